/* picture.c - a mesh drawn into pixels: every pixel whose middle a triangle contains gets its
 * colour and its number. In space the nearest triangle wins; in the plane the last one.
 *
 * A view is a matrix of three rows: pixel x, pixel y and depth are m[0] x + m[1] y + m[2] z + m[3],
 * and so on. Depth grows away from the eye. */
#include "engine/mesh_object.h"

#include <math.h>
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>

enum { COLOURS = 256, MISSING = COLOURS, PLAIN, PALETTE };

/* Light of 45 degrees falls on flat ground: it keeps its colour; slopes that face the sun are
 * lighter. */
#define DARKEST 0.25
#define SUN_HEIGHT 0.7071

typedef struct web_picture {
    web_mesh *mesh;
    const double *values; /* NULL: none */
    bool of_triangles;
    double low, high;
    float *shade;              /* light on each triangle, 0 to 1; NULL: none */
    uint8_t *borders;          /* of each triangle 1 << k for each edge k on a border */
    uint32_t palette[PALETTE]; /* as canvases have them: red is the lowest byte */
    int width, height;
    uint32_t *pixels, *numbers;
    float *depth;
    double *screen; /* pixel x, y and depth of each vertex */
    bool in_space;
    uint32_t visible; /* triangles that have a part in the picture */
} web_picture;

void WEB_EXPORT(web_picture_free)(web_picture *p)
{
    if (!p) return;
    free(p->shade);
    free(p->borders);
    free(p->pixels);
    free(p->numbers);
    free(p->depth);
    free(p->screen);
    free(p);
}

web_picture *WEB_EXPORT(web_picture_make)(web_mesh *mesh)
{
    web_picture *p = calloc(1, sizeof *p);
    if (!p) return NULL;
    p->mesh = mesh;
    p->screen = malloc((mesh->file.point_count + 1) * 3 * sizeof *p->screen);
    p->borders = calloc(mesh->file.triangle_count + 1, 1);
    if (p->screen && p->borders) return p;
    web_picture_free(p);
    return NULL;
}

/* Returns 0 if there is no memory. */
int WEB_EXPORT(web_picture_resize)(web_picture *p, int width, int height)
{
    size_t count = (size_t)width * (size_t)height;
    free(p->pixels);
    free(p->numbers);
    free(p->depth);
    p->pixels = malloc(count * sizeof *p->pixels);
    p->numbers = malloc(count * sizeof *p->numbers);
    p->depth = malloc(count * sizeof *p->depth);
    p->width = width;
    p->height = height;
    return p->pixels && p->numbers && p->depth;
}

/* The colours of the values from low to high, then that of missing ones, then that of none. */
uint32_t *WEB_EXPORT(web_picture_palette)(web_picture *p)
{
    return p->palette;
}

void WEB_EXPORT(web_picture_values)(web_picture *p, const double *values, int of_triangles,
                                    double low, double high)
{
    p->values = values;
    p->of_triangles = of_triangles;
    p->low = low;
    p->high = high;
}

/* Of each triangle 1 << k for each edge k on a border; 0 until the caller says so. */
uint8_t *WEB_EXPORT(web_picture_borders)(web_picture *p)
{
    return p->borders;
}

uint32_t *WEB_EXPORT(web_picture_pixels)(web_picture *p)
{
    return p->pixels;
}

/* The triangle of each pixel; MW_NONE: none. */
uint32_t *WEB_EXPORT(web_picture_numbers)(web_picture *p)
{
    return p->numbers;
}

uint32_t WEB_EXPORT(web_picture_visible)(const web_picture *p)
{
    return p->visible;
}

/* fmin and fmax are calls in WebAssembly; no value here is NaN but those of bad vertices, which are
 * in no picture. */
static double least(double a, double b)
{
    return a < b ? a : b;
}

static double greatest(double a, double b)
{
    return a > b ? a : b;
}

/* --- light ------------------------------------------------------------------------------------ */

