/* test_remap.c - conservative weights, held against the areas of all pairs of cells in rationals;
 * sums that are conserved; pixels, faces, vertices, the sphere. */
/* wrap: malloc calloc realloc aligned_alloc */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include "oracle/clip/clip_oracle.h"
#include "support/allocations.h"
#include "support/environment.h"
#include "support/meshes.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define DEGREE (3.14159265358979323846 / 180)

/* A mesh and its cells; face NULL: triangles. */
typedef struct plot {
    arrays of;
    mw_mesh *mesh;
    mw_locator *locator;
    uint32_t *face;
    uint32_t cells;
} plot;

static plot plot_make(arrays of, uint32_t faces, uint64_t *random)
{
    plot p = {.of = of, .cells = faces ? faces : of.triangle_count};
    p.mesh = arrays_mesh(&p.of, (mw_mesh_options){.layout = (mw_mesh_layout)(of.point_count % 3)});
    p.locator = mesh_locator(p.mesh, (mw_locator_options){.threads = 1});
    if (faces) p.face = malloc((of.triangle_count + 1) * sizeof *p.face);
    for (uint32_t t = 0; t < of.triangle_count && faces; t++)
        p.face[t] = (uint32_t)(mw__random(random) % faces);
    return p;
}

static void plot_release(plot *p)
{
    mw_locator_destroy(p->locator);
    mw_mesh_destroy(p->mesh);
    free(p->face);
    arrays_free(&p->of);
}

static mw_remap_mesh plot_view(const plot *p)
{
    return (mw_remap_mesh){p->locator, p->face, p->face ? p->cells : 0};
}

static uint32_t cell_of(const plot *p, uint32_t t)
{
    return p->face ? p->face[t] : t;
}

/* A triangle, counter-clockwise; its vertices too. False if it is flat. */
static int triangle_of(const arrays *m, uint32_t t, double p[6], uint32_t v[3])
{
    memcpy(v, m->triangles + 3 * (size_t)t, 3 * sizeof *v);
    for (uint32_t k = 0; k < 3; k++)
        memcpy(p + 2 * (size_t)k, m->points + 2 * (size_t)v[k], 2 * sizeof *p);
    double side = mw_orient2d(p, p + 2, p + 4);
    if (side < 0) {
        double swap[2] = {p[2], p[3]};
        uint32_t vertex = v[1];
        memcpy(p + 2, p + 4, sizeof swap);
        memcpy(p + 4, swap, sizeof swap);
        v[1] = v[2];
        v[2] = vertex;
    }
    return side != 0;
}

/* Weights as a dense matrix of rows x columns, times the areas of their rows. */
static double *areas_of(const mw_remap *r, mw_operator_info *info)
{
    mw_operator_describe(r->weights, info);
    uint64_t *first = malloc(((size_t)info->rows + 1) * sizeof *first);
    uint32_t *column = malloc((info->entries + 1) * sizeof *column);
    double *weight = malloc((info->entries + 1) * sizeof *weight);
    double *dense = calloc((size_t)info->rows * info->columns + 1, sizeof *dense);
    mw_operator_copy(r->weights, first, column, weight);
    for (uint32_t i = 0; i < info->rows; i++)
        for (uint64_t e = first[i]; e < first[i + 1]; e++)
            dense[(size_t)i * info->columns + column[e]] = weight[e] * r->target_area[i];
    free(first);
    free(column);
    free(weight);
    return dense;
}

static void expect_near(double is, double should, double size)
{
    if (!(fabs(is - should) <= 0x1p-38 * size)) fail_msg("%.17g, not %.17g", is, should);
}

