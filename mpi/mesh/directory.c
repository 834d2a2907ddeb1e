/* directory.c - each rank tells the homes of its vertices and triangles that it has them; the homes
 * compare. */
#include "mpi/mesh/directory.h"

#include <inttypes.h>
#include <stdlib.h>

/* A vertex or a triangle as its home has it. */
typedef struct entry {
    int64_t number;
    size_t place; /* in what arrived */
    int rank;     /* from which rank */
} entry;

typedef struct vertex_record {
    int64_t number;
    double point[2];
} vertex_record;

static int compare_entries(const void *left, const void *right)
{
    const entry *a = left, *b = right;
    if (a->number != b->number) return a->number < b->number ? -1 : 1;
    return a->place < b->place ? -1 : a->place > b->place;
}

/* What arrived, by number, then by rank. Every record begins with its number. */
static entry *entries_sort(const mwp_wire *wire, const mwp_parcels *in)
{
    entry *sorted = mwp__alloc(in->total, sizeof *sorted);
    size_t i = 0;
    if (!sorted) return NULL;
    for (int r = 0; r < wire->size; r++)
        for (uint32_t k = 0; k < in->count[r]; k++, i++) {
            const int64_t *number = (const void *)((const char *)in->records + i * in->record);
            sorted[i] = (entry){*number, i, r};
        }
    qsort(sorted, in->total, sizeof *sorted, compare_entries);
    return sorted;
}

static int64_t entries_distinct(const entry *sorted, size_t count)
{
    int64_t distinct = 0;
    for (size_t i = 0; i < count; i++)
        distinct += i == 0 || sorted[i].number != sorted[i - 1].number;
    return distinct;
}

/* Parcels with room for a record of every number at its home. */
static bool parcels_for_homes(mwp_parcels *out, const mwp_wire *wire, const int64_t *number,
                              size_t n, size_t record)
{
    uint32_t *count = calloc((size_t)wire->size, sizeof *count);
    for (size_t i = 0; count && i < n; i++) count[mwp__home(wire, number[i])]++;
    const bool done = count && mwp__parcels_create(out, wire, record, count);
    free(count);
    return done;
}

/* --- triangles: each is in one piece ---------------------------------------------------------- */

static mw_status triangles_compare(const mwp_wire *wire, const mwp_parcels *in, int64_t *distinct,
                                   mwp_error *error)
{
    entry *sorted = entries_sort(wire, in);
    mw_status status = sorted ? MW_OK : mwp__fail_memory(error);
    for (size_t i = 1; i < in->total && !status; i++)
        if (sorted[i].number == sorted[i - 1].number)
            status = mwp__fail_at(error, sorted[i].number, -1,
                                  "the pieces overlap: triangle %" PRId64 " is in those of ranks "
                                  "%d and %d",
                                  sorted[i].number, sorted[i - 1].rank, sorted[i].rank);
    if (!status) *distinct = entries_distinct(sorted, in->total);
    free(sorted);
    return status;
}

static mw_status directory_add_triangles(mwp_directory *d, const mwp_wire *wire, const mwp_own *own,
                                         mwp_error *error)
{
    mwp_parcels out = {0}, in = {0};
    mw_status status = MW_OK;
    if (parcels_for_homes(&out, wire, own->triangle, own->triangle_count, sizeof(int64_t)))
        for (uint32_t t = 0; t < own->triangle_count; t++)
            *(int64_t *)mwp__parcels_add(&out, mwp__home(wire, own->triangle[t])) =
                own->triangle[t];
    else
        status = mwp__fail_memory(error);
    status = mwp__wire_exchange(wire, status, &out, &in, error);
    if (!status)
        status = mwp__wire_agree(wire, triangles_compare(wire, &in, &d->triangles, error), error);
    mwp__parcels_release(&out);
    mwp__parcels_release(&in);
    return status;
}

/* --- vertices: at one place for all who have them --------------------------------------------- */

/* Equal numbers, or both are none: an unused vertex may have any coordinates. */
static bool coordinates_agree(double a, double b)
{
    return a == b || (a != a && b != b);
}

