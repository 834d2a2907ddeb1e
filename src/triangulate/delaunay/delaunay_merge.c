/* delaunay_merge.c - the merge step of divide and conquer [Guibas, Stolfi 1985], on facets with
 * ghosts.
 *
 *         l'.       .r'
 *          | \     / |
 *          |  \   /  |
 *         l.---------.r
 *          |///below/|
 *
 * Left and right lie on either side of a line. From the lower common tangent lr on, the seam is
 * closed upwards: an empty circle through l and r rises until it meets the first vertex, l' or r',
 * which makes a triangle with lr; its upper edge is the next lr. On either side the seam faces a
 * row of ghosts, each with its hull edge. If the circle meets l', the ghost at the edge ll' becomes
 * the triangle l', l, r: its vertex at infinity is replaced by r. If the facet behind ll' has its
 * third vertex in the circle of l, r, l', the edge ll' is removed: it is flipped between ghost and
 * facet, which makes two ghosts at the two edges behind it.
 *
 * So no facets are freed, and only two are made: a ghost below the lower tangent and one above the
 * upper tangent. A vertex on the circle does not count as met. All tests are exact. */
#include "triangulate/delaunay/delaunay_merge.h"

#include "mesh/mesh.h"

/* Which corner k of a ghost is the vertex at infinity. The hull edge is edge k + 1, opposite to it;
 * in counter-clockwise order of the hull it runs from vertex k - 1 to vertex k + 1. Edge k leads to
 * the next ghost in counter-clockwise order of the hull, edge k - 1 to the one before. */
static MW_INLINE uint32_t ghost_corner(const mw_growth *g, uint32_t ghost)
{
    const uint32_t *v = g->facet[ghost].v;
    return v[0] == g->infinity ? 0 : v[1] == g->infinity ? 1 : 2;
}

static MW_INLINE uint32_t hull_from(const mw_growth *g, uint32_t ghost)
{
    return g->facet[ghost].v[mw__prev(ghost_corner(g, ghost))];
}

static MW_INLINE uint32_t hull_to(const mw_growth *g, uint32_t ghost)
{
    return g->facet[ghost].v[mw__next(ghost_corner(g, ghost))];
}

static MW_INLINE uint32_t hull_onward(const mw_growth *g, uint32_t ghost)
{
    return mw__link_triangle(g->facet[ghost].link[ghost_corner(g, ghost)]);
}

static MW_INLINE uint32_t hull_back(const mw_growth *g, uint32_t ghost)
{
    return mw__link_triangle(g->facet[ghost].link[mw__prev(ghost_corner(g, ghost))]);
}

static MW_INLINE void ghosts_join(mw_growth *g, uint32_t a, uint32_t b)
{
    g->facet[mw__link_triangle(a)].link[mw__link_edge(a)] = b;
    g->facet[mw__link_triangle(b)].link[mw__link_edge(b)] = a;
}

/* --- which side is left --- */

/* Of a triangulation: ghosts whose hull edges begin at vertices with the least and the greatest x
 * and y. */
typedef struct hull_ends {
    uint32_t low[2], high[2];
} hull_ends;

static double ghost_coordinate(const mw_growth *g, uint32_t ghost, int axis)
{
    mw_point p = g->point[hull_from(g, ghost)];
    return axis ? p.y : p.x;
}

static hull_ends hull_find_ends(const mw_growth *g, uint32_t ghost)
{
    hull_ends e = {{ghost, ghost}, {ghost, ghost}};
    for (uint32_t t = hull_onward(g, ghost); t != ghost; t = hull_onward(g, t))
        for (int axis = 0; axis < 2; axis++) {
            double c = ghost_coordinate(g, t, axis);
            if (c < ghost_coordinate(g, e.low[axis], axis)) e.low[axis] = t;
            if (c > ghost_coordinate(g, e.high[axis], axis)) e.high[axis] = t;
        }
    return e;
}

/* --- the seam --- */

/* Between a vertex on the left and one on the right; both parts are seen with the line between them
 * upright. */
