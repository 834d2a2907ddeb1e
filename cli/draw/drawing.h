/* drawing.h - a picture of a walk: its triangles, the first and the last of them marked, and the
 * mesh near it. */
#ifndef MW_CLI_DRAW_DRAWING_H
#define MW_CLI_DRAW_DRAWING_H

#include "cli/draw/drawing_content.h"

/* Returns 0 or an exit code, after a complaint. */
int drawing_write(const drawing *d, const char *path);

/* Several on one sheet, in rows. */
int drawing_write_sheet(const drawing *d, size_t count, const char *path);

/* One step by step, as an animated PNG. */
int drawing_write_animation(const drawing *d, const char *path);

/* Several side by side, step by step, with the numbers of triangles visited so far: small, as an
 * animated PNG. It shows at most three times as many steps as the median walk takes. */
int drawing_write_race(const drawing *d, size_t count, const char *path);

#endif
