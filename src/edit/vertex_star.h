/* vertex_star.h - the tiles and edges round a vertex. Private. */
#ifndef MW_SRC_VERTEX_STAR_H
#define MW_SRC_VERTEX_STAR_H

#include "edit/fabric.h"

/* A tile of a vertex that is in some: the user's of the lowest number. mw_tiling.tile_at has one that is quicker to find, but which depends on
 * what happened before: edits have to come out the same when they are replayed. */
static MW_INLINE uint32_t mw__fabric_tile(const mw_fabric *f, uint32_t vertex)
{
    return f->tiling->tile_of[mw__lowest_around_vertex(f->tiling, f->tiling->tile_at[vertex], vertex)];
}

/* The edge that begins at v, as a half-edge of the lowest of its triangles or, where v is on the hull (*open), of the first, from which all
 * others follow counter-clockwise. */
uint32_t mw__star_first(const mw_fabric *f, uint32_t v, bool *open);
/* The same from a tile of v on. */
uint32_t mw__star_from(const mw_fabric *f, uint32_t v, uint32_t tile, bool *open);

/* The half-edge from one vertex to another, inside or on the border; MW_NONE if there is none. Where only the other
 * direction has a tile, that. */
uint32_t mw__fabric_edge(const mw_fabric *f, uint32_t from, uint32_t to);

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

#endif
