/* rim.c - finds the rim, gathers it, and looks for overlaps and holes in it. */
#include "mpi/mesh/rim.h"

#include <stdlib.h>

/* --- the outline of this rank ----------------------------------------------------------------- */

/* The edges of an own triangle that are of the outline, as bits. */
static uint32_t outline_of(const mwp_part *part, uint32_t t)
{
    uint32_t edges = 0;
    if (mwp__own_is_flat(&part->own, t)) return 0;
    for (unsigned k = 0; k < 3; k++) {
        const uint32_t other = mw_mesh_neighbour(part->mesh, t, k, NULL);
        const bool alone =
            other == MW_NONE ? !(part->joined[t] >> k & 1) : mwp__own_is_flat(&part->own, other);
        edges |= (uint32_t)alone << k;
    }
    return edges;
}

/* --- places: where the outline has ends ------------------------------------------------------- */

typedef struct place {
    double at[2];
} place;

static int compare_places(const void *left, const void *right)
{
    const place *a = left, *b = right;
    if (a->at[0] != b->at[0]) return a->at[0] < b->at[0] ? -1 : 1;
    return a->at[1] < b->at[1] ? -1 : a->at[1] > b->at[1];
}

static size_t places_drop_copies(place *at, size_t count)
{
    size_t kept = 0;
    qsort(at, count, sizeof *at, compare_places);
    for (size_t i = 0; i < count; i++)
        if (kept == 0 || compare_places(&at[i], &at[kept - 1]) != 0) at[kept++] = at[i];
    return kept;
}

/* Is corner k of triangle t an end of the outline, or of a triangle without area? */
static bool corner_is_end(const mwp_part *part, uint32_t t, uint32_t outline, uint32_t k)
{
    const uint32_t before = (k + 2) % 3;
    return (outline >> k & 1) || (outline >> before & 1) || mwp__own_is_flat(&part->own, t);
}

/* The places of this rank, each once; NULL when out of memory. */
static place *places_find(const mwp_part *part, size_t *count)
{
    const mwp_own *own = &part->own;
    uint8_t *end = calloc(own->vertices ? own->vertices : 1, sizeof *end);
    place *at = NULL;
    *count = 0;
    for (uint32_t t = 0; end && t < own->triangle_count; t++) {
        const uint32_t outline = outline_of(part, t);
        for (uint32_t k = 0; k < 3; k++)
            if (corner_is_end(part, t, outline, k)) {
                uint8_t *mark = &end[own->corner[3 * (size_t)t + k]];
                *count += !*mark;
                *mark = 1;
            }
    }
    if (end) at = mwp__alloc(*count, sizeof *at);
    *count = 0;
    for (size_t v = 0; at && v < own->vertices; v++)
        if (end[v]) at[(*count)++] = (place){{own->points[2 * v], own->points[2 * v + 1]}};
    free(end);
    if (at) *count = places_drop_copies(at, *count);
    return at;
}

/* Each place for the ranks in whose boxes it lies. */
static bool places_pack(mwp_parcels *out, const mwp_wire *wire, const mwp_router *router,
                        const place *at, size_t n)
{
    int *ranks = mwp__alloc((size_t)wire->size, sizeof *ranks);
    uint32_t *count = calloc((size_t)wire->size, sizeof *count);
    const bool room = ranks && count;
    for (size_t i = 0; room && i < n; i++)
        for (int r = mwp__router_find(router, at[i].at, ranks) - 1; r >= 0; r--) count[ranks[r]]++;
    const bool done = room && mwp__parcels_create(out, wire, sizeof *at, count);
    for (size_t i = 0; done && i < n; i++)
        for (int r = mwp__router_find(router, at[i].at, ranks) - 1; r >= 0; r--)
            *(place *)mwp__parcels_add(out, ranks[r]) = at[i];
    free(ranks);
    free(count);
    return done;
}

/* --- the triangles of this rank at places ----------------------------------------------------- */

/* Mark the own triangles that have a place inside or on an edge. */
static mw_status rim_mark_located(const mwp_part *part, const place *at, size_t n, uint8_t *mark,
                                  mwp_error *error)
{
    mw_error from;
    const mw_query_options options = {.threads = part->threads};
    if (!part->locator) return MW_OK;
    mw_location *found = mwp__alloc(n, sizeof *found);
    if (!found) return mwp__fail_memory(error);
    mw_status status = MW_OK;
    if (mw_locate_batch(part->locator, at->at, n, 2, &options, found, NULL, &from))
        status = mwp__fail_as(error, &from);
    for (size_t i = 0; i < n && !status; i++) {
        const uint32_t t = found[i].triangle;
        if (t == MW_NONE) continue;
        mark[t] = 1;
        const uint32_t beyond = found[i].where == MW_ON_EDGE
                                    ? mw_mesh_neighbour(part->mesh, t, found[i].local, NULL)
                                    : MW_NONE;
        if (beyond != MW_NONE) mark[beyond] = 1;
    }
    free(found);
    return status;
}

/* Mark the own triangles that have a corner at a place; places are sorted. */
static bool rim_mark_corners(const mwp_part *part, const place *at, size_t n, uint8_t *mark)
{
    const mwp_own *own = &part->own;
    uint8_t *hit = mwp__alloc(own->vertices, sizeof *hit);
    for (size_t v = 0; hit && v < own->vertices; v++) {
        const place here = {{own->points[2 * v], own->points[2 * v + 1]}};
        hit[v] = bsearch(&here, at, n, sizeof here, compare_places) != NULL;
    }
    for (uint32_t t = 0; hit && t < own->triangle_count; t++)
        for (uint32_t k = 0; k < 3; k++)
            if (hit[own->corner[3 * (size_t)t + k]]) mark[t] = 1;
    free(hit);
    return hit;
}

