/* icosphere.c - an icosahedron whose triangles are cut into four again and again.
 *
 *         2
 *        / \           Edge k of a triangle runs from corner k to corner k + 1. A level has V
 *       / 2 \          vertices, E edges and F triangles. In the next one the middle of edge e is
 *      m2----m1        vertex V + e; the halves of e are the edges 2 e and 2 e + 1, the one at its
 *     / \ 3 / \        first vertex first; the three edges within triangle t are 2 E + 3 t + k,
 *    / 0 \ / 1 \       where k is the corner that it cuts off; and triangle t becomes 4 t + k at
 *   0-----m0----1      corner k, and 4 t + 3 in the middle.
 *
 * So each triangle is cut by itself, without a table of edges, by any thread. */
#include "remesh/icosphere.h"

#include "base/options.h"

#include <math.h>
#include <stdlib.h>

enum { FIRST_VERTICES = 12, FIRST_EDGES = 30, FIRST_TRIANGLES = 20 };

/* The golden ratio. */
#define PHI 1.618033988749894848

static const double icosahedron_points[FIRST_VERTICES][3] = {
    {-1, PHI, 0},  {1, PHI, 0},  {-1, -PHI, 0}, {1, -PHI, 0}, {0, -1, PHI},  {0, 1, PHI},
    {0, -1, -PHI}, {0, 1, -PHI}, {PHI, 0, -1},  {PHI, 0, 1},  {-PHI, 0, -1}, {-PHI, 0, 1}};

static const uint32_t icosahedron_triangles[FIRST_TRIANGLES][3] = {
    {0, 11, 5},  {0, 5, 1},  {0, 1, 7},  {0, 7, 10}, {0, 10, 11}, {1, 5, 9}, {5, 11, 4},
    {11, 10, 2}, {10, 7, 6}, {7, 1, 8},  {3, 9, 4},  {3, 4, 2},   {3, 2, 6}, {3, 6, 8},
    {3, 8, 9},   {4, 9, 5},  {2, 4, 11}, {6, 2, 10}, {8, 6, 7},   {9, 8, 1}};

/* A level: its triangles, their edges, and the vertices of each edge. */
typedef struct sphere_level {
    uint32_t vertices, edges, triangles;
    uint32_t (*corner)[3], (*edge)[3], (*ends)[2];
} sphere_level;

/* --- the icosahedron --- */

static void point_set_length_1(double *p, double x, double y, double z)
{
    const double length = sqrt(x * x + y * y + z * z);
    p[0] = x / length;
    p[1] = y / length;
    p[2] = z / length;
}

/* The edge from a to b, in either direction; a new one if there is none yet. */
static uint32_t level_edge_between(sphere_level *l, uint32_t a, uint32_t b)
{
    uint32_t e = 0;
    while (e < l->edges && !(l->ends[e][0] == b && l->ends[e][1] == a)) e++;
    if (e == l->edges) {
        l->ends[e][0] = a;
        l->ends[e][1] = b;
        l->edges++;
    }
    return e;
}

static void level_set_icosahedron(sphere_level *l, double *points)
{
    l->vertices = FIRST_VERTICES;
    l->triangles = FIRST_TRIANGLES;
    for (int v = 0; v < FIRST_VERTICES; v++) {
        const double *p = icosahedron_points[v];
        point_set_length_1(points + 3 * v, p[0], p[1], p[2]);
    }
    for (uint32_t t = 0; t < FIRST_TRIANGLES; t++)
        for (uint32_t k = 0; k < 3; k++) {
            const uint32_t *v = icosahedron_triangles[t];
            l->corner[t][k] = v[k];
            l->edge[t][k] = level_edge_between(l, v[k], v[(k + 1) % 3]);
        }
}

/* --- a level from the one before --- */

/* `to` has no edges if no level follows. */
typedef struct sphere_cut {
    const sphere_level *from;
    sphere_level *to;
    double *points;
} sphere_cut;

static void edges_cut(void *work, uint64_t begin, uint64_t end)
{
    const sphere_cut *cut = work;
    for (uint64_t e = begin; e < end; e++) {
        const uint32_t *ends = cut->from->ends[e], middle = cut->from->vertices + (uint32_t)e;
        const double *a = cut->points + 3 * (size_t)ends[0], *b = cut->points + 3 * (size_t)ends[1];
        point_set_length_1(cut->points + 3 * (size_t)middle, a[0] + b[0], a[1] + b[1], a[2] + b[2]);
        for (uint32_t half = 0; half < 2 && cut->to->ends; half++) {
            cut->to->ends[2 * e + half][0] = ends[half];
            cut->to->ends[2 * e + half][1] = middle;
        }
    }
}

static void triangle_cut_corners(const sphere_level *from, sphere_level *to, uint32_t t)
{
    const uint32_t *v = from->corner[t], *e = from->edge[t], base = from->vertices;
    for (uint32_t k = 0; k < 3; k++) {
        const uint32_t after = e[k], before = e[(k + 2) % 3];
        uint32_t *corner = to->corner[4 * (size_t)t + k];
        corner[k] = v[k];
        corner[(k + 1) % 3] = base + after;
        corner[(k + 2) % 3] = base + before;
        to->corner[4 * (size_t)t + 3][k] = base + after;
    }
}

