/* bvh_build.c - divides the triangles of a surface among the nodes of a bounding volume hierarchy,
 * by the surface area heuristic on bins [Wald 2007].
 *
 * A node begins with all its triangles as one range. As long as it has fewer than eight, the range
 * with the largest box is divided in two, at the plane between bins where the sum of areas times
 * triangles is least. Ranges that are small are not divided, since one node will test all their
 * triangles at once; where slots of the node remain, the smallest ranges go into it, triangle by
 * triangle.
 *
 * Boxes that all have one centre cannot be divided so. They are put in order, the small ones first
 * and equal triangles side by side, and cut near the middle: so equal triangles get nodes of their
 * own.
 *
 * The tree depends on the triangles alone, not on threads. */
#include "probe/bvh/bvh.h"
#include "probe/bvh/bvh_item.h"

#include <float.h>
#include <stdatomic.h>
#include <stdlib.h>

enum {
    MOST_BINS = 16,
    FEW = 64,     /* triangles that are divided with half as many bins */
    HALVING = 24, /* from this level on ranges are halved: eight levels more are enough then */
    GROUPS = 512  /* of the ranges of a level, for the threads */
};

/* The areas of boxes up to here are floats. */
#define LARGEST 0x1p40f

/* Items first .. first + count - 1, with their box. */
typedef struct build_range {
    build_vector low, high;
    uint32_t first, count;
} build_range;

/* The ranges of the children of a node. */
typedef struct build_node {
    uint32_t first[MW_BVH_WIDTH], count[MW_BVH_WIDTH];
} build_node;

/* --- bins --- */

/* Where the centres of the items lie, doubled: bin = (low + high - from) * scale. */
typedef struct build_bins {
    build_vector from, scale;
    int count;
    uint32_t items[3][MOST_BINS];
    build_vector low[3][MOST_BINS], high[3][MOST_BINS];
} build_bins;

static const build_vector nothing_low = {FLT_MAX, FLT_MAX, FLT_MAX, FLT_MAX},
                          nothing_high = {-FLT_MAX, -FLT_MAX, -FLT_MAX, -FLT_MAX};

static void bins_begin(build_bins *b, const build_item *item, uint32_t n)
{
    build_vector low = nothing_low, high = nothing_high;
    for (uint32_t i = 0; i < n; i++) {
        build_vector centre = item[i].low + item[i].high;
        low = vector_min(low, centre);
        high = vector_max(high, centre);
    }
    b->count = n < FEW ? MOST_BINS / 2 : MOST_BINS;
    b->from = low;
    for (int k = 0; k < 3; k++) {
        float extent = high[k] - low[k];
        b->scale[k] = extent > 0x1p-60f ? (float)b->count * 0.99999f / extent : 0;
        for (int i = 0; i < b->count; i++) {
            b->items[k][i] = 0;
            b->low[k][i] = nothing_low;
            b->high[k][i] = nothing_high;
        }
    }
    b->scale[3] = 0;
}

static MW_INLINE build_index bins_of(const build_bins *b, const build_item *item)
{
    return __builtin_convertvector((item->low + item->high - b->from) * b->scale, build_index);
}

static void bins_fill(build_bins *b, const build_item *item, uint32_t n)
{
    for (uint32_t i = 0; i < n; i++) {
        build_index bin = bins_of(b, &item[i]);
        for (int k = 0; k < 3; k++) {
            b->items[k][bin[k]]++;
            b->low[k][bin[k]] = vector_min(b->low[k][bin[k]], item[i].low);
            b->high[k][bin[k]] = vector_max(b->high[k][bin[k]], item[i].high);
        }
    }
}

/* Where a range is divided: bins below `bin` of an axis go left. */
typedef struct build_split {
    float cost;
    int axis, bin;
} build_split;

/* Nodes test eight triangles at a time, at the cost of one. */
static float items_cost(uint32_t n)
{
    return (float)((n + 3) / 4);
}

