/* mend_work.h - a mesh that is being mended: its triangles so far, by the caller's vertices, and
 * the changes. Private. */
#ifndef MW_SRC_MEND_MEND_WORK_H
#define MW_SRC_MEND_MEND_WORK_H

#include "base/job.h"

#include <meshwalk/mend.h>

/* A triangle, or a part of one. */
typedef struct mw_mend_triangle {
    uint32_t v[3]; /* after welding: vertices that are kept */
    uint32_t from; /* its number in the caller's arrays */
} mw_mend_triangle;

typedef struct mw_mend_work {
    const double *points;
    size_t stride, dimension; /* of points; 2 or 3 */
    uint32_t vertex_count;
    uint32_t *kept; /* per vertex: itself, or the vertex that it is welded to */
    mw_mend_triangle *triangle;
    size_t count;
    mw_mend_change *changes;
    size_t change_count, change_capacity;
    uint32_t repairs;
    double tolerance;
    mw_job *job;
    bool too_large; /* more triangles than a mesh may have */
} mw_mend_work;

static MW_INLINE const double *mw__mend_point(const mw_mend_work *w, uint32_t vertex)
{
    return w->points + vertex * w->stride;
}

/* The functions below return false when out of memory, or cancelled. */

/* Note a change. */
bool mw__mend_note(mw_mend_work *w, mw_mend_change_kind kind, uint32_t triangle, uint32_t vertex,
                   uint32_t other);

/* The repairs, each a stage of the present part. Of mw__mend_split, *changed tells whether it found
 * anything to do; of mw__mend_drop as well. */
bool mw__mend_weld(mw_mend_work *w);
bool mw__mend_drop(mw_mend_work *w, bool *changed);
bool mw__mend_split(mw_mend_work *w, bool *changed);
bool mw__mend_orient(mw_mend_work *w);

/* --- edges --- */

/* An edge of a triangle: half is 4 * triangle + edge. */
typedef struct mw_mend_edge {
    uint32_t low, high, half;
} mw_mend_edge;

/* The edges of all triangles with three different vertices, sorted: those of the same ends follow
 * each other, in the order of triangles. NULL when out of memory. Release with free(). */
mw_mend_edge *mw__mend_edges(const mw_mend_work *w, size_t *count);

/* The number of edges from `at` on that have the same ends. */
static MW_INLINE size_t mw__mend_edge_run(const mw_mend_edge *edge, size_t count, size_t at)
{
    size_t end = at + 1;
    while (end < count && edge[end].low == edge[at].low && edge[end].high == edge[at].high) end++;
    return end - at;
}

#endif
