#include "cli/gdal/library_versions.h"
#include "cli/gdal/gdal_library.h"
#include "cli/gdal/vector_formats.h"

#include <meshwalk/meshwalk.h>

/* GDAL reads GeoJSON, too, and Jansson nothing else. */
#ifdef MW_JANSSON_VERSION
#define WITHOUT_GDAL "no vector files but GeoJSON and .poly, no rasters, no transformations"
#else
#define WITHOUT_GDAL "no vector files but .poly, no rasters, no transformations"
#endif
#ifdef MW_GDAL
#define WITHOUT_JANSSON "no constraints from GeoJSON, but by GDAL"
#else
#define WITHOUT_JANSSON "no constraints from GeoJSON"
#endif

void library_version_line(text *t, const char *name, const char *version, const char *without)
{
    if (version)
        text_printf(t, "  %-8s %s\n", name, version);
    else
        text_printf(t, "  %-8s not built in: %s\n", name, without);
}

#ifdef MW_GDAL

/* GDAL and PROJ are looked for where the program runs. */
static void version_of_gdal(text *t)
{
    const vector_format *formats;
    size_t count = vector_formats_list(&formats);
    const gdal_functions *gdal = gdal_library_load();
    int major = 0, minor = 0, patch = 0;
    if (!gdal) {
        text_string(t, "  GDAL     built in, but " MW_GDAL " is not found: " WITHOUT_GDAL "\n");
        return;
    }
    gdal->OSRGetPROJVersion(&major, &minor, &patch);
    text_printf(t, "  GDAL     %s, found: rasters and vector files;",
                gdal->GDALVersionInfo("RELEASE_NAME"));
    for (int there = 1; there >= 0; there--) {
        const char *join = there ? " writes " : ", not ";
        for (size_t i = 0; i < count; i++) {
            if ((gdal->GDALGetDriverByName(formats[i].driver) != NULL) != there) continue;
            text_printf(t, "%s%s", join, formats[i].ending);
            join = ", ";
        }
    }
    text_printf(t, "\n  PROJ     %d.%d.%d, found: coordinate systems\n", major, minor, patch);
}

#else

static void version_of_gdal(text *t)
{
    library_version_line(t, "GDAL", NULL, WITHOUT_GDAL);
}

#endif

/* libnetcdf, too. */
static void version_of_netcdf(text *t)
{
    char version[64];
    if (mw_netcdf_version(version, sizeof version))
        text_printf(t, "  netCDF   %s, found: meshes and values of ocean models\n", version);
    else
        text_printf(t, "  netCDF   libnetcdf is not found: no .nc files (Debian has it in "
                       "libnetcdf-dev)\n");
}

void library_versions_write(text *t)
{
#ifdef MW_ZLIB_VERSION
    const char *zlib = MW_ZLIB_VERSION ", built in: files packed by gzip";
#else
    const char *zlib = NULL;
#endif
#ifdef MW_JANSSON_VERSION
    const char *jansson = MW_JANSSON_VERSION ", built in: constraints from GeoJSON";
#else
    const char *jansson = NULL;
#endif
    library_version_line(t, "zlib", zlib,
                         "files packed by gzip are read by the library's own code");
    library_version_line(t, "Jansson", jansson, WITHOUT_JANSSON);
    version_of_gdal(t);
    version_of_netcdf(t);
    library_version_line(t, "LAZ", NULL, "LAS only; 'pdal translate' unpacks");
}
