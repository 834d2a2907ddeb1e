#include "bench/peers/engines.h"
#include "bench/core/bench.h"
#include "cli/frame/message.h"

#include <stdio.h>
#include <string.h>

const engine engines[ENGINES] = {
#define ENGINE(id, name, library, exact, parallel, tasks, help) {name, help, LIBRARY_##library, exact, parallel, tasks},
#include "bench/peers/engines.def"
};

static const struct {
    const char *name, *package; /* in Debian; it is wanted when the program is built, but of Python's when it runs */
    bool python;
    size_t bytes; /* per vertex that building takes, about; 0: not to be asked */
} libraries[LIBRARIES] = {
    [LIBRARY_MESHWALK] = {"meshwalk", NULL, false, 0},
    [LIBRARY_CGAL] = {"CGAL", "libcgal-dev", false, 250},
    [LIBRARY_EMBREE] = {"Embree 3", "libembree-dev", false, 500},
    [LIBRARY_GEOS] = {"GEOS", "libgeos-dev", false, 300},
    [LIBRARY_BOOST] = {"Boost", "libboost-dev", false, 300},
    [LIBRARY_SCIPY] = {"SciPy", "python3-scipy", true, 1500},
    [LIBRARY_MATPLOTLIB] = {"matplotlib", "python3-matplotlib", true, 2500},
};

const char *engines_task(engine_task task)
{
    static const char *const names[TASKS] = {
        [TASK_RANDOM] = "random",     [TASK_SORTED] = "sorted",
        [TASK_COHERENT] = "coherent", [TASK_HALF_OUTSIDE] = "half-outside",
        [TASK_TOTAL] = "total",       [TASK_DENSE] = "dense",
        [TASK_DELAUNAY] = "delaunay", [TASK_CONNECTIVITY] = "connectivity",
    };
    return names[task];
}

#ifdef MW_PEERS
static const bool with_peers = true;
#else
static const bool with_peers = false;
const engine_code *peers_engine(engine_id id)
{
    (void)id;
    return NULL;
}
#endif

const engine_code *engines_code(engine_id id)
{
    if (engines[id].library == LIBRARY_MESHWALK) return engine_own(id);
    const engine_code *code = peers_engine(id);
    return code && code->structure->version() ? code : NULL;
}

/* --- lists of names ---------------------------------------------------------------------------------------------- */

static const char *engine_name(int i)
{
    return i < ENGINES ? engines[i].name : NULL;
}
static const char *engine_help(int i)
{
    return engines[i].help;
}
static const char *task_name(int i)
{
    return i < TASKS ? engines_task((engine_task)i) : NULL;
}
static const char *task_help(int i)
{
    static const char *const help[TASKS] = {
        [TASK_RANDOM] = "queries in the mesh, in random order",
        [TASK_SORTED] = "the same, given along a Hilbert curve",
        [TASK_COHERENT] = "a stream with steps of about one edge",
        [TASK_HALF_OUTSIDE] = "as random, half of them in no triangle",
        [TASK_TOTAL] = "as random, with all that is built",
        [TASK_DENSE] = "as random, as dense as the mesh is",
        [TASK_DELAUNAY] = "the Delaunay triangulation",
        [TASK_CONNECTIVITY] = "from arrays to the first query",
    };
    return help[i];
}
const choices engine_choices = {"engine", engine_name, engine_help};
const choices task_choices = {"task", task_name, task_help};

typedef struct naming {
    const choices *choices;
    uint32_t set;
} naming;

static int take_name(const char *word, void *self)
{
    naming *n = self;
    for (int i = 0; n->choices->name(i); i++)
        if (strcmp(n->choices->name(i), word) == 0) {
            n->set |= UINT32_C(1) << i;
            return 0;
        }
    text all = {0};
    for (int i = 0; n->choices->name(i); i++) text_printf(&all, "%s%s", i ? ", " : "", n->choices->name(i));
    text_bytes(&all, "", 1);
    complain("unknown %s '%s'; there are %s", n->choices->noun, word, all.failed ? "others" : all.bytes);
    text_release(&all);
    return END_USAGE;
}

int engines_choose(const char *list, const choices *names, uint32_t *set)
{
    naming n = {.choices = names};
    int end = bench_each_word(list, take_name, &n);
    *set = n.set;
    return end;
}

int engines_tasks_named(const char *list, uint32_t *set)
{
    return engines_choose(list, &task_choices, set);
}

static bool is_in(uint32_t set, engine_id id)
{
    return set >> id & 1;
}

int engines_named(const char *list, uint32_t *set)
{
    int end = engines_choose(list, &engine_choices, set);
    for (engine_id id = 0; id < ENGINES && end == 0; id++)
        if (is_in(*set, id) && !engines_code(id)) {
            engines_missing(UINT32_C(1) << id);
            end = END_USAGE;
        }
    return end;
}

/* Bytes that the system can give without taking them from others; 0: it does not tell. */
static double available(void)
{
    char line[256];
    double kilobytes = 0;
    FILE *info = fopen("/proc/meminfo", "r");
    while (info && fgets(line, sizeof line, info))
        if (sscanf(line, "MemAvailable: %lf", &kilobytes) == 1) break;
    if (info) fclose(info);
    return 1024 * kilobytes;
}

bool engines_have_room(engine_library library, size_t vertices)
{
    double wanted = (double)libraries[library].bytes * (double)vertices, there = available();
    if (wanted <= there || there == 0) return true;
    complain("%s wants about %.0f GB for %zu vertices, and there are %.0f", libraries[library].name, wanted / 1e9,
             vertices, there / 1e9);
    return false;
}

/* --- what there is ----------------------------------------------------------------------------------------------- */

static bool wants_library(uint32_t set, engine_library library, bool present)
{
    for (engine_id id = 0; id < ENGINES; id++)
        if (is_in(set, id) && engines[id].library == library && (engines_code(id) != NULL) == present) return true;
    return false;
}

static const char *why_missing(engine_library library)
{
    if (!with_peers) return "this program was built without its peers (cmake -DMW_BUILD_BENCH=ON)";
    return libraries[library].python ? "python3 does not find it" : "it was not found when this program was built";
}

void engines_missing(uint32_t set)
{
    for (engine_library library = 0; library < LIBRARIES; library++)
        if (wants_library(set, library, false))
            complain("without %s: %s; on Debian: apt-get install %s", libraries[library].name, why_missing(library),
                     libraries[library].package);
}

void engines_versions(text *t, uint32_t set)
{
    for (engine_library library = LIBRARY_MESHWALK + 1; library < LIBRARIES; library++)
        for (engine_id id = 0; id < ENGINES; id++)
            if (is_in(set, id) && engines[id].library == library && engines_code(id)) {
                text_printf(t, ", %s", engines_code(id)->structure->version());
                break;
            }
}
