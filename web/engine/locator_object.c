/* locator_object.c - points located in a mesh of the plane, and walks followed step by step. */
#include "engine/mesh_object.h"

#include <stdlib.h>
#include <string.h>

/* web/js/locator.js reads locations by these places. */
_Static_assert(sizeof(mw_location) == 40 && offsetof(mw_location, triangle) == 24 &&
                   offsetof(mw_location, where) == 32,
               "locations as JavaScript reads them");

/* How to answer, as JavaScript says it. */
typedef struct web_query {
    mw_query_options options;
    mw_index *index;
} web_query;

/* fill: 0 as the library chooses, 1 filled, 2 open. */
mw_locator *WEB_EXPORT(web_locator_make)(web_mesh *m, int any, int border, int fill)
{
    mw_locator *locator;
    mw_locator_options options = {.any = any, .border = border, .fill = (mw_fill_mode)fill};
    mw_mesh *mesh = web_mesh_planar(m);
    if (!mesh || mw_locator_create(mesh, &options, &locator, &web_error) != MW_OK) return NULL;
    return locator;
}

void WEB_EXPORT(web_locator_free)(mw_locator *locator)
{
    mw_locator_destroy(locator);
}

size_t WEB_EXPORT(web_locator_bytes)(const mw_locator *locator)
{
    mw_locator_info info;
    mw_locator_describe(locator, &info);
    return info.bytes;
}

/* The promise that does not hold, or NULL. */
const char *WEB_EXPORT(web_locator_void_promise)(const mw_locator *locator)
{
    return mw_locator_void_promise(locator);
}

/* --- queries ---------------------------------------------------------------------------------- */

static int query_begin(web_query *q, const mw_locator *locator, int walk, int start, double seed,
                       double tolerance)
{
    *q = (web_query){.options = {.walk = (mw_walk_kind)walk,
                                 .start = (mw_start_kind)start,
                                 .seed = (uint64_t)seed,
                                 .tolerance = tolerance,
                                 .counters = 1}};
    if (!mw_start_has_index(q->options.start)) return 1;
    if (mw_index_create(locator, q->options.start, NULL, &q->index, &web_error) != MW_OK) return 0;
    q->options.index = q->index;
    return 1;
}

/* Points x, y. Returns 0 on failure. */
int WEB_EXPORT(web_locate)(const mw_locator *locator, const double *points, size_t n, int walk,
                           int start, double seed, double tolerance, mw_location *locations)
{
    web_query q;
    if (!query_begin(&q, locator, walk, start, seed, tolerance)) return 0;
    q.options.counters = 0;
    mw_status status =
        mw_locate_batch(locator, points, n, 2, &q.options, locations, NULL, &web_error);
    mw_index_destroy(q.index);
    return status == MW_OK;
}

/* Values at locations, by a field of the vertices. */
void WEB_EXPORT(web_interpolate)(web_mesh *m, const double *values, const mw_location *locations,
                                 size_t n, double *result)
{
    mw_interpolate(m->mesh, values, locations, n, result);
}

int WEB_EXPORT(web_nearest_border)(const mw_locator *locator, double x, double y, double *nearest)
{
    mw_nearest_border_point at;
    if (mw_nearest_border(locator, x, y, &at, &web_error) != MW_OK) return 0;
    const double all[] = {at.triangle, at.edge, at.distance, at.point[0], at.point[1]};
    memcpy(nearest, all, sizeof all);
    return 1;
}

/* --- one walk --------------------------------------------------------------------------------- */

/* A walk as it was: JavaScript reads it by web_walk_part. */
typedef struct web_walk {
    mw_walk_way way;
    size_t count;
    mw_location location;
    double counters[WEB_COUNTERS];
    double line[7]; /* its points; their number */
} web_walk;

void WEB_EXPORT(web_walk_free)(web_walk *w)
{
    if (!w) return;
    free(w->way.triangles);
    free(w->way.stages);
    free(w);
}

static int walk_room(web_walk *w, size_t count)
{
    free(w->way.triangles);
    free(w->way.stages);
    w->way.triangles = malloc((count ? count : 1) * sizeof *w->way.triangles);
    w->way.stages = malloc(count ? count : 1);
    w->way.capacity = count;
    return w->way.triangles && w->way.stages;
}

static void walk_count(web_walk *w, const mw_counters *c)
{
    web_count(c, w->counters);
    memcpy(w->line, w->way.line, 6 * sizeof(double));
    w->line[6] = w->way.line_points;
}

/* A first pass counts the triangles, a second one keeps them: both begin with the same cursor. */
static int walk_record(web_walk *w, const mw_locator *locator, const mw_cursor *begin, double x,
                       double y)
{
    mw_cursor cursor;
    do {
        if (!walk_room(w, w->count)) return 0;
        cursor = *begin;
        memset(&cursor.counters, 0, sizeof cursor.counters);
        w->count = mw_walk_follow(locator, &cursor, x, y, &w->way, &w->location);
    } while (w->count > w->way.capacity);
    walk_count(w, &cursor.counters);
    return 1;
}

/* A walk from the triangle of one point to another point. NULL on failure. */
web_walk *WEB_EXPORT(web_walk_make)(const mw_locator *locator, int walk, double seed, double from_x,
                                    double from_y, double x, double y)
{
    mw_cursor cursor;
    web_query q;
    if (!query_begin(&q, locator, walk, MW_START_LAST, seed, 0)) return NULL;
    if (mw_cursor_init(locator, &q.options, &cursor, &web_error) != MW_OK) return NULL;
    mw_locate(locator, &cursor, from_x, from_y);
    web_walk *w = calloc(1, sizeof *w);
    if (w && walk_record(w, locator, &cursor, x, y)) return w;
    web_walk_free(w);
    return NULL;
}

size_t WEB_EXPORT(web_walk_count)(const web_walk *w)
{
    return w->count;
}

/* 0 triangles, 1 stages, 2 the location, 3 the counters, 4 the line. */
const void *WEB_EXPORT(web_walk_part)(const web_walk *w, int part)
{
    const void *const parts[] = {w->way.triangles, w->way.stages, &w->location, w->counters,
                                 w->line};
    return parts[part];
}
