/* triangulate.c - the table of kinds of triangulation, and what they share. */
#include "triangulate/kinds/kind_maker.h"
#include "base/options.h"

#include "mesh/connect.h"
#include "mesh/layout.h"
#include "mesh/mesh_order.h"
#include "triangulate/delaunay/delaunay.h"

#include <stdlib.h>

static const struct {
    const char *name, *source, *help;
    mw_make_kind *make;
} kinds[MW_KIND_COUNT] = {
#define MW_KIND_ENTRY(id, symbol, name, source, help)                                              \
    [MW_KIND_##id] = {name, source, help, mw__make_##symbol},
#include <meshwalk/kinds.def>
};

const char *mw_kind_name(mw_triangulation_kind kind)
{
    return (unsigned)kind < MW_KIND_COUNT ? kinds[kind].name : NULL;
}

const char *mw_kind_source(mw_triangulation_kind kind)
{
    return (unsigned)kind < MW_KIND_COUNT ? kinds[kind].source : NULL;
}

const char *mw_kind_help(mw_triangulation_kind kind)
{
    return (unsigned)kind < MW_KIND_COUNT ? kinds[kind].help : NULL;
}

mw_status mw__make_delaunay(mw_triangulation *t, const mw_kind_options *options,
                            mw_kind_report *report, mw_error *error)
{
    (void)t;
    (void)options;
    (void)report;
    (void)error;
    return MW_OK;
}

/* The direction from p to another point, scaled by a power of two so that products stay among the
 * doubles. */
static mw_point unit_direction(mw_point p, mw_point to)
{
    double x = to.x - p.x, y = to.y - p.y;
    if (!(fabs(x) <= DBL_MAX && fabs(y) <= DBL_MAX)) {
        x = to.x / 2 - p.x / 2;
        y = to.y / 2 - p.y / 2;
    }
    int exponent;
    frexp(fmax(fabs(x), fabs(y)), &exponent);
    return (mw_point){ldexp(x, -exponent), ldexp(y, -exponent)};
}

/* Of the angle at corner b: its cotangent, the smaller the larger the angle is. */
static double angle_cotangent(mw_point a, mw_point b, mw_point c)
{
    double ux = a.x - b.x, uy = a.y - b.y, vx = c.x - b.x, vy = c.y - b.y;
    double cross = fabs(ux * vy - uy * vx), sum = fabs(ux * vy) + fabs(uy * vx);
    if (MW_LIKELY(sum < 0x1p900 && cross > 0x1p-900)) return (ux * vx + uy * vy) / cross;
    mw_point u = unit_direction(b, a), v = unit_direction(b, c);
    return (u.x * v.x + u.y * v.y) / fabs(u.x * v.y - u.y * v.x);
}

static void triangulation_measure(const mw_triangulation *t, mw_kind_report *report)
{
    double least = INFINITY;
    for (uint32_t i = 0; i < t->tri_count; i++)
        for (uint32_t k = 0; k < 3; k++) {
            const mw_triangle *tri = &t->tri[i];
            mw_point a = t->point[tri->v[k]], b = t->point[tri->v[k + 1]],
                     c = t->point[tri->v[mw__prev(k)]];
            bool twice = tri->link[k] != MW_NONE && mw__link_triangle(tri->link[k]) < i;
            if (!twice) report->edge_length += hypot(b.x - a.x, b.y - a.y);
            least = fmin(least, angle_cotangent(a, b, c));
        }
    report->largest_angle = atan2(1, least);
}

/* Number the records along a Hilbert curve, and link them anew. */
static bool triangulation_lay_out(mw_triangulation *t)
{
    uint32_t *order = mw__alloc(t->tri_count, sizeof *order);
    mw_triangle *tri = mw__alloc_lines(t->tri_count, sizeof *tri);
    bool done = order && tri && mw__triangles_order(t->point, t->tri, t->tri_count, order);
    if (done) {
        for (uint32_t i = 0; i < t->tri_count; i++) {
            tri[i] = t->tri[order[i]];
            tri[i].user = i;
            for (uint32_t k = 0; k < 3; k++) tri[i].link[k] = MW_NONE;
        }
        free(t->tri);
        t->tri = tri;
        mw_job_span outer = mw__job_part(t->job, 0.1);
        done = mw__connect(t->tri, t->tri_count, t->point_count, t->job, NULL);
        mw__job_part_end(t->job, outer);
    } else {
        free(tri);
    }
    free(order);
    return done;
}

/* The mesh is a Delaunay triangulation: make it one of the kind. */
static mw_status kind_convert(mw_triangulation_kind kind, mw_mesh *mesh,
                              const mw_kind_options *options, mw_job *job, mw_kind_report *report,
                              mw_error *error)
{
    mw_triangulation t = {mesh->point, mesh->point_count, mesh->tri, mesh->tri_count, job};
    mw_job_span outer = mw__job_part(job, 0.9);
    mw_status status = kinds[kind].make(&t, options, report, error);
    mw__job_part_end(job, outer);
    if (status == MW_OK && kind != MW_KIND_DELAUNAY && !triangulation_lay_out(&t))
        status = mw__fail_memory(error);
    mesh->tri = t.tri;
    mesh->tri_count = t.tri_count;
    if (status == MW_OK) triangulation_measure(&t, report);
    return status;
}

/* The caller's points. */
typedef struct given_points {
    const double *points;
    size_t count, stride;
} given_points;

/* For a Delaunay triangulation that is most of the work, for other kinds little of it. */
static mw_status kind_make(mw_triangulation_kind kind, const given_points *given,
                           const mw_kind_options *options, mw_job *job, uint32_t *duplicate_of,
                           mw_kind_report *report, mw_mesh **out, mw_error *error)
{
    const bool plain = kind == MW_KIND_DELAUNAY;
    mw_job_span outer = mw__job_part(job, plain ? 0.9 : 0.2);
    mw_status status = mw__delaunay_mesh(job, plain, given->points, given->count, given->stride,
                                         duplicate_of, &report->delaunay, out, error);
    mw__job_part_end(job, outer);
    outer = mw__job_part(job, plain ? 0.05 : 0.75);
    if (!status) status = kind_convert(kind, *out, options, job, report, error);
    mw__job_part_end(job, outer);
    outer = mw__job_part(job, 0.05);
    if (!status && !mw__mesh_lay_out_vertices(*out, job)) status = mw__fail_memory(error);
    mw__job_part_end(job, outer);
    return status;
}

mw_status mw_triangulate(mw_triangulation_kind kind, const double *points, size_t n, size_t stride,
                         const mw_kind_options *options, uint32_t *duplicate_of,
                         mw_kind_report *report, mw_mesh **out, mw_error *error)
{
    static const mw_kind_options defaults;
    mw_kind_report made = {.optimal = 1};
    if (!out) return mw__fail(error, MW_ERROR_ARGUMENT, "the pointer to the new mesh is NULL");
    *out = NULL;
    if ((unsigned)kind >= MW_KIND_COUNT)
        return mw__fail(error, MW_ERROR_ARGUMENT, "unknown kind of triangulation");
    if (!options) options = &defaults;
    mw_status status = MW_RESERVED_CHECK(mw_kind_options, options, error);
    if (status) return status;
    mw_job job = mw__job(options->threads, options->progress);
    const given_points given = {points, n, stride};
    status = mw__job_end(
        &job, kind_make(kind, &given, options, &job, duplicate_of, &made, out, error), error);
    if (status) {
        mw_mesh_destroy(*out);
        *out = NULL;
    } else if (report) {
        *report = made;
    }
    return status;
}
