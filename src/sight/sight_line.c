#include "sight/sight_line.h"
#include "predicates/big.h"

/* Bound for the error of a ground height, relative to the heights of the triangle: each of its
 * three weights is off by less than 2^-40. */
#define SIGHT_GROUND_ERROR 0x1p-37

/* Roundings: one for each difference of coordinates, two for a cross product, one for its sum; one
 * for the difference of heights, one for its product, three for the two sums. Together fewer than
 * 16. */
#define SIGHT_ROUNDING (16 * 0x1p-53)

/* Doubles decide only between these limits: then no product overflows, and underflow is below the
 * error bound. */
#define SIGHT_LEAST 0x1p-700
#define SIGHT_MOST 0x1p200

static mw_point line_vertex(const mw_sight_line *line, uint32_t v)
{
    double p[2];
    mw_mesh_vertex(line->mesh, v, p);
    return (mw_point){p[0], p[1]};
}

mw_sight_level mw__sight_level(const mw_mesh *mesh, const double *heights, mw_point at,
                               uint32_t triangle, double ground, double offset)
{
    uint32_t v[3];
    double most = fabs(offset);
    if (triangle == MW_NONE) return (mw_sight_level){at, offset, 0, offset, MW_NONE};
    mw_mesh_triangle(mesh, triangle, v);
    for (int k = 0; k < 3; k++) most = fmax(most, fabs(heights[v[k]]));
    return (mw_sight_level){at, ground + offset, SIGHT_GROUND_ERROR * most, offset, triangle};
}

/* --- exactly ---------------------------------------------------------------------------------- */

/* The numbers of one test. Coordinates and heights are integers times these powers of two. */
typedef struct sight_scale {
    int plane, height;
    double coordinate[20], value[10];
    int coordinates, values;
} sight_scale;

static void scale_note_point(sight_scale *s, mw_point p)
{
    s->coordinate[s->coordinates++] = p.x;
    s->coordinate[s->coordinates++] = p.y;
}

static void scale_note_vertex(sight_scale *s, const mw_sight_line *line, uint32_t v)
{
    scale_note_point(s, line_vertex(line, v));
    s->value[s->values++] = line->heights[v];
}

static void scale_note_level(sight_scale *s, const mw_sight_line *line, const mw_sight_level *level)
{
    uint32_t v[3];
    scale_note_point(s, level->at);
    s->value[s->values++] = level->offset;
    if (level->triangle == MW_NONE) return;
    mw_mesh_triangle(line->mesh, level->triangle, v);
    for (int k = 0; k < 3; k++)
        if (!isnan(line->heights[v[k]]))
            scale_note_vertex(s, line, v[k]);
        else
            scale_note_point(s, line_vertex(line, v[k]));
}

static void scale_settle(sight_scale *s)
{
    s->plane = mw__big_base(s->coordinate, s->coordinates);
    s->height = mw__big_base(s->value, s->values);
}

/* (p - o) x (q - o) */
static void big_area(mw_big *r, const sight_scale *s, mw_point o, mw_point p, mw_point q)
{
    mw_big px, py, qx, qy;
    mw__big_difference(&px, p.x, o.x, s->plane);
    mw__big_difference(&py, p.y, o.y, s->plane);
    mw__big_difference(&qx, q.x, o.x, s->plane);
    mw__big_difference(&qy, q.y, o.y, s->plane);
    mw__big_cross(r, &px, &py, &qx, &qy);
}

/* *sum += factor * value */
static void big_add_product(mw_big *sum, const mw_big *factor, const mw_big *value)
{
    mw_big product;
    mw__big_multiply(&product, factor, value);
    mw__big_add(sum, sum, &product);
}

/* A level as a quotient with a positive divisor. */
typedef struct big_level {
    mw_big sum, divisor;
} big_level;

static void level_exactly(big_level *r, const sight_scale *s, const mw_sight_line *line,
                          const mw_sight_level *level)
{
    uint32_t v[3];
    mw_point p[3];
    mw_big value, area;
    mw__big_difference(&value, level->offset, 0, s->height);
    mw__big_unit(&r->divisor);
    r->sum = value;
    if (level->triangle == MW_NONE) return;
    mw_mesh_triangle(line->mesh, level->triangle, v);
    for (int k = 0; k < 3; k++) p[k] = line_vertex(line, v[k]);
    big_area(&r->divisor, s, p[0], p[1], p[2]);
    mw__big_multiply(&r->sum, &r->divisor, &value);
    for (int k = 0; k < 3; k++) {
        if (isnan(line->heights[v[k]])) continue; /* the point lies on the edge of the other two */
        mw__big_difference(&value, line->heights[v[k]], 0, s->height);
        big_area(&area, s, level->at, p[(k + 1) % 3], p[(k + 2) % 3]);
        big_add_product(&r->sum, &area, &value);
    }
    if (r->divisor.sign > 0) return;
    r->divisor.sign = -r->divisor.sign;
    r->sum.sign = -r->sum.sign;
}

/* (height - level) * level.divisor * other */
static void big_rise(mw_big *r, const big_level *level, double height, const sight_scale *s,
                     const mw_big *other)
{
    mw_big value, product;
    mw__big_difference(&value, height, 0, s->height);
    mw__big_multiply(&product, &level->divisor, &value);
    mw__big_subtract(&product, &product, &level->sum);
    mw__big_multiply(r, &product, other);
}

