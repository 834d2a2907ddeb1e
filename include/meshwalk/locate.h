/* locate.h - which triangle contains a point.
 *
 * A locator prepares one mesh for queries: it decides whether the mesh is an embedding, and, where the mesh is not
 * convex, fills the pockets and holes with marked ghost triangles of its own, so that every walk can cross them; or leaves them
 * open on request, for the border walk. It is const while it is queried; what a query changes sits in a cursor that each thread owns.
 *
 * The answer is exact and unique: a point on an edge or a vertex belongs to the lowest-numbered triangle that contains
 * it. It does not depend on walk, start, arithmetic, seed, threads or the order of the queries. */
#ifndef MESHWALK_LOCATE_H
#define MESHWALK_LOCATE_H

#include <meshwalk/mesh.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef enum mw_walk_kind {
    MW_WALK_AUTO = 0,
#define MW_WALK_ENTRY(id, symbol, name, source, help) MW_WALK_##id,
#include <meshwalk/walks.def>
    MW_WALK_COUNT
} mw_walk_kind;

typedef enum mw_start_kind {
    MW_START_AUTO = 0,
#define MW_START_ENTRY(id, name, source, index, help) MW_START_##id,
#include <meshwalk/starts.def>
    MW_START_COUNT
} mw_start_kind;

/* How a walk decides its turns; some find their way in doubles in either case. The final triangle is decided exactly in
 * either case; MW_DOUBLE is for measuring. */
typedef enum mw_arithmetic { MW_EXACT = 0, MW_DOUBLE } mw_arithmetic;

/* Names as on the command line ("straight", "sorted", "auto"); NULL for a number that is no walk or start. */
MW_API const char *mw_walk_name(mw_walk_kind walk);
MW_API const char *mw_walk_source(mw_walk_kind walk);
MW_API const char *mw_walk_help(mw_walk_kind walk);
MW_API const char *mw_start_name(mw_start_kind start);
MW_API const char *mw_start_help(mw_start_kind start);
/* 1: the start needs an index (mw_index_create), 0: it needs none, or the number is no start. */
MW_API int mw_start_has_index(mw_start_kind start);
/* The number of a name (not NULL); MW_WALK_COUNT or MW_START_COUNT if there is none. */
MW_API mw_walk_kind mw_walk_by_name(const char *name);
MW_API mw_start_kind mw_start_by_name(const char *name);

typedef enum mw_where {
    MW_INSIDE = 0, /* inside `triangle`                                                                */
    MW_ON_EDGE,    /* on local edge `local` of `triangle`                                              */
    MW_ON_VERTEX,  /* at local vertex `local` of `triangle`                                            */
    MW_OUTSIDE,    /* in no triangle and no hole                                                       */
    MW_IN_HOLE,    /* in hole `hole`: a bounded part of the plane that the mesh surrounds              */
    MW_NEAR,       /* outside or in a hole, but within the tolerance: `triangle` is the nearest one's  */
    MW_BAD,        /* the point has a coordinate that is NaN or infinite                               */
    MW_WHERE_COUNT
} mw_where;

/* "inside", "edge", "vertex", "outside", "hole", "near", "bad"; NULL for another number. */
MW_API const char *mw_where_name(mw_where where);

/* Where a point lies. */
typedef struct mw_location {
    double weight[3];  /* barycentric weights of the triangle's vertices: >= 0, sum 1 up to rounding, exactly 0 for the
                          vertices off the edge the point is on; for MW_NEAR, of the nearest point; else NaN        */
    uint32_t triangle; /* the caller's number, or MW_NONE                                                           */
    uint32_t hole;     /* MW_IN_HOLE and MW_NEAR in a hole: number of the hole; else MW_NONE. Holes are numbered from 0
                          in the order of the lowest-numbered triangle beside each; of several beside the same
                          triangle the order depends on the mesh only                                                */
    uint8_t where;     /* mw_where                                                                                  */
    uint8_t local;     /* MW_ON_EDGE and MW_NEAR: local edge; MW_ON_VERTEX: local vertex; else 255                  */
    uint16_t reserved;
    uint32_t reserved2;
} mw_location;

