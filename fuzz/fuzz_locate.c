/* fuzz_locate.c - points from the input are triangulated, some triangles dropped, some turned
 * round; then every walk from every start has to name the lowest triangle that contains each
 * query, as a look at all triangles does. Coordinates are small multiples of a power of two, so
 * that points meet edges, vertices and each other often. */
#include <meshwalk/meshwalk.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { MOST = 24 };

typedef struct input {
    const uint8_t *byte;
    size_t left;
} input;

static int next(input *in)
{
    if (in->left == 0) return 0;
    in->left--;
    return *in->byte++;
}

static double coordinate(input *in, int finer)
{
    int value = next(in);
    return finer && value & 1 ? (value >> 1) / 8.0
                              /* vertices on 16 x 16 places, queries anywhere */
                              : (value >> 4) * 1.0;
}

static int contains(const mw_mesh *mesh, uint32_t t, const double q[2])
{
    uint32_t v[3];
    double p[3][2];
    mw_mesh_triangle(mesh, t, v);
    for (int k = 0; k < 3; k++) mw_mesh_vertex(mesh, v[k], p[k]);
    double turn = mw_orient2d(p[0], p[1], p[2]);
    for (int k = 0; k < 3; k++) {
        double side = mw_orient2d(p[k], p[(k + 1) % 3], q);
        if (turn > 0 ? side < 0 : side > 0) return 0;
    }
    return turn != 0;
}

static uint32_t by_force(const mw_mesh *mesh, const double q[2])
{
    uint32_t n = mw_mesh_triangle_count(mesh);
    for (uint32_t t = 0; t < n; t++)
        if (contains(mesh, t, q)) return t;
    return MW_NONE;
}

/* The triangulation less some of its triangles, in the input's order of corners. */
static mw_mesh *damaged(input *in, const mw_mesh *whole, mw_mesh_layout layout)
{
    uint32_t n = mw_mesh_triangle_count(whole), points = mw_mesh_vertex_count(whole), kept = 0;
    uint32_t triangles[6 * MOST];
    double xy[2 * MOST];
    for (uint32_t v = 0; v < points; v++) mw_mesh_vertex(whole, v, xy + 2 * (size_t)v);
    for (uint32_t t = 0; t < n; t++) {
        int what = next(in);
        if ((what & 3) == 3 && n - t + kept > 1) continue;
        uint32_t v[3], *to = triangles + 3 * (size_t)kept++;
        mw_mesh_triangle(whole, t, v);
        for (uint32_t k = 0; k < 3; k++)
            to[k] = v[((uint32_t)what / 8 + (what & 4 ? 3 - k : k)) % 3];
    }
    mw_arrays arrays = {
        .points = xy, .point_count = points, .triangles = triangles, .triangle_count = kept};
    mw_mesh *mesh;
    if (mw_mesh_create(&arrays, &(mw_mesh_options){.layout = layout}, &mesh, NULL)) abort();
    return mesh;
}

static void query(const mw_mesh *mesh, const mw_locator *locator, mw_index *const *index,
                  const double q[2], mw_mesh_layout layout)
{
    uint32_t want = by_force(mesh, q);
    for (int walk = MW_WALK_AUTO; walk < MW_WALK_COUNT; walk++)
        for (int start = MW_START_AUTO; start < MW_START_COUNT; start++) {
            mw_query_options options = {.walk = (mw_walk_kind)walk,
                                        .start = (mw_start_kind)start,
                                        .arithmetic =
                                            (mw_arithmetic)((walk ^ start ^ (int)layout) & 1),
                                        .seed = 7,
                                        .index = index[start]};
            mw_cursor cursor;
            if (mw_cursor_init(locator, &options, &cursor, NULL)) abort();
            mw_location at = mw_locate(locator, &cursor, q[0], q[1]);
            if (at.triangle != want) abort();
        }
}

/* What a locator says whose pockets and holes are not filled: the same, holes too. */
static void query_open(const mw_locator *open, const mw_locator *filled, const double q[2])
{
    mw_query_options by_default = {.start = MW_START_RANDOM, .seed = 7};
    mw_cursor cursor;
    if (mw_cursor_init(filled, &by_default, &cursor, NULL)) abort();
    mw_location want = mw_locate(filled, &cursor, q[0], q[1]);
    for (int arithmetic = MW_EXACT; arithmetic <= MW_DOUBLE; arithmetic++) {
        mw_query_options options = {
            .start = MW_START_RANDOM, .seed = 7, .arithmetic = (mw_arithmetic)arithmetic};
        if (mw_cursor_init(open, &options, &cursor, NULL)) abort();
        for (int i = 0; i < 4; i++) {
            mw_location at = mw_locate(open, &cursor, q[0], q[1]);
            if (at.triangle != want.triangle || at.where != want.where || at.hole != want.hole)
                abort();
        }
    }
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    input in = {data, size};
    double points[2 * MOST];
    size_t n = 3 + (size_t)next(&in) % (MOST - 3);
    double scale = ldexp(1, (next(&in) & 7) * 90 - 360), offset = next(&in) & 1 ? 4096 : 0;
    for (size_t i = 0; i < 2 * n; i++) points[i] = (coordinate(&in, 0) + offset) * scale;
    mw_mesh *whole;
    if (mw_delaunay(points, n, 2, NULL, NULL, NULL, &whole, NULL)) return 0; /* all on one line */
    mw_mesh_layout layout = next(&in) & 1 ? MW_LAYOUT_AS_GIVEN : MW_LAYOUT_HILBERT;
    mw_mesh *mesh = damaged(&in, whole, layout);
    mw_locator_options prepare = {0};
    mw_locator *locator, *open;
    /* a part of an embedding is one */
    if (mw_locator_create(mesh, &prepare, &locator, NULL)) abort();
    prepare.fill = MW_FILL_NO;
    if (mw_locator_create(mesh, &prepare, &open, NULL)) abort();
    mw_index *index[MW_START_COUNT];
    for (int start = MW_START_AUTO; start < MW_START_COUNT;
         start++) /* NULL for starts that have none */
        mw_index_create(locator, (mw_start_kind)start, NULL, &index[start], NULL);
    for (int i = 0; i < 8; i++) {
        const double q[2] = {(coordinate(&in, 1) + offset) * scale,
                             (coordinate(&in, 1) + offset) * scale};
        query(mesh, locator, index, q, layout);
        query_open(open, locator, q);
    }
    for (int start = MW_START_AUTO; start < MW_START_COUNT; start++) mw_index_destroy(index[start]);
    mw_locator_destroy(open);
    mw_locator_destroy(locator);
    mw_mesh_destroy(mesh);
    mw_mesh_destroy(whole);
    return 0;
}
