/* fabric.h - a tiling that changes, and the journal of its changes: the records. Private.
 *
 * The tiles lie densely in their array: where one goes, the last one takes its place. So places change, and numbers are what stays: each
 * tile of the user's has a number (tri[t].user), and tiling->tile_of finds the tile of a number. Ghosts have none. Vertices have a number
 * and a place too; a place that is free is taken again by the next vertex, its number is not.
 *
 * An edit is bracketed (journal.h): mw__fabric_begin, operations, mw__fabric_commit or
 * mw__fabric_rollback. Before a tile that was there gets other corners, or goes, its record is put into the journal, once an edit. Links of tiles round about are not: they follow from those of the tiles put back.
 * The journal of an edit, with the places at the end of the array that it has taken, tells what it changed; exchanged with the tiles as they
 * are, it takes it back. An insertion about which nobody will ask, and which cannot fail once it has begun to change tiles, needs no bracket. */
#ifndef MW_SRC_FABRIC_H
#define MW_SRC_FABRIC_H

#include "tiling/tiling.h"
#include "walk/lifted.h"

#include <meshwalk/edit.h>

/* Marks of a tile: its edges that are fixed (bit k), and whether the journal of this edit has it. */
#define MW_FIXED_EDGES 7u
#define MW_JOURNALED 8u
#define MW_FILLED 16u /* it was cut off a polygon that this edit left */

/* A place of the array of tiles, as it was before the edit. tile.v[0] is MW_NONE where there was no tile. */
typedef struct mw_before {
    uint32_t place, mark;
    mw_triangle tile;
} mw_before;

/* An edit: what it was, and how things stood before it. */
typedef struct mw_step {
    mw_edit edit;   /* vertices by number                       */
    size_t journal; /* its part of the journal begins here      */
    uint32_t tiles, ghosts, numbers, vertices, points, free_places, fixed_count;
    size_t edits;    /* more than one for many points                            */
    uint32_t vertex; /* place of the vertex made (the last one), removed or moved; MW_NONE if there is none */
    uint32_t made;   /* vertices made, with numbers from `vertices` on           */
    uint32_t number; /* of the vertex removed: others may have had its place since           */
    mw_point point;  /* where it was, if it was moved or removed                             */
    double value;    /* MW_EDIT_VALUE: as it was                                             */
    bool delaunay;
} mw_step;

/* --- lists that an edit works in, kept so that it seldom has to ask for memory ---------------- */

/* A step of the boundary of tiles that are to be replaced, which lie to its left. */
typedef struct mw_rim_step {
    uint32_t vertex; /* where the step begins; the next one begins where it ends */
    uint32_t beyond; /* half-edge on its right side; MW_NONE on the hull         */
    uint32_t half;   /* half-edge on its left side, of a tile that is replaced   */
    bool fixed;
    bool slit; /* `beyond` is replaced too: the step comes twice, once from each side */
} mw_rim_step;

/* A step of the boundary of a hole that is dug (hole.h), not yet come to: the sight where it ends and, where the tile beyond goes,
 * the sight of the vertex of that across from the step; else MW_NONE. */
typedef struct mw_step_ahead {
    uint32_t end, beyond, apex;
    bool fixed;
} mw_step_ahead;

/* --- the fabric -------------------------------------------------------------------------------- */

typedef struct mw_fabric {
    mw_tiling *tiling;       /* its arrays belong to the fabric as long as it lives; with tile_of */
    uint8_t *mark;           /* per tile */
    uint32_t *vertex_slot;   /* per number of a vertex: its place, MW_NONE if it is gone */
    uint32_t *vertex_number; /* per place */
    uint32_t *free_place;    /* places of vertices that are gone, a stack */
    uint32_t vertex_count, free_count, fixed_count; /* numbers of vertices; edges fixed but for the border */
    uint32_t tile_room, number_room, point_room, vertex_room, free_room;
    bool convex;       /* the hull is not fixed: it grows and shrinks                        */
    bool delaunay;     /* edges that are not fixed are Delaunay, and are to stay so          */
    mw_before *before; /* the journal of this edit and of those that can be undone       */
    size_t before_count, before_room;
    uint32_t journaled; /* of this edit: tiles from here on need no record, as they are new, or as nobody will ask */
    mw_step *step;      /* the edits in it; the last one is under way between begin and commit */
    size_t step_count, step_room;
    bool under_way;  /* is one? */
    uint32_t *stack; /* half-edges that may have to be flipped, and other scratch        */
    size_t stack_count, stack_room;
    mw_rim_step *rim;        /* scratch */
    uint32_t *pool;          /* scratch: tiles that are to be replaced */
    mw_step_ahead *ahead;    /* scratch: steps that are yet to be looked at */
    mw_lifted_vertex *sight; /* scratch: vertices that were looked at */
    size_t rim_room;         /* of the four, see mw__rim_room */
    uint32_t last;           /* a tile where the last edit was */
    uint32_t walked;         /* how many tiles lay on the way, when a place to insert at was looked for last */
    uint32_t flips;          /* of this edit                   */
} mw_fabric;

static MW_INLINE uint32_t mw__corner(const mw_fabric *f, uint32_t half)
{
    return f->tiling->tri[mw__link_triangle(half)].v[mw__link_edge(half)];
}

/* Which corner of a tile that has it is v? */
static MW_INLINE uint32_t mw__corner_of(const mw_triangle *tile, uint32_t v)
{
    return tile->v[0] == v ? 0 : tile->v[1] == v ? 1 : 2;
}

static MW_INLINE uint32_t mw__apex(const mw_fabric *f, uint32_t half)
{
    return f->tiling->tri[mw__link_triangle(half)].v[mw__prev(mw__link_edge(half))];
}

static MW_INLINE uint32_t mw__beyond(const mw_fabric *f, uint32_t half)
{
    return f->tiling->tri[mw__link_triangle(half)].link[mw__link_edge(half)];
}

static MW_INLINE bool mw__is_fixed(const mw_fabric *f, uint32_t half)
{
    return f->mark[mw__link_triangle(half)] >> mw__link_edge(half) & 1;
}

static MW_INLINE bool mw__is_users(const mw_fabric *f, uint32_t tile)
{
    return !(f->tiling->tri[tile].user & MW_GHOST);
}

/* The numbers of a tile's vertices, in the user's order. */
static MW_INLINE void mw__fabric_corners(const mw_fabric *f, const mw_triangle *tile, uint32_t vertices[3])
{
    for (uint32_t k = 0; k < 3; k++) vertices[mw__user_local_vertex(tile->user, k)] = f->vertex_number[tile->v[k]];
}

#endif
