/* border_walk.c - not made yet. */
#include "walk/drive.h"

static MW_INLINE mw_verdict border_walk_step(mw_walk *w, mw_policy P)
{
    (void)w;
    (void)P;
    return MW_DRY;
}

MW_STAMP_WALK(border_walk, false)
