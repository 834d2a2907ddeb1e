/* mesh.h - the records of a planar mesh. Private.
 *
 *              2            Edge k of a triangle joins its vertices k and k+1 (mod 3); the apex of
 *             / \           edge k is vertex k+2. Triangles are stored counter-clockwise, so that
 *        e2  /   \  e1      their interior lies to the left of each edge. A link names the triangle
 *           /     \         across an edge and the edge there in one number: 4 * triangle + edge;
 *          0-------1        MW_NONE where there is none. A triangle that the user gave clockwise is
 *             e0            stored with vertices 1 and 2 exchanged and marked MW_REVERSED. */
#ifndef MW_SRC_MESH_MESH_H
#define MW_SRC_MESH_MESH_H

#include "base/base.h"
#include "predicates/predicates.h"

#include <meshwalk/mesh.h>

/* 32 bytes, two in a cache line (mw__alloc_lines). v[3] repeats v[0], so that edge k is v[k], v[k +
 * 1] without a modulo. */
typedef struct mw_triangle {
    uint32_t v[4];
    uint32_t link[3];
    uint32_t user; /* the user's number, and marks in the two upper bits */
} mw_triangle;

#define MW_REVERSED (UINT32_C(1) << 31) /* the user gave vertices 1 and 2 in the other order */
/* Not a triangle of the user: it fills a hole (the number below) or a pocket. */
#define MW_GHOST (UINT32_C(1) << 30)
#define MW_USER_MASK (MW_GHOST - 1)
/* Number of a ghost in a pocket: outside the mesh, but inside its hull. */
#define MW_POCKET MW_USER_MASK

static MW_INLINE uint32_t mw__next(uint32_t k)
{
    /* 1, 2, 0 from a table: a branch would be mispredicted every third time. */
    return (9u >> (2 * k)) & 3;
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

/* The half-edges after and before a half-edge in its triangle. */
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

/* The user's number of edge k, or vertex k, of a stored triangle. */
static MW_INLINE uint32_t mw__user_local_edge(uint32_t user, uint32_t k)
{
    return user & MW_REVERSED ? 2 - k : k;
}
static MW_INLINE uint32_t mw__user_local_vertex(uint32_t user, uint32_t k)
{
    return user & MW_REVERSED ? (3 - k) % 3 : k;
}

typedef struct mw_field {
    char *name;
    double *values;
    bool borrowed; /* name and values belong to a mapped file, and are never written */
} mw_field;

/* The library may store vertices and triangles in another order than the user's, along a curve
 * (layout.h). A slot is an index into these arrays. Inside the library, vertices and triangles go
 * by slot; users only see their own numbers. */
struct mw_mesh {
    mw_point *point;
    /* tri[t].user: the user's number, and MW_REVERSED where it applies; includes flat triangles. */
    mw_triangle *tri;
    uint32_t *triangle_slot; /* slot of a triangle by its number; NULL: slots are numbers */
    uint32_t *vertex_slot;   /* slot of a vertex by its number; NULL: slots are numbers */
    uint32_t *vertex_number; /* number of a vertex by its slot; NULL together with vertex_slot */
    uint32_t point_count, tri_count;
    uint32_t flat_count, reversed_count;
    mw_field *field;
    size_t field_count;
    uint32_t border_count; /* edges without a link; set where `opposite` is */
    /* The two triangles of each edge run along it in opposite directions; false: not known. */
    bool opposite;
    bool tolerant; /* may have unusable triangles: see mw_mesh_options */
};

/* Release the fields of a mesh, and their list. */
void mw__mesh_release_fields(mw_mesh *mesh);

static MW_INLINE uint32_t mw__triangle_slot(const mw_mesh *mesh, uint32_t number)
{
    return mesh->triangle_slot ? mesh->triangle_slot[number] : number;
}
static MW_INLINE uint32_t mw__vertex_slot(const mw_mesh *mesh, uint32_t number)
{
    return mesh->vertex_slot ? mesh->vertex_slot[number] : number;
}
static MW_INLINE uint32_t mw__triangle_number(const mw_mesh *mesh, uint32_t slot)
{
    return mesh->tri[slot].user & MW_USER_MASK;
}
static MW_INLINE uint32_t mw__vertex_number(const mw_mesh *mesh, uint32_t slot)
{
    return mesh->vertex_number ? mesh->vertex_number[slot] : slot;
}

/* The lowest, and the middle one, of three vertices. */
static MW_INLINE uint32_t mw__lowest_of_three(uint32_t a, uint32_t b, uint32_t c)
{
    uint32_t low = a < b ? a : b;
    return c < low ? c : low;
}
static MW_INLINE uint32_t mw__middle_of_three(uint32_t a, uint32_t b, uint32_t c)
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

/* False for a triangle that names a vertex twice; it has no edges. */
static MW_INLINE bool mw__has_three_vertices(const mw_triangle *t)
{
    return t->v[0] != t->v[1] && t->v[1] != t->v[2] && t->v[2] != t->v[0];
}

/* Does a stored triangle have an area? Flat triangles do not, nor do those with a vertex that is
 * not finite. */
static MW_INLINE bool mw__has_area(const mw_point *point, const mw_triangle *t)
{
    return mw__orient2d(point[t->v[0]], point[t->v[1]], point[t->v[2]]) > 0;
}

#endif
