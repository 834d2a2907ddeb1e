/* surface_collapse.c - collapses an edge, if its link condition holds
 * [Dey, Edelsbrunner, Guha, Nekhayev 1999].
 *
 * The link of a vertex: the edges opposite to it, and their ends. The link of edge ab: the corners
 * opposite to it. The surface keeps its topology if and only if the intersection of the links of a
 * and b is the link of ab. A border counts as filled by triangles up to an imaginary vertex, which
 * is thus in the link of each vertex and edge of the border; a second imaginary vertex does the
 * same for pinched vertices. */
#include "surface/edit/surface_changes.h"
#include "surface/edit/surface_corners.h"
#include "surface/edit/surface_journal.h"
#include "surface/edit/surface_operations.h"
#include "topology/fan.h"
#include "topology/fan.h"

#include <inttypes.h>

typedef struct collapse_plan {
    uint32_t a, b; /* a merges into b */
    uint32_t half[2];
    unsigned triangles; /* at the edge */
    uint32_t apex[2];   /* MW_NONE: no second triangle */
    uint32_t degree;    /* of a */
} collapse_plan;

/* What a search round a vertex tells. */
typedef struct vertex_round {
    uint32_t triangles;
    bool border;   /* it lies on a border */
    bool opposite; /* an edge opposite to it joins both apices */
} vertex_round;

static vertex_round vertex_look_round(const mw_surface_editor *e, const collapse_plan *p,
                                      uint32_t v)
{
    vertex_round round = {0, false, false};
    for (uint32_t c = e->at[v].first; mw__is_corner(c); c = e->corner[c].next) {
        const mw_triangle *t = &e->surface->tri[c / 3];
        uint32_t k = c % 3, q = t->v[mw__next(k)], r = t->v[mw__prev(k)];
        round.triangles++;
        round.border = round.border || t->link[k] == MW_NONE || t->link[mw__prev(k)] == MW_NONE;
        round.opposite = round.opposite || (q == p->apex[0] && r == p->apex[1]) ||
                         (q == p->apex[1] && r == p->apex[0]);
    }
    return round;
}

/* How many triangles are in the fan, round a vertex, of a half-edge there? */
static uint32_t fan_size(const mw_surface_editor *e, uint32_t half, bool start)
{
    const mw_triangle *tri = e->surface->tri;
    const mw_edge_end first = {half, start};
    uint32_t n = 1;
    for (mw_edge_end i = first; mw__link_of(tri, i) != MW_NONE; n++) {
        i = mw__other_edge(mw__across(tri, NULL, i));
        if (i.half == first.half) return n; /* round */
    }
    for (mw_edge_end i = mw__other_edge(first); mw__link_of(tri, i) != MW_NONE; n++)
        i = mw__other_edge(mw__across(tri, NULL, i));
    return n;
}

/* Does each end have triangles outside the fan of the edge? */
static bool ends_are_pinched(const mw_surface_editor *e, const collapse_plan *p, uint32_t a_degree,
                             uint32_t b_degree)
{
    uint32_t half = p->half[0];
    bool a_first = mw__half_start(e->surface->tri, half) == p->a;
    return fan_size(e, half, a_first) != a_degree && fan_size(e, half, !a_first) != b_degree;
}

/* A common neighbour of a and b that is no apex; MW_NONE: there is none. */
static uint32_t common_neighbour(mw_surface_editor *e, const collapse_plan *p)
{
    const mw_triangle *tri = e->surface->tri;
    mw__surface_search_begin(e);
    for (uint32_t c = e->at[p->a].first; mw__is_corner(c); c = e->corner[c].next) {
        mw__surface_see(e, tri[c / 3].v[mw__next(c % 3)]);
        mw__surface_see(e, tri[c / 3].v[mw__prev(c % 3)]);
    }
    for (uint32_t c = e->at[p->b].first; mw__is_corner(c); c = e->corner[c].next) {
        uint32_t q = tri[c / 3].v[mw__next(c % 3)], r = tri[c / 3].v[mw__prev(c % 3)];
        if (mw__surface_seen(e, q) && q != p->a && q != p->apex[0] && q != p->apex[1]) return q;
        if (mw__surface_seen(e, r) && r != p->a && r != p->apex[0] && r != p->apex[1]) return r;
    }
    return MW_NONE;
}

