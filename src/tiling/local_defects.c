/* local_defects.c - finds defects of a triangle, an edge or the triangles round a vertex. */
#include "tiling/local_defects.h"
#include "mesh/array_defects.h"

#include <stdlib.h>

/* --- triangles --- */

/* Add the defects that make triangle t unusable. *usable becomes true if there are none. */
static bool mesh_check_triangle(const mw_mesh *mesh, uint32_t t, mw_defects *defects, bool *usable)
{
    bool finite[3];
    for (int k = 0; k < 3; k++) finite[k] = mw__is_finite(mesh->point[mesh->tri[t].v[k]]);
    return mw__find_unusable(mesh->tri[t].v, finite, t, defects, usable);
}

static bool mesh_check_triangles(const mw_outline *o, mw_defects *defects)
{
    for (uint32_t t = 0; o->flat && t < o->mesh->tri_count; t++) {
        bool usable = true;
        if (!o->flat[t]) continue;
        if (o->mesh->tolerant && !mesh_check_triangle(o->mesh, t, defects, &usable)) return false;
        if (usable && !mw__defects_add(defects, mw__defect(MW_DEFECT_FLAT, t))) return false;
    }
    return true;
}

/* --- edges --- */

static bool folds_check(const mw_outline *o, mw_defects *defects)
{
    for (uint32_t i = 0; i < o->half_count; i++) {
        if (!mw__is_fold(o, o->half[i])) continue;
        uint32_t t = mw__link_triangle(o->half[i]), k = mw__link_edge(o->half[i]);
        uint32_t link = o->mesh->tri[t].link[k];
        mw_defect defect = mw__defect(MW_DEFECT_FOLDED, t);
        defect.edge = (uint8_t)mw__user_local_edge(o->mesh->tri[t].user, k);
        defect.other = mw__link_triangle(link);
        defect.other_edge =
            (uint8_t)mw__user_local_edge(o->mesh->tri[defect.other].user, mw__link_edge(link));
        if (!mw__defects_add(defects, defect)) return false;
    }
    return true;
}

bool mw__find_local_defects(const mw_outline *outline, mw_defects *defects)
{
    const mw_mesh *mesh = outline->mesh;
    return mesh_check_triangles(outline, defects) &&
           (!mesh->tolerant || mw__find_non_manifold_edges(mesh->tri, mesh->tri_count, defects)) &&
           folds_check(outline, defects);
}

/* --- vertices --- */

/* Does the angle of a triangle at its corner k contain the direction +x? The first of its two rays
 * belongs to the angle. A counter-clockwise triangle with an area needs no predicate for this. */
static bool angle_holds_x(const mw_point *point, const mw_triangle *t, uint32_t k)
{
    mw_point v = point[t->v[k]], a = point[t->v[k + 1]], b = point[t->v[mw__prev(k)]];
    return (a.y < v.y && b.y > v.y) || (a.y == v.y && a.x > v.x);
}

/* At an inner vertex the triangles close round it. They turn as often as their angles contain any
 * one direction. */
static bool vertex_is_inner(const mw_outline *o, uint32_t v)
{
    return o->node[v] == MW_NONE || o->node[v] >= o->node_count;
}

bool mw__find_winding_defects(const mw_outline *outline, mw_defects *defects)
{
    const mw_mesh *mesh = outline->mesh;
    enum { MANY = 2 };
    uint8_t *turns = mw__calloc(mesh->point_count, sizeof *turns);
    if (!turns) return false;
    for (uint32_t t = 0; t < mesh->tri_count; t++)
        for (uint32_t k = 0; k < 3 && !mw__is_flat(outline, t); k++) {
            uint32_t v = mesh->tri[t].v[k];
            if (turns[v] < MANY && angle_holds_x(mesh->point, &mesh->tri[t], k)) turns[v]++;
        }
    bool done = true;
    /* In the user's order, to report the first one. */
    for (uint32_t i = 0; i < mesh->tri_count; i++) {
        uint32_t t = mw__triangle_slot(mesh, i);
        for (uint32_t k = 0; k < 3 && done && !mw__is_flat(outline, t); k++) {
            uint32_t v = mesh->tri[t].v[k];
            if (turns[v] < MANY || !vertex_is_inner(outline, v)) continue;
            turns[v] = 0; /* reported once */
            mw_defect defect = mw__defect(MW_DEFECT_WINDING, t);
            defect.vertex = v;
            done = mw__defects_add(defects, defect);
        }
    }
    free(turns);
    return done;
}
