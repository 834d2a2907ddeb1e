/* test_star_starts.c - first facets: grids by their equations, the octahedron, names; answers do
 * not depend on any of them, whatever star an index was made from. */
/* wrap: malloc calloc realloc aligned_alloc */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include <math.h>
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>

#include "base/random.h"
#include "star/star_index.h"
#include "support/allocations.h"
#include "support/meshes.h"
#include "support/star_shapes.h"

#define PI 3.14159265358979323846

static double dot(const double a[3], const double b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static double determinant(const double a[3], const double b[3], const double c[3])
{
    double n[3] = {b[1] * c[2] - b[2] * c[1], b[2] * c[0] - b[0] * c[2], b[0] * c[1] - b[1] * c[0]};
    return dot(a, n);
}

static void normalize(double d[3])
{
    double length = sqrt(dot(d, d));
    for (int k = 0; k < 3; k++) d[k] /= length;
}

/* Uniform on the sphere. */
static void draw_direction(uint64_t *random, double d[3])
{
    double z = 2 * random_unit(random) - 1, phi = 2 * PI * random_unit(random), r = sqrt(1 - z * z);
    d[0] = r * cos(phi);
    d[1] = r * sin(phi);
    d[2] = z;
}

/* --- a sphere, turned so that nothing lies on an axis or a plane of coordinates --------------- */

typedef struct starts_sphere {
    star_shape p;
    mw_surface *surface;
    mw_star *star;
} starts_sphere;

static starts_sphere make_sphere(unsigned levels)
{
    static const double turn[3][3] = {{0.36, 0.48, -0.8}, {-0.8, 0.6, 0}, {0.48, 0.64, 0.6}};
    starts_sphere s = {.p = star_shape_octahedron(levels)};
    for (uint32_t v = 0; v < s.p.points; v++) {
        double *at = s.p.point + 3 * (size_t)v, from[3] = {at[0], at[1], at[2]};
        for (int k = 0; k < 3; k++) at[k] = dot(turn[k], from);
        normalize(at);
    }
    mw_arrays view = star_shape_arrays(&s.p);
    mw_error error;
    expect_ok(mw_surface_create(&view, NULL, &s.surface, &error), "surface", &error);
    expect_ok(mw_star_create(s.surface, &(mw_star_options){.angles = 1}, &s.star, &error), "star",
              &error);
    return s;
}

static void release_sphere(starts_sphere *s)
{
    mw_star_destroy(s->star);
    mw_surface_destroy(s->surface);
    star_shape_free(&s->p);
}

static mw_star_index *make_index(const mw_star *star, mw_star_start_kind start,
                                 mw_star_index_options options)
{
    mw_star_index *index;
    mw_error error;
    expect_ok(mw_star_index_create(star, start, &options, &index, &error), "index", &error);
    return index;
}

/* The facet in the middle of a cell is the one where a query begins, and it is there. */
static void expect_at_once(const mw_star *star, const mw_star_index *index, const double d[3])
{
    mw_star_query_options options = {.walk = MW_STAR_WALK_STOCHASTIC, .index = index};
    mw_star_cursor cursor;
    mw_error error;
    mw_location at;
    expect_ok(mw_star_cursor_init(star, &options, &cursor, &error), "cursor", &error);
    if (mw_star_path(star, &cursor, d, NULL, 0, &at) != 1)
        fail_msg("%s: no facet of its own for %.17g %.17g %.17g", mw_star_start_name(index->start),
                 d[0], d[1], d[2]);
}

/* --- grids ------------------------------------------------------------------------------------ */

/* Rows and cells by eq. 4 to 6 as printed; each cell found again by eq. 7, from its middle. */
static void expect_grid(const mw_star *star, uint32_t cells, bool uniform)
{
    mw_star_start_kind start = uniform ? MW_STAR_START_GRID : MW_STAR_START_NONUNIFORM_GRID;
    mw_star_index *index = make_index(star, start, (mw_star_index_options){.cells = cells});
    const mw_star_grid *grid = &index->grid;
    uint32_t rows = (uint32_t)floor(sqrt(uniform ? cells / 2.0 : PI * cells / 4) + 0.5), count = 0;
    double area = 0;
    assert_int_equal(grid->rows, rows);
    for (uint32_t i = 0; i < rows; i++) {
        double part = 2 * PI * (cos(i * PI / rows) - cos((i + 1) * PI / rows));
        uint32_t want = uniform ? 2 * rows : (uint32_t)floor(cells * part / (4 * PI) + 0.5);
        assert_int_equal(grid->first[i], count);
        assert_int_equal(grid->first[i + 1] - grid->first[i], want);
        assert_true(want > 0);
        area += part;
        count += want;
        for (uint32_t j = 0; j < want; j++) {
            double theta = (i + 0.5) * PI / rows, phi = (j + 0.5) / want * 2 * PI - PI;
            double d[3] = {sin(theta) * cos(phi), sin(theta) * sin(phi), cos(theta)};
            assert_int_equal(mw__star_grid_cell(grid, phi, theta), grid->first[i] + j);
            expect_at_once(star, index, d);
        }
    }
    assert_true(fabs(area - 4 * PI) < 1e-12);
    assert_true(fabs((double)count - cells) <= rows / 2.0 + sqrt(2.0 * cells));
    mw_star_index_info info;
    mw_star_index_describe(index, &info);
    assert_int_equal(info.start, start);
    assert_int_equal(info.cells, count);
    assert_int_equal(info.bytes, sizeof *index + 4 * ((size_t)count + rows + 1));
    assert_int_equal(mw__star_grid_cell(grid, -PI, 0), 0);
    assert_int_equal(mw__star_grid_cell(grid, PI, 0), grid->first[1] - 1);
    assert_int_equal(mw__star_grid_cell(grid, -PI, PI), grid->first[rows - 1]);
    assert_int_equal(mw__star_grid_cell(grid, PI, PI), count - 1);
    mw_star_index_destroy(index);
}

static void test_grids(void **state)
{
    static const uint32_t cells[] = {1, 2, 3, 7, 32, 128, 500, 512, 2048};
    (void)state;
    starts_sphere s = make_sphere(4);
    for (int i = 0; i < 9; i++) {
        expect_grid(s.star, cells[i], true);
        expect_grid(s.star, cells[i], false);
    }
    release_sphere(&s);
}

/* Fig. 4 and Table 2 */
static void test_published_grids(void **state)
{
    (void)state;
    starts_sphere s = make_sphere(2);
    for (uint32_t rows = 4; rows <= 32; rows *= 2) {
        mw_star_index *index = make_index(s.star, MW_STAR_START_GRID,
                                          (mw_star_index_options){.cells = 2 * rows * rows});
        assert_int_equal(index->grid.rows, rows);
        assert_int_equal(index->grid.first[rows], 2 * rows * rows);
        mw_star_index_destroy(index);
    }
    release_sphere(&s);
}

/* --- the octahedron --------------------------------------------------------------------------- */

/* The corners of one of the finest triangles, from its number. */
static void cell_corners(uint32_t levels, uint32_t cell, double v[3][3])
{
    uint32_t octant = cell >> (2 * levels);
    memset(v, 0, 9 * sizeof(double));
    for (int k = 0; k < 3; k++) v[k][k] = octant >> k & 1 ? -1 : 1;
    for (uint32_t level = levels; level-- > 0;) {
        uint32_t child = cell >> (2 * level) & 3;
        double m[3][3];
        for (int i = 0; i < 3; i++) {
            for (int k = 0; k < 3; k++) m[i][k] = v[i][k] + v[(i + 1) % 3][k];
            normalize(m[i]);
        }
        uint32_t corner = (child + 2) % 3;
        double w[3][3];
        memcpy(w[0], child ? v[corner] : m[0], sizeof w[0]);
        memcpy(w[1], child ? m[corner] : m[1], sizeof w[1]);
        memcpy(w[2], child ? m[(corner + 2) % 3] : m[2], sizeof w[2]);
        memcpy(v, w, sizeof w);
    }
}

/* Twice the tangent of half of it [Van Oosterom, Strackee 1983]. */
static double solid_angle(double v[3][3])
{
    double volume = fabs(determinant(v[0], v[1], v[2]));
    return 2 * atan2(volume, 1 + dot(v[0], v[1]) + dot(v[1], v[2]) + dot(v[2], v[0]));
}

static void test_octahedron_covers_the_sphere(void **state)
{
    (void)state;
    starts_sphere s = make_sphere(4);
    for (uint32_t levels = 0; levels <= 4; levels++) {
        mw_star_index *index = make_index(s.star, MW_STAR_START_OCTAHEDRON,
                                          (mw_star_index_options){.levels = levels + 1});
        mw_star_index_info info;
        mw_star_index_describe(index, &info);
        assert_int_equal(info.levels, levels);
        assert_int_equal(info.cells, 8u << 2 * levels);
        assert_int_equal(info.bytes, sizeof *index + 4 * (size_t)info.cells);
        double sum = 0;
        for (uint32_t cell = 0; cell < info.cells; cell++) {
            double v[3][3], d[3];
            cell_corners(levels, cell, v);
            sum += solid_angle(v);
            for (int k = 0; k < 3; k++) d[k] = v[0][k] + v[1][k] + v[2][k];
            assert_int_equal(mw__star_octahedron_cell(&index->octahedron, d, NULL), cell);
            expect_at_once(s.star, index, d);
        }
        assert_true(fabs(sum - 4 * PI) < 1e-11);
        mw_star_index_destroy(index);
    }
    release_sphere(&s);
}

/* Each direction is in its cell, up to rounding; the mean number of triangles and tests is that of
 * uniform directions. */
static void test_octahedron_finds(void **state)
{
    enum { N = 100000 };
    uint64_t random = 5;
    double before = 0;
    (void)state;
    for (uint32_t levels = 0; levels <= MW_STAR_MAX_LEVELS; levels += 3) {
        mw_star_octahedron octahedron = {.levels = levels};
        mw_star_work work = {0};
        for (int i = 0; i < N; i++) {
            double d[3], v[3][3];
            draw_direction(&random, d);
            bool on_edge = i % 8 == 0;
            if (on_edge) d[i / 8 % 3] = 0;
            cell_corners(levels, mw__star_octahedron_cell(&octahedron, d, on_edge ? NULL : &work),
                         v);
            double turn = determinant(v[0], v[1], v[2]);
            for (int k = 0; k < 3; k++)
                if (copysign(1, turn) * determinant(v[k], v[(k + 1) % 3], d) < -1e-15)
                    fail_msg("%u levels: %.17g %.17g %.17g is not in its triangle", levels, d[0],
                             d[1], d[2]);
        }
        double mean = (double)work.triangles[MW_STAR_STAGE_INIT] / (N - N / 8);
        assert_int_equal(work.orient[MW_STAR_STAGE_INIT], 3 * work.triangles[MW_STAR_STAGE_INIT]);
        assert_int_equal(work.visited, 0);
        print_message("%u levels: %.2f triangles\n", levels, mean);
        double want = levels == 0 ? 2.5 : levels == 3 ? 7.97 : before + 5.25;
        if (fabs(mean - want) > 0.05)
            fail_msg("%u levels: %.3f triangles, not %.2f", levels, mean, want);
        before = mean;
    }
}

/* Do triangles of 3 corners share an edge, the one opposite to corner k of the first? */
static bool is_across(double a[3][3], uint32_t k, double b[3][3])
{
    int shared = 0;
    for (uint32_t i = 0; i < 3; i++)
        for (int j = 0; j < 3 && i != k; j++) shared += memcmp(a[i], b[j], sizeof a[i]) == 0;
    return shared == 2;
}

/* Steps of a barycentric walk from cell to cell as it is defined, from the first cell. */
static uint32_t walk_cells(double cell[32][3][3], uint32_t cells, const double d[3], uint32_t *end)
{
    uint32_t at = 0, visits = 0;
    for (;;) {
        double(*v)[3] = cell[at], least = 0, turn = determinant(v[0], v[1], v[2]);
        uint32_t out = 3, next = 0;
        visits++;
        for (uint32_t k = 0; k < 3; k++) {
            double value = determinant(v[(k + 1) % 3], v[(k + 2) % 3], d) / turn;
            if (value < least) {
                least = value;
                out = k;
            }
        }
        *end = at;
        if (out == 3) return visits;
        while (next == at || !is_across(v, out, cell[next])) assert_true(++next < cells);
        at = next;
    }
}

/* Among the faces, and in their first subdivision. */
static void test_octahedron_walks(void **state)
{
    uint64_t random = 9;
    (void)state;
    for (uint32_t levels = 0; levels < 2; levels++) {
        mw_star_octahedron octahedron = {.levels = levels};
        uint32_t cells = 8u << 2 * levels, end;
        double cell[32][3][3];
        for (uint32_t i = 0; i < cells; i++) {
            cell_corners(levels, i, cell[i]);
            for (int k = 0; k < 9; k++) cell[i][k / 3][k % 3] += 0.0; /* -0 is 0 */
        }
        for (int i = 0; i < 20000; i++) {
            mw_star_work work = {0};
            double d[3];
            draw_direction(&random, d);
            uint32_t found = mw__star_octahedron_cell(&octahedron, d, &work);
            uint32_t visits = walk_cells(cell, cells, d, &end);
            if (found != end || work.triangles[MW_STAR_STAGE_INIT] != visits)
                fail_msg("%a %a %a: cell %u by %u triangles, not %u by %u", d[0], d[1], d[2], found,
                         (unsigned)work.triangles[MW_STAR_STAGE_INIT], end, visits);
        }
    }
}

/* Directions at the rim of the doubles, and beyond: some cell, and an end. */
static void test_octahedron_ends(void **state)
{
    static const double value[] = {0,       -0.0,     5e-324,   -5e-324,   1,  -1,
                                   1.5e308, -1.5e308, INFINITY, -INFINITY, NAN};
    enum { N = sizeof value / sizeof *value };
    (void)state;
    for (uint32_t levels = 0; levels < 4; levels++) {
        mw_star_octahedron octahedron = {.levels = levels};
        for (int i = 0; i < N * N * N; i++) {
            double d[3] = {value[i % N], value[i / N % N], value[i / N / N]};
            assert_true(mw__star_octahedron_cell(&octahedron, d, NULL) < 8u << 2 * levels);
        }
    }
}

/* --- answers ---------------------------------------------------------------------------------- */

static void expect_same_answers(const mw_star *star, const mw_star_query_options *options,
                                const double *q, size_t n, const mw_location *want,
                                uint64_t *visited)
{
    mw_location *at = malloc(n * sizeof *at);
    mw_counters counters;
    mw_error error;
    assert_non_null(at);
    memset(at, 255, n * sizeof *at);
    expect_ok(mw_star_locate_batch(star, q, n, 3, options, at, &counters, &error), "batch", &error);
    for (size_t i = 0; i < n; i++)
        if (memcmp(&at[i], &want[i], sizeof *at) != 0)
            fail_msg("start %s: %.17g %.17g %.17g: facet %u, not %u",
                     mw_star_start_name(options->start), q[3 * i], q[3 * i + 1], q[3 * i + 2],
                     at[i].triangle, want[i].triangle);
    assert_int_equal(counters.queries, n);
    bool octahedron = options->start == MW_STAR_START_OCTAHEDRON;
    assert_true(octahedron ? counters.triangles_init >= n : counters.triangles_init == 0);
    assert_int_equal(counters.orient_init, 3 * counters.triangles_init);
    *visited = counters.triangles_visited;
    free(at);
}

/* Directions, vertices and points of edges. */
static void draw_queries(const star_shape *p, double *q, size_t n, uint64_t *random)
{
    for (size_t i = 0; i < n; i++) {
        const uint32_t *v = p->corner + 3 * (size_t)mw__random_below(random, p->triangles);
        const double *a = p->point + 3 * (size_t)v[0], *b = p->point + 3 * (size_t)v[1];
        draw_direction(random, q + 3 * i);
        for (size_t k = 0; k < 3 && i % 3; k++) q[3 * i + k] = i % 3 == 1 ? a[k] : a[k] + b[k];
    }
}

/* Also with the indices of a larger and of a smaller star. */
static void test_answers(void **state)
{
    enum { N = 3000, KINDS = 3 };
    uint64_t random = 6, visited, front = 0;
    (void)state;
    starts_sphere s = make_sphere(4),
                  other[KINDS] = {make_sphere(4), make_sphere(1), make_sphere(5)};
    double *q = malloc(3 * N * sizeof *q);
    mw_location *want = malloc(N * sizeof *want);
    mw_star_query_options plain = {
        .walk = MW_STAR_WALK_STRAIGHT, .start = MW_STAR_START_FRONT, .counters = 1};
    assert_true(q && want);
    draw_queries(&s.p, q, N, &random);
    mw_error error;
    expect_ok(mw_star_locate_batch(s.star, q, N, 3, &plain, want, NULL, &error), "batch", &error);
    expect_same_answers(s.star, &plain, q, N, want, &front);
    for (int start = MW_STAR_START_AUTO; start < MW_STAR_START_COUNT; start++)
        for (int kind = 0; kind < KINDS; kind++)
            for (int walk = MW_STAR_WALK_AUTO; walk < MW_STAR_WALK_COUNT; walk++) {
                mw_star_query_options options = {.walk = (mw_star_walk_kind)walk,
                                                 .start = (mw_star_start_kind)start,
                                                 .counters = 1};
                mw_star_index *index = NULL;
                if (mw_star_start_has_index(options.start))
                    index = make_index(other[kind].star, options.start, (mw_star_index_options){0});
                options.index = index;
                expect_same_answers(s.star, &options, q, N, want, &visited);
                if (index && kind == 0) assert_true(visited < front / 2);
                mw_star_index_destroy(index);
            }
    free(q);
    free(want);
    for (int kind = 0; kind < KINDS; kind++) release_sphere(&other[kind]);
    release_sphere(&s);
}

static size_t path_length(const mw_star *star, mw_star_query_options options, const double q[3])
{
    mw_star_cursor cursor;
    mw_error error;
    expect_ok(mw_star_cursor_init(star, &options, &cursor, &error), "cursor", &error);
    return mw_star_path(star, &cursor, q, NULL, 0, NULL);
}

/* The more facets are sampled, the shorter the walk; the front facet is in front; the last is
 * where the last query was. */
static void test_where_it_begins(void **state)
{
    enum { N = 400 };
    uint64_t random = 7;
    size_t one = 0, few = 0, many = 0, rule = 0;
    (void)state;
    starts_sphere s = make_sphere(5);
    mw_star_cursor cursor;
    mw_error error;
    for (uint64_t i = 0; i < N; i++) {
        double d[3];
        draw_direction(&random, d);
        one += path_length(
            s.star, (mw_star_query_options){.start = MW_STAR_START_SAMPLE, .seed = i, .samples = 1},
            d);
        few += path_length(
            s.star,
            (mw_star_query_options){.start = MW_STAR_START_SAMPLE, .seed = i, .samples = 17}, d);
        rule += path_length(s.star,
                            (mw_star_query_options){.start = MW_STAR_START_SAMPLE, .seed = i}, d);
        many += path_length(
            s.star,
            (mw_star_query_options){.start = MW_STAR_START_SAMPLE, .seed = i, .samples = 5000}, d);
        mw_star_query_options last = {.start = MW_STAR_START_LAST, .walk = MW_STAR_WALK_STOCHASTIC};
        expect_ok(mw_star_cursor_init(s.star, &last, &cursor, &error), "cursor", &error);
        mw_star_locate(s.star, &cursor, d);
        assert_int_equal(mw_star_path(s.star, &cursor, d, NULL, 0, NULL), 1);
    }
    assert_int_equal(few, rule); /* 2 times the fourth root of 4098 vertices, rounded up */
    assert_true(one > 2 * few && few > 2 * many);
    path_length(s.star,
                (mw_star_query_options){.start = MW_STAR_START_SAMPLE, .samples = UINT32_MAX},
                (double[3]){1});
    mw_star_query_options front = {.start = MW_STAR_START_FRONT, .walk = MW_STAR_WALK_STOCHASTIC};
    assert_int_equal(path_length(s.star, front, (double[3]){1, 0, 0}), 1);
    release_sphere(&s);
}

/* --- what is refused -------------------------------------------------------------------------- */

static void expect_refused(const mw_star *star, mw_star_start_kind start,
                           mw_star_index_options options)
{
    mw_star_index *index = (mw_star_index *)&options;
    mw_error error;
    assert_int_equal(mw_star_index_create(star, start, &options, &index, &error),
                     MW_ERROR_ARGUMENT);
    assert_null(index);
}

static void test_refused(void **state)
{
    (void)state;
    starts_sphere s = make_sphere(2);
    mw_error error;
    expect_refused(NULL, MW_STAR_START_GRID, (mw_star_index_options){0});
    expect_refused(s.star, MW_STAR_START_SAMPLE, (mw_star_index_options){0});
    expect_refused(s.star, MW_STAR_START_COUNT, (mw_star_index_options){0});
    expect_refused(s.star, MW_STAR_START_GRID, (mw_star_index_options){.cells = (1u << 30) + 1});
    expect_refused(s.star, MW_STAR_START_OCTAHEDRON,
                   (mw_star_index_options){.levels = MW_STAR_MAX_LEVELS + 2});
    assert_int_equal(mw_star_index_create(s.star, MW_STAR_START_GRID, NULL, NULL, &error),
                     MW_ERROR_ARGUMENT);
    mw_surface_begin_update(s.surface);
    mw_surface_end_update(s.surface);
    expect_refused(s.star, MW_STAR_START_GRID, (mw_star_index_options){0});
    mw_star_index_destroy(NULL);
    release_sphere(&s);
}

static void test_out_of_memory(void **state)
{
    (void)state;
    starts_sphere s = make_sphere(2);
    for (int start = 0; start < MW_STAR_START_COUNT; start++) {
        if (!mw_star_start_has_index((mw_star_start_kind)start)) continue;
        mw_status status = MW_ERROR_MEMORY;
        long allocations = 0;
        for (; status; allocations++) {
            mw_star_index *index;
            mw_error error;
            allocations_left = allocations;
            status = mw_star_index_create(s.star, (mw_star_start_kind)start, NULL, &index, &error);
            allocations_left = -1;
            assert_true(status == MW_OK || (status == MW_ERROR_MEMORY && !index));
            mw_star_index_destroy(index);
        }
        assert_true(allocations > 2);
    }
    release_sphere(&s);
}

/* --- names ------------------------------------------------------------------------------------ */

static void test_names(void **state)
{
    (void)state;
    for (int i = 0; i < MW_STAR_WALK_COUNT; i++) {
        mw_star_walk_kind walk = (mw_star_walk_kind)i;
        assert_int_equal(mw_star_walk_by_name(mw_star_walk_name(walk)), walk);
        assert_true(mw_star_walk_source(walk) && strlen(mw_star_walk_help(walk)) > 0);
    }
    for (int i = 0; i < MW_STAR_START_COUNT; i++) {
        mw_star_start_kind start = (mw_star_start_kind)i;
        assert_int_equal(mw_star_start_by_name(mw_star_start_name(start)), start);
        assert_true(strlen(mw_star_start_help(start)) > 0);
        bool index = start == MW_STAR_START_GRID || start == MW_STAR_START_NONUNIFORM_GRID ||
                     start == MW_STAR_START_OCTAHEDRON;
        assert_int_equal(mw_star_start_has_index(start), index);
    }
    assert_string_equal(mw_star_walk_name(MW_STAR_WALK_ORTHOGONAL), "orthogonal");
    assert_string_equal(mw_star_start_name(MW_STAR_START_NONUNIFORM_GRID), "nonuniform-grid");
    assert_null(mw_star_walk_name(MW_STAR_WALK_COUNT));
    assert_null(mw_star_walk_source(MW_STAR_WALK_COUNT));
    assert_null(mw_star_walk_help(MW_STAR_WALK_COUNT));
    assert_null(mw_star_start_name(MW_STAR_START_COUNT));
    assert_null(mw_star_start_help(MW_STAR_START_COUNT));
    assert_int_equal(mw_star_start_has_index(MW_STAR_START_COUNT), 0);
    assert_int_equal(mw_star_walk_by_name("no such walk"), MW_STAR_WALK_COUNT);
    assert_int_equal(mw_star_start_by_name(""), MW_STAR_START_COUNT);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_grids),
        cmocka_unit_test(test_published_grids),
        cmocka_unit_test(test_octahedron_covers_the_sphere),
        cmocka_unit_test(test_octahedron_finds),
        cmocka_unit_test(test_octahedron_walks),
        cmocka_unit_test(test_octahedron_ends),
        cmocka_unit_test(test_answers),
        cmocka_unit_test(test_where_it_begins),
        cmocka_unit_test(test_refused),
        cmocka_unit_test(test_out_of_memory),
        cmocka_unit_test(test_names),
    };
    return cmocka_run_group_tests_name("star_starts", tests, NULL, NULL);
}
