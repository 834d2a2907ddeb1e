/* cover.c - force the outline of a mesh into cells, and count the triangles over each cell. */
#include "domain/cover.h"

#include "triangulate/delaunay/delaunay.h"
#include "triangulate/constrained/brio.h"

#include <stdlib.h>

/* --- forcing the outline in --- */

static uint32_t user_edge(const mw_mesh *mesh, uint32_t half)
{
    return mw__user_edge(mesh->tri[mw__link_triangle(half)].user, mw__link_edge(half));
}

/* A defect of outline edge `edge`, and of `other` where it is one. */
static mw_defect at_edges(const mw_cover *c, mw_defect_kind kind, uint32_t edge, uint32_t other)
{
    const mw_outline *o = c->outline;
    mw_defect defect = mw__defect(kind, mw__link_triangle(o->half[edge]));
    defect.edge = (uint8_t)user_edge(o->mesh, o->half[edge]);
    if (other != MW_NONE) {
        defect.other = mw__link_triangle(o->half[other]);
        defect.other_edge = (uint8_t)user_edge(o->mesh, o->half[other]);
    }
    return defect;
}

static bool add_split(mw_cover *c, uint32_t edge, uint32_t place)
{
    if (c->split_count == c->split_capacity) {
        size_t capacity = 2 * c->split_capacity + 16;
        mw_split *split = mw__realloc(c->split, capacity, sizeof *split);
        if (!split) return false;
        c->split = split;
        c->split_capacity = capacity;
    }
    c->split[c->split_count++] = (mw_split){edge, place};
    return true;
}

/* The edge goes on beyond `place`, which lies inside it. That is right only where a flat triangle joins the two. */
static bool pass_place(mw_cover *c, uint32_t edge, uint32_t place, mw_defects *defects)
{
    if (!add_split(c, edge, place)) return false;
    if (mw__is_bridged(c->outline, c->outline->half[edge])) return true;
    mw_defect defect = at_edges(c, MW_DEFECT_VERTEX_IN_EDGE, edge, MW_NONE);
    defect.vertex = c->outline->vertex[place];
    return mw__defects_add(defects, defect);
}

/* An edge cannot be forced in: leave its triangle out. Returns false when out of memory. */
static bool leave_out(mw_cover *c, uint32_t edge)
{
    if (!c->left_out) c->left_out = mw__calloc(c->outline->mesh->tri_count, sizeof *c->left_out);
    if (c->left_out) c->left_out[mw__link_triangle(c->outline->half[edge])] = 1;
    return c->left_out;
}

/* Leave out all triangles with an area that those left out so far are linked to. What remains are whole parts of the
 * mesh, all of whose outline edges are in the cells, so that its degrees make sense. */
static bool spread_left_out(mw_cover *c)
{
    const mw_mesh *mesh = c->outline->mesh;
    if (!c->left_out) return true;
    uint32_t *stack = mw__alloc(mesh->tri_count, sizeof *stack), top = 0;
    if (!stack) return false;
    for (uint32_t t = 0; t < mesh->tri_count; t++)
        if (c->left_out[t]) stack[top++] = t;
    while (top > 0) {
        const mw_triangle *t = &mesh->tri[stack[--top]];
        for (int k = 0; k < 3; k++) {
            uint32_t other = mw__link_triangle(t->link[k]);
            if (t->link[k] == MW_NONE || c->left_out[other] || mw__is_flat(c->outline, other)) continue;
            c->left_out[other] = 1;
            stack[top++] = other;
        }
    }
    free(stack);
    return true;
}

/* Force one outline edge in. No two edges may run along a piece in the same direction, as their triangles would
 * overlap; this also bounds the pieces of all edges together. Returns false when out of memory. */
static bool force_edge(mw_cover *c, uint32_t edge, mw_defects *defects)
{
    uint32_t from = mw__outline_from(c->outline, c->outline->half[edge]);
    uint32_t to = mw__outline_to(c->outline, c->outline->half[edge]);
    while (from != to) {
        uint32_t before = from;
        mw_subsegment piece;
        mw_subsegment_result result = mw__insert_subsegment(&c->net, &from, &to, &piece);
        if (result == MW_SUBSEGMENT_MEMORY) return false;
        if (result == MW_SUBSEGMENT_FAR) return leave_out(c, edge);
        uint32_t *runs = &c->runs[2 * (size_t)piece.number];
        if (result == MW_SUBSEGMENT_CROSSES)
            return leave_out(c, edge) &&
                   mw__defects_add(defects, at_edges(c, MW_DEFECT_CROSSING, edge, runs[runs[0] == MW_NONE]));
        uint32_t *run = &runs[piece.from > piece.to];
        if (*run != MW_NONE)
            return leave_out(c, edge) && mw__defects_add(defects, at_edges(c, MW_DEFECT_OVERLAP, edge, *run));
        *run = edge;
        if (from != to && !pass_place(c, edge, from != before ? from : to, defects)) return false;
    }
    return true;
}

/* The edges come in random rounds, each in the order of the mesh. In the order of the mesh alone, each might cross
 * about all cells: so do the edges of parallel slivers that are numbered from one side to the other. In random order
 * alone, all memory would be far.
 *
 * An edge that crosses another makes no piece, and does not spare those after it the way it looked through. So once the
 * edges that cross have looked through all cells many times, the mesh being no embedding anyway, each edge that remains
 * looks only at what is near; what is not near either end is left out, and not told. */
