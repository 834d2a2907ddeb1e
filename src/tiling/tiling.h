/* tiling.h - a tiling: the convex hull of a mesh, tiled edge to edge. Walks go from tile to tile.
 * Private.
 *
 * The tiles are the user's triangles with an area, and ghost triangles that fill the holes and the
 * pockets between border and hull. All tiles are counter-clockwise and have an area. A link is
 * MW_NONE on the hull only. Coincident vertices of the user are one vertex here, so that components
 * that touch are linked. If flat triangles fill the gap beside an edge that has vertices inside it,
 * the user's triangle at that edge is cut into several tiles with its number.
 *
 * A convex mesh without flat triangles is its own tiling, whose arrays are borrowed.
 *
 * A tiling may also be without ghosts. Then a link is MW_NONE on any border. In this case a mesh
 * without flat triangles and without coincident vertices is its own tiling, convex or not. */
#ifndef MW_SRC_TILING_TILING_H
#define MW_SRC_TILING_TILING_H

#include "base/job.h"
#include "tiling/border_loops.h"
#include "mesh/mesh.h"

/* tri[t].user is the number of the user's triangle, with MW_REVERSED where it applies; of a ghost,
 * MW_GHOST and the number of its hole, or MW_POCKET. */
typedef struct mw_tiling {
    mw_point *point;
    mw_triangle *tri;
    /* Per tile: twice its area, see mw__tiling_areas; NULL unless asked for; always owned. */
    double *area;
    /* Per vertex: the lowest-numbered triangle of the user that has it; always owned; NULL if
     * edited. */
    uint32_t *owner;
    /* Of an edited tiling, per vertex: one of its tiles, or MW_NONE; else NULL. */
    uint32_t *tile_at;
    uint32_t point_count, tri_count, ghost_count, hole_count;
    bool borrowed; /* point and tri belong to the mesh */
    bool cut;      /* some of the user's triangles are cut into several tiles */
    /* False (only with option any): the tiles are the mesh's triangles, borrowed; links are MW_NONE
     * on any border; nothing above is promised. */
    bool embedding;
    mw_defect defect;              /* the first one, if the mesh is not an embedding */
    mw_border_loops *border_loops; /* of a finished tiling without ghosts; else NULL */
    mw_loop_edge *loop_edges;      /* of a tiling without ghosts, until it is finished */
    uint32_t loop_edge_count;
    uint32_t number_count; /* of an edited tiling: numbers of triangles given out */
    /* Of an edited tiling, per number: its tile, or MW_GONE and the number of a triangle that
     * replaced it; else NULL; always owned. */
    uint32_t *tile_of;
    bool slots_are_numbers; /* of an edited tiling: most tiles have their slot as number */
    /* Of an edited tiling: numbers below this lead to a tile, those of undone edits, too. */
    uint32_t name_count;
    /* Of an edited tiling, while no edit is under way: its hubs; else NULL; never owned. */
    const struct mw_hub_table *hubs;
} mw_tiling;

#define MW_GONE (UINT32_C(1) << 31)

/* Is slot t a tile whose number is t? Most are, in a tiling that was triangulated here and then
 * edited. */
static MW_INLINE bool mw__slot_is_number(const mw_tiling *tiling, uint32_t t)
{
    return t < tiling->tri_count && (tiling->tri[t].user & ~MW_REVERSED) == t;
}

/* The tile of a name (mw__tile_name). In an edited tiling: the triangle of that number, or one that
 * replaced it; else tile `name`. Always returns a tile of this tiling, also for a name that is
 * outdated or belongs to another tiling. */
static MW_INLINE uint32_t mw__tile_of_name(const mw_tiling *tiling, uint32_t name)
{
    if (MW_UNLIKELY(tiling->tile_of) &&
        (name < tiling->number_count || name < tiling->name_count)) {
        do name = tiling->tile_of[name & ~MW_GONE];
        while (name & MW_GONE);
    }
    return MW_LIKELY(name < tiling->tri_count) ? name : name % tiling->tri_count;
}

/* Does a triangle with an area have vertex v? */
static MW_INLINE bool mw__vertex_is_used(const mw_tiling *tiling, uint32_t v)
{
    return (tiling->tile_at ? tiling->tile_at : tiling->owner)[v] != MW_NONE;
}

/* The lowest-numbered triangle of the user at vertex v of tile t, found by going round v. */
uint32_t mw__lowest_around_vertex(const mw_tiling *tiling, uint32_t t, uint32_t v);
/* The same in an edited tiling, whose hubs are known. */
uint32_t mw__lowest_at_edited_vertex(const mw_tiling *tiling, uint32_t t, uint32_t v);
/* The same in any tiling. */
static MW_INLINE uint32_t mw__lowest_at_vertex(const mw_tiling *tiling, uint32_t t, uint32_t v)
{
    return tiling->tile_at ? mw__lowest_at_edited_vertex(tiling, t, v) : tiling->owner[v];
}

/* A name of tile t that outlasts edits: its number; for a ghost, the number of a triangle next to
 * it. */
static MW_INLINE uint32_t mw__tile_name(const mw_tiling *tiling, uint32_t t)
{
    if (!tiling->tile_of) return t;
    const mw_triangle *tile = &tiling->tri[t];
    return tile->user & MW_GHOST ? mw__lowest_at_edited_vertex(tiling, t, tile->v[0])
                                 : tile->user & MW_USER_MASK;
}

void mw__tiling_release(mw_tiling *tiling);

/* The extent along two axes, seen from `middle`, of the vertices of all triangles with an area. The
 * same for any number of threads. Steps of the present stage; unspecified if it is cancelled. */
void mw__tiling_extent(const mw_tiling *tiling, const double middle[2], const double axis[2][2],
                       mw_job *job, double low[2], double high[2]);

size_t mw__tiling_bytes(const mw_tiling *tiling);      /* of everything that it owns */
size_t mw__tiling_copy_bytes(const mw_tiling *tiling); /* of its own tiles and points */

/* Compute the areas, rounded, also of thin tiles. The relative error is below MW_AREA_ERROR; for a
 * subnormal area, the absolute error is below the smallest normal number. Areas beyond the doubles
 * are infinite. MW_ERROR_MEMORY. */
#define MW_AREA_ERROR 0x1p-43
mw_status mw__tiling_areas(mw_tiling *tiling, mw_error *error);

#endif
