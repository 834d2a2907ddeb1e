/* journal.c - an edit as a whole: what it changed, and how it is taken back. */
#include "edit/journal.h"

#include "edit/fabric_memory.h"
#include "edit/stitch.h"

#include <stdlib.h>
#include <string.h>

bool mw__fabric_begin(mw_fabric *f, const mw_edit *edit, bool recorded)
{
    if (MW_UNLIKELY(!f->before) && !mw__journal_room(f, 1)) return false;
    if (f->step_count == f->step_room) {
        size_t room = f->step_room + f->step_room / 2 + 4;
        mw_step *step = mw__realloc(f->step, room, sizeof *step);
        if (!step) return false;
        f->step = step;
        f->step_room = room;
    }
    const mw_tiling *tiling = f->tiling;
    f->step[f->step_count++] = (mw_step){.edit = *edit,
                                         .edits = 1,
                                         .journal = f->before_count,
                                         .tiles = tiling->tri_count,
                                         .ghosts = tiling->ghost_count,
                                         .numbers = tiling->number_count,
                                         .vertices = f->vertex_count,
                                         .points = tiling->point_count,
                                         .free_places = f->free_count,
                                         .fixed_count = f->fixed_count,
                                         .vertex = MW_NONE,
                                         .delaunay = f->delaunay};
    f->journaled = recorded ? tiling->tri_count : 0;
    f->under_way = true;
    f->flips = 0;
    f->stack_count = 0;
    return true;
}

static void end(mw_fabric *f)
{
    f->journaled = 0;
    f->under_way = false;
}

static void clear_marks(mw_fabric *f, const mw_before *first, size_t count)
{
    for (size_t i = 0; i < count; i++) f->mark[first[i].place] &= (uint8_t)MW_FIXED_EDGES;
}

void mw__fabric_commit(mw_fabric *f)
{
    const mw_before *first;
    size_t count = mw__fabric_journal(f, &first);
    mw_step *step = &f->step[f->step_count - 1];
    step->made = f->vertex_count - step->vertices;
    clear_marks(f, first, count);
    end(f);
}

/* --- taking back ------------------------------------------------------------------------------------------------------ */

/* Exchange the journal of the last step with the tiles. Tiles round about lie beside restored ones only, whose links tell theirs. */
static void exchange_tiles(mw_fabric *f, const mw_step *step)
{
    mw_tiling *tiling = f->tiling;
    for (size_t i = step->journal; i < f->before_count; i++) {
        mw_before *b = &f->before[i], now = {.place = b->place, .tile.v[0] = MW_NONE};
        if (b->place < tiling->tri_count)
            now = (mw_before){b->place, f->mark[b->place] & MW_FIXED_EDGES, tiling->tri[b->place]};
        if (b->tile.v[0] != MW_NONE) {
            tiling->tri[b->place] = b->tile;
            mw__set_fixed(f, b->place, b->mark);
        }
        *b = now;
    }
    tiling->tri_count = step->tiles;
    tiling->ghost_count = step->ghosts;
    tiling->number_count = step->numbers;
    for (size_t i = step->journal; i < f->before_count; i++) {
        uint32_t t = f->before[i].place;
        if (t >= tiling->tri_count) continue;
        for (uint32_t k = 0; k < 3; k++) {
            mw__attach(f, mw__link(t, k), tiling->tri[t].link[k]);
            tiling->tile_at[tiling->tri[t].v[k]] = t;
        }
        if (mw__is_users(f, t)) tiling->tile_of[tiling->tri[t].user & MW_USER_MASK] = t;
    }
}

static void restore_vertices(mw_fabric *f, const mw_step *step)
{
    mw_tiling *tiling = f->tiling;
    while (f->vertex_count > step->vertices) { /* the last one made first */
        uint32_t v = f->vertex_slot[--f->vertex_count];
        tiling->tile_at[v] = MW_NONE;
        if (v < step->points) f->free_place[f->free_count++] = v;
    }
    tiling->point_count = step->points;
    if (f->free_count > step->free_places) {
        uint32_t v = f->free_place[--f->free_count];
        f->vertex_number[v] = step->number;
        f->vertex_slot[step->number] = v;
        tiling->point[v] = step->point;
    }
    if (step->edit.kind == MW_EDIT_MOVE && step->vertex != MW_NONE) tiling->point[step->vertex] = step->point;
    f->fixed_count = step->fixed_count;
    f->delaunay = step->delaunay;
    if (f->last >= tiling->tri_count) f->last = 0;
}

void mw__fabric_rollback(mw_fabric *f)
{
    const mw_step *step = &f->step[f->step_count - 1];
    exchange_tiles(f, step);
    restore_vertices(f, step);
    clear_marks(f, f->before + step->journal, f->before_count - step->journal);
    end(f);
    mw__fabric_drop(f);
}

/* Put the tiles at the end of the array that an edit has made into its journal, for those who ask what was taken back. */
static bool journal_made(mw_fabric *f, const mw_step *step)
{
    const mw_tiling *tiling = f->tiling;
    if (tiling->tri_count <= step->tiles) return true;
    if (!mw__journal_room(f, tiling->tri_count - step->tiles)) return false;
    for (uint32_t t = step->tiles; t < tiling->tri_count; t++)
        f->before[f->before_count++] = (mw_before){t, f->mark[t] & MW_FIXED_EDGES, tiling->tri[t]};
    return true;
}

bool mw__fabric_revert(mw_fabric *f)
{
    const mw_step *step = &f->step[f->step_count - 1];
    if (!journal_made(f, step)) return false;
    exchange_tiles(f, step);
    restore_vertices(f, step);
    f->flips = 0;
    return true;
}

