/* fuzz_star.c - an octahedron that is cut, folded and moved about, as a star-shaped polyhedron:
 * whatever is accepted answers each ray with the lowest facet that meets it, by exact predicates
 * over all facets; and the check agrees. */
#include <math.h>
#include <meshwalk/meshwalk.h>
#include <stdlib.h>
#include <string.h>

enum { MOST_POINTS = 40, MOST_FACETS = 60, RAYS = 12 };

typedef struct input {
    const uint8_t *byte;
    size_t left;
} input;

static uint32_t next(input *in)
{
    if (in->left == 0) return 0;
    in->left--;
    return *in->byte++;
}

typedef struct polyhedron {
    double point[3 * MOST_POINTS];
    uint32_t facet[3 * MOST_FACETS];
    uint32_t points, facets;
} polyhedron;

static void add_facet(polyhedron *p, uint32_t a, uint32_t b, uint32_t c)
{
    const uint32_t v[3] = {a, b, c};
    memcpy(p->facet + 3 * (size_t)p->facets++, v, sizeof v);
}

static uint32_t add_point(polyhedron *p, const double x[3])
{
    memcpy(p->point + 3 * (size_t)p->points, x, 3 * sizeof *x);
    return p->points++;
}

/* A vertex in the middle of facet t, which becomes three. */
static void cut_facet(polyhedron *p, uint32_t t, const double x[3])
{
    uint32_t *f = p->facet + 3 * (size_t)t, a = f[0], b = f[1], c = f[2], v = add_point(p, x);
    f[2] = v;
    add_facet(p, b, c, v);
    add_facet(p, c, a, v);
}

/* A facet a b v beside the edge ab of facet t, which keeps its edge; the facet across gets av and
 * vb in its place. */
static void cut_edge(polyhedron *p, uint32_t t, uint32_t k, const double x[3])
{
    uint32_t a = p->facet[3 * t + k], b = p->facet[3 * t + (k + 1) % 3];
    for (uint32_t u = 0; u < p->facets; u++)
        for (uint32_t j = 0; j < 3; j++) {
            uint32_t *f = p->facet + 3 * (size_t)u;
            if (u == t || f[j] != b || f[(j + 1) % 3] != a) continue;
            uint32_t y = f[(j + 2) % 3], v = add_point(p, x);
            const uint32_t whole[3] = {b, v, y};
            memcpy(f, whole, sizeof whole);
            add_facet(p, v, a, y);
            add_facet(p, b, a, v);
            return;
        }
}

static void make(polyhedron *p, input *in)
{
    static const double octahedron[18] = {64, 0,   0, -64, 0, 0,  0, 64, 0,
                                          0,  -64, 0, 0,   0, 64, 0, 0,  -64};
    static const uint32_t facets[24] = {0, 2, 4, 2, 1, 4, 1, 3, 4, 3, 0, 4,
                                        2, 0, 5, 1, 2, 5, 3, 1, 5, 0, 3, 5};
    memcpy(p->point, octahedron, sizeof octahedron);
    memcpy(p->facet, facets, sizeof facets);
    p->points = 6;
    p->facets = 8;
    while (in->left && p->points < MOST_POINTS && p->facets + 2 < MOST_FACETS) {
        uint32_t step = next(in), t = next(in) % p->facets, k = step / 8 % 3;
        const uint32_t *f = p->facet + 3 * (size_t)t;
        double x[3];
        for (int i = 0; i < 3; i++) {
            const double *a = p->point + 3 * (size_t)f[k] + i,
                         *b = p->point + 3 * (size_t)f[(k + 1) % 3] + i;
            const double *c = p->point + 3 * (size_t)f[(k + 2) % 3] + i;
            double along[4] = {(*a + *b) / 2, *a, 2 * *b - *a,
                               (*a + *b + 2 * *c) / 4}; /* middle, end, beyond, inside */
            x[i] = along[step / 32 % 4];
        }
        if (step % 4 == 0) cut_facet(p, t, x);
        if (step % 4 == 1) cut_edge(p, t, k, x);
        if (step % 4 == 2) { /* turn a facet round: any orientation is fine */
            uint32_t v = p->facet[3 * t];
            p->facet[3 * t] = p->facet[3 * t + 1];
            p->facet[3 * t + 1] = v;
        }
        if (step % 4 == 3) memcpy(p->point + 3 * (size_t)f[k], x, sizeof x);
    }
}

static const double *corner(const polyhedron *p, uint32_t t, uint32_t k)
{
    return p->point + 3 * (size_t)p->facet[3 * t + k % 3];
}

/* Does the ray from the origin through q meet facet t, which is not seen edge on? */
static int meets(const polyhedron *p, uint32_t t, const double q[3])
{
    static const double c[3] = {0, 0, 0};
    double volume = mw_orient3d(corner(p, t, 0), corner(p, t, 1), corner(p, t, 2), c);
    if (volume == 0) return 0;
    for (uint32_t k = 0; k < 3; k++) {
        double side = mw_orient3d(corner(p, t, k), corner(p, t, k + 1), q, c);
        if ((side > 0 && volume < 0) || (side < 0 && volume > 0)) return 0;
    }
    return 1;
}

static void check_rays(const polyhedron *p, const mw_star *star, input *in)
{
    for (int i = 0; i < RAYS; i++) {
        double q[3];
        uint32_t t = next(in) % p->facets, how = next(in), lowest = 0;
        for (uint32_t k = 0; k < 3; k++)
            q[k] = how % 2 ? corner(p, t, 0)[k] + (how / 2 % 3) * corner(p, t, 1)[k] +
                                 (how / 8 % 2) * corner(p, t, 2)[k]
                           : (double)(int8_t)(how * (k + 1) + t);
        if (q[0] == 0 && q[1] == 0 && q[2] == 0) continue;
        while (lowest < p->facets && !meets(p, lowest, q)) lowest++;
        for (int walk = 0; walk < MW_STAR_WALK_COUNT; walk++) {
            mw_star_query_options options = {
                .walk = (mw_star_walk_kind)walk, .start = MW_STAR_START_RANDOM, .seed = how};
            mw_star_cursor cursor;
            if (mw_star_cursor_init(star, &options, &cursor, NULL)) abort();
            mw_location found = mw_star_locate(star, &cursor, q);
            if (found.triangle != lowest || lowest == p->facets) abort();
        }
    }
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);
int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    polyhedron p;
    input in = {data, size};
    int weld = (int)(next(&in) % 2);
    make(&p, &in);
    mw_arrays arrays = {.points = p.point,
                        .point_count = p.points,
                        .triangles = p.facet,
                        .triangle_count = p.facets};
    mw_surface_options how = {.weld = weld};
    mw_star_options angles = {.angles = 1};
    mw_surface *surface = NULL;
    mw_star *star = NULL;
    mw_check check;
    mw_status accepted = mw_surface_create(&arrays, &how, &surface, NULL);
    if (accepted == MW_OK) accepted = mw_star_create(surface, &angles, &star, NULL);
    if (mw_star_check_arrays(&arrays, weld, NULL, &check, NULL)) abort();
    if (check.valid != (accepted == MW_OK)) abort();
    in = (input){data, size};
    if (star) check_rays(&p, star, &in);
    mw_check_release(&check);
    mw_star_destroy(star);
    mw_surface_destroy(surface);
    return 0;
}
