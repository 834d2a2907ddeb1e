/* batch_profile.c - what the queries of a batch have in common.
 *
 * All numbers are rounded. Comparisons are written so that a NaN leads to the choice that is made
 * when nothing is known about the queries. */
#include "locate/batch_profile.h"

#include "start/start.h"

/* --- how much of the mesh they touch --- */

enum {
    SAMPLE = 64, /* how many queries are looked at */
    LEAST = 512, /* batches with fewer queries than this are not looked at */
    TILES = 8,   /* for how many of them the tile is looked at, too */
    /* with more tiles than this for each query, most tiles are met once and need not be in a
     * cache */
    OFTEN = 4
};

static mw_cache_level cache_level_of(double bytes, const mw_caches *caches)
{
    if (bytes <= (double)caches->second) return MW_CACHE_OWN;
    return bytes <= (double)caches->reach ? MW_CACHE_SHARED : MW_CACHE_NONE;
}

static double mesh_bytes(const mw_tiling *tiling)
{
    return (double)tiling->tri_count * sizeof(mw_triangle) +
           (double)tiling->point_count * sizeof(mw_point);
}

static const double *query_sampled(const mw_queries *queries, size_t i, size_t count)
{
    return &queries->points[queries->n / count * i * queries->stride];
}

/* The part of the mesh's extent over which the queries lie, along x or y. The outermost of s random
 * points of an interval are (s - 1) / (s + 1) of its length apart, on average. */
static double queries_part(const mw_locator *locator, const mw_queries *queries, size_t axis)
{
    size_t count = queries->n < SAMPLE ? queries->n : SAMPLE;
    double low = locator->low[axis], high = locator->high[axis], from = high, to = low;
    for (size_t i = 0; i < count; i++) {
        double value = query_sampled(queries, i, count)[axis];
        if (value < from) from = value;
        if (value > to) to = value;
    }
    if (from < low) from = low;
    if (to > high) to = high;
    double part = (to - from) / (high - low) * (double)(count + 1) / (double)(count - 1);
    return part < 1 ? part : 1;
}

