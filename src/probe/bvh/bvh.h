/* bvh.h - a bounding volume hierarchy over the triangles of a surface: a tree of boxes with eight
 * children a node [Wald, Benthin, Boulos 2008]. Private.
 *
 * Boxes are floats in a frame of the surface, y = scale * x - centre, rounded outwards. Each box
 * contains all its triangles with finite corners. The frame comes from a sample of the triangles.
 * So neither the unit of length, nor a surface far from the origin, nor a stray vertex costs
 * resolution.
 *
 * bvh_build.c divides the triangles, bvh_fit.c fits the boxes, bvh_beam.h tests the children of a
 * node against a line, bvh_follow.c lets the tree follow single triangles. */
#ifndef MW_SRC_PROBE_BVH_BVH_H
#define MW_SRC_PROBE_BVH_BVH_H

#include "base/job.h"
#include "surface/surface.h"

#define MW_BVH_WIDTH 8u
#define MW_BVH_SIDES (MW_BVH_WIDTH * sizeof(float)) /* bytes of the sides on one axis */
/* Levels that building makes, of which the last ones halve (bvh_build.c); and with those that
 * insertions add (bvh_follow.c). */
#define MW_BVH_BUILT_LEVELS 36
#define MW_BVH_LEVELS 52

/* A child is a node; with this bit, a triangle; or MW_NONE. */
#define MW_BVH_TRIANGLE 0x80000000u

/* Axis by axis, the sides of the boxes of all children. An empty box has low > high. The corners
 * of triangles stand here, too, so that a search does not wait for the triangle, then for its
 * corners. Five cache lines. */
typedef struct mw_bvh_node {
    float low[3][MW_BVH_WIDTH], high[3][MW_BVH_WIDTH];
    uint32_t child[MW_BVH_WIDTH];
    uint32_t vertex[MW_BVH_WIDTH][3]; /* of children that are triangles, at the last fit */
} mw_bvh_node;

typedef struct mw_bvh {
    /* Node 0 is the root. Level by level, until the tree follows single triangles. */
    mw_bvh_node *node;
    uint32_t node_count, level_count;
    uint32_t first[MW_BVH_BUILT_LEVELS + 1]; /* first node of a level; then node_count */
    double scale, centre[3];                 /* the frame; scale is a power of two */
    bool finite; /* all corners were finite at the last fit, and those put in since */
    /* Of each node: the lowest of its triangles if all of them are equal, which means that they had
     * the same corners in the same order at the last fit; else MW_NONE. A search for one triangle
     * then looks at that one alone, as long as no vertex has moved since. NULL: building met no
     * crowd of boxes round one centre, so there are hardly any equal triangles. */
    uint32_t *same;
    /* Of a tree that follows single triangles; else NULL. A place is 8 * node + child. */
    uint32_t *place;  /* of each triangle; MW_NONE: it is not in the tree */
    uint32_t *parent; /* of each node: its place; MW_NONE for the root. Of a free node: the next. */
    uint32_t place_room, node_room, free_node; /* free_node: the first; MW_NONE: none */
} mw_bvh;

/* Make the tree without fitting its boxes. Stages of the present part of the job. Returns false
 * when out of memory, or cancelled. Release in either case. O(n log n). */
bool mw__bvh_create(mw_bvh *bvh, const mw_surface *surface, mw_job *job);
void mw__bvh_release(mw_bvh *bvh);
size_t mw__bvh_bytes(const mw_bvh *bvh);

/* --- bvh_fit.c --- */

/* Choose the frame for the present vertices. */
void mw__bvh_choose_frame(mw_bvh *bvh, const mw_surface *surface);

/* The box of a triangle in the frame, empty if a corner is not finite, and all of space if it is
 * too large. */
typedef struct mw_bvh_box {
    float low[3], high[3];
} mw_bvh_box;
mw_bvh_box mw__bvh_box_of(const mw_bvh *bvh, const mw_surface *surface, uint32_t triangle);

/* Choose the frame and fit all boxes to the present vertices. A stage that takes the present part
 * of the job. Returns false if it is cancelled. */
bool mw__bvh_fit(mw_bvh *bvh, const mw_surface *surface, mw_job *job);

/* Fit the boxes of one node to its children, whose own are fitted. Returns whether all its
 * triangles are finite. */
bool mw__bvh_fit_node(const mw_bvh *bvh, const mw_surface *surface, mw_bvh_node *node);
/* The box of all children of a node. */
mw_bvh_box mw__bvh_box_of_node(const mw_bvh_node *node);

/* The triangle that stands for all in a node, for a search in boxes that are widened by `slack`.
 * MW_NONE: there is none. */
