/* flat_facets.c - flips facets without area away.
 *
 * A flat facet is flipped at its longest edge. If the facet across has an area, both have one
 * afterwards: one flat facet less. If the facet across is flat, too, and has a longer edge, that
 * one is flipped first. Edges grow along this way, so it ends. If both have the same longest edge,
 * both have shorter ones afterwards, between vertices of the same line. This ends, too. If the
 * apexes on both sides coincide, the two facets lie on each other, and both are removed. If two
 * corners coincide, the two facets at the edge between them are removed, as if the edge shrank to a
 * point. Then their neighbours are linked to each other, and the two facets become void: two flat
 * facets less. After a flip the search continues next to it, so that a fan of flat facets takes
 * linear time. */
#include "star/prepare/flat_facets.h"

static bool facet_is_flat(const mw_star *star, uint32_t t)
{
    return mw__collinear3(mw__star_corner_point(star, star->tri[t].v, 0),
                          mw__star_corner_point(star, star->tri[t].v, 1),
                          mw__star_corner_point(star, star->tri[t].v, 2));
}

/* The longest edge of a flat facet without coincident corners: it is opposite to the middle corner.
 * Different points of a line have different coordinates along any axis that is not perpendicular to
 * the line. */
static uint32_t facet_longest_edge(const mw_star *star, uint32_t t)
{
    int axis = 0;
    while (axis < 2 && mw__star_corner_point(star, star->tri[t].v, 0)[axis] ==
                           mw__star_corner_point(star, star->tri[t].v, 1)[axis])
        axis++;
    uint32_t middle = 0;
    for (uint32_t k = 0; k < 3; k++) {
        double x = mw__star_corner_point(star, star->tri[t].v, k)[axis],
               y = mw__star_corner_point(star, star->tri[t].v, mw__next(k))[axis],
               z = mw__star_corner_point(star, star->tri[t].v, mw__prev(k))[axis];
        if ((y < x && x < z) || (z < x && x < y)) middle = k;
    }
    return mw__next(middle);
}

static void facets_join(mw_star *star, uint32_t t, uint32_t edge, uint32_t link)
{
    star->tri[t].link[edge] = link;
    star->tri[mw__link_triangle(link)].link[mw__link_edge(link)] = mw__link(t, edge);
}

static void facet_set_corners(mw_triangle *t, uint32_t a, uint32_t b, uint32_t c)
{
    t->v[0] = t->v[3] = a;
    t->v[1] = b;
    t->v[2] = c;
}

/* Facet f = b a v, with edge ba, becomes v b x. The facet across, g = a b x, becomes a v x. */
static void flat_facet_flip(mw_star *star, uint32_t f, uint32_t edge)
{
    mw_triangle *flat = &star->tri[f];
    uint32_t link = flat->link[edge], g = mw__link_triangle(link), across = mw__link_edge(link);
    mw_triangle *whole = &star->tri[g];
    uint32_t b = flat->v[edge], a = flat->v[edge + 1], v = flat->v[mw__prev(edge)],
             x = whole->v[mw__prev(across)];
    uint32_t av = flat->link[mw__next(edge)], vb = flat->link[mw__prev(edge)];
    uint32_t bx = whole->link[mw__next(across)], xa = whole->link[mw__prev(across)];
    facet_set_corners(whole, a, v, x);
    facet_set_corners(flat, v, b, x);
    flat->user = whole->user;
    facets_join(star, g, 0, av);
    facets_join(star, g, 2, xa);
    facets_join(star, f, 0, vb);
    facets_join(star, f, 1, bx);
    facets_join(star, f, 2, mw__link(g, 1));
}

/* Two half-edges of facets that are removed: links the two half-edges across. One of these may be
 * removed as well. Then it gets its new neighbour when its own turn comes. If the two are
 * neighbours of each other, nothing is across. */
static void half_edges_glue(mw_star *star, uint32_t a, uint32_t b)
{
    uint32_t across_a = star->tri[mw__link_triangle(a)].link[mw__link_edge(a)];
    uint32_t across_b = star->tri[mw__link_triangle(b)].link[mw__link_edge(b)];
    if (across_a != b)
        facets_join(star, mw__link_triangle(across_a), mw__link_edge(across_a), across_b);
}

static void facet_make_void(mw_star *star, uint32_t t)
{
    for (int k = 0; k < 3; k++) star->tri[t].link[k] = MW_NONE;
}

/* An edge with coincident ends, or MW_STAR_NO_EDGE. */
static uint32_t facet_short_edge(const mw_star *star, uint32_t t)
{
    uint32_t k = 0;
    while (k < 3 && star->coincident[star->tri[t].v[k]] != star->coincident[star->tri[t].v[k + 1]])
        k++;
    return k;
}

/* Remove facet t, whose edge `edge` has coincident ends, and its neighbour there. If this edge is
 * linked to another edge of t, the third edge has coincident ends, too, as those two edges join the
 * same points. */
static void facet_shrink(mw_star *star, uint32_t t, uint32_t edge)
{
    uint32_t link = star->tri[t].link[edge];
    if (mw__link_triangle(link) == t)
        link = star->tri[t].link[edge = 3 - edge - mw__link_edge(link)];
    uint32_t half = mw__link(t, edge);
    half_edges_glue(star, mw__half_next(half), mw__half_prev(half));
    half_edges_glue(star, mw__half_next(link), mw__half_prev(link));
    facet_make_void(star, t);
    facet_make_void(star, mw__link_triangle(link));
}

/* Remove the facets on both sides of an edge, whose corners coincide. */
static void facet_pair_fold(mw_star *star, uint32_t t, uint32_t edge)
{
    uint32_t half = mw__link(t, edge), link = star->tri[t].link[edge];
    half_edges_glue(star, mw__half_next(half), mw__half_prev(link));
    half_edges_glue(star, mw__half_prev(half), mw__half_next(link));
    facet_make_void(star, t);
    facet_make_void(star, mw__link_triangle(link));
}

static uint32_t apex_representative(const mw_star *star, uint32_t half)
{
    return star->coincident[star->tri[mw__link_triangle(half)].v[mw__prev(mw__link_edge(half))]];
}

/* Remove or flip one flat facet: t, or another that must come before it. Returns a facet to
 * continue with. */
static uint32_t flat_facet_reduce(mw_star *star, uint32_t t)
{
    uint32_t small = facet_short_edge(star, t);
    if (small != MW_STAR_NO_EDGE) {
        facet_shrink(star, t, small);
        return t;
    }
    uint32_t edge = facet_longest_edge(star, t), link = star->tri[t].link[edge],
             other = mw__link_triangle(link);
    if (apex_representative(star, link) == apex_representative(star, mw__link(t, edge))) {
        facet_pair_fold(star, t, edge);
        return t;
    }
    if (facet_is_flat(star, other) && (facet_short_edge(star, other) != MW_STAR_NO_EDGE ||
                                       facet_longest_edge(star, other) != mw__link_edge(link)))
        return other;
    flat_facet_flip(star, t, edge);
    uint32_t beside = mw__link_triangle(star->tri[t].link[0]);
    return facet_is_flat(star, beside) ? beside : mw__link_triangle(star->tri[other].link[0]);
}

static bool flat_facet_remains(const mw_star *star, uint32_t t)
{
    return !mw__star_is_void(&star->tri[t]) && facet_is_flat(star, t);
}

void mw__flat_facets_remove(mw_star *star)
{
    for (uint32_t f = 0; f < star->tri_count; f++)
        for (uint32_t t = f; flat_facet_remains(star, f);)
            t = flat_facet_reduce(star, flat_facet_remains(star, t) ? t : f);
}
