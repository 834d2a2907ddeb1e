/* bvh.c - a bounding volume hierarchy over the triangles of a surface: its order, and how boxes are
 * fitted.
 *
 * The triangles keep the order of the file if its leaves are about as compact as those along a
 * space-filling curve. Else they are sorted along the curve. The order does not change when the
 * surface moves, as neighbours stay close to each other. */
#include "probe/bvh.h"

#include "base/hilbert.h"

#include <float.h>
#include <stdlib.h>

enum {
    SAMPLE = 255,    /* triangles, or leaves, in a sample */
    CHUNK = 1 << 10, /* leaves that one thread fits at a time */
    KEY_BITS = 10    /* of each axis in a key of the space-filling curve */
};

/* --- samples --- */

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
static void bvh_choose_frame(mw_bvh *b, const mw_surface *surface)
{
    double value[3][SAMPLE], largest = 0;
    uint32_t count = bvh_sample_corners(surface, value);
    b->scale = 1;
    for (int k = 0; k < 3; k++) {
        b->centre[k] = 0;
        if (count) largest = fmax(largest, fmax(fabs(value[k][0]), fabs(value[k][count - 1])));
    }
    if (largest == 0) return;
    int exponent = ilogb(largest) + 1;
    b->scale = ldexp(1, exponent > -1000 ? -exponent : 1000);
    for (int k = 0; k < 3; k++) b->centre[k] = value[k][count / 2] * b->scale;
}

/* --- fit --- */

/* Round a value of the frame down to a float that is certainly less than the exact value. The value
 * is off by at most 2^-53 of itself and 2^-1074. ROUND covers this error and the rounding to a
 * float; TINY covers underflow. */
#define ROUND 0x1p-22
#define TINY 0x1p-140

static float float_below(double y)
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

/* A box around low..high, in units of length. If it is too large for floats: everything. */
static mw_bvh_box bvh_box_outwards(const mw_bvh *b, const double low[3], const double high[3])
{
    mw_bvh_box box;
    double from[3], to[3];
    mw__bvh_to_frame(b, low, from);
    mw__bvh_to_frame(b, high, to);
    for (int k = 0; k < 3; k++) {
        if (!(from[k] > -0x1p126 && to[k] < 0x1p126)) return bvh_box_everything();
        box.low[k] = float_below(from[k]);
        box.high[k] = -float_below(-to[k]);
    }
    return box;
}

static mw_bvh_box bvh_fit_leaf(const mw_bvh *b, const mw_surface *surface, uint32_t leaf)
{
    double low[3] = {INFINITY, INFINITY, INFINITY}, high[3] = {-INFINITY, -INFINITY, -INFINITY};
    uint32_t first, end = mw__bvh_children(b, 0, leaf, &first);
    for (uint32_t i = first; i < end; i++) {
        uint32_t t = mw__bvh_triangle(b, i);
        if (!mw__corners_finite(surface, t)) continue;
        for (uint32_t corner = 0; corner < 3; corner++) {
            const double *p = mw__surface_corner(surface, t, corner);
            for (int k = 0; k < 3; k++) {
                low[k] = p[k] < low[k] ? p[k] : low[k];
                high[k] = p[k] > high[k] ? p[k] : high[k];
            }
        }
    }
    return low[0] <= high[0] ? bvh_box_outwards(b, low, high) : bvh_box_empty();
}

static mw_bvh_box bvh_fit_box(const mw_bvh *b, uint32_t level, uint32_t i)
{
    mw_bvh_box box = bvh_box_empty();
    uint32_t first, end = mw__bvh_children(b, level, i, &first);
    for (uint32_t j = first; j < end; j++) {
        const mw_bvh_box *below = mw__bvh_box_at(b, level - 1, j);
        for (int k = 0; k < 3; k++) {
            box.low[k] = below->low[k] < box.low[k] ? below->low[k] : box.low[k];
            box.high[k] = below->high[k] > box.high[k] ? below->high[k] : box.high[k];
        }
    }
    return box;
}

typedef struct level_fitting {
    mw_bvh *bvh;
    const mw_surface *surface;
    uint32_t level;
} level_fitting;

static void level_fit_chunk(void *work, uint64_t chunk, uint32_t member)
{
    const level_fitting *f = work;
    mw_bvh *b = f->bvh;
    uint64_t count = b->level_boxes[f->level], end = (chunk + 1) * CHUNK;
    mw_bvh_box *box = b->box + b->first[f->level];
    (void)member;
    for (uint64_t i = chunk * CHUNK; i < count && i < end; i++)
        box[i] = f->level ? bvh_fit_box(b, f->level, (uint32_t)i)
                          : bvh_fit_leaf(b, f->surface, (uint32_t)i);
}

