/* delaunay.c - from points to a Delaunay triangulation: sort the points, grow it patch by patch,
 * collect its triangles.
 *
 * All work is done on a copy of the points along a Hilbert curve (slot i holds point order[i]), so
 * that what lies close in the plane lies close in memory; numbers are translated at the end. */
#include "triangulate/delaunay/delaunay.h"
#include "base/options.h"

#include "base/posix.h"
#include "mesh/layout.h"
#include "triangulate/delaunay/delaunay_collect.h"

#include <limits.h>
#include <stdlib.h>
#include <string.h>

enum {
    PATCH = 1 << 14 /* points that with their facets fill a second-level cache, twice at most */
};

typedef struct delaunay {
    const mw_point *given;
    mw_point *scaled; /* NULL, or what takes the place of those given */
    mw_delaunay_setup setup;
    mw_job *job;
    mw_extent extent;
    mw_patch_arrays arrays;
    mw_patches patches;
} delaunay;

static void delaunay_release(delaunay *d)
{
    free(d->scaled);
    free(d->arrays.order);
    free(d->arrays.sequence);
    free(d->arrays.point);
    free(d->arrays.facet);
    free(d->patches.patch);
}

/* --- points --- */

static void extent_extend(mw_extent *e, const mw_extent *by)
{
    for (int axis = 0; axis < 2; axis++) {
        if (by->low[axis] < e->low[axis]) e->low[axis] = by->low[axis];
        if (by->high[axis] > e->high[axis]) e->high[axis] = by->high[axis];
    }
}

/* The extent of points from..to - 1. Returns the first one that is not finite, or `to` if all are.
 */
static uint32_t points_extent(const mw_point *points, uint32_t from, uint32_t to, mw_extent *extent)
{
    mw_extent e = {{INFINITY, INFINITY}, {-INFINITY, -INFINITY}};
    uint32_t i = from;
    for (; i < to && isfinite(points[i].x) && isfinite(points[i].y); i++) {
        mw_point p = points[i];
        if (p.x < e.low[0]) e.low[0] = p.x;
        if (p.x > e.high[0]) e.high[0] = p.x;
        if (p.y < e.low[1]) e.low[1] = p.y;
        if (p.y > e.high[1]) e.high[1] = p.y;
    }
    *extent = e;
    return i;
}

enum { NO_LATTICE = INT_MIN, LATTICE_BITS = 40 };

/* The exponent of the last bit of a finite number that is 1. INT_MAX for 0; NO_LATTICE for a number
 * of more bits than the coordinates of a lattice have in practice. */
static int value_last_bit(double x)
{
    uint64_t bits;
    memcpy(&bits, &x, sizeof bits);
    int exponent = (int)(bits >> (DBL_MANT_DIG - 1) & 0x7ff);
    uint64_t fraction = bits & ((UINT64_C(1) << (DBL_MANT_DIG - 1)) - 1);
    if (exponent > 0) fraction |= UINT64_C(1) << (DBL_MANT_DIG - 1);
    if (fraction == 0) return INT_MAX;
    int zeros = __builtin_ctzll(fraction);
    if (zeros < DBL_MANT_DIG - LATTICE_BITS) return NO_LATTICE;
    return (exponent > 0 ? exponent : 1) + DBL_MIN_EXP - 1 - DBL_MANT_DIG + zeros;
}

/* The exponent of the largest power of two that divides all coordinates of points from..to - 1. If
 * the points are not on a lattice, usually the first point shows it. */
static int points_lattice(const mw_point *points, uint32_t from, uint32_t to)
{
    int lattice = INT_MAX;
    for (uint32_t i = from; i < to && lattice != NO_LATTICE; i++) {
        int x = value_last_bit(points[i].x), y = value_last_bit(points[i].y);
        if (x < lattice) lattice = x;
        if (y < lattice) lattice = y;
    }
    return lattice;
}

/* What there is to know of the points before they are sorted. */
typedef struct point_scan {
    const mw_point *points;
    pthread_mutex_t lock; /* of what follows */
    mw_extent extent;
    int lattice;
    uint32_t bad; /* the first point that is not finite; MW_NONE: all are */
} point_scan;

