/* surface_sew.c - sews two chains of border edges: vertices merge, and border edges that get the
 * same ends thereby are linked.
 *
 * All edges that have a merged vertex as an end afterwards are sorted by their ends. So an edge of
 * three triangles shows, and so do two border edges that become one. */
#include "surface/edit/surface_changes.h"
#include "surface/edit/surface_corners.h"
#include "surface/edit/surface_journal.h"
#include "surface/edit/surface_operations.h"

#include <inttypes.h>
#include <stdlib.h>

/* `from` merges into `to`; or stays, if they are equal. */
typedef struct seam_vertex {
    uint32_t from, to;
} seam_vertex;

/* A half-edge by its ends after the merger. */
typedef struct seam_edge {
    uint32_t low, high, half;
} seam_edge;

typedef struct surface_seam {
    mw_surface_editor *e;
    seam_vertex *vertex; /* sorted by `from`, without repetition */
    size_t vertex_count;
    uint32_t *target; /* those that something merges into, sorted */
    size_t target_count;
    seam_edge *edge;
    size_t edge_count, degrees;
} surface_seam;

static int compare_seam_vertices(const void *a, const void *b)
{
    const seam_vertex *s = a, *t = b;
    if (s->from != t->from) return s->from < t->from ? -1 : 1;
    return (s->to > t->to) - (s->to < t->to);
}

static int compare_targets(const void *a, const void *b)
{
    uint32_t x = *(const uint32_t *)a, y = *(const uint32_t *)b;
    return (x > y) - (x < y);
}

static int compare_seam_edges(const void *a, const void *b)
{
    const seam_edge *s = a, *t = b;
    if (s->low != t->low) return s->low < t->low ? -1 : 1;
    if (s->high != t->high) return s->high < t->high ? -1 : 1;
    return (s->half > t->half) - (s->half < t->half);
}

static void surface_seam_release(surface_seam *s)
{
    free(s->vertex);
    free(s->target);
    free(s->edge);
}

/* --- the chains --- */

static mw_status seam_check_edge(const mw_surface_editor *e, uint32_t a, uint32_t b, uint32_t *half,
                                 mw_error *error)
{
    unsigned n;
    uint32_t both[2];
    mw_status status = mw__surface_check_edge(e, a, b, both, &n, error);
    if (status) return status;
    *half = both[0];
    if (n == 1) return MW_OK;
    return mw__fail_at(error, mw__link_triangle(both[0]), a,
                       "the edge from %" PRIu32 " to %" PRIu32 " is no border", a, b);
}

static mw_status seam_check_chains(const mw_surface_editor *e, const mw_surface_edit *edit,
                                   mw_error *error)
{
    for (size_t i = 0; i + 1 < edit->path_count; i++) {
        uint32_t a = 0, b = 0;
        mw_status status = seam_check_edge(e, edit->path[i], edit->path[i + 1], &a, error);
        if (!status) status = seam_check_edge(e, edit->other[i], edit->other[i + 1], &b, error);
        if (status) return status;
        if (a == b)
            return mw__fail_at(error, mw__link_triangle(a), edit->path[i],
                               "the edge from %" PRIu32 " to %" PRIu32 " cannot be sewn to itself",
                               edit->path[i], edit->path[i + 1]);
    }
    return MW_OK;
}

/* The vertex that one becomes. */
static uint32_t seam_after(const surface_seam *s, uint32_t vertex)
{
    size_t low = 0, high = s->vertex_count;
    while (low < high) {
        size_t middle = low + (high - low) / 2;
        if (s->vertex[middle].from < vertex)
            low = middle + 1;
        else
            high = middle;
    }
    return low < s->vertex_count && s->vertex[low].from == vertex ? s->vertex[low].to : vertex;
}

static bool seam_is_target(const surface_seam *s, uint32_t vertex)
{
    return bsearch(&vertex, s->target, s->target_count, sizeof vertex, compare_targets) != NULL;
}

/* Which vertex becomes which? None may merge into two others, nor into one that merges itself. */
static mw_status seam_map_vertices(surface_seam *s, const mw_surface_edit *edit, mw_error *error)
{
    size_t n = edit->path_count, kept = 0;
    for (size_t i = 0; i < n; i++) {
        s->vertex[i] = (seam_vertex){edit->other[i], edit->path[i]};
        s->vertex[n + i] = (seam_vertex){edit->path[i], edit->path[i]};
    }
    qsort(s->vertex, 2 * n, sizeof *s->vertex, compare_seam_vertices);
    for (size_t i = 0; i < 2 * n; i++) {
        seam_vertex v = s->vertex[i];
        if (kept == 0 || s->vertex[kept - 1].from != v.from) {
            s->vertex[kept++] = v;
        } else if (s->vertex[kept - 1].to != v.to) {
            return mw__fail_at(error, -1, v.from,
                               "vertex %" PRIu32 " would merge into two vertices, %" PRIu32
                               " and %" PRIu32,
                               v.from, s->vertex[kept - 1].to, v.to);
        }
    }
    s->vertex_count = kept;
    for (size_t i = 0; i < kept; i++)
        if (s->vertex[i].from != s->vertex[i].to) s->target[s->target_count++] = s->vertex[i].to;
    qsort(s->target, s->target_count, sizeof *s->target, compare_targets);
    return MW_OK;
}

/* --- the edges afterwards --- */

