/* stars.c - every triangle at a shared vertex goes to the home of that vertex, which so has all
 * triangles round it, and makes a small mesh of them. */
#include "mpi/mesh/stars.h"

#include "mpi/mesh/directory.h"
#include "mpi/mesh/records.h"

#include <meshwalk/predicates.h>
#include <stdlib.h>
#include <string.h>

/* The homes of the shared vertices of a triangle, each once. */
static int triangle_homes(const mwp_own *own, const mwp_wire *wire, const uint8_t *shared,
                          uint32_t triangle, int homes[3])
{
    int count = 0;
    for (uint32_t k = 0; k < 3; k++) {
        const uint32_t v = own->corner[3 * (size_t)triangle + k];
        if (!shared[v]) continue;
        const int home = mwp__home(wire, own->vertex[v]);
        bool known = false;
        for (int i = 0; i < count; i++) known = known || homes[i] == home;
        if (!known) homes[count++] = home;
    }
    return count;
}

static bool stars_pack(mwp_parcels *out, const mwp_own *own, const mwp_wire *wire,
                       const uint8_t *shared)
{
    int homes[3];
    uint32_t *count = calloc((size_t)wire->size, sizeof *count);
    for (uint32_t t = 0; count && t < own->triangle_count; t++)
        for (int i = triangle_homes(own, wire, shared, t, homes) - 1; i >= 0; i--)
            count[homes[i]]++;
    const bool room = count && mwp__parcels_create(out, wire, sizeof(mwp_record), count);
    free(count);
    for (uint32_t t = 0; room && t < own->triangle_count; t++)
        for (int i = triangle_homes(own, wire, shared, t, homes) - 1; i >= 0; i--)
            *(mwp_record *)mwp__parcels_add(out, homes[i]) = mwp__record_of(own, t, wire->rank);
    return room;
}

/* Defects that need no more than the triangles round one vertex: others, such as a border that
 * crosses another, may only seem so where most of the mesh is missing. */
static bool defect_is_local(const mw_defect *d)
{
    return d->kind == MW_DEFECT_NON_MANIFOLD_EDGE || d->kind == MW_DEFECT_FOLDED ||
           d->kind == MW_DEFECT_WINDING || d->kind == MW_DEFECT_REPEATED_VERTEX;
}

static mw_status stars_check(const mwp_union *stars, mwp_error *error)
{
    mw_check check;
    mw_error from;
    const mwp_names names = mwp__names_of_union(stars);
    if (mw_check_arrays(&names.arrays, &(mw_check_options){.threads = 1}, &check, &from))
        return mwp__fail_as(error, &from);
    mw_status status = MW_OK;
    for (size_t i = 0; i < check.defect_count && !status; i++)
        if (defect_is_local(&check.defects[i]))
            status = mwp__fail_defect(error, &names, &check.defects[i]);
    mw_check_release(&check);
    return status;
}

static bool record_is_flat(const mwp_record *r)
{
    return mw_orient2d(&r->point[0], &r->point[2], &r->point[4]) == 0;
}

/* The edges beyond which a triangle of another rank lies, as bits. */
static uint32_t stars_joined(const mwp_union *stars, const mw_mesh *mesh, uint32_t t)
{
    uint32_t joined = 0;
    for (unsigned k = 0; k < 3; k++) {
        const uint32_t other = mw_mesh_neighbour(mesh, t, k, NULL);
        if (other != MW_NONE && stars->record[other].rank != stars->record[t].rank &&
            !record_is_flat(&stars->record[other]))
            joined |= 1u << k;
    }
    return joined;
}

/* What the owner of a triangle is told of it. */
typedef struct join {
    uint32_t place, edges;
} join;

static bool stars_answer(const mwp_union *stars, const mw_mesh *mesh, const mwp_wire *wire,
                         mwp_parcels *answer)
{
    uint32_t *count = calloc((size_t)wire->size, sizeof *count);
    for (uint32_t t = 0; count && t < stars->triangle_count; t++)
        count[stars->record[t].rank] += stars_joined(stars, mesh, t) != 0;
    const bool room = count && mwp__parcels_create(answer, wire, sizeof(join), count);
    free(count);
    for (uint32_t t = 0; room && t < stars->triangle_count; t++) {
        const join j = {stars->record[t].place, stars_joined(stars, mesh, t)};
        if (j.edges) *(join *)mwp__parcels_add(answer, stars->record[t].rank) = j;
    }
    return room;
}

static mw_status stars_look(mwp_parcels *in, const mwp_wire *wire, mwp_parcels *answer,
                            mwp_error *error)
{
    mwp_union stars;
    mw_mesh *mesh = NULL;
    mw_error from;
    mw_status status = mwp__union_create(&stars, in->records, in->total, error);
    in->records = NULL;
    if (!status) status = stars_check(&stars, error);
    if (!status) {
        const mwp_names names = mwp__names_of_union(&stars);
        if (mw_mesh_create(&names.arrays, &(mw_mesh_options){.threads = 1}, &mesh, &from))
            status = mwp__fail_arrays(error, &names, &from);
    }
    if (!status && !stars_answer(&stars, mesh, wire, answer)) status = mwp__fail_memory(error);
    mw_mesh_destroy(mesh);
    mwp__union_release(&stars);
    return status;
}

mw_status mwp__stars_join(const mwp_own *own, const mwp_wire *wire, const uint8_t *shared,
                          uint8_t *joined, mwp_error *error)
{
    mwp_parcels out = {0}, in = {0}, answer = {0}, told = {0};
    memset(joined, 0, own->triangle_count);
    mw_status status = stars_pack(&out, own, wire, shared) ? MW_OK : mwp__fail_memory(error);
    status = mwp__wire_exchange(wire, status, &out, &in, error);
    if (!status) {
        status = stars_look(&in, wire, &answer, error);
        answer.record = sizeof(join);
        status = mwp__wire_exchange(wire, status, &answer, &told, error);
    }
    for (size_t i = 0; !status && i < told.total; i++) {
        const join *j = (const join *)told.records + i;
        joined[j->place] = (uint8_t)(joined[j->place] | j->edges);
    }
    mwp__parcels_release(&out);
    mwp__parcels_release(&in);
    mwp__parcels_release(&answer);
    mwp__parcels_release(&told);
    return status;
}
