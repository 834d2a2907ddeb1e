/* boxes.h - a packed tree of boxes [Leutenegger, Lopez, Edgington 1997] over the triangles of a surface. Private.
 *
 * Boxes are floats in a frame of the surface, y = scale * x - centre, rounded outwards: the box of a leaf holds all its
 * triangles that have finite corners. The frame comes from a sample of the triangles, so that neither the unit of
 * length, nor a surface far from the origin, nor a stray vertex costs resolution. */
#ifndef MW_SRC_SURFACE_BOXES_H
#define MW_SRC_SURFACE_BOXES_H

#include "mesh/surface.h"

/* Leaf i, box i of level 0, holds the triangles MW_SURFACE_LEAF * i ... in the order of the tree; box i of level k + 1
 * holds boxes MW_SURFACE_FAN * i ... of level k. The top level has one box. That makes 1.7 bytes a triangle; leaves
 * half as large would make queries 10 to 20 % faster for as much again. */
#define MW_SURFACE_LEAF 16u
#define MW_SURFACE_FAN 8u
#define MW_SURFACE_LEVELS 10 /* for MW_MAX_TRIANGLES */

typedef struct mw_surface_box {
    float low[3], high[3];
} mw_surface_box;

typedef struct mw_surface_boxes {
    mw_surface_box *box;
    uint32_t *order; /* triangles in the order of the tree; NULL: as they are numbered */
    uint32_t count;  /* of triangles */
    uint32_t level_count;
    uint32_t first[MW_SURFACE_LEVELS];       /* box of a level */
    uint32_t level_boxes[MW_SURFACE_LEVELS]; /* of a level     */
    double scale, centre[3];                 /* the frame; scale is a power of two */
} mw_surface_boxes;

/* Makes the tree, but fits no boxes. Returns false when out of memory. Release in either case. */
bool mw__surface_boxes_create(mw_surface_boxes *boxes, const mw_surface *surface);
void mw__surface_boxes_release(mw_surface_boxes *boxes);
size_t mw__surface_boxes_bytes(const mw_surface_boxes *boxes);

/* Fit all boxes to where the vertices are now. threads: 0 = what OpenMP gives. */
void mw__surface_boxes_fit(mw_surface_boxes *boxes, const mw_surface *surface, uint32_t threads);

/* The size of a common leaf, in units of length: the median, of a sample, of the mean edge of their boxes. */
double mw__surface_boxes_leaf_size(const mw_surface_boxes *boxes);

/* A point in the frame: off by at most 2^-53 of itself (and 2^-1074). May overflow. */
static MW_INLINE void mw__surface_boxes_frame(const mw_surface_boxes *boxes, const double point[3], double in_frame[3])
{
    for (int k = 0; k < 3; k++) in_frame[k] = point[k] * boxes->scale - boxes->centre[k];
}

/* --- a search, nearer boxes first --------------------------------------------------------------------------------- */

/* A search in doubles must not miss a box that holds its answer. A point in the frame is off by 2^-53 of itself: boxes
 * are widened for that by Q_ERROR of its largest coordinate, for what the surface moved, and by LEAST_WIDTH for what
 * underflows. WIDTH_ERROR is for the roundings of this sum, and of bounds of boxes less the point. For a point farther
 * off than FAR, or that overflows, all boxes are infinite. certain.c gives the arguments. */
#define MW_SURFACE_FAR 0x1p100
#define MW_SURFACE_Q_ERROR 0x1p-50
#define MW_SURFACE_WIDTH_ERROR (1 + 0x1p-40)
#define MW_SURFACE_LEAST_WIDTH 0x1p-600
/* Where distances underflow, they are off by less, in units of length. */
#define MW_SURFACE_TINY_LENGTH 0x1p-1070

/* Brings a point to the frame: q. Returns the width by which boxes are then to be larger on all sides; no vertex has
 * moved farther than `slack` since they were fitted. */
static MW_INLINE double mw__surface_boxes_aim(const mw_surface_boxes *boxes, const double point[3], double slack,
                                              double q[3])
{
    mw__surface_boxes_frame(boxes, point, q);
    double largest = fmax(fabs(q[0]), fmax(fabs(q[1]), fabs(q[2])));
    if (largest <= MW_SURFACE_FAR)
        return (largest * MW_SURFACE_Q_ERROR + slack * boxes->scale + MW_SURFACE_LEAST_WIDTH) * MW_SURFACE_WIDTH_ERROR;
    q[0] = q[1] = q[2] = 0;
    return INFINITY;
}

/* A box to look into, nothing in it being nearer than `near`. */
typedef struct mw_surface_box_visit {
    double near;
    uint32_t level, box;
} mw_surface_box_visit;

/* Depth first, so that the stack is bounded: of each level at most the brothers of one box wait. */
typedef struct mw_surface_box_stack {
    uint32_t count;
    mw_surface_box_visit visit[MW_SURFACE_LEVELS * MW_SURFACE_FAN];
} mw_surface_box_stack;

/* Push one of several brothers, which wait from number `floor` on: the nearest on top. */
static MW_INLINE void mw__surface_box_push(mw_surface_box_stack *stack, uint32_t floor, mw_surface_box_visit visit)
{
    uint32_t i = stack->count++;
    for (; i > floor && stack->visit[i - 1].near < visit.near; i--) stack->visit[i] = stack->visit[i - 1];
    stack->visit[i] = visit;
}

/* The boxes below box `i` of a level, in level - 1, or the triangles of a leaf, in the order of the tree: from *first
 * to before the value returned. */
static MW_INLINE uint32_t mw__surface_boxes_below(const mw_surface_boxes *boxes, uint32_t level, uint32_t i,
                                                  uint32_t *first)
{
    uint32_t size = level ? MW_SURFACE_FAN : MW_SURFACE_LEAF;
    uint32_t all = level ? boxes->level_boxes[level - 1] : boxes->count;
    *first = i * size;
    return all - *first < size ? all : *first + size;
}

static MW_INLINE const mw_surface_box *mw__surface_box(const mw_surface_boxes *boxes, uint32_t level, uint32_t i)
{
    return &boxes->box[boxes->first[level] + i];
}

static MW_INLINE uint32_t mw__surface_boxes_triangle(const mw_surface_boxes *boxes, uint32_t place)
{
    return boxes->order ? boxes->order[place] : place;
}

#endif
