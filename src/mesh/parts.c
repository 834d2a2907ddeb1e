/* parts.c - the triangles of a mesh from piles: sorted, turned and linked.
 *
 * A part is the vertices of a range, and the triangles whose lowest vertex is one of these. What a part needs stays in cache
 * from the pile to the last link, and threads take parts. The edges at a triangle's lowest vertex are its part's; the third edge
 * may have its lower vertex in a later part: a stray. So one thread alone links each part as soon as it is sorted; several
 * sort them all first. */
#include "mesh/parts.h"

#include "base/threads.h"
#include "mesh/connect.h"
#include "mesh/link.h"

#include <stdlib.h>

/* Of one thread. */
typedef struct bench {
    uint32_t *next; /* per vertex of a part: where the next triangle goes that has it for its lowest */
    mw_stray *stray;
    uint32_t stray_count, stray_room;
    mw_stray_list *list;  /* per part: strays that this thread has found, but for `stray`, which moves */
    mw_stray_list *lists; /* per thread: those for one part */
    mw_link_room room;
    mw_links links;
    uint32_t flat, flipped;
    bool done;
    char apart[64]; /* from the next bench: threads write to these */
} bench;

typedef struct work {
    mw_mesh *mesh;
    const mw_piles *piles;
    uint32_t *first; /* triangle of each part */
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

/* Edge k of triangle `place` belongs to a later part. */
static bool note_stray(const work *w, bench *b, uint32_t place, uint32_t k)
{
    if (b->stray_count == b->stray_room) {
        uint32_t room = b->stray_room + b->stray_room / 2 + 1024;
        mw_stray *more = mw__realloc(b->stray, room, sizeof *more);
        if (!more) return false;
        b->stray = more;
        b->stray_room = room;
    }
    const uint32_t *v = w->mesh->tri[place].v;
    mw_stray_list *list = &b->list[(v[k] < v[k + 1] ? v[k] : v[k + 1]) >> w->piles->shift];
    b->stray[b->stray_count] = (mw_stray){v[k], v[k + 1], mw__link(place, k), list->first};
    list->first = b->stray_count++;
    list->count++;
    return true;
}

/* Sort the triangles of a part by their lowest vertices, in the caller's order where these are equal. */
static bool sort_part(const work *w, bench *b, uint32_t p)
{
    const mw_part part = part_of(w, p);
    const mw_point *point = w->mesh->point;
    mw_triangle *tri = w->mesh->tri;
    uint32_t *triangle_place = w->mesh->triangle_place, *next = b->next, n, flat = 0, flipped = 0;
    bool done = true;
    const mw_corners *block;
    count(w, p, part, next);
    for (mw_pile_reader r = mw__read_piles(w->piles, p); (block = mw__read_block(&r, &n));)
        for (uint32_t i = 0; i < n; i++) {
            const mw_corners c = block[i];
            uint32_t low = mw__lowest(c.v[0], c.v[1], c.v[2]), place = next[low - part.base]++;
            double area = store(point, c, &tri[place]);
            flat += area == 0;
            flipped += area < 0;
            triangle_place[c.user] = place;
            if (MW_LIKELY(mw__part_has(part, mw__middle_of(c.v[0], c.v[1], c.v[2])))) continue;
            uint32_t k = tri[place].v[1] == low ? 1 : tri[place].v[2] == low ? 2 : 0;
            done = done && note_stray(w, b, place, mw__next(k));
        }
    b->flat += flat;
    b->flipped += flipped;
    return done;
}

/* --- linking --- */

static bool link_part(const work *w, bench *b, uint32_t p)
{
    const mw_part part = part_of(w, p);
    for (uint32_t i = 0; i < w->team; i++) {
        b->lists[i] = w->bench[i].list[p];
        b->lists[i].stray = w->bench[i].stray;
    }
    return mw__link_part(w->mesh->tri, part, b->lists, w->team, &b->room, &b->links);
}

/* --- all --- */

static bool open_bench(const work *w, bench *b)
{
    *b = (bench){.links = mw__no_links()};
    b->next = mw__alloc((size_t)1 << w->piles->shift, sizeof *b->next);
    b->list = mw__calloc(w->piles->ranges, sizeof *b->list);
    b->lists = mw__alloc(w->team, sizeof *b->lists);
    b->done = b->next && b->list && b->lists;
    return b->done;
}

static void close_bench(bench *b)
{
    free(b->next);
    free(b->stray);
    free(b->list);
    free(b->lists);
    mw__link_room_release(&b->room);
}

static void work_alone(const work *w)
{
    bench *b = &w->bench[0];
    for (uint32_t p = 0; p < w->piles->ranges && b->done; p++) b->done = sort_part(w, b, p) && link_part(w, b, p);
}

static void work_together(const work *w)
{
#ifdef _OPENMP
#pragma omp parallel num_threads(w->team)
    {
        bench *b = &w->bench[omp_get_thread_num()];
#pragma omp for schedule(dynamic)
        for (uint32_t p = 0; p < w->piles->ranges; p++) b->done = b->done && sort_part(w, b, p);
#pragma omp for schedule(dynamic)
        for (uint32_t p = 0; p < w->piles->ranges; p++) b->done = b->done && link_part(w, b, p);
    }
#else
    (void)w;
#endif
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
        links->linked += b->links.linked;
        links->opposite = links->opposite && b->links.opposite;
        if (b->links.extra != MW_NONE) mw__note_extra(mesh->tri, b->links.extra, &links->extra);
    }
    return done;
}

static void add_up(const work *w)
{
    uint32_t sum = 0;
    for (uint32_t p = 0; p < w->piles->ranges; p++) {
        w->first[p] = sum;
        sum += mw__piles_count(w->piles, p);
    }
    w->first[w->piles->ranges] = sum;
}

bool mw__work_parts(mw_mesh *mesh, const mw_piles *piles, mw_links *links)
{
    work w = {.mesh = mesh, .piles = piles, .team = piles->stackers};
    w.first = mw__alloc((size_t)piles->ranges + 1, sizeof *w.first);
    w.bench = mw__calloc(w.team, sizeof *w.bench);
    bool done = w.first && w.bench;
    for (uint32_t i = 0; i < w.team && done; i++) done = open_bench(&w, &w.bench[i]);
    if (done) {
        add_up(&w);
        if (w.team > 1)
            work_together(&w);
        else
            work_alone(&w);
        done = gather(&w, links);
    }
    for (uint32_t i = 0; i < w.team && w.bench; i++) close_bench(&w.bench[i]);
    free(w.bench);
    free(w.first);
    return done;
}
