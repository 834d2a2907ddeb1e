/* test_segment.c - the pieces of segments, held against brute force in rationals: through vertices,
 * along edges and borders, over holes and pockets, between components, from and to places beyond
 * the mesh. */
/* wrap: malloc calloc realloc aligned_alloc */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include "oracle/segment/segment_oracle.h"
#include "support/allocations.h"
#include "support/environment.h"
#include "support/meshes.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { ROOM = 4096 };

/* The pieces that an iterator gives. */
static size_t pieces_of(mw_segment *s, mw_segment_piece *piece)
{
    size_t n = 0;
    while (n < ROOM && mw_segment_next(s, &piece[n])) n++;
    assert_int_equal(mw_segment_next(s, &piece[n]), 0);
    return n;
}

static void expect_pieces(const arrays *m, const double a[2], const double b[2],
                          const mw_segment_piece *piece, size_t n)
{
    assert_true(segment_oracle_agrees(m->points, m->triangles, m->triangle_count, a, b, piece, n));
}

/* A value at each vertex, its number, interpolated at an end of a piece. */
static double value_at(const mw_mesh *mesh, const mw_segment_piece *piece, const double weight[3])
{
    uint32_t v[3];
    mw_mesh_triangle(mesh, piece->triangle, v);
    return weight[0] * v[0] + weight[1] * v[1] + weight[2] * v[2];
}

/* Weights are those of the right vertices, and pieces that meet have the same values there, unless
 * a vertex of one triangle is inside an edge of another. */
static void expect_weights(const mw_mesh *mesh, const double a[2], const double b[2],
                           const mw_segment_piece *piece, size_t n)
{
    mw_mesh_info info;
    mw_error error;
    expect_ok(mw_mesh_describe(mesh, NULL, &info, &error), "a description", &error);
    double last = 0, reached[2] = {0, 0};
    for (size_t i = 0; i < n; i++)
        for (int end = 0; end < 2; end++) {
            double weight[3], point[2], value;
            mw_segment_weights(mesh, a, b, &piece[i], end, weight, point);
            uint8_t at = end ? piece[i].to_at : piece[i].from_at;
            for (int k = 0; k < 3; k++) {
                int used = at == MW_AT_INSIDE || (at < MW_AT_VERTEX ? at == k || (at + 1) % 3 == k
                                                                    : at - MW_AT_VERTEX == k);
                assert_true(used ? weight[k] >= 0 : weight[k] == 0);
            }
            assert_true(fabs(weight[0] + weight[1] + weight[2] - 1) < 1e-14);
            mw_segment_weights(mesh, a, b, &piece[i], end, weight, NULL);
            value = value_at(mesh, &piece[i], weight);
            if (!end && i && !piece[i].gap) {
                bool same = point[0] == reached[0] && point[1] == reached[1];
                assert_true((value == last && same) || info.flat_triangles);
            }
            last = value;
            memcpy(reached, point, sizeof reached);
            double t = end ? piece[i].to : piece[i].from;
            for (int k = 0; k < 2; k++) {
                double is = point[k] / 4, should = a[k] / 4 * (1 - t) + b[k] / 4 * t;
                double size = fabs(a[k] / 4) + fabs(b[k] / 4) + fabs(info.low[k] / 4) +
                              fabs(info.high[k] / 4);
                assert_true(fabs(is - should) <= 1e-10 * size + 1e-300);
            }
        }
}

/* Bit for bit the pieces that an iterator gives, which finds them in another way. */
static void expect_as_iterator(const mw_locator *locator, const double *ends,
                               const mw_segment_piece *piece, size_t n)
{
    static mw_segment_piece own[ROOM + 1];
    mw_cursor cursor = {.walk = 0};
    mw_segment s;
    mw_error error;
    expect_ok(mw_segment_begin(locator, &cursor, ends, ends + 2, &s, &error), "a segment", &error);
    assert_int_equal(pieces_of(&s, own), n);
    if (n) assert_memory_equal(own, piece, n * sizeof *piece);
}

