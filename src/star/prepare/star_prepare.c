/* star_prepare.c - what a star holds of its surface: memory for it, the decision whether the
 * surface is star-shaped, and what follows from its facets. */
#include "star/prepare/star_prepare.h"
#include "topology/coincident.h"
#include "star/prepare/flat_facets.h"
#include "star/prepare/kernel_check.h"
#include "star/prepare/star_track.h"
#include "star/star_hubs.h"

#include <inttypes.h>
#include <stdlib.h>
#include <string.h>

/* Returns MW_ERROR_INPUT; the error names the first defect. */
static mw_status star_refuse(const mw_defects *defects, mw_error *error)
{
    char text[256];
    const mw_defect *d = &defects->list[0];
    mw_defect_describe(d, text, sizeof text);
    return mw__fail_at(error, d->triangle, d->vertex == MW_NONE ? -1 : (int64_t)d->vertex, "%s",
                       text);
}

/* Find coincident vertices, which flat facets may have, also those that did not coincide when the
 * surface was made. */
static bool star_find_coincident(mw_star *star)
{
    free(star->own_coincident);
    star->coincident = star->own_coincident =
        mw__coincident_create(star->surface->point, star->point_count);
    return star->coincident != NULL;
}

static void star_fill_owners(mw_star *star)
{
    for (uint32_t v = 0; v < star->point_count; v++) star->owner[v] = MW_NONE;
    for (uint32_t t = 0; t < star->tri_count; t++)
        for (uint32_t k = 0; k < 3 && !(star->tri[t].user & MW_STAR_OMITTED); k++) {
            uint32_t *owner = &star->owner[mw__representative(star->coincident, star->tri[t].v[k])];
            uint32_t user = star->tri[t].user & MW_USER_MASK;
            if (user < *owner) *owner = user;
        }
    for (uint32_t v = 0; v < star->point_count; v++)
        star->owner[v] = star->owner[mw__representative(star->coincident, v)];
}

/* Void facets have no links, and freed ones neither. */
static void star_omit_voids(mw_star *star)
{
    for (uint32_t t = 0; t < star->tri_count; t++)
        if (mw__star_is_void(&star->tri[t])) star->tri[t].user |= MW_STAR_OMITTED;
}

double mw__star_measure_reach(const mw_star *star)
{
    double reach = 0;
    for (uint32_t v = 0; v < star->point_count; v++)
        for (int k = 0; k < 3 && star->owner[v] != MW_NONE; k++)
            reach = fmax(reach, fabs(mw__surface_point(star->surface, v)[k] - star->centre[k]));
    return reach;
}

/* Are the facets in star->tri those of a star-shaped polyhedron? They are oriented as star.h says
 * if they are. */
static mw_status star_decide(mw_star *star, mw_job *job, mw_error *error)
{
    mw_defects defects = {0};
    memcpy(star->tri, star->surface->tri, star->tri_count * sizeof *star->tri);
    mw_job_span outer = mw__job_part(job, 0.5);
    mw_status status = mw__star_kernel_check(star, job, &defects) ? MW_OK : mw__fail_memory(error);
    mw__job_part_end(job, outer);
    if (status == MW_OK && defects.count) status = star_refuse(&defects, error);
    mw__defects_release(&defects);
    if (status == MW_OK && star->area_count == 0)
        status = mw__fail(error, MW_ERROR_INPUT, "the polyhedron has no facet with an area");
    return status;
}

/* Store the facets in star->tri, with all that depends on coordinates and links but the rings of
 * hubs. False when out of memory, or cancelled. */
static bool star_store(mw_star *star, mw_job *job)
{
    mw__job_stage(job, "finding the owners of vertices", 0.1);
    star_fill_owners(star);
    mw_job_span outer = mw__job_part(job, 0.4);
    bool done = mw__star_lay_out(star, job);
    mw__job_part_end(job, outer);
    if (!done) return false;
    star->reach = mw__star_measure_reach(star);
    if (star->angle) mw__star_fill_angles(star);
    mw__star_hubs_release(&star->hubs);
    return mw__star_hubs_create(&star->hubs, star);
}

static bool star_store_sound(mw_star *star, mw_job *job)
{
    mw__star_track_end(star);
    star->coincident = star->surface->coincident;
    if (mw__star_has_flats(star)) {
        if (!star_find_coincident(star)) return false;
        mw__flat_facets_remove(star);
    }
    star_omit_voids(star);
    return star_store(star, job) && mw__star_hubs_collect(star);
}

void mw__star_find_front(mw_star *star)
{
    static const double front[3] = {1, 0, 0};
    star->front = mw__star_facet_along(star, front, star->front % star->facet_count);
}

