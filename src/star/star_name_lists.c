/* star_name_lists.c - the names of walks and starts. */
#include <meshwalk/star.h>
#include <string.h>

static const struct {
    const char *name, *source, *help;
} walks[MW_STAR_WALK_COUNT] = {
    [MW_STAR_WALK_AUTO] = {"auto", "", "chosen by the queries"},
#define MW_STAR_WALK_ENTRY(id, symbol, name, source, help)                                         \
    [MW_STAR_WALK_##id] = {name, source, help},
#include <meshwalk/star_walks.def>
};

static const struct {
    const char *name, *help;
    int has_index;
} starts[MW_STAR_START_COUNT] = {
    [MW_STAR_START_AUTO] = {"auto", "chosen by the queries", 0},
#define MW_STAR_START_ENTRY(id, name, source, index, help)                                         \
    [MW_STAR_START_##id] = {name, help, index},
#include <meshwalk/star_starts.def>
};

const char *mw_star_walk_name(mw_star_walk_kind walk)
{
    return (unsigned)walk < MW_STAR_WALK_COUNT ? walks[walk].name : NULL;
}

const char *mw_star_walk_source(mw_star_walk_kind walk)
{
    return (unsigned)walk < MW_STAR_WALK_COUNT ? walks[walk].source : NULL;
}

const char *mw_star_walk_help(mw_star_walk_kind walk)
{
    return (unsigned)walk < MW_STAR_WALK_COUNT ? walks[walk].help : NULL;
}

const char *mw_star_start_name(mw_star_start_kind start)
{
    return (unsigned)start < MW_STAR_START_COUNT ? starts[start].name : NULL;
}

const char *mw_star_start_help(mw_star_start_kind start)
{
    return (unsigned)start < MW_STAR_START_COUNT ? starts[start].help : NULL;
}

int mw_star_start_has_index(mw_star_start_kind start)
{
    return (unsigned)start < MW_STAR_START_COUNT ? starts[start].has_index : 0;
}

mw_star_walk_kind mw_star_walk_by_name(const char *name)
{
    mw_star_walk_kind walk = MW_STAR_WALK_AUTO;
    while (walk < MW_STAR_WALK_COUNT && strcmp(name, walks[walk].name) != 0) walk++;
    return walk;
}

mw_star_start_kind mw_star_start_by_name(const char *name)
{
    mw_star_start_kind start = MW_STAR_START_AUTO;
    while (start < MW_STAR_START_COUNT && strcmp(name, starts[start].name) != 0) start++;
    return start;
}
