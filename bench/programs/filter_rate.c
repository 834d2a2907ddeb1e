/* filter_rate - how often the filters of orient2d and incircle decide, and what a call costs.
 *     filter_rate [FILE...]     points as text, "x y ..." or "x,y,...", a header is skipped;
 *                               "-" is standard input
 *
 * Without files it makes points: uniform ones, the same rounded to centimetres in UTM, and a
 * regular grid. The points are triangulated, and the predicates called as an insertion and a walk
 * would:
 *     incircle  the vertex across each inner edge against the circle of the triangle
 *     far       orient2d of an edge and a random point of the extent
 *     near      orient2d of an edge and the vertex across the next edge
 *     on edge   orient2d of an edge and a point on it, rounded: nothing harder occurs
 * Shown are the calls that the filter leaves to the exact stage, and ns per call of the filter
 * alone and of the exact stage alone (the least of five rounds). */
#include "bench/data/dataset.h"
#include "cli/frame/monotonic_clock.h"
#include "predicates/predicates.h" /* private: no public header shows the stages of a predicate */

#include <meshwalk/mesh.h>
#include <meshwalk/triangulate.h>

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* One call of a predicate; orient2d does not use the fourth point. */
typedef struct predicate_call {
    mw_point p[4];
} predicate_call;

typedef struct call_list {
    predicate_call *item;
    size_t count;
} call_list;

typedef struct point_cloud {
    double *xy;
    size_t count, capacity;
} point_cloud;

static void *memory_checked(void *memory)
{
    if (memory) return memory;
    fprintf(stderr, "filter_rate: out of memory\n");
    exit(4);
}

static void point_cloud_add(point_cloud *c, double x, double y)
{
    if (c->count == c->capacity) {
        c->capacity = 2 * c->capacity + 1024;
        c->xy = memory_checked(realloc(c->xy, 2 * c->capacity * sizeof(double)));
    }
    c->xy[2 * c->count] = x;
    c->xy[2 * c->count++ + 1] = y;
}

/* ---- points ---- */

static void point_cloud_make_uniform(point_cloud *c)
{
    uint64_t state = 1;
    for (int i = 0; i < 200000; i++) {
        double x = dataset_unit(&state);
        point_cloud_add(c, x, dataset_unit(&state));
    }
}

/* A square kilometre of points on the ground. */
static void point_cloud_make_centimetres(point_cloud *c)
{
    uint64_t state = 1;
    for (int i = 0; i < 200000; i++) {
        double x = 4.5e5 + 1000 * dataset_unit(&state), y = 5.4e6 + 1000 * dataset_unit(&state);
        point_cloud_add(c, round(100 * x) / 100, round(100 * y) / 100);
    }
}

static void point_cloud_make_grid(point_cloud *c)
{
    for (int i = 0; i < 450; i++) {
        for (int k = 0; k < 450; k++) point_cloud_add(c, 4.5e5 + 30 * i, 5.4e6 + 30 * k);
    }
}

static void point_cloud_read(point_cloud *c, const char *path)
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
        if (rest != line && end != rest) point_cloud_add(c, x, y);
    }
    if (file != stdin) fclose(file);
}

/* ---- calls ---- */

static mw_point mesh_vertex_point(const mw_mesh *mesh, uint32_t number)
{
    double p[2];
    mw_mesh_vertex(mesh, number, p);
    return (mw_point){p[0], p[1]};
}

/* The vertex across a local edge of a triangle; false at the border. */
static bool mesh_apex_across(const mw_mesh *mesh, uint32_t triangle, unsigned edge, mw_point *apex)
{
    unsigned there;
    uint32_t corner[3], other = mw_mesh_neighbour(mesh, triangle, edge, &there);
    if (other == MW_NONE) return false;
    mw_mesh_triangle(mesh, other, corner);
    *apex = mesh_vertex_point(mesh, corner[(there + 2) % 3]);
    return true;
}

static void call_list_add(call_list *list, mw_point a, mw_point b, mw_point c, mw_point d)
{
    list->item[list->count++] = (predicate_call){{a, b, c, d}};
}

enum { INCIRCLE, FAR, NEAR, ON_EDGE, LISTS };
static const char *const list_names[LISTS] = {"incircle", "far", "near", "on edge"};

