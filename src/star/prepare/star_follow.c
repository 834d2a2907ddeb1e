/* star_follow.c - brings a star up to date with its surface: where it can, by looking at what
 * changed and at nothing else (star_track.h). */
#include "star/prepare/star_follow.h"
#include "base/options.h"
#include "star/prepare/star_prepare.h"
#include "star/prepare/star_renew.h"
#include "star/prepare/star_track.h"
#include "star/star_hubs.h"
#include "topology/coincident.h"

#include <inttypes.h>
#include <stdlib.h>

/* If more than this part of the facets have moved, deciding all of them takes no longer. */
#define MOST_MOVED 4

/* --- the facets round moved vertices --- */

/* The user's numbers of facets, ascending once they are all there. */
typedef struct facet_list {
    uint32_t *item;
    uint32_t count, most;
} facet_list;

/* Add all facets round a vertex of a closed surface. Returns false if these are too many. */
static bool facets_round(const mw_star *star, uint32_t vertex, facet_list *list)
{
    if (star->owner[vertex] == MW_NONE) return true; /* of no facet */
    uint32_t place = star->track.place[star->owner[vertex]], k = 0,
             v = mw__representative(star->coincident, vertex);
    while (k < 2 && mw__representative(star->coincident, star->facet[place].v[k]) != v) k++;
    uint32_t first = mw__link(place, k), half = first;
    do {
        if (list->count == list->most) return false;
        list->item[list->count++] = star->facet[mw__link_triangle(half)].user & MW_USER_MASK;
        half = mw__star_turn(star, half);
    } while (half != first);
    return true;
}

static int facets_compare(const void *a, const void *b)
{
    uint32_t x = *(const uint32_t *)a, y = *(const uint32_t *)b;
    return (x > y) - (x < y);
}

/* Each facet once, in ascending order. */
static void facets_tidy(facet_list *list)
{
    uint32_t left = 0;
    qsort(list->item, list->count, sizeof *list->item, facets_compare);
    for (uint32_t i = 0; i < list->count; i++)
        if (i == 0 || list->item[i] != list->item[i - 1]) list->item[left++] = list->item[i];
    list->count = left;
}

/* Follow the facets round these vertices. Returns false where all must be looked at: because there
 * are many, or memory is short. */
static bool star_follow_moved(mw_star *star, const uint32_t *moved, size_t count)
{
    facet_list list = {.most = star->facet_count / MOST_MOVED};
    if (count > list.most) return false;
    list.item = mw__alloc(list.most, sizeof *list.item);
    bool done = list.item != NULL;
    for (size_t i = 0; i < count && done; i++) done = facets_round(star, moved[i], &list);
    if (done) facets_tidy(&list);
    for (uint32_t i = 0; i < list.count && done; i++) mw__star_track_renew(star, list.item[i]);
    for (uint32_t i = 0; i < list.count && done; i++) mw__star_track_link(star, list.item[i]);
    free(list.item);
    return done;
}

/* --- what can be followed --- */

/* Is what the star holds of its facets what it was before the present update? */
static bool star_is_current(const mw_star *star)
{
    return star->surface->version - star->version <= 1 && star->surface->shape == star->shape;
}

/* Follow the vertices that moved, if that can be. A star that is not star-shaped cannot turn round
 * its vertices. */
static bool star_follow_update(mw_star *star, const mw_star_update_options *options)
{
    if (!options->moved || star->borrowed || !star_is_current(star)) return false;
    if (options->moved_count == 0 && star->track.on) return true;
    if (!star->ready || mw__star_has_flats(star)) return false;
    if (!star->track.on && !mw__star_track_begin(star)) return false;
    return star_follow_moved(star, options->moved, options->moved_count);
}

/* What is tracked is up to date. Is it star-shaped? */
static bool star_conclude(mw_star *star)
{
    mw__star_take_counts(star);
    star->shape = star->surface->shape;
    star->ready = mw__star_track_is_sound(star);
    if (!star->ready) return false;
    star->area_count = star->facet_count;
    mw__star_hubs_renew(star);
    mw__star_find_front(star);
    return true;
}

