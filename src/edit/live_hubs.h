/* live_hubs.h - the hubs of a tiling, which follow its edits. Private.
 *
 * Hubs are found by sampling: one in HUB_STRIDE of all tiles, and the tiles of one in HUB_EDITS
 * edits. So a mesh without hubs pays almost nothing. A vertex of d tiles is missed with probability
 * exp(-d / HUB_STRIDE); in a mesh that is edited, until about HUB_EDITS further edits have changed
 * its tiles. Answers do not depend on it.
 *
 * When an edit gives new numbers to tiles of a hub, they are added to its heap. The number of a
 * removed triangle is dropped when it becomes the first of the heap. The heap is rebuilt when it
 * has doubled. */
#ifndef MW_SRC_EDIT_LIVE_HUBS_H
#define MW_SRC_EDIT_LIVE_HUBS_H

#include "dynamic/dynamic_tiling.h"
#include "tiling/hub_table.h"

enum {
    MW_HUB_DEGREE = 256, /* fewer tiles: no hub */
    MW_HUB_STRIDE = 61,  /* odd: hubs may take turns in the array */
    MW_HUB_EDITS = 256
};

/* Look for hubs: at every MW_HUB_STRIDE-th tile from tile `first` on. */
void mw__live_hubs_survey(mw_hub_table *hubs, const mw_tiling *tiling, uint32_t first);
/* The same at the tiles that the last step of the journal changed. */
void mw__live_hubs_survey_step(mw_hub_table *hubs, const mw_dynamic_tiling *dynamic);
/* The same at one tile and its neighbours. */
void mw__live_hubs_look_round(mw_hub_table *hubs, const mw_tiling *tiling, uint32_t t);

/* Follow the last step of the journal, which was recorded, after it was committed or reverted. */
void mw__live_hubs_follow(mw_hub_table *hubs, const mw_dynamic_tiling *dynamic);

/* Let queries use the hubs, while no edit is under way. */
void mw__live_hubs_attach(const mw_hub_table *hubs, mw_tiling *tiling);

void mw__live_hubs_release(mw_hub_table *hubs);
size_t mw__live_hubs_bytes(const mw_hub_table *hubs);

#endif
