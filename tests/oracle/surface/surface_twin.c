#include "oracle/surface/surface_twin.h"

#include "base/random.h"
#include "oracle/edit_require.h"
#include "oracle/touch_oracle.h"
#include "surface/edit/edited_surface.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* --- lists ------------------------------------------------------------------------------------ */

static twin_surface twin_surface_copy(const twin_surface *s)
{
    return (twin_surface){require_copy(s->point, 3 * (size_t)s->points, sizeof(double)),
                          require_copy(s->triangle, 3 * (size_t)s->triangles, sizeof(uint32_t)),
                          require_copy(s->has_point, s->points, sizeof(bool)),
                          require_copy(s->has_triangle, s->triangles, sizeof(bool)),
                          s->points,
                          s->triangles};
}

static void twin_surface_free(twin_surface *s)
{
    free(s->point);
    free(s->triangle);
    free(s->has_point);
    free(s->has_triangle);
}

static uint32_t twin_add_point(twin_surface *s, const double p[3])
{
    s->point = require_more_room(s->point, 3 * (size_t)s->points + 3, sizeof(double));
    s->has_point = require_more_room(s->has_point, s->points + 1u, sizeof(bool));
    memcpy(s->point + 3 * (size_t)s->points, p, 3 * sizeof *p);
    s->has_point[s->points] = true;
    return s->points++;
}

static uint32_t twin_add_triangle(twin_surface *s, uint32_t a, uint32_t b, uint32_t c)
{
    s->triangle = require_more_room(s->triangle, 3 * (size_t)s->triangles + 3, sizeof(uint32_t));
    s->has_triangle = require_more_room(s->has_triangle, s->triangles + 1u, sizeof(bool));
    uint32_t *v = s->triangle + 3 * (size_t)s->triangles;
    v[0] = a, v[1] = b, v[2] = c;
    s->has_triangle[s->triangles] = true;
    return s->triangles++;
}

static bool twin_has_point(const twin_surface *s, uint32_t v)
{
    return v < s->points && s->has_point[v];
}

static bool twin_has_triangle(const twin_surface *s, uint32_t t)
{
    return t < s->triangles && s->has_triangle[t];
}

static uint32_t twin_living(const twin_surface *s)
{
    uint32_t n = 0;
    for (uint32_t t = 0; t < s->triangles; t++) n += s->has_triangle[t];
    return n;
}

/* The corner of a triangle at a vertex; 3: none. */
static uint32_t twin_corner(const twin_surface *s, uint32_t t, uint32_t v)
{
    uint32_t k = 0;
    while (k < 3 && s->triangle[3 * t + k] != v) k++;
    return k;
}

/* The triangles with both vertices, the first two of them in `at`. */
static uint32_t twin_edge(const twin_surface *s, uint32_t a, uint32_t b, uint32_t at[2])
{
    uint32_t n = 0;
    at[0] = at[1] = MW_NONE;
    for (uint32_t t = 0; t < s->triangles && a != b; t++)
        if (s->has_triangle[t] && twin_corner(s, t, a) < 3 && twin_corner(s, t, b) < 3) {
            if (n < 2) at[n] = t;
            n++;
        }
    return n;
}

/* Does triangle t run from a to b? */
static bool twin_runs(const twin_surface *s, uint32_t t, uint32_t a, uint32_t b)
{
    uint32_t k = twin_corner(s, t, a);
    return s->triangle[3 * t + (k + 1) % 3] == b;
}

static uint32_t twin_third(const twin_surface *s, uint32_t t, uint32_t a, uint32_t b)
{
    for (uint32_t k = 0; k < 3; k++)
        if (s->triangle[3 * t + k] != a && s->triangle[3 * t + k] != b)
            return s->triangle[3 * t + k];
    return MW_NONE;
}

static void twin_replace(twin_surface *s, uint32_t t, uint32_t from, uint32_t to)
{
    uint32_t k = twin_corner(s, t, from);
    if (k < 3) s->triangle[3 * t + k] = to;
}

/* --- is it a surface? ------------------------------------------------------------------------- */

typedef struct twin_half {
    uint32_t low, high, way;
} twin_half;

static int compare_halves(const void *a, const void *b)
{
    const twin_half *s = a, *t = b;
    if (s->low != t->low) return s->low < t->low ? -1 : 1;
    return s->high < t->high ? -1 : s->high > t->high;
}

/* No vertex is twice in a triangle, no edge has three. *clashes: edges with triangles of opposite
 * orientation. */
static bool twin_is_sound(const twin_surface *s, uint32_t *clashes)
{
    twin_half *half = require_room(3 * (size_t)s->triangles, sizeof *half);
    size_t n = 0;
    bool sound = true;
    *clashes = 0;
    for (uint32_t t = 0; t < s->triangles; t++)
        for (uint32_t k = 0; k < 3 && s->has_triangle[t]; k++) {
            uint32_t a = s->triangle[3 * t + k], b = s->triangle[3 * t + (k + 1) % 3];
            sound = sound && a != b;
            half[n++] = (twin_half){a < b ? a : b, a < b ? b : a, a < b};
        }
    if (n) qsort(half, n, sizeof *half, compare_halves);
    for (size_t i = 1; i < n; i++) {
        if (compare_halves(&half[i], &half[i - 1]) != 0) continue;
        *clashes += half[i].way == half[i - 1].way;
        sound = sound && (i < 2 || compare_halves(&half[i], &half[i - 2]) != 0);
    }
    free(half);
    return sound;
}

