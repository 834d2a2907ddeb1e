#include "bench/peers/comparison_plot.h"
#include "cli/draw/plot.h"
#include "cli/frame/message.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

typedef char plot_title[128];

/* Nanoseconds per query, or, where there are no queries, per vertex. */
static double plotted_value(const comparison_row *r)
{
    return isnan(r->ns_per_query) ? 1e9 * r->build_seconds / (double)r->vertices : r->ns_per_query;
}

static void plotted_panel_name(const comparison_row *r, plot_title words)
{
    snprintf(words, sizeof(plot_title), "%s, %s: ns per %s", r->dataset, engine_task_name(r->task),
             isnan(r->ns_per_query) ? "vertex" : "query");
}

static void plotted_curve_name(const comparison_row *r, plot_title words)
{
    snprintf(words, sizeof(plot_title), r->threads > 1 ? "%s on %u" : "%s", engines[r->engine].name,
             r->threads);
}

/* The number of a name, which is added if it is new. */
static size_t plotted_name_number(const char *name, plot_title *names, size_t *count)
{
    for (size_t k = 0; k < *count; k++)
        if (strcmp(names[k], name) == 0) return k;
    snprintf(names[*count], sizeof(plot_title), "%s", name);
    return (*count)++;
}

typedef struct comparison_drawing {
    plot plot;
    plot_panel *panels;
    plot_title *panel_names, *curve_names;
} comparison_drawing;

static void drawing_add_point(comparison_drawing *d, const comparison_row *r)
{
    plot_title name;
    plotted_panel_name(r, name);
    plot_panel *panel = &d->panels[plotted_name_number(name, d->panel_names, &d->plot.count)];
    plotted_curve_name(r, name);
    size_t k = plotted_name_number(name, d->curve_names, &d->plot.curves);
    if (k >= PLOT_CURVES || panel->curve[k].count == PLOT_POINTS) return;
    panel->curve[k].point[panel->curve[k].count++] =
        (plot_point){(double)r->vertices, plotted_value(r), NAN};
}

static void drawing_name_all(comparison_drawing *d)
{
    if (d->plot.curves > PLOT_CURVES) {
        complain("bench scale: the plot shows the first %d of %zu engines", PLOT_CURVES,
                 d->plot.curves);
        d->plot.curves = PLOT_CURVES;
    }
    for (size_t k = 0; k < d->plot.curves; k++)
        d->plot.name[k] = d->plot.label[k] = d->curve_names[k];
    for (size_t k = 0; k < d->plot.count; k++) d->panels[k].title = d->panel_names[k];
    d->plot.panels = d->panels;
}

int comparison_plot(const comparison_table *table, const char *path)
{
    comparison_drawing d = {.plot = {.title = "point location",
                                     .x_label = "vertices",
                                     .y_label = "nanoseconds",
                                     .log_y = true}};
    d.panels = calloc(table->count, sizeof *d.panels);
    d.panel_names = calloc(table->count, sizeof *d.panel_names);
    d.curve_names = calloc(table->count, sizeof *d.curve_names);
    int end = d.panels && d.panel_names && d.curve_names ? 0 : fail_memory();
    for (size_t i = 0; i < table->count && end == 0; i++) drawing_add_point(&d, &table->rows[i]);
    if (end == 0) {
        drawing_name_all(&d);
        end = plot_write(&d.plot, path);
    }
    free(d.panels);
    free(d.panel_names);
    free(d.curve_names);
    return end;
}
