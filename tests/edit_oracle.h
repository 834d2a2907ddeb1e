/* edit_oracle.h - what an editor holds, kept a second time without it: the twin. It is brought up to date by what each edit reports to
 * have changed, and by nothing else; a full check then compares all that the editor tells with it, and holds the triangles
 * against geometry by brute force. Failures end the program and name the seed, the step and the edit. */
#ifndef MW_TEST_EDIT_ORACLE_H
#define MW_TEST_EDIT_ORACLE_H

#include <meshwalk/meshwalk.h>
#include <stdbool.h>

#include "meshes.h"
#include "oracle.h"
#include "predicate_oracle.h"

/* --- failures -------------------------------------------------------------------------------------------------------- */

static const char *case_name = "";
static uint64_t case_seed, case_step;
static mw_edit case_edit;

#define REQUIRE(right) ((right) ? (void)0 : require_failed(#right, __FILE__, __LINE__))

__attribute__((noreturn, noinline)) static void require_failed(const char *what, const char *file, int line)
{
    static const char *const kinds[] = {"insert", "remove", "move", "flip", "constrain", "release", "value"};
    const mw_edit *e = &case_edit;
    fprintf(stderr, "%s:%d: not so: %s\n%s, seed %llu, step %llu: %s %u %u, field %u, to %.17g %.17g, value %g\n", file,
            line, what, case_name, (unsigned long long)case_seed, (unsigned long long)case_step,
            (unsigned)e->kind < MW_EDIT_KIND_COUNT ? kinds[e->kind] : "?", e->vertex, e->other, e->field, e->x, e->y,
            e->value);
    abort();
}

static inline void *room(size_t count, size_t size)
{
    void *memory = calloc(count + 1, size);
    REQUIRE(memory != NULL);
    return memory;
}

static inline void *more_room(void *memory, size_t count, size_t size)
{
    memory = realloc(memory, (count + 1) * size);
    REQUIRE(memory != NULL);
    return memory;
}

/* --- exact geometry: in doubles with a bound that is far too large, else in integers of any size ----------------------- */

static inline int sign_of(double value)
{
    return (value > 0) - (value < 0);
}

static inline oracle *big_numbers(void)
{
    static oracle numbers;
    static bool ready;
    if (!ready) oracle_init(&numbers);
    ready = true;
    return &numbers;
}

static inline int exact_orient(const double *a, const double *b, const double *c)
{
    double left = (b[0] - a[0]) * (c[1] - a[1]), right = (b[1] - a[1]) * (c[0] - a[0]), sum = fabs(left) + fabs(right);
    if (sum > 1e-280 && sum < 1e280 && fabs(left - right) > 1e-14 * sum) return sign_of(left - right);
    const double p[6] = {a[0], a[1], b[0], b[1], c[0], c[1]};
    oracle_orient2d(big_numbers(), p);
    return oracle_sign(mpz_sgn(big_numbers()->result));
}

/* Is d in the circle of a, b, c, which turn left? */
static inline int exact_incircle(const double *a, const double *b, const double *c, const double *d)
{
    const double *corner[3] = {a, b, c};
    double x[3], y[3], sum = 0, size = 0;
    for (int i = 0; i < 3; i++) {
        x[i] = corner[i][0] - d[0];
        y[i] = corner[i][1] - d[1];
    }
    for (int i = 0; i < 3; i++) {
        int j = (i + 1) % 3, k = (i + 2) % 3;
        double lift = x[i] * x[i] + y[i] * y[i];
        sum += lift * (x[j] * y[k] - x[k] * y[j]);
        size += lift * (fabs(x[j] * y[k]) + fabs(x[k] * y[j]));
    }
    if (size > 1e-270 && size < 1e270 && fabs(sum) > 1e-13 * size) return sign_of(sum);
    const double p[8] = {a[0], a[1], b[0], b[1], c[0], c[1], d[0], d[1]};
    oracle_incircle(big_numbers(), p);
    return oracle_sign(mpz_sgn(big_numbers()->result));
}

/* Of three places on a line: is m strictly between a and b? */
static inline bool is_between(const double *a, const double *m, const double *b)
{
    return a[0] != b[0] ? (a[0] < m[0]) != (b[0] < m[0]) && m[0] != a[0] && m[0] != b[0]
                        : (a[1] < m[1]) != (b[1] < m[1]) && m[1] != a[1] && m[1] != b[1];
}

static inline bool is_on_segment(const double *a, const double *b, const double *q)
{
    return is_between(a, q, b) && exact_orient(a, b, q) == 0;
}

/* Do the insides of two segments cross in one point that is an end of neither? */
static inline bool is_crossing(const double *a, const double *b, const double *c, const double *d)
{
    return exact_orient(a, b, c) * exact_orient(a, b, d) < 0 && exact_orient(c, d, a) * exact_orient(c, d, b) < 0;
}

/* --- the twin ---------------------------------------------------------------------------------------------------------- */

