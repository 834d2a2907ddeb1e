/* Our editors. */
#include "bench/edits/editings.h"
#include "cli/frame/monotonic_clock.h"

#include <meshwalk/meshwalk.h>

#include <stdlib.h>
#include <string.h>

typedef struct own {
    mw_editor *editor;
    mw_cursor cursor;
    uint32_t *vertex; /* the editor's number of each vertex of the script */
} own;

static const char *version(void)
{
    return "meshwalk " MW_VERSION_STRING;
}

static void destroy(void *self)
{
    own *o = self;
    if (!o) return;
    mw_editor_destroy(o->editor);
    free(o->vertex);
    free(o);
}

static bool make(own *o, const script *s, mw_start_kind start)
{
    mw_mesh *mesh;
    mw_query_options options = {0};
    mw_delaunay_options one_thread = {.threads = 1}; /* others would still be spinning when the clock runs */
    mw_editor_options alone = {.threads = 1};
    if (mw_delaunay(s->points, s->point_count, 2, &one_thread, NULL, NULL, &mesh, NULL) != MW_OK) return false;
    bool made = mw_editor_create(mesh, &alone, &o->editor, NULL) == MW_OK;
    mw_mesh_destroy(mesh);
    o->vertex = malloc((s->point_count + s->inserted) * sizeof *o->vertex);
    if (!made || !o->vertex) return false;
    if (start != MW_START_AUTO && mw_editor_index(o->editor, start, NULL, &options.index, NULL) != MW_OK) return false;
    for (size_t i = 0; i < s->point_count; i++) o->vertex[i] = (uint32_t)i;
    return mw_cursor_init(mw_editor_locator(o->editor), &options, &o->cursor, NULL) == MW_OK;
}

static void *build_own(const script *s, mw_start_kind start)
{
    own *o = calloc(1, sizeof *o);
    if (o && make(o, s, start)) return o;
    destroy(o);
    return NULL;
}

static void *build(const script *s)
{
    return build_own(s, MW_START_AUTO);
}
static void *build_layers(const script *s)
{
    return build_own(s, MW_START_LAYERS);
}
static void *build_grid(const script *s)
{
    return build_own(s, MW_START_GRID);
}

static void corners_of(const mw_editor *editor, uint32_t triangle, double corners[6])
{
    uint32_t v[3];
    memset(corners, 0, 6 * sizeof *corners);
    if (!mw_editor_triangle(editor, triangle, v)) return;
    for (int k = 0; k < 3; k++) mw_editor_vertex(editor, v[k], corners + 2 * k);
}

/* Points lie in the steps as far apart as these. */
static mw_status insert_points(own *o, const script *s)
{
    _Static_assert(sizeof(script_step) % sizeof(double) == 0, "steps are some doubles apart");
    return mw_edit_insert_points(o->editor, s->steps->point, s->count, sizeof(script_step) / sizeof(double), NULL, NULL,
                                 NULL);
}

/* Nothing is asked about what changed, as CGAL tells nothing: the number of a new vertex is the next one. */
static double run(void *self, const script *s, double *corners)
{
    own *o = self;
    mw_status status = MW_OK;
    uint32_t inserted = (uint32_t)s->point_count;
    const mw_locator *locator = mw_editor_locator(o->editor);
    double clock = monotonic_seconds();
    if (s->at_once) {
        status = insert_points(o, s);
        return status == MW_OK ? monotonic_seconds() - clock : EDITING_FAILED;
    }
    for (const script_step *step = s->steps; step < s->steps + s->count && status == MW_OK; step++) {
        const double *p = step->point;
        switch (step->kind) {
        case SCRIPT_INSERT:
            status = mw_edit_insert(o->editor, p[0], p[1], NULL, NULL);
            o->vertex[inserted] = inserted;
            inserted++;
            break;
        case SCRIPT_REMOVE: status = mw_edit_remove(o->editor, o->vertex[step->vertex], NULL, NULL); break;
        case SCRIPT_MOVE: status = mw_edit_move(o->editor, o->vertex[step->vertex], p[0], p[1], NULL, NULL); break;
        case SCRIPT_LOCATE:
            corners_of(o->editor, mw_locate(locator, &o->cursor, p[0], p[1]).triangle, corners);
            corners += 6;
            break;
        }
    }
    return status == MW_OK ? monotonic_seconds() - clock : EDITING_FAILED;
}

static uint64_t sum(const void *self)
{
    const own *o = self;
    mw_editor_info info;
    uint64_t sum = 0;
    uint32_t v[3];
    double corners[6];
    mw_editor_describe(o->editor, &info);
    for (uint32_t t = 0; t < info.triangle_range; t++) {
        if (!mw_editor_triangle(o->editor, t, v)) continue;
        corners_of(o->editor, t, corners);
        sum += editing_sum(corners);
    }
    return sum;
}

const editing_code *editing_own(editor_id id)
{
    static const editing_code codes[] = {
        [EDITOR_OWN] = {version, build, run, sum, destroy},
        [EDITOR_OWN_LAYERS] = {version, build_layers, run, sum, destroy},
        [EDITOR_OWN_GRID] = {version, build_grid, run, sum, destroy},
    };
    return id <= EDITOR_OWN_GRID ? &codes[id] : NULL;
}
