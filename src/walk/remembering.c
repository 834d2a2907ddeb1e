/* remembering.c - the remembering walk [Devillers, Pion, Teillaud 2002, sec. 3.2; thesis App. A,
 * sec. 2].
 *
 * Lawson's walk that remembers the edge it came over. q cannot lie beyond that edge, so a tile
 * takes at most two tests, in the order in which it lists its edges. In the first tile, where no
 * edge was crossed, all three are tested. The walk takes the same way as Lawson's walk, and ends or
 * cycles as that does. */
#include "walk/drive.h"

static MW_INLINE mw_verdict remembering_step(mw_walk *w, mw_policy P)
{
    if (w->e == MW_NO_EDGE) {
        if (beyond(w, 0, P)) return cross(w, 0, P);
        w->e = 0; /* as if entered there: the rest is the same */
    }
    return leave_either(w, w->e == 0 ? 1 : 0, w->e == 2 ? 1 : 2, P);
}

MW_STAMP_WALK(remembering, false)
