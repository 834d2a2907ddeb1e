/* rwlock.h - a readers-writer lock: many queries or one update. A waiting update goes before later
 * queries. Private. */
#ifndef MW_SRC_SURFACE_RWLOCK_H
#define MW_SRC_SURFACE_RWLOCK_H

#include "base/base.h"

typedef struct mw_rwlock mw_rwlock;

mw_rwlock *mw__rwlock_create(void);             /* NULL when out of memory */
void mw__rwlock_destroy(mw_rwlock *lock);       /* may be NULL */
size_t mw__rwlock_bytes(const mw_rwlock *lock); /* 0 for NULL */

void mw__rwlock_read_lock(mw_rwlock *lock); /* before a query */
void mw__rwlock_read_unlock(mw_rwlock *lock);
void mw__rwlock_write_lock(mw_rwlock *lock); /* before an update: waits until no query runs */
void mw__rwlock_write_unlock(mw_rwlock *lock);

#endif
