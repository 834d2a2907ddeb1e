/* gdal_directory.h - what GDAL writes gets its name when it is complete.
 *
 * GDAL writes into a directory beside the file, so that a file of that name stays until the new one
 * is complete: some formats have several files. */
#ifndef MW_CLI_GDAL_GDAL_DIRECTORY_H
#define MW_CLI_GDAL_GDAL_DIRECTORY_H

#include <stdbool.h>

typedef struct gdal_directory {
    char *path;      /* of the file; a link is followed */
    char *directory; /* beside it */
    char *temporary; /* of the file in it, with the same name */
} gdal_directory;

/* Refuse a path that cannot be written, before anything is read. A finished file takes the place of
 * what has its name: of a file, but not of a device. Returns 0, or an exit code after a complaint.
 */
int gdal_directory_check(const char *path);

/* Returns 0, or an exit code after a complaint. Close it in both cases. */
int gdal_directory_open(gdal_directory *d, const char *path);

/* If `commit`, give the files their names; remove the directory. Returns 0, or an exit code after a
 * complaint. */
int gdal_directory_close(gdal_directory *d, bool commit);

#endif
