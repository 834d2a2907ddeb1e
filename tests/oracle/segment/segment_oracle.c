/* segment_oracle.c - clips the segment by each triangle; between two ends of clipped parts the
 * lowest triangle has it. */
#include "oracle/segment/segment_oracle.h"

#include <float.h>
#include <gmp.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "oracle/location_oracle.h"

/* The part of the segment in one triangle. */
typedef struct clipped {
    mpq_t from, to;
    uint32_t triangle;
} clipped;

typedef struct rational_point {
    mpq_t x, y;
} rational_point;

static void point_init(rational_point *p)
{
    mpq_inits(p->x, p->y, NULL);
}

static void point_clear(rational_point *p)
{
    mpq_clears(p->x, p->y, NULL);
}

static void point_set(rational_point *p, const double *xy)
{
    mpq_set_d(p->x, xy[0]);
    mpq_set_d(p->y, xy[1]);
}

/* area = (q - p) x (r - p) */
static void point_area(mpq_t area, const rational_point *p, const rational_point *q,
                       const rational_point *r)
{
    mpq_t u, v;
    mpq_inits(u, v, NULL);
    mpq_sub(u, q->x, p->x);
    mpq_sub(v, r->y, p->y);
    mpq_mul(area, u, v);
    mpq_sub(u, q->y, p->y);
    mpq_sub(v, r->x, p->x);
    mpq_mul(u, u, v);
    mpq_sub(area, area, u);
    mpq_clears(u, v, NULL);
}

/* Cuts off what lies to the right of the edge pq. */
static void clip_by_edge(clipped *c, const rational_point *p, const rational_point *q,
                         const rational_point *a, const rational_point *b)
{
    mpq_t of_a, of_b, t;
    mpq_inits(of_a, of_b, t, NULL);
    point_area(of_a, p, q, a);
    point_area(of_b, p, q, b);
    int sign_a = mpq_sgn(of_a), sign_b = mpq_sgn(of_b);
    if (sign_a < 0 && sign_b < 0) {
        mpq_set_si(c->from, 2, 1);
    } else if (sign_a < 0 || sign_b < 0) {
        mpq_sub(t, of_a, of_b);
        mpq_div(t, of_a, t);
        if (sign_a < 0 && mpq_cmp(t, c->from) > 0) mpq_set(c->from, t);
        if (sign_b < 0 && mpq_cmp(t, c->to) < 0) mpq_set(c->to, t);
    }
    mpq_clears(of_a, of_b, t, NULL);
}

/* False: no part of positive length. */
static bool clip_by_triangle(clipped *c, const double *points, const uint32_t *t,
                             const rational_point *a, const rational_point *b)
{
    rational_point p[3];
    mpq_t turn;
    mpq_init(turn);
    for (int k = 0; k < 3; k++) {
        point_init(&p[k]);
        point_set(&p[k], points + 2 * (size_t)t[k]);
    }
    point_area(turn, &p[0], &p[1], &p[2]);
    mpq_set_si(c->from, 0, 1);
    mpq_set_si(c->to, 1, 1);
    int way = mpq_sgn(turn);
    for (int k = 0; k < 3 && way; k++) {
        int next = (k + 1) % 3;
        clip_by_edge(c, &p[way > 0 ? k : next], &p[way > 0 ? next : k], a, b);
    }
    for (int k = 0; k < 3; k++) point_clear(&p[k]);
    mpq_clear(turn);
    return way != 0 && mpq_cmp(c->from, c->to) < 0;
}

/* Where the point at t of the segment is in a triangle. */
static uint8_t place_at(const double *points, const uint32_t *tri, const rational_point *a,
                        const rational_point *b, const mpq_t t, uint8_t *edges)
{
    rational_point q, p[3];
    mpq_t area;
    uint8_t zeros = 0, edge = 0;
    mpq_init(area);
    point_init(&q);
    mpq_sub(q.x, b->x, a->x);
    mpq_mul(q.x, q.x, t);
    mpq_add(q.x, q.x, a->x);
    mpq_sub(q.y, b->y, a->y);
    mpq_mul(q.y, q.y, t);
    mpq_add(q.y, q.y, a->y);
    for (int k = 0; k < 3; k++) {
        point_init(&p[k]);
        point_set(&p[k], points + 2 * (size_t)tri[k]);
    }
    *edges = 0;
    for (uint8_t k = 0; k < 3; k++) {
        point_area(area, &p[k], &p[(k + 1) % 3], &q);
        if (mpq_sgn(area) != 0) continue;
        zeros++;
        edge = k;
        *edges = (uint8_t)(*edges | 1u << k);
    }
    for (int k = 0; k < 3; k++) point_clear(&p[k]);
    point_clear(&q);
    mpq_clear(area);
    if (zeros == 0) return MW_AT_INSIDE;
    if (zeros == 1) return (uint8_t)(MW_AT_EDGE + edge);
    return (uint8_t)(MW_AT_VERTEX + (*edges == 3 ? 1 : *edges == 6 ? 2 : 0));
}

static int compare_ends(const void *a, const void *b)
{
    const mpq_t *const *p = a, *const *q = b;
    return mpq_cmp(**p, **q);
}

/* The lowest triangle whose part has all of from .. to. */
static uint32_t owner_between(const clipped *c, uint32_t n, const mpq_t from, const mpq_t to)
{
    for (uint32_t i = 0; i < n; i++)
        if (mpq_cmp(c[i].from, from) <= 0 && mpq_cmp(to, c[i].to) <= 0) return c[i].triangle;
    return MW_NONE;
}

typedef struct piece_list {
    const double *points;
    const uint32_t *triangles;
    rational_point a, b;
    mw_segment_piece *piece;
    size_t room, count;
    uint8_t first_edges; /* of the last piece: edges that its beginning is on */
} piece_list;

