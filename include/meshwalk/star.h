/* star.h - which facet of a star-shaped polyhedron a ray from its centre meets [thesis App. F].
 *
 * A polyhedron is star-shaped about a centre that sees the inside of every facet: each ray from the centre meets it
 * once. The sphere is one, with any triangulation of it. The answer is exact and unique: a ray through an edge or a
 * vertex belongs to the lowest-numbered facet that it meets. It does not depend on walk, start, seed, threads or the
 * order of the queries. */
#ifndef MESHWALK_STAR_H
#define MESHWALK_STAR_H

#include <meshwalk/locate.h>
#include <meshwalk/surface.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef enum mw_star_walk_kind {
    MW_STAR_WALK_AUTO = 0,
#define MW_STAR_WALK_ENTRY(id, symbol, name, source, help) MW_STAR_WALK_##id,
#include <meshwalk/star_walks.def>
    MW_STAR_WALK_COUNT
} mw_star_walk_kind;

typedef enum mw_star_start_kind {
    MW_STAR_START_AUTO = 0,
#define MW_STAR_START_ENTRY(id, name, source, index, help) MW_STAR_START_##id,
#include <meshwalk/star_starts.def>
    MW_STAR_START_COUNT
} mw_star_start_kind;

/* Names as on the command line; NULL for a number that is no walk or start. */
MW_API const char *mw_star_walk_name(mw_star_walk_kind walk);
MW_API const char *mw_star_walk_source(mw_star_walk_kind walk);
MW_API const char *mw_star_walk_help(mw_star_walk_kind walk);
MW_API const char *mw_star_start_name(mw_star_start_kind start);
MW_API const char *mw_star_start_help(mw_star_start_kind start);
/* 1: the start needs an index (mw_star_index_create), 0: it needs none, or the number is no start. */
MW_API int mw_star_start_has_index(mw_star_start_kind start);
/* The number of a name (not NULL); MW_STAR_WALK_COUNT or MW_STAR_START_COUNT if there is none. */
MW_API mw_star_walk_kind mw_star_walk_by_name(const char *name);
MW_API mw_star_start_kind mw_star_start_by_name(const char *name);

/* A surface prepared for rays from a centre. Const while it is queried. */
typedef struct mw_star mw_star;

typedef struct mw_star_options {
    double centre[3]; /* the origin by default */
    int angles; /* 1: store longitude and polar angle of each vertex, 16 bytes each, for MW_STAR_WALK_ORTHOGONAL */
    const mw_progress *progress; /* who watches, and may cancel: base.h; NULL: nobody */
    uint32_t reserved[5];
} mw_star_options;

/* Prepare a surface: decides exactly whether it is a closed polyhedron, star-shaped about the centre. Facets may be
 * oriented either way. Vertices with equal coordinates are one where the surface was made with `weld`: wanted for
 * spheres with a seam or with a row of vertices at a pole. Facets without area are accepted, and never own a ray.
 *   surface  must outlive the star
 *   options  NULL = all zero
 *   out      owned by the caller (mw_star_destroy); NULL on failure
 * MW_ERROR_INPUT: not closed, or not star-shaped about the centre; the error names an offending facet (several: see
 * mw_star_check_arrays). MW_ERROR_ARGUMENT: NULL, a centre that is not finite; MW_ERROR_MEMORY. O(n). */
MW_API mw_status mw_star_create(const mw_surface *surface, const mw_star_options *options, mw_star **out,
                                mw_error *error);
MW_API void mw_star_destroy(mw_star *star); /* NULL is allowed */

/* Bring up to date with a surface that has changed, during its update (mw_surface_begin_update): decides anew
 * whether it is star-shaped about the centre, O(n). Errors as mw_star_create. Until it succeeds all queries get
 * MW_BAD. */
MW_API mw_status mw_star_update(mw_star *star, mw_error *error);

typedef struct mw_star_info {
    size_t bytes;       /* all memory of the star, surface not counted */
    size_t angle_bytes; /* of it, the spherical coordinates            */
    uint32_t flat_facets;
    double centre[3];
} mw_star_info;
MW_API void mw_star_describe(const mw_star *star, mw_star_info *info);

/* Every defect of the arrays as a polyhedron star-shaped about the centre of the options: those of
 * mw_surface_check_arrays, but facets may be oriented either way, so MW_DEFECT_CLASHING stands for edges at which no
 * orientation agrees (of one-sided surfaces) only; MW_DEFECT_OPEN_EDGE, MW_DEFECT_THROUGH_CENTRE,
 * MW_DEFECT_BACK_FACING; and if there is none of all these MW_DEFECT_COVERED. Of arrays that are unusable only what
 * makes them so. check->valid: 1 if mw_star_create takes it. O(n). MW_OK also when defects were found. Release with
 * mw_check_release. Thread-safe. */
MW_API mw_status mw_star_check_arrays(const mw_arrays *arrays, int weld, const mw_star_options *options,
                                      mw_check *check, mw_error *error);

/* --- the unit sphere ---------------------------------------------------------------------------------------------- */

/* The direction of a longitude and a latitude in degrees: x to (0, 0), y to (90, 0), z to the north pole. Multiples
 * of 90 degrees give exact directions, and longitudes that differ by 360 the same one; others are rounded, each
 * coordinate off by less than 2^-52. NaN where an argument is not finite, or the latitude's magnitude is above 90. */
MW_API void mw_lonlat_to_direction(double longitude, double latitude, double direction[3]);
/* The longitude (-180 to 180) and latitude of a direction (not zero, of any length; else NaN), rounded. The
 * longitude of a pole is 0. */
MW_API void mw_direction_to_lonlat(const double direction[3], double *longitude, double *latitude);

