#include "surface/edit/surface_changes.h"
#include "surface/edit/surface_corners.h"
#include "surface/edit/surface_journal.h"

void mw__surface_set_corner(mw_surface_editor *e, uint32_t t, uint32_t k, uint32_t v)
{
    mw_triangle *tri = &e->surface->tri[t];
    mw__surface_record(e, t);
    mw__corner_drop(e, tri->v[k], mw__corner_number(t, k));
    tri->v[k] = v;
    tri->v[3] = tri->v[0];
    mw__corner_add(e, v, mw__corner_number(t, k));
}

static void half_edge_set_link(mw_surface_editor *e, uint32_t half, uint32_t link)
{
    uint32_t t = mw__link_triangle(half), k = mw__link_edge(half);
    mw__surface_record(e, t);
    uint32_t *to = &e->surface->tri[t].link[k];
    e->borders += (link == MW_NONE) - (uint32_t)(*to == MW_NONE);
    *to = link;
}

void mw__surface_join(mw_surface_editor *e, uint32_t half, uint32_t other)
{
    half_edge_set_link(e, half, other);
    if (other != MW_NONE) half_edge_set_link(e, other, half);
}

uint32_t mw__surface_make_triangle(mw_surface_editor *e, uint32_t a, uint32_t b, uint32_t c)
{
    uint32_t t = e->surface->tri_count++;
    e->surface->tri[t] =
        (mw_triangle){.v = {a, b, c, a}, .link = {MW_NONE, MW_NONE, MW_NONE}, .user = t};
    for (uint32_t k = 0; k < 3; k++)
        mw__corner_add(e, e->surface->tri[t].v[k], mw__corner_number(t, k));
    e->borders += 3;
    return t;
}

void mw__surface_free_triangle(mw_surface_editor *e, uint32_t t, uint32_t heir)
{
    mw_triangle *tri = &e->surface->tri[t];
    mw__surface_record(e, t);
    for (uint32_t k = 0; k < 3; k++) {
        uint32_t link = tri->link[k];
        if (link == MW_NONE) continue;
        mw__surface_join(e, link, MW_NONE);
        mw__surface_join(e, mw__link(t, k), MW_NONE);
    }
    for (uint32_t k = 0; k < 3; k++) mw__corner_drop(e, tri->v[k], mw__corner_number(t, k));
    e->borders -= 3;
    for (uint32_t k = 1; k < 4; k++) tri->v[k] = tri->v[0];
    tri->user = (tri->user & MW_SURFACE_RECORDED) | MW_SURFACE_FREED |
                (heir == MW_NONE ? MW_USER_MASK : heir);
    e->surface->freed_triangles++;
}

uint32_t mw__surface_make_vertex(mw_surface_editor *e, const double point[3], uint32_t copied)
{
    uint32_t v = e->surface->point_count++;
    for (size_t k = 0; k < 3; k++) e->surface->point[3 * (size_t)v + k] = point[k];
    e->at[v] = (mw_corner_list){MW_NONE, 0};
    mw__surface_record_vertex(e, MW_VERTEX_MADE, v, copied);
    return v;
}

void mw__surface_free_vertex(mw_surface_editor *e, uint32_t vertex, uint32_t other)
{
    mw__surface_record_vertex(e, MW_VERTEX_GONE, vertex, other);
    e->at[vertex].first = MW_VERTEX_FREED;
    e->surface->freed_points++;
}

void mw__surface_move_vertex(mw_surface_editor *e, uint32_t vertex, const double point[3])
{
    mw__surface_record_vertex(e, MW_VERTEX_MOVED, vertex, MW_NONE);
    for (size_t k = 0; k < 3; k++) e->surface->point[3 * (size_t)vertex + k] = point[k];
}
