/* partitions.c - sorts, orients and links the triangles of the buckets.
 *
 * A partition is a range of vertices and the triangles whose lowest vertex is in it. Its data stay
 * in cache from the bucket to the last link, and each thread takes one partition at a time. The two
 * edges at a triangle's lowest vertex belong to its partition. The third edge may have its lower
 * vertex in a later partition: then it is a stray there. So a partition can be linked as soon as it
 * and all partitions before it are sorted. */
#include "mesh/partitions.h"

#include "base/posix.h"
#include "mesh/partition_links.h"

#include <stdlib.h>

/* The strays for a partition. Each is stored in the buckets, in place of a triangle that has been
 * read. */
typedef struct stray_list {
    uint32_t first, count;
} stray_list;

/* The state of a thread. */
typedef struct partition_worker {
    /* Per vertex of a partition: where the next triangle with this lowest vertex goes. */
    uint32_t *next;
    stray_list *list; /* per partition: the strays that this thread has found */
    uint32_t *stray;  /* half-edges: the strays of all threads, for one partition */
    size_t stray_room;
    mw_link_workspace workspace;
    mw_links links;
    uint32_t flat, reversed;
    bool done;
    char apart[64]; /* keeps the next worker, which another thread writes, on other cache lines */
} partition_worker;

typedef struct partition_work {
    mw_mesh *mesh;
    const mw_buckets *buckets;
    uint32_t *first;              /* first triangle of each partition */
    bool *sorted;                 /* per partition */
    _Atomic uint32_t next_sorted; /* the partition to sort next */
    /* Partitions before `ready` can be linked; those before `next` are taken. */
    uint32_t ready, next;
    pthread_mutex_t lock; /* of `sorted`, `ready` and `next` */
    mw_job *job;
    uint32_t team;
    partition_worker *worker; /* of each thread */
} partition_work;

static mw_partition partition_of(const partition_work *w, uint32_t p)
{
    uint64_t base = (uint64_t)p << w->buckets->shift, size = UINT64_C(1) << w->buckets->shift;
    if (base + size > w->mesh->point_count) size = w->mesh->point_count - base;
    return (mw_partition){(uint32_t)base, (uint32_t)size, w->first[p], w->first[p + 1]};
}

/* --- sorting --- */

/* Find where the triangles of each vertex begin. */
static void partition_count_triangles(const partition_work *w, uint32_t p, mw_partition partition,
                                      uint32_t *next)
{
    uint32_t n, sum = partition.first;
    const mw_raw_triangle *c;
    for (uint32_t i = 0; i < partition.size; i++) next[i] = 0;
    for (mw_bucket_reader r = mw__bucket_reader_begin(w->buckets, p);
         (c = mw__bucket_read_block(&r, &n));)
        for (uint32_t i = 0; i < n; i++)
            next[mw__lowest_of_three(c[i].v[0], c[i].v[1], c[i].v[2]) - partition.base]++;
    for (uint32_t i = 0; i < partition.size; i++) {
        uint32_t here = next[i];
        next[i] = sum;
        sum += here;
    }
}

/* Store a triangle counter-clockwise. Returns its area as triangle_orient does. */
static MW_INLINE double partition_store_triangle(const mw_point *point, mw_raw_triangle c,
                                                 mw_triangle *to)
{
    uint32_t a = c.v[0], b = c.v[1], d = c.v[2];
    double area = mw__orient2d(point[a], point[b], point[d]);
    /* No branch: it would often be mispredicted. */
    uint32_t turned = 0 - (uint32_t)(area < 0), exchange = (b ^ d) & turned;
    to->v[0] = to->v[3] = a;
    to->v[1] = b ^ exchange;
    to->v[2] = d ^ exchange;
    to->link[0] = to->link[1] = to->link[2] = MW_NONE;
    to->user = c.user | (turned & MW_REVERSED);
    return area;
}