typedef struct mw_locator mw_locator;

/* Whether pockets and holes of an embedding that is not convex are filled with ghost triangles. */
typedef enum mw_fill_mode {
    MW_FILL_AUTO = 0, /* filled, unless `queries` is few                       */
    MW_FILL_YES,      /* filled, so that every walk can cross them             */
    MW_FILL_NO        /* left open, only MW_WALK_BORDER (and AUTO) walks there */
} mw_fill_mode;

typedef struct mw_locator_options {
    int any;    /* 1: take also a mesh that is no embedding; see mw_locator_void_promise                      */
    int border; /* 1: build the index that nearest-border queries and a tolerance need                        */
    int areas;  /* 1: store twice the area of each triangle, 8 bytes: MW_WALK_DIRECT then saves a test a triangle  */
    mw_fill_mode fill;
    uint32_t
        threads; /* 0: as many as processors; the locator is the same for any number. Its grids are made by as many, too */
    const mw_progress *progress; /* who watches, and may cancel: base.h; NULL: nobody */
    uint32_t reserved[3];
    uint64_t queries; /* MW_FILL_AUTO: about so many are to come; few do not pay for what filling takes. 0 = many */
} mw_locator_options;

/* Prepare a mesh for queries.
 *   mesh     must outlive the locator; its fields may change while that exists
 *   options  NULL = all zero
 *   out      owned by the caller (mw_locator_destroy); NULL on failure
 * MW_ERROR_INPUT: the mesh has no triangle with an area, or is no embedding; the error names the first defect.
 * MW_ERROR_ARGUMENT: NULL, or an option out of its range. MW_ERROR_LIMIT: more than MW_MAX_TRIANGLES with the ghosts.
 * MW_ERROR_MEMORY. */
MW_API mw_status mw_locator_create(const mw_mesh *mesh, const mw_locator_options *options, mw_locator **out,
                                   mw_error *error);
MW_API void mw_locator_destroy(mw_locator *locator); /* NULL is allowed */

/* What the locator has built beside the mesh. */
typedef struct mw_locator_info {
    size_t bytes;             /* all memory of the locator, mesh not counted       */
    size_t border_bytes;      /* of it, the index of the border                    */
    size_t area_bytes;        /* of it, the stored areas                           */
    uint32_t ghost_triangles; /* triangles that fill pockets and holes             */
    uint32_t holes;
    int copied;    /* 1: walks run on an own copy of triangles and points: with ghosts, or without flat triangles */
    int embedding; /* 0: only with options.any                          */
    int unfilled;  /* 1: not convex, and pockets and holes are not filled                  */
    uint32_t components; /* pieces that share no place (equal coordinates are one); only where unfilled, else 1 */
    size_t fill_bytes;   /* of the bytes, ghosts and the copy that they are in; 0 without ghosts           */
} mw_locator_info;
MW_API void mw_locator_describe(const mw_locator *locator, mw_locator_info *info);

/* For a mesh taken with options.any although it is no embedding: which promise is void, as a text; else NULL. */
MW_API const char *mw_locator_void_promise(const mw_locator *locator);

/* What some starts build beside the mesh: a grid, buckets, layers, a tree, or a sample along a curve. It is only a guide to the first triangle, so it may serve any
 * locator whatever its mesh, as one made after the mesh was edited: answers stay exact, walks get longer. Const while it
 * is queried. */
typedef struct mw_index mw_index;

/* At which vertex of a triangle of one layer to go down to the next: the nearest, which AUTO is, for every walk; or the
 * one with the largest orientation coordinate, as published for the direct walk. That one is farther off, and walks are
 * longer by it; the barycentric and the direct walk know it without a test, others make two. */
typedef enum mw_descent { MW_DESCENT_AUTO = 0, MW_DESCENT_NEAREST, MW_DESCENT_COORDINATE } mw_descent;

