#include "signals.h"

#include <signal.h>
#include <stddef.h>
#include <stdio.h>
#include <unistd.h>

static const int ending[] = {SIGHUP, SIGINT, SIGTERM, SIGQUIT};
enum { ENDING_COUNT = sizeof ending / sizeof *ending };

static char doomed[4096]; /* "" : none; only changed while the signals are held */

static void end_by(int signal_number)
{
    if (*doomed) unlink(doomed);
    raise(signal_number); /* its default action is back: SA_RESETHAND */
}

void signals_hold(bool hold)
{
    sigset_t set;
    sigemptyset(&set);
    for (int i = 0; i < ENDING_COUNT; i++) sigaddset(&set, ending[i]);
    sigprocmask(hold ? SIG_BLOCK : SIG_UNBLOCK, &set, NULL);
}

/* A signal that is ignored, as under nohup, stays ignored. */
static void catch_signals(void)
{
    for (int i = 0; i < ENDING_COUNT; i++) {
        struct sigaction old, action = {.sa_handler = end_by, .sa_flags = (int)SA_RESETHAND};
        sigemptyset(&action.sa_mask);
        if (sigaction(ending[i], NULL, &old) == 0 && old.sa_handler == SIG_DFL) sigaction(ending[i], &action, NULL);
    }
}

void signals_remove(const char *temporary)
{
    signals_hold(true);
    if (!temporary || snprintf(doomed, sizeof doomed, "%s", temporary) >= (int)sizeof doomed) *doomed = 0;
    if (*doomed) catch_signals();
    signals_hold(false);
}
