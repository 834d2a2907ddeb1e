#include "cli/frame/signals.h"

#include <pthread.h>
#include <signal.h>
#include <stddef.h>
#include <stdio.h>
#include <unistd.h>

static pthread_mutex_t lock = PTHREAD_MUTEX_INITIALIZER; /* held: no signal ends the program just now */
static char doomed[MOST_TEMPORARIES][4096];              /* "": none; under the lock */
static sigset_t ending;                                  /* written before the thread begins */

/* The signals that would end the program: one that is ignored, as under nohup, stays ignored. */
static void collect_signals(void)
{
    static const int numbers[] = {SIGHUP, SIGINT, SIGTERM, SIGQUIT};
    sigemptyset(&ending);
    for (size_t i = 0; i < sizeof numbers / sizeof *numbers; i++) {
        struct sigaction action;
        if (sigaction(numbers[i], NULL, &action) == 0 && action.sa_handler == SIG_DFL) sigaddset(&ending, numbers[i]);
    }
}

/* Under the lock. */
static void clean(void)
{
    for (size_t i = 0; i < MOST_TEMPORARIES; i++) {
        if (*doomed[i]) unlink(doomed[i]);
        *doomed[i] = 0;
    }
}

/* Wait for a signal, clean up, and let it do to the program what it does by default. */
static void *wait_for_signal(void *unused)
{
    int number;
    (void)unused;
    if (sigwait(&ending, &number) != 0) return NULL;
    pthread_mutex_lock(&lock);
    clean();
    pthread_sigmask(SIG_UNBLOCK, &ending, NULL);
    raise(number);
    return NULL;
}

void signals_begin(void)
{
    pthread_t thread;
    sigset_t before;
    collect_signals();
    if (pthread_sigmask(SIG_BLOCK, &ending, &before) != 0) return; /* every later thread inherits it */
    if (pthread_create(&thread, NULL, wait_for_signal, NULL) == 0)
        pthread_detach(thread);
    else
        pthread_sigmask(SIG_SETMASK, &before, NULL);
}

/* Under the lock. */
static void doom(const char *temporary)
{
    size_t i = 0;
    while (i < MOST_TEMPORARIES && *doomed[i]) i++;
    if (!temporary || i == MOST_TEMPORARIES) return;
    if (snprintf(doomed[i], sizeof doomed[i], "%s", temporary) >= (int)sizeof doomed[i]) *doomed[i] = 0;
}

void signals_remove(const char *temporary)
{
    pthread_mutex_lock(&lock);
    for (size_t i = 0; i < MOST_TEMPORARIES; i++) *doomed[i] = 0;
    doom(temporary);
    pthread_mutex_unlock(&lock);
}

void signals_remove_too(const char *temporary)
{
    pthread_mutex_lock(&lock);
    doom(temporary);
    pthread_mutex_unlock(&lock);
}

void signals_clean(void)
{
    pthread_mutex_lock(&lock);
    clean();
    pthread_mutex_unlock(&lock);
}

void signals_hold(bool hold)
{
    if (hold)
        pthread_mutex_lock(&lock);
    else
        pthread_mutex_unlock(&lock);
}
