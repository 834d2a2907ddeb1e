/* delaunay_oracle.c - records, vertices, hull, circles. */
#include "oracle/delaunay_oracle.h"

#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include <stdlib.h>
#include <string.h>

static const mw_point *sorted_points;

static int by_place(const void *left, const void *right)
{
    uint32_t i = *(const uint32_t *)left, j = *(const uint32_t *)right;
    mw_point p = sorted_points[i], q = sorted_points[j];
    if (p.x != q.x) return p.x < q.x ? -1 : 1;
    if (p.y != q.y) return p.y < q.y ? -1 : 1;
    return i < j ? -1 : i > j;
}

/* first[i] = the lowest number of a point equal to point i. */
static void find_equal_points(const mw_point *points, uint32_t n, uint32_t *first)
{
    uint32_t *order = malloc((n + 1) * sizeof *order);
    for (uint32_t i = 0; i < n; i++) order[i] = i;
    sorted_points = points;
    qsort(order, n, sizeof *order, by_place);
    for (uint32_t i = 0, from = 0; i < n; i++) {
        if (points[order[i]].x != points[order[from]].x ||
            points[order[i]].y != points[order[from]].y)
            from = i;
        first[order[i]] = order[from];
    }
    free(order);
}

/* Counter-clockwise triangles, symmetric links, the order of records. Returns the number of
 * border edges. */
static uint32_t check_records(const mw_mesh *mesh)
{
    uint32_t border = 0;
    for (uint32_t t = 0; t < mesh->tri_count; t++) {
        const mw_triangle *tri = &mesh->tri[t];
        assert_int_equal(tri->user, t);
        assert_int_equal(tri->v[3], tri->v[0]);
        for (int k = 0; k < 3; k++) assert_true(tri->v[k] < mesh->point_count);
        assert_true(mw__has_area(mesh->point, tri));
        for (uint32_t k = 0; k < 3; k++) {
            if (tri->link[k] == MW_NONE) {
                border++;
                continue;
            }
            uint32_t e = mw__link_edge(tri->link[k]);
            assert_true(mw__link_triangle(tri->link[k]) < mesh->tri_count && e < 3);
            const mw_triangle *other = &mesh->tri[mw__link_triangle(tri->link[k])];
            assert_int_equal(other->link[e], mw__link(t, k));
            assert_int_equal(other->v[e], tri->v[k + 1]);
            assert_int_equal(other->v[e + 1], tri->v[k]);
        }
    }
    return border;
}

/* No vertex across an edge lies in the circle. */
static void check_edges_delaunay(const mw_mesh *mesh)
{
    for (uint32_t t = 0; t < mesh->tri_count; t++) {
        const mw_triangle *tri = &mesh->tri[t];
        for (int k = 0; k < 3; k++) {
            if (tri->link[k] == MW_NONE) continue;
            const mw_triangle *other = &mesh->tri[mw__link_triangle(tri->link[k])];
            uint32_t apex = other->v[mw__prev(mw__link_edge(tri->link[k]))];
            const mw_point *p = mesh->point;
            assert_true(mw__incircle(p[tri->v[0]], p[tri->v[1]], p[tri->v[2]], p[apex]) <= 0);
        }
    }
}

/* No point at all lies in the circle of a triangle. */
static void check_circles_empty(const mw_mesh *mesh)
{
    const mw_point *p = mesh->point;
    for (uint32_t t = 0; t < mesh->tri_count; t++)
        for (uint32_t i = 0; i < mesh->point_count; i++) {
            const mw_triangle *tri = &mesh->tri[t];
            assert_true(mw__incircle(p[tri->v[0]], p[tri->v[1]], p[tri->v[2]], p[i]) <= 0);
        }
}

/* Does the edge from a to b point into the upper half plane, the positive x axis included? */
static int points_up(mw_point a, mw_point b)
{
    return b.y > a.y || (b.y == a.y && b.x > a.x);
}

/* The border is one loop that never turns right and turns once: a convex polygon. All points lie
 * in it. */
static void check_hull(const mw_mesh *mesh, uint32_t border)
{
    const mw_point *p = mesh->point;
    uint32_t *after = malloc(mesh->point_count * sizeof *after), first = MW_NONE, length = 0,
             half_turns = 0;
    memset(after, 255, mesh->point_count * sizeof *after);
    for (uint32_t t = 0; t < mesh->tri_count; t++)
        for (int k = 0; k < 3; k++) {
            if (mesh->tri[t].link[k] != MW_NONE) continue;
            first = mesh->tri[t].v[k];
            assert_int_equal(after[first], MW_NONE);
            after[first] = mesh->tri[t].v[k + 1];
        }
    assert_true(first != MW_NONE);
    uint32_t a = first;
    do {
        uint32_t b = after[a];
        assert_true(b != MW_NONE && after[b] != MW_NONE);
        assert_true(mw__orient2d(p[a], p[b], p[after[b]]) >= 0);
        half_turns += points_up(p[a], p[b]) != points_up(p[b], p[after[b]]);
        if ((uint64_t)border * mesh->point_count < 2000000)
            for (uint32_t i = 0; i < mesh->point_count; i++)
                assert_true(mw__orient2d(p[a], p[b], p[i]) >= 0);
        a = b;
        length++;
    } while (a != first);
    assert_int_equal(length, border);
    assert_int_equal(half_turns, 2);
    free(after);
}

/* Equal points are merged with the first of them; every other point is a vertex of a triangle.
 * Returns their number. */
static uint32_t check_vertices(const mw_mesh *mesh, const uint32_t *duplicate_of)
{
    uint32_t n = mesh->point_count, distinct = 0;
    uint32_t *first = malloc(n * sizeof *first), *used = calloc(n, sizeof *used);
    mw_point *points = malloc(n * sizeof *points); /* by the user's numbers */
    for (uint32_t i = 0; i < n; i++) {
        double p[2];
        mw_mesh_vertex(mesh, i, p);
        points[i] = (mw_point){p[0], p[1]};
    }
    find_equal_points(points, n, first);
    free(points);
    for (uint32_t t = 0; t < mesh->tri_count; t++)
        for (int k = 0; k < 3; k++) used[mw__vertex_number(mesh, mesh->tri[t].v[k])] = 1;
    for (uint32_t i = 0; i < n; i++) {
        assert_int_equal(duplicate_of[i], first[i] == i ? MW_NONE : first[i]);
        assert_int_equal(used[i], first[i] == i);
        distinct += first[i] == i;
    }
    free(first);
    free(used);
    return distinct;
}

void delaunay_oracle_check(const mw_mesh *mesh, const uint32_t *duplicate_of)
{
    uint32_t border = check_records(mesh);
    uint32_t distinct = check_vertices(mesh, duplicate_of);
    assert_int_equal(mesh->tri_count, 2 * distinct - 2 - border); /* Euler */
    check_hull(mesh, border);
    check_edges_delaunay(mesh);
    if ((uint64_t)mesh->tri_count * mesh->point_count < 100000) check_circles_empty(mesh);
}
