/* meshwalk-mpi - the program on many machines. Rank 0 runs the sub-command that the first argument
 * names: it reads and writes; the other ranks do what it orders. */
#include "mpi/program/commands.h"
#include "mpi/program/watch.h"

#include "cli/commands/commands.h"
#include "cli/frame/files.h"
#include "cli/frame/message.h"
#include "cli/frame/program.h"
#include "cli/gdal/gdal_library.h"
#include "cli/gdal/library_versions.h"

#include <meshwalk/base.h>
#include <signal.h>
#include <string.h>

/* info says nothing of pieces: rank 0 describes the mesh as the other program does. */
static const command *const commands[] = {&info_command, &locate_pieces_command,
                                          &sample_pieces_command, &weights_pieces_command};
#define COMMAND_COUNT (sizeof commands / sizeof *commands)

static service of_program;

service *program_service(void)
{
    return &of_program;
}

static int main_print_help(void)
{
    text t = {0};
    text_string(&t, "meshwalk-mpi - point location in triangle meshes, by all ranks of mpiexec\n\n"
                    "usage: mpiexec -n RANKS meshwalk-mpi COMMAND [options] FILES\n\ncommands:\n");
    for (size_t i = 0; i < COMMAND_COUNT; i++)
        text_printf(&t, "  %-8s %s\n           meshwalk-mpi %s [options] %s\n", commands[i]->name,
                    commands[i]->summary, commands[i]->name, commands[i]->operands);
    text_string(&t, "\n'meshwalk-mpi COMMAND --help all' tells about its options.\n"
                    "'meshwalk-mpi --version' tells what is built in and what was found.\n");
    return files_write_text(NULL, &t);
}

/* What MPI says of itself may have many lines; the first one names it. */
static int main_print_version(void)
{
    text t = {0};
    char mpi[MPI_MAX_LIBRARY_VERSION_STRING];
    int length;
    MPI_Get_library_version(mpi, &length);
    mpi[strcspn(mpi, ",\n")] = 0;
    for (char *tab = mpi; (tab = strchr(tab, '\t'));) *tab = ' ';
    text_printf(&t, "meshwalk-mpi %s\n", mw_version());
    library_version_line(&t, "MPI", mpi, "");
    library_versions_write(&t);
    return files_write_text(NULL, &t);
}

static int main_run(int count, char **arguments)
{
    const char *word = count < 2 ? "--help" : arguments[1];
    if (strcmp(word, "--help") == 0 || strcmp(word, "-h") == 0) return main_print_help();
    if (strcmp(word, "--version") == 0) return main_print_version();
    const command *c = program_find(commands, COMMAND_COUNT, word);
    if (c) return program_run(c, arguments + 2);
    complain("unknown command '%s'; 'meshwalk-mpi --help' lists them", word);
    return END_USAGE;
}

int main(int count, char **arguments)
{
    mwp_error error;
    int end = END_RESOURCE, given = 0, rank, size;
    signal(SIGPIPE, SIG_IGN); /* a closed pipe is then an error of the output */
    watch_begin();
    MPI_Init_thread(&count, &arguments, MPI_THREAD_FUNNELED, &given);
    MPI_Comm_rank(MPI_COMM_WORLD, &rank);
    MPI_Comm_size(MPI_COMM_WORLD, &size);
    watch_set_rank(rank, size);
    if (service_open(&of_program, &error)) {
        complain("%s", error.message);
    } else if (of_program.wire.rank == 0) {
        end = main_run(count, arguments);
        service_end(&of_program, end);
    } else {
        end = service_run(&of_program);
    }
    service_close(&of_program);
    gdal_library_end();
    MPI_Finalize();
    return end;
}
