/* values.c - values and weights at locations, from the ranks that have the triangles. */
#include "mpi/query/owners.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* --- interpolation ---------------------------------------------------------------------------- */

static mw_status interpolate_answer(void *self, const mwp_mesh *mesh, const mw_location *at,
                                    size_t n, void *answers, mwp_error *error)
{
    mw_error from;
    const mw_interpolate_options options = {.threads = mesh->part.threads};
    return mw_interpolate_table(mesh->part.mesh, self, at, n, &options, answers, &from)
               ? mwp__fail_as(error, &from)
               : MW_OK;
}

static mw_status table_check(const mwp_mesh *mesh, const mw_value_table *table, size_t n,
                             const void *result, mwp_error *error)
{
    if (!table || (mesh->part.own.vertex_count && !table->values) || (n && !result))
        return mwp__fail(error, MW_ERROR_ARGUMENT, "the values or the results are NULL");
    if ((unsigned)table->type > MW_FLOAT32 || table->count == 0 || table->count > 1 << 20)
        return mwp__fail(error, MW_ERROR_ARGUMENT,
                         "a vertex has %zu values; 1 to 2^20 doubles or floats are possible",
                         table->count);
    if (table->step > 1)
        return mwp__fail(error, MW_ERROR_ARGUMENT, "the values of a vertex are not side by side");
    if (table->stride && table->stride < table->count)
        return mwp__fail(error, MW_ERROR_ARGUMENT,
                         "the stride %zu is less than the %zu values of a vertex", table->stride,
                         table->count);
    return MW_OK;
}

static void results_clear(const mw_value_table *table, const mwp_location *at, size_t n,
                          void *result)
{
    for (size_t i = 0; i < n; i++)
        for (size_t k = 0; k < table->count && at[i].rank < 0; k++)
            if (table->type == MW_FLOAT64)
                ((double *)result)[i * table->count + k] = NAN;
            else
                ((float *)result)[i * table->count + k] = NAN;
}

mw_status mwp_interpolate(mwp_mesh *mesh, const mw_value_table *table,
                          const mwp_location *locations, size_t n, void *result, mwp_error *error)
{
    mwp_error own_error = {0};
    if (!error) error = &own_error;
    mw_status status = table_check(mesh, table, n, result, error);
    const size_t bytes =
        status ? 0 : table->count * (table->type == MW_FLOAT64 ? sizeof(double) : sizeof(float));
    status = mwp__wire_same(&mesh->wire, status, (int64_t)bytes, "the bytes of a row", error);
    if (status) return status;
    mw_value_table values = *table; /* read only */
    status = mwp__ask_owners(mesh, MW_OK, locations, n, bytes, interpolate_answer, &values, result,
                             error);
    if (!status) results_clear(table, locations, n, result);
    return status;
}

/* --- operators -------------------------------------------------------------------------------- */

static mw_status corners_answer(void *self, const mwp_mesh *mesh, const mw_location *at, size_t n,
                                void *answers, mwp_error *error)
{
    int64_t *corner = answers;
    (void)self;
    (void)error;
    for (size_t i = 0; i < n; i++)
        for (uint32_t k = 0; k < 3; k++)
            corner[3 * i + k] = mwp__own_number(&mesh->part.own, at[i].triangle, k);
    return MW_OK;
}

mw_status mwp_operator(mwp_mesh *mesh, const mwp_location *locations, size_t n, uint64_t *first,
                       int64_t *column, double *weight, mwp_error *error)
{
    mwp_error own_error = {0};
    if (!error) error = &own_error;
    int64_t *corner = mwp__alloc(n, 3 * sizeof *corner);
    mw_status status = corner ? MW_OK : mwp__fail_memory(error);
    if (!status && (!first || (n && (!column || !weight))))
        status = mwp__fail(error, MW_ERROR_ARGUMENT, "the arrays of the operator are NULL");
    status = mwp__ask_owners(mesh, status, locations, n, 3 * sizeof *corner, corners_answer, NULL,
                             corner, error);
    if (!status) first[0] = 0;
    for (size_t i = 0; i < n && !status; i++) {
        first[i + 1] = first[i];
        for (size_t k = 0; k < 3 && locations[i].rank >= 0; k++) {
            if (locations[i].weight[k] == 0) continue;
            column[first[i + 1]] = corner[3 * i + k];
            weight[first[i + 1]++] = locations[i].weight[k];
        }
    }
    free(corner);
    return status;
}
