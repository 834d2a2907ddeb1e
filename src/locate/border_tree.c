/* border_tree.c - the nearest border edge, decided exactly.
 *
 * Rounded distances with sound margins steer the search through the tree; if rounding leaves open
 * which of two edges is nearer, exact predicates decide. Equal distances go to the lowest triangle,
 * then edge. */
#include "locate/border_tree.h"

#include "base/hilbert.h"
#include "mesh/mesh_order.h"

#include <stdlib.h>

/* --- building --- */

static bool link_is_covered(const mw_tiling *tiling, uint32_t link)
{
    return link != MW_NONE && !(tiling->tri[mw__link_triangle(link)].user & MW_GHOST);
}

uint32_t mw__border_edge_of_user(const mw_mesh *mesh, const mw_tiling *tiling,
                                 const mw_triangle *tile, uint32_t k)
{
    if (!tiling->cut) return mw__user_local_edge(tile->user, k);
    const mw_triangle *t = &mesh->tri[mw__triangle_slot(mesh, tile->user & MW_USER_MASK)];
    mw_point a = tiling->point[tile->v[k]], b = tiling->point[tile->v[k + 1]];
    for (uint32_t e = 0; e < 2; e++) {
        mw_point from = mesh->point[t->v[e]], to = mesh->point[t->v[e + 1]];
        if (mw__orient2d(from, to, a) == 0 && mw__orient2d(from, to, b) == 0)
            return mw__user_local_edge(t->user, e);
    }
    return mw__user_local_edge(t->user, 2);
}

/* Called twice: first to count the edges, then to store them. */
static uint32_t border_collect(const mw_mesh *mesh, const mw_tiling *tiling, mw_border_edge *edge)
{
    uint32_t n = 0;
    for (uint32_t t = 0; t < tiling->tri_count; t++) {
        const mw_triangle *tile = &tiling->tri[t];
        if (tile->user & MW_GHOST || (!tiling->embedding && !mw__has_area(tiling->point, tile)))
            continue;
        for (uint32_t k = 0; k < 3; k++) {
            if (link_is_covered(tiling, tile->link[k])) continue;
            if (edge)
                edge[n] = (mw_border_edge){tiling->point[tile->v[k]], tiling->point[tile->v[k + 1]],
                                           tile->user & MW_USER_MASK,
                                           mw__border_edge_of_user(mesh, tiling, tile, k)};
            n++;
        }
    }
    return n;
}

static bool border_sort(mw_border_tree *border, const mw_tiling *tiling)
{
    uint32_t n = border->edge_count;
    mw_key *key = mw__alloc(2 * (size_t)n, sizeof *key);
    mw_border_edge *sorted = mw__alloc(n, sizeof *sorted);
    if (key && sorted) {
        double low[2], high[2];
        mw__triangles_extent(tiling->point, tiling->tri, tiling->tri_count, low, high);
        mw_hilbert hilbert = mw__hilbert(low, high);
        for (uint32_t i = 0; i < n; i++) {
            const mw_border_edge *e = &border->edge[i];
            key[i] = (mw_key){
                mw__hilbert_key(&hilbert, e->a.x / 2 + e->b.x / 2, e->a.y / 2 + e->b.y / 2), i};
        }
        mw__sort_keys(key, key + n, n);
        for (uint32_t i = 0; i < n; i++) sorted[i] = border->edge[key[i].item];
        free(border->edge);
        border->edge = sorted;
    } else {
        free(sorted);
    }
    free(key);
    return key && sorted;
}

mw_box mw__border_edge_box(const void *edges, uint32_t i)
{
    const mw_border_edge *e = (const mw_border_edge *)edges + i;
    return (mw_box){{fmin(e->a.x, e->b.x), fmin(e->a.y, e->b.y)},
                    {fmax(e->a.x, e->b.x), fmax(e->a.y, e->b.y)}};
}

bool mw__border_tree_create(mw_border_tree *border, const mw_mesh *mesh, const mw_tiling *tiling)
{
    *border = (mw_border_tree){.edge_count = border_collect(mesh, tiling, NULL)};
    border->edge = mw__alloc(border->edge_count, sizeof *border->edge);
    if (!border->edge) return false;
    border_collect(mesh, tiling, border->edge);
    return border_sort(border, tiling) && mw__box_tree_create(&border->tree, border->edge_count,
                                                              mw__border_edge_box, border->edge);
}

