/* plot.h - plots of measured figures: curves over numbers of vertices, and bars. */
#ifndef MW_CLI_DRAW_PLOT_H
#define MW_CLI_DRAW_PLOT_H

#include <stdbool.h>
#include <stddef.h>

#define PLOT_CURVES 8
#define PLOT_POINTS 8

/* A figure that was measured, and the published one beside it; NaN: there is none. */
typedef struct plot_point {
    double x, ours, published;
} plot_point;

typedef struct plot_curve {
    plot_point point[PLOT_POINTS];
    size_t count;
} plot_curve;

/* A panel shows curves; or bars, if every curve has one point. */
typedef struct plot_panel {
    const char *title;
    plot_curve curve[PLOT_CURVES];
} plot_panel;

typedef struct plot {
    const char *title, *x_label, *y_label;
    bool log_y;
    const char *name[PLOT_CURVES];  /* of each curve, in the legend */
    const char *label[PLOT_CURVES]; /* of each curve, below its bar */
    size_t curves;
    const plot_panel *panels;
    size_t count; /* of the panels */
} plot;

/* Complain if the ending is not that of a picture, or the program was built without Cairo. Returns
 * 0 or an exit code. */
int plot_check(const char *path);

/* Draw a plot and write it. The file appears under its name when it is complete. Returns 0, or an
 * exit code after a complaint. */
int plot_write(const plot *p, const char *path);

#endif