static void expect_batch(const arrays *m, const mw_locator *locator, const double *ends, size_t n,
                         size_t stride, uint32_t threads)
{
    mw_segment_pieces all;
    mw_error error;
    expect_ok(mw_segment_batch(locator, ends, n, stride, &(mw_segment_options){.threads = threads},
                               &all, &error),
              "pieces of segments", &error);
    assert_int_equal(all.segment_count, n);
    assert_int_equal(all.offset[n], all.piece_count);
    assert_int_equal(all.bad_count, 0);
    for (size_t i = 0; i < n; i++) {
        const mw_segment_piece *piece = all.piece + all.offset[i];
        size_t count = all.offset[i + 1] - all.offset[i];
        expect_pieces(m, ends + i * stride, ends + i * stride + 2, piece, count);
        expect_as_iterator(locator, ends + i * stride, piece, count);
    }
    mw_segment_pieces_release(&all);
}

/* Segments between places that find fault: each alone, as one of a batch, as a part of a
 * polyline. */
static void expect_segments(const arrays *m, size_t n, uint64_t *random)
{
    size_t places;
    double *place = arrays_queries(m, n, &places, random);
    size_t finite = 0;
    for (size_t i = 0; i < places; i++) {
        if (!isfinite(place[2 * i]) || !isfinite(place[2 * i + 1])) continue;
        memmove(place + 2 * finite++, place + 2 * i, 2 * sizeof *place);
    }
    places = finite;
    double *ends = malloc(4 * places * sizeof *ends);
    static mw_segment_piece piece[ROOM + 1];
    mw_mesh *mesh = arrays_mesh(m, (mw_mesh_options){.layout = (mw_mesh_layout)(n % 3)});
    mw_locator *locator = mesh_locator(mesh, (mw_locator_options){.threads = 1});
    mw_cursor cursor = {.walk = 0};
    for (size_t i = 0; i < places; i++) {
        size_t from = mw__random(random) % places, to = mw__random(random) % places;
        memcpy(ends + 4 * i, place + 2 * from, 2 * sizeof *ends);
        memcpy(ends + 4 * i + 2, place + 2 * to, 2 * sizeof *ends);
        mw_segment s;
        mw_error error;
        expect_ok(mw_segment_begin(locator, &cursor, ends + 4 * i, ends + 4 * i + 2, &s, &error),
                  "a segment", &error);
        size_t n_pieces = pieces_of(&s, piece);
        expect_pieces(m, ends + 4 * i, ends + 4 * i + 2, piece, n_pieces);
        expect_weights(mesh, ends + 4 * i, ends + 4 * i + 2, piece, n_pieces);
        size_t on = mw__random(random) % places;
        expect_ok(mw_segment_continue(&s, place + 2 * on, &error), "its continuation", &error);
        expect_pieces(m, ends + 4 * i + 2, place + 2 * on, piece, pieces_of(&s, piece));
    }
    expect_batch(m, locator, ends, places, 4, 2);
    expect_batch(m, locator, ends, 2 * places - 1, 2, 1);
    mw_locator_destroy(locator);
    mw_mesh_destroy(mesh);
    free(ends);
    free(place);
}

static void test_grids(void **state)
{
    (void)state;
    uint64_t random = environment_print_seed("test_segment grids", 1);
    for (int i = 0; i < (environment_is_long() ? 200 : 6); i++)
        for (int share = 0; share < 3; share++) {
            arrays m =
                arrays_grid(3 + (uint32_t)(mw__random(&random) % 5), i % 2 ? 0.6 : 0, &random);
            arrays_punch(&m, 0.3 * share, &random);
            arrays_scramble(&m, 1, &random);
            expect_segments(&m, 6, &random);
            arrays_free(&m);
        }
}

