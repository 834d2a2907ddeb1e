/* array_defects.c - finds the defects that make arrays unusable. Of an edge with more than two
 * triangles only the first two are linked; the others have no neighbour there. So the edges without
 * a neighbour are sorted, and every linked edge is looked up among them. */
#include "mesh/array_defects.h"
#include "mesh/arrays.h"
#include "mesh/match.h"

#include <stdlib.h>

/* --- numbers out of range --- */

static bool repair_triangle(mw_repair *repair, const mw_arrays *arrays, uint32_t t,
                            mw_defects *defects)
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
    for (uint32_t k = 0; k < 3 && repair->replaced[t]; k++)
        repair->triangles[3 * (size_t)t + k] = 0;
    return true;
}

mw_status mw__repair_create(mw_repair *repair, const mw_arrays *arrays, mw_defects *defects,
                            mw_error *error)
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

bool mw__find_unusable(const uint32_t v[3], const bool finite[3], uint32_t t, mw_defects *defects,
                       bool *usable)
{
    *usable = true;
    for (uint32_t k = 0; k < 3; k++) {
        /* A vertex three times is one defect. */
        int before = (k > 0 && v[0] == v[k]) + (k > 1 && v[1] == v[k]);
        mw_defect defect =
            mw__defect(before > 0 ? MW_DEFECT_REPEATED_VERTEX : MW_DEFECT_NOT_FINITE, t);
        defect.vertex = v[k];
        if (before > 0 || !finite[k]) *usable = false;
        if ((before == 1 || (before == 0 && !finite[k])) && !mw__defects_add(defects, defect))
            return false;
    }
    return true;
}

/* --- edges --- */

typedef struct edge_ends {
    uint32_t low, high, half;
} edge_ends;

static edge_ends edge_ends_of(const mw_triangle *tri, uint32_t half)
{
    const mw_triangle *t = &tri[mw__link_triangle(half)];
    uint32_t a = t->v[mw__link_edge(half)], b = t->v[mw__link_edge(half) + 1];
    return (edge_ends){a < b ? a : b, a < b ? b : a, half};
}

static int compare_edge_ends(const void *left, const void *right)
{
    const edge_ends *a = left, *b = right;
    if (a->low != b->low) return a->low < b->low ? -1 : 1;
    if (a->high != b->high) return a->high < b->high ? -1 : 1;
    return 0;
}

/* All edges without a neighbour, sorted. */
static bool unlinked_edges_gather(const mw_triangle *tri, uint32_t n, edge_ends **unlinked,
                                  size_t *count)
{
    *unlinked = NULL;
    for (int pass = 0; pass < 2; pass++) {
        *count = 0;
        for (uint32_t t = 0; t < n; t++)
            for (uint32_t k = 0; k < 3 && mw__has_three_vertices(&tri[t]); k++) {
                if (tri[t].link[k] != MW_NONE) continue;
                if (pass == 1) (*unlinked)[*count] = edge_ends_of(tri, mw__link(t, k));
                (*count)++;
            }
        if (pass == 0 && !(*unlinked = mw__alloc(*count, sizeof **unlinked))) return false;
    }
    qsort(*unlinked, *count, sizeof **unlinked, compare_edge_ends);
    return true;
}

static mw_defect non_manifold_defect(const mw_triangle *tri, uint32_t half, uint32_t other)
{
    mw_defect defect = mw__defect(MW_DEFECT_NON_MANIFOLD_EDGE, mw__link_triangle(half));
    defect.edge = (uint8_t)mw__user_local_edge(tri[defect.triangle].user, mw__link_edge(half));
    defect.other = other;
    return defect;
}

/* The first two triangles of a non-manifold edge are linked. Its other triangles have no neighbour
 * there. */
bool mw__find_non_manifold_edges(const mw_triangle *tri, uint32_t n, mw_defects *defects)
{
    edge_ends *unlinked;
    size_t count;
    if (!unlinked_edges_gather(tri, n, &unlinked, &count)) return false;
    bool done = true;
    for (uint32_t t = 0; t < n; t++)
        for (uint32_t k = 0; k < 3 && done; k++) {
            if (tri[t].link[k] == MW_NONE || mw__link_triangle(tri[t].link[k]) < t) continue;
            edge_ends key = edge_ends_of(tri, mw__link(t, k));
            const edge_ends *found = bsearch(&key, unlinked, count, sizeof key, compare_edge_ends);
            if (!found) continue;
            while (found > unlinked && compare_edge_ends(found - 1, &key) == 0) found--;
            for (; found < unlinked + count && compare_edge_ends(found, &key) == 0 && done; found++)
                done = mw__defects_add(defects, non_manifold_defect(tri, found->half, t));
        }
    free(unlinked);
    return done;
}