enum { TWIN_FIELDS = 2 };
enum { IS_GONE, IS_ALONE, IS_USED }; /* a vertex that is not there; in no triangle; in some */

static const char *const twin_field[TWIN_FIELDS] = {"height", "mark"};

typedef struct twin {
    mw_editor *editor;
    uint32_t vertex_range, triangle_range, vertices, triangles;
    double *point;
    uint8_t *state;     /* of each vertex                                         */
    uint32_t *triangle; /* three vertices each; the first MW_NONE: it is gone     */
    uint32_t fields;    /* of the mesh: TWIN_FIELDS or none                       */
    double *value[TWIN_FIELDS];
    uint32_t *fixed; /* the constraints: two vertices each, the lower first    */
    size_t fixed_count;
    bool convex, delaunay;
    bool border_moved; /* a vertex of a border that is fixed was moved           */
    double *border;    /* the straight parts of such a border, x y to x y, sorted */
    size_t border_count;
    mw_mesh *first; /* the mesh that the editor was made from, and a locator of it */
    mw_locator *first_locator;
    bool shared; /* a copy: first and first_locator are another's                */
} twin;

static inline const double *at(const twin *t, uint32_t v)
{
    return t->point + 2 * (size_t)v;
}

static inline const uint32_t *corners_of(const twin *t, uint32_t k)
{
    return t->triangle + 3 * (size_t)k;
}

static inline bool is_there(const twin *t, uint32_t k)
{
    return k < t->triangle_range && corners_of(t, k)[0] != MW_NONE;
}

static inline bool is_used(const twin *t, uint32_t v)
{
    return v < t->vertex_range && t->state[v] == IS_USED;
}

static inline int turn_of(const twin *t, uint32_t k)
{
    const uint32_t *v = corners_of(t, k);
    return exact_orient(at(t, v[0]), at(t, v[1]), at(t, v[2]));
}

/* A directed edge of a triangle, which lies on its left. */
typedef struct side {
    uint32_t from, to, apex, triangle;
} side;

static inline int by_ends(const void *left, const void *right)
{
    const side *a = left, *b = right;
    if (a->from != b->from) return a->from < b->from ? -1 : 1;
    return a->to < b->to ? -1 : a->to > b->to;
}

static inline side side_of(const twin *t, uint32_t triangle, int turn, int k)
{
    const uint32_t *v = corners_of(t, triangle);
    side s = {v[k], v[(k + 1) % 3], v[(k + 2) % 3], triangle};
    return turn > 0 ? s : (side){s.to, s.from, s.apex, triangle};
}

/* All sides, sorted; each triangle has an area, and no edge has two triangles on one side. */
static inline side *all_sides(const twin *t, size_t *count)
{
    side *sides = room(3 * (size_t)t->triangles, sizeof *sides);
    *count = 0;
    for (uint32_t k = 0; k < t->triangle_range; k++) {
        if (!is_there(t, k)) continue;
        int turn = turn_of(t, k);
        REQUIRE(turn != 0);
        REQUIRE(*count < 3 * (size_t)t->triangles);
        for (int e = 0; e < 3; e++) sides[(*count)++] = side_of(t, k, turn, e);
    }
    REQUIRE(*count == 3 * (size_t)t->triangles);
    qsort(sides, *count, sizeof *sides, by_ends);
    for (size_t i = 1; i < *count; i++) REQUIRE(by_ends(&sides[i - 1], &sides[i]) < 0);
    return sides;
}

static inline const side *find_side(const side *sides, size_t count, uint32_t from, uint32_t to)
{
    side key = {.from = from, .to = to};
    return bsearch(&key, sides, count, sizeof *sides, by_ends);
}

/* --- constraints --------------------------------------------------------------------------------------------------------- */

static inline size_t fixed_index(const twin *t, uint32_t a, uint32_t b)
{
    size_t i = 0;
    while (i < t->fixed_count && !(t->fixed[2 * i] == (a < b ? a : b) && t->fixed[2 * i + 1] == (a < b ? b : a))) i++;
    return i;
}

static inline bool is_fixed(const twin *t, uint32_t a, uint32_t b)
{
    return fixed_index(t, a, b) < t->fixed_count;
}

static inline void fix(twin *t, uint32_t a, uint32_t b)
{
    if (is_fixed(t, a, b)) return;
    t->fixed = more_room(t->fixed, 2 * (t->fixed_count + 1), sizeof *t->fixed);
    t->fixed[2 * t->fixed_count] = a < b ? a : b;
    t->fixed[2 * t->fixed_count++ + 1] = a < b ? b : a;
}

static inline void unfix(twin *t, uint32_t a, uint32_t b)
{
    size_t i = fixed_index(t, a, b);
    REQUIRE(i < t->fixed_count);
    t->fixed_count--;
    memcpy(t->fixed + 2 * i, t->fixed + 2 * t->fixed_count, 2 * sizeof *t->fixed);
}