void mw__border_tree_release(mw_border_tree *border)
{
    free(border->edge);
    mw__box_tree_release(&border->tree);
    *border = (mw_border_tree){0};
}

size_t mw__border_tree_bytes(const mw_border_tree *border)
{
    return border->edge_count * sizeof *border->edge + mw__box_tree_bytes(&border->tree);
}

/* --- searching --- */

typedef struct border_search {
    const mw_border_tree *border;
    mw_point q;
    const mw_border_edge *best;
    double most; /* the distance to `best` is at most this */
} border_search;

/* The distance of q to a segment lies between these. */
typedef struct distance_range {
    double low, high;
} distance_range;

/* The vector (x, y) 2^exponent, with the larger coordinate, unless it is 0, from 1/2 to 1. */
typedef struct scaled_vector {
    double x, y;
    int exponent;
} scaled_vector;

static scaled_vector scaled_vector_to(mw_point p, mw_point r)
{
    double x = r.x - p.x, y = r.y - p.y;
    int halved = !(fabs(x) <= DBL_MAX && fabs(y) <= DBL_MAX), exponent;
    if (halved) {
        x = r.x / 2 - p.x / 2;
        y = r.y / 2 - p.y / 2;
    }
    frexp(fmax(fmax(fabs(x), fabs(y)), DBL_TRUE_MIN), &exponent);
    return (scaled_vector){ldexp(x, -exponent), ldexp(y, -exponent), exponent + halved};
}

/* Where on the segment is the point nearest to q? Exact. */
typedef enum edge_part { AT_A, AT_B, BETWEEN } edge_part;

static edge_part edge_nearest_part(const mw_border_edge *e, mw_point q)
{
    if (mw__dot2d(e->a, q, e->b) <= 0) return AT_A;
    return mw__dot2d(e->b, q, e->a) <= 0 ? AT_B : BETWEEN;
}

static double edge_scaled_area(const mw_border_edge *e, mw_point q, int shift)
{
    return fabs(mw__orient2d_exact((mw_point){ldexp(e->a.x, shift), ldexp(e->a.y, shift)},
                                   (mw_point){ldexp(e->b.x, shift), ldexp(e->b.y, shift)},
                                   (mw_point){ldexp(q.x, shift), ldexp(q.y, shift)}));
}

/* Of the triangle abq, whose angles at a and b are acute. Its area is exact up to one rounding;
 * where it would leave the range of doubles, the triangle is scaled first. Bits lost in scaling
 * down are below 2^-600, and the area is at least 2^-200 then. A coordinate overflows in scaling up
 * only where it is at least 2^423, and so |ab| at least 2^369: the height is below 2^-1000 / 2^369,
 * which rounds to 0 as the area of infinite coordinates does. */
#define SHIFT 600
static double edge_height(const mw_border_edge *e, mw_point q)
{
    int shift = 0;
    double area = fabs(mw__orient2d_exact(e->a, e->b, q));
    if (area == 0) return 0;
    if (area < 0x1p-1000) shift = SHIFT;
    if (area > 0x1p1000) shift = -SHIFT;
    if (shift) area = edge_scaled_area(e, q, shift);
    scaled_vector ab = scaled_vector_to(e->a, e->b);
    return ldexp(area / hypot(ab.x, ab.y), -2 * shift - ab.exponent);
}

/* Rounded only at the end; infinite where it is above the doubles. */
static double edge_distance(const mw_border_edge *e, mw_point q)
{
    switch (edge_nearest_part(e, q)) {
    case AT_A: return hypot(q.x - e->a.x, q.y - e->a.y);
    case AT_B: return hypot(q.x - e->b.x, q.y - e->b.y);
    case BETWEEN: break;
    }
    return edge_height(e, q);
}

