#include "oracle/constrained/constrained_oracle.h"

#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static int compare_edges(const void *left, const void *right)
{
    const constrained_edge *a = left, *b = right;
    if (a->low != b->low) return a->low < b->low ? -1 : 1;
    if (a->high != b->high) return a->high < b->high ? -1 : 1;
    return a->triangle < b->triangle ? -1 : a->triangle > b->triangle;
}

constrained_edge *constrained_find_edge(const constrained_result *r, uint32_t a, uint32_t b)
{
    uint32_t low = a < b ? a : b, high = a < b ? b : a;
    size_t first = 0, last = 3 * (size_t)r->count;
    while (first < last) {
        size_t middle = (first + last) / 2;
        const constrained_edge *e = &r->edge[middle];
        if (e->low < low || (e->low == low && e->high < high))
            first = middle + 1;
        else
            last = middle;
    }
    if (first == 3 * (size_t)r->count || r->edge[first].low != low || r->edge[first].high != high)
        return NULL;
    return &r->edge[first];
}

static constrained_edge *twin_of(const constrained_result *r, constrained_edge *e)
{
    return e + 1 < r->edge + 3 * (size_t)r->count && e[1].low == e->low && e[1].high == e->high
               ? e + 1
               : NULL;
}

static void list_edges(constrained_result *r)
{
    for (uint32_t t = 0; t < r->count; t++)
        for (uint32_t k = 0; k < 3; k++) {
            uint32_t a = r->tri[t][k], b = r->tri[t][(k + 1) % 3];
            r->edge[3 * t + k] = (constrained_edge){a < b ? a : b, a < b ? b : a, t,
                                                    r->tri[t][(k + 2) % 3], MW_NONE};
        }
    qsort(r->edge, 3 * (size_t)r->count, sizeof *r->edge, compare_edges);
    for (uint32_t i = 0; i < r->pieces.count; i++) {
        constrained_edge *e =
            constrained_find_edge(r, r->pieces.edge[2 * i], r->pieces.edge[2 * i + 1]);
        assert_non_null(e);
        assert_int_equal(e->piece, MW_NONE); /* each piece is listed once */
        e->piece = i;
        if (twin_of(r, e)) twin_of(r, e)->piece = i;
    }
}

constrained_result constrained_run(const constrained_scene *s, mw_keep keep, int split)
{
    constrained_result r = {.duplicate_of = malloc((s->points + 1) * sizeof(uint32_t))};
    mw_constraints given = scene_view(s);
    r.status =
        mw_constrained_delaunay(&given, &(mw_constrain_options){.keep = keep, .split = split},
                                r.duplicate_of, &r.report, &r.pieces, &r.mesh, &r.error);
    if (r.status) {
        assert_null(r.mesh);
        assert_int_equal(r.pieces.count, 0);
        return r;
    }
    r.n = mw_mesh_vertex_count(r.mesh);
    r.count = mw_mesh_triangle_count(r.mesh);
    r.point = malloc((r.n + 1) * sizeof *r.point);
    r.tri = malloc((r.count + 1) * sizeof *r.tri);
    r.edge = malloc((3 * (size_t)r.count + 1) * sizeof *r.edge);
    for (uint32_t v = 0; v < r.n; v++) {
        double p[2];
        mw_mesh_vertex(r.mesh, v, p);
        r.point[v] = (mw_point){p[0], p[1]};
    }
    for (uint32_t t = 0; t < r.count; t++) mw_mesh_triangle(r.mesh, t, r.tri[t]);
    list_edges(&r);
    return r;
}

void constrained_release(constrained_result *r)
{
    mw_constrained_edges_release(&r->pieces);
    mw_mesh_destroy(r->mesh);
    free(r->point);
    free(r->tri);
    free(r->edge);
    free(r->duplicate_of);
}

/* --- checks --- */

