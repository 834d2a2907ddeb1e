/* components.c - walks in a tiling without ghosts that has several connected components: in which
 * component a walk begins, in which one it goes on, and in which hole a point lies that no
 * component holds. */
#include "locate/components.h"

/* --- where to begin --- */

static bool locator_extent_holds(const mw_locator *locator, mw_point q)
{
    mw_box all = {{locator->low[0], locator->low[1]}, {locator->high[0], locator->high[1]}};
    return mw__box_contains(&all, q);
}

/* The first component from number i on whose box holds q. */
static uint32_t component_next(const mw_border_loops *loops, uint32_t i, mw_point q)
{
    i = mw__box_tree_next(&loops->tree, i, q);
    while (i < loops->component_count && !mw__box_contains(&loops->component[i].box, q))
        i = mw__box_tree_next(&loops->tree, i + 1, q);
    return i;
}

void mw__components_begin(const mw_locator *locator, mw_walk *walk)
{
    const mw_border_loops *loops = walk->tiling->border_loops;
    bool near = locator_extent_holds(locator, walk->q);
    if (near && loops->component_of) {
        uint32_t here = loops->component_of[walk->tri[walk->t].v[0]];
        if (mw__box_contains(&loops->component[here].box, walk->q)) return;
        uint32_t i = component_next(loops, 0, walk->q);
        near = i < loops->component_count;
        if (near) walk->t = loops->component[i].first;
    }
    if (near) return;
    walk->phase = MW_PHASE_AWAY;
    walk->lowest = MW_NONE;
}

/* --- where to go on --- */

/* The smallest face of a component that q is known to lie in. */
typedef struct component_face {
    uint32_t hole; /* MW_NONE: none is known */
    mw_box box;    /* of the component           */
} component_face;

static bool box_is_inside(const mw_box *box, const mw_box *other)
{
    return box->low[0] >= other->low[0] && box->low[1] >= other->low[1] &&
           box->high[0] <= other->high[0] && box->high[1] <= other->high[1];
}

/* The walk went round a border last, and q lies beyond that border. Components that have a face
 * which holds q lie inside one another; keep the smallest such face. */
static void face_note(component_face *f, const mw_border_loops *loops, uint32_t lowest, mw_box box)
{
    uint32_t hole = mw__border_loops_hole(loops, lowest);
    if (hole != MW_NONE && (f->hole == MW_NONE || box_is_inside(&box, &f->box)))
        *f = (component_face){hole, box};
}

static mw_verdict component_walk(const mw_tiling *tiling, const mw_component *component,
                                 mw_walk *walk, bool counted)
{
    uint32_t fuel = mw__walk_fuel(MW_WALK_BORDER, MW_EXACT, tiling);
    mw_work *work = counted ? walk->work : NULL;
    *walk = mw__walk_begin(tiling, walk->q, component->first, fuel, 0, work);
    if (work && work->trace) mw__walk_record(work->trace, walk);
    mw_verdict verdict = mw__walk_run(walk, &mw__border_walk, true, counted);
    if (MW_LIKELY(verdict != MW_VERDICT_OUT_OF_FUEL)) return verdict;
    *walk = mw__walk_begin(tiling, walk->q, walk->t, 0, 0, work);
    return mw__walk_surely(walk, counted);
}

mw_verdict mw__components_search(const mw_tiling *tiling, mw_walk *walk, bool counted,
                                 uint32_t *hole)
{
    const mw_border_loops *loops = tiling->border_loops;
    *hole = mw__border_loops_hole(loops, walk->lowest);
    if (!loops->component_of || walk->phase == MW_PHASE_AWAY) return MW_VERDICT_LEFT;
    uint32_t here = loops->component_of[tiling->tri[walk->t].v[0]];
    component_face f = {.hole = MW_NONE};
    face_note(&f, loops, walk->lowest, loops->component[here].box);
    mw_verdict verdict = MW_VERDICT_LEFT;
    for (uint32_t i = 0; (i = component_next(loops, i, walk->q)) < loops->component_count &&
                         verdict != MW_VERDICT_FOUND;
         i++) {
        if (i == here) continue;
        verdict = component_walk(tiling, &loops->component[i], walk, counted);
        if (verdict == MW_VERDICT_LEFT) face_note(&f, loops, walk->lowest, loops->component[i].box);
    }
    *hole = f.hole;
    return verdict;
}
