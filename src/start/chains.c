/* chains.c - the chain method [Lee, Preparata 1977; Edelsbrunner, Guibas, Stolfi 1986].
 *
 * Order points by y, and those of one y by x: a lower one comes first, and an edge goes up from its
 * first end to the other. A tile to the left of an edge comes before the tile to its right. That
 * order has no cycles (docs/proofs/queries.md), so all tiles can get positions 1 to n, each after
 * those to its left. Chain c, for c from 1 to n + 1, separates the tiles before position c from the
 * others: edges from the lowest vertex of the hull to the highest one, each of them upwards. Chain
 * 1 and n + 1 are the two sides of the hull.
 *
 *        chain 2   3     4
 *           \  1 | | 2 / \ 3 /
 *            \   | |  /   \ /
 *
 * A search knows that q is at one of the positions low to high. Of the chains between them it takes
 * the one whose number ends with most zeros in binary, and tests q against the edge of that chain
 * at the height of q. Only the positions on one side of the edge remain.
 *
 * An edge from a tile at position l to one at r belongs to the chains l + 1 to r. It is stored only
 * once, with the one of them that has most zeros at the end: of these chains the search meets that
 * one first. At the height of q the tiles lie side by side, and the ranges of the edges between
 * them follow each other: low and high are always ends of such ranges. So a range lies either
 * within low .. high or outside it, and the chain that the search takes stores its edge at that
 * height itself; a binary search finds it. Each test halves the positions that remain: at most
 * log2(n + 1) + 1 tests, each after a search in one list.
 *
 * Comparisons of coordinates and the exact orient2d: nothing is rounded. A point on an edge counts
 * as right of it, one at a vertex as above it; both are within the tile that is found, or on its
 * border. Chains take 68 to 88 bytes a tile: edges are stored with their coordinates, so that a
 * test waits for memory only once. */
#include "start/chains.h"

#include <stdlib.h>
#include <string.h>

/* --- building --------------------------------------------------------------------------------- */

typedef struct chain_vertex {
    mw_point at;
    uint32_t vertex;
} chain_vertex;

/* mw_chains_edge, with ranks of vertices. */
typedef struct chain_link {
    uint32_t low, high, left, right;
} chain_link;

/* What is needed only while chains are built. */
typedef struct chains_build {
    const mw_tiling *tiling;
    mw_job *job;
    chain_vertex *vertex[2];
    uint32_t *rank;     /* of each vertex                                     */
    uint32_t *position; /* of each tile                                       */
    uint32_t *ready;    /* tiles that may be placed next                      */
    uint8_t *before;    /* neighbours to the left of a tile without a position   */
    chain_link *link;
    uint32_t links;
} chains_build;

static void chains_build_release(chains_build *b)
{
    free(b->vertex[0]);
    free(b->vertex[1]);
    free(b->rank);
    free(b->position);
    free(b->ready);
    free(b->before);
    free(b->link);
}

static MW_INLINE bool chain_is_above(mw_point a, mw_point b)
{
    return a.y > b.y || (a.y == b.y && a.x > b.x);
}

/* Merge v[from .. middle) and v[middle .. to) into w. */
static void chains_merge(const chain_vertex *v, chain_vertex *w, uint32_t from, uint32_t middle,
                         uint32_t to)
{
    uint32_t i = from, j = middle;
    for (uint32_t k = from; k < to; k++)
        w[k] = j == to || (i < middle && !chain_is_above(v[i].at, v[j].at)) ? v[i++] : v[j++];
}

/* Sort the vertices that tiles use, and rank them. */
static bool chains_rank(mw_chains *chains, chains_build *b)
{
    const mw_tiling *tiling = b->tiling;
    uint32_t n = 0;
    for (int k = 0; k < 2; k++)
        b->vertex[k] = mw__alloc_lines(tiling->point_count, sizeof *b->vertex[k]);
    b->rank = mw__alloc_lines(tiling->point_count, sizeof *b->rank);
    if (!b->vertex[0] || !b->vertex[1] || !b->rank) return false;
    for (uint32_t v = 0; v < tiling->point_count; v++)
        if (mw__vertex_is_used(tiling, v)) b->vertex[0][n++] = (chain_vertex){tiling->point[v], v};
    for (uint64_t width = 1; width < n; width *= 2) {
        if (!mw__job_step(b->job, width, (uint64_t)n * 4)) return false;
        for (uint64_t from = 0; from < n; from += 2 * width) {
            uint64_t middle = from + width < n ? from + width : n,
                     to = from + 2 * width < n ? from + 2 * width : n;
            chains_merge(b->vertex[0], b->vertex[1], (uint32_t)from, (uint32_t)middle,
                         (uint32_t)to);
        }
        chain_vertex *sorted = b->vertex[1];
        b->vertex[1] = b->vertex[0];
        b->vertex[0] = sorted;
    }
    chains->points = n;
    for (uint32_t r = 0; r < n; r++) b->rank[b->vertex[0][r].vertex] = r;
    return true;
}