void constrained_assert_sound(const constrained_scene *s, const constrained_result *r)
{
    assert_int_equal(r->status, MW_OK);
    assert_int_equal(r->n, s->points + r->report.vertices_added);
    assert_int_equal(r->pieces.count, r->report.constrained_edges);
    for (uint32_t v = 0; v < s->points; v++)
        assert_true(points_equal(r->point[v], scene_point(s, v)));
    for (uint32_t t = 0; t < r->count; t++) {
        const uint32_t *v = r->tri[t];
        mw_point p[3] = {r->point[v[0]], r->point[v[1]], r->point[v[2]]};
        assert_int_equal(points_turn(p[0], p[1], p[2]), 1);
        for (unsigned k = 0; k < 3; k++) {
            constrained_edge *e = constrained_find_edge(r, v[k], v[(k + 1) % 3]),
                             *twin = twin_of(r, e);
            if (twin) assert_null(twin_of(r, twin));
            const constrained_edge *other = !twin ? NULL : e->triangle == t ? twin : e;
            unsigned back;
            uint32_t n = mw_mesh_neighbour(r->mesh, t, k, &back);
            assert_int_equal(n, other ? other->triangle : MW_NONE);
            if (!other) continue;
            assert_int_equal(r->tri[n][back], v[(k + 1) % 3]);
            if (e->piece == MW_NONE)
                assert_true(mw__incircle(p[0], p[1], p[2], r->point[other->apex]) <= 0);
        }
    }
}

void constrained_assert_fills_hull(const constrained_scene *s, const constrained_result *r)
{
    uint32_t border = 0, used = 0;
    for (size_t i = 0; i < 3 * (size_t)r->count; i++) {
        constrained_edge *e = &r->edge[i];
        if (twin_of(r, e) || (i > 0 && twin_of(r, e - 1) == e)) continue;
        border++;
        int inner = points_turn(r->point[e->low], r->point[e->high], r->point[e->apex]);
        for (uint32_t v = 0; v < r->n; v++)
            assert_true(points_turn(r->point[e->low], r->point[e->high], r->point[v]) * inner >= 0);
    }
    uint8_t *seen = calloc(r->n, 1);
    for (uint32_t t = 0; t < r->count; t++)
        for (int k = 0; k < 3; k++) seen[r->tri[t][k]] = 1;
    for (uint32_t v = 0; v < r->n; v++) {
        used += seen[v];
        assert_int_equal(seen[v], v >= s->points || r->duplicate_of[v] == MW_NONE);
    }
    free(seen);
    assert_int_equal(r->count, 2 * used - border - 2);
    assert_int_equal(r->report.triangles_removed, 0);
}

static const mw_point *sorted_points; /* of the comparison below */

static int compare_points(const void *left, const void *right)
{
    mw_point a = sorted_points[*(const uint32_t *)left],
             b = sorted_points[*(const uint32_t *)right];
    if (a.x != b.x) return a.x < b.x ? -1 : 1;
    return a.y < b.y ? -1 : a.y > b.y;
}

/* Each segment is the chain of edges through the vertices that lie on it; pieces are parts of the
 * lowest segment that lies along them, and nothing else is a piece. lowest: per piece. */
static void assert_forced(const constrained_scene *s, const constrained_result *r)
{
    uint32_t *on = malloc((r->n + 1) * sizeof *on);
    uint32_t *lowest = malloc((r->pieces.count + 1) * sizeof *lowest);
    for (size_t i = 0; i < r->pieces.count; i++) lowest[i] = MW_NONE;
    for (uint32_t i = 0; i < s->segments; i++) {
        mw_point a = scene_point(s, s->segment[2 * i]), b = scene_point(s, s->segment[2 * i + 1]);
        uint32_t count = 0;
        for (uint32_t v = 0; v < s->points; v++)
            if (r->duplicate_of[v] == MW_NONE && point_lies_on(a, b, r->point[v])) on[count++] = v;
        sorted_points = r->point;
        qsort(on, count, sizeof *on, compare_points);
        for (uint32_t k = 0; k + 1 < count && !points_equal(a, b); k++) {
            const constrained_edge *e = constrained_find_edge(r, on[k], on[k + 1]);
            assert_non_null(e);
            assert_int_not_equal(e->piece, MW_NONE);
            if (i < lowest[e->piece]) lowest[e->piece] = i;
        }
    }
    for (size_t i = 0; i < r->pieces.count; i++) {
        assert_int_equal(lowest[i], r->pieces.segment[i]);
        mw_point a = scene_point(s, s->segment[2 * lowest[i]]),
                 b = scene_point(s, s->segment[2 * lowest[i] + 1]);
        mw_point from = r->point[r->pieces.edge[2 * i]], to = r->point[r->pieces.edge[2 * i + 1]];
        assert_true((b.x - a.x) * (to.x - from.x) >= 0 && (b.y - a.y) * (to.y - from.y) >= 0);
    }
    free(on);
    free(lowest);
}

