/* remesh.c - a star-shaped polyhedron sampled on an icosphere, with a field, and how far the two
 * are apart. */
#include <math.h>
#include <meshwalk/meshwalk.h>
#include <stdio.h>
#include <stdlib.h>

enum { GIVEN = 4, LEVEL = 4 };

/* Vertices, triangles and a value for each vertex. */
typedef struct body {
    double *points, *heights;
    uint32_t *triangles, vertices, count;
    mw_surface *surface;
} body;

static _Noreturn void fail(const mw_error *error)
{
    fprintf(stderr, "%s\n", error->message);
    exit(1);
}

static void *allocate(size_t count, size_t size)
{
    void *memory = calloc(count, size);
    if (!memory) exit(1);
    return memory;
}

static body body_of_level(uint32_t level)
{
    body b = {0};
    mw_error error;
    if (mw_icosphere_size(level, &b.vertices, &b.count, &error)) fail(&error);
    b.points = allocate(b.vertices, 3 * sizeof *b.points);
    b.heights = allocate(b.vertices, sizeof *b.heights);
    b.triangles = allocate(b.count, 3 * sizeof *b.triangles);
    return b;
}

static void body_close(body *b)
{
    mw_error error;
    const mw_arrays arrays = {.points = b->points,
                              .point_count = b->vertices,
                              .triangles = b->triangles,
                              .triangle_count = b->count};
    if (mw_surface_create(&arrays, NULL, &b->surface, &error)) fail(&error);
}

static void body_free(body *b)
{
    mw_surface_destroy(b->surface);
    free(b->points);
    free(b->heights);
    free(b->triangles);
}

/* A ball with a bulge, turned so that its vertices are not those of the new mesh; the height of a
 * vertex is its distance from the centre. */
static body make_asteroid(void)
{
    body b = body_of_level(GIVEN);
    mw_error error;
    if (mw_icosphere_create(GIVEN, NULL, b.points, b.triangles, &error)) fail(&error);
    for (uint32_t v = 0; v < b.vertices; v++) {
        double *p = b.points + 3 * (size_t)v;
        b.heights[v] = 1 + 0.5 * p[0] * p[0] * p[0];
        const double x = p[0] * b.heights[v], y = p[1] * b.heights[v], z = p[2] * b.heights[v];
        p[0] = 0.6 * x - 0.8 * y;
        p[1] = 0.48 * x + 0.36 * y - 0.8 * z;
        p[2] = 0.64 * x + 0.48 * y + 0.6 * z;
    }
    body_close(&b);
    return b;
}

/* The heights at the new vertices: the weights serve any number of fields. */
static void carry_heights(const body *from, const mw_location *at, body *to)
{
    mw_operator *weights;
    mw_error error;
    const mw_hits hits = mw_hits_of_locations(at, to->vertices);
    const mw_value_table heights = {.values = from->heights, .count = 1};
    if (mw_operator_create_on_surface(from->surface, &hits, NULL, &weights, &error) ||
        mw_operator_apply(weights, &heights, NULL, to->heights, &error))
        fail(&error);
    mw_operator_destroy(weights);
}

static body remesh(const body *from)
{
    body to = body_of_level(LEVEL);
    mw_location *at = allocate(to.vertices, sizeof *at);
    mw_star *star;
    mw_error error;
    if (mw_star_create(from->surface, NULL, &star, &error) ||
        mw_star_remesh(star, LEVEL, NULL, to.points, to.triangles, at, &error))
        fail(&error);
    carry_heights(from, at, &to);
    body_close(&to);
    mw_star_destroy(star);
    free(at);
    return to;
}

static void show_deviation(const char *name, const mw_surface *from, const mw_surface *to)
{
    const mw_prober_options boxes = {.boxes = 1};
    mw_prober *prober;
    mw_deviation d;
    mw_error error;
    if (mw_prober_create(to, &boxes, &prober, &error) ||
        mw_surface_deviation(from, prober, NULL, &d, &error))
        fail(&error);
    printf("%s: at least %.4f, at most %.4f, mean %.5f\n", name, d.largest, d.at_most, d.mean);
    mw_prober_destroy(prober);
}

int main(void)
{
    body asteroid = make_asteroid(), even = remesh(&asteroid);
    double highest = 0;
    for (uint32_t v = 0; v < even.vertices; v++) highest = fmax(highest, even.heights[v]);
    printf("%u vertices became %u; the highest is at %.4f\n", asteroid.vertices, even.vertices,
           highest);
    show_deviation("from the asteroid to the new mesh", asteroid.surface, even.surface);
    show_deviation("from the new mesh to the asteroid", even.surface, asteroid.surface);
    body_free(&asteroid);
    body_free(&even);
    return 0;
}
