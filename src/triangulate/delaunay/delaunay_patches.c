/* delaunay_patches.c - divide, grow, merge.
 *
 * A cell of a Hilbert curve is an interval of the curve, and so are its halves and quarters. Two
 * neighbouring intervals are separated by a line parallel to an axis; the first bit in which their
 * keys differ tells which one. So the sorted points can be cut into patches without moving them.
 * Each patch grows in a range of facets of its own: all can grow at the same time, and one alone
 * stays in the cache. A merge takes time in proportion to its seam and the two hulls.
 *
 * Where the points are cut depends on the points alone, and so does the result. */
#include "triangulate/delaunay/delaunay_patches.h"

#include "mesh/mesh.h"
#include "triangulate/delaunay/delaunay_merge.h"

/* --- divide --- */

static bool patches_add_halves(mw_patches *patches, uint32_t whole, uint32_t middle)
{
    if (patches->count + 2 > patches->room) {
        uint32_t room = 2 * patches->room + 2;
        mw_patch *patch = mw__realloc(patches->patch, room, sizeof *patch);
        if (!patch) return false;
        patches->patch = patch;
        patches->room = room;
    }
    mw_patch *patch = &patches->patch[patches->count];
    patches->patch[whole].half = patches->count;
    patch[0] = (mw_patch){
        .from = patches->patch[whole].from, .to = middle, .half = MW_NONE, .ghost = MW_NONE};
    patch[1] = (mw_patch){
        .from = middle, .to = patches->patch[whole].to, .half = MW_NONE, .ghost = MW_NONE};
    patches->count += 2;
    return true;
}

/* All keys of the patch are equal: let them be those of a curve through its own extent, along which
 * it is sorted. */
static bool patch_refine(const mw_patch *patch, const mw_point *points, mw_key *keys)
{
    uint32_t n = patch->to - patch->from;
    if (n <= MW_LONG_RUN) return false;
    mw__points_set_keys(points, keys + patch->from, n);
    return keys[patch->from].key != keys[patch->to - 1].key;
}

/* The first of the patch's slots whose key has the highest bit in which its keys differ. */
static uint32_t patch_find_middle(const mw_patch *patch, const mw_key *keys)
{
    uint32_t first = keys[patch->from].key, last = keys[patch->to - 1].key;
    uint32_t bit = UINT32_C(1) << (31 - __builtin_clz(first ^ last)), low = patch->from,
             high = patch->to - 1;
    while (high - low > 1) {
        uint32_t middle = low + (high - low) / 2;
        if (keys[middle].key & bit)
            high = middle;
        else
            low = middle;
    }
    return high;
}

bool mw__patches_cut(mw_patches *patches, const mw_point *points, mw_key *keys, uint32_t n,
                     uint32_t most)
{
    *patches = (mw_patches){.patch = mw__alloc(1, sizeof *patches->patch), .count = 1, .room = 1};
    if (!patches->patch) return false;
    patches->patch[0] = (mw_patch){.to = n, .half = MW_NONE, .ghost = MW_NONE};
    for (uint32_t i = 0; i < patches->count; i++) {
        const mw_patch *patch = &patches->patch[i];
        if (patch->to - patch->from <= most) continue;
        if (keys[patch->from].key == keys[patch->to - 1].key && !patch_refine(patch, points, keys))
            continue;
        if (!patches_add_halves(patches, i, patch_find_middle(patch, keys))) return false;
    }
    for (uint32_t i = patches->count; i-- > 0;) {
        mw_patch *patch = &patches->patch[i];
        if (patch->half == MW_NONE) continue;
        uint32_t first = patches->patch[patch->half].rank,
                 second = patches->patch[patch->half + 1].rank;
        patch->rank = 1 + (first > second ? first : second);
    }
    return true;
}

/* --- grow --- */

/* Bring three slots that do not lie on one line to the front of the sequence. */
static bool patch_choose_first_three(const mw_point *p, uint32_t *s, uint32_t n)
{
    uint32_t second = 1;
    while (second < n && mw__points_equal(p[s[0]], p[s[second]])) second++;
    if (second >= n) return false;
    mw__swap(&s[1], &s[second]);
    uint32_t third = second + 1;
    while (third < n && mw__orient2d(p[s[0]], p[s[1]], p[s[third]]) == 0) third++;
    if (third >= n) return false;
    mw__swap(&s[2], &s[third]);
    return true;
}

/* A point equal to another is no vertex. In its slot the coordinates give way to the slot of its
 * twin. */
static void point_set_twin(mw_point *point, uint32_t twin)
{
    *point = (mw_point){NAN, twin};
}

static uint32_t patch_insert(const mw_patch_arrays *arrays, mw_growth *g, const uint32_t *sequence,
                             uint32_t n)
{
    uint32_t duplicates = 0;
    for (uint32_t i = 0; i < n; i++) {
        uint32_t slot = sequence[i], vertex = mw__grow(g, slot);
        if (MW_LIKELY(vertex == slot)) continue;
        if (arrays->order[slot] < arrays->order[vertex])
            mw__swap(&arrays->order[slot], &arrays->order[vertex]);
        point_set_twin(&arrays->point[slot], vertex);
        duplicates++;
    }
    return duplicates;
}