/* Is q inside the polygon, for a ray to the right? */
static bool inside(const constrained_scene *s, uint32_t polygon, mw_point q)
{
    bool odd = false;
    for (uint32_t i = 0; i < s->segments; i++) {
        if (s->polygon[i] != polygon) continue;
        mw_point a = scene_point(s, s->segment[2 * i]), b = scene_point(s, s->segment[2 * i + 1]);
        if ((a.y > q.y) == (b.y > q.y)) continue;
        odd ^= points_turn(a, b, q) == (b.y > a.y ? 1 : -1);
    }
    return odd;
}

bool scene_inside_any(const constrained_scene *s, mw_point q)
{
    for (uint32_t i = 0; i < s->segments; i++)
        if (s->polygon[i] != MW_NONE && (i == 0 || s->polygon[i] != s->polygon[i - 1]) &&
            inside(s, s->polygon[i], q))
            return true;
    return false;
}

static bool any_polygon(const constrained_scene *s)
{
    for (uint32_t i = 0; i < s->segments; i++)
        if (s->polygon[i] != MW_NONE) return true;
    return false;
}

bool constrained_middle_of(const constrained_result *r, uint32_t t, mw_point *q)
{
    mw_point a = r->point[r->tri[t][0]], b = r->point[r->tri[t][1]], c = r->point[r->tri[t][2]];
    *q = (mw_point){a.x / 3 + b.x / 3 + c.x / 3, a.y / 3 + b.y / 3 + c.y / 3};
    return points_turn(a, b, *q) > 0 && points_turn(b, c, *q) > 0 && points_turn(c, a, *q) > 0;
}

static bool touches(const constrained_result *r, uint32_t t, mw_point q)
{
    mw_point a = r->point[r->tri[t][0]], b = r->point[r->tri[t][1]], c = r->point[r->tri[t][2]];
    return points_turn(a, b, q) >= 0 && points_turn(b, c, q) >= 0 && points_turn(c, a, q) >= 0;
}

/* Label what hangs together between pieces; label 0 hangs together with the outside. */
static uint32_t *label_parts(const constrained_result *r)
{
    uint32_t *label = malloc((r->count + 1) * sizeof *label);
    for (uint32_t t = 0; t < r->count; t++) label[t] = t + 1;
    for (bool changed = true; changed;) {
        changed = false;
        for (size_t i = 0; i < 3 * (size_t)r->count; i++) {
            constrained_edge *e = &r->edge[i], *twin = twin_of(r, e);
            if (e->piece != MW_NONE || (i > 0 && twin_of(r, e - 1) == e)) continue;
            uint32_t outside = 0, *a = &label[e->triangle],
                     *b = twin ? &label[twin->triangle] : &outside;
            if (*a == *b) continue;
            *a = *b = *a < *b ? *a : *b;
            changed = true;
        }
    }
    return label;
}

/* Which triangles of the whole hull are to be kept? 2: brute force cannot say. */
static uint8_t *expected_kept(const constrained_scene *s, const constrained_result *hull)
{
    uint8_t *kept = malloc(hull->count + 1);
    uint32_t *label = label_parts(hull);
    bool polygons = any_polygon(s);
    for (uint32_t t = 0; t < hull->count; t++) {
        mw_point q;
        kept[t] = !polygons                            ? label[t] != 0
                  : constrained_middle_of(hull, t, &q) ? scene_inside_any(s, q)
                                                       : 2;
    }
    for (uint32_t h = 0; h < s->holes; h++)
        for (uint32_t t = 0; t < hull->count; t++) {
            if (!touches(hull, t, (mw_point){s->hole[2 * h], s->hole[2 * h + 1]})) continue;
            for (uint32_t u = 0; u < hull->count; u++)
                if (label[u] == label[t]) kept[u] = 0;
        }
    free(label);
    return kept;
}

bool constrained_has_triangle(const constrained_result *r, const uint32_t v[3])
{
    for (int k = 0; k < 3; k++) {
        constrained_edge *e = constrained_find_edge(r, v[k], v[(k + 1) % 3]),
                         *twin = e ? twin_of(r, e) : NULL;
        uint32_t apex = v[(k + 2) % 3];
        if (!e || !(e->apex == apex || (twin && twin->apex == apex))) return false;
    }
    return true;
}

