#include "bench/peers/engine_list.h"
#include "bench/core/machine.h"
#include "bench/core/word_list.h"
#include "bench/peers/engine_meshwalk.h"
#include "bench/peers/peer_list.h"
#include "cli/frame/message.h"

#include <meshwalk/meshwalk.h>

#include <stdio.h>
#include <unistd.h>

const engine engines[ENGINES] = {
#define ENGINE(id, name, library, exact, parallel, tasks, help)                                    \
    {name, help, LIBRARY_##library, exact, parallel, tasks},
#include "bench/peers/engine.def"
};

static const struct {
    /* in Debian; it is wanted when the program is built, but of Python's when it runs */
    const char *name, *package;
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

const char *engine_task_name(engine_task task)
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
static const bool built_with_peers = true;
#else
static const bool built_with_peers = false;
const engine_code *peer_engine(engine_id id)
{
    (void)id;
    return NULL;
}
#endif

const engine_code *engine_code_of(engine_id id)
{
    if (engines[id].library == LIBRARY_MESHWALK) return engine_meshwalk_code(id);
    const engine_code *code = peer_engine(id);
    return code && code->structure->version() ? code : NULL;
}

/* --- names ------------------------------------------------------------------------------------ */

static const char *listed_engine_name(int i)
{
    return i < ENGINES ? engines[i].name : NULL;
}
static const char *listed_engine_help(int i)
{
    return engines[i].help;
}
static const char *listed_task_name(int i)
{
    return i < TASKS ? engine_task_name((engine_task)i) : NULL;
}
static const char *listed_task_help(int i)
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
const choices engine_choices = {"engine", listed_engine_name, listed_engine_help};
const choices engine_task_choices = {"task", listed_task_name, listed_task_help};

int engine_list_named(const char *list, uint32_t *set)
{
    int end = word_list_names(list, &engine_choices, set);
    for (engine_id id = 0; id < ENGINES && end == 0; id++)
        if (engine_is_in(*set, id) && !engine_code_of(id)) {
            engine_list_complain_missing(UINT32_C(1) << id);
            end = END_USAGE;
        }
    return end;
}

/* Bytes that the system can give without taking them from others; 0: it does not tell. */
static double available_memory(void)
{
    char line[256];
    double kilobytes = 0;
    FILE *info = fopen("/proc/meminfo", "r");
    while (info && fgets(line, sizeof line, info))
        if (sscanf(line, "MemAvailable: %lf", &kilobytes) == 1) break;
    if (info) fclose(info);
    return 1024 * kilobytes;
}

bool engine_library_has_room(engine_library library, size_t vertices)
{
    double wanted = (double)libraries[library].bytes * (double)vertices, there = available_memory();
    if (wanted <= there || there == 0) return true;
    complain("%s needs about %.0f GB for %zu vertices, but there are %.0f", libraries[library].name,
             wanted / 1e9, vertices, there / 1e9);
    return false;
}

/* --- what there is ---------------------------------------------------------------------------- */

static bool engine_set_has_library(uint32_t set, engine_library library, bool present)
{
    for (engine_id id = 0; id < ENGINES; id++)
        if (engine_is_in(set, id) && engines[id].library == library &&
            (engine_code_of(id) != NULL) == present)
            return true;
    return false;
}

static const char *why_library_is_missing(engine_library library)
{
    if (!built_with_peers)
        return "this program was built without its peers (cmake -DMW_BUILD_BENCH=ON)";
    return libraries[library].python ? "python3 does not find it"
                                     : "it was not found when this program was built";
}

void engine_list_complain_missing(uint32_t set)
{
    for (engine_library library = 0; library < LIBRARIES; library++)
        if (engine_set_has_library(set, library, false))
            complain("without %s: %s; on Debian: apt-get install %s", libraries[library].name,
                     why_library_is_missing(library), libraries[library].package);
}

static void add_versions(uint32_t set, text *t)
{
    for (engine_library library = LIBRARY_MESHWALK + 1; library < LIBRARIES; library++)
        for (engine_id id = 0; id < ENGINES; id++)
            if (engine_is_in(set, id) && engines[id].library == library && engine_code_of(id)) {
                text_printf(t, ", %s", engine_code_of(id)->structure->version());
                break;
            }
}

void engine_list_describe(uint32_t set, text *t)
{
    char processor[256];
    machine_date_text date;
    machine_processor(processor, sizeof processor);
    machine_date(date);
#ifdef __clang__
    text_printf(t, "%s, %ld processors; clang %d.%d.%d", processor, sysconf(_SC_NPROCESSORS_ONLN),
                __clang_major__, __clang_minor__, __clang_patchlevel__);
#else
    text_printf(t, "%s, %ld processors; gcc %s", processor, sysconf(_SC_NPROCESSORS_ONLN),
                __VERSION__);
#endif
#ifndef __OPTIMIZE__
    text_string(t, ", not optimised");
#endif
    text_printf(t, "; meshwalk %s", mw_version());
    add_versions(set, t);
    text_printf(t, "; %s", date);
}
