/* sight_oracle.c - the line is clipped by each triangle; at both ends of a part that is longer than
 * a point, the plane of the triangle is compared with the line. */
#include "oracle/sight/sight_oracle.h"
#include "oracle/location_oracle.h"

#include <gmp.h>
#include <math.h>
#include <stdbool.h>

typedef struct space_point {
    mpq_t x, y, z;
} space_point;

static void space_init(space_point *p)
{
    mpq_inits(p->x, p->y, p->z, NULL);
}

static void space_clear(space_point *p)
{
    mpq_clears(p->x, p->y, p->z, NULL);
}

/* r = (q - p) x (s - p) in the plane */
static void space_area(mpq_t r, const space_point *p, const space_point *q, const space_point *s)
{
    mpq_t u, v;
    mpq_inits(u, v, NULL);
    mpq_sub(u, q->x, p->x);
    mpq_sub(v, s->y, p->y);
    mpq_mul(r, u, v);
    mpq_sub(u, q->y, p->y);
    mpq_sub(v, s->x, p->x);
    mpq_mul(u, u, v);
    mpq_sub(r, r, u);
    mpq_clears(u, v, NULL);
}

/* False: a corner has no height, known[k]. */
static bool terrain_corners(const sight_terrain *t, uint32_t triangle, space_point p[3],
                            bool known[3])
{
    for (int k = 0; k < 3; k++) {
        uint32_t v = t->triangles[3 * (size_t)triangle + (size_t)k];
        mpq_set_d(p[k].x, t->points[2 * (size_t)v]);
        mpq_set_d(p[k].y, t->points[2 * (size_t)v + 1]);
        known[k] = !isnan(t->heights[v]);
        mpq_set_d(p[k].z, known[k] ? t->heights[v] : 0);
    }
    return known[0] && known[1] && known[2];
}

/* The height of the plane of three points at another; false if one that it depends on has none. */
static bool plane_height(mpq_t z, const space_point p[3], const bool known[3],
                         const space_point *at)
{
    bool good = true;
    mpq_t area, part;
    mpq_inits(area, part, NULL);
    mpq_set_ui(z, 0, 1);
    for (int k = 0; k < 3; k++) {
        space_area(part, at, &p[(k + 1) % 3], &p[(k + 2) % 3]);
        mpq_add(area, area, part);
        good = good && (known[k] || mpq_sgn(part) == 0);
        mpq_mul(part, part, p[k].z);
        mpq_add(z, z, part);
    }
    mpq_div(z, z, area);
    mpq_clears(area, part, NULL);
    return good;
}

/* The place and height of an end. As sight_oracle_end. */
static int end_place(const sight_terrain *t, const mw_sight_end *end, space_point *place)
{
    space_point p[3];
    mpq_t ground;
    bool known[3];
    const double at[2] = {end->x, end->y};
    uint32_t triangle = location_oracle_locate(t->points, t->triangles, t->count, at).triangle;
    int found = -1;
    mpq_init(ground);
    for (int k = 0; k < 3; k++) space_init(&p[k]);
    mpq_set_d(place->x, end->x);
    mpq_set_d(place->y, end->y);
    mpq_set_d(place->z, end->height);
    if (triangle != MW_NONE) terrain_corners(t, triangle, p, known);
    if (triangle != MW_NONE && plane_height(ground, p, known, place)) {
        if (!end->absolute) mpq_add(place->z, place->z, ground);
        found = mpq_cmp(place->z, ground) >= 0;
    }
    for (int k = 0; k < 3; k++) space_clear(&p[k]);
    mpq_clear(ground);
    return found;
}

int sight_oracle_end(const sight_terrain *terrain, const mw_sight_end *end)
{
    space_point place;
    space_init(&place);
    int found = end_place(terrain, end, &place);
    space_clear(&place);
    return found;
}

/* r = a + t (b - a) */
static void line_at(space_point *r, const space_point *a, const space_point *b, const mpq_t t)
{
    mpq_sub(r->x, b->x, a->x);
    mpq_sub(r->y, b->y, a->y);
    mpq_sub(r->z, b->z, a->z);
    mpq_mul(r->x, r->x, t);
    mpq_mul(r->y, r->y, t);
    mpq_mul(r->z, r->z, t);
    mpq_add(r->x, r->x, a->x);
    mpq_add(r->y, r->y, a->y);
    mpq_add(r->z, r->z, a->z);
}

/* The part from[0] .. from[1] of the line in a triangle. False: at most a point. */
static bool triangle_clip(const space_point p[3], const space_point *a, const space_point *b,
                          mpq_t range[2])
{
    mpq_t turn, of_a, of_b, t;
    mpq_inits(turn, of_a, of_b, t, NULL);
    space_area(turn, &p[0], &p[1], &p[2]);
    int way = mpq_sgn(turn);
    bool some = way != 0;
    mpq_set_ui(range[0], 0, 1);
    mpq_set_ui(range[1], 1, 1);
    for (int k = 0; some && k < 3; k++) {
        int from = way > 0 ? k : (k + 1) % 3, to = way > 0 ? (k + 1) % 3 : k;
        space_area(of_a, &p[from], &p[to], a);
        space_area(of_b, &p[from], &p[to], b);
        int sign_a = mpq_sgn(of_a), sign_b = mpq_sgn(of_b);
        some = sign_a >= 0 || sign_b >= 0;
        if (!some || (sign_a >= 0 && sign_b >= 0)) continue;
        mpq_sub(t, of_a, of_b);
        mpq_div(t, of_a, t);
        if (sign_a < 0 && mpq_cmp(t, range[0]) > 0) mpq_set(range[0], t);
        if (sign_b < 0 && mpq_cmp(t, range[1]) < 0) mpq_set(range[1], t);
    }
    some = some && mpq_cmp(range[0], range[1]) < 0;
    mpq_clears(turn, of_a, of_b, t, NULL);
    return some;
}

static bool triangle_hides(const space_point p[3], const space_point *a, const space_point *b)
{
    mpq_t range[2], z;
    space_point at;
    bool hides = false;
    mpq_inits(range[0], range[1], z, NULL);
    space_init(&at);
    if (triangle_clip(p, a, b, range))
        for (int end = 0; end < 2; end++) {
            line_at(&at, a, b, range[end]);
            plane_height(z, p, (const bool[]){true, true, true}, &at);
            hides = hides || mpq_cmp(z, at.z) > 0;
        }
    mpq_clears(range[0], range[1], z, NULL);
    space_clear(&at);
    return hides;
}

mw_sight_state sight_oracle(const sight_terrain *terrain, const mw_sight_end *from,
                            const mw_sight_end *to)
{
    space_point a, b, p[3];
    bool hidden = false, known[3];
    space_init(&a);
    space_init(&b);
    for (int k = 0; k < 3; k++) space_init(&p[k]);
    end_place(terrain, from, &a);
    end_place(terrain, to, &b);
    for (uint32_t t = 0; t < terrain->count; t++)
        hidden = hidden || (terrain_corners(terrain, t, p, known) && triangle_hides(p, &a, &b));
    space_clear(&a);
    space_clear(&b);
    for (int k = 0; k < 3; k++) space_clear(&p[k]);
    return hidden ? MW_SIGHT_HIDDEN : MW_SIGHT_VISIBLE;
}
