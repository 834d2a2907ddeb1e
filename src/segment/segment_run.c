/* segment_run.c - a segment through many tiles at a time, where rounded areas are sure.
 *
 * A step of the walk waits for the next tile, then for its vertex, then for the area that says on
 * which side of the segment that vertex lies; only then the tile after it is known. So here these
 * areas are computed one step ahead, for the apexes of both tiles that may follow: a fork. Nothing
 * is guessed by a jump but that the run goes on.
 *
 * A segment sees each vertex once: the differences to a and b serve for the side of the vertex and,
 * at the ends of an edge, for the areas of the parameter. A difference taken the other way only
 * changes sign, so the areas are those of mw__orient2d_rounded, to the last bit. */
#include "segment/segment_run.h"

#include "segment/segment.h"

#ifdef __SSE2__
#include <emmintrin.h>
#endif

/* Two doubles side by side; 0 or all bits. */
typedef double run_pair __attribute__((vector_size(16)));
typedef int64_t run_mask __attribute__((vector_size(16)));

#define RUN_MAGNITUDE(p) ((run_pair)((run_mask)(p)&INT64_MAX))
#define RUN_CHOOSE(mask, p, q) ((run_pair)(((run_mask)(p) & (mask)) | ((run_mask)(q) & ~(mask))))

/* 2^-942: what the bound of an area has in place of MW_UNDERFLOW_ERROR, which is less. An area that
 * passes the test of run_is_sure with it is above MW_AREA_LEAST. */
#define RUN_UNDERFLOW_ERROR (MW_PARAMETER_ERROR * MW_AREA_LEAST)

/* The mask as two bits. */
static MW_INLINE uint32_t run_bits(run_mask mask)
{
#ifdef __SSE2__
    return (uint32_t)_mm_movemask_pd((__m128d)mask);
#else
    return (uint32_t)((mask[0] & 1) | (mask[1] & 2));
#endif
}

/* --- vertices and edges --- */

/* Where a and b lie, seen from vertex v: x has a.x - v.x and v.x - b.x, y has a.y - v.y and
 * b.y - v.y. */
typedef struct run_view {
    run_pair x, y;
} run_view;

static MW_INLINE run_view view_from(const double a[2], const double b[2], mw_point v)
{
    return (run_view){{a[0] - v.x, v.x - b[0]}, {a[1] - v.y, b[1] - v.y}};
}

/* Twice the areas of edge pq with a, and of edge qp with b; bounds of their errors. Both are
 * positive where the segment's line passes from a to b over the edge out of a tile to its left. */
typedef struct run_edge {
    run_pair area, off;
} run_edge;

static MW_INLINE run_edge run_edge_seen(const run_view *p, const run_view *q)
{
    run_pair one = p->x * q->y, two = p->y * q->x;
    return (run_edge){one - two, MW_ORIENT2D_ERROR * (RUN_MAGNITUDE(one) + RUN_MAGNITUDE(two)) +
                                     RUN_UNDERFLOW_ERROR};
}

/* Are both areas surely positive, and good for a quotient? */
static MW_INLINE bool run_is_sure(const run_edge *edge)
{
    return run_bits(MW_PARAMETER_ERROR * edge->area > edge->off) == 3 &&
           edge->area[0] + edge->area[1] < MW_AREA_MOST;
}

/* b lies surely before the edge. */
static MW_INLINE bool run_ends_before(const run_edge *edge)
{
    return edge->area[1] < -edge->off[1];
}

static MW_INLINE double run_parameter(const run_edge *edge)
{
    return edge->area[0] / (edge->area[0] + edge->area[1]);
}

/* --- the first tile --- */

/* The corners of a tile as the segment sees them; their sides: > 0 is left. */
typedef struct run_tile {
    run_view corner[4];
    run_edge edge[3];
    double side[3], unsure; /* unsure: bound of all three */
} run_tile;

static MW_INLINE void run_tile_look(run_tile *of, const mw_tiling *tiling, uint32_t t,
                                    const double a[2], const double b[2])
{
    double sum = 0;
    for (uint32_t k = 0; k < 3; k++) {
        of->corner[k] = view_from(a, b, tiling->point[tiling->tri[t].v[k]]);
        double one = of->corner[k].x[0] * of->corner[k].y[1],
               two = of->corner[k].y[0] * of->corner[k].x[1];
        of->side[k] = one + two;
        sum += fabs(one) + fabs(two);
    }
    of->corner[3] = of->corner[0];
    of->unsure = MW_ORIENT2D_ERROR * sum + MW_UNDERFLOW_ERROR;
    for (uint32_t k = 0; k < 3; k++)
        of->edge[k] = run_edge_seen(&of->corner[k], &of->corner[k + 1]);
}

