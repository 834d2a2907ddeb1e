/* parts.c - the triangles of a mesh from piles: sorted, turned and linked.
 *
 * A part is the vertices of a range, and the triangles whose lowest vertex is one of these. What a part needs stays in cache
 * from the pile to the last link, and threads take parts. The edges at a triangle's lowest vertex are its part's; the third edge
 * may have its lower vertex in a later part: a stray. So a part can be linked as soon as it and all before it are sorted. */
#include "mesh/parts.h"

#include "base/threads.h"
#include "mesh/link.h"

#include <stdlib.h>

/* Strays for a part: each is kept in the piles, in the room of a triangle that was read from there before. */
typedef struct stray_list {
    uint32_t first, count;
} stray_list;

/* Of one thread. */
typedef struct bench {
    uint32_t *next;   /* per vertex of a part: where the next triangle goes that has it for its lowest */
    stray_list *list; /* per part: strays that this thread has found */
    uint32_t *stray;  /* half-edges: those of all threads, for one part */
    size_t stray_room;
    mw_link_room room;
    mw_links links;
    uint32_t flat, flipped;
    bool done;
    char apart[64]; /* from the next bench: threads write to these */
} bench;

typedef struct work {
    mw_mesh *mesh;
    const mw_piles *piles;
    uint32_t *first;      /* triangle of each part */
    bool *sorted;         /* per part                                                */
    uint32_t ready, next; /* parts before `ready` can be linked; those before `next` are, or somebody is at it */
    uint32_t team;
    bench *bench; /* of each thread */
} work;

static mw_part part_of(const work *w, uint32_t p)
{
    uint64_t base = (uint64_t)p << w->piles->shift, size = UINT64_C(1) << w->piles->shift;
    if (base + size > w->mesh->point_count) size = w->mesh->point_count - base;
    return (mw_part){(uint32_t)base, (uint32_t)size, w->first[p], w->first[p + 1]};
}

/* --- sorting --- */

/* Where the triangles of each vertex begin. */
static void count(const work *w, uint32_t p, mw_part part, uint32_t *next)
{
    uint32_t n, sum = part.first;
    const mw_corners *c;
    for (uint32_t i = 0; i < part.size; i++) next[i] = 0;
    for (mw_pile_reader r = mw__read_piles(w->piles, p); (c = mw__read_block(&r, &n));)
        for (uint32_t i = 0; i < n; i++) next[mw__lowest(c[i].v[0], c[i].v[1], c[i].v[2]) - part.base]++;
    for (uint32_t i = 0; i < part.size; i++) {
        uint32_t here = next[i];
        next[i] = sum;
        sum += here;
    }
}

/* Store a triangle counter-clockwise. Returns its area as mw__orient does. */
static MW_INLINE double store(const mw_point *point, mw_corners c, mw_triangle *to)
{
    uint32_t a = c.v[0], b = c.v[1], d = c.v[2];
    double area = mw__orient2d(point[a], point[b], point[d]);
    uint32_t turned = 0 - (uint32_t)(area < 0), exchange = (b ^ d) & turned; /* no jump: it may be guessed wrong */
    to->v[0] = to->v[3] = a;
    to->v[1] = b ^ exchange;
    to->v[2] = d ^ exchange;
    to->link[0] = to->link[1] = to->link[2] = MW_NONE;
    to->user = c.user | (turned & MW_FLIPPED);
    return area;
}

/* Where strays of a part go. */
typedef struct shelf {
    mw_pile_reader reader;
    uint32_t place, left;
} shelf;

/* Edge `half` belongs to the later part p. A triangle has one such edge at most, so there is room. */
static void note_stray(const work *w, bench *b, shelf *s, uint32_t p, uint32_t half)
{
    if (s->left == 0) s->place = (uint32_t)(mw__read_block(&s->reader, &s->left) - w->piles->at);
    mw_corners *stray = &w->piles->at[s->place];
    stray->v[0] = half;
    stray->v[1] = b->list[p].first; /* the one before in the list */
    b->list[p].first = s->place++;
    b->list[p].count++;
    s->left--;
}

/* Sort the triangles of a part by their lowest vertices, in the caller's order where these are equal. */
static void sort_part(const work *w, bench *b, uint32_t p)
{
    const mw_part part = part_of(w, p);
    const mw_point *point = w->mesh->point;
    mw_triangle *tri = w->mesh->tri;
    uint32_t *triangle_place = w->mesh->triangle_place, *next = b->next, n, flat = 0, flipped = 0;
    const mw_corners *block;
    shelf strays = {.reader = mw__read_piles(w->piles, p)};
    count(w, p, part, next);
    for (mw_pile_reader r = mw__read_piles(w->piles, p); (block = mw__read_block(&r, &n));)
        for (uint32_t i = 0; i < n; i++) {
            const mw_corners c = block[i];
            uint32_t low = mw__lowest(c.v[0], c.v[1], c.v[2]), place = next[low - part.base]++;
            double area = store(point, c, &tri[place]);
            flat += area == 0;
            flipped += area < 0;
            triangle_place[c.user] = place;
            uint32_t middle = mw__middle_of(c.v[0], c.v[1], c.v[2]);
            if (MW_LIKELY(mw__part_has(part, middle))) continue;
            uint32_t k = tri[place].v[1] == low ? 1 : tri[place].v[2] == low ? 2 : 0;
            note_stray(w, b, &strays, middle >> w->piles->shift, mw__link(place, mw__next(k)));
        }
    b->flat += flat;
    b->flipped += flipped;
}