/* Where the strays of a partition are stored. */
typedef struct stray_writer {
    mw_bucket_reader reader;
    uint32_t slot, left;
} stray_writer;

/* Edge `half` belongs to the later partition p. A triangle has one stray at most, so there is
 * room. */
static void stray_note(const partition_work *w, partition_worker *worker, stray_writer *s,
                       uint32_t p, uint32_t half)
{
    if (s->left == 0)
        s->slot = (uint32_t)(mw__bucket_read_block(&s->reader, &s->left) - w->buckets->raw);
    mw_raw_triangle *stray = &w->buckets->raw[s->slot];
    stray->v[0] = half;
    stray->v[1] = worker->list[p].first; /* the previous one of the list */
    worker->list[p].first = s->slot++;
    worker->list[p].count++;
    s->left--;
}

/* Sort the triangles of a partition by their lowest vertices, equal ones in the order of the
 * arrays. */
static void partition_sort(const partition_work *w, partition_worker *worker, uint32_t p)
{
    const mw_partition partition = partition_of(w, p);
    const mw_point *point = w->mesh->point;
    mw_triangle *tri = w->mesh->tri;
    uint32_t *triangle_slot = w->mesh->triangle_slot, *next = worker->next, n, flat = 0,
             reversed = 0;
    const mw_raw_triangle *block;
    stray_writer strays = {.reader = mw__bucket_reader_begin(w->buckets, p)};
    partition_count_triangles(w, p, partition, next);
    for (mw_bucket_reader r = mw__bucket_reader_begin(w->buckets, p);
         (block = mw__bucket_read_block(&r, &n));)
        for (uint32_t i = 0; i < n; i++) {
            const mw_raw_triangle c = block[i];
            uint32_t low = mw__lowest_of_three(c.v[0], c.v[1], c.v[2]),
                     slot = next[low - partition.base]++;
            double area = partition_store_triangle(point, c, &tri[slot]);
            flat += area == 0;
            reversed += area < 0;
            triangle_slot[c.user] = slot;
            uint32_t middle = mw__middle_of_three(c.v[0], c.v[1], c.v[2]);
            if (MW_LIKELY(mw__partition_has(partition, middle))) continue;
            uint32_t k = tri[slot].v[1] == low ? 1 : tri[slot].v[2] == low ? 2 : 0;
            stray_note(w, worker, &strays, middle >> w->buckets->shift,
                       mw__link(slot, mw__next(k)));
        }
    worker->flat += flat;
    worker->reversed += reversed;
}

/* --- linking --- */

/* Take a partition that can be linked and that no thread has taken; MW_NONE if there is none now.
 * `sorted`: a partition that has just been sorted, or MW_NONE. */
static uint32_t partition_take(partition_work *w, uint32_t sorted)
{
    uint32_t taken = MW_NONE;
    pthread_mutex_lock(&w->lock);
    if (sorted != MW_NONE) w->sorted[sorted] = true;
    while (w->ready < w->buckets->ranges && w->sorted[w->ready]) w->ready++;
    if (w->next < w->ready) taken = w->next++;
    pthread_mutex_unlock(&w->lock);
    return taken;
}

/* Gather the strays of all threads for partition p. Returns false when out of memory. */
static bool strays_gather(const partition_work *w, partition_worker *worker, uint32_t p,
                          mw_strays *strays)
{
    uint32_t count = 0;
    for (uint32_t i = 0; i < w->team; i++) count += w->worker[i].list[p].count;
    if (count > worker->stray_room) {
        free(worker->stray);
        worker->stray_room = count + count / 4;
        worker->stray = mw__alloc(worker->stray_room, sizeof *worker->stray);
        if (!worker->stray) return false;
    }
    *strays = (mw_strays){worker->stray, 0};
    for (uint32_t i = 0; i < w->team; i++)
        for (uint32_t left = w->worker[i].list[p].count, s = w->worker[i].list[p].first; left > 0;
             left--) {
            worker->stray[strays->count++] = w->buckets->raw[s].v[0];
            s = w->buckets->raw[s].v[1];
        }
    return true;
}