static void bins_look_along(const build_bins *b, int axis, build_split *best)
{
    float right_cost[MOST_BINS];
    build_vector low = nothing_low, high = nothing_high;
    uint32_t n = 0;
    for (int i = b->count - 1; i > 0; i--) {
        low = vector_min(low, b->low[axis][i]);
        high = vector_max(high, b->high[axis][i]);
        n += b->items[axis][i];
        right_cost[i] = n ? area_of(low, high) * items_cost(n) : INFINITY;
    }
    low = nothing_low;
    high = nothing_high;
    n = 0;
    for (int i = 1; i < b->count; i++) {
        low = vector_min(low, b->low[axis][i - 1]);
        high = vector_max(high, b->high[axis][i - 1]);
        n += b->items[axis][i - 1];
        if (!n) continue;
        float cost = area_of(low, high) * items_cost(n) + right_cost[i];
        if (cost < best->cost) *best = (build_split){cost, axis, i};
    }
}

/* --- ranges --- */

static void range_measure(build_range *r, const build_item *items)
{
    r->low = nothing_low;
    r->high = nothing_high;
    for (uint32_t i = 0; i < r->count; i++) {
        r->low = vector_min(r->low, items[r->first + i].low);
        r->high = vector_max(r->high, items[r->first + i].high);
    }
}

/* Divide a range as it is: `left` items and the others. */
static void range_cut(build_range *r, build_range *right, const build_item *items, uint32_t left)
{
    *right = (build_range){.first = r->first + left, .count = r->count - left};
    r->count = left;
    range_measure(r, items);
    range_measure(right, items);
}

/* The items of the left side first. Returns their number. */
static uint32_t items_part(build_item *item, uint32_t n, const build_bins *b, build_split split)
{
    uint32_t i = 0, j = n;
    for (;;) {
        while (i < j && bins_of(b, &item[i])[split.axis] < split.bin) i++;
        while (i < j && bins_of(b, &item[j - 1])[split.axis] >= split.bin) j--;
        if (i >= j) return i;
        build_item other = item[i];
        item[i++] = item[--j];
        item[j] = other;
    }
}

static void bins_box(const build_bins *b, int axis, int from, int to, build_range *r)
{
    r->low = nothing_low;
    r->high = nothing_high;
    for (int i = from; i < to; i++) {
        r->low = vector_min(r->low, b->low[axis][i]);
        r->high = vector_max(r->high, b->high[axis][i]);
    }
}

typedef struct bvh_building {
    mw_bvh *bvh;
    const mw_surface *surface;
    build_item *items;
    build_range *ranges; /* of the nodes of a level */
    build_node *nodes;
    uint32_t range_count, level;
    atomic_bool crowds; /* some range had one centre */
} bvh_building;

/* Divide a range: *r becomes the left part. */
static void range_divide(bvh_building *b, build_range *r, build_range *right)
{
    build_bins bins;
    build_split best = {INFINITY, 0, 0};
    build_item *item = b->items + r->first;
    bins_begin(&bins, item, r->count);
    bins_fill(&bins, item, r->count);
    for (int axis = 0; axis < 3; axis++) bins_look_along(&bins, axis, &best);
    if (!(best.cost < INFINITY)) { /* all centres are one */
        atomic_store_explicit(&b->crowds, true, memory_order_relaxed);
        mw__bvh_items_order(item, r->count, b->surface);
        range_cut(r, right, b->items, mw__bvh_items_cut(item, r->count));
        return;
    }
    uint32_t left = items_part(item, r->count, &bins, best);
    right->first = r->first + left;
    right->count = r->count - left;
    r->count = left;
    bins_box(&bins, best.axis, 0, best.bin, r);
    bins_box(&bins, best.axis, best.bin, bins.count, right);
}

/* --- nodes --- */

/* The range to be divided next: the largest box, of equal ones the most items, or the most items;
 * -1 if all are small. */
