/* edit_engine_list.h - which engines 'bench edit' has, what they are called, and which of them this
 * program can run. */
#ifndef MW_BENCH_EDITS_EDIT_ENGINE_LIST_H
#define MW_BENCH_EDITS_EDIT_ENGINE_LIST_H

#include "bench/edits/edit_engine.h"
#include "bench/peers/engine_list.h"

typedef struct edit_engine {
    const char *name, *help;
    engine_id engine; /* the engine whose library it is      */
    bool follows;     /* it follows edits; else it is rebuilt */
} edit_engine;

extern const edit_engine edit_engines[EDIT_ENGINES];

/* The names of engines and tasks, for lists on the command line. */
extern const choices edit_engine_choices, edit_task_choices;

/* How to run one that follows edits; NULL: it does not, or this program does not have it. */
const edit_engine_code *edit_engine_code_of(edit_engine_id id);
/* Is it to be had, of either kind? */
bool edit_engine_is_there(edit_engine_id id);

/* Sets of them have a bit for each. */
static inline bool edit_engine_is_in(uint32_t set, edit_engine_id id)
{
    return set >> id & 1;
}

/* The set of the engines (engine.h) whose libraries they are. */
uint32_t edit_engine_libraries(uint32_t set);

#endif
