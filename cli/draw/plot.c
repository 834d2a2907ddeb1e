/* plot.c - draws plots with Cairo. The colours are those of [Okabe, Ito 2008], which
 * colour-blind people can tell apart; each curve has a mark of its own too. Measured figures are
 * solid, published ones are dashed lines or empty bars. */
#include "cli/draw/plot.h"
#include "cli/frame/message.h"
#include "cli/draw/picture.h"

#ifdef MW_CAIRO

#include <cairo.h>
#include <math.h>
#include <stdio.h>

/* Lengths in points. */
#define PANEL_WIDTH 300.0
#define PANEL_HEIGHT 240.0
#define LEFT 64.0 /* of a panel: room for the labels of its axis */
#define RIGHT 14.0
#define ABOVE 30.0
#define BELOW 52.0
#define HEAD 36.0
#define LEGEND_ROW 17.0
#define LEGEND_WIDTH 170.0
#define MAX_PANEL_COLUMNS 3

/* Text. */

enum { TO_LEFT, CENTRED, TO_RIGHT };

/* The text begins at x, y, is centred there, or ends there. */
static void plot_write_text(cairo_t *c, double x, double y, const char *words, int how)
{
    cairo_text_extents_t e;
    cairo_text_extents(c, words, &e);
    cairo_move_to(c, x - (how == CENTRED ? e.x_advance / 2 : how == TO_RIGHT ? e.x_advance : 0), y);
    cairo_show_text(c, words);
}

static void plot_write_upright(cairo_t *c, double x, double y, const char *words)
{
    cairo_save(c);
    cairo_translate(c, x, y);
    cairo_rotate(c, -acos(0));
    plot_write_text(c, 0, 0, words, CENTRED);
    cairo_restore(c);
}

static void plot_set_font(cairo_t *c, double size, bool bold)
{
    cairo_select_font_face(c, "sans-serif", CAIRO_FONT_SLANT_NORMAL,
                           bold ? CAIRO_FONT_WEIGHT_BOLD : CAIRO_FONT_WEIGHT_NORMAL);
    cairo_set_font_size(c, size);
    cairo_set_source_rgb(c, 0.1, 0.1, 0.1);
}

/* Write a power of ten: 10 with a raised exponent. */
static void plot_write_power(cairo_t *c, double x, double y, int exponent)
{
    cairo_text_extents_t e;
    char digits[16];
    snprintf(digits, sizeof digits, "%d", exponent);
    cairo_text_extents(c, "10", &e);
    plot_write_text(c, x - 3, y, "10", CENTRED);
    cairo_save(c);
    cairo_set_font_size(c, 7);
    plot_write_text(c, x - 3 + e.x_advance / 2, y - 4, digits, TO_LEFT);
    cairo_restore(c);
}

/* How a curve looks. */

static void plot_set_colour(cairo_t *c, size_t curve)
{
    static const double rgb[PLOT_CURVES][3] = {
        {0.00, 0.45, 0.70}, {0.84, 0.37, 0.00}, {0.00, 0.62, 0.45}, {0.00, 0.00, 0.00},
        {0.80, 0.47, 0.65}, {0.90, 0.62, 0.00}, {0.34, 0.71, 0.91}, {0.50, 0.50, 0.50},
    };
    cairo_set_source_rgb(c, rgb[curve][0], rgb[curve][1], rgb[curve][2]);
}

/* Draw the mark of a curve: triangle, square, pentagon, hexagon, then the same standing on a
 * side. */
static void plot_mark(cairo_t *c, size_t curve, double x, double y, bool full)
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

static void plot_set_dash(cairo_t *c, bool on)
{
    cairo_set_dash(c, (const double[]){3, 3}, on ? 2 : 0, 0);
    cairo_set_line_width(c, on ? 1 : 1.6);
}

/* An axis: the values from low to high take `length` points of the page, from `begin` on. */

typedef struct plot_axis {
    double low, high, begin, length;
    bool logarithmic;
} plot_axis;

