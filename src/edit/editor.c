/* editor.c - making an editor, and carrying out edits. */
#include "edit/editor.h"
#include "base/options.h"

#include "tiling/tiling_create.h"
#include "dynamic/dynamic_tiling_memory.h"
#include "walk/prefetch.h"
#include "dynamic/flip.h"
#include "dynamic/journal.h"
#include "dynamic/move/move.h"
#include "dynamic/operations.h"
#include "dynamic/vertex_star.h"

#include <inttypes.h>
#include <stdlib.h>
#include <string.h>

/* --- making ----------------------------------------------------------------------------------- */

void mw__editor_update_view(mw_editor *editor)
{
    const mw_dynamic_tiling *dynamic = &editor->dynamic;
    const mw_tiling *tiling = &editor->locator.tiling;
    mw_mesh *view = &editor->view;
    view->point = tiling->point;
    view->tri = tiling->tri;
    view->triangle_slot = tiling->tile_of;
    view->vertex_slot = dynamic->vertex_slot;
    view->vertex_number = dynamic->vertex_number;
    view->point_count = tiling->point_count;
    view->tri_count = tiling->tri_count;
}

mw_status mw__fix_edges(mw_dynamic_tiling *dynamic, const uint32_t *ends, size_t count,
                        mw_error *error)
{
    if (!mw__journal_begin(dynamic, &(mw_edit){.kind = MW_EDIT_CONSTRAIN}, true))
        return mw__fail_memory(error);
    mw_status status = MW_OK;
    for (size_t i = 0; i < count && !status; i++) {
        uint32_t a = mw__used_vertex_slot(dynamic, ends[2 * i]),
                 b = mw__used_vertex_slot(dynamic, ends[2 * i + 1]), constrained_edges;
        if (a == MW_NONE || b == MW_NONE || a == b || mw__dynamic_edge(dynamic, a, b) == MW_NONE)
            status = mw__fail_at(error, -1, ends[2 * i],
                                 "the constraint from vertex %" PRIu32 " to %" PRIu32
                                 " is not an edge of the mesh",
                                 ends[2 * i], ends[2 * i + 1]);
        else
            status = mw__dynamic_constrain(dynamic, a, b, false, &constrained_edges, error);
    }
    if (status) {
        mw__journal_rollback(dynamic);
        return status;
    }
    mw__journal_commit(dynamic);
    mw__journal_forget(dynamic, 0);
    return MW_OK;
}

static bool dynamic_is_delaunay(const mw_dynamic_tiling *dynamic)
{
    for (uint32_t t = 0; t < dynamic->tiling->tri_count; t++)
        for (uint32_t k = 0; k < 3; k++) {
            uint32_t half = mw__link(t, k), other = mw__beyond(dynamic, half);
            if (other != MW_NONE && other > half && mw__is_users_tile(dynamic, t) &&
                mw__edge_is_illegal(dynamic, half))
                return false;
        }
    return true;
}

static mw_status editor_choose_delaunay(mw_dynamic_tiling *dynamic, mw_delaunay_mode wanted,
                                        mw_error *error)
{
    dynamic->delaunay = wanted != MW_DELAUNAY_NEVER && dynamic_is_delaunay(dynamic);
    if (wanted != MW_DELAUNAY_MAKE || dynamic->delaunay) return MW_OK;
    mw_status status = mw__journal_begin(dynamic, &(mw_edit){.kind = MW_EDIT_FLIP}, true)
                           ? mw__dynamic_make_delaunay(dynamic, error)
                           : mw__fail_memory(error);
    if (status) return status;
    mw__journal_commit(dynamic);
    mw__journal_forget(dynamic, 0);
    mw__dynamic_trim(dynamic); /* no edit will need as much */
    return MW_OK;
}

