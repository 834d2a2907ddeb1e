/* touch_oracle.c - a line against all triangles in exact rationals. */
#include "oracle/touch_oracle.h"

#include <math.h>
#include <stdlib.h>

bool touch_oracle_finite(const double *p, size_t n)
{
    for (size_t i = 0; i < n; i++)
        if (!isfinite(p[i])) return false;
    return true;
}

/* out = a x b */
static void exact_cross(mpq_t out[3], mpq_t a[3], mpq_t b[3])
{
    mpq_t product;
    mpq_init(product);
    for (int k = 0; k < 3; k++) {
        mpq_mul(out[k], a[(k + 1) % 3], b[(k + 2) % 3]);
        mpq_mul(product, a[(k + 2) % 3], b[(k + 1) % 3]);
        mpq_sub(out[k], out[k], product);
    }
    mpq_clear(product);
}

static void exact_dot(mpq_t out, mpq_t a[3], mpq_t b[3])
{
    mpq_t product;
    mpq_init(product);
    mpq_set_ui(out, 0, 1);
    for (int k = 0; k < 3; k++) {
        mpq_mul(product, a[k], b[k]);
        mpq_add(out, out, product);
    }
    mpq_clear(product);
}

/* Triangle i, whose corners are at p relative to q. */
static void look_at_triangle(touch_oracle *o, uint32_t i, mpq_t p[3][3])
{
    mpq_t vector[3], edge[2][3], sum, side;
    int right = 0, left = 0;
    for (int k = 0; k < 3; k++) mpq_inits(vector[k], edge[0][k], edge[1][k], NULL);
    mpq_inits(sum, side, NULL);
    for (int k = 0; k < 3; k++) {
        exact_cross(vector, p[k], p[(k + 1) % 3]);
        exact_dot(side, o->m, vector);
        mpq_add(sum, sum, side);
        o->side[i][k] = (char)mpq_sgn(side);
        right |= mpq_sgn(side) < 0;
        left |= mpq_sgn(side) > 0;
    }
    o->met[i] = right != left;
    o->touched[i] = right && !left;
    if (o->met[i]) { /* t = n . p0 / n . m */
        for (int j = 0; j < 2; j++)
            for (int k = 0; k < 3; k++) mpq_sub(edge[j][k], p[j + 1][k], p[0][k]);
        exact_cross(vector, edge[0], edge[1]);
        exact_dot(side, vector, p[0]);
        mpq_div(o->t[i], side, sum);
    }
    for (int k = 0; k < 3; k++) mpq_clears(vector[k], edge[0][k], edge[1][k], NULL);
    mpq_clears(sum, side, NULL);
}

static touch_oracle oracle_make(const shape *s, const double query[6], bool through)
{
    size_t n = s->triangle_count;
    touch_oracle o = {.s = s, .count = s->triangle_count};
    o.met = calloc(n, 1);
    o.touched = calloc(n, 1);
    o.side = calloc(n, sizeof *o.side);
    o.t = calloc(n, sizeof *o.t);
    mpq_t p[3][3];
    mpq_init(o.square);
    for (int k = 0; k < 3; k++) {
        mpq_inits(o.m[k], o.q[k], p[k][0], p[k][1], p[k][2], NULL);
        mpq_set_d(o.q[k], query[k]);
        mpq_set_d(o.m[k], query[3 + k]);
        if (through) mpq_sub(o.m[k], o.m[k], o.q[k]);
    }
    exact_dot(o.square, o.m, o.m);
    for (uint32_t i = 0; i < n; i++) {
        int finite = 1;
        mpq_init(o.t[i]);
        for (int k = 0; k < 3; k++) {
            const double *v = s->points + 3 * (size_t)s->triangles[3 * (size_t)i + (uint32_t)k];
            finite = finite && touch_oracle_finite(v, 3);
            for (int c = 0; c < 3 && finite; c++) {
                mpq_set_d(p[k][c], v[c]);
                mpq_sub(p[k][c], p[k][c], o.q[c]);
            }
        }
        if (finite) look_at_triangle(&o, i, p);
    }
    for (int k = 0; k < 3; k++) mpq_clears(p[k][0], p[k][1], p[k][2], NULL);
    return o;
}

touch_oracle touch_oracle_make(const shape *s, const double query[6])
{
    return oracle_make(s, query, false);
}

touch_oracle touch_oracle_through(const shape *s, const double ends[6])
{
    return oracle_make(s, ends, true);
}

