#include "cli/gdal/vector_formats.h"
#include "src/base/posix.h"

#include <stddef.h>
#include <string.h>

/* GeoJSON with all digits of a double. */
#define DIGITS "SIGNIFICANT_FIGURES=17"
#define DECIMALS "COORDINATE_PRECISION=17"

/* clang-format off */
static const vector_format formats[] = {
    {.ending = ".gpkg", .driver = "GPKG"},
    {.ending = ".shp", .driver = "ESRI Shapefile", .shapefile = true},
    /* An index would sort the rows. */
    {.ending = ".fgb", .driver = "FlatGeobuf", .options = {"SPATIAL_INDEX=NO"},
     .geometry_needed = true},
    {.ending = ".geojson", .driver = "GeoJSON", .options = {DIGITS}, .lonlat_meant = true},
    {.ending = ".json", .driver = "GeoJSON", .options = {DIGITS}, .lonlat_meant = true},
    {.ending = ".geojsonl", .driver = "GeoJSONSeq", .options = {DIGITS, DECIMALS},
     .lonlat_meant = true},
    {.ending = ".geojsons", .driver = "GeoJSONSeq", .options = {DIGITS, DECIMALS},
     .lonlat_meant = true},
    {.ending = ".gml", .driver = "GML"},
    {.ending = ".kml", .driver = "KML", .lonlat_meant = true},
    {.ending = ".gpx", .driver = "GPX", .create = "GPX_USE_EXTENSIONS=YES",
     .points = "waypoints", .lines = "routes",
     .geometry_needed = true, .lonlat_meant = true, .lonlat_only = true},
    {.ending = ".sqlite", .driver = "SQLite"},
    {.ending = ".db", .driver = "SQLite"},
    {.ending = ".jml", .driver = "JML"},
    /* The file would begin by dropping a table of that name. */
    {.ending = ".sql", .driver = "PGDUMP", .options = {"DROP_TABLE=NO"}},
    {.ending = ".parquet", .driver = "Parquet", .rare = true},
};
/* clang-format on */

size_t vector_formats_list(const vector_format **list)
{
    *list = formats;
    return sizeof formats / sizeof *formats;
}

const vector_format *vector_format_of(const char *path)
{
    size_t length = path ? strlen(path) : 0;
    for (size_t i = 0; i < sizeof formats / sizeof *formats; i++) {
        size_t end = strlen(formats[i].ending);
        if (length > end && strcasecmp(path + length - end, formats[i].ending) == 0)
            return &formats[i];
    }
    return NULL;
}
