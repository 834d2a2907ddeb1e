/* star_hubs.c - finds vertices of many facets, and the facet round such a vertex that faces a ray.
 *
 *            w2          The facets round the hub h are stored counter-clockwise, each by its edge
 *      w3  \ | / w1      h w_i. Seen from h, the ray lies in the wedge from w_i to w_{i+1} if it is
 *        `. \|/ .'       to the left of h w_i, or on it, and to the right of h w_{i+1}. "To the
 *   w4 -----h----- w0    left" spans half a turn. So the ring is cut in two at w0 and at the first
 *             * q        w_i that lies to the right of h w0: in either half, for a ray on the same
 *                        side of h w0, all w_i up to the wedge have the ray to their left, and none
 * beyond it has. That is what a binary search needs, and a facet spans less than half a turn. */
#include "star/star_hubs.h"

#include "star/star_walk.h"
#include "topology/coincident.h"

#include <stdlib.h>

static uint32_t hub_link(const mw_star *star, uint32_t half)
{
    return star->facet[mw__link_triangle(half)].link[mw__link_edge(half)];
}

static uint32_t hub_vertex(const mw_star *star, uint32_t facet, uint32_t k)
{
    return mw__representative(star->coincident, star->facet[facet].v[k]);
}

/* --- finding them --- */

/* Count the facets of each vertex, and note a half-edge that starts there. Facets that stand for
 * void ones count twice, which does no harm. */
static void hubs_count(const mw_star *star, uint32_t *degree, uint32_t *half)
{
    for (uint32_t v = 0; v < star->point_count; v++) degree[v] = 0;
    for (uint32_t t = 0; t < star->tri_count; t++)
        for (uint32_t k = 0; k < 3; k++) {
            uint32_t v = hub_vertex(star, t, k);
            degree[v]++;
            half[v] = mw__link(t, k);
        }
}

/* The facet of a half-edge may stand for a void one; its neighbours are linked to the true one. */
static uint32_t hub_true_half(const mw_star *star, uint32_t half)
{
    return hub_link(star, hub_link(star, half));
}

/* Room for the vertices with many facets. */
static bool hubs_allocate(mw_star_hubs *hubs, const mw_star *star, const uint32_t *degree)
{
    size_t count = 0, ring = 0;
    for (uint32_t v = 0; v < star->point_count; v++)
        if (degree[v] >= MW_STAR_HUB_FACETS) {
            count++;
            ring += degree[v];
        }
    if (count == 0) return true;
    hubs->hub = mw__alloc(count, sizeof *hubs->hub);
    hubs->ring = mw__alloc(ring, sizeof *hubs->ring);
    return hubs->hub && hubs->ring;
}

/* Is the end of a half-edge of the ring strictly to the right of the first one? */
static bool hub_is_past_half(const mw_star *star, const uint32_t *ring, uint32_t i)
{
    uint32_t half = ring[i], t = mw__link_triangle(half), k = mw__next(mw__link_edge(half));
    return mw__star_beyond(star, &star->facet[mw__link_triangle(ring[0])], mw__link_edge(ring[0]),
                           mw__star_corner_point(star, star->facet[t].v, k));
}

static void hub_find_half(const mw_star *star, const uint32_t *ring, mw_star_hub *hub)
{
    hub->half = 1;
    while (hub->half < hub->count && !hub_is_past_half(star, ring, hub->half)) hub->half++;
}

static void hub_collect_ring(mw_star_hubs *hubs, const mw_star *star, mw_star_hub *hub,
                             uint32_t first)
{
    uint32_t *ring = hubs->ring + hub->first, half = first;
    hub->count = 0;
    do {
        ring[hub->count++] = half;
        half = mw__star_turn(star, half);
    } while (half != first);
    hub_find_half(star, ring, hub);
}

bool mw__star_hubs_create(mw_star_hubs *hubs, const mw_star *star)
{
    uint32_t n = star->point_count, *degree = mw__alloc(2 * (size_t)n, sizeof *degree);
    *hubs = (mw_star_hubs){0};
    if (!degree) return false;
    uint32_t *half = degree + n;
    hubs_count(star, degree, half);
    bool done = hubs_allocate(hubs, star, degree);
    for (uint32_t v = 0; done && v < n; v++) {
        if (degree[v] < MW_STAR_HUB_FACETS) continue;
        mw_star_hub *hub = &hubs->hub[hubs->count++];
        *hub = (mw_star_hub){.vertex = v, .first = hubs->used};
        hub_collect_ring(hubs, star, hub, hub_true_half(star, half[v]));
        hubs->used += hub->count;
    }
    free(degree);
    return done;
}

void mw__star_hubs_release(mw_star_hubs *hubs)
{
    free(hubs->hub);
    free(hubs->ring);
    *hubs = (mw_star_hubs){0};
}

size_t mw__star_hubs_bytes(const mw_star_hubs *hubs)
{
    return hubs->count * sizeof *hubs->hub + hubs->used * sizeof *hubs->ring;
}

/* --- using them --- */

static mw_star_hub *hub_find(const mw_star *star, uint32_t facet, uint32_t k)
{
    uint32_t v = hub_vertex(star, facet, k), low = 0, high = star->hubs.count;
    while (low < high) {
        uint32_t middle = low + (high - low) / 2;
        if (star->hubs.hub[middle].vertex < v)
            low = middle + 1;
        else
            high = middle;
    }
    return low < star->hubs.count && star->hubs.hub[low].vertex == v ? &star->hubs.hub[low] : NULL;
}

const mw_star_hub *mw__star_hub_at(const mw_star *star, uint32_t facet, uint32_t k)
{
    return hub_find(star, facet, k);
}

/* Does the ray lie strictly to the right of a half-edge that starts at the hub? */
static bool hub_ray_is_right(const mw_star *star, uint32_t half, const double q[3])
{
    return mw__star_beyond(star, &star->facet[mw__link_triangle(half)], mw__link_edge(half), q);
}

uint32_t mw__star_hub_facet(const mw_star *star, const mw_star_hub *hub, const double q[3])
{
    const uint32_t *ring = star->hubs.ring + hub->first;
    bool right = hub_ray_is_right(star, ring[0], q);
    uint32_t low = right ? hub->half - 1 : 0, high = right ? hub->count : hub->half;
    while (high - low > 1) {
        uint32_t middle = low + (high - low) / 2;
        if (hub_ray_is_right(star, ring[middle], q))
            high = middle;
        else
            low = middle;
    }
    return mw__link_triangle(ring[low]);
}

/* --- following moved facets --- */

void mw__star_hubs_renew(mw_star *star)
{
    for (uint32_t i = 0; i < star->hubs.count; i++) {
        mw_star_hub *hub = &star->hubs.hub[i];
        hub_find_half(star, star->hubs.ring + hub->first, hub);
    }
}

void mw__star_hubs_follow(mw_star *star, const uint32_t *facets, uint32_t count)
{
    if (star->hubs.count == 0) return;
    for (uint32_t i = 0; i < count; i++)
        for (uint32_t k = 0; k < 3; k++) {
            mw_star_hub *hub = hub_find(star, facets[i], k);
            if (hub) hub->stale = true;
        }
    for (uint32_t i = 0; i < star->hubs.count; i++) {
        mw_star_hub *hub = &star->hubs.hub[i];
        if (hub->stale) hub_find_half(star, star->hubs.ring + hub->first, hub);
        hub->stale = false;
    }
}
