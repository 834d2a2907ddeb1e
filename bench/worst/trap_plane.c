/* trap_plane.c - meshes of the plane: queries in them, also where an editor has them. */
#include "bench/data/dataset.h"
#include "bench/worst/trap_clock.h"
#include "bench/worst/trap_entry.h"
#include "cli/frame/message.h"
#include "cli/frame/monotonic_clock.h"

#include <stdlib.h>

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
    return status ? fail_mesh(trap->name, &error) : 0;
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

int trap_in_plane(const trap_entry *trap, const trap_plan *plan, trap_figures *f)
{
    trap_scene s = {.trap = trap};
    mw_error error;
    mw_locator_options options = {.threads = 1};
    int end = trap_make_mesh(trap, plan, &s);
    double begin = monotonic_seconds();
    if (end == 0 && mw_locator_create(s.mesh, &options, &s.own, &error))
        end = fail_mesh(trap->name, &error);
    s.locator = s.own;
    if (end == 0 && trap->start && mw_index_create(s.locator, trap->start, NULL, &s.index, &error))
        end = fail_mesh(trap->name, &error);
    f->build = monotonic_seconds() - begin;
    if (end == 0) end = trap_scene_measure(&s, plan, f);
    trap_scene_release(&s);
    return end;
}

int trap_in_editor(const trap_entry *trap, const trap_plan *plan, trap_figures *f)
{
    trap_scene s = {.trap = trap};
    mw_error error;
    mw_editor_options options = {.threads = 1};
    int end = trap_make_mesh(trap, plan, &s);
    double begin = monotonic_seconds();
    if (end == 0 && mw_editor_create(s.mesh, &options, &s.editor, &error))
        end = fail_mesh(trap->name, &error);
    f->build = monotonic_seconds() - begin;
    if (end == 0) {
        s.locator = mw_editor_locator(s.editor);
        end = trap_scene_measure(&s, plan, f);
    }
    trap_scene_release(&s);
    return end;
}
