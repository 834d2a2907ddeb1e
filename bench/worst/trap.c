/* trap.c - the list of traps, and what is measured of each kind. */
#include "bench/worst/trap.h"
#include "bench/core/rounds.h"
#include "bench/data/dataset.h"
#include "cli/frame/message.h"
#include "cli/frame/monotonic_clock.h"

#include <math.h>
#include <stdlib.h>

typedef struct trap_entry trap_entry;
typedef int trap_kind(const trap_entry *trap, const trap_plan *plan, trap_figures *figures);

/* How the triangles of a probe lie. */
typedef enum trap_layers {
    LAYERS_EQUAL,
    LAYERS_TURNED, /* one half of them faces the probe, one begins at another corner, or both */
    LAYERS_NEAR    /* one behind the other, as near as doubles can be */
} trap_layers;

struct trap_entry {
    const char *name, *help;
    trap_kind *kind;
    trap_mesh_make *make;
    trap_position position;
    mw_start_kind start;
    trap_layers layers;
};

static trap_kind trap_in_plane, trap_in_editor, trap_of_star, trap_of_probe, trap_of_delaunay,
    trap_of_segments;

static const trap_entry traps[] = {
    {"strip-30", "steps that shrink by 2^30 along a strip", trap_in_plane, trap_strip_30, 0, 0, 0},
    {"strip-300", "by 2^300", trap_in_plane, trap_strip_300, 0, 0, 0},
    {"strip-2000", "by 2^2000", trap_in_plane, trap_strip_2000, 0, 0, 0},
    {"fan", "all triangles at one vertex, far away", trap_in_plane, trap_fan, 0, 0, 0},
    {"half-fan", "half a wheel", trap_in_plane, trap_half_fan, 0, 0, 0},
    {"hubs", "a row of vertices between two hubs", trap_in_plane, trap_hubs, 0, 0, 0},
    {"rings", "squares round one another", trap_in_plane, trap_rings, 0, 0, 0},
    {"extent-1e-150", "uniform points, multiplied", trap_in_plane, trap_tiny, 0, 0, 0},
    {"extent-1e-290", "the same", trap_in_plane, trap_tinier, 0, 0, 0},
    {"extent-1e250", "the same", trap_in_plane, trap_huge, 0, 0, 0},
    {"vertices", "uniform points, queries at them", trap_in_plane, trap_uniform, TRAP_ON_VERTICES,
     0, 0},
    {"edges", "at rounded middles of edges", trap_in_plane, trap_uniform, TRAP_ON_EDGES, 0, 0},
    {"clusters-grid", "clusters, queries at their points, start grid", trap_in_plane, trap_clusters,
     TRAP_ON_VERTICES, MW_START_GRID, 0},
    {"few-cluster", "one point in 100 in a tiny disc, queries there", trap_in_plane,
     trap_few_cluster, 0, 0, 0},
    {"few-graded", "in two rows that shrink by 2^36, queries there", trap_in_plane, trap_few_graded,
     0, 0, 0},
    {"few-comb", "in two rows of equal steps, queries there", trap_in_plane, trap_few_comb, 0, 0,
     0},
    {"few-wheel", "round one point, queries there", trap_in_plane, trap_few_wheel, 0, 0, 0},
    {"few-wheels", "round eight points, queries there", trap_in_plane, trap_few_wheels, 0, 0, 0},
    {"pole", "a star-shaped polyhedron with two poles", trap_of_star, NULL, 0, 0, 0},
    {"editor-hub", "queries on the hub of an edited wheel", trap_in_editor, trap_half_fan, 0, 0, 0},
    {"equal-probe", "a certain probe of equal triangles", trap_of_probe, NULL, 0, 0, LAYERS_EQUAL},
    {"turned-probe", "the same, turned in six ways", trap_of_probe, NULL, 0, 0, LAYERS_TURNED},
    {"near-probe", "the same, one ulp apart", trap_of_probe, NULL, 0, 0, LAYERS_NEAR},
    {"delaunay-1e-300", "triangulating uniform points, multiplied", trap_of_delaunay, trap_least, 0,
     0, 0},
    {"delaunay-5e-324", "multiples of the least double", trap_of_delaunay, trap_denormal, 0, 0, 0},
    {"delaunay-circle", "rounded points of a circle", trap_of_delaunay, trap_circle, 0, 0, 0},
    {"overlapping", "constraints along one line", trap_of_segments, NULL, 0, 0, 0},
};
enum { TRAPS = sizeof traps / sizeof *traps };