/* Rounding errors of segment_rounded_distance, with u = 2^-53 and size = |ax| + |ay| + |bx| + |by|,
 * between 2^-400 and 2^400. Where an end of a segment moves, the distance changes by no more than
 * that: rounded differences to q, and the rounded b - a, are worth u size each. A dot or cross
 * product with b - a, divided by |b - a|, is off by 3u size, the other roundings of the height by
 * 3u size; a wrong sign takes a, b or the height for another that is as near up to 3u size.
 * Together that is below 2^-49 size. What underflows: at most 2^-1073 in a product, 2^-536 in its
 * root, or 2^-593 where it is divided by the length of a segment, which counts as a point if
 * shorter than 2^-480. */
#define ROUNDING 0x1p-49
#define POINT 0x1p-960

/* The distance of the segment ab to the origin. */
static double segment_rounded_distance(mw_point a, mw_point b)
{
    double x = b.x - a.x, y = b.y - a.y, square = x * x + y * y;
    if (square < POINT || x * a.x + y * a.y >= 0) return sqrt(a.x * a.x + a.y * a.y);
    if (x * b.x + y * b.y <= 0) return sqrt(b.x * b.x + b.y * b.y);
    return fabs(a.x * y - a.y * x) / sqrt(square);
}

/* The same where numbers are so large or so small that products would leave the range of doubles:
 * scaled first. */
static distance_range edge_scaled_bounds(const mw_border_edge *e, mw_point q)
{
    scaled_vector a = scaled_vector_to(q, e->a), b = scaled_vector_to(q, e->b);
    int k = a.exponent > b.exponent ? a.exponent : b.exponent, i = a.exponent - k,
        j = b.exponent - k;
    double d = segment_rounded_distance((mw_point){ldexp(a.x, i), ldexp(a.y, i)},
                                        (mw_point){ldexp(b.x, j), ldexp(b.y, j)});
    double low = ldexp(d - 4 * ROUNDING, k), high = ldexp(d + 4 * ROUNDING, k);
    /* what ldexp may have lost */
    return (distance_range){fmin(low, DBL_MAX) - DBL_TRUE_MIN, high + DBL_TRUE_MIN};
}

static distance_range edge_bounds(const mw_border_edge *e, mw_point q)
{
    mw_point a = {e->a.x - q.x, e->a.y - q.y}, b = {e->b.x - q.x, e->b.y - q.y};
    double size = fabs(a.x) + fabs(a.y) + fabs(b.x) + fabs(b.y);
    if (MW_UNLIKELY(!(size > 0x1p-400 && size < 0x1p400))) return edge_scaled_bounds(e, q);
    double d = segment_rounded_distance(a, b), off = ROUNDING * size;
    return (distance_range){d - off, d + off};
}

static void search_consider(border_search *s, const mw_border_edge *e)
{
    distance_range d = edge_bounds(e, s->q);
    if (d.low > s->most) return;
    if (s->best) {
        int order = mw__compare_distance(s->q, s->best->a, s->best->b, e->a, e->b);
        bool lower = e->triangle != s->best->triangle ? e->triangle < s->best->triangle
                                                      : e->edge < s->best->edge;
        if (order < 0 || (order == 0 && !lower)) return;
    }
    s->best = e;
    s->most = d.high;
}

/* A lower bound of the distance from q to anything in the box: finite, as the distance may be just
 * above the doubles and the best one just below. */
static double box_distance(const mw_box *box, mw_point q)
{
    double dx = fmax(fmax(box->low[0] - q.x, q.x - box->high[0]), 0);
    double dy = fmax(fmax(box->low[1] - q.y, q.y - box->high[1]), 0);
    return fmin(hypot(dx, dy), DBL_MAX) * (1 - 0x1p-49) - 0x1p-1070;
}

