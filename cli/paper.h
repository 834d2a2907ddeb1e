/* paper.h - a published table measured again: what 'bench paper' has found, and how it shows it. */
#ifndef CLI_PAPER_H
#define CLI_PAPER_H

#include "bench.h"
#include "measure.h"
#include "text.h"

typedef struct paper_table {
    const char *name, *title;
    const algorithm *algorithms[MOST_ALGORITHMS + 1]; /* NULL ends them */
    const algorithm *reference;                       /* ratios between walks are taken to this one */
    const char *finish;
    unsigned sets; /* 1 << dataset_kind */
    size_t sizes[MOST_SIZES];
    bool enclosed, layered;
    quantity drawn;
} paper_table;

/* One set of points. */
typedef struct paper_result {
    char dataset[256];
    bool own; /* a file of the user's: nothing is published for it */
    outcome outcome;
} paper_result;

typedef struct paper {
    const paper_table *table;
    const bench_settings *settings;
    uint64_t queries;
    paper_result *results;
    size_t count;
} paper;

/* What is published of algorithm i for this result; NaN if nothing. */
double paper_published(const paper *p, const paper_result *r, size_t i, quantity q);

/* Sums over the columns that the table prints of an algorithm: of triangles, and of all tests. `published`: of the printed
 * numbers instead of ours; NaN where one is missing. */
enum { PAPER_TRIANGLES, PAPER_TESTS };
double paper_sum(const paper *p, const paper_result *r, size_t i, int which, bool published);

void paper_print(const paper *p, text *t);

/* Draw the figures into a file. paper_plot_check complains about what can be known before the work. Return 0 or an exit
 * code. */
int paper_plot_check(const bench_settings *s, const paper_table *table);
int paper_plot(const paper *p, const char *path);

#endif
