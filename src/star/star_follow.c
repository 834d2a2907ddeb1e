/* star_follow.c - decides the facets round moved vertices anew, and no others; or all facets where
 * they stand.
 *
 * The star was star-shaped before, by the three conditions of kernel_check.h. It is still closed,
 * and its orientation is a matter of its links, which have not changed. So it remains to decide for
 * the facets round moved vertices that the centre lies strictly behind them; and that some ray
 * meets one facet only. The ray through the inside of a facet that did not move met no other facet
 * before, so now it can meet only those that moved. All of these are tested. */
#include "star/kernel_check.h"
#include "star/star_hubs.h"
#include "topology/coincident.h"

#include <stdatomic.h>
#include <stdlib.h>

/* If more than this part of the facets have moved, deciding all of them takes no longer. */
#define MOST_MOVED 4
/* A ray is looked for in so many facets that did not move. */
#define TRIES 64

/* Places of facets in star->facet, ascending once they are all there. */
typedef struct facet_list {
    uint32_t *item;
    uint32_t count, most;
} facet_list;

/* Make star->place. */
static bool star_find_places(mw_star *star)
{
    if (star->place) return true;
    star->place = mw__alloc(star->tri_count, sizeof *star->place);
    for (uint32_t i = 0; star->place && i < star->tri_count; i++)
        star->place[star->facet[i].user & MW_USER_MASK] = i;
    return star->place != NULL;
}

/* Add all facets round a vertex. Returns false if these are too many. */
static bool facets_round(const mw_star *star, uint32_t vertex, facet_list *list)
{
    if (star->owner[vertex] == MW_NONE) return true; /* of no facet */
    uint32_t place = star->place[star->owner[vertex]], k = 0,
             v = mw__representative(star->coincident, vertex);
    while (k < 2 && mw__representative(star->coincident, star->facet[place].v[k]) != v) k++;
    uint32_t first = mw__link(place, k), half = first;
    do {
        if (list->count == list->most) return false;
        list->item[list->count++] = mw__link_triangle(half);
        half = mw__star_turn(star, half);
    } while (half != first);
    return true;
}

static int places_compare(const void *a, const void *b)
{
    uint32_t x = *(const uint32_t *)a, y = *(const uint32_t *)b;
    return (x > y) - (x < y);
}

/* Each facet once, in ascending order. */
static void facets_tidy(facet_list *list)
{
    uint32_t left = 0;
    qsort(list->item, list->count, sizeof *list->item, places_compare);
    for (uint32_t i = 0; i < list->count; i++)
        if (i == 0 || list->item[i] != list->item[i - 1]) list->item[left++] = list->item[i];
    list->count = left;
}

/* The side of edge k of a facet that the ray through q lies on: > 0 to the left, 0 in its plane. */
static double facet_side(const mw_star *star, const mw_star_facet *facet, uint32_t k,
                         const double q[3])
{
    return -mw__orient3d(mw__star_corner_point(star, facet->v, k),
                         mw__star_corner_point(star, facet->v, mw__next(k)), q, star->centre);
}

/* Is the centre still strictly behind a facet? Facets are counter-clockwise from outside. */
static bool facet_still_faces_out(const mw_star *star, const mw_star_facet *facet)
{
    return mw__star_corners_hold(star, facet->v) &&
           mw__orient3d(mw__star_corner_point(star, facet->v, 0),
                        mw__star_corner_point(star, facet->v, 1),
                        mw__star_corner_point(star, facet->v, 2), star->centre) < 0;
}

/* Does the ray through q meet the facet, its border included? */
static bool facet_meets(const mw_star *star, const mw_star_facet *facet, const double q[3])
{
    return facet_side(star, facet, 0, q) >= 0 && facet_side(star, facet, 1, q) >= 0 &&
           facet_side(star, facet, 2, q) >= 0;
}

/* A point in the cone of a facet, off its border? */
static bool facet_middle(const mw_star *star, const mw_star_facet *facet, double q[3])
{
    for (int k = 0; k < 3; k++)
        q[k] = mw__star_corner_point(star, facet->v, 0)[k] / 3 +
               mw__star_corner_point(star, facet->v, 1)[k] / 3 +
               mw__star_corner_point(star, facet->v, 2)[k] / 3;
    return facet_side(star, facet, 0, q) > 0 && facet_side(star, facet, 1, q) > 0 &&
           facet_side(star, facet, 2, q) > 0;
}

