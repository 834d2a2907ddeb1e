/* nearest_on_surface.c - finds the point of a surface nearest to a point, by branch and bound on
 * the BVH.
 *
 * Distances are rounded, but the answer does not depend on the boxes: the rounded distance of a
 * triangle is at least that of its own box (mw__distance_to_corners_box). So a box at a rounded
 * distance from q has no triangle at a smaller one, except for the few roundings that REACH_ERROR
 * covers. */
#include "probe/bvh/bvh_beam.h"
#include "probe/nearest_in_triangle.h"

/* --- the search --- */

/* Bounds are in the frame of the BVH and rounded as for lines (bvh_beam.h). The distance of a
 * box of either kind is off by less than 2^-48 of itself. */
#define REACH_ERROR (1 + 0x1p-40)

typedef struct nearest_search {
    const mw_prober *prober;
    const double *point;
    double q[3], width, reach; /* in the frame */
    double max_distance;
    mw_nearest_surface_point nearest;
} nearest_search;

static void nearest_set_reach(nearest_search *s, double distance)
{
    double scale = s->prober->bvh.scale;
    s->reach = (distance + MW_BVH_TINY_LENGTH) * scale * REACH_ERROR + MW_BVH_LEAST_WIDTH;
}

/* Lower bounds of the squared distances of q to everything in the boxes of the children, axis by
 * axis. In doubles: a point may be far from the surface. Returns the children within reach, as
 * bits. */
typedef uint32_t nearest_squares(const nearest_search *s, const mw_bvh_node *node,
                                 double square[MW_BVH_WIDTH]);

static MW_INLINE uint32_t squares_portable(const nearest_search *s, const mw_bvh_node *node,
                                           double square[MW_BVH_WIDTH])
{
    uint32_t within = 0;
    for (uint32_t i = 0; i < MW_BVH_WIDTH; i++) square[i] = 0;
    for (int k = 0; k < 3; k++)
        for (uint32_t i = 0; i < MW_BVH_WIDTH; i++) {
            double below = (double)node->low[k][i] - s->q[k],
                   above = s->q[k] - (double)node->high[k][i];
            double away = (below > above ? below : above) - s->width;
            away = away > 0 ? away : 0;
            square[i] += away * away;
        }
    for (uint32_t i = 0; i < MW_BVH_WIDTH; i++)
        within |= (uint32_t)(square[i] <= s->reach * s->reach) << i;
    return within;
}

#ifdef __x86_64__

/* The same, four at a time. */
__attribute__((target("avx2"))) static inline uint32_t
squares_avx2(const nearest_search *s, const mw_bvh_node *node, double square[MW_BVH_WIDTH])
{
    enum { LANES = 4 };
    const __m256d most = _mm256_set1_pd(s->reach * s->reach), width = _mm256_set1_pd(s->width);
    uint32_t within = 0;
    for (uint32_t i = 0; i < MW_BVH_WIDTH; i += LANES) {
        __m256d sum = _mm256_setzero_pd();
        for (int k = 0; k < 3; k++) {
            const __m256d q = _mm256_set1_pd(s->q[k]);
            __m256d below = _mm256_sub_pd(_mm256_cvtps_pd(_mm_load_ps(node->low[k] + i)), q),
                    above = _mm256_sub_pd(q, _mm256_cvtps_pd(_mm_load_ps(node->high[k] + i)));
            __m256d away = _mm256_sub_pd(_mm256_max_pd(below, above), width);
            away = _mm256_max_pd(away, _mm256_setzero_pd());
            sum = _mm256_add_pd(sum, _mm256_mul_pd(away, away));
        }
        _mm256_storeu_pd(square + i, sum);
        within |= (uint32_t)_mm256_movemask_pd(_mm256_cmp_pd(sum, most, _CMP_LE_OQ)) << i;
    }
    return within;
}

#endif

static void nearest_look_at_triangle(nearest_search *s, uint32_t t)
{
    const mw_surface *surface = s->prober->surface;
    if (t == s->nearest.triangle || !mw__corners_finite(surface, t)) return; /* it was the guess */
    const mw_corners corner = {mw__surface_corner(surface, t, 0), mw__surface_corner(surface, t, 1),
                               mw__surface_corner(surface, t, 2)};
    double least = mw__distance_to_corners_box(corner, s->point);
    double most = s->nearest.distance < s->max_distance ? s->nearest.distance : s->max_distance;
    if (least > most || mw__triangle_is_farther(corner, s->point, most)) return;
    mw_nearest_surface_point hit = mw__nearest_in_triangle(corner, s->point, least);
    if (hit.distance > s->max_distance || hit.distance > s->nearest.distance) return;
    if (hit.distance == s->nearest.distance && t >= s->nearest.triangle) return;
    if (mw__collinear3(corner[0], corner[1], corner[2])) return;
    s->nearest = hit;
    s->nearest.triangle = t;
    nearest_set_reach(s, hit.distance);
}

