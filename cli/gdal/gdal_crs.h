/* gdal_crs.h - coordinate systems: what a text names, and whether two texts name the same system.
 * GDAL decides.
 *
 * A system is a text: "EPSG:2056", or WKT. Its first two coordinates are easting and northing, or
 * longitude and latitude, in this order, whatever its definition says. Heights do not count.
 * Without GDAL texts are the same system if they are the same text. */
#ifndef MW_CLI_GDAL_GDAL_CRS_H
#define MW_CLI_GDAL_GDAL_CRS_H

#include "cli/gdal/gdal_library.h"

#include <stdbool.h>

/* Longitudes and latitudes where nothing else is said. */
#define CRS_LONLAT "EPSG:4326"

/* Does the text name a system? Texts of files are not trusted: names of files and addresses are
 * none. Without GDAL only the form of the text counts. */
bool crs_known(const char *crs);

/* Refuse a text that an option gives, if it names no system. NULL is allowed. Returns 0, or
 * END_USAGE after a complaint. */
int crs_check_option(const char *option, const char *crs);

/* A short name, for messages: "EPSG:2056 (CH1903+ / LV95)". */
#define CRS_NAME 160
const char *crs_name(const char *crs, char name[CRS_NAME]);

/* Are these the same system? Are its coordinates longitudes and latitudes? */
bool crs_same(const char *a, const char *b);
bool crs_is_lonlat(const char *crs);

/* The system as WKT, as .prj files have it. The caller frees it; NULL: not possible. */
char *crs_wkt(const char *crs);

#ifdef MW_GDAL

/* The system of a text, for GDAL, with or without heights; NULL: it names none. Release it with
 * OSRRelease. */
OGRSpatialReferenceH crs_parse(const gdal_functions *gdal, const char *crs, bool heights);

/* A system as WKT, which the caller frees; NULL: not possible. */
char *crs_export(const gdal_functions *gdal, OGRSpatialReferenceH system);

/* The system of a layer as WKT, which the caller frees; NULL: not known. */
char *crs_of_layer(GDALDatasetH set, OGRLayerH layer);

#endif

#endif
