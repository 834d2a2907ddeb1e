/* link.h - links along edges whose lower vertices are in one range. Private. */
#ifndef MW_SRC_LINK_H
#define MW_SRC_LINK_H

#include "mesh/match.h"

/* Vertices base to before base + size, and the triangles whose lowest vertex is one of these, in order of that: first to before
 * end. */
typedef struct mw_part {
    uint32_t base, size, first, end;
} mw_part;

static MW_INLINE bool mw__part_has(mw_part part, uint32_t vertex)
{
    return vertex - part.base < part.size;
}

/* Edges of triangles of other parts, 4 * triangle + edge, in any order. */
typedef struct mw_strays {
    const uint32_t *half;
    uint32_t count;
} mw_strays;

/* Room for the half-edges of a part. */
typedef struct mw_link_room {
    struct mw_arrow *arrow;
    struct mw_bunch *bunch;
    uint32_t *slot;
    size_t arrows, bunches; /* for so many */
} mw_link_room;

/* Link the triangles of a part, which have no links, and those that have strayed, along the edges whose lower vertex is in the part. What
 * is found is added to *links. The room is empty at first. Returns false when out of memory. */
bool mw__link_part(mw_triangle *tri, mw_part part, mw_strays strays, mw_link_room *room, mw_links *links);
void mw__link_room_release(mw_link_room *room);

#endif