/* Rows sum up to fractions of the target, columns to those of the source. */
static void expect_sums(const mw_remap *r)
{
    mw_operator_info info;
    double *area = areas_of(r, &info), all = 0, sources = 0;
    for (uint32_t i = 0; i < info.rows; i++) {
        double sum = 0;
        for (uint32_t j = 0; j < info.columns; j++) sum += area[(size_t)i * info.columns + j];
        expect_near(sum, r->target_fraction[i] * r->target_area[i], r->target_area[i]);
        all += sum;
    }
    for (uint32_t j = 0; j < info.columns; j++) {
        double sum = 0;
        for (uint32_t i = 0; i < info.rows; i++) sum += area[(size_t)i * info.columns + j];
        expect_near(sum, r->source_fraction[j] * r->source_area[j], r->source_area[j]);
        sources += r->source_area[j];
    }
    expect_near(all, r->common_sum, r->source_sum);
    expect_near(sources, r->source_sum, r->source_sum);
    free(area);
}

/* Add to row `row` the integrals over polygon q of what each cell, or vertex, of the source is. */
static void add_should(const plot *a, const double *q, uint32_t m, bool vertices, double *row)
{
    double p[6];
    uint32_t v[3];
    for (uint32_t t = 0; t < a->of.triangle_count; t++) {
        if (!triangle_of(&a->of, t, p, v)) continue;
        if (!vertices) row[cell_of(a, t)] += clip_oracle_sums(p, NULL, q, m, NULL).area;
        for (int k = 0; k < 3 && vertices; k++) {
            double hat[3] = {k == 0, k == 1, k == 2};
            row[v[k]] += clip_oracle_sums(p, hat, q, m, NULL).above;
        }
    }
}

static void expect_entries(const mw_remap *r, const double *should, double size)
{
    mw_operator_info info;
    double *is = areas_of(r, &info);
    for (size_t i = 0; i < (size_t)info.rows * info.columns; i++) {
        expect_near(is[i], should[i], size);
        assert_true((is[i] > 0) == (should[i] > 0));
    }
    free(is);
}

static void expect_same(const mw_remap *a, const mw_remap *b)
{
    mw_operator_info one, two;
    double *x = areas_of(a, &one), *y = areas_of(b, &two);
    assert_memory_equal(&one, &two, sizeof one);
    assert_memory_equal(x, y, (size_t)one.rows * one.columns * sizeof *x);
    free(x);
    free(y);
}

static void expect_to_mesh(const plot *a, const plot *b, bool vertices)
{
    mw_remap_mesh source = plot_view(a), target = plot_view(b);
    mw_remap r, again;
    mw_error error;
    mw_remap_options options = {.threads = 1, .vertices = vertices};
    expect_ok(mw_remap_to_mesh(&source, &target, &options, &r, &error), "weights", &error);
    uint32_t columns = vertices ? a->of.point_count : a->cells, v[3];
    double *should = calloc((size_t)b->cells * columns + 1, sizeof *should), q[6];
    for (uint32_t t = 0; t < b->of.triangle_count; t++)
        if (triangle_of(&b->of, t, q, v))
            add_should(a, q, 3, vertices, should + (size_t)cell_of(b, t) * columns);
    expect_entries(&r, should, 1);
    expect_sums(&r);
    options.threads = 3;
    expect_ok(mw_remap_to_mesh(&source, &target, &options, &again, &error), "weights", &error);
    expect_same(&r, &again);
    free(should);
    mw_remap_release(&again);
    mw_remap_release(&r);
}

static arrays random_arrays(uint64_t *random, int round)
{
    arrays m = arrays_grid(2 + (uint32_t)(mw__random(random) % 3), round & 1 ? 0.6 : 0, random);
    arrays_punch(&m, (double)(mw__random(random) % 3) * 0.3, random);
    arrays_scramble(&m, 1, random);
    return m;
}

static void test_meshes(void **state)
{
    (void)state;
    uint64_t random = environment_print_seed("test_remap meshes", 1);
    for (int round = 0; round < (environment_is_long() ? 1000 : 24); round++) {
        arrays m = random_arrays(&random, round / 2);
        arrays_transform(&m, round % 3 ? 0.75 : 1, round % 4 ? 0.5 : 0, 0.25);
        plot a = plot_make(random_arrays(&random, round), round % 5 == 1 ? 4 : 0, &random),
             b = plot_make(m, round % 4 == 1 ? 3 : 0, &random);
        expect_to_mesh(&a, &b, round % 3 == 2);
        plot_release(&b);
        plot_release(&a);
    }
}

