#include "cli/output/prj_output.h"
#include "cli/frame/files.h"
#include "cli/frame/message.h"
#include "cli/gdal/gdal_crs.h"
#include "src/base/posix.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Can another file stand beside the output? */
static bool output_has_neighbours(const char *output)
{
    struct stat s;
    return !files_is_standard(output) && (stat(output, &s) != 0 || S_ISREG(s.st_mode));
}

/* The name with another ending. */
static bool output_name_beside(const char *output, const char *ending, char *name, size_t size)
{
    const char *slash = strrchr(output, '/'), *dot = strrchr(output, '.');
    const char *first = slash ? slash + 1 : output;
    int length = dot && dot > first ? (int)(dot - output) : (int)strlen(output);
    return snprintf(name, size, "%.*s%s", length, output, ending) < (int)size;
}

/* Does a .prj file beside the output belong to it? */
static bool output_owns_prj(const char *output)
{
    char shape[4096];
    struct stat s;
    return stat(output, &s) == 0 && output_name_beside(output, ".shp", shape, sizeof shape) &&
           stat(shape, &s) != 0;
}

int prj_output_check(const char *output, const char *crs, bool quiet)
{
    mw_error error;
    char name[4096], names[2][CRS_NAME], *beside = NULL;
    if (!output_has_neighbours(output) || !output_name_beside(output, ".prj", name, sizeof name))
        return 0;
    if (mw_read_prj(output, &beside, &error) != MW_OK) return fail_reading(&error);
    int end = 0;
    if (beside && !crs && !quiet) {
        complain("%s: warning: its coordinate system is not known, and %s beside it says %s",
                 output, name, crs_name(beside, names[0]));
    } else if (beside && crs && !crs_same(beside, crs) && !output_owns_prj(output)) {
        complain("%s: is in %s, but %s, which is there already, says %s: choose another output",
                 output, crs_name(crs, names[0]), name, crs_name(beside, names[1]));
        end = END_RESOURCE;
    }
    free(beside);
    return end;
}

int prj_output_write(const char *output, const char *crs, bool quiet)
{
    mw_error error;
    char name[4096], *beside = NULL;
    if (!crs || !output_has_neighbours(output) ||
        !output_name_beside(output, ".prj", name, sizeof name))
        return 0;
    if (mw_read_prj(output, &beside, &error) != MW_OK) return fail_reading(&error);
    bool same = beside && crs_same(beside, crs);
    free(beside);
    char *wkt = same ? NULL : crs_wkt(crs);
    if (!wkt) {
        if (!same && !quiet)
            complain("%s: remark: its coordinate system, %.60s, is not written beside it: it "
                     "cannot be written as WKT",
                     output, crs);
        return 0;
    }
    text t = {0};
    text_printf(&t, "%s\n", wkt);
    free(wkt);
    return files_write_text(name, &t);
}
