/* convex.c - recognises a mesh that is its own tiling, without building anything.
 *
 * Claim. Let all triangles be counter-clockwise with an area. Let the two triangles of each inner
 * edge run along it in opposite directions. Let the border be one closed loop that turns left or
 * goes straight on at every vertex, and makes one full turn in all. Then the mesh is an embedding
 * and fills a convex polygon.
 *
 * Proof. A closed curve of edges with positive lengths that only turns left, once in all, bounds a
 * convex polygon and visits no point twice. The number of triangles over a point (on no edge) is
 * the sum of their winding numbers about it. Inner edges cancel. What remains is the winding number
 * of the border: 1 inside the polygon, 0 outside. So the interiors of the triangles are disjoint
 * and fill the polygon. Suppose a vertex v of one triangle lay inside an edge of another triangle,
 * or on another vertex. Follow the triangles round v from edge to edge. Either they close round v,
 * or they end at two border edges at v; then they fill the angle of the polygon there, since the
 * border visits this point once. In both cases the other triangle overlaps them. */
#include "tiling/convex.h"

static bool triangle_is_folded(const mw_mesh *mesh, uint32_t t)
{
    const mw_triangle *tri = &mesh->tri[t];
    for (uint32_t k = 0; k < 3; k++)
        if (tri->link[k] != MW_NONE &&
            mesh->tri[mw__link_triangle(tri->link[k])].v[mw__link_edge(tri->link[k])] == tri->v[k])
            return true;
    return false;
}

/* Do the two triangles of every inner edge run along it in opposite directions? Then *count becomes
 * the number of border edges. */
static bool mesh_is_unfolded(const mw_mesh *mesh, uint32_t *count)
{
    *count = mesh->border_count;
    if (mesh->opposite) return true; /* linking has checked it */
    *count = 0;
    for (uint32_t t = 0; t < mesh->tri_count; t++) {
        if (triangle_is_folded(mesh, t)) return false;
        for (uint32_t k = 0; k < 3; k++) *count += mesh->tri[t].link[k] == MW_NONE;
    }
    return true;
}

/* A border edge of a mesh that has some. */
static uint32_t mesh_any_border_edge(const mw_mesh *mesh)
{
    for (uint32_t t = 0;; t++)
        for (uint32_t k = 0; k < 3; k++)
            if (mesh->tri[t].link[k] == MW_NONE) return mw__link(t, k);
}

/* The border edge after border edge h: turn round its end, from triangle to triangle, to the
 * border. */
static uint32_t mesh_next_border_edge(const mw_mesh *mesh, uint32_t h)
{
    for (;;) {
        h = mw__half_next(h);
        uint32_t across = mesh->tri[mw__link_triangle(h)].link[mw__link_edge(h)];
        if (across == MW_NONE) return h;
        h = across;
    }
}

/* A direction with an angle in (-pi/2, pi/2] is rising, any other is falling. One full turn changes
 * between them twice. */
static bool direction_is_rising(mw_point a, mw_point b)
{
    return a.x < b.x || (a.x == b.x && a.y < b.y);
}

/* Does the border loop through edge h only turn left, once in all, and have all `count` border
 * edges? */
static bool loop_is_convex(const mw_mesh *mesh, uint32_t h, uint32_t count)
{
    const mw_triangle *t = &mesh->tri[mw__link_triangle(h)];
    mw_point a = mesh->point[t->v[mw__link_edge(h)]], b = mesh->point[t->v[mw__link_edge(h) + 1]];
    bool rising = direction_is_rising(a, b);
    uint32_t changes = 0, first = h;
    do {
        if (count-- == 0) return false;
        h = mesh_next_border_edge(mesh, h);
        mw_point c = mesh->point[mesh->tri[mw__link_triangle(h)].v[mw__link_edge(h) + 1]];
        bool rises = direction_is_rising(b, c);
        double turn = mw__orient2d(a, b, c);
        /* The second case: straight back. */
        if (turn < 0 || (turn == 0 && rises != rising)) return false;
        changes += rises != rising;
        rising = rises;
        a = b;
        b = c;
    } while (h != first);
    return count == 0 && changes == 2;
}

bool mw__mesh_is_convex(const mw_mesh *mesh)
{
    /* Unusable triangles count as flat. */
    if (mesh->flat_count > 0 || mesh->tri_count == 0) return false;
    uint32_t count;
    return mesh_is_unfolded(mesh, &count) && count > 0 &&
           loop_is_convex(mesh, mesh_any_border_edge(mesh), count);
}
