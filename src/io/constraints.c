/* constraints.c - reading constraints: not made yet. */
#include "base/base.h"

#include <meshwalk/io.h>

mw_status mw_read_constraints(const char *path, mw_constraint_file *file, mw_error *error)
{
    *file = (mw_constraint_file){0};
    return mw__fail(error, MW_ERROR_INPUT, "%s: not made yet", path);
}

void mw_constraint_file_release(mw_constraint_file *file)
{
    (void)file;
}