void mw__fabric_drop(mw_fabric *f)
{
    f->before_count = f->step[--f->step_count].journal;
}

/* What the journal of many edits at once needed goes when it is forgotten, if that is more than the mesh has tiles. */
static void shrink_journal(mw_fabric *f)
{
    enum { FEW = 4096 };
    size_t room = FEW + 2 * f->before_count;
    if (f->before_room <= FEW + (size_t)f->tiling->tri_count || room > f->before_room / 2) return;
    mw_before *before = mw__realloc(f->before, room, sizeof *before);
    if (!before) return;
    f->before = before;
    f->before_room = room;
}

void mw__fabric_forget(mw_fabric *f, size_t steps)
{
    if (f->step_count <= steps || f->step_count - steps < steps) return; /* so that each is moved once, on average */
    size_t gone = f->step_count - steps, entries = steps ? f->step[gone].journal : f->before_count;
    f->before_count -= entries;
    f->step_count = steps;
    if (steps > 0) {
        memmove(f->before, f->before + entries, f->before_count * sizeof *f->before);
        memmove(f->step, f->step + gone, steps * sizeof *f->step);
        for (size_t i = 0; i < steps; i++) f->step[i].journal -= entries;
    }
    shrink_journal(f);
}

/* --- what changed ----------------------------------------------------------------------------------------------------- */

static bool is_users(const mw_triangle *tile)
{
    return tile->v[0] != MW_NONE && !(tile->user & MW_GHOST);
}

/* The tile that has a number now; NULL if none has. */
static const mw_triangle *tile_now(const mw_tiling *tiling, uint32_t number)
{
    if (number >= tiling->number_count || tiling->tile_of[number] & MW_GONE) return NULL;
    return &tiling->tri[tiling->tile_of[number]];
}

static mw_changed_triangle made_triangle(const mw_triangle *tile)
{
    return (mw_changed_triangle){tile->user & MW_USER_MASK, {MW_NONE, MW_NONE, MW_NONE}};
}

static int by_number(const void *a, const void *b)
{
    const mw_changed_triangle *s = a, *t = b;
    return (s->triangle > t->triangle) - (s->triangle < t->triangle);
}

/* By number. Most edits change few, which come nearly in order; others many. */
static void sort(mw_changed_triangle *list, size_t n)
{
    enum { FEW = 32 };
    if (n > FEW) {
        qsort(list, n, sizeof *list, by_number);
        return;
    }
    for (size_t i = 1; i < n; i++) {
        mw_changed_triangle moving = list[i];
        size_t k = i;
        for (; k > 0 && list[k - 1].triangle > moving.triangle; k--) list[k] = list[k - 1];
        list[k] = moving;
    }
}

/* The triangles of the journal as they were, sorted; returns how many. */
static size_t list_before(const mw_fabric *f, const mw_before *first, size_t count, mw_changed_triangle *list)
{
    size_t n = 0;
    for (size_t i = 0; i < count; i++) {
        if (!is_users(&first[i].tile)) continue;
        list[n].triangle = first[i].tile.user & MW_USER_MASK;
        mw__fabric_corners(f, &first[i].tile, list[n++].before);
    }
    sort(list, n);
    return n;
}

/* Those that are there now and were not: appended, sorted. In places of the journal, and in those after them. */
static size_t list_made(const mw_fabric *f, const mw_before *first, size_t count, mw_changed_triangle *list,
                        size_t known)
{
    const mw_tiling *tiling = f->tiling;
    uint32_t tiles = f->step[f->step_count - 1].tiles;
    size_t n = known;
    for (size_t i = 0; i < count; i++) {
        if (first[i].place >= tiling->tri_count) continue;
        const mw_triangle *now = &tiling->tri[first[i].place];
        mw_changed_triangle made = made_triangle(now);
        if (is_users(now) && !bsearch(&made, list, known, sizeof *list, by_number)) list[n++] = made;
    }
    for (uint32_t t = tiles; t < tiling->tri_count; t++)
        if (is_users(&tiling->tri[t])) list[n++] = made_triangle(&tiling->tri[t]);
    sort(list + known, n - known);
    return n - known;
}

static bool has_gone(const mw_fabric *f, const mw_changed_triangle *c)
{
    return !tile_now(f->tiling, c->triangle);
}

static bool is_other(const mw_fabric *f, const mw_changed_triangle *c)
{
    uint32_t now[3];
    mw__fabric_corners(f, tile_now(f->tiling, c->triangle), now);
    return memcmp(now, c->before, sizeof now) != 0;
}

void mw__fabric_report(const mw_fabric *f, mw_changed_triangle *list, mw_change *change)
{
    const mw_before *first;
    size_t count = mw__fabric_journal(f, &first);
    mw_changed_triangle *before = list + 2 * mw__fabric_extent(f); /* scratch */
    size_t were = list_before(f, first, count, before), n = 0;
    memcpy(list, before, were * sizeof *list);
    change->made = list_made(f, first, count, list, were);
    memmove(list, list + were, change->made * sizeof *list);
    n = change->made;
    for (size_t i = 0; i < were; i++)
        if (!has_gone(f, &before[i]) && is_other(f, &before[i])) list[n++] = before[i];
    change->reused = n - change->made;
    for (size_t i = 0; i < were; i++)
        if (has_gone(f, &before[i])) list[n++] = before[i];
    change->freed = n - change->made - change->reused;
    change->triangle = list;
    change->flips = f->flips;
}
