#include "cli/stream/globe_points.h"
#include "cli/frame/message.h"
#include "cli/frame/progress.h"
#include "cli/input/lonlat_input.h"

#include <stdlib.h>
#include <string.h>

static const coordinates origin;

int globe_points_make(globe_points *g, const char *path, const mw_mesh_file *file, bool open,
                      uint32_t threads)
{
    const star_input_settings how = {
        .centre = &origin, .lonlat = true, .threads = threads, .open = open};
    const size_t bytes = 3 * file->point_count * sizeof *file->points;
    mw_mesh_file globe = *file;
    g->threads = threads;
    globe.points = malloc(bytes + 1);
    if (!globe.points) return fail_memory();
    memcpy(globe.points, file->points, bytes);
    const int end = star_input_make(&g->polyhedron, path, &globe, &how);
    free(globe.points);
    return end;
}

void globe_points_release(globe_points *g)
{
    star_input_release(&g->polyhedron);
}

int globe_points_locate(void *self, const query_block *block, mw_location *answers)
{
    const globe_points *g = self;
    const mw_star_query_options options = {.threads = g->threads, .progress = progress_of_call()};
    mw_error error;
    double *directions = malloc(3 * block->count * sizeof *directions + 1);
    if (!directions) return fail_memory();
    lonlat_input_directions(block->values, block->stride, block->count, origin.at, g->threads,
                            directions);
    const mw_status status = star_input_locate(&g->polyhedron, directions, 3, block->count,
                                               &options, answers, NULL, &error);
    free(directions);
    return status ? fail_query(&error) : 0;
}
