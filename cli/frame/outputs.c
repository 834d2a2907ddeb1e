#include "cli/frame/outputs.h"
#include "cli/frame/files.h"
#include "cli/frame/message.h"
#include "cli/frame/signals.h"

#include <stdio.h>

static bool is_same(const char *one, const char *other)
{
    if (files_is_stream(one) && files_is_stream(other)) return true;
    return files_same_output(one, other);
}

int outputs_check(const output_file *files, size_t count, const char *main_output, const char *const *inputs,
                  int input_count)
{
    for (size_t i = 0; i < count; i++) {
        if (!files[i].path) continue;
        int end = files_check(files[i].path, inputs, input_count);
        if (end) return end;
        const char *other = is_same(files[i].path, main_output) ? "output" : NULL;
        for (size_t k = 0; k < i && !other; k++)
            if (files[k].path && is_same(files[i].path, files[k].path)) other = files[k].option;
        if (!other) continue;
        complain("--%s and --%s cannot both go to %s", other, files[i].option,
                 files_is_stream(files[i].path) ? "standard output" : files[i].path);
        return END_USAGE;
    }
    return 0;
}

int outputs_open(output_file *files, size_t count)
{
    mw_error error;
    signals_remove(NULL);
    for (size_t i = 0; i < count; i++) {
        if (!files[i].path) continue;
        if (mw_output_open(files[i].path, &files[i].out, &error) != MW_OK) return fail_writing(&error);
        signals_remove_too(mw_output_temporary(files[i].out));
    }
    return 0;
}

int outputs_close(output_file *files, size_t count, bool commit)
{
    mw_error error;
    int end = 0;
    for (size_t i = 0; i < count; i++) {
        if (mw_output_close(files[i].out, commit && end == 0, &error) != MW_OK) end = fail_writing(&error);
        files[i].out = NULL;
    }
    signals_remove(NULL);
    return end;
}

bool outputs_failed(const output_file *files, size_t count)
{
    for (size_t i = 0; i < count; i++)
        if (files[i].out && mw_output_failed(files[i].out)) return true;
    return false;
}
