/* vertex_star.h - the tiles and edges round a vertex. Private. */
#ifndef MW_SRC_DYNAMIC_VERTEX_STAR_H
#define MW_SRC_DYNAMIC_VERTEX_STAR_H

#include "dynamic/dynamic_tiling.h"

/* The lowest-numbered user tile of a vertex that has a tile. mw_tiling.tile_at has a tile that is
 * quicker to find, but it depends on earlier edits, and a replay of an edit must give the same
 * result. */
static MW_INLINE uint32_t mw__dynamic_lowest_tile(const mw_dynamic_tiling *dynamic, uint32_t vertex)
{
    return dynamic->tiling->tile_of[mw__lowest_around_vertex(
        dynamic->tiling, dynamic->tiling->tile_at[vertex], vertex)];
}

/* The edge that begins at v, as a half-edge of the lowest of its tiles. If v is on the hull
 * (*open), of the first tile, from which all others follow counter-clockwise. */
uint32_t mw__vertex_star_first(const mw_dynamic_tiling *dynamic, uint32_t v, bool *open);
/* The same, starting from a given tile of v. */
uint32_t mw__vertex_star_first_from(const mw_dynamic_tiling *dynamic, uint32_t v, uint32_t tile,
                                    bool *open);

/* The half-edge from one vertex to another, inside or on the border; MW_NONE if there is none. If
 * only the other direction has a tile, the half-edge of that. */
uint32_t mw__dynamic_edge(const mw_dynamic_tiling *dynamic, uint32_t from, uint32_t to);

/* What mw__vertex_star_collect tells of a star beside its steps. */
typedef struct mw_vertex_star {
    size_t n;        /* tiles                                                      */
    bool open;       /* v is on the hull                                           */
    size_t spokes;   /* fixed edges at v                                           */
    size_t spoke[2]; /* the first two: the steps that begin at their other ends    */
} mw_vertex_star;

/* Collect the steps round vertex v in dynamic->boundary: from the lowest of its tiles on, or on
 * the hull from the first tile to the last. Step i is opposite of v in its i-th tile, which is
 * dynamic->pool[i]. dynamic->boundary[n].vertex is the end. False when out of memory. */
bool mw__vertex_star_collect(mw_dynamic_tiling *dynamic, uint32_t v, mw_vertex_star *star);

/* Push all edges of the star that was collected last, for mw__legalise. False when out of
 * memory. */
bool mw__vertex_star_push(mw_dynamic_tiling *dynamic, const mw_vertex_star *star);

#endif
