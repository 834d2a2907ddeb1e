/* prj_output.h - the coordinate system of a file that cannot hold it: a .prj file beside. */
#ifndef MW_CLI_OUTPUT_PRJ_OUTPUT_H
#define MW_CLI_OUTPUT_PRJ_OUTPUT_H

#include <stdbool.h>

/* Find out before an output is written whether its system can stand beside it. A .prj file there
 * that names another system is replaced if the output is, too; else it belongs to another file of
 * the same stem, and that is an error. A system that is not known gets a warning then.
 *   output  standard output, or a device, has nothing beside it
 *   crs     NULL: not known
 * Returns 0, or an exit code after a complaint. */
int prj_output_check(const char *output, const char *crs, bool quiet);

/* Write the .prj file, if the system is known and stands in none yet; the check has been made.
 * Returns 0, or an exit code after a complaint. */
int prj_output_write(const char *output, const char *crs, bool quiet);

#endif
