#include "cli/draw/plane_picture.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define PI 3.14159265358979323846

/* --- grids ------------------------------------------------------------------------------------ */

/* Eq. 5; squares, of which a row has twice as many as there are rows. */
static uint32_t grid_cells_rows(uint32_t cells, bool uniform)
{
    const double rows = uniform ? sqrt(cells / 2.0) : sqrt(PI * cells / 4);
    return rows < 1 ? 1 : (uint32_t)(rows + 0.5);
}

/* Eq. 6. */
static uint32_t grid_cells_of_row(uint32_t i, uint32_t rows, uint32_t cells, bool uniform)
{
    const double part = (cos(i * PI / rows) - cos((i + 1) * PI / rows)) / 2;
    const uint32_t count = uniform ? 2 * rows : (uint32_t)(cells * part + 0.5);
    return count ? count : 1;
}

grid_cell *grid_cells_make(uint32_t cells, bool uniform, size_t *count)
{
    const uint32_t rows = grid_cells_rows(cells, uniform);
    *count = 0;
    for (uint32_t i = 0; i < rows; i++) *count += grid_cells_of_row(i, rows, cells, uniform);
    grid_cell *grid = malloc(*count * sizeof *grid), *next = grid;
    for (uint32_t i = 0; i < rows && grid; i++) {
        const uint32_t columns = grid_cells_of_row(i, rows, cells, uniform);
        for (uint32_t j = 0; j < columns; j++)
            *next++ = (grid_cell){{j * 2 * PI / columns - PI, (j + 1) * 2 * PI / columns - PI},
                                  {i * PI / rows, (i + 1) * PI / rows}};
    }
    return grid;
}

void grid_cell_direction(const grid_cell *cell, double direction[3])
{
    const double phi = (cell->phi[0] + cell->phi[1]) / 2,
                 theta = (cell->theta[0] + cell->theta[1]) / 2;
    direction[0] = sin(theta) * cos(phi);
    direction[1] = sin(theta) * sin(phi);
    direction[2] = cos(theta);
}

/* --- what both planes need -------------------------------------------------------------------- */

static bool picture_allocate(plane_picture *p, const drawing *d, size_t line, size_t segments)
{
    p->drawing = *d;
    p->points = calloc(3 * d->point_count + 1, sizeof *p->points);
    p->triangles = malloc(3 * d->triangle_count * sizeof *p->triangles + 1);
    p->path = malloc(d->path_count * sizeof *p->path + 1);
    p->iteration = malloc(d->path_count * sizeof *p->iteration + 1);
    p->marks = calloc(d->triangle_count + 1, sizeof *p->marks);
    p->line = calloc(3 * line + 1, sizeof *p->line);
    p->segments = calloc(6 * segments + 1, sizeof *p->segments);
    p->drawing.view = VIEW_PLANE;
    p->drawing.points = p->points;
    p->drawing.triangles = p->triangles;
    p->drawing.path = p->path;
    p->drawing.iteration = p->iteration;
    p->drawing.marks = d->marks ? p->marks : NULL;
    p->drawing.line = p->line;
    p->drawing.segments = p->segments;
    return p->points && p->triangles && p->path && p->iteration && p->marks && p->line &&
           p->segments;
}

void plane_picture_release(plane_picture *p)
{
    free(p->points);
    free(p->triangles);
    free(p->path);
    free(p->iteration);
    free(p->marks);
    free(p->line);
    free(p->segments);
}

static void picture_add_segment(plane_picture *p, double ax, double ay, double bx, double by)
{
    double *s = p->segments + 6 * p->drawing.segment_count++;
    s[0] = ax;
    s[1] = ay;
    s[3] = bx;
    s[4] = by;
}

/* Keep the triangles for which number[t] is not UINT32_MAX, under new numbers, and the visits to
 * them, from visit `first` on. Returns how many of these visits are lost. */
static size_t picture_keep(plane_picture *p, const drawing *d, uint32_t *number, size_t first)
{
    uint32_t count = 0;
    size_t visits = 0;
    for (size_t t = 0; t < d->triangle_count; t++) {
        if (number[t] == UINT32_MAX) continue;
        number[t] = count;
        memcpy(p->triangles + 3 * (size_t)count, d->triangles + 3 * t, 3 * sizeof *p->triangles);
        if (d->marks) p->marks[count] = d->marks[t];
        count++;
    }
    for (size_t i = first; i < d->path_count; i++) {
        if (number[d->path[i]] == UINT32_MAX) continue;
        p->path[visits] = number[d->path[i]];
        p->iteration[visits++] = d->iteration[i];
    }
    p->drawing.triangle_count = count;
    p->drawing.path_count = visits;
    return d->path_count - first - visits;
}