static MW_INLINE bool chains_edge_goes_up(const chains_build *b, const mw_triangle *tile,
                                          uint32_t k)
{
    return b->rank[tile->v[k]] < b->rank[tile->v[k + 1]];
}

/* Put each tile behind those to its left. Returns how many have a position. */
static uint32_t chains_place(chains_build *b)
{
    const mw_tiling *tiling = b->tiling;
    uint32_t ready = 0, placed = 0;
    for (uint32_t t = tiling->tri_count; t-- > 0;) {
        const mw_triangle *tile = &tiling->tri[t];
        b->before[t] = 0;
        for (uint32_t k = 0; k < 3; k++)
            if (tile->link[k] != MW_NONE && !chains_edge_goes_up(b, tile, k)) b->before[t]++;
        if (b->before[t] == 0) b->ready[ready++] = t;
    }
    while (ready > 0) {
        uint32_t t = b->ready[--ready];
        const mw_triangle *tile = &tiling->tri[t];
        b->position[t] = ++placed;
        for (uint32_t k = 0; k < 3; k++) {
            if (tile->link[k] == MW_NONE || !chains_edge_goes_up(b, tile, k)) continue;
            uint32_t right = mw__link_triangle(tile->link[k]);
            if (--b->before[right] == 0) b->ready[ready++] = right;
        }
    }
    return placed;
}

/* The name of a tile; of a ghost that of a triangle beside it, or else `other`. */
static uint32_t chains_tile_name(const mw_tiling *tiling, uint32_t t, uint32_t other)
{
    if (!tiling->tile_of || !(tiling->tri[t].user & MW_GHOST)) return mw__tile_name(tiling, t);
    for (uint32_t k = 0; k < 3; k++) {
        uint32_t link = tiling->tri[t].link[k];
        if (link != MW_NONE && !(tiling->tri[mw__link_triangle(link)].user & MW_GHOST))
            return mw__tile_name(tiling, mw__link_triangle(link));
    }
    return other;
}

static bool chains_place_tiles(mw_chains *chains, chains_build *b)
{
    const mw_tiling *tiling = b->tiling;
    size_t n = tiling->tri_count;
    b->position = mw__alloc_lines(n, sizeof *b->position);
    b->ready = mw__alloc_lines(n, sizeof *b->ready);
    b->before = mw__alloc_lines(n, sizeof *b->before);
    chains->tile = mw__alloc_lines(n + 2, sizeof *chains->tile);
    if (!b->position || !b->ready || !b->before || !chains->tile) return false;
    if (chains_place(b) != n) return true; /* of an embedding all have one */
    chains->tiles = (uint32_t)n;
    for (uint32_t t = 0; t < n; t++) b->ready[b->position[t] - 1] = t;
    chains->tile[0] = 0;
    for (uint32_t i = 1; i <= n; i++)
        chains->tile[i] = chains_tile_name(tiling, b->ready[i - 1], chains->tile[i - 1]);
    return true;
}

/* The chain of most zeros at the end, of those from `first` to `last`. */
static MW_INLINE uint32_t chain_between(uint32_t first, uint32_t last)
{
    uint32_t bit = 31 - (uint32_t)__builtin_clz((first - 1) ^ last);
    return last >> bit << bit;
}

static MW_INLINE uint32_t chain_of_link(const chain_link *e)
{
    return chain_between(e->left + 1, e->right);
}