static int ranges_largest(const build_range *range, int n, bool halve)
{
    int largest = -1;
    float most = -1;
    for (int i = 0; i < n; i++) {
        float size = halve ? (float)range[i].count : area_of(range[i].low, range[i].high);
        if (range[i].count <= MW_BVH_WIDTH || size < most) continue;
        if (size == most && range[i].count <= range[largest].count) continue;
        most = size;
        largest = i;
    }
    return largest;
}

/* Replace small ranges by their items, the smallest first, while there is room. */
static int ranges_open(build_range *range, int n)
{
    for (;;) {
        int smallest = -1;
        for (int i = 0; i < n; i++)
            if (range[i].count > 1 && (smallest < 0 || range[i].count < range[smallest].count))
                smallest = i;
        if (smallest < 0 || n - 1 + (int64_t)range[smallest].count > (int64_t)MW_BVH_WIDTH)
            return n;
        uint32_t more = range[smallest].count - 1;
        range[smallest].count = 1;
        for (uint32_t i = 1; i <= more; i++)
            range[n++] = (build_range){.first = range[smallest].first + i, .count = 1};
    }
}

static void node_divide(bvh_building *b, build_node *node, build_range range)
{
    const bool halve = b->level >= HALVING;
    build_range child[MW_BVH_WIDTH] = {range};
    int n = 1;
    while (n < (int)MW_BVH_WIDTH) {
        int i = ranges_largest(child, n, halve);
        if (i < 0) break;
        if (halve)
            range_cut(&child[i], &child[n], b->items, child[i].count / 2);
        else
            range_divide(b, &child[i], &child[n]);
        n++;
    }
    n = ranges_open(child, n);
    *node = (build_node){{0}, {0}};
    for (int i = 0; i < n; i++) {
        node->first[i] = child[i].first;
        node->count[i] = child[i].count;
    }
}

/* --- levels --- */

static void building_box_triangles(void *work, uint64_t from, uint64_t to)
{
    const bvh_building *b = work;
    for (uint64_t t = from; t < to; t++) {
        mw_bvh_box box = mw__bvh_box_of(b->bvh, b->surface, (uint32_t)t);
        build_item *item = &b->items[t];
        *item = (build_item){{0}, {0}};
        for (int k = 0; k < 3; k++) {
            bool empty = box.low[k] > box.high[k];
            item->low[k] = empty ? 0 : fmaxf(box.low[k], -LARGEST);
            item->high[k] = empty ? 0 : fminf(box.high[k], LARGEST);
            item->low[k] = fminf(item->low[k], LARGEST);
            item->high[k] = fmaxf(item->high[k], -LARGEST);
        }
        item_set_triangle(item, (uint32_t)t);
    }
}

/* Close up over the triangles that an editor has freed. Returns how many are left. */
static uint32_t building_drop_freed(const bvh_building *b)
{
    uint32_t n = b->surface->tri_count, left = 0;
    if (b->surface->freed_triangles == 0) return n;
    for (uint32_t t = 0; t < n; t++)
        if (!mw__surface_is_freed(b->surface, t)) b->items[left++] = b->items[t];
    return left;
}

static void building_divide_group(void *work, uint64_t group, uint32_t member)
{
    bvh_building *b = work;
    uint64_t from = group * b->range_count / GROUPS, to = (group + 1) * b->range_count / GROUPS;
    (void)member;
    for (uint64_t i = from; i < to; i++)
        node_divide(b, &b->nodes[b->bvh->first[b->level] + i], b->ranges[i]);
}

/* The ranges of the next level, in b->ranges. Returns false when out of memory. */
static bool building_descend(bvh_building *b)
{
    const build_node *node = b->nodes + b->bvh->first[b->level];
    uint32_t count = 0;
    for (uint32_t i = 0; i < b->range_count; i++)
        for (uint32_t k = 0; k < MW_BVH_WIDTH; k++) count += node[i].count[k] > 1;
    build_range *next = mw__alloc_lines(count, sizeof *next);
    if (!next) return false;
    uint32_t at = 0;
    for (uint32_t i = 0; i < b->range_count; i++)
        for (uint32_t k = 0; k < MW_BVH_WIDTH; k++)
            if (node[i].count[k] > 1)
                next[at++] = (build_range){.first = node[i].first[k], .count = node[i].count[k]};
    free(b->ranges);
    b->ranges = next;
    b->range_count = count;
    b->level++;
    b->bvh->first[b->level] = b->bvh->node_count;
    return true;
}

