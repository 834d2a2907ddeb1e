/* surface_cut.c - cuts a surface along a path of edges.
 *
 * Where edges are cut, the triangles round a vertex of the path fall into fans: groups that hang
 * together by edges at the vertex that are not cut. Of the fans with a cut edge the one with the
 * lowest triangle keeps the vertex; each other one gets a copy. A cut edge is open if its two sides
 * then differ in a vertex. */
#include "surface/edit/surface_changes.h"
#include "surface/edit/surface_corners.h"
#include "surface/edit/surface_journal.h"
#include "surface/edit/surface_operations.h"

#include <inttypes.h>
#include <stdlib.h>

/* A corner that gets another vertex: copy number `copy` of those that the cut makes. */
typedef struct cut_corner {
    uint32_t corner, copy;
} cut_corner;

typedef struct surface_cut {
    mw_surface_editor *e;
    uint32_t *half; /* both half-edges of each edge of the path, sorted */
    size_t half_count;
    uint32_t *round; /* the corners at a vertex, sorted: room for those of the busiest one */
    uint8_t *grouped;
    cut_corner *corner; /* sorted at the end */
    size_t corner_count;
    uint32_t *copied; /* the vertex of each copy */
    size_t copy_count;
    uint32_t *fan;  /* corners of the fan that is searched */
    size_t degrees; /* sum over the path: at least as many triangles are at it */
} surface_cut;

static int compare_cut_numbers(const void *a, const void *b)
{
    uint32_t x = *(const uint32_t *)a, y = *(const uint32_t *)b;
    return (x > y) - (x < y);
}

static int compare_cut_corners(const void *a, const void *b)
{
    return compare_cut_numbers(&((const cut_corner *)a)->corner, &((const cut_corner *)b)->corner);
}

static bool half_edge_is_cut(const surface_cut *c, uint32_t half)
{
    return bsearch(&half, c->half, c->half_count, sizeof half, compare_cut_numbers) != NULL;
}

static void surface_cut_release(surface_cut *c)
{
    free(c->half);
    free(c->round);
    free(c->grouped);
    free(c->corner);
    free(c->copied);
    free(c->fan);
}

/* --- the path --- */

static mw_status cut_find_edges(surface_cut *c, const uint32_t *path, size_t count, mw_error *error)
{
    for (size_t i = 0; i + 1 < count; i++) {
        unsigned n;
        uint32_t *half = c->half + c->half_count;
        mw_status status = mw__surface_check_edge(c->e, path[i], path[i + 1], half, &n, error);
        if (status) return status;
        if (n == 1)
            return mw__fail_at(error, mw__link_triangle(half[0]), path[i],
                               "the edge from %" PRIu32 " to %" PRIu32 " is a border already",
                               path[i], path[i + 1]);
        c->half_count += 2;
    }
    qsort(c->half, c->half_count, sizeof *c->half, compare_cut_numbers);
    for (size_t i = 1; i < c->half_count; i++) {
        if (c->half[i] != c->half[i - 1]) continue;
        const mw_triangle *tri = c->e->surface->tri;
        uint32_t a = mw__half_start(tri, c->half[i]), b = mw__half_end(tri, c->half[i]);
        return mw__fail_at(error, mw__link_triangle(c->half[i]), a,
                           "the path has the edge from %" PRIu32 " to %" PRIu32 " twice", a, b);
    }
    return MW_OK;
}

/* --- fans --- */

/* The corners at a vertex, sorted. Returns how many. */
static size_t cut_list_corners(surface_cut *c, uint32_t vertex)
{
    const mw_surface_editor *e = c->e;
    size_t n = 0;
    for (uint32_t at = e->at[vertex].first; mw__is_corner(at); at = e->corner[at].next)
        c->round[n++] = at;
    qsort(c->round, n, sizeof *c->round, compare_cut_numbers);
    for (size_t i = 0; i < n; i++) c->grouped[i] = 0;
    return n;
}

/* The corner at the vertex in the triangle of a half-edge there. */
static uint32_t corner_of_half(const mw_triangle *tri, uint32_t half, uint32_t vertex)
{
    uint32_t t = mw__link_triangle(half), k = mw__link_edge(half);
    return mw__corner_number(t, tri[t].v[k] == vertex ? k : mw__next(k));
}

/* Search the fan of corner number `first`. Returns its size; *cut becomes whether an edge of it at
 * the vertex is cut. */
static size_t cut_search_fan(surface_cut *c, uint32_t vertex, size_t corners, size_t first,
                             bool *cut)
{
    const mw_triangle *tri = c->e->surface->tri;
    size_t n = 0;
    *cut = false;
    c->grouped[first] = 1;
    c->fan[n++] = c->round[first];
    for (size_t i = 0; i < n; i++) {
        uint32_t t = c->fan[i] / 3, k = c->fan[i] % 3;
        uint32_t side[2] = {mw__link(t, k), mw__link(t, mw__prev(k))};
        for (int j = 0; j < 2; j++) {
            uint32_t link = mw__half_link(tri, side[j]);
            if (link == MW_NONE) continue;
            if (half_edge_is_cut(c, side[j])) {
                *cut = true;
                continue;
            }
            uint32_t next = corner_of_half(tri, link, vertex);
            const uint32_t *at =
                bsearch(&next, c->round, corners, sizeof next, compare_cut_numbers);
            if (c->grouped[at - c->round]) continue;
            c->grouped[at - c->round] = 1;
            c->fan[n++] = next;
        }
    }
    return n;
}

