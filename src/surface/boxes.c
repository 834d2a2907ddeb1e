/* boxes.c - a packed tree of boxes over the triangles of a surface: its order, and how it is fitted.
 *
 * The order is the file's where its leaves are about as compact as those along a space-filling curve; else the curve's.
 * It stays when the surface moves: neighbours stay near each other. */
#include "surface/boxes.h"

#include "base/hilbert.h"
#include "base/threads.h"

#include <float.h>
#include <stdlib.h>

enum {
    SAMPLE = 255,    /* triangles, or leaves, that stand for all          */
    CHUNK = 1 << 10, /* leaves that one thread fits at a time             */
    KEY_BITS = 10    /* of each axis, in a key of the space-filling curve */
};

/* --- samples ------------------------------------------------------------------------------------------------------ */

/* Number i of `count` out of n, evenly. */
static uint32_t sampled(uint32_t i, uint32_t count, uint32_t n)
{
    return (uint32_t)((uint64_t)i * n / count);
}

static int compare_values(const void *a, const void *b)
{
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

static void sort_values(double *value, uint32_t count)
{
    qsort(value, count, sizeof *value, compare_values);
}

/* First corners of a sample of triangles, each coordinate sorted for itself. Returns how many are finite. */
static uint32_t sample_corners(const mw_surface *surface, double value[3][SAMPLE])
{
    uint32_t wanted = surface->tri_count < SAMPLE ? surface->tri_count : SAMPLE, count = 0;
    for (uint32_t i = 0; i < wanted; i++) {
        const double *corner = mw__surface_corner(surface, sampled(i, wanted, surface->tri_count), 0);
        if (!mw__is_finite3(corner)) continue;
        for (int k = 0; k < 3; k++) value[k][count] = corner[k];
        count++;
    }
    for (int k = 0; k < 3; k++) sort_values(value[k], count);
    return count;
}

/* The scale brings the largest coordinate of the sample to 1/2 ... 1; the centre is the median of each coordinate. */
static void choose_frame(mw_surface_boxes *b, const mw_surface *surface)
{
    double value[3][SAMPLE], largest = 0;
    uint32_t count = sample_corners(surface, value);
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

/* --- fit ---------------------------------------------------------------------------------------------------------- */

/* A value of the frame, off by at most 2^-53 of itself and 2^-1074, rounded to a float that is surely less, with ROUND
 * for the rounding to a float and for the error, and TINY where floats underflow. */
#define ROUND 0x1p-22
#define TINY 0x1p-140

static float float_below(double y)
{
    return (float)(y - fabs(y) * ROUND - TINY);
}

static mw_surface_box box_of_nothing(void)
{
    return (mw_surface_box){{FLT_MAX, FLT_MAX, FLT_MAX}, {-FLT_MAX, -FLT_MAX, -FLT_MAX}};
}

static mw_surface_box box_of_everything(void)
{
    return (mw_surface_box){{-INFINITY, -INFINITY, -INFINITY}, {INFINITY, INFINITY, INFINITY}};
}

/* What holds low..high, in units of length. Too large for floats: everything. */
static mw_surface_box rounded_outwards(const mw_surface_boxes *b, const double low[3], const double high[3])
{
    mw_surface_box box;
    double from[3], to[3];
    mw__surface_boxes_frame(b, low, from);
    mw__surface_boxes_frame(b, high, to);
    for (int k = 0; k < 3; k++) {
        if (!(from[k] > -0x1p126 && to[k] < 0x1p126)) return box_of_everything();
        box.low[k] = float_below(from[k]);
        box.high[k] = -float_below(-to[k]);
    }
    return box;
}

static mw_surface_box fit_leaf(const mw_surface_boxes *b, const mw_surface *surface, uint32_t leaf)
{
    double low[3] = {INFINITY, INFINITY, INFINITY}, high[3] = {-INFINITY, -INFINITY, -INFINITY};
    uint32_t first, end = mw__surface_boxes_below(b, 0, leaf, &first);
    for (uint32_t i = first; i < end; i++) {
        uint32_t t = mw__surface_boxes_triangle(b, i);
        if (!mw__corners_finite(surface, t)) continue;
        for (uint32_t corner = 0; corner < 3; corner++) {
            const double *p = mw__surface_corner(surface, t, corner);
            for (int k = 0; k < 3; k++) {
                low[k] = p[k] < low[k] ? p[k] : low[k];
                high[k] = p[k] > high[k] ? p[k] : high[k];
            }
        }
    }
    return low[0] <= high[0] ? rounded_outwards(b, low, high) : box_of_nothing();
}

static mw_surface_box fit_box(const mw_surface_boxes *b, uint32_t level, uint32_t i)
{
    mw_surface_box box = box_of_nothing();
    uint32_t first, end = mw__surface_boxes_below(b, level, i, &first);
    for (uint32_t j = first; j < end; j++) {
        const mw_surface_box *below = mw__surface_box(b, level - 1, j);
        for (int k = 0; k < 3; k++) {
            box.low[k] = below->low[k] < box.low[k] ? below->low[k] : box.low[k];
            box.high[k] = below->high[k] > box.high[k] ? below->high[k] : box.high[k];
        }
    }
    return box;
}

static void fit_level(mw_surface_boxes *b, const mw_surface *surface, uint32_t level, uint32_t threads)
{
    int64_t count = b->level_boxes[level], chunks = (count + CHUNK - 1) / CHUNK;
    int team = mw__team(threads, chunks);
    (void)team; /* unused without OpenMP */
    mw_surface_box *box = b->box + b->first[level];
#ifdef _OPENMP
#pragma omp parallel for schedule(dynamic) num_threads(team) if (team > 1)
#endif
    for (int64_t chunk = 0; chunk < chunks; chunk++)
        for (int64_t i = chunk * CHUNK; i < count && i < (chunk + 1) * CHUNK; i++)
            box[i] = level ? fit_box(b, level, (uint32_t)i) : fit_leaf(b, surface, (uint32_t)i);
}

void mw__surface_boxes_fit(mw_surface_boxes *boxes, const mw_surface *surface, uint32_t threads)
{
    choose_frame(boxes, surface);
    for (uint32_t level = 0; level < boxes->level_count; level++) fit_level(boxes, surface, level, threads);
}

/* --- how good an order is ----------------------------------------------------------------------------------------- */

static double leaf_size(const mw_surface_box *box)
{
    double sum = 0;
    for (int k = 0; k < 3; k++) sum += (double)box->high[k] - (double)box->low[k];
    return sum / 3;
}

/* Half the area of a box: the share of all lines that meet it is proportional to that. */
static double leaf_area(const mw_surface_box *box)
{
    double x = (double)box->high[0] - (double)box->low[0], y = (double)box->high[1] - (double)box->low[1];
    double z = (double)box->high[2] - (double)box->low[2];
    return x * y + y * z + z * x;
}

static double median_leaf(const mw_surface_boxes *b, double (*measure)(const mw_surface_box *box))
{
    double value[SAMPLE];
    uint32_t wanted = b->level_boxes[0] < SAMPLE ? b->level_boxes[0] : SAMPLE, count = 0;
    for (uint32_t i = 0; i < wanted; i++) {
        const mw_surface_box *box = mw__surface_box(b, 0, sampled(i, wanted, b->level_boxes[0]));
        if (box->low[0] <= box->high[0]) value[count++] = measure(box);
    }
    sort_values(value, count);
    return count ? value[count / 2] : 0;
}

double mw__surface_boxes_leaf_size(const mw_surface_boxes *boxes)
{
    return median_leaf(boxes, leaf_size) / boxes->scale;
}

/* The sum of the leaves' areas, none of which counts more than `most`. */
static double area_of_leaves(const mw_surface_boxes *b, double most)
{
    double sum = 0;
    for (uint32_t i = 0; i < b->level_boxes[0]; i++) {
        const mw_surface_box *box = mw__surface_box(b, 0, i);
        if (box->low[0] <= box->high[0]) sum += fmin(leaf_area(box), most);
    }
    return sum;
}

/* --- order -------------------------------------------------------------------------------------------------------- */

/* Maps the bulk of a surface to the cells of a Hilbert curve; what lies outside of that is moved to its rim. */
typedef struct curve {
    double low[3], scale[3];
} curve;

static curve choose_curve(const mw_surface *surface)
{
    curve c = {{0}, {0}};
    double value[3][SAMPLE];
    uint32_t count = sample_corners(surface, value);
    if (!count) return c;
    double extent = 0;
    for (int k = 0; k < 3; k++) extent = fmax(extent, value[k][count - 1] / 2 - value[k][0] / 2);
    for (int k = 0; k < 3; k++) {
        c.low[k] = value[k][0] - extent / 8;
        c.scale[k] = extent > 0 ? (1 << KEY_BITS) / 2.25 / extent : 0;
    }
    return c;
}

static uint32_t cell_of(double offset)
{
    /* written so that NaN goes to 0 */
    return offset > 0 ? offset < (1 << KEY_BITS) - 1 ? (uint32_t)offset : (1 << KEY_BITS) - 1 : 0;
}

/* The position of a cell along the Hilbert curve [Skilling 2004: Programming the Hilbert curve]: undo the turns from
 * the coarsest level on, then the Gray code; the bits of the axes interleaved are the key. */
static uint32_t curve_key(uint32_t cell[3])
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

static uint32_t triangle_key(const curve *c, const mw_surface *surface, uint32_t t)
{
    uint32_t cell[3];
    const double *p[3];
    for (uint32_t i = 0; i < 3; i++) p[i] = mw__surface_corner(surface, t, i);
    for (int k = 0; k < 3; k++) {
        double middle = p[0][k] / 3 + p[1][k] / 3 + p[2][k] / 3;
        cell[k] = cell_of((middle - c->low[k]) * c->scale[k]);
    }
    return curve_key(cell);
}

/* The triangles along the curve; NULL when out of memory. */
static uint32_t *order_along_curve(const mw_surface *surface)
{
    uint32_t n = surface->tri_count, *order = mw__alloc(n, sizeof *order);
    mw_key *key = mw__alloc(2 * (size_t)n, sizeof *key);
    if (!order || !key) {
        free(order);
        free(key);
        return NULL;
    }
    curve c = choose_curve(surface);
    for (uint32_t t = 0; t < n; t++) key[t] = (mw_key){triangle_key(&c, surface, t), t};
    mw__sort_keys(key, key + n, n);
    for (uint32_t i = 0; i < n; i++) order[i] = key[i].item;
    free(key);
    return order;
}

/* An order of one's own costs 4 bytes a triangle: it is kept where the leaves of the file's order have WORTHWHILE times
 * the area. Those of scanned models commonly have 10 to 300 times. So that a few large triangles do not hide what the
 * many do, no leaf counts more than LARGE common ones. */
#define WORTHWHILE 1.5
#define LARGE 64

static void choose_order(mw_surface_boxes *b, const mw_surface *surface)
{
    choose_frame(b, surface);
    fit_level(b, surface, 0, 0);
    double most = LARGE * median_leaf(b, leaf_area), curved = area_of_leaves(b, most);
    uint32_t *order = b->order;
    b->order = NULL;
    fit_level(b, surface, 0, 0);
    if (area_of_leaves(b, most) > WORTHWHILE * curved)
        b->order = order;
    else
        free(order);
}

/* --- the tree ----------------------------------------------------------------------------------------------------- */

/* Returns the number of boxes. */
static uint32_t lay_out(mw_surface_boxes *b)
{
    uint32_t sum = 0, here = (b->count + MW_SURFACE_LEAF - 1) / MW_SURFACE_LEAF;
    for (;; here = (here + MW_SURFACE_FAN - 1) / MW_SURFACE_FAN) {
        b->first[b->level_count] = sum;
        b->level_boxes[b->level_count++] = here;
        sum += here;
        if (here == 1) return sum;
    }
}

bool mw__surface_boxes_create(mw_surface_boxes *boxes, const mw_surface *surface)
{
    *boxes = (mw_surface_boxes){.count = surface->tri_count};
    boxes->box = mw__alloc_lines(lay_out(boxes), sizeof *boxes->box);
    boxes->order = order_along_curve(surface);
    if (!boxes->box || !boxes->order) return false;
    choose_order(boxes, surface);
    return true;
}

void mw__surface_boxes_release(mw_surface_boxes *boxes)
{
    free(boxes->box);
    free(boxes->order);
    *boxes = (mw_surface_boxes){0};
}

size_t mw__surface_boxes_bytes(const mw_surface_boxes *boxes)
{
    uint32_t top = boxes->level_count - 1;
    size_t bytes = (boxes->first[top] + (size_t)1) * sizeof *boxes->box;
    return boxes->order ? bytes + boxes->count * sizeof *boxes->order : bytes;
}