static shape twin_shape(const twin_surface *s, uint32_t **number)
{
    shape made = shape_make(s->points, s->triangles);
    uint32_t *vertex = require_room(s->points, sizeof *vertex);
    *number = require_room(s->triangles, sizeof **number);
    for (uint32_t v = 0; v < s->points; v++)
        if (s->has_point[v])
            vertex[v] =
                shape_point(&made, s->point[3 * v], s->point[3 * v + 1], s->point[3 * v + 2]);
    for (uint32_t t = 0; t < s->triangles; t++) {
        if (!s->has_triangle[t]) continue;
        (*number)[made.triangle_count] = t;
        const uint32_t *v = s->triangle + 3 * (size_t)t;
        shape_triangle(&made, vertex[v[0]], vertex[v[1]], vertex[v[2]]);
    }
    free(vertex);
    return made;
}

shape surface_twin_shape(const surface_twin *t, uint32_t **number)
{
    return twin_shape(&t->now, number);
}

static mw_surface_info twin_describe(const twin_surface *s)
{
    uint32_t *number;
    mw_surface_info info;
    shape made = twin_shape(s, &number);
    mw_surface *surface = shape_surface(&made, (mw_surface_options){0});
    REQUIRE(mw_surface_describe(surface, &info, NULL) == MW_OK);
    mw_surface_destroy(surface);
    shape_free(&made);
    free(number);
    return info;
}

/* --- predictions: is an edit right, and what does it make of the list? ------------------------ */

static void twin_free_triangles_of(twin_surface *s, uint32_t v)
{
    for (uint32_t t = 0; t < s->triangles; t++)
        if (s->has_triangle[t] && twin_corner(s, t, v) < 3) s->has_triangle[t] = false;
}

static bool predict_split_edge(twin_surface *s, const mw_surface_edit *e)
{
    uint32_t clashes, a = e->vertex[0], b = e->vertex[1], at[2], low = a < b ? a : b;
    uint32_t high = a < b ? b : a;
    if (!twin_has_point(s, a) || !twin_has_point(s, b) || !twin_edge(s, a, b, at)) return false;
    double p[3];
    for (int k = 0; k < 3; k++)
        p[k] = isnan(e->point[0])
                   ? s->point[3 * a + (uint32_t)k] / 2 + s->point[3 * b + (uint32_t)k] / 2
                   : e->point[k];
    uint32_t m = twin_add_point(s, p);
    for (int i = 0; i < 2 && at[i] != MW_NONE; i++) {
        const uint32_t *v = s->triangle + 3 * (size_t)at[i];
        uint32_t made = twin_add_triangle(s, v[0], v[1], v[2]);
        twin_replace(s, at[i], high, m);
        twin_replace(s, made, low, m);
    }
    return twin_is_sound(s, &clashes);
}

static bool predict_split_triangle(twin_surface *s, const mw_surface_edit *e)
{
    uint32_t t = e->triangle;
    if (!twin_has_triangle(s, t)) return false;
    uint32_t v[3] = {s->triangle[3 * t], s->triangle[3 * t + 1], s->triangle[3 * t + 2]};
    double p[3];
    for (uint32_t k = 0; k < 3; k++) {
        p[k] = e->point[k];
        if (!isnan(e->point[0])) continue;
        p[k] = 0;
        for (int i = 0; i < 3; i++) p[k] += s->point[3 * v[i] + k] / 3;
    }
    uint32_t m = twin_add_point(s, p);
    s->triangle[3 * t + 2] = m;
    twin_add_triangle(s, v[1], v[2], m);
    twin_add_triangle(s, v[2], v[0], m);
    return true;
}

static bool predict_flip(twin_surface *s, const mw_surface_edit *e)
{
    uint32_t a = e->vertex[0], b = e->vertex[1], at[2], other[2];
    if (!twin_has_point(s, a) || !twin_has_point(s, b) || twin_edge(s, a, b, at) != 2) return false;
    if (twin_runs(s, at[0], a, b) == twin_runs(s, at[1], a, b)) return false;
    uint32_t c = twin_third(s, at[0], a, b), d = twin_third(s, at[1], a, b);
    if (c == d || twin_edge(s, c, d, other)) return false;
    bool runs = twin_runs(s, at[0], a, b);
    twin_replace(s, at[0], runs ? a : b, d);
    twin_replace(s, at[1], runs ? b : a, c);
    return true;
}

static bool twin_has_twice(const twin_surface *s)
{
    for (uint32_t t = 0; t < s->triangles; t++)
        for (uint32_t u = t + 1; u < s->triangles && s->has_triangle[t]; u++) {
            if (!s->has_triangle[u]) continue;
            int same = 0;
            for (uint32_t k = 0; k < 3; k++) same += twin_corner(s, u, s->triangle[3 * t + k]) < 3;
            if (same == 3) return true;
        }
    return false;
}

static bool edge_on_path(const mw_surface_edit *e, uint32_t a, uint32_t b)
{
    for (size_t i = 0; e && i + 1 < e->path_count; i++)
        if ((e->path[i] == a && e->path[i + 1] == b) || (e->path[i] == b && e->path[i + 1] == a))
            return true;
    return false;
}

/* Give the triangles at a vertex the lowest number of those that they hang together with, over
 * edges at the vertex that `e` (or NULL) does not cut. Returns how many fans there are. */
