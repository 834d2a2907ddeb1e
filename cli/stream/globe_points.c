#include "cli/stream/globe_points.h"
#include "cli/frame/message.h"
#include "cli/frame/progress.h"
#include "cli/gdal/gdal_crs.h"
#include "cli/input/lonlat_input.h"

#include <stdlib.h>
#include <string.h>

static const coordinates origin;

/* With z, a mesh that does not say that it is in degrees may as well be a globe in space. */
static int globe_check(const char *path, const mw_mesh_file *file)
{
    if (!file->has_z || (file->crs && crs_is_lonlat(file->crs))) return 0;
    complain("%s: has z, and no coordinate system of longitudes and latitudes: are its x and y "
             "degrees, or places in space? --lonlat takes a mesh without z here",
             path);
    return END_INPUT;
}

int globe_points_make(globe_points *g, const char *path, const mw_mesh_file *file, bool open,
                      uint32_t threads)
{
    const star_input_settings how = {
        .centre = &origin, .lonlat = true, .threads = threads, .open = open};
    const size_t bytes = 3 * file->point_count * sizeof *file->points;
    mw_mesh_file globe = *file;
    int end = globe_check(path, file);
    if (end) return end;
    g->threads = threads;
    globe.has_z = 0;
    globe.points = malloc(bytes + 1);
    if (!globe.points) return fail_memory();
    if (bytes) memcpy(globe.points, file->points, bytes);
    end = star_input_make(&g->polyhedron, path, &globe, &how);
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
