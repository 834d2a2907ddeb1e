/* star_create.c - preparing a surface for rays from a centre. */
#include "mesh/place.h"
#include "star/flat.h"
#include "star/kernel.h"

#include <stdlib.h>
#include <string.h>

/* Name the first defect. */
static mw_status refuse(const mw_defects *defects, mw_error *error)
{
    char text[256];
    const mw_defect *d = &defects->list[0];
    mw_defect_describe(d, text, sizeof text);
    return mw__fail_at(error, d->triangle, d->vertex == MW_NONE ? -1 : (int64_t)d->vertex, "%s", text);
}

/* Where facets have no area, vertices may be at one place, also such as were not when the surface was made. */
static bool find_places(mw_star *star)
{
    free(star->own_place);
    star->place = star->own_place = mw__places_create(star->surface->point, star->point_count);
    return star->place != NULL;
}

static void fill_owners(mw_star *star)
{
    for (uint32_t v = 0; v < star->point_count; v++) star->owner[v] = MW_NONE;
    for (uint32_t t = 0; t < star->tri_count; t++)
        for (uint32_t k = 0; k < 3 && !mw__star_is_void(&star->tri[t]); k++) {
            uint32_t *owner = &star->owner[mw__place_of(star->place, star->tri[t].v[k])];
            uint32_t user = star->tri[t].user & MW_USER_MASK;
            if (user < *owner) *owner = user;
        }
    for (uint32_t v = 0; v < star->point_count; v++) star->owner[v] = star->owner[mw__place_of(star->place, v)];
}

/* Void facets are linked to nothing: where a walk begins in one, it begins in another. */
static void replace_voids(mw_star *star, uint32_t any)
{
    for (uint32_t t = 0; t < star->tri_count; t++) {
        const mw_triangle *facet = &star->tri[t];
        if (!mw__star_is_void(facet)) continue;
        uint32_t near = star->owner[facet->v[0]];
        if (near == MW_NONE) near = star->owner[facet->v[1]];
        star->tri[t] = star->tri[near == MW_NONE ? any : near];
    }
}

static double measure_reach(const mw_star *star)
{
    double reach = 0;
    for (uint32_t v = 0; v < star->point_count; v++)
        for (int k = 0; k < 3 && star->owner[v] != MW_NONE; k++)
            reach = fmax(reach, fabs(mw__surface_point(star->surface, v)[k] - star->centre[k]));
    return reach;
}

/* Some facet with an area. */
static uint32_t find_any(const mw_star *star)
{
    uint32_t v = 0;
    while (star->owner[v] == MW_NONE) v++;
    return star->owner[v];
}

/* Decide, and bring star->tri to what is laid out. */
static mw_status decide(mw_star *star, mw_error *error)
{
    mw_defects defects = {0};
    star->place = star->surface->place;
    memcpy(star->tri, star->surface->tri, star->tri_count * sizeof *star->tri);
    mw_status status = mw__star_kernel(star, &defects) ? MW_OK : mw__fail_memory(error);
    if (status == MW_OK && defects.count) status = refuse(&defects, error);
    mw__defects_release(&defects);
    if (status == MW_OK && star->area_count == 0)
        status = mw__fail(error, MW_ERROR_INPUT, "the polyhedron has no facet with an area");
    if (status) return status;
    if (star->area_count < star->tri_count) {
        if (!find_places(star)) return mw__fail_memory(error);
        mw__star_remove_flats(star);
    }
    fill_owners(star);
    replace_voids(star, find_any(star));
    return mw__star_lay_out(star) ? MW_OK : mw__fail_memory(error);
}

/* Fill in all that depends on coordinates and links. */
static mw_status prepare(mw_star *star, mw_error *error)
{
    static const double front[3] = {1, 0, 0};
    star->ready = false;
    star->tri = mw__alloc(star->tri_count, sizeof *star->tri);
    mw_status status = star->tri ? decide(star, error) : mw__fail_memory(error);
    free(star->tri);
    star->tri = NULL;
    if (status) return status;
    star->reach = measure_reach(star);
    star->front = mw__star_facet(star, front, 0);
    if (star->angle) mw__star_fill_angles(star);
    star->version = star->surface->version;
    star->ready = true;
    return MW_OK;
}

/* About 45 times the square root of the number of facets is far above the length of any walk on a Delaunay sphere of
 * spread points; a constant for small ones. Who needs more cycles, or nearly. */
static uint32_t fuel(uint32_t facets)
{
    return (uint32_t)(4096 + 45 * sqrt(facets));
}

static bool allocate(mw_star *star, bool angles)
{
    star->facet = mw__alloc_lines(star->tri_count, sizeof *star->facet);
    star->owner = mw__alloc(star->point_count, sizeof *star->owner);
    star->guide_bits = mw__star_guide_bits(star->tri_count);
    star->guide = mw__alloc((size_t)1 << star->guide_bits, sizeof *star->guide);
    if (angles) star->angle = mw__alloc_lines(star->point_count, 2 * sizeof *star->angle);
    return star->facet && star->owner && star->guide && (star->angle || !angles);
}

mw_status mw_star_create(const mw_surface *surface, const mw_star_options *options, mw_star **out, mw_error *error)
{
    static const mw_star_options defaults;
    if (!out) return mw__fail(error, MW_ERROR_ARGUMENT, "no place for the star");
    *out = NULL;
    if (!surface) return mw__fail(error, MW_ERROR_ARGUMENT, "no surface");
    if (!options) options = &defaults;
    if (!mw__is_finite3(options->centre)) return mw__fail(error, MW_ERROR_ARGUMENT, "the centre is not finite");
    mw_star *star = mw__calloc(1, sizeof *star);
    if (!star) return mw__fail_memory(error);
    star->surface = surface;
    star->tri_count = surface->tri_count;
    star->point_count = surface->point_count;
    star->fuel = fuel(surface->tri_count);
    memcpy(star->centre, options->centre, sizeof star->centre);
    mw_status status = allocate(star, options->angles) ? prepare(star, error) : mw__fail_memory(error);
    if (status)
        mw_star_destroy(star);
    else
        *out = star;
    return status;
}

mw_status mw_star_update(mw_star *star, mw_error *error)
{
    if (!star) return mw__fail(error, MW_ERROR_ARGUMENT, "no star");
    return prepare(star, error);
}

void mw_star_destroy(mw_star *star)
{
    if (!star) return;
    free(star->facet);
    free(star->guide);
    free(star->own_place);
    free(star->owner);
    free(star->angle);
    free(star);
}

void mw_star_describe(const mw_star *star, mw_star_info *info)
{
    size_t places = star->own_place ? star->point_count * sizeof *star->own_place : 0;
    size_t guide = ((size_t)1 << star->guide_bits) * sizeof *star->guide;
    size_t angles = star->angle ? star->point_count * 2 * sizeof *star->angle : 0;
    size_t facets = star->tri_count * sizeof *star->facet, owners = star->point_count * sizeof *star->owner;
    *info = (mw_star_info){
        .bytes = sizeof *star + facets + owners + guide + angles + places,
        .angle_bytes = angles,
        .flat_facets = star->tri_count - star->area_count,
        .centre = {star->centre[0], star->centre[1], star->centre[2]},
    };
}
