/* connect.c - neighbours of triangles in O(n), whatever their order: half-edges are parted by their lower vertices, where the halves of an
 * edge find each other by the upper one. Of large meshes by ranges of these; then each range is linked, in cache (link.c), by any
 * thread. Meshes that are laid out are linked on the way (parts.c). */
#include "mesh/connect.h"

#include "base/threads.h"
#include "mesh/link.h"

#include <stdlib.h>

static MW_INLINE uint32_t lower(const mw_triangle *t, uint32_t e)
{
    return t->v[e] < t->v[e + 1] ? t->v[e] : t->v[e + 1];
}

static MW_INLINE uint32_t upper(const mw_triangle *t, uint32_t e)
{
    return t->v[e] < t->v[e + 1] ? t->v[e + 1] : t->v[e];
}

/* --- a mesh that fits the cache --- */

/* The half-edges of lower vertex i are half[first[i]] to before half[first[i + 1]]. */
static void gather(const mw_triangle *tri, uint32_t n, uint32_t vertex_count, uint32_t *first, mw_half_edge *half)
{
    uint32_t sum = 0;
    for (uint32_t t = 0; t < n; t++)
        for (uint32_t e = 0; e < 3 && mw__has_three_vertices(&tri[t]); e++) first[lower(&tri[t], e)]++;
    for (uint32_t i = 0; i <= vertex_count; i++) first[i] = sum += first[i];
    for (uint32_t t = 0; t < n; t++)
        for (uint32_t e = 0; e < 3 && mw__has_three_vertices(&tri[t]); e++)
            half[--first[lower(&tri[t], e)]] = (mw_half_edge){upper(&tri[t], e), mw__link(t, e)};
}

static bool connect_few(mw_triangle *tri, uint32_t n, uint32_t vertex_count, mw_links *links)
{
    uint32_t *first = mw__calloc((size_t)vertex_count + 1, sizeof *first);
    mw_half_edge *half = mw__alloc(3 * (size_t)n, sizeof *half);
    bool done = first && half;
    if (done) gather(tri, n, vertex_count, first, half);
    for (uint32_t i = 0; i < vertex_count && done; i++)
        done = mw__match(tri, half + first[i], first[i + 1] - first[i], links);
    free(first);
    free(half);
    return done;
}

/* --- any mesh --- */

enum {
    WORTHWHILE = 1 << 14, /* triangles for a thread to be worth it          */
    PART_SHIFT = 12,      /* at least so many vertices, as a power of two, make a part */
    MOST_PARTS = 1 << 12  /* written to at the same time                    */
};

/* Of one thread: its share of the triangles is piled up by parts, then it links parts as they come. */
typedef struct bench {
    uint32_t *next; /* per part: how many half-edges of the share it gets; then where the next one goes */
    mw_link_room room;
    mw_links links;
    bool done;
    char apart[64]; /* from the next bench: threads write to these */
} bench;

typedef struct work {
    mw_triangle *tri;
    uint32_t n, vertex_count, shift, parts;
    uint32_t *half;  /* half-edges by the parts of their lower vertices */
    uint32_t *first; /* of each part */
    int team;
    bench *bench;
} work;

static uint32_t share_begin(const work *w, int share)
{
    return (uint32_t)((uint64_t)w->n * (uint32_t)share / (uint32_t)w->team);
}

static void count_share(const work *w, int share)
{
    uint32_t *next = w->bench[share].next;
    for (uint32_t t = share_begin(w, share), end = share_begin(w, share + 1); t < end; t++)
        for (uint32_t e = 0; e < 3 && mw__has_three_vertices(&w->tri[t]); e++) next[lower(&w->tri[t], e) >> w->shift]++;
}

static void add_up(const work *w)
{
    uint32_t sum = 0;
    for (uint32_t p = 0; p < w->parts; p++) {
        w->first[p] = sum;
        for (int i = 0; i < w->team; i++) {
            uint32_t here = w->bench[i].next[p];
            w->bench[i].next[p] = sum;
            sum += here;
        }
    }
    w->first[w->parts] = sum;
}

