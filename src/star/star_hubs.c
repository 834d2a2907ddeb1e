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
#include <string.h>

static uint32_t hub_vertex(const mw_star *star, uint32_t facet, uint32_t k)
{
    return mw__representative(star->coincident, star->facet[facet].v[k]);
}

/* Which hub a vertex is, or MW_NONE. */
static uint32_t hub_number(const mw_star *star, uint32_t vertex)
{
    uint32_t low = 0, high = star->hubs.count;
    while (low < high) {
        uint32_t middle = low + (high - low) / 2;
        if (star->hubs.hub[middle].vertex < vertex)
            low = middle + 1;
        else
            high = middle;
    }
    return low < star->hubs.count && star->hubs.hub[low].vertex == vertex ? low : MW_NONE;
}

/* --- finding them --- */

/* Count the facets of each vertex. */
static void hubs_count(const mw_star *star, uint32_t *degree)
{
    for (uint32_t v = 0; v < star->point_count; v++) degree[v] = 0;
    for (uint32_t t = 0; t < star->facet_count; t++)
        for (uint32_t k = 0; k < 3; k++) degree[hub_vertex(star, t, k)]++;
}

bool mw__star_hubs_create(mw_star_hubs *hubs, const mw_star *star)
{
    uint32_t n = star->point_count, count = 0, *degree = mw__alloc(n, sizeof *degree);
    *hubs = (mw_star_hubs){0};
    if (!degree) return false;
    hubs_count(star, degree);
    for (uint32_t v = 0; v < n; v++) count += degree[v] >= MW_STAR_HUB_FACETS;
    if (count) hubs->hub = mw__alloc(count, sizeof *hubs->hub);
    bool done = count == 0 || hubs->hub;
    for (uint32_t v = 0; v < n && done; v++)
        if (degree[v] >= MW_STAR_HUB_FACETS)
            hubs->hub[hubs->count++] = (mw_star_hub){.vertex = v, .stale = true};
    hubs->room = hubs->stale = hubs->count;
    free(degree);
    return done;
}

void mw__star_hubs_release(mw_star_hubs *hubs)
{
    for (uint32_t i = 0; i < hubs->count; i++) free(hubs->hub[i].ring);
    free(hubs->hub);
    *hubs = (mw_star_hubs){0};
}

size_t mw__star_hubs_bytes(const mw_star_hubs *hubs)
{
    size_t bytes = hubs->room * sizeof *hubs->hub;
    for (uint32_t i = 0; i < hubs->count; i++)
        bytes += hubs->hub[i].room * sizeof *hubs->hub[i].ring;
    return bytes;
}

/* --- their rings --- */

/* Is the end of a half-edge of the ring strictly to the right of the first one? */
static bool hub_is_past_half(const mw_star *star, const uint32_t *ring, uint32_t i)
{
    uint32_t half = ring[i], t = mw__link_triangle(half), k = mw__next(mw__link_edge(half));
    return mw__star_beyond(star, &star->facet[mw__link_triangle(ring[0])], mw__link_edge(ring[0]),
                           mw__star_corner_point(star, star->facet[t].v, k));
}

static void hub_find_half(const mw_star *star, mw_star_hub *hub)
{
    hub->half = 1;
    while (hub->half < hub->count && !hub_is_past_half(star, hub->ring, hub->half)) hub->half++;
}

static bool hub_ring_add(mw_star_hub *hub, uint32_t half)
{
    if (hub->count == hub->room) {
        uint32_t room = hub->room + hub->room / 2 + MW_STAR_HUB_FACETS,
                 *ring = mw__realloc(hub->ring, room, sizeof *ring);
        if (!ring) return false;
        hub->ring = ring;
        hub->room = room;
    }
    hub->ring[hub->count++] = half;
    return true;
}

/* `first`: a half-edge that starts at the hub. */
static bool hub_collect_ring(const mw_star *star, mw_star_hub *hub, uint32_t first)
{
    uint32_t half = first;
    hub->count = 0;
    do {
        if (!hub_ring_add(hub, half)) return false;
        half = mw__star_turn(star, half);
    } while (half != first);
    hub_find_half(star, hub);
    return true;
}

