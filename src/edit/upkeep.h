/* upkeep.h - keeps the guide and the indices useful while the mesh changes. Private.
 *
 * The locator of an editor has a guide (a grid, or a grid of two levels where vertices are
 * crowded). The editor may have an index for each start, too. They refer to tiles that edits delete
 * or reshape:
 *
 *   grids    hold names of tiles. A name leads to the triangle of that number, or to one that
 *            replaced it. So a name is never wrong; it may only lead farther off. A triangle that
 *            an edit changed is put into the cell of its centroid if it is near the centre of the
 *            cell.
 *   layers   follow each vertex [Devillers 2002]: see live_layers.h.
 *   a curve  holds slots of tiles, which edits make less and less useful. It is rebuilt only on
 *            request.
 *
 * The guide does not follow edits. The hubs do: see live_hubs.h.
 *
 * Grids and layers are rebuilt in O(n) when there are twice as many vertices as when they were
 * built, or half; or after four edits for each vertex of that time. The guide is rebuilt when there
 * are three times as many vertices, or half; or after two insertions for each vertex, where other
 * edits count twice. Guide and grids are also rebuilt when a quarter as many vertices were put
 * outside their extent; layers, when one has half or twice its expected number of vertices. That is
 * O(1) for each edit. When memory is short, the old ones stay, and layers that cannot follow are
 * dropped. No answer depends on any of this. */
#ifndef MW_SRC_EDIT_UPKEEP_H
#define MW_SRC_EDIT_UPKEEP_H

#include "dynamic/dynamic_tiling.h"
#include "edit/live_hubs.h"
#include "edit/live_layers.h"
#include "locate/locator.h"

/* How far an index has fallen behind the mesh, and when it is rebuilt. */
typedef struct mw_staleness {
    bool built;
    uint64_t edits, outsiders;           /* since then: edits; vertices outside its extent */
    uint64_t most_edits, most_outsiders; /* more lead to a rebuild                         */
    uint64_t fewest, most;               /* vertices: fewer or more lead to a rebuild      */
    uint32_t weight;                     /* of an edit that is no insertion                */
} mw_staleness;

typedef struct mw_upkeep {
    mw_locator *locator;
    const mw_dynamic_tiling *dynamic; /* its tiling is the locator's     */
    mw_index index[MW_START_COUNT];   /* by start; .start is MW_START_AUTO if there is none */
    mw_index_options options[MW_START_COUNT];
    mw_staleness staleness[MW_START_COUNT]; /* [MW_START_AUTO] is the guide's */
    mw_start_kind kept[MW_START_COUNT];     /* those that edits keep up: the guide, grids, layers */
    uint32_t kept_count;
    mw_live_layers live; /* follows the vertices for index[MW_START_LAYERS] */
    mw_hub_table hubs;
    uint64_t refreshes; /* how often something was rebuilt */
    bool large;         /* the mesh is larger than the caches; found with the guide */
} mw_upkeep;

/* Take a locator whose `tiling` is that of `dynamic`, and which is zero otherwise. Find its extent
 * and default walks, and build its guide. None of the three may move in memory afterwards, but the
 * contents of `dynamic` may be exchanged (mw__upkeep_compact). MW_ERROR_MEMORY; release in either
 * case. */
mw_status mw__upkeep_create(mw_upkeep *upkeep, mw_locator *locator,
                            const mw_dynamic_tiling *dynamic, mw_job *job, mw_error *error);
void mw__upkeep_release(mw_upkeep *upkeep);       /* the guide, too */
size_t mw__upkeep_bytes(const mw_upkeep *upkeep); /* of indices, guide and hubs */

/* Build or rebuild the index of a start, &upkeep->index[start]. options: NULL = all zero. Errors as
 * mw_index_create; then nothing has changed. */
mw_status mw__upkeep_build(mw_upkeep *upkeep, mw_start_kind start, const mw_index_options *options,
                           mw_job *job, mw_error *error);

/* Does mw__upkeep_edit need the journal of so many insertions at once? */
bool mw__upkeep_needs_report(const mw_upkeep *upkeep, size_t insertions);

/* Call after an edit was committed, or (undone) reverted, while its step can still be read. Raises
 * the locator's epoch, which tells cursors that the slot of their tile may have changed. */
void mw__upkeep_edit(mw_upkeep *upkeep, bool undone);

/* Call after an insertion without a journal step: of vertex v, or MW_NONE if one was there
 * already. */
void mw__upkeep_insertion(mw_upkeep *upkeep, uint32_t v);

/* Call during an edit that inserts many vertices: rebuilds the guide when there are three times as
 * many as when it was built. */
void mw__upkeep_grow(mw_upkeep *upkeep);

/* Call after an edit failed, or was rolled back. */
void mw__upkeep_resume(const mw_upkeep *upkeep);

/* Call after an edit that rebuilt the guide was rolled back: the guide names tiles that do not
 * exist. */
void mw__upkeep_rolled_back(mw_upkeep *upkeep);

/* Call after everything was renumbered: rebuilds all. Raises the epoch, which tells cursors that
 * the numbers have changed. */
void mw__upkeep_compact(mw_upkeep *upkeep);

#endif
