/* count.h - what can be counted in linked triangles, whatever their orientation, in the plane or in space. Private.
 *
 * `place` as in place.h: vertices at one place are one vertex, also for the links. */
#ifndef MW_SRC_COUNT_H
#define MW_SRC_COUNT_H

#include "mesh/fan.h"

/* As mw__has_three_vertices: a triangle with two vertices at one place has no edges either. */
static MW_INLINE bool mw__has_three_places(const mw_triangle *t, const uint32_t *place)
{
    uint32_t a = mw__place_of(place, t->v[0]), b = mw__place_of(place, t->v[1]), c = mw__place_of(place, t->v[2]);
    return a != b && b != c && c != a;
}

/* Vertices (below vertex_count) that triangles use, and pieces that share no vertex. False when out of memory. */
bool mw__count_pieces(const mw_triangle *tri, uint32_t n, uint32_t vertex_count, const uint32_t *place, uint32_t *used,
                      uint32_t *pieces);

/* Closed chains of edges without link: each goes on with the one that turning round its end leads to. False when out of
 * memory. */
bool mw__count_loops(const mw_triangle *tri, uint32_t n, const uint32_t *place, uint32_t *loops);

/* fans[v], 0 at first, becomes the number of fans that the triangles of three vertices form round the vertex (place) v,
 * at most 2. False when out of memory. */
bool mw__count_fans(const mw_triangle *tri, uint32_t n, const uint32_t *place, uint8_t *fans);

/* A sum with the rounding errors added up beside it [Neumaier 1974]. */
typedef struct mw_sum {
    double sum, lost;
} mw_sum;

static MW_INLINE void mw__sum_add(mw_sum *s, double x)
{
    double next = s->sum + x;
    s->lost += fabs(s->sum) >= fabs(x) ? s->sum - next + x : x - next + s->sum;
    s->sum = next;
}

static MW_INLINE double mw__sum_value(const mw_sum *s)
{
    return isfinite(s->lost) ? s->sum + s->lost : s->sum;
}

#endif
