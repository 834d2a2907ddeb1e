/* layout.c - vertices along a Hilbert curve, triangles by their lowest vertex. O(n).
 *
 * Triangles are scattered to the parts of their lowest vertices first, then sorted within each, in cache; a part is a
 * thread's work. */
#include "mesh/layout.h"

#include "base/threads.h"
#include "mesh/curve.h"

#include <stdlib.h>

enum {
    CHUNKS = 64,         /* of the caller's triangles, each scattered by one thread     */
    PART_SHIFT = 12,     /* at least so many vertices, as a power of two, make a part   */
    MOST_PARTS = 1 << 12 /* written to at the same time                                 */
};

/* --- is it worth it? --- */

static bool are_far(uint32_t a, uint32_t b)
{
    enum { FAR = 4096 };
    return (a > b ? a - b : b - a) > FAR;
}

/* The walk goes from a triangle to its neighbours, whose numbers the arrays do not tell; but triangles that lie together
 * share vertices, and with vertices in good order triangles that follow each other name close ones. */
bool mw__is_scattered(const mw_arrays *arrays)
{
    enum { SMALL = 1 << 14, PROBES = 4096 };
    size_t n = arrays->triangle_count, stride = n / PROBES + 1, edges = 0, far = 0;
    if (n < SMALL) return false; /* fits the cache in any order */
    for (size_t t = 0; t + 1 < n; t += stride) {
        uint32_t v[4];
        for (size_t k = 0; k < 4; k++) v[k] = mw__index_at(arrays, 3 * t + k);
        edges += 3;
        far += (size_t)are_far(v[0], v[1]) + are_far(v[1], v[2]) + are_far(v[0], v[3]);
    }
    return far > edges / 4;
}

bool mw__are_scattered(const mw_point *points, uint32_t n)
{
    enum { SMALL = 1 << 14, PROBES = 4096 };
    if (n < SMALL) return false;
    uint32_t stride = n / PROBES + 1, jumps = 0, probes = 0;
    double low[2] = {INFINITY, INFINITY}, high[2] = {-INFINITY, -INFINITY};
    for (uint32_t i = 0; i < n; i += stride) {
        const double p[2] = {points[i].x, points[i].y};
        for (int k = 0; k < 2; k++) {
            low[k] = fmin(low[k], p[k]);
            high[k] = fmax(high[k], p[k]);
        }
    }
    double far = 16 * sqrt((high[0] - low[0]) / n * (high[1] - low[1]));
    for (uint32_t i = 0; i + 1 < n; i += stride, probes++)
        jumps += !(fabs(points[i].x - points[i + 1].x) + fabs(points[i].y - points[i + 1].y) < far);
    return jumps > probes / 4;
}

/* --- vertices --- */

bool mw__give_points(mw_mesh *mesh, const mw_point *given, uint32_t *order, uint32_t threads)
{
    enum { AHEAD = 16, WORTHWHILE = 1 << 14 };
    uint32_t n = mesh->point_count;
    mesh->users_vertex = order;
    mesh->point = mw__alloc_lines(n, sizeof *mesh->point);
    mesh->vertex_place = order ? mw__alloc_lines(n, sizeof *mesh->vertex_place) : NULL;
    if (!mesh->point || (order && !mesh->vertex_place)) return false;
    int team = mw__team(threads, n / WORTHWHILE + 1);
    (void)team; /* unused without OpenMP */
#ifdef _OPENMP
#pragma omp parallel for schedule(static) num_threads(team) if (team > 1)
#endif
    for (uint32_t i = 0; i < n; i++) {
        if (order && i + AHEAD < n) __builtin_prefetch(&given[order[i + AHEAD]]);
        mesh->point[i] = given[order ? order[i] : i];
        if (order) mesh->vertex_place[order[i]] = i;
    }
    return true;
}

bool mw__lay_out_vertices(mw_mesh *mesh, uint32_t threads)
{
    if (mesh->users_vertex || !mw__are_scattered(mesh->point, mesh->point_count)) return true;
    uint32_t *order = mw__alloc_lines(mesh->point_count, sizeof *order);
    if (!order || !mw__curve_order(mesh->point, mesh->point_count, threads, order)) {
        free(order);
        return false;
    }
    mw_point *given = mesh->point;
    bool done = mw__give_points(mesh, given, order, threads);
    for (uint32_t t = 0; t < mesh->tri_count && done; t++)
        for (int k = 0; k < 4; k++) mesh->tri[t].v[k] = mesh->vertex_place[mesh->tri[t].v[k]];
    free(given);
    return done;
}