static void picture_normal(const double *a, const double *b, const double *c, double lift,
                           double normal[3])
{
    double u[3], v[3];
    for (int k = 0; k < 3; k++) {
        double factor = k == 2 ? lift : 1;
        u[k] = factor * (b[k] - a[k]);
        v[k] = factor * (c[k] - a[k]);
    }
    for (int k = 0; k < 3; k++)
        normal[k] = u[(k + 1) % 3] * v[(k + 2) % 3] - u[(k + 2) % 3] * v[(k + 1) % 3];
}

/* Light from a direction; heights are multiplied by `lift`. In the plane every triangle faces up;
 * in space both sides are lit alike. 0 for no light at all. */
int WEB_EXPORT(web_picture_light)(web_picture *p, int lit, int in_space, double lift, double x,
                                  double y, double z)
{
    const mw_mesh_file *f = &p->mesh->file;
    free(p->shade);
    p->shade = NULL;
    if (!lit) return 1;
    p->shade = malloc((f->triangle_count + 1) * sizeof *p->shade);
    if (!p->shade) return 0;
    for (size_t t = 0; t < f->triangle_count; t++) {
        const uint32_t *v = f->triangles + 3 * t;
        double n[3];
        picture_normal(f->points + 3 * (size_t)v[0], f->points + 3 * (size_t)v[1],
                       f->points + 3 * (size_t)v[2], lift, n);
        double length = sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
        double light = length > 0 ? (x * n[0] + y * n[1] + z * n[2]) / length : 1;
        if (in_space) light = fabs(light);
        if (!in_space && n[2] < 0) light = -light;
        p->shade[t] = (float)(DARKEST + (1 - DARKEST) / SUN_HEIGHT * greatest(0, light));
    }
    return 1;
}

/* --- pixels ----------------------------------------------------------------------------------- */

static uint32_t picture_shaded(uint32_t colour, float light)
{
    uint32_t shaded = colour & 0xff000000u, part = (uint32_t)(256 * light);
    for (int shift = 0; shift < 24; shift += 8) {
        uint32_t channel = (colour >> shift & 255) * part >> 8;
        shaded |= (channel < 255 ? channel : 255) << shift;
    }
    return shaded;
}

static uint32_t picture_colour(const web_picture *p, double value)
{
    if (isnan(value)) return p->palette[MISSING];
    double part = p->high > p->low ? (value - p->low) / (p->high - p->low) : 0.5;
    return p->palette[(int)(greatest(0, least(1, part)) * (COLOURS - 1) + 0.5)];
}

/* A triangle on the screen, and what changes from pixel to pixel. */
typedef struct web_facet {
    const double *corner[3];
    uint32_t number;
    float light;
    uint32_t colour;           /* where all pixels have the same */
    bool varies;               /* the value changes from pixel to pixel */
    double value[3], depth[3]; /* at the origin, per pixel to the right, per pixel down */
} web_facet;

/* The plane through three values at the corners; `part` is 1 / area. */
static void facet_plane(const web_facet *f, double part, double a, double b, double c,
                        double plane[3])
{
    const double *p = f->corner[0], *q = f->corner[1], *r = f->corner[2];
    plane[1] = ((b - a) * (r[1] - p[1]) - (c - a) * (q[1] - p[1])) * part;
    plane[2] = ((c - a) * (q[0] - p[0]) - (b - a) * (r[0] - p[0])) * part;
    plane[0] = a - plane[1] * p[0] - plane[2] * p[1];
}

static void facet_prepare(const web_picture *p, web_facet *f, double area)
{
    const uint32_t *v = p->mesh->file.triangles + 3 * (size_t)f->number;
    f->light = p->shade ? p->shade[f->number] : 1;
    f->varies = p->values && !p->of_triangles;
    if (f->varies)
        facet_plane(f, 1 / area, p->values[v[0]], p->values[v[1]], p->values[v[2]], f->value);
    if (!p->values) f->colour = p->palette[PLAIN];
    if (p->values && p->of_triangles) f->colour = picture_colour(p, p->values[f->number]);
    if (!f->varies && p->shade) f->colour = picture_shaded(f->colour, f->light);
    if (p->in_space)
        facet_plane(f, 1 / area, f->corner[0][2], f->corner[1][2], f->corner[2][2], f->depth);
}

