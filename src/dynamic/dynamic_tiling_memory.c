/* dynamic_tiling_memory.c - create, grow and release a dynamic tiling. */
#include "dynamic/dynamic_tiling_memory.h"

#include <inttypes.h>
#include <stdlib.h>
#include <string.h>

/* --- tiles and vertices ----------------------------------------------------------------------- */

/* Twice as much, so n additions copy O(n) in all. Unused room takes addresses, but no memory. */
static size_t grown_room(size_t room)
{
    return 2 * room + 16;
}

static uint32_t grown_room_within(size_t room, size_t least, uint32_t most)
{
    size_t more = grown_room(room) > least ? grown_room(room) : least;
    return more < most ? (uint32_t)more : most;
}

/* Move an array that begins at a cache line to a larger room (realloc would not keep the
 * alignment). Frees the old one unless it is borrowed. */
static void *cache_lines_grow(void *old, bool borrowed, size_t count, size_t room, size_t size)
{
    void *more = mw__alloc_lines(room, size);
    if (!more) return NULL;
    memcpy(more, old, count * size);
    if (!borrowed) free(old);
    return more;
}

/* Room for twice as many, and for at least `least`; here and below. */
static bool tile_arrays_grow(mw_dynamic_tiling *dynamic, size_t least)
{
    mw_tiling *tiling = dynamic->tiling;
    uint32_t room = grown_room_within(tiling->tri_count, least, MW_MAX_TRIANGLES);
    uint8_t *mark = mw__realloc(dynamic->mark, room, sizeof *mark);
    if (!mark) return false;
    dynamic->mark = mark;
    mw_triangle *tri =
        cache_lines_grow(tiling->tri, tiling->borrowed, tiling->tri_count, room, sizeof *tri);
    if (!tri) return false;
    tiling->tri = tri;
    memset(mark + dynamic->tile_room, 0, room - dynamic->tile_room);
    dynamic->tile_room = room;
    return true;
}

static bool tile_numbers_grow(mw_dynamic_tiling *dynamic, size_t least)
{
    uint32_t room = grown_room_within(dynamic->number_room, least, MW_USER_MASK);
    uint32_t *tile_of = mw__realloc(dynamic->tiling->tile_of, room, sizeof *tile_of);
    if (!tile_of) return false;
    dynamic->tiling->tile_of = tile_of;
    dynamic->number_room = room;
    return true;
}

static bool point_arrays_grow(mw_dynamic_tiling *dynamic, size_t least)
{
    mw_tiling *tiling = dynamic->tiling;
    uint32_t room = grown_room_within(tiling->point_count, least, MW_NONE);
    uint32_t *number = mw__realloc(dynamic->vertex_number, room, sizeof *number);
    if (!number) return false;
    dynamic->vertex_number = number;
    uint32_t *tile_at = mw__realloc(tiling->tile_at, room, sizeof *tile_at);
    if (!tile_at) return false;
    tiling->tile_at = tile_at;
    mw_point *point =
        cache_lines_grow(tiling->point, tiling->borrowed, tiling->point_count, room, sizeof *point);
    if (!point) return false;
    tiling->point = point;
    dynamic->point_room = room;
    return true;
}

bool mw__tile_room_grow(mw_dynamic_tiling *dynamic, size_t n, bool users)
{
    const mw_tiling *tiling = dynamic->tiling;
    if (n > MW_MAX_TRIANGLES - tiling->tri_count ||
        (users && n > MW_USER_MASK - tiling->number_count))
        return false;
    const size_t tiles = tiling->tri_count + n, numbers = tiling->number_count + n;
    if (users && numbers > dynamic->number_room && !tile_numbers_grow(dynamic, numbers))
        return false;
    return tiles <= dynamic->tile_room || tile_arrays_grow(dynamic, tiles);
}

static bool vertex_slots_grow(mw_dynamic_tiling *dynamic, size_t least)
{
    uint32_t room = grown_room_within(dynamic->vertex_room, least, MW_NONE);
    uint32_t *slots = mw__realloc(dynamic->vertex_slot, room, sizeof *slots);
    if (!slots) return false;
    dynamic->vertex_slot = slots;
    dynamic->vertex_room = room;
    return true;
}

bool mw__vertex_room_grow(mw_dynamic_tiling *dynamic, size_t n)
{
    const size_t slots = dynamic->tiling->point_count + n, numbers = dynamic->vertex_count + n;
    if (numbers >= MW_GONE || slots >= MW_NONE) return false;
    if (slots > dynamic->point_room + dynamic->free_count &&
        !point_arrays_grow(dynamic, slots - dynamic->free_count))
        return false;
    return numbers <= dynamic->vertex_room || vertex_slots_grow(dynamic, numbers);
}