static bool bvh_fit_level(mw_bvh *b, const mw_surface *surface, uint32_t level, mw_job *job)
{
    uint64_t chunks = ((uint64_t)b->level_boxes[level] + CHUNK - 1) / CHUNK;
    level_fitting fitting = {b, surface, level};
    return mw__job_chunks(job, mw__job_team(job, chunks), chunks, level_fit_chunk, &fitting);
}

/* The leaves take most of the time. */
bool mw__bvh_fit(mw_bvh *bvh, const mw_surface *surface, mw_job *job)
{
    bvh_choose_frame(bvh, surface);
    mw__job_stage(job, "fitting boxes", 1);
    for (uint32_t level = 0; level < bvh->level_count; level++)
        if (!bvh_fit_level(bvh, surface, level, job)) return false;
    return true;
}

/* --- how good an order is --- */

static double bvh_box_size(const mw_bvh_box *box)
{
    double sum = 0;
    for (int k = 0; k < 3; k++) sum += (double)box->high[k] - (double)box->low[k];
    return sum / 3;
}

/* Half the surface area of a box. The share of all lines that meet a box is proportional to it. */
static double bvh_box_area(const mw_bvh_box *box)
{
    double x = (double)box->high[0] - (double)box->low[0],
           y = (double)box->high[1] - (double)box->low[1];
    double z = (double)box->high[2] - (double)box->low[2];
    return x * y + y * z + z * x;
}

static double bvh_median_leaf(const mw_bvh *b, double (*measure)(const mw_bvh_box *box))
{
    double value[SAMPLE];
    uint32_t wanted = b->level_boxes[0] < SAMPLE ? b->level_boxes[0] : SAMPLE, count = 0;
    for (uint32_t i = 0; i < wanted; i++) {
        const mw_bvh_box *box = mw__bvh_box_at(b, 0, sample_index(i, wanted, b->level_boxes[0]));
        if (box->low[0] <= box->high[0]) value[count++] = measure(box);
    }
    values_sort(value, count);
    return count ? value[count / 2] : 0;
}

double mw__bvh_leaf_size(const mw_bvh *bvh)
{
    return bvh_median_leaf(bvh, bvh_box_size) / bvh->scale;
}

/* The sum of the areas of the leaves. No leaf counts more than `most`. */
static double bvh_area_of_leaves(const mw_bvh *b, double most)
{
    double sum = 0;
    for (uint32_t i = 0; i < b->level_boxes[0]; i++) {
        const mw_bvh_box *box = mw__bvh_box_at(b, 0, i);
        if (box->low[0] <= box->high[0]) sum += fmin(bvh_box_area(box), most);
    }
    return sum;
}

/* --- order --- */

/* Maps most of a surface to the cells of a Hilbert curve. Points outside move to its outermost
 * cells. */
typedef struct bvh_curve {
    double low[3], scale[3];
} bvh_curve;

static bvh_curve bvh_choose_curve(const mw_surface *surface)
{
    bvh_curve c = {{0}, {0}};
    double value[3][SAMPLE];
    uint32_t count = bvh_sample_corners(surface, value);
    if (!count) return c;
    double extent = 0;
    for (int k = 0; k < 3; k++) extent = fmax(extent, value[k][count - 1] / 2 - value[k][0] / 2);
    for (int k = 0; k < 3; k++) {
        c.low[k] = value[k][0] - extent / 8;
        c.scale[k] = extent > 0 ? (1 << KEY_BITS) / 2.25 / extent : 0;
    }
    return c;
}

static uint32_t curve_cell(double offset)
{
    /* written so that NaN becomes 0 */
    return offset > 0 ? offset < (1 << KEY_BITS) - 1 ? (uint32_t)offset : (1 << KEY_BITS) - 1 : 0;
}

/* The position of a cell along the Hilbert curve [Skilling 2004: Programming the Hilbert curve].
 * First undo the rotations, from the coarsest level on, then the Gray code. The key is the
 * interleaved bits of the axes. */
