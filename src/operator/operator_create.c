/* operator_create.c - operators from locations, from entries, and from the rows of another. */
#include "base/options.h"
#include "operator/hits.h"
#include "operator/row_order.h"
#include "operator/sparse_rows.h"

#include <math.h>
#include <stdlib.h>

static const mw_operator_options defaults;

/* --- from places ------------------------------------------------------------------------------ */

/* The places and the operator that is made of them. */
typedef struct place_rows {
    const mw_placed_hits *at;
    mw_operator *o;
} place_rows;

static bool place_fits(const mw_placed_hits *at, size_t i)
{
    const uint32_t triangle = mw__hit_triangle(&at->hits, i);
    const double *weight = mw__hit_weights(&at->hits, i);
    return triangle == MW_NONE ||
           (triangle < mw__placed_triangle_count(at) && isfinite(weight[0]) &&
            isfinite(weight[1]) && isfinite(weight[2]));
}

static mw_status places_check(const mw_placed_hits *at, mw_error *error)
{
    const size_t n = at->hits.count;
    if (n >= MW_NONE)
        return mw__fail(error, MW_ERROR_LIMIT,
                        "an operator cannot have %zu rows; at most %u are possible", n,
                        MW_NONE - 1);
    for (size_t i = 0; i < n; i++) {
        const double *weight = mw__hit_weights(&at->hits, i);
        if (!place_fits(at, i))
            return mw__fail(
                error, MW_ERROR_ARGUMENT,
                "location %zu is not one of this mesh: triangle %u of %u, weights %g %g %g", i,
                mw__hit_triangle(&at->hits, i), mw__placed_triangle_count(at), weight[0], weight[1],
                weight[2]);
    }
    return MW_OK;
}

static bool places_order(const mw_placed_hits *at, mw_operator *o)
{
    uint32_t *key = mw__alloc(o->rows, sizeof *key);
    if (!key) return false;
    for (uint32_t i = 0; i < o->rows; i++) {
        const uint32_t triangle = mw__hit_triangle(&at->hits, i);
        key[i] = triangle == MW_NONE ? MW_NONE : mw__placed_slot(at, triangle);
    }
    const bool done = mw__row_order(key, o->rows, &o->row);
    free(key);
    return done;
}

/* The entries of a place; the column of a weight of 0 is one that is read anyway. */
static void place_fill(const place_rows *work, size_t rank)
{
    const size_t i = mw__operator_row(work->o, rank);
    const uint32_t triangle = mw__hit_triangle(&work->at->hits, i);
    const double *given = mw__hit_weights(&work->at->hits, i);
    uint32_t v[3] = {0}, *column = &work->o->column[3 * rank];
    double *weight = &work->o->weight[3 * rank];
    const bool there = triangle != MW_NONE;
    if (there) mw__placed_vertices(work->at, triangle, v);
    const uint32_t any = given[0] != 0 ? v[0] : given[1] != 0 ? v[1] : v[2];
    for (int k = 0; k < 3; k++) {
        weight[k] = there ? given[k] : 0;
        column[k] = weight[k] != 0 ? v[k] : any;
    }
}

static void places_fill(void *work, uint64_t from, uint64_t to)
{
    for (uint64_t rank = from; rank < to; rank++) place_fill(work, rank);
}

static void places_measure(mw_operator *o)
{
    for (size_t rank = 0; rank < o->rows; rank++) {
        const double *w = &o->weight[3 * rank];
        const uint32_t count = (uint32_t)(w[0] != 0) + (w[1] != 0) + (w[2] != 0);
        o->entries += count;
        o->empty_rows += count == 0;
        if (count > o->widest) o->widest = count;
    }
}

