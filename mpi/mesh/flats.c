/* flats.c - gathers all triangles without area, and adds to a piece those that it needs. */
#include "mpi/mesh/flats.h"

#include "mpi/mesh/records.h"

#include <stdlib.h>
#include <string.h>

/* A corner of a flat triangle, by its place: vertices with different numbers may lie at one. */
typedef struct flat_corner {
    double at[2];
    uint32_t flat;
} flat_corner;

static int compare_places(const void *left, const void *right)
{
    const flat_corner *a = left, *b = right;
    if (a->at[0] != b->at[0]) return a->at[0] < b->at[0] ? -1 : 1;
    return a->at[1] < b->at[1] ? -1 : a->at[1] > b->at[1];
}

/* All flat triangles of the mesh, joined to groups by common places. */
typedef struct flat_set {
    const mwp_record *flat;
    uint32_t count;
    flat_corner *corner; /* three each, sorted */
    uint32_t *leader;    /* of the group, by union-find */
    bool *wanted;        /* per leader: the group hangs together with the piece */
} flat_set;

static uint32_t flat_leader(const flat_set *s, uint32_t f)
{
    while (s->leader[f] != f) f = s->leader[f] = s->leader[s->leader[f]];
    return f;
}

static bool flats_group(flat_set *s)
{
    const size_t corners = 3 * (size_t)s->count;
    s->corner = mwp__alloc(corners, sizeof *s->corner);
    s->leader = mwp__alloc(s->count, sizeof *s->leader);
    s->wanted = calloc(s->count ? s->count : 1, sizeof *s->wanted);
    if (!s->corner || !s->leader || !s->wanted) return false;
    for (uint32_t f = 0; f < s->count; f++) s->leader[f] = f;
    for (size_t i = 0; i < corners; i++) {
        const double *p = &s->flat[i / 3].point[2 * (i % 3)];
        s->corner[i] = (flat_corner){{p[0], p[1]}, (uint32_t)(i / 3)};
    }
    qsort(s->corner, corners, sizeof *s->corner, compare_places);
    for (size_t i = 1; i < corners; i++)
        if (compare_places(&s->corner[i - 1], &s->corner[i]) == 0)
            s->leader[flat_leader(s, s->corner[i].flat)] = flat_leader(s, s->corner[i - 1].flat);
    return true;
}

/* Mark the groups that have a place of the piece. */
static void flats_want(flat_set *s, const mwp_own *own)
{
    for (size_t v = 0; v < own->vertex_count; v++) {
        const flat_corner here = {.at = {own->points[2 * v], own->points[2 * v + 1]}};
        const flat_corner *found =
            bsearch(&here, s->corner, 3 * (size_t)s->count, sizeof here, compare_places);
        if (found) s->wanted[flat_leader(s, found->flat)] = true;
    }
}

static bool flat_is_added(const flat_set *s, uint32_t f, int rank)
{
    return s->flat[f].rank != rank && s->wanted[flat_leader(s, f)];
}

/* --- vertices --------------------------------------------------------------------------------- */

typedef struct numbered_vertex {
    int64_t number;
    uint32_t place; /* in mwp_own */
} numbered_vertex;

static int compare_vertices(const void *left, const void *right)
{
    const numbered_vertex *a = left, *b = right;
    return a->number < b->number ? -1 : a->number > b->number;
}

/* The vertex with this number; if the piece lacks it, it is added. `known` has room for it. */
static uint32_t own_vertex(mwp_own *own, numbered_vertex *known, uint32_t *added, int64_t number,
                           const double *point)
{
    const numbered_vertex key = {.number = number};
    const numbered_vertex *found =
        bsearch(&key, known, own->vertex_count, sizeof key, compare_vertices);
    numbered_vertex *more = known + own->vertex_count;
    for (uint32_t i = 0; !found && i < *added; i++)
        if (more[i].number == number) found = &more[i];
    if (found) return found->place;
    const uint32_t v = own->vertices++;
    own->vertex[v] = number;
    memcpy(&own->points[2 * (size_t)v], point, 2 * sizeof *point);
    more[(*added)++] = (numbered_vertex){number, v};
    return v;
}

static bool flats_append(const flat_set *s, mwp_own *own, int rank)
{
    size_t count = 0;
    uint32_t added = 0;
    for (uint32_t f = 0; f < s->count; f++) count += flat_is_added(s, f, rank);
    if (count == 0) return true;
    numbered_vertex *known = mwp__alloc(own->vertex_count + 3 * count, sizeof *known);
    const bool room = known && mwp__own_grow(own, 3 * count, count);
    for (uint32_t v = 0; room && v < own->vertex_count; v++)
        known[v] = (numbered_vertex){own->vertex[v], v};
    if (room) qsort(known, own->vertex_count, sizeof *known, compare_vertices);
    for (uint32_t f = 0; room && f < s->count; f++) {
        if (!flat_is_added(s, f, rank)) continue;
        const uint32_t t = own->triangles++;
        own->triangle[t] = s->flat[f].triangle;
        for (uint32_t k = 0; k < 3; k++)
            own->corner[3 * (size_t)t + k] = own_vertex(own, known, &added, s->flat[f].vertex[k],
                                                        &s->flat[f].point[2 * (size_t)k]);
    }
    free(known);
    return room;
}

static mw_status flats_take(mwp_own *own, const mwp_wire *wire, const mwp_parcels *all,
                            mwp_error *error)
{
    flat_set set = {.flat = all->records, .count = (uint32_t)all->total};
    bool done = flats_group(&set);
    if (done) {
        flats_want(&set, own);
        done = flats_append(&set, own, wire->rank);
    }
    free(set.corner);
    free(set.leader);
    free(set.wanted);
    return done ? MW_OK : mwp__fail_memory(error);
}

mw_status mwp__flats_add(mwp_own *own, const mwp_wire *wire, mwp_error *error)
{
    int64_t total = 0;
    uint32_t mine = 0;
    mwp_parcels all = {0};
    for (uint32_t t = 0; t < own->triangle_count; t++) mine += mwp__own_is_flat(own, t);
    total = mine;
    mw_status status = mwp__wire_sum(wire, &total, error);
    if (status || total == 0) return status;
    mwp_record *flat = mwp__alloc(mine, sizeof *flat);
    if (flat) {
        mine = 0;
        for (uint32_t t = 0; t < own->triangle_count; t++)
            if (mwp__own_is_flat(own, t)) flat[mine++] = mwp__record_of(own, t, wire->rank);
    } else {
        status = mwp__fail_memory(error);
    }
    status = mwp__wire_gather(wire, status, flat, mine, sizeof *flat, &all, error);
    if (!status) status = flats_take(own, wire, &all, error);
    status = mwp__wire_agree(wire, status, error);
    free(flat);
    mwp__parcels_release(&all);
    return status;
}
