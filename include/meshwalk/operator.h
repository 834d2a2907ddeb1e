/**
 * @file operator.h
 * Weights kept as a sparse matrix, for interpolation at the same points again and again.
 *
 * An operator has a row for each point and a column for each vertex. Create it once, from locations
 * or from the entries of a file of weights, and apply it to any number of fields:
 *
 *     mw_locate_batch(locator, points, n, 2, NULL, locations, NULL, &error);
 *     mw_operator_create(mesh, locations, n, NULL, &weights, &error);
 *     for (each step) mw_operator_apply(weights, &table, NULL, result, &error);
 *
 * An operator can also be made from answers of queries in space: rays from the centre of a star,
 * probes, nearest points.
 *
 *     mw_hits hits = mw_hits_of_touches(touches, n);
 *     mw_operator_create_on_surface(surface, &hits, NULL, &weights, &error);
 *
 * The results are those of mw_interpolate_table(), bit for bit. An operator takes 40 bytes a point
 * and does not refer to the mesh. It orders its rows so that consecutive rows read nearby values.
 * Where points or vertices are scattered, many fields stored one after another need 76 bytes more
 * for each point and 68 for each vertex, which the operator keeps (mw_operator_apply()).
 */
#ifndef MESHWALK_OPERATOR_H
#define MESHWALK_OPERATOR_H

#include <meshwalk/locate.h>
#include <meshwalk/probe.h>