static uint32_t twin_fans(const twin_surface *s, const mw_surface_edit *e, uint32_t v,
                          uint32_t *fan)
{
    uint32_t at[2], fans = 0;
    bool more = true;
    for (uint32_t t = 0; t < s->triangles; t++) fan[t] = t;
    while (more) {
        more = false;
        for (uint32_t t = 0; t < s->triangles; t++) {
            if (!s->has_triangle[t] || twin_corner(s, t, v) == 3) continue;
            for (uint32_t k = 0; k < 3; k++) {
                uint32_t w = s->triangle[3 * t + k];
                if (w == v || edge_on_path(e, v, w) || twin_edge(s, v, w, at) != 2) continue;
                uint32_t low = fan[at[0]] < fan[at[1]] ? fan[at[0]] : fan[at[1]];
                more = more || fan[at[0]] != fan[at[1]];
                fan[at[0]] = fan[at[1]] = low;
            }
        }
    }
    for (uint32_t t = 0; t < s->triangles; t++)
        fans += s->has_triangle[t] && twin_corner(s, t, v) < 3 && fan[t] == t;
    return fans;
}

/* Border edges at a vertex. */
static uint32_t twin_borders_at(const twin_surface *s, uint32_t v)
{
    uint32_t at[2], n = 0;
    for (uint32_t t = 0; t < s->triangles; t++)
        for (uint32_t k = 0; k < 3 && s->has_triangle[t] && twin_corner(s, t, v) < 3; k++)
            n += twin_edge(s, v, s->triangle[3 * t + k], at) == 1;
    return n;
}

/* Fans of all vertices; *pinched: border edges at vertices of more than one. */
static uint32_t twin_all_fans(const twin_surface *s, uint32_t *pinched)
{
    uint32_t *fan = require_room(s->triangles, sizeof *fan), fans = 0;
    *pinched = 0;
    for (uint32_t v = 0; v < s->points; v++) {
        uint32_t n = twin_fans(s, NULL, v, fan);
        fans += n;
        if (n > 1) *pinched += twin_borders_at(s, v);
    }
    free(fan);
    return fans;
}

/* Divide a vertex of the path: triangles at it stay together over edges that are not cut. */
static void predict_divide(const twin_surface *was, twin_surface *s, const mw_surface_edit *e,
                           uint32_t v)
{
    uint32_t *fan = require_room(was->triangles, sizeof *fan);
    bool kept = false;
    twin_fans(was, e, v, fan);
    for (uint32_t f = 0; f < was->triangles; f++) {
        bool cut = false;
        for (uint32_t t = 0; t < was->triangles; t++)
            for (uint32_t k = 0; k < 3 && fan[t] == f && was->has_triangle[t]; k++)
                cut = cut ||
                      (twin_corner(was, t, v) < 3 && edge_on_path(e, v, was->triangle[3 * t + k]));
        if (!cut) continue;
        if (kept) {
            uint32_t copy = twin_add_point(s, was->point + 3 * (size_t)v);
            for (uint32_t t = 0; t < was->triangles; t++)
                if (fan[t] == f && was->has_triangle[t]) twin_replace(s, t, v, copy);
        }
        kept = true;
    }
    free(fan);
}

/* A collapse is right if the surface stays what it is: the same numbers of components, loops,
 * handles, pinched vertices and fans; and no two triangles become one. */
static bool predict_collapse(twin_surface *s, const mw_surface_edit *e)
{
    uint32_t a = e->vertex[0], b = e->vertex[1], at[2], clashes;
    if (!twin_has_point(s, a) || !twin_has_point(s, b)) return false;
    uint32_t n = twin_edge(s, a, b, at);
    if (n == 0 || twin_living(s) <= n) return false;
    mw_surface_info before = twin_describe(s);
    bool had_twice = twin_has_twice(s);
    uint32_t pinched, pinched_now, fans = twin_all_fans(s, &pinched) - 1; /* that of a goes */
    for (uint32_t i = 0; i < n; i++) s->has_triangle[at[i]] = false;
    for (uint32_t t = 0; t < s->triangles; t++)
        if (s->has_triangle[t]) twin_replace(s, t, a, b);
    s->has_point[a] = false;
    if (!twin_is_sound(s, &clashes) || (!had_twice && twin_has_twice(s))) return false;
    mw_surface_info after = twin_describe(s);
    if (twin_all_fans(s, &pinched_now) != fans || pinched != pinched_now) return false;
    if (!isnan(e->point[0])) memcpy(s->point + 3 * (size_t)b, e->point, sizeof e->point);
    return before.euler == after.euler && before.components == after.components &&
           before.border_loops == after.border_loops &&
           before.pinched_vertices == after.pinched_vertices &&
           before.unused_vertices == after.unused_vertices &&
           before.border_edges == after.border_edges + (n == 1);
}

static bool predict_cut(twin_surface *s, const mw_surface_edit *e)
{
    uint32_t at[2];
    for (size_t i = 0; i + 1 < e->path_count; i++) {
        uint32_t a = e->path[i], b = e->path[i + 1];
        if (!twin_has_point(s, a) || !twin_has_point(s, b) || twin_edge(s, a, b, at) != 2)
            return false;
        for (size_t j = 0; j < i; j++)
            if ((e->path[j] == a && e->path[j + 1] == b) ||
                (e->path[j] == b && e->path[j + 1] == a))
                return false;
    }
    twin_surface was = twin_surface_copy(s);
    for (size_t i = 0; i < e->path_count; i++) {
        bool first = true;
        for (size_t j = 0; j < i; j++) first = first && e->path[j] != e->path[i];
        if (first) predict_divide(&was, s, e, e->path[i]);
    }
    bool open = true;
    for (size_t i = 0; i + 1 < e->path_count; i++) {
        twin_edge(&was, e->path[i], e->path[i + 1], at);
        uint32_t ends[2][2];
        for (int j = 0; j < 2; j++)
            for (int k = 0; k < 2; k++)
                ends[j][k] =
                    s->triangle[3 * at[j] + twin_corner(&was, at[j], e->path[i + (size_t)k])];
        open = open && (ends[0][0] != ends[1][0] || ends[0][1] != ends[1][1]);
    }
    twin_surface_free(&was);
    return open;
}

