/* Constrained triangulations: every result is taken apart exactly. Its segments are chains of
 * edges, its other edges are locally Delaunay, it fills the hull once, and what is kept of it is
 * what brute force keeps. */
/* wrap: malloc calloc realloc aligned_alloc */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include <math.h>
#include <meshwalk/meshwalk.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/random.h"
#include "predicates/predicates.h"
#include "support/allocations.h"

enum { MAX_POINTS = 4000, MAX_SEGMENTS = 8000, MAX_HOLES = 64 };

/* --- what is given --- */

typedef struct constrained_scene {
    double point[2 * MAX_POINTS];
    uint32_t segment[2 * MAX_SEGMENTS], polygon[MAX_SEGMENTS];
    double hole[2 * MAX_HOLES];
    uint32_t points, segments, holes;
    uint64_t random;
} constrained_scene;

static constrained_scene scenes[1]; /* large: not on the stack */

static constrained_scene *new_scene(uint64_t seed)
{
    memset(scenes, 0, sizeof scenes);
    scenes->random = seed;
    return scenes;
}

static uint32_t add_point(constrained_scene *s, double x, double y)
{
    assert_true(s->points < MAX_POINTS);
    s->point[2 * s->points] = x;
    s->point[2 * s->points + 1] = y;
    return s->points++;
}

static void add_segment(constrained_scene *s, uint32_t a, uint32_t b, uint32_t polygon)
{
    assert_true(s->segments < MAX_SEGMENTS);
    s->segment[2 * s->segments] = a;
    s->segment[2 * s->segments + 1] = b;
    s->polygon[s->segments++] = polygon;
}

static void add_line(constrained_scene *s, double x0, double y0, double x1, double y1)
{
    uint32_t a = add_point(s, x0, y0), b = add_point(s, x1, y1);
    add_segment(s, a, b, MW_NONE);
}

static void add_ring(constrained_scene *s, uint32_t n, const double *xy, uint32_t polygon)
{
    uint32_t first = s->points;
    for (uint32_t i = 0; i < n; i++) add_point(s, xy[2 * i], xy[2 * i + 1]);
    for (uint32_t i = 0; i < n; i++) add_segment(s, first + i, first + (i + 1) % n, polygon);
}

static void add_box(constrained_scene *s, double x0, double y0, double x1, double y1,
                    uint32_t polygon)
{
    add_ring(s, 4, (double[]){x0, y0, x1, y0, x1, y1, x0, y1}, polygon);
}

static void add_hole(constrained_scene *s, double x, double y)
{
    s->hole[2 * s->holes] = x;
    s->hole[2 * s->holes++ + 1] = y;
}

static double below(constrained_scene *s, uint32_t n)
{
    return mw__random_below(&s->random, n);
}

static double uniform(constrained_scene *s)
{
    return (double)(mw__random(&s->random) >> 11) * 0x1p-53;
}

static mw_constraints view(const constrained_scene *s)
{
    return (mw_constraints){.points = s->point,
                            .point_count = s->points,
                            .segments = s->segment,
                            .segment_count = s->segments,
                            .polygon = s->polygon,
                            .hole_seeds = s->hole,
                            .hole_seed_count = s->holes};
}

static mw_point given_point(const constrained_scene *s, uint32_t p)
{
    return (mw_point){s->point[2 * p], s->point[2 * p + 1]};
}

static int sign(double x)
{
    return (x > 0) - (x < 0);
}

static int turn(mw_point a, mw_point b, mw_point c)
{
    return sign(mw__orient2d(a, b, c));
}

static bool equal(mw_point a, mw_point b)
{
    return a.x == b.x && a.y == b.y;
}

static bool cross(mw_point a, mw_point b, mw_point c, mw_point d)
{
    return turn(a, b, c) * turn(a, b, d) < 0 && turn(c, d, a) * turn(c, d, b) < 0;
}

/* Does p lie on the segment ab, its ends included? */
static bool lies_on(mw_point a, mw_point b, mw_point p)
{
    return turn(a, b, p) == 0 && p.x >= fmin(a.x, b.x) && p.x <= fmax(a.x, b.x) &&
           p.y >= fmin(a.y, b.y) && p.y <= fmax(a.y, b.y);
}

static bool crosses_any(const constrained_scene *s, uint32_t a, uint32_t b)
{
    for (uint32_t i = 0; i < s->segments; i++)
        if (cross(given_point(s, a), given_point(s, b), given_point(s, s->segment[2 * i]),
                  given_point(s, s->segment[2 * i + 1])))
            return true;
    return false;
}

static void add_random_segments(constrained_scene *s, uint32_t tries)
{
    for (uint32_t i = 0; i < tries; i++) {
        uint32_t a = mw__random_below(&s->random, s->points),
                 b = mw__random_below(&s->random, s->points);
        if (!crosses_any(s, a, b)) add_segment(s, a, b, MW_NONE);
    }
}

/* --- what is made --- */

typedef struct edge {
    uint32_t low, high, triangle, apex, piece;
} edge;

typedef struct result {
    mw_status status;
    mw_error error;
    mw_constrain_report report;
    mw_constrained_edges pieces;
    mw_mesh *mesh;
    uint32_t n, count;
    mw_point *point;
    uint32_t (*tri)[3];
    edge *edge; /* half-edges, sorted */
    uint32_t *duplicate_of;
} result;

static int compare_edges(const void *left, const void *right)
{
    const edge *a = left, *b = right;
    if (a->low != b->low) return a->low < b->low ? -1 : 1;
    if (a->high != b->high) return a->high < b->high ? -1 : 1;
    return a->triangle < b->triangle ? -1 : a->triangle > b->triangle;
}

/* The first half-edge between two vertices, NULL if they are not joined. */
static edge *find_edge(const result *r, uint32_t a, uint32_t b)
{
    uint32_t low = a < b ? a : b, high = a < b ? b : a;
    size_t first = 0, last = 3 * (size_t)r->count;
    while (first < last) {
        size_t middle = (first + last) / 2;
        const edge *e = &r->edge[middle];
        if (e->low < low || (e->low == low && e->high < high))
            first = middle + 1;
        else
            last = middle;
    }
    if (first == 3 * (size_t)r->count || r->edge[first].low != low || r->edge[first].high != high)
        return NULL;
    return &r->edge[first];
}

static edge *twin_of(const result *r, edge *e)
{
    return e + 1 < r->edge + 3 * (size_t)r->count && e[1].low == e->low && e[1].high == e->high
               ? e + 1
               : NULL;
}