const char *trap_name(int trap)
{
    return trap >= 0 && trap < TRAPS ? traps[trap].name : NULL;
}

const char *trap_help(int trap)
{
    return trap >= 0 && trap < TRAPS ? traps[trap].help : NULL;
}

static int trap_fail(const trap_entry *trap, const mw_error *error)
{
    return fail_mesh(trap->name, error);
}

/* --- the clock -------------------------------------------------------------------------------- */

/* Answer n queries, either way. Returns an exit code. */
typedef int trap_answer(void *self, size_t n, bool alone);

/* The ways to answer that are timed; after these two, one for each peer. */
enum { TRAP_BATCH, TRAP_ALONE, TRAP_PEERS, TRAP_MOST = TRAP_PEERS + ENGINES };

typedef struct trap_clock {
    trap_answer *answer;
    void *self;
    size_t queries;          /* that there are */
    size_t count[TRAP_MOST]; /* that each way answers */
    trap_peers *peers;       /* NULL: none */
    const double *points;    /* their queries */
} trap_clock;

static int trap_clock_ask(trap_clock *c, size_t way, size_t n, double *seconds)
{
    if (way >= TRAP_PEERS)
        return trap_peers_locate(c->peers, way - TRAP_PEERS, c->points, n, seconds);
    double begin = monotonic_seconds();
    int end = c->answer(c->self, n, way == TRAP_ALONE);
    *seconds = monotonic_seconds() - begin;
    return end;
}

static int trap_clock_run(void *self, size_t way, size_t round, double *figures)
{
    trap_clock *c = self;
    (void)round;
    int end = trap_clock_ask(c, way, c->count[way], figures);
    figures[0] *= 1e6 / (double)c->count[way];
    return end;
}

/* As many queries as take about a tenth of a second, so that a slow trap ends. */
static int trap_clock_choose(trap_clock *c, size_t way)
{
    static const double LONG = 0.1;
    double seconds;
    for (size_t n = 16;; n *= 4) {
        c->count[way] = n < c->queries ? n : c->queries;
        int end = trap_clock_ask(c, way, c->count[way], &seconds);
        if (end || n >= c->queries || seconds > LONG / 4) return end;
    }
}

static int trap_take_times(trap_clock *c, const trap_plan *plan, trap_figures *f)
{
    rounds_results results = {0};
    const size_t peers = c->peers ? c->peers->count : 0;
    rounds_plan rounds = {.entries = TRAP_PEERS + peers, .figures = 1, .rounds = plan->rounds};
    int end = 0;
    for (size_t way = 0; way < rounds.entries && end == 0; way++) end = trap_clock_choose(c, way);
    if (end == 0) end = rounds_measure(&rounds, trap_clock_run, c, &results);
    if (end == 0) {
        f->batch = rounds_median(&results, TRAP_BATCH, 0);
        f->alone = rounds_median(&results, TRAP_ALONE, 0);
    }
    for (size_t k = 0; k < peers && end == 0; k++)
        f->peers[c->peers->peers[k].id].query = rounds_median(&results, TRAP_PEERS + k, 0);
    rounds_release(&results);
    return end;
}

/* --- meshes of the plane ---------------------------------------------------------------------- */

typedef struct trap_scene {
    const trap_entry *trap;
    mw_mesh *mesh;
    size_t first_few; /* as of the trap_mesh */
    mw_editor *editor;
    const mw_locator *locator;
    mw_locator *own; /* NULL with an editor */
    mw_index *index;
    double *queries;
    mw_location *locations;
    trap_peers peers;
} trap_scene;

static void trap_scene_release(trap_scene *s)
{
    mw_index_destroy(s->index);
    mw_locator_destroy(s->own);
    mw_editor_destroy(s->editor);
    mw_mesh_destroy(s->mesh);
    trap_peers_release(&s->peers);
    free(s->queries);
    free(s->locations);
}

static int trap_make_mesh(const trap_entry *trap, const trap_plan *plan, trap_scene *s)
{
    mw_mesh **mesh = &s->mesh;
    mw_error error;
    trap_mesh m;
    if (!trap->make(&m, plan->vertices, plan->seed)) {
        trap_mesh_release(&m);
        return fail_memory();
    }
    s->first_few = m.first_few;
    mw_arrays arrays = {.points = m.points,
                        .point_count = m.point_count,
                        .triangles = m.triangles,
                        .triangle_count = m.triangle_count};
    mw_mesh_options options = {.threads = 1};
    mw_delaunay_options delaunay = {.threads = 1};
    mw_status status =
        m.triangles ? mw_mesh_create(&arrays, &options, mesh, &error)
                    : mw_delaunay(m.points, m.point_count, 2, &delaunay, NULL, NULL, mesh, &error);
    trap_mesh_release(&m);
    return status ? trap_fail(trap, &error) : 0;
}