static void facet_pixel(web_picture *p, const web_facet *f, int x, int y)
{
    size_t at = (size_t)y * (size_t)p->width + (size_t)x;
    if (p->in_space) {
        float depth = (float)(f->depth[0] + f->depth[1] * (x + 0.5) + f->depth[2] * (y + 0.5));
        if (depth >= p->depth[at]) return;
        p->depth[at] = depth;
    }
    uint32_t colour = f->colour;
    if (f->varies) {
        colour = picture_colour(p, f->value[0] + f->value[1] * (x + 0.5) + f->value[2] * (y + 0.5));
        if (p->shade) colour = picture_shaded(colour, f->light);
    }
    p->pixels[at] = colour;
    p->numbers[at] = f->number;
}

/* The pixels of a row whose middles lie between the edges: from *first to before *last. */
static void facet_row(const web_facet *f, double y, int width, int *first, int *last)
{
    double low = INFINITY, high = -INFINITY;
    for (int k = 0; k < 3; k++) {
        const double *a = f->corner[k], *b = f->corner[(k + 1) % 3];
        if ((a[1] <= y) == (b[1] <= y)) continue;
        double x = a[0] + (y - a[1]) / (b[1] - a[1]) * (b[0] - a[0]);
        low = least(low, x);
        high = greatest(high, x);
    }
    *first = (int)greatest(0, ceil(low - 0.5));
    *last = (int)least(width, ceil(high - 0.5));
}

static int picture_limit(double value, int most)
{
    return value < 0 ? 0 : value > most ? most : (int)value;
}

static void facet_draw(web_picture *p, web_facet *f)
{
    double low[2] = {INFINITY, INFINITY}, high[2] = {-INFINITY, -INFINITY};
    for (int k = 0; k < 3; k++)
        for (int i = 0; i < 2; i++) {
            low[i] = least(low[i], f->corner[k][i]);
            high[i] = greatest(high[i], f->corner[k][i]);
        }
    if (!(high[0] >= 0 && low[0] <= p->width && high[1] >= 0 && low[1] <= p->height)) return;
    p->visible++;
    const double *a = f->corner[0], *b = f->corner[1], *c = f->corner[2];
    double area = (b[0] - a[0]) * (c[1] - a[1]) - (c[0] - a[0]) * (b[1] - a[1]);
    int top = picture_limit(ceil(low[1] - 0.5), p->height);
    int bottom = picture_limit(ceil(high[1] - 0.5), p->height);
    if (area == 0 || ceil(low[0] - 0.5) >= ceil(high[0] - 0.5)) return;
    bool ready = false; /* most small triangles have no pixel */
    for (int y = top; y < bottom; y++) {
        int first, last;
        facet_row(f, y + 0.5, p->width, &first, &last);
        if (!ready && first < last) {
            facet_prepare(p, f, area);
            ready = true;
        }
        for (int x = first; x < last; x++) facet_pixel(p, f, x, y);
    }
}

static void picture_project(web_picture *p, const double *m)
{
    const double *q = p->mesh->file.points;
    double *s = p->screen;
    for (size_t i = 0; i < p->mesh->file.point_count; i++, q += 3, s += 3)
        for (int k = 0; k < 3; k++) {
            s[k] = m[4 * k] * q[0] + m[4 * k + 1] * q[1] + m[4 * k + 3];
            if (p->in_space) s[k] += m[4 * k + 2] * q[2];
        }
}

/* Draw all triangles into pixels that are clear. */
void WEB_EXPORT(web_picture_draw)(web_picture *p, const double *matrix, int in_space)
{
    size_t count = (size_t)p->width * (size_t)p->height;
    const mw_mesh_file *file = &p->mesh->file;
    p->in_space = in_space;
    p->visible = 0;
    memset(p->pixels, 0, count * sizeof *p->pixels);
    memset(p->numbers, 255, count * sizeof *p->numbers);
    for (size_t i = 0; in_space && i < count; i++) p->depth[i] = INFINITY;
    picture_project(p, matrix);
    for (size_t t = 0; t < file->triangle_count; t++) {
        const uint32_t *v = file->triangles + 3 * t;
        web_facet f = {.number = (uint32_t)t};
        for (int k = 0; k < 3; k++) f.corner[k] = p->screen + 3 * (size_t)v[k];
        facet_draw(p, &f);
    }
}

