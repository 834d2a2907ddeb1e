#include "cli/frame/message.h"
#include "cli/frame/progress.h"
#include "cli/frame/signals.h"

#include <errno.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

void complain(const char *format, ...)
{
    char line[2048];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(line, sizeof line, format, arguments);
    va_end(arguments);
    progress_end();
    fprintf(stderr, "meshwalk: %s\n", line);
}

/* The message of an error. A call cancelled by a signal needs no message: the signal ends the
 * program. */
static const char *message_of(const mw_error *error)
{
    if (error->status == MW_CANCELLED) signals_await_end();
    return error->message;
}

static int exit_code_of(mw_status status)
{
    switch (status) {
    case MW_ERROR_ARGUMENT: return END_USAGE;
    case MW_ERROR_MEMORY:
    case MW_ERROR_LIMIT: return END_RESOURCE;
    default: return END_INPUT;
    }
}

int fail_reading(const mw_error *error)
{
    complain("%s", message_of(error));
    return exit_code_of(error->status);
}

/* The last place that was noted. */
static struct {
    char path[512], sentence[512];
    int64_t triangle;
} noted = {.triangle = -1};

void message_note_place(const char *path, size_t triangle, const char *sentence)
{
    snprintf(noted.path, sizeof noted.path, "%s", path);
    snprintf(noted.sentence, sizeof noted.sentence, "%s", sentence);
    noted.triangle = (int64_t)triangle;
}

int fail_mesh(const char *path, const mw_error *error)
{
    complain("%s: %s", path, message_of(error));
    if (noted.triangle >= 0 && error->triangle == noted.triangle && strcmp(path, noted.path) == 0)
        complain("%s", noted.sentence);
    return exit_code_of(error->status);
}

int fail_query(const mw_error *error)
{
    complain("%s", message_of(error));
    return error->status == MW_ERROR_ARGUMENT ? END_USAGE : END_RESOURCE;
}

/* A closed pipe needs no message: its reader has chosen to stop. */
static int is_closed_pipe(const mw_error *error)
{
    const char *text = strerror(EPIPE);
    size_t all = strlen(error->message), end = strlen(text);
    return all >= end && strcmp(error->message + all - end, text) == 0;
}

int fail_writing(const mw_error *error)
{
    if (!is_closed_pipe(error)) complain("%s", message_of(error));
    return error->status == MW_ERROR_ARGUMENT ? END_USAGE : END_RESOURCE;
}

int fail_memory(void)
{
    complain("out of memory");
    return END_RESOURCE;
}