static void test_scales(void **state)
{
    (void)state;
    static const double scale[][3] = {{0x1p-540, 0, 0},      {0x1p-1060, 0, 0}, {0x1p1018, 0, 0},
                                      {0x1p1020, -1e308, 0}, {1e-3, 5e5, 5e6},  {0x1p300, 0, 0},
                                      {1e-9, 1, 1}};
    uint64_t random = environment_print_seed("test_segment scales", 2);
    for (size_t i = 0; i < sizeof scale / sizeof *scale; i++)
        for (int jitter = 0; jitter < 2; jitter++) {
            arrays m = arrays_grid(4, 0.5 * jitter, &random);
            arrays_transform(&m, scale[i][0], scale[i][1], scale[i][2]);
            mw_mesh *mesh = arrays_mesh(&m, (mw_mesh_options){.threads = 1});
            mw_mesh_info info;
            mw_error error;
            expect_ok(mw_mesh_describe(mesh, NULL, &info, &error), "a description", &error);
            mw_mesh_destroy(mesh);
            if (info.embedding) {
                arrays_punch(&m, 0.3, &random);
                expect_segments(&m, 4, &random);
            }
            arrays_free(&m);
        }
}

static void test_fan(void **state)
{
    (void)state;
    uint64_t random = environment_print_seed("test_segment fan", 3);
    arrays m = arrays_fan(40);
    expect_segments(&m, 10, &random);
    arrays_punch(&m, 0.4, &random);
    expect_segments(&m, 10, &random);
    arrays_free(&m);
}

/* A long triangle below, whose upper edge meets three shorter ones by flat triangles; numbers in an
 * order that gives the long one only some parts of that edge. */
static void test_cut_triangles(void **state)
{
    (void)state;
    uint64_t random = environment_print_seed("test_segment cut", 4);
    for (int round = 0; round < 20; round++) {
        arrays m = arrays_make(16, 16);
        uint32_t left = arrays_point(&m, 0, 0), right = arrays_point(&m, 6, 0),
                 low = arrays_point(&m, 3, -6), p = arrays_point(&m, 2, 0),
                 q = arrays_point(&m, 4, 0), top = arrays_point(&m, 3, 6);
        arrays_triangle(&m, left, low, right);
        arrays_triangle(&m, left, p, top);
        arrays_triangle(&m, p, q, top);
        arrays_triangle(&m, q, right, top);
        arrays_triangle(&m, left, right, p);
        arrays_triangle(&m, p, right, q);
        arrays_scramble(&m, 1, &random);
        expect_segments(&m, 3, &random);
        arrays_free(&m);
    }
}

/* As wide as doubles go: differences of coordinates overflow. */
static void test_widest(void **state)
{
    (void)state;
    uint64_t random = environment_print_seed("test_segment widest", 7);
    arrays m = arrays_make(6, 5);
    static const double at[6][2] = {{0, 0},        {1.7e308, 0},  {0, 1.7e308},
                                    {-1.7e308, 0}, {0, -1.7e308}, {1.7e308, 1.7e308}};
    for (int i = 0; i < 6; i++) arrays_point(&m, at[i][0], at[i][1]);
    for (uint32_t i = 1; i <= 4; i++) arrays_triangle(&m, 0, i, i % 4 + 1);
    arrays_triangle(&m, 1, 5, 2);
    expect_segments(&m, 20, &random);
    arrays_free(&m);
}

/* Short and long segments, some with ends that are not finite. */
static double *draw_segments(size_t n, double size, uint64_t *random)
{
    double *ends = malloc(4 * n * sizeof *ends);
    assert_non_null(ends);
    for (size_t i = 0; i < n; i++) {
        double *e = ends + 4 * i, reach = i % 50 == 0 ? size : 4;
        for (int k = 0; k < 2; k++) {
            e[k] = (size + 2) * random_unit(random) - 1;
            e[2 + k] = e[k] + reach * (2 * random_unit(random) - 1);
        }
        if (i % 97 == 5) e[i % 4] = i % 2 ? NAN : INFINITY;
        if (i % 7 == 3) memcpy(e, e - 2, 2 * sizeof *e);
    }
    return ends;
}

/* A mesh that no cache of a core holds, so that several segments are followed in turn. Their pieces
 * are those of each segment alone. */
