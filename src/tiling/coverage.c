/* coverage.c - forces the outline of a mesh into cells, and counts the triangles over each cell. */
#include "tiling/coverage.h"

#include "triangulate/delaunay/delaunay.h"
#include "triangulate/constrained/brio.h"

#include <stdlib.h>

/* --- forcing edges --- */

static uint32_t outline_user_edge(const mw_mesh *mesh, uint32_t half)
{
    return mw__user_local_edge(mesh->tri[mw__link_triangle(half)].user, mw__link_edge(half));
}

/* A defect of outline edge `edge`, and of edge `other` unless that is MW_NONE. */
static mw_defect outline_edges_defect(const mw_coverage *c, mw_defect_kind kind, uint32_t edge,
                                      uint32_t other)
{
    const mw_outline *o = c->outline;
    mw_defect defect = mw__defect(kind, mw__link_triangle(o->half[edge]));
    defect.edge = (uint8_t)outline_user_edge(o->mesh, o->half[edge]);
    if (other != MW_NONE) {
        defect.other = mw__link_triangle(o->half[other]);
        defect.other_edge = (uint8_t)outline_user_edge(o->mesh, o->half[other]);
    }
    return defect;
}

static bool split_add(mw_coverage *c, uint32_t edge, uint32_t node)
{
    if (c->split_count == c->split_capacity) {
        size_t capacity = 2 * c->split_capacity + 16;
        mw_split *split = mw__realloc(c->split, capacity, sizeof *split);
        if (!split) return false;
        c->split = split;
        c->split_capacity = capacity;
    }
    c->split[c->split_count++] = (mw_split){edge, node};
    return true;
}

/* The edge continues beyond `node`, which lies inside it. Only a flat triangle that joins the two
 * makes this right. */
static bool coverage_pass_node(mw_coverage *c, uint32_t edge, uint32_t node, mw_defects *defects)
{
    if (!split_add(c, edge, node)) return false;
    if (mw__is_bridged(c->outline, c->outline->half[edge])) return true;
    mw_defect defect = outline_edges_defect(c, MW_DEFECT_VERTEX_IN_EDGE, edge, MW_NONE);
    defect.vertex = c->outline->vertex[node];
    return mw__defects_add(defects, defect);
}

/* Leave the triangle of an edge out, as the edge cannot be forced. Returns false when out of
 * memory. */
static bool coverage_leave_out(mw_coverage *c, uint32_t edge)
{
    if (!c->left_out) c->left_out = mw__calloc(c->outline->mesh->tri_count, sizeof *c->left_out);
    if (c->left_out) c->left_out[mw__link_triangle(c->outline->half[edge])] = 1;
    return c->left_out;
}

/* Leave out all triangles with an area that are connected by links to those left out so far. All
 * outline edges of the remaining ones are in the cells, so their degrees make sense. */
static bool coverage_flood_left_out(mw_coverage *c)
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
            if (t->link[k] == MW_NONE || c->left_out[other] || mw__is_flat(c->outline, other))
                continue;
            c->left_out[other] = 1;
            stack[top++] = other;
        }
    }
    free(stack);
    return true;
}

/* Force one outline edge. Two edges along one subsegment in the same direction are a defect, as
 * their triangles overlap. This also bounds the number of all subsegments. Returns false when out
 * of memory. */
static bool coverage_force_edge(mw_coverage *c, uint32_t edge, mw_defects *defects)
{
    uint32_t from = mw__outline_from(c->outline, c->outline->half[edge]);
    uint32_t to = mw__outline_to(c->outline, c->outline->half[edge]);
    while (from != to) {
        uint32_t before = from;
        mw_subsegment subsegment;
        mw_subsegment_result result = mw__insert_subsegment(&c->net, &from, &to, &subsegment);
        if (result == MW_SUBSEGMENT_MEMORY) return false;
        if (result == MW_SUBSEGMENT_FAR) return coverage_leave_out(c, edge);
        uint32_t *ways = &c->edge_along[2 * (size_t)subsegment.number];
        if (result == MW_SUBSEGMENT_CROSSES)
            return coverage_leave_out(c, edge) &&
                   mw__defects_add(defects, outline_edges_defect(c, MW_DEFECT_CROSSING, edge,
                                                                 ways[ways[0] == MW_NONE]));
        uint32_t *along = &ways[subsegment.from > subsegment.to];
        if (*along != MW_NONE)
            return coverage_leave_out(c, edge) &&
                   mw__defects_add(defects,
                                   outline_edges_defect(c, MW_DEFECT_OVERLAP, edge, *along));
        *along = edge;
        if (from != to && !coverage_pass_node(c, edge, from != before ? from : to, defects))
            return false;
    }
    return true;
}

/* The edges come in random rounds, each round in the order of the mesh. In the order of the mesh
 * alone, each edge might cross most of the cells, as the edges of parallel slivers do that are
 * numbered from one side to the other. In random order alone, each access would be a cache miss.
 *
 * An edge that crosses another one makes no subsegment, so it does not shorten the search of later
 * edges. Once such edges have searched all cells many times, the mesh is not an embedding anyway.
 * From then on an edge only searches near its ends. An edge that this does not find is left out and
 * not reported. */
