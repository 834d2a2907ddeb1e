/* outputs.h - files that a command writes beside its main output, which appear when all of it is done. */
#ifndef CLI_OUTPUTS_H
#define CLI_OUTPUTS_H

#include <meshwalk/meshwalk.h>
#include <stdbool.h>

typedef struct output_file {
    const char *option; /* that names it: "log" */
    const char *path;   /* NULL: not asked for */
    mw_output *out;     /* NULL: not open */
} output_file;

/* Refuse one that is an input, the main output or another one of them. Returns 0 or END_USAGE after a complaint. */
int outputs_check(const output_file *files, size_t count, const char *main_output, const char *const *inputs,
                  int input_count);

/* Open those that are asked for, of at most MOST_TEMPORARIES; close them in any case. Each returns 0 or an exit code. */
int outputs_open(output_file *files, size_t count);
int outputs_close(output_file *files, size_t count, bool commit);

/* Has a write failed? Closing tells. */
bool outputs_failed(const output_file *files, size_t count);

#endif
