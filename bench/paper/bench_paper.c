/* bench paper: the tables of the thesis, measured again. */
#include "bench/paper/bench_paper.h"
#include "bench/core/word_list.h"
#include "bench/data/dataset_file.h"
#include "bench/paper/paper_domains.h"
#include "bench/paper/paper_models.h"
#include "bench/paper/paper_plot.h"
#include "bench/paper/paper_polyhedra.h"
#include "bench/paper/paper_print.h"
#include "bench/paper/paper_seeds.h"
#include "bench/paper/published.h"
#include "cli/frame/files.h"
#include "cli/frame/message.h"
#include "cli/frame/spelling.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static bool paper_encloses(const paper *p)
{
    int enclose = p->settings->enclose;
    return enclose == ENCLOSE_AUTO ? p->table->enclosed : enclose == ENCLOSE_YES;
}

/* One set, by the walks of the table, or by another one, whose name the result bears; nothing is
 * published for that. */
static int paper_run_walk(paper *p, const dataset *data, const char *set, const char *walk,
                          bool users_file)
{
    char name[256];
    snprintf(name, sizeof name, walk ? "%.200s-%s" : "%.200s", set, walk ? walk : "");
    walk_trial t = paper_trial(p, name, data, users_file);
    t.walk = walk;
    return paper_measure(p, &t, users_file);
}

/* One set, by the walk that --walk names, or by all of them, one after the other. */
static int paper_run_set(paper *p, const dataset *data, const char *set, bool users_file)
{
    const char *walk = p->settings->walk;
    int end = 0;
    if (!walk || strcmp(walk, "all") != 0) return paper_run_walk(p, data, set, walk, users_file);
    for (int i = MW_WALK_AUTO + 1; i < MW_WALK_COUNT && end == 0; i++)
        end = paper_run_walk(p, data, set, mw_walk_name((mw_walk_kind)i), users_file);
    return end;
}

static int paper_check_walk(const paper *p)
{
    const char *walk = p->settings->walk;
    if (!walk) return 0;
    if (strcmp(p->table->name, "E1") != 0) {
        complain("bench paper: --walk is for E1, not %s", p->table->name);
        return END_USAGE;
    }
    if (strcmp(walk, "all") == 0) return 0;
    spelling s = spelling_of(walk);
    for (int i = MW_WALK_AUTO; i < MW_WALK_COUNT; i++) {
        if (strcmp(mw_walk_name((mw_walk_kind)i), walk) == 0) return 0;
        spelling_try(&s, mw_walk_name((mw_walk_kind)i));
    }
    spelling_complain(&s, "walk", "");
    return END_USAGE;
}

static int paper_run_points(paper *p, const size_t *sizes)
{
    int end = 0;
    for (int kind = 0; kind < DATASET_KINDS; kind++)
        for (size_t i = 0; i < MOST_SIZES && sizes[i] && p->table->sets >> kind & 1; i++) {
            dataset data;
            if (!dataset_make(&data, (dataset_kind)kind, sizes[i], paper_encloses(p),
                              p->settings->common.seed))
                return fail_memory();
            end = paper_run_set(p, &data, dataset_name(kind), false);
            dataset_release(&data);
            if (end) return end;
        }
    return 0;
}

/* Is a size among those that were asked for, if any were? */
static bool sizes_have(const size_t *sizes, size_t vertices)
{
    for (size_t i = 0; i < MOST_SIZES && sizes[i]; i++)
        if (sizes[i] == vertices) return true;
    return !sizes[0];
}

/* Sets that stand in for the thesis' own, as large as these. `sizes` is empty, or has those that
 * are wanted. */
static int paper_run_stand_ins(paper *p, const size_t *sizes)
{
    const char *set;
    size_t vertices;
    for (size_t i = 0; published_real(p->table->name, i, &set, &vertices); i++) {
        dataset data;
        if (!sizes_have(sizes, vertices)) continue;
        if (!dataset_make(&data, (dataset_kind)dataset_named(set), vertices, paper_encloses(p),
                          p->settings->common.seed))
            return fail_memory();
        int end = paper_run_set(p, &data, set, false);
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
    default: break;
    }
    int end = paper_run_points(p, sizes);
    return end ? end : paper_run_stand_ins(p, p->settings->sizes ? sizes : &(size_t){0});
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
    if (end == 0) end = paper_run_set(p, &data, paper_base_name(path), true);
    dataset_release(&data);
    return end;
}

static int paper_run_file(const char *path, void *self)
{
    paper *p = self;
    paper_file file;
    int end = paper_file_parse(p->table, path, &file);
    if (end) return end;
    switch (p->table->subject) {
    case PAPER_DOMAINS: return paper_domains_file(p, path, paper_base_name(path));
    case PAPER_STARS:
    case PAPER_SURFACES:
        return paper_polyhedra_file(p, file.path, paper_base_name(file.path), file.model);
    default: return paper_run_point_file(p, path);
    }
}

static int paper_check_file(const char *path, void *self)
{
    const paper *p = self;
    if (!*path) {
        complain("option '--data' must be files separated by commas, not '%s'", p->settings->data);
        return END_USAGE;
    }
    paper_file file;
    int end = paper_file_parse(p->table, path, &file);
    if (end == 0) end = files_check_output(p->settings->common.output, &file.path, 1);
    return end || !p->settings->plot ? end : files_check_output(p->settings->plot, &file.path, 1);
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
    int end = paper_check_walk(&p);
    if (end == 0) end = paper_plot_check(s, table);
    if (end == 0 && table->subject != PAPER_POINTS && s->enclose == ENCLOSE_YES) {
        complain("bench paper: the sets of %s are meshes, which --enclose does not change",
                 table->name);
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
