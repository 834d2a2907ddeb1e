/* polygon_file.h - a file of polygons, ready for queries: its features, and their attributes. */
#ifndef MW_CLI_CONSTRAINTS_POLYGON_FILE_H
#define MW_CLI_CONSTRAINTS_POLYGON_FILE_H

#include "cli/frame/options.h"
#include "cli/frame/report.h"
#include "cli/constraints/feature_values.h"

#include <meshwalk/meshwalk.h>

typedef struct polygon_file_settings {
    const char *path;
    const char *attribute; /* names, or NULL */
    const char *layer;     /* NULL: the only one with polygons */
} polygon_file_settings;

typedef struct polygon_file {
    mw_polygons *polygons;
    uint32_t *feature; /* per polygon: the feature that it belongs to; ascending */
    feature_values values;
    char *crs; /* that the file tells; NULL: not known */
} polygon_file;

/* Read and prepare the polygons. The even-odd rule is applied to each polygon separately, and a
 * feature covers what any of its polygons covers. A .poly is one feature: its domain. Warns of
 * lines, and of features that cross themselves. Returns 0, or an exit code after a complaint;
 * release it in both cases. */
int polygon_file_read(polygon_file *file, const polygon_file_settings *settings,
                      const common_settings *common);
void polygon_file_release(polygon_file *file);

/* A feature that has a point, inside or on its border. */
typedef struct feature_hit {
    uint32_t feature;
    bool border; /* of one of its polygons, and in none of them */
} feature_hit;

/* The features at a point, ascending. They are in `room` if they fit; otherwise in memory *hits
 * that the caller frees. Returns how many; SIZE_MAX if memory runs out. Several threads may call
 * this.
 */
enum { FEATURE_ROOM = 64 };
size_t polygon_file_at(const polygon_file *file, const double point[2], const mw_location *at,
                       feature_hit room[FEATURE_ROOM], feature_hit **hits);

/* Add what was prepared to a report. */
void polygon_file_report(const polygon_file *file, report *r);

#endif