static bool copy_fields(mw_editor *editor, const mw_mesh *mesh)
{
    mw_mesh *view = &editor->view;
    editor->field_room = mesh->point_count;
    view->field = mw__calloc(mesh->field_count, sizeof *view->field);
    if (!view->field) return false;
    for (; view->field_count < mesh->field_count; view->field_count++) {
        mw_field *field = &view->field[view->field_count];
        const mw_field *from = &mesh->field[view->field_count];
        size_t size = strlen(from->name) + 1;
        field->name = mw__alloc(size, 1);
        field->values = mw__alloc(mesh->point_count, sizeof *field->values);
        if (!field->name || !field->values) {
            view->field_count++;
            return false;
        }
        memcpy(field->name, from->name, size);
        memcpy(field->values, from->values, mesh->point_count * sizeof *field->values);
    }
    return true;
}

static mw_status editor_make(mw_editor *editor, const mw_mesh *mesh,
                             const mw_editor_options *options, mw_job *job, mw_error *error)
{
    mw_locator *locator = &editor->locator;
    mw_dynamic_tiling *dynamic = &editor->dynamic;
    locator->mesh = &editor->view;
    mw_job_span outer = mw__job_part(job, 0.6);
    mw_status status =
        mw__tiling_create(mesh, (mw_tiling_options){0}, job, &locator->tiling, error);
    mw__job_part_end(job, outer);
    mw__job_stage(job, "preparing edits", 0.3);
    if (!status)
        status = mw__dynamic_create(dynamic, &locator->tiling, mesh,
                                    locator->tiling.ghost_count == 0, error);
    if (!status)
        status = mw__fix_edges(dynamic, options->constrained_edges, options->constrained_edge_count,
                               error);
    if (!status) status = editor_choose_delaunay(dynamic, options->delaunay, error);
    if (!status && !copy_fields(editor, mesh)) status = mw__fail_memory(error);
    if (status) return status;
    mw__editor_update_view(editor);
    outer = mw__job_part(job, 0.1);
    status = mw__upkeep_create(&editor->upkeep, locator, dynamic, job, error);
    mw__job_part_end(job, outer);
    return status ? status : mw_cursor_init(locator, NULL, &editor->cursor, error);
}

mw_status mw_editor_create(const mw_mesh *mesh, const mw_editor_options *options, mw_editor **out,
                           mw_error *error)
{
    static const mw_editor_options defaults;
    if (!out) return mw__fail(error, MW_ERROR_ARGUMENT, "the pointer to the new editor is NULL");
    *out = NULL;
    if (!mesh) return mw__fail(error, MW_ERROR_ARGUMENT, "no mesh");
    if (!options) options = &defaults;
    if ((unsigned)options->delaunay > MW_DELAUNAY_NEVER)
        return mw__fail(error, MW_ERROR_ARGUMENT, "unknown way to keep a mesh Delaunay");
    if (options->constrained_edge_count > 0 && !options->constrained_edges)
        return mw__fail(error, MW_ERROR_ARGUMENT, "no constraints");
    if (mesh->flat_count == mesh->tri_count)
        return mw__fail(error, MW_ERROR_INPUT, "the mesh has no triangle with an area");
    mw_status status = MW_RESERVED_CHECK(mw_editor_options, options, error);
    if (status) return status;
    mw_editor *editor = mw__calloc(1, sizeof *editor);
    if (!editor) return mw__fail_memory(error);
    editor->keeps_log = options->log != 0;
    editor->threads = options->threads;
    editor->progress = options->progress;
    editor->undo = options->undo;
    mw_job job = mw__job(options->threads, options->progress);
    status = mw__job_end(&job, editor_make(editor, mesh, options, &job, error), error);
    if (status)
        mw_editor_destroy(editor);
    else
        *out = editor;
    return status;
}

