/* star_remesh.c - a star-shaped polyhedron sampled on an icosphere. */
#include "base/options.h"
#include "remesh/icosphere.h"
#include "star/query/star_locate.h"

#include <math.h>
#include <stdlib.h>

/* A power of two, at least 1 and at least half of the centre's largest coordinate: so far from the
 * centre, rounding a point hardly turns its ray. */
static double sphere_radius(const double centre[3])
{
    int exponent;
    frexp(fmax(fmax(fabs(centre[0]), fabs(centre[1])), fabs(centre[2])), &exponent);
    return exponent > 0 ? ldexp(1, exponent - 1) : 1;
}

/* Points on the unit sphere become points on rays from the centre. */
typedef struct sphere_move {
    double *points, radius;
    const double *centre;
} sphere_move;

static void points_move(void *work, uint64_t begin, uint64_t end)
{
    const sphere_move *move = work;
    for (uint64_t i = begin; i < end; i++)
        for (size_t k = 0; k < 3; k++)
            move->points[3 * i + k] = move->centre[k] + move->radius * move->points[3 * i + k];
}

/* What the call works on; `rays` has its own points. */
typedef struct star_sampling {
    const mw_star *star;
    uint32_t level, vertices;
    double *through; /* a point on each ray */
    uint32_t *triangles;
    mw_star_rays rays;
} star_sampling;

static mw_status sampling_run(star_sampling *s, mw_job *job, mw_error *error)
{
    mw_counters counters = {0};
    mw_job_span outer = mw__job_part(job, 0.15);
    bool made = mw__icosphere_fill(s->level, s->through, s->triangles, job);
    mw__job_part_end(job, outer);
    if (!made) return mw__fail_memory(error);
    mw__job_stage(job, "placing rays", 0.05);
    sphere_move move = {s->through, sphere_radius(s->star->centre), s->star->centre};
    if (!mw__job_ranges(job, s->vertices, points_move, &move)) return mw__fail_memory(error);
    outer = mw__job_part(job, 0.8);
    mw_status status = mw__star_answer_rays(s->star, &s->rays, job, &counters, error);
    mw__job_part_end(job, outer);
    return status;
}

mw_status mw_star_remesh(const mw_star *star, uint32_t level, const mw_remesh_options *options,
                         double *points, uint32_t *triangles, mw_location *locations,
                         mw_error *error)
{
    static const mw_remesh_options defaults;
    uint32_t vertices, count;
    if (!star || !points)
        return mw__fail(error, MW_ERROR_ARGUMENT, "the star or the points are NULL");
    if (!options) options = &defaults;
    mw_status status = MW_RESERVED_CHECK(mw_remesh_options, options, error);
    if (!status) status = mw_icosphere_size(level, &vertices, &count, error);
    if (status) return status;
    if (!mw_star_ready(star))
        return mw__fail(error, MW_ERROR_ARGUMENT,
                        "the star is not up to date: call mw_star_update()");
    const mw_star_query_options query = {.threads = options->threads};
    double *through = mw__alloc(vertices, 3 * sizeof *through);
    mw_location *own = locations ? NULL : mw__alloc(vertices, sizeof *own);
    star_sampling s = {.star = star,
                       .level = level,
                       .vertices = vertices,
                       .through = through,
                       .triangles = triangles,
                       .rays = {through, vertices, 3, &query, own ? own : locations, points}};
    mw_job job = mw__job(options->threads, options->progress);
    status = through && (locations || own) ? sampling_run(&s, &job, error) : mw__fail_memory(error);
    free(through);
    free(own);
    return mw__job_end(&job, status, error);
}