static void pile_share(const work *w, int share)
{
    uint32_t *next = w->bench[share].next;
    for (uint32_t t = share_begin(w, share), end = share_begin(w, share + 1); t < end; t++)
        for (uint32_t e = 0; e < 3 && mw__has_three_vertices(&w->tri[t]); e++)
            w->half[next[lower(&w->tri[t], e) >> w->shift]++] = mw__link(t, e);
}

static void link_part(const work *w, bench *b, uint32_t p)
{
    uint64_t base = (uint64_t)p << w->shift, size = UINT64_C(1) << w->shift;
    if (base + size > w->vertex_count) size = w->vertex_count - base;
    mw_part part = {(uint32_t)base, (uint32_t)size, 0, 0};
    mw_strays all = {w->half + w->first[p], w->first[p + 1] - w->first[p]};
    b->done = b->done && mw__link_part(w->tri, part, all, &b->room, &b->links);
}

/* What one thread does. */
static void work_on(const work *w, bench *b)
{
#ifdef _OPENMP
#pragma omp for schedule(static)
#endif
    for (int i = 0; i < w->team; i++) count_share(w, i);
#ifdef _OPENMP
#pragma omp single
#endif
    add_up(w);
#ifdef _OPENMP
#pragma omp for schedule(static)
#endif
    for (int i = 0; i < w->team; i++) pile_share(w, i);
#ifdef _OPENMP
#pragma omp for schedule(dynamic)
#endif
    for (uint32_t p = 0; p < w->parts; p++) link_part(w, b, p);
}

static void work_together(const work *w)
{
#ifdef _OPENMP
#pragma omp parallel num_threads(w->team) if (w->team > 1)
    work_on(w, &w->bench[omp_get_thread_num()]);
#else
    work_on(w, &w->bench[0]);
#endif
}

static bool open_work(work *w)
{
    while (w->vertex_count >> w->shift >= MOST_PARTS) w->shift++;
    w->parts = (w->vertex_count >> w->shift) + 1;
    w->half = mw__alloc_lines(3 * (size_t)w->n, sizeof *w->half);
    w->first = mw__alloc((size_t)w->parts + 1, sizeof *w->first);
    w->bench = mw__calloc((size_t)w->team, sizeof *w->bench);
    bool done = w->half && w->first && w->bench;
    for (int i = 0; i < w->team && done; i++) {
        w->bench[i] = (bench){.next = mw__calloc(w->parts, sizeof(uint32_t)), .links = mw__no_links(), .done = true};
        done = w->bench[i].next;
    }
    return done;
}

static void close_work(work *w)
{
    for (int i = 0; i < w->team && w->bench; i++) {
        free(w->bench[i].next);
        mw__link_room_release(&w->bench[i].room);
    }
    free(w->bench);
    free(w->first);
    free(w->half);
}

static bool connect_many(mw_triangle *tri, uint32_t n, uint32_t vertex_count, uint32_t threads, mw_links *links)
{
    work w = {.tri = tri, .n = n, .vertex_count = vertex_count, .shift = PART_SHIFT};
    w.team = mw__team(threads, n / WORTHWHILE + 1);
    bool done = open_work(&w);
    if (done) work_together(&w);
    for (int i = 0; i < w.team && done; i++) {
        done = w.bench[i].done;
        mw__links_add(tri, &w.bench[i].links, links);
    }
    close_work(&w);
    return done;
}

bool mw__connect(mw_triangle *tri, uint32_t n, uint32_t vertex_count, uint32_t threads, mw_links *links)
{
    mw_links found = mw__no_links();
    bool few = n < WORTHWHILE && vertex_count < WORTHWHILE;
    bool done = few ? connect_few(tri, n, vertex_count, &found) : connect_many(tri, n, vertex_count, threads, &found);
    if (links) *links = found;
    return done;
}
