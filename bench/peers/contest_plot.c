/* The figures of a contest over the number of vertices: a panel for each set and task, a curve for each engine. */
#include "bench/peers/contest.h"
#include "cli/frame/message.h"
#include "cli/draw/plot.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

typedef char title[128];

/* Nanoseconds per query, or, where there are no queries, per vertex. */
static double value_of(const contest_row *r)
{
    return isnan(r->ns_per_query) ? 1e9 * r->build_seconds / (double)r->vertices : r->ns_per_query;
}

static void name_panel(const contest_row *r, title words)
{
    snprintf(words, sizeof(title), "%s, %s: ns per %s", r->dataset, engines_task(r->task),
             isnan(r->ns_per_query) ? "vertex" : "query");
}

static void name_curve(const contest_row *r, title words)
{
    snprintf(words, sizeof(title), r->threads > 1 ? "%s on %u" : "%s", engines[r->engine].name, r->threads);
}

/* The number of a name, which is added if it is new. */
static size_t number_of(const char *name, title *names, size_t *count)
{
    for (size_t k = 0; k < *count; k++)
        if (strcmp(names[k], name) == 0) return k;
    snprintf(names[*count], sizeof(title), "%s", name);
    return (*count)++;
}

typedef struct drawing {
    plot plot;
    plot_panel *panels;
    title *panel_names, *curve_names;
} drawing;

static void add_point(drawing *d, const contest_row *r)
{
    title name;
    name_panel(r, name);
    plot_panel *panel = &d->panels[number_of(name, d->panel_names, &d->plot.count)];
    name_curve(r, name);
    size_t k = number_of(name, d->curve_names, &d->plot.curves);
    if (k >= PLOT_CURVES || panel->curve[k].count == PLOT_POINTS) return;
    panel->curve[k].point[panel->curve[k].count++] = (plot_point){(double)r->vertices, value_of(r), NAN};
}

static void name_all(drawing *d)
{
    if (d->plot.curves > PLOT_CURVES) {
        complain("bench scale: the plot shows the first %d of %zu engines", PLOT_CURVES, d->plot.curves);
        d->plot.curves = PLOT_CURVES;
    }
    for (size_t k = 0; k < d->plot.curves; k++) d->plot.name[k] = d->plot.label[k] = d->curve_names[k];
    for (size_t k = 0; k < d->plot.count; k++) d->panels[k].title = d->panel_names[k];
    d->plot.panels = d->panels;
}

int contest_plot(const contest_table *table, const char *path)
{
    drawing d = {.plot = {.title = "point location", .x_label = "vertices", .y_label = "nanoseconds", .log_y = true}};
    d.panels = calloc(table->count, sizeof *d.panels);
    d.panel_names = calloc(table->count, sizeof *d.panel_names);
    d.curve_names = calloc(table->count, sizeof *d.curve_names);
    int end = d.panels && d.panel_names && d.curve_names ? 0 : fail_memory();
    for (size_t i = 0; i < table->count && end == 0; i++) add_point(&d, &table->rows[i]);
    if (end == 0) {
        name_all(&d);
        end = plot_write(&d.plot, path);
    }
    free(d.panels);
    free(d.panel_names);
    free(d.curve_names);
    return end;
}
