/* settings.h - what the options of 'meshwalk bench' say: every measurement gets it. */
#ifndef MW_BENCH_CORE_SETTINGS_H
#define MW_BENCH_CORE_SETTINGS_H

#include "cli/frame/options.h"

enum { ENCLOSE_AUTO, ENCLOSE_YES, ENCLOSE_NO };
enum { FORMAT_TABLE, FORMAT_TSV, FORMAT_JSON };

typedef struct bench_settings {
    common_settings common;
    const char *sizes, *data, *plot, *engines, *tasks; /* lists and a file; NULL: not given */
    const char *ranks; /* of scale: a list of numbers; NULL: not given */
    /* of paper E1: a walk, or "all"; NULL: the printed one */
    const char *walk;
    uint32_t queries, rounds; /* 0: the default of the measurement */
    uint32_t seeds;           /* of paper: so many runs; 0: one    */
    int enclose, format;
    bool no_times;
} bench_settings;

#endif
