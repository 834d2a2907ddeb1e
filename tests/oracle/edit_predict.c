/* edit_predict.c - the rules of every kind of edit, by brute force. */
#include "oracle/edit_predict.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "oracle/edit_locate.h"
#include "support/meshes.h"

/* --- the triangles round a vertex ------------------------------------------------------------- */

twin_star twin_star_of(const twin *t, uint32_t v)
{
    twin_star s = {0};
    for (uint32_t k = 0; k < t->triangle_range; k++)
        for (int c = 0; c < 3; c++)
            s.count += twin_has_triangle(t, k) && twin_corners(t, k)[c] == v;
    s.side = require_room(s.count, sizeof *s.side);
    s.border = require_room(2 * (size_t)s.count, sizeof *s.border);
    s.fixed = require_room(2 * (size_t)s.count + t->fixed_count, sizeof *s.fixed);
    s.count = 0;
    for (uint32_t k = 0; k < t->triangle_range; k++)
        for (int c = 0; c < 3; c++)
            if (twin_has_triangle(t, k) && twin_corners(t, k)[(c + 2) % 3] == v)
                s.side[s.count++] = twin_side_of(t, k, twin_turn(t, k), c);
    /* 1: a side begins there, 2: one ends there */
    uint8_t *ends = require_room(t->vertex_range, 1);
    for (uint32_t i = 0; i < s.count; i++) {
        ends[s.side[i].from] |= 1;
        ends[s.side[i].to] |= 2;
    }
    for (uint32_t i = 0; i < s.count; i++) {
        if (ends[s.side[i].from] == 1) s.border[s.border_count++] = s.side[i].from;
        if (ends[s.side[i].to] == 2) s.border[s.border_count++] = s.side[i].to;
    }
    free(ends);
    for (size_t i = 0; i < t->fixed_count; i++)
        for (int k = 0; k < 2; k++)
            if (t->fixed[2 * i + (size_t)k] == v)
                s.fixed[s.fixed_count++] = t->fixed[2 * i + 1 - (size_t)k];
    for (uint32_t i = 0; i < s.border_count && !t->convex; i++)
        s.fixed[s.fixed_count++] = s.border[i];
    return s;
}

void twin_star_free(twin_star *s)
{
    free(s->side);
    free(s->border);
    free(s->fixed);
}

bool twin_star_fits(const twin *t, const twin_star *s, const double *q)
{
    for (uint32_t i = 0; i < s->count; i++)
        if (plane_orient(twin_point(t, s->side[i].from), twin_point(t, s->side[i].to), q) <= 0)
            return false;
    return true;
}

/* --- each kind -------------------------------------------------------------------------------- */

/* Do the vertices but v span an area? */
static bool is_something_left(const twin *t, uint32_t v)
{
    uint32_t a = MW_NONE, b = MW_NONE;
    for (uint32_t w = 0; w < t->vertex_range; w++) {
        if (w == v || t->state[w] != TWIN_USED) continue;
        if (a == MW_NONE)
            a = w;
        else if (b == MW_NONE)
            b = w;
        else if (plane_orient(twin_point(t, a), twin_point(t, b), twin_point(t, w)) != 0)
            return true;
    }
    return false;
}

static twin_outcome predict_remove(const twin *t, uint32_t v)
{
    if (!twin_uses_vertex(t, v)) return TWIN_REFUSED;
    twin_star s = twin_star_of(t, v);
    bool can =
        s.fixed_count == 0 ||
        (s.fixed_count == 2 && plane_is_on_segment(twin_point(t, s.fixed[0]),
                                                   twin_point(t, s.fixed[1]), twin_point(t, v)));
    if (s.border_count > 0 && !is_something_left(t, v)) can = false;
    twin_star_free(&s);
    return can ? TWIN_DONE : TWIN_REFUSED;
}

static twin_outcome predict_insert(const twin *t, const double *q)
{
    location_answer where = twin_locate(t, q);
    return where.where == MW_BAD || (where.triangle == MW_NONE && !t->convex) ? TWIN_REFUSED
                                                                              : TWIN_DONE;
}

/* Are the triangles an embedding with v at q, by a check from scratch? */
static bool is_embedding_at(const twin *t, uint32_t v, const double *q)
{
    double *points = require_room(2 * (size_t)t->vertex_range, sizeof *points);
    uint32_t *triangles = require_room(3 * (size_t)t->triangles, sizeof *triangles);
    size_t n = 0;
    for (uint32_t w = 0; w < t->vertex_range; w++)
        if (t->state[w] != TWIN_GONE)
            memcpy(points + 2 * (size_t)w, w == v ? q : twin_point(t, w), 2 * sizeof *points);
    for (uint32_t k = 0; k < t->triangle_range; k++)
        if (twin_has_triangle(t, k))
            memcpy(triangles + 3 * n++, twin_corners(t, k), 3 * sizeof *triangles);
    mw_arrays given = {.points = points,
                       .point_count = t->vertex_range,
                       .triangles = triangles,
                       .triangle_count = t->triangles};
    mw_check check;
    mw_error error = {0};
    expect_ok(mw_check_arrays(&given, NULL, &check, &error), "check", &error);
    bool embedding = check.valid;
    mw_check_release(&check);
    free(points);
    free(triangles);
    return embedding;
}