/* Edge k of a tile, if the tile is left of it, or there is nothing to its left. */
static bool chains_link(const mw_chains *chains, const chains_build *b, uint32_t t, uint32_t k,
                        chain_link *e)
{
    const mw_triangle *tile = &b->tiling->tri[t];
    uint32_t from = b->rank[tile->v[k]], to = b->rank[tile->v[k + 1]], link = tile->link[k];
    if (from < to)
        *e = (chain_link){from, to, b->position[t],
                          link == MW_NONE ? chains->tiles + 1
                                          : b->position[mw__link_triangle(link)]};
    else
        *e = (chain_link){to, from, 0, b->position[t]};
    return from < to || link == MW_NONE;
}

static mw_chains_edge chains_edge(const chains_build *b, const chain_link *e)
{
    return (mw_chains_edge){b->vertex[0][e->low].at, b->vertex[0][e->high].at, e->left, e->right};
}

static void chains_note_ends(mw_chains *chains, const chains_build *b, const chain_link *e)
{
    bool right = e->right == chains->tiles + 1;
    if (e->left != 0 && !right) return;
    if (e->low == 0) chains->bottom[right] = chains_edge(b, e);
    if (e->high == chains->points - 1) chains->top[right] = chains_edge(b, e);
}

/* Make of counts[0 .. n], of which the last is 0, where each begins. */
static void counts_add_up(uint32_t *counts, size_t n)
{
    uint32_t sum = 0;
    for (size_t i = 0; i <= n; i++) {
        uint32_t here = counts[i];
        counts[i] = sum;
        sum += here;
    }
}

/* All edges, in the order of their lower ends. */
static bool chains_sort_links(mw_chains *chains, chains_build *b)
{
    uint32_t tiles = b->tiling->tri_count;
    chain_link e;
    uint32_t *next = mw__calloc((size_t)chains->points + 1, sizeof *next);
    if (!next) return false;
    for (uint32_t t = 0; t < tiles; t++)
        for (uint32_t k = 0; k < 3; k++)
            if (chains_link(chains, b, t, k, &e)) next[e.low]++, b->links++;
    counts_add_up(next, chains->points);
    b->link = mw__alloc_lines(b->links, sizeof *b->link);
    for (uint32_t t = 0; t < tiles && b->link; t++)
        for (uint32_t k = 0; k < 3; k++)
            if (chains_link(chains, b, t, k, &e)) {
                b->link[next[e.low]++] = e;
                chains_note_ends(chains, b, &e);
            }
    free(next);
    return b->link != NULL;
}

/* Give each chain its edges. */
static bool chains_share_links(mw_chains *chains, chains_build *b)
{
    size_t last = (size_t)chains->tiles + 1;
    chains->from = mw__calloc(last + 2, sizeof *chains->from);
    chains->edge = mw__alloc_lines(b->links, sizeof *chains->edge);
    if (!chains->from || !chains->edge) return false;
    for (uint32_t i = 0; i < b->links; i++) chains->from[chain_of_link(&b->link[i])]++;
    counts_add_up(chains->from, last + 1);
    for (uint32_t i = 0; i < b->links; i++)
        chains->edge[chains->from[chain_of_link(&b->link[i])]++] = chains_edge(b, &b->link[i]);
    memmove(chains->from + 1, chains->from, (last + 1) * sizeof *chains->from);
    chains->from[0] = 0;
    return true;
}

bool mw__chains_create(mw_chains *chains, const mw_tiling *tiling, mw_job *job)
{
    chains_build b = {.tiling = tiling, .job = job};
    *chains = (mw_chains){0};
    mw__job_stage(job, "parting triangles by chains", 1);
    if (tiling->border_loops || !tiling->embedding) return true;
    bool done = chains_rank(chains, &b) && mw__job_step(job, 2, 4) &&
                chains_place_tiles(chains, &b) && mw__job_step(job, 3, 4);
    if (done && chains->tiles)
        done = chains_sort_links(chains, &b) && chains_share_links(chains, &b);
    chains_build_release(&b);
    return done;
}

void mw__chains_release(mw_chains *chains)
{
    free(chains->edge);
    free(chains->from);
    free(chains->tile);
}

size_t mw__chains_bytes(const mw_chains *chains)
{
    size_t tiles = chains->tiles;
    if (tiles == 0) return 0;
    return (tiles + 2) * sizeof *chains->tile + (tiles + 3) * sizeof *chains->from +
           chains->from[tiles + 2] * sizeof *chains->edge;
}

/* --- the search ------------------------------------------------------------------------------- */

