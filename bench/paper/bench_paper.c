/* bench paper: the tables of the thesis, measured again. */
#include "bench/paper/bench_paper.h"
#include "bench/core/word_list.h"
#include "bench/data/dataset_file.h"
#include "bench/paper/paper_domains.h"
#include "bench/paper/paper_plot.h"
#include "bench/paper/paper_polyhedra.h"
#include "bench/paper/paper_print.h"
#include "bench/paper/paper_seeds.h"
#include "cli/frame/files.h"
#include "cli/frame/message.h"

#include <stdlib.h>
#include <string.h>

static bool paper_encloses(const paper *p)
{
    int enclose = p->settings->enclose;
    return enclose == ENCLOSE_AUTO ? p->table->enclosed : enclose == ENCLOSE_YES;
}

static int paper_run_points(paper *p, const size_t *sizes)
{
    int end = 0;
    for (int kind = 0; kind < DATASET_KINDS; kind++)
        for (size_t i = 0; i < MOST_SIZES && sizes[i] && p->table->sets >> kind & 1; i++) {
            dataset data;
            if (!dataset_make(&data, (dataset_kind)kind, sizes[i], paper_encloses(p), p->settings->common.seed))
                return fail_memory();
            walk_trial t = paper_trial(p, dataset_name(kind), &data, false);
            end = paper_measure(p, &t, false);
            dataset_release(&data);
            if (end) return end;
        }
    return 0;
}

static int paper_run_made(paper *p, const size_t *sizes)
{
    switch (p->table->subject) {
    case PAPER_DOMAINS: return paper_domains_made(p, sizes);
    case PAPER_STARS: return paper_polyhedra_stars(p, sizes);
    case PAPER_SURFACES: return paper_polyhedra_surfaces(p, sizes);
    default: return paper_run_points(p, sizes);
    }
}

static const char *paper_base_name(const char *path)
{
    const char *slash = strrchr(path, '/');
    return slash && slash[1] ? slash + 1 : path;
}

static int paper_run_point_file(paper *p, const char *path)
{
    dataset data;
    int end = dataset_read(&data, path, paper_encloses(p));
    walk_trial t = paper_trial(p, paper_base_name(path), &data, true);
    if (end == 0) end = paper_measure(p, &t, true);
    dataset_release(&data);
    return end;
}

static int paper_run_file(const char *path, void *self)
{
    paper *p = self;
    switch (p->table->subject) {
    case PAPER_DOMAINS: return paper_domains_file(p, path, paper_base_name(path));
    case PAPER_STARS:
    case PAPER_SURFACES: return paper_polyhedra_file(p, path, paper_base_name(path));
    default: return paper_run_point_file(p, path);
    }
}

static int paper_check_file(const char *path, void *self)
{
    const paper *p = self;
    if (!*path) {
        complain("option '--data' wants files separated by commas, not '%s'", p->settings->data);
        return END_USAGE;
    }
    int end = files_check_output(p->settings->common.output, &path, 1);
    return end || !p->settings->plot ? end : files_check_output(p->settings->plot, &path, 1);
}

/* All sets, once for each seed. */
static int paper_run(paper *p, const bench_settings *s, const size_t *sizes)
{
    bench_settings own = *s;
    uint32_t seeds = s->seeds ? s->seeds : 1;
    int end = 0;
    p->settings = &own;
    for (uint32_t i = 0; i < seeds && end == 0; i++) {
        own.common.seed = s->common.seed + i;
        end = s->data ? word_list_each(s->data, paper_run_file, p) : paper_run_made(p, sizes);
    }
    p->settings = s;
    if (end == 0) paper_seeds_fold(p, seeds);
    return end;
}

int bench_paper(const bench_settings *s, const char *name)
{
    const paper_table *table = paper_table_named(name);
    if (!table) return END_USAGE;
    paper p = {.table = table, .settings = s, .queries = s->queries ? s->queries : 1000000};
    size_list sizes = {0};
    int end = paper_plot_check(s, table);
    if (end == 0 && table->subject != PAPER_POINTS && s->enclose == ENCLOSE_YES) {
        complain("bench paper: the sets of %s are meshes, which --enclose does not change", table->name);
        end = END_USAGE;
    }
    if (end == 0 && s->sizes) end = word_list_sizes(s->sizes, &sizes);
    if (end == 0 && s->data) end = word_list_each(s->data, paper_check_file, &p);
    if (end == 0) end = files_try_output(s->common.output, NULL);
    if (end == 0 && s->plot) end = files_try_output(s->plot, NULL);
    if (end == 0) end = paper_run(&p, s, s->sizes ? sizes.size : table->sizes);
    if (end == 0 && s->plot) end = paper_plot(&p, s->plot);
    if (end == 0) {
        text t = {0};
        paper_print(&p, &t);
        end = files_write_text(s->common.output, &t);
    }
    free(p.results);
    return end;
}
