/* paper_models.h - the real models of Apps. F and G, of which the thesis prints numbers. */
#ifndef MW_BENCH_PAPER_PAPER_MODELS_H
#define MW_BENCH_PAPER_PAPER_MODELS_H

#include "bench/paper/paper.h"

/* A word of --data: FILE, or MODEL=FILE for a file that stands in for a model of the table. */
typedef struct paper_file {
    char model[32]; /* empty: none is named */
    const char *path;
} paper_file;

/* Take a word apart. Tables of points know no models. Returns 0, or END_USAGE after a complaint
 * about a name that is none of the table's models. */
int paper_file_parse(const paper_table *table, const char *word, paper_file *file);

/* Note in *r which model of the table it stands for: the one that is named; or the one whose name
 * the data set's begins with, if it has about as many triangles. `suffix` is that of the published
 * set, as "-128", or empty. */
void paper_models_match(const paper_table *table, const char *named, const char *suffix,
                        double triangles, paper_result *r);

#endif
