/**
 * @file point_series.h
 * Values over time at points, written as netCDF by the CF conventions for discrete sampling
 * geometries: time series at fixed points, or the track of one moving point. xarray and other
 * programs that know CF can read it. libnetcdf is loaded at the first use.
 */
#ifndef MESHWALK_POINT_SERIES_H
#define MESHWALK_POINT_SERIES_H

#include <meshwalk/locate.h>

#ifdef __cplusplus
extern "C" {
#endif

/** What the points are. */
typedef enum mw_point_feature {
    MW_POINT_TIME_SERIES = 0, /**< stations: each has a value at each of the times */
    MW_POINT_TRAJECTORY       /**< one track: each point has its own time, and one value */
} mw_point_feature;

/** What is written besides the values. The arrays are read during mw_point_series_open() only. */
typedef struct mw_point_series_layout {
    mw_point_feature feature;
    const double *positions; /**< x and y of each point */
    size_t position_stride;  /**< doubles from one to the next; 0: 2 */
    size_t point_count;
    int degrees;              /**< 1: x and y are longitude and latitude */
    const double *times;      /**< `time_count` times; for a track one for each point */
    size_t time_stride;       /**< doubles from one to the next; 0: 1 */
    size_t time_count;        /**< ignored for a track */
    const char *time_unit;    /**< as in CF: "hours since 2020-01-01"; NULL or "": unknown */
    const char *calendar;     /**< NULL or "": unknown */
    const char *const *names; /**< of the fields */
    const char *const *units; /**< of the fields; "": unknown; NULL: all unknown */
    size_t field_count;
    /** the location of each point, whose status is written; NULL: no status */
    const mw_location *located;
    /** Descriptions of the fields, and their names by CF; "": unknown; NULL: all unknown. A field
     * without a description is described by its name. */
    const char *const *long_names, *const *standard_names;
    const char *crs;           /**< "EPSG:2056" or WKT; NULL: unknown, and WGS 84 for degrees */
    const char *position_unit; /**< of x and y that are not degrees: "m"; NULL: unknown */
    const char *title;         /**< of the file; NULL: what the points are */
    const char *history;       /**< how the file was made; NULL: by this library */
} mw_point_series_layout;

/** A file that is being written. Opaque. */
typedef struct mw_point_series mw_point_series;

/**
 * Begin a file of values over time.
 *
 * @param path    the file, not a pipe; it appears under its name only when it is complete
 * @param layout  what the file holds. Characters that CF does not allow in names become "_"
 * @param out     receives the output, owned by the caller (mw_point_series_close() releases it);
 *                NULL on failure
 * @param error   NULL, or receives the message of a failure
 * @return MW_OK; MW_ERROR_ARGUMENT for NULL, or a pipe; MW_ERROR_SYSTEM if the file cannot be
 *         written or there is no libnetcdf; MW_ERROR_MEMORY.
 *
 * Thread-safe; libnetcdf serves one call at a time. O(points + times).
 */
MW_API mw_status mw_point_series_open(const char *path, const mw_point_series_layout *layout,
                                      mw_point_series **out, mw_error *error);

/**
 * Write the values of a field at a step. mw_point_series_close() reports a failure.
 *
 * @param output  the output
 * @param field   number of the field, from 0
 * @param step    number of the time, from 0; ignored for a track
 * @param values  one for each point; NaN: the value is missing
 *
 * One thread at a time may use an output. O(points).
 */
MW_API void mw_point_series_write(mw_point_series *output, size_t field, size_t step,
                                  const double *values);

/** 1 if a write has failed, so that a long job can stop early; else 0. One thread at a time may use
 * an output. O(1). */
MW_API int mw_point_series_failed(const mw_point_series *output);

/**
 * Finish a file, and release the output in any case.
 *
 * @param output  the output; NULL is allowed
 * @param commit  1: give the file its name; 0: remove it
 * @param error   NULL, or receives the first failure of a write
 * @return MW_OK; MW_ERROR_SYSTEM if a write failed or the file cannot get its name: then no file
 *         is left.
 *
 * One thread at a time may use an output.
 */
MW_API mw_status mw_point_series_close(mw_point_series *output, int commit, mw_error *error);

#ifdef __cplusplus
}
#endif
#endif