static double inner3(const double a[3], const double b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static void outer3(const double a[3], const double b[3], double c[3])
{
    for (int k = 0; k < 3; k++)
        c[k] = a[(k + 1) % 3] * b[(k + 2) % 3] - a[(k + 2) % 3] * b[(k + 1) % 3];
}

static void difference3(const double a[3], const double b[3], double c[3])
{
    for (int k = 0; k < 3; k++) c[k] = a[k] - b[k];
}

/* --- longitude and polar angle ---------------------------------------------------------------- */

/* x is phi, y is -theta, so that north is up; eq. 3. */
static void star_place(const drawing *d, const double *point, double place[3])
{
    double v[3];
    difference3(point, d->centre, v);
    place[0] = atan2(v[1], v[0]);
    place[1] = -atan2(hypot(v[0], v[1]), v[2]);
    place[2] = 0;
}

/* Does a facet turn in the plane as it does seen from outside? Those across the seam do not, nor
 * those round a pole. */
static bool facet_is_plain(const plane_picture *p, const drawing *d, size_t t)
{
    const uint32_t *v = d->triangles + 3 * t;
    double a[3], b[3], c[3], n[3];
    difference3(d->points + 3 * (size_t)v[0], d->centre, a);
    difference3(d->points + 3 * (size_t)v[1], d->centre, b);
    difference3(d->points + 3 * (size_t)v[2], d->centre, c);
    outer3(a, b, n);
    const double *u = p->points + 3 * (size_t)v[0], *w = p->points + 3 * (size_t)v[1],
                 *x = p->points + 3 * (size_t)v[2];
    const double turn = (w[0] - u[0]) * (x[1] - u[1]) - (w[1] - u[1]) * (x[0] - u[0]);
    return turn * inner3(n, c) > 0;
}

/* The way of the walk: two legs; or the line of the drawing, in parts where it crosses the seam. */
static void star_make_line(plane_picture *p, const drawing *d, bool orthogonal)
{
    const double *last = d->line + 3 * (d->line_count - 1);
    size_t count = 0;
    if (orthogonal) {
        star_place(d, d->line, p->line);
        star_place(d, last, p->line + 6);
        p->line[3] = p->line[6];
        p->line[4] = p->line[1];
        p->drawing.line_count = 3;
        return;
    }
    for (size_t i = 0; i < d->line_count; i++) {
        double *at = p->line + 3 * count;
        star_place(d, d->line + 3 * i, at);
        if (i > 0 && fabs(at[0] - at[-3]) > PI) {
            memcpy(at + 3, at, 3 * sizeof *at);
            at[0] = at[1] = NAN;
            count++;
        }
        count++;
    }
    p->drawing.line_count = count;
}

static void star_add_frame(plane_picture *p)
{
    picture_add_segment(p, -PI, 0, PI, 0);
    picture_add_segment(p, PI, 0, PI, -PI);
    picture_add_segment(p, PI, -PI, -PI, -PI);
    picture_add_segment(p, -PI, -PI, -PI, 0);
}

static void star_add_cells(plane_picture *p, const grid_cell *cells, size_t count)
{
    for (size_t i = 0; i < count; i++) {
        const grid_cell *c = &cells[i];
        picture_add_segment(p, c->phi[0], -c->theta[0], c->phi[1], -c->theta[0]);
        picture_add_segment(p, c->phi[0], -c->theta[0], c->phi[0], -c->theta[1]);
    }
}

bool plane_picture_of_star(plane_picture *p, const drawing *d, bool orthogonal,
                           const grid_cell *cells, size_t cell_count, size_t *left_out)
{
    uint32_t *number = calloc(d->triangle_count + 1, sizeof *number);
    *p = (plane_picture){.drawing = *d};
    bool room = picture_allocate(p, d, 2 * d->line_count + 3, 2 * cell_count + 4) && number;
    if (room) {
        for (size_t v = 0; v < d->point_count; v++)
            star_place(d, d->points + 3 * v, p->points + 3 * v);
        for (size_t t = 0; t < d->triangle_count; t++)
            if (!facet_is_plain(p, d, t)) number[t] = UINT32_MAX;
        *left_out = picture_keep(p, d, number, 0);
        star_make_line(p, d, orthogonal);
        star_add_frame(p);
        star_add_cells(p, cells, cell_count);
        p->drawing.segment_name = cells ? "grid" : "all directions";
    }
    free(number);
    return room;
}

/* --- the cutting plane ------------------------------------------------------------------------ */

/* The plane through the line from `origin`, with its axes: x across the line, y against the motion,
 * n across the plane; of length 1. */
typedef struct cutting_plane {
    double origin[3], x[3], y[3], n[3];
} cutting_plane;

static void set_length_1(double v[3])
{
    const double length = sqrt(inner3(v, v));
    for (int k = 0; k < 3; k++) v[k] /= length;
}

static cutting_plane plane_through(const drawing *d, uint32_t triangle)
{
    const uint32_t *v = d->triangles + 3 * (size_t)triangle;
    cutting_plane c;
    double middle[3];
    memcpy(c.origin, d->line, sizeof c.origin);
    difference3(d->line, d->line + 3 * (d->line_count - 1), c.y);
    for (size_t k = 0; k < 3; k++)
        middle[k] = (d->points[3 * (size_t)v[0] + k] + d->points[3 * (size_t)v[1] + k] +
                     d->points[3 * (size_t)v[2] + k]) /
                        3 -
                    c.origin[k];
    set_length_1(c.y);
    outer3(middle, c.y, c.n);
    if (!(inner3(c.n, c.n) > 0)) outer3((const double[]){c.y[1], c.y[2], c.y[0]}, c.y, c.n);
    set_length_1(c.n);
    outer3(c.y, c.n, c.x);
    return c;
}

/* x and y of a point in the plane; returns how far it is above the plane. */
static double plane_place(const cutting_plane *c, const double *point, double place[3])
{
    double v[3];
    difference3(point, c->origin, v);
    place[0] = inner3(v, c->x);
    place[1] = inner3(v, c->y);
    place[2] = 0;
    return inner3(v, c->n);
}

/* The part of a triangle in the plane: where two of its edges cross it. A vertex in the plane
 * counts as not above it, as for the walk. Returns false if the plane does not cut it. */
static bool triangle_add_section(plane_picture *p, const uint32_t *v, const double *above)
{
    double at[2][2];
    int count = 0;
    for (int k = 0; k < 3 && count < 2; k++) {
        const uint32_t a = v[k], b = v[(k + 1) % 3];
        if ((above[a] > 0) == (above[b] > 0)) continue;
        const double part = above[a] / (above[a] - above[b]);
        for (size_t i = 0; i < 2; i++) {
            const double from = p->points[3 * (size_t)a + i], to = p->points[3 * (size_t)b + i];
            at[count][i] = from + part * (to - from);
        }
        count++;
    }
    if (count < 2) return false;
    picture_add_segment(p, at[0][0], at[0][1], at[1][0], at[1][1]);
    return true;
}

/* The first visit of the last walk. */
static size_t last_walk_begins(const drawing *d)
{
    size_t i = d->path_count;
    while (i > 1 && d->iteration[i - 2] == d->iteration[d->path_count - 1]) i--;
    return i ? i - 1 : 0;
}

bool plane_picture_of_probe(plane_picture *p, const drawing *d)
{
    uint32_t *number = calloc(d->triangle_count + 1, sizeof *number);
    double *above = malloc(d->point_count * sizeof *above + 1);
    *p = (plane_picture){.drawing = *d};
    bool room = picture_allocate(p, d, 2, d->triangle_count) && number && above;
    if (room && d->path_count) {
        const size_t first = last_walk_begins(d);
        const cutting_plane c = plane_through(d, d->path[first]);
        for (size_t v = 0; v < d->point_count; v++)
            above[v] = plane_place(&c, d->points + 3 * v, p->points + 3 * v);
        for (size_t t = 0; t < d->triangle_count; t++)
            if (!triangle_add_section(p, d->triangles + 3 * t, above)) number[t] = UINT32_MAX;
        picture_keep(p, d, number, first);
        plane_place(&c, d->line, p->line);
        plane_place(&c, d->line + 3 * (d->line_count - 1), p->line + 3);
        p->drawing.line_count = 2;
        p->drawing.segment_name = "where the plane cuts";
        p->drawing.dashed = true;
    }
    free(number);
    free(above);
    return room;
}