bool mw__free_slot_room(mw_dynamic_tiling *dynamic)
{
    if (dynamic->free_count < dynamic->free_room) return true;
    size_t room = grown_room(dynamic->free_room);
    uint32_t *slots = mw__realloc(dynamic->free_slot, room, sizeof *slots);
    if (!slots) return false;
    dynamic->free_slot = slots;
    dynamic->free_room = (uint32_t)room;
    return true;
}

/* --- the journal, and scratch ----------------------------------------------------------------- */

bool mw__stack_room(mw_dynamic_tiling *dynamic, size_t more)
{
    if (dynamic->stack_count + more <= dynamic->stack_room) return true;
    size_t room = grown_room(dynamic->stack_count + more);
    uint32_t *stack = mw__realloc(dynamic->stack, room, sizeof *stack);
    if (!stack) return false;
    dynamic->stack = stack;
    dynamic->stack_room = room;
    return true;
}

void mw__dynamic_trim(mw_dynamic_tiling *dynamic)
{
    free(dynamic->journal);
    free(dynamic->stack);
    mw__boundary_release(dynamic);
    dynamic->journal = NULL;
    dynamic->stack = NULL;
    dynamic->journal_room = dynamic->stack_room = 0;
}

bool mw__journal_room(mw_dynamic_tiling *dynamic, size_t more)
{
    if (dynamic->journal_count + more <= dynamic->journal_room) return true;
    size_t room = grown_room(dynamic->journal_room + more);
    mw_journal_entry *entries = mw__realloc(dynamic->journal, room, sizeof *entries);
    if (!entries) return false;
    dynamic->journal = entries;
    dynamic->journal_room = room;
    return true;
}

bool mw__boundary_enlarge(mw_dynamic_tiling *dynamic, size_t steps)
{
    size_t room = steps + steps / 2 + 16;
    mw_boundary_step *boundary = mw__realloc(dynamic->boundary, room, sizeof *boundary);
    if (!boundary) return false;
    dynamic->boundary = boundary;
    uint32_t *pool = mw__realloc(dynamic->pool, room, sizeof *pool);
    if (!pool) return false;
    dynamic->pool = pool;
    mw_pending_step *pending = mw__realloc(dynamic->pending, room, sizeof *pending);
    if (!pending) return false;
    dynamic->pending = pending;
    mw_lifted_vertex *lifted = mw__realloc(dynamic->lifted, 2 * room, sizeof *lifted);
    if (!lifted) return false;
    dynamic->lifted = lifted;
    dynamic->boundary_room = room;
    return true;
}

void mw__boundary_release(mw_dynamic_tiling *dynamic)
{
    free(dynamic->boundary);
    free(dynamic->pool);
    free(dynamic->pending);
    free(dynamic->lifted);
    dynamic->boundary = NULL;
    dynamic->pool = NULL;
    dynamic->pending = NULL;
    dynamic->lifted = NULL;
    dynamic->boundary_room = 0;
}

size_t mw__boundary_bytes(const mw_dynamic_tiling *dynamic)
{
    return dynamic->boundary_room * (sizeof *dynamic->boundary + sizeof *dynamic->pool +
                                     sizeof *dynamic->pending + 2 * sizeof *dynamic->lifted);
}

/* --- from a tiling ---------------------------------------------------------------------------- */

/* Make the tiling own its arrays, with room for more. Borrowed arrays are copied. */
static bool own_arrays(mw_dynamic_tiling *dynamic)
{
    mw_tiling *tiling = dynamic->tiling;
    mw_triangle *tri = tiling->tri;
    bool borrowed = tiling->borrowed;
    if (!tile_arrays_grow(dynamic, 0)) return false;
    if (!point_arrays_grow(dynamic, 0)) {
        if (borrowed) { /* the tiling must own neither */
            free(tiling->tri);
            tiling->tri = tri;
        }
        return false;
    }
    tiling->borrowed = false;
    return true;
}

/* Check that the user tiles are the user's triangles: none is cut, and no vertices coincide. */
static mw_status mesh_check_editable(const mw_tiling *tiling, const mw_mesh *mesh, mw_error *error)
{
    if (mesh->flat_count > 0) {
        uint32_t t = 0;
        while (mw__has_area(mesh->point, &mesh->tri[t])) t++;
        return mw__fail_at(error, mw__triangle_number(mesh, t), -1,
                           "triangle %" PRIu32 " has no area", mw__triangle_number(mesh, t));
    }
    for (uint32_t t = 0; t < tiling->tri_count; t++) {
        const mw_triangle *tile = &tiling->tri[t];
        if (tile->user & MW_GHOST) continue;
        const mw_triangle *own = &mesh->tri[mw__triangle_slot(mesh, tile->user & MW_USER_MASK)];
        for (int k = 0; k < 3; k++)
            if (own->v[k] != tile->v[k]) {
                uint32_t v = mw__vertex_number(mesh, own->v[k]),
                         other = mw__vertex_number(mesh, tile->v[k]);
                return mw__fail_at(error, tile->user & MW_USER_MASK, v,
                                   "vertices %" PRIu32 " and %" PRIu32 " have equal coordinates",
                                   other, v);
            }
    }
    return MW_OK;
}

