/* bench.h - what the measurements of 'meshwalk bench' share: the settings. Each measurement has a file of its own and a
 * row in bench.c. */
#ifndef CLI_BENCH_H
#define CLI_BENCH_H

#include "cli/frame/options.h"

enum { ENCLOSE_AUTO, ENCLOSE_YES, ENCLOSE_NO };
enum { FORMAT_TABLE, FORMAT_TSV, FORMAT_JSON };

typedef struct bench_settings {
    common_settings common;
    const char *sizes, *data, *plot, *engines, *tasks;
    uint32_t queries, rounds;
    int enclose, format;
    bool no_times;
} bench_settings;

/* Run `visit` on each word of a list between commas, until one returns an exit code; return that. */
typedef int visit_word(const char *word, void *self);
int bench_each_word(const char *list, visit_word *visit, void *self);

#define MOST_SIZES 8

typedef struct size_list {
    size_t size[MOST_SIZES];
    size_t count;
} size_list;

/* The numbers of --sizes. Complains; returns 0 or an exit code. */
int bench_sizes(const char *list, size_list *sizes);

/* The measurements: 'meshwalk bench WHAT [TABLE]'; the last is NULL if it was not given. Return the exit code. */
int bench_paper(const bench_settings *s, const char *table);
int bench_near(const bench_settings *s, const char *set);
int bench_peers(const bench_settings *s, const char *set);
int bench_scale(const bench_settings *s, const char *set);
int bench_edit(const bench_settings *s, const char *set);

#endif