static void points_scan(void *work, uint64_t from, uint64_t to)
{
    point_scan *s = work;
    mw_extent extent;
    uint32_t stop = points_extent(s->points, (uint32_t)from, (uint32_t)to, &extent);
    int lattice = points_lattice(s->points, (uint32_t)from, stop);
    pthread_mutex_lock(&s->lock);
    extent_extend(&s->extent, &extent);
    if (lattice < s->lattice) s->lattice = lattice;
    if (stop < to && stop < s->bad) s->bad = stop;
    pthread_mutex_unlock(&s->lock);
}

static mw_status delaunay_measure(delaunay *d, mw_error *error)
{
    point_scan s = {.points = d->given,
                    .extent = {{INFINITY, INFINITY}, {-INFINITY, -INFINITY}},
                    .lattice = INT_MAX,
                    .bad = MW_NONE};
    mw__job_stage(d->job, "measuring the extent", 0.02);
    pthread_mutex_init(&s.lock, NULL);
    bool done = mw__job_ranges(d->job, d->arrays.n, points_scan, &s);
    pthread_mutex_destroy(&s.lock);
    if (!done) return mw__fail_memory(error);
    if (s.bad != MW_NONE) return mw__fail_at(error, -1, s.bad, "point %u is not finite", s.bad);
    d->extent = s.extent;
    d->arrays.width = d->extent.high[0] - d->extent.low[0];
    d->arrays.height = d->extent.high[1] - d->extent.low[1];
    d->arrays.unit = s.lattice == NO_LATTICE || s.lattice == INT_MAX ? 0 : ldexp(1, s.lattice);
    return MW_OK;
}

/* The least magnitude of a coordinate that is not 0. */
static double points_least(const mw_point *points, uint32_t n)
{
    double least = INFINITY;
    for (uint32_t i = 0; i < n; i++) {
        double x = fabs(points[i].x), y = fabs(points[i].y);
        if (x > 0 && x < least) least = x;
        if (y > 0 && y < least) least = y;
    }
    return least;
}

/* If products of four coordinates would over- or underflow, no filter decides. So the points are
 * multiplied by a power of two that makes the largest coordinate about 1. They have the same
 * triangulation, if no coordinate loses a bit. Returns false when out of memory. */
static bool delaunay_scale(delaunay *d)
{
    const double *low = d->extent.low, *high = d->extent.high;
    double most = fmax(fmax(fabs(low[0]), fabs(high[0])), fmax(fabs(low[1]), fabs(high[1])));
    if (!(most > 0) || (most > 0x1p-150 && most < 0x1p200)) return true;
    uint32_t n = d->arrays.n;
    int shift = -ilogb(most);
    if (shift < 0 && points_least(d->given, n) < ldexp(1, -900 - shift)) return true;
    double half = ldexp(1, shift / 2), rest = ldexp(1, shift - shift / 2); /* 2^1074 is no double */
    d->scaled = mw__alloc_lines(n, sizeof *d->scaled);
    if (!d->scaled) return false;
    for (uint32_t i = 0; i < n; i++)
        d->scaled[i] = (mw_point){d->given[i].x * half * rest, d->given[i].y * half * rest};
    d->given = d->scaled;
    for (int k = 0; k < 2; k++) {
        d->extent.low[k] = d->extent.low[k] * half * rest;
        d->extent.high[k] = d->extent.high[k] * half * rest;
    }
    d->arrays.width = d->extent.high[0] - d->extent.low[0];
    d->arrays.height = d->extent.high[1] - d->extent.low[1];
    d->arrays.unit = d->arrays.unit * half * rest;
    return true;
}

/* Nothing has grown: no three of the points are the corners of a triangle. */
static mw_status delaunay_fail_flat(const delaunay *d, mw_error *error)
{
    const mw_point *p = d->arrays.point;
    uint32_t n = d->arrays.n, second = 1, third;
    while (second < n && mw__points_equal(p[0], p[second])) second++;
    if (second == n)
        return mw__fail(error, MW_ERROR_INPUT,
                        "fewer than three different points: all %u are equal", n);
    for (third = second + 1; third < n; third++)
        if (!mw__points_equal(p[third], p[0]) && !mw__points_equal(p[third], p[second]))
            return mw__fail(error, MW_ERROR_INPUT, "all %u points lie on one line", n);
    return mw__fail(error, MW_ERROR_INPUT, "fewer than three different points: only two among %u",
                    n);
}

/* --- growth --- */

typedef struct point_placing {
    const mw_point *given;
    const mw_key *keys;
    const mw_patch_arrays *arrays;
} point_placing;

