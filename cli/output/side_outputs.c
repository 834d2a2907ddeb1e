#include "cli/output/side_outputs.h"
#include "cli/frame/files.h"
#include "cli/frame/message.h"
#include "cli/frame/signals.h"

#include <stdio.h>

static bool side_output_is_same(const char *one, const char *other)
{
    if (files_is_standard(one) && files_is_standard(other)) return true;
    return files_same_output(one, other);
}

int side_outputs_check(const side_output *files, size_t count, const char *main_output,
                       const char *const *inputs, int input_count)
{
    for (size_t i = 0; i < count; i++) {
        if (!files[i].path) continue;
        int end = files_check_output(files[i].path, inputs, input_count);
        if (end) return end;
        const char *other = side_output_is_same(files[i].path, main_output) ? "output" : NULL;
        for (size_t k = 0; k < i && !other; k++)
            if (files[k].path && side_output_is_same(files[i].path, files[k].path))
                other = files[k].option;
        if (!other) continue;
        complain("--%s and --%s cannot both go to %s", other, files[i].option,
                 files_is_standard(files[i].path) ? "standard output" : files[i].path);
        return END_USAGE;
    }
    return 0;
}

int side_outputs_open(side_output *files, size_t count)
{
    mw_error error;
    signals_set_temporary(NULL);
    for (size_t i = 0; i < count; i++) {
        if (!files[i].path) continue;
        if (mw_output_open(files[i].path, &files[i].out, &error) != MW_OK)
            return fail_writing(&error);
        signals_add_temporary(mw_output_temporary(files[i].out));
    }
    return 0;
}

int side_outputs_close(side_output *files, size_t count, bool commit)
{
    mw_error error;
    int end = 0;
    for (size_t i = 0; i < count; i++) {
        if (mw_output_close(files[i].out, commit && end == 0, &error) != MW_OK)
            end = fail_writing(&error);
        files[i].out = NULL;
    }
    signals_set_temporary(NULL);
    return end;
}

bool side_outputs_failed(const side_output *files, size_t count)
{
    for (size_t i = 0; i < count; i++)
        if (files[i].out && mw_output_failed(files[i].out)) return true;
    return false;
}
