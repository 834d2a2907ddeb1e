#include "io/series/netcdf_times.h"

#include "base/posix.h"
#include "io/netcdf/netcdf_values.h"
#include "io/series/time_dates.h"
#include "io/series/time_texts.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Names of time axes, of any case. */
static bool netcdf_times_named(const char *name)
{
    static const char *const names[] = {"time", "restime", "number_of_timesteps", "ocean_time"};
    for (size_t k = 0; k < sizeof names / sizeof *names; k++)
        if (strcasecmp(name, names[k]) == 0) return true;
    return false;
}

/* Does a variable of one dimension hold times: by its units, "seconds since ...", its standard
 * name, or its own? */
static bool netcdf_times_is_axis(const mw_netcdf *file, const mw_netcdf_variable *variable)
{
    char *unit = NULL, *name = NULL;
    if (variable->rank != 1 || variable->type == MW_NETCDF_CHAR ||
        variable->type >= MW_NETCDF_STRING)
        return false;
    bool is = mw__netcdf_text(file, variable, "units", &unit, NULL) == MW_OK && unit &&
              strstr(unit, " since ");
    is = is || (mw__netcdf_text(file, variable, "standard_name", &name, NULL) == MW_OK && name &&
                strcmp(name, "time") == 0);
    free(unit);
    free(name);
    return is || netcdf_times_named(variable->name);
}

/* The axis of a dimension: one that has the dimension's name comes first. NULL: none. */
static const mw_netcdf_variable *netcdf_times_axis(const mw_netcdf *file, int dimension)
{
    const mw_netcdf_variable *found =
        mw__netcdf_find(file, mw__netcdf_dimension_at(file, dimension, NULL));
    if (found && found->rank == 1 && found->dimensions[0] == dimension &&
        netcdf_times_is_axis(file, found))
        return found;
    found = NULL;
    for (size_t i = 0; i < mw__netcdf_variable_count(file) && !found; i++) {
        const mw_netcdf_variable *variable = mw__netcdf_variable_at(file, i);
        if (netcdf_times_is_axis(file, variable) && variable->dimensions[0] == dimension)
            found = variable;
    }
    return found;
}

int mw__netcdf_time_dimension(const mw_netcdf *file)
{
    int count = (int)mw__netcdf_dimension_count(file);
    for (int d = 0; d < count; d++)
        if (netcdf_times_named(mw__netcdf_dimension_at(file, d, NULL))) return d;
    for (size_t i = 0; i < mw__netcdf_variable_count(file); i++) {
        const mw_netcdf_variable *variable = mw__netcdf_variable_at(file, i);
        if (netcdf_times_is_axis(file, variable)) return variable->dimensions[0];
    }
    return -1;
}

static mw_status netcdf_times_calendar(const mw_netcdf *file, const mw_netcdf_variable *axis,
                                       mw_series_part *part, mw_error *error)
{
    static const char *const calendars[] = {"standard", "gregorian", "proleptic_gregorian",
                                            "julian",   "noleap",    "365_day",
                                            "all_leap", "366_day",   "360_day",
                                            "utc",      "tai",       "none"};
    mw_status status = mw__netcdf_text(file, axis, "calendar", &part->calendar, error);
    if (status || !part->calendar) return status;
    for (size_t k = 0; k < sizeof calendars / sizeof *calendars; k++)
        if (strcasecmp(part->calendar, calendars[k]) == 0) return MW_OK;
    return mw__netcdf_fail(file, axis, error, "the calendar '%.80s' is not one of CF",
                           part->calendar);
}

/* FVCOM writes times as floats, which tell minutes at best, and beside them whole days and
 * milliseconds, or the times as text. */
static mw_status netcdf_times_exact(const mw_netcdf *file, const mw_netcdf_variable *axis,
                                    mw_series_part *part, mw_error *error)
{
    const double milliseconds_a_day = 86400e3;
    const mw_netcdf_variable *days = mw__netcdf_find(file, "Itime");
    const mw_netcdf_variable *parts = mw__netcdf_find(file, "Itime2");
    char *unit;
    if (axis->type != MW_NETCDF_FLOAT || !days || !parts || days->rank != 1 || parts->rank != 1 ||
        days->dimensions[0] != axis->dimensions[0] || parts->dimensions[0] != axis->dimensions[0]) {
        const mw_netcdf_variable *texts =
            axis->type == MW_NETCDF_FLOAT ? mw__time_texts_find(file, axis->dimensions[0]) : NULL;
        return texts ? mw__time_texts_refine(file, texts, part, error) : MW_OK;
    }
    mw_status status = mw__netcdf_text(file, days, "units", &unit, error);
    bool same = !status && unit && part->time_unit && strcmp(unit, part->time_unit) == 0;
    free(unit);
    if (status || !same) return status;
    double *rest = mw__alloc(part->step_count, sizeof *rest);
    if (!rest) return mw__fail_memory(error);
    status = mw__netcdf_column(file, days, part->times, error);
    if (!status) status = mw__netcdf_column(file, parts, rest, error);
    for (size_t s = 0; s < part->step_count && !status; s++)
        part->times[s] += rest[s] / milliseconds_a_day;
    free(rest);
    return status;
}