static uint32_t curve_cell_key(uint32_t cell[3])
{
    for (uint32_t bit = 1u << (KEY_BITS - 1); bit > 1; bit >>= 1) {
        for (int k = 0; k < 3; k++) {
            uint32_t swap = (cell[0] ^ cell[k]) & (bit - 1);
            if (cell[k] & bit) {
                cell[0] ^= bit - 1;
            } else {
                cell[0] ^= swap;
                cell[k] ^= swap;
            }
        }
    }
    cell[1] ^= cell[0];
    cell[2] ^= cell[1];
    uint32_t gray = 0, key = 0;
    for (uint32_t bit = 1u << (KEY_BITS - 1); bit > 1; bit >>= 1)
        if (cell[2] & bit) gray ^= bit - 1;
    for (int bit = KEY_BITS - 1; bit >= 0; bit--)
        for (int k = 0; k < 3; k++) key = key << 1 | ((cell[k] ^ gray) >> bit & 1);
    return key;
}

static uint32_t bvh_triangle_key(const bvh_curve *c, const mw_surface *surface, uint32_t t)
{
    uint32_t cell[3];
    const double *p[3];
    for (uint32_t i = 0; i < 3; i++) p[i] = mw__surface_corner(surface, t, i);
    for (int k = 0; k < 3; k++) {
        double middle = p[0][k] / 3 + p[1][k] / 3 + p[2][k] / 3;
        cell[k] = curve_cell((middle - c->low[k]) * c->scale[k]);
    }
    return curve_cell_key(cell);
}

/* The triangles sorted along the curve; NULL when out of memory, or cancelled. */
static uint32_t *bvh_order_along_curve(const mw_surface *surface, mw_job *job)
{
    uint32_t n = surface->tri_count, *order = mw__alloc(n, sizeof *order);
    mw_key *key = mw__alloc(2 * (size_t)n, sizeof *key);
    if (!order || !key) {
        free(order);
        free(key);
        return NULL;
    }
    bvh_curve c = bvh_choose_curve(surface);
    mw__job_stage(job, "sorting triangles", 0.6);
    for (uint32_t t = 0; t < n && mw__job_step(job, t, n); t++)
        key[t] = (mw_key){bvh_triangle_key(&c, surface, t), t};
    if (mw__job_stopped(job)) {
        free(order);
        free(key);
        return NULL;
    }
    mw__sort_keys(key, key + n, n);
    for (uint32_t i = 0; i < n; i++) order[i] = key[i].item;
    free(key);
    return order;
}

/* An own order costs 4 bytes a triangle. It is kept if the leaves in the order of the file have
 * WORTHWHILE times the area. Scanned models often have 10 to 300 times. No leaf counts more than
 * LARGE median ones, so that a few large triangles do not hide the many small ones. */
#define WORTHWHILE 1.5
#define LARGE 64

static bool bvh_choose_order(mw_bvh *b, const mw_surface *surface, mw_job *job)
{
    bvh_choose_frame(b, surface);
    mw__job_stage(job, "choosing an order", 0.2);
    if (!bvh_fit_level(b, surface, 0, job)) return false;
    double most = LARGE * bvh_median_leaf(b, bvh_box_area), curved = bvh_area_of_leaves(b, most);
    uint32_t *order = b->order;
    b->order = NULL;
    mw__job_stage(job, "choosing an order", 0.2);
    bool done = bvh_fit_level(b, surface, 0, job);
    if (done && bvh_area_of_leaves(b, most) > WORTHWHILE * curved)
        b->order = order;
    else
        free(order);
    return done;
}

/* --- the tree --- */

/* Lay out the levels. Returns the number of boxes. */
static uint32_t bvh_lay_out(mw_bvh *b)
{
    uint32_t sum = 0, here = (b->count + MW_BVH_LEAF - 1) / MW_BVH_LEAF;
    for (;; here = (here + MW_BVH_FANOUT - 1) / MW_BVH_FANOUT) {
        b->first[b->level_count] = sum;
        b->level_boxes[b->level_count++] = here;
        sum += here;
        if (here == 1) return sum;
    }
}

bool mw__bvh_create(mw_bvh *bvh, const mw_surface *surface, mw_job *job)
{
    *bvh = (mw_bvh){.count = surface->tri_count};
    bvh->box = mw__alloc_lines(bvh_lay_out(bvh), sizeof *bvh->box);
    bvh->order = bvh_order_along_curve(surface, job);
    return bvh->box && bvh->order && bvh_choose_order(bvh, surface, job);
}

void mw__bvh_release(mw_bvh *bvh)
{
    free(bvh->box);
    free(bvh->order);
    *bvh = (mw_bvh){0};
}

size_t mw__bvh_bytes(const mw_bvh *bvh)
{
    uint32_t top = bvh->level_count - 1;
    size_t bytes = (bvh->first[top] + (size_t)1) * sizeof *bvh->box;
    return bvh->order ? bytes + bvh->count * sizeof *bvh->order : bytes;
}