typedef struct chain_search {
    mw_point q;
    uint32_t low, high; /* positions                                         */
    uint32_t beside;    /* the position across the edge that was tested last */
    uint32_t comparisons, tests;
} chain_search;

/* Does q lie to the left of an edge? */
static MW_INLINE bool chain_edge_has_left(const mw_chains_edge *e, mw_point q)
{
    return mw__orient2d(e->low, e->high, q) > 0;
}

/* Begin a search; where q is below or above all, it ends there. */
static MW_INLINE void chain_search_begin(const mw_chains *chains, chain_search *s, mw_point q)
{
    *s = (chain_search){.q = q, .high = chains->tiles + 1, .comparisons = 2};
    bool below = chain_is_above(chains->bottom[0].low, q);
    if (MW_LIKELY(!below && chain_is_above(chains->top[0].high, q))) return;
    const mw_chains_edge *end = below ? chains->bottom : chains->top;
    s->low = s->high = chain_edge_has_left(&end[0], q) ? end[0].right : end[1].left;
    s->tests++;
}

/* The chain that is tested next. */
static MW_INLINE uint32_t chain_search_next(const chain_search *s)
{
    return chain_between(s->low + 1, s->high);
}

/* The edge of a chain at the height of q: the last one that does not begin above it. */
static MW_INLINE const mw_chains_edge *chain_edge_at(const mw_chains *chains, uint32_t chain,
                                                     chain_search *s)
{
    const mw_chains_edge *e = &chains->edge[chains->from[chain]];
    for (uint32_t n = chains->from[chain + 1] - chains->from[chain]; n > 1;) {
        uint32_t half = n / 2;
        e = chain_is_above(e[half].low, s->q) ? e : e + half;
        n -= half;
        s->comparisons++;
    }
    return e;
}

/* An edge of a chain always has the chain between its positions. Chains that come from a file
 * (src/prepared) may not keep to that: there, too, each step leaves fewer positions. */
static MW_INLINE void chain_search_step(const mw_chains *chains, chain_search *s)
{
    const uint32_t chain = chain_search_next(s);
    const mw_chains_edge *e = chain_edge_at(chains, chain, s);
    const uint32_t right = e->right > chain ? e->right : chain,
                   before = e->left < chain ? e->left : chain - 1;
    /* selected, since every other jump would be guessed wrong */
    bool left = chain_edge_has_left(e, s->q);
    s->low = left ? s->low : right;
    s->high = left ? before : s->high;
    s->beside = left ? e->right : e->left;
    s->tests++;
}

static uint32_t chain_search_tile(const mw_chains *chains, const chain_search *s)
{
    bool outside = s->low == 0 || s->low > chains->tiles;
    return chains->tile[outside ? s->beside : s->low];
}

uint32_t mw__chains_first(const mw_chains *chains, mw_point q)
{
    if (chains->tiles == 0) return 0;
    chain_search s;
    for (chain_search_begin(chains, &s, q); s.low < s.high;) chain_search_step(chains, &s);
    return chain_search_tile(chains, &s);
}

/* All searches make a step before any makes another. */
void mw__chains_first_many(const mw_chains *chains, const mw_point *q, uint32_t n, uint32_t *tile)
{
    chain_search search[MW_CHAINS_MANY];
    uint32_t alive[MW_CHAINS_MANY], count = 0;
    for (uint32_t i = 0; i < n; i++) {
        tile[i] = 0;
        if (chains->tiles == 0) continue;
        chain_search_begin(chains, &search[i], q[i]);
        alive[count++] = i;
    }
    while (count > 0) {
        uint32_t left = 0;
        for (uint32_t k = 0; k < count; k++) {
            const chain_search *s = &search[alive[k]];
            if (s->low < s->high) {
                alive[left++] = alive[k];
                __builtin_prefetch(&chains->edge[chains->from[chain_search_next(s)]]);
            } else {
                tile[alive[k]] = chain_search_tile(chains, s);
            }
        }
        count = left;
        for (uint32_t k = 0; k < count; k++) chain_search_step(chains, &search[alive[k]]);
    }
}

void mw__chains_count(const mw_chains *chains, mw_point q, mw_work *work)
{
    if (chains->tiles == 0) return;
    chain_search s;
    for (chain_search_begin(chains, &s, q); s.low < s.high;) chain_search_step(chains, &s);
    work->orient[MW_STAGE_INIT] += s.tests;
    work->comparisons += s.comparisons;
}
