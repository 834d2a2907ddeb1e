/**
 * @file series.h
 * Values over time in files: water levels, velocities, temperatures at the vertices or faces of a
 * mesh.
 *
 *     mw_series_open("fort.63.nc", NULL, &series, &error);
 *     const mw_series_info *info = mw_series_describe(series);
 *     for (size_t step = 0; step < info->step_count; step++)
 *         mw_series_read(series, field, step, values, &error);
 *
 * A call reads one step of one field. The series itself holds only its times and the names of its
 * fields. Vertices and faces have the numbers that mw_read_mesh() gives them.
 */
#ifndef MESHWALK_SERIES_H
#define MESHWALK_SERIES_H

#include <meshwalk/base.h>

#ifdef __cplusplus
extern "C" {
#endif

/** Values over time, opened. Opaque. */
typedef struct mw_series mw_series;

/** What the values of a field belong to. */
typedef enum mw_series_location {
    MW_SERIES_VERTEX = 0, /**< the vertices of the mesh */
    MW_SERIES_FACE        /**< the faces of the file, which may be polygons: mw_mesh_file.faces */
} mw_series_location;

/** A field of a series. Texts belong to the series. */
typedef struct mw_series_field {
    /** "zeta"; "temp:0", "temp:1" ... for the layers or components of a variable that has several,
     * in the order of the file; "hvel:3:0" for a variable of layers and components */
    const char *name;
    const char *unit; /**< "" = the file does not tell */
    /** As the file describes it, and its name by CF: "sea_surface_height_above_geoid"; "" = the
     * file does not tell. */
    const char *long_name, *standard_name;
    mw_series_location location;
    int constant;       /**< 1 = the field does not depend on time; all steps are equal */
    size_t value_count; /**< vertices or faces */
    uint32_t reserved[4];
} mw_series_field;

/** What a series holds. Texts and arrays belong to the series. */
typedef struct mw_series_info {
    size_t step_count;   /**< 0 = constant fields only */
    const double *times; /**< of the steps, increasing */
    /** Unit of the times, as in CF: "seconds since 2015-12-14 00:00:00"; "" = unknown. */
    const char *time_unit;
    /** Calendar of CF: "standard", "noleap", "360_day" ...; "" = the file names none, which means
     * "standard". */
    const char *calendar;
    const mw_series_field *fields;
    size_t field_count;
    uint32_t reserved[6];
} mw_series_info;

/** Options of mw_series_open(). Zero-initialised options select the defaults. */
typedef struct mw_series_options {
    /** How many vertices and faces the mesh of the values has; 0 = as the mesh in the file. Needed
     * if the mesh is in another file. */
    size_t vertex_count, face_count;
    const char *layout; /**< as mw_file_options.layout; NULL = recognised */
    /** Further files with the same fields and later times; NULL = none. */
    const char *const *more_paths;
    size_t more_count;
    uint32_t reserved[6]; /**< must be zero */
} mw_series_options;

/**
 * Open the values over time in a file.
 *
 * netCDF: a variable of numbers over the vertices or faces of the mesh is a field (layouts: see
 * mw_read_mesh()). It may have a time and two further dimensions; with these it is one field for
 * each index. Values are unpacked (scale_factor, add_offset).
 *
 * Selafin: every variable. ADCIRC's text: fort.63 has the field "zeta", fort.64 "u-vel" and
 * "v-vel", fort.73 "pressure", fort.74 "windx" and "windy", maxele.63 "zeta_max", maxvel.63
 * "vel_max"; the mesh is in fort.14. SMS .dat, text and binary: one dataset over the vertices of a
 * .2dm, or over its faces if the name of the file contains "_els"; a vector becomes "NAME_x" and
 * "NAME_y"; flags of dry elements are skipped. Files of these kinds are read once for their times.
 * To read a step before the latest one, the file is read again from its beginning. One step of all
 * fields is kept in memory.
 *
 * @param path     the file; a file compressed by gzip is decompressed in memory
 * @param options  NULL = all zero
 * @param out      set to the series, owned by the caller (mw_series_close()), or to NULL on failure
 * @param error    NULL, or receives the message of a failure
 * @return MW_OK; MW_ERROR_INPUT: no values over time, another number of vertices or faces than the
 *         mesh has, times that do not increase, a calendar unknown to CF, files that do not fit
 *         together; MW_ERROR_SYSTEM, also if libnetcdf is not found; MW_ERROR_ARGUMENT,
 *         MW_ERROR_MEMORY
 *
 * Thread-safe; libnetcdf serves one call at a time. O(times) for netCDF, else O(size of the file).
 */
MW_API mw_status mw_series_open(const char *path, const mw_series_options *options, mw_series **out,
                                mw_error *error);

/**
 * Describe what a series holds.
 *
 * @param series  the series
 * @return the description, owned by the series, never NULL.
 *
 * Thread-safe. O(1).
 */
MW_API const mw_series_info *mw_series_describe(const mw_series *series);

/**
 * Find a field by its name.
 *
 * @param series  the series
 * @param name    the name, not NULL
 * @return the number of the field, from 0; SIZE_MAX if no field has that name.
 *
 * Thread-safe. O(fields).
 */
MW_API size_t mw_series_find(const mw_series *series, const char *name);

/**
 * Read the values of a field at a step.
 *
 * @param series  the series
 * @param field   number of the field, from 0
 * @param step    number of the step, from 0; ignored for a constant field
 * @param values  receives mw_series_field.value_count doubles; NaN where the value is missing
 * @param error   NULL, or receives the message of a failure
 * @return MW_OK; MW_ERROR_ARGUMENT: no such field or step; MW_ERROR_INPUT, MW_ERROR_SYSTEM,
 *         MW_ERROR_MEMORY
 *
 * One thread at a time may read from one series. O(value_count), but for an earlier step of a file
 * that is not netCDF O(size of the file).
 */
MW_API mw_status mw_series_read(mw_series *series, size_t field, size_t step, double *values,
                                mw_error *error);

/** Close a series. NULL is allowed. */
MW_API void mw_series_close(mw_series *series);

#ifdef __cplusplus
}
#endif
#endif
