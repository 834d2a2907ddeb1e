/* star_track.h - follows single facets of a surface, star-shaped or not. Private.
 *
 * The three conditions of kernel_check.h are ones of single facets and edges, and a count. A facet
 * with an area, not in a plane with the centre, is stored so that the centre lies behind it. Then
 * the surface is star-shaped if each edge has two facets, which agree, and the one ray meets one
 * facet. So it suffices to know of each facet what is wrong with it and its edges, and to count. A
 * change of some facets changes these and the edges of their neighbours, and nothing else.
 *
 * It works while no facet of the surface lacks an area: such ones are counted, but not flipped away
 * (flat_facets.h). Stored facets fill star->facet without gaps: the last one takes the place of one
 * that goes. */
#ifndef MW_SRC_STAR_PREPARE_STAR_TRACK_H
#define MW_SRC_STAR_PREPARE_STAR_TRACK_H

#include "star/star.h"

/* Begin to track the stored facets, which are all of the surface. False when out of memory: the
 * star does not track. O(n) */
bool mw__star_track_begin(mw_star *star);
/* Cease. */
void mw__star_track_end(mw_star *star);
size_t mw__star_track_bytes(const mw_star *star);

/* Is a facet with these corners stored turned, so that the centre lies behind it? */
bool mw__star_track_turns(const mw_star *star, const uint32_t v[3]);

/* Make room for so many numbers of facets and vertices. False when out of memory. */
bool mw__star_track_reserve(mw_star *star, size_t tri_count, size_t point_count);

/* A change of facets is followed in three steps: first each facet that is new, or has other corners
 * or corners that have moved, is renewed. Then each of these, and each that has other neighbours,
 * is linked. Then those that are gone are dropped. A step may be done twice for a facet. */
void mw__star_track_renew(mw_star *star, uint32_t t);
void mw__star_track_link(mw_star *star, uint32_t t);
void mw__star_track_drop(mw_star *star, uint32_t t);

/* In star->owner: facets have left the vertex, and which is the lowest is unknown. */
#define MW_STAR_OWNER_LOST (MW_NONE - 1)

/* Is the surface star-shaped, and does no facet lack an area? */
static MW_INLINE bool mw__star_track_is_sound(const mw_star *star)
{
    const mw_star_track *track = &star->track;
    return track->unsound == 0 && track->wrong == 0 && track->flat == 0 && track->met == 1;
}

/* All numbers have become others, in the same order; MW_NONE: such a number is gone, as its facet
 * or vertex was before. */
void mw__star_track_renumber(mw_star *star, const uint32_t *triangle, const uint32_t *vertex);

#endif
