/* surface_compact.c - renumbers an edited surface without gaps. */
#include "surface/edit/surface_compact.h"
#include "surface/edit/surface_corners.h"
#include "surface/edit/surface_followers.h"

#include <stdlib.h>
#include <string.h>

/* What the surface will be. */
typedef struct compacted_surface {
    mw_triangle *tri;
    double *point;
    mw_corner *corner;
    mw_corner_list *at;
    uint32_t *triangle, *vertex; /* new numbers by the old ones */
    uint32_t tri_count, point_count;
} compacted_surface;

static void compacted_release(compacted_surface *c)
{
    free(c->tri);
    free(c->point);
    free(c->corner);
    free(c->at);
    free(c->triangle);
    free(c->vertex);
}

static bool compacted_number(compacted_surface *c, const mw_surface_editor *e)
{
    const mw_surface *s = e->surface;
    c->triangle = mw__alloc(s->tri_count, sizeof *c->triangle);
    c->vertex = mw__alloc(s->point_count, sizeof *c->vertex);
    if (!c->triangle || !c->vertex) return false;
    for (uint32_t t = 0; t < s->tri_count; t++)
        c->triangle[t] = mw__surface_has_triangle(e, t) ? c->tri_count++ : MW_NONE;
    for (uint32_t v = 0; v < s->point_count; v++)
        c->vertex[v] = mw__surface_has_vertex(e, v) ? c->point_count++ : MW_NONE;
    return true;
}

static bool compacted_fill(compacted_surface *c, const mw_surface *s)
{
    c->tri = mw__alloc_lines(c->tri_count, sizeof *c->tri);
    c->point = mw__alloc_lines(c->point_count, 3 * sizeof *c->point);
    c->corner = mw__alloc(c->tri_count, 3 * sizeof *c->corner);
    c->at = mw__alloc(c->point_count, sizeof *c->at);
    if (!c->tri || !c->point || !c->corner || !c->at) return false;
    for (uint32_t t = 0; t < s->tri_count; t++) {
        if (c->triangle[t] == MW_NONE) continue;
        mw_triangle *to = &c->tri[c->triangle[t]];
        to->user = c->triangle[t];
        for (int k = 0; k < 4; k++) to->v[k] = c->vertex[s->tri[t].v[k]];
        for (int k = 0; k < 3; k++) {
            uint32_t link = s->tri[t].link[k];
            to->link[k] = link == MW_NONE
                              ? MW_NONE
                              : mw__link(c->triangle[mw__link_triangle(link)], mw__link_edge(link));
        }
    }
    for (uint32_t v = 0; v < s->point_count; v++)
        if (c->vertex[v] != MW_NONE)
            memcpy(c->point + 3 * (size_t)c->vertex[v], mw__surface_point(s, v),
                   3 * sizeof(double));
    for (uint32_t v = 0; v < c->point_count; v++) c->at[v] = (mw_corner_list){MW_NONE, 0};
    return true;
}

/* The surface as it is afterwards, without its old arrays, which become those of `c`. */
static void compacted_exchange(compacted_surface *c, mw_surface_editor *e)
{
    mw_surface *s = e->surface;
    compacted_surface old = *c;
    old.tri = s->tri;
    old.point = s->point;
    old.corner = e->corner;
    old.at = e->at;
    old.tri_count = s->tri_count;
    old.point_count = s->point_count;
    s->tri = c->tri;
    s->point = c->point;
    e->corner = c->corner;
    e->at = c->at;
    s->tri_count = c->tri_count;
    s->point_count = c->point_count;
    *c = old;
}

static bool compacted_boxes(mw_surface_editor *e)
{
    mw_surface *s = e->surface;
    uint32_t freed = s->freed_triangles;
    s->freed_triangles = 0;
    bool done = mw__followers_rebuild(e);
    if (!done) s->freed_triangles = freed;
    return done;
}

static bool compact_run(compacted_surface *c, mw_surface_editor *e)
{
    if (!compacted_number(c, e) || !compacted_fill(c, e->surface)) return false;
    compacted_exchange(c, e);
    if (compacted_boxes(e)) return true;
    compacted_exchange(c, e);
    return false;
}

static void compact_conclude(const compacted_surface *c, mw_surface_editor *e)
{
    mw_surface *s = e->surface;
    s->freed_triangles = s->freed_points = 0;
    mw__followers_renumber(e, c->triangle, c->vertex);
    mw__corners_fill(e);
    e->search = 0;
    e->tri_room = s->tri_count;
    e->point_room = s->point_count;
    e->triangle_count = e->vertex_count = e->step_count = e->undoable = 0;
}

mw_status mw__surface_compact(mw_surface_editor *e, uint32_t *triangles, uint32_t *vertices,
                              mw_error *error)
{
    compacted_surface c = {0};
    uint32_t tri_count = e->surface->tri_count, point_count = e->surface->point_count;
    bool done = compact_run(&c, e);
    if (done) compact_conclude(&c, e);
    if (done && triangles) memcpy(triangles, c.triangle, tri_count * sizeof *triangles);
    if (done && vertices) memcpy(vertices, c.vertex, point_count * sizeof *vertices);
    compacted_release(&c);
    return done ? MW_OK : mw__fail_memory(error);
}
