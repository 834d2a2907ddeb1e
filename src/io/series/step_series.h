/* step_series.h - kinds of series whose files can only be read from the beginning: a header, then
 * one step after the other. Private.
 *
 * A file is read once when it is opened, for its times. Afterwards it stays open after the step
 * that was read last, and all fields of that step are kept. To read an earlier step, reading begins
 * anew. So reading all steps in order takes one further pass, for any number of fields. */
#ifndef MW_SRC_IO_SERIES_STEP_SERIES_H
#define MW_SRC_IO_SERIES_STEP_SERIES_H

#include "io/series/series_kind.h"

/* How a format is read. A state is `size` bytes, zero at first. */
typedef struct mw_step_format {
    size_t size;
    /* Read the header. If `part` is not NULL, add the fields, the unit of time and the calendar. */
    mw_status (*start)(void *state, mw_source *source, const mw_series_options *options,
                       mw_series_part *part, mw_error *error);
    /* Read the next step: its time, and the values of all fields, one behind the other, with NaN
     * where one is missing; NULL: they are passed over. *ended tells that there is none. */
    mw_status (*step)(void *state, double *time, bool *ended, double *values, mw_error *error);
    void (*stop)(void *state); /* after start, whether that failed or not */
} mw_step_format;

mw_status mw__step_series_open(const mw_step_format *format, mw_source *source,
                               const mw_series_options *options, mw_series_part *part,
                               mw_error *error);
mw_status mw__step_series_read(void *content, size_t field, size_t step, double *values,
                               mw_error *error);
void mw__step_series_close(void *content);

/* An error if the file has values of another number of vertices (or faces) than the mesh; the mesh
 * may not be known (0). */
mw_status mw__step_series_check(const mw_source *source, size_t have, size_t wanted,
                                const char *what, mw_error *error);

#endif
