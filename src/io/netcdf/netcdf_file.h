/* netcdf_file.h - netCDF files: what is in them, values, and files that are written. Private.
 *
 * Classic netCDF and netCDF-4 are read. Several threads may call these functions; one at a time is
 * served. A file may be used by one thread at a time. Errors of reading begin "FILE: " or "FILE:
 * variable NAME: ". */
#ifndef MW_SRC_IO_NETCDF_NETCDF_FILE_H
#define MW_SRC_IO_NETCDF_NETCDF_FILE_H

#include "base/base.h"

/* Room for a name, its NUL included; most dimensions of a variable that is looked at. */
#define MW_NETCDF_NAME 257
#define MW_NETCDF_RANK 6

typedef enum mw_netcdf_type { /* numbers as libnetcdf has them */
                              MW_NETCDF_BYTE = 1,
                              MW_NETCDF_CHAR,
                              MW_NETCDF_SHORT,
                              MW_NETCDF_INT,
                              MW_NETCDF_FLOAT,
                              MW_NETCDF_DOUBLE,
                              MW_NETCDF_UBYTE,
                              MW_NETCDF_USHORT,
                              MW_NETCDF_UINT,
                              MW_NETCDF_INT64,
                              MW_NETCDF_UINT64,
                              MW_NETCDF_STRING
} mw_netcdf_type;

typedef struct mw_netcdf_variable {
    int id;
    mw_netcdf_type type; /* beyond MW_NETCDF_STRING: a type of the file's own */
    size_t rank;         /* more than MW_NETCDF_RANK: the dimensions are not told */
    int dimensions[MW_NETCDF_RANK];
    size_t lengths[MW_NETCDF_RANK]; /* of the dimensions */
    char name[MW_NETCDF_NAME];
} mw_netcdf_variable;

/* Where attributes of the file stand: no variable. */
#define MW_NETCDF_FILE NULL

/* A file that is read. Opaque. */
typedef struct mw_netcdf mw_netcdf;

/* Do the first bytes of a file tell netCDF, or HDF5, in which netCDF-4 is written? */
bool mw__netcdf_begins(const char *head, size_t size);

/* Open a regular file that is not compressed. MW_ERROR_SYSTEM: there is no libnetcdf, or no such
 * file; MW_ERROR_INPUT; MW_ERROR_MEMORY. Release with mw__netcdf_close. */
mw_status mw__netcdf_open(const char *path, mw_netcdf **out, mw_error *error);
/* Read from memory, which must outlive the file; `name` is for messages. */
mw_status mw__netcdf_open_memory(const char *name, void *bytes, size_t size, mw_netcdf **out,
                                 mw_error *error);
/* NULL is allowed. */
void mw__netcdf_close(mw_netcdf *file);
const char *mw__netcdf_name(const mw_netcdf *file);
/* Bytes of the file. */
uint64_t mw__netcdf_file_size(const mw_netcdf *file);

/* Is it one of the classic formats, and not netCDF-4? */
bool mw__netcdf_is_classic(const mw_netcdf *file);

/* What is in the root group. Variables in the order of the file. */
size_t mw__netcdf_variable_count(const mw_netcdf *file);
const mw_netcdf_variable *mw__netcdf_variable_at(const mw_netcdf *file, size_t i);
/* NULL: there is none of that name. */
const mw_netcdf_variable *mw__netcdf_find(const mw_netcdf *file, const char *name);
/* As mw__netcdf_find, but an error if there is none. */
mw_status mw__netcdf_need(const mw_netcdf *file, const char *name, const mw_netcdf_variable **out,
                          mw_error *error);
size_t mw__netcdf_dimension_count(const mw_netcdf *file);
/* The dimension's name, owned by the file, and its length. */
const char *mw__netcdf_dimension_at(const mw_netcdf *file, int dimension, size_t *length);
/* The number of the dimension of that name; -1: none. */
int mw__netcdf_dimension_find(const mw_netcdf *file, const char *name, size_t *length);

/* The text of an attribute, released by the caller with free(); NULL if there is none, or if it is
 * no text. */
mw_status mw__netcdf_text(const mw_netcdf *file, const mw_netcdf_variable *variable,
                          const char *attribute, char **text, mw_error *error);
/* Is there an attribute with one number? A text is none. */
bool mw__netcdf_number(const mw_netcdf *file, const mw_netcdf_variable *variable,
                       const char *attribute, double *value);

/* Read the block that begins at `starts` and has `counts` values along each dimension; the last
 * dimension varies fastest. Values are returned as stored: missing values and scale factors are not
 * applied. Texts are refused. As integers, numbers beyond 64 bits are refused, and fractions are
 * cut off. */
mw_status mw__netcdf_doubles(const mw_netcdf *file, const mw_netcdf_variable *variable,
                             const size_t *starts, const size_t *counts, double *values,
                             mw_error *error);
mw_status mw__netcdf_integers(const mw_netcdf *file, const mw_netcdf_variable *variable,
                              const size_t *starts, const size_t *counts, int64_t *values,
                              mw_error *error);
mw_status mw__netcdf_characters(const mw_netcdf *file, const mw_netcdf_variable *variable,
                                const size_t *starts, const size_t *counts, char *text,
                                mw_error *error);

/* Fill in an error with MW_ERROR_INPUT: "FILE: variable NAME: ...", or "FILE: ..." for NULL.
 * Control characters become '?'. */
mw_status mw__netcdf_fail(const mw_netcdf *file, const mw_netcdf_variable *variable,
                          mw_error *error, const char *format, ...)
    __attribute__((format(printf, 4, 5)));

#endif