static mw_status rim_mark(const mwp_part *part, mwp_parcels *in, uint8_t *mark, mwp_error *error)
{
    place *at = in->records;
    const size_t n = places_drop_copies(at, in->total);
    for (uint32_t t = 0; t < part->own.triangles; t++) mark[t] = mwp__own_is_flat(&part->own, t);
    mw_status status = rim_mark_located(part, at, n, mark, error);
    if (!status && !rim_mark_corners(part, at, n, mark)) status = mwp__fail_memory(error);
    return status;
}

/* The records of this rank's part of the rim; NULL when out of memory. */
static mwp_record *rim_pack(const mwp_part *part, const mwp_wire *wire, const uint8_t *mark,
                            size_t *count)
{
    const mwp_own *own = &part->own;
    *count = 0;
    for (uint32_t t = 0; t < own->triangle_count; t++) *count += mark[t];
    mwp_record *mine = mwp__alloc(*count, sizeof *mine);
    *count = 0;
    for (uint32_t t = 0; mine && t < own->triangle_count; t++) {
        if (!mark[t]) continue;
        mine[*count] = mwp__record_of(own, t, wire->rank);
        mine[(*count)++].outline = outline_of(part, t);
    }
    return mine;
}

/* Collective: all triangles of the rim. */
static mw_status rim_gather(const mwp_wire *wire, const mwp_part *part, const mwp_router *router,
                            mwp_parcels *all, mwp_error *error)
{
    size_t count = 0;
    mwp_parcels out = {0}, in = {0};
    mwp_record *mine = NULL;
    place *at = places_find(part, &count);
    mw_status status =
        at && places_pack(&out, wire, router, at, count) ? MW_OK : mwp__fail_memory(error);
    out.record = sizeof *at;
    status = mwp__wire_exchange(wire, status, &out, &in, error);
    if (!status) {
        uint8_t *mark = mwp__alloc(part->own.triangles, sizeof *mark);
        status = mark ? rim_mark(part, &in, mark, error) : mwp__fail_memory(error);
        if (!status && !(mine = rim_pack(part, wire, mark, &count)))
            status = mwp__fail_memory(error);
        status = mwp__wire_gather(wire, status, mine, count, sizeof *mine, all, error);
        free(mark);
    }
    free(mine);
    free(at);
    mwp__parcels_release(&out);
    mwp__parcels_release(&in);
    return status;
}

/* --- the rim as a mesh ------------------------------------------------------------------------ */

static mw_status rim_make_locator(mwp_rim *rim, uint32_t threads, mwp_error *error)
{
    mw_error from;
    const mwp_names names = mwp__names_of_union(&rim->all);
    const mw_mesh_options mesh = {.threads = threads};
    const mw_locator_options locator = {.border = 1, .fill = MW_FILL_YES, .threads = threads};
    if (mw_mesh_create(&names.arrays, &mesh, &rim->mesh, &from) ||
        mw_locator_create(rim->mesh, &locator, &rim->locator, &from))
        return mwp__fail_arrays(error, &names, &from);
    return MW_OK;
}

/* Tell the holes from the voids. */
static mw_status rim_number_holes(mwp_rim *rim, mwp_error *error)
{
    mw_error from;
    mw_locator_info info;
    mw_locator_describe(rim->locator, &info);
    mw_hole_edge *edge = mwp__alloc(info.holes, sizeof *edge);
    rim->hole = mwp__alloc(info.holes, sizeof *rim->hole);
    mw_status status = edge && rim->hole ? MW_OK : mwp__fail_memory(error);
    if (!status && mw_locator_holes(rim->locator, edge, &from)) status = mwp__fail_as(error, &from);
    for (uint32_t h = 0; h < info.holes && !status; h++) {
        const bool real = rim->all.record[edge[h].triangle].outline >> edge[h].edge & 1;
        rim->hole[h] = real ? rim->holes++ : MW_NONE;
    }
    free(edge);
    return status;
}

mw_status mwp__rim_create(mwp_rim *rim, const mwp_wire *wire, const mwp_part *part,
                          const mwp_router *router, mwp_error *error)
{
    mwp_parcels all = {0};
    *rim = (mwp_rim){0};
    mw_status status = rim_gather(wire, part, router, &all, error);
    if (status) {
        mwp__parcels_release(&all);
        return status;
    }
    status = mwp__union_create(&rim->all, all.records, all.total, error);
    all.records = NULL;
    if (!status) status = rim_make_locator(rim, part->threads, error);
    if (!status) status = rim_number_holes(rim, error);
    mwp__parcels_release(&all);
    return mwp__wire_agree(wire, status, error);
}

void mwp__rim_release(mwp_rim *rim)
{
    mw_locator_destroy(rim->locator);
    mw_mesh_destroy(rim->mesh);
    mwp__union_release(&rim->all);
    free(rim->hole);
    *rim = (mwp_rim){0};
}

size_t mwp__rim_bytes(const mwp_rim *rim)
{
    mw_locator_info info;
    mw_locator_describe(rim->locator, &info);
    return rim->all.triangle_count * (sizeof *rim->all.record + 3 * sizeof *rim->all.corner) +
           rim->all.vertex_count * (2 * sizeof *rim->all.points + sizeof *rim->all.vertex) +
           mw_mesh_bytes(rim->mesh) + info.bytes;
}