static bool make_numbers(mw_dynamic_tiling *dynamic, const mw_mesh *mesh)
{
    mw_tiling *tiling = dynamic->tiling;
    dynamic->number_room = mesh->tri_count;
    dynamic->vertex_room = tiling->point_count;
    dynamic->vertex_slot = mw__alloc(dynamic->vertex_room, sizeof *dynamic->vertex_slot);
    if (!dynamic->vertex_slot || !tile_numbers_grow(dynamic, 0)) return false;
    tiling->number_count = mesh->tri_count;
    dynamic->vertex_count = tiling->point_count;
    for (uint32_t t = 0; t < tiling->tri_count; t++)
        if (!(tiling->tri[t].user & MW_GHOST))
            tiling->tile_of[tiling->tri[t].user & MW_USER_MASK] = t;
    for (uint32_t v = 0; v < dynamic->vertex_count; v++) {
        dynamic->vertex_number[v] = mw__vertex_number(mesh, v);
        dynamic->vertex_slot[dynamic->vertex_number[v]] = v;
    }
    return true;
}

static void find_vertex_tiles(mw_tiling *tiling)
{
    for (uint32_t v = 0; v < tiling->point_count; v++) tiling->tile_at[v] = MW_NONE;
    for (uint32_t t = 0; t < tiling->tri_count; t++)
        for (int k = 0; k < 3; k++) tiling->tile_at[tiling->tri[t].v[k]] = t;
    free(tiling->owner);
    tiling->owner = NULL;
}

static void fix_border(mw_dynamic_tiling *dynamic)
{
    const mw_tiling *tiling = dynamic->tiling;
    for (uint32_t t = 0; t < tiling->tri_count; t++)
        for (uint32_t k = 0; k < 3; k++) {
            uint32_t link = tiling->tri[t].link[k];
            bool border = link == MW_NONE ? !dynamic->convex && mw__is_users_tile(dynamic, t)
                                          : mw__is_users_tile(dynamic, t) !=
                                                mw__is_users_tile(dynamic, mw__link_triangle(link));
            if (border) dynamic->mark[t] |= (uint8_t)(1u << k);
        }
}

mw_status mw__dynamic_create(mw_dynamic_tiling *dynamic, mw_tiling *tiling, const mw_mesh *mesh,
                             bool convex, mw_error *error)
{
    *dynamic = (mw_dynamic_tiling){.tiling = tiling, .convex = convex};
    mw_status status = mesh_check_editable(tiling, mesh, error);
    if (status) return status;
    if (!own_arrays(dynamic) || !make_numbers(dynamic, mesh)) return mw__fail_memory(error);
    find_vertex_tiles(tiling);
    fix_border(dynamic);
    return MW_OK;
}

void mw__dynamic_release(mw_dynamic_tiling *dynamic)
{
    free(dynamic->mark);
    free(dynamic->vertex_slot);
    free(dynamic->vertex_number);
    free(dynamic->free_slot);
    free(dynamic->journal);
    free(dynamic->step);
    free(dynamic->stack);
    mw__boundary_release(dynamic);
    *dynamic = (mw_dynamic_tiling){0};
}

/* Room in the arrays of the tiling that it does not use yet. */
static size_t tiling_room_bytes(const mw_dynamic_tiling *dynamic)
{
    const mw_tiling *t = dynamic->tiling;
    return (dynamic->tile_room - t->tri_count) * sizeof *t->tri +
           (dynamic->number_room - t->number_count) * sizeof *t->tile_of +
           (dynamic->point_room - t->point_count) * (sizeof *t->point + sizeof *t->tile_at);
}

size_t mw__dynamic_bytes(const mw_dynamic_tiling *dynamic)
{
    return tiling_room_bytes(dynamic) + dynamic->tile_room * sizeof *dynamic->mark +
           dynamic->vertex_room * sizeof *dynamic->vertex_slot +
           dynamic->point_room * sizeof *dynamic->vertex_number +
           dynamic->free_room * sizeof *dynamic->free_slot +
           dynamic->journal_room * sizeof *dynamic->journal +
           dynamic->step_room * sizeof *dynamic->step +
           dynamic->stack_room * sizeof *dynamic->stack + mw__boundary_bytes(dynamic);
}
