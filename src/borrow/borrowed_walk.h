/* borrowed_walk.h - walks over the caller's arrays. Private. */
#ifndef MW_SRC_BORROW_BORROWED_WALK_H
#define MW_SRC_BORROW_BORROWED_WALK_H

#include "borrow/borrowed.h"
#include "walk/step.h"

/* A walk, and the counts of its query. `counts` has only work and stage set, for the vocabulary
 * that all walks share. */
typedef struct mw_borrowed_walk {
    const mw_borrowed *mesh;
    mw_point q;
    uint32_t t, fuel;
    uint64_t random;
    mw_walk counts;
} mw_borrowed_walk;

static const mw_policy mw__borrowed_policy = {.exact = true, .count = true};

/* Count a triangle that is entered. */
static MW_INLINE void mw__borrowed_enter(mw_borrowed_walk *w, uint32_t t)
{
    w->t = t;
    w->counts.work->visited++;
    w->counts.work->triangles[w->counts.stage]++;
}

/* From triangle w->t to the one that contains q, which is left in w->t: MW_VERDICT_FOUND.
 * MW_VERDICT_LEFT: q lies beyond an edge of w->t that has no neighbour. MW_VERDICT_OUT_OF_FUEL:
 * links are wrong, or fuel has run out, or the walk should begin where there is no area. It is the
 * remembering walk. For half of its fuel it chooses edges at random, so that it leaves any cycle.
 */
mw_verdict mw__borrowed_remembering(mw_borrowed_walk *w);

/* The barycentric and the direct walk, as published for triangles of mixed orientation. They end
 * with MW_VERDICT_UNSURE in or near the triangle that contains q, where the remembering walk goes
 * on; otherwise as above. */
mw_verdict mw__borrowed_barycentric(mw_borrowed_walk *w);
mw_verdict mw__borrowed_direct(mw_borrowed_walk *w);

#endif
