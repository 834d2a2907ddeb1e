/* Values over time in Selafin: every variable at every time. */
#include "io/grid/selafin.h"
#include "io/series/step_series.h"

#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* A piece of a name, 16 characters, without the blanks at its end. */
static void selafin_piece(const char *text, char piece[17])
{
    size_t length = 16;
    while (length > 0 && text[length - 1] == ' ') length--;
    memcpy(piece, text, length);
    piece[length] = 0;
}

/* Units stand in capitals there, "M/S": those of metres, seconds and kilograms become as all others
 * write them, "m/s". */
static void selafin_lower_unit(char *unit)
{
    for (const char *c = unit; *c; c++)
        if (!strchr("MSKG/0123456789.- ", *c)) return;
    for (char *c = unit; *c; c++)
        if (strchr("MSKG", *c)) *c = (char)(*c - 'A' + 'a');
}

static mw_status selafin_add_to_part(const mw_selafin *s, mw_series_part *part, mw_error *error)
{
    mw_status status = MW_OK;
    char unit[80] = "seconds";
    for (size_t f = 0; !status && f < s->field_count; f++) {
        char name[17], field_unit[17];
        selafin_piece(s->names[f], name);
        selafin_piece(s->names[f] + 16, field_unit);
        selafin_lower_unit(field_unit);
        status = mw__series_part_add(part,
                                     (mw_series_field){.name = name,
                                                       .unit = field_unit,
                                                       .location = MW_SERIES_VERTEX,
                                                       .value_count = (size_t)s->vertices},
                                     error);
    }
    const int64_t *d = s->date;
    if (s->parameters[9] == 1)
        snprintf(unit, sizeof unit, "seconds since %04d-%02d-%02d %02d:%02d:%02d",
                 (int)d[0] % 10000, (int)d[1] % 100, (int)d[2] % 100, (int)d[3] % 100,
                 (int)d[4] % 100, (int)d[5] % 100);
    part->time_unit = strdup(unit);
    return !status && !part->time_unit ? mw__fail_memory(error) : status;
}

/* A record whose length is not asked for is passed over. */
static mw_status selafin_pass_over(mw_selafin *s, const char *what, uint64_t *length,
                                   mw_error *error)
{
    mw_status status = mw__selafin_record(s, SIZE_MAX, what, length, error);
    if (!status) status = mw__source_skip(s->source, *length, error);
    return status ? status : mw__selafin_record_end(s, *length, error);
}

static mw_status selafin_start(void *state, mw_source *source, const mw_series_options *options,
                               mw_series_part *part, mw_error *error)
{
    mw_selafin *s = state;
    uint64_t length;
    mw_status status = mw__selafin_start(s, source, error);
    if (!status)
        status = mw__step_series_check(source, (size_t)s->vertices, options->vertex_count,
                                       "vertices", error);
    if (!status) status = selafin_pass_over(s, "elements", &length, error);
    if (!status) status = selafin_pass_over(s, "border", &length, error);
    if (!status) status = selafin_pass_over(s, "x", &length, error);
    if (!status) s->real = length == 8 * (uint64_t)s->vertices ? 8 : 4;
    if (!status) status = selafin_pass_over(s, "y", &length, error);
    return !status && part ? selafin_add_to_part(s, part, error) : status;
}

static mw_status selafin_step(void *state, double *time, bool *ended, double *values,
                              mw_error *error)
{
    mw_selafin *s = state;
    mw_status status = mw__selafin_time(s, time, ended, error);
    for (size_t f = 0; !status && !*ended && f < s->field_count; f++)
        status =
            values ? mw__selafin_values(s, s->names[f], values + f * (size_t)s->vertices, 1, error)
                   : mw__selafin_skip(s, error);
    return status;
}

static void selafin_stop(void *state)
{
    mw__selafin_release(state);
}

static const mw_step_format selafin_format = {sizeof(mw_selafin), selafin_start, selafin_step,
                                              selafin_stop};

static bool selafin_series_is(const char *path, const char *head, size_t size)
{
    (void)path;
    return mw__is_selafin(head, size);
}

static mw_status selafin_series_open(mw_source *source, const mw_series_options *options,
                                     mw_series_part *part, mw_error *error)
{
    return mw__step_series_open(&selafin_format, source, options, part, error);
}

const mw_series_kind mw__selafin_series = {selafin_series_is, selafin_series_open,
                                           mw__step_series_read, mw__step_series_close};