/* Copy the points to their slots. Where each lies in memory is hard for the processor to foresee,
 * but its number is known ahead. */
static void points_place(void *work, uint64_t from, uint64_t to)
{
    enum { AHEAD = 16 };
    const point_placing *p = work;
    for (uint64_t i = from; i < to; i++) {
        if (i + AHEAD < p->arrays->n) __builtin_prefetch(&p->given[p->keys[i + AHEAD].item]);
        p->arrays->order[i] = p->keys[i].item;
        p->arrays->point[i] = p->given[p->keys[i].item];
    }
}

/* The keys lie where the facets will grow. */
static bool delaunay_order_points(delaunay *d)
{
    mw_patch_arrays *g = &d->arrays;
    _Static_assert(sizeof(mw_key) <= sizeof(mw_facet), "the facets have room for the keys");
    mw_key *keys = (mw_key *)g->facet, *scratch = keys + g->n;
    mw_job_span outer = mw__job_part(d->job, 0.1);
    bool sorted = mw__points_sort(d->given, g->n, &d->extent, d->job, keys, scratch);
    mw__job_part_end(d->job, outer);
    if (!sorted) return false;
    mw__job_stage(d->job, "copying points", 0.03);
    point_placing placing = {d->given, keys, g};
    if (!mw__job_ranges(d->job, g->n, points_place, &placing)) return false;
    return mw__patches_cut(&d->patches, d->given, keys, g->n, d->setup.patch);
}

static mw_status delaunay_prepare(delaunay *d, mw_error *error)
{
    mw_patch_arrays *g = &d->arrays;
    if (g->n < 3) return mw__fail(error, MW_ERROR_INPUT, "fewer than three points: %u", g->n);
    if (g->n > MW_MAX_TRIANGLES / 2)
        return mw__fail(error, MW_ERROR_LIMIT, "too many points: %u", g->n);
    mw_status status = delaunay_measure(d, error);
    if (status != MW_OK) return status;
    if (!delaunay_scale(d)) return mw__fail_memory(error);
    g->order = mw__alloc_lines(g->n, sizeof *g->order);
    g->point = mw__alloc_lines(g->n, sizeof *g->point);
    g->sequence = mw__alloc_lines(g->n, sizeof *g->sequence);
    g->facet = mw__alloc_lines(2 * (size_t)g->n, sizeof *g->facet);
    bool done = g->order && g->point && g->sequence && g->facet && delaunay_order_points(d);
    return done ? MW_OK : mw__fail_memory(error);
}

static void delaunay_report_duplicates(const delaunay *d, uint32_t *duplicate_of)
{
    const mw_patch_arrays *g = &d->arrays;
    for (uint32_t i = 0, twin; i < g->n; i++)
        duplicate_of[g->order[i]] = mw__get_twin(g->point[i], &twin) ? g->order[twin] : MW_NONE;
}

/* The points are not needed any more: their memory serves the collection. */
static bool delaunay_collect(delaunay *d, mw_triangle **tri, uint32_t *tri_count)
{
    free(d->arrays.sequence);
    d->arrays.sequence = NULL;
    uint32_t *scratch = (uint32_t *)d->arrays.point;
    return mw__delaunay_collect(&d->patches, &d->arrays, d->setup.order != NULL, d->job, scratch,
                                tri, tri_count);
}

mw_status mw__delaunay_set_up(const mw_point *points, uint32_t n, const mw_delaunay_setup *setup,
                              mw_job *job, uint32_t *duplicate_of, mw_delaunay_report *report,
                              mw_triangle **tri, uint32_t *tri_count, mw_error *error)
{
    delaunay d = {.given = points, .setup = *setup, .job = job, .arrays = {.n = n}};
    if (!d.setup.patch) d.setup.patch = PATCH;
    *tri = NULL;
    *tri_count = 0;
    mw_status status = delaunay_prepare(&d, error);
    if (status == MW_OK) {
        mw_job_span outer = mw__job_part(job, 0.75);
        bool grown = mw__patches_grow(&d.patches, &d.arrays, job);
        mw__job_part_end(job, outer);
        if (!grown)
            status = mw__fail_memory(error);
        else if (d.patches.patch[0].ghost == MW_NONE)
            status = delaunay_fail_flat(&d, error);
    }
    if (status == MW_OK) {
        const mw_patch *whole = &d.patches.patch[0];
        if (duplicate_of) delaunay_report_duplicates(&d, duplicate_of);
        if (report) *report = (mw_delaunay_report){n, whole->duplicates, whole->visited};
        mw_job_span outer = mw__job_part(job, 0.1);
        if (!delaunay_collect(&d, tri, tri_count)) status = mw__fail_memory(error);
        mw__job_part_end(job, outer);
    }
    if (d.setup.order) {
        *d.setup.order = status == MW_OK ? d.arrays.order : NULL;
        if (status == MW_OK) d.arrays.order = NULL;
    }
    delaunay_release(&d);
    return status;
}