static bool predict_sew(twin_surface *s, const mw_surface_edit *e)
{
    uint32_t a[2], b[2], before, after;
    for (size_t i = 0; i < e->path_count; i++)
        if (!twin_has_point(s, e->path[i]) || !twin_has_point(s, e->other[i])) return false;
    for (size_t i = 0; i + 1 < e->path_count; i++)
        if (twin_edge(s, e->path[i], e->path[i + 1], a) != 1 ||
            twin_edge(s, e->other[i], e->other[i + 1], b) != 1 ||
            (e->path[i] == e->other[i] && e->path[i + 1] == e->other[i + 1]) ||
            (e->path[i] == e->other[i + 1] && e->path[i + 1] == e->other[i]))
            return false;
    for (size_t i = 0; i < e->path_count; i++)
        for (size_t j = 0; j < e->path_count; j++) {
            if (e->other[i] == e->other[j] && e->path[i] != e->path[j]) return false;
            if (e->other[i] == e->path[j] && e->path[i] != e->path[j]) return false;
        }
    twin_is_sound(s, &before);
    for (size_t i = 0; i < e->path_count; i++) {
        if (e->path[i] == e->other[i]) continue;
        for (uint32_t t = 0; t < s->triangles; t++) {
            if (!s->has_triangle[t]) continue;
            for (uint32_t k = 0; k < 3; k++)
                if (s->triangle[3 * t + k] == e->other[i]) s->triangle[3 * t + k] = e->path[i];
        }
        s->has_point[e->other[i]] = false;
    }
    return twin_is_sound(s, &after) && after <= before;
}

static bool predict_add_triangle(twin_surface *s, const mw_surface_edit *e)
{
    uint32_t before, after;
    for (int k = 0; k < 3; k++)
        if (!twin_has_point(s, e->vertex[k])) return false;
    twin_is_sound(s, &before);
    twin_add_triangle(s, e->vertex[0], e->vertex[1], e->vertex[2]);
    return twin_is_sound(s, &after) && after <= before;
}

static bool predict(twin_surface *s, const mw_surface_edit *e)
{
    uint32_t v = e->vertex[0];
    switch (e->kind) {
    case MW_SURFACE_ADD_VERTEX: twin_add_point(s, e->point); return true;
    case MW_SURFACE_REMOVE_VERTEX: {
        if (!twin_has_point(s, v)) return false;
        uint32_t had = twin_living(s);
        twin_free_triangles_of(s, v);
        s->has_point[v] = false;
        return had == twin_living(s) || twin_living(s) > 0;
    }
    case MW_SURFACE_MOVE_VERTEX:
        if (!twin_has_point(s, v)) return false;
        memcpy(s->point + 3 * (size_t)v, e->point, sizeof e->point);
        return true;
    case MW_SURFACE_ADD_TRIANGLE: return predict_add_triangle(s, e);
    case MW_SURFACE_REMOVE_TRIANGLE:
        if (!twin_has_triangle(s, e->triangle) || twin_living(s) == 1) return false;
        s->has_triangle[e->triangle] = false;
        return true;
    case MW_SURFACE_SPLIT_EDGE: return predict_split_edge(s, e);
    case MW_SURFACE_SPLIT_TRIANGLE: return predict_split_triangle(s, e);
    case MW_SURFACE_FLIP: return predict_flip(s, e);
    case MW_SURFACE_COLLAPSE: return predict_collapse(s, e);
    case MW_SURFACE_CUT: return predict_cut(s, e);
    case MW_SURFACE_SEW: return predict_sew(s, e);
    default: return false;
    }
}

/* --- the twin --------------------------------------------------------------------------------- */

/* A second prober, and a star with angles where that can be. */
static void twin_attach(surface_twin *t)
{
    mw_prober_options boxes = {.boxes = 1, .guide = 1, .threads = 1};
    mw_star_options angles = {.angles = 1, .threads = 1};
    REQUIRE(mw_prober_create(t->surface, &boxes, &t->second, NULL) == MW_OK);
    REQUIRE(mw_surface_editor_attach_prober(t->editor, t->second, NULL) == MW_OK);
    if (mw_star_create(t->surface, &angles, &t->star, NULL)) return;
    REQUIRE(mw_surface_editor_attach_star(t->editor, t->star, NULL) == MW_OK);
    REQUIRE(mw_star_cursor_init(t->star, NULL, &t->ray, NULL) == MW_OK);
}

surface_twin surface_twin_make(const shape *s, size_t undo)
{
    surface_twin t = {.undo = undo};
    t.surface = shape_surface(s, (mw_surface_options){.shared = 1});
    mw_prober_options boxes = {.boxes = 1, .threads = 1};
    REQUIRE(mw_prober_create(t.surface, &boxes, &t.prober, NULL) == MW_OK);
    mw_surface_editor_options options = {.prober = t.prober, .undo = undo};
    REQUIRE(mw_surface_editor_create(t.surface, &options, &t.editor, NULL) == MW_OK);
    twin_attach(&t);
    mw_probe_options certain = {.certain = 1};
    REQUIRE(mw_probe_cursor_init(t.prober, &certain, &t.certain, NULL) == MW_OK);
    REQUIRE(mw_probe_cursor_init(t.prober, NULL, &t.published, NULL) == MW_OK);
    for (uint32_t v = 0; v < s->point_count; v++) twin_add_point(&t.now, s->points + 3 * (size_t)v);
    for (uint32_t i = 0; i < s->triangle_count; i++)
        twin_add_triangle(&t.now, s->triangles[3 * i], s->triangles[3 * i + 1],
                          s->triangles[3 * i + 2]);
    return t;
}

