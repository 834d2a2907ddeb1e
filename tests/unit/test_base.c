/* test_base.c - the Hilbert curve and its sort; random numbers; checked allocation; checksums. */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include "base/base.h"
#include "base/checksum.h"
#include "base/hilbert.h"
#include "base/team_sort.h"
#include "base/job.h"
#include "base/random.h"

#include <math.h>
#include <meshwalk/locate.h>
#include <meshwalk/version.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Consecutive cells on the curve are neighbours, and each cell comes once, wherever the extent is.
 */
static void curve_check(double x0, double y0)
{
    enum { SIDE = 256, SHIFT = 16 }; /* 256 x 256 cells: keys that are multiples of 2^16 */
    static uint32_t at[SIDE * SIDE];
    const double low[2] = {x0, y0}, high[2] = {x0 + SIDE, y0 + SIDE};
    mw_hilbert hilbert = mw__hilbert(low, high);
    memset(at, 0xff, sizeof at);
    for (uint32_t x = 0; x < SIDE; x++)
        for (uint32_t y = 0; y < SIDE; y++) {
            uint32_t rank = mw__hilbert_key(&hilbert, x0 + x + 0.5, y0 + y + 0.5) >> SHIFT;
            assert_int_equal(at[rank], UINT32_MAX);
            at[rank] = x << 8 | y;
        }
    for (uint32_t i = 1; i < SIDE * SIDE; i++) {
        int dx = (int)(at[i] >> 8) - (int)(at[i - 1] >> 8),
            dy = (int)(at[i] & 255) - (int)(at[i - 1] & 255);
        assert_int_equal(abs(dx) + abs(dy), 1);
    }
}

static void test_curve(void **state)
{
    (void)state;
    curve_check(0, 0);
    curve_check(-100, 5000);
}

/* Points on the rim, beyond it, not finite, and extents without width or of the whole range. */
static void test_odd_extents(void **state)
{
    (void)state;
    const double extents[][4] = {{0, 0, 0, 0},
                                 {1, 1, 1, 5},
                                 {-1.7e308, -1.7e308, 1.7e308, 1.7e308},
                                 {0, 0, 5e-324, 5e-324},
                                 {INFINITY, INFINITY, -INFINITY, -INFINITY}};
    const double values[] = {0, 1, -1, 1e308, -1e308, INFINITY, -INFINITY, NAN, 5e-324};
    for (size_t e = 0; e < sizeof extents / sizeof *extents; e++) {
        mw_hilbert hilbert = mw__hilbert(extents[e], extents[e] + 2);
        for (size_t i = 0; i < 9; i++) /* UBSan looks on */
            for (size_t j = 0; j < 9; j++) (void)mw__hilbert_key(&hilbert, values[i], values[j]);
    }
    const double low[2] = {0, 0}, high[2] = {1, 1};
    mw_hilbert hilbert = mw__hilbert(low, high);
    assert_int_equal(mw__hilbert_key(&hilbert, 0, 0), 0);
    assert_int_equal(mw__hilbert_key(&hilbert, 2, -1), UINT32_MAX);
}

static void test_sort(void **state)
{
    (void)state;
    uint64_t random = 1;
    for (uint32_t n = 0; n < 5000; n = n * 3 + 1) {
        mw_key *key = malloc((4 * (size_t)n + 1) * sizeof *key), *given = key + 2 * (size_t)n,
               *again = key + 3 * (size_t)n;
        for (uint32_t i = 0; i < n; i++)
            key[i] = given[i] = (mw_key){(uint32_t)mw__random(&random) >> (n % 2 ? 0 : 24), i};
        mw__sort_keys(key, key + n, n);
        for (uint32_t i = 1; i < n; i++)
            assert_true(key[i - 1].key < key[i].key ||
                        (key[i - 1].key == key[i].key && key[i - 1].item < key[i].item));
        for (uint32_t team = 1; n > 0 && team < 6; team++) {
            memcpy(again, given, n * sizeof *again);
            mw__sort_keys_in_team(again, key + n, n, team);
            assert_memory_equal(again, key, n * sizeof *key);
        }
        free(key);
    }
}

static void test_random_below(void **state)
{
    (void)state;
    uint64_t random = 2;
    uint32_t count[7] = {0};
    for (int i = 0; i < 70000; i++) count[mw__random_below(&random, 7)]++;
    for (int i = 0; i < 7; i++) assert_in_range(count[i], 9500, 10500);
}

static void test_allocation(void **state)
{
    (void)state;
    assert_null(mw__alloc(SIZE_MAX / 2, 3));
    assert_null(mw__calloc(SIZE_MAX / 2, 3));
    assert_null(mw__alloc_lines(SIZE_MAX / 2, 3));
    assert_null(mw__alloc_lines(SIZE_MAX, 1));
    void *nothing = mw__alloc(0, 8);
    assert_non_null(nothing);
    free(nothing);
    for (size_t n = 0; n < 200; n += 7) {
        char *lines = mw__alloc_lines(n, 3);
        assert_true(lines && (uintptr_t)lines % 64 == 0);
        memset(lines, 1, 3 * n);
        free(lines);
    }
}

