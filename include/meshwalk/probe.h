/**
 * @file probe.h
 * Which triangle of a surface a probe touches, and the point of a surface nearest to a point
 * [thesis App. G].
 *
 * A probe is a point q and a motion vector m; together they give the line through q along m. The
 * probe touches a triangle if the line meets it at most max_distance away from q, on either side,
 * with m pointing at the triangle's front. A triangle that lies along the line, edge on, is not
 * touched. Decisions are exact for the given doubles.
 *
 * Two modes exist.
 * - *As published*: walks over the surface along planes through the line, from a few first
 *   triangles. Fast, and needs nothing but the surface. The answer is the first touch that a walk
 *   finds. If no walk finds one, the state is MW_TOUCH_LIMIT: the line may touch the surface all
 *   the same.
 * - *Certain*: complete. Of several touches the answer is the one with the smallest absolute
 *   distance, then with the lowest triangle. MW_TOUCH_NONE means that the line touches nothing.
 *   Needs boxes over the triangles (mw_prober_options.boxes).
 */
#ifndef MESHWALK_PROBE_H
#define MESHWALK_PROBE_H

#include <meshwalk/surface.h>

#ifdef __cplusplus
extern "C" {
#endif

/** A surface prepared for probes. Opaque; any number of threads may query one prober. */
typedef struct mw_prober mw_prober;

/** Options of a prober. Zero-initialised options select the defaults. */
typedef struct mw_prober_options {
    /** 1: build boxes over the triangles, for certain probes and mw_nearest_on_surface(). */
    int boxes;
    uint32_t threads;            /**< threads that build the boxes; 0: one per processor */
    const mw_progress *progress; /**< progress and cancelling, see base.h; NULL: none */
    /** 1: make a guide, a coarse grid that leads walks to their first triangle (2 bytes a
     * triangle). It is made once: if the surface changes its shape much, walks get longer. */
    int guide;
    uint32_t reserved[3]; /**< must be zero */
} mw_prober_options;

/**
 * Prepare a surface for probes.
 *
 * @param surface  the surface, which must outlive the prober
 * @param options  NULL selects the defaults
 * @param out      receives the prober, owned by the caller (mw_prober_destroy()); NULL on failure
 * @param error    NULL, or receives the message of a failure
 * @return MW_OK; MW_ERROR_ARGUMENT for NULL; MW_ERROR_INPUT if the surface has no triangle;
 *         MW_ERROR_MEMORY, MW_CANCELLED.
 *
 * Thread-safe. O(1) without boxes and guide, O(n) with a guide, O(n log n) with boxes.
 */
MW_API mw_status mw_prober_create(const mw_surface *surface, const mw_prober_options *options,
                                  mw_prober **out, mw_error *error);
/** Destroy a prober. NULL is allowed. */
MW_API void mw_prober_destroy(mw_prober *prober);

/**
 * Bring the boxes up to date with a changed surface, during its update. Not needed without boxes.
 *
 * Until this is done, certain probes return MW_TOUCH_BAD. If the surface was edited
 * (surface_edit.h) and the prober was not attached to the editor, the boxes are made anew, in
 * O(n log n); if memory runs out, they stay out of date.
 *
 * @param prober   the prober
 * @param moved    an upper bound of the distance that any vertex moved since the last update: the
 *                 boxes are enlarged by it, in O(1), and fitted again when the sum of enlargements
 *                 becomes too large. Negative or NaN: the bound is unknown, and the boxes are
 *                 fitted now, in O(n); use this after flips of edges
 * @param threads  number of threads; 0: one per processor
 *
 * Not thread-safe.
 */
MW_API void mw_prober_update(mw_prober *prober, double moved, uint32_t threads);

/** Sizes of a prober. */
typedef struct mw_prober_info {
    size_t bytes;       /**< memory in bytes, without the surface */
    size_t box_bytes;   /**< of these, for the boxes */
    size_t guide_bytes; /**< of these, for the guide */
    uint64_t fits;      /**< how often the boxes were fitted */
    double fit_seconds; /**< how long the last fit took */
} mw_prober_info;

/** Fill `info` with the sizes of a prober. O(1). Not thread-safe while mw_prober_update() runs. */
MW_API void mw_prober_describe(const mw_prober *prober, mw_prober_info *info);

/** The outcome of a probe. */
typedef enum mw_touch_state {
    MW_TOUCH_HIT = 0, /**< touches `triangle` */
    MW_TOUCH_NONE,    /**< touches nothing within the distance, for certain */
    MW_TOUCH_LIMIT,   /**< no touch found within the limit of iterations; there may be one */
    MW_TOUCH_BAD,     /**< not finite, a motion of zero, or boxes that are not up to date */
    MW_TOUCH_STATE_COUNT
} mw_touch_state;

/** The name of an outcome: "hit", "none", "limit" or "bad"; NULL for any other number. Thread-safe.
 * O(1). */
MW_API const char *mw_touch_state_name(mw_touch_state state);

/** What a probe touched. */
typedef struct mw_touch {
    /** From q along m to the touched point, in mesh units; negative behind q. Off by less than
     * 2^-40 of itself if it is a normal double; infinite beyond the largest double. NaN without a
     * touch. */
    double distance;
    /** Barycentric weights of the touched point: at least 0, sum 1 up to rounding, exactly 0 for a
     * vertex off an edge that the line meets. NaN without a touch. */
    double weight[3];
    /** The caller's number, or MW_NONE. If several triangles are touched at one point: the lowest
     * of those linked there; in certain mode the lowest of all. */
    uint32_t triangle;
    uint8_t state; /**< mw_touch_state */
    uint8_t where; /**< mw_where: MW_INSIDE, MW_ON_EDGE or MW_ON_VERTEX; MW_BAD without a touch */
    uint8_t local; /**< the edge or vertex of the triangle; 255 otherwise */
    uint8_t back;  /**< 1: the motion points at the triangle's back */
} mw_touch;

/** How the first triangle of a walk is chosen. */
typedef enum mw_probe_start {
    /** LAST if that triangle is near q. Otherwise the first walk starts at the triangle to which
     * the prober's guide leads, if m points at its front; without a guide, and in further
     * iterations, SAMPLE. */
    MW_PROBE_START_AUTO = 0,
    /** The triangle that this cursor touched last, if m points at its front. Otherwise, and in
     * further iterations, SAMPLE. */
    MW_PROBE_START_LAST,
    /** The nearest of k random triangles at whose fronts m points [thesis App. G, Alg. 1]. */
    MW_PROBE_START_SAMPLE,
    MW_PROBE_START_RANDOM, /**< a random triangle at whose front m points */
    MW_PROBE_START_COUNT
} mw_probe_start;

/** The name of a start: "auto", "last", "sample" or "random"; NULL for any other number.
 * Thread-safe. O(1). */
MW_API const char *mw_probe_start_name(mw_probe_start start);

/** Which faces of triangles count. */
typedef enum mw_probe_faces {
    MW_PROBE_FRONT = 0, /**< triangles at whose front the motion points */
    MW_PROBE_BACK,      /**< triangles at whose back the motion points */
    MW_PROBE_BOTH,      /**< all triangles */
    MW_PROBE_FACES_COUNT
} mw_probe_faces;

/** The name of a choice of faces: "front", "back" or "both"; NULL for any other number.
 * Thread-safe. O(1). */
MW_API const char *mw_probe_faces_name(mw_probe_faces faces);

/** Which part of the line through q along m counts. */
typedef enum mw_probe_extent {
    MW_PROBE_LINE = 0, /**< all of it: ahead of q and behind q */
    MW_PROBE_RAY,      /**< q, and what is ahead of it */
    /** From q to m, both included: m is the other end, not a vector. The line through two points is
     * exact, too. A difference of coordinates must not overflow. */
    MW_PROBE_SEGMENT,
    MW_PROBE_EXTENT_COUNT
} mw_probe_extent;

/** The name of an extent: "line", "ray" or "segment"; NULL for any other number. Thread-safe.
 * O(1). */
MW_API const char *mw_probe_extent_name(mw_probe_extent extent);

/** How to answer probes. Zero-initialised options select the defaults. */
typedef struct mw_probe_options {
    double max_distance; /**< greater than 0, in mesh units; 0: unlimited */
    int certain;         /**< 1: complete answers; the prober needs boxes */
    mw_probe_start start;
    /** k of Alg. 1; 0: 2 times the cube root of the number of vertices, rounded down. At most the
     * number of triangles. */
    uint32_t samples;
    uint32_t iterations; /**< most walks, from different first triangles; 0: 10 */
    /** Number of walks that run at a time in threads, at most 256; the first touch stops the
     * others. 0 or 1: one. In a race the triangle may differ between runs if the line touches
     * several. Certain probes do not race. */
    uint32_t race;
    uint32_t threads;            /**< batches without a race: threads; 0: one per processor */
    uint64_t seed;               /**< seed of random choices */
    int counters;                /**< 1: count what probes do */
    const mw_progress *progress; /**< progress and cancelling, see base.h; NULL: none */
    /** Touches nearer to q than this do not count; mesh units. Certain probes only. */
    double min_distance;
    mw_probe_faces faces;   /**< certain probes only */
    mw_probe_extent extent; /**< certain probes only */
    /** 1: of several triangles that a probe touches at one place, exactly, only the lowest counts:
     * a line through an edge touches once there. mw_probe_all_batch() only. */
    uint32_t one_per_place;
    uint32_t reserved[1]; /**< must be zero */
} mw_probe_options;

/** What probes did, summed over queries. A race counts all its walks; that depends on the run. */
typedef struct mw_probe_counters {
    uint64_t queries, hits;
    uint64_t samples;                  /**< triangles sampled for a first one */
    uint64_t triangles, triangles_max; /**< triangles visited by walks; most in one query */
    uint64_t tests, tests_max;         /**< orientation tests of walks and of first triangles */
    uint64_t intersections;            /**< triangles that the line meets: distances computed */
    uint64_t iterations, iterations_max;
    uint64_t boxes, box_triangles; /**< certain mode: boxes tested, and triangles in them */
} mw_probe_counters;

/** Add `more` to `sum`, for instance the counts of several threads. Thread-safe on different sums.
 * O(1). */
MW_API void mw_probe_counters_add(mw_probe_counters *sum, const mw_probe_counters *more);

/**
 * The state of a series of probes: one per thread, a plain value that may be copied. Members other
 * than `counters` are private.
 */
typedef struct mw_probe_cursor {
    mw_probe_counters counters; /**< of all queries so far, if enabled */
    mw_probe_options options;   /* resolved */
    const mw_prober *prober;
    uint64_t random;
    uint32_t last, before; /* triangles touched last, and before that */
    uint32_t reserved[4];
} mw_probe_cursor;

/**
 * Initialise a cursor.
 *
 * @param prober   the prober that the cursor will serve
 * @param options  NULL selects the defaults
 * @param cursor   receives the initial state
 * @param error    NULL, or receives the message of a failure
 * @return MW_OK; MW_ERROR_ARGUMENT for an unknown start, `certain` without boxes, or a distance
 *         that is negative or NaN.
 *
 * Thread-safe. O(1).
 */
MW_API mw_status mw_probe_cursor_init(const mw_prober *prober, const mw_probe_options *options,
                                      mw_probe_cursor *cursor, mw_error *error);

/**
 * Answer one probe.
 *
 * @param prober  the prober
 * @param cursor  a cursor of this prober
 * @param point   q: x, y, z
 * @param motion  m: x, y, z, not zero, of any length
 * @return what the probe touches.
 *
 * Thread-safe with one cursor per thread. No allocation. With mw_probe_options.race the call
 * creates that many threads, fewer if the system refuses them. Time: the walks; certain probes
 * O(log n) typically. Source: [thesis App. G].
 */
MW_API mw_touch mw_probe(const mw_prober *prober, mw_probe_cursor *cursor, const double point[3],
                         const double motion[3]);

/**
 * Decide whether a probe touches anything. Faster than mw_probe(), since the first touch found is
 * enough.
 *
 * The answer is always complete, as of certain probes. With MW_PROBE_SEGMENT it tells whether the
 * straight way from q to m is blocked.
 *
 * @param prober  a prober with boxes
 * @param cursor  a cursor of this prober, whose options tell what counts
 * @param point   q: x, y, z
 * @param motion  m: x, y, z; the other end of a segment
 * @return MW_TOUCH_HIT, MW_TOUCH_NONE, or MW_TOUCH_BAD: not finite, no direction, no boxes, or
 *         outdated boxes.
 *
 * Thread-safe with one cursor per thread. No allocation. O(log n) typically.
 */
MW_API mw_touch_state mw_probe_any(const mw_prober *prober, mw_probe_cursor *cursor,
                                   const double point[3], const double motion[3]);

/**
 * List all triangles that a probe touches, in their order along m. Exact and complete.
 *
 * The order is that of the signed distance; triangles touched at the same place are ordered by
 * their numbers. A line through an edge or a vertex touches all triangles there.
 *
 * @param prober    a prober with boxes
 * @param cursor    a cursor of this prober, whose options tell what counts
 * @param point     q: x, y, z
 * @param motion    m: x, y, z; the other end of a segment
 * @param touches   receives the first `capacity` touches; may be NULL if that is 0
 * @param capacity  room in `touches`
 * @param state     NULL, or receives MW_TOUCH_HIT, MW_TOUCH_NONE or MW_TOUCH_BAD, as
 *                  mw_probe_any()
 * @return how many triangles are touched, also if `capacity` is less; 0 for MW_TOUCH_BAD.
 *
 * Thread-safe with one cursor per thread. No allocation. O(k log k) for k touches, besides the
 * search.
 */
MW_API size_t mw_probe_all(const mw_prober *prober, mw_probe_cursor *cursor, const double point[3],
                           const double motion[3], mw_touch *touches, size_t capacity,
                           mw_touch_state *state);

/**
 * Answer n probes.
 *
 * Results are in the order of the queries and, without a race, equal for every number of threads.
 * With MW_PROBE_START_LAST each query starts at the triangle of the previous query of its chunk of
 * 4,096. On a shared surface an update may come between two queries of a batch.
 *
 * @param prober    the prober
 * @param queries   x, y, z of q, then of m, of query i at queries[i * stride]
 * @param n         number of queries
 * @param stride    doubles from one query to the next; 0 means 6
 * @param options   NULL selects the defaults
 * @param touches   receives n answers; unspecified on failure
 * @param counters  NULL, or receives the sums over the batch (if enabled by the options)
 * @param error     NULL, or receives the message of a failure
 * @return MW_OK; MW_ERROR_ARGUMENT for NULL, a stride below 6, and as mw_probe_cursor_init();
 *         MW_ERROR_MEMORY, MW_CANCELLED.
 *
 * Thread-safe. Time: n probes, as mw_probe().
 */
MW_API mw_status mw_probe_batch(const mw_prober *prober, const double *queries, size_t n,
                                size_t stride, const mw_probe_options *options, mw_touch *touches,
                                mw_probe_counters *counters, mw_error *error);

/**
 * Decide for n probes whether they touch anything. Faster than mw_probe_batch(), since the first
 * touch found is enough.
 *
 * @param prober    a prober with boxes
 * @param queries   as for mw_probe_batch()
 * @param n         number of queries
 * @param stride    doubles from one query to the next; 0 means 6
 * @param options   NULL selects the defaults; `certain` must be 1 for a ray or a segment
 * @param states    receives n answers of mw_touch_state, as of mw_probe_any(); equal for every
 *                  number of threads, unspecified on failure
 * @param counters  NULL, or receives the sums over the batch (if enabled by the options)
 * @param error     NULL, or receives the message of a failure
 * @return MW_OK; MW_ERROR_ARGUMENT as mw_probe_batch(), and for a prober without boxes;
 *         MW_CANCELLED.
 *
 * Thread-safe. O(log n) a probe typically.
 */
MW_API mw_status mw_probe_any_batch(const mw_prober *prober, const double *queries, size_t n,
                                    size_t stride, const mw_probe_options *options, uint8_t *states,
                                    mw_probe_counters *counters, mw_error *error);

/** All touches of many probes. Release with mw_touch_lists_release(). */
typedef struct mw_touch_lists {
    size_t *offset;     /**< probe i has the touches offset[i] up to offset[i + 1] - 1 */
    mw_touch *touch;    /**< all touches, in the order of the probes */
    size_t probe_count; /**< offset has one more */
    size_t touch_count;
    size_t bad_count; /**< probes that mw_probe_all() calls MW_TOUCH_BAD; they have no touches */
} mw_touch_lists;

/**
 * List all triangles that n probes touch: for each probe in their order along its motion.
 *
 * @param prober    a prober with boxes
 * @param queries   as for mw_probe_batch()
 * @param n         number of queries
 * @param stride    doubles from one query to the next; 0 means 6
 * @param options   NULL selects the defaults; `certain` must be 1 for a ray or a segment
 * @param lists     receives the touches, as of mw_probe_all(), equal for every number of threads;
 *                  empty on failure
 * @param counters  NULL, or receives the sums over the batch (if enabled by the options)
 * @param error     NULL, or receives the message of a failure
 * @return MW_OK, also if a probe is bad (bad_count); MW_ERROR_ARGUMENT as mw_probe_any_batch();
 *         MW_ERROR_MEMORY, MW_CANCELLED.
 *
 * Thread-safe. O(k log k) for the k touches of a probe, besides the search. Memory: 40 bytes a
 * touch, twice at the end, and 8 bytes a probe.
 */
MW_API mw_status mw_probe_all_batch(const mw_prober *prober, const double *queries, size_t n,
                                    size_t stride, const mw_probe_options *options,
                                    mw_touch_lists *lists, mw_probe_counters *counters,
                                    mw_error *error);
/** Release the touches of probes. Zero-initialised lists are allowed. */
MW_API void mw_touch_lists_release(mw_touch_lists *lists);

/**
 * List the triangles that the walks of one probe visit, in order. The query runs without a race.
 *
 * Within a walk each triangle is linked to the previous one; where a border turned the walk back,
 * to the walk's first triangle. In certain mode the boxes answer. The only walk then is a short
 * one, of at most 64 triangles, from the triangle touched last; it need not contain the answer.
 * There is no such walk if nothing was touched yet, if m does not point at that triangle's front,
 * or if the start is SAMPLE or RANDOM.
 *
 * @param prober     the prober
 * @param cursor     a cursor of this prober
 * @param point      q: x, y, z
 * @param motion     m: x, y, z
 * @param triangles  receives at most `capacity` triangles
 * @param iteration  NULL, or receives per triangle the number of its walk, from 0
 * @param capacity   room in `triangles` and `iteration`
 * @param touch      NULL, or receives the answer
 * @return how many triangles were visited, also if `capacity` is less.
 *
 * Thread-safe with one cursor per thread. No allocation. Time: as mw_probe().
 */
MW_API size_t mw_probe_path(const mw_prober *prober, mw_probe_cursor *cursor, const double point[3],
                            const double motion[3], uint32_t *triangles, uint32_t *iteration,
                            size_t capacity, mw_touch *touch);

/**
 * The point of a surface nearest to a point: the proxy of haptic rendering.
 *
 * Each coordinate of the point is rounded. The point lies in the box round its triangle; if it is a
 * corner, it is exact.
 */
typedef struct mw_nearest_surface_point {
    /** The caller's number; MW_NONE if the query is not finite or no usable triangle is in reach.
     */
    uint32_t triangle;
    /** In mesh units; infinite beyond the largest double. Without a triangle this number and those
     * below are NaN. */
    double distance;
    double point[3];  /**< x, y, z */
    double weight[3]; /**< barycentric weights of the point in its triangle */
} mw_nearest_surface_point;

/**
 * Find the point of the surface nearest to a point.
 *
 * Distances are rounded and the smallest decides; of triangles at the same rounded distance the
 * lowest is the answer. A distance is off by less than 2^-48 of the distance from q to the
 * farthest corner of its triangle (and 2^-1070), wherever the origin is. That is mostly less than
 * 2^-48 of the distance itself; exceptions are points very near the surface next to an edge, and
 * very thin triangles. Triangles without area contain no nearest point.
 *
 * @param prober        a prober with boxes
 * @param point         q: x, y, z
 * @param max_distance  search no farther, in mesh units; INFINITY: unlimited
 * @param nearest       receives the answer
 * @param error         NULL, or receives the message of a failure
 * @return MW_OK, also without a triangle; MW_ERROR_ARGUMENT if the prober has no boxes, they are
 *         not up to date, or the distance is negative or NaN.
 *
 * Thread-safe. O(log n) typically.
 */
MW_API mw_status mw_nearest_on_surface(const mw_prober *prober, const double point[3],
                                       double max_distance, mw_nearest_surface_point *nearest,
                                       mw_error *error);

/** How to find many nearest points. Zero-initialised options select the defaults. */
typedef struct mw_nearest_options {
    int in_order;                /**< 1: each point is near the one before it; do not sort */
    uint32_t threads;            /**< number of threads; 0: one per processor */
    const mw_progress *progress; /**< progress and cancelling, see base.h; NULL: none */
    uint32_t reserved[4];        /**< must be zero */
} mw_nearest_options;

/**
 * Find the points of the surface nearest to n points: the answers of mw_nearest_on_surface(), bit
 * for bit, and for every number of threads.
 *
 * Points are sorted along a curve in space, and the triangle found last bounds the next search. On
 * a shared surface an update may come between two chunks of 1,024 points.
 *
 * @param prober        a prober with boxes
 * @param points        x, y, z of point i at points[i * stride]
 * @param n             number of points
 * @param stride        doubles from one point to the next; 0 means 3
 * @param max_distance  search no farther, in mesh units; INFINITY: unlimited
 * @param options       NULL selects the defaults
 * @param nearest       receives n answers, in the order of the points; unspecified on failure
 * @param error         NULL, or receives the message of a failure
 * @return MW_OK, also where a point has no triangle; MW_ERROR_ARGUMENT for NULL, a stride of 1 or
 *         2, a prober without boxes or with boxes that are not up to date, or a distance that is
 *         negative or NaN; MW_ERROR_MEMORY, MW_CANCELLED.
 *
 * Thread-safe. O(log n) a point typically. The sort takes 16 bytes a point, of at most 2^20 points
 * at a time.
 */
MW_API mw_status mw_nearest_on_surface_batch(const mw_prober *prober, const double *points,
                                             size_t n, size_t stride, double max_distance,
                                             const mw_nearest_options *options,
                                             mw_nearest_surface_point *nearest, mw_error *error);

/** Where a point is with respect to a closed surface. */
typedef enum mw_surface_side {
    MW_SURFACE_OUTSIDE = 0,
    MW_SURFACE_INSIDE,
    MW_SURFACE_ON,  /**< on a triangle, an edge or a vertex, exactly */
    MW_SURFACE_BAD, /**< not finite */
    MW_SURFACE_SIDE_COUNT
} mw_surface_side;

/** The name of a side: "outside", "inside", "on" or "bad"; NULL for any other number. Thread-safe.
 * O(1). */
MW_API const char *mw_surface_side_name(mw_surface_side side);

/**
 * Decide which points are inside a closed surface. Exact.
 *
 * A point is inside if a ray from it meets an odd number of triangles. The surface may have several
 * components, one in another, may touch or cross itself, and its triangles may have any
 * orientation. A ray through an edge or a vertex counts as moved aside by an infinitely small
 * distance, always in the same direction. Triangles without area do not count.
 *
 * @param prober   a prober with boxes, of a surface whose edges all have a neighbour
 * @param points   x, y, z of point i at points[i * stride]
 * @param n        number of points
 * @param stride   doubles from one point to the next; 0 means 3
 * @param threads  number of threads; 0: one per processor
 * @param sides    receives n answers, of mw_surface_side
 * @param error    NULL, or receives the message of a failure
 * @return MW_OK; MW_ERROR_ARGUMENT for NULL, a stride of 1 or 2, a prober without boxes, or boxes
 *         that are not up to date; MW_ERROR_INPUT if the surface is not closed, a vertex is not
 *         finite, or vertices that were welded may have moved apart.
 *
 * Thread-safe. O(log n) a point typically.
 */
MW_API mw_status mw_inside_surface(const mw_prober *prober, const double *points, size_t n,
                                   size_t stride, uint32_t threads, uint8_t *sides,
                                   mw_error *error);

#ifdef __cplusplus
}
#endif
#endif
