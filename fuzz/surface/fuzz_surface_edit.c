/* fuzz_surface_edit.c - a small surface and a stream of edits from the input. A list of triangles,
 * edited by looking at all of them, predicts what each edit makes, and which are refused; the
 * surface, its links and its boxes have to agree after each step. */
#include "oracle/edit_require.h"
#include "oracle/surface/surface_twin.h"

#include <math.h>
#include <stdlib.h>

enum { STEPS = 24, PATH = 6, MOST_TRIANGLES = 120 };

typedef struct input {
    const uint8_t *byte;
    size_t left;
} input;

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

static uint32_t next(input *in)
{
    if (in->left == 0) return 0;
    in->left--;
    return *in->byte++;
}

static shape shape_from(input *in)
{
    uint64_t random = next(in);
    switch (next(in) % 5) {
    case 0: return shape_patch(2, 2, &random);
    case 1: return shape_ball(1, 8, 0.3, &random);
    case 2: return shape_torus(3, 3, 3);
    case 3: {
        shape s = shape_patch(2, 2, &random);
        shape_clash(&s, 0.3, &random);
        return s;
    }
    default: return shape_join(shape_patch(1, 1, &random), shape_patch(2, 1, &random), 5);
    }
}

/* A vertex, mostly one of the surface. */
static uint32_t vertex_from(input *in, const twin_surface *s)
{
    return next(in) % (s->points + 2);
}

/* A corner of a triangle and the next one: an edge that is there. */
static void edge_from(input *in, const twin_surface *s, uint32_t edge[3])
{
    uint32_t byte = next(in), t = byte / 3 % s->triangles, k = byte % 3;
    for (uint32_t i = 0; i < 3; i++) edge[i] = s->triangle[3 * t + (k + i) % 3];
}

static mw_surface_edit edit_from(input *in, const twin_surface *s, uint32_t *path)
{
    uint32_t how = next(in);
    mw_surface_edit e = {.kind = (mw_surface_edit_kind)(how % MW_SURFACE_EDIT_KIND_COUNT)};
    e.triangle = next(in) % (s->triangles + 1);
    edge_from(in, s, e.vertex);
    if (how & 128) e.vertex[0] = vertex_from(in, s);
    if (e.kind == MW_SURFACE_ADD_TRIANGLE) e.vertex[2] = vertex_from(in, s);
    for (int i = 0; i < 3; i++) e.point[i] = (double)(next(in) % 32) / 2 - 8;
    bool optional = e.kind == MW_SURFACE_SPLIT_EDGE || e.kind == MW_SURFACE_SPLIT_TRIANGLE ||
                    e.kind == MW_SURFACE_COLLAPSE;
    if (optional && how & 64) e.point[0] = NAN;
    if (e.kind < MW_SURFACE_CUT) return e;
    e.path_count = 2 + next(in) % (PATH - 1);
    e.path = path;
    e.other = path + e.path_count;
    for (size_t i = 0; i < 2 * e.path_count; i++) path[i] = vertex_from(in, s);
    return e;
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    input in = {data, size};
    shape s = shape_from(&in);
    uint64_t random = size + 1;
    uint32_t path[2 * PATH];
    surface_twin t = surface_twin_make(&s, 4);
    edit_case.name = "fuzz_surface_edit";
    for (int step = 0; step < STEPS && in.left > 0; step++) {
        uint32_t what = next(&in);
        edit_case.step = (uint64_t)step;
        if (what < 24) {
            surface_twin_undo(&t);
        } else if (what < 28) {
            surface_twin_compact(&t);
        } else if (t.now.triangles < MOST_TRIANGLES) {
            mw_surface_edit edit = edit_from(&in, &t.now, path);
            surface_twin_apply(&t, &edit);
        }
        surface_twin_check(&t, what & 1, &random);
    }
    surface_twin_free(&t);
    shape_free(&s);
    return 0;
}
