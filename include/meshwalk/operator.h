/**
 * @file operator.h
 * Weights that are kept: interpolation at the same points again and again, as a sparse matrix.
 *
 * An operator has a row for each point and a column for each vertex. It is made once, from
 * locations or from the entries of a file of weights, and applied to any number of fields:
 *
 *     mw_locate_batch(locator, points, n, 2, NULL, locations, NULL, &error);
 *     mw_operator_create(mesh, locations, n, NULL, &weights, &error);
 *     for (each step) mw_operator_apply(weights, &table, NULL, result, &error);
 *
 * The values are those of mw_interpolate_table(), bit for bit. An operator takes 40 bytes a point,
 * keeps nothing of the mesh, and holds its rows in an order in which neighbours read the same
 * values.
 */
#ifndef MESHWALK_OPERATOR_H
#define MESHWALK_OPERATOR_H

#include <meshwalk/locate.h>

#ifdef __cplusplus
extern "C" {
#endif

/** Rows of weights. Opaque; any number of threads may apply one operator. */
typedef struct mw_operator mw_operator;

/** How an operator is made. Zero-initialised options select the defaults. */
typedef struct mw_operator_options {
    uint32_t threads;            /**< number of threads; 0: one per processor */
    const mw_progress *progress; /**< progress and cancelling, see base.h; NULL: none */
    uint32_t reserved[5];        /**< must be zero */
} mw_operator_options;

/**
 * Make the operator that interpolates values at the vertices of a mesh linearly at points.
 *
 * @param mesh       the mesh in which the points were located; read during the call only
 * @param locations  n locations: row i is the point of location i. A location without a triangle
 *                   gives a row without entries; one on an edge or vertex gives the entries whose
 *                   weight is not 0
 * @param n          number of locations
 * @param options    NULL selects the defaults
 * @param out        receives the operator, owned by the caller (mw_operator_destroy()); NULL on
 *                   failure
 * @param error      NULL, or receives the message of a failure
 * @return MW_OK; MW_ERROR_ARGUMENT for NULL, or a location whose triangle is none of the mesh or
 *         whose weights are not finite; MW_ERROR_LIMIT for 2^32 - 1 locations or more;
 *         MW_ERROR_MEMORY, MW_CANCELLED.
 *
 * Thread-safe. O(n).
 */
MW_API mw_status mw_operator_create(const mw_mesh *mesh, const mw_location *locations, size_t n,
                                    const mw_operator_options *options, mw_operator **out,
                                    mw_error *error);

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
 * Make an operator from entries: any number in a row. Entries of the same row and column add up.
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
 * Make the transpose of an operator: rows become columns. It spreads values at points to vertices;
 * rows without entries are vertices that no point uses, so apply it with
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
    uint32_t widest;     /**< most entries in a row */
    size_t bytes;        /**< memory in bytes */
} mw_operator_info;

/** Fill `info` with the size of an operator. O(1). */
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

/** What a row gives where a value that it needs is missing (NaN). */
typedef enum mw_missing_rule {
    MW_MISSING_SPREADS = 0, /**< NaN, as mw_interpolate() does */
    /** The mean of the values that are there, by their weights, times the sum of all weights of
     * the row; NaN if none is there. Near the border of missing values it is a guess. */
    MW_MISSING_LEFT_OUT
} mw_missing_rule;

/** How an operator is applied. Zero-initialised options select the defaults. */
typedef struct mw_operator_apply_options {
    uint32_t threads;            /**< number of threads; 0: one per processor */
    mw_missing_rule missing;     /**< for values that are NaN */
    int zero_empty;              /**< rows without entries give 1: 0, as a matrix does; 0: NaN */
    const mw_progress *progress; /**< progress and cancelling, see base.h; NULL: none */
    uint32_t reserved[5];        /**< must be zero */
} mw_operator_apply_options;

/**
 * Apply an operator to one field or to many at once: each result is the sum of weight times value
 * over the entries of its row, in the order of the entries.
 *
 * @param weights  the operator
 * @param table    values at the columns; count, stride and step as of mw_interpolate_table().
 *                 Values of a column side by side are fastest
 * @param options  NULL selects the defaults
 * @param result   receives values of the table's type, packed: value k of row i at
 *                 result[i * count + k], or at result[k * rows + i] if step is more than 1. Floats
 *                 are summed as doubles and rounded once. It must not overlap the values
 * @param error    NULL, or receives the message of a failure
 * @return MW_OK; MW_ERROR_ARGUMENT for NULL, an unknown type or rule, or a stride less than count
 *         without a step; MW_CANCELLED, after which some results are written.
 *
 * Thread-safe. The same bits for any number of threads. Allocates memory for threads only, but for
 * four fields or more one after another, of scattered rows or columns, 64 bytes a row and a column:
 * these are then brought side by side, eight at a time. Without that memory it takes longer.
 */
MW_API mw_status mw_operator_apply(const mw_operator *weights, const mw_value_table *table,
                                   const mw_operator_apply_options *options, void *result,
                                   mw_error *error);

#ifdef __cplusplus
}
#endif
#endif
