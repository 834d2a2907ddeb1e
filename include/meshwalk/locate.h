/**
 * @file locate.h
 * Which triangle of a planar mesh contains a point.
 *
 * A locator prepares one mesh for queries. It decides whether the mesh is an embedding. If the
 * mesh is not convex, the locator fills pockets and holes with ghost triangles of its own, so that
 * every walk can cross them; on request it leaves them open for the border walk. Any number of
 * threads may query one locator; each thread has its own cursor for what a query changes.
 *
 * The answer is exact and unique: a point on an edge or a vertex belongs to the lowest-numbered
 * triangle that contains it. The answer does not depend on walk, start, arithmetic, seed, threads
 * or the order of the queries.
 */
#ifndef MESHWALK_LOCATE_H
#define MESHWALK_LOCATE_H

#include <meshwalk/mesh.h>

#ifdef __cplusplus
extern "C" {
#endif

/** The walks: walks.def lists them. 0 lets the query choose. */
typedef enum mw_walk_kind {
    MW_WALK_AUTO = 0,
#define MW_WALK_ENTRY(id, symbol, name, source, help) MW_WALK_##id,
#include <meshwalk/walks.def>
    MW_WALK_COUNT
} mw_walk_kind;

/** How the first triangle of a walk is chosen: starts.def lists the ways. 0 lets the query choose.
 */
typedef enum mw_start_kind {
    MW_START_AUTO = 0,
#define MW_START_ENTRY(id, name, source, index, help) MW_START_##id,
#include <meshwalk/starts.def>
    MW_START_COUNT
} mw_start_kind;

/** How a walk decides its turns. The final triangle is decided exactly either way; some walks find
 * their way in doubles either way. MW_DOUBLE is for measurements. */
typedef enum mw_arithmetic { MW_EXACT = 0, MW_DOUBLE } mw_arithmetic;

/** The name of a walk, as on the command line ("straight"); NULL for any other number.
 * Thread-safe. */
MW_API const char *mw_walk_name(mw_walk_kind walk);
/** Where a walk was published, "Authors Year"; NULL for any other number. Thread-safe. O(1). */
MW_API const char *mw_walk_source(mw_walk_kind walk);
/** One line of help for a walk; NULL for any other number. Thread-safe. O(1). */
MW_API const char *mw_walk_help(mw_walk_kind walk);
/** The name of a start, as on the command line ("sorted"); NULL for any other number. Thread-safe.
 * O(1). */
MW_API const char *mw_start_name(mw_start_kind start);
/** One line of help for a start; NULL for any other number. Thread-safe. O(1). */
MW_API const char *mw_start_help(mw_start_kind start);
/** 1 if a start needs an index (mw_index_create()); 0 if not, or for any other number. Thread-safe.
 * O(1). */
MW_API int mw_start_has_index(mw_start_kind start);
/** The walk with a name (not NULL); MW_WALK_COUNT if there is none. Thread-safe. O(1). */
MW_API mw_walk_kind mw_walk_by_name(const char *name);
/** The start with a name (not NULL); MW_START_COUNT if there is none. Thread-safe. O(1). */
MW_API mw_start_kind mw_start_by_name(const char *name);

/** The kinds of places where a point can lie. */
typedef enum mw_where {
    MW_INSIDE = 0, /**< inside `triangle` */
    MW_ON_EDGE,    /**< on local edge `local` of `triangle` */
    MW_ON_VERTEX,  /**< at local vertex `local` of `triangle` */
    MW_OUTSIDE,    /**< in no triangle and no hole */
    MW_IN_HOLE,    /**< in hole `hole`: a bounded part of the plane that the mesh surrounds */
    /** Outside or in a hole, but within the tolerance; `triangle` is the nearest one. */
    MW_NEAR,
    MW_BAD, /**< a coordinate is NaN or infinite */
    MW_WHERE_COUNT
} mw_where;

/** The name of a place: "inside", "edge", "vertex", "outside", "hole", "near" or "bad"; NULL for
 * any other number. Thread-safe. O(1). */
MW_API const char *mw_where_name(mw_where where);

/** Where a point lies. */
typedef struct mw_location {
    /** Barycentric weights of the triangle's vertices: at least 0, sum 1 up to rounding, exactly 0
     * for a vertex off the edge that the point is on. MW_NEAR: weights of the nearest point. NaN
     * without a triangle. */
    double weight[3];
    uint32_t triangle; /**< the caller's number, or MW_NONE */
    /** The hole, for MW_IN_HOLE and for MW_NEAR in a hole; else MW_NONE. Holes are numbered from 0
     * in the order of the lowest triangle at their border. If several holes have the same lowest
     * triangle, their order depends on the mesh only. */
    uint32_t hole;
    uint8_t where; /**< mw_where */
    uint8_t local; /**< MW_ON_EDGE, MW_NEAR: local edge; MW_ON_VERTEX: local vertex; else 255 */
    uint16_t reserved;
    uint32_t reserved2;
} mw_location;

/** A mesh prepared for queries. Opaque; any number of threads may query one locator. */
typedef struct mw_locator mw_locator;

/** Whether pockets and holes of an embedding that is not convex are filled with ghost triangles. */
typedef enum mw_fill_mode {
    MW_FILL_AUTO = 0, /**< fill, unless `queries` is small */
    MW_FILL_YES,      /**< fill, so that every walk can cross them */
    MW_FILL_NO        /**< leave them open; only MW_WALK_BORDER (and MW_WALK_AUTO) walks there */
} mw_fill_mode;

/** Options of a locator. Zero-initialised options select the defaults. */
typedef struct mw_locator_options {
    int any;    /**< 1: accept a mesh that is not an embedding; see mw_locator_void_promise() */
    int border; /**< 1: build the index that mw_nearest_border() and tolerances need */
    /** 1: store twice the area of each triangle, 8 bytes; MW_WALK_DIRECT then saves a test per
     * triangle. */
    int areas;
    mw_fill_mode fill;
    /** Number of threads, also for building grids; 0: one per processor. The locator does not
     * depend on it. */
    uint32_t threads;
    const mw_progress *progress; /**< progress and cancelling, see base.h; NULL: none */
    /** 1: no chains are made after the locator: mw_locate() allocates no memory, and
     * mw_locator_info.bytes stays as it is. By default, walks that are long lead to chains for all
     * triangles, once in the life of a locator: see mw_locate(). */
    uint32_t no_late_chains;
    uint32_t reserved[2]; /**< must be zero */
    /** MW_FILL_AUTO: expected number of queries; a few do not repay filling. 0: many. */
    uint64_t queries;
} mw_locator_options;

/**
 * Prepare a mesh for queries.
 *
 * @param mesh     the mesh, which must outlive the locator; its fields may change meanwhile
 * @param options  NULL selects the defaults
 * @param out      receives the locator, owned by the caller (mw_locator_destroy()); NULL on failure
 * @param error    NULL, or receives the message of a failure
 * @return MW_OK; MW_ERROR_INPUT if the mesh has no triangle with an area, or is not an embedding
 *         (the error names the first defect); MW_ERROR_ARGUMENT for NULL or an option out of range;
 *         MW_ERROR_LIMIT for more than MW_MAX_TRIANGLES triangles, ghosts included;
 *         MW_ERROR_MEMORY, MW_CANCELLED.
 *
 * Thread-safe. Time: O(n) for n triangles; O(b log b) for b border edges if the mesh is not convex;
 * O(n log n), and 68 to 88 bytes a triangle, where walks from a grid are long
 * (mw_locator_info.guide).
 */
MW_API mw_status mw_locator_create(const mw_mesh *mesh, const mw_locator_options *options,
                                   mw_locator **out, mw_error *error);
/** Destroy a locator. NULL is allowed. */
MW_API void mw_locator_destroy(mw_locator *locator);

/** What a locator has built beside its mesh. */
typedef struct mw_locator_info {
    size_t bytes;             /**< memory in bytes, without the mesh */
    size_t border_bytes;      /**< of these, for the border index */
    size_t area_bytes;        /**< of these, for stored areas */
    uint32_t ghost_triangles; /**< triangles that fill pockets and holes */
    uint32_t holes;
    /** 1: walks run on a copy of the mesh that has ghosts or lacks flat triangles. */
    int copied;
    int embedding;       /**< 0: the mesh is not an embedding (mw_locator_options.any) */
    int unfilled;        /**< 1: the mesh is not convex, and pockets and holes are open */
    uint32_t components; /**< if unfilled: connected components, equal coordinates joined; else 1 */
    /** Of the bytes, for ghosts and their copy of the mesh; 0 without ghosts. */
    size_t fill_bytes;
    /** The guide that leads queries to their first triangle by default: MW_START_GRID,
     * MW_START_CURVE, MW_START_TWO_LEVEL_GRID, or MW_START_CHAINS if walks from these would be
     * long. MW_START_AUTO: no guide is built. */
    mw_start_kind guide;
    size_t guide_bytes; /**< of the bytes, for the guide and chains */
    /** Of these, for chains; 0: the locator has none. Chains are the guide, or they end long walks
     * if another guide starts far from a few triangles. Queries may make more chains, once: then
     * this number and the sums above grow (mw_locate()). */
    size_t chain_bytes;
} mw_locator_info;

/** Fill `info` with the sizes of a locator. O(1). */
MW_API void mw_locator_describe(const mw_locator *locator, mw_locator_info *info);

/** An edge at the border of a hole. */
typedef struct mw_hole_edge {
    uint32_t triangle; /**< the caller's number; the lowest at the border of the hole */
    uint32_t edge;     /**< local edge; the lowest of that triangle at the hole */
} mw_hole_edge;

/**
 * Tell where the holes of a mesh are: one edge at the border of each.
 *
 * @param locator  a locator whose pockets and holes are filled (mw_locator_info.unfilled is 0), not
 *                 edited
 * @param edges    receives mw_locator_info.holes edges, by the numbers of the holes
 * @param error    NULL, or receives the message of a failure
 * @return MW_OK; MW_ERROR_ARGUMENT for NULL or another kind of locator.
 *
 * Thread-safe. O(triangles), without allocation.
 */
MW_API mw_status mw_locator_holes(const mw_locator *locator, mw_hole_edge *edges, mw_error *error);

/** Which promise does not hold because the mesh is not an embedding (mw_locator_options.any), as a
 * text owned by the library; NULL for an embedding. Thread-safe. O(1). */
MW_API const char *mw_locator_void_promise(const mw_locator *locator);

/**
 * The index of a start: a grid, buckets, layers, a tree, or a sample along a curve. Opaque; any
 * number of threads may use one index.
 *
 * An index is only a guide to the first triangle. It may serve any locator, also that of another
 * mesh or of an edited mesh: answers stay exact, but walks get longer.
 */
typedef struct mw_index mw_index;

/** The vertex of a triangle at which a search descends to the next layer. */
typedef enum mw_descent {
    MW_DESCENT_AUTO = 0, /**< the nearest */
    MW_DESCENT_NEAREST,  /**< the vertex nearest to the point */
    /** The vertex with the largest orientation coordinate, as published for the direct walk. It is
     * farther from the point, so walks are longer. The barycentric and the direct walk know it
     * without a test; other walks make two tests. */
    MW_DESCENT_COORDINATE
} mw_descent;

/** Options of an index. Zero-initialised options select the defaults. */
typedef struct mw_index_options {
    /** Grids and buckets: approximate number of cells (MW_START_TWO_LEVEL_GRID: of its first
     * level), at most 2^30; 0: one per two vertices. MW_START_CURVE: sampled triangles; 0: one of
     * 32. At most 64 per triangle are made (65,536 in small meshes). */
    uint32_t cells;
    /** MW_START_LAYERS: layers, the mesh included, 1 to MW_MAX_LAYERS; 0: chosen by the size of
     * the mesh. */
    uint32_t layers;
    /** MW_START_LAYERS: probability of a vertex to be in the next layer; 0: 0.025 [Devillers
     * 2002]. */
    double ratio;
    mw_descent descent;          /**< MW_START_LAYERS: where a search goes down */
    uint64_t seed;               /**< MW_START_LAYERS: seed of the random vertices */
    const mw_progress *progress; /**< progress and cancelling, see base.h; NULL: none */
    /** MW_START_GRID: 1 keeps the corners of each cell's triangle, 12 bytes a cell more. A single
     * query then loads the corners and the triangle from memory at the same time. In a large mesh
     * it takes about an eighth less time; the time of a batch does not change. An editor ignores
     * this option. */
    uint32_t corners;
    uint32_t reserved[3]; /**< must be zero */
} mw_index_options;

/** The most layers of an index, the mesh included. */
#define MW_MAX_LAYERS 8

/**
 * Build the index of a start that needs one.
 *
 * @param locator  the locator; the index keeps nothing of it
 * @param start    a start for which mw_start_has_index() is 1
 * @param options  NULL selects the defaults
 * @param out      receives the index, owned by the caller (mw_index_destroy()); NULL on failure
 * @param error    NULL, or receives the message of a failure
 * @return MW_OK; MW_ERROR_ARGUMENT for another start or options out of range; MW_ERROR_LIMIT for
 *         more than 2^30 cells; MW_ERROR_MEMORY, MW_CANCELLED.
 *
 * Thread-safe. Time: O(n) expected; O(n log n) for layers, the tree and chains.
 */
MW_API mw_status mw_index_create(const mw_locator *locator, mw_start_kind start,
                                 const mw_index_options *options, mw_index **out, mw_error *error);
/** Destroy an index. NULL is allowed. */
MW_API void mw_index_destroy(mw_index *index);

/** Sizes of an index. */
typedef struct mw_index_info {
    mw_start_kind start;
    size_t bytes;   /**< memory in bytes */
    double seconds; /**< how long building took */
    /** Cells of a grid (both levels), buckets, or samples of a curve. */
    uint32_t cells;
    uint32_t layers; /**< layers, the mesh included; else 0 */
    /** Vertices per layer, the mesh first; of a tree or chains one number. */
    uint32_t vertices[MW_MAX_LAYERS];
} mw_index_info;

/** Fill `info` with the sizes of an index. O(1). */
MW_API void mw_index_describe(const mw_index *index, mw_index_info *info);

/** How to answer queries. Zero-initialised options select the fastest way. */
typedef struct mw_query_options {
    mw_walk_kind walk;
    mw_start_kind start;
    mw_arithmetic arithmetic;
    /** The exact walk that ends walks whose own tests are only a guide: MW_WALK_REMEMBERING or
     * MW_WALK_STOCHASTIC; 0: remembering if a sample of edges is Delaunay, else stochastic. */
    mw_walk_kind finish;
    uint64_t seed; /**< seed of random choices; answers do not depend on it */
    /** MW_START_SAMPLE: triangles sampled, at most all; or a rule, MW_SAMPLE_... */
    uint32_t samples;
    /** MW_WALK_FAST_STOCHASTIC: its steps, one test each, at most 4096 + 45 sqrt(triangles); 0:
     * estimated from distance and density. */
    uint32_t steps;
    uint32_t threads; /**< batches: number of threads; 0: one per processor */
    /** Points outside the mesh, at most this far from it in mesh units, become MW_NEAR. At least
     * 0. Needs mw_locator_options.border. */
    double tolerance;
    int counters; /**< 1: count what the walks do */
    /** Batches: walks that run interleaved, at most MW_MAX_LANES; 0: chosen by the number of
     * queries, the part of the mesh that they cover, and the caches. */
    uint32_t lanes;
    const mw_index *index;       /**< for a start that needs one; must outlive the cursor */
    const mw_progress *progress; /**< progress and cancelling, see base.h; NULL: none */
    /** Batches: NULL, or a triangle per query, read and written: mw_locate_batch(). */
    uint32_t *hints;
    uint32_t reserved[2]; /**< must be zero */
} mw_query_options;

/** The most lanes of a batch. */
#define MW_MAX_LANES 64

/** Sample size: the cube root of the number of vertices, to the nearest; 17 for 4,897
 * [Devroye, Muecke, Zhu 1998; thesis App. D, sec. 5]. */
#define MW_SAMPLE_CUBE_ROOT_OF_VERTICES 0u
/** Sample size: 2 times the fourth root of the number of vertices, to the nearest
 * [Muecke, Saias, Zhu 1996; thesis App. F]. */
#define MW_SAMPLE_FOURTH_ROOT_OF_VERTICES UINT32_MAX

/**
 * What walks did, summed over queries. Filled if mw_query_options.counters is 1.
 *
 * A search has up to three stages: initialisation (turning round the first vertex), walk, and final
 * location (the exact walk that ends a cheap one). The border walk alternates between walk and
 * border. Each stage except the border counts the triangle that it starts in; triangles_visited
 * counts each entry once. Layers (MW_START_LAYERS) count like the mesh; the distances that choose
 * the vertex at which a search goes down are not counted. Tests of the triangles in a bucket
 * (MW_START_TRIANGLE_BUCKETS) and of chains (MW_START_CHAINS) count as orient_init. Counts do not
 * depend on threads. If queries start at the previous one (last, sorted, auto), counts depend on
 * lanes. Where long walks lead to chains (mw_locate()), they depend on what was asked before.
 */
typedef struct mw_counters {
    /** Walks; points that are not finite do not count. */
    uint64_t queries;
    /** Triangles entered, the first one included. */
    uint64_t triangles_visited;
    uint64_t triangles_max;                              /**< the most in one query */
    uint64_t triangles_init, triangles, triangles_final; /**< per stage */
    /** The most triangles_final in one query. */
    uint64_t triangles_final_max;
    uint64_t triangles_walk_max; /**< the most triangles in one query */
    /** Orientation tests per stage, and dot products of the celestial walk. The three tests of the
     * final answer do not count. */
    uint64_t orient_init, orient, orient_final;
    uint64_t implicit;               /**< positions of a point by the equation of a line */
    uint64_t comparisons;            /**< comparisons of coordinates */
    uint64_t walk_runs, border_runs; /**< MW_WALK_BORDER: runs of its two stages */
    /** MW_WALK_BORDER: at borders. */
    uint64_t triangles_border, triangles_border_max, orient_border;
    /** MW_WALK_BORDER: border edges tested. */
    uint64_t border_edges, border_edges_max;
    /** Walks that ran out of steps: in a cycle, or on a long way in a thin mesh. */
    uint64_t cycles;
    /** Walks that a walk with a proof of its end had to finish: those that ran out of steps, and
     * those that ended wrongly in doubles. That work counts as the final stage. */
    uint64_t handovers;
} mw_counters;

/** Add `more` to `sum`, for instance the counts of several threads. Thread-safe on different sums.
 * O(1). */
MW_API void mw_counters_add(mw_counters *sum, const mw_counters *more);

/**
 * The state of a series of queries: one per thread, a plain value that may be copied.
 *
 * Initialise it with mw_cursor_init(). A zero-initialised cursor takes the default options at its
 * first query. A cursor serves only the locator that it was initialised with; for an editor's
 * locator (edit.h), through all edits. Members other than `counters` are private.
 */
typedef struct mw_cursor {
    mw_counters counters; /**< of all queries so far, if enabled */
    const mw_index *index;
    uint64_t random;  /* state of the random numbers */
    double tolerance; /* as in the options */
    /* triangle of the last query (internal number) */
    uint32_t last;
    uint32_t sample;                                /* resolved number of samples */
    uint32_t steps;                                 /* as in the options */
    uint32_t fuel;                                  /* steps after which a walk hands over */
    uint8_t walk, start, finish, arithmetic, count; /* resolved options */
    uint8_t fast;                                   /* 1: the fast path is tried first */
    /* 1: an editor's mesh, which may have changed */
    uint8_t live;
    uint8_t reserved[9];
    uint32_t asked;     /* samples, as in the options */
    uint32_t last_name; /* number by which `last` is found after edits */
    uint64_t epoch;     /* of the mesh at the last query */
} mw_cursor;

/**
 * Initialise a cursor.
 *
 * With an index, MW_START_AUTO means the start of the index. Without an index, a single query
 * starts at the triangle found last if that is near, else where the locator's guide leads.
 * MW_START_SORTED acts as MW_START_LAST in single queries.
 *
 * @param locator  the locator that the cursor will serve
 * @param options  NULL selects the defaults
 * @param cursor   receives the initial state
 * @param error    NULL, or receives the message of a failure
 * @return MW_OK; MW_ERROR_ARGUMENT for an unknown walk or start, a `finish` that is neither
 *         remembering nor stochastic, a start without its index, an index of another start, a
 *         tolerance that is negative, NaN or infinite or without the border index, or another walk
 *         than the border walk where pockets and holes are open (mw_locator_info.unfilled).
 *
 * Thread-safe. O(1).
 */
MW_API mw_status mw_cursor_init(const mw_locator *locator, const mw_query_options *options,
                                mw_cursor *cursor, mw_error *error);

/**
 * Locate one point.
 *
 * @param locator  the locator
 * @param cursor   a cursor of this locator
 * @param x, y     any doubles, in mesh units
 * @return where the point lies; MW_BAD if x or y is not finite.
 *
 * Thread-safe with one cursor per thread. Sources: mw_walk_source() names that of each walk.
 *
 * Time: with MW_START_AUTO m queries of a mesh of n triangles take O(m log n + n log n), whatever
 * the mesh and the points, if the mesh is an embedding whose pockets and holes are filled and no
 * editor changes it (docs/proofs/queries.md); almost always a query takes O(1).
 *
 * No allocation, with one exception in the life of a locator, for meshes in which its guide leads
 * to long walks. The triangles of walks of more than 128 triangles are added up. The query with
 * which the sum reaches 16 times the triangles of the mesh makes chains for all triangles
 * (MW_START_CHAINS): 68 to 88 bytes each, in O(n log n), 0.1 to 0.5 seconds for a million
 * triangles. Other threads do not wait. From then on chains end long walks. If there is not enough
 * memory, walks stay long; no query reports that, and answers are the same.
 * mw_locator_info.chain_bytes tells whether there are chains, and mw_locator_options.no_late_chains
 * forbids them. Batches, segments and lines of sight do the same.
 */
MW_API mw_location mw_locate(const mw_locator *locator, mw_cursor *cursor, double x, double y);

/**
 * List the triangles that one query visits, in order.
 *
 * The first triangle is where the walk starts; each later one is entered over an edge of the
 * previous one. The list omits ghost triangles and the layers of an index: consecutive triangles
 * may have ghosts between them, and a walk to a point on the border may end beside the answer. A
 * triangle that flat triangles divide into parts counts once per part. Where pockets and holes are
 * open, a walk that finds nothing in one connected component restarts in another, and a walk along
 * a border may return to a triangle on it. Turns are decided exactly, whatever the cursor's
 * arithmetic.
 *
 * @param locator    the locator
 * @param cursor     a cursor of this locator
 * @param x, y       the point
 * @param triangles  receives at most `capacity` triangles
 * @param capacity   room in `triangles`
 * @param location   NULL, or receives the answer
 * @return how many triangles were visited, also if `capacity` is less; 0 if the point is not
 *         finite.
 *
 * Thread-safe with one cursor per thread. No allocation. No chains end a walk.
 */
MW_API size_t mw_walk_path(const mw_locator *locator, mw_cursor *cursor, double x, double y,
                           uint32_t *triangles, size_t capacity, mw_location *location);

/** The stages of a search, as mw_counters has them. */
typedef enum mw_walk_stage {
    MW_WALK_STAGE_INIT = 0, /**< turning round the first vertex */
    MW_WALK_STAGE_WALK,     /**< the walk */
    MW_WALK_STAGE_FINAL,    /**< the final location */
    MW_WALK_STAGE_BORDER    /**< along a border */
} mw_walk_stage;

/** The way of one query, and the line that its walk follows: for mw_walk_follow(). */
typedef struct mw_walk_way {
    uint32_t *triangles; /**< in: NULL, or room for `capacity` triangles */
    uint8_t *stages;     /**< in: NULL, or room for the mw_walk_stage of each triangle */
    size_t capacity;     /**< in */
    /** Out: the line from its first point, which need not be the middle of a triangle, to the
     * query. */
    double line[3][2];
    uint32_t line_points; /**< out: 2; 3 for the two legs of orthogonal walks; 0: no line */
} mw_walk_way;

/**
 * List the triangles that one query visits, as mw_walk_path() does, with the stage of each triangle
 * and the line that the walk follows.
 *
 * @param locator   the locator
 * @param cursor    a cursor of this locator
 * @param x, y      the point
 * @param way       arrays and capacity set by the caller; receives the way
 * @param location  NULL, or receives the answer
 * @return how many triangles were visited, also if the capacity is less; 0 if the point is not
 *         finite.
 *
 * Thread-safe with one cursor per thread. No allocation. No chains end a walk.
 */
MW_API size_t mw_walk_follow(const mw_locator *locator, mw_cursor *cursor, double x, double y,
                             mw_walk_way *way, mw_location *location);

/**
 * Locate n points.
 *
 * Starts. MW_START_AUTO means the locator's guide: a small grid, whose crowded cells have a sample
 * as for MW_START_CURVE. If consecutive queries are on average less than a sixth of an edge apart,
 * each starts where the previous one ended. A locator without a guide (pockets and holes open) uses
 * MW_START_SORTED for 64 queries and more, or MW_START_LAST if they already come in a good order.
 * With MW_START_LAST and MW_START_SORTED a thread takes 16,384 queries at a time, in `lanes` runs;
 * the first query of a run starts as with MW_START_SAMPLE, each other query where the previous one
 * ended.
 *
 * Hints, for particles: options->hints holds the triangle where each query starts. With
 * MW_START_AUTO query i starts at triangle hints[i] if that is near; with any other start it
 * always does. MW_NONE, and a number that no triangle has, is no hint: the query starts as `start`
 * says, or at the nearest of a sample for MW_START_LAST and MW_START_SORTED. Afterwards hints[i] is
 * the triangle of locations[i], and is unchanged if that location has none. Hints change the time,
 * never the answer. For an editor's locator the number of a removed triangle leads to one that
 * replaced it.
 *
 * @param locator    the locator
 * @param points     x, y of point i at points[i * stride] and the double after it
 * @param n          number of points
 * @param stride     doubles from one point to the next; 0 means 2
 * @param options    NULL selects the defaults
 * @param locations  receives n results in the order of the points, equal for every number of
 *                   threads; unspecified on failure, as hints are
 * @param counters   NULL, or receives the sums over the batch (if enabled by the options)
 * @param error      NULL, or receives the message of a failure
 * @return MW_OK; MW_ERROR_ARGUMENT for NULL, a stride of 1, and as mw_cursor_init();
 *         MW_ERROR_MEMORY, MW_CANCELLED.
 *
 * Thread-safe. Time: n walks, and the sort if queries are sorted.
 */
MW_API mw_status mw_locate_batch(const mw_locator *locator, const double *points, size_t n,
                                 size_t stride, const mw_query_options *options,
                                 mw_location *locations, mw_counters *counters, mw_error *error);

/**
 * A border edge and its point nearest to a query.
 *
 * A border edge has a triangle with an area on one side, and no part of the mesh on the other. Flat
 * triangles do not count, and where two parts of the mesh lie along each other there is no border.
 * If vertices inside an edge divide it and the mesh covers one of the parts on the other side, the
 * other parts are border.
 */
typedef struct mw_nearest_border_point {
    uint32_t triangle; /**< the caller's number */
    uint32_t edge;     /**< local edge */
    /** In mesh units, rounded; 0 on the border; infinite beyond the largest double. */
    double distance;
    double point[2];  /**< the nearest point of the edge, rounded */
    double weight[3]; /**< the same point as weights of the triangle's vertices */
} mw_nearest_border_point;

/**
 * Find the border edge nearest to a point, exactly. Of several at the same distance: the lowest
 * triangle, then the lowest edge.
 *
 * @param locator  a locator with mw_locator_options.border
 * @param x, y     the point
 * @param nearest  receives the answer
 * @param error    NULL, or receives the message of a failure
 * @return MW_OK; MW_ERROR_ARGUMENT if the locator has no border index or the point is not finite.
 *
 * Thread-safe. O(log b) for b border edges if few are about equally near; O(b) at worst, in the
 * middle of a round hole.
 */
MW_API mw_status mw_nearest_border(const mw_locator *locator, double x, double y,
                                   mw_nearest_border_point *nearest, mw_error *error);

/**
 * Interpolate values at vertices linearly: result[i] is the sum of weight[k] * values[vertex k].
 *
 * @param mesh       the mesh in which the points were located
 * @param values     one value per vertex
 * @param locations  n locations
 * @param n          number of locations
 * @param result     receives n values: exact at vertices; NaN for a location without a triangle
 *
 * Thread-safe. O(n), without allocation.
 */
MW_API void mw_interpolate(const mw_mesh *mesh, const double *values, const mw_location *locations,
                           size_t n, double *result);

/**
 * Make values at triangles or faces continuous: each vertex gets the mean of the triangles around
 * it, weighted by area.
 *
 * @param mesh    the mesh
 * @param values  one value per triangle, or per face; NaN: it has none, and does not count
 * @param faces   the face of each triangle, as mw_mesh_file.faces; NULL: value i is of triangle i
 * @param result  receives one value per vertex, for mw_interpolate(); NaN where no triangle has one
 * @param error   NULL, or receives the message of a failure
 * @return MW_OK; MW_ERROR_ARGUMENT for NULL; MW_ERROR_MEMORY.
 *
 * Thread-safe. O(triangles); allocates 8 bytes a vertex.
 */
MW_API mw_status mw_recover_vertex_values(const mw_mesh *mesh, const double *values,
                                          const uint32_t *faces, double *result, mw_error *error);

/** The type of the values of a table. */
typedef enum mw_value_type { MW_FLOAT64 = 0, MW_FLOAT32 } mw_value_type;

/**
 * Many values at each vertex, such as all time steps: value k of vertex v is at
 * values[v * stride + k * step].
 *
 * Values of one vertex side by side (`step` 1) are fastest. Fields one after another, as model
 * output has them, have a `stride` of 1 and a `step` of the number of vertices.
 */
typedef struct mw_value_table {
    const void *values; /**< doubles (MW_FLOAT64) or floats (MW_FLOAT32) */
    mw_value_type type;
    size_t count;  /**< values per vertex */
    size_t stride; /**< values from one vertex to the next; 0: count, or 1 if step is more than 1 */
    size_t step;   /**< values from one value of a vertex to the next; 0: 1 */
} mw_value_table;

/** Options of mw_interpolate_table(). Zero-initialised options select the defaults. */
typedef struct mw_interpolate_options {
    uint32_t threads;            /**< number of threads; 0: one per processor */
    const mw_progress *progress; /**< progress and cancelling, see base.h; NULL: none */
    uint32_t reserved[4];        /**< must be zero */
} mw_interpolate_options;

/**
 * Interpolate many values at each location: like mw_interpolate() for each value, but each
 * triangle is looked up once.
 *
 * @param mesh       the mesh in which the points were located
 * @param table      one row per vertex of the mesh; read during the call only
 * @param locations  n locations
 * @param n          number of locations
 * @param options    NULL selects the defaults
 * @param result     receives values of the table's type, packed: value k of location i at
 *                   result[i * count + k], or at result[k * n + i] if step is more than 1. Floats
 *                   are summed as doubles and rounded once. NaN for a location without a triangle
 * @param error      NULL, or receives the message of a failure
 * @return MW_OK; MW_ERROR_ARGUMENT for NULL, an unknown type, or a stride less than count without
 *         a step; MW_CANCELLED.
 *
 * Thread-safe. The same bits for any number of threads. O(n) for each value. Allocates memory for
 * threads only.
 */
MW_API mw_status mw_interpolate_table(const mw_mesh *mesh, const mw_value_table *table,
                                      const mw_location *locations, size_t n,
                                      const mw_interpolate_options *options, void *result,
                                      mw_error *error);

#ifdef __cplusplus
}
#endif
#endif
