/* start_names.c - the table of starts. */
#include "start/start.h"

#include <meshwalk/locate.h>
#include <string.h>

static const struct {
    const char *name, *help;
    int has_index;
} entries[MW_START_COUNT] = {
    [MW_START_AUTO] = {"auto", "chosen by the mesh and the queries", 0},
#define MW_START_ENTRY(id, name, source, index, help) [MW_START_##id] = {name, help, index},
#include <meshwalk/starts.def>
};

const char *mw_start_name(mw_start_kind start)
{
    return (unsigned)start < MW_START_COUNT ? entries[start].name : NULL;
}

const char *mw_start_help(mw_start_kind start)
{
    return (unsigned)start < MW_START_COUNT ? entries[start].help : NULL;
}

int mw_start_has_index(mw_start_kind start)
{
    return (unsigned)start < MW_START_COUNT ? entries[start].has_index : 0;
}

mw_start_kind mw_start_by_name(const char *name)
{
    mw_start_kind start = MW_START_AUTO;
    while (start < MW_START_COUNT && strcmp(name, entries[start].name) != 0) start++;
    return start;
}
