/* pthread.h - threads where there are none: one thread holds every lock. */
#ifndef MW_WEB_PTHREAD_H
#define MW_WEB_PTHREAD_H

typedef int pthread_mutex_t;
typedef int pthread_cond_t;

#define PTHREAD_MUTEX_INITIALIZER 0

static inline int pthread_mutex_init(pthread_mutex_t *mutex, const void *attributes)
{
    (void)attributes;
    return *mutex = 0;
}

static inline int pthread_mutex_destroy(pthread_mutex_t *mutex)
{
    return (void)mutex, 0;
}

static inline int pthread_mutex_lock(pthread_mutex_t *mutex)
{
    return (void)mutex, 0;
}

static inline int pthread_mutex_unlock(pthread_mutex_t *mutex)
{
    return (void)mutex, 0;
}

static inline int pthread_cond_init(pthread_cond_t *condition, const void *attributes)
{
    (void)attributes;
    return *condition = 0;
}

static inline int pthread_cond_destroy(pthread_cond_t *condition)
{
    return (void)condition, 0;
}

static inline int pthread_cond_broadcast(pthread_cond_t *condition)
{
    return (void)condition, 0;
}

/* Nobody else could wake the only thread. */
static inline int pthread_cond_wait(pthread_cond_t *condition, pthread_mutex_t *mutex)
{
    (void)condition;
    (void)mutex;
    __builtin_trap();
}

#endif