static void star_finish(mw_star *star)
{
    mw__star_find_front(star);
    star->version = star->surface->version;
    star->shape = star->surface->shape;
    star->ready = true;
}

/* A borrowed star stores nothing. Only if there are flat facets, or defects to be named, its check
 * takes memory. */
static mw_status star_prepare_borrowed(mw_star *star, mw_job *job, mw_error *error)
{
    mw_status status = MW_OK;
    mw_job_span outer = mw__job_part(job, 0.5);
    star->has_flat = !star->unchecked && !mw__star_kernel_holds(star, job);
    mw__job_part_end(job, outer);
    if (star->has_flat) {
        star->tri = mw__alloc(star->tri_count, sizeof *star->tri);
        status = star->tri ? star_decide(star, job, error) : mw__fail_memory(error);
        free(star->tri);
        star->tri = NULL;
    }
    star->version = star->surface->version;
    star->shape = star->surface->shape;
    star->ready = status == MW_OK;
    return status;
}

mw_status mw__star_prepare(mw_star *star, mw_job *job, mw_error *error)
{
    star->ready = false;
    if (star->borrowed) return star_prepare_borrowed(star, job, error);
    star->tri = mw__alloc(star->tri_count, sizeof *star->tri);
    mw_status status = star->tri ? star_decide(star, job, error) : mw__fail_memory(error);
    if (!status && !star_store_sound(star, job)) status = mw__fail_memory(error);
    free(star->tri);
    star->tri = NULL;
    if (!status) star_finish(star);
    return status;
}

/* --- a surface that need not be star-shaped --- */

/* Which facets have the centre in front of them? They are turned. Their neighbours' links change,
 * too. */
static bool star_turn_backs(mw_star *star)
{
    int8_t *turned = mw__alloc(star->tri_count, sizeof *turned);
    if (!turned) return false;
    for (uint32_t t = 0; t < star->tri_count; t++)
        turned[t] =
            !mw__surface_is_freed(star->surface, t) && mw__star_track_turns(star, star->tri[t].v);
    mw__facets_turn(star, turned);
    free(turned);
    return true;
}

bool mw__star_track_anew(mw_star *star)
{
    mw_job job = mw__job(1, NULL);
    star->ready = false;
    mw__star_track_end(star);
    star->coincident = star->surface->coincident;
    star->tri = mw__alloc(star->tri_count, sizeof *star->tri);
    bool done = star->tri != NULL;
    if (done) memcpy(star->tri, star->surface->tri, star->tri_count * sizeof *star->tri);
    done = done && star_turn_backs(star) && star_store(star, &job) && mw__star_track_begin(star);
    free(star->tri);
    star->tri = NULL;
    return done;
}

/* --- memory --- */

/* About 45 times the square root of the number of facets is far above the length of any walk on a
 * Delaunay sphere of well spread points. The constant is for small spheres. A walk that needs more
 * steps cycles, or nearly so. */
static uint32_t star_fuel(uint32_t facets)
{
    return (uint32_t)(4096 + 45 * sqrt(facets));
}

/* A facet takes up 4 pi / n of the sphere, on average. */
#define NEAR_FACETS 2.5

static float star_near(uint32_t facets)
{
    return (float)fmin(NEAR_FACETS * sqrt(12.6 / facets), 0.5);
}

void mw__star_release_arrays(mw_star *star)
{
    mw__star_track_end(star);
    free(star->facet);
    free(star->owner);
    free(star->guide);
    free(star->angle);
    free(star->curve);
    star->curve = NULL;
    star->facet = NULL;
    star->owner = star->guide = NULL;
    star->angle = NULL;
    star->facet_count = star->tri_room = star->point_room = 0;
}

void mw__star_take_counts(mw_star *star)
{
    star->tri_count = star->surface->tri_count;
    star->point_count = star->surface->point_count;
    star->freed_count = star->surface->freed_triangles;
    star->fuel = star_fuel(star->tri_count);
    star->near = star_near(star->tri_count);
}

bool mw__star_allocate(mw_star *star, bool angles)
{
    mw__star_take_counts(star);
    if (star->borrowed) return true;
    star->curve = mw__alloc(1, sizeof *star->curve);
    if (star->curve) *star->curve = mw__star_curve();
    star->tri_room = star->tri_count;
    star->point_room = star->point_count;
    star->facet = mw__alloc_lines(star->tri_count, sizeof *star->facet);
    star->owner = mw__alloc(star->point_count, sizeof *star->owner);
    star->guide_bits = mw__star_guide_bits(star->tri_count);
    star->guide = mw__alloc((size_t)1 << star->guide_bits, sizeof *star->guide);
    if (angles) star->angle = mw__alloc_lines(star->point_count, 2 * sizeof *star->angle);
    return star->curve && star->facet && star->owner && star->guide && (star->angle || !angles);
}
