/* drawing.c - an orthographic projection, painted from back to front with Cairo.
 *
 * Triangles of the walk are filled, from light to dark in their order. In space the mesh is a thin veil: triangles that
 * turn their back are left out, but for those of the walk, which are painted first, and so shimmer through. Of a large
 * mesh only what lies near the walk is painted. Green and vermilion are those of Okabe and Ito (2008), which
 * colour-blind people can tell apart. */
#include "drawing.h"
#include "message.h"
#include "picture.h"

#ifdef MW_CAIRO

#include <cairo.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Measures in points. */
#define PAGE_SIDE 720.0 /* of the longer side of what is shown */
#define PAGE_LEAST 300.0
#define MARGIN 14.0
#define CAPTION 26.0
#define RING 8.0 /* radius */

#define MOST_TRIANGLES 40000 /* that are painted, without the walk's */
#define CELLS 256            /* a side of the grid that tells what is near the walk */

/* A vertex on the page: to the right, up, and towards the eye. */
typedef struct spot {
    double x, y, z;
} spot;

typedef struct box {
    double low[2], high[2];
} box;

/* A triangle to be painted, in order of its key. */
typedef struct piece {
    double key;
    uint32_t triangle;
    bool back;
} piece;

typedef struct scene {
    const drawing *d;
    double middle[3], size; /* of the mesh, which becomes a cube from -1 to 1 */
    double axis[3][3];      /* of the page: right, up, towards the eye */
    spot *at;
    uint32_t *visit; /* per triangle: when it was visited first; UINT32_MAX: not */
    double *part;    /* per visit: how far its walk is, from 0 to 1 */
    piece *pieces;
    size_t count;
    box all, shown;
    double scale; /* points of a unit */
} scene;

/* --- vectors ------------------------------------------------------------------------------------------------------ */

