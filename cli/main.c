/* meshwalk - the program. Runs the sub-command that the first argument names. */
#include "cli/commands/commands.h"
#include "cli/frame/files.h"
#include "cli/frame/help.h"
#include "cli/frame/message.h"
#include "cli/frame/program.h"
#include "cli/frame/spelling.h"
#include "cli/gdal/gdal_library.h"
#include "cli/version.h"
#include "src/base/posix.h"

#include <string.h>

static const command *const commands[] = {
    &info_command,    &check_command, &triangulate_command, &locate_command,   &sample_command,
    &weights_command, &apply_command, &profile_command,     &contours_command, &raster_command,
    &visible_command, &drape_command, &volume_command,      &edit_command,     &star_command,
    &probe_command,   &walk_command,  &bench_command,       &convert_command,  &prepare_command,
    &view_command,
};
#define COMMAND_COUNT (sizeof commands / sizeof *commands)

static int main_print_help(void)
{
    text t = {0};
    text_string(&t, "meshwalk - point location in triangle meshes by walking\n\n"
                    "usage: meshwalk COMMAND [options] FILES\n\ncommands:\n");
    for (size_t i = 0; i < COMMAND_COUNT; i++) {
        text_printf(&t, "  %-12s %s\n", commands[i]->name, commands[i]->summary);
        text_printf(&t, "  %-12s   meshwalk %s [options] %s\n", "", commands[i]->name,
                    commands[i]->operands);
    }
    text_string(
        &t, "\noptions:\n"
            "      --help            print this help; 'meshwalk COMMAND --help' describes a "
            "command,\n"
            "                        'meshwalk COMMAND --help all' all its options\n"
            "      --version         print the version, what is built in and what was found\n\n");
    help_wrap(
        &t,
        "Meshes: Triangle .node/.ele, OFF, OBJ, PLY, STL, fort.14, .gr3, .2dm, Selafin, Gmsh .msh, "
        "VTK, VTU, SU2, .npz, netCDF (UGRID and ocean models), prepared .mwm. Points: text with "
        "columns, LAS. Constraints: GeoJSON, Triangle .poly. Each also gzipped; '-' is standard "
        "input or output.",
        0);
    help_wrap(
        &t,
        "Exit codes: 0 done; 1 done, but points have no answer and --strict was given, or check "
        "--fix left "
        "defects; 2 wrong usage; 3 "
        "input unreadable or invalid; 4 out of memory, a limit, or output that cannot be written.",
        0);
    return files_write_text(NULL, &t);
}

static int main_print_version(void)
{
    text t = {0};
    version_write(&t);
    return files_write_text(NULL, &t);
}

static int main_unknown_command(const char *word)
{
    spelling s = spelling_of(word);
    for (size_t i = 0; i < COMMAND_COUNT; i++) spelling_try(&s, commands[i]->name);
    spelling_try(&s, "--help");
    spelling_try(&s, "--version");
    spelling_complain(&s, *word == '-' ? "option" : "command", "");
    return END_USAGE;
}

/* 'help', 'help COMMAND' and 'help COMMAND all': as other programs have it. */
static int main_help(char **words)
{
    char wanted[] = "--help", *arguments[] = {wanted, words[0] ? words[1] : NULL, NULL};
    if (!words[0]) return main_print_help();
    const command *c = program_find(commands, COMMAND_COUNT, words[0]);
    return c ? program_run(c, arguments) : main_unknown_command(words[0]);
}

/* Open closed standard streams on /dev/null. Else the next file that is opened would take the
 * number of one, and output or messages would go into that file. They are opened the wrong way
 * round: to read or to write the stream is an error, as it is where it is closed. */
static void standard_streams_fill(void)
{
    for (int fd = STDIN_FILENO; fd <= STDERR_FILENO; fd++)
        if (fcntl(fd, F_GETFD) == -1 &&
            open("/dev/null", fd == STDIN_FILENO ? O_WRONLY : O_RDONLY) != fd)
            return;
}

static int main_run_arguments(int count, char **arguments)
{
    if (count < 2) {
        complain("which command? 'meshwalk --help' lists them");
        return END_USAGE;
    }
    const char *word = arguments[1];
    if (strcmp(word, "--help") == 0 || strcmp(word, "-h") == 0) return main_print_help();
    if (strcmp(word, "--version") == 0) return main_print_version();
    if (strcmp(word, "help") == 0) return main_help(arguments + 2);
    const command *c = program_find(commands, COMMAND_COUNT, word);
    return c ? program_run(c, arguments + 2) : main_unknown_command(word);
}

int main(int count, char **arguments)
{
    standard_streams_fill();
    signal(SIGPIPE, SIG_IGN); /* a closed pipe is then an error of the output */
    int end = main_run_arguments(count, arguments);
    gdal_library_end();
    return end;
}
