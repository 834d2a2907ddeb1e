/* edit_check.c - the editor against its twin, the twin against geometry. */
#include "oracle/edit_check.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "oracle/edit_sides.h"
#include "support/meshes.h"

/* --- the editor says what the twin does ------------------------------------------------------- */

static void same_vertex(const twin *t, uint32_t v)
{
    double p[2] = {-7, -7};
    int there = mw_editor_vertex(t->editor, v, p);
    bool expected = v < t->vertex_range && t->state[v] != TWIN_GONE;
    REQUIRE(there == expected);
    if (expected)
        REQUIRE(memcmp(p, twin_point(t, v), sizeof p) == 0);
    else
        REQUIRE(p[0] == -7 && p[1] == -7);
    for (uint32_t f = 0; f < t->fields; f++) {
        double value = mw_editor_value(t->editor, f, v);
        if (!expected)
            REQUIRE(isnan(value));
        else
            REQUIRE(memcmp(&value, &t->value[f][v], sizeof value) == 0 ||
                    (isnan(value) && isnan(t->value[f][v])));
    }
}

static void same_triangle(const twin *t, uint32_t k)
{
    uint32_t v[3] = {7, 7, 7};
    int there = mw_editor_triangle(t->editor, k, v);
    REQUIRE(there == twin_has_triangle(t, k));
    if (there)
        REQUIRE(memcmp(v, twin_corners(t, k), sizeof v) == 0);
    else
        REQUIRE(v[0] == 7 && v[1] == 7 && v[2] == 7);
}

static void same_constraints(const twin *t)
{
    size_t count;
    uint32_t *edge = mw_editor_constrained_edges(t->editor, &count);
    REQUIRE(edge != NULL && count == t->fixed_count);
    for (size_t i = 0; i < count; i++) {
        REQUIRE(twin_is_fixed(t, edge[2 * i], edge[2 * i + 1]));
        for (size_t j = 0; j < i && count < 200; j++)
            REQUIRE(!(edge[2 * j] == edge[2 * i] && edge[2 * j + 1] == edge[2 * i + 1]));
    }
    free(edge);
}

static void same_info(const twin *t)
{
    mw_editor_info info;
    mw_editor_describe(t->editor, &info);
    REQUIRE(info.vertices == t->vertices && info.triangles == t->triangles);
    REQUIRE(info.vertex_range == t->vertex_range && info.triangle_range == t->triangle_range);
    REQUIRE(info.constrained_edges == t->fixed_count);
    REQUIRE(info.delaunay == t->delaunay && info.convex == t->convex);
    REQUIRE(info.bytes > 0 && info.undo_bytes < info.bytes && info.index_bytes < info.bytes);
    for (int i = 0; i < 8; i++) REQUIRE(info.reserved[i] == 0);
}

void twin_check_same(const twin *t)
{
    same_info(t);
    for (uint32_t v = 0; v < t->vertex_range + 2; v++) same_vertex(t, v);
    for (uint32_t k = 0; k < t->triangle_range + 2; k++) same_triangle(t, k);
    same_vertex(t, MW_NONE);
    same_triangle(t, MW_NONE);
    same_constraints(t);
}

/* --- neighbours ------------------------------------------------------------------------------- */

/* The edges round a vertex by its sides, counter-clockwise: each neighbour but the first of a
 * fan is joined to the one before by a triangle. */
static void check_around(const twin *t, uint32_t v, const twin_side *sides, size_t count,
                         const twin_border_vertex *b)
{
    const twin_side key = {.from = v};
    size_t i = 0, last = count;
    while (i < last) { /* the first side from v */
        size_t middle = i + (last - i) / 2;
        if (twin_compare_sides(&sides[middle], &key) < 0)
            i = middle + 1;
        else
            last = middle;
    }
    uint32_t triangles = 0, lowest = MW_NONE, joined = 0;
    for (; i < count && sides[i].from == v; i++) {
        triangles++;
        if (sides[i].triangle < lowest) lowest = sides[i].triangle;
    }
    REQUIRE(mw_editor_triangle_of(t->editor, v) == lowest);
    size_t degree = mw_editor_adjacent_vertices(t->editor, v, NULL, 0);
    REQUIRE(degree == triangles + b[v].in);
    uint32_t *around = require_room(degree, sizeof *around);
    around[degree] = 4711;
    REQUIRE(mw_editor_adjacent_vertices(t->editor, v, around, degree) == degree &&
            around[degree] == 4711);
    for (size_t j = 0; j < degree; j++) {
        const twin_side *s = twin_find_side(sides, count, v, around[j]);
        REQUIRE(s != NULL || twin_find_side(sides, count, around[j], v) != NULL);
        joined += s && s->apex == around[(j + 1) % degree];
    }
    REQUIRE(joined == triangles);
    if (degree > 1) {
        uint32_t two[2] = {0, 4711};
        REQUIRE(mw_editor_adjacent_vertices(t->editor, v, two, 1) == degree &&
                two[0] == around[0] && two[1] == 4711);
    }
    free(around);
}