static void test_errors(void **state)
{
    (void)state;
    mw_error error;
    assert_int_equal(mw__fail_at(&error, 3, 4, "%s", "here"), MW_ERROR_INPUT);
    assert_string_equal(error.message, "here");
    assert_int_equal(error.triangle, 3);
    assert_int_equal(error.vertex, 4);
    assert_int_equal(error.line, -1);
    assert_int_equal(mw__fail(NULL, MW_ERROR_LIMIT, "nobody listens"), MW_ERROR_LIMIT);
    for (int status = 0; status <= MW_STATUS_COUNT; status++)
        assert_non_null(mw_status_text((mw_status)status));
    assert_string_equal(mw_version(), MW_VERSION_STRING);
    char version[32];
    snprintf(version, sizeof version, "%d.%d.%d", MW_VERSION_MAJOR, MW_VERSION_MINOR,
             MW_VERSION_PATCH);
    assert_string_equal(version, MW_VERSION_STRING);
}

/* --- ranges and counters ---------------------------------------------------------------------- */

static void ranges_mark(void *work, uint64_t from, uint64_t to)
{
    for (uint64_t i = from; i < to; i++) ((uint8_t *)work)[i]++;
}

/* Ranges cover all items once, however many there are. */
static void test_ranges(void **state)
{
    (void)state;
    static const uint64_t counts[] = {0, 1, 16383, 16384, 16385, 32768, 32769, 50000};
    for (size_t i = 0; i < sizeof counts / sizeof *counts; i++) {
        uint8_t *done = calloc(counts[i] + 1, 1);
        assert_non_null(done);
        mw_job job = mw__job(1, NULL);
        assert_true(mw__job_ranges(&job, counts[i], ranges_mark, done));
        for (uint64_t k = 0; k < counts[i]; k++) assert_int_equal(done[k], 1);
        assert_int_equal(done[counts[i]], 0);
        free(done);
    }
}

/* Every counter is added, or the larger one kept. */
static void test_counters(void **state)
{
    (void)state;
    enum { COUNT = sizeof(mw_counters) / sizeof(uint64_t) };
    static const size_t most[] = {
        offsetof(mw_counters, triangles_max), offsetof(mw_counters, triangles_walk_max),
        offsetof(mw_counters, triangles_final_max), offsetof(mw_counters, triangles_border_max),
        offsetof(mw_counters, border_edges_max)};
    uint64_t sum[COUNT], more[COUNT];
    for (size_t i = 0; i < COUNT; i++) {
        sum[i] = i % 2 ? 100 + i : 200 + i;
        more[i] = i % 2 ? 200 : 100;
    }
    mw_counters a, b;
    memcpy(&a, sum, sizeof a);
    memcpy(&b, more, sizeof b);
    mw_counters_add(&a, &b);
    uint64_t got[COUNT];
    memcpy(got, &a, sizeof got);
    for (size_t i = 0; i < COUNT; i++) {
        uint64_t larger = sum[i] > more[i] ? sum[i] : more[i];
        bool is_most = false;
        for (size_t k = 0; k < sizeof most / sizeof *most; k++) is_most |= most[k] == 8 * i;
        assert_int_equal(got[i], is_most ? larger : sum[i] + more[i]);
    }
}

/* Checksums: values of the specification, and pieces of any lengths. */
static void test_checksums(void **state)
{
    static const char text[] = "Nobody inspects the spammish repetition";
    char long_text[500];
    (void)state;
    assert_true(mw__checksum_of("", 0) == UINT64_C(0xEF46DB3751D8E999));
    assert_true(mw__checksum_of("a", 1) == UINT64_C(0xD24EC4F1A98C6E5B));
    assert_true(mw__checksum_of("abc", 3) == UINT64_C(0x44BC2CF5AD770999));
    assert_true(mw__checksum_of(text, sizeof text - 1) == UINT64_C(0xFBCEA83C8A378BF1));
    assert_true(mw__checksum_of(text, 31) == UINT64_C(0xC1A0E0AE86E1D78C));
    assert_true(mw__checksum_of(text, 32) == UINT64_C(0x96F5BFCBFE7F0D1A)); /* one whole stripe */
    assert_true(mw__checksum_of(text, 33) == UINT64_C(0x977F4AA19D128181));
    for (size_t i = 0; i < sizeof long_text; i++) long_text[i] = (char)(i * i);
    for (size_t piece = 1; piece < 100; piece++) {
        mw_checksum sum = {0};
        for (size_t i = 0; i < sizeof long_text; i += piece)
            mw__checksum_add(&sum, long_text + i,
                             sizeof long_text - i < piece ? sizeof long_text - i : piece);
        assert_true(mw__checksum_end(&sum) == mw__checksum_of(long_text, sizeof long_text));
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_curve),      cmocka_unit_test(test_odd_extents),
        cmocka_unit_test(test_sort),       cmocka_unit_test(test_random_below),
        cmocka_unit_test(test_allocation), cmocka_unit_test(test_errors),
        cmocka_unit_test(test_ranges),     cmocka_unit_test(test_counters),
        cmocka_unit_test(test_checksums),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