static mw_operator *places_pack(const mw_placed_hits *at, mw_job *job)
{
    const size_t n = at->hits.count;
    mw_operator *o = mw__calloc(1, sizeof *o);
    if (!o) return NULL;
    o->rows = (uint32_t)n;
    o->columns = mw__placed_vertex_count(at);
    o->column = mw__alloc_lines(n, 3 * sizeof *o->column);
    o->weight = mw__alloc_lines(n, 3 * sizeof *o->weight);
    mw__job_stage(job, "ordering points", 0.5);
    bool made = o->column && o->weight && places_order(at, o) && mw__job_step(job, 1, 1);
    mw__job_stage(job, "collecting weights", 0.5);
    made = made && mw__job_ranges(job, n, places_fill, &(place_rows){at, o});
    if (made) {
        places_measure(o);
        return o;
    }
    mw_operator_destroy(o);
    return NULL;
}

static mw_status places_run(const mw_placed_hits *at, const mw_operator_options *options,
                            mw_operator **out, mw_error *error)
{
    if (!options) options = &defaults;
    if ((!at->mesh && !at->surface) || (at->hits.count && (!at->hits.triangle || !at->hits.weight)))
        return mw__fail(error, MW_ERROR_ARGUMENT, "the mesh or the locations are NULL");
    mw_status status = MW_RESERVED_CHECK(mw_operator_options, options, error);
    if (!status) status = places_check(at, error);
    if (status) return status;
    mw_job job = mw__job(options->threads, options->progress);
    mw_operator *made = places_pack(at, &job);
    if (!made) status = mw__fail_memory(error);
    status = mw__job_end(&job, status, error);
    if (status)
        mw_operator_destroy(made);
    else
        *out = made;
    return status;
}

mw_status mw_operator_create(const mw_mesh *mesh, const mw_location *locations, size_t n,
                             const mw_operator_options *options, mw_operator **out, mw_error *error)
{
    if (!out) return mw__fail(error, MW_ERROR_ARGUMENT, "the pointer to the new operator is NULL");
    *out = NULL;
    mw_placed_hits at = {.mesh = mesh, .hits = {.count = n}};
    if (locations) at.hits = mw_hits_of_locations(locations, n);
    return places_run(&at, options, out, error);
}

mw_status mw_operator_create_on_surface(const mw_surface *surface, const mw_hits *hits,
                                        const mw_operator_options *options, mw_operator **out,
                                        mw_error *error)
{
    if (!out) return mw__fail(error, MW_ERROR_ARGUMENT, "the pointer to the new operator is NULL");
    *out = NULL;
    if (!hits) return mw__fail(error, MW_ERROR_ARGUMENT, "the places are NULL");
    return places_run(&(mw_placed_hits){.surface = surface, .hits = *hits}, options, out, error);
}

/* --- from entries ----------------------------------------------------------------------------- */

static mw_status entry_check(const mw_operator_entries *in, size_t i, mw_error *error)
{
    const uint32_t row = in->row[i] - in->base, column = in->column[i] - in->base;
    if (row >= in->rows || in->row[i] < in->base)
        return mw__fail(error, MW_ERROR_INPUT,
                        "entry %zu: there is no row %u; there are %u, from %u", i, in->row[i],
                        in->rows, in->base);
    if (column >= in->columns || in->column[i] < in->base)
        return mw__fail(error, MW_ERROR_INPUT,
                        "entry %zu: there is no column %u; there are %u, from %u", i, in->column[i],
                        in->columns, in->base);
    if (!isfinite(in->weight[i]))
        return mw__fail(error, MW_ERROR_INPUT, "entry %zu: the weight %g is not finite", i,
                        in->weight[i]);
    return MW_OK;
}

static mw_status entries_check(const mw_operator_entries *in, mw_error *error)
{
    if (!in || (in->count && (!in->row || !in->column || !in->weight)))
        return mw__fail(error, MW_ERROR_ARGUMENT, "the rows, the columns or the weights are NULL");
    if (in->base > 1)
        return mw__fail(error, MW_ERROR_ARGUMENT, "rows and columns begin at 0 or 1, not at %u",
                        in->base);
    if (in->rows == MW_NONE)
        return mw__fail(error, MW_ERROR_LIMIT, "an operator of %u rows; at most %u are possible",
                        in->rows, MW_NONE - 1);
    mw_status status = MW_OK;
    for (size_t i = 0; i < in->count && !status; i++) status = entry_check(in, i, error);
    return status;
}

