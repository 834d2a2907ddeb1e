/* line_file.h - a file of lines: each line's points, in the coordinate system of a mesh. */
#ifndef MW_CLI_LINES_LINE_FILE_H
#define MW_CLI_LINES_LINE_FILE_H

#include "cli/constraints/feature_values.h"
#include "cli/frame/options.h"

typedef struct line_file_settings {
    const char *columns;   /* --columns; NULL: not given */
    const char *layer;     /* --layer */
    const char *attribute; /* --attribute: names; NULL: all */
    const char *crs;       /* --lines-crs; "same": that of the mesh */
} line_file_settings;

typedef struct line_file {
    double *points; /* x, y; no two points of a line that follow each other are equal */
    size_t *first;  /* line i has the points first[i] up to first[i + 1] - 1, at least one */
    uint32_t *feature, *part; /* of each line: its feature of the file, and which of its lines */
    uint32_t *polygon;        /* of each line: the polygon that it is a ring of; MW_NONE: none */
    size_t count;
    feature_values values;   /* of the features; none of a table */
    const char *record_name; /* what `feature` counts: "feature", from 0, or "line", from 1 */
} line_file;

/* Read lines: features of a vector file (rings of polygons, too), segments of a .poly, or the rows
 * of a table of points, which are one line. Points in another system than that of the mesh are
 * transformed; what is not known is told on standard error.
 *   mesh, mesh_crs  the path of the mesh, and its system or NULL
 * Returns 0, or an exit code after a complaint; release it in both cases. */
int line_file_read(line_file *lines, const char *path, const line_file_settings *settings,
                   const common_settings *common, const char *mesh, const char *mesh_crs);
void line_file_release(line_file *lines);

#endif