/* All zero = choose. */
typedef struct mw_index_options {
    uint32_t cells;     /* MW_START_GRID, MW_START_BUCKETS, MW_START_TRIANGLE_BUCKETS: about so many cells,
                        MW_START_TWO_LEVEL_GRID: of its first level; at most 2^30; 0 = one for two vertices. MW_START_CURVE: triangles that are sampled; 0 = one of 32. More than 64
                        for each triangle (65,536 in small meshes) are not made: they would only cost time and memory  */
    uint32_t layers;    /* MW_START_LAYERS: layers, the mesh itself counted, 1 to MW_MAX_LAYERS; 0 = by its size     */
    double ratio;       /* MW_START_LAYERS: chance of a vertex to be in the next layer; 0 = 0.025 [Devillers 2002]   */
    mw_descent descent; /* MW_START_LAYERS: the vertex to go down at                                             */
    uint64_t seed;      /* MW_START_LAYERS: of the random vertices                                               */
    const mw_progress *progress; /* who watches, and may cancel: base.h; NULL: nobody */
    uint32_t reserved[4];
} mw_index_options;

#define MW_MAX_LAYERS 8

/* Build the index of a start that needs one (mw_start_has_index): MW_START_GRID, MW_START_BUCKETS,
 * MW_START_TRIANGLE_BUCKETS, MW_START_TWO_LEVEL_GRID, MW_START_LAYERS, MW_START_KD_TREE or MW_START_CURVE.
 *   options  NULL = all zero
 *   out      owned by the caller (mw_index_destroy); keeps nothing of the locator; NULL on failure
 * MW_ERROR_ARGUMENT for another start or options out of range; MW_ERROR_LIMIT for more cells than 2^30;
 * MW_ERROR_MEMORY. */
MW_API mw_status mw_index_create(const mw_locator *locator, mw_start_kind start, const mw_index_options *options,
                                 mw_index **out, mw_error *error);
MW_API void mw_index_destroy(mw_index *index); /* NULL is allowed */

typedef struct mw_index_info {
    mw_start_kind start;
    size_t bytes;                     /* all its memory                                        */
    double seconds;                   /* it took to build                                      */
    uint32_t cells;                   /* of a grid, those of both levels, or buckets; of a curve, samples  */
    uint32_t layers;                  /* the mesh itself counted; else 0                       */
    uint32_t vertices[MW_MAX_LAYERS]; /* of each layer, the mesh first; of a tree, one number  */
} mw_index_info;
MW_API void mw_index_describe(const mw_index *index, mw_index_info *info);

/* How to answer a query. All zero = choose what is fast. */
typedef struct mw_query_options {
    mw_walk_kind walk;
    mw_start_kind start;
    mw_arithmetic arithmetic;
    mw_walk_kind finish;   /* the final location of the walks whose own tests are only a guide: MW_WALK_REMEMBERING or
                            MW_WALK_STOCHASTIC; 0 = remembering where a look at edges finds the mesh Delaunay            */
    uint64_t seed;         /* for everything random; answers do not depend on it                                  */
    uint32_t samples;      /* MW_START_SAMPLE: triangles looked at, at most all; or one of the rules below        */
    uint32_t steps;        /* MW_WALK_FAST_STOCHASTIC: its steps, one test each, at most 4096 + 45
                            sqrt(triangles); 0 = estimate by distance and density                       */
    uint32_t threads;      /* batches: 0: as many as processors                                                      */
    double tolerance;      /* >= 0; points outside at most this far from the mesh become MW_NEAR. Needs .border   */
    int counters;          /* 1: fill the counters                                                                */
    uint32_t lanes;        /* batches: walks in flight at a time, at most MW_MAX_LANES; 0 = choose by the number of
                            queries, the part of the mesh over which they lie, and the caches                      */
    const mw_index *index; /* for the starts that have one (mw_index_create), NULL else; must outlive the cursor */
    const mw_progress *progress; /* who watches, and may cancel: base.h; NULL: nobody */
    uint32_t *hints;             /* batches: NULL, or a triangle for each query, read and written: mw_locate_batch */
    uint32_t reserved[2];
} mw_query_options;

