#include "cli/drape/drape_rows.h"
#include "cli/drape/drape_line.h"
#include "cli/frame/message.h"
#include "cli/frame/progress.h"
#include "cli/output/csv_row.h"
#include "src/base/posix.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* A polygon, or a line: lines `first` .. `end` - 1 of the file are its rings. */
typedef struct drape_shape {
    size_t first, end;
    drape_line *ring; /* end - first of them */
} drape_shape;

int drape_has_polygons(const line_file *lines)
{
    size_t rings = 0;
    for (size_t i = 0; i < lines->count; i++) rings += lines->polygon[i] != MW_NONE;
    return rings == 0 ? 0 : rings == lines->count ? 1 : -1;
}

/* --- header --- */

static const char *const drape_line_names[] = {"piece", "length", "surface_length", NULL};
static const char *const drape_polygon_names[] = {"length",       "surface_length", "area",
                                                  "surface_area", "outside_area",   NULL};

static bool drape_names_have(const char *const *names, const char *name)
{
    for (; *names; names++)
        if (strcasecmp(*names, name) == 0) return true;
    return false;
}

/* An attribute whose name is that of one of our columns gets a prefix. */
static bool drape_own_name(const void *rows, const char *name)
{
    const drape *d = rows;
    static const char *const always[] = {"feature", "part", NULL}, *const point[] = {"x", "y", "z",
                                                                                     NULL};
    return drape_names_have(always, name) || (d->table && drape_names_have(point, name)) ||
           drape_names_have(d->polygons ? drape_polygon_names : drape_line_names, name);
}

bool drape_write_header(const drape *d, text *header, text *kinds)
{
    const char *const *own = d->polygons ? drape_polygon_names : drape_line_names;
    row_output_begin_header(header, kinds, &d->lines->values, drape_own_name, d);
    for (size_t i = 0; own[i]; i++) {
        text_printf(header, ",%s", own[i]);
        text_bytes(kinds, i == 0 && !d->polygons ? "i" : "r", 1);
    }
    text_string(header, d->table ? ",x,y,z\n" : "\n");
    text_string(kinds, d->table ? "rrr" : "");
    return !header->failed && !kinds->failed;
}

/* --- rows --- */

static void drape_begin_row(const drape *d, size_t line)
{
    const line_file *lines = d->lines;
    row_output_begin_row(&d->out->text, &lines->values, lines->feature[line], lines->part[line]);
}

/* Write one piece: points from .. to of a line, all with heights. */
static int drape_write_piece(drape *d, size_t line, const drape_line *ring, size_t from, size_t to,
                             uint32_t piece)
{
    double length = 0, surface = 0;
    int end = 0;
    for (size_t i = from; i < to; i++) {
        const double *a = ring->points + 3 * i, *b = a + 3;
        double plane = hypot(b[0] - a[0], b[1] - a[1]);
        length += plane;
        surface += hypot(plane, b[2] - a[2]);
    }
    for (size_t i = from; i <= (d->table ? to : from) && end == 0; i++) {
        const double *p = ring->points + 3 * i;
        drape_begin_row(d, line);
        csv_row_count(&d->out->text, true, piece);
        csv_row_double(&d->out->text, true, length);
        csv_row_double(&d->out->text, true, surface);
        for (int k = 0; k < 3 && d->table; k++) csv_row_double(&d->out->text, true, p[k]);
        csv_row_end(&d->out->text);
        end = d->table ? row_output_row(d->out, p) : row_output_line(d->out, p, to - from + 1);
    }
    d->rows++;
    return end;
}

static int drape_write_line(drape *d, const drape_shape *shape)
{
    const drape_line *ring = shape->ring;
    uint32_t piece = 0;
    int end = 0;
    for (size_t i = 0; i < ring->count && end == 0; i++) {
        size_t from = i;
        while (i < ring->count && ring->on[i]) i++;
        if (i > from) end = drape_write_piece(d, shape->first, ring, from, i, piece++);
    }
    const bool dot = ring->length == 0 && ring->outside == 0;
    d->dots += dot;
    d->lost += piece == 0 && !dot;
    d->part += piece > 0 && ring->outside > 0;
    return end;
}

/* --- polygons --- */

static mw_status drape_triangulate(const drape *d, const drape_shape *shape, mw_mesh **mesh,
                                   mw_error *error)
{
    const line_file *l = d->lines;
    size_t first = l->first[shape->first], points = l->first[shape->end] - first, count = 0;
    uint32_t *segment = malloc((2 * points + 1) * sizeof *segment),
             *polygon = calloc(points + 1, sizeof *polygon);
    mw_status status = MW_ERROR_MEMORY;
    for (size_t r = shape->first; r < shape->end && segment && polygon; r++)
        for (size_t i = l->first[r]; i + 1 < l->first[r + 1]; i++, count++) {
            segment[2 * count] = (uint32_t)(i - first);
            segment[2 * count + 1] = (uint32_t)(i + 1 - first);
        }
    const mw_constraints rings = {.points = l->points + 2 * first,
                                  .point_count = points,
                                  .segments = segment,
                                  .segment_count = count,
                                  .polygon = polygon};
    const mw_constrain_options options = {.keep = MW_KEEP_INSIDE, .threads = 1};
    if (segment && polygon)
        status = mw_constrained_delaunay(&rings, &options, NULL, NULL, NULL, mesh, error);
    free(segment);
    free(polygon);
    return status;
}

