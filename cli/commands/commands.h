/* commands.h - the sub-commands of the program. Each has a file of its own in this room. */
#ifndef MW_CLI_COMMANDS_COMMANDS_H
#define MW_CLI_COMMANDS_COMMANDS_H

#include "cli/frame/options.h"

extern const command info_command, check_command, triangulate_command, locate_command,
    sample_command, weights_command, apply_command, profile_command, contours_command,
    raster_command, visible_command, drape_command, volume_command, edit_command, star_command,
    probe_command, walk_command, bench_command, convert_command, prepare_command, view_command;

#endif