static void twin_forget(surface_twin *t, size_t first, size_t count)
{
    for (size_t i = first; i < first + count; i++) {
        twin_surface_free(&t->before[i]);
        free(t->record[i]);
    }
}

void surface_twin_free(surface_twin *t)
{
    mw_surface_editor_destroy(t->editor);
    mw_prober_destroy(t->prober);
    mw_prober_destroy(t->second);
    mw_star_destroy(t->star);
    mw_surface_destroy(t->surface);
    twin_forget(t, 0, t->undoable);
    free(t->before);
    free(t->record);
    twin_surface_free(&t->now);
}

/* All that a surface holds, as bytes. */
static void *surface_record(const mw_surface *s, size_t *size)
{
    size_t tri = s->tri_count * sizeof *s->tri, point = s->point_count * 3 * sizeof *s->point;
    uint32_t counts[4] = {s->tri_count, s->point_count, s->freed_triangles, s->freed_points};
    char *bytes = require_room(tri + point + sizeof counts, 1);
    memcpy(bytes, s->tri, tri);
    memcpy(bytes + tri, s->point, point);
    memcpy(bytes + tri + point, counts, sizeof counts);
    *size = tri + point + sizeof counts;
    return bytes;
}

void *surface_twin_record(const surface_twin *t)
{
    size_t size;
    return surface_record(t->surface, &size);
}

void surface_twin_require_record(const surface_twin *t, const void *record)
{
    size_t size;
    void *now = surface_record(t->surface, &size);
    REQUIRE(memcmp(now, record, size) == 0);
    free(now);
}

static void twin_push(surface_twin *t, twin_surface before, void *record)
{
    if (t->undoable == t->undo) {
        if (t->undo == 0) {
            twin_surface_free(&before);
            free(record);
            return;
        }
        twin_forget(t, 0, 1);
        memmove(t->before, t->before + 1, --t->undoable * sizeof *t->before);
        memmove(t->record, t->record + 1, t->undoable * sizeof *t->record);
    }
    t->before = require_more_room(t->before, t->undoable + 1, sizeof *t->before);
    t->record = require_more_room(t->record, t->undoable + 1, sizeof *t->record);
    t->before[t->undoable] = before;
    t->record[t->undoable++] = record;
}

/* --- the report --- */

static void require_report(const twin_surface *was, const twin_surface *is,
                           const mw_surface_change *c)
{
    size_t made = 0, freed = 0, reused = 0, points_made = 0, points_freed = 0;
    uint32_t triangles = was->triangles > is->triangles ? was->triangles : is->triangles,
             points = was->points > is->points ? was->points : is->points;
    const mw_changed_triangle *first = c->triangle, *again = first + c->made,
                              *gone = again + c->reused;
    for (uint32_t t = 0; t < triangles; t++) {
        bool had = twin_has_triangle(was, t), has = twin_has_triangle(is, t);
        if (has && !had) REQUIRE(made < c->made && first[made++].triangle == t);
        if (had && !has) {
            REQUIRE(freed < c->freed && gone[freed].triangle == t);
            REQUIRE(memcmp(gone[freed++].before, was->triangle + 3 * (size_t)t,
                           sizeof gone->before) == 0);
        }
        if (!had || !has ||
            memcmp(was->triangle + 3 * (size_t)t, is->triangle + 3 * (size_t)t,
                   3 * sizeof(uint32_t)) == 0)
            continue;
        REQUIRE(reused < c->reused && again[reused].triangle == t);
        REQUIRE(memcmp(again[reused++].before, was->triangle + 3 * (size_t)t,
                       sizeof again->before) == 0);
    }
    for (uint32_t v = 0; v < points; v++) {
        bool had = twin_has_point(was, v), has = twin_has_point(is, v);
        if (has && !had)
            REQUIRE(points_made < c->vertices_made && c->vertex[points_made++].vertex == v);
        if (had && !has)
            REQUIRE(points_freed < c->vertices_freed &&
                    c->vertex[c->vertices_made + points_freed++].vertex == v);
    }
    REQUIRE(made == c->made && freed == c->freed && reused == c->reused);
    REQUIRE(points_made == c->vertices_made && points_freed == c->vertices_freed);
}

/* --- edits --- */

bool surface_twin_apply(surface_twin *t, const mw_surface_edit *edit)
{
    mw_error error = {0};
    mw_surface_change change;
    twin_surface after = twin_surface_copy(&t->now);
    void *record = surface_twin_record(t);
    uint64_t version = t->surface->version;
    bool right = predict(&after, edit);
    mw_status status = mw_surface_edit_apply(t->editor, edit, &change, &error);
    REQUIRE(status == (right ? MW_OK : MW_ERROR_INPUT));
    if (!right) {
        REQUIRE(error.status == MW_ERROR_INPUT && error.message[0]);
        REQUIRE(t->surface->version == version);
        surface_twin_require_record(t, record);
        twin_surface_free(&after);
        free(record);
        t->refused++;
        return false;
    }
    require_report(&t->now, &after, &change);
    twin_push(t, t->now, record);
    t->now = after;
    t->applied++;
    return true;
}

bool surface_twin_undo(surface_twin *t)
{
    mw_surface_change change;
    mw_status status = mw_surface_edit_undo(t->editor, &change, NULL);
    REQUIRE(status == (t->undoable ? MW_OK : MW_ERROR_INPUT));
    if (status) return false;
    t->undoable--;
    require_report(&t->now, &t->before[t->undoable], &change);
    surface_twin_require_record(t, t->record[t->undoable]);
    free(t->record[t->undoable]);
    twin_surface_free(&t->now);
    t->now = t->before[t->undoable];
    return true;
}

