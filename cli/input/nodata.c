#include "cli/input/nodata.h"
#include "cli/frame/message.h"

#include <math.h>
#include <meshwalk/meshwalk.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define ADCIRC_NODATA (-99999.0)

/* Numbers that programs write where there is no value: rasters, the lowest float, and what netCDF
 * fills with. */
static const double suspects[] = {-9999, -32768, -3.4028234663852886e38, 9.969209968386869e36};

int nodata_parse(const char *option, const char *argument, nodata_rule *rule)
{
    char *end;
    *rule = (nodata_rule){.option = option, .value = ADCIRC_NODATA, .given = argument != NULL};
    if (!argument) return 0;
    rule->none = strcmp(argument, "none") == 0;
    if (rule->none) return 0;
    rule->value = strtod(argument, &end);
    if (end != argument && *end == 0) return 0;
    complain("option '--%s' must be a number or none, not '%s'", option, argument);
    return END_USAGE;
}

/* Files often hold the float that is nearest to the number. */
static bool value_is(double value, double number)
{
    return value == number || value == (double)(float)number;
}

static size_t values_count(const double *values, size_t count, double number)
{
    size_t found = 0;
    for (size_t i = 0; i < count; i++) found += value_is(values[i], number);
    return found;
}

static void nodata_remark(const char *path, const char *field, const nodata_rule *rule,
                          size_t found, double number, const char *what)
{
    char digits[32];
    mw_format_double(number, digits);
    complain("%s: remark: %s is %s at %zu %s; --%s %s", path, field, digits, found,
             found == 1 ? (rule->place ? rule->place : "vertex")
                        : (rule->places ? rule->places : "vertices"),
             rule->option, what);
}

static void nodata_remark_suspects(const double *values, size_t count, const nodata_rule *rule,
                                   const char *path, const char *field)
{
    for (size_t i = 0; i < sizeof suspects / sizeof *suspects; i++) {
        size_t found = values_count(values, count, suspects[i]);
        char digits[32], what[96];
        mw_format_double(suspects[i], digits);
        snprintf(what, sizeof what, "%s would treat it as missing", digits);
        if (found > 0) nodata_remark(path, field, rule, found, suspects[i], what);
    }
}

double *nodata_copy(const double *values, size_t stride, size_t count, const nodata_rule *rule,
                    const char *path, const char *field, bool quiet)
{
    double *copy = malloc((count + 1) * sizeof *copy);
    if (!copy) return NULL;
    for (size_t i = 0; i < count; i++) copy[i] = values[i * stride];
    size_t found = rule->none ? 0 : values_count(copy, count, rule->value);
    for (size_t i = 0; found > 0 && i < count; i++)
        if (value_is(copy[i], rule->value)) copy[i] = NAN;
    if (quiet || rule->given) return copy;
    if (found > 0)
        nodata_remark(path, field, rule, found, rule->value,
                      "none would treat it as a value, not as missing");
    nodata_remark_suspects(copy, count, rule, path, field);
    return copy;
}