static twin_outcome predict_move(const twin *t, uint32_t v, const double *q)
{
    if (!twin_uses_vertex(t, v) || !isfinite(q[0]) || !isfinite(q[1])) return TWIN_REFUSED;
    if (q[0] == twin_point(t, v)[0] && q[1] == twin_point(t, v)[1]) return TWIN_DONE;
    location_answer where = twin_locate(t, q);
    if (where.where == MW_ON_VERTEX) return TWIN_REFUSED;
    twin_star s = twin_star_of(t, v);
    bool stays = twin_star_fits(t, &s, q), border = s.border_count > 0, fixed = s.fixed_count > 0;
    twin_star_free(&s);
    if (!border && stays) return TWIN_DONE;
    if (border && (fixed || !is_something_left(t, v)))
        return stays && is_embedding_at(t, v, q) ? TWIN_DONE : TWIN_REFUSED;
    if (fixed) return TWIN_REFUSED;
    return where.triangle == MW_NONE && !t->convex ? TWIN_REFUSED : TWIN_DONE;
}

static twin_outcome predict_flip(const twin *t, uint32_t a, uint32_t b)
{
    twin_side s, r;
    if (a == b || !twin_uses_vertex(t, a) || !twin_uses_vertex(t, b)) return TWIN_REFUSED;
    if (!twin_find_edge(t, a, b, &s) || !twin_find_edge(t, b, a, &r) || twin_is_fixed(t, a, b))
        return TWIN_REFUSED;
    return plane_is_crossing(twin_point(t, a), twin_point(t, b), twin_point(t, s.apex),
                             twin_point(t, r.apex))
               ? TWIN_DONE
               : TWIN_REFUSED;
}

uint32_t *twin_vertices_between(const twin *t, uint32_t a, uint32_t b, size_t *count)
{
    uint32_t *way = require_room((size_t)t->vertex_range + 2, sizeof *way);
    *count = 0;
    way[(*count)++] = a;
    for (uint32_t v = 0; v < t->vertex_range; v++)
        if (v != a && v != b && twin_uses_vertex(t, v) &&
            plane_is_on_segment(twin_point(t, a), twin_point(t, b), twin_point(t, v)))
            way[(*count)++] = v;
    for (size_t i = 2; i < *count; i++)
        for (size_t j = i; j > 1 && plane_is_between(twin_point(t, a), twin_point(t, way[j]),
                                                     twin_point(t, way[j - 1]));
             j--) {
            uint32_t swap = way[j];
            way[j] = way[j - 1];
            way[j - 1] = swap;
        }
    way[(*count)++] = b;
    return way;
}

/* Is one way from vertex to vertex, with none between, free for a constraint? Of meshes that do
 * not fill their hull the coordinates have to be such that the middle of two of them is exact. */
static bool is_way_free(const twin *t, uint32_t a, uint32_t b)
{
    location_answer middle;
    for (size_t i = 0; i < t->fixed_count; i++)
        if (plane_is_crossing(twin_point(t, a), twin_point(t, b), twin_point(t, t->fixed[2 * i]),
                              twin_point(t, t->fixed[2 * i + 1])))
            return false;
    if (t->convex || twin_count_sides(t, a, b)) return true;
    for (uint32_t k = 0; k < t->triangle_range; k++)
        for (int c = 0; c < 3; c++) {
            if (!twin_has_triangle(t, k)) continue;
            uint32_t v = twin_corners(t, k)[c], w = twin_corners(t, k)[(c + 1) % 3];
            if (plane_is_crossing(twin_point(t, a), twin_point(t, b), twin_point(t, v),
                                  twin_point(t, w)) &&
                twin_count_sides(t, v, w) == 1)
                return false;
        }
    const double q[2] = {twin_point(t, a)[0] / 2 + twin_point(t, b)[0] / 2,
                         twin_point(t, a)[1] / 2 + twin_point(t, b)[1] / 2};
    middle = twin_locate(t, q);
    return middle.triangle != MW_NONE;
}

static twin_outcome predict_constrain(const twin *t, uint32_t a, uint32_t b, bool release)
{
    if (!twin_uses_vertex(t, a) || !twin_uses_vertex(t, b) || a == b) return TWIN_REFUSED;
    size_t count;
    uint32_t *way = twin_vertices_between(t, a, b, &count);
    bool can = true;
    for (size_t i = 1; i < count; i++)
        can = can &&
              (release ? twin_is_fixed(t, way[i - 1], way[i]) : is_way_free(t, way[i - 1], way[i]));
    free(way);
    return can ? TWIN_DONE : TWIN_REFUSED;
}

twin_outcome twin_predict(const twin *t, const mw_edit *e)
{
    const double q[2] = {e->x, e->y};
    switch (e->kind) {
    case MW_EDIT_INSERT: return predict_insert(t, q);
    case MW_EDIT_REMOVE: return predict_remove(t, e->vertex);
    case MW_EDIT_MOVE: return predict_move(t, e->vertex, q);
    case MW_EDIT_FLIP: return predict_flip(t, e->vertex, e->other);
    case MW_EDIT_CONSTRAIN: return predict_constrain(t, e->vertex, e->other, false);
    case MW_EDIT_RELEASE: return predict_constrain(t, e->vertex, e->other, true);
    case MW_EDIT_VALUE:
        return e->vertex < t->vertex_range && t->state[e->vertex] != TWIN_GONE ? TWIN_DONE
                                                                               : TWIN_REFUSED;
    default: return TWIN_REFUSED;
    }
}