static int trap_scene_locate(void *self, size_t n, bool alone)
{
    trap_scene *s = self;
    mw_query_options options = {.threads = 1, .index = s->index};
    mw_cursor cursor;
    mw_error error;
    if (!alone)
        return mw_locate_batch(s->locator, s->queries, n, 2, &options, s->locations, NULL, &error)
                   ? fail_query(&error)
                   : 0;
    if (mw_cursor_init(s->locator, &options, &cursor, &error)) return fail_query(&error);
    for (size_t i = 0; i < n; i++)
        s->locations[i] = mw_locate(s->locator, &cursor, s->queries[2 * i], s->queries[2 * i + 1]);
    return 0;
}

static int trap_scene_count(trap_scene *s, size_t n, double *steps)
{
    enum { ENOUGH = 2000 };
    mw_error error;
    mw_counters c;
    mw_query_options options = {.threads = 1, .counters = 1, .index = s->index};
    if (n > ENOUGH) n = ENOUGH;
    if (mw_locate_batch(s->locator, s->queries, n, 2, &options, s->locations, &c, &error))
        return fail_query(&error);
    *steps = (double)(c.triangles_visited + c.orient_init + c.comparisons) / (double)n;
    return 0;
}

/* If there are peers: the queries once more by this library, and by each peer those that it was
 * timed with. */
static int trap_scene_judge(trap_scene *s, const trap_clock *clock, trap_figures *f)
{
    if (s->peers.count == 0) return 0;
    int end = trap_scene_locate(s, clock->count[TRAP_BATCH], false);
    for (size_t k = 0; k < s->peers.count && end == 0; k++) {
        size_t n = clock->count[TRAP_PEERS + k];
        if (n > clock->count[TRAP_BATCH]) n = clock->count[TRAP_BATCH];
        f->peers[s->peers.peers[k].id].wrong =
            trap_peers_wrong(&s->peers, k, s->queries, n, s->locations);
    }
    return end;
}

static int trap_scene_measure(trap_scene *s, const trap_plan *plan, trap_figures *f)
{
    mw_locator_info info;
    size_t n = plan->queries;
    s->queries = malloc(2 * n * sizeof *s->queries);
    s->locations = malloc(n * sizeof *s->locations);
    if (!s->queries || !s->locations) return fail_memory();
    if (!trap_draw(s->mesh, s->first_few, s->trap->position, s->queries, n, plan->seed))
        return fail_memory();
    for (size_t i = 0; i < 2 * n && s->editor; i++) s->queries[i] = 0; /* where the hub is */
    mw_locator_describe(s->locator, &info);
    f->bytes = (double)info.bytes;
    trap_clock clock = {trap_scene_locate, s, n, {0}, &s->peers, s->queries};
    int end = s->editor ? 0 : trap_peers_build(&s->peers, plan->engines, s->mesh, n, f->peers);
    if (end == 0) end = trap_take_times(&clock, plan, f);
    if (end == 0) end = trap_scene_judge(s, &clock, f);
    return end ? end : trap_scene_count(s, clock.count[TRAP_BATCH], &f->steps);
}

static int trap_in_plane(const trap_entry *trap, const trap_plan *plan, trap_figures *f)
{
    trap_scene s = {.trap = trap};
    mw_error error;
    mw_locator_options options = {.threads = 1};
    int end = trap_make_mesh(trap, plan, &s);
    double begin = monotonic_seconds();
    if (end == 0 && mw_locator_create(s.mesh, &options, &s.own, &error))
        end = trap_fail(trap, &error);
    s.locator = s.own;
    if (end == 0 && trap->start && mw_index_create(s.locator, trap->start, NULL, &s.index, &error))
        end = trap_fail(trap, &error);
    f->build = monotonic_seconds() - begin;
    if (end == 0) end = trap_scene_measure(&s, plan, f);
    trap_scene_release(&s);
    return end;
}

