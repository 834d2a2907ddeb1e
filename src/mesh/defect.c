/* defect.c - defects of meshes: a list of them, and their texts. */
#include "mesh/defect.h"

#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>

mw_defect mw__defect(mw_defect_kind kind, uint32_t triangle)
{
    return (mw_defect){.kind = kind,
                       .triangle = triangle,
                       .other = MW_NONE,
                       .vertex = MW_NONE,
                       .edge = 255,
                       .other_edge = 255};
}

bool mw__defects_add(mw_defects *defects, mw_defect defect)
{
    if (defects->count == defects->capacity) {
        size_t capacity = 2 * defects->capacity + 16;
        mw_defect *list = mw__realloc(defects->list, capacity, sizeof *list);
        if (!list) return false;
        defects->list = list;
        defects->capacity = capacity;
    }
    defects->list[defects->count++] = defect;
    return true;
}

static int compare_numbers(uint32_t a, uint32_t b)
{
    return (a > b) - (a < b);
}

static int compare_defects(const void *left, const void *right)
{
    const mw_defect *a = left, *b = right;
    int order = compare_numbers(a->kind, b->kind);
    if (!order) order = compare_numbers(a->triangle, b->triangle);
    if (!order) order = compare_numbers(a->edge, b->edge);
    if (!order) order = compare_numbers(a->vertex, b->vertex);
    if (!order) order = compare_numbers(a->other, b->other);
    return order ? order : compare_numbers(a->other_edge, b->other_edge);
}

void mw__defects_sort(mw_defects *defects)
{
    if (defects->count > 1)
        qsort(defects->list, defects->count, sizeof *defects->list, compare_defects);
}

void mw__defects_release(mw_defects *defects)
{
    free(defects->list);
    *defects = (mw_defects){0};
}

const char *mw_defect_text(mw_defect_kind kind)
{
    switch (kind) {
    case MW_DEFECT_MISSING_VERTEX: return "vertex that does not exist";
    case MW_DEFECT_NOT_FINITE: return "vertex that is not finite";
    case MW_DEFECT_REPEATED_VERTEX: return "vertex twice in one triangle";
    case MW_DEFECT_NON_MANIFOLD_EDGE: return "edge of three or more triangles";
    case MW_DEFECT_FOLDED: return "folded along an edge";
    case MW_DEFECT_WINDING: return "more than one turn round a vertex";
    case MW_DEFECT_CROSSING: return "borders that cross";
    case MW_DEFECT_VERTEX_IN_EDGE: return "vertex inside an edge";
    case MW_DEFECT_OVERLAP: return "overlap";
    case MW_DEFECT_FLAT: return "flat triangle";
    case MW_DEFECT_CLASHING: return "neighbours oriented differently";
    case MW_DEFECT_OPEN_EDGE: return "edge without a neighbour";
    case MW_DEFECT_THROUGH_CENTRE: return "plane through the centre";
    case MW_DEFECT_BACK_FACING: return "faces away from the centre";
    case MW_DEFECT_COVERED: return "direction covered twice";
    case MW_DEFECT_COUNT: break;
    }
    return "unknown defect";
}

static void defect_describe_overlap(const mw_defect *d, char *text, size_t size)
{
    if (d->other == MW_NONE)
        snprintf(text, size,
                 "triangle %" PRIu32 ": other triangles cover it too, beside its edge %u",
                 d->triangle, d->edge);
    else
        snprintf(text, size,
                 "triangle %" PRIu32 ": overlaps triangle %" PRIu32
                 ", which lies on the same side of edge %u",
                 d->triangle, d->other, d->edge);
}

