#include "support/calls/call_inputs.h"

#include <math.h>
#include <meshwalk/io.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

/* The sides of a polygon round the middle of the square, and one across the whole. */
static void inputs_add_segments(call_inputs *in)
{
    enum { CORNERS = 5 };
    in->segments = malloc(2 * CORNERS * sizeof *in->segments);
    for (uint32_t i = 0; i < CORNERS; i++) {
        static const double at[CORNERS][2] = {
            {0.3, 0.3}, {0.7, 0.3}, {0.7, 0.6}, {0.5, 0.8}, {0.3, 0.6}};
        memcpy(in->points + 2 * i, at[i], sizeof at[i]);
        in->segments[2 * i] = i;
        in->segments[2 * i + 1] = (i + 1) % CORNERS;
    }
    in->segment_count = CORNERS;
}

static void inputs_add_space(call_inputs *in, uint32_t n, uint64_t *random)
{
    unsigned levels = 1;
    while ((8u << (2 * levels)) < n) levels++;
    in->ball = star_shape_octahedron(levels);
    star_shape_stretch(&in->ball, 3, random);
    star_shape_shuffle(&in->ball, random);
    mw_error error;
    mw_arrays view = star_shape_arrays(&in->ball);
    mw_prober_options boxes = {.boxes = 1, .threads = 1};
    expect_ok(mw_surface_create(&view, NULL, &in->surface, &error), "a surface", &error);
    expect_ok(mw_star_create(in->surface, NULL, &in->star, &error), "a star", &error);
    expect_ok(mw_prober_create(in->surface, &boxes, &in->prober, &error), "a prober", &error);
}

static void inputs_write_file(call_inputs *in)
{
    mw_error error;
    mw_arrays view = arrays_view(&in->plain);
    double *points = malloc(3 * view.point_count * sizeof *points);
    for (size_t i = 0; i < view.point_count; i++) {
        memcpy(points + 3 * i, view.points + 2 * i, 2 * sizeof *points);
        points[3 * i + 2] = 0;
    }
    mw_mesh_file file = {.points = points,
                         .point_count = view.point_count,
                         .triangles = in->plain.triangles,
                         .triangle_count = view.triangle_count};
    in->path = malloc(64);
    snprintf(in->path, 64, "long_calls_%ld.off", (long)getpid());
    expect_ok(mw_write_mesh(in->path, &file, NULL, NULL, &error), "a file", &error);
    free(points);
}

static mw_mesh *mesh_crowded(uint32_t n, uint64_t *random)
{
    double *points = malloc(2 * (size_t)n * sizeof *points);
    for (uint32_t i = 0; i < 2 * n; i++) points[i] = pow(random_unit(random), 12);
    mw_mesh *mesh = mesh_delaunay(points, n);
    free(points);
    return mesh;
}

static void inputs_write_lines(call_inputs *in)
{
    in->lines = malloc(64);
    snprintf(in->lines, 64, "long_calls_%ld.poly", (long)getpid());
    FILE *file = fopen(in->lines, "w");
    fprintf(file, "%u 2 0 0\n", in->point_count);
    for (uint32_t i = 0; i < in->point_count; i++)
        fprintf(file, "%u %.17g %.17g\n", i, in->points[2 * i], in->points[2 * i + 1]);
    fprintf(file, "%u 0\n", in->segment_count);
    for (uint32_t i = 0; i < in->segment_count; i++)
        fprintf(file, "%u %u %u\n", i, in->segments[2 * i], in->segments[2 * i + 1]);
    fprintf(file, "0\n");
    fclose(file);
}

call_inputs call_inputs_make(uint32_t n, uint64_t seed)
{
    uint64_t random = seed;
    call_inputs in = {.point_count = n, .points = malloc(2 * (size_t)n * sizeof(double))};
    mw_mesh_options alone = {.threads = 1};
    for (uint32_t i = 0; i < 2 * n; i++) in.points[i] = random_unit(&random);
    inputs_add_segments(&in);
    in.mesh = mesh_delaunay(in.points, n);
    in.whole = arrays_of_mesh(in.mesh);
    in.neighbours = mesh_neighbours(in.mesh);
    in.plain = arrays_of_mesh(in.mesh);
    arrays_punch(&in.plain, 0.1, &random);
    arrays_scramble(&in.plain, 1, &random);
    in.damaged = arrays_make(in.plain.point_count, in.plain.triangle_count + 1);
    for (uint32_t i = 0; i < in.plain.point_count; i++)
        arrays_point(&in.damaged, in.plain.points[2 * i], in.plain.points[2 * i + 1]);
    for (uint32_t t = 0; t < in.plain.triangle_count; t++) {
        const uint32_t *v = in.plain.triangles + 3 * t;
        arrays_triangle(&in.damaged, v[0], v[1], v[2]);
    }
    arrays_triangle(&in.damaged, 0, 1, 0);
    in.holed = arrays_mesh(&in.plain, alone);
    in.crowded = mesh_crowded(n, &random);
    in.locator = mesh_locator(in.mesh, (mw_locator_options){.threads = 1});
    inputs_add_space(&in, n, &random);
    inputs_write_file(&in);
    inputs_write_lines(&in);
    return in;
}

void call_inputs_release(call_inputs *in)
{
    unlink(in->path);
    unlink(in->lines);
    free(in->path);
    free(in->lines);
    mw_prober_destroy(in->prober);
    mw_star_destroy(in->star);
    mw_surface_destroy(in->surface);
    mw_locator_destroy(in->locator);
    mw_mesh_destroy(in->crowded);
    mw_mesh_destroy(in->holed);
    mw_mesh_destroy(in->mesh);
    star_shape_free(&in->ball);
    arrays_free(&in->damaged);
    arrays_free(&in->plain);
    arrays_free(&in->whole);
    free(in->neighbours);
    free(in->segments);
    free(in->points);
}
