/**
 * @file weights.h
 * Files of weights: operators on disk, for this library and for others.
 *
 * The layout is that of ESMF's weight files, which xESMF, uxarray, ESMPy and NCO read: dimensions
 * n_a (columns, the source), n_b (rows, the destination) and n_s (entries), and for each entry its
 * row, its column, both from 1, and its weight S. Reading and writing it needs libnetcdf, which is
 * loaded at the first use. SciPy's .npz format needs no library.
 */
#ifndef MESHWALK_WEIGHTS_H
#define MESHWALK_WEIGHTS_H

#include <meshwalk/io.h>
#include <meshwalk/operator.h>

#ifdef __cplusplus
extern "C" {
#endif

/** What a file of weights says about rows and columns besides the weights. All pointers may be
 * NULL. */
typedef struct mw_weight_positions {
    const double *columns;      /**< x and y of each column: xc_a, yc_a */
    size_t column_stride;       /**< doubles from one to the next; 0: 2 */
    const double *rows;         /**< x and y of each row: xc_b, yc_b */
    size_t row_stride;          /**< doubles from one to the next; 0: 2 */
    const mw_location *located; /**< the location of each row; its status is written as status_b */
    int degrees;                /**< 1: x and y are longitude and latitude */
    const char *title;          /**< title of the file */
    const double *column_areas; /**< area of each column: area_a */
    const double *row_areas;    /**< area of each row: area_b */
    const double *column_fractions; /**< frac_a of each column */
    const double *row_fractions;    /**< frac_b of each row */
    const char *method;             /**< map_method; NULL: linear interpolation in triangles */
} mw_weight_positions;

/**
 * Write an operator to a file: in ESMF's layout (netCDF-4), or, if the name ends in .npz, as
 * scipy.sparse.save_npz() writes a csr_array. The file appears under its name only when it is
 * complete.
 *
 * Besides the weights, ESMF's layout has positions, and for columns (_a) and rows (_b) a mask (1; 0
 * for a row without entries), area and frac. If `positions` does not give areas and fractions, area
 * is 0; frac of a row is the sum of its weights, and frac of a column is 1 if some row uses it,
 * else 0.
 *
 * @param path     the file; it must not be a pipe
 * @param weights  the operator
 * @param positions   NULL: none are known
 * @param options  NULL selects the defaults
 * @param error    NULL, or receives the message of a failure
 * @return MW_OK; MW_ERROR_ARGUMENT for NULL or a pipe; MW_ERROR_LIMIT for more than 2^31 - 1 rows,
 *         columns or entries, or an .npz of 4 GiB; MW_ERROR_SYSTEM if the file cannot be written
 *         or there is no libnetcdf; MW_ERROR_MEMORY, MW_CANCELLED.
 *
 * Thread-safe; libnetcdf serves one call at a time.
 */
MW_API mw_status mw_write_weights(const char *path, const mw_operator *weights,
                                  const mw_weight_positions *positions,
                                  const mw_file_options *options, mw_error *error);

/**
 * Read an operator from a file in ESMF's layout. A row may have any number of entries.
 *
 * Rows and columns are numbered from 1, or from 0 if an attribute start_index says so.
 *
 * @param path     the file
 * @param options  NULL selects the defaults
 * @param out      receives the operator, owned by the caller (mw_operator_destroy()); NULL on
 *                 failure
 * @param error    NULL, or receives the message of a failure, which names file and variable
 * @return MW_OK; MW_ERROR_ARGUMENT for NULL; MW_ERROR_INPUT for a file of another kind, or entries
 *         outside the matrix; MW_ERROR_LIMIT; MW_ERROR_SYSTEM if the file cannot be opened or there
 *         is no libnetcdf; MW_ERROR_MEMORY, MW_CANCELLED.
 *
 * Thread-safe; libnetcdf serves one call at a time.
 */
MW_API mw_status mw_read_weights(const char *path, const mw_file_options *options,
                                 mw_operator **out, mw_error *error);

/** Options of mw_apply_weights(). Zero-initialised options select the defaults. */
typedef struct mw_apply_weights_options {
    const char *const *fields;   /**< names of the fields; NULL: all with one value per column */
    size_t field_count;          /**< number of names */
    mw_missing_rule missing;     /**< what to do about missing values */
    uint32_t threads;            /**< number of threads; 0: one per processor */
    const mw_progress *progress; /**< progress and cancelling, see base.h; NULL: none */
    uint32_t reserved[6];        /**< must be zero */
} mw_apply_weights_options;

/** What mw_apply_weights() did. */
typedef struct mw_apply_weights_info {
    size_t fields;     /**< fields that were interpolated */
    size_t slabs;      /**< rows of values in these fields: time steps, layers */
    uint32_t points;   /**< values in a row of the output */
    uint32_t unmapped; /**< points without weights, whose values are missing */
} mw_apply_weights_info;

/**
 * Interpolate the fields of a netCDF file by a file of weights, and write them to another file.
 *
 * A field is a variable of numbers whose last dimension has the length n_a of the weights. If
 * several dimensions have that length, the last dimension of the first named field is taken;
 * without names, the one that most variables have last. The last dimension becomes `point`; other
 * dimensions, such as time and layers, stay. Variables that have only such other dimensions, such
 * as time itself, are copied with their units, names and calendars. _FillValue, missing_value and
 * NaN count as missing. Packed values (scale_factor, add_offset) are unpacked. If the file of
 * weights holds the positions of the points, these become point_x and point_y. Only a few rows are
 * in memory at a time, never a whole field.
 *
 * @param weights  a file of weights in ESMF's layout
 * @param fields   a netCDF file with the fields
 * @param out      the file to write, as netCDF-4; it appears under its name only when it is
 *                 complete
 * @param options  NULL selects the defaults
 * @param info     NULL, or receives what was done
 * @param error    NULL, or receives the message of a failure, which names file and variable
 * @return MW_OK; MW_ERROR_ARGUMENT for NULL, an unknown rule, or an output that is not a file;
 *         MW_ERROR_INPUT for files of another kind, no such field, or a field that does not fit;
 *         MW_ERROR_SYSTEM if a file cannot be opened or written or there is no libnetcdf;
 *         MW_ERROR_MEMORY, MW_CANCELLED.
 *
 * Thread-safe; libnetcdf serves one call at a time.
 */
MW_API mw_status mw_apply_weights(const char *weights, const char *fields, const char *out,
                                  const mw_apply_weights_options *options,
                                  mw_apply_weights_info *info, mw_error *error);

#ifdef __cplusplus
}
#endif
#endif
