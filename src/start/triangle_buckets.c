/* triangle_buckets.c - buckets with all incident triangles [thesis App. D, sec. 3.2].
 *
 * Each cell of a uniform grid, a bucket, keeps every tile that reaches into it. A query tests these
 * one after the other until one contains it. No walk is needed, whatever the shape of the domain.
 * But where vertices are crowded a bucket keeps many tiles, and long tiles are kept in many
 * buckets; the paper warns that this takes much memory. Here memory is bounded: if tiles would be
 * kept more than MOST times on average, buckets are made larger.
 *
 * For a query outside of all tiles, or if rounding hides the right tile, the walk begins at the
 * last tile tested. If the bucket is empty, it begins at a tile of the first bucket that is not, in
 * a spiral round it (vertex_buckets.c). */
#include "start/triangle_buckets.h"

#include "start/vertex_buckets.h"

#include <stdlib.h>
#include <string.h>

enum { MOST = 12 }; /* buckets that a tile is kept in, on the average */

/* A tile in units of cells, and what is done with the cells that it reaches into. */
typedef struct mw_bucket_pass {
    const mw_lattice *lattice;
    /* without tile: cells are counted in from[c + 1]; else it is put at from[c]++ */
    uint32_t *from, *tile;
    uint64_t steps, most; /* rows and cells looked at, at most so many */
    mw_job *job;
} mw_bucket_pass;

/* The part of an edge between two heights: how far it reaches along the row. */
static void edge_span(const double a[2], const double b[2], double low, double high, double span[2])
{
    const double *below = a[1] < b[1] ? a : b, *above = a[1] < b[1] ? b : a;
    if (above[1] < low || below[1] > high) return;
    double rise = above[1] - below[1], x[2] = {below[0], above[0]};
    if (below[1] < low) x[0] = below[0] + (above[0] - below[0]) * ((low - below[1]) / rise);
    if (above[1] > high) x[1] = below[0] + (above[0] - below[0]) * ((high - below[1]) / rise);
    for (int i = 0; i < 2; i++) {
        span[0] = fmin(span[0], x[i]);
        span[1] = fmax(span[1], x[i]);
    }
}

static void bucket_row(mw_bucket_pass *p, const double corner[3][2], uint32_t row, uint32_t name)
{
    const double slack = 1e-9; /* a tile that touches a cell reaches into it */
    double span[2] = {INFINITY, -INFINITY};
    for (int k = 0; k < 3; k++)
        edge_span(corner[k], corner[(k + 1) % 3], row - slack, row + 1 + slack, span);
    if (!(span[0] <= span[1])) return;
    uint32_t first = mw__lattice_line(span[0] - slack, p->lattice->columns);
    uint32_t last = mw__lattice_line(span[1] + slack, p->lattice->columns);
    for (uint32_t column = first; column <= last; column++) {
        uint32_t cell = row * p->lattice->columns + column;
        if (p->tile)
            p->tile[p->from[cell]++] = name;
        else
            p->from[cell + 1]++;
    }
    p->steps += last - first + 1;
}

static void bucket_tile(mw_bucket_pass *p, const mw_tiling *tiling, uint32_t t)
{
    double corner[3][2], low = INFINITY, high = -INFINITY;
    for (int k = 0; k < 3; k++) {
        mw__lattice_offset(p->lattice, tiling->point[tiling->tri[t].v[k]], corner[k]);
        for (int i = 0; i < 2; i++) corner[k][i] += p->lattice->half[i];
        if (!isfinite(corner[k][0]) || !isfinite(corner[k][1])) return;
        low = fmin(low, corner[k][1]);
        high = fmax(high, corner[k][1]);
    }
    uint32_t first = mw__lattice_line(low, p->lattice->rows),
             last = mw__lattice_line(high, p->lattice->rows);
    uint32_t name = p->tile ? mw__tile_name(tiling, t) : 0;
    for (uint32_t row = first; row <= last && p->steps <= p->most; row++, p->steps++)
        bucket_row(p, corner, row, name);
}

/* Before tile t: is the job to go on? */
static MW_INLINE bool pass_goes_on(const mw_bucket_pass *pass, const mw_tiling *tiling, uint32_t t)
{
    enum { SOME = 1 << 12 };
    return t % SOME != 0 || mw__job_step(pass->job, t, tiling->tri_count);
}