/* --- edges in space --------------------------------------------------------------------------- */

/* The lines of a picture: half their widths in pixels, and how much of the ink edges take. */
typedef struct web_pen {
    uint32_t ink;
    double edge, border, alpha;
} web_pen;

/* The edges of one triangle on the screen: side[k] is the distance of a pixel from edge k. */
typedef struct web_sides {
    uint32_t number;
    double side[3][3]; /* at the origin, per pixel to the right, per pixel down */
} web_sides;

static void sides_prepare(const web_picture *p, web_sides *s, uint32_t number)
{
    const uint32_t *v = p->mesh->file.triangles + 3 * (size_t)number;
    s->number = number;
    for (int k = 0; k < 3; k++) {
        const double *a = p->screen + 3 * (size_t)v[k], *b = p->screen + 3 * (size_t)v[(k + 1) % 3];
        double across = b[0] - a[0], down = b[1] - a[1], length = hypot(across, down);
        double part = length > 0 ? 1 / length : 0;
        s->side[k][1] = part * down;
        s->side[k][2] = -part * across;
        s->side[k][0] = -s->side[k][1] * a[0] - s->side[k][2] * a[1];
    }
}

/* How much ink a pixel gets, 0 to 1: each of two neighbours draws half of their common edge. */
static double sides_ink(const web_sides *s, const web_pen *pen, unsigned borders, double x,
                        double y)
{
    double ink = 0;
    for (int k = 0; k < 3; k++) {
        bool border = borders >> k & 1 && pen->border > 0;
        double half = border ? pen->border : pen->edge;
        if (half <= 0) continue;
        double away = fabs(s->side[k][0] + s->side[k][1] * x + s->side[k][2] * y);
        ink = greatest(ink, (border ? 1 : pen->alpha) * least(1, half + 0.5 - away));
    }
    return ink;
}

static uint32_t picture_mixed(uint32_t colour, uint32_t ink, double part)
{
    uint32_t mixed = colour & 0xff000000u;
    for (int shift = 0; shift < 24; shift += 8) {
        double from = colour >> shift & 255, to = ink >> shift & 255;
        mixed |= (uint32_t)(from + part * (to - from) + 0.5) << shift;
    }
    return mixed;
}

/* Draw the edges of all triangles that are seen in the last picture, and stronger the borders, in
 * lines of the given widths; 0: none. Hidden edges stay hidden. */
void WEB_EXPORT(web_picture_edges)(web_picture *p, uint32_t ink, double edge, double border,
                                   double alpha)
{
    const web_pen pen = {.ink = ink, .edge = edge / 2, .border = border / 2, .alpha = alpha};
    web_sides s = {.number = MW_NONE};
    for (int y = 0; y < p->height; y++)
        for (int x = 0; x < p->width; x++) {
            size_t at = (size_t)y * (size_t)p->width + (size_t)x;
            uint32_t number = p->numbers[at];
            if (number == MW_NONE || (edge <= 0 && !p->borders[number])) continue;
            if (number != s.number) sides_prepare(p, &s, number);
            double part = sides_ink(&s, &pen, p->borders[number], x + 0.5, y + 0.5);
            if (part > 0) p->pixels[at] = picture_mixed(p->pixels[at], pen.ink, part);
        }
}

/* The triangles that the last picture has a part of, at most `room`. Returns how many. */
uint32_t WEB_EXPORT(web_picture_list)(const web_picture *p, uint32_t *list, uint32_t room)
{
    const mw_mesh_file *file = &p->mesh->file;
    uint32_t count = 0;
    for (size_t t = 0; t < file->triangle_count && count < room; t++) {
        bool inside = true;
        for (int i = 0; i < 2 && inside; i++) {
            double low = INFINITY, high = -INFINITY;
            for (int k = 0; k < 3; k++) {
                double at = p->screen[3 * (size_t)file->triangles[3 * t + (size_t)k] + (size_t)i];
                low = least(low, at);
                high = greatest(high, at);
            }
            inside = high >= 0 && low <= (i ? p->height : p->width);
        }
        if (inside) list[count++] = (uint32_t)t;
    }
    return count;
}
