/* drive.h - drives a step function to its end: alone, or many walks in turn. Private. */
#ifndef MW_SRC_WALK_DRIVE_H
#define MW_SRC_WALK_DRIVE_H

#include "walk/step.h"

typedef mw_verdict (*mw_step)(mw_walk *walk, mw_policy P);

/* One walk, start to end. */
static MW_INLINE mw_verdict drive_run(mw_walk *walk, mw_step step, mw_policy P)
{
    mw_walk w = *walk; /* a local copy can live in registers */
    mw_verdict verdict = MW_VERDICT_OUT_OF_FUEL;
    while (w.fuel) {
        w.fuel--;
        verdict = step(&w, P);
        if (verdict != MW_VERDICT_GO_ON) break;
        verdict = MW_VERDICT_OUT_OF_FUEL;
    }
    *walk = w;
    return verdict;
}

static MW_INLINE mw_verdict drive_once(mw_walk *w, mw_step step, mw_policy P)
{
    if (MW_UNLIKELY(w->fuel == 0)) return MW_VERDICT_OUT_OF_FUEL;
    w->fuel--;
    return step(w, P);
}

/* Many walks that take turns: while one waits for memory the others go on. After a step the new
 * tile's record is prefetched, half a lap later (when the record has come) its vertices, and
 * another half lap later the step finds them in cache. */
static MW_INLINE void drive_ring(mw_feed *feed, uint32_t lane_count, mw_step step, mw_policy P)
{
    mw_walk lane[MW_MAX_LANES];
    uint32_t name[MW_MAX_LANES], alive = 0;
    for (uint32_t i = 0; i < lane_count; i++)
        if (feed->deliver(feed, i, &lane[alive], MW_VERDICT_GO_ON)) name[alive++] = i;
    uint32_t ahead = alive / 2;
    for (uint32_t i = 0; alive;) {
        mw_verdict verdict = drive_once(&lane[i], step, P);
        if (verdict != MW_VERDICT_GO_ON && !feed->deliver(feed, name[i], &lane[i], verdict)) {
            alive--;
            lane[i] = lane[alive];
            name[i] = name[alive];
            ahead = alive / 2;
            if (i >= alive) i = 0;
            continue;
        }
        __builtin_prefetch(&lane[i].tri[lane[i].t]);
        uint32_t j = i + ahead < alive ? i + ahead : i + ahead - alive;
        const mw_triangle *t = &lane[j].tri[lane[j].t];
        __builtin_prefetch(&lane[j].point[t->v[0]]);
        __builtin_prefetch(&lane[j].point[t->v[1]]);
        __builtin_prefetch(&lane[j].point[t->v[2]]);
        if (++i == alive) i = 0;
    }
}

/* The kernels of a walk from NAME_step, with literal policies. */
#define MW_STAMP(name, suffix, exact, count)                                                       \
    static mw_verdict name##_run_##suffix(mw_walk *walk)                                           \
    {                                                                                              \
        return drive_run(walk, name##_step, (mw_policy){exact, count, false});                     \
    }                                                                                              \
    static void name##_ring_##suffix(mw_feed *feed, uint32_t lane_count)                           \
    {                                                                                              \
        drive_ring(feed, lane_count, name##_step, (mw_policy){exact, count, true});                \
    }

#define MW_STAMP_WALK(name, ends_always)                                                           \
    MW_STAMP(name, double, false, false)                                                           \
    MW_STAMP(name, double_count, false, true)                                                      \
    MW_STAMP(name, exact, true, false)                                                             \
    MW_STAMP(name, exact_count, true, true)                                                        \
    static mw_verdict name##_step_exact_count(mw_walk *walk)                                       \
    {                                                                                              \
        return name##_step(walk, (mw_policy){true, true, false});                                  \
    }                                                                                              \
    const mw_kernels mw__##name = {                                                                \
        {{name##_run_double, name##_run_double_count},                                             \
         {name##_run_exact, name##_run_exact_count}},                                              \
        {{name##_ring_double, name##_ring_double_count},                                           \
         {name##_ring_exact, name##_ring_exact_count}},                                            \
        ends_always,                                                                               \
        name##_step_exact_count,                                                                   \
    };

#endif
