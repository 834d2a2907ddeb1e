#include "cli/gdal/gdal_crs.h"
#include "cli/frame/message.h"
#include "src/base/posix.h"

#include <ctype.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* --- texts ------------------------------------------------------------------------------------ */

static bool crs_text_is_wkt(const char *crs)
{
    size_t letters = strspn(crs, "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz_");
    const char *rest = crs + letters + strspn(crs + letters, " ");
    return letters > 0 && (*rest == '[' || *rest == '(');
}

/* AUTHORITY:CODE, also two codes with a plus. */
static bool crs_text_is_code(const char *crs)
{
    size_t name = strspn(crs, "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz");
    if (name == 0 || crs[name] != ':') return false;
    const char *code = crs + name + 1;
    for (const char *c = code; *c; c++)
        if (!isalnum((unsigned char)*c) && !strchr("+._-", *c)) return false;
    return *code != 0;
}

/* GDAL itself would also read files and addresses of that name. */
static bool crs_text_is_safe(const char *crs)
{
    static const char *const names[] = {"WGS84", "WGS72", "NAD83", "NAD27"};
    for (size_t i = 0; i < sizeof names / sizeof *names; i++)
        if (strcasecmp(crs, names[i]) == 0) return true;
    return crs_text_is_wkt(crs) || crs_text_is_code(crs) ||
           strncasecmp(crs, "urn:ogc:def:crs:", 16) == 0 || *crs == '+' || *crs == '{';
}

/* The name in WKT: what stands in its first quotes. */
static const char *crs_text_name(const char *crs, char name[CRS_NAME])
{
    const char *quote = crs_text_is_wkt(crs) ? strchr(crs, '"') : NULL;
    const char *begin = quote ? quote + 1 : crs;
    size_t length = quote ? strcspn(begin, "\"") : strlen(begin);
    snprintf(name, CRS_NAME, "%.*s", length < 60 ? (int)length : 60, begin);
    for (char *c = name; *c; c++)
        if ((unsigned char)*c < 0x20 || *c == 0x7f) *c = '?';
    return name;
}

int crs_check_option(const char *option, const char *crs)
{
    if (!crs || crs_known(crs)) return 0;
    complain("option '--%s' must be a coordinate system, as EPSG:2056 or WKT, not '%.60s'", option,
             crs);
    return END_USAGE;
}

#ifdef MW_GDAL

/* --- systems ---------------------------------------------------------------------------------- */

OGRSpatialReferenceH crs_parse(const gdal_functions *gdal, const char *crs, bool heights)
{
    OGRSpatialReferenceH system = crs_text_is_safe(crs) ? gdal->OSRNewSpatialReference(NULL) : NULL;
    if (!system) return NULL;
    gdal->CPLErrorReset();
    if (gdal->OSRSetFromUserInput(system, crs) == OGRERR_NONE) {
        if (!heights) gdal->OSRDemoteTo2D(system, NULL);
        gdal->OSRSetAxisMappingStrategy(system, OAMS_TRADITIONAL_GIS_ORDER);
        return system;
    }
    gdal->OSRRelease(system);
    return NULL;
}

static void crs_release(const gdal_functions *gdal, OGRSpatialReferenceH system)
{
    if (system) gdal->OSRRelease(system);
}

bool crs_known(const char *crs)
{
    const gdal_functions *gdal = crs_text_is_safe(crs) ? gdal_library_load() : NULL;
    if (!gdal) return crs_text_is_safe(crs);
    OGRSpatialReferenceH system = crs_parse(gdal, crs, false);
    crs_release(gdal, system);
    return system != NULL;
}

const char *crs_name(const char *crs, char name[CRS_NAME])
{
    const gdal_functions *gdal = gdal_library_load();
    OGRSpatialReferenceH system = gdal ? crs_parse(gdal, crs, false) : NULL;
    if (!system) return crs_text_name(crs, name);
    const char *authority = gdal->OSRGetAuthorityName(system, NULL),
               *code = gdal->OSRGetAuthorityCode(system, NULL);
    const char *words = gdal->OSRGetName(system);
    if (authority && code)
        snprintf(name, CRS_NAME, "%.20s:%.20s (%.80s)", authority, code, words ? words : "");
    else
        snprintf(name, CRS_NAME, "%.80s", words ? words : "a system without a name");
    gdal->OSRRelease(system);
    return name;
}

