/* bench paper: the tables of the thesis about planar walks, measured again. */
#include "bench.h"
#include "dataset_file.h"
#include "files.h"
#include "message.h"
#include "paper.h"
#include "progress.h"
#include "published.h"
#include "spelling.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

static const algorithm remembering = {"remembering", "RW", "remembering", false};
static const algorithm stochastic = {"stochastic", "RSW", "stochastic", false};
static const algorithm barycentric = {"barycentric", "BW", "barycentric", false};
static const algorithm straight = {"straight", "SW", "straight", false};
static const algorithm normal_straight = {"normal-straight", "NSW", "normal-straight", false};
static const algorithm orthogonal = {"orthogonal", "OW", "orthogonal", false};
static const algorithm improved_orthogonal = {"improved-orthogonal", "IOW", "improved-orthogonal", false};
static const algorithm hybrid = {"hybrid", "HW", "hybrid", false};
static const algorithm direct_computed = {"direct-dw2", "DW2", "direct", false};
static const algorithm direct_stored = {"direct-dw1", "DW1", "direct", true};

#define SET(kind) (1u << DATASET_##kind)

/* Appendix C calls its improved orthogonal walk OW. */
static const paper_table tables[] = {
    {.name = "A1",
     .title = "straight walk and normal-straight walk (App. A, Table 1)",
     .algorithms = {&remembering, &stochastic, &straight, &normal_straight},
     .reference = &straight,
     .finish = "stochastic",
     .sets = SET(UNIFORM) | SET(GRID) | SET(GAUSSIAN) | SET(CLUSTERS) | SET(ARCS),
     .sizes = {100000, 1000000},
     .drawn = TRIANGLES},
    {.name = "A2",
     .title = "final location of the normal-straight walk (App. A, Table 2)",
     .algorithms = {&normal_straight},
     .reference = &normal_straight,
     .finish = "stochastic",
     .sets = SET(UNIFORM) | SET(GRID) | SET(GAUSSIAN) | SET(CLUSTERS) | SET(ARCS),
     .sizes = {100000, 1000000},
     .drawn = TRIANGLES_FINAL},
    {.name = "B1",
     .title = "hybrid walk (App. B, Table I)",
     .algorithms = {&stochastic, &normal_straight, &improved_orthogonal, &hybrid, &straight},
     .reference = &normal_straight,
     .finish = "stochastic",
     .sets = SET(UNIFORM),
     .sizes = {10000, 100000, 1000000},
     .enclosed = true,
     .drawn = TRIANGLES},
    {.name = "B2",
     .title = "hybrid walk in a turned rectangle (App. B, Table II)",
     .algorithms = {&improved_orthogonal, &hybrid},
     .reference = &hybrid,
     .finish = "stochastic",
     .sets = SET(RECTANGLE),
     .sizes = {10000, 100000, 1000000},
     .drawn = TRIANGLES},
    {.name = "C1",
     .title = "direct walk (App. C, Table 1)",
     .algorithms = {&remembering, &stochastic, &barycentric, &straight, &improved_orthogonal, &direct_computed,
                    &direct_stored},
     .reference = &straight,
     .finish = "remembering",
     .sets = SET(UNIFORM),
     .sizes = {10000, 100000, 1000000},
     .enclosed = true,
     .drawn = TRIANGLES},
    {.name = "C2",
     .title = "direct walk in layers (App. C, Table 2)",
     .algorithms = {&remembering, &stochastic, &improved_orthogonal, &direct_computed, &direct_stored},
     .reference = &remembering,
     .finish = "remembering",
     .sets = SET(UNIFORM),
     .sizes = {100, 1000, 10000, 100000, 1000000, 10000000},
     .enclosed = true,
     .layered = true,
     .drawn = TRIANGLES},
    {.name = "E2",
     .title = "survey of the walks (App. E, Table 2 and Fig. 12)",
     .algorithms = {&remembering, &stochastic, &barycentric, &straight, &normal_straight, &orthogonal,
                    &improved_orthogonal},
     .reference = &straight,
     .finish = "stochastic",
     .sets = SET(UNIFORM),
     .sizes = {10000, 100000, 1000000},
     .enclosed = true,
     .drawn = TIME_EXACT_US},
};
#define TABLES (sizeof tables / sizeof *tables)

static const paper_table *table_named(const char *name)
{
    if (!name) {
        complain("bench paper: which table? A1, A2, B1, B2, C1, C2 or E2");
        return NULL;
    }
    spelling s = spelling_of(name);
    for (size_t i = 0; i < TABLES; i++) {
        if (strcasecmp(tables[i].name, name) == 0) return &tables[i];
        spelling_try(&s, tables[i].name);
    }
    spelling_complain(&s, "table", "");
    return NULL;
}

/* Columns that are sums of our quantities: the first then means what the column does (docs/published-tables.md). */
static const struct {
    const char *table;
    const algorithm *algorithm;
    quantity sum, more;
    double shared; /* triangles counted in both */
} columns[] = {
    {"A1", &straight, TRIANGLES, TRIANGLES_INIT, 1},         {"A1", &straight, ORIENT, ORIENT_INIT, 0},
    {"A1", &normal_straight, TRIANGLES, TRIANGLES_FINAL, 0}, {"B1", &hybrid, TRIANGLES, TRIANGLES_INIT, 1},
    {"B2", &hybrid, TRIANGLES, TRIANGLES_INIT, 1},           {"E2", &orthogonal, TRIANGLES, TRIANGLES_INIT, 1},
};