static bool force_all(mw_cover *c, mw_defects *defects)
{
    enum { PATIENCE = 64, NEAR = 64 };                                   /* times all cells; cells */
    size_t most = 2 * ((size_t)c->cell_count + c->outline->place_count); /* pieces are edges of the cells */
    c->runs = mw__alloc(most, sizeof *c->runs);
    if (!c->runs) return false;
    for (size_t i = 0; i < most; i++) c->runs[i] = MW_NONE;
    uint32_t *order = mw__brio_order(c->outline->half_count);
    bool done = order;
    for (uint32_t i = 0; i < c->outline->half_count && done; i++) {
        done = force_edge(c, order[i], defects);
        if (c->net.wasted / PATIENCE > c->cell_count) c->net.reach = NEAR;
    }
    free(order);
    return done;
}

/* --- order of the splits --- */

static bool is_before(mw_point a, mw_point b)
{
    return a.x < b.x || (a.x == b.x && a.y < b.y);
}

typedef struct keyed_split {
    mw_split split;
    mw_point point;
    bool backwards; /* the edge runs against the order of points */
} keyed_split;

static int compare_splits(const void *left, const void *right)
{
    const keyed_split *a = left, *b = right;
    if (a->split.edge != b->split.edge) return a->split.edge < b->split.edge ? -1 : 1;
    return is_before(a->point, b->point) != a->backwards ? -1 : 1;
}

static bool sort_splits(mw_cover *c)
{
    const mw_outline *o = c->outline;
    keyed_split *keyed = mw__alloc(c->split_count, sizeof *keyed);
    if (!keyed) return false;
    for (size_t i = 0; i < c->split_count; i++) {
        uint32_t half = o->half[c->split[i].edge];
        keyed[i] = (keyed_split){c->split[i], o->point[c->split[i].place],
                                 is_before(o->point[mw__outline_to(o, half)], o->point[mw__outline_from(o, half)])};
    }
    qsort(keyed, c->split_count, sizeof *keyed, compare_splits);
    for (size_t i = 0; i < c->split_count; i++) c->split[i] = keyed[i].split;
    free(keyed);
    return true;
}

/* --- degrees --- */

static uint32_t run_along(const mw_cover *c, uint32_t half, bool backwards)
{
    const mw_triangle *t = &c->cell[mw__link_triangle(half)];
    uint32_t k = mw__link_edge(half), piece = c->net.subsegment[3 * (size_t)mw__link_triangle(half) + k];
    if (piece == MW_NONE) return MW_NONE;
    uint32_t edge = c->runs[2 * (size_t)piece + ((t->v[k] > t->v[k + 1]) != backwards)];
    if (edge == MW_NONE || !c->left_out) return edge;
    return c->left_out[mw__link_triangle(c->outline->half[edge])] ? MW_NONE : edge;
}

uint32_t mw__cover_inner(const mw_cover *c, uint32_t half)
{
    return run_along(c, half, false);
}

uint32_t mw__cover_outer(const mw_cover *c, uint32_t half)
{
    return run_along(c, half, true);
}

static int32_t weight(const mw_cover *c, uint32_t edge)
{
    if (edge == MW_NONE) return 0;
    return mw__is_fold(c->outline, c->outline->half[edge]) ? 2 : 1;
}

/* How many triangles more lie over the cell of a half-edge than beyond it. */
static int32_t step(const mw_cover *c, uint32_t half)
{
    return weight(c, mw__cover_inner(c, half)) - weight(c, mw__cover_outer(c, half));
}

/* Flood the cells from one at the hull, where nothing lies beyond. */
static bool find_degrees(mw_cover *c)
{
    enum { UNKNOWN = -1 }; /* degrees are numbers of triangles */
    uint32_t *queue = mw__alloc(c->cell_count, sizeof *queue);
    c->degree = mw__alloc(c->cell_count, sizeof *c->degree);
    if (!queue || !c->degree) {
        free(queue);
        return false;
    }
    for (uint32_t t = 0; t < c->cell_count; t++) c->degree[t] = UNKNOWN;
    uint32_t hull = 0, k = 0, head = 0, tail = 0;
    while (c->cell[hull].link[k] != MW_NONE) {
        k = mw__next(k);
        hull += k == 0;
    }
    c->degree[hull] = step(c, mw__link(hull, k));
    queue[tail++] = hull;
    while (head < tail) {
        uint32_t t = queue[head++];
        for (k = 0; k < 3; k++) {
            uint32_t link = c->cell[t].link[k];
            if (link == MW_NONE || c->degree[mw__link_triangle(link)] != UNKNOWN) continue;
            c->degree[mw__link_triangle(link)] = c->degree[t] + step(c, link);
            queue[tail++] = mw__link_triangle(link);
        }
    }
    free(queue);
    return true;
}

mw_status mw__cover_create(mw_cover *cover, const mw_outline *outline, mw_defects *defects, mw_error *error)
{
    *cover = (mw_cover){.outline = outline};
    mw_status status = mw__delaunay_triangles(outline->point, outline->place_count, NULL, NULL, &cover->cell,
                                              &cover->cell_count, error);
    if (status) return status;
    bool done =
        mw__segment_insertion_create(&cover->net, outline->point, outline->place_count, cover->cell, cover->cell_count) &&
        force_all(cover, defects) && spread_left_out(cover) && sort_splits(cover) && find_degrees(cover);
    return done ? MW_OK : mw__fail_memory(error);
}

void mw__cover_release(mw_cover *cover)
{
    mw__segment_insertion_release(&cover->net);
    free(cover->cell);
    free(cover->runs);
    free(cover->split);
    free(cover->left_out);
    free(cover->degree);
    *cover = (mw_cover){0};
}
