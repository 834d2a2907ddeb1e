/* fuzz_star_project.c - an octahedron with bent facets, of any size and place, and rays of any
 * doubles: whatever is accepted meets each ray where exact rationals say, each coordinate rounded
 * once, one by one and in a batch. */
#include "oracle/star_oracle.h"

#include <math.h>
#include <meshwalk/meshwalk.h>
#include <stdlib.h>
#include <string.h>

enum { POINTS = 6, FACETS = 8, MOST_RAYS = 8 };

typedef struct ray_input {
    const uint8_t *byte;
    size_t left;
} ray_input;

static void ray_input_take(ray_input *in, void *to, size_t size)
{
    memset(to, 0, size);
    if (size > in->left) size = in->left;
    memcpy(to, in->byte, size);
    in->byte += size;
    in->left -= size;
}

/* A number of four bytes: a sign, an exponent of 2 that leaves room for products, and digits. */
static double next_number(ray_input *in)
{
    int8_t exponent;
    int16_t digits;
    uint8_t coarse;
    ray_input_take(in, &exponent, 1);
    ray_input_take(in, &coarse, 1);
    ray_input_take(in, &digits, 2);
    return ldexp(digits, (coarse & 1 ? 3 : 0) * exponent);
}

/* Each vertex on its half of an axis, and beside it by up to a quarter. */
static void make_points(ray_input *in, double centre[3], double point[3 * POINTS])
{
    for (int k = 0; k < 3; k++) centre[k] = next_number(in);
    double size = fabs(next_number(in)) + 0x1p-200;
    for (int v = 0; v < POINTS; v++)
        for (int k = 0; k < 3; k++) {
            int8_t digit;
            ray_input_take(in, &digit, 1);
            double part = digit / 512.0;
            if (v / 2 == k) part = (v % 2 ? -1 : 1) * (1.0 + part);
            point[3 * v + k] = centre[k] + size * part;
        }
}

static void check_ray(const mw_star *star, const double *point, const uint32_t *facet,
                      const double centre[3], const double q[3], const double meeting[3],
                      const mw_location *location)
{
    int answerable = isfinite(q[0]) && isfinite(q[1]) && isfinite(q[2]) &&
                     (q[0] != centre[0] || q[1] != centre[1] || q[2] != centre[2]);
    mw_star_cursor cursor;
    double alone[3];
    if (mw_star_cursor_init(star, NULL, &cursor, NULL)) abort();
    mw_location one = mw_star_project(star, &cursor, q, alone);
    if (memcmp(&one, location, sizeof one) != 0) abort();
    if (!answerable) {
        if (one.where != MW_BAD || !isnan(meeting[0]) || !isnan(alone[2])) abort();
        return;
    }
    if (memcmp(alone, meeting, sizeof alone) != 0) abort();
    mw_location should = star_oracle_locate(point, facet, FACETS, centre, q);
    if (one.triangle != should.triangle || one.where != should.where) abort();
    if (!star_oracle_is_meeting(point, facet + 3 * (size_t)one.triangle, centre, q, meeting))
        abort();
}

/* Rays of raw doubles; one of four goes through the middle of two vertices. */
static size_t make_rays(ray_input *in, const double *point, double *q)
{
    size_t n = 0;
    while (in->left && n < MOST_RAYS) {
        uint8_t how;
        double *ray = q + 3 * n++;
        ray_input_take(in, &how, 1);
        if (how % 4)
            for (int k = 0; k < 3; k++) ray[k] = next_number(in);
        else
            for (int k = 0; k < 3; k++)
                ray[k] = point[3 * (how / 4 % 6) + k] / 2 + point[3 * (how / 24 % 6) + k] / 2;
        if (how % 4 == 1) ray_input_take(in, ray, 3 * sizeof *ray);
    }
    return n;
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);
int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    static const uint32_t facet[3 * FACETS] = {0, 2, 4, 2, 1, 4, 1, 3, 4, 3, 0, 4,
                                               2, 0, 5, 1, 2, 5, 3, 1, 5, 0, 3, 5};
    double point[3 * POINTS], q[3 * MOST_RAYS], meeting[3 * MOST_RAYS];
    mw_location location[MOST_RAYS];
    ray_input in = {data, size};
    mw_star_options options = {.threads = 1};
    mw_star_query_options one = {.threads = 1};
    make_points(&in, options.centre, point);
    mw_arrays arrays = {
        .points = point, .point_count = POINTS, .triangles = facet, .triangle_count = FACETS};
    mw_surface *surface;
    mw_star *star;
    if (mw_surface_create(&arrays, NULL, &surface, NULL)) abort();
    if (mw_star_create(surface, &options, &star, NULL) == MW_OK) {
        size_t n = make_rays(&in, point, q);
        if (mw_star_project_batch(star, q, n, 3, &one, meeting, location, NULL)) abort();
        for (size_t i = 0; i < n; i++)
            check_ray(star, point, facet, options.centre, q + 3 * i, meeting + 3 * i, &location[i]);
    }
    mw_star_destroy(star);
    mw_surface_destroy(surface);
    return 0;
}
