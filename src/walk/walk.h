/* walk.h - what a walk is to those who drive it. Private.
 *
 * A walk is a small state and a step function. One step looks at one tile and either ends there or
 * crosses one of its edges. Each algorithm is written once (one file each); drive.h makes its
 * kernels from it: one walk alone, or many that take turns, exact or in plain doubles, counting or
 * not. */
#ifndef MW_SRC_WALK_WALK_H
#define MW_SRC_WALK_WALK_H

#include "tiling/tiling.h"

#include <meshwalk/locate.h>

/* What a step of a walk, and at last the walk, has to say of its tile t. */
typedef enum mw_verdict {
    MW_VERDICT_GO_ON, /* crossed into another tile */
    MW_VERDICT_FOUND, /* q is in tile t */
    MW_VERDICT_LEFT,  /* q lies beyond a hull edge of tile t */
    /* a cheap walk, whose tests are only a guide, ended in tile t: q is here or near, and an exact
     * walk ends it */
    MW_VERDICT_UNSURE,
    MW_VERDICT_OUT_OF_FUEL /* the steps that the walk may take were spent in tile t */
} mw_verdict;

#define MW_NO_EDGE 3u

/* The stages of a search, which are counted separately: turning round the first vertex, the walk,
 * the final location that ends the cheap walks, and the way along a border. Each stage but the last
 * counts the tile in which it begins. */
enum { MW_STAGE_INIT, MW_STAGE_WALK, MW_STAGE_FINAL, MW_STAGE_BORDER, MW_STAGES };

/* The user's triangles that walks enter, in order. */
typedef struct mw_walk_trace {
    uint32_t *triangle; /* room for `capacity` */
    uint8_t *stage;     /* NULL, or room for as many: in which each was entered */
    size_t capacity, count;
} mw_walk_trace;

/* What a search did; counted only by counting kernels. */
typedef struct mw_work {
    uint64_t visited; /* tiles entered, the first one included */
    uint64_t triangles[MW_STAGES], orient[MW_STAGES];
    uint64_t implicit, comparisons;
    uint64_t walk_runs, border_runs, border_edges; /* of the border walk */
    mw_walk_trace *trace; /* NULL, or where mw__walk_run writes down the way of an exact walk */
} mw_work;

/* Everything one walk remembers. */
typedef struct mw_walk {
    const mw_point *point;
    const mw_triangle *tri;
    mw_point q; /* the point looked for                                                   */
    /* where the line to q begins, and its direction; see the walks that have one */
    mw_point p, d;
    uint32_t t, e;   /* current tile, and its edge by which it was entered; MW_NO_EDGE at first */
    uint32_t phase;  /* of the walks that have some; 0 at first                                */
    uint32_t fuel;   /* steps left                                                             */
    uint64_t random; /* of the stochastic walks                                                */
    const mw_tiling *tiling;
    union {
        double c; /* direct: orientation coordinate of the edge just crossed               */
        struct {
            uint32_t exit;   /* border: where it left the mesh, 4 * tile + edge             */
            uint32_t lowest; /* border: the lowest of the border edges it met since then    */
        };
    };
    union {
        /* fast stochastic: with one test each, that are left */
        uint32_t steps;
        /* border: where the line comes back last, of the edges met; see there */
        uint32_t farthest;
        /* direct, barycentric: at the end, the corner with the largest coordinate */
        uint32_t heaviest;
    };
    uint32_t stage; /* that counts                                                            */
    mw_work *work;  /* of counting kernels                                                    */
} mw_walk;

/* Where the lanes of a ring get their walks. `deliver` takes the finished walk of a lane (verdict
 * MW_VERDICT_GO_ON: there is none yet) and replaces it by the next one; false: no more for this
 * lane. */
typedef struct mw_feed {
    bool (*deliver)(struct mw_feed *feed, uint32_t lane, mw_walk *walk, mw_verdict verdict);
} mw_feed;

/* The kernels of one walk, by [exact][count]. */
typedef struct mw_kernels {
    mw_verdict (*run[2][2])(mw_walk *walk);                 /* one walk, from its t to its end  */
    void (*ring[2][2])(mw_feed *feed, uint32_t lane_count); /* up to MW_MAX_LANES walks in turn */
    /* with exact arithmetic it enters no tile of a tiling twice, by the argument in its file */
    bool ends;
    /* one step, exact and counting: for those who want to see each */
    mw_verdict (*step)(mw_walk *walk);
} mw_kernels;

#define MW_WALK_ENTRY(id, symbol, name, source, help) extern const mw_kernels mw__##symbol;
#include <meshwalk/walks.def>
extern const mw_kernels mw__direct_stored; /* the direct walk where areas are stored */
/* the border walk that goes along no border more than twice */
extern const mw_kernels mw__border_sure;

/* Phase of a border walk that ends at once: no component's box holds q. */
#define MW_PHASE_AWAY 15u

/* The kernels of a walk on this tiling; not for MW_WALK_AUTO. */
const mw_kernels *mw__walk_kernels(mw_walk_kind kind, const mw_tiling *tiling);

/* Steps after which another walk takes over. Walks that always end get as many as they can need.
 * The others get about 45 times the square root of the number of tiles, far above the length of any
 * walk on Delaunay meshes of points without clusters, plus a constant for small meshes; the border
 * walk also four times the number of border edges. */
uint32_t mw__walk_fuel(mw_walk_kind kind, mw_arithmetic arithmetic, const mw_tiling *tiling);

/* One walk, from its t to its end: at full speed; or, if its work has a trace, step by step,
 * exactly. The tile where it begins is not written down. */
mw_verdict mw__walk_run(mw_walk *walk, const mw_kernels *kernels, bool exact, bool count);

/* The user's triangle of the current tile is the next one of the way; ghosts are passed over. */
void mw__walk_record(mw_walk_trace *trace, const mw_walk *walk);

/* End with an exact walk (of kind `finish`) what a cheap one left at MW_VERDICT_UNSURE. */
mw_verdict mw__walk_finish(mw_walk *walk, mw_walk_kind finish, uint32_t fuel,
                           const mw_tiling *tiling, bool exact, bool count);

/* Go on from tile walk->t with an exact walk that ends on every embedding. MW_VERDICT_OUT_OF_FUEL
 * only where the mesh is none. */
mw_verdict mw__walk_surely(mw_walk *walk, bool count);

/* A walk to q from tile t, which is counted in *work, unless that is NULL. Touches no mesh
 * memory. */
static MW_INLINE mw_walk mw__walk_begin(const mw_tiling *tiling, mw_point q, uint32_t t,
                                        uint32_t fuel, uint64_t random, mw_work *work)
{
    if (work) {
        work->visited++;
        work->triangles[MW_STAGE_WALK]++;
    }
    return (mw_walk){.point = tiling->point,
                     .tri = tiling->tri,
                     .q = q,
                     .t = t,
                     .e = MW_NO_EDGE,
                     .fuel = fuel,
                     .random = random,
                     .tiling = tiling,
                     .stage = MW_STAGE_WALK,
                     .work = work};
}

#endif
