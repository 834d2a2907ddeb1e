/* rwlock.c - a readers-writer lock. Readers only count themselves; threads that must wait do so at
 * a mutex.
 *
 * A reader counts itself first and then looks for a writer. A writer sets its flag first and then
 * looks for readers. All these accesses are sequentially consistent. So of two that meet, at least
 * one sees the other: the reader, which steps back, or the writer, which waits. In the same way,
 * the last reader to unlock sees the flag, or the writer sees no reader. */
#include "surface/rwlock.h"
#include "base/posix.h"

#include <stdatomic.h>
#include <stdlib.h>

struct mw_rwlock {
    atomic_uint readers;
    atomic_bool writing; /* set while the mutex is held */
    pthread_mutex_t mutex;
    pthread_cond_t changed; /* the writer unlocked, or the last reader did while a writer waited */
};

mw_rwlock *mw__rwlock_create(void)
{
    mw_rwlock *lock = mw__calloc(1, sizeof *lock);
    if (!lock) return NULL;
    atomic_init(&lock->readers, 0);
    atomic_init(&lock->writing, false);
    if (pthread_mutex_init(&lock->mutex, NULL) == 0) {
        if (pthread_cond_init(&lock->changed, NULL) == 0) return lock;
        pthread_mutex_destroy(&lock->mutex);
    }
    free(lock);
    return NULL;
}

void mw__rwlock_destroy(mw_rwlock *lock)
{
    if (!lock) return;
    pthread_cond_destroy(&lock->changed);
    pthread_mutex_destroy(&lock->mutex);
    free(lock);
}

size_t mw__rwlock_bytes(const mw_rwlock *lock)
{
    return lock ? sizeof *lock : 0;
}

static void rwlock_wake(mw_rwlock *lock)
{
    /* A thread that has looked, but does not wait yet, holds the mutex. */
    pthread_mutex_lock(&lock->mutex);
    pthread_cond_broadcast(&lock->changed);
    pthread_mutex_unlock(&lock->mutex);
}

void mw__rwlock_read_unlock(mw_rwlock *lock)
{
    if (atomic_fetch_sub(&lock->readers, 1) == 1 && atomic_load(&lock->writing)) rwlock_wake(lock);
}

void mw__rwlock_read_lock(mw_rwlock *lock)
{
    for (;;) {
        atomic_fetch_add(&lock->readers, 1);
        if (MW_LIKELY(!atomic_load(&lock->writing))) return;
        mw__rwlock_read_unlock(lock);
        pthread_mutex_lock(&lock->mutex);
        while (atomic_load(&lock->writing)) pthread_cond_wait(&lock->changed, &lock->mutex);
        pthread_mutex_unlock(&lock->mutex);
    }
}

void mw__rwlock_write_lock(mw_rwlock *lock)
{
    pthread_mutex_lock(&lock->mutex);
    /* Wait for another writer. */
    while (atomic_load(&lock->writing)) pthread_cond_wait(&lock->changed, &lock->mutex);
    atomic_store(&lock->writing, true);
    while (atomic_load(&lock->readers) > 0) pthread_cond_wait(&lock->changed, &lock->mutex);
    pthread_mutex_unlock(&lock->mutex);
}

void mw__rwlock_write_unlock(mw_rwlock *lock)
{
    pthread_mutex_lock(&lock->mutex);
    atomic_store(&lock->writing, false);
    pthread_cond_broadcast(&lock->changed);
    pthread_mutex_unlock(&lock->mutex);
}