/* What is kept is a part of the whole triangulation, the expected one. */
static void assert_kept(const constrained_scene *s, const constrained_result *hull, int split)
{
    uint8_t *kept = expected_kept(s, hull);
    uint32_t count = 0, unknown = 0;
    for (uint32_t t = 0; t < hull->count; t++) {
        count += kept[t] == 1;
        unknown += kept[t] == 2;
    }
    constrained_result r = constrained_run(s, MW_KEEP_INSIDE, split);
    if (count + unknown == 0) {
        assert_int_equal(r.status, MW_ERROR_INPUT);
    } else if (r.status != MW_OK) {
        assert_int_equal(count, 0);
    } else {
        constrained_assert_sound(s, &r);
        assert_in_range(r.count, count, count + unknown);
        assert_int_equal(r.count + r.report.triangles_removed, hull->count);
        for (uint32_t t = 0; t < hull->count; t++)
            if (kept[t] != 2) assert_int_equal(constrained_has_triangle(&r, hull->tri[t]), kept[t]);
        constrained_result chosen = constrained_run(s, MW_KEEP_AUTO, split);
        assert_int_equal(chosen.count, any_polygon(s) || s->holes ? r.count : hull->count);
        constrained_release(&chosen);
    }
    constrained_release(&r);
    free(kept);
}

void constrained_check(const constrained_scene *s)
{
    constrained_result r = constrained_run(s, MW_KEEP_HULL, 0);
    if (r.status) fprintf(stderr, "%s\n", r.error.message);
    constrained_assert_sound(s, &r);
    constrained_assert_fills_hull(s, &r);
    assert_forced(s, &r);
    assert_int_equal(r.report.crossing_segments[0], MW_NONE);
    assert_kept(s, &r, 0);
    constrained_release(&r);
}

double points_distance(mw_point a, mw_point b, mw_point p)
{
    double dx = b.x - a.x, dy = b.y - a.y, l = dx * dx + dy * dy;
    double t = l > 0 ? fmax(0, fmin(1, ((p.x - a.x) * dx + (p.y - a.y) * dy) / l)) : 0;
    return hypot(p.x - a.x - t * dx, p.y - a.y - t * dy);
}

/* Pieces lead from the beginning of the segment to its end, near it all the way: those that are
 * called its own in their direction, those that it shares with lower ones in any. */
static void assert_led(const constrained_scene *s, const constrained_result *r, uint32_t segment,
                       double tolerance)
{
    uint32_t from = s->segment[2 * segment], to = s->segment[2 * segment + 1];
    mw_point a = scene_point(s, from), b = scene_point(s, to);
    if (r->duplicate_of[from] != MW_NONE) from = r->duplicate_of[from];
    if (r->duplicate_of[to] != MW_NONE) to = r->duplicate_of[to];
    uint8_t *reached = calloc(r->n, 1);
    reached[from] = 1;
    for (bool changed = true; changed && !reached[to];) {
        changed = false;
        for (size_t i = 0; i < r->pieces.count; i++) {
            uint32_t u = r->pieces.edge[2 * i], v = r->pieces.edge[2 * i + 1];
            if (reached[u] == reached[v] || r->pieces.segment[i] > segment) continue;
            if (reached[v] && r->pieces.segment[i] == segment) continue;
            uint32_t next = reached[u] ? v : u;
            if (points_distance(a, b, r->point[next]) > tolerance) continue;
            reached[next] = 1;
            changed = true;
        }
    }
    assert_true(reached[to]);
    free(reached);
}

size_t constrained_check_split(const constrained_scene *s, double tolerance)
{
    constrained_result r = constrained_run(s, MW_KEEP_HULL, 1);
    if (r.status) fprintf(stderr, "%s\n", r.error.message);
    constrained_assert_sound(s, &r);
    constrained_assert_fills_hull(s, &r);
    for (uint32_t i = 0; i < s->segments; i++) assert_led(s, &r, i, tolerance);
    uint8_t *is_end = calloc(r.n, 1);
    for (size_t i = 0; i < 2 * r.pieces.count; i++) is_end[r.pieces.edge[i]] = 1;
    for (uint32_t i = 0; i < s->segments; i++)
        for (uint32_t v = 0; v < s->points; v++)
            if (point_lies_on(scene_point(s, s->segment[2 * i]),
                              scene_point(s, s->segment[2 * i + 1]), r.point[v]) &&
                !points_equal(scene_point(s, s->segment[2 * i]),
                              scene_point(s, s->segment[2 * i + 1])))
                assert_true(is_end[v] || r.duplicate_of[v] != MW_NONE);
    free(is_end);
    for (uint32_t v = s->points; v < r.n; v++) { /* made where two segments are near */
        uint32_t near = 0;
        for (uint32_t i = 0; i < s->segments; i++)
            near += points_distance(scene_point(s, s->segment[2 * i]),
                                    scene_point(s, s->segment[2 * i + 1]), r.point[v]) <= tolerance;
        assert_true(near >= 2);
    }
    size_t added = r.report.vertices_added;
    constrained_release(&r);
    return added;
}
