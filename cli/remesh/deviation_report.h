/* deviation_report.h - how far a remeshed surface is from the given one, as a report. */
#ifndef MW_CLI_REMESH_DEVIATION_REPORT_H
#define MW_CLI_REMESH_DEVIATION_REPORT_H

#include "cli/frame/options.h"

#include <meshwalk/meshwalk.h>

/* Measure both ways and print the report on standard error. Returns 0, or an exit code after a
 * complaint. */
int deviation_report_print(const mw_surface *given, const mw_surface *made,
                           const common_settings *common, bool json);

#endif
