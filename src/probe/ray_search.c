/* ray_search.c - searches the BVH for the triangles that a ray meets: depth first, nearer boxes
 * first. bvh_beam.h has the proof that no box is missed. */
#include "probe/ray.h"

/* --- what is found --- */

static void ray_search_limit(mw_ray_search *s, double reach)
{
    mw__beam_limit(&s->beam, reach, s->ray->extent != MW_PROBE_LINE, s->ray->least);
}

/* Two distances, each off by less than 2^-40 of itself, or by underflow. */
#define SURELY (1 + 0x1p-37)

static MW_INLINE bool surely_nearer(double a, double b)
{
    return (fabs(a) + MW_BVH_TINY_LENGTH) * SURELY < fabs(b);
}

/* Is the triangle that is looked at nearer than the nearest so far, or as near with a lower
 * number? */
static bool ray_search_improves(const mw_ray_search *s, uint32_t triangle, double distance)
{
    if (s->nearest == MW_NONE || surely_nearer(distance, s->distance)) return true;
    if (surely_nearer(s->distance, distance)) return false;
    int order = mw__compare_hits(&s->ray->line, s->corners, s->nearest_corners);
    return order < 0 || (order == 0 && triangle < s->nearest);
}

static void ray_search_keep(mw_ray_search *s, uint32_t triangle, mw_ray_side side, double distance)
{
    double reach = fabs(distance), greatest = s->ray->greatest;
    s->nearest = triangle;
    s->side = side;
    s->distance = distance;
    s->nearest_estimate = s->estimate;
    for (int k = 0; k < 3; k++) s->nearest_corners[k] = s->corners[k];
    ray_search_limit(s, reach < greatest ? reach : greatest);
}

/* The line meets the triangle that is looked at. */
static void ray_search_look_nearest(mw_ray_search *s, uint32_t triangle, mw_ray_side side)
{
    double distance = mw__hit_distance_noted(&s->ray->line, s->corners, &s->estimate);
    if (!mw__ray_reaches_at(s->ray, s->corners, side, distance)) return;
    s->hits++;
    if (ray_search_improves(s, triangle, distance)) ray_search_keep(s, triangle, side, distance);
}

bool mw__ray_found_nearest(mw_ray_search *s, uint32_t triangle, mw_ray_side side)
{
    ray_search_look_nearest(s, triangle, side);
    return true;
}

bool mw__ray_found_any(mw_ray_search *s, uint32_t triangle, mw_ray_side side)
{
    s->nearest = triangle;
    s->side = side;
    return false;
}

mw_touch mw__ray_touch_found(const mw_ray_search *s)
{
    if (s->nearest == MW_NONE) return mw__touch_none(MW_TOUCH_NONE);
    mw_touch touch = mw__touch_at(&s->ray->line, s->nearest, s->nearest_corners,
                                  &s->nearest_estimate, s->distance);
    touch.back = s->side == MW_RAY_BACK;
    return touch;
}

/* Has the nearest triangle so far the same corners, in the same order, and a lower number than t,
 * which is looked at? Then t is met where it is, and is not better: of many equal triangles only
 * one takes exact tests. */
static bool nearest_is_repeated(const mw_ray_search *s, uint32_t t)
{
    if (s->nearest >= t) return s->nearest == t; /* or there is none */
    for (uint32_t k = 0; k < 3; k++) {
        const double *p = s->corners[k], *best = s->nearest_corners[k];
        if (p[0] != best[0] || p[1] != best[1] || p[2] != best[2]) return false;
    }
    return true;
}

/* Returns whether the search goes on. */
static MW_INLINE bool ray_search_look(mw_ray_search *s, uint32_t t, const uint32_t v[3])
{
    for (int k = 0; k < 3; k++) s->corners[k] = mw__surface_point(s->prober->surface, v[k]);
    if (nearest_is_repeated(s, t)) return true;
    mw_ray_side side = mw__ray_crosses(s->ray, s->corners, &s->estimate);
    if (side == MW_RAY_MISSES) return true;
    if (s->found == mw__ray_found_nearest) {
        ray_search_look_nearest(s, t, side);
        return true;
    }
    if (!mw__ray_reaches(s->ray, s->corners, side)) return true;
    s->hits++;
    return s->found(s, t, side);
}

/* --- the search --- */

