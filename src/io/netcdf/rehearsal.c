#include "io/netcdf/rehearsal.h"

#ifdef __wasi__ /* no processes, and no libnetcdf */

bool mw__rehearsal_begin(mw_rehearsal *r, void (*perform)(void *), void *work)
{
    (void)r;
    (void)perform;
    (void)work;
    return false;
}

bool mw__rehearsal_end(mw_rehearsal *r)
{
    (void)r;
    return true;
}

#else

#include <errno.h>
#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <stddef.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

enum { PROCESSOR_SECONDS = 5, LONGEST_WAIT = 120 * 1000 /* milliseconds, for slow disks */ };

/* The handlers of the host program are not for its child, nor a file with its memory. */
static void rehearsal_be_quiet(void)
{
    static const int fatal[] = {SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT, SIGTRAP, SIGXCPU};
    const struct rlimit none = {0, 0}, seconds = {PROCESSOR_SECONDS, PROCESSOR_SECONDS};
    for (size_t i = 0; i < sizeof fatal / sizeof *fatal; i++) signal(fatal[i], SIG_DFL);
    setrlimit(RLIMIT_CORE, &none);
    setrlimit(RLIMIT_CPU, &seconds);
    const int null = open("/dev/null", O_RDWR);
    if (null < 0) return;
    dup2(null, STDOUT_FILENO);
    dup2(null, STDERR_FILENO);
}

static _Noreturn void rehearsal_perform(int pipe, void (*perform)(void *), void *work)
{
    rehearsal_be_quiet();
    perform(work);
    const ssize_t written = write(pipe, "", 1);
    _exit(written != 1);
}

/* Above the standard streams, which a host may have closed, and the child takes. */
static int rehearsal_lift(int descriptor)
{
    const int higher = fcntl(descriptor, F_DUPFD_CLOEXEC, STDERR_FILENO + 1);
    close(descriptor);
    return higher;
}

bool mw__rehearsal_begin(mw_rehearsal *r, void (*perform)(void *), void *work)
{
    int ends[2];
    if (pipe(ends) != 0) return false;
    for (int k = 0; k < 2; k++) ends[k] = rehearsal_lift(ends[k]);
    r->child = ends[0] < 0 || ends[1] < 0 ? -1 : fork();
    if (r->child == 0) rehearsal_perform(ends[1], perform, work);
    if (ends[1] >= 0) close(ends[1]);
    r->pipe = ends[0];
    if (r->child < 0 && ends[0] >= 0) close(ends[0]);
    return r->child > 0;
}

bool mw__rehearsal_end(mw_rehearsal *r)
{
    struct pollfd end = {.fd = r->pipe, .events = POLLIN};
    char byte;
    int ready;
    do ready = poll(&end, 1, LONGEST_WAIT);
    while (ready < 0 && errno == EINTR);
    const bool performed = ready > 0 && read(r->pipe, &byte, 1) == 1;
    if (!performed) kill(r->child, SIGKILL);
    close(r->pipe);
    while (waitpid(r->child, NULL, 0) < 0 && errno == EINTR) continue;
    return performed;
}

#endif
