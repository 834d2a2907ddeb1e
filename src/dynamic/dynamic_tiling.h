/* dynamic_tiling.h - a tiling that changes: its records. Private.
 *
 * Tiles. The tiles fill their array without gaps. When a tile is deleted, the last tile moves into
 * its slot, so the slot of a tile may change. The number of a triangle changes only when the editor
 * is compacted: tri[t].user is the number of tile t, and tiling->tile_of[number] is its slot.
 * Ghosts have no number.
 *
 * Vertices. A vertex has a slot, too, and a number. The next new vertex reuses a free slot. A
 * number is not reused before compaction.
 *
 * Changes. operations.h lists what an edit can do. Each edit is recorded in a journal, which can
 * undo it; journal.h explains how. */
#ifndef MW_SRC_DYNAMIC_DYNAMIC_TILING_H
#define MW_SRC_DYNAMIC_DYNAMIC_TILING_H

#include "tiling/tiling.h"
#include "walk/lifted.h"

#include <meshwalk/edit.h>

/* Marks of a tile. Bit k of the first three: edge k is fixed, and no edit flips it. */
#define MW_FIXED_EDGES 7u
#define MW_JOURNALED 8u /* the journal has a record of this slot for the current edit */
#define MW_FILLED 16u   /* the current edit made this tile when it filled a polygon   */

/* --- the journal (see journal.h) -------------------------------------------------------------- */

/* One slot of the tile array, as it was before the edit. tile.v[0] is MW_NONE if it was empty. */
typedef struct mw_journal_entry {
    uint32_t slot, mark;
    mw_triangle tile;
} mw_journal_entry;

/* One edit, or many insertions at once: what was asked for, and what must be restored beside the
 * tiles. The counts are those before the edit. */
typedef struct mw_journal_edit {
    mw_edit edit;       /* vertices by number                          */
    size_t first_entry; /* its entries of the journal begin there      */
    uint32_t tiles, ghosts, numbers, vertices, points, free_slots, fixed_count;
    size_t edits;    /* 1, or the number of points inserted at once                       */
    uint32_t vertex; /* slot of the vertex made (the last one), removed or moved; MW_NONE */
    uint32_t made;   /* vertices made; their numbers begin at `vertices`                  */
    uint32_t number; /* of the vertex removed: a later vertex may have reused its slot    */
    mw_point point;  /* where the vertex was before it was moved or removed               */
    double value;    /* MW_EDIT_VALUE: the former value                                   */
    bool delaunay;
} mw_journal_edit;

/* --- scratch arrays: an edit reuses those of the edit before ---------------------------------- */

/* A step of a boundary: a directed edge of the boundary of tiles that are to be replaced. They lie
 * to its left. */
typedef struct mw_boundary_step {
    uint32_t vertex; /* where the step begins; it ends where the next step begins */
    uint32_t beyond; /* half-edge on its right side; MW_NONE on the hull          */
    uint32_t half;   /* half-edge on its left side, of a tile to be replaced      */
    bool fixed;
    bool slit; /* the tile beyond is replaced, too: the edge is two steps, one for each side */
} mw_boundary_step;

/* A step of the boundary of a cavity that cavity.c has not followed yet. `end` and `apex` are
 * positions in the list of lifted vertices. `apex`: the vertex opposite of the step in the tile
 * beyond it, if that tile belongs to the cavity; else MW_NONE. */
typedef struct mw_pending_step {
    uint32_t end, beyond, apex;
    bool fixed;
} mw_pending_step;

/* --- the dynamic tiling ----------------------------------------------------------------------- */

typedef struct mw_dynamic_tiling {
    mw_tiling *tiling;       /* with tile_of; its arrays belong to the dynamic tiling          */
    uint8_t *mark;           /* per slot of a tile                                             */
    uint32_t *vertex_slot;   /* per number of a vertex: its slot; MW_NONE if it was removed    */
    uint32_t *vertex_number; /* per slot of a vertex                                           */
    uint32_t *free_slot;     /* stack: the slots of removed vertices                           */
    /* numbers of vertices given out; free slots; constrained edges (fixed, but not border) */
    uint32_t vertex_count, free_count, fixed_count;
    uint32_t tile_room, number_room, point_room, vertex_room, free_room;
    bool convex;               /* the hull is not fixed: it grows and shrinks with the points   */
    bool delaunay;             /* edges that are not fixed are Delaunay, and each edit keeps so */
    mw_journal_entry *journal; /* of the current edit, and of those that can be undone          */
    size_t journal_count, journal_room;
    uint32_t journal_below; /* the current edit records tiles in slots below this one           */
    mw_journal_edit *step;  /* the edits in the journal; the last one may be under way          */
    size_t step_count, step_room;
    bool under_way;  /* an edit has begun and is neither committed nor rolled back              */
    uint32_t *stack; /* scratch: mostly half-edges that may have to be flipped                  */
    size_t stack_count, stack_room;
    mw_boundary_step *boundary; /* scratch                                                      */
    uint32_t *pool;             /* scratch: tiles that are to be replaced                       */
    mw_pending_step *pending;   /* scratch: steps that cavity.c has not followed yet            */
    mw_lifted_vertex *lifted;   /* scratch: lifted vertices round an insertion                  */
    size_t boundary_room;       /* of these four, see mw__boundary_room                         */
    uint32_t last;              /* a tile at the last edit                                      */
    uint32_t walked;            /* tiles visited by the last search for an insertion            */
    uint32_t flips;             /* of the current edit                                          */
    uint32_t star;              /* tiles round the vertex inserted last                         */
} mw_dynamic_tiling;

static MW_INLINE uint32_t mw__corner(const mw_dynamic_tiling *dynamic, uint32_t half)
{
    return dynamic->tiling->tri[mw__link_triangle(half)].v[mw__link_edge(half)];
}

/* Which corner of a tile is vertex v? The tile has v. */
static MW_INLINE uint32_t mw__corner_of(const mw_triangle *tile, uint32_t v)
{
    return tile->v[0] == v ? 0 : tile->v[1] == v ? 1 : 2;
}

static MW_INLINE uint32_t mw__apex(const mw_dynamic_tiling *dynamic, uint32_t half)
{
    return dynamic->tiling->tri[mw__link_triangle(half)].v[mw__prev(mw__link_edge(half))];
}

static MW_INLINE uint32_t mw__beyond(const mw_dynamic_tiling *dynamic, uint32_t half)
{
    return dynamic->tiling->tri[mw__link_triangle(half)].link[mw__link_edge(half)];
}

static MW_INLINE bool mw__is_fixed(const mw_dynamic_tiling *dynamic, uint32_t half)
{
    return dynamic->mark[mw__link_triangle(half)] >> mw__link_edge(half) & 1;
}

/* Is it a triangle of the user, not a ghost? */
static MW_INLINE bool mw__is_users_tile(const mw_dynamic_tiling *dynamic, uint32_t tile)
{
    return !(dynamic->tiling->tri[tile].user & MW_GHOST);
}

/* The numbers of a tile's vertices, in the user's order. */
static MW_INLINE void mw__dynamic_tile_vertices(const mw_dynamic_tiling *dynamic,
                                                const mw_triangle *tile, uint32_t vertices[3])
{
    for (uint32_t k = 0; k < 3; k++)
        vertices[mw__user_local_vertex(tile->user, k)] = dynamic->vertex_number[tile->v[k]];
}

#endif
