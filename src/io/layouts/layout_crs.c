/* The coordinate system of a mesh, by the grid mappings of CF and what models make of them. */
#include "io/layouts/layout_find.h"
#include "io/text/crs_text.h"

#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* The variable that a variable's grid_mapping names: "crs", or "crs: x y" in the longer form. */
static mw_status layout_crs_named(const mw_netcdf *file, const mw_netcdf_variable *variable,
                                  const mw_netcdf_variable **out, mw_error *error)
{
    char *text;
    mw_status status = mw__netcdf_text(file, variable, "grid_mapping", &text, error);
    if (status || !text) return status;
    text[strcspn(text, ": \t")] = 0;
    *out = mw__netcdf_find(file, text);
    free(text);
    return status;
}

static bool layout_crs_has(const mw_netcdf *file, const mw_netcdf_variable *variable,
                           const char *attribute)
{
    char *text;
    bool has = mw__netcdf_text(file, variable, attribute, &text, NULL) == MW_OK && text;
    free(text);
    return has;
}

/* The grid mapping: that of the coordinates, or of a variable over the mesh; otherwise the only
 * variable that looks like one. */
static mw_status layout_crs_variable(const mw_netcdf *file, const mw_layout *layout,
                                     const mw_netcdf_variable **out, mw_error *error)
{
    *out = NULL;
    const mw_netcdf_variable *first[] = {layout->x, layout->topology};
    mw_status status = MW_OK;
    for (int k = 0; k < 2 && !status && !*out; k++)
        if (first[k]) status = layout_crs_named(file, first[k], out, error);
    for (size_t i = 0; i < mw__netcdf_variable_count(file) && !status && !*out; i++)
        status = layout_crs_named(file, mw__netcdf_variable_at(file, i), out, error);
    size_t mappings = 0;
    const mw_netcdf_variable *mapping = NULL;
    for (size_t i = 0; i < mw__netcdf_variable_count(file) && !status && !*out; i++) {
        const mw_netcdf_variable *variable = mw__netcdf_variable_at(file, i);
        if (!layout_crs_has(file, variable, "grid_mapping_name")) continue;
        mapping = variable;
        mappings++;
    }
    if (mappings == 1) *out = mapping;
    return status;
}

static mw_status layout_crs_code(int64_t code, char **crs, mw_error *error)
{
    char text[32];
    snprintf(text, sizeof text, "EPSG:%" PRId64, code);
    return mw__crs_copy(text, strlen(text), crs, error);
}

/* A code as a number, as "28992" or "EPSG:28992". 0: none. */
static int64_t layout_crs_epsg(const mw_netcdf *file, const mw_netcdf_variable *mapping)
{
    static const char *const names[] = {"epsg", "EPSG", "epsg_code", "EPSG_code"};
    for (size_t k = 0; k < sizeof names / sizeof *names; k++) {
        double number;
        char *text;
        int64_t code = 0;
        if (mw__netcdf_number(file, mapping, names[k], &number) && number > 0 && number < 1e9)
            return (int64_t)number;
        if (mw__netcdf_text(file, mapping, names[k], &text, NULL) || !text) continue;
        const char *digits = strrchr(text, ':');
        digits = digits ? digits + 1 : text;
        size_t length = strspn(digits, "0123456789");
        if (length > 0 && length < 9 && !digits[length]) code = strtol(digits, NULL, 10);
        free(text);
        if (code > 0) return code;
    }
    return 0;
}

static mw_status layout_crs_wkt(const mw_netcdf *file, const mw_netcdf_variable *mapping,
                                char **crs, mw_error *error)
{
    static const char *const names[] = {"crs_wkt", "spatial_ref", "wkt", "esri_pe_string"};
    mw_status status = MW_OK;
    for (size_t k = 0; k < sizeof names / sizeof *names && !status && !*crs; k++) {
        char *text;
        status = mw__netcdf_text(file, mapping, names[k], &text, error);
        if (!status && text && *text) status = mw__crs_copy(text, strlen(text), crs, error);
        free(text);
    }
    return status;
}

/* ANUGA: a zone of UTM in the attributes of the file; the southern half has a false northing. */
static mw_status layout_crs_utm(const mw_netcdf *file, char **crs, mw_error *error)
{
    double zone, northing = 0;
    char *datum, *projection = NULL;
    if (!mw__netcdf_number(file, MW_NETCDF_FILE, "zone", &zone)) return MW_OK;
    if (!(zone >= 1 && zone <= 60)) return MW_OK;
    mw_status status = mw__netcdf_text(file, MW_NETCDF_FILE, "datum", &datum, error);
    if (!status) status = mw__netcdf_text(file, MW_NETCDF_FILE, "projection", &projection, error);
    bool known = !status && datum && projection && strcmp(datum, "wgs84") == 0 &&
                 strcmp(projection, "UTM") == 0 &&
                 mw__netcdf_number(file, MW_NETCDF_FILE, "false_northing", &northing);
    free(datum);
    free(projection);
    if (status || !known) return status;
    return layout_crs_code((northing > 0 ? 32700 : 32600) + (int64_t)zone, crs, error);
}

mw_status mw__layout_crs(const mw_netcdf *file, const mw_layout *layout, char **crs,
                         mw_error *error)
{
    const mw_netcdf_variable *mapping;
    *crs = NULL;
    mw_status status = layout_crs_variable(file, layout, &mapping, error);
    if (!status && mapping) {
        int64_t code = layout_crs_epsg(file, mapping);
        if (code > 0) return layout_crs_code(code, crs, error);
        status = layout_crs_wkt(file, mapping, crs, error);
    }
    if (!status && !*crs && layout->lonlat) return layout_crs_code(4326, crs, error);
    if (!status && !*crs && strcmp(layout->name, "anuga") == 0)
        status = layout_crs_utm(file, crs, error);
    return status;
}
