#include "files.h"
#include "message.h"
#include "paper.h"
#include "plot.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* The walks take about so many triangles times the square root of the vertices: divided by it the curves can be told
 * apart. */
static bool is_scaled(const paper_table *table)
{
    return table->drawn == TRIANGLES && !table->layered;
}

static const char *label_of(const paper_table *table)
{
    if (table->drawn == TIME_EXACT_US) return "microseconds per query, exact";
    if (table->drawn == TRIANGLES_FINAL) return "triangles of the final location per query";
    return is_scaled(table) ? "triangles per query / square root of vertices" : "triangles per query";
}

int paper_plot_check(const bench_settings *s, const paper_table *table)
{
    if (!s->plot) return 0;
    if (table->drawn == TIME_EXACT_US && s->no_times) {
        complain("bench paper: the plot of %s shows times; leave out --no-times or --plot", table->name);
        return END_USAGE;
    }
    if (files_same_output(s->common.output, s->plot)) {
        complain("%s: the figures and the plot want files of their own", s->plot);
        return END_USAGE;
    }
    return plot_check(s->plot);
}

/* All triangles of the thesis' column, the final location of the cheap walks too. */
static plot_point point_of(const paper *p, const paper_result *r, size_t i)
{
    quantity q = p->table->drawn;
    plot_point at = {.x = (double)r->outcome.vertices};
    if (q == TRIANGLES) {
        double scale = is_scaled(p->table) ? sqrt(at.x) : 1;
        at.ours = paper_sum(p, r, i, PAPER_TRIANGLES, false) / scale;
        at.published = paper_sum(p, r, i, PAPER_TRIANGLES, true) / scale;
    } else {
        at.ours = r->outcome.value[i][q];
        at.published = paper_published(p, r, i, q);
    }
    return at;
}

/* Results of one set stand together; a file is a set of its own. */
static size_t group(const paper *p, plot_panel *panels)
{
    size_t count = 0;
    for (size_t k = 0; k < p->count; k++) {
        const paper_result *r = &p->results[k];
        if (k == 0 || r->own || strcmp(r->dataset, r[-1].dataset) != 0)
            panels[count++] = (plot_panel){.title = r->dataset};
        for (size_t i = 0; p->table->algorithms[i]; i++) {
            plot_curve *curve = &panels[count - 1].curve[i];
            curve->point[curve->count++] = point_of(p, r, i);
        }
    }
    return count;
}

int paper_plot(const paper *p, const char *path)
{
    char title[128];
    plot_panel *panels = calloc(p->count, sizeof *panels);
    if (!panels) return fail_memory();
    snprintf(title, sizeof title, "%s: %s", p->table->name, p->table->title);
    plot drawing = {
        .title = title,
        .x_label = "vertices",
        .y_label = label_of(p->table),
        .log_y = p->table->drawn == TIME_EXACT_US,
        .panels = panels,
        .count = group(p, panels),
    };
    for (size_t i = 0; p->table->algorithms[i]; i++) {
        drawing.name[i] = p->table->algorithms[i]->name;
        drawing.label[i] = p->table->algorithms[i]->abbreviation;
        drawing.curves++;
    }
    int end = plot_write(&drawing, path);
    free(panels);
    return end;
}
