/* The measurements of 'meshwalk bench', and their options. A new one is a file with a function as
 * below, and a row here. */
#include "bench/bench.h"
#include "bench/edits/bench_edit.h"
#include "bench/ocean/bench_ocean.h"
#include "bench/paper/bench_near_vertices.h"
#include "bench/paper/bench_paper.h"
#include "bench/peers/bench_peers.h"
#include "bench/peers/engine_list.h"
#include "bench/ranks/bench_ranks.h"
#include "bench/segments/bench_segments.h"
#include "bench/space/bench_space.h"
#include "bench/terrain/bench_terrain.h"
#include "bench/worst/bench_worst.h"
#include "cli/frame/message.h"
#include "cli/frame/spelling.h"

#include <stddef.h>
#include <string.h>

static const struct {
    const char *name;
    int (*run)(const bench_settings *s, const char *table);
    bool compares; /* engines, in rounds: --engines, --tasks and --rounds are for it */
} measurements[] = {
    {"paper", bench_paper, false},      {"near-vertices", bench_near_vertices, false},
    {"peers", bench_peers, true},       {"scale", bench_scale, true},
    {"edit", bench_edit, true},         {"worst", bench_worst, true},
    {"segments", bench_segments, true}, {"ocean", bench_ocean, true},
    {"terrain", bench_terrain, true},   {"space", bench_space, true},
};
#define MEASUREMENTS (sizeof measurements / sizeof *measurements)

static const char *enclose_name(int i)
{
    static const char *const names[] = {"auto", "yes", "no", NULL};
    return names[i];
}
static const char *format_name(int i)
{
    static const char *const names[] = {"table", "tsv", "json", NULL};
    return names[i];
}
static const choices enclose_choices = {"way to enclose", enclose_name, NULL};
static const choices format_choices = {"format", format_name, NULL};

const option bench_options[] = {
    {"queries", 0, OPTION_COUNT, offsetof(bench_settings, queries), "N",
     "points to locate on each set (default: 0, a million); of paper at most 20000 of them are "
     "timed",
     NULL},
    {"sizes", 0, OPTION_TEXT, offsetof(bench_settings, sizes), "LIST",
     "numbers of vertices of the sets that are made, as in 1e4,1e5 (default: those of the table)",
     NULL},
    {"enclose", 0, OPTION_CHOICE, offsetof(bench_settings, enclose), "NAME",
     "add the four corners of the domain to the points (default: auto, as the table does):",
     &enclose_choices},
    {"data", 0, OPTION_TEXT, offsetof(bench_settings, data), "LIST",
     "files of points, or meshes whose vertices are taken, in place of the sets: "
     "ground.las,survey.csv; of D1 and "
     "F1 to G3 meshes, taken as they are; nothing is published for them, but for the models of G1 "
     "to G3",
     NULL},
    {"engines", 0, OPTION_TEXT, offsetof(bench_settings, engines), "LIST",
     "engines that peers, scale and worst measure, as in meshwalk,geos (default: all there are; of "
     "scale, meshwalk; of worst, three libraries; of edit see above):",
     &engine_choices},
    {"tasks", 0, OPTION_TEXT, offsetof(bench_settings, tasks), "LIST",
     "what peers and scale measure (default: the first five; of scale, random and the last two; of "
     "edit see above):",
     &engine_task_choices},
    {"rounds", 0, OPTION_COUNT, offsetof(bench_settings, rounds), "N",
     "rounds of peers, scale, edit and worst, whose median counts (default: 0, five; of worst "
     "three)",
     NULL},
    {"walk", 0, OPTION_TEXT, offsetof(bench_settings, walk), "NAME",
     "of paper E1: take this walk, as in locate --walk, or 'all' of them, one after the other "
     "(default: stochastic, as "
     "printed)",
     NULL},
    {"ranks", 0, OPTION_TEXT, offsetof(bench_settings, ranks), "LIST",
     "of scale: replay the routing of queries on so many ranks of MPI, as in 10,1e3,1e5; nothing "
     "is "
     "timed",
     NULL},
    {"seeds", 0, OPTION_COUNT, offsetof(bench_settings, seeds), "N",
     "of paper: N runs with seeds one after the other from --seed; prints means and the spread of "
     "one (default: 0, one "
     "run)",
     NULL},
    {"no-times", 0, OPTION_FLAG, offsetof(bench_settings, no_times), NULL, "count only", NULL},
    {"format", 0, OPTION_CHOICE, offsetof(bench_settings, format), "NAME",
     "how to print the figures (default: table):", &format_choices},
    {"plot", 0, OPTION_TEXT, offsetof(bench_settings, plot), "FILE",
     "draw them too; .svg, .png or .pdf by the ending", NULL},
    {0},
};

static int run_measurement(size_t i, const bench_settings *s, const char *table)
{
    if (!measurements[i].compares && (s->engines || s->tasks || s->rounds)) {
        complain("bench %s: --engines, --tasks and --rounds are for 'bench peers', 'bench scale', "
                 "'bench worst' and 'bench edit'",
                 measurements[i].name);
        return END_USAGE;
    }
    if ((s->seeds || s->walk) && measurements[i].run != bench_paper) {
        complain("bench %s: --seeds and --walk are for 'bench paper'", measurements[i].name);
        return END_USAGE;
    }
    if (s->ranks && measurements[i].run != bench_scale) {
        complain("bench %s: --ranks is for 'bench scale'", measurements[i].name);
        return END_USAGE;
    }
    int end = options_limit("seeds", s->seeds, 1000, NULL);
    if (end) return end;
    return s->ranks ? bench_ranks(s, table) : measurements[i].run(s, table);
}

int bench_run(const bench_settings *s, const char *measurement, const char *table)
{
    spelling word = spelling_of(measurement);
    for (size_t i = 0; i < MEASUREMENTS; i++) {
        if (strcmp(measurements[i].name, measurement) == 0) return run_measurement(i, s, table);
        spelling_try(&word, measurements[i].name);
    }
    spelling_complain(&word, "measurement", "");
    return END_USAGE;
}