/* The date of 20120131.25. False: it is none. */
static bool netcdf_times_date(double time, mw_date *date)
{
    if (!(time >= 101 && time < 1e8)) return false;
    const int64_t day = (int64_t)time;
    *date = (mw_date){.year = day / 10000, .month = day / 100 % 100, .day = day % 100};
    date->second = (time - (double)day) * 86400;
    return date->month >= 1 && date->month <= 12 && date->day >= 1 && date->day <= 31;
}

/* ICON tells dates as numbers, of which those of months do not follow one another: they become days
 * since the first. */
static mw_status netcdf_times_of_dates(const mw_netcdf *file, const mw_netcdf_variable *axis,
                                       mw_series_part *part, mw_error *error)
{
    mw_calendar calendar;
    mw_date first = {0}, date;
    char unit[MW_TIME_UNIT];
    if (!part->time_unit || strcmp(part->time_unit, "day as %Y%m%d.%f") != 0) return MW_OK;
    if (!mw__calendar_find(part->calendar, &calendar))
        return mw__netcdf_fail(file, axis, error, "dates of the calendar '%.80s' are not known",
                               part->calendar);
    for (size_t s = 0; s < part->step_count; s++) {
        if (!netcdf_times_date(part->times[s], &date))
            return mw__netcdf_fail(file, axis, error,
                                   "step %zu: %.17g is not a date such as "
                                   "20120131.25",
                                   s, part->times[s]);
        if (s == 0) first = (mw_date){.year = date.year, .month = date.month, .day = date.day};
        part->times[s] =
            (double)(mw__date_days(&date, calendar) - mw__date_days(&first, calendar)) +
            date.second / 86400;
    }
    mw__date_unit("days", &first, unit);
    free(part->time_unit);
    part->time_unit = strdup(unit);
    return part->time_unit ? MW_OK : mw__fail_memory(error);
}

/* ANUGA counts seconds from an attribute of the file, which counts them from 1970. */
static mw_status netcdf_times_of_anuga(const mw_netcdf *file, const mw_netcdf_variable *axis,
                                       mw_series_part *part, mw_error *error)
{
    double start;
    char unit[MW_TIME_UNIT] = "seconds";
    if (part->time_unit || !mw__netcdf_find(file, "volumes") || strcmp(axis->name, "time") != 0)
        return MW_OK;
    if (mw__netcdf_number(file, MW_NETCDF_FILE, "starttime", &start) && start >= 0 &&
        start < 1e11) {
        const mw_date since = mw__date_after_1970((int64_t)start);
        const double part_of_second = start - floor(start);
        mw__date_unit("seconds", &since, unit);
        for (size_t s = 0; s < part->step_count; s++) part->times[s] += part_of_second;
    }
    part->time_unit = strdup(unit);
    return part->time_unit ? MW_OK : mw__fail_memory(error);
}

static mw_status netcdf_times_check(const mw_netcdf *file, const mw_netcdf_variable *axis,
                                    const mw_series_part *part, mw_error *error)
{
    for (size_t s = 0; s < part->step_count; s++) {
        if (!isfinite(part->times[s]))
            return mw__netcdf_fail(file, axis, error, "step %zu has no time", s);
        if (s > 0 && !(part->times[s] > part->times[s - 1]))
            return mw__netcdf_fail(file, axis, error,
                                   "times do not increase: step %zu has %.17g, step %zu %.17g",
                                   s - 1, part->times[s - 1], s, part->times[s]);
    }
    return MW_OK;
}

mw_status mw__netcdf_times(const mw_netcdf *file, int dimension, mw_series_part *part,
                           mw_error *error)
{
    if (dimension < 0) return MW_OK;
    const mw_netcdf_variable *axis = netcdf_times_axis(file, dimension);
    mw_status status = axis ? mw__netcdf_check_size(file, axis, error) : MW_OK;
    if (status) return status;
    mw__netcdf_dimension_at(file, dimension, &part->step_count);
    part->times = mw__alloc(part->step_count, sizeof *part->times);
    if (!part->times) return mw__fail_memory(error);
    const mw_netcdf_variable *texts = axis ? NULL : mw__time_texts_find(file, dimension);
    if (texts) {
        status = mw__time_texts_read(file, texts, part, error);
        return status ? status : netcdf_times_check(file, texts, part, error);
    }
    for (size_t s = 0; s < part->step_count && !axis; s++) part->times[s] = (double)s;
    if (!axis) return MW_OK;
    status = mw__netcdf_text(file, axis, "units", &part->time_unit, error);
    if (!status) status = netcdf_times_calendar(file, axis, part, error);
    if (!status) status = mw__netcdf_column(file, axis, part->times, error);
    if (!status) status = netcdf_times_exact(file, axis, part, error);
    if (!status) status = netcdf_times_of_dates(file, axis, part, error);
    if (!status) status = netcdf_times_of_anuga(file, axis, part, error);
    return status ? status : netcdf_times_check(file, axis, part, error);
}
