/* rim.h - the boundary of tiles that are to be replaced by others with the same corners, or fewer. Private.
 *
 * Steps are given counter-clockwise: the tiles to be replaced lie to the left. Their records are the pool, of which the new tiles take what
 * they need, those with the lowest numbers first; what is left is dropped when the edit is done. */
#ifndef MW_SRC_RIM_H
#define MW_SRC_RIM_H

#include "edit/stitch.h"
#include "walk/remembering_corners.h"

struct mw_rim_step {
    uint32_t vertex; /* where the step begins; the next one begins where it ends */
    uint32_t beyond; /* half-edge on its right side; MW_NONE on the hull         */
    uint32_t half;   /* half-edge on its left side, of a tile that is replaced   */
    bool fixed;
    bool slit; /* `beyond` is replaced too: the step comes twice, once from each side */
};

/* mw__incircle_rounded of a, b and c, seen from q, and q, with a bound by the lifts alone: triangulate/delaunay_grow.c tells why
 * 11 u (ab + bc + ca) is one, and of three numbers that is at most a third of their sum squared. Where that square does not overflow nothing
 * else does; and what underflow may cost, 2^-1071 times the lifts, the rest of 4 u covers where the lifts are not small. */
#define MW_SIGHTS_ERROR (4.0 * 0x1p-53)
static MW_INLINE double mw__sights_rounded(const mw_sight *a, const mw_sight *b, const mw_sight *c, double *bound)
{
    double lifts = a->lift + b->lift + c->lift;
    *bound = lifts * lifts * MW_SIGHTS_ERROR + MW_UNDERFLOW_ERROR;
    return a->lift * (b->x * c->y - b->y * c->x) + b->lift * (c->x * a->y - c->y * a->x) +
           c->lift * (a->x * b->y - a->y * b->x);
}

/* A step of the boundary of a hole that is dug (hole.h), not yet come to: the sight where it ends, as above, and, where the tile beyond goes,
 * the sight of the vertex of that across from the step; else MW_NONE. */
struct mw_step_ahead {
    uint32_t end, beyond, apex;
    bool fixed;
};

/* Tiles to be replaced, all of the user's or all ghosts beside one another. */
typedef struct mw_pool {
    uint32_t *tile;
    size_t count, used;
    mw_rim_step *
        slit; /* room for those steps of a chain that are slits, from one side: `half` as it was, `beyond` the new one */
    size_t slit_count;
} mw_pool;

/* Journal the tiles of a pool and sort them by number. */
bool mw__pool_begin(mw_fabric *f, mw_pool *pool);
/* The same for the star of a vertex, of which two tiles will not be needed: only those two, of the highest numbers, are put last. */
bool mw__pool_begin_ring(mw_fabric *f, mw_pool *pool);

/* Cut off corners of the chain of n steps wherever it turns left, until it turns left nowhere [Graham 1972], which is right for chains all
 * of whose vertices are seen from one point or one edge to the left of them [Toussaint, Avis 1982]. step[n].vertex is where it ends.
 * *n becomes the number of steps that are left; where corners were cut off a step, the last tile's edge 2 is its `beyond`. Pushes edges between new tiles for
 * mw__legalise; false when out of memory. */
bool mw__cut_chain(mw_fabric *f, mw_rim_step *step, size_t *n, mw_pool *pool);

/* Fill the closed ring of n steps, the star of a vertex without fixed edges in a mesh kept Delaunay, with tiles that are Delaunay. */
void mw__fill_ring(mw_fabric *f, const mw_rim_step *step, size_t n, mw_pool *pool);

/* Cut the star of a vertex at q, inside the closed ring of n steps, into tiles. */
bool mw__cut_ring(mw_fabric *f, mw_rim_step *step, size_t n, mw_point q, mw_pool *pool);

/* The numbers of tiles not used lead to the lowest that is, or to `heir`, a number; the tiles have to be dropped. */
void mw__pool_end(mw_fabric *f, mw_pool *pool, uint32_t heir);

/* Steps round vertex v: from the lowest of its triangles on, or on the hull from the first tile to the last. step[i].half is the edge
 * across from v in its i-th tile; step[n].vertex the end. *spokes: how many edges at v are fixed, and *spoke the places of the first two in the
 * list. false when out of memory. */
typedef struct mw_star {
    size_t n;        /* tiles                                                     */
    bool open;       /* on the hull                                               */
    size_t spokes;   /* fixed edges at the vertex                                 */
    size_t spoke[2]; /* of the first two: the steps that begin at their other ends */
} mw_star;
bool mw__collect_star(mw_fabric *f, uint32_t v, mw_star *star);

/* Room for so many steps in f->rim and f->ahead, tiles in f->pool, and twice as many sights. */
bool mw__rim_enlarge(mw_fabric *f, size_t steps);
static MW_INLINE bool mw__rim_room(mw_fabric *f, size_t steps)
{
    return MW_LIKELY(steps <= f->rim_room) || mw__rim_enlarge(f, steps);
}
void mw__rim_release(mw_fabric *f);
size_t mw__rim_bytes(const mw_fabric *f);

/* The edge that begins at v, as a half-edge of the lowest of its triangles or, where v is on the hull (*open), of the first, from which all
 * others follow counter-clockwise. */
uint32_t mw__star_first(const mw_fabric *f, uint32_t v, bool *open);
/* The same from a tile of v on. */
uint32_t mw__star_from(const mw_fabric *f, uint32_t v, uint32_t tile, bool *open);

#endif