/* --- the border of a mesh that does not fill its hull: straight parts, whatever vertices lie inside them ------------------- */

typedef struct border_vertex {
    uint32_t in, out, before, after; /* edges of the border that end and begin here, and one neighbour each */
} border_vertex;

static inline border_vertex *border_vertices(const twin *t, const side *sides, size_t count)
{
    border_vertex *b = room(t->vertex_range, sizeof *b);
    for (size_t i = 0; i < count; i++) {
        if (find_side(sides, count, sides[i].to, sides[i].from)) continue;
        b[sides[i].from].out++;
        b[sides[i].from].after = sides[i].to;
        b[sides[i].to].in++;
        b[sides[i].to].before = sides[i].from;
    }
    return b;
}

static inline bool is_straight(const twin *t, const border_vertex *b, uint32_t v)
{
    return b[v].in == 1 && b[v].out == 1 && is_on_segment(at(t, b[v].before), at(t, b[v].after), at(t, v));
}

static inline int by_numbers(const void *left, const void *right)
{
    const double *a = left, *b = right;
    for (int i = 0; i < 4; i++)
        if (a[i] != b[i]) return a[i] < b[i] ? -1 : 1;
    return 0;
}

static inline double *straight_border(const twin *t, const side *sides, size_t count, size_t *parts)
{
    border_vertex *b = border_vertices(t, sides, count);
    double *border = room(4 * count, sizeof *border);
    *parts = 0;
    for (size_t i = 0; i < count; i++) {
        uint32_t from = sides[i].from, to = sides[i].to;
        if (find_side(sides, count, to, from) || is_straight(t, b, from)) continue;
        while (is_straight(t, b, to)) to = b[to].after;
        double *part = border + 4 * (*parts)++;
        memcpy(part, at(t, from), 2 * sizeof *part);
        memcpy(part + 2, at(t, to), 2 * sizeof *part);
    }
    free(b);
    qsort(border, *parts, 4 * sizeof *border, by_numbers);
    return border;
}

static inline void keep_border(twin *t)
{
    size_t count;
    side *sides = all_sides(t, &count);
    free(t->border);
    t->border = straight_border(t, sides, count, &t->border_count);
    free(sides);
}

static inline void check_border_fixed(const twin *t, const side *sides, size_t count)
{
    size_t parts;
    double *border = straight_border(t, sides, count, &parts);
    REQUIRE(parts == t->border_count);
    for (size_t i = 0; i < parts; i++) REQUIRE(by_numbers(border + 4 * i, t->border + 4 * i) == 0);
    free(border);
}

/* The border is one convex polygon: a loop that never turns right, and turns once. With that and triangles that all turn the same
 * way, with no two on one side of an edge, each place in the polygon is covered once. */
static inline void check_border_convex(const twin *t, const side *sides, size_t count)
{
    border_vertex *b = border_vertices(t, sides, count);
    uint32_t first = MW_NONE, edges = 0, length = 0, halves = 0;
    for (uint32_t v = 0; v < t->vertex_range; v++) {
        REQUIRE(b[v].in == b[v].out && b[v].in <= 1);
        if (b[v].out) first = v;
        edges += b[v].out;
    }
    REQUIRE(first != MW_NONE);
    uint32_t v = first;
    do {
        const double *p = at(t, b[v].before), *q = at(t, v), *r = at(t, b[v].after);
        REQUIRE(exact_orient(p, q, r) >= 0);
        halves += (q[1] > p[1] || (q[1] == p[1] && q[0] > p[0])) != (r[1] > q[1] || (r[1] == q[1] && r[0] > q[0]));
        v = b[v].after;
        length++;
    } while (v != first && length <= edges);
    REQUIRE(length == edges && halves == 2);
    uint32_t used = 0;
    for (v = 0; v < t->vertex_range; v++) used += t->state[v] == IS_USED;
    REQUIRE(t->triangles == 2 * used - 2 - edges); /* Euler */
    free(b);
}

/* --- made, copied, released ------------------------------------------------------------------------------------------------ */

static inline void twin_read_first(twin *t, const mw_mesh *mesh)
{
    t->vertices = t->vertex_range = mw_mesh_vertex_count(mesh);
    t->triangles = t->triangle_range = mw_mesh_triangle_count(mesh);
    t->point = room(2 * (size_t)t->vertex_range, sizeof *t->point);
    t->state = room(t->vertex_range, 1);
    t->triangle = room(3 * (size_t)t->triangle_range, sizeof *t->triangle);
    for (uint32_t v = 0; v < t->vertex_range; v++) {
        mw_mesh_vertex(mesh, v, t->point + 2 * (size_t)v);
        t->state[v] = IS_ALONE;
    }
    for (uint32_t k = 0; k < t->triangle_range; k++) {
        mw_mesh_triangle(mesh, k, t->triangle + 3 * (size_t)k);
        for (int c = 0; c < 3; c++) t->state[corners_of(t, k)[c]] = IS_USED;
    }
    for (int f = 0; f < TWIN_FIELDS; f++) {
        const double *values = mw_mesh_field(mesh, twin_field[f]);
        t->value[f] = room(t->vertex_range, sizeof(double));
        if (values) memcpy(t->value[f], values, t->vertex_range * sizeof(double));
    }
}

