/* Our engines of 'bench edit'. */
#include "bench/edits/edit_engine.h"
#include "bench/edits/triangle_hash.h"
#include "cli/frame/monotonic_clock.h"

#include <meshwalk/meshwalk.h>

#include <stdlib.h>
#include <string.h>

typedef struct meshwalk_editing {
    mw_editor *editor;
    mw_cursor cursor;
    uint32_t *vertex; /* the editor's number of each vertex of the script */
} meshwalk_editing;

static void meshwalk_editing_destroy(void *self)
{
    meshwalk_editing *o = self;
    if (!o) return;
    mw_editor_destroy(o->editor);
    free(o->vertex);
    free(o);
}

static bool meshwalk_editing_make(meshwalk_editing *o, const edit_script *s, mw_start_kind start)
{
    mw_mesh *mesh;
    mw_query_options options = {0};
    /* others would still be spinning when the clock runs */
    mw_delaunay_options one_thread = {.threads = 1};
    mw_editor_options alone = {.threads = 1};
    if (mw_delaunay(s->points, s->point_count, 2, &one_thread, NULL, NULL, &mesh, NULL) != MW_OK)
        return false;
    bool made = mw_editor_create(mesh, &alone, &o->editor, NULL) == MW_OK;
    mw_mesh_destroy(mesh);
    o->vertex = malloc((s->point_count + s->inserted) * sizeof *o->vertex);
    if (!made || !o->vertex) return false;
    if (start != MW_START_AUTO &&
        mw_editor_index(o->editor, start, NULL, &options.index, NULL) != MW_OK)
        return false;
    for (size_t i = 0; i < s->point_count; i++) o->vertex[i] = (uint32_t)i;
    return mw_cursor_init(mw_editor_locator(o->editor), &options, &o->cursor, NULL) == MW_OK;
}

static void *meshwalk_editing_build(const edit_script *s, mw_start_kind start)
{
    meshwalk_editing *o = calloc(1, sizeof *o);
    if (o && meshwalk_editing_make(o, s, start)) return o;
    meshwalk_editing_destroy(o);
    return NULL;
}

static void *meshwalk_editing_build_auto(const edit_script *s)
{
    return meshwalk_editing_build(s, MW_START_AUTO);
}
static void *meshwalk_editing_build_layers(const edit_script *s)
{
    return meshwalk_editing_build(s, MW_START_LAYERS);
}
static void *meshwalk_editing_build_grid(const edit_script *s)
{
    return meshwalk_editing_build(s, MW_START_GRID);
}

static void triangle_corners(const mw_editor *editor, uint32_t triangle, double corners[6])
{
    uint32_t v[3];
    memset(corners, 0, 6 * sizeof *corners);
    if (!mw_editor_triangle(editor, triangle, v)) return;
    for (int k = 0; k < 3; k++) mw_editor_vertex(editor, v[k], corners + 2 * k);
}

/* Points lie in the steps as far apart as these. */
static mw_status meshwalk_insert_points(meshwalk_editing *o, const edit_script *s)
{
    _Static_assert(sizeof(edit_step) % sizeof(double) == 0, "steps are some doubles apart");
    return mw_edit_insert_points(o->editor, s->steps->point, s->count,
                                 sizeof(edit_step) / sizeof(double), NULL, NULL, NULL);
}

/* Nothing is asked about what changed, as CGAL tells nothing: the number of a new vertex is the
 * next one. */
static double meshwalk_editing_run(void *self, const edit_script *s, double *corners)
{
    meshwalk_editing *o = self;
    mw_status status = MW_OK;
    uint32_t inserted = (uint32_t)s->point_count;
    const mw_locator *locator = mw_editor_locator(o->editor);
    double clock = monotonic_seconds();
    if (s->at_once) {
        status = meshwalk_insert_points(o, s);
        return status == MW_OK ? monotonic_seconds() - clock : EDIT_ENGINE_FAILED;
    }
    for (const edit_step *step = s->steps; step < s->steps + s->count && status == MW_OK; step++) {
        const double *p = step->point;
        switch (step->kind) {
        case EDIT_STEP_INSERT:
            status = mw_edit_insert(o->editor, p[0], p[1], NULL, NULL);
            o->vertex[inserted] = inserted;
            inserted++;
            break;
        case EDIT_STEP_REMOVE:
            status = mw_edit_remove(o->editor, o->vertex[step->vertex], NULL, NULL);
            break;
        case EDIT_STEP_MOVE:
            status = mw_edit_move(o->editor, o->vertex[step->vertex], p[0], p[1], NULL, NULL);
            break;
        case EDIT_STEP_LOCATE:
            triangle_corners(o->editor, mw_locate(locator, &o->cursor, p[0], p[1]).triangle,
                             corners);
            corners += 6;
            break;
        }
    }
    return status == MW_OK ? monotonic_seconds() - clock : EDIT_ENGINE_FAILED;
}

static uint64_t meshwalk_editing_hash(const void *self)
{
    const meshwalk_editing *o = self;
    mw_editor_info info;
    uint64_t hash = 0;
    uint32_t v[3];
    double corners[6];
    mw_editor_describe(o->editor, &info);
    for (uint32_t t = 0; t < info.triangle_range; t++) {
        if (!mw_editor_triangle(o->editor, t, v)) continue;
        triangle_corners(o->editor, t, corners);
        hash += triangle_hash(corners);
    }
    return hash;
}

const edit_engine_code *edit_engine_meshwalk_code(edit_engine_id id)
{
    static const edit_engine_code codes[] = {
        [EDIT_ENGINE_MESHWALK] = {meshwalk_editing_build_auto, meshwalk_editing_run,
                                  meshwalk_editing_hash, meshwalk_editing_destroy},
        [EDIT_ENGINE_MESHWALK_LAYERS] = {meshwalk_editing_build_layers, meshwalk_editing_run,
                                         meshwalk_editing_hash, meshwalk_editing_destroy},
        [EDIT_ENGINE_MESHWALK_GRID] = {meshwalk_editing_build_grid, meshwalk_editing_run,
                                       meshwalk_editing_hash, meshwalk_editing_destroy},
    };
    return id <= EDIT_ENGINE_MESHWALK_GRID ? &codes[id] : NULL;
}
