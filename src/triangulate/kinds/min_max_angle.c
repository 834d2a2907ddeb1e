/* min_max_angle.c - the triangulation with the smallest largest angle [Edelsbrunner, Tan,
 * Waupotitsch 1992].
 *
 * The triangle with the largest angle is replaced by edge insertion (edge_insertion.c) until that
 * fails: then no triangulation has a smaller largest angle. The triangle is now fixed, and the same
 * is done with the others, by falling angles. Each success takes an angle from the list of the
 * triangles' largest angles and adds only smaller ones, so this ends. If no two angles between
 * points are equal, every triangulation with the fixed angles and otherwise smaller ones has the
 * fixed triangles. Then the sorted list of angles is the least of all triangulations, in
 * lexicographic order.
 *
 * At the end all triangles are released, and single edges are flipped as long as that lowers the
 * largest angle of the two triangles. This improves the result only where angles are equal, or
 * where the work was limited. */
#include "triangulate/kinds/min_max_angle.h"

#include "triangulate/kinds/edge_insertion.h"

#include <stdlib.h>

/* Work of all insertions, unless a limit is set: about half a minute. */
#define MOST_WORK UINT64_C(500000000)

/* The limit of visits in one insertion, unless the user sets one: so many for each triangle, plus a
 * constant that 700 points never exceed. Each triangle is visited at most once in each of the gaps
 * between n vertices, which makes 2 n (n + 1) visits. */
#define VISITS_PER_TRIANGLE 4
#define MORE_VISITS ((size_t)1 << 20)

/* The heap is made anew when this many of its entries for each triangle may be out of date. */
#define ENTRIES_PER_TRIANGLE 3

/* A triangle as it was when it was put on the heap, by its corners p, q, r with the largest angle
 * at q: it may have been replaced since. */
typedef struct entry {
    uint32_t p, q, r, triangle;
} entry;

typedef struct heap {
    const mw_point *point;
    entry *at;
    size_t count, room;
} heap;

static mw_angle entry_angle(const heap *h, const entry *e)
{
    return mw__angle(h->point[e->p], h->point[e->q], h->point[e->r]);
}

/* Equal angles: the lower-numbered triangle first. */
static bool entry_comes_before(const heap *h, const entry *e, const entry *f)
{
    mw_angle s = entry_angle(h, e), t = entry_angle(h, f);
    int order = mw__compare_angles(&s, &t);
    return order > 0 || (order == 0 && e->triangle < f->triangle);
}

static void heap_sift_up(heap *h, size_t i, entry e)
{
    for (; i > 0 && entry_comes_before(h, &e, &h->at[(i - 1) / 2]); i = (i - 1) / 2)
        h->at[i] = h->at[(i - 1) / 2];
    h->at[i] = e;
}

static entry heap_pop(heap *h)
{
    entry top = h->at[0], last = h->at[--h->count];
    size_t i = 0, child;
    for (; (child = 2 * i + 1) < h->count; i = child) {
        if (child + 1 < h->count && entry_comes_before(h, &h->at[child + 1], &h->at[child]))
            child++;
        if (!entry_comes_before(h, &h->at[child], &last)) break;
        h->at[i] = h->at[child];
    }
    h->at[i] = last;
    return top;
}

/* The triangle by its largest angle, the first one of equals. */
static entry entry_make(const heap *h, const mw_triangle *tri, uint32_t t)
{
    mw_angle largest;
    entry best = {0};
    for (uint32_t k = 0; k < 3; k++) {
        entry e = {tri->v[mw__prev(k)], tri->v[k], tri->v[mw__next(k)], t};
        mw_angle angle = entry_angle(h, &e);
        if (k > 0 && mw__compare_angles(&angle, &largest) <= 0) continue;
        largest = angle;
        best = e;
    }
    return best;
}

static bool heap_push(heap *h, const mw_triangle *tri, uint32_t t)
{
    if (h->count == h->room) {
        size_t room = h->room + h->room / 2 + 64;
        entry *at = mw__realloc(h->at, room, sizeof *at);
        if (!at) return false;
        h->at = at;
        h->room = room;
    }
    heap_sift_up(h, h->count++, entry_make(h, &tri[t], t));
    return true;
}

/* The corner of the triangle where its largest angle is; 3 if it is another triangle now. */
static uint32_t entry_corner(const entry *e, const mw_triangle *tri)
{
    uint32_t k = 0;
    while (k < 3 && tri->v[k] != e->q) k++;
    bool same = k < 3 && tri->v[mw__prev(k)] == e->p && tri->v[mw__next(k)] == e->r;
    return same ? k : 3;
}

typedef struct improvement {
    mw_triangulation *t;
    mw_insertion insertion;
    heap heap;
} improvement;

