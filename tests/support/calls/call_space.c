/* call_space.c - long calls: surfaces, stars and probers. */
#include "support/calls/call_runs.h"

#include <math.h>
#include <meshwalk/remesh.h>
#include <stdlib.h>

mw_status run_surface(const call_inputs *in, const call_setting *how, uint64_t *sum,
                      mw_error *error)
{
    mw_surface *surface;
    mw_arrays view = star_shape_arrays(&in->ball);
    mw_surface_options options = {.weld = 1, .progress = how->progress};
    mw_status status = mw_surface_create(&view, &options, &surface, error);
    call_expect(!status == (surface != NULL), "there is a surface");
    if (!status) call_sum(sum, mw_surface_triangle_count(surface));
    mw_surface_destroy(surface);
    return status;
}

mw_status run_surface_check(const call_inputs *in, const call_setting *how, uint64_t *sum,
                            mw_error *error)
{
    mw_check check;
    mw_arrays view = star_shape_arrays(&in->ball);
    mw_check_options options = {.threads = how->threads, .progress = how->progress};
    return call_check_made(mw_surface_check_arrays(&view, 0, &options, &check, error), &check, sum);
}

mw_status run_star_check(const call_inputs *in, const call_setting *how, uint64_t *sum,
                         mw_error *error)
{
    mw_check check;
    mw_arrays view = star_shape_arrays(&in->ball);
    mw_star_options options = {.threads = how->threads, .progress = how->progress};
    return call_check_made(mw_star_check_arrays(&view, 0, &options, &check, error), &check, sum);
}

mw_status run_star(const call_inputs *in, const call_setting *how, uint64_t *sum, mw_error *error)
{
    mw_star *star;
    mw_star_info info;
    mw_star_options options = {.angles = 1, .threads = how->threads, .progress = how->progress};
    mw_status status = mw_star_create(in->surface, &options, &star, error);
    call_expect(!status == (star != NULL), "there is a star");
    if (status) return status;
    mw_star_describe(star, &info);
    call_sum(sum, info.bytes);
    mw_star_destroy(star);
    return MW_OK;
}

mw_status run_star_borrowed(const call_inputs *in, const call_setting *how, uint64_t *sum,
                            mw_error *error)
{
    mw_star *star;
    mw_location *at = malloc(in->ball.points * sizeof *at);
    mw_star_options options = {.borrow = 1, .threads = how->threads, .progress = how->progress};
    mw_status status = mw_star_create(in->surface, &options, &star, error);
    call_expect(!status == (star != NULL), "there is a star");
    if (!status)
        status = mw_star_locate_batch(star, in->ball.point, in->ball.points, 3,
                                      &(mw_star_query_options){.threads = how->threads}, at, NULL,
                                      error);
    if (!status) call_sum_locations(sum, at, in->ball.points);
    free(at);
    mw_star_destroy(star);
    return status;
}

static mw_status star_index_run(const call_inputs *in, mw_star_start_kind start,
                                const call_setting *how, uint64_t *sum, mw_error *error)
{
    mw_star_index *index;
    mw_star_index_info info;
    mw_star_index_options options = {.progress = how->progress};
    mw_status status = mw_star_index_create(in->star, start, &options, &index, error);
    call_expect(!status == (index != NULL), "there is an index");
    if (status) return status;
    mw_star_index_describe(index, &info);
    call_sum(sum, info.cells);
    mw_star_index_destroy(index);
    return MW_OK;
}

mw_status run_star_grid(const call_inputs *in, const call_setting *how, uint64_t *sum,
                        mw_error *error)
{
    return star_index_run(in, MW_STAR_START_GRID, how, sum, error);
}

mw_status run_star_octahedron(const call_inputs *in, const call_setting *how, uint64_t *sum,
                              mw_error *error)
{
    return star_index_run(in, MW_STAR_START_OCTAHEDRON, how, sum, error);
}

mw_status run_star_batch(const call_inputs *in, const call_setting *how, uint64_t *sum,
                         mw_error *error)
{
    mw_location *at = malloc(in->ball.points * sizeof *at);
    mw_star_query_options options = {.threads = how->threads, .progress = how->progress};
    mw_status status = mw_star_locate_batch(in->star, in->ball.point, in->ball.points, 3, &options,
                                            at, NULL, error);
    if (!status) call_sum_locations(sum, at, in->ball.points);
    free(at);
    return status;
}

mw_status run_star_project(const call_inputs *in, const call_setting *how, uint64_t *sum,
                           mw_error *error)
{
    const size_t n = 3 * (size_t)in->ball.points;
    double *meeting = malloc(n * sizeof *meeting);
    mw_star_query_options options = {.threads = how->threads, .progress = how->progress};
    mw_status status = mw_star_project_batch(in->star, in->ball.point, in->ball.points, 3, &options,
                                             meeting, NULL, error);
    for (size_t i = 0; i < n && !status; i++) call_sum_number(sum, meeting[i]);
    free(meeting);
    return status;
}

