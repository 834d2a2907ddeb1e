/* posix.h - what the code needs of POSIX.1-2008, beyond C17. Private.
 *
 * Nothing else in src/ and cli/ includes a header of POSIX, and each function that they use is
 * named here: the test `posix` compares both with the code and with what was built.
 * docs/porting.md tells what would stand in for them elsewhere. Web builds have their own
 * <pthread.h>, <dlfcn.h> and <sys/mman.h> (web/platform), and neither processes nor signals.
 *
 * Functions with a star are no part of POSIX; files that use them define _GNU_SOURCE. These
 * constants are no part of POSIX either, and the code works without them: O_TMPFILE (output.c),
 * MADV_HUGEPAGE (base.c), _SC_LEVEL2_CACHE_SIZE and _SC_LEVEL3_CACHE_SIZE (cache.c). */
#ifndef MW_SRC_BASE_POSIX_H
#define MW_SRC_BASE_POSIX_H

/* Files: open(), fcntl(), fstat(), stat(), fchmod(), access(), close(), dup2(), isatty(), linkat(),
 * mkdir(), read(), readlink(), rmdir(), unlink(), write(), opendir(), readdir(), closedir(). In
 * <stdlib.h>: realpath(), mkdtemp(), mkstemps()*. */
#include <dirent.h>
#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

/* Memory, and files mapped into it: mmap(), munmap(), madvise()*. */
#include <sys/mman.h>

/* Texts: strcasecmp(), strncasecmp(). In <string.h>: strdup(), strndup(), strerror_r(); in
 * <locale.h>: newlocale(), freelocale(); in <stdlib.h>: strtod_l()*. */
#include <strings.h>

/* Time: clock_gettime(), clock_getcpuclockid(). */
#include <time.h>

/* Threads: pthread_create(), pthread_join(), pthread_detach(), pthread_mutex_init(),
 * pthread_mutex_destroy(), pthread_mutex_lock(), pthread_mutex_unlock(), pthread_cond_init(),
 * pthread_cond_destroy(), pthread_cond_wait(), pthread_cond_broadcast(). How many processors:
 * sysconf(), sched_getaffinity()*. */
#include <pthread.h>
#include <sched.h>

/* Libraries loaded while the program runs: dlopen(), dlsym(), dlclose(). */
#include <dlfcn.h>

/* Processes and signals: fork(), _exit(), getpid(), kill(), waitpid(), setrlimit(), pipe(), poll(),
 * sigaction(), sigemptyset(), sigfillset(), sigaddset(), sigwait(), pthread_sigmask(), pause(). */
#ifndef __wasi__
#include <poll.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/wait.h>
#endif

#endif
