/* prj_output.h - the coordinate system of a file that cannot hold it: a .prj file beside. */
#ifndef MW_CLI_OUTPUT_PRJ_OUTPUT_H
#define MW_CLI_OUTPUT_PRJ_OUTPUT_H

#include <stdbool.h>

/* Check before an output is written whether a .prj file with its system can be written. An existing
 * .prj file with another system is replaced if it belongs to an older output of the same name. If
 * it belongs to another file, that is an error; if our system is unknown, a warning.
 *   output  standard output, or a device, has nothing beside it
 *   crs     NULL: unknown
 * Returns 0, or an exit code after a complaint. */
int prj_output_check(const char *output, const char *crs, bool quiet);

/* Write the .prj file, if the system is known and stands in none yet; the check has been made.
 * Returns 0, or an exit code after a complaint. */
int prj_output_write(const char *output, const char *crs, bool quiet);

#endif
