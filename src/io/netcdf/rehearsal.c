#include "io/netcdf/rehearsal.h"
#include "base/posix.h"

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
#include <stddef.h>

/* Seconds of processor time that a child may use; and seconds on the clock that it may be idle. */
enum { PROCESSOR_SECONDS = 5, IDLE_SECONDS = 3 };

/* The child must not run the host's signal handlers or write a core file. */
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

/* A descriptor above the standard streams: the host may have closed those, and the child uses them.
 */
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

/* How long the child has had the processor; negative: not known. */
static double rehearsal_seconds(const mw_rehearsal *r)
{
    clockid_t clock;
    struct timespec used;
    if (clock_getcpuclockid(r->child, &clock) || clock_gettime(clock, &used)) return -1;
    return (double)used.tv_sec + 1e-9 * (double)used.tv_nsec;
}

/* Wait until the child reports or ends; false if it is idle. */
static bool rehearsal_wait(const mw_rehearsal *r)
{
    struct pollfd end = {.fd = r->pipe, .events = POLLIN};
    double before = -1;
    for (int idle = 0; idle < IDLE_SECONDS; idle++) {
        const int ready = poll(&end, 1, 1000);
        if (ready > 0) return true;
        const double now = rehearsal_seconds(r);
        if (ready < 0 || now > before) idle = -1; /* interrupted, or at work */
        before = now;
    }
    return false;
}

bool mw__rehearsal_end(mw_rehearsal *r)
{
    char byte;
    const bool idle = !rehearsal_wait(r), performed = !idle && read(r->pipe, &byte, 1) == 1;
    if (!performed) kill(r->child, SIGKILL);
    close(r->pipe);
    while (waitpid(r->child, NULL, 0) < 0 && errno == EINTR) continue;
    return performed || idle;
}

#endif