static void test_large_mesh(void **state)
{
    (void)state;
    enum { SIZE = 360, SEGMENTS = 3000, PIECES = 8 * SIZE };
    uint64_t random = environment_print_seed("test_segment large mesh", 9);
    arrays m = arrays_grid(SIZE, 0.5, &random);
    arrays_punch(&m, 0.05, &random);
    mw_mesh *mesh = arrays_mesh(&m, (mw_mesh_options){.threads = 2});
    mw_locator *locator = mesh_locator(mesh, (mw_locator_options){.threads = 2});
    double *ends = draw_segments(SEGMENTS, SIZE, &random);
    mw_segment_piece *piece = malloc(PIECES * sizeof *piece);
    assert_non_null(piece);
    for (uint32_t threads = 1; threads < 4; threads++) {
        mw_segment_pieces all;
        mw_error error;
        mw_segment_options options = {.threads = threads};
        mw_cursor cursor = {.walk = 0};
        size_t bad = 0;
        expect_ok(mw_segment_batch(locator, ends, SEGMENTS, 4, &options, &all, &error), "pieces",
                  &error);
        for (size_t i = 0; i < SEGMENTS; i++) {
            mw_segment s;
            size_t n = 0, wanted = all.offset[i + 1] - all.offset[i];
            if (mw_segment_begin(locator, &cursor, ends + 4 * i, ends + 4 * i + 2, &s, NULL))
                bad++;
            else
                while (n < PIECES && mw_segment_next(&s, &piece[n])) n++;
            assert_int_equal(n, wanted);
            assert_memory_equal(piece, all.piece + all.offset[i], n * sizeof *piece);
        }
        assert_int_equal(all.offset[0], 0);
        assert_int_equal(all.piece_count, all.offset[SEGMENTS]);
        assert_int_equal(all.bad_count, bad);
        assert_true(bad > 0);
        mw_segment_pieces_release(&all);
    }
    free(piece);
    free(ends);
    mw_locator_destroy(locator);
    mw_mesh_destroy(mesh);
    arrays_free(&m);
}

/* Each allocation of a batch fails once. A batch that can do with less memory succeeds. */
static void expect_each_failure(const mw_locator *locator, const double *ends, size_t n)
{
    mw_segment_options options = {.threads = 1};
    mw_segment_pieces whole, all;
    mw_error error = {0};
    expect_ok(mw_segment_batch(locator, ends, n, 4, &options, &whole, &error), "pieces", &error);
    bool failed = true;
    int refused = 0;
    for (long failures = 0; failed; failures++) {
        allocations_left = failures;
        mw_status status = mw_segment_batch(locator, ends, n, 4, &options, &all, &error);
        failed = allocations_left < 0;
        allocations_left = -1;
        if (status == MW_OK) {
            assert_int_equal(all.piece_count, whole.piece_count);
            assert_memory_equal(all.piece, whole.piece, all.piece_count * sizeof *all.piece);
            mw_segment_pieces_release(&all);
            continue;
        }
        assert_true(failed);
        assert_int_equal(status, MW_ERROR_MEMORY);
        assert_null(all.piece);
        assert_null(all.offset);
        refused++;
    }
    assert_true(refused > 2);
    mw_segment_pieces_release(&whole);
}

static void test_memory(void **state)
{
    (void)state;
    enum { SEGMENTS = 2700 };
    uint64_t random = 8;
    arrays m = arrays_grid(20, 0.5, &random);
    mw_mesh *mesh = arrays_mesh(&m, (mw_mesh_options){.threads = 1});
    mw_locator *locator = mesh_locator(mesh, (mw_locator_options){.threads = 1});
    static double ends[4 * SEGMENTS];
    for (int i = 0; i < 4 * SEGMENTS; i++) ends[i] = 22 * random_unit(&random) - 1;
    expect_each_failure(locator, ends, 700);
    expect_each_failure(locator, ends, SEGMENTS);
    mw_locator_destroy(locator);
    mw_mesh_destroy(mesh);
    arrays_free(&m);
}

