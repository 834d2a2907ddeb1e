/* bvh.h - a bounding volume hierarchy over the triangles of a surface: a packed tree of boxes
 * [Leutenegger, Lopez, Edgington 1997]. Private.
 *
 * Boxes are floats in a frame of the surface, y = scale * x - centre, rounded outwards. The box of
 * a leaf contains all its triangles with finite corners. The frame comes from a sample of the
 * triangles. So neither the unit of length, nor a surface far from the origin, nor a stray vertex
 * costs resolution. */
#ifndef MW_SRC_PROBE_BVH_H
#define MW_SRC_PROBE_BVH_H

#include "base/job.h"
#include "surface/surface.h"

/* Leaf i, box i of level 0, has the triangles from MW_BVH_LEAF * i on, in the order of the tree.
 * Box i of level k + 1 has the boxes of level k from MW_BVH_FANOUT * i on. The top level has one
 * box. This takes 1.7 bytes a triangle. Leaves half as large would make queries 10 to 20 % faster,
 * for twice the memory. */
#define MW_BVH_LEAF 16u
#define MW_BVH_FANOUT 8u
#define MW_BVH_LEVELS 10 /* for MW_MAX_TRIANGLES */

typedef struct mw_bvh_box {
    float low[3], high[3];
} mw_bvh_box;

typedef struct mw_bvh {
    mw_bvh_box *box;
    uint32_t *order; /* triangles in the order of the tree; NULL: in the order of the file */
    uint32_t count;  /* number of triangles */
    uint32_t level_count;
    uint32_t first[MW_BVH_LEVELS];       /* first box of a level */
    uint32_t level_boxes[MW_BVH_LEVELS]; /* number of boxes of a level */
    double scale, centre[3];             /* the frame; scale is a power of two */
} mw_bvh;

/* Make the tree without fitting its boxes. Stages of the present part of the job. Returns false
 * when out of memory, or cancelled. Release in either case. */
bool mw__bvh_create(mw_bvh *bvh, const mw_surface *surface, mw_job *job);
void mw__bvh_release(mw_bvh *bvh);
size_t mw__bvh_bytes(const mw_bvh *bvh);

/* Fit all boxes to the present vertices. A stage that takes the present part of the job. Returns
 * false if it is cancelled. */
bool mw__bvh_fit(mw_bvh *bvh, const mw_surface *surface, mw_job *job);

/* The size of a common leaf, in units of length: the mean edge of its box, and of that the median
 * of a sample. */
double mw__bvh_leaf_size(const mw_bvh *bvh);

/* A point in the frame. Each coordinate is off by at most 2^-53 of itself, and 2^-1074. May
 * overflow. */
static MW_INLINE void mw__bvh_to_frame(const mw_bvh *bvh, const double point[3], double in_frame[3])
{
    for (int k = 0; k < 3; k++) in_frame[k] = point[k] * bvh->scale - bvh->centre[k];
}

/* --- a search, nearer boxes first --- */

/* A search in doubles must not miss a box that contains its answer. A point in the frame is off by
 * 2^-53 of itself. So boxes are widened by Q_ERROR of its largest coordinate, by the distance that
 * the surface moved, and by LEAST_WIDTH for underflow. WIDTH_ERROR covers the rounding of this sum,
 * and of the differences between boxes and the point. If the point is farther than FAR, or
 * overflows, all boxes are infinite. probe_certain.c has the proof. */
#define MW_BVH_FAR 0x1p100
#define MW_BVH_Q_ERROR 0x1p-50
#define MW_BVH_WIDTH_ERROR (1 + 0x1p-40)
#define MW_BVH_LEAST_WIDTH 0x1p-600
/* The error of distances that underflow is less than this, in units of length. */
#define MW_BVH_TINY_LENGTH 0x1p-1070

/* Transform a point to the frame: q. Returns the width by which to widen all boxes. No vertex has
 * moved farther than `slack` since they were fitted. */
static MW_INLINE double mw__bvh_aim(const mw_bvh *bvh, const double point[3], double slack,
                                    double q[3])
{
    mw__bvh_to_frame(bvh, point, q);
    double largest = fmax(fabs(q[0]), fmax(fabs(q[1]), fabs(q[2])));
    if (largest <= MW_BVH_FAR)
        return (largest * MW_BVH_Q_ERROR + slack * bvh->scale + MW_BVH_LEAST_WIDTH) *
               MW_BVH_WIDTH_ERROR;
    q[0] = q[1] = q[2] = 0;
    return INFINITY;
}

/* A box to be searched. Nothing in it is nearer than `near`. */
typedef struct mw_bvh_visit {
    double near;
    uint32_t level, box;
} mw_bvh_visit;

/* The search goes depth first, which bounds the stack: of each level, at most the children of one
 * box wait. */
typedef struct mw_bvh_stack {
    uint32_t count;
    mw_bvh_visit visit[MW_BVH_LEVELS * MW_BVH_FANOUT];
} mw_bvh_stack;

/* Push one of several siblings. They wait from number `floor` on, the nearest on top; of equally
 * near ones the first, which has the lower triangles where there are many equal ones. */
static MW_INLINE void mw__bvh_push(mw_bvh_stack *stack, uint32_t floor, mw_bvh_visit visit)
{
    uint32_t i = stack->count++;
    for (; i > floor && stack->visit[i - 1].near <= visit.near; i--)
        stack->visit[i] = stack->visit[i - 1];
    stack->visit[i] = visit;
}

/* The children of box `i` of a level: boxes of level - 1, or the triangles of a leaf, in the order
 * of the tree. They are *first up to, not including, the returned value. */
static MW_INLINE uint32_t mw__bvh_children(const mw_bvh *bvh, uint32_t level, uint32_t i,
                                           uint32_t *first)
{
    uint32_t size = level ? MW_BVH_FANOUT : MW_BVH_LEAF;
    uint32_t all = level ? bvh->level_boxes[level - 1] : bvh->count;
    *first = i * size;
    return all - *first < size ? all : *first + size;
}

static MW_INLINE const mw_bvh_box *mw__bvh_box_at(const mw_bvh *bvh, uint32_t level, uint32_t i)
{
    return &bvh->box[bvh->first[level] + i];
}

static MW_INLINE uint32_t mw__bvh_triangle(const mw_bvh *bvh, uint32_t position)
{
    return bvh->order ? bvh->order[position] : position;
}

#endif