typedef struct layout {
    mw_mesh *mesh;
    const mw_arrays *arrays;
    mw_parts *parts;
    int team;
    uint32_t bad; /* the first triangle that is unusable, or MW_NONE                                      */
    bool all_finite;
    uint32_t *next; /* per chunk and part: the triangles that go there, then the place of the next of them */
} layout;

static mw_point point_at(const mw_arrays *arrays, size_t i)
{
    const double *p = arrays->points + i * (arrays->point_stride ? arrays->point_stride : 2);
    return (mw_point){p[0], p[1]};
}

/* Number the vertices, and copy the points in their new order. */
static bool place_vertices(layout *l, uint32_t threads)
{
    uint32_t n = l->mesh->point_count, *order = mw__alloc_lines(n, sizeof *order);
    mw_point *given = mw__alloc_lines(n, sizeof *given);
    bool finite = true, done = given && order;
#ifdef _OPENMP
#pragma omp parallel for schedule(static) num_threads(l->team) if (l->team > 1) reduction(&& : finite)
#endif
    for (uint32_t i = 0; i < n; i++) {
        if (!done) continue;
        given[i] = point_at(l->arrays, i);
        finite = finite && mw__is_finite(given[i]);
    }
    l->all_finite = finite;
    done = done && mw__curve_order(given, n, threads, order);
    if (!done) free(order);
    done = done && mw__give_points(l->mesh, given, order, threads);
    free(given);
    return done;
}

/* --- triangles --- */

static size_t chunk_begin(const layout *l, uint32_t chunk)
{
    return l->arrays->triangle_count * chunk / CHUNKS;
}

/* The vertices of a triangle by their new numbers, and the lowest; that is MW_NONE where the triangle is not usable. */
typedef struct corners {
    uint32_t v[3], low;
} corners;

static MW_INLINE corners take(const layout *l, size_t t)
{
    const mw_mesh *mesh = l->mesh;
    corners c = {.low = MW_NONE};
    for (size_t k = 0; k < 3; k++) {
        uint32_t given = mw__index_at(l->arrays, 3 * t + k);
        if (MW_UNLIKELY(given >= mesh->point_count)) return (corners){.low = MW_NONE};
        c.v[k] = mesh->vertex_place[given];
        if (MW_UNLIKELY(!l->all_finite && !mw__is_finite(mesh->point[c.v[k]]))) return (corners){.low = MW_NONE};
        if (c.v[k] < c.low) c.low = c.v[k];
    }
    if (MW_UNLIKELY(c.v[0] == c.v[1] || c.v[1] == c.v[2] || c.v[2] == c.v[0])) c.low = MW_NONE;
    return c;
}

/* Returns the first triangle of the chunk that is not usable, or MW_NONE. */
static uint32_t count_chunk(const layout *l, uint32_t chunk)
{
    uint32_t *count = l->next + (size_t)chunk * l->parts->count;
    for (size_t t = chunk_begin(l, chunk); t < chunk_begin(l, chunk + 1); t++) {
        corners c = take(l, t);
        if (MW_UNLIKELY(c.low == MW_NONE)) return (uint32_t)t;
        count[mw__part_of(l->parts, c.low)]++;
    }
    return MW_NONE;
}

static void scatter_chunk(const layout *l, uint32_t chunk)
{
    uint32_t *next = l->next + (size_t)chunk * l->parts->count;
    for (size_t t = chunk_begin(l, chunk); t < chunk_begin(l, chunk + 1); t++) {
        corners c = take(l, t);
        mw_triangle *to = &l->mesh->tri[next[mw__part_of(l->parts, c.low)]++];
        *to = (mw_triangle){.v = {c.v[0], c.v[1], c.v[2]}, .user = (uint32_t)t};
    }
}

/* Where the parts begin, and in them the triangles of each chunk. */
static void add_up(const layout *l)
{
    uint32_t sum = 0, parts = l->parts->count;
    for (uint32_t p = 0; p < parts; p++) {
        l->parts->first[p] = sum;
        for (uint32_t c = 0; c < CHUNKS; c++) {
            uint32_t *next = &l->next[(size_t)c * parts + p], here = *next;
            *next = sum;
            sum += here;
        }
    }
    l->parts->first[parts] = sum;
}

static void scatter(layout *l)
{
#ifdef _OPENMP
#pragma omp parallel for schedule(static) num_threads(l->team) if (l->team > 1)
#endif
    for (uint32_t c = 0; c < CHUNKS; c++) {
        uint32_t bad = count_chunk(l, c);
        if (bad == MW_NONE) continue;
#ifdef _OPENMP
#pragma omp critical(mw_layout)
#endif
        if (bad < l->bad) l->bad = bad;
    }
    if (l->bad != MW_NONE) return;
    add_up(l);
#ifdef _OPENMP
#pragma omp parallel for schedule(static) num_threads(l->team) if (l->team > 1)
#endif
    for (uint32_t c = 0; c < CHUNKS; c++) scatter_chunk(l, c);
}

