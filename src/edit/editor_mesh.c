/* editor_mesh.c - the current mesh of an editor as a mesh of its own, and compaction. */
#include "edit/editor.h"

#include "tiling/tiling_create.h"
#include "dynamic/dynamic_tiling_memory.h"
#include "mesh/mesh_create.h"

#include <stdlib.h>
#include <string.h>

/* --- a mesh ----------------------------------------------------------------------------------- */

/* Numbers without gaps. */
typedef struct renumbering {
    uint32_t *vertex, *triangle; /* by old number; MW_NONE: deleted */
    uint32_t vertices, triangles;
} renumbering;

static void renumbering_release(renumbering *r)
{
    free(r->vertex);
    free(r->triangle);
}

static bool renumbering_create(const mw_dynamic_tiling *dynamic, renumbering *r)
{
    const mw_tiling *tiling = dynamic->tiling;
    *r = (renumbering){.vertex = mw__alloc(dynamic->vertex_count, sizeof *r->vertex),
                       .triangle = mw__alloc(tiling->number_count, sizeof *r->triangle)};
    if (!r->vertex || !r->triangle) return false;
    for (uint32_t v = 0; v < dynamic->vertex_count; v++)
        r->vertex[v] = dynamic->vertex_slot[v] == MW_NONE ? MW_NONE : r->vertices++;
    for (uint32_t t = 0; t < tiling->number_count; t++)
        r->triangle[t] = tiling->tile_of[t] & MW_GONE ? MW_NONE : r->triangles++;
    return true;
}

static mw_status renumbered_mesh(const mw_editor *editor, const renumbering *r, mw_job *job,
                                 mw_mesh **out, mw_error *error)
{
    const mw_dynamic_tiling *dynamic = &editor->dynamic;
    mw__job_stage(job, "numbering triangles", 0.3);
    mw_point *point = mw__alloc(r->vertices, sizeof *point);
    uint32_t(*triangle)[3] = mw__alloc(r->triangles, sizeof *triangle);
    mw_status status = MW_OK;
    if (point && triangle) {
        for (uint32_t v = 0; v < dynamic->vertex_count; v++)
            if (r->vertex[v] != MW_NONE)
                point[r->vertex[v]] = dynamic->tiling->point[dynamic->vertex_slot[v]];
        for (uint32_t t = 0; t < dynamic->tiling->number_count; t++) {
            if (r->triangle[t] == MW_NONE) continue;
            uint32_t *v = triangle[r->triangle[t]];
            mw__dynamic_tile_vertices(dynamic, &dynamic->tiling->tri[dynamic->tiling->tile_of[t]],
                                      v);
            for (int k = 0; k < 3; k++) v[k] = r->vertex[v[k]];
        }
        mw_arrays arrays = {.points = &point->x,
                            .point_count = r->vertices,
                            .triangles = triangle,
                            .triangle_count = r->triangles};
        static const mw_mesh_options plain;
        mw_job_span outer = mw__job_part(job, 0.7);
        status = mw__mesh_create(&arrays, &plain, job, out, error);
        mw__job_part_end(job, outer);
    } else {
        status = mw__fail_memory(error);
    }
    free(point);
    free(triangle);
    return status;
}

static double *renumbered_values(const mw_editor *editor, const renumbering *r,
                                 const double *values)
{
    double *result = mw__alloc(r->vertices, sizeof *result);
    for (uint32_t v = 0; result && v < editor->dynamic.vertex_count; v++)
        if (r->vertex[v] != MW_NONE) result[r->vertex[v]] = values[v];
    return result;
}

static mw_status add_renumbered_fields(const mw_editor *editor, const renumbering *r, mw_mesh *mesh,
                                       mw_error *error)
{
    mw_status status = MW_OK;
    for (size_t i = 0; i < editor->view.field_count && !status; i++) {
        double *values = renumbered_values(editor, r, editor->view.field[i].values);
        status = values ? mw_mesh_set_field(mesh, editor->view.field[i].name, values, 0, error)
                        : mw__fail_memory(error);
        free(values);
    }
    return status;
}

static void renumbering_copy(const mw_dynamic_tiling *dynamic, const renumbering *r,
                             uint32_t *triangles, uint32_t *vertices)
{
    if (triangles)
        memcpy(triangles, r->triangle, dynamic->tiling->number_count * sizeof *triangles);
    if (vertices) memcpy(vertices, r->vertex, dynamic->vertex_count * sizeof *vertices);
}

static mw_status editor_make_mesh(const mw_editor *editor, renumbering *r, mw_job *job,
                                  mw_mesh **out, mw_error *error)
{
    if (!renumbering_create(&editor->dynamic, r)) return mw__fail_memory(error);
    mw_status status = renumbered_mesh(editor, r, job, out, error);
    if (!status) status = add_renumbered_fields(editor, r, *out, error);
    if (status) {
        mw_mesh_destroy(*out);
        *out = NULL;
    }
    return status;
}

