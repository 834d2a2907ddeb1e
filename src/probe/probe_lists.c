/* probe_lists.c - many probes that ask for all triangles they touch, or whether they touch any.
 *
 * Chunks for the threads; in a chunk, searches of a group take turns. The touches of a chunk lie in
 * an array of its own. When all are known, each goes to its place. */
#include "base/job.h"
#include "base/posix.h"
#include "probe/ray.h"

#include <stdlib.h>
#include <string.h>

enum { CHUNK = 1 << 10 }; /* probes that one thread takes at a time */

/* The touches of the probes of one chunk. */
typedef struct lists_chunk {
    mw_touch *touch;
    size_t count, room, bad;
} lists_chunk;

typedef struct probe_lists {
    const mw_prober *prober;
    const double *queries;
    size_t n, stride;
    mw_probe_cursor cursor; /* at the start of each chunk */
    uint8_t *states;        /* any: the answers */
    lists_chunk *chunk;     /* all: [chunk] */
    size_t *offset;         /* all: at i + 1 the number of touches of probe i, later their end */
    mw_touch *touch;
    atomic_bool no_memory;
    pthread_mutex_t lock;
    mw_probe_counters sum; /* of the chunks that are done */
} probe_lists;

/* Searches of a few probes that take turns. What they find stays in them until all have ended. */
typedef struct lists_group {
    const probe_lists *lists;
    mw_ray_found *found;
    size_t first;
    uint32_t n, next, guess;
    mw_ray_query ray[MW_RAYS_AT_A_TIME];
    mw_ray_search search[MW_RAYS_AT_A_TIME];
    mw_hit_list list[MW_RAYS_AT_A_TIME];
    bool good[MW_RAYS_AT_A_TIME]; /* was there a search? */
} lists_group;

static mw_ray_search *lists_group_next(void *self, mw_ray_search *ended)
{
    lists_group *g = self;
    const probe_lists *b = g->lists;
    uint32_t i = g->next;
    (void)ended;
    if (i == g->n) return NULL;
    const double *q = b->queries + (g->first + i) * b->stride;
    mw_ray_search *search = &g->search[g->next++];
    mw__ray_search_none(search);
    g->list[i].count = 0;
    g->good[i] =
        mw__prober_is_current(b->prober) && mw__probe_ray(&b->cursor.options, q, q + 3, &g->ray[i]);
    if (!g->good[i]) return search;
    mw__ray_search_begin(search, b->prober, &g->ray[i], g->found, &g->list[i]);
    if (g->guess < b->prober->surface->tri_count) mw__ray_search_guess(search, g->guess);
    return search;
}

/* Run the searches of the probes `first` .. first + n - 1; any of them begins with triangle
 * `guess`, unless that is MW_NONE. */
static void lists_group_run(lists_group *g, const probe_lists *b, mw_ray_found *found, size_t first,
                            uint32_t n, uint32_t guess)
{
    mw_ray_source source = {lists_group_next, g};
    g->lists = b;
    g->found = found;
    g->first = first;
    g->n = n;
    g->next = 0;
    g->guess = guess;
    mw__ray_searches_run(b->prober, &source);
}

static void lists_group_count(const lists_group *g, uint32_t n, mw_probe_counters *sum)
{
    for (uint32_t i = 0; i < n; i++) {
        mw_probe_counters work = {0};
        if (g->good[i]) mw__ray_search_count(&g->search[i], &work);
        mw__probe_count(sum, &work, g->good[i] && g->search[i].hits > 0);
    }
}

static void lists_add_counters(probe_lists *b, const mw_probe_counters *more)
{
    pthread_mutex_lock(&b->lock);
    mw_probe_counters_add(&b->sum, more);
    pthread_mutex_unlock(&b->lock);
}

static size_t lists_chunk_end(const probe_lists *b, size_t first)
{
    return b->n - first < CHUNK ? b->n : first + CHUNK;
}

static uint32_t lists_group_size(size_t first, size_t end)
{
    return (uint32_t)(end - first < MW_RAYS_AT_A_TIME ? end - first : MW_RAYS_AT_A_TIME);
}

/* --- any --- */

