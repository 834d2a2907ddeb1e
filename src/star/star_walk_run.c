/* star_walk_run.c - a walk from its first facet to the one that the ray meets. */
#include "star/star_walk_run.h"

mw_star_verdict mw__star_walk_run(mw_star_walk *walk, const mw_star_kernels *kernel,
                                  mw_star_trace *trace)
{
    mw_star_verdict verdict = MW_STAR_GO;
    if (MW_LIKELY(!trace)) return kernel->run[walk->work != NULL](walk);
    while (verdict == MW_STAR_GO) {
        if (walk->fuel-- == 0) return MW_STAR_DRY;
        verdict = kernel->step(walk);
        if (verdict == MW_STAR_GO) mw__star_trace_add(trace, walk);
    }
    return verdict;
}

/* The straight walk visits no facet twice, except those that it turns round at first. */
static void star_walk_go_straight(mw_star_walk *walk, mw_star_trace *trace)
{
    mw__star_walk_enter(walk, walk->t, MW_STAR_STAGE_FINAL, UINT32_MAX);
    mw__star_walk_run(walk, &mw__star_straight, trace);
}

bool mw__star_walk_go_on(mw_star_walk *walk, mw_star_verdict verdict, const mw_star_kernels *finish,
                         mw_star_trace *trace)
{
    if (verdict == MW_STAR_CLOSE) {
        mw__star_walk_enter(walk, walk->t, MW_STAR_STAGE_FINAL, walk->star->fuel);
        verdict = mw__star_walk_run(walk, finish, trace);
    }
    if (MW_LIKELY(verdict == MW_STAR_FOUND)) return false;
    star_walk_go_straight(walk, trace);
    return true;
}

uint32_t mw__star_facet_along(const mw_star *star, const double d[3], uint32_t t)
{
    double q[3];
    for (int k = 0; k < 3; k++) q[k] = star->centre[k] + star->reach * d[k];
    if (!mw__is_finite3(q) || mw__star_point_is_centre(star, q))
        return t; /* at the end of the range of doubles, any facet will do */
    mw_star_walk walk;
    mw__star_walk_begin(&walk, star, q, 0, NULL);
    mw__star_walk_enter(&walk, t, MW_STAR_STAGE_WALK, star->fuel);
    mw__star_walk_go_on(&walk, mw__star_walk_run(&walk, &mw__star_stochastic, NULL), NULL, NULL);
    return walk.t;
}
