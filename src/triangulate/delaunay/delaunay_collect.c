/* delaunay_collect.c - triangles are numbered by their lowest slot: along the curve.
 *
 * It is a counting sort. Each patch counts and numbers those facets in its own slice of facets
 * whose lowest slot is its own. The other facets lie along seams and are few; they are numbered one
 * after the other and come last at their slot. Numbers do not depend on the threads. */
#include "triangulate/delaunay/delaunay_collect.h"

#include <stdlib.h>

/* Of a facet whose lowest slot is another patch's: FOREIGN + the number of the next such facet in
 * its patch. */
#define FOREIGN UINT32_C(0x80000000)
#define NO_MORE (MW_NONE - 1)

/* A patch without halves. */
typedef struct slice {
    uint32_t from, to; /* slots                                            */
    uint32_t foreign;  /* as the number of a foreign facet: the first, last */
    uint32_t count;    /* triangles whose lowest slot it has               */
} slice;

typedef struct collector {
    const mw_patch_arrays *arrays;
    /* of each facet: MW_NONE: it is no triangle */
    uint32_t *number;
    /* of each slot: triangles whose lowest it is, then the number of the next one */
    uint32_t *next;
    slice *slices;
    uint32_t slice_count;
    mw_triangle *tri;
    const uint32_t *vertex; /* of each slot: its vertex; NULL: they are the same */
} collector;

static MW_INLINE uint32_t facet_lowest(const mw_facet *f)
{
    uint32_t low = f->v[0] < f->v[1] ? f->v[0] : f->v[1];
    return low < f->v[2] ? low : f->v[2];
}

static MW_INLINE bool facet_is_ghost(const collector *h, const mw_facet *f)
{
    return f->v[0] == h->arrays->n || f->v[1] == h->arrays->n || f->v[2] == h->arrays->n;
}

static void slice_count(collector *h, slice *s)
{
    s->foreign = NO_MORE;
    for (uint32_t i = s->from; i < s->to; i++) h->next[i] = 0;
    for (uint32_t f = 2 * s->from; f < 2 * s->to; f++) {
        const mw_facet *facet = &h->arrays->facet[f];
        uint32_t low = facet_lowest(facet);
        if (facet_is_ghost(h, facet)) {
            h->number[f] = MW_NONE;
        } else if (low >= s->from && low < s->to) {
            h->number[f] = low;
            h->next[low]++;
        } else {
            h->number[f] = s->foreign;
            s->foreign = FOREIGN + f;
        }
    }
}

static void slice_count_foreign(collector *h, slice *s)
{
    for (uint32_t f = s->foreign; f != NO_MORE; f = h->number[f - FOREIGN])
        h->next[facet_lowest(&h->arrays->facet[f - FOREIGN])]++;
}

static void slice_sum_up(collector *h, slice *s)
{
    s->count = 0;
    for (uint32_t i = s->from; i < s->to; i++) s->count += h->next[i];
}

/* s->count has become the number of the first. */
static void slice_number(collector *h, slice *s)
{
    uint32_t sum = s->count;
    for (uint32_t i = s->from; i < s->to; i++) {
        uint32_t here = h->next[i];
        h->next[i] = sum;
        sum += here;
    }
    for (uint32_t f = 2 * s->from; f < 2 * s->to; f++)
        if (h->number[f] < FOREIGN) h->number[f] = h->next[h->number[f]]++;
}

static void slice_number_foreign(collector *h, slice *s)
{
    for (uint32_t f = s->foreign, after; f != NO_MORE; f = after) {
        after = h->number[f - FOREIGN];
        h->number[f - FOREIGN] = h->next[facet_lowest(&h->arrays->facet[f - FOREIGN])]++;
    }
}

static void slice_copy(collector *h, slice *s)
{
    for (uint32_t f = 2 * s->from; f < 2 * s->to; f++) {
        if (h->number[f] == MW_NONE) continue;
        const mw_facet *from = &h->arrays->facet[f];
        mw_triangle *t = &h->tri[h->number[f]];
        for (uint32_t k = 0; k < 3; k++) {
            uint32_t other = h->number[mw__link_triangle(from->link[k])];
            t->v[k] = h->vertex ? h->vertex[from->v[k]] : from->v[k];
            t->link[k] = other == MW_NONE ? MW_NONE : mw__link(other, mw__link_edge(from->link[k]));
        }
        t->v[3] = t->v[0];
        t->user = h->number[f];
    }
}

typedef struct slice_loop {
    collector *collector;
    void (*step)(collector *h, slice *s);
} slice_loop;

static void slice_step(void *work, uint64_t i, uint32_t member)
{
    const slice_loop *loop = work;
    (void)member;
    loop->step(loop->collector, &loop->collector->slices[i]);
}

/* Returns false if the job is to stop. */
static bool slices_run(collector *h, void (*step)(collector *h, slice *s), mw_job *job)
{
    slice_loop loop = {h, step};
    return mw__job_chunks(job, mw__job_team(job, h->slice_count), h->slice_count, slice_step,
                          &loop);
}

static bool slices_list(collector *h, const mw_patches *patches)
{
    h->slices = mw__alloc(patches->count, sizeof *h->slices);
    if (!h->slices) return false;
    for (uint32_t i = 0; i < patches->count; i++)
        if (patches->patch[i].half == MW_NONE)
            h->slices[h->slice_count++] =
                (slice){.from = patches->patch[i].from, .to = patches->patch[i].to};
    return true;
}

/* The slices lie in any order: that of the patches. Numbers go along the slots. */
static int slices_compare(const void *left, const void *right)
{
    uint32_t i = ((const slice *)left)->from, j = ((const slice *)right)->from;
    return (i > j) - (i < j);
}

static bool slices_number(collector *h, mw_job *job, uint32_t *tri_count)
{
    uint32_t sum = 0;
    qsort(h->slices, h->slice_count, sizeof *h->slices, slices_compare);
    mw__job_stage(job, "counting triangles", 0.2);
    if (!slices_run(h, slice_count, job)) return false;
    for (uint32_t i = 0; i < h->slice_count; i++) slice_count_foreign(h, &h->slices[i]);
    mw__job_stage(job, "numbering triangles", 0.3);
    if (!slices_run(h, slice_sum_up, job)) return false;
    for (uint32_t i = 0; i < h->slice_count; i++) {
        uint32_t here = h->slices[i].count;
        h->slices[i].count = sum;
        sum += here;
    }
    if (!slices_run(h, slice_number, job)) return false;
    for (uint32_t i = 0; i < h->slice_count; i++) slice_number_foreign(h, &h->slices[i]);
    *tri_count = sum;
    return true;
}

bool mw__delaunay_collect(const mw_patches *patches, const mw_patch_arrays *arrays, bool slots,
                          mw_job *job, uint32_t *scratch, mw_triangle **tri, uint32_t *tri_count)
{
    collector h = {.arrays = arrays, .number = scratch, .next = scratch + 2 * (size_t)arrays->n};
    if (!slots) h.vertex = arrays->order;
    bool done = slices_list(&h, patches) && slices_number(&h, job, tri_count);
    if (done) h.tri = mw__alloc_lines(*tri_count, sizeof *h.tri);
    mw__job_stage(job, "copying triangles", 0.5);
    if (h.tri && !slices_run(&h, slice_copy, job)) {
        free(h.tri);
        h.tri = NULL;
    }
    free(h.slices);
    *tri = h.tri;
    return h.tri;
}
