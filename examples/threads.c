/* threads.c - one mesh, one locator, a cursor for each thread: no locks. */
#include <meshwalk/meshwalk.h>
#include <pthread.h>
#include <stdio.h>
#include <stdlib.h>

enum { THREADS = 4, QUERIES = 20000, POINTS = 2000 };

typedef struct job {
    const mw_locator *locator;
    const double *queries;
    uint32_t *triangle;
    uint64_t seed;
} job;

static double uniform(uint64_t *state)
{
    *state = *state * UINT64_C(6364136223846793005) + UINT64_C(1442695040888963407);
    return (double)(*state >> 11) * 0x1p-53;
}

/* Each thread answers all queries, with its own random choices of first triangles. */
static void *work(void *argument)
{
    const job *j = argument;
    mw_query_options options = {.start = MW_START_SAMPLE, .seed = j->seed};
    mw_cursor cursor;
    if (mw_cursor_init(j->locator, &options, &cursor, NULL)) return "failed";
    for (size_t i = 0; i < QUERIES; i++)
        j->triangle[i] =
            mw_locate(j->locator, &cursor, j->queries[2 * i], j->queries[2 * i + 1]).triangle;
    return NULL;
}

/* The number of threads that failed, or whose answers differ from those of the first. */
static int race(const mw_locator *locator, const double *queries, uint32_t *triangle)
{
    pthread_t thread[THREADS];
    job jobs[THREADS];
    int wrong = 0;
    int started = 0;
    for (; started < THREADS; started++) {
        jobs[started] =
            (job){locator, queries, triangle + (size_t)started * QUERIES, (uint64_t)started};
        if (pthread_create(&thread[started], NULL, work, &jobs[started])) break;
    }
    for (int t = 0; t < started; t++) {
        void *failure;
        pthread_join(thread[t], &failure);
        for (size_t i = 0; !failure && i < QUERIES; i++) {
            if (triangle[(size_t)t * QUERIES + i] != triangle[i]) failure = "different";
        }
        wrong += failure != NULL;
    }
    return wrong + THREADS - started;
}

int main(void)
{
    double *points = malloc(2 * POINTS * sizeof *points),
           *queries = malloc(2 * QUERIES * sizeof *queries);
    uint32_t *triangle = malloc(sizeof *triangle * THREADS * QUERIES);
    mw_error error = {.message = "out of memory"};
    mw_mesh *mesh = NULL;
    mw_locator *locator = NULL;
    int wrong = THREADS;
    if (points && queries && triangle) {
        uint64_t state = 1;
        for (size_t i = 0; i < 2 * POINTS; i++) points[i] = uniform(&state);
        for (size_t i = 0; i < 2 * QUERIES; i++) queries[i] = uniform(&state);
        if (mw_delaunay(points, POINTS, 2, NULL, NULL, NULL, &mesh, &error) == MW_OK &&
            mw_locator_create(mesh, NULL, &locator, &error) == MW_OK)
            wrong = race(locator, queries, triangle);
    }
    if (locator)
        printf("%d threads, %d different answers\n", THREADS, wrong);
    else
        fprintf(stderr, "%s\n", error.message);
    mw_locator_destroy(locator);
    mw_mesh_destroy(mesh);
    free(triangle);
    free(queries);
    free(points);
    return wrong != 0;
}
