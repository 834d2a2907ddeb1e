/* surface_journal.c - what an edit of a surface changed, and how it is undone. */
#include "surface/edit/surface_journal.h"
#include "surface/edit/surface_corners.h"
#include "surface/edit/surface_followers.h"

#include <inttypes.h>
#include <stdlib.h>
#include <string.h>

/* --- memory --- */

/* Grow an array that begins at a cache line: realloc would not keep that. */
static bool lines_grow(void *array, size_t count, size_t room, size_t size)
{
    void **records = array, *more = mw__alloc_lines(room, size);
    if (!more) return false;
    memcpy(more, *records, count * size);
    free(*records);
    *records = more;
    return true;
}

static size_t larger_room(size_t room, size_t count, size_t most)
{
    size_t more = room + room / 2 + 16;
    if (more < count) more = count;
    return more < most ? more : most;
}

static bool triangles_reserve(mw_surface_editor *e, size_t count)
{
    if (count <= e->tri_room) return true;
    size_t room = larger_room(e->tri_room, count, MW_MAX_TRIANGLES);
    mw_corner *corner = mw__realloc(e->corner, 3 * room, sizeof *corner);
    if (!corner) return false;
    e->corner = corner;
    if (!lines_grow(&e->surface->tri, e->surface->tri_count, room, sizeof *e->surface->tri))
        return false;
    e->tri_room = (uint32_t)room;
    return true;
}

static bool points_reserve(mw_surface_editor *e, size_t count)
{
    if (count <= e->point_room) return true;
    size_t room = larger_room(e->point_room, count, MW_MAX_VERTICES);
    mw_corner_list *at = mw__realloc(e->at, room, sizeof *at);
    if (!at) return false;
    e->at = at;
    if (!lines_grow(&e->surface->point, e->surface->point_count, room, 3 * sizeof(double)))
        return false;
    e->point_room = (uint32_t)room;
    return true;
}

static bool report_reserve(mw_surface_editor *e, size_t triangles, size_t vertices)
{
    return mw__surface_grow(&e->changed_triangle, &e->changed_triangle_room, triangles,
                            sizeof *e->changed_triangle) &&
           mw__surface_grow(&e->changed_vertex, &e->changed_vertex_room, vertices,
                            sizeof *e->changed_vertex);
}

bool mw__surface_reserve_some(mw_surface_editor *e)
{
    return triangles_reserve(e, (size_t)e->surface->tri_count + 1) &&
           points_reserve(e, (size_t)e->surface->point_count + 1) && mw__followers_reserve(e, 1, 1);
}

mw_status mw__surface_edit_begin(mw_surface_editor *e, const mw_surface_needs *needs,
                                 mw_error *error)
{
    mw_surface *s = e->surface;
    if (needs->made >= MW_MAX_TRIANGLES - s->tri_count ||
        needs->vertices >= MW_MAX_VERTICES - s->point_count)
        return mw__fail(error, MW_ERROR_LIMIT,
                        "all numbers are used; mw_surface_editor_compact() frees those of removed "
                        "triangles and vertices");
    if (!triangles_reserve(e, s->tri_count + needs->made) ||
        !points_reserve(e, s->point_count + needs->vertices) ||
        !mw__surface_grow(&e->triangle, &e->triangle_room, e->triangle_count + needs->triangles,
                          sizeof *e->triangle) ||
        !mw__surface_grow(&e->vertex, &e->vertex_room, e->vertex_count + needs->vertex_entries,
                          sizeof *e->vertex) ||
        !mw__surface_grow(&e->step, &e->step_room, e->step_count + 1, sizeof *e->step) ||
        !report_reserve(e, needs->triangles + needs->made, needs->vertex_entries) ||
        !mw__followers_reserve(e, needs->made, needs->vertices))
        return mw__fail_memory(error);
    e->step[e->step_count++] = (mw_surface_step){.first_triangle = e->triangle_count,
                                                 .first_vertex = e->vertex_count,
                                                 .tri_count = s->tri_count,
                                                 .point_count = s->point_count,
                                                 .borders = e->borders};
    e->journal_below = s->tri_count;
    return MW_OK;
}

void mw__surface_record_vertex(mw_surface_editor *e, mw_vertex_event event, uint32_t vertex,
                               uint32_t other)
{
    const double *p = mw__surface_point(e->surface, vertex);
    e->vertex[e->vertex_count++] = (mw_vertex_entry){event, vertex, other, {p[0], p[1], p[2]}};
}

