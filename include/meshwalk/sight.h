/**
 * @file sight.h
 * Lines of sight over a terrain: what is seen from a point.
 *
 * The terrain is a planar mesh with a height at each vertex; heights are linear in each triangle. A
 * target is visible from a viewpoint if no point of the straight line between them lies below the
 * terrain. The rules:
 *
 * - A line that touches the terrain or runs along it is not interrupted. So on a plane every point
 *   of the ground sees every other.
 * - There is no terrain beyond the border of the mesh, in its holes, and in triangles with a corner
 *   of unknown height (NaN). Nothing is hidden there. A triangle that the line meets in a single
 *   point hides nothing either.
 * - From an end below the terrain nothing is visible, and such an end is not visible itself.
 *
 * All of this is decided exactly for the given doubles. The height of an end above the ground is
 * not rounded, even where the height of the ground is not a double. The earth is a plane: curvature
 * and refraction are ignored.
 */
#ifndef MESHWALK_SIGHT_H
#define MESHWALK_SIGHT_H

#include <meshwalk/locate.h>

#ifdef __cplusplus
extern "C" {
#endif

/** An end of a line of sight. */
typedef struct mw_sight_end {
    double x, y;
    double height; /**< above the ground; if `absolute`: on the scale of the mesh's heights */
    int absolute;  /**< 1: `height` is not measured from the ground */
    uint32_t reserved;
} mw_sight_end;

/** Whether a target is visible. */
typedef enum mw_sight_state {
    MW_SIGHT_VISIBLE = 0, /**< no terrain is above the line */
    MW_SIGHT_HIDDEN,      /**< terrain is above the line */
    /** the ground at the target has no height, or the target is not finite */
    MW_SIGHT_UNKNOWN
} mw_sight_state;

/** A line of sight. */
typedef struct mw_sight {
    double at;         /**< MW_SIGHT_HIDDEN: where terrain is first found above the line, as a
                        * parameter from 0 (the viewpoint) to 1 (the target), rounded; else 1 */
    uint32_t triangle; /**< MW_SIGHT_HIDDEN: the triangle there; else MW_NONE */
    uint8_t state;     /**< mw_sight_state */
    uint8_t reserved[3];
} mw_sight;

/**
 * A viewpoint: a plain value that may be copied. All members are private.
 *
 * It is valid as long as its locator and the heights exist.
 */
typedef struct mw_viewpoint {
    const mw_locator *locator;
    const double *heights;
    mw_cursor here, there; /* near the viewpoint, and near the last target */
    double at[2];
    double offset;     /* height above the ground of `triangle`, or height */
    double height;     /* rounded */
    double unsure;     /* bound for the error of `height` */
    uint32_t triangle; /* MW_NONE: the height is absolute */
    uint32_t reserved;
} mw_viewpoint;

/**
 * Prepare a viewpoint.
 *
 * @param locator  a locator that fills pockets and holes, of an embedding; it must outlive the view
 * @param heights  one for each vertex; NaN: not known. They must outlive the view
 * @param from     the viewpoint
 * @param view     receives the prepared viewpoint
 * @param error    NULL, or receives the message of a failure
 * @return MW_OK; MW_ERROR_ARGUMENT for NULL, and as mw_segment_begin(); MW_ERROR_INPUT if a number
 *         is not finite, if there is no ground below the viewpoint, or if it lies below the ground.
 *
 * Thread-safe. Memory and time: those of a query (mw_locate()).
 */
MW_API mw_status mw_viewpoint_init(const mw_locator *locator, const double *heights,
                                   const mw_sight_end *from, mw_viewpoint *view, mw_error *error);

/**
 * Decide whether a target is visible from a viewpoint.
 *
 * @param view  the viewpoint; it remembers where the last target was, for speed only
 * @param to    the target
 * @return the line of sight.
 *
 * Thread-safe with a copy of the viewpoint for each thread. Memory and time: those of a query,
 * and O(1) for each triangle that the line passes before it is interrupted.
 */
MW_API mw_sight mw_sight_to(mw_viewpoint *view, const mw_sight_end *to);

#ifdef __cplusplus
}
#endif
#endif
