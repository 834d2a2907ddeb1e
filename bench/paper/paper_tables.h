/* paper_tables.h - the tables of the thesis that can be measured again. */
#ifndef MW_BENCH_PAPER_PAPER_TABLES_H
#define MW_BENCH_PAPER_PAPER_TABLES_H

#include "bench/core/word_list.h"
#include "bench/paper/walk_measurement.h"

/* What a table is about: points that are triangulated; planar meshes (App. D); star-shaped
 * polyhedra (App. F); surfaces (App. G). */
typedef enum paper_subject {
    PAPER_POINTS,
    PAPER_DOMAINS,
    PAPER_STARS,
    PAPER_SURFACES
} paper_subject;

typedef struct paper_table {
    const char *name, *title;
    const algorithm *algorithms[MOST_ALGORITHMS + 1]; /* NULL ends them */
    /* ratios between walks are taken to this one */
    const algorithm *reference;
    const char *finish; /* NULL: auto */
    /* where walks begin: its name, and in words */
    const char *start, *from;
    uint64_t quantities; /* 1 << quantity: those of each algorithm */
    /* NULL, or the name of what a set as a whole has, */
    const algorithm *whole;
    uint64_t whole_quantities; /* these */
    unsigned sets;             /* 1 << dataset_kind */
    size_t sizes[MOST_SIZES];
    paper_subject subject;
    bool enclosed; /* four corners are added to the points */
    int variant;   /* of App. G: which of its three kinds of queries */
    quantity drawn;
} paper_table;

/* The table of a name; NULL after a complaint. */
const paper_table *paper_table_named(const char *name);

/* Some columns of a table are sums of our quantities: put the sums there. */
void paper_table_sum_columns(const paper_table *table, walk_outcome *o);

#endif
