/* time_dates.h - dates, and the seconds between them, in the calendars of CF. Private; for this
 * room only. */
#ifndef MW_SRC_IO_SERIES_TIME_DATES_H
#define MW_SRC_IO_SERIES_TIME_DATES_H

#include "base/base.h"

typedef enum mw_calendar { MW_GREGORIAN, MW_NO_LEAP, MW_360_DAYS } mw_calendar;

/* A date and a time of the day. */
typedef struct mw_date {
    int64_t year, month, day, hour, minute;
    double second;
} mw_date;

/* Read "2014-01-01", or that with "06:00:00.5" behind a blank, "T" or "_"; what follows may be
 * blanks and "Z", "UTC" or "+0000". False: it is something else. */
bool mw__date_parse(const char *text, mw_date *date);

/* The calendar of that name; NULL and "" are the Gregorian. False: CF has it, but it is none of
 * these. */
bool mw__calendar_find(const char *name, mw_calendar *calendar);

/* Does the month of the date have its day? */
bool mw__date_exists(const mw_date *date, mw_calendar calendar);

/* Days, and seconds, since the first of March of the year 0. */
int64_t mw__date_days(const mw_date *date, mw_calendar calendar);
double mw__date_seconds(const mw_date *date, mw_calendar calendar);

/* The Gregorian date so many seconds after 1970; whole seconds only. */
mw_date mw__date_after_1970(int64_t seconds);

/* "seconds since 2014-01-01 06:00:00". */
#define MW_TIME_UNIT 96
void mw__date_unit(const char *unit, const mw_date *date, char text[MW_TIME_UNIT]);

/* A unit of CF, "days since 2013-01-01": its seconds, and what it counts from. False: it is none
 * of seconds, minutes, hours or days. */
bool mw__time_unit_parse(const char *unit, double *seconds, mw_date *since);

#endif
