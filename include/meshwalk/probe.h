/* probe.h - which triangle of a surface a probe touches [thesis App. G].
 *
 * A query is a point q, where the probe is, and a motion vector m: together the *line* through q along m. It touches
 * a triangle where it meets it on either side of q, at most max_distance away, m pointing at the triangle's front. A
 * triangle that the line only lies in, edge on, is not touched. What is decided is decided exactly, on the doubles
 * given.
 *
 * Two modes. As published: walks over the surface along planes through the line, from a few first triangles; fast,
 * needs nothing beside the surface, and honest: a touch it tells of is one (the first it found), but where its
 * iterations end without one it says MW_TOUCH_LIMIT, which does not mean that there is none. Certain: complete; of
 * several touches the one at the smallest |distance|, of those the lowest-numbered triangle; MW_TOUCH_NONE means
 * that there is none. It needs boxes over the triangles (mw_prober_options.boxes). */
#ifndef MESHWALK_PROBE_H
#define MESHWALK_PROBE_H

#include <meshwalk/surface.h>

#ifdef __cplusplus
extern "C" {
#endif

/* A surface prepared for probes. Const while it is queried. */
typedef struct mw_prober mw_prober;

typedef struct mw_prober_options {
    int boxes;                   /* 1: build boxes over the triangles, for certain probes and mw_nearest_on_surface */
    uint32_t threads;            /* that make the boxes; 0: as many as processors */
    const mw_progress *progress; /* who watches, and may cancel: base.h; NULL: nobody */
    uint32_t reserved[4];
} mw_prober_options;

/* surface: must outlive the prober. options: NULL = all zero. out: owned by the caller (mw_prober_destroy); NULL on
 * failure. MW_ERROR_ARGUMENT: NULL; MW_ERROR_INPUT: the surface has no triangle; MW_ERROR_MEMORY. O(1) without
 * boxes. */
MW_API mw_status mw_prober_create(const mw_surface *surface, const mw_prober_options *options, mw_prober **out,
                                  mw_error *error);
MW_API void mw_prober_destroy(mw_prober *prober); /* NULL is allowed */

/* Bring the boxes up to date with a surface that has changed, during its update. Not needed without boxes.
 *   moved  no vertex moved farther than that since the last update: then the boxes are taken to be so much larger, in
 *          O(1), and fitted anew only when that sum grows too large for them; negative or NaN: not known, fit them now,
 *          O(n). After flips of edges: not known
 *   threads  0: as many as processors
 * Boxes not brought up to date: certain probes get MW_TOUCH_BAD. */
MW_API void mw_prober_update(mw_prober *prober, double moved, uint32_t threads);

typedef struct mw_prober_info {
    size_t bytes;       /* all its memory, surface not counted */
    size_t box_bytes;   /* of it, the boxes                    */
    uint64_t fits;      /* times that the boxes were fitted    */
    double fit_seconds; /* that the last of them took        */
} mw_prober_info;
MW_API void mw_prober_describe(const mw_prober *prober, mw_prober_info *info);

typedef enum mw_touch_state {
    MW_TOUCH_HIT = 0, /* touches `triangle`                                                                */
    MW_TOUCH_NONE,    /* surely touches nothing within the distance                                        */
    MW_TOUCH_LIMIT,   /* nothing was found within the limit of iterations: there may be something          */
    MW_TOUCH_BAD,     /* a coordinate is NaN or infinite, the motion is zero, or boxes are not up to date  */
    MW_TOUCH_STATE_COUNT
} mw_touch_state;

/* "hit", "none", "limit", "bad"; NULL for another number. */
MW_API const char *mw_touch_state_name(mw_touch_state state);

typedef struct mw_touch {
    double distance; /* from q along m to the point touched, in units of length: negative where it lies behind q. Off by
                          less than 2^-40 of itself where it is a normal double; infinite beyond the largest double (the
                          state is MW_TOUCH_HIT still); NaN but for MW_TOUCH_HIT */
    double
        weight[3]; /* barycentric weights of the point touched: >= 0, sum 1 up to rounding, exactly 0 for the vertices
                          off an edge that the line meets; NaN but for MW_TOUCH_HIT */
    uint32_t
        triangle;  /* the caller's number, or MW_NONE. Of triangles touched in one place the lowest-numbered of those
                          that are linked there; in certain mode of all */
    uint8_t state; /* mw_touch_state */
    uint8_t where; /* mw_where: MW_INSIDE, MW_ON_EDGE or MW_ON_VERTEX; MW_BAD but for MW_TOUCH_HIT */
    uint8_t local; /* edge or vertex of the triangle, 255 else */
    uint8_t reserved;
} mw_touch;

typedef enum mw_probe_start {
    MW_PROBE_START_AUTO = 0, /* as LAST where that triangle is nearer to the point than the nearest of a sample is
                                likely to be, else SAMPLE                                               */
    MW_PROBE_START_LAST,     /* the triangle touched last by this cursor, if any, and if m points at its front;
                                else, and in further iterations, SAMPLE                                 */
    MW_PROBE_START_SAMPLE,   /* the nearest of k random triangles whose fronts m points at [thesis App. G, Alg. 1] */
    MW_PROBE_START_RANDOM,   /* a random triangle whose front m points at                               */
    MW_PROBE_START_COUNT
} mw_probe_start;
/* "auto", "last", "sample", "random"; NULL for another number. */
MW_API const char *mw_probe_start_name(mw_probe_start start);

/* All zero = choose. */
typedef struct mw_probe_options {
    double max_distance; /* > 0, in units of length; 0 = no limit                                                  */
    int certain;         /* 1: complete; the prober has boxes                                                      */
    mw_probe_start start;
    uint32_t samples;    /* k of Alg. 1; 0 = 2 times the cube root, rounded down, of the number of vertices. At most
                            the number of triangles                                                                */
    uint32_t iterations; /* walks at most, from different first triangles; 0 = 10                                  */
    uint32_t race;       /* walks that run at a time in threads, 256 at most; the first to find stops the others. 0 or
                            1: one. In a race the triangle found may differ from run to run where the line touches
                            several. In certain mode nothing races                                                 */
    uint32_t threads;    /* batches without a race: 0: as many as processors                                          */
    uint64_t seed;
    int counters;                /* 1: fill the counters */
    const mw_progress *progress; /* who watches, and may cancel: base.h; NULL: nobody */
    uint32_t reserved[5];
} mw_probe_options;

/* What probes did, summed over queries. Of a race, what all its walks did: that depends on the run. */
typedef struct mw_probe_counters {
    uint64_t queries, hits;
    uint64_t samples;                  /* triangles looked at for a first one                                       */
    uint64_t triangles, triangles_max; /* visited by walks                                                          */
    uint64_t tests, tests_max;         /* orientation tests of walks and of the choice of first triangles           */
    uint64_t intersections;            /* triangles that the line meets: their distance was computed                */
    uint64_t iterations, iterations_max;
    uint64_t boxes, box_triangles; /* certain mode: boxes looked at, and triangles in them */
} mw_probe_counters;
MW_API void mw_probe_counters_add(mw_probe_counters *sum, const mw_probe_counters *more);

/* What a probe changes: one per thread, a plain value. Its members are private. */
typedef struct mw_probe_cursor {
    mw_probe_counters counters; /* of all queries so far, if they count */
    mw_probe_options options;   /* resolved */
    const mw_prober *prober;
    uint64_t random;
    uint32_t last;
    uint32_t reserved[5];
} mw_probe_cursor;

/* options: NULL = all zero. MW_ERROR_ARGUMENT: an unknown start, `certain` without boxes, a distance that is
 * negative or NaN. */
MW_API mw_status mw_probe_cursor_init(const mw_prober *prober, const mw_probe_options *options, mw_probe_cursor *cursor,
                                      mw_error *error);

/* One probe. Never fails, and allocates nothing. Thread-safe with one cursor per thread. With options.race it makes that
 * many threads, fewer where the system refuses them. */
MW_API mw_touch mw_probe(const mw_prober *prober, mw_probe_cursor *cursor, const double point[3],
                         const double motion[3]);

/* n probes: x, y, z, mx, my, mz of query i at queries[i * stride]; stride in doubles, 0 = 6. Results in input order;
 * the same for every number of threads, without a race. Each begins as the start says; MW_PROBE_START_LAST: with the
 * triangle of the query before it in its chunk of 4,096. Of a shared surface, each query is answered as a whole, but
 * an update may come between two of a batch. MW_ERROR_ARGUMENT as mw_probe_cursor_init. */
MW_API mw_status mw_probe_batch(const mw_prober *prober, const double *queries, size_t n, size_t stride,
                                const mw_probe_options *options, mw_touch *touches, mw_probe_counters *counters,
                                mw_error *error);

/* The triangles that the walks of a probe visit, in order; iteration[i] (may be NULL, else of `capacity`) is the
 * number of the walk, from 0, that triangles[i] is of. Within a walk each triangle is linked to the one before it;
 * where a border made the walk go back, to the walk's first. One query by the cursor, without a race, whose answer
 * goes to *touch (may be NULL). In certain mode the boxes answer, and the only walk is a short one, of 64 triangles
 * at most, from the triangle touched last: none of them need be the answer, and there are none where nothing was
 * touched yet, where m does not point at that triangle's front, or where the start is SAMPLE or RANDOM. Writes at
 * most `capacity` and returns how many there were. */
MW_API size_t mw_probe_path(const mw_prober *prober, mw_probe_cursor *cursor, const double point[3],
                            const double motion[3], uint32_t *triangles, uint32_t *iteration, size_t capacity,
                            mw_touch *touch);

/* The point of the surface nearest to a point q: the proxy of haptic rendering. Distances are rounded, and the least
 * of them decides; of several triangles at the same rounded distance the lowest-numbered is the answer. A distance
 * is off by less than 2^-48 of how far the farthest corner of its triangle is from q (and 2^-1070), wherever the
 * origin is: mostly by less than 2^-48 of itself, but not where q is that near the surface and next to an edge, nor
 * in very thin triangles. The point is rounded to its own coordinates beyond that, and lies in the box round its
 * triangle; a corner is exactly that. Triangles without area own no nearest point. */
typedef struct mw_nearest_surface_point {
    uint32_t triangle; /* the caller's number; MW_NONE where the point is not finite, or no usable triangle in reach */
    double distance;   /* infinite beyond the largest double; this and what follows NaN without a triangle           */
    double point[3];
    double weight[3];
} mw_nearest_surface_point;

/* max_distance: look no farther (INFINITY: anywhere); triangle is MW_NONE where there is none. MW_ERROR_ARGUMENT:
 * the prober has no boxes, or they are not up to date; the distance is negative or NaN. Thread-safe. */
MW_API mw_status mw_nearest_on_surface(const mw_prober *prober, const double point[3], double max_distance,
                                       mw_nearest_surface_point *nearest, mw_error *error);

#ifdef __cplusplus
}
#endif
#endif
