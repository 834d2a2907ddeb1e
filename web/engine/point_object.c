/* point_object.c - points of a file: tables of text, LAS. */
#include "engine/engine.h"

#include <stdbool.h>
#include <stdlib.h>

typedef struct web_points {
    mw_point_reader *reader;
    double *values;
    size_t width, count, room;
} web_points;

void WEB_EXPORT(web_points_free)(web_points *p)
{
    if (!p) return;
    mw_point_reader_close(p->reader);
    free(p->values);
    free(p);
}

static bool points_grow(web_points *p)
{
    size_t room = p->room ? 2 * p->room : 4096;
    double *more = realloc(p->values, room * p->width * sizeof *more);
    if (!more) return false;
    p->values = more;
    p->room = room;
    return true;
}

static bool points_read(web_points *p)
{
    for (size_t count = 1; count > 0; p->count += count) {
        if (p->count == p->room && !points_grow(p)) return false;
        if (mw_point_reader_read(p->reader, p->values + p->count * p->width, p->room - p->count,
                                 &count, &web_error) != MW_OK)
            return false;
    }
    return true;
}

web_points *WEB_EXPORT(web_points_read)(const char *path)
{
    web_points *p = calloc(1, sizeof *p);
    mw_point_reader_options options = {.texts = 1};
    web_error = (mw_error){MW_ERROR_MEMORY, -1, -1, -1, "there is not enough memory"};
    if (p && mw_point_reader_open(path, &options, &p->reader, &web_error) == MW_OK) {
        p->width = mw_point_reader_width(p->reader);
        if (points_read(p)) return p;
    }
    web_points_free(p);
    return NULL;
}

size_t WEB_EXPORT(web_points_count)(const web_points *p)
{
    return p->count;
}

size_t WEB_EXPORT(web_points_width)(const web_points *p)
{
    return p->width;
}

const double *WEB_EXPORT(web_points_values)(const web_points *p)
{
    return p->values;
}

const char *WEB_EXPORT(web_points_column)(const web_points *p, size_t column)
{
    return mw_point_reader_column(p->reader, column);
}

/* Does a column's name mean coordinate `axis` (0 x, 1 y, 2 z) by a set of names? 1 or 0; -1 beyond
 * the last set. */
int WEB_EXPORT(web_axis_match)(const char *column, size_t set, int axis)
{
    const mw_axis_names *names = mw_axis_names_at(set);
    return names ? mw_axis_name_matches(column, names->axis[axis]) : -1;
}