static void search_descend(border_search *s, uint32_t level, uint32_t index)
{
    const mw_border_tree *border = s->border;
    const mw_box_tree *tree = &border->tree;
    uint32_t below = level ? tree->level_boxes[level - 1] : border->edge_count;
    uint32_t first = index * MW_BOX_TREE_FANOUT,
             n = below - first < MW_BOX_TREE_FANOUT ? below - first : MW_BOX_TREE_FANOUT;
    if (level == 0) {
        for (uint32_t i = 0; i < n; i++) search_consider(s, &border->edge[first + i]);
        return;
    }
    uint32_t child[MW_BOX_TREE_FANOUT];
    double least[MW_BOX_TREE_FANOUT];
    for (uint32_t i = 0; i < n; i++) { /* nearest first */
        double d = box_distance(&tree->box[tree->first[level - 1] + first + i], s->q);
        uint32_t k = i;
        for (; k > 0 && least[k - 1] > d; k--) {
            least[k] = least[k - 1];
            child[k] = child[k - 1];
        }
        least[k] = d;
        child[k] = first + i;
    }
    for (uint32_t i = 0; i < n && !(least[i] > s->most); i++)
        search_descend(s, level - 1, child[i]);
}

static const mw_border_edge *border_edge_nearest(const mw_border_tree *border, mw_point q)
{
    border_search s = {.border = border, .q = q, .most = INFINITY};
    if (border->edge_count) search_descend(&s, border->tree.level_count - 1, 0);
    return s.best;
}

/* How far along ab the point nearest to q lies: 0 at a, 1 at b. Rounded, but exact at the ends. */
static double edge_share(const mw_border_edge *e, mw_point q)
{
    edge_part where = edge_nearest_part(e, q);
    if (where != BETWEEN) return where == AT_B;
    scaled_vector ab = scaled_vector_to(e->a, e->b), aq = scaled_vector_to(e->a, q);
    double along = (ab.x * aq.x + ab.y * aq.y) / (ab.x * ab.x + ab.y * ab.y);
    return fmin(fmax(ldexp(along, aq.exponent - ab.exponent), 0), 1);
}

/* Never beyond a and b, and so exact where they are equal. */
static double value_mix(double a, double b, double s)
{
    return fmin(fmax((1 - s) * a + s * b, fmin(a, b)), fmax(a, b));
}

/* The point of the edge nearest to q. */
static mw_point edge_foot(const mw_border_edge *e, mw_point q)
{
    double s = edge_share(e, q);
    if (s == 0) return e->a;
    if (s == 1) return e->b;
    return (mw_point){value_mix(e->a.x, e->b.x, s), value_mix(e->a.y, e->b.y, s)};
}

/* The weights, in the user's triangle, of the point of the border edge that is nearest to q. The
 * border edge may be only a part of the triangle's edge. The weights are computed from q itself:
 * the nearest point would have to be rounded, which is coarse far from the origin. */
static void edge_weights(const mw_mesh *mesh, const mw_border_edge *e, mw_point q, double weight[3])
{
    uint32_t v[3], next = mw__next(e->edge);
    mw_mesh_triangle(mesh, e->triangle, v);
    mw_border_edge whole = {mesh->point[mw__vertex_slot(mesh, v[e->edge])],
                            mesh->point[mw__vertex_slot(mesh, v[next])], e->triangle, e->edge};
    double one = edge_share(&whole, e->a), two = edge_share(&whole, e->b);
    double s = fmin(fmax(edge_share(&whole, q), fmin(one, two)), fmax(one, two));
    weight[e->edge] = 1 - s;
    weight[next] = s;
    weight[mw__prev(e->edge)] = 0;
}

bool mw__border_tree_nearest(const mw_border_tree *border, const mw_mesh *mesh, mw_point q,
                             mw_nearest_border_point *hit)
{
    const mw_border_edge *e = border_edge_nearest(border, q);
    if (!e) return false;
    mw_point at = edge_foot(e, q);
    *hit = (mw_nearest_border_point){e->triangle, e->edge, edge_distance(e, q), {at.x, at.y}, {0}};
    edge_weights(mesh, e, q, hit->weight);
    return true;
}

void mw__border_tree_apply_tolerance(const mw_border_tree *border, const mw_mesh *mesh, mw_point q,
                                     double tolerance, mw_location *location)
{
    const mw_border_edge *e = border_edge_nearest(border, q);
    if (!e || mw__compare_distance_to(q, e->a, e->b, tolerance) > 0) return;
    location->where = MW_NEAR;
    location->triangle = e->triangle;
    location->local = (uint8_t)e->edge;
    edge_weights(mesh, e, q, location->weight);
}
