#include "bench/data/dataset.h"
#include "bench/data/stand_ins.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define PI 3.14159265358979323846

const char *dataset_name(int kind)
{
    static const char *const names[DATASET_KINDS] = {
        [DATASET_UNIFORM] = "uniform",   [DATASET_GRID] = "grid",
        [DATASET_GAUSSIAN] = "gaussian", [DATASET_CLUSTERS] = "clusters",
        [DATASET_ARCS] = "arcs",         [DATASET_RECTANGLE] = "rectangle",
        [DATASET_RINGS] = "rings",       [DATASET_SLIVERS] = "slivers",
        [DATASET_OFFSET] = "offset",     [DATASET_CADASTRE] = "cadastre",
        [DATASET_LIDAR] = "lidar",
    };
    return kind >= 0 && kind < DATASET_KINDS ? names[kind] : NULL;
}

int dataset_named(const char *name)
{
    int kind = 0;
    while (kind < DATASET_KINDS && strcmp(dataset_name(kind), name) != 0) kind++;
    return kind;
}

/* Two independent normal numbers [Box, Muller 1958]. */
static void draw_normal_pair(double pair[2], uint64_t *random)
{
    double radius = sqrt(-2 * log(1 - dataset_unit(random))), angle = 2 * PI * dataset_unit(random);
    pair[0] = radius * cos(angle);
    pair[1] = radius * sin(angle);
}

void dataset_draw(const dataset *d, double *points, size_t n, uint64_t *random)
{
    for (size_t i = 0; i < n; i++) {
        double s = dataset_unit(random), t = dataset_unit(random);
        for (size_t k = 0; k < 2; k++) points[2 * i + k] = d->origin[k] + s * d->u[k] + t * d->v[k];
    }
}

static void fill_grid(dataset *d, size_t n)
{
    size_t width = (size_t)ceil(sqrt((double)n)), height = (n + width - 1) / width;
    for (size_t i = 0; i < n; i++) {
        d->points[2 * i] = (double)(i % width);
        d->points[2 * i + 1] = (double)(i / width);
    }
    d->origin[0] = d->origin[1] = -0.5;
    d->u[0] = (double)width;
    d->v[1] = (double)height;
}

static void fill_gaussian(dataset *d, size_t n, uint64_t *random)
{
    for (size_t i = 0; i < n; i++) draw_normal_pair(d->points + 2 * i, random);
    dataset_bound(d, n);
}

static bool point_in_unit_square(const double p[2])
{
    return p[0] >= 0 && p[0] <= 1 && p[1] >= 0 && p[1] <= 1;
}

#define CLUSTERS 100
#define CLUSTER_DEVIATION 0.01

static void fill_clusters(dataset *d, size_t n, uint64_t *random)
{
    double centre[2 * CLUSTERS];
    for (size_t i = 0; i < 2 * CLUSTERS; i++) centre[i] = dataset_unit(random);
    for (size_t i = 0; i < n; i++) {
        double *p = d->points + 2 * i;
        do {
            size_t c = (size_t)(dataset_bits(random) % CLUSTERS);
            draw_normal_pair(p, random);
            for (size_t k = 0; k < 2; k++) p[k] = centre[2 * c + k] + CLUSTER_DEVIATION * p[k];
        } while (!point_in_unit_square(p));
    }
}

#define ARCS 30
#define ARC_DEVIATION 0.001

typedef struct dataset_arc {
    double centre[2], radius, begin, length;
} dataset_arc;

/* Radii from 0.05 to 0.3, lengths from an eighth to a whole circle. */
static void fill_arcs(dataset *d, size_t n, uint64_t *random)
{
    dataset_arc arc_of[ARCS];
    for (size_t i = 0; i < ARCS; i++) {
        arc_of[i] = (dataset_arc){.centre = {dataset_unit(random), dataset_unit(random)}};
        arc_of[i].radius = 0.05 + 0.25 * dataset_unit(random);
        arc_of[i].begin = 2 * PI * dataset_unit(random);
        arc_of[i].length = 2 * PI * (0.125 + 0.875 * dataset_unit(random));
    }
    for (size_t i = 0; i < n; i++) {
        double *p = d->points + 2 * i;
        do {
            const dataset_arc *a = &arc_of[dataset_bits(random) % ARCS];
            double angle = a->begin + a->length * dataset_unit(random), off[2];
            draw_normal_pair(off, random);
            double radius = a->radius + ARC_DEVIATION * off[0];
            p[0] = a->centre[0] + radius * cos(angle);
            p[1] = a->centre[1] + radius * sin(angle);
        } while (!point_in_unit_square(p));
    }
}

