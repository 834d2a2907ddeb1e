/* layout.c - the facets in the order and form in which walks read them.
 *
 * The order is that along a Hilbert curve over the sphere, which is unfolded to a square by way of an octahedron: what
 * a walk visits, and the walks of queries sorted along the same curve, stand near each other, whatever the user's
 * order. A guide tells where in it a part of the curve begins: 1 to 2 bytes a facet. The form holds the three planes that
 * bound a facet's cone, so that a step reads one line of memory and no vertex. */
#include "base/hilbert.h"
#include "star/star.h"

#include <stdlib.h>

static const double *corner(const mw_star *star, const uint32_t *v, uint32_t k)
{
    return mw__surface_point(star->surface, v[k]);
}

/* --- order -------------------------------------------------------------------------------------------------------- */

/* The direction to the middle of a facet: rounded, and halved so that it does not overflow. */
static uint32_t curve_key(const mw_hilbert *hilbert, const mw_star *star, const mw_triangle *t)
{
    double d[3], x, y;
    for (int k = 0; k < 3; k++) {
        double middle = corner(star, t->v, 0)[k] / 6 + corner(star, t->v, 1)[k] / 6 + corner(star, t->v, 2)[k] / 6;
        d[k] = middle - star->centre[k] / 2;
    }
    mw__star_unfold(d, &x, &y);
    return mw__hilbert_key(hilbert, x, y);
}

static void sort_facets(const mw_star *star, mw_key *keys, mw_key *scratch)
{
    static const double low[2] = {-1, -1}, high[2] = {1, 1};
    mw_hilbert hilbert = mw__hilbert(low, high);
    for (uint32_t t = 0; t < star->tri_count; t++) keys[t] = (mw_key){curve_key(&hilbert, star, &star->tri[t]), t};
    mw__sort_keys(keys, scratch, star->tri_count);
}

/* --- form --------------------------------------------------------------------------------------------------------- */

/* With a factor off by u = 2^-53 of itself, a component of the normal (a - c) x (b - c) is off by 4u of its sum of
 * magnitudes, so the normal by less than 2^-49 |a - c| |b - c|. Where it is at least LEAST_SINE times that product,
 * that is less than 2^-26 of it. Where it is less, or lengths are SHORT or LONG, which might under- or overflow, the
 * normal is 0, and so never sure of a side. */
#define LEAST_SINE 0x1p-23
#define SHORT 0x1p-200
#define LONG 0x1p200

static double length(const double v[3])
{
    return sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
}

static void set_normal(const mw_star *star, const double *p, const double *q, float normal[3])
{
    double a[3], b[3], n[3];
    for (int k = 0; k < 3; k++) {
        a[k] = p[k] - star->centre[k];
        b[k] = q[k] - star->centre[k];
        normal[k] = 0;
    }
    for (uint32_t k = 0; k < 3; k++) n[k] = a[mw__next(k)] * b[mw__prev(k)] - a[mw__prev(k)] * b[mw__next(k)];
    double from = length(a), to = length(b), size = length(n);
    bool ordinary = from > SHORT && from < LONG && to > SHORT && to < LONG;
    if (!ordinary || !(size > LEAST_SINE * from * to)) return;
    for (int k = 0; k < 3; k++) normal[k] = (float)(n[k] / size);
}

static bool is_recast(const uint32_t v[3], const mw_triangle *given)
{
    return v[0] != given->v[0] || v[1] != given->v[1] || v[2] != given->v[2];
}

/* place[i] is where facet i of the user's order goes. */
static mw_star_facet cast(const mw_star *star, const mw_triangle *t, const uint32_t *place)
{
    mw_star_facet facet = {.user = t->user & MW_USER_MASK};
    for (uint32_t k = 0; k < 3; k++) {
        facet.v[k] = t->v[k];
        facet.link[k] = mw__link(place[mw__link_triangle(t->link[k])], mw__link_edge(t->link[k]));
        set_normal(star, corner(star, t->v, k), corner(star, t->v, k + 1), facet.normal[k]);
    }
    if (is_recast(facet.v, &star->surface->tri[facet.user])) facet.user |= MW_RECAST;
    return facet;
}

/* --- guide -------------------------------------------------------------------------------------------------------- */

/* For each part of the curve the middle one of the facets there; of a part without any, the next one. */
static void fill_guide(mw_star *star, const mw_key *keys)
{
    uint32_t parts = UINT32_C(1) << star->guide_bits, shift = 32 - star->guide_bits, end = 0;
    for (uint32_t i = 0; i < parts; i++) {
        uint32_t first = end;
        while (end < star->tri_count && keys[end].key >> shift == i) end++;
        uint32_t middle = first + (end - first) / 2;
        star->guide[i] = middle < star->tri_count ? middle : star->tri_count - 1;
    }
}

bool mw__star_lay_out(mw_star *star)
{
    uint32_t n = star->tri_count, *place = mw__alloc(n, sizeof *place);
    mw_key *keys = mw__alloc(2 * (size_t)n, sizeof *keys);
    bool done = place && keys;
    if (done) {
        sort_facets(star, keys, keys + n);
        for (uint32_t i = 0; i < n; i++) place[keys[i].item] = i;
        for (uint32_t i = 0; i < n; i++) star->facet[i] = cast(star, &star->tri[keys[i].item], place);
        fill_guide(star, keys);
    }
    free(place);
    free(keys);
    return done;
}
