/* test_lonlat_cut.c - faces in longitudes and latitudes: across 180 degrees they are cut as the
 * same faces elsewhere are, and round a pole or at it as they lie on the globe. */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>
#include <string.h>

#include "io/mesh/lonlat_cut.h"

enum { MOST = 6, LARGE = 65 };

typedef struct face {
    size_t count;
    double at[MOST][2];
} face;

/* Cut a face after all its longitudes are turned; the first vertex is not the lowest. */
static bool cut_turned(const face *f, double turn, uint32_t *triangles)
{
    double points[3 * MOST];
    uint32_t corners[MOST];
    for (size_t i = 0; i < f->count; i++) {
        const uint32_t vertex = (uint32_t)((i + 2) % f->count);
        double lon = f->at[i][0] + turn;
        if (lon > 180) lon -= 360;
        corners[i] = vertex;
        memcpy(points + 3 * vertex, (double[]){lon, f->at[i][1], 0}, 3 * sizeof *points);
    }
    return mw__lonlat_cut(points, corners, f->count, triangles);
}

static void test_seam(void **state)
{
    static const face faces[] = {
        {4, {{0, 0}, {20, 0}, {21, 10}, {0, 11}}},
        {5, {{0, 0}, {20, 0}, {25, 10}, {10, 15}, {-5, 10}}},
        {6, {{0, 0}, {10, 0}, {20, 0}, {20, 10}, {10, 10}, {0, 10}}},
        {4, {{0, 80}, {20, 80}, {20, 85}, {7, 90}}},
        {4, {{0, -80}, {90, -85}, {180, -80}, {-90, -80}}},
    };
    (void)state;
    for (size_t k = 0; k < sizeof faces / sizeof *faces; k++) {
        uint32_t here[3 * MOST], there[3 * MOST];
        assert_true(cut_turned(&faces[k], 0, here));
        for (int turn = 5; turn <= 180; turn += 5) {
            assert_true(cut_turned(&faces[k], turn, there));
            assert_memory_equal(here, there, 3 * (faces[k].count - 2) * sizeof *here);
        }
    }
}

/* A ring round the pole is convex, or has a corner that points inwards. */
static void test_pole(void **state)
{
    static const face ring = {4, {{0, 60}, {120, 60}, {-120, 60}, {-60, 60}}};
    uint32_t triangles[3 * MOST];
    (void)state;
    assert_true(cut_turned(&ring, 0, triangles));
    assert_false(cut_turned(&(face){4, {{0, 60}, {120, 60}, {-120, 60}, {-60, 85}}}, 0, triangles));
}

static void test_refused(void **state)
{
    static const face dart = {4, {{175, 0}, {-175, 0}, {180, 2}, {180, 10}}},
                      belt = {4, {{0, 0}, {90, 0}, {180, 0}, {-90, 0}}};
    static double points[3 * LARGE];
    static uint32_t corners[LARGE], triangles[3 * LARGE];
    (void)state;
    assert_false(cut_turned(&dart, 0, triangles));
    assert_false(cut_turned(&belt, 0, triangles));
    for (uint32_t i = 0; i < LARGE; i++) {
        corners[i] = i;
        points[3 * i] = i % 2 ? -179 : 179;
    }
    assert_false(mw__lonlat_cut(points, corners, LARGE, triangles));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_seam),
        cmocka_unit_test(test_pole),
        cmocka_unit_test(test_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
