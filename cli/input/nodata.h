/* nodata.h - numbers that stand for missing values of vertices. */
#ifndef MW_CLI_INPUT_NODATA_H
#define MW_CLI_INPUT_NODATA_H

#include <stdbool.h>
#include <stddef.h>

/* Which number means that a value is missing. NaN always does. */
typedef struct nodata_rule {
    const char *place, *places; /* what has values; NULL: vertex, vertices */
    const char *option;         /* that tells it, without --; for messages */
    double value;
    bool given; /* by the option; else the number is that of ADCIRC, -99999 */
    bool none;  /* no number does */
} nodata_rule;

/* Take the argument of an option: a number, "none", or NULL if it was not given. Returns 0, or
 * END_USAGE after a complaint. */
int nodata_parse(const char *option, const char *argument, nodata_rule *rule);

/* Copy a value for each vertex (or triangle), with NaN in place of the number that means that it
 * is missing; a float of that number is meant, too. Tells on standard error, unless `quiet`, which
 * values are taken for missing without the option, and which look as if they were meant so. Returns
 * the copy, for free(); NULL if memory runs out. */
double *nodata_copy(const double *values, size_t stride, size_t count, const nodata_rule *rule,
                    const char *path, const char *field, bool quiet);

#endif
