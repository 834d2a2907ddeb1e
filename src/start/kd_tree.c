/* kd_tree.c - the nearest vertex, by a k-d tree [Bentley 1975; Friedman, Bentley, Finkel 1977].
 *
 * The walk begins at the vertex nearest to q, in any tile that has it, which layers and buckets
 * only approximate. Of all starts that lead to a vertex it visits the fewest triangles. The tree is
 * the array of vertices itself: the middle vertex of a range has the vertices on one side of it
 * before it in the range, those on the other side after it, by x and by y in turn. Ranges of at
 * most LEAF vertices are searched one by one. 24 bytes a vertex. A search goes down on the side of
 * q, and also on the other side if a nearer vertex may be there: O(log n) expected if q is near the
 * vertices. If all vertices are about equally far from q, as on a circle round it, all are looked
 * at. */
#include "start/kd_tree.h"

#include "base/random.h"
#include "start/start.h"

#include <stdlib.h>

enum { LEAF = 6 };

static MW_INLINE double kd_coordinate(mw_point p, int axis)
{
    return axis == 0 ? p.x : p.y;
}

static MW_INLINE void kd_swap(mw_kd_vertex *a, mw_kd_vertex *b)
{
    mw_kd_vertex c = *a;
    *a = *b;
    *b = c;
}

/* Bring the vertex that would be number `middle` of v[0 .. n) in the order of the axis there, with
 * none greater before it and none less behind it [Hoare 1961]. */
static void kd_select(mw_kd_vertex *v, uint32_t n, uint32_t middle, int axis, uint64_t *random)
{
    uint32_t low = 0, high = n - 1;
    while (low < high) {
        double pivot = kd_coordinate(v[low + mw__random_below(random, high - low + 1)].at, axis);
        uint32_t i = low, j = high;
        while (i <= j) {
            while (kd_coordinate(v[i].at, axis) < pivot) i++;
            while (kd_coordinate(v[j].at, axis) > pivot) j--;
            if (i > j) break;
            kd_swap(&v[i++], &v[j]);
            if (j == 0) break;
            j--;
        }
        if (middle <= j)
            high = j;
        else if (middle >= i)
            low = i;
        else
            return;
    }
}

typedef struct kd_building {
    uint64_t random;
    mw_job *job;
    uint32_t done, count; /* vertices in their places, and all */
} kd_building;

static bool kd_build(kd_building *b, mw_kd_vertex *v, uint32_t n, int axis)
{
    while (n > LEAF) {
        uint32_t middle = n / 2;
        kd_select(v, n, middle, axis, &b->random);
        axis = 1 - axis;
        if (!kd_build(b, v, middle, axis)) return false; /* half of it: no deeper than 32 */
        v += middle + 1;
        n -= middle + 1;
        b->done++;
    }
    b->done += n;
    return mw__job_step(b->job, b->done, b->count);
}

bool mw__kd_tree_create(mw_kd_tree *tree, const mw_tiling *tiling, mw_job *job)
{
    uint32_t *at = mw__tile_of_vertices(tiling), used = 0;
    *tree = (mw_kd_tree){0};
    for (uint32_t v = 0; at && v < tiling->point_count; v++) used += at[v] != MW_NONE;
    if (at) tree->vertex = mw__alloc_lines((size_t)used + 1, sizeof *tree->vertex);
    for (uint32_t v = 0; tree->vertex && v < tiling->point_count; v++)
        if (at[v] != MW_NONE) tree->vertex[tree->count++] = (mw_kd_vertex){tiling->point[v], at[v]};
    free(at);
    kd_building building = {.random = 1, .job = job, .count = tree->count};
    mw__job_stage(job, "building a tree of vertices", 1);
    return tree->vertex && (tree->count == 0 || kd_build(&building, tree->vertex, tree->count, 0));
}

void mw__kd_tree_release(mw_kd_tree *tree)
{
    free(tree->vertex);
}

size_t mw__kd_tree_bytes(const mw_kd_tree *tree)
{
    return ((size_t)tree->count + 1) * sizeof *tree->vertex;
}

/* --- the search --- */

typedef struct mw_kd_search {
    mw_point q;
    const mw_kd_vertex *best;
    double best2;
} mw_kd_search;

static MW_INLINE void kd_offer(mw_kd_search *s, const mw_kd_vertex *v)
{
    double distance2 = mw__distance2(v->at, s->q);
    if (!(distance2 < s->best2)) return;
    s->best2 = distance2;
    s->best = v;
}

static void kd_search(mw_kd_search *s, const mw_kd_vertex *v, uint32_t n, int axis)
{
    while (n > LEAF) {
        uint32_t middle = n / 2;
        double off = kd_coordinate(s->q, axis) - kd_coordinate(v[middle].at, axis);
        const mw_kd_vertex *behind = v + middle + 1;
        uint32_t left = n - middle - 1;
        axis = 1 - axis;
        if (off < 0)
            kd_search(s, v, middle, axis);
        else
            kd_search(s, behind, left, axis);
        if (!(off * off < s->best2)) return;
        kd_offer(s, &v[middle]);
        v = off < 0 ? behind : v;
        n = off < 0 ? left : middle;
    }
    for (uint32_t i = 0; i < n; i++) kd_offer(s, &v[i]);
}

uint32_t mw__kd_tree_first(const mw_kd_tree *tree, mw_point q)
{
    mw_kd_search s = {q, tree->vertex, INFINITY}; /* the first where all are too far for doubles */
    kd_search(&s, tree->vertex, tree->count, 0);
    return tree->count ? s.best->tile : 0;
}
