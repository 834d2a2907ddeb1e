/* fabric.h - a tiling that changes: local operations on its tiles, and what takes them back. Private.
 *
 * The tiles lie densely in their array: where one goes, the last one takes its place. So places change, and numbers are what stays: each
 * tile of the user's has a number (tri[t].user), and tiling->tile_of finds the tile of a number. Ghosts have none. Vertices have a number
 * and a place too; a place that is free is taken again by the next vertex, its number is not.
 *
 * An edit is bracketed: mw__fabric_begin, operations, mw__fabric_commit or mw__fabric_rollback. Before a tile that was there gets other corners,
 * or goes, its record is put into the journal, once an edit. Links of tiles round about are not: they follow from those of the tiles put back.
 * The journal of an edit, with the places at the end of the array that it has taken, tells what it changed; exchanged with the tiles as they
 * are, it takes it back. An insertion about which nobody will ask, and which cannot fail once it has begun to change tiles, needs no bracket. */
#ifndef MW_SRC_FABRIC_H
#define MW_SRC_FABRIC_H

#include "domain/tiling.h"

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

/* A step of the boundary of tiles that are to be replaced, which lie to its left: see rim.h. */
typedef struct mw_rim_step mw_rim_step;
typedef struct mw_step_ahead mw_step_ahead;
typedef struct mw_sight mw_sight;

typedef struct mw_fabric {
    mw_tiling *tiling;       /* its arrays belong to the fabric as long as it lives; with tile_of */
    uint8_t *mark;           /* per tile */
    uint32_t *vertex_place;  /* per number of a vertex: its place, MW_NONE if it is gone */
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
    mw_rim_step *rim;     /* scratch */
    uint32_t *pool;       /* scratch: tiles that are to be replaced */
    mw_step_ahead *ahead; /* scratch: steps that are yet to be looked at */
    mw_sight *sight;      /* scratch: vertices that were looked at */
    size_t rim_room;      /* of the four, see mw__rim_room */
    uint32_t last;        /* a tile where the last edit was */
    uint32_t walked;      /* how many tiles lay on the way, when a place to insert at was looked for last */
    uint32_t flips;       /* of this edit                   */
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

/* Take the arrays of a tiling, borrowed from `mesh` or its own (borrowed ones are copied); `mesh` gives the numbers of vertices. Border
 * between tiles and ghosts is fixed. MW_ERROR_INPUT: vertices at one place, or triangles cut; MW_ERROR_MEMORY. Release in either case,
 * before the tiling is. */
mw_status mw__fabric_create(mw_fabric *f, mw_tiling *tiling, const mw_mesh *mesh, mw_error *error);
void mw__fabric_release(mw_fabric *f);
size_t mw__fabric_bytes(const mw_fabric *f); /* but for the tiling's own (mw__tiling_bytes)   */

/* --- an edit as a whole (journal.c) ----------------------------------------------------------------------------------- */

/* False when out of memory. `recorded`: in the journal, unless nobody will ask and nothing can fail (mw__fabric_reserve). */
bool mw__fabric_begin(mw_fabric *f, const mw_edit *edit, bool recorded);

/* Room for so many insertions, wherever they are and whatever they meet. False where there is not as much memory, or as many numbers, or where they
 * may be refused for another reason: in a mesh that does not fill its hull. */
bool mw__fabric_reserve(mw_fabric *f, size_t insertions);

/* After the operations. Between this and mw__fabric_forget the journal of the last step can be read. */
void mw__fabric_commit(mw_fabric *f);
void mw__fabric_rollback(mw_fabric *f);
/* Take back the last step, which was recorded. Its journal then holds the tiles as they were after the edit, and is the last thing in the
 * journal until the step is dropped (mw__fabric_drop). False when out of memory; then nothing has changed. */
bool mw__fabric_revert(mw_fabric *f);
void mw__fabric_drop(mw_fabric *f);
/* Keep the journal of the last `steps` edits only. */
void mw__fabric_forget(mw_fabric *f, size_t steps);
/* Release an empty journal, and scratch. */
void mw__fabric_trim(mw_fabric *f);

/* The part of the journal that belongs to the last step. */
static MW_INLINE size_t mw__fabric_journal(const mw_fabric *f, const mw_before **first)
{
    size_t begin = f->step[f->step_count - 1].journal;
    *first = f->before + begin;
    return f->before_count - begin;
}

/* How many places the last step changed at most. */
static MW_INLINE size_t mw__fabric_extent(const mw_fabric *f)
{
    const mw_step *step = &f->step[f->step_count - 1];
    uint32_t tiles = f->tiling->tri_count;
    return f->before_count - step->journal + (tiles > step->tiles ? tiles - step->tiles : 0);
}

/* The triangles that the last step, which was recorded, changed: `list` has room for three times its extent. */
void mw__fabric_report(const mw_fabric *f, mw_changed_triangle *list, mw_change *change);

/* The numbers of a tile's vertices, in the user's order. */
void mw__fabric_corners(const mw_fabric *f, const mw_triangle *tile, uint32_t vertices[3]);

/* --- operations: MW_ERROR_INPUT, MW_ERROR_LIMIT or MW_ERROR_MEMORY, then roll back ------------------------------------ */

/* Vertices are places; *vertex MW_NONE: a new one, else one that is in no tile. *vertex is set to the vertex at q, which may be another
 * one. `t`: where to begin to look for q (insert.c). There may be no edit under way, if nobody will ask: one begins where this may fail after
 * it has changed something. */
mw_status mw__fabric_insert(mw_fabric *f, mw_point q, uint32_t t, uint32_t *vertex, mw_error *error);
mw_status mw__fabric_remove(mw_fabric *f, uint32_t vertex, mw_error *error);
/* `t`: where to begin to look for q if the vertex cannot stay in its star; MW_NONE: there. */
mw_status mw__fabric_move(mw_fabric *f, uint32_t vertex, mw_point q, uint32_t t, mw_error *error);
mw_status mw__fabric_flip(mw_fabric *f, uint32_t from, uint32_t to, mw_error *error);
mw_status mw__fabric_constrain(mw_fabric *f, uint32_t from, uint32_t to, bool release, uint32_t *pieces,
                               mw_error *error);
/* Make all that is not fixed Delaunay. */
mw_status mw__fabric_mend(mw_fabric *f, mw_error *error);

/* The half-edge from one vertex to another, inside or on the border; MW_NONE if there is none. Where only the other
 * direction has a tile, that. */
uint32_t mw__fabric_edge(const mw_fabric *f, uint32_t from, uint32_t to);

/* A tile of a vertex that is in some: the user's of the lowest number. mw_tiling.tile_at has one that is quicker to find, but which depends on
 * what happened before: edits have to come out the same when they are replayed. */
static MW_INLINE uint32_t mw__fabric_tile(const mw_fabric *f, uint32_t vertex)
{
    return f->tiling->tile_of[mw__lowest_round(f->tiling, f->tiling->tile_at[vertex], vertex)];
}

#endif