static inline void set_fields(mw_mesh *mesh)
{
    uint32_t n = mw_mesh_vertex_count(mesh);
    for (int f = 0; f < TWIN_FIELDS; f++) {
        double *values = room(n, sizeof *values);
        for (uint32_t v = 0; v < n; v++) values[v] = f ? v : 100 + v % 17;
        REQUIRE(mw_mesh_set_field(mesh, twin_field[f], values, 1, NULL) == MW_OK);
        free(values);
    }
}

/* The constraints of the options, but for those along a border that is fixed anyway. */
static inline void fix_first(twin *t, const mw_editor_options *options)
{
    size_t count;
    side *sides = all_sides(t, &count);
    for (size_t i = 0; options && i < options->constrained_edge_count; i++) {
        uint32_t a = options->constrained_edges[2 * i], b = options->constrained_edges[2 * i + 1];
        if (t->convex || (find_side(sides, count, a, b) && find_side(sides, count, b, a))) fix(t, a, b);
    }
    free(sides);
}

/* Threads have nothing to do in meshes this small, and wait for one another all the time. */
__attribute__((weak)) void omp_set_num_threads(int count);

/* Of a mesh that the twin then owns; it gets two fields, unless it is to be bare. */
static bool bare;

static inline void twin_open(twin *t, mw_mesh *mesh, const mw_editor_options *options)
{
    mw_error error = {0};
    mw_mesh_info info;
    *t = (twin){.first = mesh, .fields = bare ? 0 : TWIN_FIELDS};
    if (omp_set_num_threads) omp_set_num_threads(1);
    if (!bare) set_fields(mesh);
    twin_read_first(t, mesh);
    REQUIRE(mw_mesh_describe(mesh, &info, NULL) == MW_OK);
    t->convex = info.convex;
    expect_ok(mw_editor_create(mesh, options, &t->editor, &error), "editor", &error);
    expect_ok(mw_locator_create(mesh, NULL, &t->first_locator, &error), "locator", &error);
    fix_first(t, options);
    mw_editor_info now;
    mw_editor_describe(t->editor, &now);
    t->delaunay = now.delaunay;
    if (!t->convex) keep_border(t);
}

static inline void twin_close(twin *t)
{
    if (!t->shared) {
        mw_editor_destroy(t->editor);
        mw_locator_destroy(t->first_locator);
        mw_mesh_destroy(t->first);
    }
    free(t->point);
    free(t->state);
    free(t->triangle);
    for (int f = 0; f < TWIN_FIELDS; f++) free(t->value[f]);
    free(t->fixed);
    free(t->border);
}

static inline void *copy_of(const void *memory, size_t count, size_t size)
{
    void *copy = room(count, size);
    if (count) memcpy(copy, memory, count * size);
    return copy;
}

/* How things stand, to compare with after an undo. */
static inline twin twin_copy(const twin *t)
{
    twin c = *t;
    c.shared = true;
    c.point = copy_of(t->point, 2 * (size_t)t->vertex_range, sizeof *c.point);
    c.state = copy_of(t->state, t->vertex_range, 1);
    c.triangle = copy_of(t->triangle, 3 * (size_t)t->triangle_range, sizeof *c.triangle);
    for (int f = 0; f < TWIN_FIELDS; f++) c.value[f] = copy_of(t->value[f], t->vertex_range, sizeof(double));
    c.fixed = copy_of(t->fixed, 2 * t->fixed_count, sizeof *c.fixed);
    c.border = copy_of(t->border, 4 * t->border_count, sizeof *c.border);
    return c;
}

/* --- the editor says what the twin does ------------------------------------------------------------------------------------- */

static inline void same_vertex(const twin *t, uint32_t v)
{
    double p[2] = {-7, -7};
    int there = mw_editor_vertex(t->editor, v, p);
    bool expected = v < t->vertex_range && t->state[v] != IS_GONE;
    REQUIRE(there == expected);
    if (expected)
        REQUIRE(memcmp(p, at(t, v), sizeof p) == 0);
    else
        REQUIRE(p[0] == -7 && p[1] == -7);
    for (uint32_t f = 0; f < t->fields; f++) {
        double value = mw_editor_value(t->editor, f, v);
        if (!expected)
            REQUIRE(isnan(value));
        else
            REQUIRE(memcmp(&value, &t->value[f][v], sizeof value) == 0 || (isnan(value) && isnan(t->value[f][v])));
    }
}

