#include "io/series/time_texts.h"

#include "io/netcdf/netcdf_values.h"
#include "io/series/time_dates.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { SHORTEST = 19, LONGEST = 512 }; /* characters of "2014-01-01_06:00:00"; of a row */

const mw_netcdf_variable *mw__time_texts_find(const mw_netcdf *file, int dimension)
{
    static const char *const names[] = {"xtime", "Times"};
    for (size_t k = 0; k < sizeof names / sizeof *names; k++) {
        const mw_netcdf_variable *texts = mw__netcdf_find(file, names[k]);
        if (texts && texts->type == MW_NETCDF_CHAR && texts->rank == 2 &&
            texts->dimensions[0] == dimension && texts->lengths[1] >= SHORTEST &&
            texts->lengths[1] <= LONGEST)
            return texts;
    }
    return NULL;
}

/* MPAS has names of its own for the calendars of CF; without one it is the Gregorian, which it
 * follows for all years. */
static mw_status time_find_calendar(const mw_netcdf *file, mw_calendar *calendar,
                                    mw_series_part *part, mw_error *error)
{
    static const char *const names[][3] = {
        {"gregorian", "standard", "proleptic_gregorian"},
        {"gregorian_noleap", "noleap", "noleap"},
        {"360_day", "360day", "360_day"},
    };
    char *text;
    mw_status status = mw__netcdf_text(file, NULL, "config_calendar_type", &text, error);
    if (status) return status;
    int found = text ? -1 : MW_GREGORIAN;
    for (int k = 0; k < 3 && text; k++)
        if (strcmp(text, names[k][0]) == 0 || strcmp(text, names[k][1]) == 0) found = k;
    if (found < 0)
        status =
            mw__netcdf_fail(file, NULL, error, "config_calendar_type '%.80s' is not known", text);
    free(text);
    if (status) return status;
    *calendar = (mw_calendar)found;
    part->calendar = strdup(names[found][2]);
    return part->calendar ? MW_OK : mw__fail_memory(error);
}

/* One row, without the blanks that follow. */
static mw_status time_read_row(const mw_netcdf *file, const mw_netcdf_variable *texts, size_t step,
                               mw_calendar calendar, mw_date *time, mw_error *error)
{
    char row[LONGEST + 1];
    const size_t starts[] = {step, 0}, counts[] = {1, texts->lengths[1]};
    mw_status status = mw__netcdf_characters(file, texts, starts, counts, row, error);
    if (status) return status;
    size_t length = counts[1];
    row[length] = 0;
    length = strlen(row);
    while (length > 0 && row[length - 1] == ' ') row[--length] = 0;
    if (length >= SHORTEST && mw__date_parse(row, time)) {
        if (mw__date_exists(time, calendar)) return MW_OK;
        return mw__netcdf_fail(file, texts, error,
                               "step %zu: there is no day '%.10s' in its calendar", step, row);
    }
    return mw__netcdf_fail(file, texts, error,
                           "step %zu: '%.40s' is not a time such as "
                           "2014-01-01_06:00:00",
                           step, row);
}

mw_status mw__time_texts_read(const mw_netcdf *file, const mw_netcdf_variable *texts,
                              mw_series_part *part, mw_error *error)
{
    mw_calendar calendar = MW_GREGORIAN;
    mw_date first = {0}, time;
    char unit[MW_TIME_UNIT];
    mw_status status = mw__netcdf_check_size(file, texts, error);
    if (!status) status = time_find_calendar(file, &calendar, part, error);
    for (size_t step = 0; step < part->step_count && !status; step++) {
        status = time_read_row(file, texts, step, calendar, &time, error);
        if (step == 0) {
            first = time;
            first.second = floor(first.second); /* as the unit tells it */
        }
        part->times[step] =
            status ? 0 : mw__date_seconds(&time, calendar) - mw__date_seconds(&first, calendar);
    }
    if (status) return status;
    mw__date_unit("seconds", &first, unit);
    part->time_unit = strdup(unit);
    return part->time_unit ? MW_OK : mw__fail_memory(error);
}

mw_status mw__time_texts_refine(const mw_netcdf *file, const mw_netcdf_variable *texts,
                                mw_series_part *part, mw_error *error)
{
    double unit;
    mw_date since, time;
    mw_calendar calendar;
    if (!part->time_unit || !mw__time_unit_parse(part->time_unit, &unit, &since) ||
        !mw__calendar_find(part->calendar, &calendar))
        return MW_OK;
    double *exact = mw__alloc(part->step_count, sizeof *exact);
    if (!exact) return mw__fail_memory(error);
    bool same = true;
    for (size_t step = 0; step < part->step_count && same; step++) {
        same = time_read_row(file, texts, step, calendar, &time, NULL) == MW_OK;
        if (!same) break;
        exact[step] =
            (mw__date_seconds(&time, calendar) - mw__date_seconds(&since, calendar)) / unit;
        same = fabs(exact[step] - part->times[step]) <= FLT_EPSILON * fabs(exact[step]);
    }
    if (same) memcpy(part->times, exact, part->step_count * sizeof *exact);
    free(exact);
    return MW_OK;
}
