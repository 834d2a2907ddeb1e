/* damage.c - finds what makes arrays unusable. An edge of more than two triangles shows as an edge without neighbour
 * that has the ends of a linked one: those without are sorted, the linked ones looked up. */
#include "mesh/damage.h"
#include "mesh/arrays.h"
#include "mesh/match.h"

#include <stdlib.h>

/* --- numbers out of range --- */

static bool repair_triangle(mw_repair *repair, const mw_arrays *arrays, uint32_t t, mw_defects *defects)
{
    for (uint32_t k = 0; k < 3; k++) {
        uint32_t v = mw__index_at(arrays, 3 * (size_t)t + k);
        repair->triangles[3 * (size_t)t + k] = v;
        if (v < arrays->point_count) continue;
        mw_defect defect = mw__defect(MW_DEFECT_MISSING_VERTEX, t);
        defect.vertex = v;
        repair->replaced[t] = 1;
        if (!mw__defects_add(defects, defect)) return false;
    }
    for (uint32_t k = 0; k < 3 && repair->replaced[t]; k++) repair->triangles[3 * (size_t)t + k] = 0;
    return true;
}

mw_status mw__repair(mw_repair *repair, const mw_arrays *arrays, mw_defects *defects, mw_error *error)
{
    *repair = (mw_repair){.arrays = *arrays,
                          .triangles = mw__alloc(3 * arrays->triangle_count, sizeof(uint32_t)),
                          .replaced = mw__calloc(arrays->triangle_count, sizeof(uint8_t))};
    if (!repair->triangles || !repair->replaced) return mw__fail_memory(error);
    repair->arrays.triangles = repair->triangles;
    repair->arrays.integer_type = MW_UINT32;
    for (uint32_t t = 0; t < arrays->triangle_count; t++)
        if (!repair_triangle(repair, arrays, t, defects)) return mw__fail_memory(error);
    return MW_OK;
}

void mw__repair_release(mw_repair *repair)
{
    free(repair->triangles);
    free(repair->replaced);
    *repair = (mw_repair){0};
}

/* --- triangles --- */

bool mw__find_unusable(const uint32_t v[3], const bool finite[3], uint32_t t, mw_defects *defects, bool *usable)
{
    *usable = true;
    for (uint32_t k = 0; k < 3; k++) {
        int before = (k > 0 && v[0] == v[k]) + (k > 1 && v[1] == v[k]); /* a vertex three times is one defect */
        mw_defect defect = mw__defect(before > 0 ? MW_DEFECT_REPEATED_VERTEX : MW_DEFECT_NOT_FINITE, t);
        defect.vertex = v[k];
        if (before > 0 || !finite[k]) *usable = false;
        if ((before == 1 || (before == 0 && !finite[k])) && !mw__defects_add(defects, defect)) return false;
    }
    return true;
}

/* --- edges --- */

typedef struct side {
    uint32_t low, high, half;
} side;

static side side_of(const mw_triangle *tri, uint32_t half)
{
    const mw_triangle *t = &tri[mw__link_triangle(half)];
    uint32_t a = t->v[mw__link_edge(half)], b = t->v[mw__link_edge(half) + 1];
    return (side){a < b ? a : b, a < b ? b : a, half};
}

static int compare_sides(const void *left, const void *right)
{
    const side *a = left, *b = right;
    if (a->low != b->low) return a->low < b->low ? -1 : 1;
    if (a->high != b->high) return a->high < b->high ? -1 : 1;
    return 0;
}

/* All edges without neighbour, sorted: *sides and *count. */
static bool gather_unlinked(const mw_triangle *tri, uint32_t n, side **sides, size_t *count)
{
    *sides = NULL;
    for (int pass = 0; pass < 2; pass++) {
        *count = 0;
        for (uint32_t t = 0; t < n; t++)
            for (uint32_t k = 0; k < 3 && mw__has_three_vertices(&tri[t]); k++) {
                if (tri[t].link[k] != MW_NONE) continue;
                if (pass == 1) (*sides)[*count] = side_of(tri, mw__link(t, k));
                (*count)++;
            }
        if (pass == 0 && !(*sides = mw__alloc(*count, sizeof **sides))) return false;
    }
    qsort(*sides, *count, sizeof **sides, compare_sides);
    return true;
}

static mw_defect shared(const mw_triangle *tri, uint32_t half, uint32_t other)
{
    mw_defect defect = mw__defect(MW_DEFECT_NON_MANIFOLD_EDGE, mw__link_triangle(half));
    defect.edge = (uint8_t)mw__user_edge(tri[defect.triangle].user, mw__link_edge(half));
    defect.other = other;
    return defect;
}

/* Of such an edge the first two triangles are linked: the others are without neighbour there. */
bool mw__find_shared(const mw_triangle *tri, uint32_t n, mw_defects *defects)
{
    side *sides;
    size_t count;
    if (!gather_unlinked(tri, n, &sides, &count)) return false;
    bool done = true;
    for (uint32_t t = 0; t < n; t++)
        for (uint32_t k = 0; k < 3 && done; k++) {
            if (tri[t].link[k] == MW_NONE || mw__link_triangle(tri[t].link[k]) < t) continue;
            side key = side_of(tri, mw__link(t, k));
            const side *found = bsearch(&key, sides, count, sizeof key, compare_sides);
            if (!found) continue;
            while (found > sides && compare_sides(found - 1, &key) == 0) found--;
            for (; found < sides + count && compare_sides(found, &key) == 0 && done; found++)
                done = mw__defects_add(defects, shared(tri, found->half, t));
        }
    free(sides);
    return done;
}
