/* walk.c - the table of walks. */
#include "walk/walk.h"

#include <string.h>

typedef struct mw_walk_entry {
    const char *name, *source, *help;
} mw_walk_entry;

static const mw_walk_entry entries[MW_WALK_COUNT] = {
    [MW_WALK_AUTO] = {"auto", "", "chosen by the mesh and the queries"},
#define MW_WALK_ENTRY(id, symbol, name, source, help) [MW_WALK_##id] = {name, source, help},
#include <meshwalk/walks.def>
};

static const mw_kernels *const kernels[MW_WALK_COUNT] = {
#define MW_WALK_ENTRY(id, symbol, name, source, help) [MW_WALK_##id] = &mw__##symbol,
#include <meshwalk/walks.def>
};

static const mw_walk_entry *walk_entry(mw_walk_kind walk)
{
    static const mw_walk_entry none = {NULL, NULL, NULL};
    return (unsigned)walk < MW_WALK_COUNT ? &entries[walk] : &none;
}

const char *mw_walk_name(mw_walk_kind walk)
{
    return walk_entry(walk)->name;
}

const char *mw_walk_source(mw_walk_kind walk)
{
    return walk_entry(walk)->source;
}

const char *mw_walk_help(mw_walk_kind walk)
{
    return walk_entry(walk)->help;
}

mw_walk_kind mw_walk_by_name(const char *name)
{
    mw_walk_kind walk = MW_WALK_AUTO;
    while (walk < MW_WALK_COUNT && strcmp(name, entries[walk].name) != 0) walk++;
    return walk;
}

const mw_kernels *mw__walk_kernels(mw_walk_kind kind, const mw_tiling *tiling)
{
    return kind == MW_WALK_DIRECT && tiling->area ? &mw__direct_stored : kernels[kind];
}

mw_verdict mw__walk_finish(mw_walk *walk, mw_walk_kind finish, uint32_t fuel,
                           const mw_tiling *tiling, bool exact, bool count)
{
    walk->e = MW_NO_EDGE; /* the cheap walk was not sure of the edge it came by */
    walk->fuel = fuel;
    walk->stage = MW_STAGE_FINAL;
    if (count) walk->work->triangles[MW_STAGE_FINAL]++;
    return mw__walk_run(walk, mw__walk_kernels(finish, tiling), exact, count);
}

uint32_t mw__walk_fuel(mw_walk_kind kind, mw_arithmetic arithmetic, const mw_tiling *tiling)
{
    double tiles = tiling->tri_count, steps = 4096 + 45 * sqrt(tiles);
    if (kernels[kind]->ends && arithmetic == MW_EXACT && tiling->embedding) steps = tiles + 1;
    if (kind == MW_WALK_BORDER)
        steps += tiling->border_loops ? 4.0 * tiling->border_loops->edge_count : tiles;
    return steps < UINT32_MAX ? (uint32_t)steps : UINT32_MAX;
}

mw_verdict mw__walk_surely(mw_walk *walk, bool count)
{
    const mw_tiling *tiling = walk->tiling;
    mw_verdict verdict = MW_VERDICT_OUT_OF_FUEL;
    if (!tiling->border_loops) {
        walk->fuel = mw__walk_fuel(MW_WALK_CELESTIAL, MW_EXACT, tiling);
        return mw__walk_run(walk, &mw__celestial, true, count);
    }
    while (verdict == MW_VERDICT_OUT_OF_FUEL) { /* once, unless there are some 10^9 border edges */
        walk->fuel = UINT32_MAX;
        verdict = mw__walk_run(walk, &mw__border_sure, true, count);
    }
    return verdict;
}