#define MW_MAX_LANES 64
/* Rules for the size of a sample, of the n vertices of the mesh, to the nearest whole number: the cube root of n, 17 for
 * 4,897 [Devroye, Muecke, Zhu 1998; thesis App. D, sec. 5], and 2 times its fourth root [Muecke, Saias, Zhu 1996; thesis App. F]. */
#define MW_SAMPLE_CUBE_ROOT_OF_VERTICES 0u
#define MW_SAMPLE_FOURTH_ROOT_OF_VERTICES UINT32_MAX

/* What the walks did, summed over queries; filled where options.counters says so. A search has up to three stages:
 * initialisation (turning round the first vertex), walk, and the final location that ends the cheap walks; the border walk
 * alternates between the walk and the border. Each beginning of a stage but the border counts the triangle it begins in again;
 * triangles_visited counts each entry once.
 * Layers (MW_START_LAYERS) are counted like the mesh itself; the tests in a bucket (MW_START_TRIANGLE_BUCKETS) are orient_init. Independent of threads; where queries begin at the one
 * before (last, sorted, auto), they depend on lanes. */
typedef struct mw_counters {
    uint64_t queries;           /* walks: points that are not finite are not counted */
    uint64_t triangles_visited; /* triangles entered, the first one included   */
    uint64_t triangles_max;     /* most of them by one query                   */
    uint64_t triangles_init, triangles, triangles_final;
    uint64_t triangles_final_max; /* most triangles_final of one query                                     */
    uint64_t triangles_walk_max;  /* most triangles of one query                                           */
    uint64_t orient_init, orient, orient_final; /* orientation tests (and dot products of the celestial walk); the final
                                                   answer's three are not counted                                      */
    uint64_t implicit;    /* positions of a point by the equation of a line                                  */
    uint64_t comparisons; /* comparisons of coordinates                                                      */
    /* MW_WALK_BORDER, whose stages are the walk and the border walk: */
    uint64_t walk_runs, border_runs;
    uint64_t triangles_border, triangles_border_max, orient_border;
    uint64_t border_edges, border_edges_max; /* edges of the border that were tested */
    uint64_t cycles; /* walks that ran out of steps: in a cycle or, in a long thin mesh, on a long way */
    /* Walks that one ended that surely ends (celestial; where the mesh is open, the border walk all along each border): those,
     * and such as in doubles ended wrongly. Its work counts as the final stage. */
    uint64_t handovers;
} mw_counters;

/* Add `more` to `sum`: for the cursors of several threads. */
MW_API void mw_counters_add(mw_counters *sum, const mw_counters *more);

/* What a query changes; one per thread. Initialise it with mw_cursor_init; a cursor that is all zero is initialised with the
 * default options by its first query. It may be copied freely. It serves only the locator it was initialised with; that of
 * an editor (edit.h) through all edits. */
typedef struct mw_cursor {
    mw_counters counters;
    const mw_index *index;
    uint64_t random;                                /* state of the random numbers                 */
    double tolerance;                               /* as in the options                           */
    uint32_t last;                                  /* triangle of the query before (internal number) */
    uint32_t sample;                                /* resolved number of samples                  */
    uint32_t steps;                                 /* as in the options                           */
    uint32_t fuel;                                  /* steps after which a walk hands over         */
    uint8_t walk, start, finish, arithmetic, count; /* resolved options          */
    uint8_t fast;                                   /* 1: the fast path is tried first */
    uint8_t live;                                   /* 1: the mesh is an editor's, and may have changed */
    uint8_t reserved[9];
    uint32_t asked;     /* samples, as in the options                  */
    uint32_t last_name; /* number by which `last` is found after edits */
    uint64_t epoch;     /* of the mesh at the query before             */
} mw_cursor;

