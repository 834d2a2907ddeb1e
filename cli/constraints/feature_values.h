/* feature_values.h - the requested attributes of features, as text. */
#ifndef MW_CLI_CONSTRAINTS_FEATURE_VALUES_H
#define MW_CLI_CONSTRAINTS_FEATURE_VALUES_H

#include "cli/frame/text.h"

/* All zero: no attributes. */
typedef struct feature_values {
    /* their names, separated by commas; or one name, which may have commas; NULL: all */
    const char *list;
    char **names;   /* as the file has them                                                 */
    char *kinds;    /* of each: 't' text, 'i' integer, 'r' real                             */
    size_t *fields; /* of each: its number among the attributes of the file                 */
    size_t count;
    text cells;    /* each is ended by NUL; those of a feature follow each other */
    size_t *begin; /* of each cell                                               */
    size_t cell_count, cell_room;
} feature_values;

/* Choose among the `count` attributes of a file by their names. Returns 0, or an exit code after a
 * complaint that lists them. */
int feature_values_choose(feature_values *values, const char *path, const char *const *names,
                          const char *kinds, size_t count);

/* Add the next cell of the next feature. False if memory runs out. */
bool feature_values_add(feature_values *values, const char *cell);

/* Attribute i of a feature. */
const char *feature_values_cell(const feature_values *values, size_t feature, size_t i);

void feature_values_release(feature_values *values);

#endif