typedef struct seam {
    uint32_t l, r;
    uint32_t left;  /* the ghost whose hull edge begins at l, going up */
    uint32_t right; /* the ghost whose hull edge ends at r, coming down */
    uint32_t below; /* link to the edge rl of the facet below           */
} seam;

/* Begin with l the rightmost vertex and r the leftmost: turn to the lower common tangent. Of
 * vertices on the tangent l is the last and r the first, so there is none between them. */
static void seam_go_to_tangent(const mw_growth *g, seam *s)
{
    const mw_point *p = g->point;
    for (;;) {
        uint32_t under_left = hull_back(g, s->left), under_right = hull_onward(g, s->right);
        uint32_t l = hull_from(g, under_left), r = hull_to(g, under_right);
        if (mw__orient2d(p[s->l], p[l], p[s->r]) > 0) {
            s->l = l;
            s->left = under_left;
        } else if (mw__orient2d(p[s->r], p[r], p[s->l]) < 0) {
            s->r = r;
            s->right = under_right;
        } else {
            return;
        }
    }
}

/* Put a ghost at the lower tangent, between the ghosts before l and after r. */
static void seam_close_below(mw_growth *g, seam *s, uint32_t ghost)
{
    uint32_t before = hull_back(g, s->left), after = hull_onward(g, s->right);
    g->facet[ghost] = (mw_facet){{s->r, s->l, g->infinity}, {MW_NONE, MW_NONE, MW_NONE}};
    ghosts_join(g, mw__link(ghost, 1), mw__link(before, ghost_corner(g, before)));
    ghosts_join(g, mw__link(ghost, 2), mw__link(after, mw__prev(ghost_corner(g, after))));
    s->below = mw__link(ghost, 0);
}

/* Put a ghost at the upper tangent. */
static void seam_close_above(mw_growth *g, const seam *s, uint32_t ghost)
{
    g->facet[ghost] = (mw_facet){{s->l, s->r, g->infinity}, {MW_NONE, MW_NONE, MW_NONE}};
    ghosts_join(g, mw__link(ghost, 0), s->below);
    ghosts_join(g, mw__link(ghost, 1), mw__link(s->right, ghost_corner(g, s->right)));
    ghosts_join(g, mw__link(ghost, 2), mw__link(s->left, mw__prev(ghost_corner(g, s->left))));
}

/* Is the vertex behind the hull edge of a ghost in the circle of l, r and c? Sets *link to the edge
 * behind. */
static MW_INLINE bool seam_meets_before(const mw_growth *g, const seam *s, uint32_t ghost,
                                        uint32_t c, uint32_t *link)
{
    const mw_point *p = g->point;
    *link = g->facet[ghost].link[mw__next(ghost_corner(g, ghost))];
    uint32_t behind = g->facet[mw__link_triangle(*link)].v[mw__prev(mw__link_edge(*link))];
    return behind != g->infinity && mw__incircle(p[s->l], p[s->r], p[c], p[behind]) > 0;
}

/* Flip edges ll' that the circle passes. The ghost keeps its edge from l to infinity, whose
 * neighbour is below the seam by now and must not be touched. */
static uint32_t seam_clear_left(mw_growth *g, const seam *s)
{
    uint32_t up = hull_to(g, s->left), link;
    while (seam_meets_before(g, s, s->left, up, &link)) {
        uint32_t t = mw__link_triangle(link), e = mw__link_edge(link), k = ghost_corner(g, s->left);
        mw_facet *ghost = &g->facet[s->left];
        const mw_facet old = g->facet[t];
        uint32_t apex = old.v[mw__prev(e)], next = ghost->link[k];
        g->facet[t] = (mw_facet){{up, apex, g->infinity}, {MW_NONE, MW_NONE, MW_NONE}};
        ghost->v[mw__next(k)] = apex;
        ghosts_join(g, mw__link(s->left, mw__next(k)), old.link[mw__prev(e)]);
        ghosts_join(g, mw__link(s->left, k), mw__link(t, 1));
        ghosts_join(g, mw__link(t, 0), old.link[mw__next(e)]);
        ghosts_join(g, mw__link(t, 2), next);
        up = apex;
    }
    return up;
}

