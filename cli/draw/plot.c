/* plot.c - drawn with Cairo. Colours are those of Okabe and Ito (2008), which colour-blind people can tell apart; a curve
 * also has a mark of its own. Solid: measured; dashed, or an empty bar: published. */
#include "cli/draw/plot.h"
#include "cli/frame/message.h"
#include "cli/draw/picture.h"

#ifdef MW_CAIRO

#include <cairo.h>
#include <math.h>
#include <stdio.h>

/* Measures in points. */
#define PANEL_WIDTH 300.0
#define PANEL_HEIGHT 240.0
#define LEFT 64.0 /* of a panel, for the labels of its axis */
#define RIGHT 14.0
#define ABOVE 30.0
#define BELOW 52.0
#define HEAD 36.0
#define LEGEND_ROW 17.0
#define LEGEND_WIDTH 170.0
#define MOST_COLUMNS 3

/* Text. */

enum { TO_LEFT, CENTRED, TO_RIGHT };

/* The baseline begins, has its middle, or ends at x, y. */
static void write_at(cairo_t *c, double x, double y, const char *words, int how)
{
    cairo_text_extents_t e;
    cairo_text_extents(c, words, &e);
    cairo_move_to(c, x - (how == CENTRED ? e.x_advance / 2 : how == TO_RIGHT ? e.x_advance : 0), y);
    cairo_show_text(c, words);
}

static void write_upright(cairo_t *c, double x, double y, const char *words)
{
    cairo_save(c);
    cairo_translate(c, x, y);
    cairo_rotate(c, -acos(0));
    write_at(c, 0, 0, words, CENTRED);
    cairo_restore(c);
}

static void face(cairo_t *c, double size, bool bold)
{
    cairo_select_font_face(c, "sans-serif", CAIRO_FONT_SLANT_NORMAL,
                           bold ? CAIRO_FONT_WEIGHT_BOLD : CAIRO_FONT_WEIGHT_NORMAL);
    cairo_set_font_size(c, size);
    cairo_set_source_rgb(c, 0.1, 0.1, 0.1);
}

/* A power of ten: 10 with its exponent raised. */
static void write_power(cairo_t *c, double x, double y, int exponent)
{
    cairo_text_extents_t e;
    char digits[16];
    snprintf(digits, sizeof digits, "%d", exponent);
    cairo_text_extents(c, "10", &e);
    write_at(c, x - 3, y, "10", CENTRED);
    cairo_save(c);
    cairo_set_font_size(c, 7);
    write_at(c, x - 3 + e.x_advance / 2, y - 4, digits, TO_LEFT);
    cairo_restore(c);
}

/* How a curve looks. */

static void colour(cairo_t *c, size_t curve)
{
    static const double rgb[PLOT_CURVES][3] = {
        {0.00, 0.45, 0.70}, {0.84, 0.37, 0.00}, {0.00, 0.62, 0.45}, {0.00, 0.00, 0.00},
        {0.80, 0.47, 0.65}, {0.90, 0.62, 0.00}, {0.34, 0.71, 0.91}, {0.50, 0.50, 0.50},
    };
    cairo_set_source_rgb(c, rgb[curve][0], rgb[curve][1], rgb[curve][2]);
}

/* Triangle, square, pentagon, ..., then the same standing on a side. */
static void mark(cairo_t *c, size_t curve, double x, double y, bool full)
{
    int corners = 3 + (int)(curve % 4);
    double radius = 4.2, turn = curve < 4 ? 0 : acos(-1) / corners;
    cairo_new_path(c);
    for (int k = 0; k < corners; k++) {
        double angle = turn + 2 * acos(-1) * k / corners;
        cairo_line_to(c, x + radius * sin(angle), y - radius * cos(angle));
    }
    cairo_close_path(c);
    if (full) {
        cairo_fill(c);
        return;
    }
    cairo_set_line_width(c, 1);
    cairo_stroke(c);
}