static void entries_into_rows(const mw_operator_entries *in, mw_sparse_rows *s)
{
    for (size_t i = 0; i < in->count; i++) s->first[in->row[i] - in->base] += in->weight[i] != 0;
    mw__sparse_rows_open(s);
    for (size_t i = 0; i < in->count; i++)
        if (in->weight[i] != 0)
            mw__sparse_rows_put(s, in->row[i] - in->base, in->column[i] - in->base, in->weight[i]);
    mw__sparse_rows_full(s);
}

/* Finish a call that has filled rows or ran out of memory. */
static mw_status entries_end(mw_sparse_rows *s, bool filled, mw_job *job, mw_operator **out,
                             mw_error *error)
{
    mw_operator *made = NULL;
    if (filled) {
        mw__job_stage(job, "ordering rows", 0.5);
        made = mw__sparse_rows_pack(s, job);
    }
    mw__sparse_rows_release(s);
    mw_status status = mw__job_end(job, made ? MW_OK : mw__fail_memory(error), error);
    if (status)
        mw_operator_destroy(made);
    else
        *out = made;
    return status;
}

mw_status mw_operator_create_from_entries(const mw_operator_entries *entries,
                                          const mw_operator_options *options, mw_operator **out,
                                          mw_error *error)
{
    if (!out) return mw__fail(error, MW_ERROR_ARGUMENT, "the pointer to the new operator is NULL");
    *out = NULL;
    if (!options) options = &defaults;
    mw_status status = MW_RESERVED_CHECK(mw_operator_options, options, error);
    if (!status) status = entries_check(entries, error);
    if (status) return status;
    mw_sparse_rows rows;
    mw_job job = mw__job(options->threads, options->progress);
    mw__job_stage(&job, "sorting weights", 0.5);
    bool filled = mw__sparse_rows_init(&rows, entries->rows, entries->columns, entries->count);
    if (filled) entries_into_rows(entries, &rows);
    filled = filled && mw__job_step(&job, 1, 1);
    return entries_end(&rows, filled, &job, out, error);
}

/* --- the transpose ---------------------------------------------------------------------------- */

/* Rows of the transpose, which take the entries in the order of the given rows. */
static void transpose_fill(const mw_sparse_rows *in, mw_sparse_rows *s)
{
    for (uint64_t e = 0; e < in->first[in->rows]; e++) s->first[in->column[e]]++;
    mw__sparse_rows_open(s);
    for (uint32_t i = 0; i < in->rows; i++)
        for (uint64_t e = in->first[i]; e < in->first[i + 1]; e++)
            mw__sparse_rows_put(s, in->column[e], i, in->weight[e]);
    mw__sparse_rows_full(s);
}

mw_status mw_operator_transpose(const mw_operator *weights, const mw_operator_options *options,
                                mw_operator **out, mw_error *error)
{
    if (!out) return mw__fail(error, MW_ERROR_ARGUMENT, "the pointer to the new operator is NULL");
    *out = NULL;
    if (!options) options = &defaults;
    if (!weights) return mw__fail(error, MW_ERROR_ARGUMENT, "the operator is NULL");
    mw_status status = MW_RESERVED_CHECK(mw_operator_options, options, error);
    if (status) return status;
    mw_sparse_rows given = {0}, turned = {0};
    mw_job job = mw__job(options->threads, options->progress);
    mw__job_stage(&job, "turning weights", 0.5);
    bool filled = mw__sparse_rows_init(&given, weights->rows, weights->columns, weights->entries) &&
                  mw__sparse_rows_init(&turned, weights->columns, weights->rows, weights->entries);
    if (filled) {
        mw_operator_copy(weights, given.first, given.column, given.weight);
        transpose_fill(&given, &turned);
    }
    filled = filled && mw__job_step(&job, 1, 1);
    mw__sparse_rows_release(&given);
    return entries_end(&turned, filled, &job, out, error);
}