void mw_editor_destroy(mw_editor *editor)
{
    if (!editor) return;
    mw__upkeep_release(&editor->upkeep);
    mw__dynamic_release(&editor->dynamic);
    mw__tiling_release(&editor->locator.tiling);
    for (size_t i = 0; i < editor->view.field_count; i++) {
        free(editor->view.field[i].name);
        free(editor->view.field[i].values);
    }
    free(editor->view.field);
    free(editor->log);
    free(editor->changed);
    free(editor);
}

/* --- values at new vertices ------------------------------------------------------------------- */

bool mw__field_room(mw_editor *editor, size_t more)
{
    const size_t needed = editor->dynamic.vertex_count + more;
    if (editor->view.field_count == 0 || needed <= editor->field_room) return true;
    size_t room = needed + needed / 4 + 16;
    for (size_t i = 0; i < editor->view.field_count; i++) {
        double *values = mw__realloc(editor->view.field[i].values, room, sizeof *values);
        if (!values) return false;
        editor->view.field[i].values = values;
    }
    editor->field_room = room;
    return true;
}

/* Set the values of the next vertex, interpolated in the mesh without it. *borrows: the point lies
 * outside of the mesh. The search begins at tile `from`; returns the tile where it ends. */
static uint32_t editor_set_values(mw_editor *editor, const mw_edit *edit, uint32_t from,
                                  bool *borrows)
{
    const mw_dynamic_tiling *dynamic = &editor->dynamic;
    mw_mesh *view = &editor->view;
    editor->cursor.last = from;
    editor->cursor.epoch = editor->locator.epoch;
    mw__editor_update_view(editor);
    mw_location at = mw_locate(&editor->locator, &editor->cursor, edit->x, edit->y);
    *borrows = at.triangle == MW_NONE;
    for (uint32_t i = 0; i < view->field_count; i++) {
        double *values = view->field[i].values, *value = &values[dynamic->vertex_count];
        if (i == edit->field && !isnan(edit->value))
            *value = edit->value;
        else
            mw_interpolate(view, values, &at, 1, value);
    }
    return editor->cursor.last;
}

/* The vertex nearer to p: v (which may be MW_NONE) or w. Of equally near ones, the lower number. */
static uint32_t nearer_vertex(const mw_dynamic_tiling *dynamic, mw_point p, uint32_t v, uint32_t w)
{
    if (v == MW_NONE) return w;
    double one = mw__square_length(dynamic->tiling->point[v], p),
           two = mw__square_length(dynamic->tiling->point[w], p);
    return two < one || (two == one && dynamic->vertex_number[w] < dynamic->vertex_number[v]) ? w
                                                                                              : v;
}

/* A vertex outside of the former hull takes the values of the nearest vertex that it is joined
 * to. */
static void borrow_values(mw_editor *editor, const mw_edit *edit, uint32_t v)
{
    const mw_dynamic_tiling *dynamic = &editor->dynamic;
    bool open;
    uint32_t best = MW_NONE, vertex = dynamic->vertex_number[v];
    for (uint32_t at = mw__vertex_star_first(dynamic, v, &open); at != MW_NONE;
         at = mw__beyond(dynamic, mw__half_prev(at))) {
        best = nearer_vertex(dynamic, dynamic->tiling->point[v], best,
                             mw__corner(dynamic, mw__half_next(at)));
        best = nearer_vertex(dynamic, dynamic->tiling->point[v], best,
                             mw__corner(dynamic, mw__half_prev(at)));
    }
    for (uint32_t i = 0; i < editor->view.field_count; i++)
        if (i != edit->field || isnan(edit->value))
            editor->view.field[i].values[vertex] =
                editor->view.field[i].values[dynamic->vertex_number[best]];
}

/* --- edits ------------------------------------------------------------------------------------ */

static mw_status refuse_vertex(const mw_dynamic_tiling *dynamic, uint32_t number, mw_error *error)
{
    bool gone = number >= dynamic->vertex_count || dynamic->vertex_slot[number] == MW_NONE;
    return mw__fail_at(error, -1, number, "vertex %" PRIu32 " %s", number,
                       gone ? "is not there" : "is in no triangle");
}

