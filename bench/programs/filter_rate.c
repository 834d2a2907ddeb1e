/* filter_rate - how often the filters of orient2d and incircle decide, and what a call costs.
 *
 *     filter_rate [FILE...]     points as text, "x y ..." or "x,y,...", a header is skipped; "-" is standard input
 *
 * Without files it makes points: uniform ones, the same rounded to centimetres in UTM, and a regular grid. The points
 * are triangulated, and the predicates called as an insertion and a walk would:
 *     incircle  the vertex across each inner edge against the circle of the triangle
 *     far       orient2d of an edge and a random point of the extent
 *     near      orient2d of an edge and the vertex across the next edge
 *     on edge   orient2d of an edge and a point on it, rounded: nothing harder occurs
 * Shown are the calls that the filter leaves to the exact stage, and ns per call of the filter alone and of the exact
 * stage alone (the least of five rounds). */
#include "base/random.h"
#include "predicates/predicates.h"

#include <meshwalk/mesh.h>
#include <meshwalk/triangulate.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

/* One call of a predicate; orient2d does not use the fourth point. */
typedef struct call {
    mw_point p[4];
} call;

typedef struct calls {
    call *item;
    size_t count;
} calls;

typedef struct cloud {
    double *xy;
    size_t count, capacity;
} cloud;

static void *checked(void *memory)
{
    if (memory) return memory;
    fprintf(stderr, "filter_rate: out of memory\n");
    exit(4);
}

static void append(cloud *c, double x, double y)
{
    if (c->count == c->capacity) {
        c->capacity = 2 * c->capacity + 1024;
        c->xy = checked(mw__realloc(c->xy, c->capacity, 2 * sizeof(double)));
    }
    c->xy[2 * c->count] = x;
    c->xy[2 * c->count++ + 1] = y;
}

/* ---- points ---- */

static double uniform(uint64_t *state)
{
    return (double)(mw__random(state) >> 11) * 0x1p-53;
}

static void make_uniform(cloud *c)
{
    uint64_t state = 1;
    for (int i = 0; i < 200000; i++) {
        double x = uniform(&state);
        append(c, x, uniform(&state));
    }
}

/* A square kilometre of points on the ground. */
static void make_centimetres(cloud *c)
{
    uint64_t state = 1;
    for (int i = 0; i < 200000; i++) {
        double x = 4.5e5 + 1000 * uniform(&state), y = 5.4e6 + 1000 * uniform(&state);
        append(c, round(100 * x) / 100, round(100 * y) / 100);
    }
}

static void make_grid(cloud *c)
{
    for (int i = 0; i < 450; i++) {
        for (int k = 0; k < 450; k++) append(c, 4.5e5 + 30 * i, 5.4e6 + 30 * k);
    }
}

static void read_points(cloud *c, const char *path)
{
    FILE *file = strcmp(path, "-") == 0 ? stdin : fopen(path, "r");
    char line[4096];
    if (!file) {
        fprintf(stderr, "filter_rate: %s: cannot be opened\n", path);
        exit(3);
    }
    while (fgets(line, sizeof line, file)) {
        char *rest, *end;
        double x = strtod(line, &rest);
        while (*rest == ',' || *rest == ';') rest++;
        double y = strtod(rest, &end);
        if (rest != line && end != rest) append(c, x, y);
    }
    if (file != stdin) fclose(file);
}

/* ---- calls ---- */

static mw_point vertex(const mw_mesh *mesh, uint32_t number)
{
    double p[2];
    mw_mesh_vertex(mesh, number, p);
    return (mw_point){p[0], p[1]};
}

/* The vertex across a local edge of a triangle; false at the border. */
static bool across(const mw_mesh *mesh, uint32_t triangle, unsigned edge, mw_point *apex)
{
    unsigned there;
    uint32_t corner[3], other = mw_mesh_neighbour(mesh, triangle, edge, &there);
    if (other == MW_NONE) return false;
    mw_mesh_triangle(mesh, other, corner);
    *apex = vertex(mesh, corner[(there + 2) % 3]);
    return true;
}

static void add(calls *list, mw_point a, mw_point b, mw_point c, mw_point d)
{
    list->item[list->count++] = (call){{a, b, c, d}};
}

enum { INCIRCLE, FAR, NEAR, ON_EDGE, LISTS };
static const char *const list_names[LISTS] = {"incircle", "far", "near", "on edge"};

