/* trap_space.c - surfaces in space: rays from the centre of a star, and certain probes. */
#include "bench/data/dataset.h"
#include "bench/worst/trap_clock.h"
#include "bench/worst/trap_entry.h"
#include "cli/frame/message.h"
#include "cli/frame/monotonic_clock.h"

#include <math.h>
#include <stdlib.h>

typedef struct trap_surface {
    mw_surface *surface;
    mw_star *star;
    mw_prober *prober;
    double *queries; /* three coordinates each; of probes six */
    mw_location *locations;
    mw_touch *touches;
} trap_surface;

static void trap_surface_release(trap_surface *s)
{
    mw_prober_destroy(s->prober);
    mw_star_destroy(s->star);
    mw_surface_destroy(s->surface);
    free(s->queries);
    free(s->locations);
    free(s->touches);
}

static int trap_make_surface(const trap_entry *trap, const double *points, size_t point_count,
                             const uint32_t *triangles, size_t count, mw_surface **surface)
{
    mw_error error;
    mw_arrays arrays = {.points = points,
                        .point_count = point_count,
                        .point_stride = 3,
                        .triangles = triangles,
                        .triangle_count = count};
    return mw_surface_create(&arrays, NULL, surface, &error) ? fail_mesh(trap->name, &error) : 0;
}

/* Two pyramids over one polygon: all its corners are joined to either top. */
static int trap_make_poles(const trap_entry *trap, size_t n, mw_surface **surface)
{
    size_t rim = n - 2;
    double *points = malloc(3 * n * sizeof *points);
    uint32_t *triangles = malloc(6 * rim * sizeof *triangles);
    int end = points && triangles ? 0 : fail_memory();
    for (size_t i = 0; i < rim && end == 0; i++) {
        double angle = 6.28318530717958647692 * (double)i / (double)rim;
        uint32_t a = (uint32_t)i, b = (uint32_t)((i + 1) % rim), top = (uint32_t)rim;
        const uint32_t v[6] = {a, b, top, b, a, top + 1};
        points[3 * i] = cos(angle);
        points[3 * i + 1] = sin(angle);
        points[3 * i + 2] = 0;
        for (int k = 0; k < 6; k++) triangles[6 * i + (size_t)k] = v[k];
    }
    for (size_t i = rim; i < n && end == 0; i++) {
        points[3 * i] = points[3 * i + 1] = 0;
        points[3 * i + 2] = i == rim ? 1 : -1;
    }
    if (end == 0) end = trap_make_surface(trap, points, n, triangles, 2 * rim, surface);
    free(points);
    free(triangles);
    return end;
}

static int trap_star_locate(void *self, size_t n, bool alone)
{
    trap_surface *s = self;
    mw_star_query_options options = {.threads = 1};
    mw_star_cursor cursor;
    mw_error error;
    if (!alone)
        return mw_star_locate_batch(s->star, s->queries, n, 3, &options, s->locations, NULL, &error)
                   ? fail_query(&error)
                   : 0;
    if (mw_star_cursor_init(s->star, &options, &cursor, &error)) return fail_query(&error);
    for (size_t i = 0; i < n; i++)
        s->locations[i] = mw_star_locate(s->star, &cursor, &s->queries[3 * i]);
    return 0;
}

int trap_of_star(const trap_entry *trap, const trap_plan *plan, trap_figures *f)
{
    trap_surface s = {0};
    mw_error error;
    uint64_t random = plan->seed;
    size_t n = plan->queries;
    int end = trap_make_poles(trap, plan->vertices, &s.surface);
    double begin = monotonic_seconds();
    if (end == 0 && mw_star_create(s.surface, NULL, &s.star, &error))
        end = fail_mesh(trap->name, &error);
    f->build = monotonic_seconds() - begin;
    s.queries = malloc(3 * n * sizeof *s.queries);
    s.locations = malloc(n * sizeof *s.locations);
    if (end == 0 && (!s.queries || !s.locations)) end = fail_memory();
    for (size_t i = 0; i < 3 * n && end == 0; i++) s.queries[i] = 2 * dataset_unit(&random) - 1;
    if (end == 0)
        end = trap_take_times(&(trap_clock){trap_star_locate, &s, n, {0}, NULL, NULL}, plan, f);
    trap_surface_release(&s);
    return end;
}

static int trap_probe(void *self, size_t n, bool alone)
{
    trap_surface *s = self;
    mw_probe_options options = {.threads = 1, .certain = 1};
    mw_probe_cursor cursor;
    mw_error error;
    if (!alone)
        return mw_probe_batch(s->prober, s->queries, n, 6, &options, s->touches, NULL, &error)
                   ? fail_query(&error)
                   : 0;
    if (mw_probe_cursor_init(s->prober, &options, &cursor, &error)) return fail_query(&error);
    for (size_t i = 0; i < n; i++)
        s->touches[i] = mw_probe(s->prober, &cursor, &s->queries[6 * i], &s->queries[6 * i + 3]);
    return 0;
}

/* Corner k of triangle i: the corners are (0, 0), (1, 0), (0, 1). */
static void trap_layer_corner(trap_layers layers, size_t i, size_t k, double p[3])
{
    if (layers == LAYERS_TURNED) k = i % 2 ? (i + 3 - k) % 3 : (i + k) % 3;
    p[0] = k == 1;
    p[1] = k == 2;
    p[2] = 1 + (layers == LAYERS_NEAR ? (double)i * 0x1p-52 : 0);
}

/* A third as many triangles as vertices, all of them at one place. */
static int trap_make_equal(const trap_entry *trap, size_t n, mw_surface **surface)
{
    size_t count = n / 3;
    double *points = malloc(9 * count * sizeof *points);
    uint32_t *triangles = malloc(3 * count * sizeof *triangles);
    int end = points && triangles ? 0 : fail_memory();
    for (size_t i = 0; i < 3 * count && end == 0; i++) {
        trap_layer_corner(trap->layers, i / 3, i % 3, &points[3 * i]);
        triangles[i] = (uint32_t)i;
    }
    if (end == 0) end = trap_make_surface(trap, points, 3 * count, triangles, count, surface);
    free(points);
    free(triangles);
    return end;
}

int trap_of_probe(const trap_entry *trap, const trap_plan *plan, trap_figures *f)
{
    trap_surface s = {0};
    mw_error error;
    uint64_t random = plan->seed;
    size_t n = plan->queries;
    mw_prober_options options = {.boxes = 1};
    int end = trap_make_equal(trap, plan->vertices, &s.surface);
    double begin = monotonic_seconds();
    if (end == 0 && mw_prober_create(s.surface, &options, &s.prober, &error))
        end = fail_mesh(trap->name, &error);
    f->build = monotonic_seconds() - begin;
    s.queries = malloc(6 * n * sizeof *s.queries);
    s.touches = malloc(n * sizeof *s.touches);
    if (end == 0 && (!s.queries || !s.touches)) end = fail_memory();
    for (size_t i = 0; i < n && end == 0; i++) {
        double *q = &s.queries[6 * i];
        for (int k = 0; k < 6; k++) q[k] = k < 3 ? 0.4 * dataset_unit(&random) : 0;
        q[5] = -1; /* against the fronts */
    }
    if (end == 0) end = trap_take_times(&(trap_clock){trap_probe, &s, n, {0}, NULL, NULL}, plan, f);
    trap_surface_release(&s);
    return end;
}
