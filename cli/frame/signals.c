#include "cli/frame/signals.h"
#include "src/base/posix.h"

#include <stdatomic.h>
#include <stddef.h>
#include <stdio.h>

/* While this is held, no signal ends the program. */
static pthread_mutex_t lock = PTHREAD_MUTEX_INITIALIZER;
static char temporaries[MAX_TEMPORARIES][4096]; /* "": none. Guarded by the lock */
static atomic_bool come;                        /* a signal asks the program to end */
static sigset_t ending_signals;                 /* set before the thread starts */

/* Collect the signals that would end the program. An ignored one, as under nohup, stays ignored. */
static void ending_signals_collect(void)
{
    static const int numbers[] = {SIGHUP, SIGINT, SIGTERM, SIGQUIT};
    sigemptyset(&ending_signals);
    for (size_t i = 0; i < sizeof numbers / sizeof *numbers; i++) {
        struct sigaction action;
        if (sigaction(numbers[i], NULL, &action) == 0 && action.sa_handler == SIG_DFL)
            sigaddset(&ending_signals, numbers[i]);
    }
}

/* Remove a directory of files. */
static void directory_remove(const char *path)
{
    DIR *directory = opendir(path);
    char name[4096];
    if (!directory) return;
    for (struct dirent *entry; (entry = readdir(directory));)
        if (snprintf(name, sizeof name, "%s/%s", path, entry->d_name) < (int)sizeof name)
            unlink(name);
    closedir(directory);
    rmdir(path);
}

/* The caller holds the lock. */
static void temporaries_remove(void)
{
    for (size_t i = 0; i < MAX_TEMPORARIES; i++) {
        if (*temporaries[i] && unlink(temporaries[i]) != 0) directory_remove(temporaries[i]);
        *temporaries[i] = 0;
    }
}

/* Wait for a signal, remove the files, and then let the signal end the program as usual. */
static void *signals_wait(void *unused)
{
    int number;
    (void)unused;
    if (sigwait(&ending_signals, &number) != 0) return NULL;
    atomic_store(&come, true);
    pthread_mutex_lock(&lock);
    temporaries_remove();
    pthread_sigmask(SIG_UNBLOCK, &ending_signals, NULL);
    raise(number);
    return NULL;
}

void signals_begin(void)
{
    pthread_t thread;
    sigset_t before;
    ending_signals_collect();
    /* Threads that start later inherit the mask. */
    if (pthread_sigmask(SIG_BLOCK, &ending_signals, &before) != 0) return;
    if (pthread_create(&thread, NULL, signals_wait, NULL) == 0)
        pthread_detach(thread);
    else
        pthread_sigmask(SIG_SETMASK, &before, NULL);
}

/* The caller holds the lock. */
static void temporaries_add(const char *temporary)
{
    size_t i = 0;
    while (i < MAX_TEMPORARIES && *temporaries[i]) i++;
    if (!temporary || i == MAX_TEMPORARIES) return;
    if (snprintf(temporaries[i], sizeof temporaries[i], "%s", temporary) >=
        (int)sizeof temporaries[i])
        *temporaries[i] = 0;
}

void signals_set_temporary(const char *temporary)
{
    pthread_mutex_lock(&lock);
    for (size_t i = 0; i < MAX_TEMPORARIES; i++) *temporaries[i] = 0;
    temporaries_add(temporary);
    pthread_mutex_unlock(&lock);
}

void signals_add_temporary(const char *temporary)
{
    pthread_mutex_lock(&lock);
    temporaries_add(temporary);
    pthread_mutex_unlock(&lock);
}

void signals_remove_temporaries(void)
{
    pthread_mutex_lock(&lock);
    temporaries_remove();
    pthread_mutex_unlock(&lock);
}

void signals_hold(bool hold)
{
    if (hold)
        pthread_mutex_lock(&lock);
    else
        pthread_mutex_unlock(&lock);
}

bool signals_have_come(void)
{
    return atomic_load(&come);
}

void signals_await_end(void)
{
    for (;;) pause();
}
