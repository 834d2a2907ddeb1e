/* ray_search.c - searches the BVH for the triangles that a ray meets: depth first, nearer boxes
 * first. bvh_beam.h has the proof that no box is missed. */
#include "probe/ray.h"

/* --- what is found --- */

static void ray_search_limit(mw_ray_search *s, double reach)
{
    mw__beam_limit(&s->beam, reach, s->ray->extent != MW_PROBE_LINE, s->ray->least);
}

bool mw__ray_found_nearest(mw_ray_search *s, uint32_t triangle, mw_ray_side side)
{
    const mw_surface *surface = s->prober->surface;
    const mw_line *line = &s->ray->line;
    if (s->nearest != MW_NONE && !mw__touch_is_better(surface, line, triangle, s->nearest))
        return true;
    s->nearest = triangle;
    s->side = side;
    const mw_corners corners = {mw__surface_corner(surface, triangle, 0),
                                mw__surface_corner(surface, triangle, 1),
                                mw__surface_corner(surface, triangle, 2)};
    ray_search_limit(s, fmin(fabs(mw__hit_distance(line, corners)), s->ray->greatest));
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
    return s->nearest == MW_NONE ? mw__touch_none(MW_TOUCH_NONE)
                                 : mw__ray_touch(s->prober->surface, s->ray, s->nearest, s->side);
}

/* Has the nearest triangle so far the same corners, in the same order, and a lower number? Then t
 * is met where it is, and is not better: of many equal triangles only one takes exact tests. */
static bool nearest_is_repeated(const mw_ray_search *s, uint32_t t)
{
    if (s->nearest >= t) return s->nearest == t; /* or there is none */
    const mw_surface *surface = s->prober->surface;
    for (uint32_t k = 0; k < 3; k++) {
        const double *p = mw__surface_corner(surface, t, k),
                     *best = mw__surface_corner(surface, s->nearest, k);
        if (p[0] != best[0] || p[1] != best[1] || p[2] != best[2]) return false;
    }
    return true;
}

/* Returns whether the search goes on. */
static MW_INLINE bool ray_search_look(mw_ray_search *s, uint32_t t, const uint32_t v[3])
{
    if (nearest_is_repeated(s, t)) return true;
    const mw_surface *surface = s->prober->surface;
    const mw_corners corners = {mw__surface_point(surface, v[0]), mw__surface_point(surface, v[1]),
                                mw__surface_point(surface, v[2])};
    mw_ray_side side = mw__ray_meets(s->ray, corners);
    if (side == MW_RAY_MISSES) return true;
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
    s->nearest = MW_NONE;
    s->side = MW_RAY_MISSES;
    s->boxes = s->triangles = s->hits = 0;
    s->beam = mw__beam_make(&prober->bvh, &ray->line, prober->slack);
    double reach = ray->greatest;
    if (ray->extent == MW_PROBE_SEGMENT) {
        const double *m = ray->line.m;
        reach = fmin(reach, hypot(hypot(m[0], m[1]), m[2]) * MW_BEAM_REACH_ERROR);
    }
    ray_search_limit(s, reach);
    s->stack.count = 1;
    s->stack.visit[0] = (mw_bvh_visit){0, 0};
}

void mw__ray_search_guess(mw_ray_search *s, uint32_t triangle)
{
    if (!ray_search_look(s, triangle, s->prober->surface->tri[triangle].v)) s->stack.count = 0;
}

static MW_INLINE void ray_search_prefetch_node(const mw_ray_search *s, uint32_t i)
{
    const char *node = (const char *)&s->prober->bvh.node[i];
    for (size_t line = 0; line < sizeof(mw_bvh_node); line += 64) __builtin_prefetch(node + line);
}

/* Visit the next node: which children does the beam meet? Asks for the corners of triangles. */
static MW_INLINE void ray_search_visit(mw_ray_search *s, mw_beam_meets *meets)
{
    mw_bvh_visit visit = s->stack.visit[--s->stack.count];
    s->met = 0;
    if (!(visit.near <= s->beam.reach)) return;
    const mw_bvh_node *node = s->node = &s->prober->bvh.node[visit.node];
    s->met = meets(&s->beam, node, s->near);
    s->boxes += MW_BVH_WIDTH;
    for (uint32_t met = s->met; met; met &= met - 1) {
        uint32_t i = (uint32_t)__builtin_ctz(met);
        if (node->child[i] & MW_BVH_TRIANGLE)
            for (uint32_t k = 0; k < 3; k++)
                __builtin_prefetch(mw__surface_point(s->prober->surface, node->vertex[i][k]));
        else
            ray_search_prefetch_node(s, node->child[i]);
    }
}

/* Look at the triangles of the node, then push the nodes. Returns whether the search goes on. */
static MW_INLINE bool ray_search_descend(mw_ray_search *s)
{
    const mw_bvh_node *node = s->node;
    uint32_t nodes = 0;
    for (uint32_t met = s->met; met; met &= met - 1) {
        uint32_t i = (uint32_t)__builtin_ctz(met), child = node->child[i];
        if (!(child & MW_BVH_TRIANGLE)) {
            nodes |= 1u << i;
        } else if (child != MW_NONE && s->near[i] <= s->beam.reach) {
            s->triangles++;
            if (!ray_search_look(s, child & ~MW_BVH_TRIANGLE, node->vertex[i])) {
                s->stack.count = 0;
                return false;
            }
        }
    }
    uint32_t floor = s->stack.count;
    for (; nodes; nodes &= nodes - 1) {
        uint32_t i = (uint32_t)__builtin_ctz(nodes);
        if (s->near[i] <= s->beam.reach)
            mw__bvh_push(&s->stack, floor, (mw_bvh_visit){s->near[i], node->child[i]});
    }
    return s->stack.count != 0;
}

/* Searches take turns; one that has ended is replaced by the last one. */
static MW_INLINE void ray_searches_run(mw_ray_search *search, uint32_t count, mw_beam_meets *meets)
{
    mw_ray_search *going[MW_RAYS_AT_A_TIME];
    uint32_t n = 0;
    for (uint32_t i = 0; i < count; i++)
        if (search[i].stack.count) going[n++] = &search[i];
    while (n > 1) {
        for (uint32_t i = 0; i < n; i++) ray_search_visit(going[i], meets);
        for (uint32_t i = 0; i < n;)
            if (ray_search_descend(going[i]))
                i++;
            else
                going[i] = going[--n];
    }
    bool goes_on = n > 0;
    while (goes_on) {
        ray_search_visit(going[0], meets);
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
