/* drawing.c - a scene, painted from back to front with Cairo.
 *
 * Triangles of the walk are filled, from light to dark in their order. In space the mesh is drawn
 * nearly transparent: triangles of the walk that face away are painted first, so they are faintly
 * visible. Green, vermilion and yellow are those of [Okabe, Ito 2008], which colour-blind people
 * can tell apart. */
#include "cli/draw/drawing.h"
#include "cli/draw/animation.h"
#include "cli/frame/message.h"
#include "cli/draw/picture.h"

#ifdef MW_CAIRO

#include "cli/draw/scene.h"

#include <cairo.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Measures in points. */
#define PAGE_SIDE 720.0 /* of the longer side of what is shown */
#define PAGE_LEAST 300.0
#define MARGIN 14.0
#define CAPTION 40.0
#define LEGEND 15.0 /* below the caption */
#define RING 8.0    /* radius */

/* --- colours ---------------------------------------------------------------------------------- */

static const double green[3] = {0.00, 0.62, 0.45}, vermilion[3] = {0.84, 0.37, 0.00},
                    yellow[3] = {0.94, 0.89, 0.26};

static void colour_mix(const double a[3], const double b[3], double part, double rgb[3])
{
    for (int k = 0; k < 3; k++) rgb[k] = a[k] + part * (b[k] - a[k]);
}

#define HUES 4

/* From light to dark: blue, purple, brown, pink. */
static void colour_of_hue(uint32_t hue, double part, double rgb[3])
{
    static const double light[HUES][3] = {
        {0.80, 0.90, 0.98}, {0.93, 0.83, 0.95}, {0.98, 0.92, 0.75}, {0.99, 0.87, 0.90}};
    static const double dark[HUES][3] = {
        {0.03, 0.25, 0.55}, {0.42, 0.13, 0.45}, {0.50, 0.33, 0.00}, {0.62, 0.10, 0.28}};
    colour_mix(light[hue], dark[hue], part, rgb);
}

/* Each stage of a search has a colour; the second stage, the walk, is blue. */
static uint32_t stage_hue(uint32_t stage)
{
    static const uint32_t hues[HUES] = {2, 0, 1, 3};
    return hues[stage % HUES];
}

/* The walks of a probe are blue, purple, brown, and so on again. */
#define WALK_HUES 3u

static uint32_t walk_hue(uint32_t iteration)
{
    return iteration % WALK_HUES;
}

/* Each walk, or each stage of a walk, has a colour, which darkens along the way. */
static void colour_of_visit(const scene *s, uint32_t visit, double rgb[3])
{
    uint32_t hue = s->d->stage ? stage_hue(s->d->stage[visit]) : walk_hue(s->d->iteration[visit]);
    colour_of_hue(hue, s->part[visit], rgb);
}

static void colour_of_triangle(const scene *s, const painted_triangle *p, double rgb[3])
{
    const drawing *d = s->d;
    if (p->triangle == d->path[s->seen - 1])
        memcpy(rgb, vermilion, sizeof vermilion);
    else if (p->triangle == d->path[0])
        memcpy(rgb, green, sizeof green);
    else
        colour_of_visit(s, s->visit[p->triangle], rgb);
    if (p->back) colour_mix(rgb, (const double[]){1, 1, 1}, 0.45, rgb);
}

/* --- painting --------------------------------------------------------------------------------- */

/* Points of a unit. */
static double scene_scale(const scene *s)
{
    return PAGE_SIDE / page_box_side(&s->shown);
}

static double scene_page_x(const scene *s, double x)
{
    return MARGIN + (x - s->shown.low[0]) * scene_scale(s);
}

static double scene_page_y(const scene *s, double y)
{
    return MARGIN + (s->shown.high[1] - y) * scene_scale(s);
}

/* Thinner where triangles are small on the page. */
static double scene_line_width(const scene *s)
{
    double sum = 0;
    for (size_t i = 0; i < s->count; i++) {
        page_box b = scene_box(s, s->painted[i].triangle);
        sum += page_box_side(&b);
    }
    double mean = s->count ? sum / (double)s->count * scene_scale(s) : 10;
    return fmin(0.6, fmax(0.08, 0.05 * mean));
}

