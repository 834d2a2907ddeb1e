/* upkeep.h - what leads queries to a first tile, while the mesh changes. Private.
 *
 * A locator of a mesh that changes has a guide, a grid or, where vertices are crowded, one of two levels; and its editor may have an index for
 * each start. They name tiles that edits take away or reshape:
 *
 *   grids    hold names of tiles. A name leads to the triangle of that number, or to one that took its place, so it never goes wrong,
 *            only farther off. A triangle that an edit changed is put into the cell of its middle, if near the middle of that.
 *   layers   follow each vertex [Devillers 2002]: see live_layers.h.
 *   a curve  holds places of tiles, which say less and less. It is built anew only on request.
 *
 * The guide is not told of edits. Grids and layers are built anew, in O(n), when there are twice as many vertices as when they were built,
 * or half, or after four edits for each vertex there was; the guide when there are three times as many, or half, or after two insertions for each, other
 * edits counting twice; guide and grids also when a quarter as many vertices were put
 * beyond their rims; layers when one has half or twice as many vertices as its chance of them lets expect. That is O(1) for each edit.
 * Where memory is short the old ones stay, and layers that cannot follow are dropped: all of this is only a guide, no answer depends on it. */
#ifndef MW_SRC_UPKEEP_H
#define MW_SRC_UPKEEP_H

#include "edit/fabric.h"
#include "edit/live_layers.h"
#include "locate/locator.h"

/* When is it to be built anew? */
typedef struct mw_since {
    bool built;
    uint64_t edits, outsiders;           /* since it was built: edits; vertices put where it has no cells */
    uint64_t most_edits, most_outsiders; /* as many are borne                                             */
    uint64_t fewest, most;               /* vertices                                                      */
    uint32_t weight;                     /* an edit that is no insertion counts as so many                */
} mw_since;

typedef struct mw_upkeep {
    mw_locator *locator;
    const mw_fabric *fabric;        /* whose tiling is the locator's */
    mw_index index[MW_START_COUNT]; /* by start; its own start is MW_START_AUTO where there is none */
    mw_index_options options[MW_START_COUNT];
    mw_since since[MW_START_COUNT];     /* that of MW_START_AUTO is the guide's */
    mw_start_kind kept[MW_START_COUNT]; /* those that follow edits: the guide, and what is built but for a curve */
    uint32_t kept_count;
    mw_live_layers live; /* what follows the vertices of index[MW_START_LAYERS] */
    uint64_t refreshes;  /* times that something was built anew */
    bool large;          /* the mesh is more than caches hold as a rule: found out with the guide */
} mw_upkeep;

/* Take a locator whose `tiling` is the fabric's, and all else is zero: find its extent, walks, guide, and what else it keeps. None of the three may
 * move from then on, but what the fabric holds may be exchanged (mw__upkeep_compact). MW_ERROR_MEMORY; release in either case. */
mw_status mw__upkeep_create(mw_upkeep *upkeep, mw_locator *locator, const mw_fabric *fabric, mw_error *error);
void mw__upkeep_release(mw_upkeep *upkeep);       /* the guide too */
size_t mw__upkeep_bytes(const mw_upkeep *upkeep); /* of indices and guide */

/* Build the index of a start, or build it anew, at &upkeep->index[start]. options: NULL = all zero. Errors as mw_index_create; then nothing
 * has changed. */
mw_status mw__upkeep_build(mw_upkeep *upkeep, mw_start_kind start, const mw_index_options *options, mw_error *error);

/* Has an insertion to be recorded for mw__upkeep_edit? */
bool mw__upkeep_asks(const mw_upkeep *upkeep);

/* After an edit was committed, or (undone) reverted, and before its step is forgotten or dropped: its journal tells what changed. Raises the
 * locator's epoch, by which cursors know that their tile has another place. */
void mw__upkeep_edit(mw_upkeep *upkeep, bool undone);

/* The same after an insertion that was no step, as nobody asked: of vertex v, or MW_NONE where there was one. */
void mw__upkeep_insertion(mw_upkeep *upkeep, uint32_t v);

/* In the middle of an edit that puts in many vertices: the guide is built anew if there are three times as many as when it was. */
void mw__upkeep_grow(mw_upkeep *upkeep);

/* After an edit in which the guide was built anew failed, and was rolled back: it names tiles that are not there. */
void mw__upkeep_rolled_back(mw_upkeep *upkeep);

/* After everything was numbered anew: all is built anew. Raises the epoch so that cursors know that names are other ones. */
void mw__upkeep_compact(mw_upkeep *upkeep);

#endif
