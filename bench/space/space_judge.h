/* space_judge.h - which answers of rays are wrong, exactly.
 *
 * Whether a ray meets a triangle is decided by the signs of orientations, which are exact. Of two
 * triangles that are met, quotients of 113 bits tell which is nearer; where these are as good as
 * equal, the ray has to meet both in a vertex or an edge that they share, or both triangles have to
 * have the same corners. */
#ifndef MW_BENCH_SPACE_SPACE_JUDGE_H
#define MW_BENCH_SPACE_SPACE_JUDGE_H

#include "bench/space/space_model.h"

/* The exact answer of every ray. */
typedef struct space_truth {
    uint32_t *nearest;
    size_t count;
    size_t checked; /* the first ones of them, by all triangles of the model */
} space_truth;

/* Take the answers that an exact engine found, and compare the first ones with all triangles, as
 * many as `tests` tests are enough for. Returns how many of these were wrong; the truth then has
 * the right ones. */
size_t space_truth_check(space_truth *t, const space_model *m, const space_rays *rays,
                         double tests);

typedef struct space_verdict {
    size_t other;    /* a triangle that is not the nearest, or is not met */
    size_t missed;   /* nothing, where there is a triangle */
    size_t invented; /* a triangle, where there is nothing */
} space_verdict;

/* Judge the answers of the first `count` rays. With `any` a triangle that is met is right, be it
 * near or far, in front of the ray or behind. */
space_verdict space_judge(const space_truth *t, const space_model *m, const space_rays *rays,
                          const uint32_t *found, size_t count, bool any);

#endif