static double plot_axis_position(const plot_axis *a, double value)
{
    double part = a->logarithmic ? log(value / a->low) / log(a->high / a->low)
                                 : (value - a->low) / (a->high - a->low);
    return a->begin + part * a->length;
}

/* The next of 1, 2, 5, 10, ... that is at least `value`. */
static double plot_round_up(double value)
{
    double unit = pow(10, floor(log10(value)));
    for (int k = 0; k < 3; k++) {
        static const double step[] = {1, 2, 5};
        if (step[k] * unit >= value * (1 - 1e-9)) return step[k] * unit;
    }
    return 10 * unit;
}

/* A measured or published value; NaN if there is none, and on a logarithmic axis if it is not
 * positive. A time may be 0 if the clock is too coarse. */
static double plot_value(const plot *p, const plot_point *at, bool published)
{
    double value = published ? at->published : at->ours;
    return p->log_y && value <= 0 ? NAN : value;
}

/* The range of the values in a panel. */
typedef struct plot_range {
    double x[2], y[2];
} plot_range;

static plot_range plot_range_of(const plot *p, const plot_panel *panel)
{
    plot_range r = {{INFINITY, -INFINITY}, {INFINITY, -INFINITY}};
    for (size_t k = 0; k < p->curves; k++)
        for (size_t i = 0; i < panel->curve[k].count; i++) {
            const plot_point *at = &panel->curve[k].point[i];
            r.x[0] = fmin(r.x[0], at->x);
            r.x[1] = fmax(r.x[1], at->x);
            double ours = plot_value(p, at, false), published = plot_value(p, at, true);
            r.y[0] = fmin(r.y[0], fmin(ours, published)); /* fmin ignores NaN */
            r.y[1] = fmax(r.y[1], fmax(ours, published));
        }
    return r;
}

static void plot_draw_frame(cairo_t *c)
{
    cairo_set_source_rgb(c, 0.1, 0.1, 0.1);
    cairo_set_line_width(c, 0.8);
    cairo_rectangle(c, 0, 0, PANEL_WIDTH, PANEL_HEIGHT);
    cairo_stroke(c);
}

static void plot_draw_rule(cairo_t *c, double x, double y, double dx, double dy)
{
    cairo_set_source_rgb(c, 0.85, 0.85, 0.85);
    cairo_set_line_width(c, 0.6);
    cairo_move_to(c, x, y);
    cairo_rel_line_to(c, dx, dy);
    cairo_stroke(c);
    plot_set_font(c, 10, false);
}

static void plot_draw_y_tick(cairo_t *c, const plot_axis *y, double value)
{
    char words[32];
    double at = plot_axis_position(y, value);
    if (value < y->low * (1 - 1e-9) || value > y->high * (1 + 1e-9)) return;
    plot_draw_rule(c, 0, at, PANEL_WIDTH, 0);
    snprintf(words, sizeof words, "%g", round(value * 1e6) / 1e6);
    plot_write_text(c, -6, at + 3.5, words, TO_RIGHT);
}

/* The axis begins at 0 for bars, and near the least value for curves. */
static void plot_draw_linear_axis(cairo_t *c, plot_axis *y, const plot_range *r, bool bars)
{
    double low = bars ? 0 : r->y[0], high = r->y[1] > low ? r->y[1] : low + 1,
           step = plot_round_up((high - low) / 6);
    y->low = step * floor(low / step);
    y->high = step * (floor(high / step) + 1);
    for (int k = 0; k <= (int)round((y->high - y->low) / step); k++)
        plot_draw_y_tick(c, y, y->low + k * step);
}

/* Draw the ticks 1, 2 and 5 of each power of ten. */
static void plot_draw_log_axis(cairo_t *c, plot_axis *y, const plot_range *r)
{
    y->low = r->y[0] / 1.3;
    y->high = r->y[1] * 1.3;
    for (double unit = pow(10, floor(log10(y->low))); unit < y->high; unit *= 10) {
        plot_draw_y_tick(c, y, unit);
        plot_draw_y_tick(c, y, 2 * unit);
        plot_draw_y_tick(c, y, 5 * unit);
    }
}

