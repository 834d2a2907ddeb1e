#include "bench/data/domains.h"
#include "bench/data/dataset.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define PI 3.14159265358979323846

/* A polygon whose corners are seen from its centre at equal angles, in the order of these. */
typedef struct star_polygon {
    double centre[2], reach; /* the corners are at most so far away */
    double *corner;          /* x0 y0 x1 y1 ... */
    size_t count;
} star_polygon;

#define WAVES 8
#define ARMS 6
#define ARM_WIDTH 0.12 /* radians, on either side */

/* A compact star with narrow arms, as a town has along its roads: these make its hull large, and
 * few lines between two of its points leave it. Distances of the corners of a star without waves
 * and arms are all about 1. */
typedef struct star_waves {
    double size[WAVES], phase[WAVES];
    double arm[ARMS], direction[ARMS];
} star_waves;

static star_waves star_draw_waves(uint64_t *random)
{
    star_waves w;
    for (size_t i = 0; i < WAVES; i++) {
        w.size[i] = (2 * dataset_unit(random) - 1) / sqrt((double)(i + 2));
        w.phase[i] = 2 * PI * dataset_unit(random);
    }
    for (size_t i = 0; i < ARMS; i++) {
        w.arm[i] = 0.5 + 0.5 * dataset_unit(random);
        w.direction[i] = 2 * PI * ((double)i + dataset_unit(random)) / ARMS;
    }
    return w;
}

/* How far an arm reaches in a direction, from 0 to 1. */
static double star_arm(const star_waves *w, double angle)
{
    double most = 0;
    for (size_t i = 0; i < ARMS; i++) {
        double off = remainder(angle - w->direction[i], 2 * PI) / ARM_WIDTH;
        most = fmax(most, w->arm[i] * exp(-off * off));
    }
    return most;
}

/* The seed of other numbers. */
static uint64_t star_draw_seed(uint64_t *random)
{
    return (uint64_t)(dataset_unit(random) * 0x1p53);
}

/* The same noise for the same seed. */
static void star_shape(star_polygon *s, const star_waves *w, double height, double arms,
                       uint64_t seed)
{
    double step = 2 * PI / (double)s->count;
    s->reach = 0;
    for (size_t k = 0; k < s->count; k++) {
        double angle = step * (double)k, sum = 0;
        for (size_t i = 0; i < WAVES; i++)
            sum += w->size[i] * cos((double)(i + 2) * angle + w->phase[i]);
        double radius = exp(height * sum) * (1 + arms * star_arm(w, angle)) *
                        (1 + fmin(step, 0.2) * (dataset_unit(&seed) - 0.5));
        s->corner[2 * k] = s->centre[0] + radius * cos(angle);
        s->corner[2 * k + 1] = s->centre[1] + radius * sin(angle);
        s->reach = fmax(s->reach, radius);
    }
}

static void star_scale(star_polygon *s, double factor)
{
    for (size_t i = 0; i < 2 * s->count; i++)
        s->corner[i] = s->centre[i % 2] + factor * (s->corner[i] - s->centre[i % 2]);
    s->reach *= factor;
}

static void star_move(star_polygon *s, const double centre[2])
{
    for (size_t i = 0; i < 2 * s->count; i++) s->corner[i] += centre[i % 2] - s->centre[i % 2];
    memcpy(s->centre, centre, sizeof s->centre);
}

/* Only the edge in the direction of the point can part it from the centre. */
static bool star_contains(const star_polygon *s, const double p[2])
{
    double dx = p[0] - s->centre[0], dy = p[1] - s->centre[1];
    if (dx * dx + dy * dy > s->reach * s->reach) return false;
    double turn = atan2(dy, dx) / (2 * PI);
    size_t k = (size_t)((turn < 0 ? turn + 1 : turn) * (double)s->count) % s->count;
    return mw_orient2d(s->corner + 2 * k, s->corner + 2 * ((k + 1) % s->count), p) > 0;
}

static double corner_turn(const double a[2], const double b[2], const double c[2])
{
    return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
}

static double polygon_area(const double *corner, size_t count)
{
    double sum = 0;
    for (size_t k = 1; k + 1 < count; k++)
        sum += corner_turn(corner, corner + 2 * k, corner + 2 * (k + 1)) / 2;
    return sum;
}

/* Round the star from its farthest corner on, which is one of the hull, and back where it turns
 * right [Graham 1972]. `hull` has room for one corner more than the star. */
