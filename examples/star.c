/* star.c - a sphere of triangles: which of them lies under a place, by longitude and latitude or
 * by a direction. */
#include <meshwalk/meshwalk.h>
#include <stdio.h>
#include <stdlib.h>

enum { STEP = 10, PLACES = (360 / STEP) * (180 / STEP) };

static _Noreturn void fail(const mw_error *error)
{
    fprintf(stderr, "%s\n", error->message);
    exit(1);
}

/* An octahedron: four vertices on the equator, and the poles. */
static mw_surface *make_sphere(void)
{
    /* longitude, latitude */
    const double places[6][2] = {{0, 0}, {90, 0}, {180, 0}, {270, 0}, {0, 90}, {0, -90}};
    const uint32_t facets[] = {0, 1, 4, 1, 2, 4, 2, 3, 4, 3, 0, 4,
                               1, 0, 5, 2, 1, 5, 3, 2, 5, 0, 3, 5};
    double points[6][3];
    for (int i = 0; i < 6; i++) mw_lonlat_to_direction(places[i][0], places[i][1], points[i]);
    mw_arrays arrays = {
        .points = points[0], .point_count = 6, .triangles = facets, .triangle_count = 8};
    mw_surface *surface;
    mw_error error;
    if (mw_surface_create(&arrays, NULL, &surface, &error)) fail(&error);
    return surface;
}

static void show(const mw_star *star, mw_star_cursor *cursor, const double direction[3])
{
    double longitude, latitude;
    mw_direction_to_lonlat(direction, &longitude, &latitude);
    mw_location at = mw_star_locate(star, cursor, direction);
    printf("(%g, %g) %s of facet %u, weights %.3f %.3f %.3f\n", longitude, latitude,
           mw_where_name(at.where), at.triangle, at.weight[0], at.weight[1], at.weight[2]);
}

/* The middles of the cells of a grid in longitude and latitude, all at once: how many lie in each
 * facet. */
static void count_cells(const mw_star *star)
{
    static double directions[PLACES][3];
    static mw_location found[PLACES];
    uint32_t cells[8] = {0};
    mw_error error;
    for (int i = 0; i < PLACES; i++) {
        int column = i % (360 / STEP), row = i / (360 / STEP);
        mw_lonlat_to_direction(STEP * (column + 0.5) - 180, STEP * (row + 0.5) - 90, directions[i]);
    }
    if (mw_star_locate_batch(star, directions[0], PLACES, 3, NULL, found, NULL, &error))
        fail(&error);
    for (int i = 0; i < PLACES; i++) cells[found[i].triangle]++;
    printf("cells in each facet:");
    for (int f = 0; f < 8; f++) printf(" %u", cells[f]);
    printf("\n");
}

int main(void)
{
    mw_error error;
    mw_surface *surface = make_sphere();
    mw_star *star;
    mw_star_cursor cursor;
    if (mw_star_create(surface, NULL, &star, &error) ||
        mw_star_cursor_init(star, NULL, &cursor, &error))
        fail(&error);

    double vienna[3];
    mw_lonlat_to_direction(16.37, 48.21, vienna);
    show(star, &cursor, vienna);
    /* through the edge of facets 0 and 3: the lower one has it */
    show(star, &cursor, (double[3]){3, 0, 5});
    /* the south pole, where four facets meet */
    show(star, &cursor, (double[3]){0, 0, -100});
    count_cells(star);

    mw_star_destroy(star);
    mw_surface_destroy(surface);
    return 0;
}
