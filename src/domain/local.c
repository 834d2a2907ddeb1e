/* local.c - defects that show in a triangle, at an edge or round a vertex. */
#include "domain/local.h"

#include <stdlib.h>

/* --- triangles --- */

/* What makes triangle t unusable; *usable tells whether nothing does. */
static bool check_triangle(const mw_mesh *mesh, uint32_t t, mw_defects *defects, bool *usable)
{
    const uint32_t *v = mesh->tri[t].v;
    *usable = true;
    for (uint32_t k = 0; k < 3; k++) {
        bool finite = mw__is_finite(mesh->point[v[k]]);
        int before = (k > 0 && v[0] == v[k]) + (k > 1 && v[1] == v[k]); /* a vertex three times is one defect */
        mw_defect defect = mw__defect(before > 0 ? MW_DEFECT_REPEATED_VERTEX : MW_DEFECT_NOT_FINITE, t);
        defect.vertex = v[k];
        if (before > 0 || !finite) *usable = false;
        if ((before == 1 || (before == 0 && !finite)) && !mw__defects_add(defects, defect)) return false;
    }
    return true;
}

static bool check_triangles(const mw_outline *o, mw_defects *defects)
{
    for (uint32_t t = 0; o->flat && t < o->mesh->tri_count; t++) {
        bool usable = true;
        if (!o->flat[t]) continue;
        if (o->mesh->tolerant && !check_triangle(o->mesh, t, defects, &usable)) return false;
        if (usable && !mw__defects_add(defects, mw__defect(MW_DEFECT_FLAT, t))) return false;
    }
    return true;
}

/* --- edges --- */

typedef struct side {
    uint32_t low, high, half;
} side;

static side side_of(const mw_mesh *mesh, uint32_t half)
{
    const mw_triangle *t = &mesh->tri[mw__link_triangle(half)];
    uint32_t a = t->v[mw__link_edge(half)], b = t->v[mw__link_edge(half) + 1];
    return (side){a < b ? a : b, a < b ? b : a, half};
}

static int compare_sides(const void *left, const void *right)
{
    const side *a = left, *b = right;
    if (a->low != b->low) return a->low < b->low ? -1 : 1;
    if (a->high != b->high) return a->high < b->high ? -1 : 1;
    return 0;
}

/* All edges without neighbour, sorted: *sides and *count. */
static bool gather_unlinked(const mw_mesh *mesh, side **sides, size_t *count)
{
    *sides = NULL;
    for (int pass = 0; pass < 2; pass++) {
        *count = 0;
        for (uint32_t t = 0; t < mesh->tri_count; t++)
            for (uint32_t k = 0; k < 3 && mw__has_three_vertices(&mesh->tri[t]); k++) {
                if (mesh->tri[t].link[k] != MW_NONE) continue;
                if (pass == 1) (*sides)[*count] = side_of(mesh, mw__link(t, k));
                (*count)++;
            }
        if (pass == 0 && !(*sides = mw__alloc(*count, sizeof **sides))) return false;
    }
    qsort(*sides, *count, sizeof **sides, compare_sides);
    return true;
}

static mw_defect shared(const mw_mesh *mesh, uint32_t half, uint32_t other)
{
    mw_defect defect = mw__defect(MW_DEFECT_EDGE_SHARED, mw__link_triangle(half));
    defect.edge = (uint8_t)mw__user_edge(mesh->tri[defect.triangle].user, mw__link_edge(half));
    defect.other = other;
    return defect;
}

/* Of an edge of more than two triangles, the first two are linked: the others are without neighbour. */
static bool check_sharing(const mw_mesh *mesh, mw_defects *defects)
{
    side *sides;
    size_t count;
    if (!mesh->tolerant) return true;
    if (!gather_unlinked(mesh, &sides, &count)) return false;
    bool done = true;
    for (uint32_t t = 0; t < mesh->tri_count; t++)
        for (uint32_t k = 0; k < 3 && done; k++) {
            if (mesh->tri[t].link[k] == MW_NONE || mw__link_triangle(mesh->tri[t].link[k]) < t) continue;
            side key = side_of(mesh, mw__link(t, k));
            const side *found = bsearch(&key, sides, count, sizeof key, compare_sides);
            if (!found) continue;
            while (found > sides && compare_sides(found - 1, &key) == 0) found--;
            for (; found < sides + count && compare_sides(found, &key) == 0 && done; found++)
                done = mw__defects_add(defects, shared(mesh, found->half, t));
        }
    free(sides);
    return done;
}

static bool check_folds(const mw_outline *o, mw_defects *defects)
{
    for (uint32_t i = 0; i < o->half_count; i++) {
        if (!mw__is_fold(o, o->half[i])) continue;
        uint32_t t = mw__link_triangle(o->half[i]), k = mw__link_edge(o->half[i]);
        uint32_t link = o->mesh->tri[t].link[k];
        mw_defect defect = mw__defect(MW_DEFECT_FOLDED, t);
        defect.edge = (uint8_t)mw__user_edge(o->mesh->tri[t].user, k);
        defect.other = mw__link_triangle(link);
        defect.other_edge = (uint8_t)mw__user_edge(o->mesh->tri[defect.other].user, mw__link_edge(link));
        if (!mw__defects_add(defects, defect)) return false;
    }
    return true;
}

bool mw__find_local_defects(const mw_outline *outline, mw_defects *defects)
{
    return check_triangles(outline, defects) && check_sharing(outline->mesh, defects) && check_folds(outline, defects);
}

/* --- vertices --- */

/* Does the angle of a triangle at its corner k hold the direction +x? Of its two rays, the first counts as in the
 * angle. A counter-clockwise triangle with an area needs no predicate for this. */
static bool holds_x(const mw_point *point, const mw_triangle *t, uint32_t k)
{
    mw_point v = point[t->v[k]], a = point[t->v[k + 1]], b = point[t->v[mw__prev(k)]];
    return (a.y < v.y && b.y > v.y) || (a.y == v.y && a.x > v.x);
}

/* An inner vertex: the triangles round it close; they turn as often as their angles hold any one direction. */
static bool is_inner(const mw_outline *o, uint32_t v)
{
    return o->place[v] == MW_NONE || o->place[v] >= o->place_count;
}

bool mw__find_turns(const mw_outline *outline, mw_defects *defects)
{
    const mw_mesh *mesh = outline->mesh;
    enum { MANY = 2 };
    uint8_t *turns = mw__calloc(mesh->point_count, sizeof *turns);
    if (!turns) return false;
    for (uint32_t t = 0; t < mesh->tri_count; t++)
        for (uint32_t k = 0; k < 3 && !mw__is_flat(outline, t); k++) {
            uint32_t v = mesh->tri[t].v[k];
            if (turns[v] < MANY && holds_x(mesh->point, &mesh->tri[t], k)) turns[v]++;
        }
    bool done = true;
    for (uint32_t t = 0; t < mesh->tri_count; t++)
        for (uint32_t k = 0; k < 3 && done && !mw__is_flat(outline, t); k++) {
            uint32_t v = mesh->tri[t].v[k];
            if (turns[v] < MANY || !is_inner(outline, v)) continue;
            turns[v] = 0; /* told once */
            mw_defect defect = mw__defect(MW_DEFECT_TURN, t);
            defect.vertex = v;
            done = mw__defects_add(defects, defect);
        }
    free(turns);
    return done;
}
