#include "io/series/time_texts.h"

#include "io/netcdf/netcdf_values.h"

#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { SHORTEST = 19, LONGEST = 512 }; /* characters of "2014-01-01_06:00:00"; of a row */

typedef enum time_calendar { TIME_GREGORIAN, TIME_NO_LEAP, TIME_360_DAYS } time_calendar;

/* A date and a time of the day: year, month, day, hour, minute, second. */
enum { YEAR, MONTH, DAY, HOUR, MINUTE, SECOND, TIME_PARTS };

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
static mw_status time_find_calendar(const mw_netcdf *file, time_calendar *calendar,
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
    int found = text ? -1 : TIME_GREGORIAN;
    for (int k = 0; k < 3 && text; k++)
        if (strcmp(text, names[k][0]) == 0 || strcmp(text, names[k][1]) == 0) found = k;
    if (found < 0)
        status =
            mw__netcdf_fail(file, NULL, error, "config_calendar_type '%.80s' is not known", text);
    free(text);
    if (status) return status;
    *calendar = (time_calendar)found;
    part->calendar = strdup(names[found][2]);
    return part->calendar ? MW_OK : mw__fail_memory(error);
}

/* Digits at *text up to a separator, which is one of `ends`; -1: something else. */
static int64_t time_number(const char **text, const char *ends)
{
    int64_t value = 0;
    const char *at = *text;
    while (*at >= '0' && *at <= '9' && value < 1000000) value = 10 * value + (*at++ - '0');
    if (at == *text || !(*at ? strchr(ends, *at) != NULL : *ends == 0)) return -1;
    *text = *at ? at + 1 : at;
    return value;
}

static bool time_parse(const char *text, int64_t time[TIME_PARTS])
{
    static const char *const ends[TIME_PARTS] = {"-", "-", "_ T", ":", ":", ""};
    static const int64_t most[TIME_PARTS] = {999999, 12, 31, 24, 59, 60};
    for (int k = 0; k < TIME_PARTS; k++) {
        time[k] = time_number(&text, ends[k]);
        if (time[k] < 0 || time[k] > most[k]) return false;
    }
    return time[MONTH] > 0 && time[DAY] > 0;
}

/* Days since the first of March of the year 0; of calendars with leap years, the Gregorian. */
static int64_t time_days(const int64_t time[TIME_PARTS], time_calendar calendar)
{
    static const int before[] = {0, 31, 61, 92, 122, 153, 184, 214, 245, 275, 306, 337};
    if (calendar == TIME_360_DAYS) return 360 * time[YEAR] + 30 * (time[MONTH] - 1) + time[DAY] - 1;
    const int64_t year = time[YEAR] - (time[MONTH] < 3), month = (time[MONTH] + 9) % 12;
    const int64_t leap = year >= 0 ? year / 4 - year / 100 + year / 400 : -1;
    return 365 * year + (calendar == TIME_GREGORIAN ? leap : 0) + before[month] + time[DAY] - 1;
}

static double time_seconds(const int64_t time[TIME_PARTS], time_calendar calendar)
{
    return 86400.0 * (double)time_days(time, calendar) +
           (double)(3600 * time[HOUR] + 60 * time[MINUTE] + time[SECOND]);
}

/* One row, without the blanks that follow. */
static mw_status time_read_row(const mw_netcdf *file, const mw_netcdf_variable *texts, size_t step,
                               int64_t time[TIME_PARTS], mw_error *error)
{
    char row[LONGEST + 1];
    const size_t starts[] = {step, 0}, counts[] = {1, texts->lengths[1]};
    mw_status status = mw__netcdf_characters(file, texts, starts, counts, row, error);
    if (status) return status;
    size_t length = counts[1];
    row[length] = 0;
    length = strlen(row);
    while (length > 0 && row[length - 1] == ' ') row[--length] = 0;
    if (time_parse(row, time)) return MW_OK;
    return mw__netcdf_fail(file, texts, error,
                           "step %zu: '%.40s' is not a time such as "
                           "2014-01-01_06:00:00",
                           step, row);
}

mw_status mw__time_texts_read(const mw_netcdf *file, const mw_netcdf_variable *texts,
                              mw_series_part *part, mw_error *error)
{
    time_calendar calendar = TIME_GREGORIAN;
    int64_t first[TIME_PARTS] = {0}, time[TIME_PARTS];
    char unit[96];
    mw_status status = mw__netcdf_check_size(file, texts, error);
    if (!status) status = time_find_calendar(file, &calendar, part, error);
    for (size_t step = 0; step < part->step_count && !status; step++) {
        status = time_read_row(file, texts, step, step == 0 ? first : time, error);
        part->times[step] =
            status || step == 0 ? 0 : time_seconds(time, calendar) - time_seconds(first, calendar);
    }
    if (status) return status;
    snprintf(unit, sizeof unit,
             "seconds since %04" PRId64 "-%02" PRId64 "-%02" PRId64 " %02" PRId64 ":%02" PRId64
             ":%02" PRId64,
             first[YEAR], first[MONTH], first[DAY], first[HOUR], first[MINUTE], first[SECOND]);
    part->time_unit = strdup(unit);
    return part->time_unit ? MW_OK : mw__fail_memory(error);
}
