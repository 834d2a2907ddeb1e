/* series_kind.h - the kinds of files that hold values over time: the functions behind mw_series.
 * Private.
 *
 * A new kind is one file with these functions, and one row in series.c. */
#ifndef MW_SRC_IO_SERIES_SERIES_KIND_H
#define MW_SRC_IO_SERIES_SERIES_KIND_H

#include "io/text/byte_source.h"

#include <meshwalk/series.h>

/* What one file holds. Everything is released by mw__series_part_release. */
typedef struct mw_series_part {
    const struct mw_series_kind *kind;
    void *content; /* the kind's own; NULL: nothing to close */
    size_t step_count;
    double *times;
    char *time_unit, *calendar; /* NULL: not known */
    mw_series_field *fields;    /* their names and units are allocated */
    size_t field_count;
} mw_series_part;

typedef struct mw_series_kind {
    /* By the path and the first bytes of what is in the file. */
    bool (*is)(const char *path, const char *head, size_t size);
    /* Fill in the part, whose kind is set. `source` is at its beginning, and closed afterwards. */
    mw_status (*open)(mw_source *source, const mw_series_options *options, mw_series_part *part,
                      mw_error *error);
    /* Read field and step of the part, both of which exist. */
    mw_status (*read)(void *content, size_t field, size_t step, double *values, mw_error *error);
    void (*close)(void *content);
} mw_series_kind;

/* Add a field. Its texts are copied; NULL becomes "". */
mw_status mw__series_part_add(mw_series_part *part, mw_series_field field, mw_error *error);
void mw__series_part_release(mw_series_part *part);

extern const mw_series_kind mw__netcdf_series, mw__selafin_series, mw__adcirc_series,
    mw__sms_series;

#endif
