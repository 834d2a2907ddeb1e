/* star_borrowed.c - one ray on the records of the surface: first facet, walk, conclusion. This file
 * decides ties of borrowed stars.
 *
 * If the ray passes through an edge or a vertex of the facet where the walk ended, it also meets
 * the facets round that edge or vertex. If one of these is flat, others may lie behind it. Then all
 * facets are tested in ascending order, and the first that the ray meets is the answer. The same is
 * done if a walk does not end, or if the star is unchecked and the facet does not face outwards. */
#include "star/borrow/star_borrowed.h"

#include "base/random.h"
#include "star/star_location.h"
#include "topology/coincident.h"

/* --- the first facet --- */

/* Grows with the cosine of the angle between d and vertex 0 of facet t. It is rounded, as it is
 * only a guide. */
static double borrowed_star_nearness(const mw_star *star, const double d[3], uint32_t t)
{
    const double *p = mw__surface_corner(star->surface, t, 0), *c = star->centre;
    double x = p[0] - c[0], y = p[1] - c[1], z = p[2] - c[2];
    return (d[0] * x + d[1] * y + d[2] * z) / sqrt(x * x + y * y + z * z);
}

/* The square of the distance of two points on the unit sphere, in the directions u and v. */
static double borrowed_star_apart(const double u[3], const double v[3])
{
    double uu = 0, vv = 0, uv = 0;
    for (int k = 0; k < 3; k++) {
        uu += u[k] * u[k];
        vv += v[k] * v[k];
        uv += u[k] * v[k];
    }
    return 2 - 2 * uv / sqrt(uu * vv);
}

/* Is the ray within a few lengths of the longer edge at vertex 0 of facet t, seen from the centre?
 */
static bool borrowed_star_is_close(const mw_star *star, const double d[3], uint32_t t)
{
    enum { LENGTHS = 2 };
    double corner[3][3];
    for (uint32_t i = 0; i < 3; i++)
        for (int k = 0; k < 3; k++)
            corner[i][k] = mw__surface_corner(star->surface, t, i)[k] - star->centre[k];
    double longest =
        fmax(borrowed_star_apart(corner[0], corner[1]), borrowed_star_apart(corner[0], corner[2]));
    return borrowed_star_apart(corner[0], d) <= LENGTHS * LENGTHS * longest;
}

/* The nearest of some random facets, as star_start.c has it. */
static uint32_t borrowed_star_sample(const mw_star_borrowed_walk *w, uint32_t count,
                                     uint64_t *random)
{
    const mw_surface *surface = w->star->surface;
    if (count == 0) count = (uint32_t)ceil(2 * sqrt(sqrt(surface->point_count)));
    if (count > surface->tri_count) count = surface->tri_count;
    uint32_t best = 0;
    double nearest = -INFINITY;
    for (uint32_t i = 0; i < count; i++) {
        uint32_t t = mw__random_below(random, surface->tri_count);
        double near = borrowed_star_nearness(w->star, w->d, t);
        if (!(near > nearest)) continue;
        nearest = near;
        best = t;
    }
    return best;
}

static uint32_t borrowed_star_first(mw_star_borrowed_walk *w, const mw_star_cursor *cursor,
                                    uint32_t last)
{
    const mw_surface *surface = w->star->surface;
    mw_star_start_kind start = (mw_star_start_kind)cursor->start;
    if (start == MW_STAR_START_RANDOM) return mw__random_below(&w->random, surface->tri_count);
    if (start != MW_STAR_START_SAMPLE && last < surface->tri_count &&
        (start != MW_STAR_START_AUTO || borrowed_star_is_close(w->star, w->d, last)))
        return last;
    return borrowed_star_sample(w, cursor->sample, &w->random);
}

/* Begin in facet t; where that is flat, in some other facet. */
static bool borrowed_star_begin(mw_star_borrowed_walk *w, uint32_t t)
{
    enum { TRIES = 64 };
    for (int i = 0; i < TRIES; i++) {
        if (mw__star_borrowed_enter(w, t)) return true;
        t = mw__random_below(&w->random, w->star->surface->tri_count);
    }
    return false;
}

/* --- the conclusion --- */

/* Does the ray meet facet t, its border included? The three half-spaces of its edges meet in its
 * cone, without the opposite cone. */
static bool borrowed_star_meets(mw_star_borrowed_walk *w, uint32_t t)
{
    bool left = false, right = false;
    for (uint32_t k = 0; k < 3; k++) {
        double side = mw__star_borrowed_side(w, t, k);
        left = left || side > 0;
        right = right || side < 0;
        if (left && right) return false;
    }
    if (left == right) return false;
    return mw__star_borrowed_facing(w->star, t) == (left ? 1 : -1);
}

