/* fuzz_edit.c - a small mesh and a stream of edits, undos and queries from the input. What each
 * edit has to do is predicted by brute force, its report is taken over into a twin, and the editor
 * has to agree with that after each step. Places are on a small lattice, so that they meet edges,
 * vertices, lines and circles often. */
#include "oracle/edit_open.h"
#include "oracle/edit_apply.h"

#include <math.h>
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>

enum { MOST = 14, STEPS = 40, KEPT = 8 };

typedef struct input {
    const uint8_t *byte;
    size_t left;
} input;

static uint32_t next(input *in)
{
    if (in->left == 0) return 0;
    in->left--;
    return *in->byte++;
}

/* Places of 8 x 8, and those half way between. */
static double coordinate(uint32_t bits)
{
    return (bits & 15) / 2.0;
}

/* The Delaunay triangulation of some places, less some triangles; NULL if there is none. */
static mw_mesh *mesh_from(input *in)
{
    double points[2 * MOST];
    uint32_t triangles[6 * MOST], n = 3 + next(in) % (MOST - 2), how = next(in), kept = 0;
    for (uint32_t i = 0; i < n; i++) {
        uint32_t byte = next(in);
        points[2 * i] = coordinate(byte);
        points[2 * i + 1] = coordinate(byte >> 4);
    }
    mw_mesh *whole, *mesh;
    if (mw_delaunay(points, n, 2, NULL, NULL, NULL, &whole, NULL)) return NULL;
    uint32_t count = mw_mesh_triangle_count(whole);
    for (uint32_t t = 0; t < count; t++) {
        uint32_t what = how & 1 ? next(in) : 0, v[3];
        if ((what & 3) == 3 && count - t + kept > 1) continue;
        mw_mesh_triangle(whole, t, v);
        for (uint32_t k = 0; k < 3; k++)
            triangles[3 * kept + k] = v[(what / 8 + (what & 4 ? 3 - k : k)) % 3];
        kept++;
    }
    mw_arrays view = {
        .points = points, .point_count = n, .triangles = triangles, .triangle_count = kept};
    if (mw_mesh_create(
            &view,
            &(mw_mesh_options){.layout = how >> 1 & 1 ? MW_LAYOUT_AS_GIVEN : MW_LAYOUT_HILBERT},
            &mesh, NULL))
        abort();
    mw_mesh_destroy(whole);
    return mesh;
}

static void edit_from(input *in, uint32_t what, twin *t)
{
    uint32_t place = next(in), one = next(in);
    mw_edit e = {.kind = (mw_edit_kind)(what % MW_EDIT_KIND_COUNT),
                 .field = what >> 4 & 1,
                 .value = what & 64 ? NAN : 5};
    e.x = coordinate(place);
    e.y = coordinate(place >> 4);
    e.vertex = one % (t->vertex_range + 1);
    if (e.kind >= MW_EDIT_FLIP) e.other = place % (t->vertex_range + 1);
    if (e.kind == MW_EDIT_VALUE && twin_bare) e.kind = MW_EDIT_RELEASE;
    if (e.kind == MW_EDIT_VALUE) e.value = one;
    twin_apply(t, &e, what >> 7);
}

static void look(twin *t, twin_cursors *r)
{
    twin_check_all(t);
    twin_check_queries(t, r);
}

static void run(input *in, twin *t, const mw_editor_options *options)
{
    twin then[KEPT];
    twin_cursors r;
    uint32_t kept = 0, steps = 0;
    bool compacted = false;
    twin_cursors_open(&r, t, options->delaunay != MW_DELAUNAY_MAKE, 1);
    while (in->left > 0 && steps++ < STEPS) {
        uint32_t what = next(in);
        mw_editor_info was, is;
        mw_editor_describe(t->editor, &was);
        edit_case.step = steps;
        if (what % 16 == 15 && kept > 0) {
            twin_undo(t, &then[--kept]);
            twin_close(&then[kept]);
        } else if (what == 14) {
            twin_compact(t);
            compacted = true;
            while (kept > 0) twin_close(&then[--kept]);
        } else {
            if (kept == KEPT) {
                twin_close(&then[0]);
                memmove(then, then + 1, --kept * sizeof *then);
            }
            then[kept] = twin_copy(t);
            edit_from(in, what, t);
            mw_editor_describe(t->editor, &is);
            if (is.edits > was.edits)
                kept++;
            else
                twin_close(&then[kept]);
        }
        twin_check_same(t);
        if (what % 8 == 5) look(t, &r);
    }
    look(t, &r);
    if (!compacted) twin_check_replay(t, options);
    while (kept > 0) twin_close(&then[--kept]);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    input in = {data, size};
    twin t;
    mw_editor_options options = {
        .delaunay = (mw_delaunay_mode)(next(&in) % 3), .undo = KEPT, .log = 1};
    mw_mesh *mesh = mesh_from(&in);
    if (!mesh) return 0;
    uint32_t constraint[2], v[3], more = next(&in);
    twin_bare = more >> 1 & 1;
    if (more & 1) {
        mw_mesh_triangle(mesh, 0, v);
        constraint[0] = v[0];
        constraint[1] = v[1];
        options.constrained_edges = constraint;
        options.constrained_edge_count = 1;
    }
    edit_case.name = "input";
    twin_open(&t, mesh, &options);
    run(&in, &t, &options);
    twin_close(&t);
    return 0;
}
