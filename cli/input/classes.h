/* classes.h - classes of LAS points, by name or number. */
#ifndef CLI_CLASSES_H
#define CLI_CLASSES_H

#include <stdint.h>

/* Mark the classes of a list such as "ground" or "2,9". Returns 0, or END_USAGE after a complaint. */
int classes_parse(const char *list, uint8_t classes[256]);

#endif