void touch_oracle_free(touch_oracle *o)
{
    for (uint32_t i = 0; i < o->count; i++) mpq_clear(o->t[i]);
    mpq_clear(o->square);
    for (int k = 0; k < 3; k++) mpq_clears(o->q[k], o->m[k], NULL);
    free(o->met);
    free(o->touched);
    free(o->side);
    free(o->t);
}

bool touch_oracle_in_reach(const touch_oracle *o, uint32_t i, double d)
{
    if (d == 0 || isinf(d)) return true;
    mpq_t away, limit;
    mpq_inits(away, limit, NULL);
    mpq_mul(away, o->t[i], o->t[i]);
    mpq_mul(away, away, o->square);
    mpq_set_d(limit, d);
    mpq_mul(limit, limit, limit);
    bool in = mpq_cmp(away, limit) <= 0;
    mpq_clears(away, limit, NULL);
    return in;
}

uint32_t touch_oracle_best(const touch_oracle *o, double d)
{
    uint32_t best = MW_NONE;
    mpq_t a, b;
    mpq_inits(a, b, NULL);
    for (uint32_t i = 0; i < o->count; i++) {
        if (!o->touched[i] || !touch_oracle_in_reach(o, i, d)) continue;
        mpq_abs(a, o->t[i]);
        if (best == MW_NONE || mpq_cmp(a, b) < 0) {
            best = i;
            mpq_set(b, a);
        }
    }
    mpq_clears(a, b, NULL);
    return best;
}

double touch_oracle_distance(const touch_oracle *o, uint32_t i)
{
    return mpq_get_d(o->t[i]) * sqrt(mpq_get_d(o->square));
}

/* Does edge k of triangle i hold the place where the line meets triangle `met`? */
static int edge_holds(const touch_oracle *o, uint32_t i, uint32_t k, uint32_t met)
{
    const uint32_t *v = o->s->triangles + 3 * (size_t)i;
    const double *end[2] = {o->s->points + 3 * (size_t)v[k],
                            o->s->points + 3 * (size_t)v[(k + 1) % 3]};
    if (!touch_oracle_finite(end[0], 3) || !touch_oracle_finite(end[1], 3)) return 0;
    mpq_t to[2][3], cross[3], dot;
    mpq_init(dot);
    for (int c = 0; c < 3; c++) {
        mpq_inits(to[0][c], to[1][c], cross[c], NULL);
        mpq_mul(dot, o->t[met], o->m[c]);
        mpq_add(dot, dot, o->q[c]); /* the place */
        for (int j = 0; j < 2; j++) {
            mpq_set_d(to[j][c], end[j][c]);
            mpq_sub(to[j][c], to[j][c], dot);
        }
    }
    exact_cross(cross, to[0], to[1]);
    exact_dot(dot, to[0], to[1]);
    int holds = !mpq_sgn(cross[0]) && !mpq_sgn(cross[1]) && !mpq_sgn(cross[2]) && mpq_sgn(dot) <= 0;
    for (int c = 0; c < 3; c++) mpq_clears(to[0][c], to[1][c], cross[c], NULL);
    mpq_clear(dot);
    return holds;
}

uint32_t touch_oracle_lowest_linked(const touch_oracle *o, const mw_surface *surface, uint32_t i)
{
    uint32_t lowest = i, depth = 0, *stack = calloc(3 * (size_t)o->count + 1, sizeof *stack);
    char *seen = calloc(o->count, 1);
    stack[depth++] = i;
    while (depth) {
        uint32_t t = stack[--depth];
        if (seen[t]) continue;
        seen[t] = 1;
        if (o->touched[t] && t < lowest) lowest = t;
        for (uint32_t k = 0; k < 3; k++) {
            uint32_t next = mw_surface_neighbour(surface, t, k, NULL);
            if (next != MW_NONE && !seen[next] && edge_holds(o, t, k, i)) stack[depth++] = next;
        }
    }
    free(stack);
    free(seen);
    return lowest;
}

int touch_oracle_where(const touch_oracle *o, uint32_t i, int *local)
{
    int zeros = 0, edge = 255, off = 0;
    for (int k = 0; k < 3; k++)
        if (o->side[i][k] == 0) {
            zeros++;
            edge = k;
        } else {
            off = k;
        }
    *local = zeros == 2 ? (off + 2) % 3 : edge;
    return zeros == 0 ? MW_INSIDE : zeros == 1 ? MW_ON_EDGE : MW_ON_VERTEX;
}
