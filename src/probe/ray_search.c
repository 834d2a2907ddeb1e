/* ray_search.c - searches the BVH for the triangles that a ray meets: depth first, nearer boxes
 * first. bvh_beam.h has the proof that no box is missed. */
#include "probe/ray.h"

/* --- what is found --- */

static MW_INLINE void ray_search_limit(mw_ray_search *s, double reach)
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

static MW_INLINE double ray_search_distance(mw_ray_search *s, bool vectors)
{
    const mw_line *line = &s->ray->line;
    mw_line_plane plane;
    if (!vectors) return mw__hit_distance_noted(line, s->corners, &s->estimate);
    mw__lanes_plane(line, s->corners, s->underflow, &plane);
    return mw__hit_distance_by(line, s->corners, &plane, &s->estimate);
}

/* The line meets the triangle that is looked at. */
static MW_INLINE void ray_search_look_nearest(mw_ray_search *s, uint32_t triangle, mw_ray_side side,
                                              bool vectors)
{
    double distance = ray_search_distance(s, vectors);
    if (!mw__ray_reaches_at(s->ray, s->corners, side, distance)) return;
    s->hits++;
    if (ray_search_improves(s, triangle, distance)) ray_search_keep(s, triangle, side, distance);
}

bool mw__ray_found_nearest(mw_ray_search *s, uint32_t triangle, mw_ray_side side)
{
    ray_search_look_nearest(s, triangle, side, false);
    return true;
}