/* The edge over which the segment leaves the tile, or 3: that is not sure, or a is not inside. */
static MW_INLINE uint32_t run_tile_exit(const run_tile *of)
{
    /* from a vertex on the right to one on the left, by those on the left, as bits */
    static const uint8_t exits[8] = {3, 2, 0, 2, 1, 1, 0, 3};
    bool sure = true;
    uint32_t left = 0;
    for (uint32_t k = 0; k < 3; k++) {
        sure &= (of->edge[k].area[0] > of->edge[k].off[0]) & (fabs(of->side[k]) > of->unsure);
        left |= (uint32_t)(of->side[k] > 0) << k;
    }
    return sure ? exits[left] : 3;
}

bool mw__segment_begin_inside(mw_segment *s, const mw_locator *locator, uint32_t tile,
                              const double a[2], const double b[2], mw_segment_piece *piece,
                              size_t *count)
{
    run_tile of;
    run_tile_look(&of, &locator->tiling, tile, a, b);
    uint32_t out = run_tile_exit(&of), user = locator->tiling.tri[tile].user;
    if (MW_UNLIKELY(out == 3)) return false;
    uint32_t link = locator->tiling.tri[tile].link[out];
    bool ends = run_ends_before(&of.edge[out]);
    if (!ends && (!run_is_sure(&of.edge[out]) || link == MW_NONE)) return false;
    double to = ends ? 1 : run_parameter(&of.edge[out]);
    uint8_t to_at = ends ? MW_AT_INSIDE : (uint8_t)mw__user_local_edge(user, out);
    *piece = (mw_segment_piece){0, to, user & MW_USER_MASK, MW_AT_INSIDE, to_at, 255, 0};
    *count += (user & MW_GHOST) == 0;
    *s = (mw_segment){.locator = locator,
                      .a = {a[0], a[1]},
                      .b = {b[0], b[1]},
                      .at = to,
                      .tile = ends ? tile : mw__link_triangle(link),
                      .local = (uint8_t)(ends ? 0 : mw__link_edge(link)),
                      .phase = ends ? MW_SEGMENT_ENDED : MW_SEGMENT_ENTERS,
                      .gap = (user & MW_GHOST) != 0};
    return true;
}

/* --- the tiles after it --- */

/* The apexes of two tiles, one of which follows: the differences of run_view, and bits: lies to
 * the left, is surely on that side. */
typedef struct run_fork {
    run_pair ax, xb, ay, by;
    uint32_t left, sure;
} run_fork;

static MW_INLINE void run_fork_look(run_fork *fork, const double a[2], const double b[2],
                                    const mw_point *v, const mw_point *w)
{
    run_pair x = {v->x, w->x}, y = {v->y, w->y};
    fork->ax = a[0] - x;
    fork->xb = x - b[0];
    fork->ay = a[1] - y;
    fork->by = b[1] - y;
    run_pair one = fork->ax * fork->by, two = fork->ay * fork->xb, side = one + two,
             unsure =
                 MW_ORIENT2D_ERROR * (RUN_MAGNITUDE(one) + RUN_MAGNITUDE(two)) + MW_UNDERFLOW_ERROR;
    fork->left = run_bits(side > 0);
    fork->sure = run_bits(RUN_MAGNITUDE(side) > unsure);
}

static MW_INLINE run_view run_fork_view(const run_fork *fork, uint32_t which)
{
    return (run_view){{fork->ax[which], fork->xb[which]}, {fork->ay[which], fork->by[which]}};
}

/* Without a jump, which would be mispredicted every other time. */
static MW_INLINE uint32_t run_choose(uint32_t first, uint32_t p, uint32_t q)
{
    return q ^ ((p ^ q) & (0 - first));
}

/* The vertex moves one end of the edge: the left one if it lies to the left. */
static MW_INLINE void run_move_end(run_view *left, run_view *right, run_view v, uint32_t is_left)
{
    static const run_mask masks[2] = {{0, 0}, {-1, -1}};
    run_mask mask = masks[is_left];
    left->x = RUN_CHOOSE(mask, v.x, left->x);
    left->y = RUN_CHOOSE(mask, v.y, left->y);
    right->x = RUN_CHOOSE(mask, right->x, v.x);
    right->y = RUN_CHOOSE(mask, right->y, v.y);
}

