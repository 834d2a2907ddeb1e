/* fuzz_segment.c - points from the input are triangulated, some triangles dropped, some turned
 * round; then the pieces of segments have to be those of brute force in rationals. Coordinates are
 * small multiples of a power of two, so that segments run through vertices and along edges. */
#include <meshwalk/meshwalk.h>

#include <math.h>
#include <stdlib.h>

#include "oracle/segment/segment_oracle.h"

enum { MOST = 20, ROOM = 512 };

typedef struct input {
    const uint8_t *byte;
    size_t left;
} input;

static unsigned next(input *in)
{
    if (in->left == 0) return 0;
    in->left--;
    return *in->byte++;
}

static double coordinate(input *in, int finer)
{
    unsigned value = next(in);
    return finer && value & 1 ? (double)(value >> 1) / 8 : (double)(value >> 4);
}

/* The arrays of the triangulation less some of its triangles, in the input's order of corners. */
static uint32_t triangles_kept(input *in, const mw_mesh *whole, uint32_t *triangles)
{
    uint32_t n = mw_mesh_triangle_count(whole), kept = 0;
    for (uint32_t t = 0; t < n; t++) {
        unsigned what = next(in);
        if ((what & 3) == 3 && n - t + kept > 1) continue;
        uint32_t v[3], *to = triangles + 3 * (size_t)kept++;
        mw_mesh_triangle(whole, t, v);
        for (uint32_t k = 0; k < 3; k++) to[k] = v[(what / 8 + (what & 4 ? 3 - k : k)) % 3];
    }
    return kept;
}

static void follow(const mw_locator *locator, input *in, const mw_arrays *arrays, double scale)
{
    static mw_segment_piece piece[ROOM];
    mw_cursor cursor = {.walk = 0};
    mw_segment s;
    double at[4];
    for (int k = 0; k < 4; k++) at[k] = coordinate(in, 1) * scale;
    if (mw_segment_begin(locator, &cursor, at, at + 2, &s, NULL)) abort();
    for (int i = 0; i < 6; i++) {
        size_t n = 0;
        while (n < ROOM && mw_segment_next(&s, &piece[n])) n++;
        if (!segment_oracle_agrees(arrays->points, arrays->triangles,
                                   (uint32_t)arrays->triangle_count, at, at + 2, piece, n))
            abort();
        at[0] = at[2];
        at[1] = at[3];
        for (int k = 2; k < 4; k++) at[k] = coordinate(in, 1) * scale;
        if (mw_segment_continue(&s, at + 2, NULL)) abort();
    }
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    input in = {data, size};
    double points[2 * MOST];
    uint32_t triangles[6 * MOST];
    size_t n = 3 + next(&in) % (MOST - 3);
    double scale = ldexp(1, (int)(next(&in) & 7) * 250 - 800);
    for (size_t i = 0; i < 2 * n; i++) points[i] = coordinate(&in, 0) * scale;
    mw_mesh *whole, *mesh;
    if (mw_delaunay(points, n, 2, NULL, NULL, NULL, &whole, NULL)) return 0; /* all on one line */
    for (uint32_t v = 0; v < mw_mesh_vertex_count(whole); v++)
        mw_mesh_vertex(whole, v, points + 2 * (size_t)v);
    mw_arrays arrays = {.points = points,
                        .point_count = mw_mesh_vertex_count(whole),
                        .triangles = triangles,
                        .triangle_count = triangles_kept(&in, whole, triangles)};
    mw_locator *locator;
    if (mw_mesh_create(&arrays, NULL, &mesh, NULL)) abort();
    if (mw_locator_create(mesh, NULL, &locator, NULL)) abort();
    follow(locator, &in, &arrays, scale);
    mw_locator_destroy(locator);
    mw_mesh_destroy(mesh);
    mw_mesh_destroy(whole);
    return 0;
}