static uint32_t lowest(const mw_triangle *t)
{
    uint32_t low = t->v[0] < t->v[1] ? t->v[0] : t->v[1];
    return t->v[2] < low ? t->v[2] : low;
}

/* Sort the triangles of a part by their lowest vertices, in the caller's order where these are equal. */
static void sort_part(const layout *l, uint32_t p, uint32_t *next, mw_triangle *scratch)
{
    mw_mesh *mesh = l->mesh;
    mw_triangle *tri = mesh->tri + l->parts->first[p];
    uint32_t n = l->parts->first[p + 1] - l->parts->first[p], base = mw__part_begin(l->parts, p);
    uint32_t size = mw__part_size(l->parts, p, mesh->point_count), sum = l->parts->first[p];
    for (uint32_t i = 0; i < size; i++) next[i] = 0;
    for (uint32_t i = 0; i < n; i++) {
        next[lowest(&tri[i]) - base]++;
        scratch[i] = tri[i];
    }
    for (uint32_t i = 0; i < size; i++) {
        uint32_t here = next[i];
        next[i] = sum;
        sum += here;
    }
    for (uint32_t i = 0; i < n; i++) {
        uint32_t place = next[lowest(&scratch[i]) - base]++;
        mesh->tri[place] = (mw_triangle){.v = {scratch[i].v[0], scratch[i].v[1], scratch[i].v[2], scratch[i].v[0]},
                                         .link = {MW_NONE, MW_NONE, MW_NONE},
                                         .user = scratch[i].user};
        mesh->triangle_place[scratch[i].user] = place;
    }
}

static bool sort_parts(const layout *l)
{
    uint32_t most = 0;
    for (uint32_t p = 0; p < l->parts->count; p++) {
        uint32_t n = l->parts->first[p + 1] - l->parts->first[p];
        if (n > most) most = n;
    }
    int team = mw__team((uint32_t)l->team, l->parts->count);
    (void)team; /* unused without OpenMP */
    bool done = true;
#ifdef _OPENMP
#pragma omp parallel num_threads(team) if (team > 1)
#endif
    {
        uint32_t *next = mw__alloc((size_t)1 << l->parts->shift, sizeof *next);
        mw_triangle *scratch = mw__alloc_lines(most, sizeof *scratch);
        bool mine = next && scratch;
#ifdef _OPENMP
#pragma omp for schedule(dynamic)
#endif
        for (uint32_t p = 0; p < l->parts->count; p++)
            if (mine) sort_part(l, p, next, scratch);
        free(next);
        free(scratch);
#ifdef _OPENMP
#pragma omp critical(mw_layout)
#endif
        done = done && mine;
    }
    return done;
}

/* --- all --- */

static void choose_parts(const mw_mesh *mesh, mw_parts *parts)
{
    parts->shift = PART_SHIFT;
    while (mesh->point_count >> parts->shift >= MOST_PARTS) parts->shift++;
    parts->count = (mesh->point_count >> parts->shift) + 1;
    parts->first = mw__alloc((size_t)parts->count + 1, sizeof *parts->first);
}

static mw_status place_all(layout *l, uint32_t threads, mw_error *error)
{
    mw_mesh *mesh = l->mesh;
    l->team = mw__team(threads, CHUNKS);
    mesh->tri = mw__alloc_lines(mesh->tri_count, sizeof *mesh->tri);
    mesh->triangle_place = mw__alloc_lines(mesh->tri_count, sizeof *mesh->triangle_place);
    l->next = mw__calloc((size_t)CHUNKS * l->parts->count, sizeof *l->next);
    if (!mesh->tri || !mesh->triangle_place || !l->next || !l->parts->first || !place_vertices(l, threads))
        return mw__fail_memory(error);
    scatter(l);
    if (l->bad != MW_NONE) return mw__copy_triangle(l->arrays, 2, false, l->bad, &mesh->tri[0], error);
    return sort_parts(l) ? MW_OK : mw__fail_memory(error);
}

mw_status mw__lay_out(mw_mesh *mesh, const mw_arrays *arrays, uint32_t threads, mw_parts *parts, mw_error *error)
{
    choose_parts(mesh, parts);
    layout l = {.mesh = mesh, .arrays = arrays, .parts = parts, .bad = MW_NONE};
    mw_status status = place_all(&l, threads, error);
    free(l.next);
    return status;
}
