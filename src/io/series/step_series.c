#include "io/series/step_series.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

typedef struct step_content {
    const mw_step_format *format;
    char *path;
    size_t *begins; /* where the values of each field begin among those of a step */
    size_t *counts;
    size_t value_count; /* of all fields */
    void *state;
    mw_source source;
    bool reading;  /* source and state are at the beginning of step `next` */
    size_t next;   /* step */
    size_t cached; /* step that `values` holds; SIZE_MAX: none */
    double *values;
} step_content;

mw_status mw__step_series_check(const mw_source *source, size_t have, size_t wanted,
                                const char *what, mw_error *error)
{
    if (wanted == 0 || have == wanted) return MW_OK;
    return mw__source_fail(source, error, "the file has values at %zu %s, but the mesh has %zu",
                           have, what, wanted);
}

static mw_status step_series_add_time(mw_series_part *part, size_t *room, double time,
                                      const mw_source *source, mw_error *error)
{
    size_t count = part->step_count;
    if (!isfinite(time) || (count > 0 && !(time > part->times[count - 1])))
        return mw__source_fail(source, error, "time %g is not later than the time before it", time);
    if (count == *room) {
        size_t larger = count < 16 ? 16 : count + count / 2;
        double *times = mw__realloc(part->times, larger, sizeof *times);
        if (!times) return mw__fail_memory(error);
        part->times = times;
        *room = larger;
    }
    part->times[part->step_count++] = time;
    return MW_OK;
}

/* Read the file once: its header, and its times. */
static mw_status step_series_scan(step_content *c, mw_source *source,
                                  const mw_series_options *options, mw_series_part *part,
                                  mw_error *error)
{
    size_t room = 0;
    bool ended = false;
    mw_status status = c->format->start(c->state, source, options, part, error);
    while (!status && !ended) {
        double time;
        status = c->format->step(c->state, &time, &ended, NULL, error);
        if (!status && !ended) status = step_series_add_time(part, &room, time, source, error);
    }
    c->format->stop(c->state);
    if (!status && part->step_count == 0)
        status = mw__source_fail(source, error, "there are no values in this file");
    return status;
}

/* Lay out the values of a step. */
static mw_status step_series_lay_out(step_content *c, const mw_series_part *part, mw_error *error)
{
    c->begins = mw__alloc(part->field_count, sizeof *c->begins);
    c->counts = mw__alloc(part->field_count, sizeof *c->counts);
    if (!c->begins || !c->counts) return mw__fail_memory(error);
    for (size_t f = 0; f < part->field_count; f++) {
        c->begins[f] = c->value_count;
        c->counts[f] = part->fields[f].value_count;
        c->value_count += c->counts[f];
    }
    c->values = mw__alloc(c->value_count, sizeof *c->values);
    return c->values ? MW_OK : mw__fail_memory(error);
}

mw_status mw__step_series_open(const mw_step_format *format, mw_source *source,
                               const mw_series_options *options, mw_series_part *part,
                               mw_error *error)
{
    if (strcmp(source->path, "-") == 0)
        return mw__fail(error, MW_ERROR_INPUT,
                        "standard input: values of this kind are read twice, so they need a file");
    step_content *c = mw__calloc(1, sizeof *c);
    if (!c) return mw__fail_memory(error);
    part->content = c;
    *c = (step_content){.format = format,
                        .cached = SIZE_MAX,
                        .path = strdup(source->path),
                        .state = mw__calloc(1, format->size)};
    if (!c->path || !c->state) return mw__fail_memory(error);
    mw_status status = step_series_scan(c, source, options, part, error);
    return status ? status : step_series_lay_out(c, part, error);
}

static void step_series_stop(step_content *c)
{
    if (!c->reading) return;
    c->format->stop(c->state);
    mw__source_close(&c->source);
    c->reading = false;
}

static mw_status step_series_restart(step_content *c, mw_error *error)
{
    static const mw_series_options any;
    step_series_stop(c);
    memset(c->state, 0, c->format->size);
    mw_status status = mw__source_open(&c->source, c->path, error);
    if (status) return status;
    c->reading = true;
    c->next = 0;
    return c->format->start(c->state, &c->source, &any, NULL, error);
}

static mw_status step_series_go_to(step_content *c, size_t step, mw_error *error)
{
    mw_status status = c->reading && c->next <= step ? MW_OK : step_series_restart(c, error);
    c->cached = SIZE_MAX;
    while (!status) {
        double time;
        bool ended = false, last = c->next == step;
        status = c->format->step(c->state, &time, &ended, last ? c->values : NULL, error);
        if (!status && ended)
            status =
                mw__source_fail(&c->source, error, "the file is shorter than when it was opened");
        if (!status) c->next++;
        if (!status && last) c->cached = step;
        if (last) break;
    }
    if (status) step_series_stop(c);
    return status;
}

mw_status mw__step_series_read(void *content, size_t field, size_t step, double *values,
                               mw_error *error)
{
    step_content *c = content;
    mw_status status = c->cached == step ? MW_OK : step_series_go_to(c, step, error);
    if (!status) memcpy(values, c->values + c->begins[field], c->counts[field] * sizeof *values);
    return status;
}

void mw__step_series_close(void *content)
{
    step_content *c = content;
    step_series_stop(c);
    free(c->path);
    free(c->begins);
    free(c->counts);
    free(c->state);
    free(c->values);
    free(c);
}