static mw_status vertices_compare(const mwp_parcels *in, const entry *sorted, size_t i,
                                  mwp_error *error)
{
    const vertex_record *all = in->records, *a = &all[sorted[i - 1].place],
                        *b = &all[sorted[i].place];
    if (coordinates_agree(a->point[0], b->point[0]) && coordinates_agree(a->point[1], b->point[1]))
        return MW_OK;
    return mwp__fail_at(error, -1, b->number,
                        "vertex %" PRId64 " has the coordinates %.17g, %.17g on rank %d, but "
                        "%.17g, %.17g on rank %d",
                        b->number, a->point[0], a->point[1], sorted[i - 1].rank, b->point[0],
                        b->point[1], sorted[i].rank);
}

/* Which vertices do several ranks have? The answer to each record is one byte. */
static mw_status vertices_share(const mwp_wire *wire, const mwp_parcels *in, mwp_parcels *answer,
                                int64_t *distinct, mwp_error *error)
{
    entry *sorted = entries_sort(wire, in);
    mw_status status = sorted && mwp__parcels_create(answer, wire, sizeof(uint8_t), in->count)
                           ? MW_OK
                           : mwp__fail_memory(error);
    uint8_t *shared = answer->records;
    for (size_t i = 0; i < in->total && !status; i++) shared[i] = 0;
    for (size_t i = 1; i < in->total && !status; i++) {
        if (sorted[i].number != sorted[i - 1].number) continue;
        shared[sorted[i].place] = shared[sorted[i - 1].place] = 1;
        status = vertices_compare(in, sorted, i, error);
    }
    if (!status) *distinct = entries_distinct(sorted, in->total);
    free(sorted);
    return status;
}

static bool vertices_pack(mwp_parcels *out, const mwp_wire *wire, const mwp_own *own)
{
    if (!parcels_for_homes(out, wire, own->vertex, own->vertex_count, sizeof(vertex_record)))
        return false;
    for (size_t v = 0; v < own->vertex_count; v++)
        *(vertex_record *)mwp__parcels_add(out, mwp__home(wire, own->vertex[v])) =
            (vertex_record){own->vertex[v], {own->points[2 * v], own->points[2 * v + 1]}};
    return true;
}

/* The answers come in the order of the records, those of each home for itself. */
static void vertices_read(uint8_t *shared, const mwp_wire *wire, const mwp_own *own,
                          const mwp_parcels *answer, size_t *next)
{
    const uint8_t *byte = answer->records;
    size_t place = 0;
    for (int r = 0; r < wire->size; r++) {
        next[r] = place;
        place += answer->count[r];
    }
    for (uint32_t v = 0; v < own->vertex_count; v++)
        shared[v] = byte[next[mwp__home(wire, own->vertex[v])]++];
}

static mw_status directory_add_vertices(mwp_directory *d, const mwp_wire *wire, const mwp_own *own,
                                        mwp_error *error)
{
    mwp_parcels out = {0}, in = {0}, answer = {0}, told = {0};
    d->shared = mwp__alloc(own->vertex_count, sizeof *d->shared);
    mw_status status =
        d->shared && vertices_pack(&out, wire, own) ? MW_OK : mwp__fail_memory(error);
    status = mwp__wire_exchange(wire, status, &out, &in, error);
    if (!status) {
        status = vertices_share(wire, &in, &answer, &d->vertices, error);
        status = mwp__wire_exchange(wire, status, &answer, &told, error);
    }
    if (!status) vertices_read(d->shared, wire, own, &told, out.next);
    mwp__parcels_release(&out);
    mwp__parcels_release(&in);
    mwp__parcels_release(&answer);
    mwp__parcels_release(&told);
    return status;
}

mw_status mwp__directory_create(mwp_directory *directory, const mwp_wire *wire, const mwp_own *own,
                                mwp_error *error)
{
    *directory = (mwp_directory){0};
    mw_status status = directory_add_triangles(directory, wire, own, error);
    if (!status) status = directory_add_vertices(directory, wire, own, error);
    if (!status) status = mwp__wire_sum(wire, &directory->vertices, error);
    return status ? status : mwp__wire_sum(wire, &directory->triangles, error);
}

void mwp__directory_release(mwp_directory *directory)
{
    free(directory->shared);
    *directory = (mwp_directory){0};
}
