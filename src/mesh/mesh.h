/* mesh.h - the records of a planar mesh. Private.
 *
 *              2            Edge k of a triangle joins its vertices k and k+1 (mod 3); the apex of edge k is vertex
 *             / \           k+2. Triangles are stored counter-clockwise, so that their inside lies to the left of each
 *        e2  /   \  e1      edge. A link names the triangle across an edge and the edge there in one number:
 *           /     \         4 * triangle + edge; MW_NONE where there is none.
 *          0-------1        A triangle that the user gave clockwise is stored with vertices 1 and 2 exchanged and is
 *             e0            marked MW_FLIPPED. */
#ifndef MW_SRC_MESH_H
#define MW_SRC_MESH_H

#include "base/base.h"
#include "predicates/predicates.h"

#include <meshwalk/mesh.h>

/* 32 bytes, two to a cache line (mw__alloc_lines). v[3] repeats v[0], so that edge k is v[k], v[k + 1] without a
 * modulo. */
typedef struct mw_triangle {
    uint32_t v[4];
    uint32_t link[3];
    uint32_t user; /* the user's number of the triangle, and marks in the two upper bits */
} mw_triangle;

#define MW_FLIPPED (UINT32_C(1) << 31) /* vertices 1 and 2 are exchanged against the user's order                  */
#define MW_GHOST (UINT32_C(1) << 30)   /* no triangle of the user's: fills a hole (the number below) or a pocket   */
#define MW_USER_MASK (MW_GHOST - 1)
#define MW_POCKET MW_USER_MASK /* number of a ghost that lies in no hole but between border and hull       */

static MW_INLINE uint32_t mw__next(uint32_t k)
{
    return (9u >> (2 * k)) & 3; /* 1, 2, 0 looked up: a jump would be guessed wrong every third time */
}
static MW_INLINE uint32_t mw__prev(uint32_t k)
{
    return (18u >> (2 * k)) & 3; /* 2, 0, 1 */
}
static MW_INLINE uint32_t mw__link(uint32_t triangle, uint32_t edge)
{
    return triangle << 2 | edge;
}
static MW_INLINE uint32_t mw__link_triangle(uint32_t link)
{
    return link >> 2;
}
static MW_INLINE uint32_t mw__link_edge(uint32_t link)
{
    return link & 3;
}

/* The edge after a half-edge, given as a link, round its triangle, and the one before. */
static MW_INLINE uint32_t mw__half_next(uint32_t half)
{
    return mw__link(mw__link_triangle(half), mw__next(mw__link_edge(half)));
}
static MW_INLINE uint32_t mw__half_prev(uint32_t half)
{
    return mw__link(mw__link_triangle(half), mw__prev(mw__link_edge(half)));
}

/* Of a half-edge: the vertices where it starts and ends, and what it is linked to. */
static MW_INLINE uint32_t mw__half_start(const mw_triangle *tri, uint32_t half)
{
    return tri[mw__link_triangle(half)].v[mw__link_edge(half)];
}
static MW_INLINE uint32_t mw__half_end(const mw_triangle *tri, uint32_t half)
{
    return tri[mw__link_triangle(half)].v[mw__link_edge(half) + 1];
}
static MW_INLINE uint32_t mw__half_link(const mw_triangle *tri, uint32_t half)
{
    return tri[mw__link_triangle(half)].link[mw__link_edge(half)];
}

/* Edge k of a stored triangle as the user numbers it, and vertex k. */
static MW_INLINE uint32_t mw__user_edge(uint32_t user, uint32_t k)
{
    return user & MW_FLIPPED ? 2 - k : k;
}
static MW_INLINE uint32_t mw__user_vertex(uint32_t user, uint32_t k)
{
    return user & MW_FLIPPED ? (3 - k) % 3 : k;
}

typedef struct mw_field {
    char *name;
    double *values;
} mw_field;

/* Vertices and triangles may be in another order than the user's, laid out along a curve (layout.h). Within the library they
 * go by their places in these arrays; users know their own numbers only. */
struct mw_mesh {
    mw_point *point;
    mw_triangle *tri; /* tri[t].user is the user's number, with MW_FLIPPED where it applies; flat ones are among them */
    uint32_t *triangle_place; /* per triangle by the user's number: its place; NULL: they are the same  */
    uint32_t *vertex_place;   /* per vertex by the user's number: its place; NULL: they are the same    */
    uint32_t *users_vertex;   /* per vertex by its place: the user's number; NULL with vertex_place     */
    uint32_t point_count, tri_count;
    uint32_t flat_count, flipped_count;
    mw_field *field;
    size_t field_count;
    uint32_t border_count; /* edges without link, where `opposite` is set */
    bool opposite; /* both triangles of each edge run through it in opposite directions; false: it is not known */
    bool tolerant; /* may hold triangles that are not usable: see mw_mesh_options */
};

static MW_INLINE uint32_t mw__triangle_place(const mw_mesh *mesh, uint32_t users)
{
    return mesh->triangle_place ? mesh->triangle_place[users] : users;
}
static MW_INLINE uint32_t mw__vertex_place(const mw_mesh *mesh, uint32_t users)
{
    return mesh->vertex_place ? mesh->vertex_place[users] : users;
}
static MW_INLINE uint32_t mw__users_triangle(const mw_mesh *mesh, uint32_t place)
{
    return mesh->tri[place].user & MW_USER_MASK;
}
static MW_INLINE uint32_t mw__users_vertex(const mw_mesh *mesh, uint32_t place)
{
    return mesh->users_vertex ? mesh->users_vertex[place] : place;
}

/* Of three vertices, the lowest and the one between. */
static MW_INLINE uint32_t mw__lowest(uint32_t a, uint32_t b, uint32_t c)
{
    uint32_t low = a < b ? a : b;
    return c < low ? c : low;
}
static MW_INLINE uint32_t mw__middle_of(uint32_t a, uint32_t b, uint32_t c)
{
    uint32_t low = a < b ? a : b, high = a < b ? b : a;
    if (c < high) high = c;
    return high > low ? high : low;
}

static MW_INLINE bool mw__is_finite(mw_point p)
{
    return isfinite(p.x) && isfinite(p.y);
}

static MW_INLINE bool mw__points_equal(mw_point a, mw_point b)
{
    return a.x == b.x && a.y == b.y;
}

/* One that names a vertex twice has no edges to speak of. */
static MW_INLINE bool mw__has_three_vertices(const mw_triangle *t)
{
    return t->v[0] != t->v[1] && t->v[1] != t->v[2] && t->v[2] != t->v[0];
}

/* Has a triangle, as stored, an area? Flat ones have none, nor have those with a vertex that is not finite. */
static MW_INLINE bool mw__has_area(const mw_point *point, const mw_triangle *t)
{
    return mw__orient2d(point[t->v[0]], point[t->v[1]], point[t->v[2]]) > 0;
}

#endif