static mw_status collapse_refuse(const collapse_plan *p, const char *why, mw_error *error)
{
    return mw__fail_at(error, mw__link_triangle(p->half[0]), p->a,
                       "the edge from %" PRIu32 " to %" PRIu32 " cannot be collapsed: %s", p->a,
                       p->b, why);
}

static mw_status collapse_check_links(mw_surface_editor *e, collapse_plan *p, mw_error *error)
{
    vertex_round a = vertex_look_round(e, p, p->a), b = vertex_look_round(e, p, p->b);
    p->degree = a.triangles;
    if (p->triangles == 2 && p->apex[0] == p->apex[1])
        return collapse_refuse(p, "both its triangles have the same vertices", error);
    if (p->triangles == 2 && a.border && b.border)
        return collapse_refuse(p, "both ends lie on a border, and the edge does not", error);
    if (a.opposite && b.opposite)
        return collapse_refuse(p, "a triangle at each end has the same two other vertices", error);
    if (ends_are_pinched(e, p, a.triangles, b.triangles))
        return collapse_refuse(p, "both ends are pinched", error);
    for (unsigned i = 0; i < p->triangles; i++) {
        const mw_triangle *t = &e->surface->tri[mw__link_triangle(p->half[i])];
        uint32_t k = mw__link_edge(p->half[i]);
        if (t->link[mw__next(k)] == MW_NONE && t->link[mw__prev(k)] == MW_NONE)
            return collapse_refuse(p, "a triangle at it has no other neighbour", error);
    }
    uint32_t other = common_neighbour(e, p);
    if (other == MW_NONE) return MW_OK;
    return mw__fail_at(error, mw__link_triangle(p->half[0]), p->a,
                       "the edge from %" PRIu32 " to %" PRIu32
                       " cannot be collapsed: vertex %" PRIu32
                       " is joined to both ends, but not by a triangle at the edge",
                       p->a, p->b, other);
}

/* Free a triangle at the edge: its two neighbours become each other's. */
static void collapse_triangle(mw_surface_editor *e, uint32_t half)
{
    uint32_t t = mw__link_triangle(half), k = mw__link_edge(half);
    uint32_t next = e->surface->tri[t].link[mw__next(k)],
             prev = e->surface->tri[t].link[mw__prev(k)];
    mw__surface_free_triangle(e, t, mw__link_triangle(next != MW_NONE ? next : prev));
    if (next != MW_NONE && prev != MW_NONE) mw__surface_join(e, next, prev);
}

mw_status mw__surface_collapse(mw_surface_editor *e, const mw_surface_edit *edit, mw_error *error)
{
    collapse_plan p = {.a = edit->vertex[0], .b = edit->vertex[1], .apex = {MW_NONE, MW_NONE}};
    bool moves = !isnan(edit->point[0]);
    mw_status status = mw__surface_check_edge(e, p.a, p.b, p.half, &p.triangles, error);
    if (status) return status;
    for (unsigned i = 0; i < p.triangles; i++)
        p.apex[i] =
            e->surface->tri[mw__link_triangle(p.half[i])].v[mw__prev(mw__link_edge(p.half[i]))];
    status = collapse_check_links(e, &p, error);
    if (!status) /* those round a, and two neighbours of each triangle at the edge */
        status = mw__surface_edit_begin(
            e, &(mw_surface_needs){.triangles = (size_t)p.degree + 4, .vertex_entries = 1u + moves},
            error);
    if (status) return status;
    for (unsigned i = 0; i < p.triangles; i++) collapse_triangle(e, p.half[i]);
    while (mw__is_corner(e->at[p.a].first)) {
        uint32_t c = e->at[p.a].first;
        mw__surface_set_corner(e, c / 3, c % 3, p.b);
    }
    mw__surface_free_vertex(e, p.a, p.b);
    if (moves) mw__surface_move_vertex(e, p.b, edit->point);
    return MW_OK;
}
