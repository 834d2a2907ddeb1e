/* operations.h - what an edit can do to a fabric, each operation in its file. Private.
 *
 * They return MW_ERROR_INPUT, MW_ERROR_LIMIT or MW_ERROR_MEMORY; then the edit is to be rolled back.
 * Vertices are places. */
#ifndef MW_SRC_OPERATIONS_H
#define MW_SRC_OPERATIONS_H

#include "edit/fabric.h"

/* *vertex MW_NONE: a new one, else one that is in no tile. *vertex is set to the vertex at q, which may
 * be another one. `t`: where to begin to look for q (insert.c). There may be no edit under way, if
 * nobody will ask: one begins where this may fail after it has changed something. */
mw_status mw__fabric_insert(mw_fabric *f, mw_point q, uint32_t t, uint32_t *vertex, mw_error *error);
mw_status mw__fabric_remove(mw_fabric *f, uint32_t vertex, mw_error *error);
/* `t`: where to begin to look for q if the vertex cannot stay in its star; MW_NONE: there. */
mw_status mw__fabric_move(mw_fabric *f, uint32_t vertex, mw_point q, uint32_t t, mw_error *error);
mw_status mw__fabric_flip(mw_fabric *f, uint32_t from, uint32_t to, mw_error *error);
mw_status mw__fabric_constrain(mw_fabric *f, uint32_t from, uint32_t to, bool release, uint32_t *pieces,
                               mw_error *error);
/* Make all that is not fixed Delaunay. */
mw_status mw__fabric_mend(mw_fabric *f, mw_error *error);

#endif
