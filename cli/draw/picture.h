/* picture.h - pictures as files: SVG, PNG or PDF, as the ending of the name says. Drawn with Cairo. */
#ifndef CLI_PICTURE_H
#define CLI_PICTURE_H

#include <stdbool.h>

/* Is it the name of a picture, by its ending? */
bool picture_named(const char *path);

/* Can this program draw? Complains if it was built without Cairo. Returns 0 or an exit code. */
int picture_check(const char *path);

struct _cairo; /* Cairo's cairo_t */

/* Draw on a page whose origin is its upper left corner; measures are points. The page is white. */
typedef void picture_draw(struct _cairo *c, const void *self);

/* Returns 0 or an exit code, after a complaint. The file appears under its name when it is complete. */
int picture_write(const char *path, double width, double height, picture_draw *draw, const void *self);

#endif
