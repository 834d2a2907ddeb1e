/* path.c - a moving point: each search starts where the last one ended, and the counters show what
 * it cost. */
#include <meshwalk/meshwalk.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

/* A mesh of n x n squares of side 1, each cut into two triangles. */
static mw_mesh *make_squares(uint32_t n, mw_error *error)
{
    double *points = malloc((n + 1) * (n + 1) * 2 * sizeof *points);
    uint32_t *triangles = malloc(n * n * 6 * sizeof *triangles), *corner = triangles;
    mw_mesh *mesh = NULL;
    if (points && triangles) {
        for (uint32_t i = 0; i < (n + 1) * (n + 1); i++) {
            points[2 * i] = i % (n + 1);
            points[2 * i + 1] = i / (n + 1);
        }
        for (uint32_t i = 0; i < n * n; i++, corner += 6) {
            uint32_t a = i / n * (n + 1) + i % n, b = a + 1, d = a + n + 1, c = d + 1;
            const uint32_t two[6] = {a, b, c, a, c, d};
            for (int k = 0; k < 6; k++) corner[k] = two[k];
        }
        mw_arrays arrays = {.points = points,
                            .point_count = (size_t)(n + 1) * (n + 1),
                            .triangles = triangles,
                            .triangle_count = (size_t)2 * n * n};
        mw_mesh_create(&arrays, NULL, &mesh, error);
    } else {
        snprintf(error->message, sizeof error->message, "out of memory");
    }
    free(triangles);
    free(points);
    return mesh;
}

int main(void)
{
    mw_error error;
    mw_locator *locator = NULL;
    mw_cursor cursor;
    mw_query_options options = {.walk = MW_WALK_STRAIGHT, .start = MW_START_LAST, .counters = 1};
    mw_mesh *mesh = make_squares(100, &error);
    if (!mesh || mw_locator_create(mesh, NULL, &locator, &error) ||
        mw_cursor_init(locator, &options, &cursor, &error)) {
        fprintf(stderr, "%s\n", error.message);
        mw_mesh_destroy(mesh);
        return 1;
    }

    /* Once round a circle; every triangle entered is noted. */
    uint32_t last = MW_NONE, entered = 0;
    for (int i = 0; i < 10000; i++) {
        double angle = 6.283185307179586 * i / 10000;
        mw_location at =
            mw_locate(locator, &cursor, 50.3 + 40 * cos(angle), 49.9 + 40 * sin(angle));
        if (at.triangle != last) entered++;
        last = at.triangle;
    }
    const mw_counters *c = &cursor.counters;
    printf("%llu searches, %u changes of triangle, %.2f triangles visited per search\n",
           (unsigned long long)c->queries, entered,
           (double)c->triangles_visited / (double)c->queries);
    mw_locator_destroy(locator);
    mw_mesh_destroy(mesh);
    return 0;
}
