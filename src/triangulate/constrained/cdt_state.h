/* cdt_state.h - a constrained Delaunay triangulation in the making. Private.
 *
 * A segment is inserted whole or, once it has been split where it crosses others, in several parts.
 * An inserted part is a chain of one or more subsegments [Shewchuk]: edges of the triangulation.
 * Segments may overlap, so a subsegment may have several owners. */
#ifndef MW_SRC_TRIANGULATE_CONSTRAINED_CDT_STATE_H
#define MW_SRC_TRIANGULATE_CONSTRAINED_CDT_STATE_H

#include "base/job.h"
#include "triangulate/constrained/segment_insertion.h"
#include "triangulate/constrained/subsegment_runs.h"

#include <meshwalk/triangulate.h>

/* Part of a segment, between two points. Of a subsegment: `segment` is the lowest one that owns
 * it. */
typedef struct mw_segment_part {
    uint32_t from, to, segment;
} mw_segment_part;

typedef struct mw_segment_parts {
    mw_segment_part *item;
    size_t count, capacity;
} mw_segment_parts;

/* A segment that runs along a subsegment owns it. */
typedef struct mw_subsegment_owner {
    uint32_t subsegment, segment;
} mw_subsegment_owner;

typedef struct mw_cdt {
    const mw_constraints *given;
    mw_job *job;
    mw_point *point; /* the caller's, then those made where segments cross */
    size_t point_count;
    /* per point: the lowest-numbered one with its coordinates, MW_NONE if it is that itself */
    uint32_t *twin;
    mw_triangle *tri; /* of the points, with the parts inserted */
    uint32_t tri_count;
    mw_segment_insertion net;
    /* to be inserted */
    mw_segment_parts parts;
    /* inserted, by number */
    mw_segment_parts subsegments;
    /* what could not be inserted of some parts: it crosses subsegments */
    mw_segment_parts crossing;
    /* without those that jumped along runs: cdt_spans.h */
    mw_subsegment_owner *owner;
    size_t owner_count, owner_capacity;
    mw_subsegment_runs runs;
    uint64_t crossed; /* triangles: by the parts of all rounds, those that crossed others too */
    uint8_t *kept;    /* per triangle */
} mw_cdt;

/* Append; false when out of memory. */
bool mw__segment_parts_add(mw_segment_parts *list, mw_segment_part part);

/* The vertex of point p: the lowest-numbered point with its coordinates. */
static MW_INLINE uint32_t mw__vertex_of(const mw_cdt *m, uint32_t p)
{
    return m->twin[p] == MW_NONE ? p : m->twin[p];
}

/* The owners of each subsegment: those of subsegment s are segment[first[s]] .. segment[first[s +
 * 1] - 1]. */
typedef struct mw_subsegment_owners {
    size_t *first;
    uint32_t *segment;
} mw_subsegment_owners;
bool mw__subsegment_owner_add(mw_cdt *m, mw_subsegment_owner owner); /* false when out of memory */
/* A subsegment was made, or one made before has another owner now. False when out of memory. */
bool mw__subsegment_note(mw_cdt *m, const mw_subsegment *subsegment, uint32_t segment);
bool mw__subsegment_owners_create(mw_subsegment_owners *owners,
                                  const mw_cdt *m); /* false when out of memory; release anyway */
void mw__subsegment_owners_release(mw_subsegment_owners *owners);

#endif