/* An icosphere of level 6. */
mw_status run_remesh(const call_inputs *in, const call_setting *how, uint64_t *sum, mw_error *error)
{
    enum { LEVEL = 6, VERTICES = 10 * 4096 + 2, TRIANGLES = 20 * 4096 };
    double *points = malloc(3 * VERTICES * sizeof *points);
    uint32_t *triangles = malloc(3 * TRIANGLES * sizeof *triangles);
    mw_remesh_options options = {.threads = how->threads, .progress = how->progress};
    mw_status status = mw_star_remesh(in->star, LEVEL, &options, points, triangles, NULL, error);
    for (size_t i = 0; i < 3 * VERTICES && !status; i++) call_sum_number(sum, points[i]);
    free(points);
    free(triangles);
    return status;
}

mw_status run_icosphere(const call_inputs *in, const call_setting *how, uint64_t *sum,
                        mw_error *error)
{
    enum { LEVEL = 6, VERTICES = 10 * 4096 + 2, TRIANGLES = 20 * 4096 };
    double *points = malloc(3 * VERTICES * sizeof *points);
    uint32_t *triangles = malloc(3 * TRIANGLES * sizeof *triangles);
    mw_remesh_options options = {.threads = how->threads, .progress = how->progress};
    (void)in;
    mw_status status = mw_icosphere_create(LEVEL, &options, points, triangles, error);
    for (size_t i = 0; i < 3 * TRIANGLES && !status; i++) call_sum(sum, triangles[i]);
    free(points);
    free(triangles);
    return status;
}

mw_status run_deviation(const call_inputs *in, const call_setting *how, uint64_t *sum,
                        mw_error *error)
{
    mw_deviation d;
    mw_remesh_options options = {.threads = how->threads, .progress = how->progress};
    mw_status status = mw_surface_deviation(in->surface, in->prober, &options, &d, error);
    if (!status) call_sum_number(sum, d.at_most);
    return status;
}

mw_status run_prober(const call_inputs *in, const call_setting *how, uint64_t *sum, mw_error *error)
{
    mw_prober *prober;
    mw_prober_info info;
    mw_prober_options options = {
        .boxes = 1, .threads = how->threads, .progress = how->progress, .guide = 1};
    mw_status status = mw_prober_create(in->surface, &options, &prober, error);
    call_expect(!status == (prober != NULL), "there is a prober");
    if (status) return status;
    mw_prober_describe(prober, &info);
    call_sum(sum, info.bytes);
    mw_prober_destroy(prober);
    return MW_OK;
}

mw_status run_probe_batch(const call_inputs *in, const call_setting *how, uint64_t *sum,
                          mw_error *error)
{
    size_t n = in->ball.points / 4;
    mw_touch *touches = malloc(n * sizeof *touches);
    mw_probe_options options = {.certain = 1, .threads = how->threads, .progress = how->progress};
    mw_status status =
        mw_probe_batch(in->prober, in->ball.point, n, 6, &options, touches, NULL, error);
    for (size_t i = 0; i < n && !status; i++) call_sum(sum, touches[i].triangle);
    free(touches);
    return status;
}

mw_status run_probe_any(const call_inputs *in, const call_setting *how, uint64_t *sum,
                        mw_error *error)
{
    size_t n = in->ball.points / 4;
    uint8_t *states = malloc(n);
    mw_probe_options options = {.certain = 1, .threads = how->threads, .progress = how->progress};
    mw_status status =
        mw_probe_any_batch(in->prober, in->ball.point, n, 6, &options, states, NULL, error);
    for (size_t i = 0; i < n && !status; i++) call_sum(sum, states[i]);
    free(states);
    return status;
}

mw_status run_probe_all(const call_inputs *in, const call_setting *how, uint64_t *sum,
                        mw_error *error)
{
    size_t n = in->ball.points / 4;
    mw_touch_lists lists;
    mw_probe_options options = {.certain = 1, .threads = how->threads, .progress = how->progress};
    mw_status status =
        mw_probe_all_batch(in->prober, in->ball.point, n, 6, &options, &lists, NULL, error);
    call_expect(!status || (!lists.offset && !lists.touch), "there are no touches");
    for (size_t i = 0; i < lists.touch_count; i++) call_sum(sum, lists.touch[i].triangle);
    mw_touch_lists_release(&lists);
    return status;
}

mw_status run_nearest_batch(const call_inputs *in, const call_setting *how, uint64_t *sum,
                            mw_error *error)
{
    size_t n = in->ball.points / 2;
    mw_nearest_surface_point *at = malloc(n * sizeof *at);
    mw_nearest_options options = {.threads = how->threads, .progress = how->progress};
    mw_status status = mw_nearest_on_surface_batch(in->prober, in->ball.point, n, 6, INFINITY,
                                                   &options, at, error);
    for (size_t i = 0; i < n && !status; i++) {
        call_sum(sum, at[i].triangle);
        call_sum_number(sum, at[i].point[0]);
    }
    free(at);
    return status;
}