/* The touched triangle of a group is the next one's guess. */
static void lists_answer_any(void *work, uint64_t number, uint32_t member)
{
    probe_lists *b = work;
    mw_probe_counters sum = {0};
    uint32_t last = MW_NONE;
    size_t first = (size_t)number * CHUNK, end = lists_chunk_end(b, first);
    lists_group g = {0};
    (void)member;
    for (size_t at = first; at < end; at += MW_RAYS_AT_A_TIME) {
        uint32_t n = lists_group_size(at, end);
        mw__surface_read_lock(b->prober->surface);
        lists_group_run(&g, b, mw__ray_found_any, at, n, last);
        mw__surface_read_unlock(b->prober->surface);
        for (uint32_t i = 0; i < n; i++) {
            bool hit = g.good[i] && g.search[i].hits > 0;
            b->states[at + i] = (uint8_t)(hit         ? MW_TOUCH_HIT
                                          : g.good[i] ? MW_TOUCH_NONE
                                                      : MW_TOUCH_BAD);
            if (hit) last = g.search[i].nearest;
        }
        if (b->cursor.options.counters) lists_group_count(&g, n, &sum);
    }
    lists_add_counters(b, &sum);
}

/* --- all --- */

static bool lists_chunk_append(lists_chunk *chunk, const mw_hit_list *list)
{
    if (list->count == 0) return true;
    if (chunk->count + list->count > chunk->room) {
        size_t room = 2 * chunk->room + list->count + CHUNK;
        mw_touch *touch = mw__realloc(chunk->touch, room, sizeof *touch);
        if (!touch) return false;
        chunk->touch = touch;
        chunk->room = room;
    }
    memcpy(chunk->touch + chunk->count, list->touches, list->count * sizeof *list->touches);
    chunk->count += list->count;
    return true;
}

/* Complete the lists of a group, under the lock of the surface. Returns false when out of memory.
 */
static bool lists_group_finish(lists_group *g, const probe_lists *b, uint32_t n)
{
    bool enough = true;
    for (uint32_t i = 0; i < n; i++) {
        enough = enough && !g->list[i].no_memory;
        if (!g->good[i] || !enough) continue;
        mw__hit_list_sort(&g->search[i]);
        if (b->cursor.options.one_per_place) mw__hit_list_keep_places(&g->search[i]);
        mw__hit_list_complete(&g->search[i]);
    }
    return enough;
}

/* Answer the probes first .. first + n - 1. Returns false when out of memory. */
static bool lists_answer_group(lists_group *g, probe_lists *b, lists_chunk *chunk, size_t first,
                               uint32_t n)
{
    mw__surface_read_lock(b->prober->surface);
    lists_group_run(g, b, mw__hit_list_found, first, n, MW_NONE);
    bool enough = lists_group_finish(g, b, n);
    mw__surface_read_unlock(b->prober->surface);
    for (uint32_t i = 0; enough && i < n; i++) {
        chunk->bad += !g->good[i];
        b->offset[first + i + 1] = g->list[i].count;
        enough = lists_chunk_append(chunk, &g->list[i]);
    }
    return enough;
}

static void lists_answer_all(void *work, uint64_t number, uint32_t member)
{
    probe_lists *b = work;
    mw_probe_counters sum = {0};
    size_t first = (size_t)number * CHUNK, end = lists_chunk_end(b, first);
    lists_group g = {0};
    (void)member;
    for (uint32_t i = 0; i < MW_RAYS_AT_A_TIME; i++) g.list[i].grows = true;
    for (size_t at = first; at < end && !atomic_load_explicit(&b->no_memory, memory_order_relaxed);
         at += MW_RAYS_AT_A_TIME) {
        uint32_t n = lists_group_size(at, end);
        if (!lists_answer_group(&g, b, &b->chunk[number], at, n))
            atomic_store_explicit(&b->no_memory, true, memory_order_relaxed);
        else if (b->cursor.options.counters)
            lists_group_count(&g, n, &sum);
    }
    for (uint32_t i = 0; i < MW_RAYS_AT_A_TIME; i++) free(g.list[i].touches);
    lists_add_counters(b, &sum);
}

/* The touches of a chunk go to their place. */
static void lists_collect_chunk(void *work, uint64_t number, uint32_t member)
{
    probe_lists *b = work;
    lists_chunk *chunk = &b->chunk[number];
    (void)member;
    if (chunk->count)
        memcpy(b->touch + b->offset[(size_t)number * CHUNK], chunk->touch,
               chunk->count * sizeof *chunk->touch);
    free(chunk->touch);
    chunk->touch = NULL;
}

