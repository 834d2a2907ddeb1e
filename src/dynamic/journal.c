/* journal.c - an edit as a whole: what it changed, and how it is undone. */
#include "dynamic/journal.h"

#include "dynamic/dynamic_tiling_memory.h"
#include "dynamic/tile_links.h"

#include <stdlib.h>
#include <string.h>

bool mw__journal_begin(mw_dynamic_tiling *dynamic, const mw_edit *edit, bool recorded)
{
    if (MW_UNLIKELY(!dynamic->journal) && !mw__journal_room(dynamic, 1)) return false;
    if (dynamic->step_count == dynamic->step_room) {
        size_t room = dynamic->step_room + dynamic->step_room / 2 + 4;
        mw_journal_edit *step = mw__realloc(dynamic->step, room, sizeof *step);
        if (!step) return false;
        dynamic->step = step;
        dynamic->step_room = room;
    }
    mw_tiling *tiling = dynamic->tiling;
    tiling->hubs = NULL; /* until they have followed the edit */
    dynamic->step[dynamic->step_count++] = (mw_journal_edit){.edit = *edit,
                                                             .edits = 1,
                                                             .first_entry = dynamic->journal_count,
                                                             .tiles = tiling->tri_count,
                                                             .ghosts = tiling->ghost_count,
                                                             .numbers = tiling->number_count,
                                                             .vertices = dynamic->vertex_count,
                                                             .points = tiling->point_count,
                                                             .free_slots = dynamic->free_count,
                                                             .fixed_count = dynamic->fixed_count,
                                                             .vertex = MW_NONE,
                                                             .delaunay = dynamic->delaunay};
    dynamic->journal_below = recorded ? tiling->tri_count : 0;
    dynamic->under_way = true;
    dynamic->flips = 0;
    dynamic->stack_count = 0;
    return true;
}

static void journal_end(mw_dynamic_tiling *dynamic)
{
    dynamic->journal_below = 0;
    dynamic->under_way = false;
}

static void journal_clear_marks(mw_dynamic_tiling *dynamic, const mw_journal_entry *first,
                                size_t count)
{
    for (size_t i = 0; i < count; i++) dynamic->mark[first[i].slot] &= (uint8_t)MW_FIXED_EDGES;
}

void mw__journal_commit(mw_dynamic_tiling *dynamic)
{
    const mw_journal_entry *first;
    size_t count = mw__journal_entries(dynamic, &first);
    mw_journal_edit *step = &dynamic->step[dynamic->step_count - 1];
    step->made = dynamic->vertex_count - step->vertices;
    journal_clear_marks(dynamic, first, count);
    journal_end(dynamic);
}

/* --- undo ------------------------------------------------------------------------------------- */

/* Exchange the entries of the last step with the tiles. Unrecorded neighbours lie beside restored
 * tiles only, and get their links from them. */
static void journal_exchange_tiles(mw_dynamic_tiling *dynamic, const mw_journal_edit *step)
{
    mw_tiling *tiling = dynamic->tiling;
    for (size_t i = step->first_entry; i < dynamic->journal_count; i++) {
        mw_journal_entry *b = &dynamic->journal[i], now = {.slot = b->slot, .tile.v[0] = MW_NONE};
        if (b->slot < tiling->tri_count)
            now = (mw_journal_entry){b->slot, dynamic->mark[b->slot] & MW_FIXED_EDGES,
                                     tiling->tri[b->slot]};
        if (b->tile.v[0] != MW_NONE) {
            tiling->tri[b->slot] = b->tile;
            mw__set_fixed(dynamic, b->slot, b->mark);
        }
        *b = now;
    }
    tiling->tri_count = step->tiles;
    tiling->ghost_count = step->ghosts;
    tiling->number_count = step->numbers;
    for (size_t i = step->first_entry; i < dynamic->journal_count; i++) {
        uint32_t t = dynamic->journal[i].slot;
        if (t >= tiling->tri_count) continue;
        for (uint32_t k = 0; k < 3; k++) {
            mw__attach(dynamic, mw__link(t, k), tiling->tri[t].link[k]);
            tiling->tile_at[tiling->tri[t].v[k]] = t;
        }
        if (mw__is_users_tile(dynamic, t)) tiling->tile_of[tiling->tri[t].user & MW_USER_MASK] = t;
    }
}

