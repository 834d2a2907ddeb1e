/* bench - measurements that anybody can repeat. */
#include "bench/core/bench.h"
#include "cli/commands/commands.h"
#include "bench/peers/engines.h"
#include "cli/frame/message.h"
#include "cli/frame/spelling.h"

#include <math.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

static const struct {
    const char *name;
    int (*run)(const bench_settings *s, const char *table);
    bool contest; /* of engines, in rounds */
} measurements[] = {
    {"paper", bench_paper, false}, {"near-vertices", bench_near, false}, {"peers", bench_peers, true},
    {"scale", bench_scale, true},  {"edit", bench_edit, true},
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

static const option bench_options[] = {
    {"queries", 0, OPTION_COUNT, offsetof(bench_settings, queries), "N",
     "points to locate on each set (default: 0, a million); of paper at most 20000 of them are timed", NULL},
    {"sizes", 0, OPTION_TEXT, offsetof(bench_settings, sizes), "LIST",
     "numbers of vertices of the sets that are made, as in 1e4,1e5 (default: those of the table)", NULL},
    {"enclose", 0, OPTION_CHOICE, offsetof(bench_settings, enclose), "NAME",
     "add the four corners of the domain to the points (default: auto, as the table does):", &enclose_choices},
    {"data", 0, OPTION_TEXT, offsetof(bench_settings, data), "LIST",
     "files of points, or meshes whose vertices are taken, in place of the sets: ground.las,survey.csv; of D1 and "
     "F1 to G3 meshes, taken as they are; nothing is published for them, but for the models of G1 to G3",
     NULL},
    {"engines", 0, OPTION_TEXT, offsetof(bench_settings, engines), "LIST",
     "engines that peers and scale measure, as in meshwalk,geos (default: all there are; of scale, meshwalk; of edit "
     "see "
     "above):",
     &engine_choices},
    {"tasks", 0, OPTION_TEXT, offsetof(bench_settings, tasks), "LIST",
     "what peers and scale measure (default: the first five; of scale, random and the last two; of edit see above):",
     &task_choices},
    {"rounds", 0, OPTION_COUNT, offsetof(bench_settings, rounds), "N",
     "rounds of peers, scale and edit, whose median counts (default: 0, five)", NULL},
    {"no-times", 0, OPTION_FLAG, offsetof(bench_settings, no_times), NULL, "count only", NULL},
    {"format", 0, OPTION_CHOICE, offsetof(bench_settings, format), "NAME",
     "how to print the figures (default: table):", &format_choices},
    {"plot", 0, OPTION_TEXT, offsetof(bench_settings, plot), "FILE", "draw them too; .svg, .png or .pdf by the ending",
     NULL},
    {0},
};

int bench_each_word(const char *list, visit_word *visit, void *self)
{
    int end = 0;
    for (bool more = true; more && end == 0;) {
        size_t length = strcspn(list, ",");
        char *word = strndup(list, length);
        if (!word) return fail_memory();
        end = visit(word, self);
        free(word);
        more = list[length] == ',';
        list += length + more;
    }
    return end;
}

/* At least 10: four may be corners. */
#define LEAST_SIZE 10
#define MOST_SIZE 500000000

static int take_size(const char *word, void *self)
{
    size_list *list = self;
    char *rest;
    double size = strtod(word, &rest);
    bool plain = *word && strspn(word, "0123456789e") == strlen(word) && !*rest;
    if (!plain || !(size >= LEAST_SIZE && size <= MOST_SIZE) || size != floor(size)) {
        complain("option '--sizes' wants numbers from %d to %d separated by commas, not '%s'", LEAST_SIZE, MOST_SIZE,
                 word);
        return END_USAGE;
    }
    if (list->count == MOST_SIZES) {
        complain("option '--sizes' takes at most %d numbers", MOST_SIZES);
        return END_USAGE;
    }
    list->size[list->count++] = (size_t)size;
    return 0;
}

int bench_sizes(const char *list, size_list *sizes)
{
    *sizes = (size_list){0};
    return bench_each_word(list, take_size, sizes);
}

static int run_measurement(size_t i, const bench_settings *s, const char *table)
{
    if (!measurements[i].contest && (s->engines || s->tasks || s->rounds)) {
        complain("bench %s: --engines, --tasks and --rounds are for 'bench peers', 'bench scale' and 'bench edit'",
                 measurements[i].name);
        return END_USAGE;
    }
    return measurements[i].run(s, table);
}

static int run(const void *settings, const char *const *operands)
{
    const char *what = operands[0];
    spelling s = spelling_of(what);
    for (size_t i = 0; i < MEASUREMENTS; i++) {
        if (strcmp(measurements[i].name, what) == 0) return run_measurement(i, settings, operands[1]);
        spelling_try(&s, measurements[i].name);
    }
    spelling_complain(&s, "measurement", "");
    return END_USAGE;
}

static const option *const tables[] = {bench_options, common_options, NULL};

const command bench_command = {
    .name = "bench",
    .operands = "WHAT [TABLE]",
    .operand_count = 2,
    .optional_operands = 1,
    .summary = "measure the walks, beside published figures and other libraries",
    .description =
        "'meshwalk bench paper TABLE' makes the sets of points of a published table, triangulates them, counts and "
        "times what the walks do, and prints each figure beside the published one and their ratio. TABLE is one of "
        "A1, A2, B1, B2, C1, C2, D1, E1, E2, F1, F2, G1, G2 and G3, after the appendix of the thesis. D1, with Fig. 11 "
        "and 12 of its appendix, is about meshes with pockets and holes, F1 and F2 are about star-shaped polyhedra, "
        "G1 to G3 about probes of a surface: their sets are meshes, and so are their --data. E1 is about "
        "kinds of triangulation. E2 is also Fig. 12 of its appendix. Counts are taken over all queries, on all "
        "threads; times are medians over 5 rounds of single queries on one thread, in plain doubles (time_us) and "
        "exact (time_exact_us).\n\n"
        "'meshwalk bench near-vertices [SET]' locates points within 1e-15 of vertices, or one of the next doubles, in "
        "five meshes: uniform, grid, rings, slivers, offset, or in one of them. It prints for every walk and "
        "arithmetic how many of a million queries ran out of steps (cycles), and how many the celestial walk had to "
        "end (hand-overs).\n\n"
        "'meshwalk bench peers [SET]' measures point location beside other libraries: CGAL, Embree, GEOS, Boost, SciPy "
        "and "
        "matplotlib, where the program was built with them. In one run all engines take turns, and all answers are "
        "compared "
        "with the exact one. 'meshwalk bench scale [SET]' measures from ten thousand vertices to a hundred million. "
        "SET is "
        "one of uniform, grid, gaussian, clusters, arcs, rectangle, rings, slivers and offset, or several of them with "
        "commas between.\n\n"
        "'meshwalk bench edit [SET]' measures what changes of a mesh take, and location between them, beside CGAL, and "
        "beside trees that are built anew. Its tasks are insert, insert-sorted, insert-many, insert-many-sorted, "
        "remove, move-near, "
        "move-far, mixed, "
        "rebuild and session, its engines meshwalk, meshwalk-layers, meshwalk-grid, cgal, cgal-hierarchy, and in "
        "rebuild "
        "meshwalk-anew, embree, geos and boost; the default is all of both. --queries is how many edits are timed "
        "(default: "
        "50000, at most half of the vertices). SET is of uniform, clusters, gaussian, arcs and rectangle.",
    .options = tables,
    .settings_size = sizeof(bench_settings),
    .run = run,
};
