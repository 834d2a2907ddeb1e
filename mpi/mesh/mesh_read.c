/* mesh_read.c - a mesh in pieces from a file. Rank 0 reads it and cuts it into runs of triangles
 * along a Hilbert curve. */
#include "mpi/mesh/mesh.h"

#include "mpi/mesh/records.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* What rank 0 has; nothing on the others. */
typedef struct whole {
    const mw_mesh_file *file;
    mw_mesh *mesh;
    uint32_t *order; /* triangles along the curve */
    uint32_t fields; /* heights, if the file has any, and the fields */
} whole;

static mw_status whole_order(whole *w, const mw_mesh_file *file, mwp_error *error)
{
    mw_error from;
    if (!file) return mwp__fail(error, MW_ERROR_ARGUMENT, "the mesh of the file is NULL");
    const mw_arrays arrays = mw_mesh_file_arrays(file);
    w->file = file;
    w->fields = (uint32_t)file->field_count + (file->has_z != 0);
    w->order = mwp__alloc(file->triangle_count, sizeof *w->order);
    if (!w->order) return mwp__fail_memory(error);
    if (mw_mesh_create(&arrays, &(mw_mesh_options){.threads = 1}, &w->mesh, &from) ||
        mw_mesh_hilbert_order(w->mesh, w->order, NULL, &from)) {
        mwp__fail_as(error, &from);
        error->triangle = from.triangle;
        error->vertex = from.vertex;
        return from.status;
    }
    return MW_OK;
}

static void whole_release(whole *w)
{
    mw_mesh_destroy(w->mesh);
    free(w->order);
}

static double whole_value(const whole *w, uint32_t field, size_t vertex)
{
    if (!w->file->has_z) return w->file->fields[field][vertex];
    return field == 0 ? w->file->points[3 * vertex + 2] : w->file->fields[field - 1][vertex];
}

static const char *whole_field_name(const whole *w, uint32_t field)
{
    if (!w->file->has_z) return w->file->field_names[field];
    return field == 0 ? "z" : w->file->field_names[field - 1];
}

/* The first triangle of rank r along the curve. */
static size_t run_begin(const mwp_wire *wire, size_t triangles, int r)
{
    return (size_t)((uint64_t)triangles * (uint64_t)r / (uint64_t)wire->size);
}

/* --- triangles -------------------------------------------------------------------------------- */

static mwp_record whole_record(const whole *w, uint32_t t)
{
    mwp_record record = {.triangle = t};
    for (size_t k = 0; k < 3; k++) {
        const uint32_t v = w->file->triangles[3 * (size_t)t + k];
        record.vertex[k] = v;
        memcpy(&record.point[2 * k], &w->file->points[3 * (size_t)v], 2 * sizeof(double));
    }
    return record;
}

static bool triangles_pack(const whole *w, const mwp_wire *wire, mwp_parcels *out)
{
    const size_t n = w->file->triangle_count;
    uint32_t *count = calloc((size_t)wire->size, sizeof *count);
    for (int r = 0; count && r < wire->size; r++)
        count[r] = (uint32_t)(run_begin(wire, n, r + 1) - run_begin(wire, n, r));
    const bool done = count && mwp__parcels_create(out, wire, sizeof(mwp_record), count);
    for (size_t i = 0; done && i < n; i++)
        ((mwp_record *)out->records)[i] = whole_record(w, w->order[i]);
    free(count);
    return done;
}

/* --- values ----------------------------------------------------------------------------------- */

/* A vertex of rank r that was not met in its run before: `seen` has the last rank that met it. */
static bool vertex_is_new(int *seen, uint32_t v, int r)
{
    const bool fresh = seen[v] != r;
    seen[v] = r;
    return fresh;
}

static int compare_vertex_numbers(const void *left, const void *right)
{
    const uint32_t a = *(const uint32_t *)left, b = *(const uint32_t *)right;
    return a < b ? -1 : a > b;
}

/* The vertices of rank r in the order of their numbers. Returns how many. */
static uint32_t run_vertices(const whole *w, const mwp_wire *wire, int r, int *seen, uint32_t *list)
{
    const size_t n = w->file->triangle_count;
    uint32_t count = 0;
    for (size_t i = run_begin(wire, n, r); i < run_begin(wire, n, r + 1); i++)
        for (size_t k = 0; k < 3; k++) {
            const uint32_t v = w->file->triangles[3 * (size_t)w->order[i] + k];
            if (vertex_is_new(seen, v, r)) list[count++] = v;
        }
    qsort(list, count, sizeof *list, compare_vertex_numbers);
    return count;
}

static void seen_clear(int *seen, size_t n)
{
    for (size_t v = 0; v < n; v++) seen[v] = -1;
}

/* For each rank a record of all fields for each of its vertices. */
static bool values_pack(const whole *w, const mwp_wire *wire, mwp_parcels *out)
{
    const size_t points = w->file->point_count;
    int *seen = mwp__alloc(points, sizeof *seen);
    uint32_t *list = mwp__alloc(points, sizeof *list),
             *count = calloc((size_t)wire->size, sizeof *count);
    bool done = seen && list && count;
    if (done) seen_clear(seen, points);
    for (int r = 0; done && r < wire->size; r++) count[r] = run_vertices(w, wire, r, seen, list);
    done = done && mwp__parcels_create(out, wire, w->fields * sizeof(double), count);
    if (done) seen_clear(seen, points);
    for (int r = 0; done && r < wire->size; r++) {
        const uint32_t n = run_vertices(w, wire, r, seen, list);
        for (uint32_t i = 0; i < n; i++) {
            double *row = mwp__parcels_add(out, r);
            for (uint32_t f = 0; f < w->fields; f++) row[f] = whole_value(w, f, list[i]);
        }
    }
    free(seen);
    free(list);
    free(count);
    return done;
}

