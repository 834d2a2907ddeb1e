/* prober.h - the prober, and what the files of this room share. Private.
 *
 * probe_touch.c decides what a line touches. plane_walk.c and probe_race.c walk over the surface
 * [thesis App. G]. ray_search.c searches the BVH. probe_query.c is the query. */
#ifndef MW_SRC_PROBE_PROBER_H
#define MW_SRC_PROBE_PROBER_H

#include "surface/surface.h"
#include "predicates/line.h"
#include "probe/bvh/bvh.h"
#include "probe/probe_guide.h"

#include <meshwalk/probe.h>

struct mw_prober {
    const mw_surface *surface;
    mw_bvh bvh;
    mw_probe_guide guide;
    bool has_bvh;
    bool portable; /* no vector instructions: for tests */
    /* For mw_inside_surface: all edges have neighbours, which do not change; and vertices that were
     * welded are known to have stayed together. */
    bool closed, joined;
    /* About the mean squared distance of the vertices from their mean, when created. */
    double variance;
    uint64_t version;    /* version of the surface that the BVH is valid for */
    uint64_t edit_count; /* of the surface whose triangles the BVH holds */
    double slack;        /* boxes are widened by this */
    double slack_limit;  /* beyond this they are fitted again */
    uint64_t fits;
    double fit_seconds;
};

/* --- prober.c --- */

/* Divide the triangles anew and fit the boxes. The tree goes on following single triangles if it
 * did. False when out of memory; then nothing has changed. */
bool mw__prober_rebuild(mw_prober *prober, mw_job *job);

/* The same; *former is what the prober was. Release its boxes, or put it back and release the new
 * ones. */
bool mw__prober_remake(mw_prober *prober, mw_job *job, mw_prober *former);

/* --- probe_touch.c --- */

/* Does the line touch the triangle, at any distance: does it meet the triangle, and does m point at
 * its front? Exact. False for a triangle with a vertex that is not finite. */
bool mw__line_touches(const mw_surface *surface, const mw_line *line, uint32_t triangle);

/* Does the line meet the triangle, from either side? */
bool mw__line_meets(const mw_surface *surface, const mw_line *line, uint32_t triangle);

/* Is the touch of a triangle at most d away? Exact. d may be infinite. */
bool mw__touch_in_reach(const mw_surface *surface, const mw_line *line, uint32_t triangle,
                        double d);

/* Of two triangles that are touched, is s the better answer: nearer, or equally near with the lower
 * number? Exact. */
bool mw__touch_is_better(const mw_surface *surface, const mw_line *line, uint32_t s, uint32_t t);

/* The lowest-numbered of the triangles touched at the point where `triangle` is, among those linked
 * there. */
uint32_t mw__lowest_touched(const mw_surface *surface, const mw_line *line, uint32_t triangle);

/* The answer for a triangle that is touched, and the answer for none: MW_TOUCH_NONE, _LIMIT,
 * _BAD. */
mw_touch mw__touch_of(const mw_surface *surface, const mw_line *line, uint32_t triangle);
/* The same with the corners, the full estimate and the mw__hit_distance of the triangle. */
mw_touch mw__touch_at(const mw_line *line, uint32_t triangle, const mw_corners corners,
                      const mw_line_estimate *e, double distance);
/* The same with the mw__hit_sides of a triangle, none of which is 0. */
mw_touch mw__touch_inside(uint32_t triangle, double distance, const double side[3]);
mw_touch mw__touch_none(mw_touch_state state);

/* The answer for the lowest-numbered of the triangles touched at the point where `triangle` is. */
mw_touch mw__touch_of_lowest(const mw_surface *surface, const mw_line *line, uint32_t triangle);

/* Is the triangle touched in its interior, at most d away, and are doubles sure of it? Then *touch
 * becomes the answer. */
bool mw__touch_surely_inside(const mw_surface *surface, const mw_line *line, uint32_t triangle,
                             double d, mw_touch *touch);

/* --- nearest_on_surface.c --- */

/* The answer of mw_nearest_on_surface, with current boxes. `guess`: a triangle to be looked at
 * first, or MW_NONE; the answer does not depend on it. */
void mw__nearest_find(const mw_prober *prober, const double point[3], double max_distance,
                      uint32_t guess, mw_nearest_surface_point *nearest);
/* Refuse a prober without boxes, and a distance that is none. */
mw_status mw__nearest_check(const mw_prober *prober, double max_distance, mw_error *error);
mw_status mw__nearest_fail_outdated(mw_error *error);

/* --- inside.c --- */

/* Does every edge have a neighbour? O(n) */
bool mw__surface_is_closed(const mw_surface *surface);
/* Are vertices that were welded at the same place? O(n) if the surface was welded. */
bool mw__surface_is_joined(const mw_surface *surface);

/* --- probe_counters.c --- */

/* Add the work of one probe. */
void mw__probe_count(mw_probe_counters *sum, mw_probe_counters *work, bool hit);

/* --- probe_query.c --- */

/* Are there boxes, which are up to date? */
bool mw__prober_is_current(const mw_prober *prober);

/* The best triangle that is touched at most max_distance away (0: no limit), or MW_NONE: exact and
 * complete. `seed`: a triangle, to be looked at first, or MW_NONE. Counts in *counters, unless that
 * is NULL. The BVH must be up to date. */
uint32_t mw__probe_certain(const mw_prober *prober, const mw_line *line, double max_distance,
                           uint32_t seed, mw_probe_counters *counters);

/* Answer n certain probes as mw_probe does, several at a time; at most MW_PROBE_BLOCK. */
#define MW_PROBE_BLOCK 512
void mw__probe_certain_block(const mw_prober *prober, mw_probe_cursor *cursor,
                             const double *queries, size_t stride, uint32_t n, mw_touch *touches);

#endif
