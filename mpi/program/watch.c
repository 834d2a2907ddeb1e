/* watch.c - the launched process becomes the watcher, its child the rank. What this rests on:
 *
 * - MPICH's mpiexec learns of a rank's end when the socket closes that the rank was started with.
 *   The watcher has a copy, which stays open until the watcher ends. Open MPI's mpiexec learns it
 *   from the end of the process that it launched, which is the watcher.
 * - mpiexec ends ranks by signals to their process groups. SIGKILL ends the watcher with its rank,
 *   and neither runs again. Other signals reach the watcher before it can see the rank's end; it
 *   keeps silent about a rank that a signal of mpiexec ended.
 * - If it is the watcher that is killed, the kernel sends a signal to the rank (Linux), which
 *   then says so and ends. */
#ifndef _GNU_SOURCE
#define _GNU_SOURCE /* MAP_ANONYMOUS */
#endif
#include "mpi/program/watch.h"

#include <signal.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>
#ifdef __linux__
#include <sys/prctl.h>
#endif

/* Signals that the watcher hands on to the rank. */
static const int handed_on[] = {SIGHUP, SIGINT, SIGQUIT, SIGTERM, SIGUSR1, SIGUSR2};
#define HANDED_ON (sizeof handed_on / sizeof *handed_on)

/* Memory that the watcher shares with its rank. */
static volatile struct rank_place {
    int rank, size; /* size 0: not known yet */
} * place;

static pid_t watcher, watched;
static pid_t launchers[3]; /* who signals groups of processes: see launchers_find() */
static volatile sig_atomic_t launcher_sent[128]; /* by signal: one of these has sent it */

/* "meshwalk-mpi: rank 1 of 3 (process 4148 on node7)" */
static int rank_describe(char *to, size_t room, pid_t process)
{
    char host[256] = "";
    const int rank = place->rank, size = place->size;
    if (gethostname(host, sizeof host - 1) != 0) strcpy(host, "an unknown machine");
    if (size == 0)
        return snprintf(to, room, "meshwalk-mpi: a process before it had a rank (%ld on %s)",
                        (long)process, host);
    return snprintf(to, room, "meshwalk-mpi: rank %d of %d (process %ld on %s)", rank, size,
                    (long)process, host);
}

/* --- the watcher ------------------------------------------------------------------------------ */

static void signal_hand_on(int number, siginfo_t *info, void *unused)
{
    (void)unused;
    if (info->si_pid == 0)
        launcher_sent[number] = 1; /* from the terminal, or outside a container */
    for (size_t i = 0; i < sizeof launchers / sizeof *launchers; i++)
        if (info->si_pid == launchers[i]) launcher_sent[number] = 1;
    kill(watched, number); /* it is not reaped, so its number is no other's */
}

static void signals_hand_on(void)
{
    for (size_t i = 0; i < HANDED_ON; i++) {
        struct sigaction action;
        if (sigaction(handed_on[i], NULL, &action) != 0 || action.sa_handler == SIG_IGN) continue;
        action = (struct sigaction){.sa_flags = SA_SIGINFO | SA_RESTART};
        action.sa_sigaction = signal_hand_on;
        sigemptyset(&action.sa_mask);
        sigaction(handed_on[i], &action, NULL);
    }
}

/* The parent of a process, where /proc tells it; or -1. */
static pid_t process_parent(pid_t process)
{
    char path[64], line[512];
    long parent = -1;
    snprintf(path, sizeof path, "/proc/%ld/stat", (long)process);
    FILE *file = fopen(path, "r");
    if (!file) return -1;
    line[fread(line, 1, sizeof line - 1, file)] = 0;
    fclose(file);
    const char *after = strrchr(line, ')'); /* the name of the program may hold anything */
    if (!after || sscanf(after + 1, " %*c %ld", &parent) != 1) return -1;
    return (pid_t)parent;
}

/* Launchers make the launched process the leader of a group; it may be a shell that started this
 * one. Others leave it in a group of their own. */
