/* mesh_crs.h - the coordinate system of a file, by an option or by what the file tells. */
#ifndef MW_CLI_GDAL_MESH_CRS_H
#define MW_CLI_GDAL_MESH_CRS_H

#include <stdbool.h>

/* Choose the system of the file `path`: that of the option --crs, or else the one that the file
 * names. Warns if they differ, or if the file's system is not understood and so counts as unknown.
 * *crs is NULL or freed by the caller. Returns 0, or an exit code after a complaint. */
int mesh_crs_settle(const char *path, const char *option, const char *of_file, bool quiet,
                    char **crs);

#endif
