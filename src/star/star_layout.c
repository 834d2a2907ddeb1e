/* star_layout.c - the order and form in which walks read facets.
 *
 * The order is along a Hilbert curve over the sphere, which an octahedron unfolds to a square. So
 * the facets that a walk visits are close in memory, whatever the user's order, and so are the
 * walks of queries sorted along the same curve. A guide tells where in this order a section of the
 * curve begins: 1 to 2 bytes a facet. The form has the three planes that bound the cone of a facet,
 * so that a step reads one cache line and no vertex. */
#include "base/hilbert.h"
#include "star/star.h"

#include <stdlib.h>

/* --- order --- */

typedef struct star_layout {
    mw_star *star;
    mw_key *keys;         /* by their place */
    const uint32_t *slot; /* of facet i of the user's order */
} star_layout;

/* The key of the direction to the middle of a facet. The direction is rounded, and halved so that
 * it does not overflow. Where there is none, any key will do. */
uint32_t mw__star_facet_key(const mw_star *star, const uint32_t v[3])
{
    double d[3];
    for (int k = 0; k < 3; k++) {
        double middle = mw__star_corner_point(star, v, 0)[k] / 6 +
                        mw__star_corner_point(star, v, 1)[k] / 6 +
                        mw__star_corner_point(star, v, 2)[k] / 6;
        d[k] = middle - star->centre[k] / 2;
    }
    return mw__star_curve_key(star->curve, d);
}

static void facets_key(void *work, uint64_t from, uint64_t to)
{
    const star_layout *layout = work;
    for (uint64_t i = from; i < to; i++) {
        mw_key *key = &layout->keys[i];
        key->key = mw__star_facet_key(layout->star, layout->star->tri[key->item].v);
    }
}

/* --- form --- */

/* If a factor is off by u = 2^-53 of itself, a component of the normal (a - c) x (b - c) is off by
 * 4u of its sum of magnitudes. So the normal is off by less than 2^-49 |a - c| |b - c|. If it is at
 * least LEAST_SINE times that product, the error is less than 2^-26 of it. If it is shorter, or
 * lengths are SHORT or LONG, which might underflow or overflow, the normal becomes 0, which is
 * never sure of a side. */
#define LEAST_SINE 0x1p-23
#define SHORT 0x1p-200
#define LONG 0x1p200

static double layout_vector_length(const double v[3])
{
    return sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
}

static void facet_set_normal(const mw_star *star, const double *p, const double *q, float normal[3])
{
    double a[3], b[3], n[3];
    for (int k = 0; k < 3; k++) {
        a[k] = p[k] - star->centre[k];
        b[k] = q[k] - star->centre[k];
        normal[k] = 0;
    }
    for (uint32_t k = 0; k < 3; k++)
        n[k] = a[mw__next(k)] * b[mw__prev(k)] - a[mw__prev(k)] * b[mw__next(k)];
    double from = layout_vector_length(a), to = layout_vector_length(b),
           size = layout_vector_length(n);
    bool ordinary = from > SHORT && from < LONG && to > SHORT && to < LONG;
    if (!ordinary || !(size > LEAST_SINE * from * to)) return;
    for (int k = 0; k < 3; k++) normal[k] = (float)(n[k] / size);
}

static bool facet_is_altered(const uint32_t v[3], const mw_triangle *given)
{
    return v[0] != given->v[0] || v[1] != given->v[1] || v[2] != given->v[2];
}

void mw__star_set_planes(const mw_star *star, mw_star_facet *facet)
{
    for (uint32_t k = 0; k < 3; k++)
        facet_set_normal(star, mw__star_corner_point(star, facet->v, k),
                         mw__star_corner_point(star, facet->v, mw__next(k)), facet->normal[k]);
}

/* Make facet t. slot[i] is the slot of facet i of the user's order. */
static mw_star_facet facet_make(const mw_star *star, const mw_triangle *t, const uint32_t *slot)
{
    mw_star_facet facet = {.user = t->user & MW_USER_MASK};
    for (uint32_t k = 0; k < 3; k++) {
        uint32_t link = t->link[k];
        facet.v[k] = t->v[k];
        facet.link[k] = link == MW_NONE
                            ? MW_NONE /* of a surface that is not closed */
                            : mw__link(slot[mw__link_triangle(link)], mw__link_edge(link));
    }
    mw__star_set_planes(star, &facet);
    if (facet_is_altered(facet.v, &star->surface->tri[facet.user])) facet.user |= MW_FACET_ALTERED;
    return facet;
}

static void facets_make(void *work, uint64_t from, uint64_t to)
{
    const star_layout *layout = work;
    for (uint64_t i = from; i < to; i++)
        layout->star->facet[i] =
            facet_make(layout->star, &layout->star->tri[layout->keys[i].item], layout->slot);
}

/* --- guide --- */

/* For each section of the curve, enter the middle one of its facets; if it has none, the next
 * facet. */
static void star_fill_guide(mw_star *star, const mw_key *keys)
{
    uint32_t parts = UINT32_C(1) << star->guide_bits, shift = 32 - star->guide_bits, end = 0;
    for (uint32_t i = 0; i < parts; i++) {
        uint32_t first = end;
        while (end < star->facet_count && keys[end].key >> shift == i) end++;
        uint32_t middle = first + (end - first) / 2;
        star->guide[i] = middle < star->facet_count ? middle : star->facet_count - 1;
    }
}

/* List the facets that are to be stored. */
static void star_list_facets(mw_star *star, mw_key *keys)
{
    star->facet_count = 0;
    for (uint32_t t = 0; t < star->tri_count; t++)
        if (!(star->tri[t].user & MW_STAR_OMITTED)) keys[star->facet_count++].item = t;
}

bool mw__star_lay_out(mw_star *star, mw_job *job)
{
    uint32_t n = star->tri_count, *slot = mw__alloc(n, sizeof *slot);
    mw_key *keys = mw__alloc(2 * (size_t)n, sizeof *keys);
    star_layout layout = {star, keys, slot};
    bool done = slot && keys;
    if (done) star_list_facets(star, keys);
    n = star->facet_count;
    mw__job_stage(job, "sorting facets", 0.5);
    done = done && mw__job_ranges(job, n, facets_key, &layout);
    if (done) {
        mw__sort_keys(keys, keys + n, n);
        for (uint32_t i = 0; i < n; i++) slot[keys[i].item] = i;
        mw__job_stage(job, "laying out facets", 0.5);
        done = mw__job_ranges(job, n, facets_make, &layout);
        star_fill_guide(star, keys);
    }
    free(slot);
    free(keys);
    return done;
}
