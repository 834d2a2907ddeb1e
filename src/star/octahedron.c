/* octahedron.c - down through the subdivisions of a regular octahedron [Wu et al. 2007; thesis App. F, sec. 7].
 *
 *            2              A triangle has four children, whose new corners are the middles of its edges, moved out to
 *           / \             the sphere: on the great circles of the edges, so the children cover just their parent. A
 *          /---\            query walks to a face of the octahedron, always from the same one, then goes down: in each
 *         / \ / \           triangle to the middle child first, and, if it lies beyond one of its edges, to the corner
 *        0-------1          child there. It begins in the facet in the middle of the finest triangle.
 * All this is a barycentric walk, over the edge of the least of three determinants, with three tests a triangle, and
 * counted so. But the outcome of those in a corner child is known, so they are not made. 2.5 triangles for the face;
 * 1.65, 1.73 and then 1.75 a level for uniform directions.
 * The face needs no orientation: mirrored to where its coordinates are positive, each is the same triangle. */
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

/* To the octant of d, from the first one; q becomes d mirrored to that. The coordinates are the determinants. */
static uint32_t find_octant(const double d[3], double q[3], mw_star_work *work)
{
    uint32_t octant = 0, k;
    for (k = 0; k < 3; k++) q[k] = d[k];
    visit(work);
    while (k = least(q), q[k] < 0) {
        q[k] = -q[k];
        octant |= 1u << k;
        visit(work);
    }
    return octant;
}

uint32_t mw__star_octahedron_cell(const mw_star_octahedron *octahedron, const double d[3], mw_star_work *work)
{
    double q[3];
    uint32_t cell = find_octant(d, q, work);
    corners triangle = face;
    for (uint32_t level = 0; level < octahedron->levels; level++) {
        corners inner = middle_child(&triangle);
        double value[3];
        for (uint32_t k = 0; k < 3; k++) value[k] = determinant(inner.v[mw__prev(k)], inner.v[k], q);
        uint32_t k = least(value); /* the edge that cuts off corner k */
        visit(work);
        if (value[k] < 0) visit(work);
        triangle = value[k] < 0 ? corner_child(&triangle, &inner, k) : inner;
        cell = 4 * cell + (value[k] < 0 ? 1 + k : 0);
    }
    return cell;
}