static mw_growth patch_growth(const mw_patch_arrays *arrays, uint32_t last, uint32_t facets)
{
    mw_growth g = {
        .point = arrays->point, .facet = arrays->facet, .facet_count = facets, .last = last};
    mw__grow_prepare(&g, arrays->n, arrays->width, arrays->height, arrays->unit);
    return g;
}

/* Make ghosts of nothing but infinity of the facets from the last that is used to those of slot
 * `to`. */
static void growth_clear_unused(const mw_growth *g, uint32_t to)
{
    uint32_t i = g->infinity;
    for (uint32_t f = g->facet_count; f < 2 * to; f++)
        g->facet[f] = (mw_facet){{i, i, i}, {MW_NONE, MW_NONE, MW_NONE}};
}

static uint32_t growth_find_ghost(const mw_growth *g, uint32_t from)
{
    uint32_t f = 2 * from;
    while (!mw__is_ghost(g, &g->facet[f]) || g->facet[f].v[0] == g->facet[f].v[1]) f++;
    return f;
}

static void patch_grow(const mw_patch_arrays *arrays, mw_patch *patch)
{
    uint32_t n = patch->to - patch->from, *sequence = arrays->sequence + patch->from;
    mw__insertion_sequence(patch->from, n, sequence);
    mw_growth g = patch_growth(arrays, 0, 2 * patch->from);
    if (patch_choose_first_three(g.point, sequence, n)) {
        mw__grow_begin(&g, sequence);
        patch->duplicates = patch_insert(arrays, &g, sequence + 3, n - 3);
        patch->ghost = growth_find_ghost(&g, patch->from);
        patch->visited = g.visited;
        patch->spare = 2 * patch->to - 2;
    }
    growth_clear_unused(&g, patch->to);
}

/* --- merge --- */

/* Of two halves one has grown, the slots of the other lie on a line: insert them. */
static void patch_take_in(const mw_patch_arrays *arrays, mw_patch *patch, const mw_patch *grown,
                          const mw_patch *flat)
{
    uint32_t n = flat->to - flat->from, *sequence = arrays->sequence + flat->from;
    mw__insertion_sequence(flat->from, n, sequence);
    mw_growth g = patch_growth(arrays, grown->ghost, 2 * flat->from);
    patch->duplicates = grown->duplicates + patch_insert(arrays, &g, sequence, n);
    growth_clear_unused(&g, flat->to);
    patch->ghost = growth_find_ghost(&g, patch->from);
    patch->visited = grown->visited + g.visited;
    patch->spare = grown->spare;
}

static void patch_merge(const mw_patch_arrays *arrays, mw_patch *patch, const mw_patch *half)
{
    if (half[0].ghost == MW_NONE && half[1].ghost == MW_NONE) {
        patch_grow(arrays, patch);
    } else if (half[0].ghost == MW_NONE) {
        patch_take_in(arrays, patch, &half[1], &half[0]);
    } else if (half[1].ghost == MW_NONE) {
        patch_take_in(arrays, patch, &half[0], &half[1]);
    } else {
        mw_growth g = patch_growth(arrays, 0, 0);
        patch->ghost = mw__merge(&g, half[0].ghost, half[1].ghost, half[0].spare);
        patch->spare = half[1].spare;
        patch->visited = half[0].visited + half[1].visited;
        patch->duplicates = half[0].duplicates + half[1].duplicates;
    }
}

typedef struct rank_growth {
    mw_patches *patches;
    const mw_patch_arrays *arrays;
    uint32_t rank;
} rank_growth;

static void rank_grow_patch(void *work, uint64_t i, uint32_t member)
{
    const rank_growth *g = work;
    mw_patch *patch = &g->patches->patch[i];
    (void)member;
    if (patch->rank != g->rank) return;
    if (patch->half == MW_NONE)
        patch_grow(g->arrays, patch);
    else
        patch_merge(g->arrays, patch, &g->patches->patch[patch->half]);
}

/* Patches of one rank do not depend on each other. Returns false if the job is to stop. */
static bool rank_grow(mw_patches *patches, const mw_patch_arrays *arrays, uint32_t rank,
                      mw_job *job)
{
    rank_growth growth = {patches, arrays, rank};
    uint32_t count = 0;
    for (uint32_t i = 0; i < patches->count; i++) count += patches->patch[i].rank == rank;
    return mw__job_chunks(job, mw__job_team(job, count), patches->count, rank_grow_patch, &growth);
}

bool mw__patches_grow(mw_patches *patches, const mw_patch_arrays *arrays, mw_job *job)
{
    const uint32_t ranks = patches->patch[0].rank;
    mw__job_stage(job, "triangulating", ranks ? 0.9 : 1);
    if (!rank_grow(patches, arrays, 0, job)) return false;
    for (uint32_t rank = 1; rank <= ranks; rank++) {
        mw__job_stage(job, "merging triangulations", 0.1 / ranks);
        if (!rank_grow(patches, arrays, rank, job)) return false;
    }
    return true;
}