static void test_pixels(void **state)
{
    (void)state;
    uint64_t random = environment_print_seed("test_remap pixels", 2);
    for (int round = 0; round < (environment_is_long() ? 1000 : 20); round++) {
        bool vertices = round % 3 == 2;
        plot a = plot_make(random_arrays(&random, round), round % 4 == 3 ? 5 : 0, &random);
        mw_remap_mesh source = plot_view(&a);
        mw_remap_pixels pixels = {round % 2 ? 0 : -0.3, 4, round % 5 ? 0.7 : 1, 0.5, 5, 7};
        mw_remap r;
        mw_error error;
        mw_remap_options options = {.vertices = vertices};
        expect_ok(mw_remap_to_pixels(&source, &pixels, &options, &r, &error), "weights", &error);
        uint32_t columns = vertices ? a.of.point_count : a.cells;
        double *should = calloc(35 * (size_t)columns + 1, sizeof *should);
        for (uint32_t i = 0; i < 35; i++) {
            double west = pixels.west + i % 5 * pixels.width,
                   east = pixels.west + (i % 5 + 1) * pixels.width, north = 4 - i / 5 * 0.5;
            double q[8] = {west, north - 0.5, east, north - 0.5, east, north, west, north};
            add_should(&a, q, 4, vertices, should + (size_t)i * columns);
        }
        expect_entries(&r, should, 1);
        expect_sums(&r);
        free(should);
        mw_remap_release(&r);
        plot_release(&a);
    }
}

/* Many small pixels over triangles that they cover: nothing is lost, whatever their number, and far
 * from the origin. */
static void test_conserves(void **state)
{
    (void)state;
    uint64_t random = environment_print_seed("test_remap conserves", 3);
    arrays m = arrays_grid(6, 0.8, &random);
    arrays_transform(&m, 7, 2600000, 1200000);
    plot a = plot_make(m, 0, &random);
    mw_remap_mesh source = plot_view(&a);
    mw_remap_pixels pixels = {2599999.9, 1200042.1, 0.3, 0.3, 150, 150};
    mw_remap r;
    mw_error error;
    expect_ok(mw_remap_to_pixels(&source, &pixels, NULL, &r, &error), "weights", &error);
    for (uint32_t j = 0; j < a.cells; j++) assert_true(fabs(r.source_fraction[j] - 1) < 1e-12);
    assert_true(fabs(r.common_sum - r.source_sum) < 1e-12 * r.source_sum);
    mw_value_table table = {.values = r.source_area, .count = 1};
    double *values = malloc(150 * 150 * sizeof *values), is = 0, should = 0;
    mw_operator_apply_options apply = {.zero_empty = 1};
    expect_ok(mw_operator_apply(r.weights, &table, &apply, values, &error), "values", &error);
    for (uint32_t i = 0; i < 150 * 150; i++) is += values[i] * r.target_area[i];
    for (uint32_t j = 0; j < a.cells; j++) should += r.source_area[j] * r.source_area[j];
    assert_true(fabs(is - should) < 1e-12 * should);
    free(values);
    mw_remap_release(&r);

    /* The mean of the covered part. */
    mw_remap_options options = {.covered = 1};
    pixels.columns = pixels.rows = 3;
    expect_ok(mw_remap_to_pixels(&source, &pixels, &options, &r, &error), "weights", &error);
    double ones[72], mean[9];
    for (int j = 0; j < 72; j++) ones[j] = 1;
    table.values = ones;
    expect_ok(mw_operator_apply(r.weights, &table, NULL, mean, &error), "values", &error);
    for (int i = 0; i < 9; i++)
        assert_true(r.target_fraction[i] == 0 ? isnan(mean[i]) : fabs(mean[i] - 1) < 1e-12);
    mw_remap_release(&r);
    plot_release(&a);
}

