#include "prepared/tiles/tile_holes.h"

#include <stdlib.h>

typedef struct hole_key {
    uint32_t triangle, edge, hole;
} hole_key;

static int compare_hole_keys(const void *left, const void *right)
{
    const hole_key *a = left, *b = right;
    if (a->triangle != b->triangle) return a->triangle < b->triangle ? -1 : 1;
    return a->edge < b->edge ? -1 : a->edge > b->edge;
}

/* The edges of the holes of a locator; NULL on failure. */
static mw_hole_edge *hole_edges(const mw_locator *locator, size_t *count, mw_error *error)
{
    mw_locator_info info;
    mw_locator_describe(locator, &info);
    mw_hole_edge *edges = mw__alloc(info.holes, sizeof *edges);
    *count = info.holes;
    if (!edges)
        mw__fail_memory(error);
    else if (mw_locator_holes(locator, edges, error) == MW_OK)
        return edges;
    free(edges);
    return NULL;
}

static int64_t hole_find(const hole_key *keys, size_t count, hole_key wanted)
{
    const hole_key *found = bsearch(&wanted, keys, count, sizeof *keys, compare_hole_keys);
    return found ? (int64_t)found->hole : -1;
}

mw_status mw__tile_holes_match(mw_tile_holes *holes, const mw_locator *whole,
                               const mw_locator *part, const uint32_t *triangles, mw_error *error)
{
    mw_error own_error;
    size_t count = 0, part_count = 0;
    *holes = (mw_tile_holes){0};
    if (!error) error = &own_error;
    error->status = MW_OK;
    mw_hole_edge *of_whole = hole_edges(whole, &count, error);
    mw_hole_edge *of_part = of_whole ? hole_edges(part, &part_count, error) : NULL;
    hole_key *keys = of_part ? mw__alloc(count, sizeof *keys) : NULL;
    holes->number = keys ? mw__alloc(part_count, sizeof *holes->number) : NULL;
    if (of_part && !holes->number) mw__fail_memory(error);
    if (holes->number) {
        holes->count = part_count;
        for (size_t i = 0; i < count; i++)
            keys[i] = (hole_key){of_whole[i].triangle, of_whole[i].edge, (uint32_t)i};
        qsort(keys, count, sizeof *keys, compare_hole_keys);
        for (size_t i = 0; i < part_count; i++)
            holes->number[i] = hole_find(
                keys, count, (hole_key){triangles[of_part[i].triangle], of_part[i].edge, 0});
    }
    free(of_whole);
    free(of_part);
    free(keys);
    return holes->number ? MW_OK : error->status;
}

void mw__tile_holes_release(mw_tile_holes *holes)
{
    free(holes->number);
    *holes = (mw_tile_holes){0};
}