/* The tile where the search for q begins: the one that the guide names, which is near as a rule. To
 * test whether the tile of the last edit is nearer would cost more than it saves. Only after a long
 * walk (as when many vertices have come into one cell) that test is made, until walks are short
 * again. */
static uint32_t insertion_first_tile(mw_editor *editor, mw_point q)
{
    const mw_locator *locator = &editor->locator;
    const uint32_t last = editor->dynamic.last;
    editor->guide_led_far = editor->guide_led_far && mw__locator_is_close(locator, last, q);
    return MW_UNLIKELY(editor->guide_led_far)
               ? last
               : mw__index_tile(&locator->tiling, &locator->guide, q);
}

/* Insert a vertex at q in a mesh without fields. */
static mw_status editor_insert_at(mw_editor *editor, mw_point q, uint32_t t, uint32_t *slot,
                                  mw_error *error)
{
    enum { FAR = 8 };
    mw_dynamic_tiling *dynamic = &editor->dynamic;
    if (t != MW_NONE) return mw__dynamic_insert(dynamic, q, t, slot, error);
    t = insertion_first_tile(editor, q);
    if (editor->upkeep.large) {
        mw__prefetch_tiles_round(dynamic->tiling, t);
        mw__prefetch_points_round(dynamic->tiling, dynamic->tiling->tri[t].v[0]);
    }
    mw_status status = mw__dynamic_insert(dynamic, q, t, slot, error);
    editor->guide_led_far |= dynamic->walked > FAR;
    return status;
}

static __attribute__((noinline)) mw_status editor_insert_with_values(mw_editor *editor,
                                                                     const mw_edit *edit,
                                                                     uint32_t t, uint32_t *vertex,
                                                                     mw_error *error)
{
    mw_dynamic_tiling *dynamic = &editor->dynamic;
    const uint32_t before = dynamic->vertex_count;
    bool borrows;
    uint32_t slot = MW_NONE;
    if (!isnan(edit->value) && edit->field >= editor->view.field_count)
        return mw__fail(error, MW_ERROR_ARGUMENT, "no such field");
    if (!mw__field_room(editor, 1)) return mw__fail_memory(error);
    t = editor_set_values(editor, edit, t == MW_NONE ? dynamic->last : t, &borrows);
    mw_status status = mw__dynamic_insert(dynamic, (mw_point){edit->x, edit->y}, t, &slot, error);
    if (status) return status;
    if (borrows && dynamic->vertex_count > before) borrow_values(editor, edit, slot);
    *vertex = dynamic->vertex_number[slot];
    return MW_OK;
}

mw_status mw__editor_insert(mw_editor *editor, const mw_edit *edit, uint32_t t, uint32_t *vertex,
                            mw_error *error)
{
    mw_dynamic_tiling *dynamic = &editor->dynamic;
    const mw_point q = {edit->x, edit->y};
    if (!isfinite(q.x) || !isfinite(q.y))
        return mw__fail(error, MW_ERROR_INPUT, "the point is not finite");
    if (editor->view.field_count > 0)
        return editor_insert_with_values(editor, edit, t, vertex, error);
    uint32_t slot = MW_NONE;
    mw_status status = editor_insert_at(editor, q, t, &slot, error);
    if (!status) *vertex = dynamic->vertex_number[slot];
    return status;
}

static mw_status edit_insert(mw_editor *editor, const mw_edit *edit, mw_change *change,
                             mw_error *error)
{
    const uint32_t before = editor->dynamic.vertex_count;
    mw_status status = mw__editor_insert(editor, edit, MW_NONE, &change->vertex, error);
    change->vertices_made = editor->dynamic.vertex_count > before;
    return status;
}

