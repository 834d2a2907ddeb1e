/* sampled_values.c - each rank finds where the values of its points come from, in a triangle or at
 * the border, and asks the ranks that have the values. */
#include "mpi/program/sampled_values.h"

#include "cli/commands/sample.h"
#include "mpi/query/owners.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* The points of this rank. */
typedef struct sampling {
    const service *service;
    const service_options *options;
    const double *points;
    size_t n;
    mw_value_table table; /* values at the vertices of this rank's piece, one for each */
    mwp_location *place;  /* where each value comes from */
    double *value;
    sample_corners *corners; /* of the places that sampling_ask was told of */
    mwp_location *asked;
} sampling;

static bool sampling_create(sampling *s)
{
    s->place = mwp__alloc(s->n, sizeof *s->place);
    s->value = mwp__alloc(s->n, sizeof *s->value);
    s->corners = mwp__alloc(s->n, sizeof *s->corners);
    s->asked = mwp__alloc(s->n, sizeof *s->asked);
    return s->place && s->value && s->corners && s->asked;
}

static void sampling_release(sampling *s)
{
    free(s->place);
    free(s->value);
    free(s->corners);
    free(s->asked);
}

/* The place of the border that is nearest to a point outside. Points that are not finite have
 * none. */
static void place_outside(const sampling *s, size_t i)
{
    mwp_nearest_border_point hit;
    const double *p = s->points + 2 * i;
    mwp_location *place = &s->place[i];
    if (mwp_nearest_border(s->service->mesh, p[0], p[1], &hit, NULL) != MW_OK) return;
    place->triangle = hit.triangle;
    place->rank = hit.rank;
    place->index = hit.index;
    memcpy(place->weight, hit.weight, sizeof place->weight);
}

static void places_find(const sampling *s, const mwp_location *at)
{
    for (size_t i = 0; i < s->n; i++) {
        s->place[i] = at[i];
        if (at[i].triangle < 0 && s->options->outside != OUTSIDE_EMPTY) place_outside(s, i);
    }
}

/* --- corners ---------------------------------------------------------------------------------- */

static mw_status corners_of_piece(void *self, const mwp_mesh *mesh, const mw_location *at, size_t n,
                                  void *answers, mwp_error *error)
{
    const mw_value_table *table = self;
    sample_corners *corners = answers;
    (void)error;
    for (size_t i = 0; i < n; i++)
        sample_corners_read(mesh->part.mesh, table->values, at[i].triangle, &corners[i]);
    return MW_OK;
}

/* Collective. Get the corners of the places for which `wanted` holds. */
static mw_status sampling_ask(sampling *s, bool (*wanted)(const sampling *, size_t i),
                              mwp_error *error)
{
    for (size_t i = 0; i < s->n; i++) {
        s->asked[i] = s->place[i];
        if (!wanted(s, i)) s->asked[i].rank = -1;
    }
    return mwp__ask_owners(s->service->mesh, MW_OK, s->asked, s->n, sizeof *s->corners,
                           corners_of_piece, &s->table, s->corners, error);
}

/* The location tells that a point is in no triangle, although its place is in one. */
static bool place_is_outside(const sampling *s, size_t i)
{
    const uint8_t where = s->place[i].where;
    return s->place[i].rank >= 0 && (where == MW_OUTSIDE || where == MW_IN_HOLE);
}

static bool place_is_missing(const sampling *s, size_t i)
{
    return s->place[i].rank >= 0 && isnan(s->value[i]);
}

/* Where the plane of the border triangle has a value, it takes the place of that at the border. */
static mw_status values_continue(sampling *s, mwp_error *error)
{
    mw_status status = sampling_ask(s, place_is_outside, error);
    for (size_t i = 0; i < s->n && !status; i++) {
        if (s->asked[i].rank < 0) continue;
        const double value = sample_plane_value(&s->corners[i], s->points + 2 * i);
        if (isfinite(value)) s->value[i] = value;
    }
    return status;
}

static mw_status values_mend(sampling *s, mwp_error *error)
{
    mw_status status = sampling_ask(s, place_is_missing, error);
    for (size_t i = 0; i < s->n && !status; i++)
        if (s->asked[i].rank >= 0)
            s->value[i] = sample_nearest_value(&s->corners[i], s->points + 2 * i);
    return status;
}

/* --- values ----------------------------------------------------------------------------------- */

static mw_status values_find(sampling *s, service_answer *answers, mwp_error *error)
{
    mw_status status =
        mwp_interpolate(s->service->mesh, &s->table, s->place, s->n, s->value, error);
    if (!status && s->options->outside == OUTSIDE_LINEAR) status = values_continue(s, error);
    for (size_t i = 0; i < s->n && !status; i++) answers[i].missing = place_is_missing(s, i);
    if (!status && s->options->missing == MISSING_NEAREST) status = values_mend(s, error);
    for (size_t i = 0; i < s->n && !status; i++) answers[i].value = s->value[i];
    return status;
}

mw_status sampled_values(const service *ranks, const double *points, size_t n,
                         const service_options *options, const mwp_location *at,
                         service_answer *answers, mwp_error *error)
{
    sampling s = {.service = ranks, .options = options, .points = points, .n = n};
    const bool values = options->more == SERVICE_VALUES;
    mw_status status = sampling_create(&s) ? MW_OK : mwp__fail_memory(error);
    if (!status && values &&
        !mwp_mesh_field(ranks->mesh, mwp_mesh_field_name(ranks->mesh, 0), &s.table))
        status = mwp__fail(error, MW_ERROR_ARGUMENT, "the mesh has no field");
    if (!status && values && s.table.stride > 1)
        status = mwp__fail(error, MW_ERROR_ARGUMENT, "the mesh has several fields");
    status = mwp__wire_agree(&ranks->wire, status, error);
    if (!status) places_find(&s, at);
    for (size_t i = 0; i < n && !status; i++) answers[i].from = s.place[i].triangle;
    if (!status && values) status = values_find(&s, answers, error);
    sampling_release(&s);
    return status;
}
