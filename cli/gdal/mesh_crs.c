#include "cli/gdal/mesh_crs.h"
#include "cli/frame/files.h"
#include "cli/frame/message.h"
#include "cli/gdal/gdal_crs.h"

#include <string.h>

int mesh_crs_settle(const char *path, const char *option, const char *of_file, bool quiet,
                    char **crs)
{
    char names[2][CRS_NAME];
    const char *name = files_is_standard(path) ? "standard input" : path;
    const char *chosen = option ? option : of_file;
    *crs = NULL;
    if (option && of_file && !quiet && !crs_same(option, of_file))
        complain("%s: warning: its file says that it is in %s, but --crs says %s, which is used",
                 name, crs_name(of_file, names[0]), crs_name(option, names[1]));
    if (!option && of_file && !crs_known(of_file)) {
        if (!quiet)
            complain("%s: warning: its coordinate system is not understood: %.200s", name, of_file);
        chosen = NULL;
    }
    if (!chosen) return 0;
    *crs = strdup(chosen);
    return *crs ? 0 : fail_memory();
}
