/* names.c - the table of starts. */
#include "start/start.h"

#include <meshwalk/locate.h>
#include <string.h>

static const struct {
    const char *name, *help;
} entries[MW_START_COUNT] = {
    [MW_START_AUTO] = {"auto", "chosen by the mesh and the queries"},
#define MW_START_ENTRY(id, name, source, help) [MW_START_##id] = {name, help},
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

mw_start_kind mw_start_by_name(const char *name)
{
    mw_start_kind start = MW_START_AUTO;
    while (start < MW_START_COUNT && strcmp(name, entries[start].name) != 0) start++;
    return start;
}