static bool coverage_force_edges(mw_coverage *c, mw_job *job, mw_defects *defects)
{
    mw__job_stage(job, "forcing the border", 0.5);
    enum { PATIENCE = 64, NEAR = 64 }; /* PATIENCE: times all cells; NEAR: cells */
    /* Subsegments are edges of the cells. */
    size_t most = 2 * ((size_t)c->cell_count + c->outline->node_count);
    c->edge_along = mw__alloc(most, sizeof *c->edge_along);
    if (!c->edge_along) return false;
    for (size_t i = 0; i < most; i++) c->edge_along[i] = MW_NONE;
    uint32_t *order = mw__brio_order(c->outline->half_count);
    bool done = order;
    for (uint32_t i = 0; i < c->outline->half_count && done; i++) {
        done = coverage_force_edge(c, order[i], defects) &&
               mw__job_step(job, i, c->outline->half_count);
        if (c->net.wasted / PATIENCE > c->cell_count) c->net.reach = NEAR;
    }
    free(order);
    return done;
}

/* --- order of the splits --- */

static bool point_is_before(mw_point a, mw_point b)
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
    return point_is_before(a->point, b->point) != a->backwards ? -1 : 1;
}

static bool splits_sort(mw_coverage *c)
{
    const mw_outline *o = c->outline;
    keyed_split *keyed = mw__alloc(c->split_count, sizeof *keyed);
    if (!keyed) return false;
    for (size_t i = 0; i < c->split_count; i++) {
        uint32_t half = o->half[c->split[i].edge];
        keyed[i] = (keyed_split){c->split[i], o->point[c->split[i].node],
                                 point_is_before(o->point[mw__outline_to(o, half)],
                                                 o->point[mw__outline_from(o, half)])};
    }
    qsort(keyed, c->split_count, sizeof *keyed, compare_splits);
    for (size_t i = 0; i < c->split_count; i++) c->split[i] = keyed[i].split;
    free(keyed);
    return true;
}

/* --- degrees --- */

static uint32_t coverage_edge_along(const mw_coverage *c, uint32_t half, bool backwards)
{
    const mw_triangle *t = &c->cell[mw__link_triangle(half)];
    uint32_t k = mw__link_edge(half),
             subsegment = c->net.subsegment[3 * (size_t)mw__link_triangle(half) + k];
    if (subsegment == MW_NONE) return MW_NONE;
    uint32_t edge = c->edge_along[2 * (size_t)subsegment + ((t->v[k] > t->v[k + 1]) != backwards)];
    if (edge == MW_NONE || !c->left_out) return edge;
    return c->left_out[mw__link_triangle(c->outline->half[edge])] ? MW_NONE : edge;
}

uint32_t mw__coverage_inner_edge(const mw_coverage *c, uint32_t half)
{
    return coverage_edge_along(c, half, false);
}

uint32_t mw__coverage_outer_edge(const mw_coverage *c, uint32_t half)
{
    return coverage_edge_along(c, half, true);
}

static int32_t outline_edge_weight(const mw_coverage *c, uint32_t edge)
{
    if (edge == MW_NONE) return 0;
    return mw__is_fold(c->outline, c->outline->half[edge]) ? 2 : 1;
}

/* The number of triangles over the cell of a half-edge less the number beyond it. */
static int32_t coverage_step(const mw_coverage *c, uint32_t half)
{
    return outline_edge_weight(c, mw__coverage_inner_edge(c, half)) -
           outline_edge_weight(c, mw__coverage_outer_edge(c, half));
}

/* Flood the cells, starting at the hull, beyond which there are no triangles. */
static bool coverage_find_degrees(mw_coverage *c)
{
    enum { UNKNOWN = -1 }; /* degrees are not negative */
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
    c->degree[hull] = coverage_step(c, mw__link(hull, k));
    queue[tail++] = hull;
    while (head < tail) {
        uint32_t t = queue[head++];
        for (k = 0; k < 3; k++) {
            uint32_t link = c->cell[t].link[k];
            if (link == MW_NONE || c->degree[mw__link_triangle(link)] != UNKNOWN) continue;
            c->degree[mw__link_triangle(link)] = c->degree[t] + coverage_step(c, link);
            queue[tail++] = mw__link_triangle(link);
        }
    }
    free(queue);
    return true;
}

mw_status mw__coverage_create(mw_coverage *coverage, const mw_outline *outline, mw_job *job,
                              mw_defects *defects, mw_error *error)
{
    *coverage = (mw_coverage){.outline = outline};
    mw_job_span outer = mw__job_part(job, 0.5);
    mw_status status = mw__delaunay_triangles(outline->point, outline->node_count, job, NULL, NULL,
                                              &coverage->cell, &coverage->cell_count, error);
    mw__job_part_end(job, outer);
    if (status) return status;
    bool done = mw__segment_insertion_create(&coverage->net, outline->point, outline->node_count,
                                             coverage->cell, coverage->cell_count) &&
                coverage_force_edges(coverage, job, defects) && coverage_flood_left_out(coverage) &&
                splits_sort(coverage) && coverage_find_degrees(coverage);
    return done ? MW_OK : mw__fail_memory(error);
}

void mw__coverage_release(mw_coverage *coverage)
{
    mw__segment_insertion_release(&coverage->net);
    free(coverage->cell);
    free(coverage->edge_along);
    free(coverage->split);
    free(coverage->left_out);
    free(coverage->degree);
    *coverage = (mw_coverage){0};
}
