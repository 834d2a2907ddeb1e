/* flat.c - facets without area are flipped away.
 *
 * A flat facet is flipped at its longest edge. If the facet across has an area, both have one afterwards: one flat
 * facet less. If it is flat, too, and has a longer edge, that one is flipped first; edges grow along the way, so it
 * comes to an end. If both have the same longest edge, both have shorter ones afterwards, between vertices of the
 * same line: that, too, comes to an end. Where the apexes on both sides are at one place, the two facets lie on each
 * other, and go together; and where two corners are at one place, the two facets at the edge between them go as if
 * it was shrunk to a point. What lay beside them is linked, and they are void: two facets less. After a flip the
 * search goes on beside it, so that a fan of flat facets takes time in proportion to their number. */
#include "star/flat.h"

static const double *corner(const mw_star *star, uint32_t t, uint32_t k)
{
    return mw__surface_point(star->surface, star->tri[t].v[k]);
}

static bool is_flat(const mw_star *star, uint32_t t)
{
    return mw__collinear3(corner(star, t, 0), corner(star, t, 1), corner(star, t, 2));
}

/* Of a flat facet, whose corners are three places: the edge off the middle one. On a line that is not perpendicular
 * to an axis different points have different coordinates. */
static uint32_t longest_edge(const mw_star *star, uint32_t t)
{
    int axis = 0;
    while (axis < 2 && corner(star, t, 0)[axis] == corner(star, t, 1)[axis]) axis++;
    uint32_t middle = 0;
    for (uint32_t k = 0; k < 3; k++) {
        double x = corner(star, t, k)[axis], y = corner(star, t, mw__next(k))[axis],
               z = corner(star, t, mw__prev(k))[axis];
        if ((y < x && x < z) || (z < x && x < y)) middle = k;
    }
    return mw__next(middle);
}

static void join(mw_star *star, uint32_t t, uint32_t edge, uint32_t link)
{
    star->tri[t].link[edge] = link;
    star->tri[mw__link_triangle(link)].link[mw__link_edge(link)] = mw__link(t, edge);
}

static void set_corners(mw_triangle *t, uint32_t a, uint32_t b, uint32_t c)
{
    t->v[0] = t->v[3] = a;
    t->v[1] = b;
    t->v[2] = c;
}

/* Facet f = b a v, with edge ba, becomes v b x; that across, g = a b x, becomes a v x. */
static void flip(mw_star *star, uint32_t f, uint32_t edge)
{
    mw_triangle *flat = &star->tri[f];
    uint32_t link = flat->link[edge], g = mw__link_triangle(link), across = mw__link_edge(link);
    mw_triangle *whole = &star->tri[g];
    uint32_t b = flat->v[edge], a = flat->v[edge + 1], v = flat->v[mw__prev(edge)], x = whole->v[mw__prev(across)];
    uint32_t av = flat->link[mw__next(edge)], vb = flat->link[mw__prev(edge)];
    uint32_t bx = whole->link[mw__next(across)], xa = whole->link[mw__prev(across)];
    set_corners(whole, a, v, x);
    set_corners(flat, v, b, x);
    flat->user = whole->user;
    join(star, g, 0, av);
    join(star, g, 2, xa);
    join(star, f, 0, vb);
    join(star, f, 1, bx);
    join(star, f, 2, mw__link(g, 1));
}

/* Two half-edges of facets that go: what lies across one is linked with what lies across the other. That may be a
 * half-edge that goes, too, and then finds its new partner when its own turn comes; partners of each other have
 * nothing across. */
static void glue(mw_star *star, uint32_t a, uint32_t b)
{
    uint32_t across_a = star->tri[mw__link_triangle(a)].link[mw__link_edge(a)];
    uint32_t across_b = star->tri[mw__link_triangle(b)].link[mw__link_edge(b)];
    if (across_a != b) join(star, mw__link_triangle(across_a), mw__link_edge(across_a), across_b);
}

static void make_void(mw_star *star, uint32_t t)
{
    for (int k = 0; k < 3; k++) star->tri[t].link[k] = MW_NONE;
}

/* An edge whose ends are at one place, or MW_STAR_NO_EDGE. */
static uint32_t short_edge(const mw_star *star, uint32_t t)
{
    uint32_t k = 0;
    while (k < 3 && star->place[star->tri[t].v[k]] != star->place[star->tri[t].v[k + 1]]) k++;
    return k;
}

/* Of facet t, edge `edge` has its ends at one place. If it is linked to another edge of t, the third edge has, too,
 * as those two end in the same places. */
static void shrink(mw_star *star, uint32_t t, uint32_t edge)
{
    uint32_t link = star->tri[t].link[edge];
    if (mw__link_triangle(link) == t) link = star->tri[t].link[edge = 3 - edge - mw__link_edge(link)];
    uint32_t half = mw__link(t, edge);
    glue(star, mw__half_next(half), mw__half_prev(half));
    glue(star, mw__half_next(link), mw__half_prev(link));
    make_void(star, t);
    make_void(star, mw__link_triangle(link));
}

/* Facets on both sides of an edge, with the same three places, go. */
static void fold(mw_star *star, uint32_t t, uint32_t edge)
{
    uint32_t half = mw__link(t, edge), link = star->tri[t].link[edge];
    glue(star, mw__half_next(half), mw__half_prev(link));
    glue(star, mw__half_prev(half), mw__half_next(link));
    make_void(star, t);
    make_void(star, mw__link_triangle(link));
}

static uint32_t apex_place(const mw_star *star, uint32_t half)
{
    return star->place[star->tri[mw__link_triangle(half)].v[mw__prev(mw__link_edge(half))]];
}

/* Take one flat facet away, or flip it: t, or one that has to go before it. Returns a facet to go on with. */
static uint32_t reduce(mw_star *star, uint32_t t)
{
    uint32_t small = short_edge(star, t);
    if (small != MW_STAR_NO_EDGE) {
        shrink(star, t, small);
        return t;
    }
    uint32_t edge = longest_edge(star, t), link = star->tri[t].link[edge], other = mw__link_triangle(link);
    if (apex_place(star, link) == apex_place(star, mw__link(t, edge))) {
        fold(star, t, edge);
        return t;
    }
    if (is_flat(star, other) &&
        (short_edge(star, other) != MW_STAR_NO_EDGE || longest_edge(star, other) != mw__link_edge(link)))
        return other;
    flip(star, t, edge);
    uint32_t beside = mw__link_triangle(star->tri[t].link[0]);
    return is_flat(star, beside) ? beside : mw__link_triangle(star->tri[other].link[0]);
}

static bool is_left(const mw_star *star, uint32_t t)
{
    return !mw__star_is_void(&star->tri[t]) && is_flat(star, t);
}

void mw__star_remove_flats(mw_star *star)
{
    for (uint32_t f = 0; f < star->tri_count; f++)
        for (uint32_t t = f; is_left(star, f);) t = reduce(star, is_left(star, t) ? t : f);
}
