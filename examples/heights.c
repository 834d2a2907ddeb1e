/* heights.c - read a terrain, triangulate it, and find the heights of many positions in one call.
 *
 *     heights TERRAIN.csv POSITIONS.csv > heights.csv
 *
 * Positions outside the terrain get an empty height. */
#include <meshwalk/meshwalk.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

/* A whole file of points as one array, `*width` doubles per point; release with free(). */
static double *read_points(const char *path, size_t *width, size_t *count, mw_error *error)
{
    mw_point_reader *reader;
    if (mw_point_reader_open(path, NULL, &reader, error)) return NULL;
    *width = mw_point_reader_width(reader);
    *count = 0;

    double *values = NULL;
    for (size_t room = 0, got = 1; got > 0; *count += got) {
        if (*count == room) {
            room = room ? 2 * room : 4096;
            double *more = realloc(values, room * *width * sizeof *more);
            if (!more) snprintf(error->message, sizeof error->message, "out of memory");
            if (!more) goto failed;
            values = more;
        }
        if (mw_point_reader_read(reader, values + *count * *width, room - *count, &got, error))
            goto failed;
    }
    mw_point_reader_close(reader);
    return values;

failed:
    mw_point_reader_close(reader);
    free(values);
    return NULL;
}

/* Heights of n positions; NaN outside the terrain. */
static int sample(const double *terrain, size_t vertices, size_t terrain_width,
                  const double *positions, size_t n, size_t width, double *height, mw_error *error)
{
    mw_mesh *mesh = NULL;
    mw_locator *locator = NULL;
    mw_location *location = malloc(n * sizeof *location);
    int failed = !location ||
                 mw_delaunay(terrain, vertices, terrain_width, NULL, NULL, NULL, &mesh, error) ||
                 mw_mesh_set_field(mesh, "z", terrain + 2, terrain_width, error) ||
                 mw_locator_create(mesh, NULL, &locator, error) ||
                 mw_locate_batch(locator, positions, n, width, NULL, location, NULL, error);
    if (!failed) mw_interpolate(mesh, mw_mesh_field(mesh, "z"), location, n, height);
    mw_locator_destroy(locator);
    mw_mesh_destroy(mesh);
    free(location);
    return failed;
}

int main(int argc, char **argv)
{
    if (argc != 3) {
        fprintf(stderr, "usage: heights TERRAIN.csv POSITIONS.csv\n");
        return 2;
    }
    mw_error error = {.message = "out of memory"};
    size_t vertices, terrain_width, n, width;
    double *terrain = read_points(argv[1], &terrain_width, &vertices, &error);
    double *positions = terrain ? read_points(argv[2], &width, &n, &error) : NULL;
    double *height = positions ? malloc(n * sizeof *height) : NULL;
    int failed =
        !height || sample(terrain, vertices, terrain_width, positions, n, width, height, &error);
    if (failed) fprintf(stderr, "heights: %s\n", error.message);

    for (size_t i = 0; !failed && i < n; i++) {
        printf("%.3f,%.3f,", positions[width * i], positions[width * i + 1]);
        if (!isnan(height[i])) printf("%.2f", height[i]);
        printf("\n");
    }
    free(height);
    free(positions);
    free(terrain);
    return failed;
}
