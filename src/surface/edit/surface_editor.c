/* surface_editor.c - the public functions of an editor of a surface. */
#include "surface/edit/surface_compact.h"
#include "surface/edit/surface_corners.h"
#include "surface/edit/surface_followers.h"
#include "surface/edit/surface_journal.h"
#include "surface/edit/surface_operations.h"
#include "base/options.h"

#include <inttypes.h>
#include <stdlib.h>

const char *mw_surface_edit_name(mw_surface_edit_kind kind)
{
    static const char *const names[MW_SURFACE_EDIT_KIND_COUNT] = {
        "add-vertex", "remove-vertex",  "move-vertex", "add-triangle", "remove-triangle",
        "split-edge", "split-triangle", "flip",        "collapse",     "cut",
        "sew"};
    return (unsigned)kind < MW_SURFACE_EDIT_KIND_COUNT ? names[kind] : NULL;
}

/* --- creation --- */

static mw_status editor_check_surface(const mw_surface *surface, mw_error *error)
{
    if (surface->coincident)
        return mw__fail(error, MW_ERROR_ARGUMENT,
                        "the surface was welded: an editor needs one number for equal vertices");
    if (surface->borrowed)
        return mw__fail(error, MW_ERROR_ARGUMENT,
                        "the points of the surface are borrowed, so an editor cannot add any");
    if (surface->edited)
        return mw__fail(error, MW_ERROR_ARGUMENT, "the surface has an editor already");
    if (mw_surface_triangle_count(surface) == surface->freed_triangles)
        return mw__fail(error, MW_ERROR_INPUT, "the surface has no triangle");
    return MW_OK;
}

/* No triangle has a vertex twice, and no border edge has another triangle. */
static mw_status editor_check_triangles(const mw_surface_editor *e, mw_error *error)
{
    const mw_surface *s = e->surface;
    for (uint32_t t = 0; t < s->tri_count; t++) {
        if (mw__surface_is_freed(s, t)) continue;
        const uint32_t *v = s->tri[t].v;
        if (!mw__has_three_vertices(&s->tri[t]))
            return mw__fail_at(error, t, v[0], "triangle %" PRIu32 " names a vertex twice", t);
        for (uint32_t k = 0; k < 3; k++) {
            uint32_t half[2];
            if (s->tri[t].link[k] != MW_NONE) continue;
            mw__surface_edge(e, v[k], v[k + 1], half);
            if (half[0] != mw__link(t, k) || half[1] != MW_NONE)
                return mw__fail_at(error, t, v[k],
                                   "triangle %" PRIu32 ": its edge from %" PRIu32 " to %" PRIu32
                                   " has more than two triangles",
                                   t, v[k], v[k + 1]);
        }
    }
    return MW_OK;
}

static bool editor_allocate(mw_surface_editor *e)
{
    const mw_surface *s = e->surface;
    e->tri_room = s->tri_count;
    e->point_room = s->point_count;
    e->corner = mw__alloc(e->tri_room, 3 * sizeof *e->corner);
    e->at = mw__alloc(e->point_room, sizeof *e->at);
    return e->corner && e->at;
}

static void editor_fill(mw_surface_editor *e)
{
    const mw_surface *s = e->surface;
    for (uint32_t v = 0; v < s->point_count; v++) e->at[v] = (mw_corner_list){MW_NONE, 0};
    mw__corners_fill(e);
    for (uint32_t t = 0; t < s->tri_count; t++)
        for (int k = 0; k < 3 && !mw__surface_is_freed(s, t); k++)
            e->borders += s->tri[t].link[k] == MW_NONE;
}

mw_status mw_surface_editor_create(mw_surface *surface, const mw_surface_editor_options *options,
                                   mw_surface_editor **out, mw_error *error)
{
    static const mw_surface_editor_options defaults;
    if (!out) return mw__fail(error, MW_ERROR_ARGUMENT, "the pointer to the new editor is NULL");
    *out = NULL;
    if (!surface) return mw__fail(error, MW_ERROR_ARGUMENT, "no surface");
    if (!options) options = &defaults;
    mw_status status = MW_RESERVED_CHECK(mw_surface_editor_options, options, error);
    if (!status) status = editor_check_surface(surface, error);
    if (status) return status;
    mw_surface_editor *e = mw__calloc(1, sizeof *e);
    if (!e) return mw__fail_memory(error);
    e->surface = surface;
    e->undo = options->undo;
    if (editor_allocate(e)) {
        editor_fill(e);
        status = editor_check_triangles(e, error);
        if (!status && options->prober)
            status = mw__followers_add_prober(e, options->prober, error);
        if (!status && !mw__surface_reserve_some(e)) status = mw__fail_memory(error);
    } else {
        status = mw__fail_memory(error);
    }
    surface->edited = status == MW_OK;
    if (status)
        mw_surface_editor_destroy(e);
    else
        *out = e;
    return status;
}

