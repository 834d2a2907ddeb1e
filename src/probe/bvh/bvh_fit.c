/* bvh_fit.c - the frame of a bounding volume hierarchy, and boxes that are fitted to the present
 * vertices, the lowest level first. */
#include "probe/bvh/bvh.h"

#include <float.h>
#include <stdatomic.h>
#include <stdlib.h>

#ifdef __SSE2__
#include <emmintrin.h>
#endif

enum {
    SAMPLE = 255, /* triangles, or nodes, in a sample */
    CHUNK = 512   /* nodes that one thread fits at a time */
};

/* --- the frame --- */

/* Item i of a sample: `count` out of n, evenly spaced. */
static uint32_t sample_index(uint32_t i, uint32_t count, uint32_t n)
{
    return (uint32_t)((uint64_t)i * n / count);
}

static int compare_values(const void *a, const void *b)
{
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

static void values_sort(double *value, uint32_t count)
{
    qsort(value, count, sizeof *value, compare_values);
}

/* The first corners of a sample of triangles. Sorts each coordinate separately. Returns the number
 * of finite corners. */
static uint32_t bvh_sample_corners(const mw_surface *surface, double value[3][SAMPLE])
{
    uint32_t wanted = surface->tri_count < SAMPLE ? surface->tri_count : SAMPLE, count = 0;
    for (uint32_t i = 0; i < wanted; i++) {
        const double *corner =
            mw__surface_corner(surface, sample_index(i, wanted, surface->tri_count), 0);
        if (!mw__is_finite3(corner)) continue;
        for (int k = 0; k < 3; k++) value[k][count] = corner[k];
        count++;
    }
    for (int k = 0; k < 3; k++) values_sort(value[k], count);
    return count;
}

/* The scale brings the largest coordinate of the sample to 1/2 ... 1. The centre is the median of
 * each coordinate. */
void mw__bvh_choose_frame(mw_bvh *bvh, const mw_surface *surface)
{
    double value[3][SAMPLE], largest = 0;
    uint32_t count = bvh_sample_corners(surface, value);
    bvh->scale = 1;
    for (int k = 0; k < 3; k++) {
        bvh->centre[k] = 0;
        if (count) largest = fmax(largest, fmax(fabs(value[k][0]), fabs(value[k][count - 1])));
    }
    if (largest == 0) return;
    int exponent = ilogb(largest) + 1;
    bvh->scale = ldexp(1, exponent > -1000 ? -exponent : 1000);
    for (int k = 0; k < 3; k++) bvh->centre[k] = value[k][count / 2] * bvh->scale;
}

/* --- boxes --- */

/* Round a value of the frame down to a float that is certainly less than the exact value. The value
 * is off by at most 2^-53 of itself and 2^-1074. ROUND covers this error and the rounding to a
 * float; TINY covers underflow, and keeps away from denormal floats, which are slow. */
#define ROUND 0x1p-22
#define TINY 0x1p-126

static MW_INLINE float float_below(double y)
{
    return (float)(y - fabs(y) * ROUND - TINY);
}

static mw_bvh_box bvh_box_empty(void)
{
    return (mw_bvh_box){{FLT_MAX, FLT_MAX, FLT_MAX}, {-FLT_MAX, -FLT_MAX, -FLT_MAX}};
}

static mw_bvh_box bvh_box_everything(void)
{
    return (mw_bvh_box){{-INFINITY, -INFINITY, -INFINITY}, {INFINITY, INFINITY, INFINITY}};
}

/* Two coordinates. Compilers make branches of some least and greatest values, and these are guessed
 * wrong as often as not. */
typedef double fit_pair __attribute__((vector_size(16)));
typedef int64_t fit_mask __attribute__((vector_size(16)));

static MW_INLINE fit_pair pair_min(fit_pair a, fit_pair b)
{
#ifdef __SSE2__
    return (fit_pair)_mm_min_pd((__m128d)a, (__m128d)b);
#else
    fit_mask less = a < b;
    return (fit_pair)((less & (fit_mask)a) | (~less & (fit_mask)b));
#endif
}

static MW_INLINE fit_pair pair_max(fit_pair a, fit_pair b)
{
    return -pair_min(-a, -b);
}

/* A point: x and y, z and z. */
typedef struct fit_point {
    fit_pair xy, zz;
} fit_point;

static MW_INLINE fit_point fit_point_of(const double p[3])
{
    return (fit_point){{p[0], p[1]}, {p[2], p[2]}};
}

/* The sides of a box in the frame, of sides in units of length. Are they finite and not too
 * large? */
static MW_INLINE bool bvh_sides_outwards(const mw_bvh *b, int axis, double low, double high,
                                         mw_bvh_box *box)
{
    double from = low * b->scale - b->centre[axis], to = high * b->scale - b->centre[axis];
    box->low[axis] = float_below(from);
    box->high[axis] = -float_below(-to);
    return from > -MW_BVH_LARGE && to < MW_BVH_LARGE;
}

/* x - x is 0 if x is finite, else NaN. */
static MW_INLINE mw_bvh_box bvh_triangle_box(const mw_bvh *bvh, const mw_surface *surface,
                                             const uint32_t v[3])
{
    fit_point p = fit_point_of(mw__surface_point(surface, v[0])),
              q = fit_point_of(mw__surface_point(surface, v[1])),
              r = fit_point_of(mw__surface_point(surface, v[2]));
    fit_pair zero = ((p.xy - p.xy) + (q.xy - q.xy) + (r.xy - r.xy)) +
                    ((p.zz - p.zz) + (q.zz - q.zz) + (r.zz - r.zz));
    fit_pair low = pair_min(pair_min(p.xy, q.xy), r.xy),
             high = pair_max(pair_max(p.xy, q.xy), r.xy),
             z_low = pair_min(pair_min(p.zz, q.zz), r.zz),
             z_high = pair_max(pair_max(p.zz, q.zz), r.zz);
    mw_bvh_box box;
    bool fits = bvh_sides_outwards(bvh, 0, low[0], high[0], &box);
    fits &= bvh_sides_outwards(bvh, 1, low[1], high[1], &box);
    fits &= bvh_sides_outwards(bvh, 2, z_low[0], z_high[0], &box);
    if (MW_UNLIKELY(zero[0] + zero[1] != 0)) return bvh_box_empty();
    return MW_LIKELY(fits) ? box : bvh_box_everything();
}

mw_bvh_box mw__bvh_box_of(const mw_bvh *bvh, const mw_surface *surface, uint32_t triangle)
{
    return bvh_triangle_box(bvh, surface, surface->tri[triangle].v);
}

mw_bvh_box mw__bvh_box_of_node(const mw_bvh_node *node)
{
    mw_bvh_box box;
    for (int k = 0; k < 3; k++) {
        float low = node->low[k][0], high = node->high[k][0];
        for (uint32_t i = 1; i < MW_BVH_WIDTH; i++) {
            low = node->low[k][i] < low ? node->low[k][i] : low;
            high = node->high[k][i] > high ? node->high[k][i] : high;
        }
        box.low[k] = low;
        box.high[k] = high;
    }
    return box;
}

static bool box_is_empty(const mw_bvh_box *box)
{
    return box->low[0] > box->high[0];
}

/* Nodes are fitted in the order of the tree, and their triangles may lie anywhere in memory. So
 * they are prefetched FAR_AHEAD nodes before, and their corners NEAR_AHEAD: those of the last fit,
 * which only flips of edges change. Nodes from `end` on are another thread's, which writes them. */
enum { FAR_AHEAD = 12, NEAR_AHEAD = 6 };

static MW_INLINE void bvh_prefetch(const mw_bvh *b, const mw_surface *surface, uint64_t i,
                                   uint64_t end)
{
    for (uint32_t k = 0; i + FAR_AHEAD < end && k < MW_BVH_WIDTH; k++) {
        uint32_t child = b->node[i + FAR_AHEAD].child[k];
        if (child & MW_BVH_TRIANGLE && child != MW_NONE)
            __builtin_prefetch(&surface->tri[child & ~MW_BVH_TRIANGLE]);
    }
    for (uint32_t k = 0; i + NEAR_AHEAD < end && k < MW_BVH_WIDTH; k++) {
        const mw_bvh_node *node = &b->node[i + NEAR_AHEAD];
        for (uint32_t c = 0; node->child[k] != MW_NONE && c < 3; c++)
            __builtin_prefetch(mw__surface_point(surface, node->vertex[k][c]));
    }
}

bool mw__bvh_fit_node(const mw_bvh *b, const mw_surface *surface, mw_bvh_node *node)
{
    bool finite = true;
    for (uint32_t i = 0; i < MW_BVH_WIDTH; i++) {
        uint32_t child = node->child[i];
        mw_bvh_box box;
        if (child == MW_NONE) {
            box = bvh_box_empty();
        } else if (child & MW_BVH_TRIANGLE) {
            const uint32_t *v = surface->tri[child & ~MW_BVH_TRIANGLE].v;
            box = bvh_triangle_box(b, surface, v);
            for (int k = 0; k < 3; k++) node->vertex[i][k] = v[k];
            finite = finite && !box_is_empty(&box);
        } else {
            box = mw__bvh_box_of_node(&b->node[child]);
        }
        for (int k = 0; k < 3; k++) {
            node->low[k][i] = box.low[k];
            node->high[k][i] = box.high[k];
        }
    }
    return finite;
}

/* --- equal triangles --- */

static bool triangles_are_equal(const mw_surface *surface, uint32_t s, uint32_t t)
{
    for (uint32_t i = 0; i < 9; i++)
        if (mw__surface_corner(surface, s, i / 3)[i % 3] !=
            mw__surface_corner(surface, t, i / 3)[i % 3])
            return false;
    return true;
}

/* The lowest triangle of a node if all are equal, else MW_NONE. That of its children is known. */
static uint32_t node_same(const mw_bvh *b, const mw_surface *surface, const mw_bvh_node *node)
{
    uint32_t lowest = MW_NONE;
    for (uint32_t i = 0; i < MW_BVH_WIDTH; i++) {
        uint32_t child = node->child[i], t;
        if (child == MW_NONE) continue;
        t = child & MW_BVH_TRIANGLE ? child & ~MW_BVH_TRIANGLE : b->same[child];
        if (t == MW_NONE) return MW_NONE;
        if (lowest != MW_NONE && !triangles_are_equal(surface, lowest, t)) return MW_NONE;
        if (t < lowest) lowest = t;
    }
    return lowest;
}

/* Fit the boxes of node i, and tell whether its triangles are equal. */
static bool bvh_fit_one(const mw_bvh *b, const mw_surface *surface, uint64_t i)
{
    bool finite = mw__bvh_fit_node(b, surface, &b->node[i]);
    if (MW_UNLIKELY(b->same)) b->same[i] = node_same(b, surface, &b->node[i]);
    return finite;
}

/* --- levels --- */

typedef struct level_fitting {
    const mw_bvh *bvh;
    const mw_surface *surface;
    uint32_t level;
    atomic_bool gaps; /* some triangle is not finite */
} level_fitting;

static void level_fit_chunk(void *work, uint64_t chunk, uint32_t member)
{
    level_fitting *f = work;
    const mw_bvh *b = f->bvh;
    uint64_t begin = b->first[f->level] + chunk * CHUNK, end = b->first[f->level + 1];
    bool finite = true;
    (void)member;
    end = end < begin + CHUNK ? end : begin + CHUNK;
    for (uint64_t i = begin; i < end; i++) {
        bvh_prefetch(b, f->surface, i, end);
        finite = bvh_fit_one(b, f->surface, i) && finite;
    }
    if (!finite) atomic_store_explicit(&f->gaps, true, memory_order_relaxed);
}

/* A tree that follows single triangles has its nodes in any order. It has at most MW_BVH_LEVELS
 * levels. */
static bool bvh_fit_below(const mw_bvh *bvh, const mw_surface *surface, uint32_t i)
{
    const mw_bvh_node *node = &bvh->node[i];
    bool finite = true;
    for (uint32_t k = 0; k < MW_BVH_WIDTH; k++)
        if (!(node->child[k] & MW_BVH_TRIANGLE))
            finite = bvh_fit_below(bvh, surface, node->child[k]) && finite;
    return bvh_fit_one(bvh, surface, i) && finite;
}

bool mw__bvh_fit(mw_bvh *bvh, const mw_surface *surface, mw_job *job)
{
    level_fitting fitting = {.bvh = bvh, .surface = surface};
    mw__bvh_choose_frame(bvh, surface);
    if (bvh->parent) {
        bvh->finite = bvh_fit_below(bvh, surface, 0);
        return true;
    }
    for (uint32_t level = bvh->level_count; level-- > 0;) {
        uint64_t nodes = bvh->first[level + 1] - bvh->first[level],
                 chunks = (nodes + CHUNK - 1) / CHUNK;
        fitting.level = level;
        mw__job_stage(job, "fitting boxes", (double)nodes / bvh->node_count);
        if (!mw__job_chunks(job, mw__job_team(job, chunks), chunks, level_fit_chunk, &fitting))
            return false;
    }
    bvh->finite = !atomic_load_explicit(&fitting.gaps, memory_order_relaxed);
    return true;
}

/* --- the size of triangles --- */

double mw__bvh_triangle_size(const mw_bvh *bvh)
{
    double value[SAMPLE];
    uint32_t wanted = bvh->node_count < SAMPLE ? bvh->node_count : SAMPLE, count = 0;
    for (uint32_t i = 0; i < wanted; i++) {
        const mw_bvh_node *node = &bvh->node[sample_index(i, wanted, bvh->node_count)];
        if (node->child[0] == MW_NONE || !(node->child[0] & MW_BVH_TRIANGLE)) continue;
        if (node->low[0][0] > node->high[0][0]) continue;
        double sum = 0;
        for (int k = 0; k < 3; k++) sum += (double)node->high[k][0] - (double)node->low[k][0];
        value[count++] = sum / 3;
    }
    values_sort(value, count);
    return count ? value[count / 2] / bvh->scale : 0;
}