/* The sphere: a triangle by itself, in pixels, and in the whole globe. */
static void test_degrees(void **state)
{
    (void)state;
    uint64_t random = environment_print_seed("test_remap degrees", 4);
    arrays m = arrays_grid(9, 0.7, &random);
    arrays_transform(&m, 20, -90, -90);
    plot a = plot_make(m, 0, &random);
    mw_remap_mesh source = plot_view(&a);
    mw_remap_pixels globe = {-180, 90, 1.5, 1.5, 240, 120};
    mw_remap_options options = {.degrees = 1};
    mw_remap r, back;
    mw_error error;
    expect_ok(mw_remap_to_pixels(&source, &globe, &options, &r, &error), "weights", &error);
    double whole = 0;
    for (uint32_t i = 0; i < 240 * 120; i++) whole += r.target_area[i];
    assert_true(fabs(whole - 720 * DEGREE) < 1e-11); /* 4 pi */
    assert_true(fabs(r.source_sum - 360 * DEGREE) < 1e-11);
    for (uint32_t j = 0; j < a.cells; j++) {
        assert_true(fabs(r.source_fraction[j] - 1) < 1e-11);
        /* By many strips of one latitude. */
        double p[6], sum = 0, step = 1e-3;
        uint32_t v[3];
        if (j % 40 || !triangle_of(&a.of, j, p, v)) continue;
        double low = fmin(p[1], fmin(p[3], p[5])), high = fmax(p[1], fmax(p[3], p[5]));
        for (double y = low + step / 2; y < high; y += step) {
            double x[2], n = 0;
            for (int k = 0; k < 3; k++) {
                const double *s = p + 2 * (size_t)k, *e = p + 2 * (size_t)((k + 1) % 3);
                if ((s[1] <= y) != (e[1] <= y))
                    x[(int)n++] = s[0] + (y - s[1]) / (e[1] - s[1]) * (e[0] - s[0]);
            }
            if (n == 2) sum += fabs(x[1] - x[0]) * cos(y * DEGREE) * step * DEGREE * DEGREE;
        }
        assert_true(fabs(r.source_area[j] - sum) < 1e-4 * sum);
    }
    mw_remap_release(&r);
    expect_ok(mw_remap_to_mesh(&source, &source, &options, &back, &error), "weights", &error);
    expect_sums(&back);
    mw_remap_release(&back);
    options.degrees = 1;
    arrays n = arrays_grid(2, 0, &random);
    arrays_transform(&n, 60, 0, 0);
    plot b = plot_make(n, 0, &random);
    mw_remap_mesh beyond = plot_view(&b);
    assert_int_equal(mw_remap_to_mesh(&source, &beyond, &options, &r, &error), MW_ERROR_INPUT);
    assert_int_equal(mw_remap_to_mesh(&beyond, &source, &options, &r, &error), MW_ERROR_INPUT);
    globe.north = 91;
    assert_int_equal(mw_remap_to_pixels(&source, &globe, &options, &r, &error), MW_ERROR_INPUT);
    plot_release(&b);
    plot_release(&a);
}

/* The area that a pixel and the whole source have in common. */
static double common_area(const mw_remap *r, size_t pixel)
{
    return r->target_fraction[pixel] * r->target_area[pixel];
}

