#include "io/netcdf/netcdf_library.h"
#include "base/posix.h"

#include <meshwalk/io.h>

#include <stdio.h>

/* Releases of netCDF 4 since 2015, and those to come; each has its number in the name. */
enum { NEWEST_NAME = 40, OLDEST_NAME = 11 };

static pthread_mutex_t netcdf_mutex = PTHREAD_MUTEX_INITIALIZER;

void mw__netcdf_lock(const mw_netcdf_functions *functions)
{
    pthread_mutex_lock(&netcdf_mutex);
    if (functions->be_quiet) functions->be_quiet(0, NULL, NULL);
}

void mw__netcdf_unlock(void)
{
    pthread_mutex_unlock(&netcdf_mutex);
}

/* HDF5 cannot be unloaded safely, so it stays (RTLD_NODELETE). */
static void *netcdf_library_open(void)
{
    enum { FLAGS = RTLD_NOW | RTLD_LOCAL | RTLD_NODELETE };
    char name[32];
    for (int number = NEWEST_NAME; number >= OLDEST_NAME; number--) {
        snprintf(name, sizeof name, "libnetcdf.so.%d", number);
        void *library = dlopen(name, FLAGS);
        if (library) return library;
    }
    return dlopen("libnetcdf.so", FLAGS);
}

static bool netcdf_library_find(void *library, mw_netcdf_functions *functions)
{
#define NETCDF_FIND(name, result, parameters)                                                      \
    *(void **)&functions->name = dlsym(library, #name);                                            \
    if (!functions->name) return false;
    NETCDF_FUNCTIONS(NETCDF_FIND)
#undef NETCDF_FIND
    *(void **)&functions->be_quiet = dlsym(library, "H5Eset_auto2");
    /* Without this call HDF5 crashes at the end of the program if a file could not be written. It
     * has an effect only before the first use of HDF5. */
    int (*no_exit)(void);
    *(void **)&no_exit = dlsym(library, "H5dont_atexit");
    if (no_exit) no_exit();
    return true;
}

mw_status mw__netcdf_load(const char *name, mw_netcdf_functions *functions, mw_error *error)
{
    pthread_mutex_lock(&netcdf_mutex);
    void *library = netcdf_library_open();
    bool found = library && netcdf_library_find(library, functions);
    if (library) dlclose(library);
    pthread_mutex_unlock(&netcdf_mutex);
    if (found) return MW_OK;
    return mw__fail(error, MW_ERROR_SYSTEM,
                    "%.240s: netCDF needs the library libnetcdf, which %s; on Debian and Ubuntu "
                    "the package libnetcdf-dev brings it",
                    name, library ? "is too old here" : "is not found here");
}

size_t mw_netcdf_version(char *text, size_t size)
{
    mw_netcdf_functions functions;
    if (mw__netcdf_load("", &functions, NULL)) {
        if (text && size) text[0] = 0;
        return 0;
    }
    mw__netcdf_lock(&functions);
    const char *version = functions.nc_inq_libvers();
    mw__netcdf_unlock();
    size_t length = 0;
    while (version[length] && version[length] != ' ') length++;
    if (text && size) snprintf(text, size, "%.*s", (int)length, version);
    return length;
}