static mw_status change_vertex(mw_editor *editor, const mw_edit *edit, mw_change *change,
                               mw_error *error)
{
    mw_dynamic_tiling *dynamic = &editor->dynamic;
    uint32_t v = mw__used_vertex_slot(dynamic, edit->vertex);
    if (v == MW_NONE) return refuse_vertex(dynamic, edit->vertex, error);
    change->vertex = edit->vertex;
    if (editor->upkeep.large) {
        mw__prefetch_points_round(dynamic->tiling, v);
        mw__prefetch_tiles_round(dynamic->tiling, dynamic->tiling->tile_at[v]);
    }
    if (edit->kind == MW_EDIT_REMOVE) {
        change->vertices_freed = 1;
        return mw__dynamic_remove(dynamic, v, error);
    }
    if (!isfinite(edit->x) || !isfinite(edit->y))
        return mw__fail(error, MW_ERROR_INPUT, "the point is not finite");
    mw_point q = {edit->x, edit->y};
    return mw__dynamic_move(
        dynamic, v, q, mw__locator_guided_tile(&editor->locator, dynamic->tiling->tile_at[v], q),
        error);
}

static mw_status change_edge(mw_dynamic_tiling *dynamic, const mw_edit *edit, mw_change *change,
                             mw_error *error)
{
    uint32_t v = mw__used_vertex_slot(dynamic, edit->vertex),
             w = mw__used_vertex_slot(dynamic, edit->other);
    if (v == MW_NONE) return refuse_vertex(dynamic, edit->vertex, error);
    if (w == MW_NONE) return refuse_vertex(dynamic, edit->other, error);
    if (v == w)
        return mw__fail_at(error, -1, edit->vertex, "both ends are vertex %" PRIu32, edit->vertex);
    if (edit->kind == MW_EDIT_FLIP) return mw__dynamic_flip(dynamic, v, w, error);
    return mw__dynamic_constrain(dynamic, v, w, edit->kind == MW_EDIT_RELEASE,
                                 &change->constrained_edges, error);
}

static mw_status change_value(mw_editor *editor, const mw_edit *edit, mw_error *error)
{
    const mw_dynamic_tiling *dynamic = &editor->dynamic;
    if (edit->field >= editor->view.field_count)
        return mw__fail(error, MW_ERROR_ARGUMENT, "no such field");
    if (edit->vertex >= dynamic->vertex_count || dynamic->vertex_slot[edit->vertex] == MW_NONE)
        return refuse_vertex(dynamic, edit->vertex, error);
    dynamic->step[dynamic->step_count - 1].value =
        editor->view.field[edit->field].values[edit->vertex];
    return MW_OK; /* mw_edit_apply writes the new value, when nothing can fail any more */
}

static mw_status edit_carry_out(mw_editor *editor, const mw_edit *edit, mw_change *change,
                                mw_error *error)
{
    switch (edit->kind) {
    case MW_EDIT_INSERT: return edit_insert(editor, edit, change, error);
    case MW_EDIT_REMOVE:
    case MW_EDIT_MOVE: return change_vertex(editor, edit, change, error);
    case MW_EDIT_FLIP:
    case MW_EDIT_CONSTRAIN:
    case MW_EDIT_RELEASE: return change_edge(&editor->dynamic, edit, change, error);
    case MW_EDIT_VALUE: return change_value(editor, edit, error);
    case MW_EDIT_KIND_COUNT: break;
    }
    return mw__fail(error, MW_ERROR_ARGUMENT, "unknown kind of edit");
}

bool mw__log_room(mw_editor *editor, size_t more)
{
    if (!editor->keeps_log || more <= editor->log_room - editor->log_count) return true;
    size_t room = editor->log_count + editor->log_count / 2 + more + 16;
    mw_edit *log = mw__realloc(editor->log, room, sizeof *log);
    if (!log) return false;
    editor->log = log;
    editor->log_room = room;
    return true;
}

