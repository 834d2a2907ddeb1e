#include "cli/gdal/gdal_library.h"
#include "cli/frame/message.h"
#include "src/base/posix.h"

#ifdef MW_GDAL

static struct {
    pthread_t thread;
    bool loading; /* the thread runs, or has ended */
} begun;

static void *gdal_library_map(void *unused)
{
    (void)unused;
    return dlopen(MW_GDAL, RTLD_NOW | RTLD_LOCAL);
}

void gdal_library_begin(void)
{
    if (!begun.loading)
        begun.loading = pthread_create(&begun.thread, NULL, gdal_library_map, NULL) == 0;
}

void gdal_library_end(void)
{
    if (begun.loading) pthread_join(begun.thread, NULL);
    begun.loading = false;
}

static bool gdal_library_find(gdal_functions *gdal)
{
    gdal_library_end();
    void *library = gdal_library_map(NULL); /* at once, if it is loaded */
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

GDALDatasetH gdal_library_open(const char *path, unsigned kind, const char *otherwise)
{
    const gdal_functions *gdal = gdal_library_load();
    if (!gdal) {
        complain("%s: GDAL, which would read it, cannot be loaded (" MW_GDAL ")", path);
        return NULL;
    }
    gdal->CPLErrorReset();
    GDALDatasetH set =
        gdal->GDALOpenEx(path, kind | GDAL_OF_READONLY | GDAL_OF_VERBOSE_ERROR, NULL, NULL, NULL);
    const char *message = gdal->CPLGetLastErrorMsg();
    if (!set) complain("%s: GDAL says: %.1000s", path, *message ? message : otherwise);
    return set;
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

void gdal_library_end(void) {}

#endif
