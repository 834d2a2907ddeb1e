/* engine_list.h - which engines there are, what they are called, and which of them this program can
 * run. */
#ifndef MW_BENCH_PEERS_ENGINE_LIST_H
#define MW_BENCH_PEERS_ENGINE_LIST_H

#include "bench/peers/engine.h"
#include "cli/frame/options.h"
#include "cli/frame/text.h"

typedef struct engine {
    const char *name, *help;
    engine_library library;
    bool exact, parallel;
    uint32_t tasks; /* ENGINE_IN */
} engine;

extern const engine engines[ENGINES];

/* "random", ... */
const char *engine_task_name(engine_task task);
/* The names of both, for --help and for lists on the command line. */
extern const choices engine_choices, engine_task_choices;

/* How to run an engine; NULL: this program, or this machine, does not have it. */
const engine_code *engine_code_of(engine_id id);

/* Sets of engines have a bit for each. */
static inline bool engine_is_in(uint32_t set, engine_id id)
{
    return set >> id & 1;
}

/* The set of a list of names with commas between them. Complains about other names, and about
 * engines that are not to be had. Returns 0 or an exit code. */
int engine_list_named(const char *list, uint32_t *set);

/* Is there memory for a library to take so many vertices? Complains. Ours may always try. */
bool engine_library_has_room(engine_library library, size_t vertices);

/* Say on standard error which libraries of these engines are missing, and how to get them. */
void engine_list_complain_missing(uint32_t set);

/* What a figure says nothing without: processor, compiler, versions of the libraries of these
 * engines, date. */
void engine_list_describe(uint32_t set, text *t);

#endif
