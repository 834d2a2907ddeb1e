/* borrowed_locate.h - one query in the caller's arrays. Private. */
#ifndef MW_SRC_BORROW_BORROWED_LOCATE_H
#define MW_SRC_BORROW_BORROWED_LOCATE_H

#include "borrow/borrowed.h"

/* As mw_borrowed_locate; the walk begins at the cursor's last triangle if `chained`. */
mw_location mw__borrowed_locate(const mw_borrowed *mesh, mw_borrowed_cursor *cursor, mw_point q,
                                bool chained);

#endif