static double star_hull_area(const star_polygon *s, double *hull)
{
    size_t first = 0, count = 0;
    for (size_t k = 0; k < s->count; k++)
        if (hypot(s->corner[2 * k], s->corner[2 * k + 1]) >
            hypot(s->corner[2 * first], s->corner[2 * first + 1]))
            first = k;
    for (size_t k = 0; k <= s->count; k++) {
        const double *next = s->corner + 2 * ((first + k) % s->count);
        while (count > 1 && corner_turn(hull + 2 * (count - 2), hull + 2 * (count - 1), next) <= 0)
            count--;
        memcpy(hull + 2 * count++, next, 2 * sizeof *next);
    }
    return polygon_area(hull, count);
}

/* Of waves, and of arms: longer ones are hardly more than lines. */
#define WAVE_HEIGHT 0.1
#define LONGEST_ARMS 6.0
#define LENGTHS 300
#define MOST_WAVES 100 /* drawn, until the last are taken as they are */

/* The longer the arms, the less of its hull the outline fills. Arms that never leave as little of
 * it as wanted are drawn again. Returns the area of the hull. */
static double star_shape_outline(star_polygon *s, double share, double *hull, uint64_t *random)
{
    for (int drawn = 0;; drawn++) {
        star_waves w = star_draw_waves(random);
        uint64_t noise = star_draw_seed(random);
        for (int i = 0; i <= LENGTHS; i++) {
            star_shape(s, &w, WAVE_HEIGHT, LONGEST_ARMS * i / LENGTHS, noise);
            double area = star_hull_area(s, hull);
            if (polygon_area(s->corner, s->count) <= share * area ||
                (drawn == MOST_WAVES && i == LENGTHS))
                return area;
        }
    }
}

static double distance_to_segment(const double p[2], const double a[2], const double b[2])
{
    double ux = b[0] - a[0], uy = b[1] - a[1], vx = p[0] - a[0], vy = p[1] - a[1];
    double t = fmin(1, fmax(0, (ux * vx + uy * vy) / (ux * ux + uy * uy)));
    return hypot(vx - t * ux, vy - t * uy);
}

typedef struct holed_domain {
    star_polygon *star; /* the outline, then the holes */
    size_t stars;
    double *points; /* corners first */
    size_t corners, count;
} holed_domain;

static void star_draw_near(const star_polygon *outline, double p[2], uint64_t *random)
{
    for (size_t k = 0; k < 2; k++) p[k] = outline->reach * (2 * dataset_unit(random) - 1);
}

/* Room for star i at p, with some space round it? */
static bool domain_is_free(const holed_domain *d, size_t i, const double p[2])
{
    const star_polygon *outline = &d->star[0];
    double room = 1.2 * d->star[i].reach;
    if (!star_contains(outline, p)) return false;
    for (size_t k = 1; k < i; k++)
        if (hypot(p[0] - d->star[k].centre[0], p[1] - d->star[k].centre[1]) <
            room + d->star[k].reach)
            return false;
    for (size_t k = 0; k < outline->count; k++)
        if (distance_to_segment(p, outline->corner + 2 * k,
                                outline->corner + 2 * ((k + 1) % outline->count)) < room)
            return false;
    return true;
}

#define DRAWN_IN_VAIN 500

/* A hole that fits nowhere gets smaller. */
static void domain_place_hole(holed_domain *d, size_t i, double area, uint64_t *random)
{
    star_polygon *s = &d->star[i];
    star_waves w = star_draw_waves(random);
    star_shape(s, &w, 0.5, 0, star_draw_seed(random));
    star_scale(s, sqrt(area / polygon_area(s->corner, s->count)));
    double p[2] = {0, 0};
    for (int drawn = 1;; drawn++) {
        star_draw_near(&d->star[0], p, random);
        if (domain_is_free(d, i, p)) break;
        if (drawn % DRAWN_IN_VAIN == 0) star_scale(s, 0.7);
    }
    star_move(s, p);
}

/* How dense points lie: the exponential of a sum of waves. In a town they stand close where there
 * are many small sites. */
#define DENSITY_WAVES 12
#define DENSITY_DEVIATION 1.0 /* of the logarithm */
#define DENSITY_MOST 2.0      /* times this: denser parts are as dense as that */

typedef struct point_density {
    double wave[DENSITY_WAVES][2], phase[DENSITY_WAVES];
} point_density;