/* The calls of the three edges of each triangle. */
static void collect(calls list[LISTS], const mw_mesh *mesh, const double *xy, size_t count)
{
    uint64_t state = 2;
    uint32_t triangles = mw_mesh_triangle_count(mesh);
    for (int i = 0; i < LISTS; i++) list[i] = (calls){checked(mw__alloc(3 * (size_t)triangles, sizeof(call))), 0};
    for (uint32_t t = 0; t < triangles; t++) {
        uint32_t corner[3];
        mw_mesh_triangle(mesh, t, corner);
        for (unsigned k = 0; k < 3; k++) {
            mw_point a = vertex(mesh, corner[k]), b = vertex(mesh, corner[(k + 1) % 3]);
            mw_point c = vertex(mesh, corner[(k + 2) % 3]), apex;
            const double *other = &xy[2 * mw__random_below(&state, (uint32_t)count)];
            double s = uniform(&state), u = uniform(&state);
            add(&list[FAR], a, b, (mw_point){other[0] + u * (a.x - other[0]), other[1] + u * (a.y - other[1])}, c);
            add(&list[ON_EDGE], a, b, (mw_point){a.x + s * (b.x - a.x), a.y + s * (b.y - a.y)}, c);
            if (across(mesh, t, (k + 1) % 3, &apex)) add(&list[NEAR], a, b, apex, c);
            if (across(mesh, t, k, &apex)) add(&list[INCIRCLE], a, b, c, apex);
        }
    }
}

/* ---- measuring ---- */

static double seconds(void)
{
    struct timespec time;
    clock_gettime(CLOCK_MONOTONIC, &time);
    return (double)time.tv_sec + 1e-9 * (double)time.tv_nsec;
}

static volatile double sink;

/* What a pass over a list does with each call; returns how many calls the filter leaves undecided. */
static size_t orient2d_filter(const calls *list)
{
    size_t undecided = 0;
    for (size_t i = 0; i < list->count; i++) {
        const mw_point *p = list->item[i].p;
        double bound, det = mw__orient2d_rounded(p[0], p[1], p[2], &bound);
        undecided += !(fabs(det) > bound);
    }
    return undecided;
}

static size_t incircle_filter(const calls *list)
{
    size_t undecided = 0;
    for (size_t i = 0; i < list->count; i++) {
        const mw_point *p = list->item[i].p;
        double bound, det = mw__incircle_rounded(p[0], p[1], p[2], p[3], &bound);
        undecided += !(fabs(det) > bound);
    }
    return undecided;
}

static size_t orient2d_exact(const calls *list)
{
    double sum = 0;
    for (size_t i = 0; i < list->count; i++) {
        const mw_point *p = list->item[i].p;
        sum += mw__orient2d_exact(p[0], p[1], p[2]);
    }
    sink = sum;
    return 0;
}

static size_t incircle_exact(const calls *list)
{
    double sum = 0;
    for (size_t i = 0; i < list->count; i++) {
        const mw_point *p = list->item[i].p;
        sum += mw__incircle_exact(p[0], p[1], p[2], p[3]);
    }
    sink = sum;
    return 0;
}

/* ns per call. */
static double measure(size_t (*pass)(const calls *list), const calls *list, size_t *undecided)
{
    double best = INFINITY;
    for (int round = 0; round < 5; round++) {
        double begin = seconds();
        *undecided = pass(list);
        best = fmin(best, seconds() - begin);
    }
    return list->count ? best * 1e9 / (double)list->count : 0;
}

static void report(const char *name, const cloud *points)
{
    mw_mesh *mesh;
    mw_error error;
    calls list[LISTS];
    if (mw_delaunay(points->xy, points->count, 2, NULL, NULL, NULL, &mesh, &error) != MW_OK) {
        fprintf(stderr, "filter_rate: %s: %s\n", name, error.message);
        exit(3);
    }
    printf("%s: %zu points, %u triangles\n", name, points->count, (unsigned)mw_mesh_triangle_count(mesh));
    collect(list, mesh, points->xy, points->count);
    for (int i = 0; i < LISTS; i++) {
        size_t undecided, none;
        double filter = measure(i == INCIRCLE ? incircle_filter : orient2d_filter, &list[i], &undecided);
        double exact = measure(i == INCIRCLE ? incircle_exact : orient2d_exact, &list[i], &none);
        double share = list[i].count ? 100 * (double)undecided / (double)list[i].count : 0;
        printf("  %-9s %9zu calls, exact stage %9zu (%8.4f %%), filter %6.2f ns, exact %8.2f ns\n", list_names[i],
               list[i].count, undecided, share, filter, exact);
        free(list[i].item);
    }
    mw_mesh_destroy(mesh);
}

int main(int argc, char **argv)
{
    static void (*const make[3])(cloud * c) = {make_uniform, make_centimetres, make_grid};
    static const char *const made[3] = {"uniform", "centimetres", "grid"};
    for (int i = 1; i < argc || (argc == 1 && i <= 3); i++) {
        cloud points = {0};
        if (argc == 1)
            make[i - 1](&points);
        else
            read_points(&points, argv[i]);
        report(argc == 1 ? made[i - 1] : argv[i], &points);
        free(points.xy);
    }
    return 0;
}