static void dash(cairo_t *c, bool on)
{
    cairo_set_dash(c, (const double[]){3, 3}, on ? 2 : 0, 0);
    cairo_set_line_width(c, on ? 1 : 1.6);
}

/* An axis: from low to high on so many points of the page. */

typedef struct axis {
    double low, high, begin, length;
    bool logarithmic;
} axis;

static double place(const axis *a, double value)
{
    double part = a->logarithmic ? log(value / a->low) / log(a->high / a->low) : (value - a->low) / (a->high - a->low);
    return a->begin + part * a->length;
}

/* The next of 1, 2, 5, 10, ... that is at least `value`. */
static double round_up(double value)
{
    double unit = pow(10, floor(log10(value)));
    for (int k = 0; k < 3; k++) {
        static const double step[] = {1, 2, 5};
        if (step[k] * unit >= value * (1 - 1e-9)) return step[k] * unit;
    }
    return 10 * unit;
}

/* What is measured, or published; NaN where there is nothing, or a logarithmic axis has no place for it: a clock may be
 * too coarse to tell a time from 0. */
static double value_of(const plot *p, const plot_point *at, bool published)
{
    double value = published ? at->published : at->ours;
    return p->log_y && value <= 0 ? NAN : value;
}

/* Range of the values in a panel. */
typedef struct range {
    double x[2], y[2];
} range;

static range range_of(const plot *p, const plot_panel *panel)
{
    range r = {{INFINITY, -INFINITY}, {INFINITY, -INFINITY}};
    for (size_t k = 0; k < p->curves; k++)
        for (size_t i = 0; i < panel->curve[k].count; i++) {
            const plot_point *at = &panel->curve[k].point[i];
            r.x[0] = fmin(r.x[0], at->x);
            r.x[1] = fmax(r.x[1], at->x);
            double ours = value_of(p, at, false), published = value_of(p, at, true);
            r.y[0] = fmin(r.y[0], fmin(ours, published)); /* passes over NaN */
            r.y[1] = fmax(r.y[1], fmax(ours, published));
        }
    return r;
}

static void draw_frame(cairo_t *c)
{
    cairo_set_source_rgb(c, 0.1, 0.1, 0.1);
    cairo_set_line_width(c, 0.8);
    cairo_rectangle(c, 0, 0, PANEL_WIDTH, PANEL_HEIGHT);
    cairo_stroke(c);
}

static void rule(cairo_t *c, double x, double y, double dx, double dy)
{
    cairo_set_source_rgb(c, 0.85, 0.85, 0.85);
    cairo_set_line_width(c, 0.6);
    cairo_move_to(c, x, y);
    cairo_rel_line_to(c, dx, dy);
    cairo_stroke(c);
    face(c, 10, false);
}

static void draw_y_tick(cairo_t *c, const axis *y, double value)
{
    char words[32];
    double at = place(y, value);
    if (value < y->low * (1 - 1e-9) || value > y->high * (1 + 1e-9)) return;
    rule(c, 0, at, PANEL_WIDTH, 0);
    snprintf(words, sizeof words, "%g", round(value * 1e6) / 1e6);
    write_at(c, -6, at + 3.5, words, TO_RIGHT);
}

/* Bars stand on zero; else the axis holds what there is. */
static void draw_linear_axis(cairo_t *c, axis *y, const range *r, bool bars)
{
    double low = bars ? 0 : r->y[0], high = r->y[1] > low ? r->y[1] : low + 1, step = round_up((high - low) / 6);
    y->low = step * floor(low / step);
    y->high = step * (floor(high / step) + 1);
    for (int k = 0; k <= (int)round((y->high - y->low) / step); k++) draw_y_tick(c, y, y->low + k * step);
}

