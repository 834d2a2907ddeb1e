/* meshwalk - the program. Picks the sub-command; each has a file of its own. */
#include "cli/commands/commands.h"
#include "cli/frame/files.h"
#include "cli/frame/message.h"
#include "cli/frame/progress.h"
#include "cli/frame/signals.h"
#include "cli/frame/spelling.h"

#include <fcntl.h>
#include <signal.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

static const command *const commands[] = {
    &info_command, &check_command, &triangulate_command, &locate_command, &sample_command,
    &edit_command, &star_command,  &probe_command,       &walk_command,   &bench_command,
};
#define COMMAND_COUNT (sizeof commands / sizeof *commands)

static int print_help(void)
{
    text t = {0};
    text_string(&t, "meshwalk - point location in triangle meshes by walking\n\n"
                    "usage: meshwalk COMMAND [options] FILES\n\ncommands:\n");
    for (size_t i = 0; i < COMMAND_COUNT; i++) {
        text_printf(&t, "  %-12s %s\n", commands[i]->name, commands[i]->summary);
        text_printf(&t, "  %-12s   meshwalk %s [options] %s\n", "", commands[i]->name, commands[i]->operands);
    }
    text_string(&t, "\noptions:\n"
                    "      --help            print this help; 'meshwalk COMMAND --help' tells about a command\n"
                    "      --version         print the version\n\n");
    options_wrap(
        &t,
        "Meshes: Triangle .node/.ele, OFF, OBJ, PLY, STL. Points: text with columns, LAS. Constraints: GeoJSON, "
        "Triangle .poly. Each also gzipped; '-' is standard input or output.",
        0);
    options_wrap(&t,
                 "Exit codes: 0 done; 1 done, but points have no answer and --strict was given; 2 wrong usage; 3 "
                 "input unreadable or invalid; 4 out of memory, a limit, or output that cannot be written.",
                 0);
    return files_write_text(NULL, &t);
}

static int print_version(void)
{
    text t = {0};
    text_printf(&t, "meshwalk %s\n", mw_version());
    return files_write_text(NULL, &t);
}

static int print_command_help(const command *c)
{
    text t = {0};
    options_help(&t, c);
    return files_write_text(NULL, &t);
}

#define MOST_THREADS 256 /* a system refuses threads without bound, and OpenMP would end the program */

static int run_command(const command *c, int count, char **arguments)
{
    const char *operands[MOST_OPERANDS] = {0};
    void *settings = calloc(1, c->settings_size);
    if (!settings) return fail_memory();
    int end = options_parse(c, count, arguments, settings, operands);
    const common_settings *common = settings;
    if (end == 0 && common->help) {
        end = print_command_help(c);
    } else if (end == 0 && common->threads > MOST_THREADS) {
        complain("option '--threads' wants at most %d", MOST_THREADS);
        end = END_USAGE;
    } else if (end == 0) {
        signals_begin();
        progress_begin(common->quiet);
        end = c->run(settings, operands);
        progress_end();
    }
    free(settings);
    return end;
}

static int unknown_command(const char *word)
{
    spelling s = spelling_of(word);
    for (size_t i = 0; i < COMMAND_COUNT; i++) spelling_try(&s, commands[i]->name);
    spelling_try(&s, "--help");
    spelling_try(&s, "--version");
    spelling_complain(&s, *word == '-' ? "option" : "command", "");
    return END_USAGE;
}

/* Were a standard stream closed, the next file opened would take its number, and the output would go into it. */
static void fill_standard_streams(void)
{
    for (int fd = STDIN_FILENO; fd <= STDERR_FILENO; fd++)
        if (fcntl(fd, F_GETFD) == -1 && open("/dev/null", fd == STDERR_FILENO ? O_WRONLY : O_RDONLY) != fd) return;
}

/* OpenMP ends a program that cannot get its threads with 1, which means something else here. */
static bool returned;
static void end_by_limit(void)
{
    if (returned) return;
    signals_clean();
    _exit(END_INTERNAL);
}

static int run_word(int count, char **arguments)
{
    if (count < 2) {
        complain("which command? 'meshwalk --help' lists them");
        return END_USAGE;
    }
    const char *word = arguments[1];
    if (strcmp(word, "--help") == 0 || strcmp(word, "-h") == 0) return print_help();
    if (strcmp(word, "--version") == 0) return print_version();
    for (size_t i = 0; i < COMMAND_COUNT; i++)
        if (strcmp(commands[i]->name, word) == 0) return run_command(commands[i], count - 2, arguments + 2);
    return unknown_command(word);
}

int main(int count, char **arguments)
{
    fill_standard_streams();
    signal(SIGPIPE, SIG_IGN); /* a closed pipe is an error of the output like any other */
    if (atexit(end_by_limit) != 0) return fail_memory();
    int end = run_word(count, arguments);
    returned = true;
    return end;
}
