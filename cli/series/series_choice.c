#include "cli/series/series_choice.h"
#include "cli/frame/message.h"
#include "cli/frame/text.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static const char nearest[] = "nearest:";

/* A step, as a number from 0. Returns what follows it; NULL if there is none. */
static const char *step_parse(const char *digits, size_t *step)
{
    char *end;
    if (*digits < '0' || *digits > '9') return NULL;
    *step = strtoull(digits, &end, 10);
    return end;
}

/* FIRST..LAST or N. */
static bool steps_parse(const char *time, size_t *first, size_t *last)
{
    const char *end = step_parse(time, first);
    *last = *first;
    if (end && strncmp(end, "..", 2) == 0) end = step_parse(end + 2, last);
    return end && *end == 0;
}

static bool instant_parse(const char *time, double *instant)
{
    char *end;
    if (strncmp(time, nearest, strlen(nearest))) return false;
    time += strlen(nearest);
    *instant = strtod(time, &end);
    return end > time && *end == 0 && isfinite(*instant);
}

int series_check_time(const char *time)
{
    size_t first, last;
    double instant;
    if (strcmp(time, "all") == 0 || instant_parse(time, &instant)) return 0;
    if (steps_parse(time, &first, &last) && first <= last) return 0;
    complain(
        "option '--time' must be all, FIRST..LAST or N (steps, from 0), or nearest:T, not '%s'",
        time);
    return END_USAGE;
}

static size_t choice_nearest(const mw_series_info *info, double instant)
{
    size_t best = 0;
    for (size_t i = 1; i < info->step_count; i++)
        if (fabs(info->times[i] - instant) < fabs(info->times[best] - instant)) best = i;
    return best;
}

static int choice_find_steps(series_choice *c, const char *time)
{
    double instant;
    if (c->info->step_count == 0) {
        complain("%s: has no times", c->path);
        return END_INPUT;
    }
    c->first = 0;
    c->last = c->info->step_count - 1;
    if (!time || strcmp(time, "all") == 0) return 0;
    if (instant_parse(time, &instant))
        c->first = c->last = choice_nearest(c->info, instant);
    else
        steps_parse(time, &c->first, &c->last);
    if (c->last < c->info->step_count) return 0;
    complain("%s: has %zu step%s, from 0: there is no step %zu", c->path, c->info->step_count,
             c->info->step_count == 1 ? "" : "s", c->last);
    return END_INPUT;
}

static int choice_fail_field(const series_choice *c, const char *name, size_t length)
{
    text names = {0};
    for (size_t i = 0; i < c->info->field_count; i++)
        text_printf(&names, " %s", c->info->fields[i].name);
    complain("%s: has no field '%.*s' over time; --field may be of:%.*s", c->path, (int)length,
             name, (int)names.size, names.bytes ? names.bytes : "");
    text_release(&names);
    return END_INPUT;
}

/* A field by its name, or all layers of a variable: temp is temp:0, temp:1 ... Returns how many. */
static size_t choice_add_named(series_choice *c, const char *name, size_t length)
{
    size_t found = 0;
    for (size_t i = 0; i < c->info->field_count; i++) {
        const char *there = c->info->fields[i].name;
        if (strncmp(there, name, length) || (there[length] && there[length] != ':')) continue;
        c->field[c->field_count++] = i;
        found++;
    }
    return found;
}

static int choice_find_fields(series_choice *c, const char *names)
{
    size_t room = c->info->field_count;
    for (const char *s = names ? names : ""; *s; s++) room += *s == ',' ? c->info->field_count : 0;
    c->field = malloc(room * sizeof *c->field + 1);
    if (!c->field) return fail_memory();
    for (size_t i = 0; i < c->info->field_count && !names; i++)
        if (!c->info->fields[i].constant) c->field[c->field_count++] = i;
    while (names && *names) {
        const size_t length = strcspn(names, ",");
        if (choice_add_named(c, names, length) == 0) return choice_fail_field(c, names, length);
        names += length + (names[length] == ',');
    }
    if (c->field_count) return 0;
    complain("%s: has no field over time", c->path);
    return END_INPUT;
}

int series_choose(series_choice *c, const series_request *request, size_t vertices, size_t faces)
{
    mw_error error;
    *c = (series_choice){.path = request->mesh};
    mw_series_options options = {.layout = request->layout};
    if (request->path) {
        if (!series_paths_split(&c->files, request->path)) return fail_memory();
        c->path = c->files.paths[0];
        options.more_paths = c->files.paths + 1;
        options.more_count = c->files.count - 1;
    }
    if (request->path) options.vertex_count = vertices;
    if (request->path) options.face_count = faces;
    if (mw_series_open(c->path, &options, &c->series, &error) != MW_OK) return fail_reading(&error);
    c->info = mw_series_describe(c->series);
    int end = choice_find_steps(c, request->time);
    if (end == 0) end = choice_find_fields(c, request->fields);
    for (size_t k = 0; k < c->field_count && end == 0; k++) {
        const mw_series_field *f = series_field(c, k);
        const size_t want = f->location == MW_SERIES_FACE ? faces : vertices;
        if (f->value_count == want) continue;
        complain("%s: field %s has %zu values, not %zu as the mesh %s has %s", c->path, f->name,
                 f->value_count, want, request->mesh,
                 f->location == MW_SERIES_FACE ? "faces" : "vertices");
        end = END_INPUT;
    }
    return end;
}

void series_close(series_choice *c)
{
    mw_series_close(c->series);
    series_paths_release(&c->files);
    free(c->field);
}