/* The half of edge e at vertex v. */
static uint32_t edge_half_at(const sphere_level *l, uint32_t e, uint32_t v)
{
    return 2 * e + (l->ends[e][0] != v);
}

static void triangle_cut_edges(const sphere_level *from, sphere_level *to, uint32_t t)
{
    const uint32_t *v = from->corner[t], *e = from->edge[t], inner = 2 * from->edges + 3 * t;
    for (uint32_t k = 0; k < 3; k++) {
        const uint32_t next = (k + 1) % 3, last = (k + 2) % 3;
        uint32_t *edge = to->edge[4 * (size_t)t + k];
        edge[k] = edge_half_at(from, e[k], v[k]);
        edge[next] = inner + k;
        edge[last] = edge_half_at(from, e[last], v[k]);
        /* the middle triangle's edge from m(k) to m(k + 1) cuts off corner k + 1 */
        to->edge[4 * (size_t)t + 3][k] = inner + next;
        to->ends[inner + k][0] = from->vertices + e[k];
        to->ends[inner + k][1] = from->vertices + e[last];
    }
}

static void triangles_cut(void *work, uint64_t begin, uint64_t end)
{
    const sphere_cut *cut = work;
    for (uint64_t t = begin; t < end; t++) {
        triangle_cut_corners(cut->from, cut->to, (uint32_t)t);
        if (cut->to->ends) triangle_cut_edges(cut->from, cut->to, (uint32_t)t);
    }
}

static void level_release(sphere_level *l)
{
    free(l->corner);
    free(l->edge);
    free(l->ends);
    *l = (sphere_level){0};
}

/* Room for the arrays of a level with so many edges and triangles. */
static bool level_allocate(sphere_level *l, uint32_t edges, uint32_t triangles)
{
    l->corner = mw__alloc(triangles, sizeof *l->corner);
    l->edge = mw__alloc(triangles, sizeof *l->edge);
    l->ends = mw__alloc(edges, sizeof *l->ends);
    return l->corner && l->edge && l->ends;
}

/* Cut each triangle of a level, in two stages that take `share` of the job. */
static bool level_cut(const sphere_level *from, sphere_level *to, double *points, double share,
                      mw_job *job)
{
    sphere_cut cut = {from, to, points};
    to->vertices = from->vertices + from->edges;
    to->edges = 2 * from->edges + 3 * from->triangles;
    to->triangles = 4 * from->triangles;
    mw__job_stage(job, "cutting edges", share / 2);
    if (!mw__job_ranges(job, from->edges, edges_cut, &cut)) return false;
    mw__job_stage(job, "cutting triangles", share / 2);
    return !to->corner || mw__job_ranges(job, from->triangles, triangles_cut, &cut);
}

bool mw__icosphere_fill(uint32_t level, double *points, uint32_t *triangles, mw_job *job)
{
    sphere_level now = {0};
    bool done = level_allocate(&now, FIRST_EDGES, FIRST_TRIANGLES);
    if (done) level_set_icosahedron(&now, points);
    for (uint32_t i = 1; i <= level && done; i++) {
        const bool last = i == level;
        sphere_level next = {.corner = last ? (uint32_t(*)[3])triangles : NULL};
        if (!last)
            done = level_allocate(&next, 2 * now.edges + 3 * now.triangles, 4 * now.triangles);
        done = done && level_cut(&now, &next, points, last ? 0.75 : 0.25 / (level - 1), job);
        level_release(&now);
        if (!last) now = next;
    }
    for (uint32_t t = 0; t < FIRST_TRIANGLES && level == 0 && done && triangles; t++)
        for (uint32_t k = 0; k < 3; k++) triangles[3 * t + k] = now.corner[t][k];
    level_release(&now);
    return done;
}

/* --- */

mw_status mw_icosphere_size(uint32_t level, uint32_t *vertices, uint32_t *triangles,
                            mw_error *error)
{
    if (!vertices || !triangles)
        return mw__fail(error, MW_ERROR_ARGUMENT, "a pointer to a number is NULL");
    if (level > MW_ICOSPHERE_MAX_LEVEL)
        return mw__fail(error, MW_ERROR_ARGUMENT,
                        "an icosphere of level %u is too large; the highest level is %d", level,
                        MW_ICOSPHERE_MAX_LEVEL);
    *vertices = (UINT32_C(10) << 2 * level) + 2;
    *triangles = UINT32_C(20) << 2 * level;
    return MW_OK;
}

mw_status mw_icosphere_create(uint32_t level, const mw_remesh_options *options, double *points,
                              uint32_t *triangles, mw_error *error)
{
    static const mw_remesh_options defaults;
    uint32_t vertices, count;
    if (!points || !triangles)
        return mw__fail(error, MW_ERROR_ARGUMENT, "the points or the triangles are NULL");
    if (!options) options = &defaults;
    mw_status status = MW_RESERVED_CHECK(mw_remesh_options, options, error);
    if (!status) status = mw_icosphere_size(level, &vertices, &count, error);
    if (status) return status;
    mw_job job = mw__job(options->threads, options->progress);
    if (!mw__icosphere_fill(level, points, triangles, &job)) status = mw__fail_memory(error);
    return mw__job_end(&job, status, error);
}