/* Triangles whose neighbour has changed may be worth another try: where only one edge is
 * exchanged. */
static bool improvement_push_again(improvement *m, uint32_t t)
{
    mw_triangle *tri = m->t->tri;
    for (uint32_t k = 0; k < 3; k++) {
        uint32_t link = tri[t].link[k], n = mw__link_triangle(link);
        if (link == MW_NONE || tri[n].user != MW_INSERTION_TRIED) continue;
        tri[n].user = MW_INSERTION_FREE;
        if (!heap_push(&m->heap, tri, n)) return false;
    }
    return true;
}

static bool improvement_push_made(improvement *m)
{
    const mw_insertion *in = &m->insertion;
    for (uint32_t i = 0; i < in->made_count; i++) {
        if (!heap_push(&m->heap, m->t->tri, in->made[i])) return false;
        if (!improvement_push_again(m, in->made[i])) return false;
    }
    return true;
}

/* Put all free triangles on the heap, and nothing else: those that are on it already, less what is
 * out of date. */
static bool improvement_fill(improvement *m)
{
    m->heap.count = 0;
    for (uint32_t i = 0; i < m->t->tri_count; i++)
        if (m->t->tri[i].user == MW_INSERTION_FREE && !heap_push(&m->heap, m->t->tri, i))
            return false;
    return true;
}

static bool improvement_add_made(improvement *m)
{
    if (!improvement_push_made(m)) return false;
    return m->heap.count / (ENTRIES_PER_TRIANGLE + 1) < m->t->tri_count || improvement_fill(m);
}

/* Improve by edges that cross at most `reach` others, until nothing is left to try or a limit is
 * reached. *proved: an attempt has failed. */
static mw_status improvement_run(improvement *m, uint32_t reach, mw_angle_limits limits,
                                 bool *proved)
{
    mw_triangle *tri = m->t->tri;
    mw_insertion_result result = MW_INSERTION_NONE;
    m->insertion.reach = reach;
    m->insertion.most_work = limits.most_work;
    m->insertion.most_seen = limits.most_seen;
    for (uint32_t i = 0; i < m->t->tri_count; i++) tri[i].user = MW_INSERTION_FREE;
    if (!improvement_fill(m)) return MW_ERROR_MEMORY;
    uint64_t tried = 0;
    mw__job_stage(m->t->job, "inserting better edges", 0.5);
    while (m->heap.count > 0 && result != MW_INSERTION_SPENT) {
        if (!mw__job_step(m->t->job, tried, tried + m->heap.count)) return MW_ERROR_MEMORY;
        tried++;
        entry e = heap_pop(&m->heap);
        uint32_t k = entry_corner(&e, &tri[e.triangle]);
        if (k == 3 || tri[e.triangle].user != MW_INSERTION_FREE) continue;
        result = mw__insert_edge(&m->insertion, e.triangle, k);
        if (result == MW_INSERTION_MEMORY) return MW_ERROR_MEMORY;
        if (result == MW_INSERTION_DONE && !improvement_add_made(m)) return MW_ERROR_MEMORY;
        if (result != MW_INSERTION_NONE) continue;
        tri[e.triangle].user = reach > 1 ? MW_INSERTION_FIXED : MW_INSERTION_TRIED;
        *proved = true;
    }
    return MW_OK;
}

mw_status mw__min_max_angle_within(mw_triangulation *t, mw_angle_limits limits, bool *proved)
{
    static const mw_angle_limits none = {UINT64_MAX, SIZE_MAX};
    improvement m = {
        .t = t, .insertion = {.point = t->point, .tri = t->tri}, .heap = {.point = t->point}};
    mw_status status = MW_OK;
    bool ignored;
    *proved = false;
    if (limits.most_work > 0) status = improvement_run(&m, UINT32_MAX, limits, proved);
    if (status == MW_OK) status = improvement_run(&m, 1, none, &ignored);
    mw__insertion_release(&m.insertion);
    free(m.heap.at);
    return status;
}

/* A limit of the caller's is one on points only. */
static mw_angle_limits triangulation_angle_limits(const mw_triangulation *t, uint32_t most_points)
{
    if (most_points == 0)
        return (mw_angle_limits){MOST_WORK,
                                 VISITS_PER_TRIANGLE * (size_t)t->tri_count + MORE_VISITS};
    return (mw_angle_limits){t->point_count <= most_points ? UINT64_MAX : 0, SIZE_MAX};
}

mw_status mw__make_min_max_angle(mw_triangulation *t, const mw_kind_options *options,
                                 mw_kind_report *report, mw_error *error)
{
    bool proved;
    mw_status status =
        mw__min_max_angle_within(t, triangulation_angle_limits(t, options->limit), &proved);
    report->optimal = proved;
    return status == MW_OK ? MW_OK : mw__fail_memory(error);
}