mw_status mw_editor_mesh(const mw_editor *editor, uint32_t *triangles, uint32_t *vertices,
                         mw_mesh **out, mw_error *error)
{
    if (!out) return mw__fail(error, MW_ERROR_ARGUMENT, "the pointer to the new mesh is NULL");
    *out = NULL;
    if (!editor) return mw__fail(error, MW_ERROR_ARGUMENT, "no editor");
    renumbering r;
    mw_job job = mw__job(editor->threads, editor->progress);
    mw_status status = mw__job_end(&job, editor_make_mesh(editor, &r, &job, out, error), error);
    if (!status) {
        renumbering_copy(&editor->dynamic, &r, triangles, vertices);
    } else {
        mw_mesh_destroy(*out);
        *out = NULL;
    }
    renumbering_release(&r);
    return status;
}

uint32_t *mw_editor_constrained_edges(const mw_editor *editor, size_t *count)
{
    const mw_dynamic_tiling *dynamic = &editor->dynamic;
    uint32_t *ends = mw__alloc(dynamic->fixed_count, 2 * sizeof *ends);
    *count = 0;
    if (!ends) return NULL;
    for (uint32_t t = 0; t < dynamic->tiling->tri_count; t++)
        for (uint32_t k = 0; k < 3; k++) {
            uint32_t half = mw__link(t, k), other = mw__beyond(dynamic, half);
            if (!mw__is_fixed(dynamic, half) || !mw__is_users_tile(dynamic, t) ||
                (other == MW_NONE && !dynamic->convex))
                continue;
            if (other != MW_NONE &&
                (other < half || !mw__is_users_tile(dynamic, mw__link_triangle(other))))
                continue;
            ends[2 * *count] = dynamic->vertex_number[mw__corner(dynamic, half)];
            ends[2 * (*count)++ + 1] =
                dynamic->vertex_number[mw__corner(dynamic, mw__half_next(half))];
        }
    return ends;
}

/* --- compaction ------------------------------------------------------------------------------- */

/* What compaction makes, before anything is exchanged. */
typedef struct compaction {
    renumbering numbers;
    mw_mesh *mesh;
    mw_tiling tiling;
    mw_dynamic_tiling dynamic;
} compaction;

static mw_status compaction_fix_edges(const mw_editor *editor, compaction *c, mw_error *error)
{
    size_t count;
    uint32_t *ends = mw_editor_constrained_edges(editor, &count);
    if (!ends) return mw__fail_memory(error);
    for (size_t i = 0; i < 2 * count; i++) ends[i] = c->numbers.vertex[ends[i]];
    mw_status status = mw__fix_edges(&c->dynamic, ends, count, error);
    free(ends);
    return status;
}

static mw_status compaction_create(const mw_editor *editor, compaction *c, mw_job *job,
                                   mw_error *error)
{
    mw_job_span outer = mw__job_part(job, 0.4);
    mw_status status = editor_make_mesh(editor, &c->numbers, job, &c->mesh, error);
    mw__job_part_end(job, outer);
    outer = mw__job_part(job, 0.4);
    if (!status)
        status = mw__tiling_create(c->mesh, (mw_tiling_options){0}, job, &c->tiling, error);
    mw__job_part_end(job, outer);
    mw__job_stage(job, "preparing edits", 0.2);
    if (!status)
        status =
            mw__dynamic_create(&c->dynamic, &c->tiling, c->mesh, editor->dynamic.convex, error);
    if (!status) status = compaction_fix_edges(editor, c, error);
    c->dynamic.delaunay = editor->dynamic.delaunay;
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

mw_status mw_editor_compact(mw_editor *editor, uint32_t *triangles, uint32_t *vertices,
                            mw_error *error)
{
    if (!editor) return mw__fail(error, MW_ERROR_ARGUMENT, "no editor");
    compaction c = {.mesh = NULL};
    mw_job job = mw__job(editor->threads, editor->progress);
    mw_status status = mw__job_end(&job, compaction_create(editor, &c, &job, error), error);
    if (!status) {
        mw_tiling *tiling = &editor->locator.tiling, old = *tiling;
        renumbering_copy(&editor->dynamic, &c.numbers, triangles, vertices);
        *tiling = c.tiling;
        c.tiling = old;
        mw_dynamic_tiling dynamic = editor->dynamic;
        editor->dynamic = c.dynamic;
        editor->dynamic.tiling = tiling;
        c.dynamic = dynamic;
        exchange_fields(editor, c.mesh);
        editor->undoable = editor->log_count = 0;
        mw__editor_update_view(editor);
        mw__upkeep_compact(&editor->upkeep);
    }
    mw__dynamic_release(&c.dynamic);
    mw__tiling_release(&c.tiling);
    mw_mesh_destroy(c.mesh);
    renumbering_release(&c.numbers);
    return status;
}