bool mw__ray_found_any(mw_ray_search *s, uint32_t triangle, mw_ray_side side)
{
    s->nearest = triangle;
    s->side = side;
    return false;
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

/* Without `above` there are no vectors. */
static MW_INLINE mw_ray_side ray_search_side(mw_ray_search *s, mw_lanes_above *above)
{
    mw_lanes side, bound, less;
    if (!above) return mw__ray_line_meets(&s->ray->line, s->corners, &s->estimate);
    mw__lanes_estimate(&s->ray->line, s->corners, s->underflow, &side, &bound);
    less = -bound;
    uint32_t right = above(&less, &side), left = above(&side, &bound);
    if (right && left) return MW_RAY_MISSES;
    for (int k = 0; k < 3; k++) {
        s->estimate.side[k] = side[k];
        s->estimate.bound[k] = bound[k];
    }
    if (right == 7) return MW_RAY_FRONT;
    return left == 7 ? MW_RAY_BACK : mw__line_meets_exactly(&s->ray->line, s->corners);
}

static MW_INLINE bool ray_counts(const mw_ray_query *ray, mw_ray_side side)
{
    return ray->faces == MW_PROBE_BOTH ||
           side == (ray->faces == MW_PROBE_FRONT ? MW_RAY_FRONT : MW_RAY_BACK);
}

/* Returns whether the search goes on. */
static MW_INLINE bool ray_search_look(mw_ray_search *s, uint32_t t, const uint32_t v[3],
                                      mw_lanes_above *above)
{
    for (int k = 0; k < 3; k++) s->corners[k] = mw__surface_point(s->prober->surface, v[k]);
    if (nearest_is_repeated(s, t)) return true;
    mw_ray_side side = ray_search_side(s, above);
    if (side == MW_RAY_MISSES || !ray_counts(s->ray, side)) return true;
    if (s->found == mw__ray_found_nearest) {
        ray_search_look_nearest(s, t, side, above != NULL);
        return true;
    }
    if (!mw__ray_reaches(s->ray, s->corners, side)) return true;
    s->hits++;
    return s->found(s, t, side);
}

/* --- the search --- */

static MW_INLINE void ray_search_begin(mw_ray_search *s, const mw_prober *prober,
                                       const mw_ray_query *ray, bool vectors)
{
    double reach = ray->greatest;
    s->prober = prober;
    s->ray = ray;
    s->nearest = MW_NONE;
    s->side = MW_RAY_MISSES;
    s->boxes = s->triangles = s->hits = 0;
    s->underflow = mw__side_underflow(ray->line.m);
    mw__beam_aim(&s->beam, &prober->bvh, &ray->line, prober->slack, vectors);
    if (ray->extent == MW_PROBE_SEGMENT) {
        const double *m = ray->line.m;
        reach = fmin(reach, hypot(hypot(m[0], m[1]), m[2]) * MW_BEAM_REACH_ERROR);
    }
    ray_search_limit(s, reach);
    s->stack.count = 0;
    s->at = 0;
}

bool mw__prober_has_vectors(const mw_prober *prober)
{
#ifdef __x86_64__
    return !prober->portable && __builtin_cpu_supports("avx2");
#else
    (void)prober;
    return false;
#endif
}

#ifdef __x86_64__

__attribute__((target("avx2"))) static void
ray_search_begin_avx2(mw_ray_search *s, const mw_prober *prober, const mw_ray_query *ray)
{
    ray_search_begin(s, prober, ray, true);
}

#endif

void mw__ray_search_begin(mw_ray_search *s, const mw_prober *prober, const mw_ray_query *ray,
                          mw_ray_found *found, void *self)
{
    s->found = found;
    s->self = self;
    s->one_of_same = found == mw__ray_found_nearest || found == mw__ray_found_any;
#ifdef __x86_64__
    if (mw__prober_has_vectors(prober)) {
        ray_search_begin_avx2(s, prober, ray);
        return;
    }
#endif
    ray_search_begin(s, prober, ray, false);
}

void mw__ray_search_none(mw_ray_search *s)
{
    s->at = s->nearest = MW_NONE;
    s->boxes = s->triangles = s->hits = 0;
}

void mw__ray_search_guess(mw_ray_search *s, uint32_t triangle)
{
    const uint32_t *v = s->prober->surface->tri[triangle].v;
    if (!ray_search_look(s, triangle, v, NULL)) s->at = MW_NONE;
}

static MW_INLINE void ray_search_prefetch_node(const mw_ray_search *s, uint32_t i)
{
    const char *node = (const char *)&s->prober->bvh.node[i];
    for (size_t line = 0; line < sizeof(mw_bvh_node); line += 64) __builtin_prefetch(node + line);
}

/* Which children of the node does the beam meet? Nodes wait on the stack; of triangles, the corners
 * are asked for. */
static MW_INLINE void ray_search_visit(mw_ray_search *s, mw_ray_visit *visit)
{
    const mw_bvh_node *node = &s->prober->bvh.node[s->at];
    s->floor = s->stack.count;
    s->triangles_met = visit(&s->beam, node, s->near, &s->stack);
    s->boxes += MW_BVH_WIDTH;
    for (uint32_t left = s->triangles_met; left; left &= left - 1)
        for (uint32_t i = (uint32_t)__builtin_ctz(left), k = 0; k < 3; k++)
            __builtin_prefetch(mw__surface_point(s->prober->surface, node->vertex[i][k]));
}

/* Look at the triangles of the node that the beam meets. Returns whether the search goes on. */
static MW_INLINE bool ray_search_look_at_all(mw_ray_search *s, const mw_bvh_node *node,
                                             mw_lanes_above *above)
{
    for (uint32_t left = s->triangles_met; left; left &= left - 1) {
        uint32_t i = (uint32_t)__builtin_ctz(left), child = node->child[i];
        if (child == MW_NONE || !(s->near[i] <= s->beam.reach)) continue;
        s->triangles++;
        if (!ray_search_look(s, child & ~MW_BVH_TRIANGLE, node->vertex[i], above)) return false;
    }
    return true;
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

/* The node has equal triangles: look at the lowest of them. No child of the node waits. */
static __attribute__((noinline)) bool ray_search_look_at_one(mw_ray_search *s, uint32_t triangle)
{
    bool met = s->stack.count > s->floor || s->triangles_met;
    const uint32_t *v = s->prober->surface->tri[triangle].v;
    met = met && !nearest_is_turned(s, triangle);
    s->stack.count = s->floor;
    s->triangles += met;
    bool goes_on = !met || ray_search_look(s, triangle, v, NULL);
    s->at = goes_on ? mw__ray_stack_pop(&s->stack, s->beam.reach) : MW_NONE;
    return s->at != MW_NONE;
}

/* Look at the triangles of the node, then choose the next one. Returns whether the search goes
 * on. */
static MW_INLINE bool ray_search_descend(mw_ray_search *s, mw_lanes_above *above)
{
    const mw_bvh_node *node = &s->prober->bvh.node[s->at];
    uint32_t same = mw__bvh_same(&s->prober->bvh, s->prober->slack, s->at);
    if (MW_UNLIKELY(same != MW_NONE && s->one_of_same)) return ray_search_look_at_one(s, same);
    bool goes_on = ray_search_look_at_all(s, node, above);
    s->at = goes_on ? mw__ray_stack_pop(&s->stack, s->beam.reach) : MW_NONE;
    return s->at != MW_NONE;
}

/* The next search that does not end at once, after `ended`; or NULL. */
static MW_INLINE mw_ray_search *ray_source_next(const mw_ray_source *source, mw_ray_search *ended)
{
    mw_ray_search *s = ended;
    do s = source->next(source->self, s);
    while (MW_UNLIKELY(s && s->at == MW_NONE));
    return s;
}

/* A search that is alone asks at once for all that it may visit. */
static MW_INLINE void ray_search_finish(mw_ray_search *s, mw_ray_visit *visit,
                                        mw_lanes_above *above)
{
    do {
        ray_search_visit(s, visit);
        for (uint32_t i = s->floor; i < s->stack.count; i++)
            ray_search_prefetch_node(s, s->stack.node[i]);
    } while (ray_search_descend(s, above));
}

/* Searches take turns; one that has ended makes room for the next. */
static MW_INLINE void ray_searches_run(const mw_ray_source *source, mw_ray_visit *visit,
                                       mw_lanes_above *above)
{
    mw_ray_search *going[MW_RAYS_AT_A_TIME], *s;
    uint32_t n = 0;
    while (n < MW_RAYS_AT_A_TIME && (s = ray_source_next(source, NULL))) going[n++] = s;
    while (n > 1) {
        for (uint32_t i = 0; i < n; i++) ray_search_visit(going[i], visit);
        for (uint32_t i = 0; i < n;) {
            s = going[i];
            if (MW_LIKELY(ray_search_descend(s, above)))
                ray_search_prefetch_node(s, s->at);
            else
                s = ray_source_next(source, s);
            going[i] = s ? s : going[--n];
            i += s != NULL;
        }
    }
    for (s = n ? going[0] : NULL; s; s = ray_source_next(source, s))
        ray_search_finish(s, visit, above);
}

#ifdef __x86_64__

__attribute__((target("avx2"))) static void ray_searches_run_avx2(const mw_ray_source *source)
{
    ray_searches_run(source, mw__ray_visit_avx2, mw__lanes_above_avx2);
}

__attribute__((target("avx2"))) void mw__ray_search_look(mw_ray_search *s, uint32_t triangle,
                                                         const uint32_t vertex[3])
{
    s->triangles++;
    ray_search_look(s, triangle, vertex, mw__lanes_above_avx2);
}

__attribute__((target("avx2"))) static void ray_search_finish_avx2(mw_ray_search *search)
{
    ray_search_finish(search, mw__ray_visit_avx2, mw__lanes_above_avx2);
}

#endif

void mw__ray_search_run(mw_ray_search *search)
{
    if (search->at == MW_NONE) return;
#ifdef __x86_64__
    if (mw__prober_has_vectors(search->prober)) {
        ray_search_finish_avx2(search);
        return;
    }
#endif
    ray_search_finish(search, mw__ray_visit_portable, NULL);
}

void mw__ray_searches_run(const mw_prober *prober, const mw_ray_source *source)
{
#ifdef __x86_64__
    if (mw__prober_has_vectors(prober)) {
        ray_searches_run_avx2(source);
        return;
    }
#else
    (void)prober;
#endif
    ray_searches_run(source, mw__ray_visit_portable, NULL);
}

/* --- the answer --- */

#ifdef __x86_64__

__attribute__((target("avx2"))) static bool ray_weights_avx2(const mw_ray_search *s, double side[3])
{
    return mw__lanes_weights(&s->ray->line, s->nearest_corners, s->underflow, &s->nearest_estimate,
                             side);
}

#endif

mw_touch mw__ray_touch_found(const mw_ray_search *s)
{
    double side[3];
    if (s->nearest == MW_NONE) return mw__touch_none(MW_TOUCH_NONE);
    bool known = false;
#ifdef __x86_64__
    known = mw__prober_has_vectors(s->prober) && ray_weights_avx2(s, side);
#endif
    mw_touch touch = known ? mw__touch_inside(s->nearest, s->distance, side)
                           : mw__touch_at(&s->ray->line, s->nearest, s->nearest_corners,
                                          &s->nearest_estimate, s->distance);
    touch.back = s->side == MW_RAY_BACK;
    return touch;
}

void mw__ray_search_count(const mw_ray_search *s, mw_probe_counters *counters)
{
    counters->boxes += s->boxes;
    counters->box_triangles += s->triangles;
    counters->intersections += s->hits;
}