/* options: NULL = all zero. MW_ERROR_ARGUMENT for an unknown walk or start, a finish that is neither remembering nor
 * stochastic, a start without its index, an index of another start, a tolerance that is negative, NaN or infinite, or
 * one without the border index, another walk than the border walk where pockets and holes are open
 * (mw_locator_info.unfilled). With an index and MW_START_AUTO the start is the index's; without, it is in single
 * queries the triangle found last if that is near, else what the locator's guide says. MW_START_SORTED in single
 * queries means MW_START_LAST. */
MW_API mw_status mw_cursor_init(const mw_locator *locator, const mw_query_options *options, mw_cursor *cursor,
                                mw_error *error);

/* Locate one point. Thread-safe with one cursor per thread; no allocation, no failure. */
MW_API mw_location mw_locate(const mw_locator *locator, mw_cursor *cursor, double x, double y);

/* The triangles that a query visits, in order: one query by the cursor, whose answer goes to *location (may be NULL). First
 * comes the one where it begins, and each further one is entered over an edge of the one before. Left out are the ghost
 * triangles that fill pockets and holes: two that follow each other may have such between them, and a walk to a point on the
 * border may end in one beside the answer; and the layers of an index. A triangle that flat ones part into several counts for
 * each part. Where pockets and holes are open, a walk that finds nothing in one piece begins again in another, and one along
 * a border may go back to a triangle on it. The walk decides its turns exactly, whatever the cursor's arithmetic. Writes at
 * most `capacity` of them and returns how many there were; none if the point is not finite. Thread-safe with one cursor per
 * thread; no allocation. */
MW_API size_t mw_walk_path(const mw_locator *locator, mw_cursor *cursor, double x, double y, uint32_t *triangles,
                           size_t capacity, mw_location *location);

/* The stages of a search, as mw_counters has them: turning round the first vertex, the walk, the final location, the way
 * along a border. */
typedef enum mw_walk_stage {
    MW_WALK_STAGE_INIT = 0,
    MW_WALK_STAGE_WALK,
    MW_WALK_STAGE_FINAL,
    MW_WALK_STAGE_BORDER
} mw_walk_stage;

/* The way of one query, and the line that its walk follows; see mw_walk_follow. */
typedef struct mw_walk_way {
    uint32_t *triangles; /* room for `capacity`, or NULL */
    uint8_t *stages;     /* room for as many, or NULL: the mw_walk_stage in which each was entered */
    size_t capacity;
    double line[3]
               [2]; /* out: from where the line begins, which need not be in the middle of a triangle, to the point */
    uint32_t line_points; /* out: 2; 3 for the orthogonal walks, two legs; 0: the walk follows no line */
} mw_walk_way;

/* As mw_walk_path, and tells also the stage of each triangle and the line. way->triangles, stages and capacity are set by
 * the caller. */
MW_API size_t mw_walk_follow(const mw_locator *locator, mw_cursor *cursor, double x, double y, mw_walk_way *way,
                             mw_location *location);

/* Locate n points.
 *   points    x, y of point i at points[i * stride] and the double after it; stride in doubles, 0 = 2
 *   locations n results, in input order, the same for every number of threads
 *   counters  NULL or filled with the sum over the batch (options->counters)
 * MW_START_AUTO means the locator's guide: a small grid, whose crowded cells have a sample as of MW_START_CURVE; queries that come, on
 * the average, less than a sixth of an edge apart begin where the one before ended. Where the locator has no guide, as where
 * pockets and holes are open, it means MW_START_SORTED for 64 queries and more, or MW_START_LAST if they come in about as good an
 * order already. MW_START_LAST and _SORTED: each thread takes 16,384 queries at a time, in `lanes` runs; the first query of a run begins
 * as with MW_START_SAMPLE, each other where the one before it ended.
 *
 * options->hints, for particles: n numbers of triangles, where the queries begin. With MW_START_AUTO query i begins at
 * triangle hints[i] if that is near, with any other start in any case. MW_NONE, and a number that no triangle has, is
 * no hint: the query begins as `start` says, or at the nearest of a sample if that is MW_START_LAST or MW_START_SORTED.
 * Afterwards hints[i] is the triangle of locations[i], or as it was where that has none. Hints change the time, never
 * the answer. In an editor's locator the number of a deleted triangle leads to one that replaced it.
 *
 * MW_ERROR_ARGUMENT as mw_cursor_init; MW_ERROR_MEMORY (then locations and hints are unspecified). */