/* With 1, 2 and 5 of each power of ten. */
static void draw_log_axis(cairo_t *c, axis *y, const range *r)
{
    y->low = r->y[0] / 1.3;
    y->high = r->y[1] * 1.3;
    for (double unit = pow(10, floor(log10(y->low))); unit < y->high; unit *= 10) {
        draw_y_tick(c, y, unit);
        draw_y_tick(c, y, 2 * unit);
        draw_y_tick(c, y, 5 * unit);
    }
}

static axis draw_y_axis(cairo_t *c, const plot *p, const range *r, bool bars)
{
    axis y = {.begin = PANEL_HEIGHT, .length = -PANEL_HEIGHT, .logarithmic = p->log_y && !bars};
    if (y.logarithmic)
        draw_log_axis(c, &y, r);
    else
        draw_linear_axis(c, &y, r, bars);
    return y;
}

static axis draw_x_axis(cairo_t *c, const range *r)
{
    axis x = {.low = r->x[0] / 1.5, .high = r->x[1] * 1.5, .length = PANEL_WIDTH, .logarithmic = true};
    for (int k = (int)ceil(log10(x.low)); pow(10, k) <= x.high; k++) {
        rule(c, place(&x, pow(10, k)), 0, 0, PANEL_HEIGHT);
        write_power(c, place(&x, pow(10, k)), PANEL_HEIGHT + 15, k);
    }
    return x;
}

/* Curves and bars. */

static void draw_curve(cairo_t *c, const plot *p, size_t k, const plot_curve *curve, const axis *x, const axis *y,
                       bool published)
{
    colour(c, k);
    dash(c, published);
    cairo_new_path(c);
    for (size_t i = 0; i < curve->count; i++) {
        double value = value_of(p, &curve->point[i], published);
        if (!isnan(value)) cairo_line_to(c, place(x, curve->point[i].x), place(y, value));
    }
    cairo_stroke(c);
    cairo_set_dash(c, NULL, 0, 0);
    for (size_t i = 0; i < curve->count; i++) {
        double value = value_of(p, &curve->point[i], published);
        if (!isnan(value)) mark(c, k, place(x, curve->point[i].x), place(y, value), !published);
    }
}

static void draw_curves(cairo_t *c, const plot *p, const plot_panel *panel, const range *r, const axis *y)
{
    axis x = draw_x_axis(c, r);
    for (int published = 1; published >= 0; published--)
        for (size_t k = 0; k < p->curves; k++) draw_curve(c, p, k, &panel->curve[k], &x, y, published);
    face(c, 11, false);
    write_at(c, PANEL_WIDTH / 2, PANEL_HEIGHT + 36, p->x_label, CENTRED);
}

static void draw_bars(cairo_t *c, const plot *p, const plot_panel *panel, const axis *y)
{
    double room = PANEL_WIDTH / (double)p->curves, width = fmin(0.38 * room, 40);
    for (size_t k = 0; k < p->curves; k++) {
        const plot_point *at = &panel->curve[k].point[0];
        double middle = ((double)k + 0.5) * room;
        bool pair = !isnan(at->published);
        colour(c, k);
        cairo_rectangle(c, pair ? middle - width : middle - width / 2, PANEL_HEIGHT, width,
                        place(y, at->ours) - PANEL_HEIGHT);
        cairo_fill(c);
        if (pair) {
            cairo_set_line_width(c, 1);
            cairo_rectangle(c, middle + 1, PANEL_HEIGHT, width - 2, place(y, at->published) - PANEL_HEIGHT);
            cairo_stroke(c);
        }
        face(c, 10, false);
        write_at(c, middle, PANEL_HEIGHT + 15, p->label[k], CENTRED);
    }
}

static bool has_bars(const plot *p, const plot_panel *panel)
{
    for (size_t k = 0; k < p->curves; k++)
        if (panel->curve[k].count > 1) return false;
    return true;
}

/* As large as fits. */
static void write_title(cairo_t *c, const char *title)
{
    cairo_text_extents_t e;
    face(c, 11, true);
    cairo_text_extents(c, title, &e);
    if (e.width > PANEL_WIDTH) face(c, 11 * PANEL_WIDTH / e.width, true);
    write_at(c, PANEL_WIDTH / 2, -8, title, CENTRED);
}

