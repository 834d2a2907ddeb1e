#include "bench/edits/edit_engine_list.h"

const edit_engine edit_engines[EDIT_ENGINES] = {
#define EDIT_ENGINE(id, name, engine, follows, help) {name, help, ENGINE_##engine, follows},
#include "bench/edits/edit_engine.def"
};

static const char *listed_edit_engine_name(int i)
{
    return i < EDIT_ENGINES ? edit_engines[i].name : NULL;
}
static const char *listed_edit_task_name(int i)
{
    return i < EDIT_TASKS ? edit_task_name((edit_task)i) : NULL;
}
const choices edit_engine_choices = {"engine", listed_edit_engine_name, NULL};
const choices edit_task_choices = {"task", listed_edit_task_name, NULL};

#ifndef MW_PEERS
const edit_engine_code *edit_engine_cgal_code(edit_engine_id id)
{
    (void)id;
    return NULL;
}
#endif

const edit_engine_code *edit_engine_code_of(edit_engine_id id)
{
    if (!edit_engines[id].follows) return NULL;
    const edit_engine_code *own = edit_engine_meshwalk_code(id);
    return own ? own : edit_engine_cgal_code(id);
}

bool edit_engine_is_there(edit_engine_id id)
{
    return edit_engines[id].follows ? edit_engine_code_of(id) != NULL
                                    : engine_code_of(edit_engines[id].engine) != NULL;
}

uint32_t edit_engine_libraries(uint32_t set)
{
    uint32_t found = 0;
    for (edit_engine_id id = 0; id < EDIT_ENGINES; id++)
        if (edit_engine_is_in(set, id)) found |= UINT32_C(1) << edit_engines[id].engine;
    return found;
}