static plot_axis plot_draw_y_axis(cairo_t *c, const plot *p, const plot_range *r, bool bars)
{
    plot_axis y = {
        .begin = PANEL_HEIGHT, .length = -PANEL_HEIGHT, .logarithmic = p->log_y && !bars};
    if (y.logarithmic)
        plot_draw_log_axis(c, &y, r);
    else
        plot_draw_linear_axis(c, &y, r, bars);
    return y;
}

static plot_axis plot_draw_x_axis(cairo_t *c, const plot_range *r)
{
    plot_axis x = {
        .low = r->x[0] / 1.5, .high = r->x[1] * 1.5, .length = PANEL_WIDTH, .logarithmic = true};
    for (int k = (int)ceil(log10(x.low)); pow(10, k) <= x.high; k++) {
        plot_draw_rule(c, plot_axis_position(&x, pow(10, k)), 0, 0, PANEL_HEIGHT);
        plot_write_power(c, plot_axis_position(&x, pow(10, k)), PANEL_HEIGHT + 15, k);
    }
    return x;
}

/* Curves and bars. */

static void plot_draw_curve(cairo_t *c, const plot *p, size_t k, const plot_curve *curve,
                            const plot_axis *x, const plot_axis *y, bool published)
{
    plot_set_colour(c, k);
    plot_set_dash(c, published);
    cairo_new_path(c);
    for (size_t i = 0; i < curve->count; i++) {
        double value = plot_value(p, &curve->point[i], published);
        if (!isnan(value))
            cairo_line_to(c, plot_axis_position(x, curve->point[i].x),
                          plot_axis_position(y, value));
    }
    cairo_stroke(c);
    cairo_set_dash(c, NULL, 0, 0);
    for (size_t i = 0; i < curve->count; i++) {
        double value = plot_value(p, &curve->point[i], published);
        if (!isnan(value))
            plot_mark(c, k, plot_axis_position(x, curve->point[i].x), plot_axis_position(y, value),
                      !published);
    }
}

static void plot_draw_curves(cairo_t *c, const plot *p, const plot_panel *panel,
                             const plot_range *r, const plot_axis *y)
{
    plot_axis x = plot_draw_x_axis(c, r);
    for (int published = 1; published >= 0; published--)
        for (size_t k = 0; k < p->curves; k++)
            plot_draw_curve(c, p, k, &panel->curve[k], &x, y, published);
    plot_set_font(c, 11, false);
    plot_write_text(c, PANEL_WIDTH / 2, PANEL_HEIGHT + 36, p->x_label, CENTRED);
}

static void plot_draw_bars(cairo_t *c, const plot *p, const plot_panel *panel, const plot_axis *y)
{
    double room = PANEL_WIDTH / (double)p->curves, width = fmin(0.38 * room, 40);
    for (size_t k = 0; k < p->curves; k++) {
        const plot_point *at = &panel->curve[k].point[0];
        double middle = ((double)k + 0.5) * room;
        bool pair = !isnan(at->published);
        plot_set_colour(c, k);
        cairo_rectangle(c, pair ? middle - width : middle - width / 2, PANEL_HEIGHT, width,
                        plot_axis_position(y, at->ours) - PANEL_HEIGHT);
        cairo_fill(c);
        if (pair) {
            cairo_set_line_width(c, 1);
            cairo_rectangle(c, middle + 1, PANEL_HEIGHT, width - 2,
                            plot_axis_position(y, at->published) - PANEL_HEIGHT);
            cairo_stroke(c);
        }
        plot_set_font(c, 10, false);
        plot_write_text(c, middle, PANEL_HEIGHT + 15, p->label[k], CENTRED);
    }
}

static bool plot_has_bars(const plot *p, const plot_panel *panel)
{
    for (size_t k = 0; k < p->curves; k++)
        if (panel->curve[k].count > 1) return false;
    return true;
}

/* Write the title; smaller if it is too wide. */
static void plot_write_title(cairo_t *c, const char *title)
{
    cairo_text_extents_t e;
    plot_set_font(c, 11, true);
    cairo_text_extents(c, title, &e);
    if (e.width > PANEL_WIDTH) plot_set_font(c, 11 * PANEL_WIDTH / e.width, true);
    plot_write_text(c, PANEL_WIDTH / 2, -8, title, CENTRED);
}