/* --- the update --- */

static mw_status star_check_moved(const mw_star *star, const mw_star_update_options *options,
                                  mw_error *error)
{
    for (size_t i = 0; options->moved && i < options->moved_count; i++)
        if (options->moved[i] >= star->surface->point_count)
            return mw__fail(error, MW_ERROR_ARGUMENT,
                            "moved vertex %" PRIu32 " is not a vertex; there are %" PRIu32,
                            options->moved[i], star->surface->point_count);
    return MW_OK;
}

/* An editor may have made triangles and vertices. False when out of memory; a later call tries
 * again. */
static bool star_follow_counts(mw_star *star)
{
    const mw_surface *surface = star->surface;
    if (star->borrowed) return mw__star_allocate(star, false);
    if (star->facet && star->tri_room >= surface->tri_count &&
        star->point_room >= surface->point_count) {
        mw__star_take_counts(star);
        return true;
    }
    star->ready = false;
    mw__star_release_arrays(star);
    free(star->own_coincident);
    star->own_coincident = NULL;
    if (mw__star_allocate(star, star->angles)) return true;
    mw__star_release_arrays(star);
    return false;
}

/* Decide all facets: where they stand if that will do, else as for a new star. */
static mw_status star_decide_all(mw_star *star, mw_job *job, mw_error *error)
{
    double left = 1;
    if (mw__star_can_renew(star)) {
        mw_job_span outer = mw__job_part(job, 0.5);
        bool done = mw__star_renew(star, job);
        mw__job_part_end(job, outer);
        if (done) return MW_OK;
        left = 0.5;
    }
    mw_job_span outer = mw__job_part(job, left);
    mw_status status = mw__star_prepare(star, job, error);
    mw__job_part_end(job, outer);
    return status;
}

/* Decide all facets. What a star tracks is kept if it is `followed`: then it is right, though the
 * surface is refused. */
static mw_status star_update_all(mw_star *star, const mw_star_update_options *options,
                                 bool followed, mw_error *error)
{
    if (!star_follow_counts(star)) return mw__fail_memory(error);
    mw_job job = mw__job(options->threads, options->progress);
    if (!followed || !star->attached) mw__star_track_end(star);
    mw_status status = mw__job_end(&job, star_decide_all(star, &job, error), error);
    if (!star->attached || star->track.on) return status;
    if (status == MW_OK && !mw__star_has_flats(star)) mw__star_track_begin(star);
    if (status == MW_ERROR_INPUT && mw__star_track_anew(star)) star_conclude(star);
    return status;
}

mw_status mw_star_update(mw_star *star, const mw_star_update_options *options, mw_error *error)
{
    static const mw_star_update_options defaults;
    if (!star) return mw__fail(error, MW_ERROR_ARGUMENT, "no star");
    if (!options) options = &defaults;
    mw_status status = MW_RESERVED_CHECK(mw_star_update_options, options, error);
    if (!status) status = star_check_moved(star, options, error);
    if (status) return status;
    bool followed = star_follow_update(star, options);
    if (!followed || !star_conclude(star)) status = star_update_all(star, options, followed, error);
    if (!status || star->track.on) star->version = star->surface->version;
    return status;
}

/* --- an editor --- */

bool mw__star_attach(mw_star *star)
{
    const mw_surface *surface = star->surface;
    bool current =
             star->ready && star->version == surface->version && star->shape == surface->shape,
         done = true;
    if (!current) {
        done = star_follow_counts(star) && mw__star_track_anew(star);
        if (done) star_conclude(star);
        if (done) star->version = surface->version;
    } else if (!star->track.on && !mw__star_has_flats(star)) {
        done = mw__star_track_begin(star);
    }
    star->attached = done;
    return done;
}

void mw__star_detach(mw_star *star)
{
    star->attached = false;
    mw__star_track_end(star);
}

bool mw__star_follows(const mw_star *star, uint64_t shape)
{
    return star->track.on && star->shape == shape;
}

void mw__star_edit_end(mw_star *star)
{
    star_conclude(star);
}