static mw_status seam_list_triangle(surface_seam *s, uint32_t t, mw_error *error)
{
    uint32_t v[3];
    for (int k = 0; k < 3; k++) v[k] = seam_after(s, s->e->surface->tri[t].v[k]);
    for (uint32_t k = 0; k < 3; k++) {
        uint32_t a = v[k], b = v[mw__next(k)];
        if (a == b)
            return mw__fail_at(error, t, a,
                               "triangle %" PRIu32 " would have vertex %" PRIu32 " twice", t, a);
        if (!seam_is_target(s, a) && !seam_is_target(s, b)) continue;
        s->edge[s->edge_count++] = (seam_edge){a < b ? a : b, a < b ? b : a, mw__link(t, k)};
    }
    return MW_OK;
}

static bool seam_touches(const surface_seam *s, const seam_vertex *v)
{
    return v->from != v->to || seam_is_target(s, v->from);
}

static mw_status seam_list_edges(surface_seam *s, mw_error *error)
{
    const mw_surface_editor *e = s->e;
    for (size_t i = 0; i < s->vertex_count; i++)
        if (seam_touches(s, &s->vertex[i])) s->degrees += mw__surface_degree(e, s->vertex[i].from);
    s->edge = mw__alloc(s->degrees, 3 * sizeof *s->edge);
    if (!s->edge) return mw__fail_memory(error);
    for (size_t i = 0; i < s->vertex_count; i++) {
        if (!seam_touches(s, &s->vertex[i])) continue;
        uint32_t c = e->at[s->vertex[i].from].first;
        for (; mw__is_corner(c); c = e->corner[c].next) {
            mw_status status = seam_list_triangle(s, c / 3, error);
            if (status) return status;
        }
    }
    if (s->edge_count) qsort(s->edge, s->edge_count, sizeof *s->edge, compare_seam_edges);
    size_t kept = 0;
    for (size_t i = 0; i < s->edge_count; i++)
        if (kept == 0 || s->edge[kept - 1].half != s->edge[i].half) s->edge[kept++] = s->edge[i];
    s->edge_count = kept;
    return MW_OK;
}

/* The half-edges from number i on with the same ends. */
static size_t seam_equal_edges(const surface_seam *s, size_t i)
{
    size_t n = 1;
    while (i + n < s->edge_count && s->edge[i + n].low == s->edge[i].low &&
           s->edge[i + n].high == s->edge[i].high)
        n++;
    return n;
}

/* Two half-edges with the same ends are linked, or both are borders: what one of them was linked to
 * would be a third. */
static mw_status seam_check_edges(const surface_seam *s, mw_error *error)
{
    const mw_triangle *tri = s->e->surface->tri;
    for (size_t i = 0, n; i < s->edge_count; i += n) {
        const seam_edge *edge = &s->edge[i];
        n = seam_equal_edges(s, i);
        uint32_t t = mw__link_triangle(edge->half);
        if (n > 2) return mw__surface_refuse_third(t, edge->low, edge->high, error);
        if (n == 1 || mw__half_link(tri, edge[0].half) != MW_NONE) continue;
        if (seam_after(s, mw__half_start(tri, edge[0].half)) ==
            seam_after(s, mw__half_start(tri, edge[1].half)))
            return mw__surface_refuse_clash(t, edge->low, edge->high, error);
    }
    return MW_OK;
}

/* --- the edit --- */

static void surface_seam_carry_out(surface_seam *s)
{
    mw_surface_editor *e = s->e;
    for (size_t i = 0, n; i < s->edge_count; i += n) {
        const seam_edge *edge = &s->edge[i];
        n = seam_equal_edges(s, i);
        if (n == 2 && mw__half_link(e->surface->tri, edge[0].half) == MW_NONE)
            mw__surface_join(e, edge[0].half, edge[1].half);
    }
    for (size_t i = 0; i < s->vertex_count; i++) {
        seam_vertex v = s->vertex[i];
        if (v.from == v.to) continue;
        while (mw__is_corner(e->at[v.from].first)) {
            uint32_t c = e->at[v.from].first;
            mw__surface_set_corner(e, c / 3, c % 3, v.to);
        }
        mw__surface_free_vertex(e, v.from, v.to);
    }
}

static mw_status surface_seam_run(surface_seam *s, const mw_surface_edit *edit, mw_error *error)
{
    mw_status status = seam_check_chains(s->e, edit, error);
    if (status) return status;
    s->vertex = mw__alloc(edit->path_count, 2 * sizeof *s->vertex);
    s->target = mw__alloc(edit->path_count, sizeof *s->target);
    if (!s->vertex || !s->target) return mw__fail_memory(error);
    status = seam_map_vertices(s, edit, error);
    if (!status) status = seam_list_edges(s, error);
    if (!status) status = seam_check_edges(s, error);
    if (!status)
        status = mw__surface_edit_begin(
            s->e, &(mw_surface_needs){.triangles = s->degrees, .vertex_entries = edit->path_count},
            error);
    if (!status) surface_seam_carry_out(s);
    return status;
}

mw_status mw__surface_sew(mw_surface_editor *e, const mw_surface_edit *edit, mw_error *error)
{
    if (!edit->path || !edit->other || edit->path_count < 2)
        return mw__fail(error, MW_ERROR_ARGUMENT,
                        "each side of a seam needs at least two vertices");
    surface_seam seam = {.e = e};
    mw_status status = surface_seam_run(&seam, edit, error);
    surface_seam_release(&seam);
    return status;
}