/* Room for the report of the step under way. */
static bool report_room(mw_editor *editor)
{
    size_t count = 3 * mw__journal_extent(&editor->dynamic), room = count + count / 2 + 16;
    if (editor->changed && count <= editor->changed_room) return true;
    mw_changed_triangle *changed = mw__realloc(editor->changed, room, sizeof *changed);
    if (!changed) return false;
    editor->changed = changed;
    editor->changed_room = room;
    return true;
}

mw_status mw__editor_conclude(mw_editor *editor, mw_status status, const mw_change *own,
                              mw_change *change, mw_error *error)
{
    mw_dynamic_tiling *dynamic = &editor->dynamic;
    if (!status && change && !report_room(editor)) status = mw__fail_memory(error);
    if (status) {
        if (dynamic->under_way) mw__journal_rollback(dynamic);
        mw__editor_update_view(editor);
        mw__upkeep_resume(&editor->upkeep);
        return status;
    }
    mw__editor_update_view(editor);
    mw__journal_commit(dynamic);
    if (editor->undoable < editor->undo) editor->undoable++;
    editor->edits += dynamic->step[dynamic->step_count - 1].edits;
    mw__upkeep_edit(&editor->upkeep, false);
    if (change) {
        *change = *own;
        mw__journal_report(dynamic, editor->changed, change);
    }
    mw__journal_forget(dynamic, editor->undo);
    return MW_OK;
}

/* Insert a vertex when nobody needs to know what changed. There is no step unless
 * mw__dynamic_insert begins one. */
static mw_status editor_insert_unreported(mw_editor *editor, const mw_edit *edit, mw_error *error)
{
    mw_dynamic_tiling *dynamic = &editor->dynamic;
    const uint32_t before = dynamic->vertex_count;
    uint32_t vertex;
    mw_status status = mw__editor_insert(editor, edit, MW_NONE, &vertex, error);
    if (MW_UNLIKELY(status || dynamic->under_way)) {
        const mw_change own = {.vertex = MW_NONE};
        return mw__editor_conclude(editor, status, &own, NULL, error);
    }
    mw__editor_update_view(editor);
    editor->edits++;
    mw__upkeep_insertion(&editor->upkeep,
                         dynamic->vertex_count > before ? dynamic->vertex_slot[vertex] : MW_NONE);
    return MW_OK;
}

mw_status mw_edit_apply(mw_editor *editor, const mw_edit *edit, mw_change *change, mw_error *error)
{
    if (!editor || !edit)
        return mw__fail(error, MW_ERROR_ARGUMENT, "the editor or the edit is NULL");
    if (edit->kind == MW_EDIT_INSERT && !editor->keeps_log &&
        !mw__editor_needs_report(editor, change, 1))
        return editor_insert_unreported(editor, edit, error);
    const mw_edit copy = *edit; /* the caller may pass an entry of the log, which may move */
    mw_change own = {.vertex = MW_NONE};
    if (!mw__log_room(editor, 1) || !mw__journal_begin(&editor->dynamic, &copy, true))
        return mw__fail_memory(error);
    mw_status status = mw__editor_conclude(editor, edit_carry_out(editor, &copy, &own, error), &own,
                                           change, error);
    if (status) return status;
    if (editor->keeps_log) editor->log[editor->log_count++] = copy;
    if (copy.kind == MW_EDIT_VALUE) editor->view.field[copy.field].values[copy.vertex] = copy.value;
    return MW_OK;
}

/* --- undo ------------------------------------------------------------------------------------- */

static void undo_value(mw_editor *editor, const mw_journal_edit *step)
{
    if (step->edit.kind == MW_EDIT_VALUE)
        editor->view.field[step->edit.field].values[step->edit.vertex] = step->value;
}

/* What undoing an edit did to a vertex. `vertices`: how many numbers of vertices were given out
 * before. */