/* Twice the area, rounded. */
static double tile_area(const mw_tiling *tiling, uint32_t t)
{
    const uint32_t *v = tiling->tri[t].v;
    mw_point a = tiling->point[v[0]], b = tiling->point[v[1]], c = tiling->point[v[2]];
    return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

/* How many tiles there are in a unit of area, where the queries are. */
static double queries_tile_density(const mw_locator *locator, const mw_queries *queries)
{
    mw_point q[TILES];
    uint32_t t[TILES];
    for (size_t i = 0; i < TILES; i++) {
        const double *at = query_sampled(queries, i, TILES);
        q[i] = (mw_point){at[0], at[1]};
    }
    mw__index_first_many(&locator->tiling, &locator->guide, q, TILES, t);
    double sum = 0;
    for (size_t i = 0; i < TILES; i++) sum += 2 / tile_area(&locator->tiling, t[i]);
    return sum / TILES;
}

mw_cache_level mw__cache_level_of_mesh(const mw_locator *locator, const mw_caches *caches)
{
    return cache_level_of(mesh_bytes(&locator->tiling), caches);
}

mw_cache_level mw__cache_level_of_queries(const mw_locator *locator, const mw_caches *caches,
                                          const mw_queries *queries)
{
    mw_cache_level level = mw__cache_level_of_mesh(locator, caches);
    if (level == MW_CACHE_OWN || queries->n < LEAST || locator->guide.start == MW_START_AUTO)
        return level;
    double x = queries_part(locator, queries, 0), y = queries_part(locator, queries, 1),
           all = mesh_bytes(&locator->tiling);
    mw_cache_level even = cache_level_of(x * y * all, caches);
    if (even == level || x * y * locator->tiling.tri_count > (double)queries->n * OFTEN)
        return level;
    /* Where the mesh is refined a small part of the extent may hold most of it. */
    double width = x * (locator->high[0] - locator->low[0]),
           height = y * (locator->high[1] - locator->low[1]);
    double tiles = width * queries_tile_density(locator, queries) * height;
    if (!(tiles <= (double)queries->n * OFTEN)) return level;
    mw_cache_level dense = cache_level_of(tiles / locator->tiling.tri_count * all, caches);
    return dense > level ? level : dense > even ? dense : even;
}

/* --- in which order they come --- */

enum { RUN = 64 }; /* queries between two decisions */

/* The sum of |dx| + |dy| from each of `count` queries to the next. That is 1.27 times the sum of
 * their distances, on average. It is made of four sums that the processor can add up at the same
 * time. */
static double queries_way(const double *at, size_t count, size_t stride)
{
    double way[4] = {0, 0, 0, 0};
    size_t i = 0;
    for (; i + 2 <= count; i += 2, at += 2 * stride) {
        way[0] += fabs(at[stride] - at[0]);
        way[1] += fabs(at[stride + 1] - at[1]);
        way[2] += fabs(at[2 * stride] - at[stride]);
        way[3] += fabs(at[2 * stride + 1] - at[stride + 1]);
    }
    if (i < count) way[0] += fabs(at[stride] - at[0]) + fabs(at[stride + 1] - at[1]);
    return way[0] + way[1] + way[2] + way[3];
}

static double shortest_edge(const mw_tiling *tiling, uint32_t t)
{
    const uint32_t *v = tiling->tri[t].v;
    mw_point a = tiling->point[v[0]], b = tiling->point[v[1]], c = tiling->point[v[2]];
    double ab = mw__distance2(a, b), bc = mw__distance2(b, c), ca = mw__distance2(c, a);
    double least = ab < bc ? ab : bc;
    return sqrt(least < ca ? least : ca);
}

/* If a query lies within so many lengths (struct way_measure) of the one before it, a walk from
 * there is as quick as the guide. GRID is for a guide that is a grid. CURVE is for a guide that
 * also asks a curve, which takes longer. Queries that are a typical edge apart come to about 2.8
 * lengths. So GRID stands for a step of 0.18 edges. At a step of 0.1 edges the guide took twice as
 * long as a walk. */
static const double GRID = 0.5, CURVE = 1.5;

/* The unit in which the way from a query to the next one is measured: the shortest edge of the
 * guide's tile, but at most two typical edges, as tiles along the hull are large. */
typedef struct way_measure {
    double length, worth; /* worth: GRID or CURVE */
} way_measure;

static way_measure way_measure_at(const mw_locator *locator, const double *at)
{
    const mw_index *guide = &locator->guide;
    mw_point p = {at[0], at[1]};
    bool crowded = guide->start == MW_START_CURVE && guide->curve.sparse.tile &&
                   mw__grid_first(&guide->curve.sparse, p) == MW_NONE;
    double edge = shortest_edge(&locator->tiling, mw__index_tile(&locator->tiling, guide, p));
    double longest = sqrt(locator->cell2);
    return (way_measure){.length = edge < longest ? edge : longest,
                         .worth = crowded ? CURVE : GRID};
}

/* The length of the way through a run of queries. Returns infinity, without a look at the tiles, if
 * the way is longer than `left` and the most that the run can gain. */
static double queries_short_way(const mw_locator *locator, const double *at, size_t count,
                                size_t stride, double left)
{
    double way = queries_way(at, count, stride);
    return way <= (left + CURVE * (double)count) * sqrt(locator->cell2) ? way : INFINITY;
}

/* What a run of queries gains by walking from one to the next: the time that the guide would take,
 * less the time for the way. */
static double queries_gain(const mw_locator *locator, const double *at, size_t count, size_t stride,
                           double left)
{
    /* the first queries of a run, so many, show it for nearly all runs that are not near */
    enum { FEW = 8 };
    if (isinf(queries_short_way(locator, at, count < FEW ? count : FEW, stride, left)))
        return -INFINITY;
    double way = queries_short_way(locator, at, count, stride, left);
    if (isinf(way)) return -INFINITY;
    way_measure from = way_measure_at(locator, at),
                to = way_measure_at(locator, at + count * stride);
    return from.worth * (double)count - way / (from.length < to.length ? from.length : to.length);
}

/* Adds up gains and ways run by run, over runs from all parts of the batch. The sum of the ways may
 * never exceed the gains so far and a part of those of the whole batch. So a batch that is not
 * dense is found out after a few runs. */
bool mw__queries_are_dense(const mw_locator *locator, const mw_queries *queries)
{
    static const double PART = 1.0 / 32;
    enum { LAPS = 16 };
    /* beyond the squares of doubles */
    if (!(locator->cell2 > 0 && locator->cell2 < INFINITY)) return false;
    double left = GRID * PART * (double)queries->n;
    for (size_t lap = 0; lap < LAPS; lap++)
        for (size_t i = lap * RUN; i + 1 < queries->n; i += LAPS * RUN) {
            size_t count = queries->n - 1 - i < RUN ? queries->n - 1 - i : RUN;
            left += queries_gain(locator, &queries->points[i * queries->stride], count,
                                 queries->stride, left);
            if (!(left >= 0)) return false;
        }
    return true;
}

/* After sorting, n queries are as far apart as on a square lattice over their extent. Each typical
 * edge beyond that distance costs a walk of two tiles; sorting costs as much as SORT such edges.
 * One stray query can make the extent large; so that distance is taken to be SHORT edges at most.
 */
bool mw__queries_are_in_order(const mw_locator *locator, const mw_queries *queries)
{
    /* common edges; |dx| + |dy| for a distance */
    static const double SORT = 0.4, SHORT = 4, SUM = 1.27;
    double n = (double)queries->n, edge = sqrt(locator->cell2) / 2;
    double width = queries_part(locator, queries, 0) * (locator->high[0] - locator->low[0]);
    double height = queries_part(locator, queries, 1) * (locator->high[1] - locator->low[1]);
    double sorted = sqrt(width) * sqrt(height) / sqrt(n) + SORT * edge;
    double left = SUM * n * (sorted < SHORT * edge ? sorted : SHORT * edge);
    for (size_t i = 0; i + 1 < queries->n; i += RUN) {
        size_t count = queries->n - 1 - i < RUN ? queries->n - 1 - i : RUN;
        left -= queries_way(&queries->points[i * queries->stride], count, queries->stride);
        if (!(left >= 0)) return false;
    }
    return true;
}