void mw__ray_search_begin(mw_ray_search *s, const mw_prober *prober, const mw_ray_query *ray,
                          mw_ray_found *found, void *self)
{
    s->prober = prober;
    s->ray = ray;
    s->found = found;
    s->self = self;
    s->one_of_same = found == mw__ray_found_nearest || found == mw__ray_found_any;
    s->nearest = MW_NONE;
    s->side = MW_RAY_MISSES;
    s->boxes = s->triangles = s->hits = 0;
    mw__beam_aim(&s->beam, &prober->bvh, &ray->line, prober->slack);
    double reach = ray->greatest;
    if (ray->extent == MW_PROBE_SEGMENT) {
        const double *m = ray->line.m;
        reach = fmin(reach, hypot(hypot(m[0], m[1]), m[2]) * MW_BEAM_REACH_ERROR);
    }
    ray_search_limit(s, reach);
    s->stack.count = 0;
    s->at = 0;
}

void mw__ray_search_none(mw_ray_search *s)
{
    s->prober = NULL;
    s->at = MW_NONE;
}

void mw__ray_search_guess(mw_ray_search *s, uint32_t triangle)
{
    if (!ray_search_look(s, triangle, s->prober->surface->tri[triangle].v)) s->at = MW_NONE;
}

static MW_INLINE void ray_search_prefetch_node(const mw_ray_search *s, uint32_t i)
{
    const char *node = (const char *)&s->prober->bvh.node[i];
    for (size_t line = 0; line < sizeof(mw_bvh_node); line += 64) __builtin_prefetch(node + line);
}

/* Which children of the node does the beam meet? Asks for the corners of triangles, and if the
 * search is alone, for nodes; of searches that take turns, a node is prefetched when chosen. */
static MW_INLINE void ray_search_visit(mw_ray_search *s, mw_beam_meets *meets, bool alone)
{
    const mw_bvh_node *node = &s->prober->bvh.node[s->at];
    uint32_t triangles, met = meets(&s->beam, node, s->near, &triangles);
    s->nodes_met = met & ~triangles;
    s->triangles_met = met & triangles;
    s->boxes += MW_BVH_WIDTH;
    for (uint32_t left = alone ? s->nodes_met : 0; left; left &= left - 1)
        ray_search_prefetch_node(s, node->child[__builtin_ctz(left)]);
    for (uint32_t left = s->triangles_met; left; left &= left - 1)
        for (uint32_t i = (uint32_t)__builtin_ctz(left), k = 0; k < 3; k++)
            __builtin_prefetch(mw__surface_point(s->prober->surface, node->vertex[i][k]));
}

/* Look at the triangles of the node that the beam meets. Returns whether the search goes on. */
static MW_INLINE bool ray_search_look_at_all(mw_ray_search *s, const mw_bvh_node *node)
{
    for (uint32_t left = s->triangles_met; left; left &= left - 1) {
        uint32_t i = (uint32_t)__builtin_ctz(left), child = node->child[i];
        if (child == MW_NONE || !(s->near[i] <= s->beam.reach)) continue;
        s->triangles++;
        if (!ray_search_look(s, child & ~MW_BVH_TRIANGLE, node->vertex[i])) return false;
    }
    return true;
}

/* The next node that waits, or MW_NONE. */
static MW_INLINE uint32_t ray_search_pop(mw_ray_search *s)
{
    while (s->stack.count) {
        mw_bvh_visit visit = s->stack.visit[--s->stack.count];
        if (visit.near <= s->beam.reach) return visit.node;
    }
    return MW_NONE;
}

/* Child i of the node waits, among its siblings. */
static MW_INLINE void ray_search_push(mw_ray_search *s, uint32_t floor, const mw_bvh_node *node,
                                      uint32_t i)
{
    mw__bvh_push(&s->stack, floor, (mw_bvh_visit){s->near[i], node->child[i]});
}

/* The nearest of the children that are nodes and are met; the others wait. Mostly there are one or
 * two. If triangles brought a nearer bound, a child may be too far: that is seen at a look at its
 * boxes. */