/* The origin is the upper left corner of the frame. */
static void plot_draw_panel(cairo_t *c, const plot *p, const plot_panel *panel)
{
    bool bars = plot_has_bars(p, panel);
    plot_range r = plot_range_of(p, panel);
    plot_axis y = plot_draw_y_axis(c, p, &r, bars);
    if (bars)
        plot_draw_bars(c, p, panel, &y);
    else
        plot_draw_curves(c, p, panel, &r, &y);
    plot_draw_frame(c);
    plot_set_font(c, 11, false);
    plot_write_upright(c, -44, PANEL_HEIGHT / 2, p->y_label);
    plot_write_title(c, panel->title);
}

static bool plot_has_published(const plot *p)
{
    for (size_t i = 0; i < p->count; i++)
        for (size_t k = 0; k < p->curves; k++)
            for (size_t n = 0; n < p->panels[i].curve[k].count; n++)
                if (!isnan(p->panels[i].curve[k].point[n].published)) return true;
    return false;
}

/* If there are published figures, two more rows explain solid and dashed lines. */
static void plot_draw_legend(cairo_t *c, const plot *p)
{
    size_t rows = plot_has_published(p) ? p->curves + 2 : p->curves;
    for (size_t k = 0; k < rows; k++) {
        double y = LEGEND_ROW * ((double)k + (k >= p->curves ? 0.5 : 0));
        bool sample = k<p->curves, published = k> p->curves;
        if (sample)
            plot_set_colour(c, k);
        else
            cairo_set_source_rgb(c, 0.3, 0.3, 0.3);
        plot_set_dash(c, published);
        cairo_move_to(c, 0, y);
        cairo_line_to(c, 30, y);
        cairo_stroke(c);
        cairo_set_dash(c, NULL, 0, 0);
        if (sample) plot_mark(c, k, 15, y, true);
        plot_set_font(c, 10, false);
        plot_write_text(c, 38, y + 3.5,
                        sample      ? p->name[k]
                        : published ? "published"
                                    : "measured",
                        TO_LEFT);
    }
}

typedef struct plot_page {
    size_t columns, rows;
    double width, height;
} plot_page;

static plot_page plot_lay_out(const plot *p)
{
    plot_page g = {.columns = p->count == 4                  ? 2
                              : p->count < MAX_PANEL_COLUMNS ? p->count
                                                             : MAX_PANEL_COLUMNS};
    g.rows = (p->count + g.columns - 1) / g.columns;
    g.width = (double)g.columns * (LEFT + PANEL_WIDTH + RIGHT) + LEGEND_WIDTH;
    g.height = HEAD + (double)g.rows * (ABOVE + PANEL_HEIGHT + BELOW);
    return g;
}

static void plot_draw_page(cairo_t *c, const plot *p, const plot_page *g)
{
    plot_set_font(c, 13, true);
    plot_write_text(c, g->width / 2, 24, p->title, CENTRED);
    for (size_t i = 0; i < p->count; i++) {
        double column = (double)(i % g->columns), row = (double)(i / g->columns);
        cairo_save(c);
        cairo_translate(c, LEFT + column * (LEFT + PANEL_WIDTH + RIGHT),
                        HEAD + ABOVE + row * (ABOVE + PANEL_HEIGHT + BELOW));
        plot_draw_panel(c, p, &p->panels[i]);
        cairo_restore(c);
    }
    cairo_translate(c, g->width - LEGEND_WIDTH + 8, HEAD + ABOVE + 12);
    plot_draw_legend(c, p);
}

static void plot_draw(cairo_t *c, const void *self)
{
    const plot *p = self;
    plot_page g = plot_lay_out(p);
    plot_draw_page(c, p, &g);
}

int plot_write(const plot *p, const char *path)
{
    plot_page g = plot_lay_out(p);
    return picture_write(path, g.width, g.height, plot_draw, p);
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
