/* fabric_memory.c - making a fabric, the room it needs, and its end. */
#include "edit/fabric_memory.h"

#include <inttypes.h>
#include <stdlib.h>
#include <string.h>

/* --- tiles and vertices ------------------------------------------------------------------------ */

/* Twice as much, so that n additions copy O(n) in all; what is not used yet takes addresses, no memory. */
static size_t enlarged(size_t room)
{
    return 2 * room + 16;
}

static uint32_t enlarged_to(size_t room, size_t least, uint32_t most)
{
    size_t more = enlarged(room) > least ? enlarged(room) : least;
    return more < most ? (uint32_t)more : most;
}

/* An array that begins with a cache line, which realloc would not keep, in a larger room; the old one goes unless it is borrowed. */
static void *enlarge_lines(void *old, bool borrowed, size_t count, size_t room, size_t size)
{
    void *more = mw__alloc_lines(room, size);
    if (!more) return NULL;
    memcpy(more, old, count * size);
    if (!borrowed) free(old);
    return more;
}

/* Room for twice as many, and for `least`, here and below. */
static bool more_tiles(mw_fabric *f, size_t least)
{
    mw_tiling *tiling = f->tiling;
    uint32_t room = enlarged_to(tiling->tri_count, least, MW_MAX_TRIANGLES);
    uint8_t *mark = mw__realloc(f->mark, room, sizeof *mark);
    if (!mark) return false;
    f->mark = mark;
    mw_triangle *tri = enlarge_lines(tiling->tri, tiling->borrowed, tiling->tri_count, room, sizeof *tri);
    if (!tri) return false;
    tiling->tri = tri;
    memset(mark + f->tile_room, 0, room - f->tile_room);
    f->tile_room = room;
    return true;
}

static bool more_numbers(mw_fabric *f, size_t least)
{
    uint32_t room = enlarged_to(f->number_room, least, MW_USER_MASK);
    uint32_t *tile_of = mw__realloc(f->tiling->tile_of, room, sizeof *tile_of);
    if (!tile_of) return false;
    f->tiling->tile_of = tile_of;
    f->number_room = room;
    return true;
}

static bool more_points(mw_fabric *f, size_t least)
{
    mw_tiling *tiling = f->tiling;
    uint32_t room = enlarged_to(tiling->point_count, least, MW_NONE);
    uint32_t *number = mw__realloc(f->vertex_number, room, sizeof *number);
    if (!number) return false;
    f->vertex_number = number;
    uint32_t *tile_at = mw__realloc(tiling->tile_at, room, sizeof *tile_at);
    if (!tile_at) return false;
    tiling->tile_at = tile_at;
    mw_point *point = enlarge_lines(tiling->point, tiling->borrowed, tiling->point_count, room, sizeof *point);
    if (!point) return false;
    tiling->point = point;
    f->point_room = room;
    return true;
}

bool mw__more_tiles(mw_fabric *f, size_t n, bool users)
{
    const mw_tiling *tiling = f->tiling;
    if (n > MW_MAX_TRIANGLES - tiling->tri_count || (users && n > MW_USER_MASK - tiling->number_count)) return false;
    const size_t tiles = tiling->tri_count + n, numbers = tiling->number_count + n;
    if (users && numbers > f->number_room && !more_numbers(f, numbers)) return false;
    return tiles <= f->tile_room || more_tiles(f, tiles);
}

static bool more_vertices(mw_fabric *f, size_t least)
{
    uint32_t room = enlarged_to(f->vertex_room, least, MW_NONE);
    uint32_t *place = mw__realloc(f->vertex_slot, room, sizeof *place);
    if (!place) return false;
    f->vertex_slot = place;
    f->vertex_room = room;
    return true;
}

bool mw__more_vertices(mw_fabric *f, size_t n)
{
    const size_t places = f->tiling->point_count + n, numbers = f->vertex_count + n;
    if (numbers >= MW_GONE || places >= MW_NONE) return false;
    if (places > f->point_room + f->free_count && !more_points(f, places - f->free_count)) return false;
    return numbers <= f->vertex_room || more_vertices(f, numbers);
}

bool mw__free_place_room(mw_fabric *f)
{
    if (f->free_count < f->free_room) return true;
    size_t room = enlarged(f->free_room);
    uint32_t *place = mw__realloc(f->free_place, room, sizeof *place);
    if (!place) return false;
    f->free_place = place;
    f->free_room = (uint32_t)room;
    return true;
}

/* --- the journal, and scratch ------------------------------------------------------------------ */

bool mw__stack_room(mw_fabric *f, size_t more)
{
    if (f->stack_count + more <= f->stack_room) return true;
    size_t room = enlarged(f->stack_count + more);
    uint32_t *stack = mw__realloc(f->stack, room, sizeof *stack);
    if (!stack) return false;
    f->stack = stack;
    f->stack_room = room;
    return true;
}

void mw__fabric_trim(mw_fabric *f)
{
    free(f->before);
    free(f->stack);
    mw__rim_release(f);
    f->before = NULL;
    f->stack = NULL;
    f->before_room = f->stack_room = 0;
}