/* Give copies to the fans at a vertex that do not keep it. */
static void cut_divide_vertex(surface_cut *c, uint32_t vertex)
{
    size_t corners = cut_list_corners(c, vertex);
    bool kept = false;
    for (size_t first = 0; first < corners; first++) { /* the lowest triangle first */
        bool cut;
        if (c->grouped[first]) continue;
        size_t n = cut_search_fan(c, vertex, corners, first, &cut);
        if (!cut) continue;
        if (kept) {
            for (size_t i = 0; i < n; i++)
                c->corner[c->corner_count++] = (cut_corner){c->fan[i], (uint32_t)c->copy_count};
            c->copied[c->copy_count++] = vertex;
        }
        kept = true;
    }
}

/* --- the check --- */

/* The vertex at a corner after the cut: a copy counts from the number of vertices on. */
static uint32_t corner_vertex_after(const surface_cut *c, uint32_t corner)
{
    const mw_surface *surface = c->e->surface;
    const cut_corner *changed =
        bsearch(&corner, c->corner, c->corner_count, sizeof *c->corner, compare_cut_corners);
    return changed ? surface->point_count + changed->copy : surface->tri[corner / 3].v[corner % 3];
}

static bool ends_differ(const surface_cut *c, uint32_t half, uint32_t vertex)
{
    const mw_triangle *tri = c->e->surface->tri;
    uint32_t link = mw__half_link(tri, half);
    return corner_vertex_after(c, corner_of_half(tri, half, vertex)) !=
           corner_vertex_after(c, corner_of_half(tri, link, vertex));
}

static mw_status cut_check_open(surface_cut *c, mw_error *error)
{
    const mw_triangle *tri = c->e->surface->tri;
    if (c->corner_count) qsort(c->corner, c->corner_count, sizeof *c->corner, compare_cut_corners);
    for (size_t i = 0; i < c->half_count; i++) {
        uint32_t half = c->half[i], a = mw__half_start(tri, half), b = mw__half_end(tri, half);
        if (!ends_differ(c, half, a) && !ends_differ(c, half, b))
            return mw__fail_at(error, mw__link_triangle(half), a,
                               "the cut does not open the edge from %" PRIu32 " to %" PRIu32
                               ": a cut inside the surface needs at least two edges",
                               a, b);
    }
    return MW_OK;
}

/* --- the edit --- */

static bool surface_cut_reserve(surface_cut *c, const mw_surface_edit *edit)
{
    uint32_t busiest = 0;
    mw__surface_search_begin(c->e);
    for (size_t i = 0; i < edit->path_count; i++) {
        if (mw__surface_seen(c->e, edit->path[i])) continue;
        mw__surface_see(c->e, edit->path[i]);
        uint32_t degree = mw__surface_degree(c->e, edit->path[i]);
        c->degrees += degree;
        if (degree > busiest) busiest = degree;
    }
    c->round = mw__alloc(busiest, sizeof *c->round);
    c->grouped = mw__alloc(busiest, sizeof *c->grouped);
    c->fan = mw__alloc(busiest, sizeof *c->fan);
    c->corner = mw__alloc(c->degrees, sizeof *c->corner);
    c->copied = mw__alloc(c->degrees, sizeof *c->copied);
    return c->round && c->grouped && c->fan && c->corner && c->copied;
}

static void surface_cut_plan(surface_cut *c, const mw_surface_edit *edit)
{
    mw__surface_search_begin(c->e);
    for (size_t i = 0; i < edit->path_count; i++) {
        if (mw__surface_seen(c->e, edit->path[i])) continue;
        mw__surface_see(c->e, edit->path[i]);
        cut_divide_vertex(c, edit->path[i]);
    }
}

static void surface_cut_carry_out(surface_cut *c)
{
    mw_surface_editor *e = c->e;
    uint32_t first = e->surface->point_count;
    for (size_t i = 0; i < c->copy_count; i++)
        mw__surface_make_vertex(e, mw__surface_point(e->surface, c->copied[i]), c->copied[i]);
    for (size_t i = 0; i < c->half_count; i++) mw__surface_join(e, c->half[i], MW_NONE);
    for (size_t i = 0; i < c->corner_count; i++)
        mw__surface_set_corner(e, c->corner[i].corner / 3, c->corner[i].corner % 3,
                               first + c->corner[i].copy);
}

static mw_status surface_cut_run(surface_cut *c, const mw_surface_edit *edit, mw_error *error)
{
    c->half = mw__alloc(edit->path_count, 2 * sizeof *c->half);
    if (!c->half) return mw__fail_memory(error);
    mw_status status = cut_find_edges(c, edit->path, edit->path_count, error);
    if (status) return status;
    if (!surface_cut_reserve(c, edit)) return mw__fail_memory(error);
    surface_cut_plan(c, edit);
    status = cut_check_open(c, error);
    if (!status)
        status = mw__surface_edit_begin(c->e,
                                        &(mw_surface_needs){.vertices = c->copy_count,
                                                            .triangles = c->degrees,
                                                            .vertex_entries = c->copy_count},
                                        error);
    if (!status) surface_cut_carry_out(c);
    return status;
}

mw_status mw__surface_cut(mw_surface_editor *e, const mw_surface_edit *edit, mw_error *error)
{
    if (!edit->path || edit->path_count < 2)
        return mw__fail(error, MW_ERROR_ARGUMENT, "a cut needs at least two vertices");
    surface_cut cut = {.e = e};
    mw_status status = surface_cut_run(&cut, edit, error);
    surface_cut_release(&cut);
    return status;
}
