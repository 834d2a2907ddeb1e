/* star_create.c - prepares a surface for rays from a centre. */
#include "topology/coincident.h"
#include "base/options.h"
#include "star/flat_facets.h"
#include "star/kernel_check.h"
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
        for (uint32_t k = 0; k < 3 && !mw__star_is_void(&star->tri[t]); k++) {
            uint32_t *owner = &star->owner[mw__representative(star->coincident, star->tri[t].v[k])];
            uint32_t user = star->tri[t].user & MW_USER_MASK;
            if (user < *owner) *owner = user;
        }
    for (uint32_t v = 0; v < star->point_count; v++)
        star->owner[v] = star->owner[mw__representative(star->coincident, v)];
}

/* Void facets have no links. Other facets take their place, for walks that would start in one. */
static void star_replace_voids(mw_star *star, uint32_t any)
{
    for (uint32_t t = 0; t < star->tri_count; t++) {
        const mw_triangle *facet = &star->tri[t];
        if (!mw__star_is_void(facet)) continue;
        uint32_t near = star->owner[facet->v[0]];
        if (near == MW_NONE) near = star->owner[facet->v[1]];
        star->tri[t] = star->tri[near == MW_NONE ? any : near];
    }
}

/* Any facet with an area. */
static uint32_t star_any_facet(const mw_star *star)
{
    uint32_t v = 0;
    while (star->owner[v] == MW_NONE) v++;
    return star->owner[v];
}

/* Check the polyhedron, whose triangles star->tri becomes, turned. */
static mw_status star_check_triangles(mw_star *star, mw_job *job, mw_error *error)
{
    mw_defects defects = {0};
    memcpy(star->tri, star->surface->tri, star->tri_count * sizeof *star->tri);
    mw_status status = mw__star_kernel_check(star, job, &defects) ? MW_OK : mw__fail_memory(error);
    if (status == MW_OK && defects.count) status = star_refuse(&defects, error);
    mw__defects_release(&defects);
    if (status == MW_OK && star->area_count == 0)
        status = mw__fail(error, MW_ERROR_INPUT, "the polyhedron has no facet with an area");
    return status;
}

/* Check the polyhedron, and prepare star->tri for the layout. */
static mw_status star_decide(mw_star *star, mw_job *job, mw_error *error)
{
    star->coincident = star->surface->coincident;
    mw_job_span outer = mw__job_part(job, 0.5);
    mw_status status = star_check_triangles(star, job, error);
    mw__job_part_end(job, outer);
    if (status) return status;
    if (star->area_count < star->tri_count) {
        if (!star_find_coincident(star)) return mw__fail_memory(error);
        mw__flat_facets_remove(star);
    }
    mw__job_stage(job, "finding the owners of vertices", 0.1);
    star_fill_owners(star);
    star_replace_voids(star, star_any_facet(star));
    outer = mw__job_part(job, 0.4);
    bool done = mw__star_lay_out(star, job);
    mw__job_part_end(job, outer);
    if (!done) return mw__fail_memory(error);
    mw__star_hubs_release(&star->hubs);
    return mw__star_hubs_create(&star->hubs, star) ? MW_OK : mw__fail_memory(error);
}

/* The facets are up to date. */
static void star_finish(mw_star *star)
{
    static const double front[3] = {1, 0, 0};
    star->front = mw__star_facet_along(star, front, star->front);
    star->version = star->surface->version;
    star->shape = star->surface->shape;
    star->ready = true;
}

/* Run a decision that needs star->tri. */
static mw_status star_with_triangles(mw_star *star, mw_job *job, mw_error *error,
                                     mw_status (*decide)(mw_star *star, mw_job *job,
                                                         mw_error *error))
{
    star->tri = mw__alloc(star->tri_count, sizeof *star->tri);
    mw_status status = star->tri ? decide(star, job, error) : mw__fail_memory(error);
    free(star->tri);
    star->tri = NULL;
    return status;
}

/* A borrowed star has nothing to fill in. Only if there are flat facets, or defects to be named,
 * its check takes memory. */