bool mw__journal_room(mw_fabric *f, size_t more)
{
    if (f->before_count + more <= f->before_room) return true;
    size_t room = enlarged(f->before_room + more);
    mw_before *before = mw__realloc(f->before, room, sizeof *before);
    if (!before) return false;
    f->before = before;
    f->before_room = room;
    return true;
}

bool mw__rim_enlarge(mw_fabric *f, size_t steps)
{
    size_t room = steps + steps / 2 + 16;
    mw_rim_step *rim = mw__realloc(f->rim, room, sizeof *rim);
    if (!rim) return false;
    f->rim = rim;
    uint32_t *pool = mw__realloc(f->pool, room, sizeof *pool);
    if (!pool) return false;
    f->pool = pool;
    mw_step_ahead *ahead = mw__realloc(f->ahead, room, sizeof *ahead);
    if (!ahead) return false;
    f->ahead = ahead;
    mw_lifted_vertex *sight = mw__realloc(f->sight, 2 * room, sizeof *sight);
    if (!sight) return false;
    f->sight = sight;
    f->rim_room = room;
    return true;
}

void mw__rim_release(mw_fabric *f)
{
    free(f->rim);
    free(f->pool);
    free(f->ahead);
    free(f->sight);
    f->rim = NULL;
    f->pool = NULL;
    f->ahead = NULL;
    f->sight = NULL;
    f->rim_room = 0;
}

size_t mw__rim_bytes(const mw_fabric *f)
{
    return f->rim_room * (sizeof *f->rim + sizeof *f->pool + sizeof *f->ahead + 2 * sizeof *f->sight);
}

/* --- from a tiling ----------------------------------------------------------------------------- */

/* The tiling's arrays, or copies of the mesh's where it has borrowed them, with room for more. */
static bool own_arrays(mw_fabric *f)
{
    mw_tiling *tiling = f->tiling;
    mw_triangle *tri = tiling->tri;
    bool borrowed = tiling->borrowed;
    if (!more_tiles(f, 0)) return false;
    if (!more_points(f, 0)) {
        if (borrowed) { /* neither is the tiling's */
            free(tiling->tri);
            tiling->tri = tri;
        }
        return false;
    }
    tiling->borrowed = false;
    return true;
}

/* Tiles are the user's triangles: none is cut, or has another vertex of the same place. */
static mw_status check(const mw_tiling *tiling, const mw_mesh *mesh, mw_error *error)
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

static bool make_numbers(mw_fabric *f, const mw_mesh *mesh)
{
    mw_tiling *tiling = f->tiling;
    f->number_room = mesh->tri_count;
    f->vertex_room = tiling->point_count;
    f->vertex_slot = mw__alloc(f->vertex_room, sizeof *f->vertex_slot);
    if (!f->vertex_slot || !more_numbers(f, 0)) return false;
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

static void find_tiles(mw_tiling *tiling)
{
    for (uint32_t v = 0; v < tiling->point_count; v++) tiling->tile_at[v] = MW_NONE;
    for (uint32_t t = 0; t < tiling->tri_count; t++)
        for (int k = 0; k < 3; k++) tiling->tile_at[tiling->tri[t].v[k]] = t;
    free(tiling->owner);
    tiling->owner = NULL;
}

static void fix_border(mw_fabric *f)
{
    const mw_tiling *tiling = f->tiling;
    for (uint32_t t = 0; t < tiling->tri_count; t++)
        for (uint32_t k = 0; k < 3; k++) {
            uint32_t link = tiling->tri[t].link[k];
            bool border = link == MW_NONE ? !f->convex && mw__is_users(f, t)
                                          : mw__is_users(f, t) != mw__is_users(f, mw__link_triangle(link));
            if (border) f->mark[t] |= (uint8_t)(1u << k);
        }
}

mw_status mw__fabric_create(mw_fabric *f, mw_tiling *tiling, const mw_mesh *mesh, mw_error *error)
{
    *f = (mw_fabric){.tiling = tiling, .convex = tiling->ghost_count == 0};
    mw_status status = check(tiling, mesh, error);
    if (status) return status;
    if (!own_arrays(f) || !make_numbers(f, mesh)) return mw__fail_memory(error);
    find_tiles(tiling);
    fix_border(f);
    return MW_OK;
}

void mw__fabric_release(mw_fabric *f)
{
    free(f->mark);
    free(f->vertex_slot);
    free(f->vertex_number);
    free(f->free_place);
    free(f->before);
    free(f->step);
    free(f->stack);
    mw__rim_release(f);
    *f = (mw_fabric){0};
}

size_t mw__fabric_bytes(const mw_fabric *f)
{
    const mw_tiling *t = f->tiling;
    return t->tri_count * sizeof *f->mark + f->vertex_count * sizeof *f->vertex_slot +
           t->point_count * sizeof *f->vertex_number + f->free_room * sizeof *f->free_place +
           f->before_room * sizeof *f->before + f->step_room * sizeof *f->step + f->stack_room * sizeof *f->stack +
           mw__rim_bytes(f);
}