/* --- linking --- */

/* A part that can be linked and nobody has taken; MW_NONE if there is none now. `sorted`: one that has become so, or MW_NONE. */
static uint32_t take_part(work *w, uint32_t sorted)
{
    uint32_t taken = MW_NONE;
#ifdef _OPENMP
#pragma omp critical(mw_parts)
#endif
    {
        if (sorted != MW_NONE) w->sorted[sorted] = true;
        while (w->ready < w->piles->ranges && w->sorted[w->ready]) w->ready++;
        if (w->next < w->ready) taken = w->next++;
    }
    return taken;
}

/* What all threads have found for part p. Returns false when out of memory. */
static bool gather_strays(const work *w, bench *b, uint32_t p, mw_strays *strays)
{
    uint32_t count = 0;
    for (uint32_t i = 0; i < w->team; i++) count += w->bench[i].list[p].count;
    if (count > b->stray_room) {
        free(b->stray);
        b->stray_room = count + count / 4;
        b->stray = mw__alloc(b->stray_room, sizeof *b->stray);
        if (!b->stray) return false;
    }
    *strays = (mw_strays){b->stray, 0};
    for (uint32_t i = 0; i < w->team; i++)
        for (uint32_t left = w->bench[i].list[p].count, s = w->bench[i].list[p].first; left > 0; left--) {
            b->stray[strays->count++] = w->piles->at[s].v[0];
            s = w->piles->at[s].v[1];
        }
    return true;
}

static void link_part(const work *w, bench *b, uint32_t p)
{
    mw_strays strays;
    b->done = b->done && gather_strays(w, b, p, &strays) &&
              mw__link_part(w->mesh->tri, part_of(w, p), strays, &b->room, &b->links);
}

/* --- all --- */

/* What one thread does. Parts are sorted one after the other, as far as threads go; in between those are linked that the cache still holds. */
static void work_on(work *w, bench *b)
{
    uint32_t taken;
#ifdef _OPENMP
#pragma omp for schedule(monotonic : dynamic)
#endif
    for (uint32_t p = 0; p < w->piles->ranges; p++) {
        sort_part(w, b, p);
        taken = take_part(w, p);
        if (taken != MW_NONE) link_part(w, b, taken);
    }
    while ((taken = take_part(w, MW_NONE)) != MW_NONE) link_part(w, b, taken);
}

static void work_together(work *w)
{
#ifdef _OPENMP
#pragma omp parallel num_threads(w->team) if (w->team > 1)
    work_on(w, &w->bench[omp_get_thread_num()]);
#else
    work_on(w, &w->bench[0]);
#endif
}

static bool open_bench(const work *w, bench *b)
{
    *b = (bench){.links = mw__no_links()};
    b->next = mw__alloc((size_t)1 << w->piles->shift, sizeof *b->next);
    b->list = mw__calloc(w->piles->ranges, sizeof *b->list);
    b->done = b->next && b->list;
    return b->done;
}

static void close_bench(bench *b)
{
    free(b->next);
    free(b->list);
    free(b->stray);
    mw__link_room_release(&b->room);
}

/* What all threads have found. */
static bool gather(const work *w, mw_links *links)
{
    mw_mesh *mesh = w->mesh;
    bool done = true;
    *links = mw__no_links();
    for (uint32_t i = 0; i < w->team; i++) {
        const bench *b = &w->bench[i];
        done = done && b->done;
        mesh->flat_count += b->flat;
        mesh->flipped_count += b->flipped;
        mw__links_add(mesh->tri, &b->links, links);
    }
    return done;
}

static bool make_room(work *w)
{
    uint32_t parts = w->piles->ranges, sum = 0;
    w->first = mw__alloc((size_t)parts + 1, sizeof *w->first);
    w->sorted = mw__calloc(parts, sizeof *w->sorted);
    w->bench = mw__calloc(w->team, sizeof *w->bench);
    if (!w->first || !w->sorted || !w->bench) return false;
    for (uint32_t p = 0; p < parts; p++) {
        w->first[p] = sum;
        sum += mw__piles_count(w->piles, p);
    }
    w->first[parts] = sum;
    bool done = true;
    for (uint32_t i = 0; i < w->team && done; i++) done = open_bench(w, &w->bench[i]);
    return done;
}

static void release_room(work *w)
{
    for (uint32_t i = 0; i < w->team && w->bench; i++) close_bench(&w->bench[i]);
    free(w->bench);
    free(w->sorted);
    free(w->first);
}

bool mw__work_parts(mw_mesh *mesh, const mw_piles *piles, mw_links *links)
{
    work w = {.mesh = mesh, .piles = piles, .team = piles->stackers};
    bool done = make_room(&w);
    if (done) {
        work_together(&w);
        done = gather(&w, links);
    }
    release_room(&w);
    return done;
}
