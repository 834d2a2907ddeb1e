/* region.c - connected regions of cells that are not covered exactly once. O(cells + holes log holes). */
#include "domain/region.h"

#include <stdlib.h>

/* Give the cells of equal degree that can be reached from cell t the number of a new region. */
static void flood(mw_regions *r, const mw_cover *c, uint32_t t, uint32_t *stack)
{
    uint32_t top = 0, region = r->count++;
    r->of[t] = region;
    stack[top++] = t;
    while (top > 0) {
        t = stack[--top];
        for (uint32_t k = 0; k < 3; k++) {
            uint32_t link = c->cell[t].link[k], other = mw__link_triangle(link);
            if (link == MW_NONE || r->of[other] != MW_NONE || c->degree[other] != c->degree[t]) continue;
            r->of[other] = region;
            stack[top++] = other;
        }
    }
}

/* Take note of what lies along edge k of cell t. */
static void look_along(mw_region *region, const mw_cover *c, uint32_t t, uint32_t k)
{
    uint32_t half = mw__link(t, k);
    uint32_t edge = region->degree == 0 ? mw__cover_outer(c, half) : mw__cover_inner(c, half);
    if (c->cell[t].link[k] == MW_NONE && region->degree == 0) region->open = true;
    if (edge == MW_NONE || mw__outline_rank(c->outline, edge) >= region->rank) return;
    if (region->degree != 0 && mw__is_fold(c->outline, c->outline->half[edge])) return;
    region->lowest = edge;
    region->rank = mw__outline_rank(c->outline, edge);
}

static void describe(mw_regions *r, const mw_cover *c)
{
    for (uint32_t i = 0; i < r->count; i++)
        r->list[i] = (mw_region){.hole = MW_POCKET, .lowest = MW_NONE, .rank = UINT64_MAX};
    for (uint32_t t = 0; t < c->cell_count; t++) {
        if (r->of[t] == MW_NONE) continue;
        mw_region *region = &r->list[r->of[t]];
        region->degree = c->degree[t];
        for (uint32_t k = 0; k < 3; k++) look_along(region, c, t, k);
    }
}

static int compare_regions(const void *left, const void *right)
{
    const mw_region *a = *(mw_region *const *)left, *b = *(mw_region *const *)right;
    return a->rank < b->rank ? -1 : a->rank > b->rank;
}

static bool number_holes(mw_regions *r)
{
    mw_region **holes = mw__alloc(r->count, sizeof *holes);
    if (!holes) return false;
    for (uint32_t i = 0; i < r->count; i++)
        if (r->list[i].degree == 0 && !r->list[i].open) holes[r->hole_count++] = &r->list[i];
    qsort(holes, r->hole_count, sizeof(mw_region *), compare_regions);
    for (uint32_t i = 0; i < r->hole_count; i++) holes[i]->hole = i;
    free(holes);
    return true;
}

bool mw__regions_create(mw_regions *regions, const mw_cover *cover)
{
    *regions = (mw_regions){0};
    uint32_t *stack = mw__alloc(cover->cell_count, sizeof *stack);
    regions->of = mw__alloc(cover->cell_count, sizeof *regions->of);
    if (!stack || !regions->of) {
        free(stack);
        return false;
    }
    for (uint32_t t = 0; t < cover->cell_count; t++) regions->of[t] = MW_NONE;
    for (uint32_t t = 0; t < cover->cell_count; t++)
        if (regions->of[t] == MW_NONE && cover->degree[t] != 1) flood(regions, cover, t, stack);
    free(stack);
    regions->list = mw__alloc(regions->count, sizeof *regions->list);
    if (!regions->list) return false;
    describe(regions, cover);
    return number_holes(regions);
}

void mw__regions_release(mw_regions *regions)
{
    free(regions->of);
    free(regions->list);
    *regions = (mw_regions){0};
}