mw_status mw__delaunay_triangles(const mw_point *points, uint32_t n, mw_job *job,
                                 uint32_t *duplicate_of, mw_delaunay_report *report,
                                 mw_triangle **tri, uint32_t *tri_count, mw_error *error)
{
    static const mw_delaunay_setup defaults;
    return mw__delaunay_set_up(points, n, &defaults, job, duplicate_of, report, tri, tri_count,
                               error);
}

/* --- a mesh --- */

static mw_status delaunay_make_mesh(const mw_point *given, bool laid_out, mw_job *job,
                                    uint32_t *duplicate_of, mw_delaunay_report *report,
                                    mw_mesh *mesh, mw_error *error)
{
    mw_delaunay_setup setup = {0};
    uint32_t *order = NULL, n = mesh->point_count;
    if (laid_out && mw__points_are_scattered(given, n)) setup.order = &order;
    mw_job_span outer = mw__job_part(job, 0.93);
    mw_status status = mw__delaunay_set_up(given, n, &setup, job, duplicate_of, report, &mesh->tri,
                                           &mesh->tri_count, error);
    mw__job_part_end(job, outer);
    mw__job_stage(job, "copying points", 0.05);
    if (!status && !mw__mesh_set_points(mesh, given, order, job)) status = mw__fail_memory(error);
    return status;
}

mw_status mw__delaunay_mesh(mw_job *job, bool laid_out, const double *points, size_t n,
                            size_t stride, uint32_t *duplicate_of, mw_delaunay_report *report,
                            mw_mesh **out, mw_error *error)
{
    if (!out) return mw__fail(error, MW_ERROR_ARGUMENT, "the pointer to the new mesh is NULL");
    *out = NULL;
    if (!stride) stride = 2;
    if (stride < 2)
        return mw__fail(error, MW_ERROR_ARGUMENT,
                        "the stride must be at least 2 (x and y), not %zu", stride);
    if (n && !points) return mw__fail(error, MW_ERROR_ARGUMENT, "the points are NULL");
    if (n > MW_MAX_TRIANGLES / 2) return mw__fail(error, MW_ERROR_LIMIT, "too many points: %zu", n);
    mw_point *copy;
    mw__job_stage(job, "reading points", 0.02);
    const mw_point *given = mw__points_read(points, stride, (uint32_t)n, job, &copy);
    mw_mesh *mesh = mw__calloc(1, sizeof *mesh);
    mw_status status = mesh && (given || !n) ? MW_OK : mw__fail_memory(error);
    if (status == MW_OK) {
        mesh->point_count = (uint32_t)n;
        status = delaunay_make_mesh(given, laid_out, job, duplicate_of, report, mesh, error);
    }
    free(copy);
    if (status == MW_OK)
        *out = mesh;
    else
        mw_mesh_destroy(mesh);
    return status;
}

mw_status mw_delaunay(const double *points, size_t n, size_t stride,
                      const mw_delaunay_options *options, uint32_t *duplicate_of,
                      mw_delaunay_report *report, mw_mesh **out, mw_error *error)
{
    static const mw_delaunay_options defaults;
    if (!out) return mw__fail(error, MW_ERROR_ARGUMENT, "the pointer to the new mesh is NULL");
    *out = NULL;
    if (!options) options = &defaults;
    mw_status status = MW_RESERVED_CHECK(mw_delaunay_options, options, error);
    if (status) return status;
    mw_job job = mw__job(options->threads, options->progress);
    status = mw__delaunay_mesh(&job, true, points, n, stride, duplicate_of, report, out, error);
    status = mw__job_end(&job, status, error);
    if (status) {
        mw_mesh_destroy(*out);
        *out = NULL;
    }
    return status;
}