static mw_status star_prepare_borrowed(mw_star *star, mw_job *job, mw_error *error)
{
    mw_job_span outer = mw__job_part(job, 0.5);
    star->has_flat = !star->unchecked && !mw__star_kernel_holds(star, job);
    mw__job_part_end(job, outer);
    outer = mw__job_part(job, 0.5);
    mw_status status =
        star->has_flat ? star_with_triangles(star, job, error, star_check_triangles) : MW_OK;
    mw__job_part_end(job, outer);
    star->version = star->surface->version;
    star->shape = star->surface->shape;
    star->ready = status == MW_OK;
    return status;
}

/* Fill in everything that depends on coordinates and links. */
static mw_status star_prepare(mw_star *star, mw_job *job, mw_error *error)
{
    star->ready = false;
    star->freed_count = star->surface->freed_triangles;
    free(star->place);
    star->place = NULL;
    if (star->borrowed) return star_prepare_borrowed(star, job, error);
    mw_status status = star_with_triangles(star, job, error, star_decide);
    if (status) return status;
    star->reach = mw__star_measure_reach(star);
    if (star->angle) mw__star_fill_angles(star);
    star_finish(star);
    return MW_OK;
}

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

static void star_release_arrays(mw_star *star)
{
    free(star->facet);
    free(star->owner);
    free(star->guide);
    free(star->angle);
    free(star->curve);
    star->curve = NULL;
    star->facet = NULL;
    star->owner = star->guide = NULL;
    star->angle = NULL;
}

/* What depends on how many facets and vertices the surface has. */
static bool star_allocate(mw_star *star, bool angles)
{
    star->tri_count = star->surface->tri_count;
    star->point_count = star->surface->point_count;
    star->fuel = star_fuel(star->tri_count);
    star->near = star_near(star->tri_count);
    if (star->borrowed) return true;
    star->curve = mw__alloc(1, sizeof *star->curve);
    if (star->curve) *star->curve = mw__star_curve();
    star->facet = mw__alloc_lines(star->tri_count, sizeof *star->facet);
    star->owner = mw__alloc(star->point_count, sizeof *star->owner);
    star->guide_bits = mw__star_guide_bits(star->tri_count);
    star->guide = mw__alloc((size_t)1 << star->guide_bits, sizeof *star->guide);
    if (angles) star->angle = mw__alloc_lines(star->point_count, 2 * sizeof *star->angle);
    return star->curve && star->facet && star->owner && star->guide && (star->angle || !angles);
}

static mw_status star_check_options(const mw_star_options *options, mw_error *error)
{
    if (!mw__is_finite3(options->centre))
        return mw__fail(error, MW_ERROR_ARGUMENT, "the centre is not finite");
    if (options->unchecked && !options->borrow)
        return mw__fail(error, MW_ERROR_ARGUMENT, "'unchecked' goes with 'borrow' only");
    if (options->angles && options->borrow)
        return mw__fail(error, MW_ERROR_ARGUMENT, "a borrowed star has no angles");
    return MW_RESERVED_CHECK(mw_star_options, options, error);
}

mw_status mw_star_create(const mw_surface *surface, const mw_star_options *options, mw_star **out,
                         mw_error *error)
{
    static const mw_star_options defaults;
    if (!out) return mw__fail(error, MW_ERROR_ARGUMENT, "the pointer to the new star is NULL");
    *out = NULL;
    if (!surface) return mw__fail(error, MW_ERROR_ARGUMENT, "no surface");
    if (!options) options = &defaults;
    mw_status status = star_check_options(options, error);
    if (status) return status;
    mw_star *star = mw__calloc(1, sizeof *star);
    if (!star) return mw__fail_memory(error);
    star->surface = surface;
    star->angles = options->angles != 0;
    star->borrowed = options->borrow != 0;
    star->unchecked = options->unchecked != 0;
    memcpy(star->centre, options->centre, sizeof star->centre);
    mw_job job = mw__job(options->threads, options->progress);
    status = star_allocate(star, options->angles) ? star_prepare(star, &job, error)
                                                  : mw__fail_memory(error);
    status = mw__job_end(&job, status, error);
    if (status)
        mw_star_destroy(star);
    else
        *out = star;
    return status;
}

