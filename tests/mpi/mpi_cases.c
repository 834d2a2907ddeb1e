/* mpi_cases.c - meshes and cuts. */
#include "mpi_cases.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* --- meshes ----------------------------------------------------------------------------------- */

static arrays with_room(const arrays *a, uint32_t points, uint32_t triangles)
{
    arrays b = arrays_make(a->point_count + points, a->triangle_count + triangles);
    memcpy(b.points, a->points, 2 * sizeof *a->points * a->point_count);
    memcpy(b.triangles, a->triangles, 3 * sizeof *a->triangles * a->triangle_count);
    b.point_count = a->point_count;
    b.triangle_count = a->triangle_count;
    return b;
}

void mpi_break_edges(arrays *a, uint32_t every, uint64_t *random)
{
    const uint32_t count = a->triangle_count;
    mw_mesh *mesh = arrays_mesh(a, (mw_mesh_options){.threads = 1});
    arrays b = with_room(a, count, 2 * count);
    bool *touched = calloc(count, sizeof *touched);
    for (uint32_t t = 0; t < count; t++) {
        unsigned there, k = (unsigned)(mw__random(random) % 3);
        const uint32_t other = mw_mesh_neighbour(mesh, t, k, &there);
        if (mw__random(random) % every || other == MW_NONE || touched[t] || touched[other])
            continue;
        touched[t] = touched[other] = true;
        uint32_t *v = &b.triangles[3 * (size_t)other];
        const uint32_t from = v[there], to = v[(there + 1) % 3], apex = v[(there + 2) % 3];
        const double *p = &b.points[2 * (size_t)from], *q = &b.points[2 * (size_t)to];
        const uint32_t middle = arrays_point(&b, (p[0] + q[0]) / 2, (p[1] + q[1]) / 2);
        v[(there + 1) % 3] = middle;
        arrays_triangle(&b, middle, to, apex);
        arrays_triangle(&b, from, to, middle);
    }
    free(touched);
    mw_mesh_destroy(mesh);
    arrays_free(a);
    *a = b;
}

void mpi_tear(arrays *a, double share, uint64_t *random)
{
    arrays b = with_room(a, 3 * a->triangle_count, 0);
    for (uint32_t t = 0; t < b.triangle_count; t++)
        for (int k = 0; k < 3 && random_unit(random) < share; k++) {
            uint32_t *v = &b.triangles[3 * (size_t)t + (size_t)k];
            *v = arrays_point(&b, b.points[2 * (size_t)*v], b.points[2 * (size_t)*v + 1]);
        }
    arrays_free(a);
    *a = b;
}

/* Lattice points, doubled, so that middles are exact. */
static arrays grid_of(uint32_t n, double jitter, uint64_t *random)
{
    arrays a = arrays_grid(n, jitter, random);
    if (jitter == 0) arrays_transform(&a, 4, -8, 4);
    return a;
}

static arrays delaunay_of(uint32_t n, uint64_t *random)
{
    double *points = malloc(2 * n * sizeof *points);
    for (uint32_t i = 0; i < 2 * n; i++) points[i] = random_unit(random) * 100;
    mw_mesh *mesh = mesh_delaunay(points, n);
    arrays a = arrays_of_mesh(mesh);
    mw_mesh_destroy(mesh);
    free(points);
    return a;
}

arrays mpi_mesh(int i, uint64_t seed, const char **name)
{
    static const char *const names[MPI_MESHES] = {
        "grid",  "holes",           "many holes", "shreds",   "fan",
        "flats", "flats and holes", "torn",       "delaunay", "one triangle"};
    uint64_t random = seed + (uint64_t)i;
    arrays a;
    *name = names[i];
    switch (i) {
    case 0: a = grid_of(12, 0.4, &random); break;
    case 4: a = arrays_fan(40); break;
    case 8: a = delaunay_of(400, &random); break;
    case 9:
        a = arrays_fan(3);
        a.triangle_count = 1;
        break;
    default: a = grid_of(10, 0, &random); break;
    }
    if (i == 1 || i == 6) arrays_punch(&a, 0.15, &random);
    if (i == 2) arrays_punch(&a, 0.4, &random);
    if (i == 3) arrays_punch(&a, 0.8, &random);
    if (i == 5 || i == 6) mpi_break_edges(&a, 3, &random);
    if (i == 7) {
        arrays_punch(&a, 0.2, &random);
        mpi_tear(&a, 0.5, &random);
    }
    arrays_scramble(&a, i % 2, &random);
    return a;
}

/* --- cuts ------------------------------------------------------------------------------------- */

static double middle_x(const arrays *a, uint32_t t)
{
    double sum = 0;
    for (int k = 0; k < 3; k++)
        sum += a->points[2 * (size_t)a->triangles[3 * (size_t)t + (size_t)k]];
    return sum / 3;
}

/* The extent of the points along x. */
typedef struct extent {
    double low, high;
} extent;

