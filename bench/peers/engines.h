/* engines.h - which engines there are, and what they are called. */
#ifndef CLI_ENGINES_H
#define CLI_ENGINES_H

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
const char *engines_task(engine_task task);
/* The names of both, for --help. */
extern const choices engine_choices, task_choices;

/* How to run an engine; NULL: this program, or this machine, does not have it. */
const engine_code *engines_code(engine_id id);
/* Ours; NULL for a peer. */
const engine_code *engine_own(engine_id id);

/* The names in a list between commas, as bits. Complains of others; returns 0 or an exit code. */
int engines_choose(const char *list, const choices *names, uint32_t *set);

/* Sets of engines and tasks, as bits, by their names between commas. Complain of other names, and of engines that are not to
 * be had; return 0 or an exit code. */
int engines_named(const char *list, uint32_t *set);
int engines_tasks_named(const char *list, uint32_t *set);

/* Is there memory for a library to take so many vertices? Complains. Ours may always try. */
bool engines_have_room(engine_library library, size_t vertices);

/* Say on standard error which of these libraries are missing, and how to get them. */
void engines_missing(uint32_t set);

/* The versions of the peers among these engines: ", CGAL 5.5.1". */
void engines_versions(text *t, uint32_t set);

#endif
