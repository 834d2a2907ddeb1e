/* rim.c - the border of the tiles, in the order in which it runs round what lies beyond it.
 *
 *      v---x        Beyond the border edge u->v lie the cells that no triangle covers. Turning counter-clockwise round v from
 *     /: . |        u through these cells, the first border edge met leaves v along the same face: v->x here. On the hull
 *    u  `. |        the turn passes the outside, from one hull edge at v to the other.
 * The cells are those of the survey's cover; their edges along the outline are parts of the tiles' edges, from place to
 * place. O(b log b) for b border edges, if places do not have many cells at once. */
#include "domain/rim.h"

#include <stdlib.h>

/* A border edge by its ends, the first vertex in the upper bits. */
typedef struct named {
    uint64_t ends;
    uint32_t half;
} named;

static int compare_named(const void *left, const void *right)
{
    const named *a = left, *b = right;
    return a->ends < b->ends ? -1 : a->ends > b->ends;
}

static named name_of(const mw_tiling *tiling, uint32_t t, uint32_t k)
{
    const uint32_t *v = tiling->tri[t].v;
    return (named){(uint64_t)v[k] << 32 | v[k + 1], mw__link(t, k)};
}

/* All border edges of the tiles, by their ends. */
static named *name_all(const mw_tiling *tiling, uint32_t *count)
{
    *count = 0;
    for (uint32_t t = 0; t < tiling->tri_count; t++)
        for (uint32_t k = 0; k < 3; k++) *count += tiling->tri[t].link[k] == MW_NONE;
    named *names = mw__alloc(*count, sizeof *names);
    if (!names) return NULL;
    uint32_t n = 0;
    for (uint32_t t = 0; t < tiling->tri_count; t++)
        for (uint32_t k = 0; k < 3; k++)
            if (tiling->tri[t].link[k] == MW_NONE) names[n++] = name_of(tiling, t, k);
    qsort(names, n, sizeof *names, compare_named);
    return names;
}

/* --- turning through the cells --- */

static uint32_t link_of(const mw_cover *c, uint32_t half)
{
    return c->cell[mw__link_triangle(half)].link[mw__link_edge(half)];
}

static bool is_empty(const mw_cover *c, uint32_t half)
{
    return c->degree[mw__link_triangle(half)] == 0;
}

/* Turn clockwise round the start of `half` to the hull edge that leaves it. */
static uint32_t hull_edge(const mw_cover *c, uint32_t half)
{
    for (uint32_t link; (link = link_of(c, half)) != MW_NONE;) half = mw__half_next(link);
    return half;
}

/* The half-edge of a cell along which the border goes on: as the border runs, or against it with *reversed. Begins at
 * one that leaves the vertex, in an empty cell. */
static uint32_t turn_to_border(const mw_cover *c, uint32_t half, bool *reversed)
{
    for (;;) {
        uint32_t arriving = mw__half_prev(half);
        *reversed = true;
        if (mw__cover_outer(c, arriving) != MW_NONE) return arriving;
        half = link_of(c, arriving);
        if (half != MW_NONE) continue;
        half = hull_edge(c, mw__half_next(arriving));
        *reversed = false;
        if (!is_empty(c, half)) return half;
    }
}

/* --- the border edges --- */

typedef struct maker {
    const mw_survey *survey;
    const named *names;
    uint32_t count;
    mw_rim_edge *edge;
    uint32_t made;
} maker;

/* The border edge along a half-edge of a cell. */
static uint32_t border_along(const maker *m, uint32_t half, bool reversed)
{
    const uint32_t *v = m->survey->cover.cell[mw__link_triangle(half)].v, *vertex = m->survey->outline.vertex;
    uint32_t k = mw__link_edge(half), from = vertex[v[k + reversed]], to = vertex[v[k + !reversed]];
    named key = {(uint64_t)from << 32 | to, 0};
    const named *found = bsearch(&key, m->names, m->count, sizeof key, compare_named);
    return found->half;
}

/* The border runs against `half`, whose cell is empty. */
static void add_inside(maker *m, uint32_t half)
{
    const mw_survey *s = m->survey;
    bool reversed;
    uint32_t next = turn_to_border(&s->cover, half, &reversed);
    uint32_t hole = s->regions.list[s->regions.of[mw__link_triangle(half)]].hole;
    m->edge[m->made++] = (mw_rim_edge){border_along(m, half, true), border_along(m, next, reversed), hole};
}

/* The border runs along `half`, an edge of the hull, whose cell a triangle covers. */
static void add_hull(maker *m, uint32_t half)
{
    const mw_cover *c = &m->survey->cover;
    bool reversed = false;
    uint32_t next = hull_edge(c, mw__half_next(half));
    if (is_empty(c, next)) next = turn_to_border(c, next, &reversed);
    m->edge[m->made++] = (mw_rim_edge){border_along(m, half, false), border_along(m, next, reversed), MW_POCKET};
}

static void add_all(maker *m)
{
    const mw_cover *c = &m->survey->cover;
    for (uint32_t t = 0; t < c->cell_count; t++)
        for (uint32_t k = 0; k < 3; k++) {
            uint32_t half = mw__link(t, k);
            if (is_empty(c, half)) {
                if (mw__cover_outer(c, half) != MW_NONE) add_inside(m, half);
            } else if (c->cell[t].link[k] == MW_NONE) {
                add_hull(m, half);
            }
        }
}

mw_rim_edge *mw__rim_create(const mw_survey *survey, const mw_tiling *tiling, uint32_t *count)
{
    named *names = name_all(tiling, count);
    maker m = {.survey = survey, .names = names, .count = *count};
    m.edge = names ? mw__alloc(*count, sizeof *m.edge) : NULL;
    if (m.edge) add_all(&m);
    free(names);
    return m.edge;
}
