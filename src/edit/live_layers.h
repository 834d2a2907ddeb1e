/* live_layers.h - layers that follow the mesh [Devillers 2002, "The Delaunay hierarchy"]. Private.
 *
 * Each layer above the mesh is a fabric: a vertex inserted into the mesh rises into the layer above with the chance that those had when the
 * layers were built, from there into the next with the same, and so on; one that goes leaves all layers; one that moves does so in all. A vertex
 * of a layer knows the one below it, by its place, and the one above. */
#ifndef MW_SRC_LIVE_LAYERS_H
#define MW_SRC_LIVE_LAYERS_H

#include "edit/fabric.h"
#include "start/layers.h"

typedef struct mw_live_layers {
    mw_layers *layers;                   /* which these are; NULL: none */
    const mw_fabric *mesh;               /* below them                  */
    mw_fabric fabric[MW_MAX_LAYERS - 1]; /* of each layer, as in layers->layer */
    uint32_t *up[MW_MAX_LAYERS - 1];     /* per place of a vertex below that layer: its place there, or MW_NONE */
    uint32_t up_room[MW_MAX_LAYERS - 1], below_room[MW_MAX_LAYERS - 1];
    double ratio;
    uint64_t random;
} mw_live_layers;

/* Build layers above a fabric. As mw__layers_create; release in either case. */
mw_status mw__live_layers_create(mw_live_layers *live, mw_layers *layers, const mw_fabric *mesh,
                                 const mw_layers_options *options, mw_error *error);
void mw__live_layers_attach(mw_live_layers *live, mw_layers *layers); /* the layers were copied to this place */
void mw__live_layers_drop(mw_live_layers *live);                      /* all layers but the mesh go */
void mw__live_layers_release(mw_live_layers *live);                   /* the layers too */
size_t mw__live_layers_bytes(const mw_live_layers *live);             /* beside what mw__layers_bytes tells */

/* Has each layer between half and twice as many vertices as the chance of them lets expect? */
bool mw__live_layers_even(const mw_live_layers *live);

/* After vertex v of the mesh came, went, or moved. False: a layer could not follow; it and those above are gone. */
bool mw__live_layers_insert(mw_live_layers *live, uint32_t v, mw_point p);
bool mw__live_layers_remove(mw_live_layers *live, uint32_t v);
bool mw__live_layers_move(mw_live_layers *live, uint32_t v, mw_point p);

#endif
