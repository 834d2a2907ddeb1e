/* borrowed_outline.c - does the caller's mesh fill its convex hull?
 *
 * It does, and nothing overlaps, if its border is one loop that goes round a convex polygon once.
 * To see why, add up the boundaries of all triangles, each counter-clockwise. Two triangles lie on
 * different sides of their common edge, so it is passed once in each direction and cancels out.
 * What is left is the border. So the number of triangles over a point is how often the border winds
 * round it: 1 in the polygon, 0 outside. Triangles without an area cover nothing; the check has
 * seen that they lie between their neighbours, so that their edges cancel out, too. */
#include "borrow/borrowed.h"

/* An edge of a tile from vertex a to b; the tile lies to its left, s is its third corner. By number
 * of the corner in the tile. */
typedef struct outline_edge {
    mw_borrowed_tile tile;
    uint32_t t, a, b, s;
} outline_edge;

static mw_point outline_from(const outline_edge *e)
{
    return e->tile.p[e->a];
}

static mw_point outline_to(const outline_edge *e)
{
    return e->tile.p[e->b];
}

/* From a border edge to the next one: round the vertex where it ends. False where links are wrong.
 */
static bool outline_step(const mw_borrowed *mesh, outline_edge *e)
{
    for (uint32_t turns = 0; turns < mesh->tri_count; turns++) {
        uint32_t a = e->a, b = e->b, s = e->s, across = mw__borrowed_across(mesh, e->t, a);
        if (across == MW_NONE) {
            *e = (outline_edge){e->tile, e->t, b, s, a};
            return true;
        }
        uint32_t from = e->tile.v[b], to = e->tile.v[s];
        if (!mw__borrowed_read(mesh, across, &e->tile)) return false;
        uint32_t apex = mw__borrowed_apex(&e->tile, from, to);
        if (apex == 3) return false;
        /* the tile beyond has the edge from `to` to `from` to its right, then goes on from there */
        e->t = across;
        e->s = apex;
        e->b = e->tile.v[mw__next(apex)] == from ? mw__next(apex) : mw__prev(apex);
        e->a = 3 - e->b - apex;
    }
    return false;
}

/* Does an edge lead to the right, or, if it is vertical, up? */
static bool outline_leads_on(mw_point from, mw_point to)
{
    return from.x != to.x ? from.x < to.x : from.y < to.y;
}

bool mw__borrowed_is_convex(const mw_borrowed *mesh, uint32_t first, uint32_t k, uint32_t borders)
{
    outline_edge e = {.t = first, .a = mw__next(k), .b = mw__prev(k), .s = k};
    if (!mw__borrowed_read(mesh, first, &e.tile)) return false;
    if (mw__orient2d(e.tile.p[e.a], e.tile.p[e.b], e.tile.p[e.s]) < 0)
        e = (outline_edge){e.tile, e.t, e.b, e.a, e.s};
    uint32_t start = e.tile.v[e.a], next = e.tile.v[e.b], switches = 0, passed = 0;
    do {
        mw_point a = outline_from(&e), b = outline_to(&e);
        if (!outline_step(mesh, &e) || ++passed > borders) return false;
        mw_point c = outline_to(&e);
        bool on = outline_leads_on(a, b), goes_on = outline_leads_on(b, c);
        double turn = mw__orient2d(a, b, c);
        if (turn < 0 || (turn == 0 && on != goes_on)) return false;
        switches += on != goes_on;
    } while (e.tile.v[e.a] != start || e.tile.v[e.b] != next);
    return passed == borders && switches == 2; /* once round */
}