/* Count the tiles of all buckets of a lattice. Returns false where they are too many. */
static bool buckets_count(mw_triangle_buckets *buckets, const mw_tiling *tiling, mw_job *job)
{
    uint32_t cells = mw__lattice_cells(&buckets->lattice);
    mw_bucket_pass pass = {.lattice = &buckets->lattice,
                           .from = buckets->from,
                           .most = cells > 1 ? (uint64_t)MOST * tiling->tri_count : UINT64_MAX,
                           .job = job};
    if (pass.most > UINT32_MAX / 2 && cells > 1) pass.most = UINT32_MAX / 2;
    memset(buckets->from, 0, ((size_t)cells + 1) * sizeof *buckets->from);
    for (uint32_t t = 0;
         t < tiling->tri_count && pass.steps <= pass.most && pass_goes_on(&pass, tiling, t); t++)
        bucket_tile(&pass, tiling, t);
    return pass.steps <= pass.most;
}

static bool buckets_fill(mw_triangle_buckets *buckets, const mw_tiling *tiling, mw_job *job)
{
    uint32_t cells = mw__lattice_cells(&buckets->lattice), *from = buckets->from;
    for (uint32_t c = 0; c < cells; c++) from[c + 1] += from[c];
    buckets->tile = mw__alloc_lines(from[cells] + 1, sizeof *buckets->tile);
    if (!buckets->tile) return false;
    mw_bucket_pass pass = {.lattice = &buckets->lattice,
                           .from = from,
                           .tile = buckets->tile,
                           .most = UINT64_MAX,
                           .job = job};
    for (uint32_t t = 0; t < tiling->tri_count && pass_goes_on(&pass, tiling, t); t++)
        bucket_tile(&pass, tiling, t);
    memmove(from + 1, from, cells * sizeof *from); /* each has come to the beginning of the next */
    from[0] = 0;
    return !mw__job_stopped(job);
}

bool mw__triangle_buckets_create(mw_triangle_buckets *buckets, const mw_tiling *tiling,
                                 const double low[2], const double high[2], uint32_t cells,
                                 mw_job *job)
{
    if (cells == 0) cells = mw__lattice_choose(tiling);
    *buckets = (mw_triangle_buckets){.lattice = mw__lattice(low, high, cells)};
    buckets->from =
        mw__alloc_lines(mw__lattice_cells(&buckets->lattice) + 1, sizeof *buckets->from);
    if (!buckets->from) return false;
    mw__job_stage(job, "counting triangles of buckets", 0.4);
    while (!buckets_count(buckets, tiling, job)) {
        cells = cells > 4 ? cells / 4 : 1;
        buckets->lattice = mw__lattice(low, high, cells);
    }
    if (mw__job_stopped(job)) return false;
    mw__job_stage(job, "filling buckets", 0.6);
    return buckets_fill(buckets, tiling, job);
}

void mw__triangle_buckets_release(mw_triangle_buckets *buckets)
{
    free(buckets->from);
    free(buckets->tile);
}

size_t mw__triangle_buckets_bytes(const mw_triangle_buckets *buckets)
{
    uint32_t cells = mw__lattice_cells(&buckets->lattice);
    return ((size_t)cells + 1) * sizeof *buckets->from +
           ((size_t)buckets->from[cells] + 1) * sizeof *buckets->tile;
}

/* --- the query --- */

/* Does tile t have q, in plain doubles? Counts the tests in *tests. */
static bool bucket_tile_has(const mw_tiling *tiling, uint32_t t, mw_point q, uint64_t *tests)
{
    const uint32_t *v = tiling->tri[t].v;
    for (int k = 0; k < 3; k++) {
        (*tests)++;
        if (mw__orient2d_double(tiling->point[v[k]], tiling->point[v[k + 1]], q) < 0) return false;
    }
    return true;
}

static bool bucket_has_triangle(const void *self, uint32_t cell)
{
    const mw_triangle_buckets *buckets = self;
    return buckets->from[cell] < buckets->from[cell + 1];
}

uint32_t mw__triangle_buckets_first(const mw_triangle_buckets *buckets, const mw_tiling *tiling,
                                    mw_point q, mw_work *work)
{
    uint32_t cell = mw__lattice_spiral(&buckets->lattice, q, bucket_has_triangle, buckets),
             name = 0;
    uint64_t tests = 0;
    for (uint32_t i = cell == MW_NONE ? 1 : buckets->from[cell];
         cell != MW_NONE && i < buckets->from[cell + 1]; i++) {
        name = buckets->tile[i];
        if (bucket_tile_has(tiling, mw__tile_of_name(tiling, name), q, &tests)) break;
    }
    if (work) work->orient[MW_STAGE_INIT] += tests;
    return name;
}