static mw_status lists_run(probe_lists *b, mw_job *job, size_t *bad, mw_error *error)
{
    uint64_t chunks = b->n / CHUNK + (b->n % CHUNK != 0);
    uint32_t team = mw__job_team(job, chunks);
    mw__job_stage(job, "answering queries", 0.9);
    if (!mw__job_chunks(job, team, chunks, lists_answer_all, b) || b->no_memory)
        return mw__fail_memory(error);
    for (size_t i = 0; i < b->n; i++) b->offset[i + 1] += b->offset[i];
    for (uint64_t i = 0; i < chunks; i++) *bad += b->chunk[i].bad;
    b->touch = mw__alloc(b->offset[b->n], sizeof *b->touch);
    if (!b->touch) return mw__fail_memory(error);
    mw__job_stage(job, "collecting touches", 0.1);
    if (!mw__job_chunks(job, team, chunks, lists_collect_chunk, b)) return mw__fail_memory(error);
    return MW_OK;
}

static mw_status lists_make(probe_lists *b, mw_job *job, size_t *bad, mw_error *error)
{
    size_t chunks = b->n / CHUNK + (b->n % CHUNK != 0);
    b->chunk = mw__calloc(chunks, sizeof *b->chunk);
    b->offset = mw__calloc(b->n + 1, sizeof *b->offset);
    mw_status status =
        b->chunk && b->offset ? lists_run(b, job, bad, error) : mw__fail_memory(error);
    for (size_t i = 0; b->chunk && i < chunks; i++) free(b->chunk[i].touch);
    free(b->chunk);
    return mw__job_end(job, status, error);
}

/* --- calls --- */

static mw_status lists_begin(probe_lists *b, const mw_probe_options *options, const void *results,
                             mw_error *error)
{
    mw_status status = mw_probe_cursor_init(b->prober, options, &b->cursor, error);
    if (status) return status;
    if (!b->prober->has_bvh)
        return mw__fail(error, MW_ERROR_ARGUMENT,
                        "all touches, or whether there is one, need a prober with options.boxes");
    if ((b->n && !b->queries) || !results)
        return mw__fail(error, MW_ERROR_ARGUMENT, "queries or results are NULL");
    if (b->stride == 0) b->stride = 6;
    if (b->stride < 6)
        return mw__fail(error, MW_ERROR_ARGUMENT,
                        "the stride must be at least 6 (point and motion)");
    return MW_OK;
}

mw_status mw_probe_any_batch(const mw_prober *prober, const double *queries, size_t n,
                             size_t stride, const mw_probe_options *options, uint8_t *states,
                             mw_probe_counters *counters, mw_error *error)
{
    probe_lists b = {
        .prober = prober, .queries = queries, .n = n, .stride = stride, .states = states};
    mw_status status = lists_begin(&b, options, n ? (const void *)states : &b, error);
    if (status) return status;
    uint64_t chunks = n / CHUNK + (n % CHUNK != 0);
    mw_job job = mw__job(b.cursor.options.threads, b.cursor.options.progress);
    mw__job_stage(&job, "answering queries", 1);
    pthread_mutex_init(&b.lock, NULL);
    mw__job_chunks(&job, mw__job_team(&job, chunks), chunks, lists_answer_any, &b);
    pthread_mutex_destroy(&b.lock);
    if (counters) *counters = b.sum;
    return mw__job_end(&job, MW_OK, error);
}

mw_status mw_probe_all_batch(const mw_prober *prober, const double *queries, size_t n,
                             size_t stride, const mw_probe_options *options, mw_touch_lists *lists,
                             mw_probe_counters *counters, mw_error *error)
{
    probe_lists b = {.prober = prober, .queries = queries, .n = n, .stride = stride};
    size_t bad = 0;
    if (lists) *lists = (mw_touch_lists){0};
    mw_status status = lists_begin(&b, options, lists, error);
    if (status) return status;
    mw_job job = mw__job(b.cursor.options.threads, b.cursor.options.progress);
    pthread_mutex_init(&b.lock, NULL);
    status = lists_make(&b, &job, &bad, error);
    pthread_mutex_destroy(&b.lock);
    if (status) {
        free(b.touch);
        free(b.offset);
        return status;
    }
    if (counters) *counters = b.sum;
    *lists = (mw_touch_lists){.offset = b.offset,
                              .touch = b.touch,
                              .probe_count = n,
                              .touch_count = b.offset[n],
                              .bad_count = bad};
    return MW_OK;
}

void mw_touch_lists_release(mw_touch_lists *lists)
{
    if (!lists) return;
    free(lists->offset);
    free(lists->touch);
    *lists = (mw_touch_lists){0};
}
