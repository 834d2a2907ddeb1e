/* walk.h - what a walk is to those who drive it. Private.
 *
 * A walk is a small state and a step function. One step looks at one tile and either ends there or crosses one of its
 * edges. Each algorithm is written once (one file each); drive.h makes its kernels from it: alone or many in flight,
 * exact or in plain doubles, counting or not. */
#ifndef MW_SRC_WALK_H
#define MW_SRC_WALK_H

#include "domain/tiling.h"

#include <meshwalk/locate.h>

typedef enum mw_verdict {
    MW_GO,    /* crossed into another tile            */
    MW_FOUND, /* q is in tile t                       */
    MW_LEFT,  /* q lies beyond a hull edge of tile t  */
    MW_DRY    /* out of fuel in tile t                */
} mw_verdict;

#define MW_NO_EDGE 3u

/* Everything one walk remembers. */
typedef struct mw_walk {
    const mw_point *point;
    const mw_triangle *tri;
    mw_point q;      /* the point looked for                                                   */
    mw_point p;      /* straight: where the line to q begins                                   */
    uint32_t t, e;   /* current tile, and its edge by which it was entered; MW_NO_EDGE at first */
    uint32_t phase;  /* straight: see there                                                    */
    uint32_t fuel;   /* steps left                                                             */
    uint64_t random; /* stochastic                                                             */
    uint32_t visited, visited_init, tests, tests_init; /* counted only by counting kernels      */
} mw_walk;

/* Where the lanes of a ring get their walks. `deliver` takes the finished walk of a lane (verdict MW_GO: there is none
 * yet) and puts the next one in its place; false: no more for this lane. */
typedef struct mw_feed {
    bool (*deliver)(struct mw_feed *feed, uint32_t lane, mw_walk *walk, mw_verdict verdict);
} mw_feed;

/* The kernels of one walk, by [exact][count]. */
typedef struct mw_kernels {
    mw_verdict (*run[2][2])(mw_walk *walk);                 /* one walk, from its t to its end  */
    void (*ring[2][2])(mw_feed *feed, uint32_t lane_count); /* up to MW_MAX_LANES walks in turn */
    bool ends; /* with exact arithmetic it enters no tile of a tiling twice, by the argument in its file */
} mw_kernels;

#define MW_WALK_ENTRY(id, symbol, name, source, help) extern const mw_kernels mw__##symbol;
#include <meshwalk/walks.def>

/* The kernels of a walk; not for MW_WALK_AUTO. */
const mw_kernels *mw__walk_kernels(mw_walk_kind kind);

/* Steps after which a walk hands over. Walks that end get what they can need at most; the others about 45 times the
 * square root of the number of tiles, far above the length of any walk on Delaunay meshes of spread points, plus a
 * constant for small meshes. */
uint32_t mw__walk_fuel(mw_walk_kind kind, mw_arithmetic arithmetic, const mw_tiling *tiling);

/* A walk to q from tile t. Touches no mesh memory. */
static MW_INLINE mw_walk mw__walk_begin(const mw_tiling *tiling, mw_point q, uint32_t t, uint32_t fuel, uint64_t random)
{
    return (mw_walk){.point = tiling->point,
                     .tri = tiling->tri,
                     .q = q,
                     .t = t,
                     .e = MW_NO_EDGE,
                     .fuel = fuel,
                     .random = random,
                     .visited = 1};
}

#endif
