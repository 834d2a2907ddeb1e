/* gate.h - lets many queries through, or one update. A waiting update goes before queries that come later. Private. */
#ifndef MW_SRC_GATE_H
#define MW_SRC_GATE_H

#include "base/base.h"

typedef struct mw_gate mw_gate;

mw_gate *mw__gate_create(void);             /* NULL when out of memory */
void mw__gate_destroy(mw_gate *gate);       /* NULL is allowed */
size_t mw__gate_bytes(const mw_gate *gate); /* 0 of NULL */

void mw__gate_enter(mw_gate *gate); /* a query */
void mw__gate_leave(mw_gate *gate);
void mw__gate_close(mw_gate *gate); /* an update: waits until the queries inside have left */
void mw__gate_open(mw_gate *gate);

#endif