/* Where triangles are left out, a faint grey in their place. */
static void scene_paint_veil(cairo_t *c, const scene *s)
{
    double side[2];
    if (!s->veil) return;
    for (int k = 0; k < 2; k++) side[k] = (s->shown.high[k] - s->shown.low[k]) / SCENE_CELLS;
    cairo_set_source_rgb(c, 0.92, 0.92, 0.92);
    for (size_t y = 0; y < SCENE_CELLS; y++)
        for (size_t x = 0, end; x < SCENE_CELLS; x = end + 1) {
            for (end = x; end < SCENE_CELLS && s->veil[y * SCENE_CELLS + end];) end++;
            if (end == x) continue;
            double left = scene_page_x(s, s->shown.low[0] + (double)x * side[0]);
            double top = scene_page_y(s, s->shown.low[1] + (double)(y + 1) * side[1]);
            cairo_rectangle(c, left, top, (double)(end - x) * side[0] * scene_scale(s),
                            side[1] * scene_scale(s));
        }
    cairo_fill(c);
}

static void triangle_trace(cairo_t *c, const scene *s, uint32_t triangle)
{
    for (size_t k = 0; k < 3; k++) {
        const page_point *at = scene_corner(s, triangle, k);
        cairo_line_to(c, scene_page_x(s, at->x), scene_page_y(s, at->y));
    }
    cairo_close_path(c);
}

