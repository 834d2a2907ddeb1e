/* layers.h - the layered hierarchy: random vertices of the mesh, triangulated, above it, random
 * ones of these above them, and so on [Mulmuley 1991; Devillers 2002, "The Delaunay hierarchy";
 * thesis App. C, sec. 2 and 3]. Private. */
#ifndef MW_SRC_START_LAYERS_H
#define MW_SRC_START_LAYERS_H

#include "walk/walk.h"

/* One layer above the mesh: the Delaunay triangulation of its vertices. Tiles lie along a Hilbert
 * curve, vertices as the tiles use them; areas are stored. Live layers follow a mesh that is edited
 * (edit/live_layers.h): with owners, without areas. */
typedef struct mw_layer {
    mw_tiling tiling;
    /* per vertex: the name of a tile that has it, in the layer below; at last, in the mesh. Live:
     * its slot there */
    uint32_t *below;
    uint32_t vacant; /* live: slots of vertices that are gone */
} mw_layer;

/* Keeps nothing of the tiling it was made from but the names of tiles. */
typedef struct mw_layers {
    mw_layer layer[MW_MAX_LAYERS - 1]; /* the lowest first */
    uint32_t count;                    /* the mesh itself counted */
    uint32_t vertices, tiles;          /* of the mesh             */
    mw_descent descent;
    bool live;
} mw_layers;

#define MW_LAYER_RATIO                                                                             \
    0.025 /* the best exchange of time for memory on random vertices [Devillers 2002] */

typedef struct mw_layers_options {
    uint32_t layers; /* the mesh itself counted, at most MW_MAX_LAYERS; 0 = by its size       */
    double ratio;    /* chance of a vertex to be in the next layer, between 0 and 1; 0 = 0.025 */
    mw_descent descent;
    uint64_t seed;
} mw_layers_options;

/* Make layers above the tiling. The share `ratio` of the vertices of a layer, at least 3, chosen at
 * random, make the next layer. There may be fewer layers than requested: a layer is not made if its
 * vertices lie on one line, or if it would have all vertices of the layer below. Fails with
 * MW_ERROR_ARGUMENT for options out of range, and MW_ERROR_MEMORY (also if cancelled). *out may be
 * released in either case. Stages of the present part of the job. */
mw_status mw__layers_create(const mw_tiling *tiling, const mw_layers_options *options, mw_job *job,
                            mw_layers *out, mw_error *error);
void mw__layers_release(mw_layers *layers);
void mw__layers_cut(mw_layers *layers, uint32_t count); /* keep so many, the mesh itself counted */
size_t mw__layers_bytes(const mw_layers *layers);       /* what it owns, beside *layers */

/* The vertices of each layer, the mesh first; 0 for those that are not there. */
void mw__layers_describe(const mw_layers *layers, uint32_t vertices[MW_MAX_LAYERS]);

/* How to walk in the layers: as in the mesh. */
typedef struct mw_layer_walk {
    mw_walk_kind walk, finish;
    bool exact, count;
    const mw_tiling *mesh; /* NULL will do where the layers are not live */
} mw_layer_walk;

/* The name of the tile at which a walk to q begins in the mesh. With how->count, the work of the
 * walks in the layers is added to *work, which may be NULL otherwise. If a walk in a layer runs out
 * of steps, the search goes down from where it stopped. The fast stochastic walk makes no steps
 * with one test here, as the walks are short. */
uint32_t mw__layers_first(const mw_layers *layers, mw_point q, const mw_layer_walk *how,
                          uint64_t *random, mw_work *work);

/* The same, which also tells the tile of each layer where its walk ended; tile: NULL, or room for
 * all layers but the mesh. */
uint32_t mw__layers_descend(const mw_layers *layers, mw_point q, const mw_layer_walk *how,
                            uint64_t *random, mw_work *work, uint32_t *tile);

#endif