/* A half-edge that starts at each vertex that is a stale hub. */
static void hubs_find_starts(const mw_star *star, uint32_t *start)
{
    for (uint32_t t = 0; t < star->facet_count; t++)
        for (uint32_t k = 0; k < 3; k++) {
            uint32_t i = hub_number(star, hub_vertex(star, t, k));
            if (i != MW_NONE) start[i] = mw__link(t, k);
        }
}

bool mw__star_hubs_collect(mw_star *star)
{
    mw_star_hubs *hubs = &star->hubs;
    if (hubs->count == 0) return true;
    uint32_t *start = mw__alloc(hubs->count, sizeof *start);
    bool done = start != NULL;
    if (done) hubs_find_starts(star, start);
    for (uint32_t i = 0; i < hubs->count && done; i++) {
        done = hub_collect_ring(star, &hubs->hub[i], start[i]);
        hubs->hub[i].stale = false;
    }
    if (done) hubs->stale = 0;
    free(start);
    return done;
}

/* --- using them --- */

const mw_star_hub *mw__star_hub_at(const mw_star *star, uint32_t facet, uint32_t k)
{
    uint32_t i = hub_number(star, hub_vertex(star, facet, k));
    return i == MW_NONE ? NULL : &star->hubs.hub[i];
}

/* Does the ray lie strictly to the right of a half-edge that starts at the hub? */
static bool hub_ray_is_right(const mw_star *star, uint32_t half, const double q[3])
{
    return mw__star_beyond(star, &star->facet[mw__link_triangle(half)], mw__link_edge(half), q);
}

uint32_t mw__star_hub_facet(const mw_star *star, const mw_star_hub *hub, const double q[3])
{
    const uint32_t *ring = hub->ring;
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

/* --- following changed facets --- */

static void hub_set_stale(mw_star_hubs *hubs, mw_star_hub *hub)
{
    hubs->stale += !hub->stale;
    hub->stale = true;
}

static void hub_remove(mw_star_hubs *hubs, uint32_t i)
{
    hubs->stale -= hubs->hub[i].stale;
    free(hubs->hub[i].ring);
    hubs->count--;
    memmove(&hubs->hub[i], &hubs->hub[i + 1], (hubs->count - i) * sizeof *hubs->hub);
}

/* When memory is short there is no hub: walks go round the vertex, with the same answer. */
static void hub_insert(mw_star_hubs *hubs, uint32_t vertex)
{
    if (hubs->count == hubs->room) {
        uint32_t room = hubs->room + hubs->room / 2 + 4;
        mw_star_hub *hub = mw__realloc(hubs->hub, room, sizeof *hub);
        if (!hub) return;
        hubs->hub = hub;
        hubs->room = room;
    }
    uint32_t i = hubs->count++;
    for (; i > 0 && hubs->hub[i - 1].vertex > vertex; i--) hubs->hub[i] = hubs->hub[i - 1];
    hubs->hub[i] = (mw_star_hub){.vertex = vertex, .stale = true};
    hubs->stale++;
}

void mw__star_hub_touch(mw_star *star, uint32_t vertex, uint32_t degree)
{
    if (MW_LIKELY(degree < MW_STAR_HUB_FACETS && star->hubs.count == 0)) return;
    uint32_t i = hub_number(star, vertex);
    if (i != MW_NONE && degree < MW_STAR_HUB_FACETS / 2)
        hub_remove(&star->hubs, i);
    else if (i != MW_NONE)
        hub_set_stale(&star->hubs, &star->hubs.hub[i]);
    else if (degree >= MW_STAR_HUB_FACETS)
        hub_insert(&star->hubs, vertex);
}

void mw__star_hubs_renew(mw_star *star)
{
    mw_star_hubs *hubs = &star->hubs;
    for (uint32_t i = hubs->count; i-- > 0 && hubs->stale > 0;) {
        mw_star_hub *hub = &hubs->hub[i];
        if (!hub->stale) continue;
        uint32_t place = star->track.place[star->owner[hub->vertex]], k = 0;
        while (k < 2 && hub_vertex(star, place, k) != hub->vertex) k++;
        if (!hub_collect_ring(star, hub, mw__link(place, k))) {
            hub_remove(hubs, i);
            continue;
        }
        hub->stale = false;
        hubs->stale--;
    }
}