static void launchers_find(void)
{
    launchers[0] = getppid();
    launchers[1] = getpgrp();
    launchers[2] = launchers[1] == getpid() ? launchers[0] : process_parent(launchers[1]);
}

/* As the rank ended, so that mpiexec sees the same as without a watcher. */
static _Noreturn void watcher_end(const siginfo_t *end)
{
    sigset_t one;
    if (end->si_code == CLD_EXITED) _exit(end->si_status);
    setrlimit(RLIMIT_CORE, &(struct rlimit){0}); /* the rank has left one, if any */
    signal(end->si_status, SIG_DFL);
    sigemptyset(&one);
    sigaddset(&one, end->si_status);
    sigprocmask(SIG_UNBLOCK, &one, NULL);
    raise(end->si_status);
    _exit(128 + end->si_status);
}

static void killed_name(int number)
{
    char line[1024];
    int length = rank_describe(line, sizeof line, watched);
    length += snprintf(line + length, sizeof line - (size_t)length,
                       " was killed by signal %d (%s); the run ends\n", number, strsignal(number));
    /* one call, so that no other line gets between; without standard error, nobody is told */
    if (write(STDERR_FILENO, line, (size_t)length) < 0) return;
}

static _Noreturn void watcher_run(const sigset_t *mask)
{
    siginfo_t end = {0};
    launchers_find();
    signals_hand_on();
    sigprocmask(SIG_SETMASK, mask, NULL);
#ifdef __linux__
    prctl(PR_SET_NAME, "meshwalk-watch");
#endif
    close(STDIN_FILENO); /* the rank's alone */
    close(STDOUT_FILENO);
    while (waitid(P_PID, (id_t)watched, &end, WEXITED | WNOWAIT) != 0) {
    }
    if (end.si_code != CLD_EXITED && !launcher_sent[end.si_status]) killed_name(end.si_status);
    watcher_end(&end);
}

/* --- the rank --------------------------------------------------------------------------------- */

#ifdef __linux__
static char orphan_line[1024];
static volatile sig_atomic_t orphan_length;

static void orphan_end(int number)
{
    (void)number;
    if (getppid() == watcher) return; /* somebody else has sent the signal */
    if (write(STDERR_FILENO, orphan_line, (size_t)orphan_length) < 0) _exit(128 + SIGKILL);
    kill(getpid(), SIGKILL);
}

/* A handler can write only what is ready. */
static void orphan_prepare(void)
{
    orphan_length = 0;
    const int length = rank_describe(orphan_line, sizeof orphan_line, getpid());
    orphan_length =
        length + snprintf(orphan_line + length, sizeof orphan_line - (size_t)length,
                          " was watched by process %ld, which was killed; the run ends\n",
                          (long)watcher);
}

static void orphan_listen(void)
{
    struct sigaction action = {.sa_handler = orphan_end};
    const int number = SIGRTMAX - 3; /* of those that nobody has a use for */
    sigemptyset(&action.sa_mask);
    orphan_prepare();
    if (sigaction(number, &action, NULL) != 0 || prctl(PR_SET_PDEATHSIG, number) != 0) return;
    if (getppid() != watcher) raise(number); /* it was killed before */
}
#else
static void orphan_prepare(void) {}
static void orphan_listen(void) {}
#endif

/* --- both ------------------------------------------------------------------------------------- */

void watch_begin(void)
{
    sigset_t all, mask;
    void *memory =
        mmap(NULL, sizeof *place, PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
    if (memory == MAP_FAILED) return;
    place = memory;
    watcher = getpid();
    sigfillset(&all);
    sigprocmask(SIG_SETMASK, &all, &mask); /* until each is ready for them */
    signal(SIGCHLD, SIG_DFL);              /* if it were ignored, there would be no end to see */
    watched = fork();
    if (watched > 0) watcher_run(&mask);
    if (watched == 0) orphan_listen();
    sigprocmask(SIG_SETMASK, &mask, NULL);
}

void watch_set_rank(int rank, int size)
{
    if (!place) return;
    place->rank = rank;
    place->size = size;
    if (watched == 0) orphan_prepare();
}
