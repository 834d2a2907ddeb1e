#include "bench/paper/paper.h"
#include "bench/paper/published.h"
#include "cli/frame/message.h"
#include "cli/frame/progress.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

double paper_published_of(const paper *p, const paper_result *r, const algorithm *a, quantity q)
{
    if (r->model[0])
        return published_value(p->table->name, r->model, r->model_vertices, a->name, q);
    return r->users_file
               ? NAN
               : published_value(p->table->name, r->dataset, r->outcome.vertices, a->name, q);
}

double paper_published(const paper *p, const paper_result *r, size_t i, quantity q)
{
    return paper_published_of(p, r, p->table->algorithms[i], q);
}

double paper_sum(const paper *p, const paper_result *r, size_t i, int which, bool published)
{
    static const quantity parts[2][6] = {
        {TRIANGLES_INIT, TRIANGLES, TRIANGLES_FINAL, TRIANGLES_BORDER, QUANTITIES},
        {ORIENT_INIT, ORIENT, ORIENT_FINAL, ORIENT_BORDER, IMPLICIT, COMPARISONS}};
    const char *name = p->table->algorithms[i]->name;
    double all = 0, printed = 0;
    bool some = false;
    for (size_t k = 0; k < 6 && parts[which][k] != QUANTITIES; k++) {
        quantity q = parts[which][k];
        double value = published ? paper_published(p, r, i, q) : r->outcome.value[i][q];
        all += value;
        if (!published_prints(p->table->name, name, q)) continue;
        some = true;
        printed += value;
    }
    return some ? printed : all;
}

/* The layers of App. C, Table 2, for sets of these sizes; 0 for others. */
static uint32_t layers_for(const paper_table *table, size_t n)
{
    double layers = published_value(table->name, "uniform", n, table->algorithms[0]->name, LAYERS);
    return layers > 0 ? (uint32_t)layers : 0;
}

walk_trial paper_trial(const paper *p, const char *name, const dataset *data, bool users_file)
{
    const bench_settings *s = p->settings;
    bool timed = p->table->quantities >> TIME_US & 1;
    return (walk_trial){
        .name = name,
        .data = data,
        .algorithms = p->table->algorithms,
        .finish = p->table->finish ? p->table->finish : "auto",
        .start = p->table->start,
        .layers = users_file ? 0 : layers_for(p->table, data->count),
        .queries = p->queries,
        .seed = s->common.seed,
        .threads = s->common.threads,
        .times = timed && !s->no_times,
    };
}

paper_result *paper_add(paper *p, const char *name, bool users_file)
{
    paper_result *results = realloc(p->results, (p->count + 1) * sizeof *results);
    if (!results) return NULL;
    p->results = results;
    paper_result *r = &results[p->count++];
    *r = (paper_result){.users_file = users_file};
    strncpy(r->dataset, name, sizeof r->dataset - 1);
    return r;
}

/* Of x and y of n things [Pearson 1895]. */
static double correlation(const double *x, const double *y, size_t n)
{
    double mean[2] = {0, 0}, xx = 0, yy = 0, xy = 0;
    for (size_t i = 0; i < n; i++) {
        mean[0] += x[i] / (double)n;
        mean[1] += y[i] / (double)n;
    }
    for (size_t i = 0; i < n; i++) {
        double dx = x[i] - mean[0], dy = y[i] - mean[1];
        xx += dx * dx;
        yy += dy * dy;
        xy += dx * dy;
    }
    return xy / sqrt(xx * yy);
}

static double paper_table_correlation(const paper_table *table, const walk_outcome *o)
{
    double x[MOST_ALGORITHMS], y[MOST_ALGORITHMS];
    size_t n = 0;
    for (; table->algorithms[n]; n++) {
        x[n] = o->value[n][TRIANGLES];
        y[n] = o->value[n][SIDE_LENGTH];
    }
    return correlation(x, y, n);
}

int paper_measure(paper *p, const walk_trial *t, bool users_file)
{
    paper_result *r = paper_add(p, t->name, users_file);
    if (!r) return fail_memory();
    r->walks = true;
    int end = walk_measurement_run(t, &r->outcome);
    progress_phase("measuring", NULL); /* the name may go */
    if (end) return end;
    paper_table_sum_columns(p->table, &r->outcome);
    if (p->table->whole_quantities >> CORRELATION & 1) {
        r->whole = true;
        r->outcome.whole[CORRELATION] = paper_table_correlation(p->table, &r->outcome);
    }
    return 0;
}