static inline void same_triangle(const twin *t, uint32_t k)
{
    uint32_t v[3] = {7, 7, 7};
    int there = mw_editor_triangle(t->editor, k, v);
    REQUIRE(there == is_there(t, k));
    if (there)
        REQUIRE(memcmp(v, corners_of(t, k), sizeof v) == 0);
    else
        REQUIRE(v[0] == 7 && v[1] == 7 && v[2] == 7);
}

static inline void same_constraints(const twin *t)
{
    size_t count;
    uint32_t *edge = mw_editor_constrained_edges(t->editor, &count);
    REQUIRE(edge != NULL && count == t->fixed_count);
    for (size_t i = 0; i < count; i++) {
        REQUIRE(is_fixed(t, edge[2 * i], edge[2 * i + 1]));
        for (size_t j = 0; j < i && count < 200; j++)
            REQUIRE(!(edge[2 * j] == edge[2 * i] && edge[2 * j + 1] == edge[2 * i + 1]));
    }
    free(edge);
}

static inline void same_info(const twin *t)
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

static inline void check_same(const twin *t)
{
    same_info(t);
    for (uint32_t v = 0; v < t->vertex_range + 2; v++) same_vertex(t, v);
    for (uint32_t k = 0; k < t->triangle_range + 2; k++) same_triangle(t, k);
    same_vertex(t, MW_NONE);
    same_triangle(t, MW_NONE);
    same_constraints(t);
}

/* --- neighbours ------------------------------------------------------------------------------------------------------------- */

/* The edges round a vertex by its sides, counter-clockwise: each neighbour but the first of a fan is joined to the one before by a
 * triangle. */