static void partition_link_taken(const partition_work *w, partition_worker *worker, uint32_t p)
{
    mw_strays strays;
    worker->done = worker->done && strays_gather(w, worker, p, &strays) &&
                   mw__partition_link(w->mesh->tri, partition_of(w, p), strays, &worker->workspace,
                                      &worker->links);
}

/* --- all --- */

/* The work of one thread. Threads sort partitions in order. In between they link partitions that
 * are still in cache. */
static void partition_member_run(void *work, uint32_t member)
{
    partition_work *w = work;
    partition_worker *worker = &w->worker[member];
    uint32_t p, taken;
    while ((p = atomic_fetch_add(&w->next_sorted, 1)) < w->buckets->ranges &&
           !mw__job_stopped(w->job)) {
        partition_sort(w, worker, p);
        taken = partition_take(w, p);
        if (taken != MW_NONE) partition_link_taken(w, worker, taken);
        if (member == 0) mw__job_step(w->job, p + 1, w->buckets->ranges);
    }
    while ((taken = partition_take(w, MW_NONE)) != MW_NONE) partition_link_taken(w, worker, taken);
}

static bool partition_worker_create(const partition_work *w, partition_worker *worker)
{
    *worker = (partition_worker){.links = mw__no_links()};
    worker->next = mw__alloc((size_t)1 << w->buckets->shift, sizeof *worker->next);
    worker->list = mw__calloc(w->buckets->ranges, sizeof *worker->list);
    worker->done = worker->next && worker->list;
    return worker->done;
}

static void partition_worker_release(partition_worker *worker)
{
    free(worker->next);
    free(worker->list);
    free(worker->stray);
    mw__link_workspace_release(&worker->workspace);
}

/* Gather the results of all threads. */
static bool partition_results_gather(const partition_work *w, mw_links *links)
{
    mw_mesh *mesh = w->mesh;
    bool done = true;
    *links = mw__no_links();
    for (uint32_t i = 0; i < w->team; i++) {
        const partition_worker *worker = &w->worker[i];
        done = done && worker->done;
        mesh->flat_count += worker->flat;
        mesh->reversed_count += worker->reversed;
        mw__links_add(mesh->tri, &worker->links, links);
    }
    return done;
}

static bool partition_work_create(partition_work *w)
{
    uint32_t partitions = w->buckets->ranges, sum = 0;
    w->first = mw__alloc((size_t)partitions + 1, sizeof *w->first);
    w->sorted = mw__calloc(partitions, sizeof *w->sorted);
    w->worker = mw__calloc(w->team, sizeof *w->worker);
    if (!w->first || !w->sorted || !w->worker) return false;
    for (uint32_t p = 0; p < partitions; p++) {
        w->first[p] = sum;
        sum += mw__buckets_count(w->buckets, p);
    }
    w->first[partitions] = sum;
    bool done = true;
    for (uint32_t i = 0; i < w->team && done; i++) done = partition_worker_create(w, &w->worker[i]);
    return done;
}

static void partition_work_release(partition_work *w)
{
    for (uint32_t i = 0; i < w->team && w->worker; i++) partition_worker_release(&w->worker[i]);
    free(w->worker);
    free(w->sorted);
    free(w->first);
}

bool mw__partitions_build(mw_mesh *mesh, const mw_buckets *buckets, mw_job *job, mw_links *links)
{
    partition_work w = {.mesh = mesh, .buckets = buckets, .job = job, .team = buckets->writers};
    mw__job_stage(job, "linking triangles", 0.3);
    pthread_mutex_init(&w.lock, NULL);
    bool done = partition_work_create(&w);
    if (done) {
        mw__team_run(w.team, partition_member_run, &w);
        done = !mw__job_stopped(job) && partition_results_gather(&w, links);
    }
    pthread_mutex_destroy(&w.lock);
    partition_work_release(&w);
    return done;
}