static MW_INLINE uint32_t mw__bvh_same(const mw_bvh *bvh, double slack, uint32_t node)
{
    return MW_LIKELY(!bvh->same) || slack > 0 ? MW_NONE : bvh->same[node];
}

/* The size of a common triangle, in units of length: the mean edge of its box, and of that the
 * median of a sample. */
double mw__bvh_triangle_size(const mw_bvh *bvh);

/* --- bvh_follow.c --- */

/* Let a fitted tree follow single triangles from now on. False when out of memory. O(n). */
bool mw__bvh_follow(mw_bvh *bvh, const mw_surface *surface);

/* Make room for triangles below tri_count, and for so many insertions. False when out of memory. */
bool mw__bvh_reserve(mw_bvh *bvh, size_t tri_count, size_t insertions);

/* Would so many insertions make the tree deeper than searches can go? It is then built anew. */
static MW_INLINE bool mw__bvh_is_deep(const mw_bvh *bvh)
{
    return bvh->level_count > MW_BVH_BUILT_LEVELS;
}

/* Put a triangle in, beside a triangle that is in the tree, or MW_NONE: where it fits best. */
void mw__bvh_put(mw_bvh *bvh, const mw_surface *surface, uint32_t triangle, uint32_t beside);
/* The triangle has other corners. */
void mw__bvh_refit(mw_bvh *bvh, const mw_surface *surface, uint32_t triangle);
/* Take a triangle out, which need not exist any more. The tree must not become empty. */
void mw__bvh_drop(mw_bvh *bvh, uint32_t triangle);

/* --- the frame --- */

/* A point in the frame. Each coordinate is off by at most 2^-53 of itself, and 2^-1074. May
 * overflow. */
static MW_INLINE void mw__bvh_to_frame(const mw_bvh *bvh, const double point[3], double in_frame[3])
{
    for (int k = 0; k < 3; k++) in_frame[k] = point[k] * bvh->scale - bvh->centre[k];
}

/* Boxes with a coordinate beyond this are all of space. */
#define MW_BVH_LARGE 0x1p60

/* A search must not miss a box that contains its answer. A point in the frame is off by 2^-53 of
 * itself. So boxes are widened by Q_ERROR of its largest coordinate, by the distance that the
 * surface moved, and by LEAST_WIDTH for underflow. WIDTH_ERROR covers the rounding of this sum. If
 * the point is farther than FAR, or overflows, all boxes are infinite. bvh_beam.h has the proof for
 * lines. */
#define MW_BVH_FAR 0x1p100
#define MW_BVH_Q_ERROR 0x1p-50
#define MW_BVH_WIDTH_ERROR (1 + 0x1p-40)
#define MW_BVH_LEAST_WIDTH 0x1p-60
/* The error of distances that underflow is less than this, in units of length. */
#define MW_BVH_TINY_LENGTH 0x1p-1070

/* The largest coordinate, without its sign. None is NaN. */
static MW_INLINE double mw__bvh_largest(const double v[3])
{
    double x = fabs(v[0]), y = fabs(v[1]), z = fabs(v[2]), larger = x > y ? x : y;
    return larger > z ? larger : z;
}

/* Transform a point to the frame: q. Returns the width by which to widen all boxes. No vertex has
 * moved farther than `slack` since they were fitted. */
static MW_INLINE double mw__bvh_aim(const mw_bvh *bvh, const double point[3], double slack,
                                    double q[3])
{
    mw__bvh_to_frame(bvh, point, q);
    double largest = mw__bvh_largest(q);
    if (largest <= MW_BVH_FAR)
        return (largest * MW_BVH_Q_ERROR + slack * bvh->scale + MW_BVH_LEAST_WIDTH) *
               MW_BVH_WIDTH_ERROR;
    q[0] = q[1] = q[2] = 0;
    return INFINITY;
}

/* --- a search, nearer boxes first --- */

/* A node to be searched. Nothing in it is nearer than `near`, in the measure of the search. */
typedef struct mw_bvh_visit {
    float near;
    uint32_t node;
} mw_bvh_visit;

/* The search goes depth first, which bounds the stack: of each level, at most the children of one
 * node wait. */
typedef struct mw_bvh_stack {
    uint32_t count;
    mw_bvh_visit visit[MW_BVH_LEVELS * MW_BVH_WIDTH];
} mw_bvh_stack;

/* Push one of several siblings. They wait from number `floor` on, the nearest on top; of equally
 * near ones the first. */
static MW_INLINE void mw__bvh_push(mw_bvh_stack *stack, uint32_t floor, mw_bvh_visit visit)
{
    uint32_t i = stack->count++;
    for (; i > floor && stack->visit[i - 1].near <= visit.near; i--)
        stack->visit[i] = stack->visit[i - 1];
    stack->visit[i] = visit;
}

#endif