/* --- the report --- */

static int compare_changed(const void *a, const void *b)
{
    const mw_changed_triangle *s = a, *t = b;
    return (s->triangle > t->triangle) - (s->triangle < t->triangle);
}

static int compare_changed_vertices(const void *a, const void *b)
{
    const mw_changed_vertex *s = a, *t = b;
    return (s->vertex > t->vertex) - (s->vertex < t->vertex);
}

/* What became of triangles that an edit recorded. */
typedef enum triangle_fate { FATE_MADE, FATE_REUSED, FATE_FREED, FATE_SAME } triangle_fate;

static triangle_fate entry_fate(const mw_surface_editor *e, const mw_triangle_entry *entry)
{
    bool is = mw__surface_has_triangle(e, entry->triangle), was = mw__entry_was(entry);
    if (is && was) return mw__entry_is_altered(e, entry) ? FATE_REUSED : FATE_SAME;
    return is ? FATE_MADE : was ? FATE_FREED : FATE_SAME;
}

/* Append the triangles with one fate, sorted. Returns how many. */
static size_t report_triangles(mw_surface_editor *e, triangle_fate fate, size_t from)
{
    const mw_surface_step *step = mw__last_step(e);
    size_t n = from;
    for (size_t i = step->first_triangle; i < e->triangle_count; i++) {
        const mw_triangle_entry *entry = &e->triangle[i];
        if (entry_fate(e, entry) != fate) continue;
        mw_changed_triangle *c = &e->changed_triangle[n++];
        c->triangle = entry->triangle;
        for (int k = 0; k < 3; k++) c->before[k] = fate == FATE_MADE ? MW_NONE : entry->before.v[k];
    }
    for (uint32_t t = step->tri_count; fate == FATE_MADE && t < e->surface->tri_count; t++)
        e->changed_triangle[n++] = (mw_changed_triangle){t, {MW_NONE, MW_NONE, MW_NONE}};
    qsort(e->changed_triangle + from, n - from, sizeof *e->changed_triangle, compare_changed);
    return n - from;
}

static size_t report_vertices(mw_surface_editor *e, mw_vertex_event event, size_t from)
{
    size_t n = from;
    for (size_t i = mw__last_step(e)->first_vertex; i < e->vertex_count; i++)
        if (e->vertex[i].event == event)
            e->changed_vertex[n++] = (mw_changed_vertex){e->vertex[i].vertex, e->vertex[i].other};
    qsort(e->changed_vertex + from, n - from, sizeof *e->changed_vertex, compare_changed_vertices);
    return n - from;
}

void mw__surface_report(mw_surface_editor *e, mw_surface_change *change)
{
    *change = (mw_surface_change){.triangle = e->changed_triangle, .vertex = e->changed_vertex};
    change->made = report_triangles(e, FATE_MADE, 0);
    change->reused = report_triangles(e, FATE_REUSED, change->made);
    change->freed = report_triangles(e, FATE_FREED, change->made + change->reused);
    change->vertices_made = report_vertices(e, MW_VERTEX_MADE, 0);
    change->vertices_freed = report_vertices(e, MW_VERTEX_GONE, change->vertices_made);
    change->vertices_moved =
        report_vertices(e, MW_VERTEX_MOVED, change->vertices_made + change->vertices_freed);
}

/* --- the end of an edit --- */

/* Discard the oldest steps; only when at least half are dropped: so each moves once, on average. */
static void journal_forget(mw_surface_editor *e)
{
    if (e->step_count <= e->undo || e->step_count - e->undo < e->undo) return;
    size_t gone = e->step_count - e->undo,
           triangles = e->undo ? e->step[gone].first_triangle : e->triangle_count,
           vertices = e->undo ? e->step[gone].first_vertex : e->vertex_count;
    e->triangle_count -= triangles;
    e->vertex_count -= vertices;
    e->step_count = e->undo;
    if (e->undo == 0) return;
    memmove(e->triangle, e->triangle + triangles, e->triangle_count * sizeof *e->triangle);
    memmove(e->vertex, e->vertex + vertices, e->vertex_count * sizeof *e->vertex);
    memmove(e->step, e->step + gone, e->step_count * sizeof *e->step);
    for (size_t i = 0; i < e->step_count; i++) {
        e->step[i].first_triangle -= triangles;
        e->step[i].first_vertex -= vertices;
    }
}

