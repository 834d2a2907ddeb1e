/* subsegment_runs.h - subsegments that follow each other on one line, joined. Private.
 *
 * Segments that overlap would each pass all subsegments that they share: n of them on one line, n^2
 * in all. A run has subsegments of one line without a gap between them, and knows both of its ends.
 * A segment that comes to a run jumps to its end, and notes a span: it owns the subsegments between
 * two vertices of the run. Runs only grow, so a span says the same later. */
#ifndef MW_SRC_TRIANGULATE_CONSTRAINED_SUBSEGMENT_RUNS_H
#define MW_SRC_TRIANGULATE_CONSTRAINED_SUBSEGMENT_RUNS_H

#include "mesh/mesh.h"

/* Of a subsegment. Runs are trees of subsegments, as in union-find. */
typedef struct mw_subsegment_run {
    uint32_t parent;    /* a subsegment of the same run; the root's is the root */
    uint32_t low, high; /* of the root: both ends of the run, by x, then y      */
} mw_subsegment_run;

/* A segment owns the subsegments from one vertex to another, in the run of `subsegment`. */
typedef struct mw_subsegment_span {
    uint32_t subsegment, from, to, segment;
} mw_subsegment_span;

typedef struct mw_subsegment_runs {
    mw_subsegment_run *run; /* per subsegment */
    mw_subsegment_span *span;
    size_t count, room, span_count, span_room;
} mw_subsegment_runs;

void mw__subsegment_runs_release(mw_subsegment_runs *runs);

/* Is p before q, by x, then y? */
static MW_INLINE bool mw__point_is_before(mw_point p, mw_point q)
{
    return p.x < q.x || (p.x == q.x && p.y < q.y);
}

/* A new subsegment, the next number, from one vertex to another, is a run. False when out of
 * memory. */
bool mw__subsegment_runs_add(mw_subsegment_runs *runs, const mw_point *point, uint32_t from,
                             uint32_t to);

/* Two subsegments on one line that share a vertex, or whose runs do, become one run. */
void mw__subsegment_runs_join(mw_subsegment_runs *runs, const mw_point *point, uint32_t a,
                              uint32_t b);

/* Where a segment leaves the run of a subsegment that it passes from vertex `from` towards vertex
 * `to`: `to`, if the run goes as far. */
uint32_t mw__subsegment_runs_leave(mw_subsegment_runs *runs, const mw_point *point,
                                   uint32_t subsegment, uint32_t from, uint32_t to);

/* The subsegment that stands for the run of a subsegment. */
uint32_t mw__subsegment_run(mw_subsegment_runs *runs, uint32_t subsegment);

/* Note a span. False when out of memory. */
bool mw__subsegment_runs_note(mw_subsegment_runs *runs, const mw_subsegment_span *span);

#endif
