/* editor_mesh.c - what is there now as a mesh of its own, and beginning anew from that. */
#include "edit/editor.h"

#include "tiling/tiling_create.h"
#include "edit/fabric_memory.h"

#include <stdlib.h>
#include <string.h>

/* --- a mesh ----------------------------------------------------------------------------------------------------------- */

/* Numbers without gaps. */
typedef struct renumbering {
    uint32_t *vertex, *triangle; /* by the old numbers; MW_NONE: gone */
    uint32_t vertices, triangles;
} renumbering;

static void release(renumbering *r)
{
    free(r->vertex);
    free(r->triangle);
}

static bool renumber(const mw_fabric *f, renumbering *r)
{
    const mw_tiling *tiling = f->tiling;
    *r = (renumbering){.vertex = mw__alloc(f->vertex_count, sizeof *r->vertex),
                       .triangle = mw__alloc(tiling->number_count, sizeof *r->triangle)};
    if (!r->vertex || !r->triangle) return false;
    for (uint32_t v = 0; v < f->vertex_count; v++)
        r->vertex[v] = f->vertex_slot[v] == MW_NONE ? MW_NONE : r->vertices++;
    for (uint32_t t = 0; t < tiling->number_count; t++)
        r->triangle[t] = tiling->tile_of[t] & MW_GONE ? MW_NONE : r->triangles++;
    return true;
}

static mw_status make_mesh(const mw_editor *editor, const renumbering *r, mw_mesh **out, mw_error *error)
{
    const mw_fabric *f = &editor->fabric;
    mw_point *point = mw__alloc(r->vertices, sizeof *point);
    uint32_t(*triangle)[3] = mw__alloc(r->triangles, sizeof *triangle);
    mw_status status = MW_OK;
    if (point && triangle) {
        for (uint32_t v = 0; v < f->vertex_count; v++)
            if (r->vertex[v] != MW_NONE) point[r->vertex[v]] = f->tiling->point[f->vertex_slot[v]];
        for (uint32_t t = 0; t < f->tiling->number_count; t++) {
            if (r->triangle[t] == MW_NONE) continue;
            uint32_t *v = triangle[r->triangle[t]];
            mw__fabric_corners(f, &f->tiling->tri[f->tiling->tile_of[t]], v);
            for (int k = 0; k < 3; k++) v[k] = r->vertex[v[k]];
        }
        mw_arrays arrays = {
            .points = &point->x, .point_count = r->vertices, .triangles = triangle, .triangle_count = r->triangles};
        status = mw_mesh_create(&arrays, &(mw_mesh_options){.threads = editor->threads}, out, error);
    } else {
        status = mw__fail_memory(error);
    }
    free(point);
    free(triangle);
    return status;
}

static double *renumbered_values(const mw_editor *editor, const renumbering *r, const double *values)
{
    double *result = mw__alloc(r->vertices, sizeof *result);
    for (uint32_t v = 0; result && v < editor->fabric.vertex_count; v++)
        if (r->vertex[v] != MW_NONE) result[r->vertex[v]] = values[v];
    return result;
}

static mw_status add_fields(const mw_editor *editor, const renumbering *r, mw_mesh *mesh, mw_error *error)
{
    mw_status status = MW_OK;
    for (size_t i = 0; i < editor->view.field_count && !status; i++) {
        double *values = renumbered_values(editor, r, editor->view.field[i].values);
        status =
            values ? mw_mesh_set_field(mesh, editor->view.field[i].name, values, 0, error) : mw__fail_memory(error);
        free(values);
    }
    return status;
}

static void tell(const mw_fabric *f, const renumbering *r, uint32_t *triangles, uint32_t *vertices)
{
    if (triangles) memcpy(triangles, r->triangle, f->tiling->number_count * sizeof *triangles);
    if (vertices) memcpy(vertices, r->vertex, f->vertex_count * sizeof *vertices);
}

static mw_status make(const mw_editor *editor, renumbering *r, mw_mesh **out, mw_error *error)
{
    if (!renumber(&editor->fabric, r)) return mw__fail_memory(error);
    mw_status status = make_mesh(editor, r, out, error);
    if (!status) status = add_fields(editor, r, *out, error);
    if (status) {
        mw_mesh_destroy(*out);
        *out = NULL;
    }
    return status;
}