/* The first facet of all that the ray meets, or MW_NONE. */
static uint32_t borrowed_star_scan(mw_star_borrowed_walk *w)
{
    for (uint32_t t = 0; t < w->star->surface->tri_count; t++)
        if (borrowed_star_meets(w, t)) return t;
    return MW_NONE;
}

/* Is facet t one with an area? Only then do its neighbours on an edge or at a vertex tell all. */
static bool borrowed_star_is_solid(const mw_star *star, uint32_t t)
{
    return !(star->unchecked || star->has_flat) || mw__star_borrowed_facing(star, t) != 0;
}

static uint32_t borrowed_star_lowest_at_edge(const mw_star *star, uint32_t t, uint32_t k)
{
    uint32_t link = star->surface->tri[t].link[k];
    if (link == MW_NONE || !borrowed_star_is_solid(star, mw__link_triangle(link))) return MW_NONE;
    return mw__link_triangle(link) < t ? mw__link_triangle(link) : t;
}

/* Turn round corner k of facet t, once. */
static uint32_t borrowed_star_lowest_at_vertex(const mw_star *star, uint32_t t, uint32_t k)
{
    const mw_surface *surface = star->surface;
    uint32_t first = t, lowest = t, edge = k,
             at = mw__representative(surface->coincident, surface->tri[t].v[k]);
    for (uint32_t turns = 0; turns < surface->tri_count; turns++) {
        uint32_t link = surface->tri[t].link[edge];
        if (link == MW_NONE) return MW_NONE;
        t = mw__link_triangle(link);
        if (t == first) return lowest;
        if (!borrowed_star_is_solid(star, t)) return MW_NONE;
        if (t < lowest) lowest = t;
        edge = mw__link_edge(link);
        bool begins = mw__representative(surface->coincident, surface->tri[t].v[edge]) == at;
        edge = begins ? mw__prev(edge) : mw__next(edge); /* the other edge at the vertex */
    }
    return MW_NONE;
}

/* The lowest facet that the ray meets, which meets facet t; MW_NONE: these links do not tell. */
static uint32_t borrowed_star_lowest(const mw_star *star, uint32_t t, const double area[3])
{
    uint32_t zeros = 0, on = 0, at = 0;
    for (uint32_t k = 0; k < 3; k++)
        if (area[k] == 0) {
            zeros++;
            on = mw__next(k); /* the edge opposite to vertex k */
        } else {
            at = k;
        }
    if (MW_LIKELY(zeros == 0)) return t;
    return zeros == 1 ? borrowed_star_lowest_at_edge(star, t, on)
                      : borrowed_star_lowest_at_vertex(star, t, at);
}

/* The walk has ended in its facet. Where nothing was checked, does this face outwards, as the walk
 * takes it to do? */
static bool borrowed_star_is_right(const mw_star_borrowed_walk *w)
{
    return !w->star->unchecked || mw__star_borrowed_facing(w->star, w->t) == (w->turned ? -1 : 1);
}

/* --- the query --- */

static void borrowed_star_aim(mw_star_borrowed_walk *w, const double q[3])
{
    for (int k = 0; k < 3; k++) {
        w->c[k] = w->star->centre[k];
        w->q[k] = q[k];
        w->d[k] = q[k] - w->star->centre[k];
    }
}

mw_location mw__star_borrowed_answer(const mw_star *star, const mw_star_cursor *cursor,
                                     const double q[3], uint32_t *last, uint64_t *random,
                                     mw_star_work *work, bool *scanned, mw_star_trace *trace)
{
    mw_star_borrowed_walk w = {.star = star, .random = *random, .fuel = star->fuel, .trace = trace};
    double area[3];
    borrowed_star_aim(&w, q);
    uint32_t number = MW_NONE;
    bool found = star->surface->tri_count > 0 &&
                 borrowed_star_begin(&w, borrowed_star_first(&w, cursor, *last)) &&
                 mw__star_borrowed_run(&w) && borrowed_star_is_right(&w);
    if (MW_LIKELY(found)) {
        mw__star_areas(star, star->surface->tri[w.t].v, q, area);
        number = borrowed_star_lowest(star, w.t, area);
    }
    *scanned = number == MW_NONE;
    if (MW_UNLIKELY(*scanned)) number = borrowed_star_scan(&w);
    *random = w.random;
    *work = w.work;
    *last = found ? w.t : number;
    if (MW_UNLIKELY(number == MW_NONE)) {
        mw_location none = mw__star_location_none();
        none.where = MW_OUTSIDE;
        return none;
    }
    mw_location location;
    if (MW_UNLIKELY(!found || number != w.t))
        mw__star_areas(star, star->surface->tri[number].v, q, area);
    mw__star_location_in_facet(star, number, q, area, &location);
    return location;
}