static int trap_in_editor(const trap_entry *trap, const trap_plan *plan, trap_figures *f)
{
    trap_scene s = {.trap = trap};
    mw_error error;
    mw_editor_options options = {.threads = 1};
    int end = trap_make_mesh(trap, plan, &s);
    double begin = monotonic_seconds();
    if (end == 0 && mw_editor_create(s.mesh, &options, &s.editor, &error))
        end = trap_fail(trap, &error);
    f->build = monotonic_seconds() - begin;
    if (end == 0) {
        s.locator = mw_editor_locator(s.editor);
        end = trap_scene_measure(&s, plan, f);
    }
    trap_scene_release(&s);
    return end;
}

/* --- space ------------------------------------------------------------------------------------ */

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
    return mw_surface_create(&arrays, NULL, surface, &error) ? trap_fail(trap, &error) : 0;
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

static int trap_of_star(const trap_entry *trap, const trap_plan *plan, trap_figures *f)
{
    trap_surface s = {0};
    mw_error error;
    uint64_t random = plan->seed;
    size_t n = plan->queries;
    int end = trap_make_poles(trap, plan->vertices, &s.surface);
    double begin = monotonic_seconds();
    if (end == 0 && mw_star_create(s.surface, NULL, &s.star, &error)) end = trap_fail(trap, &error);
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

static int trap_of_probe(const trap_entry *trap, const trap_plan *plan, trap_figures *f)
{
    trap_surface s = {0};
    mw_error error;
    uint64_t random = plan->seed;
    size_t n = plan->queries;
    mw_prober_options options = {.boxes = 1};
    int end = trap_make_equal(trap, plan->vertices, &s.surface);
    double begin = monotonic_seconds();
    if (end == 0 && mw_prober_create(s.surface, &options, &s.prober, &error))
        end = trap_fail(trap, &error);
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

/* --- constructions ---------------------------------------------------------------------------- */

static int trap_of_delaunay(const trap_entry *trap, const trap_plan *plan, trap_figures *f)
{
    mw_mesh *mesh = NULL;
    mw_error error;
    trap_mesh m;
    mw_delaunay_options options = {.threads = 1};
    int end = trap->make(&m, plan->vertices, plan->seed) ? 0 : fail_memory();
    double begin = monotonic_seconds();
    if (end == 0 && mw_delaunay(m.points, m.point_count, 2, &options, NULL, NULL, &mesh, &error))
        end = trap_fail(trap, &error);
    f->build = monotonic_seconds() - begin;
    if (end == 0) trap_peers_triangulate(plan->engines, m.points, m.point_count, f->peers);
    mw_mesh_destroy(mesh);
    trap_mesh_release(&m);
    return end;
}

/* Segments of random lengths along the x axis, a point above and one below. */
static int trap_of_segments(const trap_entry *trap, const trap_plan *plan, trap_figures *f)
{
    size_t n = plan->vertices / 2, count = 2 * n + 2;
    uint64_t random = plan->seed;
    mw_error error;
    mw_mesh *mesh = NULL;
    double *points = malloc(2 * count * sizeof *points);
    uint32_t *segments = malloc(2 * n * sizeof *segments);
    int end = points && segments ? 0 : fail_memory();
    for (size_t i = 0; i < 2 * n && end == 0; i++) {
        points[2 * i] = dataset_unit(&random);
        points[2 * i + 1] = 0;
        segments[i] = (uint32_t)i;
    }
    if (end == 0) {
        const double ends[4] = {0.5, 1, 0.5, -1};
        for (size_t k = 0; k < 4; k++) points[4 * n + k] = ends[k];
        mw_constraints constraints = {
            .points = points, .point_count = count, .segments = segments, .segment_count = n};
        mw_constrain_options options = {.threads = 1};
        double begin = monotonic_seconds();
        if (mw_constrained_delaunay(&constraints, &options, NULL, NULL, NULL, &mesh, &error))
            end = trap_fail(trap, &error);
        f->build = monotonic_seconds() - begin;
    }
    mw_mesh_destroy(mesh);
    free(points);
    free(segments);
    return end;
}

int trap_measure(int trap, const trap_plan *plan, trap_figures *figures)
{
    *figures = (trap_figures){.build = NAN, .batch = NAN, .alone = NAN, .steps = NAN, .bytes = NAN};
    for (size_t i = 0; i < ENGINES; i++) figures->peers[i] = (trap_peer_figures){NAN, NAN, NAN};
    return traps[trap].kind(&traps[trap], plan, figures);
}