/* What is refused, and how. */
static void test_refusals(void **state)
{
    (void)state;
    uint64_t random = 5;
    arrays m = arrays_grid(4, 0, &random);
    arrays_punch(&m, 0.4, &random);
    mw_mesh *mesh = arrays_mesh(&m, (mw_mesh_options){.threads = 1});
    mw_locator *open = mesh_locator(mesh, (mw_locator_options){.fill = MW_FILL_NO});
    mw_locator *locator = mesh_locator(mesh, (mw_locator_options){.threads = 1});
    mw_cursor cursor = {.walk = 0}, other = {.walk = 0};
    const double a[2] = {0, 0}, b[2] = {1, 1}, nan[2] = {NAN, 1};
    double ends[12] = {0, 0, 1, 1, 1, 1, INFINITY, 0, INFINITY, 0, 1, 1};
    mw_segment s = {.tile = 7}, before = s;
    mw_error error;
    assert_int_equal(mw_segment_begin(open, &other, a, b, &s, &error), MW_ERROR_ARGUMENT);
    assert_int_equal(mw_segment_begin(NULL, &cursor, a, b, &s, &error), MW_ERROR_ARGUMENT);
    assert_int_equal(mw_segment_begin(locator, &cursor, a, nan, &s, &error), MW_ERROR_INPUT);
    assert_memory_equal(&s, &before, sizeof s);
    assert_int_equal(mw_segment_continue(&s, b, &error), MW_ERROR_ARGUMENT);
    mw_segment_pieces all;
    assert_int_equal(mw_segment_batch(open, ends, 3, 4, NULL, &all, &error), MW_ERROR_ARGUMENT);
    assert_int_equal(mw_segment_batch(locator, ends, 3, 3, NULL, &all, &error), MW_ERROR_ARGUMENT);
    assert_int_equal(mw_segment_batch(locator, NULL, 3, 4, NULL, &all, &error), MW_ERROR_ARGUMENT);
    assert_null(all.piece);
    expect_ok(mw_segment_batch(locator, ends, 3, 4, NULL, &all, &error), "bad segments", &error);
    assert_int_equal(all.bad_count, 2);
    assert_int_equal(all.offset[1], all.piece_count);
    mw_segment_pieces_release(&all);
    expect_ok(mw_segment_batch(locator, NULL, 0, 4, NULL, &all, &error), "no segments", &error);
    assert_int_equal(all.piece_count, 0);
    mw_segment_pieces_release(&all);
    mw_locator_destroy(locator);
    mw_locator_destroy(open);
    mw_mesh_destroy(mesh);
    arrays_free(&m);
}

/* An editor's locator: the pieces are those of the mesh as it is. */
static void test_editor(void **state)
{
    (void)state;
    uint64_t random = environment_print_seed("test_segment editor", 6);
    arrays grid = arrays_grid(5, 0, &random);
    mw_mesh *mesh = arrays_mesh(&grid, (mw_mesh_options){.threads = 1});
    mw_editor *editor;
    mw_error error;
    expect_ok(mw_editor_create(mesh, NULL, &editor, &error), "an editor", &error);
    const mw_locator *locator = mw_editor_locator(editor);
    mw_cursor cursor = {.walk = 0};
    static mw_segment_piece piece[ROOM + 1];
    for (int i = 0; i < 40; i++) {
        double at[4];
        for (int k = 0; k < 4; k++) at[k] = (double)(mw__random(&random) % 21) / 4;
        mw_edit_insert(editor, at[0], at[1], NULL, &error);
        mw_segment s;
        expect_ok(mw_segment_begin(locator, &cursor, at, at + 2, &s, &error), "a segment", &error);
        size_t n = pieces_of(&s, piece);
        double sum = 0;
        for (size_t k = 0; k < n; k++) {
            sum += piece[k].to - piece[k].from;
            double middle = (piece[k].from + piece[k].to) / 2;
            mw_location where =
                mw_locate(locator, &(mw_cursor){.walk = 0}, at[0] + middle * (at[2] - at[0]),
                          at[1] + middle * (at[3] - at[1]));
            if (piece[k].along == 255) assert_int_equal(where.triangle, piece[k].triangle);
        }
        if (at[0] != at[2] || at[1] != at[3]) assert_true(fabs(sum - 1) < 1e-9);
    }
    mw_editor_destroy(editor);
    mw_mesh_destroy(mesh);
    arrays_free(&grid);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_grids),      cmocka_unit_test(test_scales),
        cmocka_unit_test(test_fan),        cmocka_unit_test(test_cut_triangles),
        cmocka_unit_test(test_widest),     cmocka_unit_test(test_memory),
        cmocka_unit_test(test_refusals),   cmocka_unit_test(test_editor),
        cmocka_unit_test(test_large_mesh),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
