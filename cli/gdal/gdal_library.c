#include "cli/gdal/gdal_library.h"

#ifdef MW_GDAL

#include <dlfcn.h>

static bool gdal_library_find(gdal_functions *gdal)
{
    void *library = dlopen(MW_GDAL, RTLD_NOW | RTLD_LOCAL);
    if (!library) return false;
#define GDAL_FIND(name)                                                                            \
    *(void **)&gdal->name = dlsym(library, #name);                                                 \
    if (!gdal->name) return false;
    GDAL_FUNCTIONS(GDAL_FIND)
#undef GDAL_FIND
    return true;
}

const gdal_functions *gdal_library_load(void)
{
    static gdal_functions gdal;
    static bool loaded;
    if (loaded) return &gdal;
    if (!gdal_library_find(&gdal)) return NULL;
    gdal.CPLSetErrorHandler(gdal.CPLQuietErrorHandler);
    gdal.GDALAllRegister();
    loaded = true;
    return &gdal;
}

bool gdal_library_built(void)
{
    return true;
}

#else

bool gdal_library_built(void)
{
    return false;
}

#endif
