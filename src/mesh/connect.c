/* connect.c - finds the neighbours of triangles in O(n), in any order of the arrays. Half-edges are
 * sorted into groups by their lower vertices; in a group, the two halves of an edge have the same
 * upper vertex. Large meshes are divided into partitions by ranges of lower vertices. Any thread
 * links a partition, in cache (partition_links.c). Meshes that are laid out are linked while they
 * are sorted (partitions.c). */
#include "mesh/connect.h"

#include "mesh/partition_links.h"

#include <stdlib.h>

static MW_INLINE uint32_t edge_lower_vertex(const mw_triangle *t, uint32_t e)
{
    return t->v[e] < t->v[e + 1] ? t->v[e] : t->v[e + 1];
}

static MW_INLINE uint32_t edge_upper_vertex(const mw_triangle *t, uint32_t e)
{
    return t->v[e] < t->v[e + 1] ? t->v[e + 1] : t->v[e];
}

/* --- a mesh that fits the cache --- */

/* The half-edges of lower vertex i: half[first[i]] up to, not including, half[first[i + 1]]. */
static void half_edges_gather(const mw_triangle *tri, uint32_t n, uint32_t vertex_count,
                              uint32_t *first, mw_half_edge *half)
{
    uint32_t sum = 0;
    for (uint32_t t = 0; t < n; t++)
        for (uint32_t e = 0; e < 3 && mw__has_three_vertices(&tri[t]); e++)
            first[edge_lower_vertex(&tri[t], e)]++;
    for (uint32_t i = 0; i <= vertex_count; i++) first[i] = sum += first[i];
    for (uint32_t t = 0; t < n; t++)
        for (uint32_t e = 0; e < 3 && mw__has_three_vertices(&tri[t]); e++)
            half[--first[edge_lower_vertex(&tri[t], e)]] =
                (mw_half_edge){edge_upper_vertex(&tri[t], e), mw__link(t, e)};
}

static bool connect_in_cache(mw_triangle *tri, uint32_t n, uint32_t vertex_count, mw_links *links)
{
    uint32_t *first = mw__calloc((size_t)vertex_count + 1, sizeof *first);
    mw_half_edge *half = mw__alloc(3 * (size_t)n, sizeof *half);
    bool done = first && half;
    if (done) half_edges_gather(tri, n, vertex_count, first, half);
    for (uint32_t i = 0; i < vertex_count && done; i++)
        done = mw__half_edges_match(tri, half + first[i], first[i + 1] - first[i], links);
    free(first);
    free(half);
    return done;
}

/* --- any mesh --- */

enum {
    WORTHWHILE = 1 << 14,     /* triangles that make a thread worthwhile */
    PARTITION_SHIFT = 12,     /* a partition has at least 2^12 vertices */
    MOST_PARTITIONS = 1 << 12 /* so that the caches can hold the ends of all */
};

/* The state of a thread. It distributes its share of the half-edges to partitions, then links
 * partitions as they become free. */
typedef struct connect_worker {
    /* Per partition: the number of half-edges in the share; then where the next one goes. */
    uint32_t *next;
    mw_link_workspace workspace;
    mw_links links;
    bool done;
    char apart[64]; /* keeps the next worker, which another thread writes, on other cache lines */
} connect_worker;

typedef struct connect_work {
    mw_triangle *tri;
    uint32_t n, vertex_count, shift, partitions;
    uint32_t *half;  /* half-edges by the partitions of their lower vertices */
    uint32_t *first; /* of each partition */
    uint32_t team;
    connect_worker *worker;
} connect_work;

static uint32_t connect_share_begin(const connect_work *w, uint32_t share)
{
    return (uint32_t)((uint64_t)w->n * share / w->team);
}

static void connect_count_share(const connect_work *w, uint32_t share)
{
    uint32_t *next = w->worker[share].next;
    for (uint32_t t = connect_share_begin(w, share), end = connect_share_begin(w, share + 1);
         t < end; t++)
        for (uint32_t e = 0; e < 3 && mw__has_three_vertices(&w->tri[t]); e++)
            next[edge_lower_vertex(&w->tri[t], e) >> w->shift]++;
}

static void connect_sum_counts(const connect_work *w)
{
    uint32_t sum = 0;
    for (uint32_t p = 0; p < w->partitions; p++) {
        w->first[p] = sum;
        for (uint32_t i = 0; i < w->team; i++) {
            uint32_t here = w->worker[i].next[p];
            w->worker[i].next[p] = sum;
            sum += here;
        }
    }
    w->first[w->partitions] = sum;
}