static mw_change undone_change(const mw_dynamic_tiling *dynamic, const mw_journal_edit *step,
                               uint32_t vertices)
{
    mw_change change = {.vertex = MW_NONE};
    if (step->vertex == MW_NONE) return change;
    change.vertex = step->made > 0 ? step->vertices : dynamic->vertex_number[step->vertex];
    change.vertices_freed = vertices - dynamic->vertex_count;
    change.vertices_made = step->edit.kind == MW_EDIT_REMOVE;
    return change;
}

mw_status mw_edit_undo(mw_editor *editor, mw_change *change, mw_error *error)
{
    if (!editor) return mw__fail(error, MW_ERROR_ARGUMENT, "the editor or the edit is NULL");
    if (editor->undoable == 0) return mw__fail(error, MW_ERROR_INPUT, "there is no edit to undo");
    if (change && !report_room(editor)) return mw__fail_memory(error);
    mw_dynamic_tiling *dynamic = &editor->dynamic;
    uint32_t vertices = dynamic->vertex_count;
    if (!mw__journal_revert(dynamic)) return mw__fail_memory(error);
    const mw_journal_edit *step = &dynamic->step[dynamic->step_count - 1];
    undo_value(editor, step);
    if (editor->keeps_log) editor->log_count -= step->edits;
    editor->undoable--;
    editor->edits++;
    mw__editor_update_view(editor);
    mw__upkeep_edit(&editor->upkeep, true);
    if (change) {
        *change = undone_change(dynamic, step, vertices);
        mw__journal_report(dynamic, editor->changed, change);
    }
    mw__journal_drop(dynamic);
    return MW_OK;
}

const mw_edit *mw_editor_log(const mw_editor *editor, size_t *count)
{
    *count = editor->log_count;
    return editor->log_count > 0 ? editor->log : NULL;
}

/* --- each kind by itself ---------------------------------------------------------------------- */

mw_status mw_edit_insert(mw_editor *editor, double x, double y, mw_change *change, mw_error *error)
{
    mw_edit edit = {.kind = MW_EDIT_INSERT, .x = x, .y = y, .value = NAN};
    return mw_edit_apply(editor, &edit, change, error);
}

mw_status mw_edit_remove(mw_editor *editor, uint32_t vertex, mw_change *change, mw_error *error)
{
    mw_edit edit = {.kind = MW_EDIT_REMOVE, .vertex = vertex};
    return mw_edit_apply(editor, &edit, change, error);
}

mw_status mw_edit_move(mw_editor *editor, uint32_t vertex, double x, double y, mw_change *change,
                       mw_error *error)
{
    mw_edit edit = {.kind = MW_EDIT_MOVE, .vertex = vertex, .x = x, .y = y};
    return mw_edit_apply(editor, &edit, change, error);
}

mw_status mw_edit_flip(mw_editor *editor, uint32_t from, uint32_t to, mw_change *change,
                       mw_error *error)
{
    mw_edit edit = {.kind = MW_EDIT_FLIP, .vertex = from, .other = to};
    return mw_edit_apply(editor, &edit, change, error);
}

mw_status mw_edit_constrain(mw_editor *editor, uint32_t from, uint32_t to, mw_change *change,
                            mw_error *error)
{
    mw_edit edit = {.kind = MW_EDIT_CONSTRAIN, .vertex = from, .other = to};
    return mw_edit_apply(editor, &edit, change, error);
}

mw_status mw_edit_release(mw_editor *editor, uint32_t from, uint32_t to, mw_change *change,
                          mw_error *error)
{
    mw_edit edit = {.kind = MW_EDIT_RELEASE, .vertex = from, .other = to};
    return mw_edit_apply(editor, &edit, change, error);
}

mw_status mw_edit_value(mw_editor *editor, uint32_t field, uint32_t vertex, double value,
                        mw_error *error)
{
    mw_edit edit = {.kind = MW_EDIT_VALUE, .vertex = vertex, .field = field, .value = value};
    return mw_edit_apply(editor, &edit, NULL, error);
}
