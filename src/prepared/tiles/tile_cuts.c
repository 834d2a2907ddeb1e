#include "prepared/tiles/tile_cuts.h"
#include "base/random.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

typedef struct tile_item {
    double middle[2];
    uint32_t triangle, tile;
} tile_item;

typedef struct cutting {
    mw_tile_cuts *cuts;
    const mw_mesh *mesh;
    tile_item *item;
    uint64_t random; /* chooses pivots, which no result depends on */
} cutting;

static void triangle_box(const mw_mesh *mesh, uint32_t t, double low[2], double high[2])
{
    uint32_t v[3];
    double p[2];
    mw_mesh_triangle(mesh, t, v);
    for (int k = 0; k < 3; k++) {
        mw_mesh_vertex(mesh, v[k], p);
        for (int axis = 0; axis < 2; axis++) {
            if (k == 0 || p[axis] < low[axis]) low[axis] = p[axis];
            if (k == 0 || p[axis] > high[axis]) high[axis] = p[axis];
        }
    }
}

/* No two items are equal, so that the result is the same on every machine. */
static bool item_is_before(const tile_item *a, const tile_item *b, int axis)
{
    if (a->middle[axis] != b->middle[axis]) return a->middle[axis] < b->middle[axis];
    return a->triangle < b->triangle;
}

static void items_swap(tile_item *a, tile_item *b)
{
    const tile_item kept = *a;
    *a = *b;
    *b = kept;
}

/* Divide items by the first of them. Returns the last place of the lower part. */
static size_t items_divide(tile_item *item, size_t count, int axis)
{
    const tile_item pivot = *item;
    for (size_t i = 0, j = count - 1;; i++, j--) {
        while (item_is_before(&item[i], &pivot, axis)) i++;
        while (item_is_before(&pivot, &item[j], axis)) j--;
        if (i >= j) return j;
        items_swap(&item[i], &item[j]);
    }
}

/* Move the lowest `first` of the items to the front [Hoare 1961, algorithm 65]. */
static void items_select(tile_item *item, size_t count, size_t first, int axis, uint64_t *random)
{
    while (count > 1) {
        items_swap(item, &item[mw__random(random) % count]);
        const size_t low = items_divide(item, count, axis) + 1;
        if (first < low) {
            count = low;
        } else {
            item += low;
            first -= low;
            count -= low;
        }
    }
}

/* The axis along which the items reach farther. */
static int items_axis(const tile_item *item, size_t count)
{
    double size[2];
    for (int axis = 0; axis < 2; axis++) {
        double low = item->middle[axis], high = low;
        for (size_t i = 1; i < count; i++) {
            low = fmin(low, item[i].middle[axis]);
            high = fmax(high, item[i].middle[axis]);
        }
        size[axis] = high - low;
    }
    return size[1] > size[0];
}

/* How far the items reach along an axis: the highest, or the lowest. */
static double items_end(const cutting *c, const tile_item *item, size_t count, int axis,
                        bool highest)
{
    double end = 0, low[2], high[2];
    for (size_t i = 0; i < count; i++) {
        triangle_box(c->mesh, item[i].triangle, low, high);
        const double reach = highest ? high[axis] : low[axis];
        if (i == 0 || (highest ? reach > end : reach < end)) end = reach;
    }
    return end;
}

/* Divide items into tiles. Returns the number of the cut, or -1 - that of the tile. */
static int64_t cutting_divide(cutting *c, tile_item *item, size_t count, uint32_t tiles)
{
    mw_tile_cuts *cuts = c->cuts;
    if (tiles == 1) {
        for (size_t i = 0; i < count; i++) item[i].tile = cuts->tiles;
        return -1 - (int64_t)cuts->tiles++;
    }
    const uint32_t number = cuts->cuts++, half = tiles / 2;
    const size_t below = (size_t)((uint64_t)count * half / tiles);
    mw_tile_cut cut = {.axis = items_axis(item, count)};
    items_select(item, count, below, cut.axis, &c->random);
    cut.low_ends = items_end(c, item, below, cut.axis, true);
    cut.high_begins = items_end(c, item + below, count - below, cut.axis, false);
    cut.low = cutting_divide(c, item, below, half);
    cut.high = cutting_divide(c, item + below, count - below, tiles - half);
    cuts->cut[number] = cut;
    return number;
}

static void items_take(const cutting *c, const uint32_t *triangles, size_t count)
{
    for (size_t i = 0; i < count; i++) {
        double low[2], high[2];
        triangle_box(c->mesh, triangles[i], low, high);
        c->item[i] = (tile_item){{low[0] / 2 + high[0] / 2, low[1] / 2 + high[1] / 2}, 0, 0};
        c->item[i].triangle = triangles[i];
    }
}

/* List the triangles of each tile in ascending order. `tile_of` has room for all of the mesh. */
static void cuts_list(mw_tile_cuts *cuts, const tile_item *item, const uint32_t *triangles,
                      size_t count, uint32_t *tile_of)
{
    for (size_t i = 0; i < count; i++) {
        tile_of[item[i].triangle] = item[i].tile;
        cuts->begin[item[i].tile + 1]++;
    }
    for (uint32_t tile = 0; tile < cuts->tiles; tile++) cuts->begin[tile + 1] += cuts->begin[tile];
    for (size_t i = 0; i < count; i++)
        cuts->triangle[cuts->begin[tile_of[triangles[i]]]++] = triangles[i];
    memmove(cuts->begin + 1, cuts->begin, cuts->tiles * sizeof *cuts->begin);
    cuts->begin[0] = 0;
}

bool mw__tile_cuts_create(mw_tile_cuts *cuts, const mw_mesh *mesh, const uint32_t *triangles,
                          size_t count, uint32_t tiles)
{
    *cuts = (mw_tile_cuts){.cut = mw__calloc(tiles, sizeof *cuts->cut),
                           .triangle = mw__alloc(count, sizeof *cuts->triangle),
                           .begin = mw__calloc((size_t)tiles + 1, sizeof *cuts->begin)};
    cutting c = {.cuts = cuts, .mesh = mesh, .item = mw__alloc(count, sizeof *c.item), .random = 1};
    uint32_t *tile_of = mw__alloc(mw_mesh_triangle_count(mesh), sizeof *tile_of);
    const bool done = cuts->cut && cuts->triangle && cuts->begin && c.item && tile_of;
    if (done) {
        items_take(&c, triangles, count);
        cutting_divide(&c, c.item, count, tiles);
        cuts_list(cuts, c.item, triangles, count, tile_of);
    }
    free(c.item);
    free(tile_of);
    return done;
}

void mw__tile_cuts_release(mw_tile_cuts *cuts)
{
    free(cuts->cut);
    free(cuts->triangle);
    free(cuts->begin);
    *cuts = (mw_tile_cuts){0};
}