/* The origin is the upper left corner of the frame. */
static void draw_panel(cairo_t *c, const plot *p, const plot_panel *panel)
{
    bool bars = has_bars(p, panel);
    range r = range_of(p, panel);
    axis y = draw_y_axis(c, p, &r, bars);
    if (bars)
        draw_bars(c, p, panel, &y);
    else
        draw_curves(c, p, panel, &r, &y);
    draw_frame(c);
    face(c, 11, false);
    write_upright(c, -44, PANEL_HEIGHT / 2, p->y_label);
    write_title(c, panel->title);
}

static bool has_published(const plot *p)
{
    for (size_t i = 0; i < p->count; i++)
        for (size_t k = 0; k < p->curves; k++)
            for (size_t n = 0; n < p->panels[i].curve[k].count; n++)
                if (!isnan(p->panels[i].curve[k].point[n].published)) return true;
    return false;
}

/* Where there is something published, two more rows for what solid and dashed mean. */
static void draw_legend(cairo_t *c, const plot *p)
{
    size_t rows = has_published(p) ? p->curves + 2 : p->curves;
    for (size_t k = 0; k < rows; k++) {
        double y = LEGEND_ROW * ((double)k + (k >= p->curves ? 0.5 : 0));
        bool sample = k<p->curves, published = k> p->curves;
        if (sample)
            colour(c, k);
        else
            cairo_set_source_rgb(c, 0.3, 0.3, 0.3);
        dash(c, published);
        cairo_move_to(c, 0, y);
        cairo_line_to(c, 30, y);
        cairo_stroke(c);
        cairo_set_dash(c, NULL, 0, 0);
        if (sample) mark(c, k, 15, y, true);
        face(c, 10, false);
        write_at(c, 38, y + 3.5, sample ? p->name[k] : published ? "published" : "measured", TO_LEFT);
    }
}

typedef struct page {
    size_t columns, rows;
    double width, height;
} page;

static page lay_out(const plot *p)
{
    page g = {.columns = p->count == 4 ? 2 : p->count < MOST_COLUMNS ? p->count : MOST_COLUMNS};
    g.rows = (p->count + g.columns - 1) / g.columns;
    g.width = (double)g.columns * (LEFT + PANEL_WIDTH + RIGHT) + LEGEND_WIDTH;
    g.height = HEAD + (double)g.rows * (ABOVE + PANEL_HEIGHT + BELOW);
    return g;
}

static void draw_page(cairo_t *c, const plot *p, const page *g)
{
    face(c, 13, true);
    write_at(c, g->width / 2, 24, p->title, CENTRED);
    for (size_t i = 0; i < p->count; i++) {
        double column = (double)(i % g->columns), row = (double)(i / g->columns);
        cairo_save(c);
        cairo_translate(c, LEFT + column * (LEFT + PANEL_WIDTH + RIGHT),
                        HEAD + ABOVE + row * (ABOVE + PANEL_HEIGHT + BELOW));
        draw_panel(c, p, &p->panels[i]);
        cairo_restore(c);
    }
    cairo_translate(c, g->width - LEGEND_WIDTH + 8, HEAD + ABOVE + 12);
    draw_legend(c, p);
}

static void draw(cairo_t *c, const void *self)
{
    const plot *p = self;
    page g = lay_out(p);
    draw_page(c, p, &g);
}

int plot_write(const plot *p, const char *path)
{
    page g = lay_out(p);
    return picture_write(path, g.width, g.height, draw, p);
}

#else

int plot_write(const plot *p, const char *path)
{
    (void)p;
    return picture_check(path);
}

#endif

int plot_check(const char *path)
{
    int end = picture_check(path);
    if (end || picture_named(path)) return end;
    complain("%s: a plot is an .svg, .png or .pdf file", path);
    return END_USAGE;
}
