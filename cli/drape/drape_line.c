#include "cli/drape/drape_line.h"
#include "cli/frame/message.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

typedef struct drape_place {
    double at[3];
    bool on; /* the line goes on over the mesh */
} drape_place;

static bool drape_add(drape_line *line, const drape_place *place)
{
    if (line->count == line->room) {
        size_t room = 2 * line->room + 64;
        double *points = realloc(line->points, 3 * room * sizeof *points);
        if (points) line->points = points;
        bool *on = realloc(line->on, room * sizeof *on);
        if (on) line->on = on;
        if (!points || !on) return false;
        line->room = room;
    }
    memcpy(line->points + 3 * line->count, place->at, sizeof place->at);
    line->on[line->count++] = place->on;
    return true;
}

/* Replace the last point, if there is one at the same place: the later point has more information.
 */
static bool drape_add_once(drape_line *line, const drape_place *place)
{
    double *last = line->count ? line->points + 3 * (line->count - 1) : NULL;
    if (!last || last[0] != place->at[0] || last[1] != place->at[1]) return drape_add(line, place);
    if (!isnan(place->at[2])) last[2] = place->at[2];
    line->on[line->count - 1] = place->on;
    return true;
}

/* Where a piece begins or ends, with its height. */
static drape_place drape_place_of(const mw_mesh *mesh, const double *values, const double *a,
                                  const double *b, const mw_segment_piece *piece, int end)
{
    drape_place place = {.at = {0}};
    double weight[3];
    uint32_t v[3];
    mw_segment_weights(mesh, a, b, piece, end, weight, place.at);
    mw_mesh_triangle(mesh, piece->triangle, v);
    for (int k = 0; k < 3; k++)
        if (weight[k] != 0) place.at[2] += weight[k] * values[v[k]];
    return place;
}

/* Lay the segment from a to b, without its end, which is the beginning of the next segment. */
static bool drape_segment(drape_line *line, const mw_mesh *mesh, const double *values,
                          mw_segment *s, const double *a, const double *b)
{
    mw_segment_piece piece;
    drape_place begin = {.at = {a[0], a[1], NAN}}, end = {.at = {b[0], b[1], NAN}};
    bool good = drape_add_once(line, &begin);
    while (good && mw_segment_next(s, &piece)) {
        drape_place from = drape_place_of(mesh, values, a, b, &piece, 0),
                    to = drape_place_of(mesh, values, a, b, &piece, 1);
        if (isnan(from.at[2]) || isnan(to.at[2])) continue;
        from.on = true;
        good = drape_add_once(line, &from) && drape_add_once(line, &to);
    }
    return good && drape_add_once(line, &end);
}

static void drape_measure(drape_line *line)
{
    line->length = line->surface = line->outside = 0;
    for (size_t i = 0; i + 1 < line->count; i++) {
        const double *a = line->points + 3 * i, *b = a + 3;
        double plane = hypot(b[0] - a[0], b[1] - a[1]);
        if (!line->on[i]) {
            line->outside += plane;
            continue;
        }
        line->length += plane;
        line->surface += hypot(plane, b[2] - a[2]);
    }
}

int drape_line_lay(drape_line *line, const mw_locator *locator, const mw_mesh *mesh,
                   const double *values, mw_cursor *cursor, const double *points, size_t count)
{
    mw_segment s;
    mw_error error;
    line->count = 0;
    for (size_t i = 0; i + 1 < count; i++) {
        const double *a = points + 2 * i, *b = a + 2;
        mw_status status = i == 0 ? mw_segment_begin(locator, cursor, a, b, &s, &error)
                                  : mw_segment_continue(&s, b, &error);
        if (status != MW_OK) return fail_query(&error);
        if (!drape_segment(line, mesh, values, &s, a, b)) return fail_memory();
    }
    drape_measure(line);
    return 0;
}

void drape_line_release(drape_line *line)
{
    free(line->points);
    free(line->on);
}