static inline void check_around(const twin *t, uint32_t v, const side *sides, size_t count, const border_vertex *b)
{
    const side key = {.from = v};
    size_t i = 0, last = count;
    while (i < last) { /* the first side from v */
        size_t middle = i + (last - i) / 2;
        if (by_ends(&sides[middle], &key) < 0)
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
    uint32_t *around = room(degree, sizeof *around);
    around[degree] = 4711;
    REQUIRE(mw_editor_adjacent_vertices(t->editor, v, around, degree) == degree && around[degree] == 4711);
    for (size_t j = 0; j < degree; j++) {
        const side *s = find_side(sides, count, v, around[j]);
        REQUIRE(s != NULL || find_side(sides, count, around[j], v) != NULL);
        joined += s && s->apex == around[(j + 1) % degree];
    }
    REQUIRE(joined == triangles);
    if (degree > 1) {
        uint32_t two[2] = {0, 4711};
        REQUIRE(mw_editor_adjacent_vertices(t->editor, v, two, 1) == degree && two[0] == around[0] && two[1] == 4711);
    }
    free(around);
}

static inline mw_edge_kind edge_of(const twin *t, const side *sides, size_t count, uint32_t a, uint32_t b)
{
    const side *s = find_side(sides, count, a, b), *r = find_side(sides, count, b, a);
    if (!s && !r) return MW_EDGE_NONE;
    if (is_fixed(t, a, b)) return MW_EDGE_CONSTRAINED;
    return s && r ? MW_EDGE_UNCONSTRAINED : MW_EDGE_BORDER;
}

static inline void check_edge(const twin *t, const side *sides, size_t count, uint32_t a, uint32_t b)
{
    mw_edge_kind kind = edge_of(t, sides, count, a, b);
    REQUIRE(mw_editor_edge(t->editor, a, b) == kind && mw_editor_edge(t->editor, b, a) == kind);
}

static inline void check_neighbours(const twin *t, const side *sides, size_t count)
{
    border_vertex *b = border_vertices(t, sides, count);
    for (uint32_t v = 0; v < t->vertex_range; v++) check_around(t, v, sides, count, b);
    for (uint32_t v = t->vertex_range; v < t->vertex_range + 2; v++) {
        REQUIRE(mw_editor_triangle_of(t->editor, v) == MW_NONE &&
                mw_editor_adjacent_vertices(t->editor, v, NULL, 0) == 0);
        REQUIRE(mw_editor_edge(t->editor, v, 0) == MW_EDGE_NONE && mw_editor_edge(t->editor, 0, v) == MW_EDGE_NONE);
    }
    const size_t step = 1 + count / 5000; /* it takes as long as there are edges at the vertex */
    for (size_t i = 0; i < count; i += step) check_edge(t, sides, count, sides[i].from, sides[i].to);
    if (t->vertex_range <= 40)
        for (uint32_t v = 0; v < t->vertex_range; v++)
            for (uint32_t w = 0; w <= v; w++) check_edge(t, sides, count, v, w);
    free(b);
}

/* --- Delaunay -------------------------------------------------------------------------------------------------------------- */

static inline void check_delaunay(const twin *t, const side *sides, size_t count)
{
    for (size_t i = 0; i < count; i++) {
        const side *s = &sides[i], *r = find_side(sides, count, s->to, s->from);
        if (!r || s->from > s->to || is_fixed(t, s->from, s->to)) continue;
        REQUIRE(exact_incircle(at(t, s->from), at(t, s->to), at(t, s->apex), at(t, r->apex)) <= 0);
    }
}

/* What a rebuild from nothing makes of the same points has the same edges, but for such as have four points on their circle. */
static inline void check_rebuilt(const twin *t, const side *sides, size_t count)
{
    double *points = room(2 * (size_t)t->vertices, sizeof *points);
    uint32_t *number = room(t->vertices, sizeof *number), *back = room(t->vertex_range, sizeof *back), n = 0;
    uint32_t *segments = room(2 * (t->fixed_count + count), sizeof *segments);
    uint32_t *polygon = room(t->fixed_count + count, sizeof *polygon);
    size_t m = 0;
    for (uint32_t v = 0; v < t->vertex_range; v++) {
        if (t->state[v] != IS_USED) continue;
        memcpy(points + 2 * (size_t)n, at(t, v), 2 * sizeof *points);
        back[v] = n;
        number[n++] = v;
    }
    for (; m < t->fixed_count; m++) {
        for (int k = 0; k < 2; k++) segments[2 * m + (size_t)k] = back[t->fixed[2 * m + (size_t)k]];
        polygon[m] = MW_NONE;
    }
    for (size_t i = 0; i < count && !t->convex; i++) {
        if (find_side(sides, count, sides[i].to, sides[i].from)) continue;
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
        expect_ok(mw_constrained_delaunay(&given, NULL, NULL, NULL, NULL, &mesh, &error), "rebuild", &error);
    REQUIRE(mw_mesh_triangle_count(mesh) == t->triangles);
    for (uint32_t k = 0; k < t->triangles; k++) {
        uint32_t v[3];
        mw_mesh_triangle(mesh, k, v);
        for (int e = 0; e < 3; e++) {
            uint32_t a = number[v[e]], b = number[v[(e + 1) % 3]], c = number[v[(e + 2) % 3]];
            unsigned edge;
            uint32_t other = mw_mesh_neighbour(mesh, k, (unsigned)e, &edge), w[3];
            if (find_side(sides, count, a, b)) continue;
            REQUIRE(other != MW_NONE && !is_fixed(t, a, b));
            mw_mesh_triangle(mesh, other, w);
            REQUIRE(exact_incircle(at(t, a), at(t, b), at(t, c), at(t, number[w[(edge + 2) % 3]])) == 0);
        }
    }
    mw_mesh_destroy(mesh);
    free(points);
    free(number);
    free(back);
    free(segments);
    free(polygon);
}

/* --- the mesh that the editor gives ------------------------------------------------------------------------------------------- */

static inline void check_numbers(const uint32_t *fresh, const twin *t, bool vertices, uint32_t count)
{
    uint32_t next = 0, range = vertices ? t->vertex_range : t->triangle_range;
    for (uint32_t i = 0; i < range; i++) {
        bool there = vertices ? t->state[i] != IS_GONE : is_there(t, i);
        REQUIRE(fresh[i] == (there ? next : MW_NONE));
        next += there;
    }
    REQUIRE(next == count && fresh[range] == 4711);
}

/* Is `mesh` what is there, numbered anew? */
static inline void check_mesh_given(const twin *t, const mw_mesh *mesh, const uint32_t *triangles,
                                    const uint32_t *vertices)
{
    REQUIRE(mw_mesh_triangle_count(mesh) == t->triangles && mw_mesh_vertex_count(mesh) == t->vertices);
    check_numbers(triangles, t, false, t->triangles);
    check_numbers(vertices, t, true, t->vertices);
    for (uint32_t k = 0; k < t->triangle_range; k++) {
        uint32_t v[3];
        if (triangles[k] == MW_NONE) continue;
        mw_mesh_triangle(mesh, triangles[k], v);
        for (int c = 0; c < 3; c++) REQUIRE(v[c] == vertices[corners_of(t, k)[c]]);
    }
    for (uint32_t v = 0; v < t->vertex_range; v++) {
        double p[2];
        if (vertices[v] == MW_NONE) continue;
        mw_mesh_vertex(mesh, vertices[v], p);
        REQUIRE(memcmp(p, at(t, v), sizeof p) == 0);
        for (uint32_t f = 0; f < t->fields; f++) {
            const double *values = mw_mesh_field(mesh, twin_field[f]);
            REQUIRE(values != NULL && memcmp(&values[vertices[v]], &t->value[f][v], sizeof(double)) == 0);
        }
    }
}

static inline void check_export(const twin *t)
{
    uint32_t *triangles = room(t->triangle_range, sizeof *triangles),
             *vertices = room(t->vertex_range, sizeof *vertices);
    triangles[t->triangle_range] = vertices[t->vertex_range] = 4711;
    mw_mesh *mesh;
    mw_error error = {0};
    expect_ok(mw_editor_mesh(t->editor, triangles, vertices, &mesh, &error), "mesh", &error);
    check_mesh_given(t, mesh, triangles, vertices);
    mw_mesh_info info;
    expect_ok(mw_mesh_describe(mesh, &info, &error), "describe", &error);
    REQUIRE(info.embedding && !info.flat_triangles && info.convex == t->convex);
    if (t->delaunay && !t->fixed_count) REQUIRE(info.delaunay);
    mw_mesh_destroy(mesh);
    free(triangles);
    free(vertices);
}

/* --- all of it ---------------------------------------------------------------------------------------------------------------- */

static inline void check_all(const twin *t)
{
    size_t count;
    check_same(t);
    side *sides = all_sides(t, &count);
    if (t->convex)
        check_border_convex(t, sides, count);
    else
        check_border_fixed(t, sides, count);
    for (size_t i = 0; i < t->fixed_count; i++)
        REQUIRE(find_side(sides, count, t->fixed[2 * i], t->fixed[2 * i + 1]) ||
                find_side(sides, count, t->fixed[2 * i + 1], t->fixed[2 * i]));
    for (uint32_t v = 0; v < t->vertex_range; v++) { /* used vertices are those of triangles */
        const side *s = NULL;
        if (t->state[v] == IS_USED) s = sides;
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

/* --- places --------------------------------------------------------------------------------------------------------------------- */

/* Is q in triangle k? By the vertices in the editor's order. */
static inline bool holds(const twin *t, uint32_t k, const double *q, oracle_answer *answer)
{
    const uint32_t *v = corners_of(t, k);
    const double *p[3] = {at(t, v[0]), at(t, v[1]), at(t, v[2])};
    for (int c = 0; c < 2; c++) {
        if (q[c] < p[0][c] && q[c] < p[1][c] && q[c] < p[2][c]) return false;
        if (q[c] > p[0][c] && q[c] > p[1][c] && q[c] > p[2][c]) return false;
    }
    int turn = exact_orient(p[0], p[1], p[2]), zeros = 0, edge = 0, off = 0;
    for (int e = 0; e < 3; e++) {
        int s = exact_orient(p[e], p[(e + 1) % 3], q) * turn;
        if (s < 0) return false;
        if (s == 0) {
            zeros++;
            edge = e;
        } else {
            off = e;
        }
    }
    *answer = (oracle_answer){k,
                              (uint8_t)(zeros == 0   ? MW_INSIDE
                                        : zeros == 1 ? MW_ON_EDGE
                                                     : MW_ON_VERTEX),
                              (uint8_t)(zeros == 0   ? 255
                                        : zeros == 1 ? edge
                                                     : (off + 2) % 3)};
    return true;
}

static inline oracle_answer twin_locate(const twin *t, const double *q)
{
    oracle_answer answer = {MW_NONE, MW_OUTSIDE, 255};
    if (!isfinite(q[0]) || !isfinite(q[1])) return (oracle_answer){MW_NONE, MW_BAD, 255};
    for (uint32_t k = 0; k < t->triangle_range; k++)
        if (is_there(t, k) && holds(t, k, q, &answer)) break;
    return answer;
}

/* Is that the answer, where the lowest triangle that holds q is known? */
static inline void check_location(const twin *t, const mw_location *l, const double *q, oracle_answer expected)
{
    REQUIRE(l->triangle == expected.triangle);
    if (expected.triangle == MW_NONE) {
        REQUIRE(l->local == 255);
        if (expected.where == MW_BAD) REQUIRE(l->where == MW_BAD && l->hole == MW_NONE);
        if (expected.where == MW_BAD || t->border_moved) return;
        mw_cursor cursor;
        REQUIRE(mw_cursor_init(t->first_locator, NULL, &cursor, NULL) == MW_OK);
        mw_location first = mw_locate(t->first_locator, &cursor, q[0], q[1]);
        if (t->convex) first.where = MW_OUTSIDE;
        REQUIRE(l->where == first.where && (t->convex || l->hole == first.hole));
        return;
    }
    REQUIRE(l->where == expected.where && l->local == expected.local && l->hole == MW_NONE);
    double sum = 0;
    for (int k = 0; k < 3; k++) {
        REQUIRE(l->weight[k] >= 0 && l->weight[k] <= 1 + 1e-9);
        sum += l->weight[k];
        if (l->where == MW_ON_VERTEX) REQUIRE(l->weight[k] == (k == l->local));
        if (l->where == MW_ON_EDGE && k == (l->local + 2) % 3) REQUIRE(l->weight[k] == 0);
    }
    REQUIRE(fabs(sum - 1) < 1e-9);
    double got, value = 0;
    for (uint32_t f = 0; f < t->fields; f++, value = 0) {
        for (int k = 0; k < 3; k++)
            if (l->weight[k] != 0) value += l->weight[k] * t->value[f][corners_of(t, l->triangle)[k]];
        mw_editor_interpolate(t->editor, f, l, 1, &got);
        REQUIRE(fabs(got - value) <= 1e-9 * fabs(value) || (isnan(got) && isnan(value)));
    }
}

/* Cursors of every walk that live as long as the editor. */
typedef struct readers {
    mw_cursor cursor[MW_WALK_COUNT];
    const mw_index *index[MW_START_COUNT];
    uint64_t random;
} readers;

static inline void open_cursor(readers *r, const twin *t, int walk)
{
    mw_query_options options = {.walk = (mw_walk_kind)walk, .seed = mw__random(&r->random)};
    do options.start = (mw_start_kind)mw__random_below(&r->random, MW_START_COUNT);
    while (mw_start_has_index(options.start) && !r->index[options.start]);
    options.index = r->index[options.start];
    options.arithmetic = (mw_arithmetic)mw__random_below(&r->random, 2);
    options.counters = (int)mw__random_below(&r->random, 2);
    mw_error error = {0};
    expect_ok(mw_cursor_init(mw_editor_locator(t->editor), &options, &r->cursor[walk], &error), "cursor", &error);
}

static inline void readers_open(readers *r, const twin *t, bool indexed, uint64_t seed)
{
    mw_error error = {0};
    *r = (readers){.random = seed};
    for (int start = 0; start < MW_START_COUNT && indexed; start++)
        if (mw_start_has_index((mw_start_kind)start))
            expect_ok(mw_editor_index(t->editor, (mw_start_kind)start, NULL, &r->index[start], &error), "index",
                      &error);
    for (int walk = 0; walk < MW_WALK_COUNT; walk++) open_cursor(r, t, walk);
}

/* One query, by a walk and a start that chance chooses. */
static inline void ask(readers *r, const twin *t, const double *q, oracle_answer expected)
{
    int walk = (int)mw__random_below(&r->random, MW_WALK_COUNT);
    if (mw__random_below(&r->random, 16) == 0) open_cursor(r, t, walk);
    mw_location location = mw_locate(mw_editor_locator(t->editor), &r->cursor[walk], q[0], q[1]);
    check_location(t, &location, q, expected);
}

/* The same answers by a batch, and the last triangle of a way. */
static inline void ask_batch(readers *r, const twin *t, const double *q, size_t n, const oracle_answer *expected)
{
    mw_location *locations = room(n, sizeof *locations);
    mw_query_options options = {.walk = (mw_walk_kind)mw__random_below(&r->random, MW_WALK_COUNT)};
    mw_error error = {0};
    expect_ok(mw_locate_batch(mw_editor_locator(t->editor), q, n, 2, &options, locations, NULL, &error), "batch",
              &error);
    for (size_t i = 0; i < n; i++) check_location(t, &locations[i], q + 2 * i, expected[i]);
    uint32_t way[64];
    mw_location last;
    size_t length = mw_walk_path(mw_editor_locator(t->editor), &r->cursor[options.walk], q[0], q[1], way, 64, &last);
    check_location(t, &last, q, expected[0]);
    for (size_t i = 0; i < length && i < 64; i++) REQUIRE(is_there(t, way[i]));
    free(locations);
}

/* All vertices, the middles of all edges and of all triangles, and places round about. */
static inline void check_places(const twin *t, readers *r)
{
    const double away[][2] = {{-1e3, -1e3}, {1e3, 0.5}, {0.5, 1e3}, {NAN, 0}, {0, INFINITY}};
    size_t most = (size_t)t->vertices + 6 * (size_t)t->triangles + 5, n = 0;
    double *q = room(2 * most, sizeof *q);
    for (uint32_t v = 0; v < t->vertex_range; v++)
        if (t->state[v] != IS_GONE) memcpy(q + 2 * n++, at(t, v), 2 * sizeof *q);
    for (uint32_t k = 0; k < t->triangle_range; k++) {
        if (!is_there(t, k)) continue;
        const double *p[3];
        for (int c = 0; c < 3; c++) p[c] = at(t, corners_of(t, k)[c]);
        for (int c = 0; c < 3; c++) {
            const double *u = p[c], *v = p[(c + 1) % 3], *w = p[(c + 2) % 3];
            for (int i = 0; i < 2; i++) {
                q[2 * n + (size_t)i] = u[i] / 2 + v[i] / 2;
                if (c == 0) q[2 * n + 2 + (size_t)i] = u[i] / 3 + v[i] / 3 + w[i] / 3;
            }
            n += c == 0 ? 2 : 1;
        }
    }
    for (int i = 0; i < 5; i++) memcpy(q + 2 * n++, away[i], sizeof away[i]);
    REQUIRE(n <= most);
    oracle_answer *expected = room(n, sizeof *expected);
    for (size_t i = 0; i < n; i++) {
        expected[i] = twin_locate(t, q + 2 * i);
        ask(r, t, q + 2 * i, expected[i]);
    }
    ask_batch(r, t, q, n, expected);
    free(expected);
    free(q);
}

#endif