/* A visit keeps its distance as a float that is not greater. */
static MW_INLINE void nearest_look_into(nearest_search *s, mw_bvh_stack *stack, uint32_t visited,
                                        nearest_squares *squares)
{
    const mw_bvh_node *node = &s->prober->bvh.node[visited];
    const uint32_t same = mw__bvh_same(&s->prober->bvh, s->prober->slack, visited);
    if (MW_UNLIKELY(same != MW_NONE)) {
        nearest_look_at_triangle(s, same);
        return;
    }
    double square[MW_BVH_WIDTH];
    uint32_t floor = stack->count, nodes = 0;
    for (uint32_t left = squares(s, node, square); left; left &= left - 1) {
        uint32_t i = (uint32_t)__builtin_ctz(left), child = node->child[i];
        if (!(child & MW_BVH_TRIANGLE))
            nodes |= 1u << i;
        else if (child != MW_NONE && square[i] <= s->reach * s->reach)
            nearest_look_at_triangle(s, child & ~MW_BVH_TRIANGLE);
    }
    double most = s->reach * s->reach;
    for (; nodes; nodes &= nodes - 1) {
        uint32_t i = (uint32_t)__builtin_ctz(nodes);
        if (square[i] <= most)
            mw__bvh_push(stack, floor,
                         (mw_bvh_visit){mw__float_down(sqrt(square[i])), node->child[i]});
    }
}

static MW_INLINE void nearest_search_run(nearest_search *s, nearest_squares *squares)
{
    mw_bvh_stack stack;
    stack.count = 1;
    stack.visit[0] = (mw_bvh_visit){0, 0};
    while (stack.count) {
        mw_bvh_visit visit = stack.visit[--stack.count];
        if ((double)visit.near <= s->reach) nearest_look_into(s, &stack, visit.node, squares);
    }
}

static void nearest_search_portable(nearest_search *s)
{
    nearest_search_run(s, squares_portable);
}

#ifdef __x86_64__

__attribute__((target("avx2"))) static void nearest_search_avx2(nearest_search *s)
{
    nearest_search_run(s, squares_avx2);
}

#endif

/* `guess` is looked at first. The answer is the same: of all triangles at the smallest distance the
 * lowest. */
static void nearest_search_bvh(nearest_search *s, uint32_t guess)
{
    const mw_prober *prober = s->prober;
    s->width = mw__bvh_aim(&prober->bvh, s->point, prober->slack, s->q);
    nearest_set_reach(s, s->max_distance);
    if (guess < prober->surface->tri_count) nearest_look_at_triangle(s, guess);
#ifdef __x86_64__
    if (!prober->portable && __builtin_cpu_supports("avx2")) {
        nearest_search_avx2(s);
        return;
    }
#endif
    nearest_search_portable(s);
}

void mw__nearest_find(const mw_prober *prober, const double point[3], double max_distance,
                      uint32_t guess, mw_nearest_surface_point *hit)
{
    *hit = (mw_nearest_surface_point){MW_NONE, NAN, {NAN, NAN, NAN}, {NAN, NAN, NAN}};
    if (!mw__is_finite3(point)) return;
    nearest_search s = {.prober = prober,
                        .point = point,
                        .max_distance = max_distance,
                        .nearest = {.triangle = MW_NONE, .distance = INFINITY}};
    nearest_search_bvh(&s, guess);
    if (s.nearest.triangle != MW_NONE) *hit = s.nearest;
}

mw_status mw__nearest_check(const mw_prober *prober, double max_distance, mw_error *error)
{
    if (!prober->has_bvh)
        return mw__fail(error, MW_ERROR_ARGUMENT,
                        "a nearest point needs a prober with options.boxes");
    if (!(max_distance >= 0))
        return mw__fail(error, MW_ERROR_ARGUMENT, "the distance must be at least 0");
    return MW_OK;
}

mw_status mw__nearest_fail_outdated(mw_error *error)
{
    return mw__fail(error, MW_ERROR_ARGUMENT,
                    "the boxes are not up to date: call mw_prober_update()");
}

mw_status mw_nearest_on_surface(const mw_prober *prober, const double point[3], double max_distance,
                                mw_nearest_surface_point *hit, mw_error *error)
{
    if (!prober || !point || !hit)
        return mw__fail(error, MW_ERROR_ARGUMENT,
                        "the prober, the point or the pointer to the result is NULL");
    *hit = (mw_nearest_surface_point){MW_NONE, NAN, {NAN, NAN, NAN}, {NAN, NAN, NAN}};
    mw_status status = mw__nearest_check(prober, max_distance, error);
    if (status) return status;
    mw__surface_read_lock(prober->surface);
    bool current = mw__prober_is_current(prober);
    if (current) mw__nearest_find(prober, point, max_distance, MW_NONE, hit);
    mw__surface_read_unlock(prober->surface);
    return current || !mw__is_finite3(point) ? MW_OK : mw__nearest_fail_outdated(error);
}