/* Collective: the names of the fields, from rank 0. */
static mw_status names_share(const whole *w, const mwp_wire *wire, mwp_fields *fields,
                             mwp_error *error)
{
    mwp_parcels all = {0};
    char *text = mwp__alloc(w->fields, MWP_FIELD_NAME);
    mw_status status = text ? MW_OK : mwp__fail_memory(error);
    for (uint32_t f = 0; f < w->fields && !status; f++)
        snprintf(text + f * (size_t)MWP_FIELD_NAME, MWP_FIELD_NAME, "%s", whole_field_name(w, f));
    status = mwp__wire_gather(wire, status, text, w->fields, MWP_FIELD_NAME, &all, error);
    free(text);
    if (!status) {
        fields->count = (uint32_t)all.total;
        fields->names = all.records;
        all.records = NULL;
    }
    mwp__parcels_release(&all);
    return status;
}

/* Collective: the values of this rank's vertices, a row for each. */
static mw_status values_share(const whole *w, const mwp_wire *wire, mwp_fields *fields,
                              mwp_error *error)
{
    mwp_parcels out = {0}, in = {0};
    mw_status status = names_share(w, wire, fields, error);
    if (status || fields->count == 0) return status;
    uint32_t *none = calloc((size_t)wire->size, sizeof *none);
    const bool packed =
        wire->rank == 0
            ? values_pack(w, wire, &out)
            : none && mwp__parcels_create(&out, wire, fields->count * sizeof(double), none);
    status = mwp__wire_exchange(wire, packed ? MW_OK : mwp__fail_memory(error), &out, &in, error);
    if (!status) {
        fields->rows = in.records;
        in.records = NULL;
    }
    free(none);
    mwp__parcels_release(&out);
    mwp__parcels_release(&in);
    return status;
}

/* --- the mesh --------------------------------------------------------------------------------- */

static mw_status piece_receive(const whole *w, const mwp_wire *wire, mwp_union *all,
                               mwp_error *error)
{
    mwp_parcels out = {0}, in = {0};
    uint32_t *none = calloc((size_t)wire->size, sizeof *none);
    const bool packed = wire->rank == 0
                            ? triangles_pack(w, wire, &out)
                            : none && mwp__parcels_create(&out, wire, sizeof(mwp_record), none);
    mw_status status =
        mwp__wire_exchange(wire, packed ? MW_OK : mwp__fail_memory(error), &out, &in, error);
    if (!status) {
        status = mwp__union_create(all, in.records, in.total, error);
        in.records = NULL;
        status = mwp__wire_agree(wire, status, error);
    }
    free(none);
    mwp__parcels_release(&out);
    mwp__parcels_release(&in);
    return status;
}

static mw_status mesh_of_union(MPI_Comm comm, const mwp_wire *wire, const mwp_union *all,
                               const mwp_mesh_options *options, mwp_mesh **out, mwp_error *error)
{
    int64_t *number = mwp__alloc(all->triangle_count, sizeof *number);
    mw_status status = mwp__wire_agree(wire, number ? MW_OK : mwp__fail_memory(error), error);
    for (uint32_t t = 0; t < all->triangle_count && !status; t++)
        number[t] = all->record[t].triangle;
    const mwp_piece piece = {.arrays = mwp__names_of_union(all).arrays,
                             .vertex_numbers = all->vertex,
                             .triangle_numbers = number};
    if (!status) status = mwp_mesh_create(comm, &piece, options, out, error);
    free(number);
    return status;
}

mw_status mwp_mesh_scatter(MPI_Comm comm, const mw_mesh_file *file, const mwp_mesh_options *options,
                           mwp_mesh **out, mwp_error *error)
{
    mwp_error own_error;
    mwp_wire wire;
    whole w = {0};
    mwp_union all = {0};
    mwp_fields fields = {0};
    if (!error) error = &own_error;
    if (out) *out = NULL;
    mw_status status = mwp__wire_open(&wire, comm, error);
    if (!status) {
        status = out ? MW_OK
                     : mwp__fail(error, MW_ERROR_ARGUMENT, "the pointer to the new mesh is NULL");
        if (!status && wire.rank == 0) status = whole_order(&w, file, error);
        status = mwp__wire_agree(&wire, status, error);
    }
    if (!status) status = piece_receive(&w, &wire, &all, error);
    if (!status) status = values_share(&w, &wire, &fields, error);
    whole_release(&w);
    if (!status) status = mesh_of_union(comm, &wire, &all, options, out, error);
    if (status)
        mwp__fields_release(&fields);
    else
        (*out)->fields = fields;
    mwp__union_release(&all);
    mwp__wire_close(&wire);
    return status;
}

mw_status mwp_mesh_read(MPI_Comm comm, const char *path, const mwp_mesh_options *options,
                        mwp_mesh **out, mwp_error *error)
{
    mwp_error own_error;
    mw_error from;
    mwp_wire wire;
    mw_mesh_file file = {0};
    if (!error) error = &own_error;
    if (out) *out = NULL;
    mw_status status = mwp__wire_open(&wire, comm, error);
    if (!status) {
        status =
            path || wire.rank ? MW_OK : mwp__fail(error, MW_ERROR_ARGUMENT, "the path is NULL");
        if (!status && wire.rank == 0 && mw_read_mesh(path, NULL, &file, &from))
            status = mwp__fail_as(error, &from);
        status = mwp__wire_agree(&wire, status, error);
    }
    mwp__wire_close(&wire);
    if (!status) status = mwp_mesh_scatter(comm, &file, options, out, error);
    mw_mesh_file_release(&file);
    return status;
}
