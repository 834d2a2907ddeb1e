/* cdt_output.c - what was made, as a mesh and a list of subsegments. */
#include "triangulate/constrained/cdt_output.h"

#include "mesh/layout.h"

#include <inttypes.h>
#include <stdlib.h>

void mw_constrained_edges_release(mw_constrained_edges *edges)
{
    if (!edges) return;
    free(edges->edge);
    free(edges->segment);
    *edges = (mw_constrained_edges){0};
}

/* Points made twice, or where one of the caller's lies, are not vertices: number those that are.
 * NULL when out of memory. */
static uint32_t *output_number_points(const mw_cdt *m, uint32_t *count)
{
    uint32_t *number = mw__alloc(m->point_count, sizeof *number);
    *count = 0;
    for (size_t i = 0; number && i < m->point_count; i++)
        number[i] = i < m->given->point_count || m->twin[i] == MW_NONE ? (*count)++ : MW_NONE;
    return number;
}

/* Per triangle its number among those kept, or MW_NONE. They are numbered along a Hilbert curve
 * from the beginning. NULL when out of memory. */
static uint32_t *output_number_triangles(const mw_cdt *m, uint32_t *count)
{
    uint32_t *number = mw__alloc(m->tri_count, sizeof *number);
    *count = 0;
    for (uint32_t t = 0; number && t < m->tri_count; t++)
        number[t] = m->kept[t] ? (*count)++ : MW_NONE;
    return number;
}

/* The triangles kept, with their new numbers, and those of their vertices. */
static void output_copy_triangles(const mw_cdt *m, const uint32_t *number, const uint32_t *vertex,
                                  mw_triangle *out)
{
    for (uint32_t t = 0; t < m->tri_count; t++) {
        if (!m->kept[t]) continue;
        const mw_triangle *from = &m->tri[t];
        mw_triangle *to = &out[number[t]];
        for (uint32_t k = 0; k < 3; k++) {
            uint32_t other =
                from->link[k] == MW_NONE ? MW_NONE : number[mw__link_triangle(from->link[k])];
            to->v[k] = vertex[from->v[k]];
            to->link[k] =
                other == MW_NONE ? MW_NONE : mw__link(other, mw__link_edge(from->link[k]));
        }
        to->v[3] = to->v[0];
        to->user = number[t];
    }
}

/* Nothing has a new number: the triangles are moved. */
static void output_move_triangles(mw_cdt *m, mw_mesh *mesh)
{
    for (uint32_t t = 0; t < m->tri_count; t++) m->tri[t].user = t;
    mesh->tri = m->tri;
    m->tri = NULL;
}

/* Subsegments of the triangles kept, each once, in the order of the triangles. With out NULL they
 * are only counted. */
static size_t output_list_subsegments(const mw_cdt *m, const uint32_t *vertex,
                                      mw_constrained_edges *out)
{
    size_t made = 0;
    for (uint32_t t = 0; t < m->tri_count; t++)
        for (uint32_t k = 0; k < 3 && m->kept[t]; k++) {
            uint32_t subsegment = m->net.subsegment[3 * (size_t)t + k], link = m->tri[t].link[k];
            if (subsegment == MW_NONE) continue;
            if (link != MW_NONE && mw__link_triangle(link) < t && m->kept[mw__link_triangle(link)])
                continue;
            if (out) {
                const mw_segment_part *p = &m->subsegments.item[subsegment];
                out->edge[2 * made] = vertex[p->from];
                out->edge[2 * made + 1] = vertex[p->to];
                out->segment[made] = p->segment;
            }
            made++;
        }
    return made;
}

static bool output_give_subsegments(const mw_cdt *m, const uint32_t *vertex, size_t count,
                                    mw_constrained_edges *out)
{
    if (!out) return true;
    out->edge = mw__alloc(2 * count, sizeof *out->edge);
    out->segment = mw__alloc(count, sizeof *out->segment);
    out->count = count;
    if (!out->edge || !out->segment) return false;
    output_list_subsegments(m, vertex, out);
    return true;
}

static bool output_give_triangles(mw_cdt *m, const uint32_t *number, const uint32_t *vertex,
                                  mw_mesh *mesh)
{
    if (mesh->tri_count == m->tri_count && mesh->point_count == m->point_count) {
        output_move_triangles(m, mesh);
        return true;
    }
    mesh->tri = mw__alloc_lines(mesh->tri_count, sizeof *mesh->tri);
    if (!mesh->tri) return false;
    output_copy_triangles(m, number, vertex, mesh->tri);
    return true;
}

static void output_give_points(mw_cdt *m, const uint32_t *vertex, mw_mesh *mesh)
{
    for (size_t i = 0; i < m->point_count; i++)
        if (vertex[i] != MW_NONE) m->point[vertex[i]] = m->point[i];
    mesh->point = m->point;
    m->point = NULL;
}

/* Move what was made into a mesh. */
static bool output_give_mesh(mw_cdt *m, mw_constrain_report *report, mw_constrained_edges *edges,
                             mw_mesh *mesh)
{
    uint32_t *vertex = output_number_points(m, &mesh->point_count),
             *number = output_number_triangles(m, &mesh->tri_count);
    bool done = vertex && number;
    if (done) {
        report->triangles_removed = m->tri_count - mesh->tri_count;
        report->vertices_added = mesh->point_count - m->given->point_count;
        report->constrained_edges = output_list_subsegments(m, vertex, NULL);
        done = output_give_subsegments(m, vertex, report->constrained_edges, edges) &&
               output_give_triangles(m, number, vertex, mesh);
    }
    if (done) output_give_points(m, vertex, mesh);
    free(vertex);
    free(number);
    return done;
}

static bool output_lay_out(const mw_cdt *m, mw_mesh *mesh)
{
    mw_job_span outer = mw__job_part(m->job, 0.7);
    bool done = mw__mesh_lay_out_vertices(mesh, m->job);
    mw__job_part_end(m->job, outer);
    return done;
}

mw_status mw__cdt_output(mw_cdt *m, mw_constrain_report *report, mw_constrained_edges *edges,
                         mw_mesh **out, mw_error *error)
{
    mw_mesh *mesh = mw__calloc(1, sizeof *mesh);
    mw__job_stage(m->job, "making a mesh", 0.3);
    if (mesh && output_give_mesh(m, report, edges, mesh) && output_lay_out(m, mesh)) {
        *out = mesh;
        return MW_OK;
    }
    mw_mesh_destroy(mesh);
    return mw__fail_memory(error);
}
