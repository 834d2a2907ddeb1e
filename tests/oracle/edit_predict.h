/* edit_predict.h - what an edit has to do to a twin, predicted by brute force. */
#ifndef MW_TESTS_ORACLE_EDIT_PREDICT_H
#define MW_TESTS_ORACLE_EDIT_PREDICT_H

#include "oracle/edit_sides.h"

typedef enum twin_outcome { TWIN_DONE, TWIN_REFUSED } twin_outcome;

/* Is the edit to be done or refused? */
twin_outcome twin_predict(const twin *t, const mw_edit *e);

/* The triangles round a vertex. */
typedef struct twin_star {
    twin_side *side; /* opposite to the vertex; in the order of the triangles' numbers */
    uint32_t count;
    uint32_t *border, border_count; /* neighbours along border edges                          */
    uint32_t *fixed, fixed_count;   /* neighbours along edges that are not to be flipped away */
} twin_star;

/* Those round v. The caller frees them: twin_star_free. */
twin_star twin_star_of(const twin *t, uint32_t v);
void twin_star_free(twin_star *s);

/* Do the triangles round a vertex keep their turn, with it at q? */
bool twin_star_fits(const twin *t, const twin_star *s, const double *q);

/* The vertices on the straight way from a to b, in order, both ends counted. The caller frees
 * them. */
uint32_t *twin_vertices_between(const twin *t, uint32_t a, uint32_t b, size_t *count);

#endif