/* Defects of surfaces and star-shaped polyhedra. */
static void defect_describe_in_space(const mw_defect *d, char *text, size_t size)
{
    uint32_t t = d->triangle;
    unsigned e = d->edge;
    switch (d->kind) {
    case MW_DEFECT_CLASHING:
        snprintf(text, size,
                 "triangle %" PRIu32 ": triangle %" PRIu32 " at edge %u is oriented differently", t,
                 d->other, e);
        return;
    case MW_DEFECT_OPEN_EDGE:
        snprintf(text, size,
                 "triangle %" PRIu32 ": edge %u has no neighbour: the polyhedron is not closed", t,
                 e);
        return;
    case MW_DEFECT_THROUGH_CENTRE:
        snprintf(text, size, "triangle %" PRIu32 ": its plane passes through the centre", t);
        return;
    case MW_DEFECT_BACK_FACING:
        if (d->other == MW_NONE)
            snprintf(text, size, "triangle %" PRIu32 ": faces away from the centre, unlike most",
                     t);
        else
            snprintf(text, size,
                     "triangle %" PRIu32 ": faces away from the centre, unlike triangle %" PRIu32
                     " at edge %u",
                     t, d->other, e);
        return;
    case MW_DEFECT_COVERED:
        snprintf(text, size,
                 "triangle %" PRIu32 ": a ray from the centre meets it and triangle %" PRIu32, t,
                 d->other);
        return;
    default: return;
    }
}

void mw_defect_describe(const mw_defect *d, char *text, size_t size)
{
    uint32_t t = d->triangle, v = d->vertex;
    unsigned e = d->edge;
    switch (d->kind) {
    case MW_DEFECT_MISSING_VERTEX:
        if (v == MW_NONE)
            snprintf(text, size, "triangle %" PRIu32 ": a vertex number is out of range", t);
        else
            snprintf(text, size, "triangle %" PRIu32 ": vertex %" PRIu32 " does not exist", t, v);
        return;
    case MW_DEFECT_NOT_FINITE:
        snprintf(text, size, "triangle %" PRIu32 ": vertex %" PRIu32 " is not finite", t, v);
        return;
    case MW_DEFECT_REPEATED_VERTEX:
        snprintf(text, size, "triangle %" PRIu32 ": vertex %" PRIu32 " is in it twice", t, v);
        return;
    case MW_DEFECT_NON_MANIFOLD_EDGE:
        snprintf(text, size,
                 "triangle %" PRIu32 ": two others share its edge %u, one is triangle %" PRIu32, t,
                 e, d->other);
        return;
    case MW_DEFECT_FOLDED:
        snprintf(text, size,
                 "triangle %" PRIu32 ": triangle %" PRIu32 " is folded back onto it at edge %u", t,
                 d->other, e);
        return;
    case MW_DEFECT_WINDING:
        snprintf(text, size,
                 "triangle %" PRIu32 ": the triangles round its vertex %" PRIu32
                 " turn more than once",
                 t, v);
        return;
    case MW_DEFECT_CROSSING:
        snprintf(text, size, "triangle %" PRIu32 ": edge %u crosses edge %u of triangle %" PRIu32,
                 t, e, d->other_edge, d->other);
        return;
    case MW_DEFECT_VERTEX_IN_EDGE:
        snprintf(text, size, "triangle %" PRIu32 ": vertex %" PRIu32 " lies inside edge %u", t, v,
                 e);
        return;
    case MW_DEFECT_OVERLAP: defect_describe_overlap(d, text, size); return;
    case MW_DEFECT_FLAT: snprintf(text, size, "triangle %" PRIu32 ": has no area", t); return;
    case MW_DEFECT_CLASHING:
    case MW_DEFECT_OPEN_EDGE:
    case MW_DEFECT_THROUGH_CENTRE:
    case MW_DEFECT_BACK_FACING:
    case MW_DEFECT_COVERED: defect_describe_in_space(d, text, size); return;
    case MW_DEFECT_COUNT: break;
    }
    snprintf(text, size, "triangle %" PRIu32 ": unknown defect", t);
}

void mw_check_release(mw_check *check)
{
    if (!check) return;
    free(check->defects);
    *check = (mw_check){0};
}
