/* stochastic.c - the remembering stochastic walk [Devillers, Pion, Teillaud 2002, sec. 3.2; thesis
 * App. E, Alg. 2].
 *
 * The remembering walk with its edges in random order. On any mesh the chance of walking on for
 * ever is zero, but there is no bound that holds for certain; where the fuel runs out it hands
 * over. */
#include "walk/stochastic.h"

#include "walk/drive.h"

MW_STAMP_WALK(stochastic, false)