static extent extent_of(const arrays *a)
{
    extent e = {a->points[0], a->points[0]};
    for (uint32_t v = 0; v < a->point_count; v++) {
        const double x = a->points[2 * (size_t)v];
        if (x < e.low) e.low = x;
        if (x > e.high) e.high = x;
    }
    return e;
}

static int stripe(const arrays *a, extent e, uint32_t t, int stripes)
{
    const int s = (int)((middle_x(a, t) - e.low) / (e.high - e.low) * stripes);
    return s < stripes ? s : stripes - 1;
}

/* The vertex of most triangles. */
static uint32_t busiest_vertex(const arrays *a)
{
    uint32_t *count = calloc(a->point_count, sizeof *count), best = 0;
    for (size_t k = 0; k < 3 * (size_t)a->triangle_count; k++) count[a->triangles[k]]++;
    for (uint32_t v = 0; v < a->point_count; v++)
        if (count[v] > count[best]) best = v;
    free(count);
    return best;
}

/* All ranks meet at one vertex. */
static int sector(const arrays *a, uint32_t hub, uint32_t t, int sectors)
{
    const double *p = a->points + 2 * (size_t)hub;
    double y = 0;
    for (int k = 0; k < 3; k++)
        y += (a->points[2 * (size_t)a->triangles[3 * (size_t)t + (size_t)k] + 1] - p[1]) / 3;
    const double turn = atan2(y, middle_x(a, t) - p[0]) / 6.2831853071795862 + 0.5;
    const int s = (int)(turn * sectors);
    return s < sectors ? s : sectors - 1;
}

int *mpi_cut(int i, const arrays *a, int ranks, uint64_t seed, const char **name)
{
    static const char *const names[MPI_CUTS] = {"stripes",        "random",       "by number",
                                                "narrow stripes", "last has all", "one each",
                                                "sectors",        "second half"};
    int *rank_of = malloc((a->triangle_count + 1) * sizeof *rank_of);
    uint64_t random = seed;
    const extent e = extent_of(a);
    const uint32_t hub = busiest_vertex(a);
    *name = names[i];
    for (uint32_t t = 0; t < a->triangle_count; t++) {
        const int drawn = (int)(mw__random(&random) % (uint64_t)ranks);
        switch (i) {
        case 0: rank_of[t] = stripe(a, e, t, ranks); break;
        case 1: rank_of[t] = drawn; break;
        case 2: rank_of[t] = (int)((uint64_t)t * (uint64_t)ranks / a->triangle_count); break;
        case 3: rank_of[t] = stripe(a, e, t, 3 * ranks) % ranks; break;
        case 4: rank_of[t] = ranks - 1; break;
        case 5: rank_of[t] = t < (uint32_t)ranks ? (int)t : 0; break;
        case 6: rank_of[t] = sector(a, hub, t, ranks); break;
        default: rank_of[t] = ranks / 2 + drawn / 2 < ranks ? ranks / 2 + drawn / 2 : 0; break;
        }
    }
    return rank_of;
}

/* --- pieces ----------------------------------------------------------------------------------- */

/* The triangles of a rank, in a random order. */
static uint32_t *piece_order(const arrays *a, const int *rank_of, int rank, uint64_t random,
                             uint32_t *count)
{
    uint32_t *order = malloc((a->triangle_count + 1) * sizeof *order);
    *count = 0;
    for (uint32_t t = 0; t < a->triangle_count; t++)
        if (rank_of[t] == rank) order[(*count)++] = t;
    for (uint32_t i = *count; i > 1; i--) {
        const uint32_t j = (uint32_t)(mw__random(&random) % i), old = order[j];
        order[j] = order[i - 1];
        order[i - 1] = old;
    }
    return order;
}

piece piece_make(const arrays *a, const int *rank_of, int rank, uint64_t seed)
{
    uint32_t count;
    uint32_t *order = piece_order(a, rank_of, rank, seed, &count);
    uint32_t *local = malloc((a->point_count + 1) * sizeof *local);
    piece p = {.part = arrays_make(a->point_count + 1, count + 1),
               .vertex = malloc((a->point_count + 1) * sizeof *p.vertex),
               .triangle = malloc((count + 1) * sizeof *p.triangle)};
    for (uint32_t v = 0; v < a->point_count; v++) local[v] = MW_NONE;
    for (uint32_t i = 0; i < count; i++) {
        uint32_t corner[3];
        for (size_t k = 0; k < 3; k++) {
            const uint32_t v = a->triangles[3 * (size_t)order[i] + k];
            if (local[v] == MW_NONE) {
                p.vertex[p.part.point_count] = mpi_number(v);
                local[v] =
                    arrays_point(&p.part, a->points[2 * (size_t)v], a->points[2 * (size_t)v + 1]);
            }
            corner[k] = local[v];
        }
        p.triangle[i] = mpi_number(order[i]);
        arrays_triangle(&p.part, corner[0], corner[1], corner[2]);
    }
    free(local);
    free(order);
    return p;
}

void piece_free(piece *p)
{
    arrays_free(&p->part);
    free(p->vertex);
    free(p->triangle);
}