/* An editor may have made triangles and vertices. False when out of memory; a later call tries
 * again. */
static bool star_follow_counts(mw_star *star)
{
    const mw_surface *surface = star->surface;
    if (star->borrowed) return star_allocate(star, false);
    if (star->facet && star->tri_count == surface->tri_count &&
        star->point_count == surface->point_count)
        return true;
    star->ready = false;
    star_release_arrays(star);
    free(star->own_coincident);
    star->own_coincident = NULL;
    if (star_allocate(star, star->angles)) return true;
    star_release_arrays(star);
    return false;
}

/* Has nothing changed but places of vertices, and can all facets be decided where they stand? */
static bool star_keeps_shape(const mw_star *star)
{
    return star->ready && !star->borrowed && star->surface->shape == star->shape &&
           star->area_count == star->tri_count;
}

/* Can the facets round the vertices that moved be decided alone? */
static bool star_can_follow(const mw_star *star)
{
    return star_keeps_shape(star) && star->surface->version - star->version <= 1;
}

/* Decide all facets: where they stand if that will do, else as for a new star. */
static mw_status star_renew(mw_star *star, mw_job *job, mw_error *error)
{
    double left = 1;
    if (star_keeps_shape(star)) {
        mw_job_span outer = mw__job_part(job, 0.5);
        bool done = mw__star_follow_all(star, job);
        mw__job_part_end(job, outer);
        if (done) {
            star_finish(star);
            return MW_OK;
        }
        left = 0.5;
    }
    mw_job_span outer = mw__job_part(job, left);
    mw_status status = star_prepare(star, job, error);
    mw__job_part_end(job, outer);
    return status;
}

mw_status mw_star_update(mw_star *star, const mw_star_update_options *options, mw_error *error)
{
    static const mw_star_update_options defaults;
    if (!star) return mw__fail(error, MW_ERROR_ARGUMENT, "no star");
    if (!options) options = &defaults;
    mw_status status = MW_RESERVED_CHECK(mw_star_update_options, options, error);
    if (status) return status;
    for (size_t i = 0; options->moved && i < options->moved_count; i++)
        if (options->moved[i] >= star->surface->point_count)
            return mw__fail(error, MW_ERROR_ARGUMENT,
                            "moved vertex %" PRIu32 " is not a vertex; there are %" PRIu32,
                            options->moved[i], star->surface->point_count);
    if (!star_follow_counts(star)) return mw__fail_memory(error);
    if (options->moved && star_can_follow(star) &&
        mw__star_follow(star, options->moved, options->moved_count)) {
        star_finish(star);
        return MW_OK;
    }
    mw_job job = mw__job(options->threads, options->progress);
    return mw__job_end(&job, star_renew(star, &job, error), error);
}

void mw_star_destroy(mw_star *star)
{
    if (!star) return;
    star_release_arrays(star);
    mw__star_hubs_release(&star->hubs);
    free(star->own_coincident);
    free(star->place);
    free(star);
}

void mw_star_describe(const mw_star *star, mw_star_info *info)
{
    size_t coincident = star->own_coincident ? star->point_count * sizeof *star->own_coincident : 0;
    size_t guide = star->guide ? ((size_t)1 << star->guide_bits) * sizeof *star->guide : 0,
           curve = star->curve ? sizeof *star->curve : 0;
    size_t angles = star->angle ? star->point_count * 2 * sizeof *star->angle : 0;
    size_t facets = star->facet ? star->tri_count * sizeof *star->facet : 0,
           owners = star->owner ? star->point_count * sizeof *star->owner : 0,
           places = star->place ? star->tri_count * sizeof *star->place : 0;
    *info = (mw_star_info){
        .bytes = sizeof *star + curve + facets + owners + places + guide + angles + coincident +
                 mw__star_hubs_bytes(&star->hubs),
        .angle_bytes = angles,
        .flat_facets = star->unchecked ? 0 : star->tri_count - star->area_count - star->freed_count,
        .centre = {star->centre[0], star->centre[1], star->centre[2]},
    };
}