void mw__surface_commit(mw_surface_editor *e)
{
    for (size_t i = mw__last_step(e)->first_triangle; i < e->triangle_count; i++)
        e->surface->tri[e->triangle[i].triangle].user &= ~MW_SURFACE_RECORDED;
    e->journal_below = 0;
    e->edits++;
    if (e->undoable < e->undo) e->undoable++;
    journal_forget(e);
}

/* --- undo --- */

static void corners_change(mw_surface_editor *e, uint32_t t,
                           void (*change)(mw_surface_editor *, uint32_t, uint32_t))
{
    const mw_triangle *tri = &e->surface->tri[t];
    for (uint32_t k = 0; k < 3 && !(tri->user & MW_SURFACE_FREED); k++)
        change(e, tri->v[k], mw__corner_number(t, k));
}

/* Exchange the entries of the last step, made triangles included, with the triangles. */
static void triangles_restore(mw_surface_editor *e, const mw_surface_step *step)
{
    mw_surface *s = e->surface;
    for (size_t i = step->first_triangle; i < e->triangle_count; i++) {
        mw_triangle_entry *entry = &e->triangle[i];
        mw_triangle *tri = &s->tri[entry->triangle], now = *tri;
        corners_change(e, entry->triangle, mw__corner_drop);
        s->freed_triangles -= (now.user & MW_SURFACE_FREED) != 0;
        if (entry->triangle < step->tri_count) {
            *tri = entry->before;
            s->freed_triangles += (tri->user & MW_SURFACE_FREED) != 0;
            corners_change(e, entry->triangle, mw__corner_add);
        }
        entry->before = now;
    }
    s->tri_count = step->tri_count;
    e->borders = step->borders;
}

static void point_exchange(mw_surface_editor *e, mw_vertex_entry *entry)
{
    double *p = e->surface->point + 3 * (size_t)entry->vertex;
    for (int k = 0; k < 3; k++) {
        double now = p[k];
        p[k] = entry->before[k];
        entry->before[k] = now;
    }
}

/* In turn: what was made is gone, and the other way round. Freed vertices must be back before
 * triangles get them. */
static void vertices_restore(mw_surface_editor *e, const mw_surface_step *step)
{
    for (size_t i = e->vertex_count; i-- > step->first_vertex;) {
        mw_vertex_entry *entry = &e->vertex[i];
        entry->other = MW_NONE;
        if (entry->event == MW_VERTEX_MADE) {
            entry->event = MW_VERTEX_GONE;
        } else if (entry->event == MW_VERTEX_GONE) {
            entry->event = MW_VERTEX_MADE;
            e->at[entry->vertex].first = MW_NONE;
            e->surface->freed_points--;
        } else {
            point_exchange(e, entry);
        }
    }
}

/* Record the triangles that the edit made, so that the reverted step tells them. */
static mw_status revert_reserve(mw_surface_editor *e, const mw_surface_step *step, mw_error *error)
{
    size_t made = e->surface->tri_count - step->tri_count,
           entries = e->triangle_count - step->first_triangle + made, freed = 0;
    for (size_t i = step->first_triangle; i < e->triangle_count; i++)
        freed += mw__surface_is_freed(e->surface, e->triangle[i].triangle);
    if (!mw__surface_grow(&e->triangle, &e->triangle_room, e->triangle_count + made,
                          sizeof *e->triangle) ||
        !report_reserve(e, entries, e->vertex_count - step->first_vertex) ||
        !mw__followers_reserve(e, freed, 0))
        return mw__fail_memory(error);
    for (uint32_t t = step->tri_count; t < e->surface->tri_count; t++)
        e->triangle[e->triangle_count++] = (mw_triangle_entry){t, e->surface->tri[t]};
    return MW_OK;
}

mw_status mw__surface_revert(mw_surface_editor *e, mw_error *error)
{
    const mw_surface_step *step = mw__last_step(e);
    mw_status status = revert_reserve(e, step, error);
    if (status) return status;
    vertices_restore(e, step);
    triangles_restore(e, step);
    e->surface->point_count = step->point_count;
    return MW_OK;
}

void mw__surface_drop_step(mw_surface_editor *e)
{
    const mw_surface_step *step = mw__last_step(e);
    e->triangle_count = step->first_triangle;
    e->vertex_count = step->first_vertex;
    e->step_count--;
    e->undoable--;
}

size_t mw__surface_journal_bytes(const mw_surface_editor *e)
{
    return e->triangle_room * sizeof *e->triangle + e->vertex_room * sizeof *e->vertex +
           e->step_room * sizeof *e->step;
}