static void sum_columns(const paper_table *table, outcome *o)
{
    for (size_t c = 0; c < sizeof columns / sizeof *columns; c++)
        for (size_t i = 0; table->algorithms[i] && strcmp(columns[c].table, table->name) == 0; i++)
            if (table->algorithms[i] == columns[c].algorithm)
                o->value[i][columns[c].sum] += o->value[i][columns[c].more] - columns[c].shared;
}

double paper_published(const paper *p, const paper_result *r, size_t i, quantity q)
{
    if (r->own) return NAN;
    return published_value(p->table->name, r->dataset, r->outcome.vertices, p->table->algorithms[i]->name, q);
}

double paper_sum(const paper *p, const paper_result *r, size_t i, int which, bool published)
{
    static const quantity parts[2][5] = {{TRIANGLES_INIT, TRIANGLES, TRIANGLES_FINAL, QUANTITIES},
                                         {ORIENT_INIT, ORIENT, ORIENT_FINAL, IMPLICIT, COMPARISONS}};
    const char *name = p->table->algorithms[i]->name;
    bool known = published_prints(p->table->name, name, TRIANGLES);
    double sum = 0;
    for (size_t k = 0; k < 5 && parts[which][k] != QUANTITIES; k++) {
        quantity q = parts[which][k];
        if (known && !published_prints(p->table->name, name, q)) continue;
        sum += published ? paper_published(p, r, i, q) : r->outcome.value[i][q];
    }
    return sum;
}

/* The layers of Table 2 for sets of these sizes; 0 for others. */
static uint32_t layers_for(const paper_table *table, size_t n)
{
    double layers = published_value(table->name, "uniform", n, table->algorithms[0]->name, LAYERS);
    return layers > 0 ? (uint32_t)layers : 0;
}

static int measure_set(paper *p, const dataset *data, const char *name, bool own)
{
    const bench_settings *s = p->settings;
    paper_result *results = realloc(p->results, (p->count + 1) * sizeof *results);
    if (!results) return fail_memory();
    p->results = results;
    paper_result *r = &results[p->count];
    *r = (paper_result){.own = own};
    strncpy(r->dataset, name, sizeof r->dataset - 1);
    trial t = {
        .name = name,
        .data = data,
        .algorithms = p->table->algorithms,
        .finish = p->table->finish,
        .layered = p->table->layered,
        .layers = own ? 0 : layers_for(p->table, data->count),
        .queries = p->queries,
        .seed = s->common.seed,
        .threads = s->common.threads,
        .times = !s->no_times,
    };
    int end = measure(&t, &r->outcome);
    progress_phase("measuring", NULL); /* the name may go */
    if (end) return end;
    sum_columns(p->table, &r->outcome);
    p->count++;
    return 0;
}

static bool encloses(const paper *p)
{
    int enclose = p->settings->enclose;
    return enclose == ENCLOSE_AUTO ? p->table->enclosed : enclose == ENCLOSE_YES;
}

static int run_generated(paper *p, const size_t *sizes)
{
    int end = 0;
    for (int kind = 0; kind < DATASET_KINDS; kind++)
        for (size_t i = 0; i < MOST_SIZES && sizes[i] && p->table->sets >> kind & 1; i++) {
            dataset data;
            if (!dataset_make(&data, (dataset_kind)kind, sizes[i], encloses(p), p->settings->common.seed))
                return fail_memory();
            end = measure_set(p, &data, dataset_name(kind), false);
            dataset_release(&data);
            if (end) return end;
        }
    return 0;
}

static const char *base_name(const char *path)
{
    const char *slash = strrchr(path, '/');
    return slash && slash[1] ? slash + 1 : path;
}

static int run_file(const char *path, void *self)
{
    paper *p = self;
    dataset data;
    int end = dataset_read(&data, path, encloses(p));
    if (end == 0) end = measure_set(p, &data, base_name(path), true);
    dataset_release(&data);
    return end;
}

static int check_file(const char *path, void *self)
{
    const paper *p = self;
    if (!*path) {
        complain("option '--data' wants files separated by commas, not '%s'", p->settings->data);
        return END_USAGE;
    }
    int end = files_check(p->settings->common.output, &path, 1);
    return end || !p->settings->plot ? end : files_check(p->settings->plot, &path, 1);
}

int bench_paper(const bench_settings *s, const char *name)
{
    const paper_table *table = table_named(name);
    if (!table) return END_USAGE;
    paper p = {.table = table, .settings = s, .queries = s->queries ? s->queries : 1000000};
    size_list sizes = {0};
    int end = paper_plot_check(s, table);
    if (end == 0 && s->sizes) end = bench_sizes(s->sizes, &sizes);
    if (end == 0 && s->data) end = bench_each_word(s->data, check_file, &p);
    if (end == 0) end = files_try_output(s->common.output, NULL);
    if (end == 0 && s->plot) end = files_try_output(s->plot, NULL);
    if (end == 0)
        end =
            s->data ? bench_each_word(s->data, run_file, &p) : run_generated(&p, s->sizes ? sizes.size : table->sizes);
    if (end == 0 && s->plot) end = paper_plot(&p, s->plot);
    if (end == 0) {
        text t = {0};
        paper_print(&p, &t);
        end = files_write_text(s->common.output, &t);
    }
    free(p.results);
    return end;
}
