/* memory.c - one allocation fails, anywhere in the making and asking of everything: the error says
 * so, nothing is left behind, and the next try succeeds. */
#include "hostile/hostile.h"
#include "support/allocations.h"
#include "support/star_shapes.h"

#include <stdlib.h>

typedef struct world {
    arrays a;
    star_shape s;
    uint64_t seed;
} world;

static mw_status try_plane(const world *w)
{
    mw_mesh *mesh = NULL, *fresh = NULL;
    mw_locator *locator = NULL;
    mw_index *index = NULL;
    mw_editor *editor = NULL;
    mw_location at[40];
    uint64_t random = w->seed;
    mw_arrays view = arrays_view(&w->a);
    double q[80];
    for (int i = 0; i < 80; i++) q[i] = 9 * random_unit(&random) - 0.5;
    mw_mesh_options alone = {.threads = 1};
    mw_locator_options filled = {.fill = MW_FILL_YES, .border = 1, .threads = 1};
    mw_query_options sorted = {.start = MW_START_SORTED, .threads = 1};
    mw_editor_options undo = {.undo = 5, .log = 1, .threads = 1};
    mw_delaunay_options one = {.threads = 1};
    mw_start_kind start = (mw_start_kind)mw__random_below(&random, MW_START_COUNT);
    mw_status status = mw_mesh_create(&view, &alone, &mesh, NULL);
    if (!status) status = mw_locator_create(mesh, &filled, &locator, NULL);
    if (!status && mw_start_has_index(start))
        status = mw_index_create(locator, start, NULL, &index, NULL);
    if (!status) status = mw_locate_batch(locator, q, 40, 2, &sorted, at, NULL, NULL);
    if (!status) status = mw_delaunay(q, 40, 2, &one, NULL, NULL, &fresh, NULL);
    if (!status) status = mw_editor_create(fresh, &undo, &editor, NULL);
    for (int i = 0; i < 6 && !status; i++)
        status = mw_edit_insert(editor, q[i] + 0.01, q[i + 1], NULL, NULL);
    for (int i = 0; i < 3 && !status; i++) status = mw_edit_undo(editor, NULL, NULL);
    mw_editor_destroy(editor);
    mw_mesh_destroy(fresh);
    mw_index_destroy(index);
    mw_locator_destroy(locator);
    mw_mesh_destroy(mesh);
    return status;
}

static mw_status try_space(const world *w)
{
    mw_surface *surface = NULL;
    mw_star *star = NULL;
    mw_star_index *index = NULL;
    mw_prober *prober = NULL;
    mw_location at[4];
    mw_arrays view = star_shape_arrays(&w->s);
    static const double ray[12] = {1, 2, 3, -1, 2, 3, 1, -2, 3, 1, 2, -3};
    mw_prober_options boxes = {.boxes = 1};
    mw_star_query_options alone = {.threads = 1};
    mw_status status = mw_surface_create(&view, NULL, &surface, NULL);
    if (!status) status = mw_star_create(surface, NULL, &star, NULL);
    if (!status) status = mw_star_index_create(star, MW_STAR_START_GRID, NULL, &index, NULL);
    if (!status) status = mw_star_locate_batch(star, ray, 4, 3, &alone, at, NULL, NULL);
    if (!status) status = mw_prober_create(surface, &boxes, &prober, NULL);
    mw_prober_destroy(prober);
    mw_star_index_destroy(index);
    mw_star_destroy(star);
    mw_surface_destroy(surface);
    return status;
}

static void fail_each(mw_status (*try_all)(const world *), const world *w)
{
    for (long k = 0;; k++) {
        allocations_left = k;
        mw_status status = try_all(w);
        bool failed = allocations_left < 0;
        allocations_left = -1;
        if (!failed && status) hostile_failed("without a failure: %s", mw_status_text(status));
        if (!failed) return;
        if (status && status != MW_ERROR_MEMORY)
            hostile_failed("allocation %ld: %s", k, mw_status_text(status));
    }
}

void hostile_memory(uint64_t *random)
{
    world w = {.a = arrays_grid(2 + mw__random_below(random, 6), 0.4, random),
               .s = star_shape_octahedron(mw__random_below(random, 3)),
               .seed = mw__random(random)};
    if (mw__random_below(random, 2)) arrays_punch(&w.a, 0.3, random);
    fail_each(try_plane, &w);
    fail_each(try_space, &w);
    star_shape_free(&w.s);
    arrays_free(&w.a);
}
