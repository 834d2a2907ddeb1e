/* outside.c - points outside a mesh and in its hole: which hole, how far, and the nearest border
 * edge. */
#include <meshwalk/meshwalk.h>
#include <stdio.h>

int main(void)
{
    /* A square frame: outer corners 0..3, inner corners 4..7, and a hole in the middle. */
    const double points[] = {0, 0, 6, 0, 6, 6, 0, 6, 2, 2, 4, 2, 4, 4, 2, 4};
    const uint32_t triangles[] = {0, 1, 5, 0, 5, 4, 1, 2, 6, 1, 6, 5,
                                  2, 3, 7, 2, 7, 6, 3, 0, 4, 3, 4, 7};
    mw_arrays arrays = {
        .points = points, .point_count = 8, .triangles = triangles, .triangle_count = 8};
    mw_locator_options with_border = {.border = 1};
    mw_query_options within_a_tenth = {.tolerance = 0.1};
    mw_error error;
    mw_mesh *mesh = NULL;
    mw_locator *locator = NULL;
    mw_cursor cursor;
    if (mw_mesh_create(&arrays, NULL, &mesh, &error) ||
        mw_locator_create(mesh, &with_border, &locator, &error) ||
        mw_cursor_init(locator, &within_a_tenth, &cursor, &error)) {
        fprintf(stderr, "%s\n", error.message);
        mw_locator_destroy(locator);
        mw_mesh_destroy(mesh);
        return 1;
    }

    const double queries[][2] = {{3, 1}, {3, 3.5}, {7, 3}, {6.0625, 3}};
    for (int i = 0; i < 4; i++) {
        double x = queries[i][0], y = queries[i][1];
        mw_location at = mw_locate(locator, &cursor, x, y);
        printf("(%g, %g) %s", x, y, mw_where_name(at.where));
        mw_nearest_border_point hit;
        if (at.where >= MW_OUTSIDE && mw_nearest_border(locator, x, y, &hit, &error) == MW_OK)
            printf(", %g from edge %u of triangle %u", hit.distance, hit.edge, hit.triangle);
        printf("\n");
    }
    mw_locator_destroy(locator);
    mw_mesh_destroy(mesh);
    return 0;
}