static void connect_fill_share(const connect_work *w, uint32_t share)
{
    uint32_t *next = w->worker[share].next;
    for (uint32_t t = connect_share_begin(w, share), end = connect_share_begin(w, share + 1);
         t < end; t++)
        for (uint32_t e = 0; e < 3 && mw__has_three_vertices(&w->tri[t]); e++)
            w->half[next[edge_lower_vertex(&w->tri[t], e) >> w->shift]++] = mw__link(t, e);
}

static void connect_link_partition(const connect_work *w, connect_worker *worker, uint32_t p)
{
    uint64_t base = (uint64_t)p << w->shift, size = UINT64_C(1) << w->shift;
    if (base + size > w->vertex_count) size = w->vertex_count - base;
    mw_partition partition = {(uint32_t)base, (uint32_t)size, 0, 0};
    mw_strays all = {w->half + w->first[p], w->first[p + 1] - w->first[p]};
    worker->done = worker->done &&
                   mw__partition_link(w->tri, partition, all, &worker->workspace, &worker->links);
}

static void connect_count_chunk(void *work, uint64_t share, uint32_t member)
{
    (void)member;
    connect_count_share(work, (uint32_t)share);
}

static void connect_fill_chunk(void *work, uint64_t share, uint32_t member)
{
    (void)member;
    connect_fill_share(work, (uint32_t)share);
}

static void connect_link_chunk(void *work, uint64_t p, uint32_t member)
{
    const connect_work *w = work;
    connect_link_partition(w, &w->worker[member], (uint32_t)p);
}

static bool connect_run(connect_work *w, mw_job *job)
{
    mw__job_stage(job, "counting edges", 0.1);
    if (!mw__job_chunks(job, w->team, w->team, connect_count_chunk, w)) return false;
    connect_sum_counts(w);
    mw__job_stage(job, "distributing edges", 0.4);
    if (!mw__job_chunks(job, w->team, w->team, connect_fill_chunk, w)) return false;
    mw__job_stage(job, "linking triangles", 0.5);
    return mw__job_chunks(job, w->team, w->partitions, connect_link_chunk, w);
}

static bool connect_work_create(connect_work *w)
{
    while (w->vertex_count >> w->shift >= MOST_PARTITIONS) w->shift++;
    w->partitions = (w->vertex_count >> w->shift) + 1;
    w->half = mw__alloc_lines(3 * (size_t)w->n, sizeof *w->half);
    w->first = mw__alloc((size_t)w->partitions + 1, sizeof *w->first);
    w->worker = mw__calloc(w->team, sizeof *w->worker);
    bool done = w->half && w->first && w->worker;
    for (uint32_t i = 0; i < w->team && done; i++) {
        w->worker[i] = (connect_worker){.next = mw__calloc(w->partitions, sizeof(uint32_t)),
                                        .links = mw__no_links(),
                                        .done = true};
        done = w->worker[i].next;
    }
    return done;
}

static void connect_work_release(connect_work *w)
{
    for (uint32_t i = 0; i < w->team && w->worker; i++) {
        free(w->worker[i].next);
        mw__link_workspace_release(&w->worker[i].workspace);
    }
    free(w->worker);
    free(w->first);
    free(w->half);
}

static bool connect_by_partitions(mw_triangle *tri, uint32_t n, uint32_t vertex_count, mw_job *job,
                                  mw_links *links)
{
    connect_work w = {.tri = tri, .n = n, .vertex_count = vertex_count, .shift = PARTITION_SHIFT};
    w.team = mw__job_team(job, n / WORTHWHILE + 1);
    bool done = connect_work_create(&w) && connect_run(&w, job);
    for (uint32_t i = 0; i < w.team && done; i++) {
        done = w.worker[i].done;
        mw__links_add(tri, &w.worker[i].links, links);
    }
    connect_work_release(&w);
    return done;
}

bool mw__connect(mw_triangle *tri, uint32_t n, uint32_t vertex_count, mw_job *job, mw_links *links)
{
    mw_links found = mw__no_links();
    bool few = n < WORTHWHILE && vertex_count < WORTHWHILE;
    bool done = few ? connect_in_cache(tri, n, vertex_count, &found)
                    : connect_by_partitions(tri, n, vertex_count, job, &found);
    if (links) *links = found;
    return done;
}
