#include "bench/data/stand_ins.h"
#include "bench/data/dataset_random.h"

#include <math.h>
#include <stdbool.h>

#define PI 3.14159265358979323846

static void point_turn(double p[2], double angle)
{
    double x = p[0], y = p[1];
    p[0] = x * cos(angle) - y * sin(angle);
    p[1] = x * sin(angle) + y * cos(angle);
}

/* --- parcels ---------------------------------------------------------------------------------- */

/* The city is a rectangle of height 1. */
#define CITY_WIDTH 1.4
#define CITY_ANGLE 0.1
/* How much denser sites are in the middle than far outside, and how far the middle reaches. */
#define CITY_DENSITY 12.0
#define CITY_REACH 0.5

#define SITE_POINTS 7  /* about so many on the border of each site */
#define BLOCK_SITES 12 /* streets part blocks of at most so many sites */
#define STREET 0.08    /* of the shorter side, between two blocks */
#define SITE_GAP 0.02  /* of the sides, round a site */
#define SITE_SKEW 0.1  /* of the sides: how far corners are moved */

typedef struct city_box {
    double low[2], high[2];
} city_box;

typedef struct city {
    double *points;
    size_t sites, site; /* in all, and made so far */
    size_t count;       /* points in all */
    uint64_t *random;
} city;

static double box_side(const city_box *b, size_t axis)
{
    return b->high[axis] - b->low[axis];
}

/* About so many sites belong there, up to a factor. */
static double box_weight(const city_box *b)
{
    double x = (b->low[0] + b->high[0] - CITY_WIDTH) / 2, y = (b->low[1] + b->high[1] - 1) / 2;
    double near = exp(-(x * x + y * y) / (CITY_REACH * CITY_REACH));
    return box_side(b, 0) * box_side(b, 1) * (1 + CITY_DENSITY * near);
}

/* A point of the border of a quadrilateral, at a share of the way round it. */
static void border_point(double corner[4][2], double share, double p[2])
{
    size_t k = (size_t)(4 * share) % 4;
    double t = 4 * share - floor(4 * share);
    for (size_t axis = 0; axis < 2; axis++)
        p[axis] = corner[k][axis] + t * (corner[(k + 1) % 4][axis] - corner[k][axis]);
}

static void city_make_site(city *c, const city_box *b)
{
    size_t first = c->site * c->count / c->sites, end = (c->site + 1) * c->count / c->sites;
    double corner[4][2];
    for (size_t k = 0; k < 4; k++)
        for (size_t axis = 0; axis < 2; axis++) {
            bool high = axis == 0 ? k == 1 || k == 2 : k >= 2;
            double off = SITE_GAP + SITE_SKEW * dataset_unit(c->random);
            corner[k][axis] = high ? b->high[axis] - off * box_side(b, axis)
                                   : b->low[axis] + off * box_side(b, axis);
        }
    for (size_t i = first; i < end; i++) {
        size_t k = i - first;
        border_point(corner, k < 4 ? (double)k / 4 : dataset_unit(c->random), c->points + 2 * i);
        point_turn(c->points + 2 * i, CITY_ANGLE);
    }
    c->site++;
}

/* Part a box that has `sites` sites, across its longer side. */
static void city_make(city *c, city_box b, size_t sites)
{
    while (sites > 1) {
        size_t axis = box_side(&b, 0) > box_side(&b, 1) ? 0 : 1;
        double cut = b.low[axis] + (0.3 + 0.4 * dataset_unit(c->random)) * box_side(&b, axis);
        double street = sites > BLOCK_SITES ? STREET * box_side(&b, 1 - axis) / 2 : 0;
        city_box part[2] = {b, b};
        part[0].high[axis] = cut - street;
        part[1].low[axis] = cut + street;
        double weight[2] = {box_weight(&part[0]), box_weight(&part[1])};
        size_t first = (size_t)((double)sites * weight[0] / (weight[0] + weight[1]) + 0.5);
        if (first == 0) first = 1;
        if (first == sites) first = sites - 1;
        city_make(c, part[0], first);
        b = part[1];
        sites -= first;
    }
    city_make_site(c, &b);
}

void stand_in_parcels(double *points, size_t n, uint64_t *random)
{
    city c = {.points = points, .sites = n / SITE_POINTS + 1, .count = n, .random = random};
    city_make(&c, (city_box){{0, 0}, {CITY_WIDTH, 1}}, c.sites);
}

/* --- flight strips ---------------------------------------------------------------------------- */

/* The tile is the unit square. Strips are flown across it at an angle. */
#define STRIP_ANGLE 0.5
#define STRIPS 5         /* side by side, over a square twice as large as the tile */
#define STRIP_WIDTH 1.15 /* of the distance of two strips: the rest is scanned twice */
#define SCAN_JITTER 0.3  /* of the distance of points */
#define LAKES 14

typedef struct scan_lake {
    double centre[2], radius;
} scan_lake;

static bool lakes_have(const scan_lake *lake, const double p[2])
{
    for (size_t i = 0; i < LAKES; i++)
        if (hypot(p[0] - lake[i].centre[0], p[1] - lake[i].centre[1]) < lake[i].radius) return true;
    return false;
}

/* Points of the tile, about `step` apart. Writes at most n of them; returns how many there are. */
static size_t strips_scan(double *points, size_t n, double step, const scan_lake *lake,
                          uint64_t random)
{
    const double side = sqrt(2), strip = side / STRIPS;
    const size_t lines = (size_t)(side / step), across = (size_t)(STRIP_WIDTH * strip / step);
    size_t made = 0;
    for (size_t s = 0; s < STRIPS; s++)
        for (size_t line = 0; line < lines; line++)
            for (size_t k = 0; k < across; k++) {
                /* a scan line slants, since the plane flies on while it is scanned */
                double x =
                    (double)line + (double)k / (double)across + SCAN_JITTER * dataset_unit(&random);
                double y = (double)k + SCAN_JITTER * dataset_unit(&random);
                double p[2] = {step * x - side / 2, strip * (double)s + step * y - side / 2};
                point_turn(p, STRIP_ANGLE);
                p[0] += 0.5, p[1] += 0.5;
                if (p[0] < 0 || p[0] > 1 || p[1] < 0 || p[1] > 1 || lakes_have(lake, p) ||
                    made++ >= n)
                    continue;
                points[2 * made - 2] = p[0];
                points[2 * made - 1] = p[1];
            }
    return made;
}

/* Points are a little closer until there are enough; those too many are left out of the last
 * strip. */
void stand_in_strips(double *points, size_t n, uint64_t *random)
{
    scan_lake lake[LAKES];
    for (size_t i = 0; i < LAKES; i++)
        lake[i] = (scan_lake){{dataset_unit(random), dataset_unit(random)},
                              0.03 + 0.06 * dataset_unit(random)};
    uint64_t seed = (uint64_t)(dataset_unit(random) * 0x1p53);
    double step = sqrt(STRIP_WIDTH / (double)n);
    while (strips_scan(points, n, step, lake, seed) < n) step *= 0.998;
}
