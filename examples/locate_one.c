/* locate_one.c - a mesh from your own arrays, and the triangle that holds a point. */
#include <meshwalk/meshwalk.h>
#include <stdio.h>

int main(void)
{
    /*  3-----2   Two triangles that share an edge. */
    /*  | 1 / |                                     */
    /*  | / 0 |                                     */
    /*  0-----1                                     */
    const double points[] = {0, 0, 4, 0, 4, 4, 0, 4};
    const uint32_t triangles[] = {0, 1, 2, 0, 2, 3};
    mw_arrays arrays = {
        .points = points, .point_count = 4, .triangles = triangles, .triangle_count = 2};

    mw_error error;
    mw_mesh *mesh = NULL;
    mw_locator *locator = NULL;
    mw_cursor cursor;
    if (mw_mesh_create(&arrays, NULL, &mesh, &error) ||
        mw_locator_create(mesh, NULL, &locator, &error) ||
        mw_cursor_init(locator, NULL, &cursor, &error)) {
        fprintf(stderr, "%s\n", error.message);
        mw_locator_destroy(locator);
        mw_mesh_destroy(mesh);
        return 1;
    }

    const double queries[][2] = {{3, 1}, {2, 2}, {4, 0}, {5, 1}};
    for (int i = 0; i < 4; i++) {
        mw_location at = mw_locate(locator, &cursor, queries[i][0], queries[i][1]);
        printf("(%g, %g) %s", queries[i][0], queries[i][1], mw_where_name(at.where));
        if (at.triangle != MW_NONE)
            printf(" of triangle %u, weights %g %g %g", at.triangle, at.weight[0], at.weight[1],
                   at.weight[2]);
        printf("\n");
    }

    mw_locator_destroy(locator);
    mw_mesh_destroy(mesh);
    return 0;
}