/* Across the meridian of 180 degrees: the same mesh, raster and mesh in other turns. */
static void test_seam(void **state)
{
    (void)state;
    uint64_t random = environment_print_seed("test_remap seam", 7);
    const mw_remap_options options = {.degrees = 1};
    mw_remap_pixels west = {-180, 90, 1.5, 1.5, 240, 120}, east = {0, 90, 1.5, 1.5, 240, 120};
    mw_remap r, s;
    mw_error error;
    for (int turn = -1; turn <= 1; turn++) {
        uint64_t same = random;
        arrays m = arrays_grid(9, 0.7, &same), n = arrays_grid(5, 0.7, &same);
        arrays_transform(&m, 3, 165.3 + 360 * turn, -13);
        arrays_transform(&n, 9, -202.1, -21);
        plot a = plot_make(m, 0, &same), b = plot_make(n, 0, &same);
        mw_remap_mesh source = plot_view(&a), target = plot_view(&b);
        expect_ok(mw_remap_to_pixels(&source, &west, &options, &r, &error), "weights", &error);
        expect_ok(mw_remap_to_pixels(&source, &east, &options, &s, &error), "weights", &error);
        for (uint32_t j = 0; j < a.cells; j++) {
            assert_true(fabs(r.source_fraction[j] - 1) < 1e-11);
            assert_true(fabs(s.source_fraction[j] - 1) < 1e-11);
        }
        for (size_t i = 0; i < 240 * 120; i++) {
            size_t k = i / 240 * 240 + (i % 240 + 120) % 240;
            assert_true(fabs(common_area(&r, i) - common_area(&s, k)) < 1e-14);
        }
        assert_true(common_area(&r, 60 * 240) > 0 && common_area(&r, 60 * 240 + 239) > 0);
        mw_remap_release(&r);
        mw_remap_release(&s);
        expect_ok(mw_remap_to_mesh(&source, &target, &options, &r, &error), "weights", &error);
        for (uint32_t j = 0; j < a.cells; j++) assert_true(fabs(r.source_fraction[j] - 1) < 1e-11);
        mw_remap_release(&r);
        plot_release(&a);
        plot_release(&b);
    }
    /* More than once round the sphere, and triangles that are too wide to be sure of. */
    arrays n = arrays_grid(2, 0, &random), m = arrays_grid(41, 0, &random);
    for (uint32_t i = 0; i < n.point_count; i++) n.points[2 * i] *= 91;
    for (uint32_t i = 0; i < m.point_count; i++) m.points[2 * i] *= 9;
    plot a = plot_make(n, 0, &random), b = plot_make(m, 0, &random);
    mw_remap_mesh wide = plot_view(&a), round = plot_view(&b);
    expect_ok(mw_remap_to_pixels(&wide, &west, &options, &r, &error), "weights", &error);
    mw_remap_release(&r);
    assert_int_equal(mw_remap_to_pixels(&round, &west, &options, &r, &error), MW_ERROR_INPUT);
    assert_non_null(strstr(error.message, "more than once"));
    west.columns = 241;
    assert_int_equal(mw_remap_to_pixels(&wide, &west, &options, &r, &error), MW_ERROR_INPUT);
    west = (mw_remap_pixels){721, 90, 1.5, 1.5, 10, 120};
    assert_int_equal(mw_remap_to_pixels(&wide, &west, &options, &r, &error), MW_ERROR_INPUT);
    plot_release(&a);
    plot_release(&b);
    n = arrays_grid(1, 0, &random);
    for (uint32_t i = 0; i < n.point_count; i++) n.points[2 * i] *= 181;
    a = plot_make(n, 0, &random);
    wide = plot_view(&a);
    assert_int_equal(mw_remap_to_pixels(&wide, &east, &options, &r, &error), MW_ERROR_INPUT);
    assert_non_null(strstr(error.message, "meridian of 180 degrees"));
    plot_release(&a);
}

/* --- a globe, cut ----------------------------------------------------------------------------- */

/* Vertices at the poles; triangles with the poles inside. Both fill the sphere. */
static const double octahedron[] = {0, 0, 90, 0, 180, 0, -90, 0, 17, 90, 5, -90},
                    caps[] = {10, 60, 130, 60, -110, 60, 70, -45, -170, -45, -50, -45};
