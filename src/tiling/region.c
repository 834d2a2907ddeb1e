/* region.c - finds connected regions of cells that are not covered exactly once. O(cells + holes
 * log holes). */
#include "tiling/region.h"

#include <stdlib.h>

/* Give a new region to all cells of equal degree that can be reached from cell t. */
static void region_flood(mw_regions *r, const mw_coverage *c, uint32_t t, uint32_t *stack)
{
    uint32_t top = 0, region = r->count++;
    r->of[t] = region;
    stack[top++] = t;
    while (top > 0) {
        t = stack[--top];
        for (uint32_t k = 0; k < 3; k++) {
            uint32_t link = c->cell[t].link[k], other = mw__link_triangle(link);
            if (link == MW_NONE || r->of[other] != MW_NONE || c->degree[other] != c->degree[t])
                continue;
            r->of[other] = region;
            stack[top++] = other;
        }
    }
}

/* Note the border of a region along edge k of cell t. */
static void region_look_along(mw_region *region, const mw_coverage *c, uint32_t t, uint32_t k)
{
    uint32_t half = mw__link(t, k);
    uint32_t edge =
        region->degree == 0 ? mw__coverage_outer_edge(c, half) : mw__coverage_inner_edge(c, half);
    if (c->cell[t].link[k] == MW_NONE && region->degree == 0) region->unbounded = true;
    if (edge == MW_NONE || mw__outline_rank(c->outline, edge) >= region->rank) return;
    if (region->degree != 0 && mw__is_fold(c->outline, c->outline->half[edge])) return;
    region->lowest = edge;
    region->rank = mw__outline_rank(c->outline, edge);
}

static void regions_describe(mw_regions *r, const mw_coverage *c)
{
    for (uint32_t i = 0; i < r->count; i++)
        r->list[i] = (mw_region){.hole = MW_POCKET, .lowest = MW_NONE, .rank = UINT64_MAX};
    for (uint32_t t = 0; t < c->cell_count; t++) {
        if (r->of[t] == MW_NONE) continue;
        mw_region *region = &r->list[r->of[t]];
        region->degree = c->degree[t];
        for (uint32_t k = 0; k < 3; k++) region_look_along(region, c, t, k);
    }
}

static int compare_regions(const void *left, const void *right)
{
    const mw_region *a = *(mw_region *const *)left, *b = *(mw_region *const *)right;
    return a->rank < b->rank ? -1 : a->rank > b->rank;
}

static bool holes_number(mw_regions *r)
{
    mw_region **holes = mw__alloc(r->count, sizeof *holes);
    if (!holes) return false;
    for (uint32_t i = 0; i < r->count; i++)
        if (r->list[i].degree == 0 && !r->list[i].unbounded) holes[r->hole_count++] = &r->list[i];
    qsort(holes, r->hole_count, sizeof(mw_region *), compare_regions);
    for (uint32_t i = 0; i < r->hole_count; i++) holes[i]->hole = i;
    free(holes);
    return true;
}

bool mw__regions_create(mw_regions *regions, const mw_coverage *coverage)
{
    *regions = (mw_regions){0};
    uint32_t *stack = mw__alloc(coverage->cell_count, sizeof *stack);
    regions->of = mw__alloc(coverage->cell_count, sizeof *regions->of);
    if (!stack || !regions->of) {
        free(stack);
        return false;
    }
    for (uint32_t t = 0; t < coverage->cell_count; t++) regions->of[t] = MW_NONE;
    for (uint32_t t = 0; t < coverage->cell_count; t++)
        if (regions->of[t] == MW_NONE && coverage->degree[t] != 1)
            region_flood(regions, coverage, t, stack);
    free(stack);
    regions->list = mw__alloc(regions->count, sizeof *regions->list);
    if (!regions->list) return false;
    regions_describe(regions, coverage);
    return holes_number(regions);
}

void mw__regions_release(mw_regions *regions)
{
    free(regions->of);
    free(regions->list);
    *regions = (mw_regions){0};
}
