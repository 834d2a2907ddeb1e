/* test_io_number.c - numbers as text, both ways, against the C library, and in a locale with a
 * decimal comma. */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include "base/random.h"
#include "io/text/number_text.h"

#include <locale.h>
#include <math.h>
#include <meshwalk/io.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

static uint64_t bits_of(double x)
{
    uint64_t bits;
    memcpy(&bits, &x, sizeof bits);
    return bits;
}

static double of_bits(uint64_t bits)
{
    double x;
    memcpy(&x, &bits, sizeof x);
    return x;
}

/* The shortest of %.15g, %.16g, %.17g that reads back, by the C library. */
static void library_text(char text[64], double v)
{
    for (int precision = 15; precision <= 17; precision++) {
        snprintf(text, 64, "%.*g", precision, v);
        if (strtod(text, NULL) == v) return;
    }
}

static void expect_text(double v)
{
    char text[32], wanted[64];
    memset(text, 'x', sizeof text);
    size_t length = mw_format_double(v, text);
    library_text(wanted, v);
    if (strcmp(text, wanted) != 0 || strlen(text) != length)
        fail_msg("%a is written as '%s' instead of '%s'", v, text, wanted);
}

static void expect_number(const char *text)
{
    double value;
    const char *end = mw__read_double(text, &value);
    double wanted = strtod(text, NULL);
    if (!end || *end || bits_of(value) != bits_of(wanted))
        fail_msg("'%s' is read as %a, not %a", text, value, wanted);
}

static uint64_t new_seed(void)
{
    uint64_t seed = (uint64_t)time(NULL);
    print_message("seed %llu\n", (unsigned long long)seed);
    return seed;
}

/* Doubles of many kinds: any bits, unit interval, few decimals, all exponents, beside powers of
 * ten and of two. */
static double random_double(uint64_t *random, int kind)
{
    uint64_t b = mw__random(random);
    double v;
    switch (kind) {
    case 0: v = of_bits(b); break;
    case 1: v = (double)(b >> 11) * 0x1p-53; break;
    case 2: v = (double)(int64_t)(b % 1000000000000) / pow(10, (double)(b >> 60)); break;
    case 3: v = ldexp((double)(b >> 11), (int)(b % 200) - 120); break;
    case 4: v = pow(10, (double)(int)(b % 64) - 22); break;
    default: v = ldexp(1, (int)(b % 300) - 150); break;
    }
    if (kind >= 4 && (b >> 60 & 3) == 1) v = nextafter(v, 0);
    if (kind >= 4 && (b >> 60 & 3) == 2) v = nextafter(v, INFINITY);
    if (kind > 0 && b >> 63) v = -v;
    return isfinite(v) ? v : 0.5;
}

static void test_write_random(void **state)
{
    (void)state;
    uint64_t random = new_seed();
    for (int i = 0; i < 1200000; i++) expect_text(random_double(&random, i % 6));
}

static void test_read_random(void **state)
{
    (void)state;
    uint64_t random = new_seed();
    char text[512];
    for (int i = 0; i < 300000; i++) {
        double v = random_double(&random, i % 6);
        snprintf(text, sizeof text, "%.*e", (int)(mw__random(&random) % 24), v);
        expect_number(text);
        if (fabs(v) < 1e25) {
            snprintf(text, sizeof text, "%.*f", (int)(mw__random(&random) % 24), v);
            expect_number(text);
        }
        uint64_t digits = mw__random(&random) >> mw__random_below(&random, 60);
        snprintf(text, sizeof text, "%llue%d", (unsigned long long)digits,
                 (int)mw__random_below(&random, 70) - 35);
        expect_number(text);
    }
}

