/* locate.h - the options of the commands `locate` of meshwalk and meshwalk-mpi. */
#ifndef MW_CLI_COMMANDS_LOCATE_H
#define MW_CLI_COMMANDS_LOCATE_H

#include "cli/frame/options.h"
#include "cli/stream/polygon_query.h"

typedef struct locate_settings {
    point_query_settings query;
    polygon_file_settings polygons;
    int base; /* number of the name of --base */
    bool details;
} locate_settings;

/* The options, for locate_settings. */
extern const option *const locate_option_tables[];

#endif