/* Find a ray through the inside of a facet that is not in the list. */
static bool find_still_ray(const mw_star *star, const facet_list *list, double q[3])
{
    uint32_t next = 0, tries = 0;
    for (uint32_t place = 0; place < star->tri_count && tries < TRIES; place++) {
        if (next < list->count && list->item[next] == place) {
            next++;
            continue;
        }
        if (facet_middle(star, &star->facet[place], q)) return true;
        tries++;
    }
    return false;
}

static bool facets_are_star_shaped(const mw_star *star, const facet_list *list)
{
    double q[3];
    if (!find_still_ray(star, list, q)) return false;
    for (uint32_t i = 0; i < list->count; i++) {
        const mw_star_facet *facet = &star->facet[list->item[i]];
        if (!facet_still_faces_out(star, facet) || facet_meets(star, facet, q)) return false;
    }
    return true;
}

/* Fill in what depends on the coordinates of these facets. */
static void facets_renew(mw_star *star, const facet_list *list)
{
    for (uint32_t i = 0; i < list->count; i++) {
        mw_star_facet *facet = &star->facet[list->item[i]];
        mw__star_set_planes(star, facet);
        if (star->angle) mw__star_renew_angles(star, facet);
        for (uint32_t k = 0; k < 9; k++)
            star->reach =
                fmax(star->reach, fabs(mw__star_corner_point(star, facet->v, k / 3)[k % 3] -
                                       star->centre[k % 3]));
    }
    mw__star_hubs_follow(star, list->item, list->count);
}

bool mw__star_follow(mw_star *star, const uint32_t *moved, size_t count)
{
    facet_list list = {.most = star->tri_count / MOST_MOVED};
    if (count > list.most || !star_find_places(star)) return false;
    list.item = mw__alloc(list.most, sizeof *list.item);
    bool done = list.item != NULL;
    for (size_t i = 0; i < count && done; i++) done = facets_round(star, moved[i], &list);
    if (done) facets_tidy(&list);
    done = done && facets_are_star_shaped(star, &list);
    if (done) facets_renew(star, &list);
    free(list.item);
    return done;
}

/* --- all facets --- */

typedef struct star_renewal {
    mw_star *star;
    atomic_bool fails;
    atomic_uint_fast32_t met;
} star_renewal;

/* Decide some facets and set their planes. By any thread. */
static void facets_decide(void *work, uint64_t from, uint64_t to)
{
    star_renewal *r = work;
    uint32_t met = 0;
    for (uint64_t i = from; i < to; i++) {
        mw_star_facet *facet = &r->star->facet[i];
        if (!facet_still_faces_out(r->star, facet)) {
            atomic_store_explicit(&r->fails, true, memory_order_relaxed);
            return;
        }
        met += mw__star_first_ray_meets(r->star, facet->v);
        mw__star_set_planes(r->star, facet);
        facet->user &= ~MW_SEAM;
    }
    atomic_fetch_add_explicit(&r->met, met, memory_order_relaxed);
}

/* Does the guide still lead near the facets? The order of facets is that of the curve as it was. */
static bool guide_still_leads(const mw_star *star)
{
    enum { LOOKS = 256, FAR = 256 };
    uint32_t step = star->tri_count / LOOKS + 1, looks = 0, far = 0;
    for (uint32_t i = 0; i < star->tri_count; i += step, looks++) {
        double d[3];
        for (int k = 0; k < 3; k++)
            d[k] = mw__star_corner_point(star, star->facet[i].v, 0)[k] / 2 - star->centre[k] / 2;
        uint32_t led = mw__star_guide_facet(star, mw__star_curve_key(star->curve, d));
        far += (led < i ? i - led : led - i) > FAR;
    }
    return 2 * far <= looks;
}

bool mw__star_follow_all(mw_star *star, mw_job *job)
{
    star_renewal r = {.star = star};
    if (!guide_still_leads(star)) return false;
    star->ready = false;
    mw__job_stage(job, "looking at facets", 1);
    if (!mw__job_ranges(job, star->tri_count, facets_decide, &r) || r.fails || r.met != 1)
        return false;
    star->reach = mw__star_measure_reach(star);
    if (star->angle) mw__star_fill_angles(star);
    mw__star_hubs_renew(star);
    return true;
}
