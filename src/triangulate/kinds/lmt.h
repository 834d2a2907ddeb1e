/* lmt.h - the parts of a triangulation of least weight: candidate edges, the LMT skeleton, its
 * faces. Private. */
#ifndef MW_SRC_TRIANGULATE_KINDS_LMT_H
#define MW_SRC_TRIANGULATE_KINDS_LMT_H

#include "base/job.h"
#include "mesh/mesh.h"

/* Points with coordinates multiplied by a power of two, the largest near 2^500: squares do not
 * overflow, and only those of tiny numbers underflow. They serve for lengths and angles only; sides
 * of lines are decided with the given points. */
typedef struct mw_scaled {
    const mw_point *point, *scaled;
    uint32_t count;
} mw_scaled;

static MW_INLINE double mw__square(const mw_scaled *s, uint32_t a, uint32_t b)
{
    double dx = s->scaled[b].x - s->scaled[a].x, dy = s->scaled[b].y - s->scaled[a].y;
    return dx * dx + dy * dy;
}

/* Is the square a of a length larger than b, whatever rounding did? A square of mw__square is off
 * by the factor (1 + u)^4 with u = 2^-53, so two of them by less than 1 + 9u; coordinates and
 * products that underflow add less than 2^-1000. */
static MW_INLINE bool mw__surely_longer(double a, double b)
{
    return a > b * (1 + 0x1p-48) + 0x1p-1000;
}

/* What may still be spent; parts give up, and say so, when nothing is left. A cancelled job is as
 * good as no memory. */
typedef struct mw_effort {
    uint64_t steps;      /* of about a nanosecond or ten          */
    uint64_t candidates; /* directed edges that may be collected  */
    mw_job *job;         /* steps of its present stage            */
} mw_effort;

/* --- candidates --- */

typedef struct mw_edge_list {
    uint64_t *key; /* of an edge of points u < v */
    size_t count, capacity;
} mw_edge_list;

#define MW_EDGE_KNOWN UINT64_C(1) /* in a key: the edge stays a candidate */

static MW_INLINE uint64_t mw__edge_key(uint32_t u, uint32_t v)
{
    return u < v ? (uint64_t)u << 32 | (uint64_t)v << 1 : (uint64_t)v << 32 | (uint64_t)u << 1;
}
static MW_INLINE uint32_t mw__edge_low(uint64_t key)
{
    return (uint32_t)(key >> 32);
}
static MW_INLINE uint32_t mw__edge_high(uint64_t key)
{
    return (uint32_t)key >> 1;
}

bool mw__edge_push(mw_edge_list *list, uint64_t key);

typedef enum mw_lmt_result { MW_LMT_DONE, MW_LMT_SPENT, MW_LMT_MEMORY } mw_lmt_result;

/* Append, from each of the vertices, the edges to others that may have the diamond property: an
 * edge that has it is appended twice, once from each end. */
mw_lmt_result mw__diamond(const mw_scaled *s, const uint32_t *vertex, uint32_t vertex_count,
                          mw_effort *effort, mw_edge_list *list);

/* --- skeleton --- */

/* Edges round their vertices. Edge e has two halves, 2 e and 2 e + 1. */
typedef struct mw_lmt {
    const mw_scaled *points;
    uint32_t edge_count;
    /* per half: the vertex that it leaves */
    uint32_t *from;
    /* per vertex: where its halves begin in `ring`; one more for the end */
    uint32_t *first;
    /* halves, counter-clockwise round each vertex */
    uint32_t *ring;
    /* per half: where in `ring` it is */
    uint32_t *ring_index;
    /* per edge, see below */
    uint8_t *state;
    /* of edges, a ring buffer */
    uint32_t *queue;
} mw_lmt;

enum { MW_LMT_ALIVE = 1, MW_LMT_KNOWN = 2, MW_LMT_QUEUED = 4 };

/* The edges of the list, none of which may hold a point between its ends. MW_LMT_SPENT: there are
 * 2^31 of them or more. Release in any case. */
mw_lmt_result mw__lmt_create(mw_lmt *lmt, const mw_scaled *points, const mw_edge_list *list);
void mw__lmt_release(mw_lmt *lmt);

/* Remove the edges for which no pair of empty triangles is locally minimal, except known ones.
 * Stops when there are no more, when the effort is spent, or when the job is cancelled. Every
 * triangulation of least weight whose edges were in the list still has all its edges in the list.
 */
void mw__lmt_reduce(mw_lmt *lmt, mw_effort *effort);

/* --- faces --- */

/* A polygon, perhaps with vertices and edges that its border meets twice, and chords from corner to
 * corner inside. */
typedef struct mw_lmt_diagonal {
    uint32_t low, high; /* corners, low + 1 < high */
    double length;
} mw_lmt_diagonal;

typedef struct mw_lmt_face {
    uint32_t corner_count;
    const mw_lmt_diagonal *chord;
    size_t chord_count; /* at most UINT32_MAX */
} mw_lmt_face;

/* About how many steps mw__lmt_face_fill takes. False when out of memory. */
bool mw__lmt_face_steps(const mw_lmt_face *polygon, uint64_t *steps);

/* Triangulate with chords of least total length, by dynamic programming [Gilbert 1979; Klincsek
 * 1980]. The chords must hold a triangulation. Writes three corners, counter-clockwise, for each of
 * corner_count - 2 triangles. Steps of the present stage. False when out of memory, or cancelled.
 */
bool mw__lmt_face_fill(const mw_lmt_face *polygon, mw_job *job, uint32_t *corners);

#endif