void surface_twin_compacted(surface_twin *t, const uint32_t *triangle, const uint32_t *vertex)
{
    twin_surface now = {0};
    uint32_t points = 0, triangles = 0;
    for (uint32_t v = 0; v < t->now.points; v++) {
        REQUIRE(vertex[v] == (t->now.has_point[v] ? points : MW_NONE));
        if (t->now.has_point[v]) points = twin_add_point(&now, t->now.point + 3 * (size_t)v) + 1;
    }
    for (uint32_t i = 0; i < t->now.triangles; i++) {
        REQUIRE(triangle[i] == (t->now.has_triangle[i] ? triangles : MW_NONE));
        const uint32_t *v = t->now.triangle + 3 * (size_t)i;
        if (t->now.has_triangle[i])
            triangles = twin_add_triangle(&now, vertex[v[0]], vertex[v[1]], vertex[v[2]]) + 1;
    }
    twin_surface_free(&t->now);
    t->now = now;
    twin_forget(t, 0, t->undoable);
    t->undoable = 0;
}

void surface_twin_compact(surface_twin *t)
{
    uint32_t *triangle = require_room(t->now.triangles, sizeof *triangle),
             *vertex = require_room(t->now.points, sizeof *vertex);
    REQUIRE(mw_surface_editor_compact(t->editor, triangle, vertex, NULL) == MW_OK);
    surface_twin_compacted(t, triangle, vertex);
    free(triangle);
    free(vertex);
}

void surface_twin_moved(surface_twin *t, double distance)
{
    mw_prober_update(t->prober, distance, 1);
    mw_prober_update(t->second, distance, 1);
    if (t->star) mw_star_update(t->star, NULL, NULL);
}

/* --- comparison ------------------------------------------------------------------------------- */

/* The same triangles under the same numbers. */
static void check_numbers(const surface_twin *t)
{
    const twin_surface *s = &t->now;
    mw_surface_editor_info info;
    mw_surface_editor_describe(t->editor, &info);
    REQUIRE(info.triangles == twin_living(s) && info.triangle_range == s->triangles);
    REQUIRE(info.vertex_range == s->points && info.undoable == t->undoable);
    REQUIRE(mw_surface_triangle_count(t->surface) == s->triangles);
    for (uint32_t i = 0; i < s->triangles; i++) {
        uint32_t v[3];
        REQUIRE(mw_surface_editor_triangle(t->editor, i, v) == s->has_triangle[i]);
        if (s->has_triangle[i]) REQUIRE(memcmp(v, s->triangle + 3 * (size_t)i, sizeof v) == 0);
    }
    for (uint32_t v = 0; v < s->points; v++) {
        double p[3];
        REQUIRE(mw_surface_editor_vertex(t->editor, v, p) == s->has_point[v]);
        if (s->has_point[v])
            for (uint32_t k = 0; k < 3; k++)
                REQUIRE(fabs(p[k] - s->point[3 * v + k]) <= 1e-12 * fabs(p[k]) + 1e-300);
        if (s->has_point[v]) memcpy(s->point + 3 * (size_t)v, p, sizeof p); /* rounded means */
    }
}

/* The links of a surface made anew. */
static void check_links(const surface_twin *t, const mw_surface *fresh, const uint32_t *number)
{
    for (uint32_t i = 0; i < mw_surface_triangle_count(fresh); i++)
        for (unsigned k = 0; k < 3; k++) {
            unsigned e = 0, f = 0;
            uint32_t should = mw_surface_neighbour(fresh, i, k, &e),
                     is = mw_surface_neighbour(t->surface, number[i], k, &f);
            REQUIRE(is == (should == MW_NONE ? MW_NONE : number[should]) && e == f);
        }
}

static void check_description(const surface_twin *t, const mw_surface *fresh)
{
    mw_surface_info should, is;
    mw_surface_editor_info info;
    mw_surface_editor_describe(t->editor, &info);
    REQUIRE(mw_surface_describe(fresh, &should, NULL) == MW_OK);
    REQUIRE(mw_surface_describe(t->surface, &is, NULL) == MW_OK);
    REQUIRE(is.vertices == should.vertices && is.triangles == should.triangles);
    REQUIRE(is.vertices == info.vertices && is.border_edges == info.border_edges);
    REQUIRE(is.unused_vertices == should.unused_vertices && is.euler == should.euler);
    REQUIRE(is.flat_triangles == should.flat_triangles);
    REQUIRE(is.border_edges == should.border_edges && is.border_loops == should.border_loops);
    REQUIRE(is.clashing_edges == should.clashing_edges && is.components == should.components);
    REQUIRE(is.pinched_vertices == should.pinched_vertices && is.closed == should.closed);
    for (int k = 0; k < 3; k++) REQUIRE(is.low[k] == should.low[k] && is.high[k] == should.high[k]);
}

static void check_rounds(const surface_twin *t, uint64_t *random)
{
    enum { MOST = 64 };
    const twin_surface *s = &t->now;
    uint32_t at[MOST], should[2], is[2];
    uint32_t a = mw__random_below(random, s->points + 1), b = mw__random_below(random, s->points);
    size_t n = mw_surface_editor_triangles_of(t->editor, a, at, MOST), found = 0;
    for (uint32_t i = 0; i < s->triangles && twin_has_point(s, a); i++)
        if (s->has_triangle[i] && twin_corner(s, i, a) < 3) {
            REQUIRE(found >= MOST || at[found] == i);
            found++;
        }
    REQUIRE(found == n);
    uint32_t edges = twin_has_point(s, a) && twin_has_point(s, b) ? twin_edge(s, a, b, should) : 0;
    REQUIRE(mw_surface_editor_edge(t->editor, a, b, is) == edges);
    if (edges) REQUIRE(is[0] == should[0] && is[1] == should[1]);
}

