/* dynamic_tiling_memory.c - create, grow and release a dynamic tiling. */
#include "edit/dynamic_tiling_memory.h"

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
static bool tile_arrays_grow(mw_dynamic_tiling *f, size_t least)
{
    mw_tiling *tiling = f->tiling;
    uint32_t room = grown_room_within(tiling->tri_count, least, MW_MAX_TRIANGLES);
    uint8_t *mark = mw__realloc(f->mark, room, sizeof *mark);
    if (!mark) return false;
    f->mark = mark;
    mw_triangle *tri = cache_lines_grow(tiling->tri, tiling->borrowed, tiling->tri_count, room, sizeof *tri);
    if (!tri) return false;
    tiling->tri = tri;
    memset(mark + f->tile_room, 0, room - f->tile_room);
    f->tile_room = room;
    return true;
}

static bool tile_numbers_grow(mw_dynamic_tiling *f, size_t least)
{
    uint32_t room = grown_room_within(f->number_room, least, MW_USER_MASK);
    uint32_t *tile_of = mw__realloc(f->tiling->tile_of, room, sizeof *tile_of);
    if (!tile_of) return false;
    f->tiling->tile_of = tile_of;
    f->number_room = room;
    return true;
}

static bool point_arrays_grow(mw_dynamic_tiling *f, size_t least)
{
    mw_tiling *tiling = f->tiling;
    uint32_t room = grown_room_within(tiling->point_count, least, MW_NONE);
    uint32_t *number = mw__realloc(f->vertex_number, room, sizeof *number);
    if (!number) return false;
    f->vertex_number = number;
    uint32_t *tile_at = mw__realloc(tiling->tile_at, room, sizeof *tile_at);
    if (!tile_at) return false;
    tiling->tile_at = tile_at;
    mw_point *point = cache_lines_grow(tiling->point, tiling->borrowed, tiling->point_count, room, sizeof *point);
    if (!point) return false;
    tiling->point = point;
    f->point_room = room;
    return true;
}

bool mw__tile_room_grow(mw_dynamic_tiling *f, size_t n, bool users)
{
    const mw_tiling *tiling = f->tiling;
    if (n > MW_MAX_TRIANGLES - tiling->tri_count || (users && n > MW_USER_MASK - tiling->number_count)) return false;
    const size_t tiles = tiling->tri_count + n, numbers = tiling->number_count + n;
    if (users && numbers > f->number_room && !tile_numbers_grow(f, numbers)) return false;
    return tiles <= f->tile_room || tile_arrays_grow(f, tiles);
}

static bool vertex_slots_grow(mw_dynamic_tiling *f, size_t least)
{
    uint32_t room = grown_room_within(f->vertex_room, least, MW_NONE);
    uint32_t *slots = mw__realloc(f->vertex_slot, room, sizeof *slots);
    if (!slots) return false;
    f->vertex_slot = slots;
    f->vertex_room = room;
    return true;
}

bool mw__vertex_room_grow(mw_dynamic_tiling *f, size_t n)
{
    const size_t slots = f->tiling->point_count + n, numbers = f->vertex_count + n;
    if (numbers >= MW_GONE || slots >= MW_NONE) return false;
    if (slots > f->point_room + f->free_count && !point_arrays_grow(f, slots - f->free_count)) return false;
    return numbers <= f->vertex_room || vertex_slots_grow(f, numbers);
}

bool mw__free_slot_room(mw_dynamic_tiling *f)
{
    if (f->free_count < f->free_room) return true;
    size_t room = grown_room(f->free_room);
    uint32_t *slots = mw__realloc(f->free_slot, room, sizeof *slots);
    if (!slots) return false;
    f->free_slot = slots;
    f->free_room = (uint32_t)room;
    return true;
}

/* --- the journal, and scratch ----------------------------------------------------------------- */

bool mw__stack_room(mw_dynamic_tiling *f, size_t more)
{
    if (f->stack_count + more <= f->stack_room) return true;
    size_t room = grown_room(f->stack_count + more);
    uint32_t *stack = mw__realloc(f->stack, room, sizeof *stack);
    if (!stack) return false;
    f->stack = stack;
    f->stack_room = room;
    return true;
}

void mw__dynamic_trim(mw_dynamic_tiling *f)
{
    free(f->journal);
    free(f->stack);
    mw__boundary_release(f);
    f->journal = NULL;
    f->stack = NULL;
    f->journal_room = f->stack_room = 0;
}

bool mw__journal_room(mw_dynamic_tiling *f, size_t more)
{
    if (f->journal_count + more <= f->journal_room) return true;
    size_t room = grown_room(f->journal_room + more);
    mw_journal_entry *entries = mw__realloc(f->journal, room, sizeof *entries);
    if (!entries) return false;
    f->journal = entries;
    f->journal_room = room;
    return true;
}

bool mw__boundary_enlarge(mw_dynamic_tiling *f, size_t steps)
{
    size_t room = steps + steps / 2 + 16;
    mw_boundary_step *boundary = mw__realloc(f->boundary, room, sizeof *boundary);
    if (!boundary) return false;
    f->boundary = boundary;
    uint32_t *pool = mw__realloc(f->pool, room, sizeof *pool);
    if (!pool) return false;
    f->pool = pool;
    mw_pending_step *pending = mw__realloc(f->pending, room, sizeof *pending);
    if (!pending) return false;
    f->pending = pending;
    mw_lifted_vertex *lifted = mw__realloc(f->lifted, 2 * room, sizeof *lifted);
    if (!lifted) return false;
    f->lifted = lifted;
    f->boundary_room = room;
    return true;
}