static void journal_restore_vertices(mw_dynamic_tiling *dynamic, const mw_journal_edit *step)
{
    mw_tiling *tiling = dynamic->tiling;
    while (dynamic->vertex_count > step->vertices) { /* the newest first */
        uint32_t v = dynamic->vertex_slot[--dynamic->vertex_count];
        tiling->tile_at[v] = MW_NONE;
        if (v < step->points) dynamic->free_slot[dynamic->free_count++] = v;
    }
    tiling->point_count = step->points;
    if (dynamic->free_count > step->free_slots) {
        uint32_t v = dynamic->free_slot[--dynamic->free_count];
        dynamic->vertex_number[v] = step->number;
        dynamic->vertex_slot[step->number] = v;
        tiling->point[v] = step->point;
    }
    if (step->edit.kind == MW_EDIT_MOVE && step->vertex != MW_NONE)
        tiling->point[step->vertex] = step->point;
    dynamic->fixed_count = step->fixed_count;
    dynamic->delaunay = step->delaunay;
    if (dynamic->last >= tiling->tri_count) dynamic->last = 0;
}

void mw__journal_rollback(mw_dynamic_tiling *dynamic)
{
    const mw_journal_edit *step = &dynamic->step[dynamic->step_count - 1];
    journal_exchange_tiles(dynamic, step);
    journal_restore_vertices(dynamic, step);
    journal_clear_marks(dynamic, dynamic->journal + step->first_entry,
                        dynamic->journal_count - step->first_entry);
    journal_end(dynamic);
    mw__journal_drop(dynamic);
}

/* Record the tiles that an edit added at the end of the array, so that the reverted step tells
 * them. */
static bool journal_add_made(mw_dynamic_tiling *dynamic, const mw_journal_edit *step)
{
    const mw_tiling *tiling = dynamic->tiling;
    if (tiling->tri_count <= step->tiles) return true;
    if (!mw__journal_room(dynamic, tiling->tri_count - step->tiles)) return false;
    for (uint32_t t = step->tiles; t < tiling->tri_count; t++)
        dynamic->journal[dynamic->journal_count++] =
            (mw_journal_entry){t, dynamic->mark[t] & MW_FIXED_EDGES, tiling->tri[t]};
    return true;
}

bool mw__journal_revert(mw_dynamic_tiling *dynamic)
{
    const mw_journal_edit *step = &dynamic->step[dynamic->step_count - 1];
    if (!journal_add_made(dynamic, step)) return false;
    journal_exchange_tiles(dynamic, step);
    journal_restore_vertices(dynamic, step);
    dynamic->flips = 0;
    return true;
}

void mw__journal_drop(mw_dynamic_tiling *dynamic)
{
    dynamic->journal_count = dynamic->step[--dynamic->step_count].first_entry;
}

/* After a step of many edits was forgotten, release its memory, if that is more than the mesh has
 * tiles. */
static void shrink_journal(mw_dynamic_tiling *dynamic)
{
    enum { FEW = 4096 };
    size_t room = FEW + 2 * dynamic->journal_count;
    if (dynamic->journal_room <= FEW + (size_t)dynamic->tiling->tri_count ||
        room > dynamic->journal_room / 2)
        return;
    mw_journal_entry *entries = mw__realloc(dynamic->journal, room, sizeof *entries);
    if (!entries) return;
    dynamic->journal = entries;
    dynamic->journal_room = room;
}

void mw__journal_forget(mw_dynamic_tiling *dynamic, size_t steps)
{
    /* only when at least half of the steps are dropped: so each step moves once, on average */
    if (dynamic->step_count <= steps || dynamic->step_count - steps < steps) return;
    size_t gone = dynamic->step_count - steps,
           entries = steps ? dynamic->step[gone].first_entry : dynamic->journal_count;
    dynamic->journal_count -= entries;
    dynamic->step_count = steps;
    if (steps > 0) {
        memmove(dynamic->journal, dynamic->journal + entries,
                dynamic->journal_count * sizeof *dynamic->journal);
        memmove(dynamic->step, dynamic->step + gone, steps * sizeof *dynamic->step);
        for (size_t i = 0; i < steps; i++) dynamic->step[i].first_entry -= entries;
    }
    shrink_journal(dynamic);
}

/* --- what changed ----------------------------------------------------------------------------- */

static bool is_users_triangle(const mw_triangle *tile)
{
    return tile->v[0] != MW_NONE && !(tile->user & MW_GHOST);
}

/* The tile that has a number now; NULL if no tile has. */
static const mw_triangle *tile_with_number(const mw_tiling *tiling, uint32_t number)
{
    if (number >= tiling->number_count || tiling->tile_of[number] & MW_GONE) return NULL;
    return &tiling->tri[tiling->tile_of[number]];
}

