/* star_glide.c - a short way to the facet that a ray meets: single rays mostly need no more. It
 * leaves a facet by the edge that the ray is farthest beyond, draws no coin and keeps no state. If
 * it could go round in a circle, or a float is not sure, it gives up, and a walk begins. */
#include "star/query/star_locate.h"

/* The direction of a ray is not scaled to length 1. The sum of its magnitudes is at least its
 * length and at most twice that: it scales the bounds on sides. */
typedef struct glide_ray {
    float f[3], length;
} glide_ray;

/* Lengths between these are ordinary floats, and so are products of them with MW_STAR_SURE. */
#define LEAST_LENGTH 0x1p-60
#define MOST_LENGTH 0x1p60

static MW_INLINE bool glide_aim(const mw_star *star, const double q[3], glide_ray *ray)
{
    double length = 0;
    for (int k = 0; k < 3; k++) {
        double d = q[k] - star->centre[k];
        ray->f[k] = (float)d;
        length += fabs(d);
    }
    ray->length = (float)length;
    return length > LEAST_LENGTH && length < MOST_LENGTH;
}

/* The edge that the ray is farthest beyond, or nearest to; *side becomes negative beyond it. */
static MW_INLINE uint32_t glide_farthest_edge(const mw_star_facet *facet, const float f[3],
                                              float *least)
{
    float side[3];
    for (uint32_t k = 0; k < 3; k++) {
        const float *n = facet->normal[k];
        side[k] = n[0] * f[0] + n[1] * f[1] + n[2] * f[2];
    }
    uint32_t k = side[1] < side[0];
    k = side[2] < side[k] ? 2 : k;
    *least = side[k];
    return k;
}

/* `last` if the ray is near it; else where the guide leads. */
static MW_INLINE uint32_t glide_first_facet(const mw_star *star, bool guided, const double q[3],
                                            const glide_ray *ray, uint32_t last)
{
    float least;
    if (last < star->facet_count) {
        if (!guided) return last;
        glide_farthest_edge(&star->facet[last], ray->f, &least);
        if (least > -star->near * ray->length) return last;
    }
    if (!guided) return MW_NONE;
    double half[3];
    for (int k = 0; k < 3; k++) half[k] = q[k] / 2 - star->centre[k] / 2;
    return mw__star_guide_facet(star, mw__star_curve_key(star->curve, half));
}

uint32_t mw__star_glide(const mw_star *star, bool guided, const double q[3], uint32_t last)
{
    enum { STEPS = 12 };
    glide_ray ray;
    if (!glide_aim(star, q, &ray)) return MW_NONE;
    uint32_t t = glide_first_facet(star, guided, q, &ray, last);
    for (int step = 0; step < STEPS && t != MW_NONE; step++) {
        const mw_star_facet *facet = &star->facet[t];
        float side, sure = MW_STAR_SURE * ray.length;
        uint32_t k = glide_farthest_edge(facet, ray.f, &side);
        if (side > sure) return t;
        if (!(side < -sure)) return MW_NONE;
        t = mw__link_triangle(facet->link[k]);
    }
    return MW_NONE;
}