/* The calls of the three edges of each triangle. */
static void collect_calls(call_list list[LISTS], const mw_mesh *mesh, const double *xy,
                          size_t count)
{
    uint64_t state = 2;
    uint32_t triangles = mw_mesh_triangle_count(mesh);
    for (int i = 0; i < LISTS; i++)
        list[i] = (call_list){
            memory_checked(malloc((3 * (size_t)triangles + 1) * sizeof(predicate_call))), 0};
    for (uint32_t t = 0; t < triangles; t++) {
        uint32_t corner[3];
        mw_mesh_triangle(mesh, t, corner);
        for (unsigned k = 0; k < 3; k++) {
            mw_point a = mesh_vertex_point(mesh, corner[k]),
                     b = mesh_vertex_point(mesh, corner[(k + 1) % 3]);
            mw_point c = mesh_vertex_point(mesh, corner[(k + 2) % 3]), apex;
            const double *other = xy + 2 * (size_t)(dataset_unit(&state) * (double)count);
            double s = dataset_unit(&state), u = dataset_unit(&state);
            call_list_add(
                &list[FAR], a, b,
                (mw_point){other[0] + u * (a.x - other[0]), other[1] + u * (a.y - other[1])}, c);
            call_list_add(&list[ON_EDGE], a, b,
                          (mw_point){a.x + s * (b.x - a.x), a.y + s * (b.y - a.y)}, c);
            if (mesh_apex_across(mesh, t, (k + 1) % 3, &apex))
                call_list_add(&list[NEAR], a, b, apex, c);
            if (mesh_apex_across(mesh, t, k, &apex)) call_list_add(&list[INCIRCLE], a, b, c, apex);
        }
    }
}

/* ---- measuring ---- */

static volatile double sink;

/* What a pass over a list does with each call; returns how many calls the filter leaves
 * undecided. */
static size_t orient2d_filter(const call_list *list)
{
    size_t undecided = 0;
    for (size_t i = 0; i < list->count; i++) {
        const mw_point *p = list->item[i].p;
        double bound, det = mw__orient2d_rounded(p[0], p[1], p[2], &bound);
        undecided += !(fabs(det) > bound);
    }
    return undecided;
}

static size_t incircle_filter(const call_list *list)
{
    size_t undecided = 0;
    for (size_t i = 0; i < list->count; i++) {
        const mw_point *p = list->item[i].p;
        double bound, det = mw__incircle_rounded(p[0], p[1], p[2], p[3], &bound);
        undecided += !(fabs(det) > bound);
    }
    return undecided;
}

static size_t time_orient2d_exact(const call_list *list)
{
    double sum = 0;
    for (size_t i = 0; i < list->count; i++) {
        const mw_point *p = list->item[i].p;
        sum += mw__orient2d_exact(p[0], p[1], p[2]);
    }
    sink = sum;
    return 0;
}

static size_t time_incircle_exact(const call_list *list)
{
    double sum = 0;
    for (size_t i = 0; i < list->count; i++) {
        const mw_point *p = list->item[i].p;
        sum += mw__incircle_exact(p[0], p[1], p[2], p[3]);
    }
    sink = sum;
    return 0;
}

/* ns per call. The stages are measured one after the other, not in turns: each finds the list in
 * the cache. */
static double time_pass(size_t (*pass)(const call_list *list), const call_list *list,
                        size_t *undecided)
{
    double best = INFINITY;
    for (int round = 0; round < 5; round++) {
        double begin = monotonic_seconds();
        *undecided = pass(list);
        best = fmin(best, monotonic_seconds() - begin);
    }
    return list->count ? best * 1e9 / (double)list->count : 0;
}

static void report_list(int kind, const call_list *list)
{
    size_t undecided, none;
    double filter =
        time_pass(kind == INCIRCLE ? incircle_filter : orient2d_filter, list, &undecided);
    double exact =
        time_pass(kind == INCIRCLE ? time_incircle_exact : time_orient2d_exact, list, &none);
    double share = list->count ? 100 * (double)undecided / (double)list->count : 0;
    printf("  %-9s %9zu calls, exact stage %9zu (%8.4f %%), filter %6.2f ns, exact %8.2f ns\n",
           list_names[kind], list->count, undecided, share, filter, exact);
}

static void report_points(const char *name, const point_cloud *points)
{
    mw_mesh *mesh;
    mw_error error;
    call_list list[LISTS];
    if (mw_delaunay(points->xy, points->count, 2, NULL, NULL, NULL, &mesh, &error) != MW_OK) {
        fprintf(stderr, "filter_rate: %s: %s\n", name, error.message);
        exit(3);
    }
    printf("%s: %zu points, %u triangles\n", name, points->count,
           (unsigned)mw_mesh_triangle_count(mesh));
    collect_calls(list, mesh, points->xy, points->count);
    for (int i = 0; i < LISTS; i++) {
        report_list(i, &list[i]);
        free(list[i].item);
    }
    mw_mesh_destroy(mesh);
}

int main(int argc, char **argv)
{
    static void (*const make[3])(point_cloud * c) = {
        point_cloud_make_uniform, point_cloud_make_centimetres, point_cloud_make_grid};
    static const char *const made[3] = {"uniform", "centimetres", "grid"};
    for (int i = 1; i < argc || (argc == 1 && i <= 3); i++) {
        point_cloud points = {0};
        if (argc == 1)
            make[i - 1](&points);
        else
            point_cloud_read(&points, argv[i]);
        report_points(argc == 1 ? made[i - 1] : argv[i], &points);
        free(points.xy);
    }
    return 0;
}
