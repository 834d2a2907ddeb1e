#include "io/series/time_dates.h"
#include "base/posix.h"

#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

enum { DAY = 86400 };

/* --- text ------------------------------------------------------------------------------------- */

/* Digits at *text, which is moved behind them; -1: there are none, or the number is too large. */
static int64_t date_number(const char **text, int64_t most)
{
    int64_t value = 0;
    const char *at = *text;
    while (*at >= '0' && *at <= '9' && value <= most) value = 10 * value + (*at++ - '0');
    if (at == *text || value > most) return -1;
    *text = at;
    return value;
}

/* A number of at least `least`, behind one of the characters `before`, if that is not NULL. */
static bool date_piece(const char **text, const char *before, int64_t least, int64_t most,
                       int64_t *value)
{
    if (before && (!**text || !strchr(before, *(*text)++))) return false;
    *value = date_number(text, most);
    return *value >= least;
}

/* What may follow ".", digits of a second. */
static double date_fraction(const char **text)
{
    double value = 0, place = 1;
    if (**text != '.') return 0;
    for (++*text; **text >= '0' && **text <= '9'; ++*text) {
        place /= 10;
        value += place * (**text - '0');
    }
    return value;
}

static bool date_ends(const char *text)
{
    static const char *const zones[] = {"Z", "UTC", "GMT", "+00:00", "+0000", "+00", "-0:00"};
    text += strspn(text, " ");
    for (size_t k = 0; k < sizeof zones / sizeof *zones; k++)
        if (strncasecmp(text, zones[k], strlen(zones[k])) == 0) {
            text += strlen(zones[k]);
            break;
        }
    return text[strspn(text, " ")] == 0;
}

bool mw__date_parse(const char *text, mw_date *date)
{
    int64_t second = 0;
    *date = (mw_date){0};
    if (!date_piece(&text, NULL, 0, 999999, &date->year) ||
        !date_piece(&text, "-", 1, 12, &date->month) || !date_piece(&text, "-", 1, 31, &date->day))
        return false;
    if (date_ends(text)) return true;
    if (!date_piece(&text, "_ T", 0, 24, &date->hour) ||
        !date_piece(&text, ":", 0, 59, &date->minute))
        return false;
    if (*text == ':' && !date_piece(&text, ":", 0, 60, &second)) return false;
    date->second = (double)second + date_fraction(&text);
    return date_ends(text);
}

void mw__date_unit(const char *unit, const mw_date *date, char text[MW_TIME_UNIT])
{
    snprintf(text, MW_TIME_UNIT,
             "%.20s since %04" PRId64 "-%02" PRId64 "-%02" PRId64 " %02" PRId64 ":%02" PRId64
             ":%02d",
             unit, date->year, date->month, date->day, date->hour, date->minute, (int)date->second);
}

bool mw__time_unit_parse(const char *unit, double *seconds, mw_date *since)
{
    static const struct {
        const char *names;
        double seconds;
    } units[] = {{" s sec secs second seconds ", 1},
                 {" min mins minute minutes ", 60},
                 {" h hr hrs hour hours ", 3600},
                 {" d day days ", DAY}};
    static const char between[] = " since ";
    char word[16];
    const char *at = strstr(unit, between);
    if (!at || at == unit || (size_t)(at - unit) + 3 > sizeof word || strchr(unit, ' ') != at)
        return false;
    snprintf(word, sizeof word, " %.*s ", (int)(at - unit), unit);
    *seconds = 0;
    for (size_t k = 0; k < sizeof units / sizeof *units; k++)
        if (strstr(units[k].names, word)) *seconds = units[k].seconds;
    return *seconds > 0 && mw__date_parse(at + strlen(between), since);
}

bool mw__calendar_find(const char *name, mw_calendar *calendar)
{
    static const struct {
        const char *name;
        mw_calendar calendar;
    } names[] = {{"", MW_GREGORIAN},          {"standard", MW_GREGORIAN},
                 {"gregorian", MW_GREGORIAN}, {"proleptic_gregorian", MW_GREGORIAN},
                 {"noleap", MW_NO_LEAP},      {"365_day", MW_NO_LEAP},
                 {"360_day", MW_360_DAYS}};
    for (size_t k = 0; k < sizeof names / sizeof *names; k++) {
        if (strcasecmp(name ? name : "", names[k].name) != 0) continue;
        *calendar = names[k].calendar;
        return true;
    }
    return false;
}

/* --- days ------------------------------------------------------------------------------------- */

int64_t mw__date_days(const mw_date *date, mw_calendar calendar)
{
    static const int before[] = {0, 31, 61, 92, 122, 153, 184, 214, 245, 275, 306, 337};
    if (calendar == MW_360_DAYS) return 360 * date->year + 30 * (date->month - 1) + date->day - 1;
    const int64_t year = date->year - (date->month < 3), month = (date->month + 9) % 12;
    const int64_t leap = year >= 0 ? year / 4 - year / 100 + year / 400 : -1;
    return 365 * year + (calendar == MW_GREGORIAN ? leap : 0) + before[month] + date->day - 1;
}

bool mw__date_exists(const mw_date *date, mw_calendar calendar)
{
    const bool last = date->month == 12;
    const mw_date first = {.year = date->year, .month = date->month, .day = 1},
                  next = {.year = date->year + last, .month = last ? 1 : date->month + 1, .day = 1};
    return date->day <= mw__date_days(&next, calendar) - mw__date_days(&first, calendar);
}

double mw__date_seconds(const mw_date *date, mw_calendar calendar)
{
    return (double)(DAY * mw__date_days(date, calendar) + 3600 * date->hour + 60 * date->minute) +
           date->second;
}

/* The date of a day since the first of March of the year 0: the year by its mean length, and one
 * less if it begins later. */
static mw_date date_of_day(int64_t day)
{
    mw_date date = {.year = day / 365 + 1, .month = 3, .day = 1};
    while (mw__date_days(&date, MW_GREGORIAN) > day) date.year--;
    int64_t left = day - mw__date_days(&date, MW_GREGORIAN);
    for (; date.month < 14; date.month++) {
        const mw_date next = {.year = date.year + (date.month >= 12),
                              .month = date.month % 12 + 1,
                              .day = 1},
                      now = {.year = date.year + (date.month > 12),
                             .month = (date.month - 1) % 12 + 1,
                             .day = 1};
        const int64_t length =
            mw__date_days(&next, MW_GREGORIAN) - mw__date_days(&now, MW_GREGORIAN);
        if (left < length) break;
        left -= length;
    }
    date.year += date.month > 12;
    date.month = (date.month - 1) % 12 + 1;
    date.day = left + 1;
    return date;
}

mw_date mw__date_after_1970(int64_t seconds)
{
    static const mw_date epoch = {.year = 1970, .month = 1, .day = 1};
    const int64_t all = DAY * mw__date_days(&epoch, MW_GREGORIAN) + seconds, rest = all % DAY;
    mw_date date = date_of_day(all / DAY);
    date.hour = rest / 3600;
    date.minute = rest / 60 % 60;
    date.second = (double)(rest % 60);
    return date;
}