void mw_surface_editor_destroy(mw_surface_editor *editor)
{
    if (!editor) return;
    if (editor->surface->edited) editor->surface->freed_points = 0; /* no one knows which */
    editor->surface->edited = false;
    mw__followers_release(editor);
    free(editor->corner);
    free(editor->at);
    free(editor->triangle);
    free(editor->vertex);
    free(editor->step);
    free(editor->changed_triangle);
    free(editor->changed_vertex);
    free(editor);
}

/* --- what follows --- */

/* Queries of other threads wait while what they use changes. */
static void editor_lock(const mw_surface *surface)
{
    if (surface->rwlock && !surface->updating) mw__rwlock_write_lock(surface->rwlock);
}
static void editor_unlock(const mw_surface *surface)
{
    if (surface->rwlock && !surface->updating) mw__rwlock_write_unlock(surface->rwlock);
}

mw_status mw_surface_editor_attach_prober(mw_surface_editor *editor, mw_prober *prober,
                                          mw_error *error)
{
    if (!editor || !prober)
        return mw__fail(error, MW_ERROR_ARGUMENT, "the editor or the prober is NULL");
    editor_lock(editor->surface);
    mw_status status = mw__followers_add_prober(editor, prober, error);
    editor_unlock(editor->surface);
    return status;
}

mw_status mw_surface_editor_attach_star(mw_surface_editor *editor, mw_star *star, mw_error *error)
{
    if (!editor || !star)
        return mw__fail(error, MW_ERROR_ARGUMENT, "the editor or the star is NULL");
    editor_lock(editor->surface);
    mw_status status = mw__followers_add_star(editor, star, error);
    editor_unlock(editor->surface);
    return status;
}

void mw_surface_editor_detach_prober(mw_surface_editor *editor, const mw_prober *prober)
{
    mw__followers_remove_prober(editor, prober);
}

void mw_surface_editor_detach_star(mw_surface_editor *editor, mw_star *star)
{
    mw__followers_remove_star(editor, star);
}

/* --- an edit as an update --- */

/* An edit that is no part of an update is an update of its own. Returns whether it is. */
static bool edit_update_begin(mw_surface_editor *e)
{
    bool own = !e->surface->updating;
    if (own) mw_surface_begin_update(e->surface);
    return own;
}

static void edit_update_end(mw_surface_editor *e, bool own, mw_status status)
{
    mw_surface *s = e->surface;
    if (!own) return;
    if (status)
        s->version--; /* nothing has changed */
    else
        mw__followers_end_update(e);
    mw_surface_end_update(s);
}

static mw_status edit_conclude(mw_surface_editor *e, mw_status status, mw_surface_change *change)
{
    if (status) return status;
    mw__followers_follow(e);
    if (change) mw__surface_report(e, change);
    mw__surface_commit(e);
    return MW_OK;
}

/* Which coordinates must an edit have? `optional`: or a NaN first. */
static mw_status edit_check_point(const mw_surface_edit *edit, mw_error *error)
{
    bool optional = edit->kind == MW_SURFACE_SPLIT_EDGE ||
                    edit->kind == MW_SURFACE_SPLIT_TRIANGLE || edit->kind == MW_SURFACE_COLLAPSE,
         wanted = optional || edit->kind == MW_SURFACE_ADD_VERTEX ||
                  edit->kind == MW_SURFACE_MOVE_VERTEX;
    if (!wanted || mw__is_finite3(edit->point) || (optional && isnan(edit->point[0]))) return MW_OK;
    return mw__fail(error, MW_ERROR_INPUT, "a coordinate is not finite");
}

mw_status mw_surface_edit_apply(mw_surface_editor *editor, const mw_surface_edit *edit,
                                mw_surface_change *change, mw_error *error)
{
    static mw_surface_operation *const operations[MW_SURFACE_EDIT_KIND_COUNT] = {
        mw__surface_add_vertex,
        mw__surface_remove_vertex,
        mw__surface_shift_vertex,
        mw__surface_add_triangle,
        mw__surface_remove_triangle,
        mw__surface_split_edge,
        mw__surface_split_triangle,
        mw__surface_flip_edge,
        mw__surface_collapse,
        mw__surface_cut,
        mw__surface_sew};
    if (!editor || !edit)
        return mw__fail(error, MW_ERROR_ARGUMENT, "the editor or the edit is NULL");
    if ((unsigned)edit->kind >= MW_SURFACE_EDIT_KIND_COUNT)
        return mw__fail(error, MW_ERROR_ARGUMENT, "unknown kind of edit");
    mw_status status = edit_check_point(edit, error);
    if (status) return status;
    bool own = edit_update_begin(editor);
    status = edit_conclude(editor, operations[edit->kind](editor, edit, error), change);
    edit_update_end(editor, own, status);
    return status;
}