static const uint32_t octahedron_triangles[] = {0, 1, 4, 1, 2, 4, 2, 3, 4, 3, 0, 4,
                                                1, 0, 5, 2, 1, 5, 3, 2, 5, 0, 3, 5},
                      caps_triangles[] = {0, 1, 2, 5, 4, 3, 0, 3, 1, 1, 3, 4,
                                          1, 4, 2, 2, 4, 5, 2, 5, 0, 0, 5, 3};

static mw_arrays globe_arrays(const double *points, const uint32_t *triangles)
{
    return (mw_arrays){
        .points = points, .point_count = 6, .triangles = triangles, .triangle_count = 8};
}

/* The pieces fill the plane of longitudes and latitudes once, turn no other way than the triangles,
 * and a field has what it has in between. */
static void expect_pieces(const mw_arrays *globe, const double *field, bool is_latitude)
{
    mw_seam_pieces pieces;
    mw_error error;
    assert_int_equal(mw_seam_crosses(globe), 1);
    expect_ok(mw_seam_cut(globe, NULL, &pieces, &error), "pieces", &error);
    double area = 0, *values = malloc(pieces.point_count * sizeof *values);
    for (size_t t = 0; t < pieces.triangle_count; t++) {
        const double *p[3];
        for (size_t k = 0; k < 3; k++) p[k] = pieces.points + 2 * pieces.triangles[3 * t + k];
        assert_true(mw_orient2d(p[0], p[1], p[2]) > 0);
        assert_true(pieces.faces[t] < 8);
        area += mw_orient2d(p[0], p[1], p[2]) / 2;
    }
    expect_near(area, 360 * 180, 1e4);
    const mw_value_table table = {.values = field, .count = 1};
    expect_ok(mw_operator_apply(pieces.values, &table, NULL, values, &error), "values", &error);
    for (size_t i = 0; i < pieces.point_count; i++) {
        const double *p = pieces.points + 2 * i;
        assert_true(p[0] >= pieces.west && p[0] <= pieces.west + 360);
        expect_near(values[i], is_latitude ? p[1] : 7, 90);
    }
    free(values);
    mw_seam_pieces_release(&pieces);
    assert_null(pieces.points);
}

static void test_globe(void **state)
{
    (void)state;
    double latitude[6], same[6] = {7, 7, 7, 7, 7, 7}, turned[12];
    mw_arrays octa = globe_arrays(octahedron, octahedron_triangles),
              two = globe_arrays(caps, caps_triangles);
    for (int i = 0; i < 6; i++) latitude[i] = octahedron[2 * i + 1];
    expect_pieces(&octa, latitude, true);
    expect_pieces(&octa, same, false);
    expect_pieces(&two, same, false);
    for (int i = 0; i < 12; i++) turned[i] = caps[i] + (i % 2 == 0 && caps[i] < 0 ? 360 : 0);
    two = globe_arrays(turned, caps_triangles);
    expect_pieces(&two, same, false);
}

static void test_globe_memory_and_refusals(void **state)
{
    (void)state;
    const uint32_t far[] = {0, 1, 6};
    double points[12];
    mw_seam_pieces pieces = {0};
    mw_error error;
    mw_arrays two = globe_arrays(caps, caps_triangles);
    for (long failures = 0;; failures++) {
        allocations_left = failures;
        mw_status status = mw_seam_cut(&two, NULL, &pieces, &error);
        bool failed = allocations_left < 0;
        allocations_left = -1;
        assert_int_equal(status, failed ? MW_ERROR_MEMORY : MW_OK);
        if (!failed) {
            assert_true(failures > 6);
            mw_seam_pieces_release(&pieces);
            break;
        }
        assert_null(pieces.points);
    }
    assert_int_equal(mw_seam_cut(NULL, NULL, &pieces, &error), MW_ERROR_ARGUMENT);
    assert_int_equal(mw_seam_cut(&two, NULL, NULL, &error), MW_ERROR_ARGUMENT);
    two.integer_type = MW_INT64;
    assert_int_equal(mw_seam_cut(&two, NULL, &pieces, &error), MW_ERROR_ARGUMENT);
    two = (mw_arrays){.points = caps, .point_count = 6, .triangles = far, .triangle_count = 1};
    assert_int_equal(mw_seam_cut(&two, NULL, &pieces, &error), MW_ERROR_INPUT);
    two = globe_arrays(points, caps_triangles);
    for (int i = 0; i < 12; i++) points[i] = caps[i] - (i % 2 ? 0 : 20);
    assert_int_equal(mw_seam_cut(&two, NULL, &pieces, &error), MW_ERROR_INPUT);
    assert_non_null(strstr(error.message, "longitudes, from -190 to 110, have to lie"));
    points[0] = NAN;
    assert_int_equal(mw_seam_crosses(&two), 0);
    assert_int_equal(mw_seam_cut(&two, NULL, &pieces, &error), MW_ERROR_INPUT);
    assert_null(pieces.values);
    mw_seam_pieces_release(NULL);
}

