/* edit_open.c - the twin reads the mesh, its border and the constraints of the options. */
#include "oracle/edit_open.h"

#include <stdlib.h>
#include <string.h>

#include "oracle/edit_sides.h"
#include "support/meshes.h"

static void twin_read_first(twin *t, const mw_mesh *mesh)
{
    t->vertices = t->vertex_range = mw_mesh_vertex_count(mesh);
    t->triangles = t->triangle_range = mw_mesh_triangle_count(mesh);
    t->point = require_room(2 * (size_t)t->vertex_range, sizeof *t->point);
    t->state = require_room(t->vertex_range, 1);
    t->triangle = require_room(3 * (size_t)t->triangle_range, sizeof *t->triangle);
    for (uint32_t v = 0; v < t->vertex_range; v++) {
        mw_mesh_vertex(mesh, v, t->point + 2 * (size_t)v);
        t->state[v] = TWIN_ALONE;
    }
    for (uint32_t k = 0; k < t->triangle_range; k++) {
        mw_mesh_triangle(mesh, k, t->triangle + 3 * (size_t)k);
        for (int c = 0; c < 3; c++) t->state[twin_corners(t, k)[c]] = TWIN_USED;
    }
    for (int f = 0; f < TWIN_FIELDS; f++) {
        const double *values = mw_mesh_field(mesh, twin_field[f]);
        t->value[f] = require_room(t->vertex_range, sizeof(double));
        if (values) memcpy(t->value[f], values, t->vertex_range * sizeof(double));
    }
}

void twin_set_fields(mw_mesh *mesh)
{
    uint32_t n = mw_mesh_vertex_count(mesh);
    for (int f = 0; f < TWIN_FIELDS; f++) {
        double *values = require_room(n, sizeof *values);
        for (uint32_t v = 0; v < n; v++) values[v] = f ? v : 100 + v % 17;
        REQUIRE(mw_mesh_set_field(mesh, twin_field[f], values, 1, NULL) == MW_OK);
        free(values);
    }
}

/* The constraints of the options, except for those along a border that is fixed anyway. */
static void fix_first(twin *t, const mw_editor_options *options)
{
    size_t count;
    twin_side *sides = twin_sides(t, &count);
    for (size_t i = 0; options && i < options->constrained_edge_count; i++) {
        uint32_t a = options->constrained_edges[2 * i], b = options->constrained_edges[2 * i + 1];
        if (t->convex || (twin_find_side(sides, count, a, b) && twin_find_side(sides, count, b, a)))
            twin_fix(t, a, b);
    }
    free(sides);
}

void twin_open(twin *t, mw_mesh *mesh, const mw_editor_options *options)
{
    mw_error error = {0};
    mw_mesh_info info;
    *t = (twin){.first = mesh, .fields = twin_bare ? 0 : TWIN_FIELDS};
    if (!twin_bare) twin_set_fields(mesh);
    twin_read_first(t, mesh);
    REQUIRE(mw_mesh_describe(mesh, NULL, &info, NULL) == MW_OK);
    t->convex = info.convex;
    expect_ok(mw_editor_create(mesh, options, &t->editor, &error), "editor", &error);
    expect_ok(mw_locator_create(mesh, NULL, &t->first_locator, &error), "locator", &error);
    fix_first(t, options);
    mw_editor_info now;
    mw_editor_describe(t->editor, &now);
    t->delaunay = now.delaunay;
    if (!t->convex) twin_keep_border(t);
}