MW_API mw_status mw_locate_batch(const mw_locator *locator, const double *points, size_t n, size_t stride,
                                 const mw_query_options *options, mw_location *locations, mw_counters *counters,
                                 mw_error *error);

/* The border edge nearest to a point, exactly: of several at the same distance the lowest triangle, then edge. A border
 * edge has a triangle with an area on one side, and on the other nothing that the mesh covers: flat triangles do not
 * count, and where two pieces lie along one another there is no border. Of an edge that is covered in part, where vertices lie
 * inside it, the other parts are border. */
typedef struct mw_nearest_border_point {
    uint32_t triangle; /* the caller's number */
    uint32_t edge;     /* local edge */
    double distance;   /* mesh units, rounded; 0 for a point on the border; infinite beyond the largest double */
    double point[2];   /* nearest point of that edge, rounded */
    double weight[3];  /* the same point as weights of the triangle's vertices, 0 for the one off the edge */
} mw_nearest_border_point;

/* Logarithmic in the border edges where few of them are about equally near; linear at worst, in the middle of a round
 * hole. MW_ERROR_ARGUMENT if the locator was made without options.border, or the point is not finite. Thread-safe. */
MW_API mw_status mw_nearest_border(const mw_locator *locator, double x, double y, mw_nearest_border_point *nearest,
                                   mw_error *error);

/* Linear interpolation: value[i] = sum of location[i].weight[k] * values[vertex k of its triangle], exact at vertices;
 * NaN where the location has no triangle. values: one per vertex of the mesh, in which the points were located.
 * Thread-safe. */
MW_API void mw_interpolate(const mw_mesh *mesh, const double *values, const mw_location *locations, size_t n,
                           double *result);

typedef enum mw_value_type { MW_FLOAT64 = 0, MW_FLOAT32 } mw_value_type;

/**
 * Many values at each vertex, such as those of all time steps: value k of vertex v at values[v * stride + k * step].
 *
 * Values of one vertex side by side (`step` 1) are the fastest. Where fields follow one another, as model output has
 * them, `stride` is 1 and `step` the number of vertices.
 */
typedef struct mw_value_table {
    const void *values; /**< of one double (MW_FLOAT64) or float (MW_FLOAT32) each              */
    mw_value_type type;
    size_t count;  /**< values of each vertex                                                          */
    size_t stride; /**< from one vertex to the next, in values; 0 = count, or 1 where step is more than 1     */
    size_t step;   /**< from one value of a vertex to the next, in values; 0 = 1                             */
} mw_value_table;

/** How mw_interpolate_table works. All zero = choose. */
typedef struct mw_interpolate_options {
    uint32_t threads;            /**< 0: as many as processors          */
    const mw_progress *progress; /**< who watches, and may cancel: base.h; NULL: nobody */
    uint32_t reserved[4];
} mw_interpolate_options;

/** Interpolate many values at each point: as mw_interpolate each of them, but looking up each triangle once.
 *
 * @param mesh       in which the points were located
 * @param table      read during the call only; a row for each vertex of the mesh
 * @param locations  n of them
 * @param options    NULL = all zero
 * @param result     of the table's type, packed: value k of location i at result[i * count + k], or, where step is more
 *                   than 1, at result[k * n + i]. Floats are summed as doubles and rounded once. NaN where the location
 *                   has no triangle
 * @return MW_ERROR_ARGUMENT: NULL, an unknown type, a stride that is less than count without a step. MW_CANCELLED
 *
 * Thread-safe; no allocation but for threads. The same bits for any number of threads.
 */
MW_API mw_status mw_interpolate_table(const mw_mesh *mesh, const mw_value_table *table, const mw_location *locations,
                                      size_t n, const mw_interpolate_options *options, void *result, mw_error *error);

#ifdef __cplusplus
}
#endif
#endif
