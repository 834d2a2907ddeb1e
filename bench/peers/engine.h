/* engine.h - what an engine does: it tells which triangle contains a point, and is measured beside
 * others. Ours are in engine_meshwalk.c; each peer is a file peer_NAME.cpp, linked only where
 * MW_BUILD_BENCH is set. */
#ifndef MW_BENCH_PEERS_ENGINE_H
#define MW_BENCH_PEERS_ENGINE_H

#include <meshwalk/predicates.h>

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/* What is measured. */
typedef enum engine_task {
    TASK_RANDOM,       /* queries uniform in the mesh, in random order */
    TASK_SORTED,       /* the same, given along a Hilbert curve */
    TASK_COHERENT,     /* a stream with steps of about one edge */
    TASK_HALF_OUTSIDE, /* every other one, at random, is in no triangle */
    /* as random, from the arrays of the mesh to the answers: what is built counts */
    TASK_TOTAL,
    /* each triangle is as likely as any other: as dense as the mesh is, in random order */
    TASK_DENSE,
    TASK_DELAUNAY,     /* the Delaunay triangulation of the points */
    TASK_CONNECTIVITY, /* from the arrays of the mesh to the first query */
    TASKS
} engine_task;

#define ENGINE_IN(task) (1u << TASK_##task)
#define ENGINE_UNORDERED                                                                           \
    (ENGINE_IN(RANDOM) | ENGINE_IN(HALF_OUTSIDE) | ENGINE_IN(TOTAL) | ENGINE_IN(DENSE))
#define ENGINE_ORDERED (ENGINE_IN(SORTED) | ENGINE_IN(COHERENT))

typedef enum engine_library {
    LIBRARY_MESHWALK,
    LIBRARY_CGAL,
    LIBRARY_EMBREE,
    LIBRARY_GEOS,
    LIBRARY_BOOST,
    LIBRARY_SCIPY,
    LIBRARY_MATPLOTLIB,
    LIBRARIES
} engine_library;

typedef enum engine_id {
#define ENGINE(id, name, library, exact, parallel, tasks, help) ENGINE_##id,
#include "bench/peers/engine.def"
    ENGINES
} engine_id;

/* The arrays of a mesh; they outlive all that is built of them. */
typedef struct engine_mesh {
    const double *points; /* x0 y0 x1 y1 ... */
    size_t point_count;
    const uint32_t *triangles; /* three vertices of each */
    size_t triangle_count;
} engine_mesh;

#define ENGINE_NONE UINT64_MAX /* the answer for a point in no triangle */
#define ENGINE_FAILED (-1.0)   /* in the place of seconds               */

/* What is built before the first query; engines with the same one share it. Each measures itself:
 * preparing the form in which queries are given, or answers are wanted, is no part of the seconds,
 * but what it needs to be told in doubles is. */
typedef struct engine_structure {
    /* The library and its version. NULL: it is not to be had on this machine. */
    const char *(*version)(void);
    /* Returns seconds. Where it fails, *self is NULL. */
    double (*build)(const engine_mesh *mesh, unsigned threads, void **self);
    /* All that is kept for queries; the arrays of the mesh, where they are used, not counted. */
    size_t (*bytes)(const void *self);
    /* The corners of an answer that is not ENGINE_NONE. No function: answers are numbers of
     * triangles in the arrays. */
    void (*corners)(const void *self, uint64_t answer, double corners[6]);
    void (*destroy)(void *self);
} engine_structure;

typedef struct engine_code {
    const engine_structure *structure;
    /* Returns seconds. */
    double (*locate)(void *self, const double *queries, size_t n, unsigned threads,
                     uint64_t *answers);
    /* For TASK_DELAUNAY alone: returns seconds. */
    double (*triangulate)(const double *points, size_t n, unsigned threads, size_t *bytes);
} engine_code;

/* Is q in the triangle, its border included? A triangle without area has no inside. Exact. */
static inline bool engine_contains(const double *a, const double *b, const double *c,
                                   const double *q)
{
    double area = mw_orient2d(a, b, c);
    if (area < 0) {
        const double *other = b;
        b = c;
        c = other;
    }
    return area != 0 && mw_orient2d(a, b, q) >= 0 && mw_orient2d(b, c, q) >= 0 &&
           mw_orient2d(c, a, q) >= 0;
}

#ifdef __cplusplus
}
#endif

#endif
