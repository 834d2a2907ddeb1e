/* open_create.c - loops of the border, and pieces of the mesh.
 *
 * O(n + b log b) for b border edges. */
#include "domain/open_create.h"

#include "base/hilbert.h"

#include <stdlib.h>

static mw_point start_of(const mw_tiling *tiling, uint32_t half)
{
    return tiling->point[tiling->tri[mw__link_triangle(half)].v[mw__link_edge(half)]];
}

static uint32_t end_of(const mw_tiling *tiling, uint32_t half)
{
    return tiling->tri[mw__link_triangle(half)].v[mw__link_edge(half) + 1];
}

/* --- turns --- */

/* Where one border edge only arrives at a vertex, turning round it through tiles leads to the only one that leaves. */
static bool find_turns(mw_open *open, const mw_tiling *tiling, const mw_rim_edge *rim, uint32_t count)
{
    uint8_t *arriving = mw__calloc(tiling->point_count, sizeof *arriving);
    if (!arriving) return false;
    for (uint32_t i = 0; i < count; i++) {
        uint8_t *here = &arriving[end_of(tiling, rim[i].half)];
        if (*here < 2) ++*here;
    }
    for (int pass = 0; pass < 2; pass++) {
        uint32_t turns = 0;
        for (uint32_t i = 0; i < count; i++) {
            if (arriving[end_of(tiling, rim[i].half)] < 2) continue;
            if (pass == 1) open->turn[turns] = (mw_turn){rim[i].half, rim[i].next};
            turns++;
        }
        if (pass == 0) open->turn = mw__alloc(turns, sizeof *open->turn);
        if (!open->turn) break;
        open->turn_count = turns;
    }
    free(arriving);
    return open->turn;
}

/* --- loops --- */

static int compare_halves(const void *left, const void *right)
{
    const mw_rim_edge *a = left, *b = right;
    return a->half < b->half ? -1 : a->half > b->half;
}

/* A loop runs round the outside of its piece if the outside reaches its leftmost vertex (of several, the lowest) from the
 * left. All edges there lead to the right, so it does where the way turns left. */
typedef struct turning {
    mw_point leftmost;
    bool outside;
} turning;

static void look_at(turning *t, mw_point u, mw_point v, mw_point w)
{
    if (v.x > t->leftmost.x || (v.x == t->leftmost.x && v.y > t->leftmost.y)) return;
    if (v.x != t->leftmost.x || v.y != t->leftmost.y) *t = (turning){v, false};
    if (mw__orient2d(u, v, w) > 0) t->outside = true;
}

/* Follow the loop of edge i and mark its edges. Does it bound a face? */
static bool bounds_face(const mw_tiling *tiling, const mw_rim_edge *rim, uint32_t count, uint32_t i, uint8_t *seen)
{
    turning t = {{INFINITY, INFINITY}, false};
    const mw_rim_edge *edge = &rim[i];
    while (!seen[edge - rim]) {
        seen[edge - rim] = 1;
        const mw_rim_edge key = {.half = edge->next};
        const mw_rim_edge *next = bsearch(&key, rim, count, sizeof key, compare_halves);
        look_at(&t, start_of(tiling, edge->half), start_of(tiling, next->half),
                tiling->point[end_of(tiling, next->half)]);
        edge = next;
    }
    return !t.outside;
}

/* The edges are in order, so each loop is met by its lowest one. */
static bool find_loops(mw_open *open, const mw_tiling *tiling, const mw_rim_edge *rim, uint32_t count)
{
    uint8_t *seen = mw__calloc(count, sizeof *seen);
    open->loop = mw__alloc(tiling->hole_count, sizeof *open->loop); /* each hole has one piece round it */
    bool done = seen && open->loop;
    for (uint32_t i = 0; done && i < count; i++)
        if (!seen[i] && bounds_face(tiling, rim, count, i, seen))
            open->loop[open->loop_count++] = (mw_hole_loop){rim[i].half, rim[i].hole};
    free(seen);
    return done;
}

/* --- pieces --- */

static uint32_t root_of(uint32_t *parent, uint32_t v)
{
    while (parent[v] != v) {
        parent[v] = parent[parent[v]];
        v = parent[v];
    }
    return v;
}

/* parent[v] leads to the lowest vertex of the piece. */
static void unite(const mw_tiling *tiling, uint32_t *parent)
{
    for (uint32_t v = 0; v < tiling->point_count; v++) parent[v] = v;
    for (uint32_t t = 0; t < tiling->tri_count; t++)
        for (uint32_t k = 0; k < 2; k++) {
            uint32_t a = root_of(parent, tiling->tri[t].v[k]), b = root_of(parent, tiling->tri[t].v[k + 1]);
            parent[a > b ? a : b] = a > b ? b : a;
        }
}

