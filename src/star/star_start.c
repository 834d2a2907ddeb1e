/* star_start.c - chooses the first facet of a walk [thesis App. F, sec. 6]. */
#include "base/random.h"
#include "star/star_index.h"

/* A measure to compare facets. It grows with the cosine of the angle between d and vertex 0 of
 * facet t. It is rounded, as it is only a guide. */
static double facet_nearness(const mw_star *star, const double d[3], uint32_t t)
{
    const double *p = mw__surface_point(star->surface, star->facet[t].v[0]);
    double x = p[0] - star->centre[0], y = p[1] - star->centre[1], z = p[2] - star->centre[2];
    return (d[0] * x + d[1] * y + d[2] * z) / sqrt(x * x + y * y + z * z);
}

/* Jump and walk: the nearest of some random facets [Muecke, Saias, Zhu 1996]. */
static uint32_t star_start_sample(const mw_star *star, uint32_t count, const double d[3],
                                  uint64_t *random)
{
    uint32_t best = mw__random_below(random, star->facet_count);
    double nearest = facet_nearness(star, d, best);
    for (uint32_t i = 1; i < count; i++) {
        uint32_t t = mw__random_below(random, star->facet_count);
        double near = facet_nearness(star, d, t);
        if (near > nearest) {
            nearest = near;
            best = t;
        }
    }
    return best;
}

/* At most the number of facets: a query must end soon. */
static uint32_t star_sample_count(const mw_star *star, uint32_t count)
{
    if (count == 0) count = (uint32_t)ceil(2 * sqrt(sqrt(star->point_count)));
    return count < star->facet_count ? count : star->facet_count;
}

/* The facet that the cursor's index names, of this star, even if the index was made for another
 * star. */
static uint32_t star_start_indexed(const mw_star *star, const mw_star_index *index,
                                   const mw_star_walk *walk)
{
    uint32_t t;
    if (index->start == MW_STAR_START_OCTAHEDRON) {
        t = index->octahedron
                .facet[mw__star_octahedron_cell(&index->octahedron, walk->d, walk->work)];
    } else {
        double phi, theta;
        mw__star_angles(walk->d, &phi, &theta);
        t = index->grid.facet[mw__star_grid_cell(&index->grid, phi, theta)];
    }
    return MW_LIKELY(t < star->facet_count) ? t : t % star->facet_count;
}

/* Is the ray near a facet: not farther beyond any of its edges than star->near? This reads one
 * cache line, which the query before has just read. It is only a guide. */
static bool star_ray_is_near(const mw_star *star, uint32_t t, const float f[3])
{
    const mw_star_facet *facet = &star->facet[t];
    float least = INFINITY;
    for (uint32_t k = 0; k < 3; k++) {
        const float *n = facet->normal[k];
        float side = n[0] * f[0] + n[1] * f[1] + n[2] * f[2];
        least = side < least ? side : least;
    }
    return least > -star->near;
}

/* From the facet of the query before, if the ray is near; else from where the curve leads. */
static uint32_t star_start_auto(const mw_star *star, uint32_t last, const mw_star_walk *walk)
{
    if (last < star->facet_count && star_ray_is_near(star, last, walk->f)) return last;
    double half[3];
    for (int k = 0; k < 3; k++) half[k] = walk->q[k] / 2 - star->centre[k] / 2;
    return mw__star_guide_facet(star, mw__star_curve_key(star->curve, half));
}

uint32_t mw__star_start(const mw_star *star, const mw_star_cursor *cursor, uint32_t last,
                        mw_star_walk *walk)
{
    switch ((mw_star_start_kind)cursor->start) {
    case MW_STAR_START_RANDOM: return mw__random_below(&walk->random, star->facet_count);
    case MW_STAR_START_FRONT: return star->front;
    case MW_STAR_START_GRID:
    case MW_STAR_START_NONUNIFORM_GRID:
    case MW_STAR_START_OCTAHEDRON: return star_start_indexed(star, cursor->index, walk);
    case MW_STAR_START_LAST:
    case MW_STAR_START_SORTED:
        if (last < star->facet_count) return last;
        break;
    case MW_STAR_START_AUTO: return star_start_auto(star, last, walk);
    case MW_STAR_START_SAMPLE:
    case MW_STAR_START_COUNT: break;
    }
    return star_start_sample(star, star_sample_count(star, cursor->sample), walk->d, &walk->random);
}
