#include "cli/frame/program.h"
#include "cli/frame/files.h"
#include "cli/frame/help.h"
#include "cli/frame/message.h"
#include "cli/frame/progress.h"
#include "cli/frame/signals.h"

#include <stdlib.h>
#include <string.h>

#define MAX_THREADS 256

const command *program_find(const command *const *commands, size_t count, const char *name)
{
    for (size_t i = 0; i < count; i++)
        if (strcmp(commands[i]->name, name) == 0) return commands[i];
    return NULL;
}

static int program_print_help(const command *c, bool all)
{
    text t = {0};
    help_of_command(&t, c, all);
    return files_write_text(NULL, &t);
}

int program_run(const command *c, char **arguments)
{
    const char *operands[MAX_OPERANDS] = {0};
    void *settings = calloc(1, c->settings_size);
    if (!settings) return fail_memory();
    int end = options_parse(c, arguments, settings, operands);
    const common_settings *common = settings;
    if (end == 0 && common->help) {
        end = program_print_help(c, common->help_all);
    } else if (end == 0 && common->threads > MAX_THREADS) {
        complain("option '--threads' must be at most %d", MAX_THREADS);
        end = END_USAGE;
    } else if (end == 0) {
        signals_begin();
        progress_begin(common->quiet);
        files_use_layout(common->layout);
        end = c->run(settings, operands);
        progress_end();
    }
    free(settings);
    return end;
}