/* The areas of a polygon; MW_ERROR_INPUT if its rings cross or it has no area. */
static mw_status drape_area(const drape *d, const drape_shape *shape, mw_surface_area_info *info,
                            mw_error *error)
{
    mw_mesh *mesh = NULL;
    mw_locator *region = NULL;
    const mw_volume_options options = {.threads = d->threads, .progress = progress_of_call()};
    const mw_locator_options alone = {.threads = 1};
    mw_status status = drape_triangulate(d, shape, &mesh, error);
    if (!status) status = mw_locator_create(mesh, &alone, &region, error);
    if (!status) status = mw_surface_area(d->locator, d->values, region, &options, info, error);
    mw_locator_destroy(region);
    mw_mesh_destroy(mesh);
    return status;
}

/* Concatenate the rings of a polygon. */
static int drape_put_polygon(drape *d, const drape_shape *shape)
{
    size_t rings = shape->end - shape->first, count = 0;
    size_t *first = malloc((rings + 1) * sizeof *first);
    for (size_t r = 0; r < rings && first; r++) {
        first[r] = count;
        count += shape->ring[r].count;
    }
    double *points = malloc((3 * count + 1) * sizeof *points);
    int end = points && first ? 0 : fail_memory();
    if (end == 0) first[rings] = count;
    for (size_t r = 0; r < rings && end == 0; r++)
        memcpy(points + 3 * first[r], shape->ring[r].points,
               3 * shape->ring[r].count * sizeof *points);
    for (size_t i = 0; i < count && end == 0; i++)
        if (isnan(points[3 * i + 2])) points[3 * i + 2] = d->nodata;
    if (end == 0) end = row_output_polygon(d->out, points, first, rings);
    free(points);
    free(first);
    return end;
}

static int drape_write_polygon(drape *d, const drape_shape *shape)
{
    mw_surface_area_info info = {0};
    mw_error error;
    text *out = &d->out->text;
    double length = 0, surface = 0, outside = 0;
    mw_status status = drape_area(d, shape, &info, &error);
    if (status != MW_OK && status != MW_ERROR_INPUT) return fail_query(&error);
    for (size_t r = 0; r < shape->end - shape->first; r++) {
        length += shape->ring[r].length;
        surface += shape->ring[r].surface;
        outside += shape->ring[r].outside;
    }
    double rest = info.region_area - info.area;
    if (!(rest > 1e-12 * info.region_area)) rest = 0;
    drape_begin_row(d, shape->first);
    csv_row_double(out, true, length);
    csv_row_double(out, true, surface);
    csv_row_double(out, status == MW_OK, info.area);
    csv_row_double(out, status == MW_OK, info.surface_area);
    csv_row_double(out, status == MW_OK, rest);
    csv_row_end(out);
    d->unmeasured += status != MW_OK;
    const bool dot = length == 0 && outside == 0;
    d->dots += dot;
    d->lost += length == 0 && !dot;
    d->part += length > 0 && outside > 0;
    d->rows++;
    return drape_put_polygon(d, shape);
}

/* --- all --- */

/* The rings of one polygon follow each other. */
static size_t drape_shape_end(const line_file *l, size_t first)
{
    size_t end = first + 1;
    while (l->polygon[first] != MW_NONE && end < l->count && l->polygon[end] == l->polygon[first] &&
           l->feature[end] == l->feature[first])
        end++;
    return end;
}

static int drape_write_shape(drape *d, drape_shape *shape, mw_cursor *cursor)
{
    const line_file *l = d->lines;
    size_t rings = shape->end - shape->first;
    int end = 0;
    shape->ring = calloc(rings, sizeof *shape->ring);
    if (!shape->ring) return fail_memory();
    for (size_t r = 0; r < rings && end == 0; r++) {
        size_t from = l->first[shape->first + r], to = l->first[shape->first + r + 1];
        end = drape_line_lay(&shape->ring[r], d->locator, d->mesh, d->values, cursor,
                             l->points + 2 * from, to - from);
    }
    if (end == 0) end = d->polygons ? drape_write_polygon(d, shape) : drape_write_line(d, shape);
    for (size_t r = 0; r < rings; r++) drape_line_release(&shape->ring[r]);
    free(shape->ring);
    return end;
}

int drape_write_rows(drape *d)
{
    mw_cursor cursor;
    mw_error error;
    int end = 0;
    size_t lines = d->lines->count;
    if (mw_cursor_init(d->locator, NULL, &cursor, &error) != MW_OK) return fail_query(&error);
    for (size_t i = 0; i < lines && end == 0;) {
        drape_shape shape = {.first = i, .end = drape_shape_end(d->lines, i)};
        end = drape_write_shape(d, &shape, &cursor);
        i = shape.end;
        progress_lines(i, (double)i / (double)lines);
    }
    return end;
}
