/**
 * @file star.h
 * Which facet of a star-shaped polyhedron a ray from its centre meets [thesis App. F].
 *
 * A polyhedron is star-shaped about a centre that sees the inside of every facet: each ray from the
 * centre meets it exactly once. Every triangulation of a sphere is star-shaped.
 *
 * The answer is exact and unique: a ray through an edge or a vertex belongs to the lowest-numbered
 * facet that it meets. The answer does not depend on walk, start, seed, threads or the order of the
 * queries.
 */
#ifndef MESHWALK_STAR_H
#define MESHWALK_STAR_H

#include <meshwalk/locate.h>
#include <meshwalk/surface.h>

#ifdef __cplusplus
extern "C" {
#endif

/** The walks over a star-shaped polyhedron: star_walks.def lists them. 0 lets the query choose. */
typedef enum mw_star_walk_kind {
    MW_STAR_WALK_AUTO = 0,
#define MW_STAR_WALK_ENTRY(id, symbol, name, source, help) MW_STAR_WALK_##id,
#include <meshwalk/star_walks.def>
    MW_STAR_WALK_COUNT
} mw_star_walk_kind;

/** How the first facet of a walk is chosen: star_starts.def lists the ways. 0 lets the query
 * choose. */
typedef enum mw_star_start_kind {
    MW_STAR_START_AUTO = 0,
#define MW_STAR_START_ENTRY(id, name, source, index, help) MW_STAR_START_##id,
#include <meshwalk/star_starts.def>
    MW_STAR_START_COUNT
} mw_star_start_kind;

/** The name of a walk, as on the command line; NULL for any other number. Thread-safe. O(1). */
MW_API const char *mw_star_walk_name(mw_star_walk_kind walk);
/** Where a walk was published, "Authors Year"; NULL for any other number. Thread-safe. O(1). */
MW_API const char *mw_star_walk_source(mw_star_walk_kind walk);
/** One line of help for a walk; NULL for any other number. Thread-safe. O(1). */
MW_API const char *mw_star_walk_help(mw_star_walk_kind walk);
/** The name of a start, as on the command line; NULL for any other number. Thread-safe. O(1). */
MW_API const char *mw_star_start_name(mw_star_start_kind start);
/** One line of help for a start; NULL for any other number. Thread-safe. O(1). */
MW_API const char *mw_star_start_help(mw_star_start_kind start);
/** 1 if a start needs an index (mw_star_index_create()); 0 if not, or for any other number.
 * Thread-safe. O(1). */
MW_API int mw_star_start_has_index(mw_star_start_kind start);
/** The walk with a name (not NULL); MW_STAR_WALK_COUNT if there is none. Thread-safe. O(1). */
MW_API mw_star_walk_kind mw_star_walk_by_name(const char *name);
/** The start with a name (not NULL); MW_STAR_START_COUNT if there is none. Thread-safe. O(1). */
MW_API mw_star_start_kind mw_star_start_by_name(const char *name);

/** A surface prepared for rays from a centre. Opaque; any number of threads may query one star. */
typedef struct mw_star mw_star;

/** Options of a star. Zero-initialised options select the defaults. */
typedef struct mw_star_options {
    double centre[3]; /**< x, y, z of the centre; the origin by default */
    /** 1: store longitude and polar angle of each vertex, 16 bytes per vertex; the walk
     * MW_STAR_WALK_ORTHOGONAL needs them. */
    int angles;
    uint32_t threads;            /**< threads that prepare the star; 0: one per processor */
    const mw_progress *progress; /**< progress and cancelling, see base.h; NULL: none */
    /** 1: keep nothing but the centre. Rays then walk on the surface's own triangles, as in the
     * thesis, and the star takes a few hundred bytes; see mw_star_create(). */
    int borrow;
    /** With `borrow`, 1: trust that the surface is star-shaped, now and after every change.
     * Creating the star then takes O(1), and the star needs no update. */
    int unchecked;
    uint32_t reserved[2]; /**< must be zero */
} mw_star_options;

/**
 * Prepare a surface for rays from a centre.
 *
 * Decides exactly whether the surface is a closed polyhedron that is star-shaped about the centre.
 * Facets may have either orientation. Facets without area are accepted and contain no ray. Vertices
 * with equal coordinates are one vertex if the surface was created with `weld`: use that for
 * spheres with a seam or with a row of vertices at a pole.
 *
 * @param surface  the surface, which must outlive the star
 * @param options  NULL selects the defaults
 * @param out      receives the star, owned by the caller (mw_star_destroy()); NULL on failure
 * @param error    NULL, or receives the message of a failure
 * @return MW_OK; MW_ERROR_INPUT if the surface is not closed or not star-shaped about the centre
 *         (the error names one offending facet; mw_star_check_arrays() finds all);
 *         MW_ERROR_ARGUMENT for NULL or a centre that is not finite; MW_ERROR_MEMORY, MW_CANCELLED.
 *
 * A star with mw_star_options.borrow gives the same answers, bit for bit, but takes several times
 * as long: it has no guide, so a ray far from the previous one starts at the nearest of a sample,
 * and it visits facets in the order of the surface's memory. Its only walk is the stochastic one;
 * its starts are sample, last, sorted and random. A query looks at all facets if its walk has not
 * ended after some thousand facets, or if its ray passes through an edge or a vertex of a flat
 * facet. The check takes no memory, unless facets are flat: then 38 bytes a facet while it runs. If
 * an unchecked surface is not star-shaped, queries end all the same. The answer then is a facet
 * that the ray meets, though perhaps not the lowest; MW_OUTSIDE means that the ray meets none.
 *
 * Thread-safe. O(n) time for n facets.
 */
MW_API mw_status mw_star_create(const mw_surface *surface, const mw_star_options *options,
                                mw_star **out, mw_error *error);
/** Destroy a star. NULL is allowed. */
MW_API void mw_star_destroy(mw_star *star);

/** Options of mw_star_update(). Zero-initialised options select the defaults. */
typedef struct mw_star_update_options {
    /** The vertices that moved since the last update, in any order; no other vertex may have moved.
     * NULL: any vertex may have moved. Read during the call only. */
    const uint32_t *moved;
    size_t moved_count;          /**< how many vertices `moved` lists */
    uint32_t threads;            /**< threads; 0: one per processor */
    const mw_progress *progress; /**< progress and cancelling, see base.h; NULL: none */
    uint32_t reserved[4];        /**< must be zero */
} mw_star_update_options;

/**
 * Bring a star up to date with its changed surface, during the surface's update
 * (mw_surface_begin_update()).
 *
 * Decides again whether the surface is star-shaped about the centre. Until this succeeds, all
 * queries return MW_BAD. If mw_star_update_options.moved lists few vertices, only the facets round
 * these are decided again. All facets are decided again if edges were flipped, if the last update
 * failed or was left out, or if facets have no area. A star that is attached to an editor
 * (mw_surface_editor_attach_star()) follows edits by itself; updating it with an empty list of
 * vertices takes O(1) if the surface is star-shaped.
 *
 * @param star     the star
 * @param options  NULL selects the defaults
 * @param error    NULL, or receives the message of a failure
 * @return as mw_star_create(); also MW_ERROR_ARGUMENT if `moved` has a number that is no vertex.
 *         After a failure the star answers MW_BAD until an update succeeds.
 *
 * O(n); with a list O(k log k) for the k facets round the listed vertices, but the first update
 * with a list takes O(n), and 5 bytes a facet and 4 a vertex from then on. A borrowed star is
 * always decided as a whole, in O(n); an unchecked one needs no update. Not thread-safe.
 */
MW_API mw_status mw_star_update(mw_star *star, const mw_star_update_options *options,
                                mw_error *error);

/** 1 if the star is up to date and answers queries; 0 if they return MW_BAD. O(1). Thread-safe. */
MW_API int mw_star_ready(const mw_star *star);

/** Sizes of a star. */
typedef struct mw_star_info {
    size_t bytes;         /**< memory of the star in bytes, without the surface */
    size_t angle_bytes;   /**< of these, for the spherical coordinates */
    uint32_t flat_facets; /**< facets without area */
    double centre[3];
} mw_star_info;

/** Fill `info` with the sizes of a star. Thread-safe while no update runs. O(1). */
MW_API void mw_star_describe(const mw_star *star, mw_star_info *info);

/**
 * Find every defect of arrays as a polyhedron that is star-shaped about a centre.
 *
 * Defects are those of mw_surface_check_arrays(), then MW_DEFECT_OPEN_EDGE,
 * MW_DEFECT_THROUGH_CENTRE, MW_DEFECT_BACK_FACING, and, if there are none of these,
 * MW_DEFECT_COVERED. Facets may have either orientation; MW_DEFECT_CLASHING names edges at which no
 * orientation fits, as on one-sided surfaces. For unusable arrays only the defects that make them
 * unusable are found. check->valid is 1 if mw_star_create() would accept the arrays.
 *
 * @param arrays   as for mw_surface_create()
 * @param weld     as mw_surface_options.weld
 * @param options  centre and progress; NULL selects the defaults
 * @param check    receives the defects; release with mw_check_release()
 * @param error    NULL, or receives the message of a failure
 * @return MW_OK, also if defects were found; MW_ERROR_ARGUMENT, MW_ERROR_LIMIT, MW_ERROR_MEMORY,
 *         MW_CANCELLED.
 *
 * Thread-safe. O(n).
 */
MW_API mw_status mw_star_check_arrays(const mw_arrays *arrays, int weld,
                                      const mw_star_options *options, mw_check *check,
                                      mw_error *error);

/* --- the unit sphere -------------------------------------------------------------------------- */

/**
 * Compute the direction of a longitude and a latitude.
 *
 * x points to (0, 0), y to (90, 0), z to the north pole. Multiples of 90 degrees give exact
 * directions; longitudes that differ by 360 give equal ones. Other coordinates are off by less than
 * 2^-52.
 *
 * @param longitude  in degrees, any finite value
 * @param latitude   in degrees, -90 to 90
 * @param direction  receives x, y, z of length 1; NaN if an argument is not finite or the latitude
 *                   is out of range
 *
 * Thread-safe. O(1).
 */
MW_API void mw_lonlat_to_direction(double longitude, double latitude, double direction[3]);

/**
 * Compute the longitude and latitude of a direction, rounded. The longitude of a pole is 0.
 *
 * @param direction  x, y, z, not zero, of any length
 * @param longitude  receives degrees from -180 to 180; NaN for a zero or non-finite direction
 * @param latitude   receives degrees from -90 to 90; NaN likewise
 *
 * Thread-safe. O(1).
 */
MW_API void mw_direction_to_lonlat(const double direction[3], double *longitude, double *latitude);

/* --- queries ---------------------------------------------------------------------------------- */

/**
 * The index of a start. Opaque; any number of threads may use one index.
 *
 * An index is only a guide to the first facet. It may serve any star, also after an update; answers
 * stay exact.
 */
typedef struct mw_star_index mw_star_index;

/** Options of an index. Zero-initialised options select the defaults. */
typedef struct mw_star_index_options {
    /** Grids: approximate number of cells, at most 2^30; 0: one per 16 facets. At most 64 cells per
     * facet are made, or 65,536 on small polyhedra. */
    uint32_t cells;
    /** Octahedron: 1 plus the number of subdivisions, which is 0 to MW_STAR_MAX_LEVELS; 0: chosen
     * by the number of facets. */
    uint32_t levels;
    const mw_progress *progress; /**< progress and cancelling, see base.h; NULL: none */
    uint32_t reserved[4];        /**< must be zero */
} mw_star_index_options;

/** The most subdivisions of an octahedron. */
#define MW_STAR_MAX_LEVELS 12

/**
 * Build the index of a start that needs one.
 *
 * @param star     the star
 * @param start    a start for which mw_star_start_has_index() is 1
 * @param options  NULL selects the defaults
 * @param out      receives the index, owned by the caller (mw_star_index_destroy()); NULL on
 *                 failure
 * @param error    NULL, or receives the message of a failure
 * @return MW_OK; MW_ERROR_ARGUMENT for another start, options out of range, or a star that is not
 *         up to date; MW_ERROR_MEMORY, MW_CANCELLED.
 *
 * Thread-safe. Time: a short walk per cell.
 */
MW_API mw_status mw_star_index_create(const mw_star *star, mw_star_start_kind start,
                                      const mw_star_index_options *options, mw_star_index **out,
                                      mw_error *error);
/** Destroy an index. NULL is allowed. */
MW_API void mw_star_index_destroy(mw_star_index *index);

/** Sizes of an index. */
typedef struct mw_star_index_info {
    mw_star_start_kind start;
    size_t bytes;    /**< memory in bytes */
    double seconds;  /**< how long building took */
    uint32_t cells;  /**< cells of a grid, or triangles of the finest octahedron */
    uint32_t levels; /**< subdivisions of the octahedron; 0 for a grid */
} mw_star_index_info;

/** Fill `info` with the sizes of an index. Thread-safe. O(1). */
MW_API void mw_star_index_describe(const mw_star_index *index, mw_star_index_info *info);

/** How to answer queries. Zero-initialised options select the fastest way. */
typedef struct mw_star_query_options {
    mw_star_walk_kind walk;
    mw_star_start_kind start;
    /** The walk that ends the orthogonal walk: MW_STAR_WALK_STOCHASTIC, or MW_STAR_WALK_FORGETFUL,
     * which counts as the paper does; 0: stochastic. */
    mw_star_walk_kind finish;
    /** MW_STAR_START_SAMPLE: number of facets sampled; 0: 2 times the fourth root of the number of
     * vertices. */
    uint32_t samples;
    uint64_t seed;               /**< seed of random choices; answers do not depend on it */
    uint32_t threads;            /**< batches: number of threads; 0: one per processor */
    int counters;                /**< 1: count what the walks do */
    const mw_star_index *index;  /**< for a start that needs one; must outlive the cursor */
    const mw_progress *progress; /**< progress and cancelling, see base.h; NULL: none */
    uint32_t reserved[4];        /**< must be zero */
} mw_star_query_options;

/**
 * The state of a series of queries: one per thread, a plain value that may be copied.
 *
 * It serves only the star that it was initialised with, also after updates. Members other than
 * `counters` are private.
 */
typedef struct mw_star_cursor {
    /** Counts of all queries so far, if enabled. The stage `init` is the choice of the first facet
     * by an octahedron: three tests per triangle of its subdivisions on the way, as the published
     * table counts, though many triangles need fewer or none. */
    mw_counters counters;
    const mw_star_index *index;
    uint64_t random;
    uint32_t last;
    uint32_t sample;
    uint8_t walk, start, finish, count;
    uint8_t reserved[12];
} mw_star_cursor;

/**
 * Initialise a cursor.
 *
 * MW_STAR_START_AUTO begins at the facet of the previous query if the ray is near it. Otherwise an
 * index along a curve over the sphere gives a facet near the answer, whatever the order of the
 * queries. If this walk meets a vertex of 64 facets or more, it jumps to the facet there that faces
 * the ray.
 *
 * MW_STAR_START_SORTED acts as MW_STAR_START_LAST in single queries. In a batch of more queries
 * than facets each query starts at the facet of the previous one; in a smaller batch it starts
 * where the curve leads.
 *
 * @param star     the star that the cursor will serve
 * @param options  NULL selects the defaults
 * @param cursor   receives the initial state
 * @param error    NULL, or receives the message of a failure
 * @return MW_OK; MW_ERROR_ARGUMENT for an unknown walk or start, a `finish` that is neither
 *         stochastic nor forgetful, a start without its index, an index of another start, or the
 *         orthogonal walk on a star without angles.
 *
 * Thread-safe. O(1).
 */
MW_API mw_status mw_star_cursor_init(const mw_star *star, const mw_star_query_options *options,
                                     mw_star_cursor *cursor, mw_error *error);

/**
 * Find the facet that the ray from the centre through a point meets.
 *
 * The result's `where` is MW_INSIDE, MW_ON_EDGE or MW_ON_VERTEX; MW_BAD if the point is the centre
 * or not finite, or the star is not up to date. The ray meets the facet's plane at the sum of
 * weight[k] * vertex k: the weights are barycentric on the flat facet (on a sphere: of the central
 * projection, not areas on the sphere). Each weight is at least 0 and off by less than 2^-34; it is
 * exactly 0 for a vertex off an edge that the ray meets. The weights sum to 1 up to rounding. If
 * determinants leave the range of doubles, weights come from rounded differences and are less
 * exact.
 *
 * @param star    the star
 * @param cursor  a cursor of this star
 * @param point   x, y, z
 * @return the location, with the caller's facet number.
 *
 * Thread-safe with one cursor per thread. No allocation. Time: proportional to the facets that the
 * walk visits. Source: [thesis App. F].
 */
MW_API mw_location mw_star_locate(const mw_star *star, mw_star_cursor *cursor,
                                  const double point[3]);

/**
 * Locate n points as mw_star_locate() does.
 *
 * Results are in the order of the points and equal for every number of threads. MW_STAR_START_AUTO
 * means MW_STAR_START_SORTED for 64 queries and more.
 *
 * @param star       the star
 * @param points     x, y, z of point i at points[i * stride]
 * @param n          number of points
 * @param stride     doubles from one point to the next; 0 means 3
 * @param options    NULL selects the defaults
 * @param locations  receives n locations; unspecified on failure
 * @param counters   NULL, or receives the sums over the batch (if enabled by the options)
 * @param error      NULL, or receives the message of a failure
 * @return MW_OK; MW_ERROR_ARGUMENT for NULL, a stride of 1 or 2, and as mw_star_cursor_init();
 *         MW_ERROR_MEMORY, MW_CANCELLED.
 *
 * Thread-safe. Time: n walks, and the sort if queries are sorted.
 */
MW_API mw_status mw_star_locate_batch(const mw_star *star, const double *points, size_t n,
                                      size_t stride, const mw_star_query_options *options,
                                      mw_location *locations, mw_counters *counters,
                                      mw_error *error);

/**
 * Compute the point at which the ray from the centre through a point meets the polyhedron.
 *
 * Each coordinate is rounded once: it is the double nearest to the exact coordinate; a tie goes to
 * the double with an even last bit. So the result does not depend on how the facet was found. A ray
 * through a vertex ends exactly there.
 *
 * @param star     the star
 * @param cursor   a cursor of this star
 * @param point    x, y, z
 * @param meeting  receives x, y, z; NaN if the location is MW_BAD
 * @return the location, as of mw_star_locate().
 *
 * Thread-safe with one cursor per thread. No allocation. Time: as mw_star_locate().
 */
MW_API mw_location mw_star_project(const mw_star *star, mw_star_cursor *cursor,
                                   const double point[3], double meeting[3]);

/**
 * Project n points as mw_star_project() does.
 *
 * @param star       the star
 * @param points     x, y, z of point i at points[i * stride]
 * @param n          number of points
 * @param stride     doubles from one point to the next; 0 means 3
 * @param options    as for mw_star_locate_batch(); NULL selects the defaults
 * @param meetings   receives n points x, y, z, packed; unspecified on failure. It must not overlap
 *                   the points
 * @param locations  NULL, or receives n locations
 * @param error      NULL, or receives the message of a failure
 * @return as mw_star_locate_batch().
 *
 * Thread-safe. Results are equal for every number of threads. Time: as mw_star_locate_batch().
 */
MW_API mw_status mw_star_project_batch(const mw_star *star, const double *points, size_t n,
                                       size_t stride, const mw_star_query_options *options,
                                       double *meetings, mw_location *locations, mw_error *error);

/**
 * List the facets that one query visits, in order, with the first one. Each is linked to the
 * previous one, unless the walk has jumped round a vertex of many facets (mw_star_cursor_init()).
 *
 * @param star      the star
 * @param cursor    a cursor of this star
 * @param point     x, y, z
 * @param facets    receives at most `capacity` facets
 * @param capacity  room in `facets`
 * @param location  NULL, or receives the answer
 * @return how many facets the query visited, also if `capacity` is less.
 *
 * Thread-safe with one cursor per thread. No allocation. Time: as mw_star_locate().
 */
MW_API size_t mw_star_path(const mw_star *star, mw_star_cursor *cursor, const double point[3],
                           uint32_t *facets, size_t capacity, mw_location *location);

#ifdef __cplusplus
}
#endif
#endif
