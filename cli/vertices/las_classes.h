/* las_classes.h - the classes of LAS points, by name or number. */
#ifndef MW_CLI_VERTICES_LAS_CLASSES_H
#define MW_CLI_VERTICES_LAS_CLASSES_H

#include <stdint.h>

/* Set classes[c] to 1 for each class c of a list: "ground", or "2,9". Returns 0, or END_USAGE after
 * a complaint. */
int las_classes_parse(const char *list, uint8_t classes[256]);

#endif