mw_status mw_surface_edit_undo(mw_surface_editor *editor, mw_surface_change *change,
                               mw_error *error)
{
    if (!editor) return mw__fail(error, MW_ERROR_ARGUMENT, "no editor");
    if (editor->undoable == 0) return mw__fail(error, MW_ERROR_INPUT, "there is no edit to undo");
    bool own = edit_update_begin(editor);
    mw_status status = mw__surface_revert(editor, error);
    if (!status) {
        mw__followers_follow(editor);
        if (change) mw__surface_report(editor, change);
        mw__surface_drop_step(editor);
    }
    edit_update_end(editor, own, status);
    return status;
}

mw_status mw_surface_editor_compact(mw_surface_editor *editor, uint32_t *triangles,
                                    uint32_t *vertices, mw_error *error)
{
    if (!editor) return mw__fail(error, MW_ERROR_ARGUMENT, "no editor");
    bool own = edit_update_begin(editor);
    mw_status status = mw__surface_compact(editor, triangles, vertices, error);
    edit_update_end(editor, own, status);
    return status;
}

/* --- edits by name --- */

static mw_surface_edit edit_at(mw_surface_edit_kind kind, const double point[3])
{
    mw_surface_edit edit = {.kind = kind, .point = {NAN, NAN, NAN}};
    for (int k = 0; k < 3 && point; k++) edit.point[k] = point[k];
    return edit;
}

/* A point that may be missing as a whole may not be missing in part. */
static mw_status edit_apply_at(mw_surface_editor *editor, const mw_surface_edit *edit,
                               const double point[3], mw_surface_change *change, mw_error *error)
{
    if (point && !mw__is_finite3(point))
        return mw__fail(error, MW_ERROR_INPUT, "a coordinate is not finite");
    return mw_surface_edit_apply(editor, edit, change, error);
}

mw_status mw_surface_edit_add_vertex(mw_surface_editor *editor, const double point[3],
                                     mw_surface_change *change, mw_error *error)
{
    mw_surface_edit edit = edit_at(MW_SURFACE_ADD_VERTEX, point);
    return edit_apply_at(editor, &edit, point, change, error);
}

mw_status mw_surface_edit_remove_vertex(mw_surface_editor *editor, uint32_t vertex,
                                        mw_surface_change *change, mw_error *error)
{
    mw_surface_edit edit = {.kind = MW_SURFACE_REMOVE_VERTEX, .vertex = {vertex}};
    return mw_surface_edit_apply(editor, &edit, change, error);
}

mw_status mw_surface_edit_move_vertex(mw_surface_editor *editor, uint32_t vertex,
                                      const double point[3], mw_surface_change *change,
                                      mw_error *error)
{
    mw_surface_edit edit = edit_at(MW_SURFACE_MOVE_VERTEX, point);
    edit.vertex[0] = vertex;
    return edit_apply_at(editor, &edit, point, change, error);
}

mw_status mw_surface_edit_add_triangle(mw_surface_editor *editor, const uint32_t vertices[3],
                                       mw_surface_change *change, mw_error *error)
{
    if (!vertices) return mw__fail(error, MW_ERROR_ARGUMENT, "no vertices");
    mw_surface_edit edit = {.kind = MW_SURFACE_ADD_TRIANGLE,
                            .vertex = {vertices[0], vertices[1], vertices[2]}};
    return mw_surface_edit_apply(editor, &edit, change, error);
}

mw_status mw_surface_edit_remove_triangle(mw_surface_editor *editor, uint32_t triangle,
                                          mw_surface_change *change, mw_error *error)
{
    mw_surface_edit edit = {.kind = MW_SURFACE_REMOVE_TRIANGLE, .triangle = triangle};
    return mw_surface_edit_apply(editor, &edit, change, error);
}

mw_status mw_surface_edit_split_edge(mw_surface_editor *editor, uint32_t a, uint32_t b,
                                     const double point[3], mw_surface_change *change,
                                     mw_error *error)
{
    mw_surface_edit edit = edit_at(MW_SURFACE_SPLIT_EDGE, point);
    edit.vertex[0] = a;
    edit.vertex[1] = b;
    return edit_apply_at(editor, &edit, point, change, error);
}

