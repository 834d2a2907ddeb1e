/* mend_drop.c - drops the triangles that are unusable, have no area, or stand in the mesh twice. */
#include "mend/mend_geometry.h"

#include <stdlib.h>

/* Why a triangle has to go, and the vertex that tells; MW_MEND_CHANGE_COUNT: it stays. */
static mw_mend_change_kind drop_reason(const mw_mend_work *w, const uint32_t v[3], uint32_t *vertex)
{
    *vertex = MW_NONE;
    for (int k = 0; k < 3; k++)
        if (v[k] >= w->vertex_count) return *vertex = v[k], MW_MEND_DROPPED_MISSING;
    for (int k = 0; k < 3; k++)
        if (!mw__mend_finite(w, v[k])) return *vertex = v[k], MW_MEND_DROPPED_INFINITE;
    for (int k = 0; k < 3; k++)
        if (v[k] == v[(k + 1) % 3]) return *vertex = v[k], MW_MEND_DROPPED_REPEATED;
    /* A flat triangle may fill a gap between a long edge and a vertex in it; without it the edge
     * must be split. */
    if (w->repairs & MW_REPAIR_SPLIT && mw__mend_flat(w, v)) return MW_MEND_DROPPED_FLAT;
    return MW_MEND_CHANGE_COUNT;
}

static bool drop_unusable(mw_mend_work *w)
{
    size_t left = 0;
    for (size_t t = 0; t < w->count; t++) {
        uint32_t vertex, from = w->triangle[t].from;
        mw_mend_change_kind kind = drop_reason(w, w->triangle[t].v, &vertex);
        if (kind == MW_MEND_CHANGE_COUNT)
            w->triangle[left++] = w->triangle[t];
        else if (!mw__mend_note(w, kind, from, vertex, MW_NONE))
            return false;
        if (!mw__job_step(w->job, t, 2 * w->count)) return false;
    }
    w->count = left;
    return true;
}

/* --- duplicates --- */

typedef struct drop_key {
    uint32_t v[3], triangle;
} drop_key;

static int compare_drop_vertices(const drop_key *a, const drop_key *b)
{
    for (int k = 0; k < 3; k++)
        if (a->v[k] != b->v[k]) return a->v[k] < b->v[k] ? -1 : 1;
    return 0;
}

static int compare_drop_keys(const void *left, const void *right)
{
    const drop_key *a = left, *b = right;
    int order = compare_drop_vertices(a, b);
    return order ? order : (a->triangle > b->triangle) - (a->triangle < b->triangle);
}

static drop_key drop_key_of(const mw_mend_triangle *t, uint32_t number)
{
    drop_key key = {{t->v[0], t->v[1], t->v[2]}, number};
    if (key.v[0] > key.v[1]) mw__swap(&key.v[0], &key.v[1]);
    if (key.v[1] > key.v[2]) mw__swap(&key.v[1], &key.v[2]);
    if (key.v[0] > key.v[1]) mw__swap(&key.v[0], &key.v[1]);
    return key;
}

/* same_as[t]: the lowest triangle with the vertices of t, perhaps t itself. */
static bool duplicates_find(const mw_mend_work *w, uint32_t *same_as)
{
    drop_key *key = mw__alloc(w->count, sizeof *key);
    if (!key) return false;
    for (size_t t = 0; t < w->count; t++) key[t] = drop_key_of(&w->triangle[t], (uint32_t)t);
    qsort(key, w->count, sizeof *key, compare_drop_keys);
    size_t first = 0;
    for (size_t i = 0; i < w->count; i++) {
        if (compare_drop_vertices(&key[first], &key[i])) first = i;
        same_as[key[i].triangle] = key[first].triangle;
    }
    free(key);
    return true;
}

static bool drop_duplicates(mw_mend_work *w)
{
    uint32_t *same_as = mw__alloc(w->count, sizeof *same_as);
    bool done = same_as && duplicates_find(w, same_as);
    size_t left = 0;
    for (size_t t = 0; t < w->count && done; t++) {
        mw_mend_triangle triangle = w->triangle[t];
        bool first = same_as[t] == t;
        /* The first of some comes before the others, which then read its number here. */
        if (first) same_as[t] = triangle.from;
        if (first)
            w->triangle[left++] = triangle;
        else
            done = mw__mend_note(w, MW_MEND_DROPPED_DUPLICATE, triangle.from, MW_NONE,
                                 same_as[same_as[t]]);
    }
    if (done) w->count = left;
    free(same_as);
    return done;
}

bool mw__mend_drop(mw_mend_work *w, bool *changed)
{
    size_t before = w->count;
    if (!drop_unusable(w) || !drop_duplicates(w)) return false;
    *changed = w->count < before;
    return mw__job_step(w->job, 1, 1);
}