bool crs_same(const char *a, const char *b)
{
    const char *const options[] = {"IGNORE_DATA_AXIS_TO_SRS_AXIS_MAPPING=YES",
                                   "CRITERION=EQUIVALENT_EXCEPT_AXIS_ORDER_GEOGCRS", NULL};
    if (strcasecmp(a, b) == 0) return true;
    const gdal_functions *gdal = gdal_library_load();
    OGRSpatialReferenceH one = gdal ? crs_parse(gdal, a, false) : NULL,
                         other = gdal ? crs_parse(gdal, b, false) : NULL;
    bool same = one && other && gdal->OSRIsSameEx(one, other, options);
    crs_release(gdal, one);
    crs_release(gdal, other);
    return same;
}

bool crs_is_lonlat(const char *crs)
{
    const gdal_functions *gdal = gdal_library_load();
    OGRSpatialReferenceH system = gdal ? crs_parse(gdal, crs, false) : NULL;
    bool lonlat = system ? gdal->OSRIsGeographic(system) : strcasecmp(crs, CRS_LONLAT) == 0;
    crs_release(gdal, system);
    return lonlat;
}

char *crs_export(const gdal_functions *gdal, OGRSpatialReferenceH system)
{
    char *wkt = NULL, *copy = NULL;
    if (gdal->OSRExportToWkt(system, &wkt) == OGRERR_NONE && wkt) copy = strdup(wkt);
    if (wkt) gdal->VSIFree(wkt);
    return copy;
}

char *crs_wkt(const char *crs)
{
    const gdal_functions *gdal = gdal_library_load();
    OGRSpatialReferenceH system = gdal ? crs_parse(gdal, crs, true) : NULL;
    if (!system) return crs_text_is_wkt(crs) ? strdup(crs) : NULL;
    char *wkt = crs_export(gdal, system);
    gdal->OSRRelease(system);
    return wkt;
}

/* --- layers ----------------------------------------------------------------------------------- */

/* GDAL takes GeoJSON that names no system for longitudes and latitudes, also where it has numbers
 * that cannot be such. */
static bool layer_belies_lonlat(const gdal_functions *gdal, GDALDatasetH set, OGRLayerH layer)
{
    OGREnvelope box;
    GDALDriverH driver = gdal->GDALGetDatasetDriver(set);
    const char *format = driver ? gdal->GDALGetDriverShortName(driver) : "";
    if (strncmp(format, "GeoJSON", 7) != 0 ||
        !gdal->OSRIsGeographic(gdal->OGR_L_GetSpatialRef(layer)))
        return false;
    /* GeoJSONSeq would have to be read as a whole. */
    if (gdal->OGR_L_GetExtent(layer, &box, strcmp(format, "GeoJSON") == 0) != OGRERR_NONE)
        return false;
    return box.MinX < -360 || box.MaxX > 360 || box.MinY < -90 || box.MaxY > 90;
}

char *crs_of_layer(GDALDatasetH set, OGRLayerH layer)
{
    const gdal_functions *gdal = gdal_library_load();
    OGRSpatialReferenceH system = gdal->OGR_L_GetSpatialRef(layer);
    const char *name = system ? gdal->OSRGetName(system) : NULL;
    /* A GeoPackage has a system of that name for what is not known. */
    if (!system || (name && strncmp(name, "Undefined ", 10) == 0)) return NULL;
    return layer_belies_lonlat(gdal, set, layer) ? NULL : crs_export(gdal, system);
}

#else

bool crs_known(const char *crs)
{
    return crs_text_is_safe(crs);
}

const char *crs_name(const char *crs, char name[CRS_NAME])
{
    return crs_text_name(crs, name);
}

bool crs_same(const char *a, const char *b)
{
    return strcasecmp(a, b) == 0;
}

bool crs_is_lonlat(const char *crs)
{
    return strcasecmp(crs, CRS_LONLAT) == 0;
}

char *crs_wkt(const char *crs)
{
    return crs_text_is_wkt(crs) ? strdup(crs) : NULL;
}

#endif
