/* stochastic.c - the remembering stochastic walk [Devillers, Pion, Teillaud 2002, sec. 3.2; thesis
 * App. E, Alg. 2].
 *
 * The remembering walk with its edges in random order. On any mesh the probability of walking for
 * ever is zero, but the number of steps has no bound. If the fuel runs out, another walk takes
 * over. */
#include "walk/stochastic.h"

#include "walk/drive.h"

MW_STAMP_WALK(stochastic, false)