/* Waves of 10 to 20 radians a unit; the outline is about 2 wide. */
static point_density density_draw(uint64_t *random)
{
    point_density d;
    for (size_t i = 0; i < DENSITY_WAVES; i++) {
        double angle = 2 * PI * dataset_unit(random), frequency = 10 + 10 * dataset_unit(random);
        d.wave[i][0] = frequency * cos(angle);
        d.wave[i][1] = frequency * sin(angle);
        d.phase[i] = 2 * PI * dataset_unit(random);
    }
    return d;
}

/* From 0 to 1. */
static double density_at(const point_density *d, const double p[2])
{
    double sum = 0;
    for (size_t i = 0; i < DENSITY_WAVES; i++)
        sum += cos(d->wave[i][0] * p[0] + d->wave[i][1] * p[1] + d->phase[i]);
    return exp(DENSITY_DEVIATION * fmin(0, sum / sqrt(DENSITY_WAVES / 2.0) - DENSITY_MOST));
}

static void domain_draw_point(const holed_domain *d, const point_density *density, double p[2],
                              uint64_t *random)
{
    bool inside;
    do {
        do star_draw_near(&d->star[0], p, random);
        while (dataset_unit(random) > density_at(density, p));
        inside = star_contains(&d->star[0], p);
        for (size_t i = 1; i < d->stars && inside; i++) inside = !star_contains(&d->star[i], p);
    } while (!inside);
}

/* Of the hull, all holes together. */
#define SHARE_OF_HOLES 0.01
/* Of the border edges, those of the outline. */
#define EDGES_OF_OUTLINE 0.55

static void domain_fill(holed_domain *d, const domain_shape *shape, double *hull, uint64_t *random)
{
    double holes = shape->holes ? SHARE_OF_HOLES : 0;
    double area = star_shape_outline(&d->star[0], shape->share + holes, hull, random);
    for (size_t i = 1; i < d->stars; i++)
        domain_place_hole(d, i, holes * area / (double)shape->holes, random);
    point_density density = density_draw(random);
    for (size_t i = d->corners; i < d->count; i++)
        domain_draw_point(d, &density, d->points + 2 * i, random);
}

static mw_status domain_triangulate(const holed_domain *d, uint32_t *segments, uint32_t *polygon,
                                    mw_mesh **out, mw_error *error)
{
    uint32_t first = 0;
    for (size_t i = 0; i < d->stars; i++) {
        uint32_t count = (uint32_t)d->star[i].count;
        for (uint32_t k = 0; k < count; k++) {
            segments[2 * (first + k)] = first + k;
            segments[2 * (first + k) + 1] = first + (k + 1) % count;
            polygon[first + k] = 0;
        }
        first += count;
    }
    mw_constraints constraints = {
        .points = d->points,
        .point_count = d->count,
        .segments = segments,
        .segment_count = d->corners,
        .polygon = polygon,
    };
    return mw_constrained_delaunay(&constraints, NULL, NULL, NULL, NULL, out, error);
}

/* Holes share their edges equally; the outline has what remains. */
static void domain_share_corners(holed_domain *d, const domain_shape *shape)
{
    size_t each = 0, first = 0;
    if (shape->holes)
        each = (size_t)((1 - EDGES_OF_OUTLINE) * (double)shape->border_edges) / shape->holes;
    if (each < 3) each = 3;
    for (size_t i = 0; i < d->stars; i++) {
        size_t count = i ? each : d->corners - shape->holes * each;
        d->star[i] = (star_polygon){.corner = d->points + 2 * first, .count = count};
        first += count;
    }
}

mw_status domain_make(const domain_shape *shape, uint64_t seed, mw_mesh **out, mw_error *error)
{
    holed_domain d = {
        .stars = shape->holes + 1, .corners = shape->border_edges, .count = shape->vertices};
    uint64_t random = seed + shape->vertices;
    d.star = calloc(d.stars, sizeof *d.star);
    d.points = calloc(d.count, 2 * sizeof *d.points);
    double *hull = calloc(d.corners + 1, 2 * sizeof *hull);
    uint32_t *segments = calloc(d.corners, 3 * sizeof *segments);
    mw_status status = MW_ERROR_MEMORY;
    *error = (mw_error){.status = status, .message = "out of memory"};
    if (d.star && d.points && hull && segments) {
        domain_share_corners(&d, shape);
        domain_fill(&d, shape, hull, &random);
        status = domain_triangulate(&d, segments, segments + 2 * d.corners, out, error);
    }
    free(d.star);
    free(d.points);
    free(hull);
    free(segments);
    return status;
}