/* The part from .. to has this owner; it joins the piece before it. */
static void list_add(piece_list *list, uint32_t owner, uint32_t before, const mpq_t from,
                     const mpq_t to)
{
    uint8_t edges;
    if (owner == MW_NONE) return;
    const uint32_t *t = list->triangles + 3 * (size_t)owner;
    if (owner != before) list->count++;
    if (list->count > list->room) return;
    mw_segment_piece *piece = &list->piece[list->count - 1];
    if (owner != before) {
        *piece = (mw_segment_piece){.triangle = owner,
                                    .from = mpq_get_d(from),
                                    .gap = before == MW_NONE && mpq_sgn(from) > 0};
        piece->from_at = place_at(list->points, t, &list->a, &list->b, from, &list->first_edges);
    }
    piece->to = mpq_get_d(to);
    piece->to_at = place_at(list->points, t, &list->a, &list->b, to, &edges);
    edges &= list->first_edges;
    piece->along = edges ? (uint8_t)__builtin_ctz(edges) : 255;
}

static void list_make(piece_list *list, const clipped *c, uint32_t n)
{
    const mpq_t **end = malloc((2 * (size_t)n + 1) * sizeof *end);
    uint32_t before = MW_NONE;
    for (uint32_t i = 0; i < n; i++) {
        end[2 * i] = &c[i].from;
        end[2 * i + 1] = &c[i].to;
    }
    if (n) qsort(end, 2 * (size_t)n, sizeof *end, compare_ends);
    for (uint32_t i = 0; i + 1 < 2 * n; i++) {
        if (mpq_equal(*end[i], *end[i + 1])) continue;
        uint32_t owner = owner_between(c, n, *end[i], *end[i + 1]);
        list_add(list, owner, before, *end[i], *end[i + 1]);
        before = owner;
    }
    free(end);
}

static size_t pieces_of_point(piece_list *list, uint32_t count, const double q[2])
{
    location_answer at = location_oracle_locate(list->points, list->triangles, count, q);
    if (at.triangle == MW_NONE) return 0;
    uint8_t place = (uint8_t)(at.where == MW_INSIDE    ? MW_AT_INSIDE
                              : at.where == MW_ON_EDGE ? MW_AT_EDGE + at.local
                                                       : MW_AT_VERTEX + at.local);
    if (list->room)
        list->piece[0] = (mw_segment_piece){
            .triangle = at.triangle, .from_at = place, .to_at = place, .along = 255};
    return 1;
}

size_t segment_oracle_pieces(const double *points, const uint32_t *triangles, uint32_t count,
                             const double a[2], const double b[2], mw_segment_piece *pieces,
                             size_t room)
{
    piece_list list = {.points = points, .triangles = triangles, .piece = pieces, .room = room};
    if (a[0] == b[0] && a[1] == b[1]) return pieces_of_point(&list, count, a);
    clipped *c = malloc((count + 1) * sizeof *c);
    uint32_t n = 0;
    point_init(&list.a);
    point_init(&list.b);
    point_set(&list.a, a);
    point_set(&list.b, b);
    for (uint32_t t = 0; t < count; t++) {
        mpq_inits(c[n].from, c[n].to, NULL);
        c[n].triangle = t;
        if (clip_by_triangle(&c[n], points, triangles + 3 * (size_t)t, &list.a, &list.b))
            n++;
        else
            mpq_clears(c[n].from, c[n].to, NULL);
    }
    list_make(&list, c, n);
    for (uint32_t i = 0; i < n; i++) mpq_clears(c[i].from, c[i].to, NULL);
    free(c);
    point_clear(&list.a);
    point_clear(&list.b);
    return list.count;
}

/* --- comparison --- */

static bool parameters_agree(double is, double should)
{
    return fabs(is - should) <= 0x1p-40 * should + DBL_MIN;
}

static bool piece_agrees(const mw_segment_piece *is, const mw_segment_piece *should,
                         const mw_segment_piece *before)
{
    return is->triangle == should->triangle && is->from_at == should->from_at &&
           is->to_at == should->to_at && is->along == should->along && is->gap == should->gap &&
           parameters_agree(is->from, should->from) && parameters_agree(is->to, should->to) &&
           is->from <= is->to && is->to <= 1 &&
           (!before || (is->gap ? before->to <= is->from : before->to == is->from));
}

static void piece_print(const char *whose, const mw_segment_piece *p)
{
    fprintf(stderr, "  %s: triangle %u, %.17g (%d) to %.17g (%d), along %d, gap %d\n", whose,
            p->triangle, p->from, p->from_at, p->to, p->to_at, p->along, p->gap);
}

bool segment_oracle_agrees(const double *points, const uint32_t *triangles, uint32_t count,
                           const double a[2], const double b[2], const mw_segment_piece *pieces,
                           size_t piece_count)
{
    size_t room = 2 * (size_t)count + 1, i = 0;
    mw_segment_piece *should = malloc(room * sizeof *should);
    size_t n = segment_oracle_pieces(points, triangles, count, a, b, should, room);
    while (i < n && i < piece_count &&
           piece_agrees(&pieces[i], &should[i], i ? &pieces[i - 1] : NULL))
        i++;
    bool agrees = i == n && i == piece_count;
    if (!agrees) {
        fprintf(stderr, "segment %.17g %.17g to %.17g %.17g: %zu pieces, not %zu; piece %zu\n",
                a[0], a[1], b[0], b[1], piece_count, n, i);
        if (i < n) piece_print("should be", &should[i]);
        if (i < piece_count) piece_print("is", &pieces[i]);
    }
    free(should);
    return agrees;
}