/* The sign of (zP - zA) of_p + (zQ - zA) of_q + (zB - zA) of_b, where the factors are known. */
static int rises_sign(const mw_sight_line *line, const sight_scale *s, const uint32_t *v, int n,
                      const mw_big of[2], const mw_big *of_b)
{
    big_level a, b;
    mw_big sum = {0}, rise, cross;
    level_exactly(&a, s, line, &line->a);
    level_exactly(&b, s, line, &line->b);
    for (int k = 0; k < n; k++) {
        big_rise(&rise, &a, line->heights[v[k]], s, &b.divisor);
        big_add_product(&sum, &rise, &of[k]);
    }
    mw__big_multiply(&rise, &b.sum, &a.divisor);
    mw__big_multiply(&cross, &a.sum, &b.divisor);
    mw__big_subtract(&rise, &rise, &cross);
    big_add_product(&sum, &rise, of_b);
    return sum.sign;
}

static int edge_sign_exactly(const mw_sight_line *line, uint32_t v, uint32_t w)
{
    sight_scale s = {0};
    mw_big of[2], of_b, turn;
    const uint32_t ends[2] = {v, w};
    mw_point a = line->a.at, b = line->b.at, p = line_vertex(line, v), q = line_vertex(line, w);
    scale_note_level(&s, line, &line->a);
    scale_note_level(&s, line, &line->b);
    scale_note_vertex(&s, line, v);
    scale_note_vertex(&s, line, w);
    scale_settle(&s);
    big_area(&of[0], &s, a, q, b);
    big_area(&of[1], &s, a, b, p);
    big_area(&of_b, &s, a, p, q);
    mw__big_add(&turn, &of[0], &of[1]);
    return turn.sign * rises_sign(line, &s, ends, 2, of, &of_b);
}

static int vertex_sign_exactly(const mw_sight_line *line, uint32_t v, double a, double b, double at)
{
    sight_scale s = {0};
    mw_big of[2], of_b;
    scale_note_level(&s, line, &line->a);
    scale_note_level(&s, line, &line->b);
    scale_note_vertex(&s, line, v);
    scale_settle(&s);
    mw__big_difference(&of[0], b, a, s.plane);
    mw__big_difference(&of_b, a, at, s.plane);
    return of[0].sign * rises_sign(line, &s, &v, 1, of, &of_b);
}

int mw__sight_level_sign(const mw_sight_line *line, const mw_sight_level *level)
{
    sight_scale s = {0};
    big_level exact;
    if (fabs(level->height) > 2 * level->unsure) return level->height > 0 ? 1 : -1;
    scale_note_level(&s, line, level);
    scale_settle(&s);
    level_exactly(&exact, &s, line, level);
    return exact.sum.sign;
}

/* --- in doubles ------------------------------------------------------------------------------- */

/* A sum of products of a difference of heights and a factor, and a bound for its rounding error. */
typedef struct sight_sum {
    double value, bound, most;
} sight_sum;

/* `size`: the factor with absolute values for its products; `unsure`: of the difference. */
static MW_INLINE void sum_add(sight_sum *s, double rise, double unsure, double factor, double size)
{
    s->value += rise * factor;
    s->bound += (SIGHT_ROUNDING * fabs(rise) + 2 * unsure) * size;
    s->most = fmax(s->most, fmax(fabs(rise), size));
}

static MW_INLINE bool sum_is_sure(const sight_sum *s)
{
    return s->bound > SIGHT_LEAST && s->most < SIGHT_MOST && fabs(s->value) > 2 * s->bound;
}

int mw__sight_edge_sign(const mw_sight_line *line, uint32_t v, uint32_t w)
{
    mw_point a = line->a.at, p = line_vertex(line, v), q = line_vertex(line, w);
    double za = line->a.height, unsure = line->a.unsure;
    double bx = line->b.at.x - a.x, by = line->b.at.y - a.y;
    double px = p.x - a.x, py = p.y - a.y, qx = q.x - a.x, qy = q.y - a.y;
    double p_left = bx * py, p_right = by * px, q_left = bx * qy, q_right = by * qx;
    double of_p = q_right - q_left, of_q = p_left - p_right, of_b = px * qy - py * qx;
    double size_p = fabs(q_left) + fabs(q_right), size_q = fabs(p_left) + fabs(p_right);
    double turn = of_p + of_q;
    sight_sum sum = {0};
    sum_add(&sum, line->heights[v] - za, unsure, of_p, size_p);
    sum_add(&sum, line->heights[w] - za, unsure, of_q, size_q);
    sum_add(&sum, line->b.height - za, unsure + line->b.unsure, of_b,
            fabs(px * qy) + fabs(py * qx));
    if (MW_LIKELY(sum_is_sure(&sum) && fabs(turn) > SIGHT_ROUNDING * (size_p + size_q)))
        return (sum.value > 0) == (turn > 0) ? 1 : -1;
    return edge_sign_exactly(line, v, w);
}

int mw__sight_vertex_sign(const mw_sight_line *line, uint32_t v)
{
    mw_point a = line->a.at, b = line->b.at, p = line_vertex(line, v);
    bool by_x = fabs(b.x / 2 - a.x / 2) >= fabs(b.y / 2 - a.y / 2);
    double from = by_x ? a.x : a.y, to = by_x ? b.x : b.y, at = by_x ? p.x : p.y;
    double za = line->a.height, unsure = line->a.unsure;
    sight_sum sum = {0};
    sum_add(&sum, line->heights[v] - za, unsure, to - from, fabs(to - from));
    sum_add(&sum, line->b.height - za, unsure + line->b.unsure, from - at, fabs(from - at));
    if (sum_is_sure(&sum)) return (sum.value > 0) == (to > from) ? 1 : -1;
    return vertex_sign_exactly(line, v, from, to, at);
}