/* --- queries ------------------------------------------------------------------------------------------------------ */

/* What some starts build beside the star. It is only a guide to the first facet: it may serve any star, also after an
 * update, and answers stay exact. Const while it is queried. */
typedef struct mw_star_index mw_star_index;

/* All zero = choose. */
typedef struct mw_star_index_options {
    uint32_t cells;  /* grids: about so many cells, at most 2^30; 0 = one for 16 facets. More than 64 for
                        each facet (65,536 on small polyhedra) are not made, and no finer octahedron         */
    uint32_t levels; /* octahedron: subdivisions, 0 to MW_STAR_MAX_LEVELS, plus 1; 0 = by the number of facets */
    const mw_progress *progress; /* who watches, and may cancel: base.h; NULL: nobody */
    uint32_t reserved[4];
} mw_star_index_options;
#define MW_STAR_MAX_LEVELS 12

/* Build the index of a start that needs one. MW_ERROR_ARGUMENT for another start, options out of range, or a star
 * that is not up to date; MW_ERROR_MEMORY. */
MW_API mw_status mw_star_index_create(const mw_star *star, mw_star_start_kind start,
                                      const mw_star_index_options *options, mw_star_index **out, mw_error *error);
MW_API void mw_star_index_destroy(mw_star_index *index); /* NULL is allowed */

typedef struct mw_star_index_info {
    mw_star_start_kind start;
    size_t bytes;
    double seconds;  /* it took to build */
    uint32_t cells;  /* of a grid, or triangles of the finest octahedron */
    uint32_t levels; /* subdivisions of the octahedron; 0 of a grid      */
} mw_star_index_info;
MW_API void mw_star_index_describe(const mw_star_index *index, mw_star_index_info *info);

/* How to answer a query. All zero = choose what is fast. */
typedef struct mw_star_query_options {
    mw_star_walk_kind walk;
    mw_star_start_kind start;
    mw_star_walk_kind finish; /* the final location of the orthogonal walk: MW_STAR_WALK_STOCHASTIC, or
                                 MW_STAR_WALK_FORGETFUL, which counts as the paper does; 0 = stochastic           */
    uint32_t samples;         /* MW_STAR_START_SAMPLE: facets looked at; 0 = 2 times the fourth root of the vertices */
    uint64_t seed;            /* for everything random; answers do not depend on it                               */
    uint32_t threads;         /* batches: 0: as many as processors                                                   */
    int counters;             /* 1: fill the counters                                                             */
    const mw_star_index *index;  /* for the starts that have one, NULL else; must outlive the cursor               */
    const mw_progress *progress; /* who watches, and may cancel: base.h; NULL: nobody */
    uint32_t reserved[4];
} mw_star_query_options;

/* What a query changes: one per thread, a plain value. It serves only the star it was initialised with, also after
 * updates. Its members are private. */
typedef struct mw_star_cursor {
    mw_counters counters; /* of all queries so far, if they count. Of the stages, `init` is the choice of the first
                             facet by an octahedron: three tests for each triangle of its subdivision that the way
                             leads through, as the published table counts, though many take fewer or none */
    const mw_star_index *index;
    uint64_t random;
    uint32_t last;
    uint32_t sample;
    uint8_t walk, start, finish, count;
    uint8_t reserved[12];
} mw_star_cursor;

/* options: NULL = all zero. MW_ERROR_ARGUMENT: an unknown walk or start, a finish that is neither stochastic nor
 * forgetful, a start without its index, an index of another start, the orthogonal walk on a star without angles.
 * MW_STAR_START_SORTED means MW_STAR_START_LAST in single queries; in a batch of more queries than facets each begins
 * at the facet of the one before, in one of fewer where the curve leads. */
MW_API mw_status mw_star_cursor_init(const mw_star *star, const mw_star_query_options *options, mw_star_cursor *cursor,
                                     mw_error *error);

/* The facet that the ray from the centre through `point` meets. where: MW_INSIDE, MW_ON_EDGE or MW_ON_VERTEX; MW_BAD
 * where the point is the centre or not finite, or the star is not up to date. weight[k]: the ray meets the facet's
 * plane at sum of weight[k] * vertex k, so these are the barycentric weights of that point of the flat facet (on the
 * sphere: of the central projection onto it, not of areas on the sphere); each >= 0 and off by less than 2^-34,
 * exactly 0 for the vertices off an edge that the ray meets, sum 1 up to rounding; where determinants leave the
 * range of doubles, from rounded differences, and less exact. Thread-safe with one cursor per thread; no allocation. */
MW_API mw_location mw_star_locate(const mw_star *star, mw_star_cursor *cursor, const double point[3]);

/* The same for n points, x, y, z of point i at points[i * stride]; stride in doubles, 0 = 3. Results in input order,
 * the same for every number of threads. counters: NULL, or filled with the sum over the batch. MW_STAR_START_AUTO
 * means MW_STAR_START_SORTED for 64 queries and more. MW_ERROR_ARGUMENT as mw_star_cursor_init; MW_ERROR_MEMORY
 * (then locations is unspecified). */
MW_API mw_status mw_star_locate_batch(const mw_star *star, const double *points, size_t n, size_t stride,
                                      const mw_star_query_options *options, mw_location *locations,
                                      mw_counters *counters, mw_error *error);

/* The facets that a query visits, in order, the first one included: one query by the cursor, whose answer goes to
 * *location (may be NULL). Writes at most `capacity` of them and returns how many there were. */
MW_API size_t mw_star_path(const mw_star *star, mw_star_cursor *cursor, const double point[3], uint32_t *facets,
                           size_t capacity, mw_location *location);

#ifdef __cplusplus
}
#endif
#endif
