/* vector_formats.h - the vector formats that answers are written in, chosen by the ending of a
 * name: those that GDAL writes feature by feature, and that keep every column and position. Why
 * others are refused says files_check_text_output. */
#ifndef MW_CLI_GDAL_VECTOR_FORMATS_H
#define MW_CLI_GDAL_VECTOR_FORMATS_H

#include <stdbool.h>
#include <stddef.h>

typedef struct vector_format {
    const char *ending, *driver; /* of GDAL */
    const char *create;          /* an option of the file; NULL: none */
    const char *options[3];      /* options of its layer, ended by NULL */
    const char *points, *lines;  /* the name of the layer; NULL: that of the file */
    bool shapefile;
    bool geometry_needed; /* every row needs a geometry */
    bool lonlat_meant;    /* without a system, it means longitudes and latitudes */
    bool lonlat_only;     /* and GDAL does not transform coordinates to these */
    bool rare;            /* many builds of GDAL lack it */
} vector_format;

/* The format of a name; NULL: it is none of them. */
const vector_format *vector_format_of(const char *path);

/* All formats. Returns how many. */
size_t vector_formats_list(const vector_format **list);

#endif
