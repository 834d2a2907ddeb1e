/* live_layers.h - layers that follow the mesh [Devillers 2002, "The Delaunay hierarchy"]. Private.
 *
 * Each layer above the mesh is a dynamic tiling. A vertex inserted into the mesh is copied into the
 * layer above with the probability that the layers were built with, from there into the next one
 * with the same probability, and so on. Removing or moving a vertex removes or moves all its
 * copies. A vertex of a layer knows its slot in the layer below, and in the layer above if it has a
 * copy there. */
#ifndef MW_SRC_EDIT_LIVE_LAYERS_H
#define MW_SRC_EDIT_LIVE_LAYERS_H

#include "dynamic/dynamic_tiling.h"
#include "start/layers.h"

typedef struct mw_live_layers {
    mw_layers *layers;                            /* NULL: none        */
    const mw_dynamic_tiling *mesh;                /* below all layers  */
    mw_dynamic_tiling dynamic[MW_MAX_LAYERS - 1]; /* layers->layer[i]  */
    /* slot of a vertex below layer i -> slot of its copy in layer i; MW_NONE */
    uint32_t *up[MW_MAX_LAYERS - 1];
    uint32_t up_room[MW_MAX_LAYERS - 1], below_room[MW_MAX_LAYERS - 1];
    double ratio;
    uint64_t random;
} mw_live_layers;

/* Build layers above a dynamic tiling. Errors as mw__layers_create; release in either case. */
mw_status mw__live_layers_create(mw_live_layers *live, mw_layers *layers,
                                 const mw_dynamic_tiling *mesh, const mw_layers_options *options,
                                 mw_job *job, mw_error *error);
/* The layers were copied to this address. */
void mw__live_layers_attach(mw_live_layers *live, mw_layers *layers);
/* Release all layers above the mesh. */
void mw__live_layers_drop(mw_live_layers *live);
/* Release everything, the layers too. */
void mw__live_layers_release(mw_live_layers *live);
/* Without what mw__layers_bytes counts. */
size_t mw__live_layers_bytes(const mw_live_layers *live);

/* Does each layer have between half and twice its expected number of vertices? */
bool mw__live_layers_even(const mw_live_layers *live);

/* Call after vertex v of the mesh was inserted, removed or moved. False: a layer could not follow.
 * It has been released, with those above it. */
bool mw__live_layers_insert(mw_live_layers *live, uint32_t v, mw_point p);
bool mw__live_layers_remove(mw_live_layers *live, uint32_t v);
bool mw__live_layers_move(mw_live_layers *live, uint32_t v, mw_point p);

#endif