/* The apex of the tile there; of tile 0 beyond the hull, where the run stops. */
static MW_INLINE const mw_point *run_apex(const mw_tiling *tiling, uint32_t link, uint32_t *apex)
{
    if (MW_UNLIKELY(link == MW_NONE)) link = 0;
    *apex = mw__prev(mw__link_edge(link));
    return &tiling->point[tiling->tri[mw__link_triangle(link)].v[*apex]];
}

/* The tile that the run is in, the edge that it is entered over and the one before that; the ends
 * of the former, the left one and the right one. */
typedef struct run_position {
    uint32_t tile, edge, apex;
    run_view left, right;
} run_position;

static MW_INLINE run_position run_position_of(const mw_segment *s)
{
    const mw_tiling *tiling = &s->locator->tiling;
    const uint32_t *v = tiling->tri[s->tile].v, e = s->local;
    return (run_position){s->tile, e, mw__prev(e), view_from(s->a, s->b, tiling->point[v[e]]),
                          view_from(s->a, s->b, tiling->point[v[e + 1]])};
}

static MW_INLINE void run_write_piece(mw_segment_piece *piece, double from, double to,
                                      uint32_t user, uint32_t gap, uint32_t in, uint8_t to_at)
{
    *piece =
        (mw_segment_piece){from,  to,  user & MW_USER_MASK, (uint8_t)mw__user_local_edge(user, in),
                           to_at, 255, (uint8_t)gap};
}

/* b lies in the tile: the last piece, unless it is in a ghost. */
static size_t run_end(mw_segment *s, mw_segment_piece *piece)
{
    uint32_t user = s->locator->tiling.tri[s->tile].user;
    run_write_piece(piece, s->at, 1, user, s->gap, s->local, MW_AT_INSIDE);
    s->at = 1;
    s->gap = (user & MW_GHOST) != 0;
    s->phase = MW_SEGMENT_ENDED;
    return !s->gap;
}

bool mw__segment_run_far(mw_segment *s, size_t room, mw_segment_piece *piece, size_t *count)
{
    const mw_tiling *tiling = &s->locator->tiling;
    const double a[2] = {s->a[0], s->a[1]}, b[2] = {s->b[0], s->b[1]};
    const mw_segment_piece *first = piece, *end = piece + room;
    run_position at = run_position_of(s);
    run_fork fork;
    const mw_point *apex = &tiling->point[tiling->tri[at.tile].v[at.apex]];
    run_fork_look(&fork, a, b, apex, apex);
    uint32_t gap = s->gap, which = 0;
    double from = s->at;
    bool sure = true, ends = false;
    while (piece < end) {
        const mw_triangle *tile = &tiling->tri[at.tile];
        uint32_t user = tile->user, is_left = fork.left >> which & 1,
                 is_sure = fork.sure >> which & 1, next = 3 - at.edge - at.apex,
                 link[2] = {tile->link[at.apex], tile->link[next]}, apexes[2];
        run_move_end(&at.left, &at.right, run_fork_view(&fork, which), is_left);
        const mw_point *p = run_apex(tiling, link[0], &apexes[0]),
                       *q = run_apex(tiling, link[1], &apexes[1]);
        run_fork_look(&fork, a, b, p, q);
        which = is_left;
        uint32_t out = run_choose(is_left, next, at.apex),
                 way = run_choose(is_left, link[1], link[0]);
        run_edge edge = run_edge_seen(&at.right, &at.left);
        if (MW_UNLIKELY(!run_is_sure(&edge)) || MW_UNLIKELY(!is_sure) ||
            MW_UNLIKELY(way == MW_NONE)) {
            sure = ends = is_sure && run_ends_before(&edge);
            break;
        }
        double to = run_parameter(&edge);
        to = to < from ? from : to;
        run_write_piece(piece, from, to, user, gap, at.edge,
                        (uint8_t)mw__user_local_edge(user, out));
        gap = (user & MW_GHOST) != 0;
        piece += 1 - gap;
        from = to;
        at.apex = run_choose(is_left, apexes[1], apexes[0]);
        at.tile = mw__link_triangle(way);
        at.edge = mw__link_edge(way);
    }
    s->tile = at.tile;
    s->local = (uint8_t)at.edge;
    s->at = from;
    s->gap = (uint8_t)gap;
    if (ends) piece += run_end(s, piece);
    *count += (size_t)(piece - first);
    return sure;
}