mw_status mw_editor_mesh(const mw_editor *editor, uint32_t *triangles, uint32_t *vertices, mw_mesh **out,
                         mw_error *error)
{
    if (!out) return mw__fail(error, MW_ERROR_ARGUMENT, "no place for the mesh");
    *out = NULL;
    if (!editor) return mw__fail(error, MW_ERROR_ARGUMENT, "no editor");
    renumbering r;
    mw_status status = make(editor, &r, out, error);
    if (!status) tell(&editor->fabric, &r, triangles, vertices);
    release(&r);
    return status;
}

uint32_t *mw_editor_constrained_edges(const mw_editor *editor, size_t *count)
{
    const mw_fabric *f = &editor->fabric;
    uint32_t *ends = mw__alloc(f->fixed_count, 2 * sizeof *ends);
    *count = 0;
    if (!ends) return NULL;
    for (uint32_t t = 0; t < f->tiling->tri_count; t++)
        for (uint32_t k = 0; k < 3; k++) {
            uint32_t half = mw__link(t, k), other = mw__beyond(f, half);
            if (!mw__is_fixed(f, half) || !mw__is_users(f, t) || (other == MW_NONE && !f->convex)) continue;
            if (other != MW_NONE && (other < half || !mw__is_users(f, mw__link_triangle(other)))) continue;
            ends[2 * *count] = f->vertex_number[mw__corner(f, half)];
            ends[2 * (*count)++ + 1] = f->vertex_number[mw__corner(f, mw__half_next(half))];
        }
    return ends;
}

/* --- beginning anew --------------------------------------------------------------------------------------------------- */

/* What compaction makes before anything is exchanged. */
typedef struct anew {
    renumbering numbers;
    mw_mesh *mesh;
    mw_tiling tiling;
    mw_fabric fabric;
} anew;

static mw_status fix_again(const mw_editor *editor, anew *a, mw_error *error)
{
    size_t count;
    uint32_t *ends = mw_editor_constrained_edges(editor, &count);
    if (!ends) return mw__fail_memory(error);
    for (size_t i = 0; i < 2 * count; i++) ends[i] = a->numbers.vertex[ends[i]];
    mw_status status = mw__fix_edges(&a->fabric, ends, count, error);
    free(ends);
    return status;
}

static mw_status begin_anew(const mw_editor *editor, anew *a, mw_error *error)
{
    mw_status status = make(editor, &a->numbers, &a->mesh, error);
    if (!status) status = mw__tiling_create(a->mesh, false, &a->tiling, error);
    if (!status) status = mw__fabric_create(&a->fabric, &a->tiling, a->mesh, error);
    if (!status) status = fix_again(editor, a, error);
    a->fabric.delaunay = editor->fabric.delaunay;
    return status;
}

static void exchange_fields(mw_editor *editor, mw_mesh *mesh)
{
    for (size_t i = 0; i < editor->view.field_count; i++) {
        double *values = mesh->field[i].values;
        mesh->field[i].values = editor->view.field[i].values;
        editor->view.field[i].values = values;
    }
    editor->field_room = mesh->point_count;
}

mw_status mw_editor_compact(mw_editor *editor, uint32_t *triangles, uint32_t *vertices, mw_error *error)
{
    if (!editor) return mw__fail(error, MW_ERROR_ARGUMENT, "no editor");
    anew a = {.mesh = NULL};
    mw_status status = begin_anew(editor, &a, error);
    if (!status) {
        mw_tiling *tiling = &editor->locator.tiling, old = *tiling;
        tell(&editor->fabric, &a.numbers, triangles, vertices);
        *tiling = a.tiling;
        a.tiling = old;
        mw_fabric fabric = editor->fabric;
        editor->fabric = a.fabric;
        editor->fabric.tiling = tiling;
        a.fabric = fabric;
        exchange_fields(editor, a.mesh);
        editor->undoable = editor->log_count = 0;
        mw__editor_look(editor);
        mw__upkeep_compact(&editor->upkeep);
    }
    mw__fabric_release(&a.fabric);
    mw__tiling_release(&a.tiling);
    mw_mesh_destroy(a.mesh);
    release(&a.numbers);
    return status;
}