static mw_edge_kind edge_of(const twin *t, const twin_side *sides, size_t count, uint32_t a,
                            uint32_t b)
{
    const twin_side *s = twin_find_side(sides, count, a, b),
                    *r = twin_find_side(sides, count, b, a);
    if (!s && !r) return MW_EDGE_NONE;
    if (twin_is_fixed(t, a, b)) return MW_EDGE_CONSTRAINED;
    return s && r ? MW_EDGE_UNCONSTRAINED : MW_EDGE_BORDER;
}

static void check_edge(const twin *t, const twin_side *sides, size_t count, uint32_t a, uint32_t b)
{
    mw_edge_kind kind = edge_of(t, sides, count, a, b);
    REQUIRE(mw_editor_edge(t->editor, a, b) == kind && mw_editor_edge(t->editor, b, a) == kind);
}

static void check_neighbours(const twin *t, const twin_side *sides, size_t count)
{
    twin_border_vertex *b = twin_border_vertices(t, sides, count);
    for (uint32_t v = 0; v < t->vertex_range; v++) check_around(t, v, sides, count, b);
    for (uint32_t v = t->vertex_range; v < t->vertex_range + 2; v++) {
        REQUIRE(mw_editor_triangle_of(t->editor, v) == MW_NONE &&
                mw_editor_adjacent_vertices(t->editor, v, NULL, 0) == 0);
        REQUIRE(mw_editor_edge(t->editor, v, 0) == 0 && mw_editor_edge(t->editor, 0, v) == 0);
    }
    const size_t step = 1 + count / 5000; /* it takes as long as there are edges at the vertex */
    for (size_t i = 0; i < count; i += step)
        check_edge(t, sides, count, sides[i].from, sides[i].to);
    if (t->vertex_range <= 40)
        for (uint32_t v = 0; v < t->vertex_range; v++)
            for (uint32_t w = 0; w <= v; w++) check_edge(t, sides, count, v, w);
    free(b);
}

/* --- Delaunay --------------------------------------------------------------------------------- */

static void check_delaunay(const twin *t, const twin_side *sides, size_t count)
{
    for (size_t i = 0; i < count; i++) {
        const twin_side *s = &sides[i], *r = twin_find_side(sides, count, s->to, s->from);
        if (!r || s->from > s->to || twin_is_fixed(t, s->from, s->to)) continue;
        REQUIRE(plane_incircle(twin_point(t, s->from), twin_point(t, s->to), twin_point(t, s->apex),
                               twin_point(t, r->apex)) <= 0);
    }
}

/* What a rebuild from nothing makes of the same points has the same edges, except for such as have
 * four points on their circle. */
static void check_rebuilt(const twin *t, const twin_side *sides, size_t count)
{
    double *points = require_room(2 * (size_t)t->vertices, sizeof *points);
    uint32_t *number = require_room(t->vertices, sizeof *number),
             *back = require_room(t->vertex_range, sizeof *back), n = 0;
    uint32_t *segments = require_room(2 * (t->fixed_count + count), sizeof *segments);
    uint32_t *polygon = require_room(t->fixed_count + count, sizeof *polygon);
    size_t m = 0;
    for (uint32_t v = 0; v < t->vertex_range; v++) {
        if (t->state[v] != TWIN_USED) continue;
        memcpy(points + 2 * (size_t)n, twin_point(t, v), 2 * sizeof *points);
        back[v] = n;
        number[n++] = v;
    }
    for (; m < t->fixed_count; m++) {
        for (int k = 0; k < 2; k++) segments[2 * m + (size_t)k] = back[t->fixed[2 * m + (size_t)k]];
        polygon[m] = MW_NONE;
    }
    for (size_t i = 0; i < count && !t->convex; i++) {
        if (twin_find_side(sides, count, sides[i].to, sides[i].from)) continue;
        segments[2 * m] = back[sides[i].from];
        segments[2 * m + 1] = back[sides[i].to];
        polygon[m++] = 0;
    }
    mw_constraints given = {.points = points,
                            .point_count = n,
                            .segments = segments,
                            .segment_count = m,
                            .polygon = t->convex ? NULL : polygon};
    mw_mesh *mesh;
    mw_error error = {0};
    if (m == 0)
        expect_ok(mw_delaunay(points, n, 2, NULL, NULL, NULL, &mesh, &error), "rebuild", &error);
    else
        expect_ok(mw_constrained_delaunay(&given, NULL, NULL, NULL, NULL, &mesh, &error), "rebuild",
                  &error);
    REQUIRE(mw_mesh_triangle_count(mesh) == t->triangles);
    for (uint32_t k = 0; k < t->triangles; k++) {
        uint32_t v[3];
        mw_mesh_triangle(mesh, k, v);
        for (int e = 0; e < 3; e++) {
            uint32_t a = number[v[e]], b = number[v[(e + 1) % 3]], c = number[v[(e + 2) % 3]];
            unsigned edge;
            uint32_t other = mw_mesh_neighbour(mesh, k, (unsigned)e, &edge), w[3];
            if (twin_find_side(sides, count, a, b)) continue;
            REQUIRE(other != MW_NONE && !twin_is_fixed(t, a, b));
            mw_mesh_triangle(mesh, other, w);
            REQUIRE(plane_incircle(twin_point(t, a), twin_point(t, b), twin_point(t, c),
                                   twin_point(t, number[w[(edge + 2) % 3]])) == 0);
        }
    }
    mw_mesh_destroy(mesh);
    free(points);
    free(number);
    free(back);
    free(segments);
    free(polygon);
}

