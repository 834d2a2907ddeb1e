/* gate.c - those inside are counted without a lock; who must wait does so at a mutex.
 *
 * A query counts itself in and then looks whether the gate is closed; an update closes the gate and then looks whether
 * anybody is inside. All this is sequentially consistent, so at least one of two that meet sees the other: the query,
 * which turns back, or the update, which waits. In the same way the last one to leave sees the gate closed, or the
 * update sees nobody inside. */
#include "mesh/gate.h"

#include <pthread.h>
#include <stdatomic.h>
#include <stdlib.h>

struct mw_gate {
    atomic_uint inside;
    atomic_bool closed; /* set under the mutex */
    pthread_mutex_t mutex;
    pthread_cond_t changed; /* the gate was opened, or the last one left while it was closed */
};

mw_gate *mw__gate_create(void)
{
    mw_gate *gate = mw__calloc(1, sizeof *gate);
    if (!gate) return NULL;
    atomic_init(&gate->inside, 0);
    atomic_init(&gate->closed, false);
    if (pthread_mutex_init(&gate->mutex, NULL) == 0) {
        if (pthread_cond_init(&gate->changed, NULL) == 0) return gate;
        pthread_mutex_destroy(&gate->mutex);
    }
    free(gate);
    return NULL;
}

void mw__gate_destroy(mw_gate *gate)
{
    if (!gate) return;
    pthread_cond_destroy(&gate->changed);
    pthread_mutex_destroy(&gate->mutex);
    free(gate);
}

size_t mw__gate_bytes(const mw_gate *gate)
{
    return gate ? sizeof *gate : 0;
}

static void wake(mw_gate *gate)
{
    pthread_mutex_lock(&gate->mutex); /* who has looked, but does not wait yet, holds it */
    pthread_cond_broadcast(&gate->changed);
    pthread_mutex_unlock(&gate->mutex);
}

void mw__gate_leave(mw_gate *gate)
{
    if (atomic_fetch_sub(&gate->inside, 1) == 1 && atomic_load(&gate->closed)) wake(gate);
}

void mw__gate_enter(mw_gate *gate)
{
    for (;;) {
        atomic_fetch_add(&gate->inside, 1);
        if (MW_LIKELY(!atomic_load(&gate->closed))) return;
        mw__gate_leave(gate);
        pthread_mutex_lock(&gate->mutex);
        while (atomic_load(&gate->closed)) pthread_cond_wait(&gate->changed, &gate->mutex);
        pthread_mutex_unlock(&gate->mutex);
    }
}

void mw__gate_close(mw_gate *gate)
{
    pthread_mutex_lock(&gate->mutex);
    while (atomic_load(&gate->closed)) pthread_cond_wait(&gate->changed, &gate->mutex); /* another update */
    atomic_store(&gate->closed, true);
    while (atomic_load(&gate->inside) > 0) pthread_cond_wait(&gate->changed, &gate->mutex);
    pthread_mutex_unlock(&gate->mutex);
}

void mw__gate_open(mw_gate *gate)
{
    pthread_mutex_lock(&gate->mutex);
    atomic_store(&gate->closed, false);
    pthread_cond_broadcast(&gate->changed);
    pthread_mutex_unlock(&gate->mutex);
}