/* The mirror image. */
static uint32_t seam_clear_right(mw_growth *g, const seam *s)
{
    uint32_t up = hull_from(g, s->right), link;
    while (seam_meets_before(g, s, s->right, up, &link)) {
        uint32_t t = mw__link_triangle(link), e = mw__link_edge(link),
                 k = ghost_corner(g, s->right);
        mw_facet *ghost = &g->facet[s->right];
        const mw_facet old = g->facet[t];
        uint32_t apex = old.v[mw__prev(e)], next = ghost->link[mw__prev(k)];
        g->facet[t] = (mw_facet){{apex, up, g->infinity}, {MW_NONE, MW_NONE, MW_NONE}};
        ghost->v[mw__prev(k)] = apex;
        ghosts_join(g, mw__link(s->right, mw__next(k)), old.link[mw__next(e)]);
        ghosts_join(g, mw__link(s->right, mw__prev(k)), mw__link(t, 2));
        ghosts_join(g, mw__link(t, 0), old.link[mw__prev(e)]);
        ghosts_join(g, mw__link(t, 1), next);
        up = apex;
    }
    return up;
}

/* The ghost at l becomes the triangle of l', l and r. */
static void seam_rise_left(mw_growth *g, seam *s, uint32_t up)
{
    uint32_t t = s->left, k = ghost_corner(g, t);
    s->left = hull_onward(g, t);
    g->facet[t].v[k] = s->r;
    ghosts_join(g, mw__link(t, mw__prev(k)), s->below);
    s->below = mw__link(t, k);
    s->l = up;
}

/* The ghost at r becomes the triangle of r, r' and l. */
static void seam_rise_right(mw_growth *g, seam *s, uint32_t up)
{
    uint32_t t = s->right, k = ghost_corner(g, t);
    s->right = hull_back(g, t);
    g->facet[t].v[k] = s->l;
    ghosts_join(g, mw__link(t, k), s->below);
    s->below = mw__link(t, mw__prev(k));
    s->r = up;
}

static void seam_close(mw_growth *g, seam *s, uint32_t spare)
{
    const mw_point *p = g->point;
    seam_go_to_tangent(g, s);
    seam_close_below(g, s, spare);
    for (;;) {
        uint32_t l = hull_to(g, s->left), r = hull_from(g, s->right);
        bool left = mw__orient2d(p[s->l], p[s->r], p[l]) > 0,
             right = mw__orient2d(p[s->l], p[s->r], p[r]) > 0;
        if (!left && !right) break;
        if (left) l = seam_clear_left(g, s);
        if (right) r = seam_clear_right(g, s);
        if (right && (!left || mw__incircle(p[s->l], p[s->r], p[l], p[r]) > 0))
            seam_rise_right(g, s, r);
        else
            seam_rise_left(g, s, l);
    }
    seam_close_above(g, s, spare + 1);
}

uint32_t mw__merge(mw_growth *g, uint32_t a, uint32_t b, uint32_t spare)
{
    hull_ends ea = hull_find_ends(g, a), eb = hull_find_ends(g, b);
    int axis = ghost_coordinate(g, ea.high[0], 0) < ghost_coordinate(g, eb.low[0], 0) ||
                       ghost_coordinate(g, eb.high[0], 0) < ghost_coordinate(g, ea.low[0], 0)
                   ? 0
                   : 1;
    bool a_first =
        ghost_coordinate(g, ea.high[axis], axis) < ghost_coordinate(g, eb.low[axis], axis);
    /* A horizontal line is turned upright by a quarter turn clockwise: what lies below it comes to
     * lie on the left. */
    uint32_t left = a_first ? ea.high[axis] : eb.high[axis],
             right = a_first ? eb.low[axis] : ea.low[axis];
    seam s = {.l = hull_from(g, left),
              .r = hull_from(g, right),
              .left = left,
              .right = hull_back(g, right)};
    seam_close(g, &s, spare);
    return spare + 1;
}
