/* plane.c - hostile meshes of the plane. */
#include "hostile/hostile.h"
#include "oracle/domain_oracle.h"
#include "support/point_sets.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static bool has_area(const arrays *a)
{
    domain_spot corner[3];
    for (uint32_t t = 0; t < a->triangle_count; t++)
        if (domain_oracle_corners(a, t, corner)) return true;
    return false;
}

/* --- soups ------------------------------------------------------------------------------------ */

static arrays soup_of_triples(uint64_t *random)
{
    uint32_t side = 2 + mw__random_below(random, 6), points = 3 + mw__random_below(random, 9);
    arrays a = arrays_make(points, 8);
    for (uint32_t i = 0; i < points; i++)
        arrays_point(&a, mw__random_below(random, side), mw__random_below(random, side));
    uint32_t triangles = 1 + mw__random_below(random, 7);
    for (uint32_t t = 0; t < triangles; t++)
        arrays_triangle(&a, mw__random_below(random, points), mw__random_below(random, points),
                        mw__random_below(random, points));
    return a;
}

/* An embedding on a lattice. */
static arrays soup_lattice(uint64_t *random)
{
    arrays a = arrays_grid(1 + mw__random_below(random, 7), 0, random);
    if (mw__random_below(random, 2)) arrays_punch(&a, 0.5 * random_unit(random), random);
    arrays_scramble(&a, (int)mw__random_below(random, 2), random);
    return a;
}

/* One change that may, or may not, spoil an embedding. */
static void soup_damage(arrays *a, uint64_t *random)
{
    uint32_t t = mw__random_below(random, a->triangle_count),
             v = mw__random_below(random, a->point_count);
    uint32_t *corner = a->triangles + 3 * (size_t)t;
    switch (mw__random_below(random, 4)) {
    case 0: corner[mw__random_below(random, 3)] = v; break;
    case 1: memcpy(corner, a->triangles, 3 * sizeof *corner); break;
    case 2: a->points[2 * (size_t)v] += 1; break;
    default: a->points[2 * (size_t)v + 1] -= mw__random_below(random, 3); break;
    }
}

void hostile_soup(uint64_t *random)
{
    bool triples = mw__random_below(random, 2);
    arrays a = triples ? soup_of_triples(random) : soup_lattice(random);
    for (uint32_t n = triples ? 0 : mw__random_below(random, 3); n > 0; n--)
        soup_damage(&a, random);
    bool embedding = domain_oracle_is_embedding(&a);
    mw_arrays view = arrays_view(&a);
    mw_check check;
    mw_error error;
    expect_ok(mw_check_arrays(&view, NULL, &check, &error), "a check", &error);
    if ((check.valid != 0) != embedding)
        hostile_failed(embedding ? "an embedding is refused" : "a soup is taken for an embedding");
    if (!embedding && check.defect_count == 0) hostile_failed("refused without a defect");
    mw_check_release(&check);
    if (embedding && has_area(&a)) hostile_check_answers(&a, random);
    arrays_free(&a);
}

/* --- Delaunay meshes of hostile points -------------------------------------------------------- */

static void check_points(const double *points, uint32_t n, uint64_t *random)
{
    mw_mesh *mesh;
    mw_error error;
    mw_delaunay_options options = {.threads = 1 + mw__random_below(random, 2)};
    mw_status status = mw_delaunay(points, n, 2, &options, NULL, NULL, &mesh, &error);
    if (status == MW_ERROR_INPUT) return; /* all on a line */
    expect_ok(status, "a triangulation", &error);
    arrays a = arrays_of_mesh(mesh);
    mw_mesh_destroy(mesh);
    if (mw__random_below(random, 2)) arrays_punch(&a, 0.3 * random_unit(random), random);
    arrays_scramble(&a, (int)mw__random_below(random, 2), random);
    hostile_check_answers(&a, random);
    arrays_free(&a);
}

/* Rings round a point, each smaller than the one before by the same factor. */
void hostile_graded(uint64_t *random)
{
    enum { MOST = 160 };
    double points[2 * MOST], centre = mw__random_below(random, 2) ? 0 : random_unit(random);
    double radius = 1, factor = pow(10, -3 * random_unit(random));
    uint32_t each = 3 + mw__random_below(random, 6), n = 20 + mw__random_below(random, MOST - 20);
    for (uint32_t i = 0; i < n; i++) {
        if (i % each == 0) radius *= factor;
        double angle = 6.28318530717958648 * ((i % each) + 0.3 * random_unit(random)) / each;
        points[2 * i] = centre + radius * cos(angle);
        points[2 * i + 1] = centre + radius * sin(angle);
    }
    check_points(points, n, random);
}

/* Points on circles or lines round a few centres: each centre has a triangle for nearly each. */
void hostile_hubs(uint64_t *random)
{
    enum { MOST = 150 };
    double points[2 * MOST];
    uint32_t hubs = 1 + mw__random_below(random, 4), n = 12 + mw__random_below(random, MOST - 12);
    bool circles = mw__random_below(random, 2);
    for (uint32_t i = 0; i < n; i++) {
        double x = 8 * (i % hubs), angle = 6.28318530717958648 * random_unit(random);
        bool centre = i < hubs;
        points[2 * i] = centre    ? x
                        : circles ? x + 3 * cos(angle)
                                  : mw__random_below(random, 1 << 20);
        points[2 * i + 1] = centre    ? -1e3
                            : circles ? 3 * sin(angle) - 1e3
                                      : 1e-9 * mw__random_below(random, 3);
    }
    check_points(points, n, random);
}

/* One of the hard sets, or random exponents for each coordinate, scaled to anywhere. */
void hostile_exponents(uint64_t *random)
{
    enum { MOST = 60 };
    mw_point point[MOST];
    double points[2 * MOST];
    uint32_t n = 6 + mw__random_below(random, MOST - 6), wide = mw__random_below(random, 2);
    point_set_fill(&point_sets[mw__random_below(random, POINT_SETS)], mw__random(random), point, n);
    int shift = (int)mw__random_below(random, 2000) - 1000,
        spread = wide ? (int)mw__random_below(random, 900) : 0;
    for (uint32_t i = 0; i < 2 * n; i++) {
        double x = i % 2 ? point[i / 2].y : point[i / 2].x;
        int own = spread ? (int)mw__random_below(random, (uint32_t)(2 * spread + 1)) - spread : 0;
        x = ldexp(x, shift + own);
        points[i] = isfinite(x) ? x : copysign(0x1p1000, x);
    }
    check_points(points, n, random);
}