static MW_INLINE uint32_t ray_search_nearest_child(mw_ray_search *s, const mw_bvh_node *node)
{
    uint32_t left = s->nodes_met, i = (uint32_t)__builtin_ctz(left);
    left &= left - 1;
    if (!left) return node->child[i];
    uint32_t j = (uint32_t)__builtin_ctz(left), floor = s->stack.count;
    bool second = s->near[j] < s->near[i];
    uint32_t first = second ? j : i, other = second ? i : j;
    left &= left - 1;
    ray_search_push(s, floor, node, other);
    if (!left) return node->child[first];
    ray_search_push(s, floor, node, first);
    for (; left; left &= left - 1) ray_search_push(s, floor, node, (uint32_t)__builtin_ctz(left));
    return s->stack.visit[--s->stack.count].node;
}

static bool corner_is_at(const double p[3], const double q[3])
{
    return p[0] == q[0] && p[1] == q[1] && p[2] == q[2];
}

/* Has the nearest triangle so far a lower number than t, and the corners of t, in whatever order?
 * Then t is met at the same place, if it counts, and is not better. */
static bool nearest_is_turned(const mw_ray_search *s, uint32_t t)
{
    if (s->nearest >= t) return false; /* or there is none */
    for (uint32_t k = 0; k < 3; k++) {
        const double *p = mw__surface_corner(s->prober->surface, t, k);
        uint32_t i = 0;
        while (i < 3 && !corner_is_at(p, s->nearest_corners[i])) i++;
        if (i == 3) return false;
    }
    return true;
}

/* The node has equal triangles: look at the lowest of them. */
static __attribute__((noinline)) bool ray_search_look_at_one(mw_ray_search *s, uint32_t triangle)
{
    bool met = (s->nodes_met || s->triangles_met) && !nearest_is_turned(s, triangle);
    s->triangles += met;
    bool goes_on = !met || ray_search_look(s, triangle, s->prober->surface->tri[triangle].v);
    s->at = goes_on ? ray_search_pop(s) : MW_NONE;
    return s->at != MW_NONE;
}

/* Look at the triangles of the node, then choose the next one. Returns whether the search goes
 * on. */
static MW_INLINE bool ray_search_descend(mw_ray_search *s)
{
    const mw_bvh_node *node = &s->prober->bvh.node[s->at];
    uint32_t same = mw__bvh_same(&s->prober->bvh, s->prober->slack, s->at);
    if (MW_UNLIKELY(same != MW_NONE && s->one_of_same)) return ray_search_look_at_one(s, same);
    if (!ray_search_look_at_all(s, node))
        s->at = MW_NONE;
    else
        s->at = s->nodes_met ? ray_search_nearest_child(s, node) : ray_search_pop(s);
    return s->at != MW_NONE;
}

/* Searches take turns; one that has ended is replaced by the last one. */
static MW_INLINE void ray_searches_run(mw_ray_search *search, uint32_t count, mw_beam_meets *meets)
{
    mw_ray_search *going[MW_RAYS_AT_A_TIME];
    uint32_t n = 0;
    for (uint32_t i = 0; i < count; i++)
        if (search[i].at != MW_NONE) going[n++] = &search[i];
    while (n > 1) {
        for (uint32_t i = 0; i < n; i++) ray_search_visit(going[i], meets, false);
        for (uint32_t i = 0; i < n;)
            if (ray_search_descend(going[i]))
                ray_search_prefetch_node(going[i], going[i]->at), i++;
            else
                going[i] = going[--n];
    }
    bool goes_on = n > 0;
    while (goes_on) {
        ray_search_visit(going[0], meets, true);
        goes_on = ray_search_descend(going[0]);
    }
}

static void ray_searches_run_portable(mw_ray_search *search, uint32_t count)
{
    ray_searches_run(search, count, mw__beam_meets_portable);
}

#ifdef __x86_64__

__attribute__((target("avx2"))) static void ray_searches_run_avx2(mw_ray_search *search,
                                                                  uint32_t count)
{
    ray_searches_run(search, count, mw__beam_meets_avx2);
}

#endif

void mw__ray_search_run(const mw_prober *prober, mw_ray_search *search, uint32_t count)
{
#ifdef __x86_64__
    if (!prober->portable && __builtin_cpu_supports("avx2")) {
        ray_searches_run_avx2(search, count);
        return;
    }
#else
    (void)prober;
#endif
    ray_searches_run_portable(search, count);
}

void mw__ray_search_count(const mw_ray_search *s, mw_probe_counters *counters)
{
    counters->boxes += s->boxes;
    counters->box_triangles += s->triangles;
    counters->intersections += s->hits;
}