void mw__boundary_release(mw_dynamic_tiling *f)
{
    free(f->boundary);
    free(f->pool);
    free(f->pending);
    free(f->lifted);
    f->boundary = NULL;
    f->pool = NULL;
    f->pending = NULL;
    f->lifted = NULL;
    f->boundary_room = 0;
}

size_t mw__boundary_bytes(const mw_dynamic_tiling *f)
{
    return f->boundary_room * (sizeof *f->boundary + sizeof *f->pool + sizeof *f->pending + 2 * sizeof *f->lifted);
}

/* --- from a tiling ---------------------------------------------------------------------------- */

/* Make the tiling own its arrays, with room for more. Borrowed arrays are copied. */
static bool own_arrays(mw_dynamic_tiling *f)
{
    mw_tiling *tiling = f->tiling;
    mw_triangle *tri = tiling->tri;
    bool borrowed = tiling->borrowed;
    if (!tile_arrays_grow(f, 0)) return false;
    if (!point_arrays_grow(f, 0)) {
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
        return mw__fail_at(error, mw__triangle_number(mesh, t), -1, "triangle %" PRIu32 " has no area",
                           mw__triangle_number(mesh, t));
    }
    for (uint32_t t = 0; t < tiling->tri_count; t++) {
        const mw_triangle *tile = &tiling->tri[t];
        if (tile->user & MW_GHOST) continue;
        const mw_triangle *own = &mesh->tri[mw__triangle_slot(mesh, tile->user & MW_USER_MASK)];
        for (int k = 0; k < 3; k++)
            if (own->v[k] != tile->v[k]) {
                uint32_t v = mw__vertex_number(mesh, own->v[k]), other = mw__vertex_number(mesh, tile->v[k]);
                return mw__fail_at(error, tile->user & MW_USER_MASK, v,
                                   "vertices %" PRIu32 " and %" PRIu32 " lie at one place", other, v);
            }
    }
    return MW_OK;
}

static bool make_numbers(mw_dynamic_tiling *f, const mw_mesh *mesh)
{
    mw_tiling *tiling = f->tiling;
    f->number_room = mesh->tri_count;
    f->vertex_room = tiling->point_count;
    f->vertex_slot = mw__alloc(f->vertex_room, sizeof *f->vertex_slot);
    if (!f->vertex_slot || !tile_numbers_grow(f, 0)) return false;
    tiling->number_count = mesh->tri_count;
    f->vertex_count = tiling->point_count;
    for (uint32_t t = 0; t < tiling->tri_count; t++)
        if (!(tiling->tri[t].user & MW_GHOST)) tiling->tile_of[tiling->tri[t].user & MW_USER_MASK] = t;
    for (uint32_t v = 0; v < f->vertex_count; v++) {
        f->vertex_number[v] = mw__vertex_number(mesh, v);
        f->vertex_slot[f->vertex_number[v]] = v;
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

static void fix_border(mw_dynamic_tiling *f)
{
    const mw_tiling *tiling = f->tiling;
    for (uint32_t t = 0; t < tiling->tri_count; t++)
        for (uint32_t k = 0; k < 3; k++) {
            uint32_t link = tiling->tri[t].link[k];
            bool border = link == MW_NONE ? !f->convex && mw__is_users_tile(f, t)
                                          : mw__is_users_tile(f, t) != mw__is_users_tile(f, mw__link_triangle(link));
            if (border) f->mark[t] |= (uint8_t)(1u << k);
        }
}

mw_status mw__dynamic_create(mw_dynamic_tiling *f, mw_tiling *tiling, const mw_mesh *mesh, bool convex, mw_error *error)
{
    *f = (mw_dynamic_tiling){.tiling = tiling, .convex = convex};
    mw_status status = mesh_check_editable(tiling, mesh, error);
    if (status) return status;
    if (!own_arrays(f) || !make_numbers(f, mesh)) return mw__fail_memory(error);
    find_vertex_tiles(tiling);
    fix_border(f);
    return MW_OK;
}

void mw__dynamic_release(mw_dynamic_tiling *f)
{
    free(f->mark);
    free(f->vertex_slot);
    free(f->vertex_number);
    free(f->free_slot);
    free(f->journal);
    free(f->step);
    free(f->stack);
    mw__boundary_release(f);
    *f = (mw_dynamic_tiling){0};
}

size_t mw__dynamic_bytes(const mw_dynamic_tiling *f)
{
    const mw_tiling *t = f->tiling;
    return t->tri_count * sizeof *f->mark + f->vertex_count * sizeof *f->vertex_slot +
           t->point_count * sizeof *f->vertex_number + f->free_room * sizeof *f->free_slot +
           f->journal_room * sizeof *f->journal + f->step_room * sizeof *f->step + f->stack_room * sizeof *f->stack +
           mw__boundary_bytes(f);
}
