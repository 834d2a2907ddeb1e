/* convex.c - recognise, without building anything, the mesh that needs no completion.
 *
 * Claim: let all triangles be counter-clockwise with an area, let every inner edge be run through in opposite
 * directions by its two triangles, and let the border be one closed loop that turns left (or goes straight on) at every
 * vertex, and once in all. Then the mesh is an embedding and fills a convex polygon.
 *
 * A closed curve of positive lengths that turns left only, once in all, bounds a convex polygon and visits no point
 * twice. The number of triangles over a point (on no edge) is the sum of their winding numbers about it; inner edges
 * cancel, what remains is the winding number of the border: 1 inside the polygon, 0 outside. So the insides of the
 * triangles are disjoint and fill the polygon. Suppose a vertex v of one triangle lay inside an edge of another, or on
 * another vertex: the triangles round v, passed from edge to edge, either turn fully round v, or end at two border
 * edges at v and then fill the polygon's angle there, since the border visits v's place once; either way the other
 * triangle overlaps them. */
#include "domain/convex.h"

static bool is_folded(const mw_mesh *mesh, uint32_t t)
{
    const mw_triangle *tri = &mesh->tri[t];
    for (uint32_t k = 0; k < 3; k++)
        if (tri->link[k] != MW_NONE &&
            mesh->tri[mw__link_triangle(tri->link[k])].v[mw__link_edge(tri->link[k])] == tri->v[k])
            return true;
    return false;
}

/* Is every inner edge run through in opposite directions? Then *count becomes the number of the others. */
static bool is_unfolded(const mw_mesh *mesh, uint32_t *count)
{
    *count = mesh->border_count;
    if (mesh->opposite) return true; /* whoever linked the triangles has seen it */
    *count = 0;
    for (uint32_t t = 0; t < mesh->tri_count; t++) {
        if (is_folded(mesh, t)) return false;
        for (uint32_t k = 0; k < 3; k++) *count += mesh->tri[t].link[k] == MW_NONE;
    }
    return true;
}

/* A border edge, of a mesh that has some. */
static uint32_t find_border(const mw_mesh *mesh)
{
    for (uint32_t t = 0;; t++)
        for (uint32_t k = 0; k < 3; k++)
            if (mesh->tri[t].link[k] == MW_NONE) return mw__link(t, k);
}

/* The border edge that follows border edge h: turn round its end, from triangle to triangle, to the border again. */
static uint32_t next_border(const mw_mesh *mesh, uint32_t h)
{
    for (;;) {
        h = mw__half_next(h);
        uint32_t across = mesh->tri[mw__link_triangle(h)].link[mw__link_edge(h)];
        if (across == MW_NONE) return h;
        h = across;
    }
}

/* Directions of an angle in (-pi/2, pi/2] are rising, the others falling: one turn changes between them twice. */
static bool is_rising(mw_point a, mw_point b)
{
    return a.x < b.x || (a.x == b.x && a.y < b.y);
}

/* Does the border loop through edge h turn left, once in all, and take in all `count` border edges? */
static bool loop_is_convex(const mw_mesh *mesh, uint32_t h, uint32_t count)
{
    const mw_triangle *t = &mesh->tri[mw__link_triangle(h)];
    mw_point a = mesh->point[t->v[mw__link_edge(h)]], b = mesh->point[t->v[mw__link_edge(h) + 1]];
    bool rising = is_rising(a, b);
    uint32_t changes = 0, first = h;
    do {
        if (count-- == 0) return false;
        h = next_border(mesh, h);
        mw_point c = mesh->point[mesh->tri[mw__link_triangle(h)].v[mw__link_edge(h) + 1]];
        bool rises = is_rising(b, c);
        double turn = mw__orient2d(a, b, c);
        if (turn < 0 || (turn == 0 && rises != rising)) return false; /* the latter: straight back */
        changes += rises != rising;
        rising = rises;
        a = b;
        b = c;
    } while (h != first);
    return count == 0 && changes == 2;
}

bool mw__convex(const mw_mesh *mesh)
{
    if (mesh->flat_count > 0 || mesh->tri_count == 0) return false; /* what is not usable is flat, too */
    uint32_t count;
    return is_unfolded(mesh, &count) && count > 0 && loop_is_convex(mesh, find_border(mesh), count);
}
