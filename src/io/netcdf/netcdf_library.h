/* netcdf_library.h - libnetcdf, loaded while the program runs. Private; for this room only.
 *
 * libnetcdf brings HDF5 and more, so the library is not linked with it: it is loaded for the first
 * file of that kind, and stays. Its interface is declared here as the headers of netCDF 4 have it,
 * so that building needs none of them.
 *
 * Neither libnetcdf nor HDF5 may be called by two threads at a time, whatever the files. So every
 * call stands between mw__netcdf_lock and mw__netcdf_unlock, which hold one lock of the process:
 * the only variable that all calls of this library share. A program that calls libnetcdf itself
 * must not do so while another thread is in this library. */
#ifndef MW_SRC_IO_NETCDF_NETCDF_LIBRARY_H
#define MW_SRC_IO_NETCDF_NETCDF_LIBRARY_H

#include "base/base.h"

enum {
    NETCDF_READ = 0,           /* NC_NOWRITE */
    NETCDF_VERSION_4 = 0x1000, /* NC_NETCDF4 */
    NETCDF_NO_FILL = 0x100,    /* NC_NOFILL */
    NETCDF_CHUNKED = 0,        /* NC_CHUNKED */
    NETCDF_GLOBAL = -1,        /* NC_GLOBAL: attributes of the file */
    NETCDF_NO_ATTRIBUTE = -43, /* NC_ENOTATT */
    NETCDF_OUT_OF_RANGE = -60, /* NC_ERANGE */
    NETCDF_NO_MEMORY = -61,    /* NC_ENOMEM */
    NETCDF_HDF5 = -101,        /* NC_EHDFERR */
    NETCDF_MEMORY = -137       /* NC_EINMEMORY */
};

/* F(name, result, parameters) */
#define NETCDF_FUNCTIONS(F)                                                                        \
    F(nc_inq_libvers, const char *, (void))                                                        \
    F(nc_strerror, const char *, (int))                                                            \
    F(nc_open, int, (const char *, int, int *))                                                    \
    F(nc_open_mem, int, (const char *, int, size_t, void *, int *))                                \
    F(nc_create, int, (const char *, int, int *))                                                  \
    F(nc_close, int, (int))                                                                        \
    F(nc_abort, int, (int))                                                                        \
    F(nc_set_fill, int, (int, int, int *))                                                         \
    F(nc_inq, int, (int, int *, int *, int *, int *))                                              \
    F(nc_inq_format, int, (int, int *))                                                            \
    F(nc_inq_dim, int, (int, int, char *, size_t *))                                               \
    F(nc_inq_var, int, (int, int, char *, int *, int *, int *, int *))                             \
    F(nc_inq_vardimid, int, (int, int, int *))                                                     \
    F(nc_inq_varndims, int, (int, int, int *))                                                     \
    F(nc_inq_att, int, (int, int, const char *, int *, size_t *))                                  \
    F(nc_inq_attname, int, (int, int, int, char *))                                                \
    F(nc_get_att_text, int, (int, int, const char *, char *))                                      \
    F(nc_get_att_double, int, (int, int, const char *, double *))                                  \
    F(nc_get_att_string, int, (int, int, const char *, char **))                                   \
    F(nc_free_string, int, (size_t, char **))                                                      \
    F(nc_get_vara_double, int, (int, int, const size_t *, const size_t *, double *))               \
    F(nc_get_vara_longlong, int, (int, int, const size_t *, const size_t *, long long *))          \
    F(nc_get_vara_text, int, (int, int, const size_t *, const size_t *, char *))                   \
    F(nc_def_dim, int, (int, const char *, size_t, int *))                                         \
    F(nc_def_var, int, (int, const char *, int, int, const int *, int *))                          \
    F(nc_def_var_deflate, int, (int, int, int, int, int))                                          \
    F(nc_def_var_chunking, int, (int, int, int, const size_t *))                                   \
    F(nc_put_att_text, int, (int, int, const char *, size_t, const char *))                        \
    F(nc_put_att_double, int, (int, int, const char *, int, size_t, const double *))               \
    F(nc_enddef, int, (int))                                                                       \
    F(nc_put_vara_double, int, (int, int, const size_t *, const size_t *, const double *))         \
    F(nc_put_vara_longlong, int, (int, int, const size_t *, const size_t *, const long long *))    \
    F(nc_put_vara_uint, int, (int, int, const size_t *, const size_t *, const unsigned *))         \
    F(nc_put_vara_text, int, (int, int, const size_t *, const size_t *, const char *))

/* The functions of libnetcdf that are called, under their own names. */
typedef struct mw_netcdf_functions {
    /* Of HDF5, which would else print what goes wrong, thread by thread; NULL where libnetcdf has
     * none. Called as H5Eset_auto2(0, NULL, NULL). */
    int (*be_quiet)(int64_t, void *, void *);
#define NETCDF_MEMBER(name, result, parameters) result(*name) parameters;
    NETCDF_FUNCTIONS(NETCDF_MEMBER)
#undef NETCDF_MEMBER
} mw_netcdf_functions;

/* Find the functions; the library is loaded if it is not yet. MW_ERROR_SYSTEM: there is none; the
 * message begins with `name` and tells what to install. */
mw_status mw__netcdf_load(const char *name, mw_netcdf_functions *functions, mw_error *error);

void mw__netcdf_lock(const mw_netcdf_functions *functions);
void mw__netcdf_unlock(void);

#endif