static void list_edges(result *r)
{
    for (uint32_t t = 0; t < r->count; t++)
        for (uint32_t k = 0; k < 3; k++) {
            uint32_t a = r->tri[t][k], b = r->tri[t][(k + 1) % 3];
            r->edge[3 * t + k] =
                (edge){a < b ? a : b, a < b ? b : a, t, r->tri[t][(k + 2) % 3], MW_NONE};
        }
    qsort(r->edge, 3 * (size_t)r->count, sizeof *r->edge, compare_edges);
    for (uint32_t i = 0; i < r->pieces.count; i++) {
        edge *e = find_edge(r, r->pieces.edge[2 * i], r->pieces.edge[2 * i + 1]);
        assert_non_null(e);
        assert_int_equal(e->piece, MW_NONE); /* each piece is listed once */
        e->piece = i;
        if (twin_of(r, e)) twin_of(r, e)->piece = i;
    }
}

static result run(const constrained_scene *s, mw_keep keep, int split)
{
    result r = {.duplicate_of = malloc((s->points + 1) * sizeof(uint32_t))};
    mw_constraints given = view(s);
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

static void release(result *r)
{
    mw_constrained_edges_release(&r->pieces);
    mw_mesh_destroy(r->mesh);
    free(r->point);
    free(r->tri);
    free(r->edge);
    free(r->duplicate_of);
}

/* --- checks --- */

/* Triangles turn left, neighbours are linked, no edge has three; but at pieces they are locally
 * Delaunay. */
static void assert_sound(const constrained_scene *s, const result *r)
{
    assert_int_equal(r->status, MW_OK);
    assert_int_equal(r->n, s->points + r->report.vertices_added);
    assert_int_equal(r->pieces.count, r->report.constrained_edges);
    for (uint32_t v = 0; v < s->points; v++) assert_true(equal(r->point[v], given_point(s, v)));
    for (uint32_t t = 0; t < r->count; t++) {
        const uint32_t *v = r->tri[t];
        mw_point p[3] = {r->point[v[0]], r->point[v[1]], r->point[v[2]]};
        assert_int_equal(turn(p[0], p[1], p[2]), 1);
        for (unsigned k = 0; k < 3; k++) {
            edge *e = find_edge(r, v[k], v[(k + 1) % 3]), *twin = twin_of(r, e);
            if (twin) assert_null(twin_of(r, twin));
            const edge *other = !twin ? NULL : e->triangle == t ? twin : e;
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

/* The border is that of the hull, and there are as many triangles as it takes to fill that once. */
static void assert_fills_hull(const constrained_scene *s, const result *r)
{
    uint32_t border = 0, used = 0;
    for (size_t i = 0; i < 3 * (size_t)r->count; i++) {
        edge *e = &r->edge[i];
        if (twin_of(r, e) || (i > 0 && twin_of(r, e - 1) == e)) continue;
        border++;
        int inner = turn(r->point[e->low], r->point[e->high], r->point[e->apex]);
        for (uint32_t v = 0; v < r->n; v++)
            assert_true(turn(r->point[e->low], r->point[e->high], r->point[v]) * inner >= 0);
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
static void assert_forced(const constrained_scene *s, const result *r)
{
    uint32_t *on = malloc((r->n + 1) * sizeof *on);
    uint32_t *lowest = malloc((r->pieces.count + 1) * sizeof *lowest);
    for (size_t i = 0; i < r->pieces.count; i++) lowest[i] = MW_NONE;
    for (uint32_t i = 0; i < s->segments; i++) {
        mw_point a = given_point(s, s->segment[2 * i]), b = given_point(s, s->segment[2 * i + 1]);
        uint32_t count = 0;
        for (uint32_t v = 0; v < s->points; v++)
            if (r->duplicate_of[v] == MW_NONE && lies_on(a, b, r->point[v])) on[count++] = v;
        sorted_points = r->point;
        qsort(on, count, sizeof *on, compare_points);
        for (uint32_t k = 0; k + 1 < count && !equal(a, b); k++) {
            const edge *e = find_edge(r, on[k], on[k + 1]);
            assert_non_null(e);
            assert_int_not_equal(e->piece, MW_NONE);
            if (i < lowest[e->piece]) lowest[e->piece] = i;
        }
    }
    for (size_t i = 0; i < r->pieces.count; i++) {
        assert_int_equal(lowest[i], r->pieces.segment[i]);
        mw_point a = given_point(s, s->segment[2 * lowest[i]]),
                 b = given_point(s, s->segment[2 * lowest[i] + 1]);
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
        mw_point a = given_point(s, s->segment[2 * i]), b = given_point(s, s->segment[2 * i + 1]);
        if ((a.y > q.y) == (b.y > q.y)) continue;
        odd ^= turn(a, b, q) == (b.y > a.y ? 1 : -1);
    }
    return odd;
}

static bool inside_any(const constrained_scene *s, mw_point q)
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

/* A place strictly inside triangle t; false where rounding finds none. */
static bool middle_of(const result *r, uint32_t t, mw_point *q)
{
    mw_point a = r->point[r->tri[t][0]], b = r->point[r->tri[t][1]], c = r->point[r->tri[t][2]];
    *q = (mw_point){a.x / 3 + b.x / 3 + c.x / 3, a.y / 3 + b.y / 3 + c.y / 3};
    return turn(a, b, *q) > 0 && turn(b, c, *q) > 0 && turn(c, a, *q) > 0;
}

static bool touches(const result *r, uint32_t t, mw_point q)
{
    mw_point a = r->point[r->tri[t][0]], b = r->point[r->tri[t][1]], c = r->point[r->tri[t][2]];
    return turn(a, b, q) >= 0 && turn(b, c, q) >= 0 && turn(c, a, q) >= 0;
}

/* Label what hangs together between pieces; label 0 hangs together with the outside. */
static uint32_t *label_parts(const result *r)
{
    uint32_t *label = malloc((r->count + 1) * sizeof *label);
    for (uint32_t t = 0; t < r->count; t++) label[t] = t + 1;
    for (bool changed = true; changed;) {
        changed = false;
        for (size_t i = 0; i < 3 * (size_t)r->count; i++) {
            edge *e = &r->edge[i], *twin = twin_of(r, e);
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
static uint8_t *expected_kept(const constrained_scene *s, const result *hull)
{
    uint8_t *kept = malloc(hull->count + 1);
    uint32_t *label = label_parts(hull);
    bool polygons = any_polygon(s);
    for (uint32_t t = 0; t < hull->count; t++) {
        mw_point q;
        kept[t] = !polygons ? label[t] != 0 : middle_of(hull, t, &q) ? inside_any(s, q) : 2;
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

static bool has_triangle(const result *r, const uint32_t v[3])
{
    for (int k = 0; k < 3; k++) {
        edge *e = find_edge(r, v[k], v[(k + 1) % 3]), *twin = e ? twin_of(r, e) : NULL;
        uint32_t apex = v[(k + 2) % 3];
        if (!e || !(e->apex == apex || (twin && twin->apex == apex))) return false;
    }
    return true;
}

/* What is kept is a part of the whole triangulation, the expected one. */
static void assert_kept(const constrained_scene *s, const result *hull, int split)
{
    uint8_t *kept = expected_kept(s, hull);
    uint32_t count = 0, unknown = 0;
    for (uint32_t t = 0; t < hull->count; t++) {
        count += kept[t] == 1;
        unknown += kept[t] == 2;
    }
    result r = run(s, MW_KEEP_INSIDE, split);
    if (count + unknown == 0) {
        assert_int_equal(r.status, MW_ERROR_INPUT);
    } else if (r.status != MW_OK) {
        assert_int_equal(count, 0);
    } else {
        assert_sound(s, &r);
        assert_in_range(r.count, count, count + unknown);
        assert_int_equal(r.count + r.report.triangles_removed, hull->count);
        for (uint32_t t = 0; t < hull->count; t++)
            if (kept[t] != 2) assert_int_equal(has_triangle(&r, hull->tri[t]), kept[t]);
        result chosen = run(s, MW_KEEP_AUTO, split);
        assert_int_equal(chosen.count, any_polygon(s) || s->holes ? r.count : hull->count);
        release(&chosen);
    }
    release(&r);
    free(kept);
}

static void check(const constrained_scene *s)
{
    result r = run(s, MW_KEEP_HULL, 0);
    if (r.status) fprintf(stderr, "%s\n", r.error.message);
    assert_sound(s, &r);
    assert_fills_hull(s, &r);
    assert_forced(s, &r);
    assert_int_equal(r.report.crossing_segments[0], MW_NONE);
    assert_kept(s, &r, 0);
    release(&r);
}

/* How far p is from the segment ab, roughly. */
static double distance(mw_point a, mw_point b, mw_point p)
{
    double dx = b.x - a.x, dy = b.y - a.y, l = dx * dx + dy * dy;
    double t = l > 0 ? fmax(0, fmin(1, ((p.x - a.x) * dx + (p.y - a.y) * dy) / l)) : 0;
    return hypot(p.x - a.x - t * dx, p.y - a.y - t * dy);
}

/* Pieces lead from the beginning of the segment to its end, near it all the way: those that are
 * called its own in their direction, those that it shares with lower ones in any. */
static void assert_led(const constrained_scene *s, const result *r, uint32_t segment,
                       double tolerance)
{
    uint32_t from = s->segment[2 * segment], to = s->segment[2 * segment + 1];
    mw_point a = given_point(s, from), b = given_point(s, to);
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
            if (distance(a, b, r->point[next]) > tolerance) continue;
            reached[next] = 1;
            changed = true;
        }
    }
    assert_true(reached[to]);
    free(reached);
}

/* Returns how many points were made. */
static size_t check_split(const constrained_scene *s, double tolerance)
{
    result r = run(s, MW_KEEP_HULL, 1);
    if (r.status) fprintf(stderr, "%s\n", r.error.message);
    assert_sound(s, &r);
    assert_fills_hull(s, &r);
    for (uint32_t i = 0; i < s->segments; i++) assert_led(s, &r, i, tolerance);
    uint8_t *is_end = calloc(r.n, 1);
    for (size_t i = 0; i < 2 * r.pieces.count; i++) is_end[r.pieces.edge[i]] = 1;
    for (uint32_t i = 0; i < s->segments; i++)
        for (uint32_t v = 0; v < s->points; v++)
            if (lies_on(given_point(s, s->segment[2 * i]), given_point(s, s->segment[2 * i + 1]),
                        r.point[v]) &&
                !equal(given_point(s, s->segment[2 * i]), given_point(s, s->segment[2 * i + 1])))
                assert_true(is_end[v] || r.duplicate_of[v] != MW_NONE);
    free(is_end);
    for (uint32_t v = s->points; v < r.n; v++) { /* made where two segments are near */
        uint32_t near = 0;
        for (uint32_t i = 0; i < s->segments; i++)
            near += distance(given_point(s, s->segment[2 * i]),
                             given_point(s, s->segment[2 * i + 1]), r.point[v]) <= tolerance;
        assert_true(near >= 2);
    }
    size_t added = r.report.vertices_added;
    release(&r);
    return added;
}

/* --- tests --- */

/* Points of a small grid, on lines and circles, some at one place, with any segments that do not
 * cross. */
static void test_grids(void **state)
{
    (void)state;
    uint64_t seed = 11;
    print_message("seed %llu\n", (unsigned long long)seed);
    for (int round = 0; round < 700; round++) {
        constrained_scene *s = new_scene(seed + (uint64_t)round);
        static const double scales[] = {1, 1, 1e-3, 0x1p-1000, 1e-300, 0x1p1000, 1e300};
        double scale = scales[round % 7], offset = round % 7 == 1 ? 1e6 : 0;
        uint32_t grid = 3 + (uint32_t)below(s, 9), n = 5 + (uint32_t)below(s, 60);
        add_point(s, offset, offset);
        add_point(s, offset + scale * grid, offset);
        add_point(s, offset, offset + scale * grid);
        for (uint32_t i = 0; i < n; i++)
            add_point(s, offset + scale * below(s, grid), offset + scale * below(s, grid));
        add_random_segments(s, (uint32_t)below(s, 4 * n));
        if (round % 3 == 0)
            add_hole(s, offset + scale * below(s, grid), offset + scale * below(s, grid));
        if (round % 3 == 1)
            add_hole(s, offset + scale * grid * uniform(s), offset + scale * grid * uniform(s));
        check(s);
    }
}

static void test_uniform(void **state)
{
    (void)state;
    for (uint64_t round = 0; round < 8; round++) {
        constrained_scene *s = new_scene(100 + round);
        double offset = round % 2 ? 1e6 : 0;
        for (int i = 0; i < 300; i++) add_point(s, offset + uniform(s), offset + uniform(s));
        add_random_segments(s, 600);
        check(s);
    }
}

/* Long segments through many points, and many that all lie along one line. */
static void test_long(void **state)
{
    (void)state;
    constrained_scene *s = new_scene(3);
    uint32_t west = add_point(s, -1, 0.5), east = add_point(s, 2, 0.5 + 1e-9),
             low = add_point(s, -1, -2);
    uint32_t high = add_point(s, 2, 3);
    for (int i = 0; i < 2000; i++) add_point(s, uniform(s), uniform(s));
    add_segment(s, west, east, MW_NONE);
    add_segment(s, low, east, MW_NONE);
    add_segment(s, west, high, MW_NONE);
    check(s);
    s = new_scene(4);
    for (int i = 0; i < 40; i++) add_point(s, i, i % 2);
    for (uint32_t i = 0; i < 38; i += 2)
        for (uint32_t j = i + 2; j < 40; j += 2) add_segment(s, j, i, MW_NONE);
    check(s);
}

/* Fans of slivers: triangulations with vertices of a high degree, rims that run back along
 * themselves. */
static void test_fans(void **state)
{
    (void)state;
    constrained_scene *s = new_scene(5);
    uint32_t left = add_point(s, -1000, 0), right = add_point(s, 1000, 0.5);
    for (int i = 0; i < 300; i++) add_point(s, uniform(s) - 0.5, i - 150 + uniform(s) / 2);
    add_segment(s, left, right, MW_NONE);
    for (uint32_t i = 2; i < 60; i++)
        if (!crosses_any(s, left, i * 5)) add_segment(s, left, i * 5, MW_NONE);
    for (uint32_t i = 2; i < 60; i++)
        if (!crosses_any(s, right, i * 5 + 1)) add_segment(s, right, i * 5 + 1, MW_NONE);
    check(s);
}

static void test_polygons(void **state)
{
    (void)state;
    /* islands in holes, and a line in the hole; points everywhere */
    constrained_scene *s = new_scene(6);
    add_box(s, 0, 0, 90, 90, 7);
    add_box(s, 10, 10, 80, 80, 7);
    add_box(s, 20, 20, 70, 70, 7);
    add_box(s, 30, 30, 60, 60, 7);
    add_line(s, 12, 15, 17, 75);
    for (int i = 0; i < 400; i++) add_point(s, below(s, 300) - 100, below(s, 300) - 100);
    check(s);
    /* one inside another: their union; a box that shares a corner and a border; one given twice */
    s = new_scene(6);
    add_box(s, 0, 0, 90, 90, 4000000000u);
    add_box(s, 10, 10, 20, 20, 5);
    add_box(s, 90, 90, 100, 100, 1);
    add_box(s, 90, 30, 120, 60, 0);
    add_box(s, 200, 200, 210, 210, 9);
    add_box(s, 200, 200, 210, 210, 9);
    check(s);
}

/* Parcels: each shares its borders with its neighbours; some are left out, some drawn the other
 * way round. */
static void test_parcels(void **state)
{
    (void)state;
    for (uint64_t round = 0; round < 20; round++) {
        constrained_scene *s = new_scene(60 + round);
        enum { SIDE = 9 };
        for (int i = 0; i < SIDE * SIDE; i++)
            add_point(s, i % SIDE + (round % 2 ? uniform(s) / 3 : 0),
                      i / SIDE + (round % 2 ? uniform(s) / 3 : 0));
        for (uint32_t i = 0; i < (SIDE - 1) * (SIDE - 1); i++) {
            uint32_t a = i / (SIDE - 1) * SIDE + i % (SIDE - 1),
                     ring[5] = {a, a + 1, a + 1 + SIDE, a + SIDE, a};
            if (below(s, 4) == 0) continue;
            bool back = below(s, 2) > 0;
            for (uint32_t k = 0; k < 4; k++)
                add_segment(s, ring[back ? k + 1 : k], ring[back ? k : k + 1], i);
        }
        for (int i = 0; i < 100; i++) add_point(s, SIDE * uniform(s), SIDE * uniform(s));
        check(s);
        add_hole(s, SIDE * uniform(s), SIDE * uniform(s));
        add_hole(s, s->point[0], s->point[1]);
        check(s);
    }
}

/* Rings that touch themselves and others in vertices, at a vertex inside an edge too. */
static void test_touching(void **state)
{
    (void)state;
    constrained_scene *s = new_scene(8);
    /* a bow tie that meets in the middle */
    add_ring(s, 6, (double[]){0, 0, 4, 4, 8, 0, 8, 8, 4, 4, 0, 8}, 0);
    check(s);
    s = new_scene(8);
    add_box(s, 0, 0, 12, 12, 0);
    add_ring(s, 3, (double[]){0, 6, 4, 4, 4, 8}, 0); /* a hole touches the outline inside an edge */
    add_ring(s, 3, (double[]){4, 4, 8, 2, 8, 4}, 0); /* and another hole in a vertex              */
    add_ring(s, 4, (double[]){6, 8, 10, 8, 10, 10, 6, 10}, 0);
    /* the hole of one is another polygon */
    add_ring(s, 4, (double[]){6, 8, 10, 8, 10, 10, 6, 10}, 1);
    check(s);
}

/* Without polygons: what no segment parts from the outside goes, what holes reach too, and lines
 * that end anywhere part nothing. */
static void test_flood(void **state)
{
    (void)state;
    for (uint64_t round = 0; round < 6; round++) {
        constrained_scene *s = new_scene(80 + round);
        add_box(s, 0, 0, 90, 90, MW_NONE);
        add_box(s, 10, 10, 40, 40, MW_NONE);
        add_box(s, 50, 50, 80, 80, MW_NONE);
        add_line(s, 45, 5, 45, 85);
        for (int i = 0; i < 50; i++) add_point(s, below(s, 150) - 30, below(s, 150) - 30);
        if (round & 1) add_hole(s, 20, 20);
        if (round & 2) add_hole(s, 1000, 5); /* outside: nothing */
        if (round & 4) add_hole(s, 50, 60);  /* on a constraint: both sides of it */
        check(s);
    }
}

/* Of the triangles whose middle is not near a segment, those inside polygons are kept. */
static void assert_far_kept(const constrained_scene *s, const result *hull, const result *r,
                            double near)
{
    for (uint32_t t = 0; t < hull->count; t++) {
        mw_point q;
        if (!middle_of(hull, t, &q)) continue;
        bool far = true;
        for (uint32_t i = 0; i < s->segments; i++)
            far &= distance(given_point(s, s->segment[2 * i]),
                            given_point(s, s->segment[2 * i + 1]), q) >= near;
        if (far) assert_int_equal(has_triangle(r, hull->tri[t]), inside_any(s, q));
    }
}

/* Random triangles on a grid as polygons, that cross, overlap, coincide: split. Coordinates are
 * rounded, so brute force is asked only away from borders. */
static void test_union(void **state)
{
    (void)state;
    for (uint64_t round = 0; round < 60; round++) {
        constrained_scene *s = new_scene(200 + round);
        for (uint32_t i = 0; i < 12; i++) {
            double xy[6];
            for (int k = 0; k < 6; k++) xy[k] = below(s, 40);
            add_ring(s, 3, xy, i / 2);
        }
        result hull = run(s, MW_KEEP_HULL, 1), r = run(s, MW_KEEP_INSIDE, 1);
        assert_sound(s, &hull);
        assert_sound(s, &r);
        assert_far_kept(s, &hull, &r, 1e-9);
        release(&hull);
        release(&r);
    }
}

static void test_crossing_is_told(void **state)
{
    (void)state;
    constrained_scene *s = new_scene(0);
    add_point(s, 5, 5);
    add_line(s, 0, 0, 10, 9);
    add_line(s, 0, 10, 10, 0);
    add_segment(s, 0, 3, MW_NONE);
    result r = run(s, MW_KEEP_HULL, 0);
    assert_int_equal(r.status, MW_ERROR_INPUT);
    assert_int_equal(r.report.crossing_segments[0], 0);
    assert_int_equal(r.report.crossing_segments[1], 1);
    assert_string_equal(r.error.message, "segments 0 (from point 1 to 2) and 1 (from point 3 to 4) "
                                         "cross near 5.26315789 4.73684211");
    release(&r);
    assert_int_equal(check_split(s, 1e-12), 1);
}

/* In general position there is one new point for each pair that crosses. */
static void test_split_counts(void **state)
{
    (void)state;
    for (uint64_t round = 0; round < 40; round++) {
        constrained_scene *s = new_scene(300 + round);
        double offset = round % 2 ? 1e6 : 0;
        uint32_t n = 5 + (uint32_t)below(s, 30), crossings = 0;
        for (uint32_t i = 0; i < n; i++) {
            uint32_t a = add_point(s, offset + uniform(s), offset + uniform(s));
            uint32_t b = add_point(s, offset + uniform(s), offset + uniform(s));
            for (uint32_t k = 0; k < s->segments; k++)
                crossings +=
                    cross(given_point(s, a), given_point(s, b), given_point(s, s->segment[2 * k]),
                          given_point(s, s->segment[2 * k + 1]));
            add_segment(s, a, b, MW_NONE);
        }
        for (int i = 0; i < 50; i++) add_point(s, offset + uniform(s), offset + uniform(s));
        size_t added = check_split(s, offset > 0 ? 1e-8 : 1e-14);
        if (offset == 0) assert_int_equal(added, crossings);
    }
}

/* All cross one long segment; all cross in one place; a grid of lines. */
static void test_split_many(void **state)
{
    (void)state;
    constrained_scene *s = new_scene(9);
    add_line(s, -1, 0, 101, 0.3);
    for (int i = 0; i < 100; i++) add_line(s, i + uniform(s), -1, i + uniform(s), 1);
    check_split(s, 1e-12);
    s = new_scene(9);
    for (int i = 0; i < 20; i++) {
        double angle = 0.157 * i + 0.05;
        add_line(s, cos(angle), sin(angle), -cos(angle), -sin(angle));
    }
    check_split(s, 1e-14);
    s = new_scene(9);
    for (int i = 1; i < 20; i++) {
        add_line(s, 0, i, 20, i);
        add_line(s, i, 0, i, 20);
    }
    assert_int_equal(check_split(s, 0), 361);
}

/* Few segments among many points, many of which lie on them. */
static void test_split_among(void **state)
{
    (void)state;
    for (uint64_t round = 0; round < 10; round++) {
        constrained_scene *s = new_scene(600 + round);
        enum { SIDE = 40, LINES = 20 };
        for (int i = 0; i < SIDE * SIDE; i++) add_point(s, i % SIDE, i / SIDE);
        for (int i = 0; i < LINES; i++) {
            uint32_t a = mw__random_below(&s->random, SIDE * SIDE),
                     b = mw__random_below(&s->random, SIDE * SIDE);
            add_segment(s, a, b, MW_NONE);
        }
        add_line(s, uniform(s), 3 * uniform(s), SIDE, SIDE * uniform(s));
        check_split(s, 1e-12);
    }
}

/* Segments among few doubles: where they cross there is no double near, or an end. */
static void test_split_tight(void **state)
{
    (void)state;
    for (uint64_t round = 0; round < 400; round++) {
        constrained_scene *s = new_scene(400 + round);
        double unit = round % 2 ? 0x1p-52 : 0x1p-1074, base = round % 2 ? 1 : 0;
        uint32_t cells = 2 + (uint32_t)below(s, 30), n = 3 + (uint32_t)below(s, 25);
        add_point(s, base, base);
        add_point(s, base + unit * cells, base);
        add_point(s, base, base + unit * cells);
        for (uint32_t i = 0; i < n; i++) {
            uint32_t a = add_point(s, base + unit * below(s, cells), base + unit * below(s, cells));
            uint32_t b = add_point(s, base + unit * below(s, cells), base + unit * below(s, cells));
            add_segment(s, a, b, MW_NONE);
        }
        result r = run(s, MW_KEEP_HULL, 1);
        if (r.status) fprintf(stderr, "%s\n", r.error.message);
        assert_sound(s, &r);
        assert_fills_hull(s, &r);
        release(&r);
    }
}

/* Parallel lines that cross at tiny angles, far off. */
static void test_split_shallow(void **state)
{
    (void)state;
    for (uint64_t round = 0; round < 40; round++) {
        constrained_scene *s = new_scene(500 + round);
        double scale = round % 4 == 0 ? 1e300 : round % 4 == 1 ? 1e-300 : round % 4 == 2 ? 1e6 : 1;
        add_point(s, 0, scale);
        for (int i = 0; i < 30; i++)
            add_line(s, 0, scale * uniform(s) * 1e-14, scale, scale * uniform(s) * 1e-14);
        result r = run(s, MW_KEEP_HULL, 1);
        if (r.status) fprintf(stderr, "%s\n", r.error.message);
        assert_sound(s, &r);
        assert_fills_hull(s, &r);
        release(&r);
    }
}

static void check_split_of(uint32_t n, const double *xy, uint32_t m, const uint32_t *segment,
                           double tolerance)
{
    constrained_scene *s = new_scene(0);
    for (uint32_t i = 0; i < n; i++) add_point(s, xy[2 * i], xy[2 * i + 1]);
    for (uint32_t i = 0; i < m; i++) add_segment(s, segment[2 * i], segment[2 * i + 1], MW_NONE);
    check_split(s, tolerance);
}

/* Long segments, nearly parallel: rounding moves each crossing past the next segment. */
static void test_split_close(void **state)
{
    (void)state;
    enum { Y = 5000000 };
    const double unit = 0x1p-30; /* the distance of doubles at Y */
    const double three[] = {1250816.0639249918, Y, 531171.4665219282,  Y + 4 * unit,
                            1303493.7280111513, Y, 816597.12245701486, Y + 6 * unit};
    check_split_of(4, three, 3, (const uint32_t[]){0, 3, 0, 1, 1, 2}, 4 * unit);
    const double others[] = {1238705.1289641492, Y,
                             1248737.949965422,  Y,
                             458771.71222629939, Y + 6 * unit,
                             609270.95347090648, Y + 14 * unit};
    check_split_of(4, others, 3, (const uint32_t[]){3, 0, 2, 0, 1, 2}, 4 * unit);
    const double many[] = {1283425.3194980419, Y,
                           1366677.5162477922, Y,
                           1030640.9006492354, 5266898.1642696485,
                           826911.96684861369, Y,
                           919228.86694196006, Y + 7 * unit,
                           911496.40165268898, Y,
                           477594.894757726,   Y,
                           471731.04780258331, Y,
                           931799.30658502644, Y + 23 * unit,
                           483990.44128173275, Y,
                           1166459.3102712967, Y + 3 * unit,
                           471082.46996141929, Y,
                           543830.71508661099, Y,
                           715319.25111099193, Y};
    const uint32_t segments[] = {13, 0, 10, 12, 6, 6,  9, 13, 11, 13, 8, 10, 9,
                                 5,  9, 10, 5,  8, 10, 3, 8,  12, 1,  4, 6,  2};
    check_split_of(14, many, 13, segments, 4 * unit);
}

/* Many sets of such segments: along the x axis, with some that lie across, and on a slope. */
static void test_split_nearly_parallel(void **state)
{
    (void)state;
    uint64_t seed = 700;
    print_message("seed %llu\n", (unsigned long long)seed);
    for (uint64_t round = 0; round < 600; round++) {
        constrained_scene *s = new_scene(seed + round);
        uint32_t n = 4 + (uint32_t)below(s, 20), units = 2 + (uint32_t)below(s, 20),
                 m = 3 + (uint32_t)below(s, 20);
        double slope = round % 3 == 2 ? uniform(s) : 0;
        add_point(s, 0, 0);
        for (uint32_t i = 0; i < n; i++) {
            double x = 4e5 + 1e6 * uniform(s), y = 5e6 + slope * x + 0x1p-30 * below(s, units);
            add_point(s, x, round % 3 == 1 && below(s, 4) == 0 ? 5e6 + 1e6 * uniform(s) : y);
        }
        for (uint32_t i = 0; i < m; i++)
            add_segment(s, 1 + (uint32_t)below(s, n), 1 + (uint32_t)below(s, n), MW_NONE);
        check_split(s, 8 * 0x1p-30);
    }
}

/* Triangles with one side along nearly the same line as those of the others: sides become one
 * chain, and what each of them bounds stays apart. */
static void test_union_close(void **state)
{
    (void)state;
    for (uint64_t round = 0; round < 100; round++) {
        constrained_scene *s = new_scene(1400 + round);
        for (uint32_t i = 0; i < 8; i++) {
            double xy[6];
            for (int k = 0; k < 6; k++)
                xy[k] = k % 2 == 0 ? 1e6 * uniform(s)
                        : k < 5    ? 5e6 + 0x1p-30 * below(s, 9)
                                   : 4e6 + 2e6 * uniform(s);
            add_ring(s, 3, xy, i / 2);
        }
        result hull = run(s, MW_KEEP_HULL, 1), r = run(s, MW_KEEP_INSIDE, 1);
        assert_sound(s, &hull);
        assert_sound(s, &r);
        assert_far_kept(s, &hull, &r, 1e-7);
        release(&hull);
        release(&r);
    }
}

/* A segment is led through a vertex that another one was led through before: its pieces still
 * follow one another. */
static void test_split_directions(void **state)
{
    (void)state;
    constrained_scene *s = new_scene(0);
    static const double cells[5][2] = {{0, 0}, {1, 0}, {2, 2}, {1, 2}, {0, 1}};
    for (int i = 0; i < 5; i++) add_point(s, 1 + 0x1p-52 * cells[i][0], 1 + 0x1p-52 * cells[i][1]);
    add_segment(s, 4, 1, MW_NONE);
    add_segment(s, 3, 0, MW_NONE);
    add_segment(s, 0, 2, MW_NONE);
    check_split(s, 0x1p-52);
    result r = run(s, MW_KEEP_HULL, 1);
    static const uint32_t pieces[2][2] = {{4, 0}, {0, 1}}; /* of the first segment */
    for (int i = 0; i < 2; i++) {
        const edge *e = find_edge(&r, pieces[i][0], pieces[i][1]);
        assert_non_null(e);
        assert_int_not_equal(e->piece, MW_NONE);
        assert_int_equal(r.pieces.segment[e->piece], 0);
        assert_int_equal(r.pieces.edge[2 * e->piece], pieces[i][0]);
    }
    release(&r);
}

static void expect(const constrained_scene *s, const mw_constraints *given,
                   mw_constrain_options options, mw_status status, const char *message)
{
    mw_constraints all = view(s);
    mw_mesh *mesh;
    mw_error error;
    mw_constrained_edges pieces;
    assert_int_equal(
        mw_constrained_delaunay(given ? given : &all, &options, NULL, NULL, &pieces, &mesh, &error),
        status);
    assert_null(mesh);
    assert_null(pieces.edge);
    assert_string_equal(error.message, message);
}

static void test_wrong_arguments(void **state)
{
    (void)state;
    constrained_scene *s = new_scene(0);
    mw_constrain_options none = {0}, inside_only = {.keep = MW_KEEP_INSIDE},
                         unknown = {.keep = (mw_keep)9};
    mw_error error;
    mw_mesh *mesh;
    assert_int_equal(mw_constrained_delaunay(NULL, NULL, NULL, NULL, NULL, &mesh, &error),
                     MW_ERROR_ARGUMENT);
    add_box(s, 0, 0, 1, 1, MW_NONE);
    mw_constraints given = view(s);
    assert_int_equal(mw_constrained_delaunay(&given, NULL, NULL, NULL, NULL, NULL, &error),
                     MW_ERROR_ARGUMENT);
    expect(s, NULL, unknown, MW_ERROR_ARGUMENT, "unknown choice of what to keep");
    given.stride = 1;
    expect(s, &given, none, MW_ERROR_ARGUMENT, "the stride must be at least 2 (x and y), not 1");
    given = view(s);
    given.segments = NULL;
    expect(s, &given, none, MW_ERROR_ARGUMENT, "arrays are missing");
    given = view(s);
    given.point_count = 3;
    expect(s, &given, none, MW_ERROR_ARGUMENT, "segment 2: 3 is not a point; there are 3");
    given.segment_count = 2;
    given.point_count = 3;
    assert_int_equal(mw_constrained_delaunay(&given, &none, NULL, NULL, NULL, &mesh, &error),
                     MW_OK);
    mw_mesh_destroy(mesh);
    expect(s, &given, inside_only, MW_ERROR_INPUT,
           "nothing is left: all 1 triangles are outside or in holes");
    s->polygon[0] = s->polygon[1] = 6;
    expect(s, &given, inside_only, MW_ERROR_INPUT,
           "polygon 6 is not closed: a ring ends at point 0");
    add_hole(s, NAN, 0);
    expect(s, NULL, none, MW_ERROR_ARGUMENT, "the point of hole 0 is not finite");
    s->holes = 0;
    s->point[3] = INFINITY;
    expect(s, NULL, none, MW_ERROR_INPUT, "point 1 is not finite");
    for (uint32_t i = 0; i < 4; i++) s->point[2 * i] = s->point[2 * i + 1] = i;
    expect(s, NULL, none, MW_ERROR_INPUT, "all 4 points lie on one line");
    mw_constrained_edges_release(NULL);
}

/* A stride, duplicates, and no segments at all. */
static void test_plain(void **state)
{
    (void)state;
    double points[] = {0, 0, 9, 1, 0, 9, 0, 0, 9, 1, 1, 9, 0, 1, 9};
    uint32_t segments[] = {3, 2, 2, 0}, duplicate_of[5];
    mw_constraints given = {
        .points = points, .point_count = 5, .stride = 3, .segments = segments, .segment_count = 2};
    mw_mesh *mesh;
    mw_constrain_report report;
    mw_constrained_edges pieces;
    assert_int_equal(
        mw_constrained_delaunay(&given, NULL, duplicate_of, &report, &pieces, &mesh, NULL), MW_OK);
    assert_int_equal(mw_mesh_triangle_count(mesh), 2);
    assert_int_equal(duplicate_of[2], 0);
    assert_int_equal(duplicate_of[3], MW_NONE);
    assert_int_equal(pieces.count, 1);
    assert_int_equal(pieces.edge[0], 3);
    assert_int_equal(pieces.edge[1], 0);
    assert_int_equal(report.delaunay.duplicates, 1);
    mw_constrained_edges_release(&pieces);
    mw_mesh_destroy(mesh);
    given.segment_count = 0;
    given.segments = NULL;
    assert_int_equal(mw_constrained_delaunay(&given, NULL, NULL, NULL, NULL, &mesh, NULL), MW_OK);
    mw_mesh_destroy(mesh);
}

/* The same in every run, and what is left out of the results makes no difference. */
static void test_repeatable(void **state)
{
    (void)state;
    constrained_scene *s = new_scene(12);
    for (int i = 0; i < 60; i++) add_line(s, uniform(s), uniform(s), uniform(s), uniform(s));
    result a = run(s, MW_KEEP_HULL, 1), b = run(s, MW_KEEP_HULL, 1);
    assert_int_equal(a.count, b.count);
    assert_memory_equal(a.tri, b.tri, a.count * sizeof *a.tri);
    assert_memory_equal(a.point, b.point, a.n * sizeof *a.point);
    assert_memory_equal(a.pieces.edge, b.pieces.edge, 2 * a.pieces.count * sizeof *a.pieces.edge);
    release(&a);
    release(&b);
    a = run(s, MW_KEEP_HULL, 0);
    b = run(s, MW_KEEP_HULL, 0);
    assert_string_equal(a.error.message, b.error.message);
    release(&a);
    release(&b);
}

/* A long segment through n points crosses of the order of sqrt(n) triangles; it is not counted
 * twice, nor is the whole triangulation looked at. */
static void test_crossed(void **state)
{
    (void)state;
    constrained_scene *s = new_scene(13);
    add_line(s, -1, 0.5, 2, 0.5);
    for (int i = 0; i < 3900; i++) add_point(s, uniform(s), uniform(s));
    result r = run(s, MW_KEEP_HULL, 0);
    assert_in_range(r.report.triangles_crossed, 60, 400);
    release(&r);
    /* what is crossed before the two are split counts, although nothing is in the end */
    s = new_scene(0);
    add_line(s, 0, 0, 4, 4);
    add_line(s, 0, 4, 4, 0);
    r = run(s, MW_KEEP_HULL, 1);
    assert_int_equal(r.report.triangles_crossed, 1);
    release(&r);
}

/* Every allocation fails once. */
static void test_memory(void **state)
{
    (void)state;
    constrained_scene *s = new_scene(14);
    add_box(s, 0, 0, 9, 9, 3);
    add_box(s, 1, 1, 4, 4, 3);
    add_line(s, -1, 5, 12, 7);
    for (int i = 0; i < 4; i++) add_line(s, -1 - i, 0, 10 + i, 0);
    for (int i = 0; i < 150; i++) add_point(s, 10 * uniform(s), 10 * uniform(s));
    add_hole(s, 8, 8);
    mw_constraints given = view(s);
    mw_constrain_options options = {.keep = MW_KEEP_INSIDE, .split = 1};
    long k = 0;
    for (mw_status status = MW_ERROR_MEMORY; status != MW_OK; k++) {
        mw_mesh *mesh;
        mw_constrained_edges pieces;
        allocations_left = k;
        status = mw_constrained_delaunay(&given, &options, NULL, NULL, &pieces, &mesh, NULL);
        allocations_left = -1;
        if (status == MW_OK) {
            mw_constrained_edges_release(&pieces);
            mw_mesh_destroy(mesh);
        } else {
            assert_int_equal(status, MW_ERROR_MEMORY);
            assert_null(mesh);
            assert_null(pieces.edge);
        }
    }
    assert_true(k > 30);
}

/* --- real data --- */

static FILE *open_shared(const char *name)
{
    char path[512];
    snprintf(path, sizeof path, "%s/domain/%s", MW_TEST_SHARED, name);
    return fopen(path, "r");
}

/* Two counts, points, pairs of their numbers. */
static bool read_pairs(constrained_scene *s, const char *name)
{
    FILE *file = open_shared(name);
    if (!file) return false;
    unsigned n, m;
    assert_int_equal(fscanf(file, "%u %u", &n, &m), 2);
    for (unsigned i = 0; i < n; i++) {
        double x, y;
        assert_int_equal(fscanf(file, "%lf %lf", &x, &y), 2);
        add_point(s, x, y);
    }
    for (unsigned i = 0; i < m; i++) {
        unsigned a, b;
        assert_int_equal(fscanf(file, "%u %u", &a, &b), 2);
        add_segment(s, a, b, MW_NONE);
    }
    fclose(file);
    return true;
}

/* One ring, a point per line. */
static bool read_ring(constrained_scene *s, const char *name)
{
    FILE *file = open_shared(name);
    if (!file) return false;
    for (double x, y; fscanf(file, "%lf %lf", &x, &y) == 2;) add_point(s, x, y);
    for (uint32_t i = 0; i < s->points; i++) add_segment(s, i, (i + 1) % s->points, 0);
    fclose(file);
    return true;
}

static void check_real(const constrained_scene *s, const char *name)
{
    bool crosses = false;
    for (uint32_t i = 0; i < s->segments && !crosses; i++)
        for (uint32_t k = 0; k < i && !crosses; k++)
            crosses =
                cross(given_point(s, s->segment[2 * i]), given_point(s, s->segment[2 * i + 1]),
                      given_point(s, s->segment[2 * k]), given_point(s, s->segment[2 * k + 1]));
    print_message("%s: %u points, %u segments%s\n", name, s->points, s->segments,
                  crosses ? ", that cross" : "");
    if (!crosses) {
        check(s);
        return;
    }
    result r = run(s, MW_KEEP_HULL, 0);
    assert_int_equal(r.status, MW_ERROR_INPUT);
    assert_int_not_equal(r.report.crossing_segments[0], MW_NONE);
    release(&r);
    check_split(s, 1e-6);
}

static void test_real(void **state)
{
    (void)state;
    static const char *const pairs[] = {
        "capital_a", "cdt",    "cdt_duplicates", "corner_cases",  "gh_issue",          "guitar",
        "island",    "kidney", "letter_u",       "lake_superior", "sweden_constrained"};
    static const char *const rings[] = {"bird",         "dude",     "kzer-za", "nazca_heron",
                                        "nazca_monkey", "sketchup", "tank"};
    for (size_t i = 0; i < sizeof pairs / sizeof *pairs; i++) {
        char name[64];
        snprintf(name, sizeof name, "%s.cdt.txt", pairs[i]);
        constrained_scene *s = new_scene(1);
        if (read_pairs(s, name)) check_real(s, name);
    }
    for (size_t i = 0; i < sizeof rings / sizeof *rings; i++) {
        char name[64];
        snprintf(name, sizeof name, "%s.dat", rings[i]);
        constrained_scene *s = new_scene(1);
        if (read_ring(s, name)) check_real(s, name);
    }
}

/* --- segments along one line ------------------------------------------------------------------ */

/* Segments between random points of a line, those of line y at y * (0, 1): many lie on one another.
 * Every edge along the line is owned by the lowest segment that covers it, in its direction. */
static void check_overlapping(uint32_t lines, uint32_t points, uint32_t per_line, double dx,
                              double dy, uint64_t *random)
{
    const uint32_t n = lines * points, segments = lines * per_line;
    double *p = malloc(2 * n * sizeof *p);
    uint32_t *s = malloc(2 * segments * sizeof *s), *lowest = malloc(n * sizeof *lowest);
    for (uint32_t i = 0; i < n; i++) {
        p[2 * i] = dx * (i % points);
        p[2 * i + 1] = dy * (i % points) + i / points;
        lowest[i] = MW_NONE;
    }
    for (uint32_t i = 0; i < segments; i++) {
        const uint32_t line = mw__random_below(random, lines);
        for (uint32_t k = 0; k < 2; k++)
            s[2 * i + k] = line * points + mw__random_below(random, points);
        const uint32_t a = s[2 * i], b = s[2 * i + 1];
        for (uint32_t v = a < b ? a : b; v < (a < b ? b : a) && points < 1000; v++)
            if (lowest[v] == MW_NONE) lowest[v] = i;
    }
    mw_constraints given = {
        .points = p, .point_count = n, .segments = s, .segment_count = segments};
    mw_constrained_edges edges;
    mw_mesh *mesh;
    mw_error error;
    if (mw_constrained_delaunay(&given, NULL, NULL, NULL, &edges, &mesh, &error))
        fail_msg("%s", error.message);
    for (size_t i = 0; i < edges.count && points < 1000; i++) {
        const uint32_t a = edges.edge[2 * i], b = edges.edge[2 * i + 1], low = a < b ? a : b,
                       *given_ends = &s[2 * edges.segment[i]];
        assert_int_equal(a < b ? b - a : a - b, 1);
        assert_int_equal(edges.segment[i], lowest[low]);
        assert_int_equal(a < b, given_ends[0] < given_ends[1]);
        lowest[low] = MW_NONE;
    }
    for (uint32_t v = 0; v < n && points < 1000; v++) assert_int_equal(lowest[v], MW_NONE);
    mw_constrained_edges_release(&edges);
    mw_mesh_destroy(mesh);
    free(p);
    free(s);
    free(lowest);
}

/* The last of them would list 10^9 pairs of a segment and an edge. */
static void test_overlapping(void **state)
{
    (void)state;
    uint64_t random = 5;
    for (int i = 0; i < 40; i++) {
        const double dx = mw__random_below(&random, 3) - 1.0, dy = 3 * dx;
        check_overlapping(2 + mw__random_below(&random, 3), 2 + mw__random_below(&random, 40),
                          mw__random_below(&random, 30), dx == 0 ? 1 : dx, dy, &random);
    }
    check_overlapping(2, 40000, 40000, 1, 1, &random);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_grids),
        cmocka_unit_test(test_uniform),
        cmocka_unit_test(test_long),
        cmocka_unit_test(test_fans),
        cmocka_unit_test(test_polygons),
        cmocka_unit_test(test_parcels),
        cmocka_unit_test(test_touching),
        cmocka_unit_test(test_overlapping),
        cmocka_unit_test(test_flood),
        cmocka_unit_test(test_union),
        cmocka_unit_test(test_crossing_is_told),
        cmocka_unit_test(test_split_counts),
        cmocka_unit_test(test_split_many),
        cmocka_unit_test(test_split_among),
        cmocka_unit_test(test_split_tight),
        cmocka_unit_test(test_split_shallow),
        cmocka_unit_test(test_split_close),
        cmocka_unit_test(test_split_nearly_parallel),
        cmocka_unit_test(test_union_close),
        cmocka_unit_test(test_split_directions),
        cmocka_unit_test(test_wrong_arguments),
        cmocka_unit_test(test_plain),
        cmocka_unit_test(test_repeatable),
        cmocka_unit_test(test_crossed),
        cmocka_unit_test(test_memory),
        cmocka_unit_test(test_real),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