static void test_memory(void **state)
{
    (void)state;
    uint64_t random = 5;
    plot a = plot_make(arrays_grid(3, 0.5, &random), 0, &random);
    mw_remap_mesh mesh = plot_view(&a);
    mw_remap_options options = {.threads = 1};
    for (long failures = 0;; failures++) {
        mw_remap r;
        mw_error error = {0};
        allocations_left = failures;
        mw_status status = mw_remap_to_mesh(&mesh, &mesh, &options, &r, &error);
        bool failed = allocations_left < 0;
        allocations_left = -1;
        assert_int_equal(status, failed ? MW_ERROR_MEMORY : MW_OK);
        if (!failed) {
            assert_true(failures > 12);
            mw_remap_release(&r);
            break;
        }
        assert_null(r.weights);
        assert_null(r.target_area);
    }
    plot_release(&a);
}

static void test_refusals(void **state)
{
    (void)state;
    uint64_t random = 6;
    plot a = plot_make(arrays_grid(3, 0, &random), 4, &random);
    mw_remap_mesh mesh = plot_view(&a), none = {0}, few = mesh;
    mw_remap_pixels p = {0, 3, 1, 1, 3, 3}, flat = {0, 3, 1, 0, 3, 3},
                    small = {1e6, 3, 1e-9, 1, 1, 1};
    mw_remap r;
    mw_error error;
    few.face_count = 1;
    assert_int_equal(mw_remap_to_mesh(&none, &mesh, NULL, &r, &error), MW_ERROR_ARGUMENT);
    assert_int_equal(mw_remap_to_mesh(&mesh, &none, NULL, &r, &error), MW_ERROR_ARGUMENT);
    assert_int_equal(mw_remap_to_mesh(&mesh, &few, NULL, &r, &error), MW_ERROR_ARGUMENT);
    assert_int_equal(mw_remap_to_mesh(&mesh, &mesh, NULL, NULL, &error), MW_ERROR_ARGUMENT);
    assert_int_equal(mw_remap_to_pixels(&mesh, NULL, NULL, &r, &error), MW_ERROR_ARGUMENT);
    assert_int_equal(mw_remap_to_pixels(&mesh, &flat, NULL, &r, &error), MW_ERROR_ARGUMENT);
    assert_int_equal(mw_remap_to_pixels(&mesh, &small, NULL, &r, &error), MW_ERROR_LIMIT);
    p.columns = p.rows = 1 << 16;
    assert_int_equal(mw_remap_to_pixels(&mesh, &p, NULL, &r, &error), MW_ERROR_LIMIT);
    assert_null(r.weights);
    plot_release(&a);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_meshes),    cmocka_unit_test(test_pixels),
        cmocka_unit_test(test_conserves), cmocka_unit_test(test_degrees),
        cmocka_unit_test(test_seam),      cmocka_unit_test(test_globe),
        cmocka_unit_test(test_memory),    cmocka_unit_test(test_globe_memory_and_refusals),
        cmocka_unit_test(test_refusals),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
