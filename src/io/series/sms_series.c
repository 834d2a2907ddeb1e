/* Values over time of SMS beside a 2DM mesh: .dat as text (cards DATASET, BEGSCL or BEGVEC, ND, NC,
 * NAME, RT_JULIAN, TIMEUNITS, and for each time TS, perhaps a line for each element that tells
 * whether it is active, and the values) and as bytes (the same as numbers of cards, in either
 * order). Files that begin with SCALAR or VECTOR have the time alone behind TS. A file has one
 * dataset; its values belong to the faces if the name of the file contains "_els". A vector becomes
 * two fields. */
#include "base/posix.h"
#include "io/grid/value_source.h"
#include "io/series/step_series.h"
#include "io/text/number_text.h"

#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

typedef struct sms_data {
    mw_value_source values;
    int64_t vertices, faces, width;
    size_t flag_size, real_size; /* of bytes */
    bool on_faces, ended;
    bool at_step; /* the card of a time has been read */
    double julian;
    char name[64], unit[16];
} sms_data;

/* Numbers of the cards. */
enum {
    SMS_VERSION = 3000,
    SMS_OBJECT = 100,
    SMS_REAL_SIZE = 110,
    SMS_FLAG_SIZE = 120,
    SMS_SCALAR = 130,
    SMS_VECTOR = 140,
    SMS_VECTOR_TYPE = 150,
    SMS_OBJECT_ID = 160,
    SMS_VERTICES = 170,
    SMS_FACES = 180,
    SMS_NAME = 190,
    SMS_STEP = 200,
    SMS_END = 210,
    SMS_JULIAN = 240,
    SMS_TIME_UNIT = 250
};

static const mw_number_type sms_int = {MW_NUMBER_SIGNED, 4};

static mw_source *sms_source(const sms_data *d)
{
    return d->values.source;
}

/* "hours", from a word or a number: 0 hours, 1 minutes, 2 seconds, 4 days. */
static void sms_set_unit(sms_data *d, const char *word)
{
    const char *unit =
        strcasecmp(word, "se") == 0 || strncasecmp(word, "sec", 3) == 0 || strcmp(word, "2") == 0
            ? "seconds"
        : strncasecmp(word, "mi", 2) == 0 || strcmp(word, "1") == 0 ? "minutes"
        : strncasecmp(word, "d", 1) == 0 || strcmp(word, "4") == 0  ? "days"
                                                                    : "hours";
    strcpy(d->unit, unit);
}

/* --- cards as text --- */

/* The number of a card, 0 for one that does not matter. */
static int sms_card(const char *word)
{
    static const struct {
        const char *word;
        int card;
    } cards[] = {{"BEGSCL", SMS_SCALAR},      {"SCALAR", SMS_SCALAR},
                 {"BEGVEC", SMS_VECTOR},      {"VECTOR", SMS_VECTOR},
                 {"ND", SMS_VERTICES},        {"NC", SMS_FACES},
                 {"NAME", SMS_NAME},          {"TS", SMS_STEP},
                 {"ENDDS", SMS_END},          {"RT_JULIAN", SMS_JULIAN},
                 {"TIMEUNITS", SMS_TIME_UNIT}};
    for (size_t i = 0; i < sizeof cards / sizeof *cards; i++)
        if (strcasecmp(word, cards[i].word) == 0) return cards[i].card;
    return 0;
}

static void sms_take_name(sms_data *d, const char *text)
{
    while (*text == ' ' || *text == '\t' || *text == '"') text++;
    size_t length = strcspn(text, "\"");
    while (length > 0 && text[length - 1] == ' ') length--;
    if (length > sizeof d->name - 1) length = sizeof d->name - 1;
    memcpy(d->name, text, length);
    d->name[length] = 0;
}

static mw_status sms_read_text_card(sms_data *d, int *card, mw_error *error)
{
    char *word;
    mw_status status = mw__value_word(&d->values, &word, error);
    *card = SMS_END;
    if (status || !word) return status;
    *card = sms_card(word);
    if (*card == SMS_VERTICES)
        return mw__value_word_count(&d->values, "number of vertices", &d->vertices, error);
    if (*card == SMS_FACES)
        return mw__value_word_count(&d->values, "number of elements", &d->faces, error);
    if (*card == SMS_JULIAN)
        return mw__value_double(&d->values, (mw_number_type){MW_NUMBER_FLOAT, 8}, "Julian date",
                                &d->julian, error);
    if (*card == SMS_TIME_UNIT) {
        status = mw__value_word(&d->values, &word, error);
        if (!status && word) sms_set_unit(d, word);
        return status;
    }
    if (*card == SMS_STEP || *card == SMS_END) return MW_OK;
    const char *rest = mw__value_rest(&d->values);
    if (*card == SMS_NAME && rest) sms_take_name(d, rest);
    return MW_OK;
}

/* --- cards as bytes --- */

