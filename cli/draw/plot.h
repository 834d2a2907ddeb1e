/* plot.h - pictures of figures: curves over numbers of vertices, and bars. */
#ifndef CLI_PLOT_H
#define CLI_PLOT_H

#include <stdbool.h>
#include <stddef.h>

#define PLOT_CURVES 8
#define PLOT_POINTS 8

/* What is measured, and what is published; NaN: none. */
typedef struct plot_point {
    double x, ours, published;
} plot_point;

typedef struct plot_curve {
    plot_point point[PLOT_POINTS];
    size_t count;
} plot_curve;

/* A panel with curves; or, where all of them have one point, with bars. */
typedef struct plot_panel {
    const char *title;
    plot_curve curve[PLOT_CURVES];
} plot_panel;

typedef struct plot {
    const char *title, *x_label, *y_label;
    bool log_y;
    const char *name[PLOT_CURVES], *label[PLOT_CURVES]; /* of the curves: in the legend, and below a bar */
    size_t curves;
    const plot_panel *panels;
    size_t count;
} plot;

/* Can such a file be made? Complains if its ending is not known, or the program was built without Cairo. */
int plot_check(const char *path);

/* Returns 0 or an exit code, after a complaint. The file appears under its name when it is complete. */
int plot_write(const plot *p, const char *path);

#endif