/* Decimals that lie in the middle of two doubles, or a digit beside it: 2^53 + 1 and its like. */
static void test_read_middles(void **state)
{
    (void)state;
    uint64_t random = new_seed();
    char text[128];
    for (int i = 0; i < 100000; i++) {
        /* 54 bits, the last one set */
        uint64_t middle = (mw__random(&random) >> 10 | UINT64_C(1) << 53) | 1;
        int shift = (int)mw__random_below(&random, 9);
        snprintf(text, sizeof text, "%llu", (unsigned long long)(middle << shift));
        expect_number(text);
        snprintf(text, sizeof text, "%llu.0000001", (unsigned long long)middle);
        expect_number(text);
        snprintf(text, sizeof text, "%llu.%d", (unsigned long long)(middle >> 3),
                 (int)(mw__random(&random) % 8) * 125);
        expect_number(text);
        snprintf(text, sizeof text, "%.60e", ldexp((double)(middle >> 1), -60));
        expect_number(text);
    }
}

static void test_written_text(void **state)
{
    (void)state;
    const struct {
        double value;
        const char *text;
    } cases[] = {
        {0, "0"},
        {-0.0, "-0"},
        {1, "1"},
        {-1, "-1"},
        {0.1, "0.1"},
        {-0.25, "-0.25"},
        {1.0 / 3, "0.3333333333333333"},
        {0.1 + 0.2, "0.30000000000000004"},
        {637176.34, "637176.34"},
        {1e-4, "0.0001"},
        {1e-5, "1e-05"},
        {123456789012345, "123456789012345"},
        {1e15, "1e+15"},
        {9007199254740993.0, "9007199254740992"},
        {1e21, "1e+21"},
        {1e22, "1e+22"},
        {1e23, "1e+23"},
        {9.5367431640625e-07, "9.5367431640625e-07"},
        {5e-324, "4.94065645841247e-324"},
        {2.2250738585072014e-308, "2.2250738585072014e-308"},
        {1.7976931348623157e308, "1.7976931348623157e+308"},
        {-1.7976931348623157e308, "-1.7976931348623157e+308"},
        {INFINITY, "inf"},
        {-INFINITY, "-inf"},
        {NAN, "nan"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        char text[32];
        assert_int_equal(mw_format_double(cases[i].value, text), strlen(cases[i].text));
        assert_string_equal(text, cases[i].text);
    }
    for (int e = -1074; e <= 1023; e++) {
        double v = ldexp(1, e);
        expect_text(v);
        expect_text(nextafter(v, 0) > 0 ? nextafter(v, 0) : v);
        expect_text(nextafter(v, INFINITY));
    }
    for (int e = -323; e <= 308; e++) {
        char text[16];
        snprintf(text, sizeof text, "1e%d", e);
        expect_text(strtod(text, NULL));
    }
}

static void test_read_text(void **state)
{
    (void)state;
    static const char *const numbers[] = {"0",
                                          "-0",
                                          "+1",
                                          "1.",
                                          ".5",
                                          "-.5e1",
                                          "1e5",
                                          "1E+5",
                                          "1e-5",
                                          "00012",
                                          "0.1",
                                          "1e400",
                                          "-1e400",
                                          "1e-400",
                                          "4.9406564584124654e-324",
                                          "2.4703282292062327e-324",
                                          "2.4703282292062328e-324",
                                          "1.7976931348623157e308",
                                          "1.7976931348623158e308",
                                          "1.7976931348623159e308",
                                          "9007199254740993",
                                          "9007199254740992.9999999999999999999",
                                          "0.000000000000000000000000000000123",
                                          "123456789012345678901234567890",
                                          "18446744073709551616",
                                          "1e23",
                                          "8.5e22",
                                          "0.28764899999999999",
                                          "1e99999999999999999999",
                                          "-0e99999999999999999999",
                                          "0.5e-0",
                                          "nan",
                                          "inf",
                                          "-inf",
                                          "infinity",
                                          "-Infinity"};
    for (size_t i = 0; i < sizeof numbers / sizeof *numbers; i++) {
        double value;
        const char *end = mw__read_double(numbers[i], &value);
        assert_non_null(end);
        assert_int_equal(*end, 0);
        double wanted = strtod(numbers[i], NULL);
        assert_true(bits_of(value) == bits_of(wanted) || (isnan(value) && isnan(wanted)));
    }
    double value;
    const char *fortran = "-1.5D+03";
    assert_ptr_equal(mw__read_double(fortran, &value), fortran + 8);
    assert_true(value == -1500);
    fortran = "1.25d300";
    assert_ptr_equal(mw__read_double(fortran, &value), fortran + 8);
    assert_true(value == 1.25e300);
}

/* Where a number ends, and what is none. */
static void test_read_rest(void **state)
{
    (void)state;
    const struct {
        const char *text, *rest;
    } cases[] = {{"1,5", ",5"},   {"1e", "e"},        {"1e+", "e+"}, {"0x10", "x10"},
                 {"1.2.3", ".3"}, {"12abc", "abc"},   {"nano", "o"}, {"1 2", " 2"},
                 {"inf2", "2"},   {"infinit", "init"}};
    double value;
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++)
        assert_string_equal(mw__read_double(cases[i].text, &value), cases[i].rest);
    static const char *const none[] = {"",    "-",   "+",   ".",  "-.", "e5", ".e5",
                                       "abc", "--1", "+-1", " 1", "na", ",5"};
    for (size_t i = 0; i < sizeof none / sizeof *none; i++)
        assert_null(mw__read_double(none[i], &value));
    char large[1200];
    memset(large, '7', sizeof large);
    large[1000] = 0;
    assert_non_null(mw__read_double(large, &value));
    assert_true(value == INFINITY);
    large[1000] = '7';
    large[1001] = 0;
    assert_null(mw__read_double(large, &value));
}