static mw_status sms_read_byte_card(sms_data *d, int *card, mw_error *error)
{
    const char *next;
    const unsigned char *bytes;
    size_t size;
    int64_t number, value = 0;
    *card = SMS_END;
    mw_status status = mw__source_peek(sms_source(d), 4, &next, &size, error);
    if (status || (size == 0 && !sms_source(d)->damage)) return status;
    status = mw__value_integer(&d->values, sms_int, "card", &number, error);
    *card = (int)number;
    if (status || number == SMS_STEP || number == SMS_END || number == SMS_SCALAR ||
        number == SMS_VECTOR || number == SMS_VERSION)
        return status;
    if (number == SMS_NAME) {
        char name[41] = "";
        status = mw__source_bytes(sms_source(d), 40, &bytes, error);
        if (!status) memcpy(name, bytes, 40);
        sms_take_name(d, name);
        return status;
    }
    if (number == SMS_JULIAN)
        return mw__value_double(&d->values, (mw_number_type){MW_NUMBER_FLOAT, 8}, "Julian date",
                                &d->julian, error);
    if (number < SMS_OBJECT || number > SMS_TIME_UNIT || number % 10)
        return mw__source_fail(sms_source(d), error, "%" PRId64 " is not a known card number",
                               number);
    status = mw__value_integer(&d->values, sms_int, "value of a card", &value, error);
    if (number == SMS_VERTICES) d->vertices = value;
    if (number == SMS_FACES) d->faces = value;
    if (number == SMS_REAL_SIZE) d->real_size = (size_t)value;
    if (number == SMS_FLAG_SIZE) d->flag_size = (size_t)value;
    char text[24];
    snprintf(text, sizeof text, "%" PRId64, value);
    if (number == SMS_TIME_UNIT) sms_set_unit(d, text);
    return status;
}

static mw_status sms_read_any_card(sms_data *d, int *card, mw_error *error)
{
    return d->values.binary ? sms_read_byte_card(d, card, error)
                            : sms_read_text_card(d, card, error);
}

/* --- the header --- */

/* Does a file begin with the card of the version, 3000, as bytes? */
static bool sms_are_bytes(const char *head, size_t size, bool *big)
{
    *big = size >= 4 && memcmp(head, "\0\0\x0b\xb8", 4) == 0;
    return *big || (size >= 4 && memcmp(head, "\xb8\x0b\0\0", 4) == 0);
}

static int64_t sms_count(const sms_data *d)
{
    return d->on_faces ? d->faces : d->vertices;
}

/* Cards up to the first time. */
static mw_status sms_read_header(sms_data *d, mw_error *error)
{
    for (;;) {
        int card;
        mw_status status = sms_read_any_card(d, &card, error);
        if (status) return status;
        if (card == SMS_SCALAR || card == SMS_VECTOR) d->width = card == SMS_VECTOR ? 2 : 1;
        if (card != SMS_STEP && card != SMS_END) continue;
        d->at_step = card == SMS_STEP;
        if (d->width == 0 || sms_count(d) < 1 || sms_count(d) > INT64_C(1) << 28)
            return mw__source_fail(sms_source(d), error,
                                   "the file announces %" PRId64 " values at each of %" PRId64
                                   " %s",
                                   d->width, sms_count(d), d->on_faces ? "elements" : "vertices");
        if (d->faces < 0 || (d->real_size != 4 && d->real_size != 8) ||
            (d->flag_size != 1 && d->flag_size != 4))
            return mw__source_fail(sms_source(d), error,
                                   "the sizes of numbers are missing or not supported");
        return MW_OK;
    }
}

/* The unit of time, since the date that a Julian date is. */
static void sms_tell_unit(const sms_data *d, char *text, size_t size)
{
    double seconds = round((d->julian - 2440587.5) * 86400);
    if (!(d->julian > 0 && fabs(seconds) < 1e11)) {
        snprintf(text, size, "%s", d->unit);
        return;
    }
    int64_t days = (int64_t)floor(seconds / 86400), rest = (int64_t)seconds - 86400 * days;
    /* years of 365.2425 days that begin in March, in eras of 400 */
    int64_t z = days + 719468, era = (z >= 0 ? z : z - 146096) / 146097, n = z - era * 146097;
    int64_t year = (n - n / 1460 + n / 36524 - n / 146096) / 365;
    int64_t day = n - (365 * year + year / 4 - year / 100), month = (5 * day + 2) / 153;
    day -= (153 * month + 2) / 5 - 1;
    month += month < 10 ? 3 : -9;
    year += era * 400 + (month <= 2);
    snprintf(text, size,
             "%s since %04" PRId64 "-%02" PRId64 "-%02" PRId64 " %02" PRId64 ":%02" PRId64
             ":%02" PRId64,
             d->unit, year, month, day, rest / 3600, rest / 60 % 60, rest % 60);
}

