/* side_outputs.h - files that a command writes beside its main output. All of them appear when all
 * are complete. */
#ifndef MW_CLI_OUTPUT_SIDE_OUTPUTS_H
#define MW_CLI_OUTPUT_SIDE_OUTPUTS_H

#include <meshwalk/meshwalk.h>
#include <stdbool.h>

typedef struct side_output {
    const char *option; /* its option, for messages: "log" */
    const char *path;   /* NULL: not requested */
    mw_output *out;     /* NULL: not open */
} side_output;

/* Refuse a side output that is an input, the main output or another side output. Returns 0, or
 * END_USAGE after a complaint. */
int side_outputs_check(const side_output *files, size_t count, const char *main_output,
                       const char *const *inputs, int input_count);

/* Open the requested ones, at most MAX_TEMPORARIES; close them also if opening failed. Both return
 * 0, or an exit code after a complaint. */
int side_outputs_open(side_output *files, size_t count);
int side_outputs_close(side_output *files, size_t count, bool commit);

/* Has a write failed? Closing then reports the error. */
bool side_outputs_failed(const side_output *files, size_t count);

#endif
