#include "bench/terrain/timed_command.h"
#include "cli/frame/message.h"
#include "cli/frame/monotonic_clock.h"

#include <errno.h>
#include <fcntl.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

bool command_is_there(const char *program)
{
    const char *path = getenv("PATH");
    char name[4096];
    for (const char *p = path ? path : ""; *p;) {
        size_t length = strcspn(p, ":");
        int size = snprintf(name, sizeof name, "%.*s/%s", (int)length, p, program);
        if (size < (int)sizeof name && access(name, X_OK) == 0) return true;
        p += length + (p[length] == ':');
    }
    return false;
}

static void command_exec(const char *folder, const char *const *words)
{
    int log = -1;
    if (chdir(folder) == 0) log = open("log", O_WRONLY | O_CREAT | O_TRUNC, 0600);
    if (log >= 0 && dup2(log, STDOUT_FILENO) >= 0 && dup2(log, STDERR_FILENO) >= 0)
        execvp(words[0], (char *const *)(uintptr_t)words);
    _exit(127);
}

/* What the program has told: the first line. */
static int command_fail(const char *folder, const char *program)
{
    char name[4096], line[200] = "";
    snprintf(name, sizeof name, "%s/log", folder);
    FILE *log = fopen(name, "r");
    if (log && !fgets(line, sizeof line, log)) *line = 0;
    if (log) fclose(log);
    line[strcspn(line, "\n")] = 0;
    complain("bench terrain: '%s' has failed: %s", program, line);
    return END_RESOURCE;
}

static double seconds_of(struct timeval t)
{
    return (double)t.tv_sec + 1e-6 * (double)t.tv_usec;
}

int command_run(const char *folder, const char *const *words, command_time *time)
{
    struct rusage usage;
    int status;
    double begin = monotonic_seconds();
    pid_t child = fork();
    if (child == 0) command_exec(folder, words);
    while (child > 0 && wait4(child, &status, 0, &usage) < 0)
        if (errno != EINTR) child = -1;
    if (child < 0 || !WIFEXITED(status) || WEXITSTATUS(status) != 0)
        return command_fail(folder, words[0]);
    *time = (command_time){monotonic_seconds() - begin,
                           seconds_of(usage.ru_utime) + seconds_of(usage.ru_stime)};
    return 0;
}