/* Each box holds what is below it, tightly; each living triangle is there once. Returns the number
 * of triangles below a node. */
static uint32_t check_boxes_below(const mw_bvh *b, const mw_surface *s, uint32_t i, uint32_t level)
{
    const mw_bvh_node *node = &b->node[i];
    uint32_t triangles = 0, children = 0;
    REQUIRE(level < MW_BVH_LEVELS && i < b->node_count);
    for (uint32_t k = 0; k < MW_BVH_WIDTH; k++) {
        uint32_t child = node->child[k];
        mw_bvh_box box;
        if (child == MW_NONE) {
            REQUIRE(node->low[0][k] > node->high[0][k]);
            continue;
        }
        children++;
        if (child & MW_BVH_TRIANGLE) {
            child &= ~MW_BVH_TRIANGLE;
            REQUIRE(child < s->tri_count && !mw__surface_is_freed(s, child));
            REQUIRE(memcmp(node->vertex[k], s->tri[child].v, sizeof node->vertex[k]) == 0);
            REQUIRE(b->place[child] == i * MW_BVH_WIDTH + k);
            box = mw__bvh_box_of(b, s, child);
            triangles++;
        } else {
            REQUIRE(b->parent[child] == i * MW_BVH_WIDTH + k);
            triangles += check_boxes_below(b, s, child, level + 1);
            box = mw__bvh_box_of_node(&b->node[child]);
        }
        for (int x = 0; x < 3; x++)
            REQUIRE(node->low[x][k] == box.low[x] && node->high[x][k] == box.high[x]);
    }
    REQUIRE(i == 0 || children > 1);
    return triangles;
}

static void check_probes(surface_twin *t, const shape *s, const uint32_t *number, size_t lines,
                         uint64_t *random)
{
    double *query = shape_queries(s, lines, random);
    for (size_t i = 0; i < lines; i++) {
        const double *q = query + 6 * i;
        touch_oracle o = touch_oracle_make(s, q);
        uint32_t best = touch_oracle_best(&o, 0);
        mw_touch touch = mw_probe(t->prober, &t->certain, q, q + 3);
        REQUIRE(touch.state == (best == MW_NONE ? MW_TOUCH_NONE : MW_TOUCH_HIT));
        REQUIRE(touch.triangle == (best == MW_NONE ? MW_NONE : number[best]));
        mw_probe_cursor fresh;
        REQUIRE(mw_probe_cursor_init(t->second, &(mw_probe_options){.certain = 1}, &fresh, NULL) ==
                MW_OK);
        mw_touch second = mw_probe(t->second, &fresh, q, q + 3);
        REQUIRE(memcmp(&second, &touch, sizeof touch) == 0);
        touch = mw_probe(t->prober, &t->published, q, q + 3);
        REQUIRE(touch.state == MW_TOUCH_HIT || touch.state == MW_TOUCH_LIMIT);
        if (touch.state == MW_TOUCH_HIT) {
            uint32_t n = 0;
            while (number[n] != touch.triangle) REQUIRE(++n < s->triangle_count);
            REQUIRE(o.touched[n]);
        }
        touch_oracle_free(&o);
    }
    free(query);
}

static void check_nearest(surface_twin *t, const mw_surface *fresh, const shape *s,
                          const uint32_t *number, uint64_t *random)
{
    mw_prober *prober;
    mw_prober_options boxes = {.boxes = 1, .threads = 1};
    REQUIRE(mw_prober_create(fresh, &boxes, &prober, NULL) == MW_OK);
    const double *p = s->points + 3 * (size_t)mw__random_below(random, s->point_count);
    double q[3] = {p[0] + (double)mw__random_below(random, 5) - 2, p[1] + 0.5, p[2]};
    mw_nearest_surface_point should, is;
    REQUIRE(mw_nearest_on_surface(prober, q, INFINITY, &should, NULL) == MW_OK);
    REQUIRE(mw_nearest_on_surface(t->prober, q, INFINITY, &is, NULL) == MW_OK);
    REQUIRE(is.triangle == (should.triangle == MW_NONE ? MW_NONE : number[should.triangle]));
    REQUIRE(is.triangle == MW_NONE || is.distance == should.distance);
    uint8_t side[2] = {9, 9};
    mw_status status = mw_inside_surface(prober, q, 1, 3, 1, &side[0], NULL);
    REQUIRE(mw_inside_surface(t->prober, q, 1, 3, 1, &side[1], NULL) == status);
    REQUIRE(side[0] == side[1]);
    mw_prober_destroy(prober);
}

void surface_twin_check(surface_twin *t, size_t lines, uint64_t *random)
{
    uint32_t *number;
    check_numbers(t);
    shape s = twin_shape(&t->now, &number);
    mw_surface *fresh = shape_surface(&s, (mw_surface_options){0});
    check_links(t, fresh, number);
    check_description(t, fresh);
    check_rounds(t, random);
    REQUIRE(check_boxes_below(&t->prober->bvh, t->surface, 0, 0) == s.triangle_count);
    REQUIRE(check_boxes_below(&t->second->bvh, t->surface, 0, 0) == s.triangle_count);
    if (t->star) star_twin_check(t->star, &t->ray, (int)lines, &t->stars, random);
    check_probes(t, &s, number, lines, random);
    if (lines) check_nearest(t, fresh, &s, number, random);
    mw_surface_destroy(fresh);
    shape_free(&s);
    free(number);
}