static void fill_rings(dataset *d, size_t n)
{
    size_t around = 2 * (size_t)sqrt((double)n), count = n / around + 1;
    for (size_t i = 0; i < n; i++) {
        double radius = (double)(i / around + 1) / (double)(2 * count);
        double angle = 2 * PI * (double)(i % around) / (double)around;
        d->points[2 * i] = 0.5 + radius * cos(angle);
        d->points[2 * i + 1] = 0.5 + radius * sin(angle);
    }
}

#define ROWS 10

static void fill_slivers(dataset *d, size_t n, uint64_t *random)
{
    const double cosine = 0.8660254037844386, sine = 0.5;
    for (size_t i = 0; i < n; i++) {
        double x = dataset_unit(random), y = 0.1 * (double)(i % ROWS) + 1e-9 * dataset_unit(random);
        d->points[2 * i] = x * cosine - y * sine;
        d->points[2 * i + 1] = x * sine + y * cosine;
    }
    dataset_bound(d, n);
}

static void dataset_fill(dataset *d, dataset_kind kind, size_t n, uint64_t *random)
{
    *d = (dataset){.points = d->points, .count = d->count, .u = {1, 0}, .v = {0, 1}};
    if (kind == DATASET_RECTANGLE) {
        d->u[0] = 2 * cos(PI / 6);
        d->u[1] = 2 * sin(PI / 6);
        d->v[0] = -sin(PI / 6);
        d->v[1] = cos(PI / 6);
    } else if (kind == DATASET_OFFSET) {
        d->origin[0] = d->origin[1] = 5e6;
        d->u[0] = d->v[1] = 1e4;
    }
    switch (kind) {
    case DATASET_GRID: fill_grid(d, n); break;
    case DATASET_GAUSSIAN: fill_gaussian(d, n, random); break;
    case DATASET_CLUSTERS: fill_clusters(d, n, random); break;
    case DATASET_ARCS: fill_arcs(d, n, random); break;
    case DATASET_RINGS: fill_rings(d, n); break;
    case DATASET_SLIVERS: fill_slivers(d, n, random); break;
    case DATASET_CADASTRE: stand_in_parcels(d->points, n, random); break;
    case DATASET_LIDAR: stand_in_strips(d->points, n, random); break;
    default: dataset_draw(d, d->points, n, random);
    }
    if (kind == DATASET_CADASTRE || kind == DATASET_LIDAR) dataset_bound(d, n);
}

bool dataset_make(dataset *d, dataset_kind kind, size_t n, bool enclose, uint64_t seed)
{
    uint64_t random = seed;
    *d = (dataset){.points =
                       n <= SIZE_MAX / (2 * sizeof(double)) ? malloc(2 * n * sizeof(double)) : NULL,
                   .count = n};
    if (!d->points) {
        d->count = 0;
        return false;
    }
    dataset_fill(d, kind, enclose ? n - 4 : n, &random);
    if (enclose) dataset_enclose(d);
    return true;
}

void dataset_release(dataset *d)
{
    free(d->points);
    *d = (dataset){0};
}

bool dataset_bound(dataset *d, size_t n)
{
    double low[2] = {INFINITY, INFINITY}, high[2] = {-INFINITY, -INFINITY};
    bool fits = true;
    for (size_t i = 0; i < n; i++)
        for (size_t k = 0; k < 2; k++) {
            low[k] = fmin(low[k], d->points[2 * i + k]);
            high[k] = fmax(high[k], d->points[2 * i + k]);
        }
    for (size_t k = 0; k < 2; k++) {
        d->origin[k] = low[k];
        d->u[k] = k == 0 ? high[k] - low[k] : 0;
        d->v[k] = k == 1 ? high[k] - low[k] : 0;
        /* points that are not finite, or none, are for others to refuse */
        fits = fits && (!isfinite(low[k]) || !isfinite(high[k]) || isfinite(high[k] - low[k]));
    }
    return fits;
}

void dataset_enclose(dataset *d)
{
    for (size_t i = 0; i < 4; i++)
        for (size_t k = 0; k < 2; k++)
            d->points[2 * (d->count - 4 + i) + k] =
                d->origin[k] + (i & 1 ? d->u[k] : 0) + (i & 2 ? d->v[k] : 0);
}