static mw_changed_triangle made_triangle(const mw_triangle *tile)
{
    return (mw_changed_triangle){tile->user & MW_USER_MASK, {MW_NONE, MW_NONE, MW_NONE}};
}

static int compare_by_number(const void *a, const void *b)
{
    const mw_changed_triangle *s = a, *t = b;
    return (s->triangle > t->triangle) - (s->triangle < t->triangle);
}

/* Most edits change few triangles, which are nearly sorted already. */
static void sort_by_number(mw_changed_triangle *list, size_t n)
{
    enum { FEW = 32 };
    if (n > FEW) {
        qsort(list, n, sizeof *list, compare_by_number);
        return;
    }
    for (size_t i = 1; i < n; i++) {
        mw_changed_triangle moving = list[i];
        size_t k = i;
        for (; k > 0 && list[k - 1].triangle > moving.triangle; k--) list[k] = list[k - 1];
        list[k] = moving;
    }
}

/* List the triangles of the entries, as they were before the edit, sorted; returns how many. */
static size_t list_former(const mw_dynamic_tiling *dynamic, const mw_journal_entry *first,
                          size_t count, mw_changed_triangle *list)
{
    size_t n = 0;
    for (size_t i = 0; i < count; i++) {
        if (!is_users_triangle(&first[i].tile)) continue;
        list[n].triangle = first[i].tile.user & MW_USER_MASK;
        mw__dynamic_tile_vertices(dynamic, &first[i].tile, list[n++].before);
    }
    sort_by_number(list, n);
    return n;
}

/* Append the triangles that exist now and did not before, sorted; returns how many. They are in
 * slots of entries, and in slots at the end of the array. A triangle at the end with an older
 * number has only changed its slot. */
static size_t list_made(const mw_dynamic_tiling *dynamic, const mw_journal_entry *first,
                        size_t count, mw_changed_triangle *list, size_t known)
{
    const mw_tiling *tiling = dynamic->tiling;
    const mw_journal_edit *step = &dynamic->step[dynamic->step_count - 1];
    size_t n = known;
    for (size_t i = 0; i < count; i++) {
        if (first[i].slot >= tiling->tri_count) continue;
        const mw_triangle *now = &tiling->tri[first[i].slot];
        mw_changed_triangle made = made_triangle(now);
        if (is_users_triangle(now) && !bsearch(&made, list, known, sizeof *list, compare_by_number))
            list[n++] = made;
    }
    for (uint32_t t = step->tiles; t < tiling->tri_count; t++) {
        const mw_triangle *now = &tiling->tri[t];
        if (is_users_triangle(now) && (now->user & MW_USER_MASK) >= step->numbers)
            list[n++] = made_triangle(now);
    }
    sort_by_number(list + known, n - known);
    return n - known;
}

static bool triangle_is_gone(const mw_dynamic_tiling *dynamic, const mw_changed_triangle *c)
{
    return !tile_with_number(dynamic->tiling, c->triangle);
}

static bool triangle_is_changed(const mw_dynamic_tiling *dynamic, const mw_changed_triangle *c)
{
    uint32_t now[3];
    mw__dynamic_tile_vertices(dynamic, tile_with_number(dynamic->tiling, c->triangle), now);
    return memcmp(now, c->before, sizeof now) != 0;
}

void mw__journal_report(const mw_dynamic_tiling *dynamic, mw_changed_triangle *list,
                        mw_change *change)
{
    const mw_journal_entry *first;
    size_t count = mw__journal_entries(dynamic, &first);
    mw_changed_triangle *before = list + 2 * mw__journal_extent(dynamic); /* scratch */
    size_t were = list_former(dynamic, first, count, before), n = 0;
    memcpy(list, before, were * sizeof *list);
    change->made = list_made(dynamic, first, count, list, were);
    memmove(list, list + were, change->made * sizeof *list);
    n = change->made;
    for (size_t i = 0; i < were; i++)
        if (!triangle_is_gone(dynamic, &before[i]) && triangle_is_changed(dynamic, &before[i]))
            list[n++] = before[i];
    change->reused = n - change->made;
    for (size_t i = 0; i < were; i++)
        if (triangle_is_gone(dynamic, &before[i])) list[n++] = before[i];
    change->freed = n - change->made - change->reused;
    change->triangle = list;
    change->flips = dynamic->flips;
}
