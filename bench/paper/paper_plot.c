#include "bench/paper/paper_plot.h"
#include "cli/draw/plot.h"
#include "cli/frame/files.h"
#include "cli/frame/message.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* The walks take about so many triangles times the square root of the vertices: divided by it the
 * curves can be told apart. */
static bool table_is_scaled(const paper_table *table)
{
    bool plain = strcmp(table->start, "random") == 0 || strcmp(table->start, "front") == 0;
    return table->drawn == TRIANGLES && table->subject != PAPER_DOMAINS && plain;
}

static const char *table_label(const paper_table *table)
{
    if (table->drawn == TIME_EXACT_US) return "microseconds per query, exact";
    if (table->drawn == TRIANGLES_FINAL) return "triangles of the final location per query";
    return table_is_scaled(table) ? "triangles per query / square root of vertices"
                                  : "triangles per query";
}

int paper_plot_check(const bench_settings *s, const paper_table *table)
{
    if (!s->plot) return 0;
    if (table->drawn == TIME_EXACT_US && s->no_times) {
        complain("bench paper: the plot of %s shows times; leave out --no-times or --plot",
                 table->name);
        return END_USAGE;
    }
    if (files_same_output(s->common.output, s->plot)) {
        complain("%s: the figures and the plot must go to different files", s->plot);
        return END_USAGE;
    }
    return plot_check(s->plot);
}

/* A curve for each algorithm; of Appendix D one for each phase of the first. */
typedef struct paper_curve {
    size_t algorithm;
    quantity quantity;
    const char *name, *label;
} paper_curve;

static size_t table_curves(const paper_table *table, paper_curve curves[MOST_ALGORITHMS])
{
    static const paper_curve phases[] = {{0, TRIANGLES, "walk", "walk"},
                                         {0, TRIANGLES_BORDER, "border walk", "border"}};
    size_t count = 0;
    if (table->subject == PAPER_DOMAINS) {
        memcpy(curves, phases, sizeof phases);
        return sizeof phases / sizeof *phases;
    }
    for (; table->algorithms[count]; count++) {
        const algorithm *a = table->algorithms[count];
        curves[count] = (paper_curve){count, table->drawn, a->name, a->abbreviation};
    }
    return count;
}

/* All triangles of the thesis' column, the final location of the cheap walks too. */
static plot_point result_point(const paper *p, const paper_result *r, const paper_curve *c)
{
    plot_point at = {.x = (double)r->outcome.vertices};
    if (c->quantity == TRIANGLES && p->table->subject != PAPER_DOMAINS) {
        double scale = table_is_scaled(p->table) ? sqrt(at.x) : 1;
        at.ours = paper_sum(p, r, c->algorithm, PAPER_TRIANGLES, false) / scale;
        at.published = paper_sum(p, r, c->algorithm, PAPER_TRIANGLES, true) / scale;
    } else {
        at.ours = r->outcome.value[c->algorithm][c->quantity];
        at.published = paper_published(p, r, c->algorithm, c->quantity);
    }
    return at;
}

/* In the figures of Appendix D walks begin at the nearest of a sample. */
static bool result_is_drawn(const paper *p, const paper_result *r)
{
    return r->walks && (p->table->subject != PAPER_DOMAINS || r->outcome.value[0][SAMPLE] > 1);
}

/* The panel of a result: that of its set; a file is a set of its own. */
static plot_panel *result_panel(plot_panel *panels, size_t *count, const paper_result *r)
{
    for (size_t k = 0; k < *count && !r->users_file; k++)
        if (strcmp(panels[k].title, r->dataset) == 0) return &panels[k];
    panels[*count].title = r->dataset;
    return &panels[(*count)++];
}

static size_t paper_group_panels(const paper *p, const paper_curve *curves, size_t curve_count,
                                 plot_panel *panels)
{
    size_t count = 0;
    for (size_t k = 0; k < p->count; k++) {
        if (!result_is_drawn(p, &p->results[k])) continue;
        plot_panel *panel = result_panel(panels, &count, &p->results[k]);
        for (size_t i = 0; i < curve_count; i++)
            panel->curve[i].point[panel->curve[i].count++] =
                result_point(p, &p->results[k], &curves[i]);
    }
    return count;
}

int paper_plot(const paper *p, const char *path)
{
    char title[128];
    paper_curve curves[MOST_ALGORITHMS];
    plot_panel *panels = calloc(p->count, sizeof *panels);
    if (!panels) return fail_memory();
    snprintf(title, sizeof title, "%s: %s", p->table->name, p->table->title);
    plot drawing = {
        .title = title,
        .x_label = "vertices",
        .y_label = table_label(p->table),
        .log_y = p->table->drawn == TIME_EXACT_US,
        .panels = panels,
        .curves = table_curves(p->table, curves),
    };
    drawing.count = paper_group_panels(p, curves, drawing.curves, panels);
    for (size_t i = 0; i < drawing.curves; i++) {
        drawing.name[i] = curves[i].name;
        drawing.label[i] = curves[i].label;
    }
    int end = plot_write(&drawing, path);
    free(panels);
    return end;
}
