/* bench.h - what the measurements of 'meshwalk bench' share: the settings. Each measurement has a file of its own and a
 * row in bench.c. */
#ifndef CLI_BENCH_H
#define CLI_BENCH_H

#include "options.h"

enum { ENCLOSE_AUTO, ENCLOSE_YES, ENCLOSE_NO };
enum { FORMAT_TABLE, FORMAT_TSV, FORMAT_JSON };

typedef struct bench_settings {
    common_settings common;
    const char *sizes, *data, *plot;
    uint32_t queries;
    int enclose, format;
    bool no_times;
} bench_settings;

/* A measurement: 'meshwalk bench WHAT [TABLE]'; table is NULL if none was given. Returns the exit code. */
int bench_paper(const bench_settings *s, const char *table);

#endif