static double inner(const double a[3], const double b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static void outer(const double a[3], const double b[3], double c[3])
{
    for (int k = 0; k < 3; k++) c[k] = a[(k + 1) % 3] * b[(k + 2) % 3] - a[(k + 2) % 3] * b[(k + 1) % 3];
}

/* False for one without length. */
static bool normalise(double a[3])
{
    double length = sqrt(inner(a, a));
    if (!(length > 1e-150) || !isfinite(length)) return false;
    for (int k = 0; k < 3; k++) a[k] /= length;
    return true;
}

/* --- the view ----------------------------------------------------------------------------------------------------- */

static void measure(scene *s)
{
    const drawing *d = s->d;
    double low[3] = {INFINITY, INFINITY, INFINITY}, high[3] = {-INFINITY, -INFINITY, -INFINITY};
    for (size_t i = 0; i < 3 * d->triangle_count; i++)
        for (size_t k = 0; k < 3; k++) {
            double x = d->points[3 * (size_t)d->triangles[i] + k];
            if (!isfinite(x)) continue;
            low[k] = fmin(low[k], x);
            high[k] = fmax(high[k], x);
        }
    s->size = 0;
    for (int k = 0; k < 3; k++) {
        s->middle[k] = low[k] <= high[k] ? low[k] / 2 + high[k] / 2 : 0;
        if (d->view != VIEW_PLANE || k < 2) s->size = fmax(s->size, high[k] / 2 - low[k] / 2);
    }
    if (!(s->size > 0)) s->size = 1;
}

/* A point in the cube. */
static void place(const scene *s, const double *point, double p[3])
{
    for (int k = 0; k < 3; k++) p[k] = (point[k] - s->middle[k]) / s->size;
}

static void corners(const scene *s, uint32_t triangle, double p[3][3])
{
    for (size_t k = 0; k < 3; k++) place(s, s->d->points + 3 * (size_t)s->d->triangles[3 * (size_t)triangle + k], p[k]);
}

/* Of length 1, on the front; zero where there is no area. */
static void normal_of(const scene *s, uint32_t triangle, double n[3])
{
    double p[3][3], a[3], b[3], c[3];
    corners(s, triangle, p);
    for (int k = 0; k < 3; k++) {
        a[k] = p[1][k] - p[0][k];
        b[k] = p[2][k] - p[0][k];
    }
    outer(a, b, n);
    if (!normalise(n)) memset(n, 0, 3 * sizeof *n);
    if (s->d->view != VIEW_STAR) return;
    place(s, s->d->centre, c);
    for (int k = 0; k < 3; k++) a[k] = p[0][k] - c[k];
    if (inner(a, n) < 0)
        for (int k = 0; k < 3; k++) n[k] = -n[k];
}

/* From the centre to the middle of a facet, of length 1. */
static void direction_of(const scene *s, uint32_t triangle, double n[3])
{
    double p[3][3], c[3];
    corners(s, triangle, p);
    place(s, s->d->centre, c);
    for (int k = 0; k < 3; k++) n[k] = (p[0][k] + p[1][k] + p[2][k]) / 3 - c[k];
    if (!normalise(n)) memset(n, 0, 3 * sizeof *n);
}

static void look_of(const scene *s, size_t visit, double n[3])
{
    if (s->d->view == VIEW_STAR)
        direction_of(s, s->d->path[visit], n);
    else
        normal_of(s, s->d->path[visit], n);
}

/* Where a walk goes all round a surface, the directions of its triangles cancel out: then that of the last one counts. */
static void mean_look(const scene *s, double eye[3])
{
    double n[3], sum[3] = {0, 0, 0};
    size_t count = s->d->path_count;
    for (size_t i = 0; i < count; i++) {
        look_of(s, i, n);
        for (int k = 0; k < 3; k++) sum[k] += n[k];
    }
    memcpy(eye, sum, sizeof sum);
    if (count && inner(sum, sum) < 0.09 * (double)count * (double)count) look_of(s, count - 1, eye);
    if (!normalise(eye)) memcpy(eye, (const double[]){0, 0, 1}, sizeof sum);
}

/* What is up on the page: north on a globe; models have y up more often than z. */
static void choose_up(const scene *s, const double eye[3], double up[3])
{
    double unit[3] = {0, 0, 0};
    int first = s->d->view == VIEW_STAR ? 2 : 1, axis = fabs(eye[first]) < 0.9 ? first : 3 - first;
    unit[axis] = 1;
    for (int k = 0; k < 3; k++) up[k] = unit[k] - eye[k] * eye[axis];
    normalise(up);
}

/* A probe's line should be seen as a line: where the eye looks along it, step aside. */
static void step_aside(const scene *s, double eye[3])
{
    double from[3], to[3], line[3], up[3], side[3];
    place(s, s->d->line, from);
    place(s, s->d->line + 3 * (s->d->line_count - 1), to);
    for (int k = 0; k < 3; k++) line[k] = to[k] - from[k];
    if (!normalise(line) || fabs(inner(line, eye)) < 0.85) return;
    choose_up(s, eye, up);
    outer(up, eye, side);
    for (int k = 0; k < 3; k++) eye[k] += 0.55 * side[k] + 0.25 * up[k];
    normalise(eye);
}

static void choose_view(scene *s)
{
    double eye[3] = {0, 0, 1}, up[3] = {0, 1, 0}, right[3];
    if (s->d->view != VIEW_PLANE) {
        mean_look(s, eye);
        if (s->d->view == VIEW_SURFACE) step_aside(s, eye);
        choose_up(s, eye, up);
    }
    outer(up, eye, right);
    memcpy(s->axis[0], right, sizeof right);
    memcpy(s->axis[1], up, sizeof up);
    memcpy(s->axis[2], eye, sizeof eye);
}

static spot project(const scene *s, const double *point)
{
    double p[3];
    place(s, point, p);
    if (s->d->view == VIEW_PLANE) return (spot){p[0], p[1], 0};
    return (spot){inner(s->axis[0], p), inner(s->axis[1], p), inner(s->axis[2], p)};
}

static bool is_spot(const spot *at)
{
    return isfinite(at->x) && isfinite(at->y);
}

/* --- what is shown ------------------------------------------------------------------------------------------------ */

static const box nothing = {{INFINITY, INFINITY}, {-INFINITY, -INFINITY}};

static void grow(box *b, const spot *at)
{
    if (!is_spot(at)) return;
    b->low[0] = fmin(b->low[0], at->x);
    b->low[1] = fmin(b->low[1], at->y);
    b->high[0] = fmax(b->high[0], at->x);
    b->high[1] = fmax(b->high[1], at->y);
}

static const spot *corner(const scene *s, uint32_t triangle, size_t k)
{
    return &s->at[s->d->triangles[3 * (size_t)triangle + k]];
}

static box box_of(const scene *s, uint32_t triangle)
{
    box b = nothing;
    for (size_t k = 0; k < 3; k++) grow(&b, corner(s, triangle, k));
    return b;
}

static double side_of(const box *b)
{
    return fmax(b->high[0] - b->low[0], b->high[1] - b->low[1]);
}

static box widen(box b, double margin)
{
    for (int k = 0; k < 2; k++) {
        b.low[k] -= margin;
        b.high[k] += margin;
    }
    return b;
}

static box join(box a, box b)
{
    for (int k = 0; k < 2; k++) {
        a.low[k] = fmin(a.low[k], b.low[k]);
        a.high[k] = fmax(a.high[k], b.high[k]);
    }
    return a;
}

static box meet(box a, box b)
{
    for (int k = 0; k < 2; k++) {
        a.low[k] = fmax(a.low[k], b.low[k]);
        a.high[k] = fmin(a.high[k], b.high[k]);
    }
    return a;
}

/* An end of the line should be seen, unless it lies far away: from a mesh in the plane, or from the walk of a probe. */
static void grow_to_end(scene *s, const double *point)
{
    spot at = project(s, point);
    box near = s->d->view == VIEW_PLANE ? widen(s->all, 2) : widen(s->shown, side_of(&s->shown));
    if (at.x >= near.low[0] && at.x <= near.high[0] && at.y >= near.low[1] && at.y <= near.high[1])
        grow(&s->shown, &at);
}

/* The walk and the ends of its line, with a margin; the whole mesh where that is not much more. */
static void choose_box(scene *s)
{
    const drawing *d = s->d;
    double sides = 0;
    s->all = s->shown = nothing;
    for (size_t i = 0; i < 3 * d->triangle_count; i++) grow(&s->all, &s->at[d->triangles[i]]);
    for (size_t i = 0; i < d->path_count; i++) {
        box b = box_of(s, d->path[i]);
        sides += side_of(&b);
        for (size_t k = 0; k < 3; k++) grow(&s->shown, corner(s, d->path[i], k));
    }
    for (size_t i = 0; i < d->line_count; i += d->line_count - 1) grow_to_end(s, d->line + 3 * i);
    double side = side_of(&s->shown), mean = d->path_count ? sides / (double)d->path_count : 0;
    box near = widen(s->shown, fmax(0.12 * side, 1.5 * mean)), most = join(s->shown, s->all);
    bool whole = !d->path_count || side_of(&near) > 0.6 * side_of(&s->all);
    s->shown = whole ? most : meet(near, most);
    s->shown = widen(s->shown, 0.02 * side_of(&s->shown));
    if (!(side_of(&s->shown) > 0)) s->shown = (box){{-1, -1}, {1, 1}};
    s->scale = PAGE_SIDE / side_of(&s->shown);
}

/* --- what is painted ---------------------------------------------------------------------------------------------- */

static bool is_in_sight(const scene *s, const box *b)
{
    return b->low[0] <= s->shown.high[0] && b->high[0] >= s->shown.low[0] && b->low[1] <= s->shown.high[1] &&
           b->high[1] >= s->shown.low[1];
}

static bool is_finite(const scene *s, uint32_t triangle)
{
    return is_spot(corner(s, triangle, 0)) && is_spot(corner(s, triangle, 1)) && is_spot(corner(s, triangle, 2));
}

static double depth_of(const scene *s, uint32_t triangle)
{
    return (corner(s, triangle, 0)->z + corner(s, triangle, 1)->z + corner(s, triangle, 2)->z) / 3;
}

static bool turns_back(const scene *s, uint32_t triangle)
{
    double n[3];
    if (s->d->view == VIEW_PLANE) return false;
    normal_of(s, triangle, n);
    return inner(n, s->axis[2]) < 0;
}

/* In the plane the walk lies on the mesh; in space what is nearer hides what is farther away. Depths are within 2. */
static void add_piece(scene *s, uint32_t triangle)
{
    box b = box_of(s, triangle);
    bool walk = s->visit[triangle] != UINT32_MAX;
    if (!is_finite(s, triangle) || !is_in_sight(s, &b)) return;
    bool back = turns_back(s, triangle);
    if (back && !walk) return;
    double key =
        s->d->view == VIEW_PLANE ? (walk ? s->visit[triangle] : -1.0) : depth_of(s, triangle) - (back ? 10 : 0);
    s->pieces[s->count++] = (piece){key, triangle, back};
}

static int by_key(const void *a, const void *b)
{
    const piece *p = a, *q = b;
    if (p->key != q->key) return p->key < q->key ? -1 : 1;
    return p->triangle < q->triangle ? -1 : 1;
}

/* How many cells of the page a triangle is away from the walk. */
typedef struct nearness {
    uint16_t cells[CELLS + 2][CELLS + 2]; /* with a rim that is far away */
} nearness;

#define FAR 0x7fff

static int cell(double x, double low, double high)
{
    double c = 1 + floor((x - low) / (high - low) * CELLS);
    return c < 1 ? 1 : c > CELLS ? CELLS : (int)c;
}

static void mark_walk(const scene *s, nearness *near)
{
    const box *v = &s->shown;
    for (size_t i = 0; i < s->d->path_count; i++) {
        if (!is_finite(s, s->d->path[i])) continue;
        box b = box_of(s, s->d->path[i]);
        int right = cell(b.high[0], v->low[0], v->high[0]), top = cell(b.high[1], v->low[1], v->high[1]);
        for (int y = cell(b.low[1], v->low[1], v->high[1]); y <= top; y++)
            for (int x = cell(b.low[0], v->low[0], v->high[0]); x <= right; x++) near->cells[y][x] = 0;
    }
}

static uint16_t closer(uint16_t here, uint16_t there)
{
    return there + 1 < here ? (uint16_t)(there + 1) : here;
}

/* Steps of a king, in two sweeps. */
static void spread(nearness *near)
{
    for (int y = 1; y <= CELLS; y++)
        for (int x = 1; x <= CELLS; x++) {
            uint16_t *c = &near->cells[y][x];
            for (int k = -1; k <= 1; k++) *c = closer(*c, near->cells[y - 1][x + k]);
            *c = closer(*c, near->cells[y][x - 1]);
        }
    for (int y = CELLS; y >= 1; y--)
        for (int x = CELLS; x >= 1; x--) {
            uint16_t *c = &near->cells[y][x];
            for (int k = -1; k <= 1; k++) *c = closer(*c, near->cells[y + 1][x + k]);
            *c = closer(*c, near->cells[y][x + 1]);
        }
}

static uint32_t steps_away(const scene *s, const nearness *near, uint32_t triangle)
{
    const box *v = &s->shown;
    box b = box_of(s, triangle);
    return near->cells[cell((b.low[1] + b.high[1]) / 2, v->low[1], v->high[1])]
                      [cell((b.low[0] + b.high[0]) / 2, v->low[0], v->high[0])];
}

/* Keep those near the walk, as many as are to be painted. False: out of memory. */
static bool keep_near(scene *s)
{
    size_t counts[CELLS + 1] = {0}, sum = 0, kept = 0;
    uint32_t most = 0;
    if (s->count <= MOST_TRIANGLES + s->d->path_count) return true;
    nearness *near = malloc(sizeof *near);
    if (!near) return false;
    for (int y = 0; y < CELLS + 2; y++)
        for (int x = 0; x < CELLS + 2; x++) near->cells[y][x] = FAR;
    mark_walk(s, near);
    spread(near);
    for (size_t i = 0; i < s->count; i++) {
        uint32_t away = steps_away(s, near, s->pieces[i].triangle);
        if (away <= CELLS) counts[away]++;
    }
    while (most < CELLS && sum + counts[most] <= MOST_TRIANGLES) sum += counts[most++];
    for (size_t i = 0; i < s->count; i++) {
        uint32_t t = s->pieces[i].triangle;
        if (s->visit[t] != UINT32_MAX || steps_away(s, near, t) < most) s->pieces[kept++] = s->pieces[i];
    }
    s->count = kept;
    free(near);
    return true;
}

static bool choose_pieces(scene *s)
{
    for (size_t t = 0; t < s->d->triangle_count; t++) add_piece(s, (uint32_t)t);
    if (!keep_near(s)) return false;
    qsort(s->pieces, s->count, sizeof *s->pieces, by_key);
    return true;
}

/* --- colours ------------------------------------------------------------------------------------------------------ */

static const double green[3] = {0.00, 0.62, 0.45}, vermilion[3] = {0.84, 0.37, 0.00};

static void mix(const double a[3], const double b[3], double part, double rgb[3])
{
    for (int k = 0; k < 3; k++) rgb[k] = a[k] + part * (b[k] - a[k]);
}

/* Each walk from light to dark: blue, purple, brown, and again. */
static void shade(const scene *s, uint32_t visit, double rgb[3])
{
    static const double light[3][3] = {{0.80, 0.90, 0.98}, {0.93, 0.83, 0.95}, {0.98, 0.92, 0.75}};
    static const double dark[3][3] = {{0.03, 0.25, 0.55}, {0.42, 0.13, 0.45}, {0.50, 0.33, 0.00}};
    uint32_t hue = s->d->iteration[visit] % 3;
    mix(light[hue], dark[hue], s->part[visit], rgb);
}

static void colour_of(const scene *s, const piece *p, double rgb[3])
{
    const drawing *d = s->d;
    if (p->triangle == d->path[d->path_count - 1])
        memcpy(rgb, vermilion, sizeof vermilion);
    else if (p->triangle == d->path[0])
        memcpy(rgb, green, sizeof green);
    else
        shade(s, s->visit[p->triangle], rgb);
    if (p->back) mix(rgb, (const double[]){1, 1, 1}, 0.45, rgb);
}

/* --- painting ----------------------------------------------------------------------------------------------------- */

static double page_x(const scene *s, double x)
{
    return MARGIN + (x - s->shown.low[0]) * s->scale;
}

static double page_y(const scene *s, double y)
{
    return MARGIN + (s->shown.high[1] - y) * s->scale;
}

/* Thinner where triangles are small on the page. */
static double line_width(const scene *s)
{
    double sum = 0;
    for (size_t i = 0; i < s->count; i++) {
        box b = box_of(s, s->pieces[i].triangle);
        sum += side_of(&b);
    }
    double mean = s->count ? sum / (double)s->count * s->scale : 10;
    return fmin(0.6, fmax(0.08, 0.05 * mean));
}

static void trace(cairo_t *c, const scene *s, uint32_t triangle)
{
    for (size_t k = 0; k < 3; k++) {
        const spot *at = corner(s, triangle, k);
        cairo_line_to(c, page_x(s, at->x), page_y(s, at->y));
    }
    cairo_close_path(c);
}

static void paint(cairo_t *c, const scene *s, const piece *p, double width)
{
    bool walk = s->visit[p->triangle] != UINT32_MAX;
    double rgb[3];
    trace(c, s, p->triangle);
    if (walk) {
        colour_of(s, p, rgb);
        cairo_set_source_rgb(c, rgb[0], rgb[1], rgb[2]);
        cairo_fill_preserve(c);
    } else if (s->d->view != VIEW_PLANE) {
        cairo_set_source_rgba(c, 1, 1, 1, 0.7);
        cairo_fill_preserve(c);
    }
    double grey = walk && !p->back ? 0.25 : 0.7;
    cairo_set_source_rgb(c, grey, grey, grey);
    cairo_set_line_width(c, walk ? 1.3 * width : width);
    cairo_stroke(c);
}

/* A triangle that is too small or thin to show its colour gets a ring of it. */
static void ring(cairo_t *c, const scene *s, uint32_t triangle, const double rgb[3])
{
    box b = box_of(s, triangle);
    if (!is_finite(s, triangle) || fmin(b.high[0] - b.low[0], b.high[1] - b.low[1]) * s->scale > 1.5 * RING) return;
    cairo_new_sub_path(c);
    cairo_arc(c, page_x(s, b.low[0] / 2 + b.high[0] / 2), page_y(s, b.low[1] / 2 + b.high[1] / 2), RING, 0,
              2 * acos(-1));
    cairo_set_source_rgb(c, rgb[0], rgb[1], rgb[2]);
    cairo_set_line_width(c, 2);
    cairo_stroke(c);
}

/* Is a point of a star's line on the side of the eye? */
static bool is_seen(const scene *s, const double *point)
{
    double c[3], p[3];
    if (s->d->view != VIEW_STAR) return true;
    place(s, s->d->centre, c);
    place(s, point, p);
    for (int k = 0; k < 3; k++) p[k] -= c[k];
    return inner(p, s->axis[2]) >= 0;
}

static void paint_line(cairo_t *c, const scene *s)
{
    const double *line = s->d->line;
    cairo_set_line_width(c, 1.1);
    for (size_t i = 0; i + 1 < s->d->line_count; i++) {
        spot a = project(s, line + 3 * i), b = project(s, line + 3 * i + 3);
        if (!is_spot(&a) || !is_spot(&b)) continue;
        bool seen = is_seen(s, line + 3 * i) && is_seen(s, line + 3 * i + 3);
        double grey = seen ? 0 : 0.6;
        cairo_set_source_rgb(c, grey, grey, grey);
        cairo_move_to(c, page_x(s, a.x), page_y(s, a.y));
        cairo_line_to(c, page_x(s, b.x), page_y(s, b.y));
        cairo_stroke(c);
    }
}

/* The beginning of the line is a ring, its end a disc. */
static void paint_end(cairo_t *c, const scene *s, const double *point, bool last)
{
    spot at = project(s, point);
    if (!is_spot(&at)) return;
    double grey = is_seen(s, point) ? 0 : 0.6, paper = last ? grey : 1;
    cairo_new_sub_path(c);
    cairo_arc(c, page_x(s, at.x), page_y(s, at.y), 2.5, 0, 2 * acos(-1));
    cairo_set_source_rgb(c, paper, paper, paper);
    cairo_fill_preserve(c);
    cairo_set_source_rgb(c, grey, grey, grey);
    cairo_set_line_width(c, 1.1);
    cairo_stroke(c);
}

static double write_words(cairo_t *c, double x, double y, const char *words)
{
    cairo_text_extents_t e;
    cairo_set_source_rgb(c, 0.1, 0.1, 0.1);
    cairo_text_extents(c, words, &e);
    cairo_move_to(c, x, y);
    cairo_show_text(c, words);
    return x + e.x_advance;
}

static double sample(cairo_t *c, double x, double y, const double rgb[3], const char *words)
{
    cairo_rectangle(c, x, y - 8, 9, 9);
    cairo_set_source_rgb(c, rgb[0], rgb[1], rgb[2]);
    cairo_fill(c);
    return write_words(c, x + 13, y, words) + 14;
}

static void paint_caption(cairo_t *c, const scene *s, double y)
{
    cairo_select_font_face(c, "sans-serif", CAIRO_FONT_SLANT_NORMAL, CAIRO_FONT_WEIGHT_NORMAL);
    cairo_set_font_size(c, 11);
    double x = MARGIN;
    if (s->d->path_count) {
        x = sample(c, x, y, green, "first");
        x = sample(c, x, y, vermilion, "last");
    }
    write_words(c, x, y, s->d->caption);
}

static double page_width(const scene *s)
{
    return 2 * MARGIN + fmax(PAGE_LEAST, (s->shown.high[0] - s->shown.low[0]) * s->scale);
}

static double page_height(const scene *s)
{
    return MARGIN + (s->shown.high[1] - s->shown.low[1]) * s->scale + CAPTION;
}

static void draw(cairo_t *c, const void *self)
{
    const scene *s = self;
    double width = line_width(s);
    cairo_save(c);
    cairo_rectangle(c, 0, 0, page_width(s), page_height(s) - CAPTION + 4);
    cairo_clip(c);
    cairo_set_line_join(c, CAIRO_LINE_JOIN_ROUND);
    for (size_t i = 0; i < s->count; i++) paint(c, s, &s->pieces[i], width);
    paint_line(c, s);
    if (s->d->path_count) {
        ring(c, s, s->d->path[0], green);
        ring(c, s, s->d->path[s->d->path_count - 1], vermilion);
    }
    paint_end(c, s, s->d->line, false);
    paint_end(c, s, s->d->line + 3 * (s->d->line_count - 1), true);
    cairo_restore(c);
    paint_caption(c, s, page_height(s) - 9);
}

/* --- the whole ---------------------------------------------------------------------------------------------------- */

static bool make_room(scene *s)
{
    const drawing *d = s->d;
    s->at = malloc((d->point_count + 1) * sizeof *s->at);
    s->visit = malloc((d->triangle_count + 1) * sizeof *s->visit);
    s->part = malloc((d->path_count + 1) * sizeof *s->part);
    s->pieces = malloc((d->triangle_count + 1) * sizeof *s->pieces);
    return s->at && s->visit && s->part && s->pieces;
}

static void number_visits(scene *s)
{
    const drawing *d = s->d;
    memset(s->visit, 0xff, d->triangle_count * sizeof *s->visit);
    for (size_t i = 0; i < d->path_count; i++)
        if (s->visit[d->path[i]] == UINT32_MAX) s->visit[d->path[i]] = (uint32_t)i;
    for (size_t begin = 0, end; begin < d->path_count; begin = end) {
        for (end = begin; end < d->path_count && d->iteration[end] == d->iteration[begin];) end++;
        for (size_t i = begin; i < end; i++) s->part[i] = (double)(i - begin + 1) / (double)(end - begin);
    }
}

static bool set_scene(scene *s)
{
    if (!make_room(s)) return false;
    measure(s);
    choose_view(s);
    for (size_t v = 0; v < s->d->point_count; v++) s->at[v] = project(s, s->d->points + 3 * v);
    number_visits(s);
    choose_box(s);
    return choose_pieces(s);
}

int drawing_write(const drawing *d, const char *path)
{
    scene s = {.d = d};
    int end = set_scene(&s) ? picture_write(path, page_width(&s), page_height(&s), draw, &s) : fail_memory();
    free(s.at);
    free(s.visit);
    free(s.part);
    free(s.pieces);
    return end;
}

#else

int drawing_write(const drawing *d, const char *path)
{
    (void)d;
    return picture_check(path);
}

#endif
