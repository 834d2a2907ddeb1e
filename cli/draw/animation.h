/* animation.h - pictures that follow each other, in a file: animated PNG (APNG, the third edition
 * of PNG), drawn with Cairo. */
#ifndef MW_CLI_DRAW_ANIMATION_H
#define MW_CLI_DRAW_ANIMATION_H

#include <stdbool.h>
#include <stdint.h>

/* Is the ending that of an animation: .png or .apng? */
bool animation_named(const char *path);

struct _cairo; /* Cairo's cairo_t */

typedef struct animation {
    double width, height; /* of each picture, in pixels */
    uint32_t frames;      /* at least 1 */
    /* Draw picture `frame` on a white page. The origin is its upper left corner; the unit is a
     * pixel. */
    void (*draw)(struct _cairo *c, uint32_t frame, void *self);
    uint16_t (*milliseconds)(uint32_t frame, void *self); /* how long it is shown */
    void *self;
} animation;

/* Write the pictures, to be shown again and again. Programs that know plain PNG only show the last
 * one. The file appears under its name when it is complete. Returns 0, or an exit code after a
 * complaint. */
int animation_write(const animation *a, const char *path);

#endif
