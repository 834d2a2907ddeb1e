/* triangulate.c - the Delaunay triangulation of points, duplicates among them. */
#include <meshwalk/meshwalk.h>
#include <stdio.h>

int main(void)
{
    /* Point 4 is the same as point 1; no triangle uses it, but the numbering stays yours. */
    const double points[] = {0, 0, 5, 0, 5, 4, 0, 4, 5, 0, 2, 1};
    enum { N = 6 };
    uint32_t duplicate_of[N];
    mw_delaunay_report report;
    mw_mesh *mesh;
    mw_error error;
    if (mw_delaunay(points, N, 2, NULL, duplicate_of, &report, &mesh, &error)) {
        fprintf(stderr, "%s\n", error.message);
        return 1;
    }
    printf("%zu points, %zu of them duplicates\n", report.points, report.duplicates);
    for (uint32_t i = 0; i < N; i++) {
        if (duplicate_of[i] != MW_NONE) printf("point %u is point %u again\n", i, duplicate_of[i]);
    }

    mw_mesh_info info;
    if (mw_mesh_describe(mesh, NULL, &info, &error) == MW_OK)
        printf("%u triangles, area %g, convex: %s, Delaunay: %s\n", info.triangles, info.area,
               info.convex ? "yes" : "no", info.delaunay ? "yes" : "no");
    mw_mesh_destroy(mesh);
    return 0;
}