mw_status mw_surface_edit_split_triangle(mw_surface_editor *editor, uint32_t triangle,
                                         const double point[3], mw_surface_change *change,
                                         mw_error *error)
{
    mw_surface_edit edit = edit_at(MW_SURFACE_SPLIT_TRIANGLE, point);
    edit.triangle = triangle;
    return edit_apply_at(editor, &edit, point, change, error);
}

mw_status mw_surface_edit_flip(mw_surface_editor *editor, uint32_t a, uint32_t b,
                               mw_surface_change *change, mw_error *error)
{
    mw_surface_edit edit = {.kind = MW_SURFACE_FLIP, .vertex = {a, b}};
    return mw_surface_edit_apply(editor, &edit, change, error);
}

mw_status mw_surface_edit_collapse(mw_surface_editor *editor, uint32_t gone, uint32_t kept,
                                   const double point[3], mw_surface_change *change,
                                   mw_error *error)
{
    mw_surface_edit edit = edit_at(MW_SURFACE_COLLAPSE, point);
    edit.vertex[0] = gone;
    edit.vertex[1] = kept;
    return edit_apply_at(editor, &edit, point, change, error);
}

mw_status mw_surface_edit_cut(mw_surface_editor *editor, const uint32_t *path, size_t count,
                              mw_surface_change *change, mw_error *error)
{
    mw_surface_edit edit = {.kind = MW_SURFACE_CUT, .path = path, .path_count = count};
    return mw_surface_edit_apply(editor, &edit, change, error);
}

mw_status mw_surface_edit_sew(mw_surface_editor *editor, const uint32_t *path,
                              const uint32_t *other, size_t count, mw_surface_change *change,
                              mw_error *error)
{
    mw_surface_edit edit = {
        .kind = MW_SURFACE_SEW, .path = path, .other = other, .path_count = count};
    return mw_surface_edit_apply(editor, &edit, change, error);
}

/* --- the present surface --- */

void mw_surface_editor_describe(const mw_surface_editor *editor, mw_surface_editor_info *info)
{
    const mw_surface *s = editor->surface;
    size_t undo = mw__surface_journal_bytes(editor);
    *info = (mw_surface_editor_info){
        .vertices = s->point_count - s->freed_points,
        .triangles = mw__surface_living(editor),
        .vertex_range = s->point_count,
        .triangle_range = s->tri_count,
        .border_edges = editor->borders,
        .undoable = editor->undoable,
        .undo_bytes = undo,
        .bytes = sizeof *editor + undo + (editor->tri_room - s->tri_count) * sizeof *s->tri +
                 (editor->point_room - s->point_count) * 3 * sizeof *s->point +
                 3 * (size_t)editor->tri_room * sizeof *editor->corner +
                 editor->point_room * sizeof *editor->at + mw__followers_bytes(editor) +
                 editor->changed_triangle_room * sizeof *editor->changed_triangle +
                 editor->changed_vertex_room * sizeof *editor->changed_vertex,
        .edits = editor->edits,
    };
}

int mw_surface_editor_triangle(const mw_surface_editor *editor, uint32_t triangle,
                               uint32_t vertices[3])
{
    if (!mw__surface_has_triangle(editor, triangle)) return 0;
    mw_surface_triangle(editor->surface, triangle, vertices);
    return 1;
}

int mw_surface_editor_vertex(const mw_surface_editor *editor, uint32_t vertex, double point[3])
{
    if (!mw__surface_has_vertex(editor, vertex)) return 0;
    mw_surface_vertex(editor->surface, vertex, point);
    return 1;
}

size_t mw_surface_editor_triangles_of(const mw_surface_editor *editor, uint32_t vertex,
                                      uint32_t *triangles, size_t capacity)
{
    size_t count = 0, kept = 0;
    if (!mw__surface_has_vertex(editor, vertex)) return 0;
    for (uint32_t c = editor->at[vertex].first; c != MW_NONE; c = editor->corner[c].next) {
        size_t i = kept < capacity ? kept++ : capacity;
        count++;
        for (; i > 0 && triangles[i - 1] > c / 3; i--)
            if (i < capacity) triangles[i] = triangles[i - 1];
        if (i < capacity) triangles[i] = c / 3;
    }
    return count;
}

unsigned mw_surface_editor_edge(const mw_surface_editor *editor, uint32_t a, uint32_t b,
                                uint32_t triangles[2])
{
    uint32_t half[2] = {MW_NONE, MW_NONE};
    unsigned n = 0;
    if (a != b && mw__surface_has_vertex(editor, a) && mw__surface_has_vertex(editor, b))
        n = mw__surface_edge(editor, a, b, half);
    for (int i = 0; i < 2; i++)
        triangles[i] = half[i] == MW_NONE ? MW_NONE : mw__link_triangle(half[i]);
    return n;
}
