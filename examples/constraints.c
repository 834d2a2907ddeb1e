/* constraints.c - a domain with a hole: polygons as edges of the triangulation, what lies outside
 * removed. */
#include <meshwalk/meshwalk.h>
#include <stdio.h>

int main(void)
{
    /* A lake of six corners, an island in it, and a sounding. Both rings belong to polygon 0: what
     * lies inside an odd number of its rings is kept. */
    const double points[] = {0, 0, 8, 0, 10, 4, 8, 8, 3, 7, 0, 8, 4, 3, 6, 3, 6, 5, 4, 5, 2, 2};
    const uint32_t segments[] = {0, 1, 1, 2, 2, 3, 3, 4, 4, 5, 5, 0, 6, 7, 7, 8, 8, 9, 9, 6};
    const uint32_t polygon[10] = {0};
    mw_constraints lake = {.points = points,
                           .point_count = 11,
                           .segments = segments,
                           .segment_count = 10,
                           .polygon = polygon};
    mw_constrain_report report;
    mw_constrained_edges edges;
    mw_error error;
    mw_mesh *mesh;
    if (mw_constrained_delaunay(&lake, NULL, NULL, &report, &edges, &mesh, &error)) {
        if (report.crossing_segments[0] != MW_NONE)
            fprintf(stderr, "segments %u and %u cross\n", report.crossing_segments[0],
                    report.crossing_segments[1]);
        fprintf(stderr, "%s\n", error.message);
        return 1;
    }
    printf("%u triangles, %zu removed, %zu constrained edges\n", mw_mesh_triangle_count(mesh),
           report.triangles_removed, edges.count);
    mw_constrained_edges_release(&edges);

    mw_locator *locator;
    mw_cursor cursor;
    if (mw_locator_create(mesh, NULL, &locator, &error) ||
        mw_cursor_init(locator, NULL, &cursor, &error)) {
        fprintf(stderr, "%s\n", error.message);
        return 1;
    }
    const double queries[][2] = {{2, 1}, {5, 4}, {4, 7.5}};
    for (int i = 0; i < 3; i++)
        printf("(%g, %g) %s\n", queries[i][0], queries[i][1],
               mw_where_name(mw_locate(locator, &cursor, queries[i][0], queries[i][1]).where));
    mw_locator_destroy(locator);
    mw_mesh_destroy(mesh);
    return 0;
}
