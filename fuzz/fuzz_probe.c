/* fuzz_probe.c - lines against a few triangles anywhere, on small integers: certain probes, as
 * they were made and after the surface has moved, against every triangle in turn; and what the
 * walks tell of is touched. */
#include <meshwalk/meshwalk.h>
#include <stdlib.h>
#include <string.h>

enum { MOST_POINTS = 16, MOST_TRIANGLES = 24, PROBES = 8 };

typedef struct input {
    const uint8_t *byte;
    size_t left;
    uint64_t random;
} input;

/* The bytes given, then random ones that depend on them: short inputs are whole scenes, too. */
static int next(input *in)
{
    in->random = in->random * UINT64_C(6364136223846793005) + UINT64_C(1442695040888963407);
    if (in->left == 0) return (int)(in->random >> 56);
    in->left--;
    in->random ^= *in->byte;
    return *in->byte++;
}

/* Coordinates from -8 to 7, so that much falls together. */
static int64_t coordinate(input *in)
{
    return next(in) % 16 - 8;
}

typedef struct triangles {
    double point[3 * MOST_POINTS];
    uint32_t vertex[3 * MOST_TRIANGLES];
    uint32_t points, count;
} triangles;

/* Where a line meets a plane: at numerator / denominator of its vector, denominator > 0. */
typedef struct place {
    int64_t numerator, denominator;
} place;

static int64_t determinant(const int64_t a[3], const int64_t b[3], const int64_t c[3])
{
    return a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2]) +
           a[2] * (b[0] * c[1] - b[1] * c[0]);
}

/* Does the line through q along m touch triangle t, and where? */
static int touches(const triangles *s, uint32_t t, const int64_t q[3], const int64_t m[3],
                   place *at)
{
    int64_t v[3][3], e[3], f[3], facing = 0;
    for (int k = 0; k < 3; k++)
        for (int i = 0; i < 3; i++)
            v[k][i] = (int64_t)s->point[3 * s->vertex[3 * t + (uint32_t)k] + (uint32_t)i] - q[i];
    for (int k = 0; k < 3; k++) {
        int64_t side = determinant(v[k], v[(k + 1) % 3], m);
        if (side > 0) return 0;
        facing += side;
    }
    for (int i = 0; i < 3; i++) {
        e[i] = v[1][i] - v[0][i];
        f[i] = v[2][i] - v[0][i];
    }
    *at = (place){-determinant(e, f, v[0]), -facing};
    return facing < 0;
}

/* |a| - |b|: its sign. */
static int compare(place a, place b)
{
    int64_t left = llabs(a.numerator) * b.denominator, right = llabs(b.numerator) * a.denominator;
    return (left > right) - (left < right);
}

static void check_probe(const triangles *s, const mw_prober *prober, mw_probe_cursor cursor[2],
                        input *in)
{
    int64_t q[3], m[3];
    double point[3], motion[3];
    for (int k = 0; k < 3; k++) {
        point[k] = (double)(q[k] = coordinate(in));
        motion[k] = (double)(m[k] = next(in) % 7 - 3);
    }
    if (m[0] == 0 && m[1] == 0 && m[2] == 0) return;
    uint32_t best = MW_NONE;
    place at, nearest = {0, 1};
    for (uint32_t t = 0; t < s->count; t++)
        if (touches(s, t, q, m, &at) && (best == MW_NONE || compare(at, nearest) < 0)) {
            best = t;
            nearest = at;
        }
    mw_touch certain = mw_probe(prober, &cursor[0], point, motion),
             found = mw_probe(prober, &cursor[1], point, motion);
    if (certain.triangle != best ||
        certain.state != (best == MW_NONE ? MW_TOUCH_NONE : MW_TOUCH_HIT))
        abort();
    if (found.state == MW_TOUCH_HIT && !touches(s, found.triangle, q, m, &at)) abort();
    if (found.state != MW_TOUCH_HIT && found.state != MW_TOUCH_LIMIT) abort();
}

static void check_probes(const triangles *s, const mw_prober *prober, input *in)
{
    mw_probe_cursor cursor[2];
    for (int i = 0; i < 2; i++) {
        mw_probe_options options = {.certain = i == 0};
        if (mw_probe_cursor_init(prober, &options, &cursor[i], NULL)) abort();
    }
    for (int i = 0; i < PROBES; i++) check_probe(s, prober, cursor, in);
}

/* Move every vertex by a few units, or say that it is not known how far. */
static void move(triangles *s, mw_surface *surface, mw_prober *prober, input *in)
{
    double *points = mw_surface_points(surface);
    int known = next(in) % 2;
    mw_surface_begin_update(surface);
    for (uint32_t i = 0; i < 3 * s->points; i++) s->point[i] += next(in) % 3 - 1;
    memcpy(points, s->point, 3 * s->points * sizeof *points);
    mw_prober_update(prober, known ? 1.75 : -1, 1); /* the root of 3 is 1.733 */
    mw_surface_end_update(surface);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);
int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    triangles s = {.points = 3 + (uint32_t)(size % (MOST_POINTS - 2))};
    input in = {data, size, 1};
    mw_surface_options how = {.weld = next(&in) % 2, .tolerant = 1};
    s.count = 1 + (uint32_t)next(&in) % MOST_TRIANGLES;
    for (uint32_t i = 0; i < 3 * s.points; i++) s.point[i] = (double)coordinate(&in);
    for (uint32_t i = 0; i < 3 * s.count; i++) s.vertex[i] = (uint32_t)next(&in) % s.points;
    mw_arrays arrays = {.points = s.point,
                        .point_count = s.points,
                        .triangles = s.vertex,
                        .triangle_count = s.count};
    mw_prober_options boxes = {.boxes = 1};
    mw_surface *surface;
    mw_prober *prober;
    if (mw_surface_create(&arrays, &how, &surface, NULL)) return 0;
    if (mw_prober_create(surface, &boxes, &prober, NULL)) abort();
    check_probes(&s, prober, &in);
    for (int i = 0; i < 2; i++) {
        move(&s, surface, prober, &in);
        check_probes(&s, prober, &in);
    }
    mw_prober_destroy(prober);
    mw_surface_destroy(surface);
    return 0;
}