/* Divide the ranges of a level. */
static bool building_divide_level(bvh_building *b, mw_job *job, double share)
{
    uint64_t nodes = (uint64_t)b->bvh->node_count + b->range_count;
    build_node *more = mw__realloc(b->nodes, nodes, sizeof *more);
    if (!more) return false;
    b->nodes = more;
    b->bvh->node_count = (uint32_t)nodes;
    mw__job_stage(job, "dividing triangles", share);
    return mw__job_chunks(job, mw__job_team(job, b->range_count), GROUPS, building_divide_group, b);
}

/* The children of all nodes, as they are numbered level by level. */
static void building_number(const bvh_building *b)
{
    uint32_t next = 1;
    for (uint32_t i = 0; i < b->bvh->node_count; i++)
        for (uint32_t k = 0; k < MW_BVH_WIDTH; k++) {
            const build_node *node = &b->nodes[i];
            uint32_t *child = &b->bvh->node[i].child[k];
            if (node->count[k] == 0)
                *child = MW_NONE;
            else if (node->count[k] == 1)
                *child = item_triangle(&b->items[node->first[k]]) | MW_BVH_TRIANGLE;
            else
                *child = next++;
            for (int c = 0; c < 3; c++) b->bvh->node[i].vertex[k][c] = 0;
        }
}

static bool building_run(bvh_building *b, mw_job *job)
{
    if (!b->items || !b->ranges) return false;
    mw__job_stage(job, "boxes of triangles", 0.1);
    mw__bvh_choose_frame(b->bvh, b->surface);
    if (!mw__job_ranges(job, b->surface->tri_count, building_box_triangles, b)) return false;
    uint32_t n = building_drop_freed(b);
    b->ranges[0] = (build_range){.first = 0, .count = n};
    b->range_count = 1;
    double left = 0.9;
    while (b->range_count) {
        left /= 2;
        if (!building_divide_level(b, job, left) || !building_descend(b)) return false;
    }
    b->bvh->level_count = b->level;
    b->bvh->node = mw__alloc_lines(b->bvh->node_count, sizeof *b->bvh->node);
    if (!b->bvh->node) return false;
    building_number(b);
    if (!atomic_load_explicit(&b->crowds, memory_order_relaxed)) return true;
    b->bvh->same = mw__alloc(b->bvh->node_count, sizeof *b->bvh->same);
    return b->bvh->same != NULL;
}

bool mw__bvh_create(mw_bvh *bvh, const mw_surface *surface, mw_job *job)
{
    *bvh = (mw_bvh){.free_node = MW_NONE};
    bvh_building b = {.bvh = bvh, .surface = surface};
    b.items = mw__alloc_lines(surface->tri_count, sizeof *b.items);
    b.ranges = mw__alloc_lines(1, sizeof *b.ranges);
    bool done = building_run(&b, job);
    free(b.items);
    free(b.ranges);
    free(b.nodes);
    return done;
}

void mw__bvh_release(mw_bvh *bvh)
{
    free(bvh->node);
    free(bvh->place);
    free(bvh->parent);
    free(bvh->same);
    *bvh = (mw_bvh){0};
}

size_t mw__bvh_bytes(const mw_bvh *bvh)
{
    size_t parents = bvh->parent ? bvh->node_room * sizeof *bvh->parent : 0,
           places = bvh->place ? bvh->place_room * sizeof *bvh->place : 0,
           same = bvh->same ? bvh->node_count * sizeof *bvh->same : 0;
    return bvh->node_count * sizeof *bvh->node + parents + places + same;
}
