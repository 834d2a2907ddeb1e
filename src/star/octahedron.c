/* octahedron.c - down through the subdivisions of a regular octahedron [Wu et al. 2007; thesis App. F, sec. 7].
 *
 *            2              A triangle has four children, whose new corners are the middles of its edges, moved out to
 *           / \             the sphere: on the great circles of the edges, so the children cover just their parent. A
 *          /---\            query walks through the 32 triangles of the first subdivision, always from the same one,
 *         / \ / \           then goes down: in each triangle to the middle child first, and, if it lies beyond one of
 *        0-------1          its edges, to the corner child there. It begins in the facet in the middle of the finest.
 * All this is a barycentric walk, over the edge of the least of three determinants, with three tests a triangle, and
 * counted so. But below the first subdivision the outcome of those in a corner child is known, so they are not made.
 * 4.50 triangles for the first subdivision, 1.73, 1.74 and then 1.75 a level for uniform directions: the published
 * counts. To go down from the octahedron itself, which takes 2.5, would save 0.35. A query walks there only where it is
 * not subdivided.
 * A face needs no orientation: mirrored to where its coordinates are positive, each is the same triangle. */
#include "star/index.h"

#include <stdlib.h>

typedef struct corners {
    double v[3][3];
} corners;

static const corners face = {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};

/* det(a, b, q): negative where q lies beyond the edge ab. */
static double determinant(const double a[3], const double b[3], const double q[3])
{
    return q[0] * (a[1] * b[2] - a[2] * b[1]) + q[1] * (a[2] * b[0] - a[0] * b[2]) + q[2] * (a[0] * b[1] - a[1] * b[0]);
}

static void middle(const double a[3], const double b[3], double m[3])
{
    for (int k = 0; k < 3; k++) m[k] = a[k] + b[k];
    double scale = 1 / sqrt(m[0] * m[0] + m[1] * m[1] + m[2] * m[2]);
    for (int k = 0; k < 3; k++) m[k] *= scale;
}

/* The middle child: its corner k lies on edge k. */
static corners middle_child(const corners *parent)
{
    corners child;
    for (uint32_t k = 0; k < 3; k++) middle(parent->v[k], parent->v[mw__next(k)], child.v[k]);
    return child;
}

/* The corner child at corner k of a triangle. */
static corners corner_child(const corners *parent, const corners *inner, uint32_t k)
{
    const double *part[3] = {parent->v[k], inner->v[k], inner->v[mw__prev(k)]};
    corners child;
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++) child.v[i][j] = part[i][j];
    return child;
}

static void fill(mw_star_octahedron *octahedron, const mw_star *star, const corners *triangle, uint32_t level,
                 uint32_t cell, uint32_t *t)
{
    if (level == octahedron->levels) {
        uint32_t octant = cell >> (2 * level);
        double d[3];
        for (int k = 0; k < 3; k++) {
            d[k] = triangle->v[0][k] + triangle->v[1][k] + triangle->v[2][k];
            if (octant >> k & 1) d[k] = -d[k];
        }
        *t = octahedron->facet[cell] = mw__star_facet(star, d, *t);
        return;
    }
    corners inner = middle_child(triangle);
    fill(octahedron, star, &inner, level + 1, 4 * cell, t);
    for (uint32_t k = 0; k < 3; k++) {
        corners child = corner_child(triangle, &inner, k);
        fill(octahedron, star, &child, level + 1, 4 * cell + 1 + k, t);
    }
}

bool mw__star_octahedron_create(mw_star_octahedron *octahedron, const mw_star *star, uint32_t levels)
{
    octahedron->levels = levels;
    octahedron->facet = mw__alloc(mw__star_octahedron_cells(levels), sizeof *octahedron->facet);
    uint32_t t = 0;
    for (uint32_t octant = 0; octahedron->facet && octant < 8; octant++) fill(octahedron, star, &face, 0, octant, &t);
    return octahedron->facet;
}

void mw__star_octahedron_release(mw_star_octahedron *octahedron)
{
    free(octahedron->facet);
}

/* Counts the visit of a triangle. */
static void visit(mw_star_work *work)
{
    if (!work) return;
    work->triangles[MW_STAR_STAGE_INIT]++;
    work->orient[MW_STAR_STAGE_INIT] += 3;
}

static uint32_t least(const double value[3])
{
    uint32_t k = value[1] < value[0] ? 1 : 0;
    return value[2] < value[k] ? 2 : k;
}

/* Where a query stands among the 8 faces, or in the 32 triangles of their first subdivision. */
typedef struct place {
    double q[3]; /* the query, mirrored as its face is to the first one */
    uint32_t octant;
    uint32_t child; /* as in the number of a cell: 0 the middle one, 1 + k that at corner k */
} place;

/* Over the face's edge opposite to corner k, into its mirror image. */
static void cross_edge(place *at, uint32_t k)
{
    at->q[k] = -at->q[k];
    at->octant ^= 1u << k;
}

/* To the face that holds the query. The coordinates are the determinants. */
static void find_face(place *at, mw_star_work *work)
{
    uint32_t k;
    visit(work);
    while (k = least(at->q), at->q[k] < 0) {
        cross_edge(at, k);
        visit(work);
    }
}

/* In the first subdivision, the determinant of the edge that cuts off corner k, as the middle child has it. Rounded, too,
 * that of the corner child is its negative. */
static double cut(const double q[3], uint32_t k)
{
    return (q[mw__next(k)] + q[mw__prev(k)] - q[k]) / 2;
}

/* One step of the walk in the first subdivision; false: the query is here. */
static bool step(place *at)
{
    const double half_root = 0.70710678118654752; /* det(a, m, q) for det(a, b, q), with m = (a + b) / sqrt(2) */
    const double *q = at->q;
    double value[3];
    for (uint32_t k = 0; k < 3; k++) value[k] = at->child ? half_root * q[k] : cut(q, k);
    uint32_t corner = at->child - 1;
    if (at->child) value[corner] = -cut(q, corner);
    uint32_t k = least(value);
    if (!(value[k] < 0)) return false;
    if (at->child == 0)
        at->child = 1 + k;
    else if (k == corner)
        at->child = 0;
    else
        cross_edge(at, k);
    return true;
}

/* To the triangle of the first subdivision that holds the query. A coordinate changes its sign once at most, and between
 * such changes no triangle comes twice, so this ends whatever is rounded. */
static void find_child(place *at, mw_star_work *work)
{
    do visit(work);
    while (step(at));
}

uint32_t mw__star_octahedron_cell(const mw_star_octahedron *octahedron, const double d[3], mw_star_work *work)
{
    place at = {.q = {d[0], d[1], d[2]}};
    if (octahedron->levels == 0) {
        find_face(&at, work);
        return at.octant;
    }
    find_child(&at, work);
    uint32_t cell = 4 * at.octant + at.child;
    corners inner = middle_child(&face), triangle = at.child ? corner_child(&face, &inner, at.child - 1) : inner;
    for (uint32_t level = 1; level < octahedron->levels; level++) {
        double value[3];
        inner = middle_child(&triangle);
        for (uint32_t k = 0; k < 3; k++) value[k] = determinant(inner.v[mw__prev(k)], inner.v[k], at.q);
        uint32_t k = least(value); /* the edge that cuts off corner k */
        visit(work);
        if (value[k] < 0) visit(work);
        triangle = value[k] < 0 ? corner_child(&triangle, &inner, k) : inner;
        cell = 4 * cell + (value[k] < 0 ? 1 + k : 0);
    }
    return cell;
}