#ifdef __cplusplus
extern "C" {
#endif

/** Rows of weights. Opaque; any number of threads may apply one operator. */
typedef struct mw_operator mw_operator;

/** Options for creating an operator. Zero-initialised options select the defaults. */
typedef struct mw_operator_options {
    uint32_t threads;            /**< number of threads; 0: one per processor */
    const mw_progress *progress; /**< progress and cancelling, see base.h; NULL: none */
    uint32_t reserved[5];        /**< must be zero */
} mw_operator_options;

/**
 * Create the operator that interpolates values at the vertices of a mesh linearly at points.
 *
 * @param mesh       the mesh in which the points were located; read during the call only
 * @param locations  n locations: row i is the point of location i. A location without a triangle
 *                   gives a row without entries. Weights of 0 are left out, so a location on an
 *                   edge gives two entries and one on a vertex one
 * @param n          number of locations
 * @param options    NULL selects the defaults
 * @param out        receives the operator, owned by the caller (mw_operator_destroy()); NULL on
 *                   failure
 * @param error      NULL, or receives the message of a failure
 * @return MW_OK; MW_ERROR_ARGUMENT for NULL, or a location whose triangle is not in the mesh or
 *         whose weights are not finite; MW_ERROR_LIMIT for 2^32 - 1 locations or more;
 *         MW_ERROR_MEMORY, MW_CANCELLED.
 *
 * Thread-safe. O(n).
 */
MW_API mw_status mw_operator_create(const mw_mesh *mesh, const mw_location *locations, size_t n,
                                    const mw_operator_options *options, mw_operator **out,
                                    mw_error *error);

/** Places in triangles of a surface: the triangle and the weights in records of any type. */
typedef struct mw_hits {
    const uint32_t *triangle; /**< of the first record; MW_NONE: it is in no triangle */
    const double *weight;     /**< the three weights of the first record */
    size_t stride;            /**< bytes from one record to the next, for both */
    size_t count;             /**< number of records */
} mw_hits;

/** View n locations, as of mw_star_locate_batch(), as places. They stay the caller's. Thread-safe.
 * O(1). */
MW_API mw_hits mw_hits_of_locations(const mw_location *locations, size_t n);
/** View n touches, as of mw_probe_batch(), as places. They stay the caller's. Thread-safe. O(1). */
MW_API mw_hits mw_hits_of_touches(const mw_touch *touches, size_t n);
/** View n nearest points, as of mw_nearest_on_surface_batch(), as places. They stay the caller's.
 * Thread-safe. O(1). */
MW_API mw_hits mw_hits_of_nearest(const mw_nearest_surface_point *points, size_t n);

/**
 * Create the operator that interpolates values at the vertices of a surface linearly at places in
 * its triangles.
 *
 * On a star the place is where the ray meets the flat facet.
 *
 * @param surface  the surface in which the places were found; read during the call only
 * @param hits     the places: row i is record i. As for mw_operator_create(), records without a
 *                 triangle give rows without entries, and weights of 0 are left out
 * @param options  NULL selects the defaults
 * @param out      receives the operator, owned by the caller (mw_operator_destroy()); NULL on
 *                 failure
 * @param error    NULL, or receives the message of a failure
 * @return as mw_operator_create().
 *
 * Thread-safe; not during an update of the surface. O(n).
 */
MW_API mw_status mw_operator_create_on_surface(const mw_surface *surface, const mw_hits *hits,
                                               const mw_operator_options *options,
                                               mw_operator **out, mw_error *error);

/**
 * Interpolate values at the vertices of a surface linearly: result[i] is the sum of weight[k] *
 * values[vertex k] over the weights that are not 0.
 *
 * For many fields, or to leave out missing values, use an operator: its results are the same.
 *
 * @param surface  the surface in which the places were found
 * @param values   one value per vertex
 * @param hits     the places
 * @param result   receives hits->count values: exact at vertices; NaN for a record without a
 *                 triangle
 *
 * Thread-safe; not during an update of the surface. O(n), without allocation.
 */
MW_API void mw_surface_interpolate(const mw_surface *surface, const double *values,
                                   const mw_hits *hits, double *result);

/** The entries of a sparse matrix in any order, as ESMF's files of weights have them. */
typedef struct mw_operator_entries {
    const uint32_t *row;    /**< `count` numbers of rows, from `base` */
    const uint32_t *column; /**< `count` numbers of columns, from `base` */
    const double *weight;   /**< `count` weights; entries with the weight 0 are left out */
    size_t count;
    uint32_t rows, columns; /**< size of the matrix */
    uint32_t base;          /**< number of the first row and column: 0 or 1 */
} mw_operator_entries;

/**
 * Create an operator from entries. A row may have any number of them; entries with the same row and
 * column are added.
 *
 * @param entries  read during the call only
 * @param options  NULL selects the defaults
 * @param out      receives the operator, owned by the caller (mw_operator_destroy()); NULL on
 *                 failure
 * @param error    NULL, or receives the message of a failure, which names the entry from 0
 * @return MW_OK; MW_ERROR_ARGUMENT for NULL or another base; MW_ERROR_INPUT for a row or column
 *         out of range or a weight that is not finite; MW_ERROR_LIMIT for 2^32 - 1 rows;
 *         MW_ERROR_MEMORY, MW_CANCELLED.
 *
 * Thread-safe. O(count + rows).
 */
MW_API mw_status mw_operator_create_from_entries(const mw_operator_entries *entries,
                                                 const mw_operator_options *options,
                                                 mw_operator **out, mw_error *error);

/**
 * Create the transpose of an operator: rows become columns. The transpose spreads values at points
 * to vertices. Its rows without entries are vertices that no point uses, so apply it with
 * mw_operator_apply_options.zero_empty.
 *
 * @param weights  the operator
 * @param options  NULL selects the defaults
 * @param out      receives the transpose, owned by the caller (mw_operator_destroy()); NULL on
 *                 failure
 * @param error    NULL, or receives the message of a failure
 * @return MW_OK; MW_ERROR_ARGUMENT for NULL; MW_ERROR_MEMORY, MW_CANCELLED.
 *
 * Thread-safe. O(entries + rows + columns). The entries of a row are in the order of the points.
 */
MW_API mw_status mw_operator_transpose(const mw_operator *weights,
                                       const mw_operator_options *options, mw_operator **out,
                                       mw_error *error);

/** Destroy an operator. NULL is allowed. */
MW_API void mw_operator_destroy(mw_operator *weights);

/** The size of an operator. */
typedef struct mw_operator_info {
    uint32_t rows, columns;
    size_t entries;      /**< weights that are not 0 */
    uint32_t empty_rows; /**< rows without entries */
    uint32_t widest;     /**< the most entries in a row */
    size_t bytes;        /**< memory in bytes, with what calls of mw_operator_apply() left to it */
} mw_operator_info;

/** Fill `info` with the size of an operator. Thread-safe. O(1). */
MW_API void mw_operator_describe(const mw_operator *weights, mw_operator_info *info);

/**
 * Copy an operator as compressed sparse rows (CSR), row by row.
 *
 * @param weights  the operator
 * @param first    receives rows + 1 numbers: the entries of row i are first[i] to first[i + 1] - 1
 * @param column   receives the column of each entry, from 0; NULL: not needed
 * @param weight   receives the weight of each entry; NULL: not needed
 *
 * Thread-safe. O(entries + rows), without allocation.
 */
MW_API void mw_operator_copy(const mw_operator *weights, uint64_t *first, uint32_t *column,
                             double *weight);

/** The result of a row if a value that it needs is missing (NaN). */
typedef enum mw_missing_rule {
    MW_MISSING_SPREADS = 0, /**< NaN, as of mw_interpolate() */
    /** The weighted mean of the values present, times the sum of all weights of the row; NaN if no
     * value is present. Next to missing values this is a guess. */
    MW_MISSING_LEFT_OUT
} mw_missing_rule;

/** Options of mw_operator_apply(). Zero-initialised options select the defaults. */
typedef struct mw_operator_apply_options {
    uint32_t threads;        /**< number of threads; 0: one per processor */
    mw_missing_rule missing; /**< what to do about values that are NaN */
    /** Result of a row without entries. 1: the number 0, as in matrix algebra; 0: NaN. */
    int zero_empty;
    const mw_progress *progress; /**< progress and cancelling, see base.h; NULL: none */
    uint32_t reserved[5];        /**< must be zero */
} mw_operator_apply_options;

/**
 * Apply an operator to one field or to many at once. Each result is the sum of weight times value
 * over the entries of its row, in the order of the entries.
 *
 * @param weights  the operator
 * @param table    values at the columns; count, stride and step as for mw_interpolate_table(). It
 *                 is fastest if the values of a column are side by side
 * @param options  NULL selects the defaults
 * @param result   receives values of the table's type, packed: value k of row i at
 *                 result[i * count + k], or at result[k * rows + i] if step is more than 1. Floats
 *                 are summed as doubles and rounded once. It must not overlap the values
 * @param error    NULL, or receives the message of a failure
 * @return MW_OK; MW_ERROR_ARGUMENT for NULL, an unknown type or rule, or a stride less than count
 *         without a step; MW_CANCELLED, after which some results are written.
 *
 * Thread-safe. The result is the same, bit for bit, for any number of threads. O(entries) for each
 * field. Memory is allocated for threads, and for fields that are stored one after another, whose
 * values are brought side by side: from eight fields on 2.6 MB and a byte for 256 columns for each
 * thread. From four fields on, if rows or columns are scattered, it is instead 64 bytes for each
 * row and column, and 4 for each column and entry. The operator keeps this memory for the next call
 * until it is destroyed; of calls that run at the same time, each has its own 64 bytes for each row
 * and column. If memory is not available, the call takes longer.
 */
MW_API mw_status mw_operator_apply(const mw_operator *weights, const mw_value_table *table,
                                   const mw_operator_apply_options *options, void *result,
                                   mw_error *error);

#ifdef __cplusplus
}
#endif
#endif