static mw_status sms_add_to_part(const sms_data *d, mw_series_part *part, mw_error *error)
{
    static const char *const components[] = {"_x", "_y"};
    mw_status status = MW_OK;
    char unit[160];
    for (int64_t k = 0; !status && k < d->width; k++) {
        char name[80];
        snprintf(name, sizeof name, "%s%s", *d->name ? d->name : "values",
                 d->width > 1 ? components[k] : "");
        status = mw__series_part_add(
            part,
            (mw_series_field){.name = name,
                              .location = d->on_faces ? MW_SERIES_FACE : MW_SERIES_VERTEX,
                              .value_count = (size_t)sms_count(d)},
            error);
    }
    sms_tell_unit(d, unit, sizeof unit);
    part->time_unit = strdup(unit);
    return !status && !part->time_unit ? mw__fail_memory(error) : status;
}

static mw_status sms_start(void *state, mw_source *source, const mw_series_options *options,
                           mw_series_part *part, mw_error *error)
{
    sms_data *d = state;
    const char *head, *slash = strrchr(source->path, '/');
    size_t size;
    *d = (sms_data){.values = {.source = source}, .real_size = 4, .flag_size = 4, .unit = "hours"};
    d->on_faces = strstr(slash ? slash : source->path, "_els") != NULL;
    mw_status status = mw__source_peek(source, 4, &head, &size, error);
    if (status) return status;
    d->values.binary = source->binary = sms_are_bytes(head, size, &d->values.big);
    status = sms_read_header(d, error);
    if (!status)
        status = d->on_faces ? mw__step_series_check(source, (size_t)d->faces, options->face_count,
                                                     "faces", error)
                             : mw__step_series_check(source, (size_t)d->vertices,
                                                     options->vertex_count, "vertices", error);
    return !status && part ? sms_add_to_part(d, part, error) : status;
}

/* --- steps --- */

/* Does the line have one number more? */
static bool sms_time_is_alone(const sms_data *d)
{
    const char *p = d->values.binary || !d->values.rest ? "" : mw__skip_blanks(d->values.rest);
    bool any = *p;
    while (!mw__at_gap(p)) p++;
    return any && !*mw__skip_blanks(p);
}

/* The flag that tells whether activity follows, the time, and that activity. */
static mw_status sms_read_step_head(sms_data *d, double *time, mw_error *error)
{
    mw_number_type flag = {MW_NUMBER_SIGNED, d->flag_size};
    mw_number_type real = {MW_NUMBER_FLOAT, d->real_size};
    int64_t active = 0, ignored;
    mw_status status = sms_time_is_alone(d)
                           ? MW_OK
                           : mw__value_integer(&d->values, flag, "status", &active, error);
    if (!status) status = mw__value_double(&d->values, real, "time", time, error);
    for (int64_t i = 0; !status && active && i < d->faces; i++)
        status = mw__value_integer(&d->values, flag, "activity", &ignored, error);
    return status;
}

static mw_status sms_step(void *state, double *time, bool *ended, double *values, mw_error *error)
{
    sms_data *d = state;
    mw_number_type real = {MW_NUMBER_FLOAT, d->real_size};
    mw_status status = MW_OK;
    int card = SMS_STEP;
    *ended = d->ended;
    while (!*ended && !status && !d->at_step) {
        status = sms_read_any_card(d, &card, error);
        if (!status && (card == SMS_SCALAR || card == SMS_VECTOR))
            status = mw__source_fail(sms_source(d), error, "a second dataset is not read");
        d->at_step = card == SMS_STEP;
        *ended = d->ended = card == SMS_END;
    }
    if (status || *ended) return status;
    d->at_step = false;
    status = sms_read_step_head(d, time, error);
    for (int64_t i = 0; !status && i < sms_count(d); i++)
        for (int64_t k = 0; !status && k < d->width; k++) {
            double value;
            status = mw__value_double(&d->values, real, "value", &value, error);
            if (!status && values) values[k * sms_count(d) + i] = value;
        }
    return status;
}

static void sms_stop(void *state)
{
    (void)state;
}

static const mw_step_format sms_format = {sizeof(sms_data), sms_start, sms_step, sms_stop};

static bool sms_series_is(const char *path, const char *head, size_t size)
{
    if (!mw__path_ends(path, ".dat")) return false;
    bool big;
    if (sms_are_bytes(head, size, &big)) return true;
    return size >= 7 && (memcmp(head, "DATASET", 7) == 0 || memcmp(head, "SCALAR", 6) == 0 ||
                         memcmp(head, "VECTOR", 6) == 0);
}

static mw_status sms_series_open(mw_source *source, const mw_series_options *options,
                                 mw_series_part *part, mw_error *error)
{
    return mw__step_series_open(&sms_format, source, options, part, error);
}

const mw_series_kind mw__sms_series = {sms_series_is, sms_series_open, mw__step_series_read,
                                       mw__step_series_close};
