/* star_octahedron.c - descends the subdivisions of a regular octahedron [Wu, He, Tian 2005; thesis
 * App. F, sec. 7].
 *
 *            2              A triangle has four children. Their new corners are the middles of its
 *           / \             edges, moved out to the sphere. They stay on the great circles of the
 *          /---\            edges, so the children cover exactly their parent. A query walks
 *         / \ / \           through the 32 triangles of the first subdivision, always from the
 *        0-------1          same one. Then it descends: in each triangle it goes to the middle
 *                           child, and if it lies beyond one of its edges, to the corner child
 *                           there. It starts in the facet in the middle of the finest triangle.
 *
 * All this is a barycentric walk, over the edge of the least of three determinants, with three
 * tests a triangle, and counted so. But below the first subdivision the results of the tests in a
 * corner child are known, so these tests are not made. Counts for uniform directions: 4.50
 * triangles for the first subdivision, then 1.73, 1.74 and 1.75 a level, as published. Descending
 * from the octahedron itself, which takes 2.5, would save 0.35. A query only walks there if the
 * octahedron is not subdivided.
 *
 * A face needs no orientation: mirrored to positive coordinates, all faces are the same
 * triangle. */
#include "star/star_index.h"

#include <stdlib.h>

typedef struct octahedron_corners {
    double v[3][3];
} octahedron_corners;

static const octahedron_corners face = {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};

/* det(a, b, q): negative if q lies beyond the edge ab. */
static double edge_determinant(const double a[3], const double b[3], const double q[3])
{
    return q[0] * (a[1] * b[2] - a[2] * b[1]) + q[1] * (a[2] * b[0] - a[0] * b[2]) +
           q[2] * (a[0] * b[1] - a[1] * b[0]);
}

static void arc_middle(const double a[3], const double b[3], double m[3])
{
    for (int k = 0; k < 3; k++) m[k] = a[k] + b[k];
    double scale = 1 / sqrt(m[0] * m[0] + m[1] * m[1] + m[2] * m[2]);
    for (int k = 0; k < 3; k++) m[k] *= scale;
}

/* The middle child: its corner k lies on edge k. */
static octahedron_corners octahedron_middle_child(const octahedron_corners *parent)
{
    octahedron_corners child;
    for (uint32_t k = 0; k < 3; k++) arc_middle(parent->v[k], parent->v[mw__next(k)], child.v[k]);
    return child;
}

/* The corner child at corner k of a triangle. */
static octahedron_corners octahedron_corner_child(const octahedron_corners *parent,
                                                  const octahedron_corners *inner, uint32_t k)
{
    const double *part[3] = {parent->v[k], inner->v[k], inner->v[mw__prev(k)]};
    octahedron_corners child;
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++) child.v[i][j] = part[i][j];
    return child;
}

typedef struct octahedron_filling {
    mw_star_octahedron *octahedron;
    const mw_star *star;
    mw_job *job;
    uint32_t t;      /* the facet of the last cell */
    uint32_t filled; /* cells */
} octahedron_filling;

/* The direction to the middle of a triangle in an octant. */
static void octahedron_cell_middle(const octahedron_corners *triangle, uint32_t octant, double d[3])
{
    for (int k = 0; k < 3; k++) {
        d[k] = triangle->v[0][k] + triangle->v[1][k] + triangle->v[2][k];
        if (octant >> k & 1) d[k] = -d[k];
    }
}

/* Returns false if the job is to stop. */
static bool octahedron_fill(octahedron_filling *f, const octahedron_corners *triangle,
                            uint32_t level, uint32_t cell)
{
    if (level == f->octahedron->levels) {
        double d[3];
        octahedron_cell_middle(triangle, cell >> (2 * level), d);
        f->t = f->octahedron->facet[cell] = mw__star_facet_along(f->star, d, f->t);
        return mw__job_step(f->job, ++f->filled, mw__star_octahedron_cells(level));
    }
    octahedron_corners inner = octahedron_middle_child(triangle);
    bool done = octahedron_fill(f, &inner, level + 1, 4 * cell);
    for (uint32_t k = 0; k < 3 && done; k++) {
        octahedron_corners child = octahedron_corner_child(triangle, &inner, k);
        done = octahedron_fill(f, &child, level + 1, 4 * cell + 1 + k);
    }
    return done;
}