/* From `parent` to numbers of pieces; vertices that no tile has get MW_NONE. Returns how many pieces there are. */
static uint32_t number_pieces(const mw_tiling *tiling, uint32_t *parent, uint32_t *number)
{
    uint32_t pieces = 0;
    for (uint32_t v = 0; v < tiling->point_count; v++) number[v] = MW_NONE;
    for (uint32_t t = 0; t < tiling->tri_count; t++) {
        uint32_t root = root_of(parent, tiling->tri[t].v[0]);
        if (number[root] == MW_NONE) number[root] = pieces++;
        for (uint32_t k = 0; k < 3; k++) number[tiling->tri[t].v[k]] = number[root];
    }
    return pieces;
}

static void measure_pieces(mw_open *open, const mw_tiling *tiling)
{
    for (uint32_t i = 0; i < open->piece_count; i++) open->piece[i] = (mw_part){mw__box_of_nothing(), MW_NONE};
    for (uint32_t t = 0; t < tiling->tri_count; t++) {
        mw_part *piece = &open->piece[open->piece_of[tiling->tri[t].v[0]]];
        if (piece->first == MW_NONE) piece->first = t;
        for (uint32_t k = 0; k < 3; k++) {
            mw_point p = tiling->point[tiling->tri[t].v[k]];
            mw__box_join(&piece->box, (mw_box){{p.x, p.y}, {p.x, p.y}});
        }
    }
}

/* Small pieces first: a place in the boxes of several is likelier in the smallest. By the size of the longer side, in
 * powers of four, then along a Hilbert curve. */
static uint64_t rank_of(const mw_hilbert *hilbert, const mw_box *box)
{
    int size;
    frexp(fmax(box->high[0] / 2 - box->low[0] / 2, box->high[1] / 2 - box->low[1] / 2), &size);
    uint32_t key = mw__hilbert_key(hilbert, box->low[0] / 2 + box->high[0] / 2, box->low[1] / 2 + box->high[1] / 2);
    return (uint64_t)(size + 4096) / 2 << 32 | key;
}

typedef struct ranked {
    uint64_t rank;
    uint32_t piece;
} ranked;

static int compare_ranks(const void *left, const void *right)
{
    const ranked *a = left, *b = right;
    if (a->rank != b->rank) return a->rank < b->rank ? -1 : 1;
    return a->piece < b->piece ? -1 : 1;
}

/* Number the pieces anew in the order in which they are to be tried. */
static bool sort_pieces(mw_open *open, const mw_tiling *tiling)
{
    ranked *order = mw__alloc(open->piece_count, sizeof *order);
    uint32_t *number = mw__alloc(open->piece_count, sizeof *number);
    mw_part *sorted = mw__alloc(open->piece_count, sizeof *sorted);
    bool done = order && number && sorted;
    if (done) {
        mw_box all = mw__box_of_nothing();
        for (uint32_t i = 0; i < open->piece_count; i++) mw__box_join(&all, open->piece[i].box);
        mw_hilbert hilbert = mw__hilbert(all.low, all.high);
        for (uint32_t i = 0; i < open->piece_count; i++) order[i] = (ranked){rank_of(&hilbert, &open->piece[i].box), i};
        qsort(order, open->piece_count, sizeof *order, compare_ranks);
        for (uint32_t i = 0; i < open->piece_count; i++) {
            sorted[i] = open->piece[order[i].piece];
            number[order[i].piece] = i;
        }
        for (uint32_t v = 0; v < tiling->point_count; v++)
            if (open->piece_of[v] != MW_NONE) open->piece_of[v] = number[open->piece_of[v]];
        free(open->piece);
        open->piece = sorted;
    } else {
        free(sorted);
    }
    free(order);
    free(number);
    return done;
}

static mw_box box_of_piece(const void *pieces, uint32_t i)
{
    return ((const mw_part *)pieces)[i].box;
}

static bool list_pieces(mw_open *open, const mw_tiling *tiling)
{
    open->piece = mw__alloc(open->piece_count, sizeof *open->piece);
    if (!open->piece) return false;
    measure_pieces(open, tiling);
    return sort_pieces(open, tiling) && mw__boxes_create(&open->boxes, open->piece_count, box_of_piece, open->piece);
}

static bool find_pieces(mw_open *open, const mw_tiling *tiling)
{
    uint32_t *parent = mw__alloc(tiling->point_count, sizeof *parent);
    open->piece_of = mw__alloc(tiling->point_count, sizeof *open->piece_of);
    bool done = parent && open->piece_of;
    if (done) {
        unite(tiling, parent);
        open->piece_count = number_pieces(tiling, parent, open->piece_of);
    }
    free(parent);
    if (!done) return false;
    if (open->piece_count > 1) return list_pieces(open, tiling);
    free(open->piece_of);
    open->piece_of = NULL;
    return true;
}

/* --- all of it --- */

bool mw__open_create(mw_open *open, const mw_tiling *tiling, mw_rim_edge *rim, uint32_t count)
{
    *open = (mw_open){.edge_count = count};
    qsort(rim, count, sizeof *rim, compare_halves);
    return find_turns(open, tiling, rim, count) && find_loops(open, tiling, rim, count) && find_pieces(open, tiling);
}
