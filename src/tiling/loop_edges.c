/* loop_edges.c - the border edges of the tiles, each with the next one of its border loop.
 *
 *      v---x        Beyond the border edge u->v lie cells that no triangle covers. Turn round v,
 *     /: . |        counter-clockwise from u, through these cells. The first border edge met
 *    u  `. |        is the next one of the loop: v->x here. On the hull the turn passes
 *                   through the outside, from one hull edge at v to the other.
 *
 * The cells are those of the coverage. Their edges along the outline are subsegments of the tiles'
 * edges, from node to node. O(b log b) for b border edges, if no node has very many cells. */
#include "tiling/border_loops.h"
#include "tiling/embedding_check.h"
#include "tiling/tiling.h"

#include <stdlib.h>

/* A border edge, found by its ends: the first vertex is in the upper bits. */
typedef struct loop_border_edge {
    uint64_t ends;
    uint32_t half;
} loop_border_edge;

static int compare_border_edges(const void *left, const void *right)
{
    const loop_border_edge *a = left, *b = right;
    return a->ends < b->ends ? -1 : a->ends > b->ends;
}

static loop_border_edge border_edge_of(const mw_tiling *tiling, uint32_t t, uint32_t k)
{
    const uint32_t *v = tiling->tri[t].v;
    return (loop_border_edge){(uint64_t)v[k] << 32 | v[k + 1], mw__link(t, k)};
}

/* All border edges of the tiles, sorted by their ends. */
static loop_border_edge *border_edges_collect(const mw_tiling *tiling, uint32_t *count)
{
    *count = 0;
    for (uint32_t t = 0; t < tiling->tri_count; t++)
        for (uint32_t k = 0; k < 3; k++) *count += tiling->tri[t].link[k] == MW_NONE;
    loop_border_edge *border = mw__alloc(*count, sizeof *border);
    if (!border) return NULL;
    uint32_t n = 0;
    for (uint32_t t = 0; t < tiling->tri_count; t++)
        for (uint32_t k = 0; k < 3; k++)
            if (tiling->tri[t].link[k] == MW_NONE) border[n++] = border_edge_of(tiling, t, k);
    qsort(border, n, sizeof *border, compare_border_edges);
    return border;
}

/* --- turning through the cells --- */

static uint32_t cell_link(const mw_coverage *c, uint32_t half)
{
    return c->cell[mw__link_triangle(half)].link[mw__link_edge(half)];
}

static bool cell_is_empty(const mw_coverage *c, uint32_t half)
{
    return c->degree[mw__link_triangle(half)] == 0;
}

/* Turn clockwise round the start of `half`, to the hull edge that leaves it. */
static uint32_t hull_edge_from(const mw_coverage *c, uint32_t half)
{
    for (uint32_t link; (link = cell_link(c, half)) != MW_NONE;) half = mw__half_next(link);
    return half;
}

/* The half-edge of a cell along which the loop continues: in the direction of the loop, or against
 * it if *reversed. Starts at a half-edge that leaves the vertex, in an empty cell. */
static uint32_t turn_to_border(const mw_coverage *c, uint32_t half, bool *reversed)
{
    for (;;) {
        uint32_t arriving = mw__half_prev(half);
        *reversed = true;
        if (mw__coverage_outer_edge(c, arriving) != MW_NONE) return arriving;
        half = cell_link(c, arriving);
        if (half != MW_NONE) continue;
        half = hull_edge_from(c, mw__half_next(arriving));
        *reversed = false;
        if (!cell_is_empty(c, half)) return half;
    }
}

/* --- the border edges --- */

typedef struct loop_edge_maker {
    const mw_embedding_check *check;
    const loop_border_edge *border;
    uint32_t count;
    mw_loop_edge *edge;
    uint32_t made;
} loop_edge_maker;

/* The border edge along a half-edge of a cell. */
static uint32_t border_edge_along(const loop_edge_maker *m, uint32_t half, bool reversed)
{
    const uint32_t *v = m->check->coverage.cell[mw__link_triangle(half)].v,
                   *vertex = m->check->outline.vertex;
    uint32_t k = mw__link_edge(half), from = vertex[v[k + reversed]], to = vertex[v[k + !reversed]];
    loop_border_edge key = {(uint64_t)from << 32 | to, 0};
    const loop_border_edge *found =
        bsearch(&key, m->border, m->count, sizeof key, compare_border_edges);
    return found->half;
}

/* Add the loop edge that runs against `half`, whose cell is empty. */
static void loop_edge_add_inside(loop_edge_maker *m, uint32_t half)
{
    const mw_embedding_check *s = m->check;
    bool reversed;
    uint32_t next = turn_to_border(&s->coverage, half, &reversed);
    uint32_t hole = s->regions.list[s->regions.of[mw__link_triangle(half)]].hole;
    m->edge[m->made++] = (mw_loop_edge){border_edge_along(m, half, true),
                                        border_edge_along(m, next, reversed), hole};
}

/* Add the loop edge along `half`, an edge of the hull, whose cell a triangle covers. */
static void loop_edge_add_hull(loop_edge_maker *m, uint32_t half)
{
    const mw_coverage *c = &m->check->coverage;
    bool reversed = false;
    uint32_t next = hull_edge_from(c, mw__half_next(half));
    if (cell_is_empty(c, next)) next = turn_to_border(c, next, &reversed);
    m->edge[m->made++] = (mw_loop_edge){border_edge_along(m, half, false),
                                        border_edge_along(m, next, reversed), MW_POCKET};
}

static void loop_edges_add_all(loop_edge_maker *m)
{
    const mw_coverage *c = &m->check->coverage;
    for (uint32_t t = 0; t < c->cell_count; t++)
        for (uint32_t k = 0; k < 3; k++) {
            uint32_t half = mw__link(t, k);
            if (cell_is_empty(c, half)) {
                if (mw__coverage_outer_edge(c, half) != MW_NONE) loop_edge_add_inside(m, half);
            } else if (c->cell[t].link[k] == MW_NONE) {
                loop_edge_add_hull(m, half);
            }
        }
}

mw_loop_edge *mw__loop_edges_create(const mw_embedding_check *check, const mw_tiling *tiling,
                                    uint32_t *count)
{
    loop_border_edge *border = border_edges_collect(tiling, count);
    loop_edge_maker m = {.check = check, .border = border, .count = *count};
    m.edge = border ? mw__alloc(*count, sizeof *m.edge) : NULL;
    if (m.edge) loop_edges_add_all(&m);
    free(border);
    return m.edge;
}
