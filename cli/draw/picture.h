/* picture.h - pictures in files, drawn with Cairo: SVG, PNG or PDF by the ending of the name. */
#ifndef MW_CLI_DRAW_PICTURE_H
#define MW_CLI_DRAW_PICTURE_H

#include <stdbool.h>

/* Is the ending that of a picture? */
bool picture_named(const char *path);

/* Complain if the program was built without Cairo. Returns 0 or an exit code. */
int picture_check(const char *path);

struct _cairo; /* Cairo's cairo_t */

/* Draw the content of a white page. The origin is its upper left corner; the unit is a point. */
typedef void picture_draw(struct _cairo *c, const void *self);

/* Draw a picture and write it. The file appears under its name when it is complete. Returns 0, or
 * an exit code after a complaint. */
int picture_write(const char *path, double width, double height, picture_draw *draw,
                  const void *self);

#endif