/* --- the mesh that the editor gives ----------------------------------------------------------- */

static void check_numbers(const uint32_t *fresh, const twin *t, bool vertices, uint32_t count)
{
    uint32_t next = 0, range = vertices ? t->vertex_range : t->triangle_range;
    for (uint32_t i = 0; i < range; i++) {
        bool there = vertices ? t->state[i] != TWIN_GONE : twin_has_triangle(t, i);
        REQUIRE(fresh[i] == (there ? next : MW_NONE));
        next += there;
    }
    REQUIRE(next == count && fresh[range] == 4711);
}

void twin_check_mesh(const twin *t, const mw_mesh *mesh, const uint32_t *triangles,
                     const uint32_t *vertices)
{
    REQUIRE(mw_mesh_triangle_count(mesh) == t->triangles &&
            mw_mesh_vertex_count(mesh) == t->vertices);
    check_numbers(triangles, t, false, t->triangles);
    check_numbers(vertices, t, true, t->vertices);
    for (uint32_t k = 0; k < t->triangle_range; k++) {
        uint32_t v[3];
        if (triangles[k] == MW_NONE) continue;
        mw_mesh_triangle(mesh, triangles[k], v);
        for (int c = 0; c < 3; c++) REQUIRE(v[c] == vertices[twin_corners(t, k)[c]]);
    }
    for (uint32_t v = 0; v < t->vertex_range; v++) {
        double p[2];
        if (vertices[v] == MW_NONE) continue;
        mw_mesh_vertex(mesh, vertices[v], p);
        REQUIRE(memcmp(p, twin_point(t, v), sizeof p) == 0);
        for (uint32_t f = 0; f < t->fields; f++) {
            const double *values = mw_mesh_field(mesh, twin_field[f]);
            REQUIRE(values != NULL &&
                    memcmp(&values[vertices[v]], &t->value[f][v], sizeof(double)) == 0);
        }
    }
}

static void check_export(const twin *t)
{
    uint32_t *triangles = require_room(t->triangle_range, sizeof *triangles),
             *vertices = require_room(t->vertex_range, sizeof *vertices);
    triangles[t->triangle_range] = vertices[t->vertex_range] = 4711;
    mw_mesh *mesh;
    mw_error error = {0};
    expect_ok(mw_editor_mesh(t->editor, triangles, vertices, &mesh, &error), "mesh", &error);
    twin_check_mesh(t, mesh, triangles, vertices);
    mw_mesh_info info;
    expect_ok(mw_mesh_describe(mesh, NULL, &info, &error), "describe", &error);
    REQUIRE(info.embedding && !info.flat_triangles);
    /* a border that is fixed may have become convex */
    REQUIRE(info.convex == t->convex || t->border_moved);
    if (t->delaunay && !t->fixed_count) REQUIRE(info.delaunay);
    mw_mesh_destroy(mesh);
    free(triangles);
    free(vertices);
}

/* --- all of it -------------------------------------------------------------------------------- */

void twin_check_all(const twin *t)
{
    size_t count;
    twin_check_same(t);
    twin_side *sides = twin_sides(t, &count);
    twin_check_border(t, sides, count);
    for (size_t i = 0; i < t->fixed_count; i++)
        REQUIRE(twin_find_side(sides, count, t->fixed[2 * i], t->fixed[2 * i + 1]) ||
                twin_find_side(sides, count, t->fixed[2 * i + 1], t->fixed[2 * i]));
    for (uint32_t v = 0; v < t->vertex_range; v++) { /* used vertices are those of triangles */
        const twin_side *s = NULL;
        if (t->state[v] == TWIN_USED) s = sides;
        REQUIRE((s != NULL) == (mw_editor_triangle_of(t->editor, v) != MW_NONE));
    }
    check_neighbours(t, sides, count);
    if (t->delaunay) {
        check_delaunay(t, sides, count);
        check_rebuilt(t, sides, count);
    }
    check_export(t);
    free(sides);
}

void twin_check_replay(const twin *t, const mw_editor_options *options)
{
    size_t count;
    const mw_edit *log = mw_editor_log(t->editor, &count);
    mw_error error = {0};
    twin again = twin_copy(t);
    expect_ok(mw_editor_create(t->first, options, &again.editor, &error), "editor", &error);
    for (size_t i = 0; i < count; i++)
        expect_ok(mw_edit_apply(again.editor, &log[i], NULL, &error), "replay", &error);
    twin_check_same(&again);
    mw_editor_destroy(again.editor);
    twin_close(&again);
}
