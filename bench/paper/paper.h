/* paper.h - a published table measured again: what 'bench paper' has found. */
#ifndef MW_BENCH_PAPER_PAPER_H
#define MW_BENCH_PAPER_PAPER_H

#include "bench/core/settings.h"
#include "bench/paper/paper_tables.h"

/* One set of points; or a mesh, and one way to draw queries and to begin. */
typedef struct paper_result {
    char dataset[256];
    bool users_file; /* nothing is published for it, but if it is a model of the thesis: */
    char model[40];  /* empty, or that one's name, */
    size_t model_vertices;
    bool stands_in;    /* the user says so */
    bool walks, whole; /* the parts of the outcome that it has */
    walk_outcome outcome;
    walk_outcome deviation; /* standard deviations over the seeds, where there are several */
} paper_result;

typedef struct paper {
    const paper_table *table;
    const bench_settings *settings;
    uint64_t queries;
    paper_result *results;
    size_t count;
} paper;

/* The trial of a set as the table and the settings want it; measured, it becomes the last of the
 * results. paper_measure returns 0 or an exit code; paper_add returns an empty result, or NULL
 * without memory. */
walk_trial paper_trial(const paper *p, const char *name, const dataset *data, bool users_file);
int paper_measure(paper *p, const walk_trial *t, bool users_file);
paper_result *paper_add(paper *p, const char *name, bool users_file);

/* What is published of an algorithm, or of algorithm i, for this result; NaN if nothing. */
double paper_published_of(const paper *p, const paper_result *r, const algorithm *a, quantity q);
double paper_published(const paper *p, const paper_result *r, size_t i, quantity q);

/* Sums over the columns that the table prints of an algorithm: of triangles, and of all tests.
 * `published`: of the printed numbers instead of ours; NaN where one is missing. */
enum { PAPER_TRIANGLES, PAPER_TESTS };
double paper_sum(const paper *p, const paper_result *r, size_t i, int which, bool published);

#endif