void surface_twin_check_probes(surface_twin *t, size_t lines, uint64_t *random)
{
    uint32_t *number;
    shape s = twin_shape(&t->now, &number);
    check_probes(t, &s, number, lines, random);
    shape_free(&s);
    free(number);
}

/* --- random edits ----------------------------------------------------------------------------- */

static uint32_t any_triangle(const twin_surface *s, uint64_t *random)
{
    for (int i = 0; i < 50; i++) {
        uint32_t t = mw__random_below(random, s->triangles + (i == 0));
        if (twin_has_triangle(s, t) || mw__random_below(random, 50) == 0) return t;
    }
    return 0;
}

/* A walk along edges; along the border, if `border`, and as long as there is one. */
static size_t random_path(const twin_surface *s, uint32_t *path, size_t room, bool border,
                          uint64_t *random)
{
    size_t n = 0, wanted = 2 + mw__random_below(random, (uint32_t)room - 1);
    uint32_t t = any_triangle(s, random), at[2];
    for (int looks = 0; border && looks < 50; looks++, t = any_triangle(s, random)) {
        uint32_t k = mw__random_below(random, 3);
        if (!twin_has_triangle(s, t)) continue;
        if (twin_edge(s, s->triangle[3 * t + k], s->triangle[3 * t + (k + 1) % 3], at) == 1) {
            path[n++] = s->triangle[3 * t + k];
            break;
        }
    }
    if (n == 0) path[n++] = twin_has_triangle(s, t) ? s->triangle[3 * t] : 0;
    while (n < wanted) {
        uint32_t next = MW_NONE, seen = 0;
        for (uint32_t u = 0; u < s->triangles; u++)
            for (uint32_t k = 0; k < 3 && s->has_triangle[u]; k++) {
                uint32_t w = s->triangle[3 * u + k], corner = twin_corner(s, u, path[n - 1]);
                if (corner == 3 || w == path[n - 1] || (n > 1 && w == path[n - 2])) continue;
                if (border && twin_edge(s, w, path[n - 1], at) != 1) continue;
                if (mw__random_below(random, ++seen) == 0) next = w;
            }
        if (next == MW_NONE) break;
        path[n++] = next;
    }
    while (n < 2) path[n++] = mw__random_below(random, s->points);
    return n;
}

/* The other side of a border from the end of the path on, or another border: chains that close a
 * cut or a hole, and others that must be refused. */
static void random_other(const twin_surface *s, uint32_t *path, size_t count, uint64_t *random)
{
    uint32_t *other = path + count;
    size_t n = 0;
    if (mw__random_below(random, 2)) { /* points at the same places: the other side of a cut */
        for (size_t i = 0; i < count; i++) {
            other[i] = path[i];
            for (uint32_t v = 0; v < s->points; v++)
                if (s->has_point[v] && v != path[i] &&
                    memcmp(s->point + 3 * (size_t)v, s->point + 3 * (size_t)path[i],
                           3 * sizeof(double)) == 0)
                    other[i] = v;
        }
        return;
    }
    n = random_path(s, other, count, true, random);
    for (; n < count; n++) other[n] = other[n - 1];
}

mw_surface_edit surface_twin_edit(const surface_twin *t, uint32_t *path, size_t room,
                                  uint64_t *random)
{
    const twin_surface *s = &t->now;
    mw_surface_edit e = {
        .kind = (mw_surface_edit_kind)mw__random_below(random, MW_SURFACE_EDIT_KIND_COUNT)};
    if (twin_living(s) > 200 && mw__random_below(random, 2)) e.kind = MW_SURFACE_COLLAPSE;
    if (twin_living(s) < 8 && e.kind >= MW_SURFACE_ADD_TRIANGLE) e.kind = MW_SURFACE_SPLIT_EDGE;
    e.triangle = mw__random_below(random, 10) ? any_triangle(s, random)
                                              : mw__random_below(random, s->triangles + 2);
    uint32_t k = mw__random_below(random, 3), u = twin_has_triangle(s, e.triangle) ? e.triangle : 0;
    for (uint32_t i = 0; i < 3; i++)
        e.vertex[i] = mw__random_below(random, 20) ? s->triangle[3 * u + (k + i) % 3]
                                                   : mw__random_below(random, s->points + 9);
    if (e.kind == MW_SURFACE_ADD_TRIANGLE) { /* fill a corner, or the hole of a triangle */
        mw__swap(&e.vertex[0], &e.vertex[1]);
        if (mw__random_below(random, 3)) e.vertex[2] = mw__random_below(random, s->points);
    }
    for (int i = 0; i < 3; i++) e.point[i] = (double)mw__random_below(random, 64) - 32;
    if (e.kind == MW_SURFACE_MOVE_VERTEX && twin_has_point(s, e.vertex[0]))
        for (uint32_t i = 0; i < 3; i++)
            e.point[i] = s->point[3 * e.vertex[0] + i] + (double)(i == 0);
    if (mw__random_below(random, 4)) {
        bool optional = e.kind == MW_SURFACE_SPLIT_EDGE || e.kind == MW_SURFACE_SPLIT_TRIANGLE ||
                        e.kind == MW_SURFACE_COLLAPSE;
        if (optional) e.point[0] = NAN;
    }
    e.path = path;
    if (e.kind == MW_SURFACE_CUT)
        e.path_count = random_path(s, path, room, mw__random_below(random, 8) == 0, random);
    if (e.kind == MW_SURFACE_SEW) {
        e.path_count = random_path(s, path, room, true, random);
        random_other(s, path, e.path_count, random);
        e.other = path + e.path_count;
    }
    return e;
}
