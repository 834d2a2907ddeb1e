/* tiling.h - the convex hull of a mesh, tiled edge to edge: what the walks walk on. Private.
 *
 * The tiles are the user's triangles that have an area, and ghost triangles that fill the pockets between border and
 * hull and the holes. All tiles are counter-clockwise and have an area; a link is MW_NONE on the hull only. Vertices of
 * the user's with equal coordinates are one vertex here, so that pieces which touch are linked. Where flat triangles
 * fill the gap beside an edge that has vertices inside it, the user's triangle at that edge is cut into several tiles
 * of the same number.
 *
 * A convex mesh without flat triangles is its own tiling; its arrays are borrowed then.
 *
 * A tiling may also be left open: without ghosts, so that links are MW_NONE on any border. Then a mesh without flat triangles
 * whose vertices all lie at different places is its own tiling, convex or not. */
#ifndef MW_SRC_TILING_H
#define MW_SRC_TILING_H

#include "domain/open.h"
#include "mesh/mesh.h"

/* The user's number of a tile, tri[t].user, is that of the triangle with MW_FLIPPED, or MW_GHOST and the number of the
 * hole (MW_POCKET: it lies in none). */
typedef struct mw_tiling {
    mw_point *point;
    mw_triangle *tri;
    double *area;      /* per tile, twice its area, see mw__tiling_areas; NULL unless asked for; always owned      */
    uint32_t *owner;   /* per vertex: the lowest-numbered triangle of the user's that contains it; always owned. NULL
                        for a tiling that is edited                                                          */
    uint32_t *tile_at; /* of such a one instead, per vertex: a tile of it, MW_NONE if there is none; else NULL   */
    uint32_t point_count, tri_count, ghost_count, hole_count;
    bool borrowed;    /* point and tri belong to the mesh               */
    bool cut;         /* some of the user's triangles are several tiles */
    bool embedding;   /* false: the mesh is no embedding (option any); the tiles are the mesh's own triangles, borrowed,
                       links are MW_NONE on any border, and nothing above is promised */
    mw_defect defect; /* the first one, where the mesh is no embedding */
    mw_open *open;    /* NULL for a tiling that fills its hull         */
    mw_rim_edge *rim; /* the border of an open tiling, until it is finished */
    uint32_t rim_count;
    uint32_t number_count; /* of a tiling that is edited: numbers of triangles given out                     */
    uint32_t
        *tile_of; /* of such a one, per number: its tile, or MW_GONE and the number of a triangle that took its place;
                              else NULL. Always owned */
    bool at_home; /* of such a one: most tiles have their place as number (mw__locator_survey)          */
    uint32_t name_count; /* of such a one: numbers up to here, of edits that were undone, lead to a tile too */
    uint32_t threads;    /* that make what belongs to it; 0: as OpenMP gives                                   */
} mw_tiling;

#define MW_GONE (UINT32_C(1) << 31)

/* Has tile t, if there is one, its place as number? Most have in a tiling that was triangulated here, and edited. */
static MW_INLINE bool mw__is_at_home(const mw_tiling *tiling, uint32_t t)
{
    return t < tiling->tri_count && (tiling->tri[t].user & ~MW_FLIPPED) == t;
}

/* The tile that `name` leads to: in a tiling that is edited the triangle of that number, or one that took its place; else tile
 * `name`. Always a tile of this tiling: what names it may be older, or of another one. */
static MW_INLINE uint32_t mw__tile_named(const mw_tiling *tiling, uint32_t name)
{
    if (MW_UNLIKELY(tiling->tile_of) && (name < tiling->number_count || name < tiling->name_count)) {
        do name = tiling->tile_of[name & ~MW_GONE];
        while (name & MW_GONE);
    }
    return MW_LIKELY(name < tiling->tri_count) ? name : name % tiling->tri_count;
}

/* Is vertex v one of a triangle that has an area? */
static MW_INLINE bool mw__is_used(const mw_tiling *tiling, uint32_t v)
{
    return (tiling->tile_at ? tiling->tile_at : tiling->owner)[v] != MW_NONE;
}

/* The lowest-numbered triangle of the user's that has vertex v, of which t is a tile: where none is stored all tiles round v are looked at. */
uint32_t mw__lowest_round(const mw_tiling *tiling, uint32_t t, uint32_t v);
static MW_INLINE uint32_t mw__lowest_at(const mw_tiling *tiling, uint32_t t, uint32_t v)
{
    return tiling->tile_at ? mw__lowest_round(tiling, t, v) : tiling->owner[v];
}

/* A name of a tile that lasts: of a ghost, that of a triangle beside it. */
static MW_INLINE uint32_t mw__tile_name(const mw_tiling *tiling, uint32_t t)
{
    if (!tiling->tile_of) return t;
    const mw_triangle *tile = &tiling->tri[t];
    return tile->user & MW_GHOST ? mw__lowest_round(tiling, t, tile->v[0]) : tile->user & MW_USER_MASK;
}

void mw__tiling_release(mw_tiling *tiling);

/* The extent along two axes, seen from `middle`, of the vertices that triangles with an area have: the same for any threads. */
void mw__tiling_extent(const mw_tiling *tiling, const double middle[2], const double axis[2][2], double low[2],
                       double high[2]);

size_t mw__tiling_bytes(const mw_tiling *tiling);      /* what it owns           */
size_t mw__tiling_copy_bytes(const mw_tiling *tiling); /* of it, tiles and points */

/* Compute the areas: rounded, thin tiles included, with a relative error below MW_AREA_ERROR or, among the subnormal
 * numbers, an absolute one below the smallest normal number; infinite above the doubles. MW_ERROR_MEMORY. */
#define MW_AREA_ERROR 0x1p-43
mw_status mw__tiling_areas(mw_tiling *tiling, mw_error *error);

#endif
