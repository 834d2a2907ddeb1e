#include "bench/ranks/rank_queries.h"

#include <math.h>

#define HOT_DEVIATION 0.01
#define CLOUD_DEVIATION 0.05
#define CLOUD_JITTER 0.002 /* of each particle in a step, beside the current that carries all */

const char *rank_spread_name(rank_spread spread)
{
    static const char *const names[RANK_SPREADS] = {"uniform", "hot spot", "cloud"};
    return names[spread];
}

/* A point of the domain's square, and a normal step from it [Box, Muller 1958]. */
static void spread_place(const dataset *domain, const double middle[2], double deviation,
                         double *point, uint64_t *random)
{
    const double r = deviation * sqrt(-2 * log(1 - dataset_unit(random)));
    const double angle = 8 * atan(1) * dataset_unit(random);
    const double s = middle[0] + r * cos(angle), t = middle[1] + r * sin(angle);
    for (int k = 0; k < 2; k++) point[k] = domain->origin[k] + s * domain->u[k] + t * domain->v[k];
}

static void spread_cloud(const dataset *domain, double *points, size_t n, uint64_t *random)
{
    const size_t particles = n / RANK_CLOUD_STEPS;
    for (size_t i = 0; i < particles; i++)
        spread_place(domain, (double[2]){0.25, 0.3}, CLOUD_DEVIATION, points + 2 * i, random);
    for (size_t i = particles; i < n; i++) {
        const double *before = points + 2 * (i - particles);
        double off[2];
        const double current[2] = {0.5 / RANK_CLOUD_STEPS, 0.4 / RANK_CLOUD_STEPS};
        spread_place(domain, current, CLOUD_JITTER, off, random);
        for (int k = 0; k < 2; k++)
            points[2 * i + (size_t)k] = before[k] + off[k] - domain->origin[k];
    }
}

void rank_spread_draw(const dataset *domain, rank_spread spread, double *points, size_t n,
                      uint64_t seed)
{
    uint64_t random = seed;
    switch (spread) {
    case RANK_SPREAD_UNIFORM: dataset_draw(domain, points, n, &random); break;
    case RANK_SPREAD_HOT:
        for (size_t i = 0; i < n; i++)
            spread_place(domain, (double[2]){0.37, 0.61}, HOT_DEVIATION, points + 2 * i, &random);
        break;
    case RANK_SPREAD_CLOUD: spread_cloud(domain, points, n, &random); break;
    case RANK_SPREADS: break;
    }
}