bool mw__star_octahedron_create(mw_star_octahedron *octahedron, const mw_star *star,
                                uint32_t levels, mw_job *job)
{
    octahedron->levels = levels;
    octahedron->facet = mw__alloc(mw__star_octahedron_cells(levels), sizeof *octahedron->facet);
    octahedron_filling filling = {.octahedron = octahedron, .star = star, .job = job};
    bool done = octahedron->facet;
    for (uint32_t octant = 0; done && octant < 8; octant++)
        done = octahedron_fill(&filling, &face, 0, octant);
    return done;
}

void mw__star_octahedron_release(mw_star_octahedron *octahedron)
{
    free(octahedron->facet);
}

/* Count the visit of a triangle. */
static void octahedron_visit(mw_star_work *work)
{
    if (!work) return;
    work->triangles[MW_STAR_STAGE_INIT]++;
    work->orient[MW_STAR_STAGE_INIT] += 3;
}

static uint32_t least_of(const double value[3])
{
    uint32_t k = value[1] < value[0] ? 1 : 0;
    return value[2] < value[k] ? 2 : k;
}

/* The position of a query among the 8 faces, or the 32 triangles of their first subdivision. */
typedef struct octahedron_position {
    double q[3]; /* the query, mirrored like its face to the first face */
    uint32_t octant;
    uint32_t child; /* as in cell numbers: 0 is the middle child, 1 + k that at corner k */
} octahedron_position;

/* Cross the edge of the face opposite to corner k, into its mirror image. */
static void octahedron_cross_edge(octahedron_position *at, uint32_t k)
{
    at->q[k] = -at->q[k];
    at->octant ^= 1u << k;
}

/* Walk to the face that contains the query. The coordinates are the determinants. */
static void octahedron_find_face(octahedron_position *at, mw_star_work *work)
{
    uint32_t k;
    octahedron_visit(work);
    while (k = least_of(at->q), at->q[k] < 0) {
        octahedron_cross_edge(at, k);
        octahedron_visit(work);
    }
}

/* In the first subdivision, the determinant of the edge that cuts off corner k, for the middle
 * child. For the corner child it is exactly the negative, also after rounding. */
static double octahedron_cut(const double q[3], uint32_t k)
{
    return (q[mw__next(k)] + q[mw__prev(k)] - q[k]) / 2;
}

/* One step of the walk in the first subdivision. Returns false if the query is here. */
static bool octahedron_step(octahedron_position *at)
{
    /* det(a, m, q) for det(a, b, q), with m = (a + b) / sqrt(2). */
    const double half_root = 0.70710678118654752;
    const double *q = at->q;
    double value[3];
    for (uint32_t k = 0; k < 3; k++) value[k] = at->child ? half_root * q[k] : octahedron_cut(q, k);
    uint32_t corner = at->child - 1;
    if (at->child) value[corner] = -octahedron_cut(q, corner);
    uint32_t k = least_of(value);
    if (!(value[k] < 0)) return false;
    if (at->child == 0)
        at->child = 1 + k;
    else if (k == corner)
        at->child = 0;
    else
        octahedron_cross_edge(at, k);
    return true;
}

/* Walk to the triangle of the first subdivision that contains the query. A coordinate changes its
 * sign at most once, and between such changes no triangle comes twice. So this ends in spite of
 * rounding. */
static void octahedron_find_child(octahedron_position *at, mw_star_work *work)
{
    do octahedron_visit(work);
    while (octahedron_step(at));
}

uint32_t mw__star_octahedron_cell(const mw_star_octahedron *octahedron, const double d[3],
                                  mw_star_work *work)
{
    octahedron_position at = {.q = {d[0], d[1], d[2]}};
    if (octahedron->levels == 0) {
        octahedron_find_face(&at, work);
        return at.octant;
    }
    octahedron_find_child(&at, work);
    uint32_t cell = 4 * at.octant + at.child;
    octahedron_corners inner = octahedron_middle_child(&face),
                       triangle =
                           at.child ? octahedron_corner_child(&face, &inner, at.child - 1) : inner;
    for (uint32_t level = 1; level < octahedron->levels; level++) {
        double value[3];
        inner = octahedron_middle_child(&triangle);
        for (uint32_t k = 0; k < 3; k++)
            value[k] = edge_determinant(inner.v[mw__prev(k)], inner.v[k], at.q);
        uint32_t k = least_of(value); /* the edge that cuts off corner k */
        octahedron_visit(work);
        if (value[k] < 0) octahedron_visit(work);
        triangle = value[k] < 0 ? octahedron_corner_child(&triangle, &inner, k) : inner;
        cell = 4 * cell + (value[k] < 0 ? 1 + k : 0);
    }
    return cell;
}
