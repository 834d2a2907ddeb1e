/* star_renew.c - decides all facets of a star where they stand: for surfaces whose vertices have
 * moved, but not their triangles.
 *
 * The links are those of before, so the surface is closed, and its facets are oriented alike. It
 * remains to decide that the centre lies strictly behind each, and that one ray meets only one
 * (kernel_check.h). The facets keep their order along the curve, and the guide what it has: both
 * only tell where something was, and walks find where it is now. */
#include "star/prepare/star_renew.h"
#include "star/prepare/kernel_check.h"
#include "star/prepare/star_prepare.h"
#include "star/star_hubs.h"

#include <stdatomic.h>

typedef struct star_renewal {
    mw_star *star;
    atomic_bool fails;
    atomic_uint_fast32_t met;
} star_renewal;

static bool renewal_faces_out(const mw_star *star, const uint32_t v[3])
{
    return mw__star_corners_hold(star, v) &&
           mw__orient3d(mw__star_corner_point(star, v, 0), mw__star_corner_point(star, v, 1),
                        mw__star_corner_point(star, v, 2), star->centre) < 0;
}

/* Decide some facets and set their planes. By any thread. */
static void renewal_decide(void *work, uint64_t from, uint64_t to)
{
    star_renewal *r = work;
    uint32_t met = 0;
    for (uint64_t i = from; i < to; i++) {
        mw_star_facet *facet = &r->star->facet[i];
        if (!renewal_faces_out(r->star, facet->v)) {
            atomic_store_explicit(&r->fails, true, memory_order_relaxed);
            return;
        }
        met += mw__star_ray_meets(r->star, facet->v);
        mw__star_set_planes(r->star, facet);
        facet->user &= ~MW_SEAM;
    }
    atomic_fetch_add_explicit(&r->met, met, memory_order_relaxed);
}

/* Does the guide still lead near the facets, if not to them? */
static bool renewal_guide_leads(const mw_star *star)
{
    enum { LOOKS = 256, FAR = 256 };
    uint32_t step = star->facet_count / LOOKS + 1, looks = 0, far = 0;
    for (uint32_t i = 0; i < star->facet_count; i += step, looks++) {
        double d[3];
        for (int k = 0; k < 3; k++)
            d[k] = mw__star_corner_point(star, star->facet[i].v, 0)[k] / 2 - star->centre[k] / 2;
        uint32_t led = mw__star_guide_facet(star, mw__star_curve_key(star->curve, d));
        far += (led < i ? i - led : led - i) > FAR;
    }
    return 2 * far <= looks;
}

bool mw__star_can_renew(const mw_star *star)
{
    return star->ready && !star->borrowed && star->shape == star->surface->shape &&
           !mw__star_has_flats(star) && renewal_guide_leads(star);
}

bool mw__star_renew(mw_star *star, mw_job *job)
{
    star_renewal r = {.star = star};
    star->ready = false;
    mw__job_stage(job, "looking at facets", 1);
    if (!mw__job_ranges(job, star->facet_count, renewal_decide, &r) || r.fails || r.met != 1 ||
        !mw__star_hubs_collect(star))
        return false;
    star->reach = mw__star_measure_reach(star);
    if (star->angle) mw__star_fill_angles(star);
    mw__star_find_front(star);
    star->version = star->surface->version;
    star->ready = true;
    return true;
}
