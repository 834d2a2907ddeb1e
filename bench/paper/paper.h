/* paper.h - a published table measured again: what 'bench paper' has found, and how it shows it. */
#ifndef CLI_PAPER_H
#define CLI_PAPER_H

#include "bench/core/bench.h"
#include "bench/core/measure.h"
#include "cli/frame/text.h"

/* What a table is about: points that are triangulated; planar meshes (App. D); star-shaped polyhedra (App. F); surfaces
 * (App. G). */
typedef enum paper_subject { PAPER_POINTS, PAPER_DOMAINS, PAPER_STARS, PAPER_SURFACES } paper_subject;

typedef struct paper_table {
    const char *name, *title;
    const algorithm *algorithms[MOST_ALGORITHMS + 1]; /* NULL ends them */
    const algorithm *reference;                       /* ratios between walks are taken to this one */
    const char *finish;                               /* NULL: auto */
    const char *start, *from;                         /* where walks begin: its name, and in words */
    uint64_t quantities;                              /* 1 << quantity: those of each algorithm */
    const algorithm *whole;                           /* NULL, or the name of what a set as a whole has, */
    uint64_t whole_quantities;                        /* these */
    unsigned sets;                                    /* 1 << dataset_kind */
    size_t sizes[MOST_SIZES];
    paper_subject subject;
    bool enclosed; /* four corners are added to the points */
    int variant;   /* of App. G: which of its three kinds of queries */
    quantity drawn;
} paper_table;

/* The table of a name; NULL after a complaint. */
const paper_table *paper_table_named(const char *name);

/* Put sums where a column of the table is one. */
void paper_sum_columns(const paper_table *table, outcome *o);

/* One set of points; or a mesh, and one way to draw queries and to begin. */
typedef struct paper_result {
    char dataset[256];
    bool own;          /* a file of the user's: nothing is published for it, but if it is a model of the thesis: */
    const char *model; /* NULL, or that one's name, */
    size_t model_vertices;
    bool walks, whole; /* the parts of the outcome that it has */
    outcome outcome;
} paper_result;

typedef struct paper {
    const paper_table *table;
    const bench_settings *settings;
    uint64_t queries;
    paper_result *results;
    size_t count;
} paper;

/* The trial of a set as the table and the settings want it; measured, it becomes the last of the results. paper_measure
 * returns 0 or an exit code; paper_add returns an empty result, or NULL without memory. */
trial paper_trial(const paper *p, const char *name, const dataset *data, bool own);
int paper_measure(paper *p, const trial *t, bool own);
paper_result *paper_add(paper *p, const char *name, bool own);

/* App. D: meshes that are made, those of the table or of the sizes, which a 0 ends; and one from a file. Return 0 or an
 * exit code. */
int paper_domains(paper *p, const size_t *sizes);
int paper_domain_file(paper *p, const char *path, const char *name);

/* A star-shaped polyhedron (App. F), or a surface (App. G). Return 0 or an exit code. */
int paper_star(paper *p, const mw_arrays *arrays, const char *name, bool own);
int paper_surface(paper *p, const mw_arrays *arrays, const char *name, bool own);

/* Those that are made, of the sizes, which a 0 ends; and the one of a file, as the table wants it. Return 0 or an exit
 * code. */
int paper_stars(paper *p, const size_t *sizes);
int paper_surfaces(paper *p, const size_t *sizes);
int paper_polyhedron_file(paper *p, const char *path, const char *name);

/* What is published of an algorithm, or of algorithm i, for this result; NaN if nothing. */
double paper_published_of(const paper *p, const paper_result *r, const algorithm *a, quantity q);
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
