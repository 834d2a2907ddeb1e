/* triangle_cut.h - cuts a triangle that has vertices inside its edges. Private. */
#ifndef MW_SRC_MEND_TRIANGLE_CUT_H
#define MW_SRC_MEND_TRIANGLE_CUT_H

#include "mend/mend_work.h"

/* A vertex inside an edge. */
typedef struct mw_cut_vertex {
    uint32_t half; /* 4 * triangle + edge */
    uint32_t vertex;
    double along; /* from the start of the edge: a larger number is farther */
} mw_cut_vertex;

/* Cut a triangle at `count` vertices, sorted by edge, and along each edge, into count + 1 parts.
 * They are turned like the triangle, and none is flat. O(count). */
void mw__triangle_cut(const mw_mend_work *w, const mw_mend_triangle *triangle,
                      const mw_cut_vertex *vertex, size_t count, mw_mend_triangle *part);

#endif
