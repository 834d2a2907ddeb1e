/* trace.c - walks whose way is written down, tile by tile. */
#include "walk/walk.h"

static void trace_record(mw_walk_trace *trace, const mw_triangle *tile, uint32_t stage)
{
    if (tile->user & MW_GHOST) return;
    size_t i = trace->count++;
    if (i >= trace->capacity) return;
    trace->triangle[i] = tile->user & MW_USER_MASK;
    if (trace->stage) trace->stage[i] = (uint8_t)stage;
}

void mw__walk_record(mw_walk_trace *trace, const mw_walk *walk)
{
    trace_record(trace, &walk->tri[walk->t], walk->stage);
}

/* In one step the border walk turns round a vertex of the border: over edge e of tile t, then over
 * each further edge at that vertex, up to the border. From there it may go on into a tile beyond
 * the border, or return to a tile that it has passed. */
static void trace_record_turn(mw_walk_trace *trace, const mw_walk *walk, uint32_t t, uint32_t e,
                              uint64_t entered)
{
    for (; entered && walk->tri[t].link[e] != MW_NONE; entered--) {
        uint32_t link = walk->tri[t].link[e];
        t = mw__link_triangle(link);
        e = mw__next(mw__link_edge(link));
        trace_record(trace, &walk->tri[t], MW_STAGE_BORDER);
    }
    if (t != walk->t) mw__walk_record(trace, walk);
}

static mw_verdict walk_step_recorded(mw_walk *walk, const mw_kernels *kernels)
{
    mw_work *work = walk->work;
    uint32_t t = walk->t, e = walk->e;
    uint64_t visited = work->visited;
    bool turns = walk->stage == MW_STAGE_BORDER;
    mw_verdict verdict = kernels->step(walk);
    if (turns)
        trace_record_turn(work->trace, walk, t, e, work->visited - visited);
    else if (work->visited > visited)
        mw__walk_record(work->trace, walk);
    return verdict;
}

mw_verdict mw__walk_run(mw_walk *walk, const mw_kernels *kernels, bool exact, bool count)
{
    if (MW_LIKELY(!count || !walk->work->trace)) return kernels->run[exact][count](walk);
    while (walk->fuel) {
        walk->fuel--;
        mw_verdict verdict = walk_step_recorded(walk, kernels);
        if (verdict != MW_VERDICT_GO_ON) return verdict;
    }
    return MW_VERDICT_OUT_OF_FUEL;
}