static void test_read_integers(void **state)
{
    (void)state;
    const struct {
        const char *text, *rest;
        int64_t value;
    } cases[] = {{"0", "", 0},
                 {"-0", "", 0},
                 {"+17", "", 17},
                 {"12/3", "/3", 12},
                 {"1.5", ".5", 1},
                 {"4294967296", "", INT64_C(4294967296)},
                 {"9223372036854775807", "", INT64_MAX},
                 {"9223372036854775808", "", INT64_MAX},
                 {"-9223372036854775808", "", INT64_MIN},
                 {"-9223372036854775809", "", INT64_MIN},
                 {"99999999999999999999999999", "", INT64_MAX},
                 {"-99999999999999999999999999", "", INT64_MIN}};
    int64_t value;
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        assert_string_equal(mw__read_integer(cases[i].text, &value), cases[i].rest);
        assert_true(value == cases[i].value);
    }
    static const char *const none[] = {"", "-", "x", " 1", "--1"};
    for (size_t i = 0; i < sizeof none / sizeof *none; i++)
        assert_null(mw__read_integer(none[i], &value));
}

/* The locale of the program has no say. */
static void test_locale(void **state)
{
    (void)state;
    static const char *const names[] = {"de_DE.UTF-8", "fr_FR.UTF-8", "de_DE", "cs_CZ.UTF-8",
                                        "nl_NL.UTF-8"};
    const char *set = NULL;
    for (size_t i = 0; i < sizeof names / sizeof *names && !set; i++)
        set = setlocale(LC_ALL, names[i]);
    if (!set || localeconv()->decimal_point[0] != ',') {
        setlocale(LC_ALL, "C");
        print_message("left out: no locale with a decimal comma is installed\n");
        skip();
    }
    char text[32];
    double value = 0;
    bool right = true;
    const double all[] = {0.5, 1.0 / 3, 1.5e-300, 1.2345678901234567e300, 5e-324};
    for (size_t i = 0; i < sizeof all / sizeof *all; i++) {
        mw_format_double(all[i], text);
        right = right && !strchr(text, ',') && mw__read_double(text, &value) && value == all[i];
    }
    right = right && mw__read_double("1.25e-310", &value) && value == 1.25e-310;
    setlocale(LC_ALL, "C");
    assert_true(right);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_write_random),  cmocka_unit_test(test_read_random),
        cmocka_unit_test(test_read_middles),  cmocka_unit_test(test_written_text),
        cmocka_unit_test(test_read_text),     cmocka_unit_test(test_read_rest),
        cmocka_unit_test(test_read_integers), cmocka_unit_test(test_locale),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