static void triangle_paint(cairo_t *c, const scene *s, const painted_triangle *p, double width)
{
    bool walk = s->visit[p->triangle] < s->seen, mark = s->d->marks && s->d->marks[p->triangle];
    double rgb[3];
    if (p->back && !walk) return; /* not seen yet */
    triangle_trace(c, s, p->triangle);
    if (walk) {
        colour_of_triangle(s, p, rgb);
        cairo_set_source_rgb(c, rgb[0], rgb[1], rgb[2]);
        cairo_fill_preserve(c);
    } else if (mark) {
        cairo_set_source_rgb(c, yellow[0], yellow[1], yellow[2]);
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
static void triangle_ring(cairo_t *c, const scene *s, uint32_t triangle, const double rgb[3])
{
    page_box b = scene_box(s, triangle);
    if (!scene_is_finite(s, triangle) ||
        fmin(b.high[0] - b.low[0], b.high[1] - b.low[1]) * scene_scale(s) > 1.5 * RING)
        return;
    cairo_new_sub_path(c);
    cairo_arc(c, scene_page_x(s, b.low[0] / 2 + b.high[0] / 2),
              scene_page_y(s, b.low[1] / 2 + b.high[1] / 2), RING, 0, 2 * acos(-1));
    cairo_set_source_rgb(c, rgb[0], rgb[1], rgb[2]);
    cairo_set_line_width(c, 2);
    cairo_stroke(c);
}

static void scene_paint_segments(cairo_t *c, const scene *s)
{
    static const double dash[] = {3, 2};
    const drawing *d = s->d;
    cairo_save(c);
    cairo_set_source_rgb(c, 0.35, 0.35, 0.35);
    cairo_set_line_width(c, 0.8);
    if (d->dashed) cairo_set_dash(c, dash, 2, 0);
    for (size_t i = 0; i < d->segment_count; i++) {
        const page_point a = projection_at(&s->projection, d->segments + 6 * i),
                         b = projection_at(&s->projection, d->segments + 6 * i + 3);
        cairo_move_to(c, scene_page_x(s, a.x), scene_page_y(s, a.y));
        cairo_line_to(c, scene_page_x(s, b.x), scene_page_y(s, b.y));
        cairo_stroke(c);
    }
    cairo_restore(c);
}

static void scene_paint_line(cairo_t *c, const scene *s)
{
    const double *line = s->d->line;
    cairo_set_line_width(c, 1.1);
    for (size_t i = 0; i + 1 < s->d->line_count; i++) {
        page_point a = projection_at(&s->projection, line + 3 * i),
                   b = projection_at(&s->projection, line + 3 * i + 3);
        if (!page_point_is_finite(&a) || !page_point_is_finite(&b)) continue;
        bool seen = projection_shows(&s->projection, line + 3 * i) &&
                    projection_shows(&s->projection, line + 3 * i + 3);
        double grey = seen ? 0 : 0.6;
        cairo_set_source_rgb(c, grey, grey, grey);
        cairo_move_to(c, scene_page_x(s, a.x), scene_page_y(s, a.y));
        cairo_line_to(c, scene_page_x(s, b.x), scene_page_y(s, b.y));
        cairo_stroke(c);
    }
}

/* The beginning of the line is a ring, its end a disc. */
static void scene_paint_end(cairo_t *c, const scene *s, const double *point, bool last)
{
    page_point at = projection_at(&s->projection, point);
    if (!page_point_is_finite(&at)) return;
    double grey = projection_shows(&s->projection, point) ? 0 : 0.6, paper = last ? grey : 1;
    cairo_new_sub_path(c);
    cairo_arc(c, scene_page_x(s, at.x), scene_page_y(s, at.y), 2.5, 0, 2 * acos(-1));
    cairo_set_source_rgb(c, paper, paper, paper);
    cairo_fill_preserve(c);
    cairo_set_source_rgb(c, grey, grey, grey);
    cairo_set_line_width(c, 1.1);
    cairo_stroke(c);
}

static double legend_write_words(cairo_t *c, double x, double y, const char *words)
{
    cairo_text_extents_t e;
    cairo_set_source_rgb(c, 0.1, 0.1, 0.1);
    cairo_text_extents(c, words, &e);
    cairo_move_to(c, x, y);
    cairo_show_text(c, words);
    return x + e.x_advance;
}

static double legend_sample(cairo_t *c, double x, double y, const double rgb[3], const char *words)
{
    cairo_rectangle(c, x, y - 8, 9, 9);
    cairo_set_source_rgb(c, rgb[0], rgb[1], rgb[2]);
    cairo_fill(c);
    return legend_write_words(c, x + 13, y, words) + 14;
}

static bool stage_is_seen(const drawing *d, uint32_t stage)
{
    for (size_t i = 0; i < d->path_count; i++)
        if (d->stage[i] == stage) return true;
    return false;
}

static double legend_paint_stages(cairo_t *c, const drawing *d, double x, double y)
{
    double rgb[3];
    for (uint32_t stage = 0; d->stage && d->stage_names[stage]; stage++) {
        if (!stage_is_seen(d, stage)) continue;
        colour_of_hue(stage_hue(stage), 0.6, rgb);
        x = legend_sample(c, x, y, rgb, d->stage_names[stage]);
    }
    return x;
}

/* The walks of a colour, counted from 1: "walk 2", "walks 2, 5", "walks 2, 5, 8 ...". Returns how
 * many there are. */
static uint32_t walks_of_hue(const drawing *d, uint32_t hue, char *words, size_t size)
{
    uint32_t count = 0, last = UINT32_MAX;
    size_t used = (size_t)snprintf(words, size, "walks");
    for (size_t i = 0; i < d->path_count; i++) {
        const uint32_t walk = d->iteration[i];
        if (walk_hue(walk) != hue || walk == last) continue;
        last = walk;
        if (++count > 4 || used >= size) continue;
        used += (size_t)(count > 3 ? snprintf(words + used, size - used, " ...")
                                   : snprintf(words + used, size - used, "%s%u",
                                              count > 1 ? ", " : " ", walk + 1));
    }
    if (count == 1) snprintf(words, size, "walk %u", last + 1);
    return count;
}

/* A walk darkens along its way. */
static double legend_paint_walks(cairo_t *c, const drawing *d, double x, double y)
{
    double rgb[3];
    char words[64];
    const bool one = d->path_count && d->iteration[d->path_count - 1] == 0;
    for (uint32_t hue = 0; hue < WALK_HUES && !d->stage; hue++) {
        if (walks_of_hue(d, hue, words, sizeof words) == 0) continue;
        colour_of_hue(hue, 0.6, rgb);
        x = legend_sample(c, x, y, rgb, one ? "between, darker along the way" : words);
    }
    return x;
}

static double legend_line(cairo_t *c, double x, double y, double grey, bool dashed,
                          const char *words)
{
    static const double dash[] = {3, 2};
    cairo_save(c);
    cairo_set_source_rgb(c, grey, grey, grey);
    cairo_set_line_width(c, dashed || grey > 0 ? 0.8 : 1.1);
    if (dashed) cairo_set_dash(c, dash, 2, 0);
    cairo_move_to(c, x, y - 3.5);
    cairo_line_to(c, x + 14, y - 3.5);
    cairo_stroke(c);
    cairo_restore(c);
    return legend_write_words(c, x + 18, y, words) + 14;
}

static bool drawing_has_line(const drawing *d)
{
    return d->line_name && d->line_count > 1 && !isnan(d->line[3]);
}

/* The legend: what each colour and each line means. */
static double legend_paint(cairo_t *c, const drawing *d, double x, double y)
{
    x = legend_sample(c, x, y, green, "first");
    x = legend_sample(c, x, y, vermilion, "last");
    x = legend_paint_stages(c, d, x, y);
    x = legend_paint_walks(c, d, x, y);
    if (d->marks) x = legend_sample(c, x, y, yellow, d->mark_name);
    if (drawing_has_line(d)) x = legend_line(c, x, y, 0, false, d->line_name);
    if (d->segment_count) x = legend_line(c, x, y, 0.35, d->dashed, d->segment_name);
    return x;
}

static void scene_paint_caption(cairo_t *c, const scene *s, double y)
{
    cairo_select_font_face(c, "sans-serif", CAIRO_FONT_SLANT_NORMAL, CAIRO_FONT_WEIGHT_NORMAL);
    cairo_set_font_size(c, 11);
    legend_write_words(c, MARGIN, y, s->caption);
    if (s->d->path_count) legend_paint(c, s->d, MARGIN, y + LEGEND);
}

/* Room for the legend: its width on a page that is thrown away. */
static double legend_width(const drawing *d)
{
    cairo_surface_t *page = cairo_recording_surface_create(CAIRO_CONTENT_COLOR, NULL);
    cairo_t *c = cairo_create(page);
    cairo_select_font_face(c, "sans-serif", CAIRO_FONT_SLANT_NORMAL, CAIRO_FONT_WEIGHT_NORMAL);
    cairo_set_font_size(c, 11);
    const double width = d->path_count ? legend_paint(c, d, 0, 0) : 0;
    cairo_destroy(c);
    cairo_surface_destroy(page);
    return width;
}

static double scene_page_width(const scene *s)
{
    const double least = fmax(PAGE_LEAST, legend_width(s->d));
    return 2 * MARGIN + fmax(least, (s->shown.high[0] - s->shown.low[0]) * scene_scale(s));
}

static double scene_page_height(const scene *s)
{
    return MARGIN + (s->shown.high[1] - s->shown.low[1]) * scene_scale(s) + CAPTION;
}

static void drawing_draw(cairo_t *c, const void *self)
{
    const scene *s = self;
    double width = scene_line_width(s);
    cairo_save(c);
    cairo_rectangle(c, 0, 0, scene_page_width(s), scene_page_height(s) - CAPTION + 4);
    cairo_clip(c);
    cairo_set_line_join(c, CAIRO_LINE_JOIN_ROUND);
    scene_paint_veil(c, s);
    for (size_t i = 0; i < s->count; i++) triangle_paint(c, s, &s->painted[i], width);
    scene_paint_segments(c, s);
    scene_paint_line(c, s);
    if (s->d->path_count) {
        triangle_ring(c, s, s->d->path[0], green);
        triangle_ring(c, s, s->d->path[s->seen - 1], vermilion);
    }
    scene_paint_end(c, s, s->d->line, false);
    scene_paint_end(c, s, s->d->line + 3 * (s->d->line_count - 1), true);
    cairo_restore(c);
    scene_paint_caption(c, s, scene_page_height(s) - 9 - LEGEND);
}

/* --- sheets ----------------------------------------------------------------------------------- */

/* Scenes in rows, each in a field of the same size. */
typedef struct sheet {
    scene *scenes;
    size_t count, columns, rows;
    double width, height; /* of a field */
} sheet;

static void drawing_draw_sheet(cairo_t *c, const void *self)
{
    const sheet *all = self;
    for (size_t i = 0; i < all->count; i++) {
        cairo_save(c);
        cairo_translate(c, (double)(i % all->columns) * all->width,
                        (double)(i / all->columns) * all->height);
        drawing_draw(c, &all->scenes[i]);
        cairo_restore(c);
    }
}

/* False: out of memory. To be released in any case. */
static bool sheet_make(sheet *all, const drawing *d, size_t count)
{
    *all = (sheet){.scenes = calloc(count, sizeof *all->scenes),
                   .columns = (size_t)ceil(sqrt((double)count))};
    bool made = all->scenes;
    while (made && all->count < count) {
        made = scene_make(&all->scenes[all->count], &d[all->count]);
        all->width = fmax(all->width, scene_page_width(&all->scenes[all->count]));
        all->height = fmax(all->height, scene_page_height(&all->scenes[all->count]));
        all->count++;
    }
    all->rows = (count + all->columns - 1) / all->columns;
    return made;
}

static void sheet_release(sheet *all)
{
    for (size_t i = 0; i < all->count; i++) scene_release(&all->scenes[i]);
    free(all->scenes);
}

int drawing_write_sheet(const drawing *d, size_t count, const char *path)
{
    sheet all;
    bool made = sheet_make(&all, d, count);
    int end = made ? picture_write(path, (double)all.columns * all.width,
                                   (double)all.rows * all.height, drawing_draw_sheet, &all)
                   : fail_memory();
    sheet_release(&all);
    return end;
}

int drawing_write(const drawing *d, const char *path)
{
    return drawing_write_sheet(d, 1, path);
}

/* --- animations ------------------------------------------------------------------------------- */

enum { MOST_FRAMES = 120, CAPTION_ROOM = 240 };

typedef struct moving_scene {
    scene scene;
    size_t steps; /* visits that each frame adds */
    uint32_t frames;
    char caption[CAPTION_ROOM];
} moving_scene;

static void moving_scene_draw(cairo_t *c, uint32_t frame, void *self)
{
    moving_scene *m = self;
    size_t all = m->scene.d->path_count, seen = (frame + 1) * m->steps;
    m->scene.seen = frame + 1 < m->frames ? seen : all;
    snprintf(m->caption, sizeof m->caption, "%s: %zu", m->scene.d->caption, m->scene.seen);
    m->scene.caption = m->caption;
    drawing_draw(c, &m->scene);
}

/* All frames together take about eight seconds, within limits for each frame; the last one stays
 * longer. */
static uint16_t moving_scene_milliseconds(uint32_t frame, void *self)
{
    const moving_scene *m = self;
    double each = fmin(500, fmax(60, 8000.0 / m->frames));
    return frame + 1 < m->frames ? (uint16_t)each : 2000;
}

int drawing_write_animation(const drawing *d, const char *path)
{
    moving_scene m = {.steps = (d->path_count + MOST_FRAMES - 1) / MOST_FRAMES};
    m.frames = d->path_count ? (uint32_t)((d->path_count + m.steps - 1) / m.steps) : 1;
    bool made = scene_make(&m.scene, d);
    animation a = {.width = made ? scene_page_width(&m.scene) : 0,
                   .height = made ? scene_page_height(&m.scene) : 0,
                   .frames = m.frames,
                   .draw = moving_scene_draw,
                   .milliseconds = moving_scene_milliseconds,
                   .self = &m};
    int end = made ? animation_write(&a, path) : fail_memory();
    scene_release(&m.scene);
    return end;
}

/* --- races ------------------------------------------------------------------------------------ */

/* Sizes in pixels, times in milliseconds. */
enum { MOST_RACERS = 64 };
enum { RACE_WIDTH = 168, RACE_FRAMES = 60, RACE_TIME = 12000, RACE_END = 4000, RACE_CAPTION = 32 };

typedef struct race {
    sheet all;
    double scale, height; /* of a field, with its caption */
    size_t steps;         /* visits that each frame adds */
    uint32_t frames;
} race;

static int race_compare_lengths(const void *a, const void *b)
{
    const size_t *p = a, *q = b;
    return (*p > *q) - (*p < *q);
}

/* How many steps the race shows: three times the median, if a walk takes more. */
static size_t race_length(const drawing *d, size_t count)
{
    size_t lengths[MOST_RACERS], racers = count < MOST_RACERS ? count : MOST_RACERS;
    for (size_t i = 0; i < racers; i++) lengths[i] = d[i].path_count;
    qsort(lengths, racers, sizeof *lengths, race_compare_lengths);
    size_t most = 3 * lengths[racers / 2], longest = lengths[racers - 1];
    return longest < most ? longest : most;
}

static void race_write_caption(cairo_t *c, const scene *s, double y)
{
    char words[64];
    bool done = s->seen == s->d->path_count;
    snprintf(words, sizeof words, "%zu triangle%s%s", s->seen, s->seen == 1 ? "" : "s",
             done ? ": there" : " ...");
    cairo_select_font_face(c, "sans-serif", CAIRO_FONT_SLANT_NORMAL, CAIRO_FONT_WEIGHT_BOLD);
    cairo_set_font_size(c, 10);
    cairo_set_source_rgb(c, 0, 0, 0);
    cairo_move_to(c, 5, y + 11);
    cairo_show_text(c, s->d->name);
    cairo_select_font_face(c, "sans-serif", CAIRO_FONT_SLANT_NORMAL, CAIRO_FONT_WEIGHT_NORMAL);
    if (done)
        cairo_set_source_rgb(c, green[0] / 2, green[1] / 2, green[2] / 2);
    else
        cairo_set_source_rgb(c, vermilion[0], vermilion[1], vermilion[2]);
    cairo_move_to(c, 5, y + 24);
    cairo_show_text(c, words);
}

/* A field: the picture without its own caption, which is too small to be read, then that of the
 * race. */
static void race_draw_field(cairo_t *c, const race *r, scene *s)
{
    double picture = (scene_page_height(s) - CAPTION) * r->scale;
    cairo_save(c);
    cairo_rectangle(c, 0, 0, RACE_WIDTH, picture);
    cairo_clip(c);
    cairo_scale(c, r->scale, r->scale);
    drawing_draw(c, s);
    cairo_restore(c);
    race_write_caption(c, s, picture);
}

static void race_draw(cairo_t *c, uint32_t frame, void *self)
{
    race *r = self;
    for (size_t i = 0; i < r->all.count; i++) {
        scene *s = &r->all.scenes[i];
        size_t seen = (frame + 1) * r->steps;
        s->seen = seen < s->d->path_count ? seen : s->d->path_count;
        cairo_save(c);
        cairo_translate(c, (double)(i % r->all.columns) * RACE_WIDTH,
                        (double)(i / r->all.columns) * r->height);
        race_draw_field(c, r, s);
        cairo_restore(c);
    }
}

static uint16_t race_milliseconds(uint32_t frame, void *self)
{
    const race *r = self;
    double each = fmin(400, fmax(60, (double)RACE_TIME / r->frames));
    return frame + 1 < r->frames ? (uint16_t)each : RACE_END;
}

int drawing_write_race(const drawing *d, size_t count, const char *path)
{
    race r;
    size_t length = race_length(d, count);
    bool made = sheet_make(&r.all, d, count);
    r.steps = (length + RACE_FRAMES - 1) / RACE_FRAMES;
    r.frames = length ? (uint32_t)((length + r.steps - 1) / r.steps) : 1;
    r.scale = made ? RACE_WIDTH / r.all.width : 1;
    r.height = made ? (r.all.height - CAPTION) * r.scale + RACE_CAPTION : 1;
    animation a = {.width = (double)r.all.columns * RACE_WIDTH,
                   .height = (double)r.all.rows * r.height,
                   .frames = r.frames,
                   .draw = race_draw,
                   .milliseconds = race_milliseconds,
                   .self = &r};
    int end = made ? animation_write(&a, path) : fail_memory();
    sheet_release(&r.all);
    return end;
}

#else

int drawing_write_race(const drawing *d, size_t count, const char *path)
{
    (void)d, (void)count;
    return picture_check(path);
}

int drawing_write_animation(const drawing *d, const char *path)
{
    (void)d;
    return picture_check(path);
}

int drawing_write(const drawing *d, const char *path)
{
    (void)d;
    return picture_check(path);
}

int drawing_write_sheet(const drawing *d, size_t count, const char *path)
{
    (void)d, (void)count;
    return picture_check(path);
}

#endif
