/* surface_edit_rate - edits of a surface whose boxes and star follow: how many a second, and what
 * the next probe takes.
 *     surface_edit_rate [TRIANGLES [EDITS [ROUNDS]]]    (default: 1e6 1e6 5)
 *
 * The surface is a wavy torus. A pair of edits splits an edge and collapses it again, or flips an
 * edge and flips it back; so the surface stays what it is. The edits walk from each triangle to one
 * beside it (local), or take random triangles (scattered). Shown is processor time, the least of
 * all rounds, in turns: ns an edit without boxes, with boxes, and with boxes, undo of a thousand
 * edits and a report. Then certain probes at random triangles: ns of one, and of one right after an
 * edit of the triangle that it touches; the medians of 20,000 single calls.
 *
 * Then the same edits of an icosphere of at least as many triangles, without a star and with one
 * that follows; and what the star takes to be brought up to date as a whole. */
#include <meshwalk/remesh.h>
#include <meshwalk/surface_edit.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

enum { WAYS = 5, TORUS_WAYS = 3, STAR_WAY = 4, PROBES = 20000 };

typedef struct edit_scene {
    mw_surface *surface;
    mw_prober *prober; /* NULL: without boxes */
    mw_star *star;     /* NULL: none */
    mw_surface_editor *editor;
    mw_surface_change change;
    uint32_t triangles, at; /* where the local edits are */
    uint64_t random;
    int reported;
} edit_scene;

static void scene_require(mw_status status, const mw_error *error)
{
    if (status == MW_OK) return;
    fprintf(stderr, "%s\n", error->message);
    exit(1);
}

static uint64_t scene_random(edit_scene *s)
{
    s->random ^= s->random << 13;
    s->random ^= s->random >> 7;
    return s->random ^= s->random << 17;
}

static double processor_seconds(void)
{
    struct timespec t;
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

static mw_surface *make_torus(uint32_t triangles)
{
    uint32_t m = (uint32_t)sqrt(triangles / 4.0), n = triangles / 2 / m;
    double *points = malloc(3 * sizeof *points * n * m);
    uint32_t *corners = malloc(6 * sizeof *corners * n * m);
    if (!points || !corners) exit(1);
    for (uint32_t i = 0; i < n; i++)
        for (uint32_t j = 0; j < m; j++) {
            double u = 2 * M_PI * i / n, v = 2 * M_PI * j / m, r = 1 + 0.05 * sin(9 * u + 7 * v);
            double *p = points + 3 * ((size_t)i * m + j);
            p[0] = (3 + r * cos(v)) * cos(u);
            p[1] = (3 + r * cos(v)) * sin(u);
            p[2] = r * sin(v);
            uint32_t a = i * m + j, b = (i + 1) % n * m + j, c = (i + 1) % n * m + (j + 1) % m,
                     d = i * m + (j + 1) % m;
            memcpy(corners + 6 * ((size_t)i * m + j), (uint32_t[]){a, b, c, a, c, d},
                   6 * sizeof *corners);
        }
    mw_surface *surface;
    mw_error error;
    mw_arrays arrays = {.points = points,
                        .point_count = (size_t)n * m,
                        .triangles = corners,
                        .triangle_count = 2 * (size_t)n * m};
    scene_require(mw_surface_create(&arrays, NULL, &surface, &error), &error);
    free(points);
    free(corners);
    return surface;
}

static mw_surface *make_sphere(uint32_t least)
{
    uint32_t level = 0, vertices, triangles = 0;
    mw_surface *surface;
    mw_error error;
    for (; triangles < least; level++)
        scene_require(mw_icosphere_size(level, &vertices, &triangles, &error), &error);
    double *points = malloc(3 * sizeof *points * vertices);
    uint32_t *corners = malloc(3 * sizeof *corners * triangles);
    if (!points || !corners) exit(1);
    scene_require(mw_icosphere_create(level - 1, NULL, points, corners, &error), &error);
    mw_arrays arrays = {.points = points,
                        .point_count = vertices,
                        .triangles = corners,
                        .triangle_count = triangles};
    scene_require(mw_surface_create(&arrays, NULL, &surface, &error), &error);
    free(points);
    free(corners);
    return surface;
}

/* way 0: without boxes; 1: with them; 2: with undo and a report, too. Of a sphere: 3: without a
 * star; 4: with one. */
static void scene_make(edit_scene *s, uint32_t triangles, int way)
{
    mw_error error;
    *s = (edit_scene){.surface = way < TORUS_WAYS ? make_torus(triangles) : make_sphere(triangles),
                      .random = 88172645463325252u};
    mw_prober_options boxes = {.boxes = 1};
    if (way == 1 || way == 2)
        scene_require(mw_prober_create(s->surface, &boxes, &s->prober, &error), &error);
    mw_surface_editor_options options = {.prober = s->prober, .undo = way == 2 ? 1000 : 0};
    scene_require(mw_surface_editor_create(s->surface, &options, &s->editor, &error), &error);
    if (way == STAR_WAY) {
        scene_require(mw_star_create(s->surface, NULL, &s->star, &error), &error);
        scene_require(mw_surface_editor_attach_star(s->editor, s->star, &error), &error);
    }
    s->triangles = mw_surface_triangle_count(s->surface);
    s->reported = way == 2;
}

static void scene_release(edit_scene *s)
{
    mw_surface_editor_destroy(s->editor);
    mw_prober_destroy(s->prober);
    mw_star_destroy(s->star);
    mw_surface_destroy(s->surface);
}

static uint32_t scene_next(edit_scene *s, int scattered)
{
    if (scattered) return s->at = (uint32_t)(scene_random(s) % s->triangles);
    uint32_t next = mw_surface_neighbour(s->surface, s->at, (unsigned)(scene_random(s) % 3), NULL);
    return s->at = next < s->triangles ? next : 0;
}

/* A pair of edits at a triangle, which is there again afterwards. Returns how many were done. */
static size_t scene_edit_pair(edit_scene *s, uint32_t triangle)
{
    mw_surface_change *change = s->reported ? &s->change : NULL;
    mw_error error;
    uint32_t v[3], made = mw_surface_vertex_count(s->surface);
    unsigned k = (unsigned)(scene_random(s) % 3), other;
    mw_surface_triangle(s->surface, triangle, v);
    uint32_t a = v[k], b = v[(k + 1) % 3], c = v[(k + 2) % 3], w[3];
    if (scene_random(s) >> 60 & 1) {
        scene_require(mw_surface_edit_split_edge(s->editor, a, b, NULL, change, &error), &error);
        scene_require(
            mw_surface_edit_collapse(s->editor, made, a < b ? b : a, NULL, change, &error), &error);
        return 2;
    }
    uint32_t beyond = mw_surface_neighbour(s->surface, triangle, k, &other);
    mw_surface_triangle(s->surface, beyond, w);
    if (mw_surface_edit_flip(s->editor, a, b, change, NULL) != MW_OK) return 0;
    scene_require(mw_surface_edit_flip(s->editor, c, w[(other + 2) % 3], change, &error), &error);
    return 2;
}

static double scene_edit(edit_scene *s, size_t edits, int scattered)
{
    double begin = processor_seconds();
    for (size_t done = 0; done < edits;) done += scene_edit_pair(s, scene_next(s, scattered));
    return (processor_seconds() - begin) / (double)edits;
}

static double now_nanoseconds(void)
{
    struct timespec t;
    clock_gettime(CLOCK_MONOTONIC, &t);
    return 1e9 * (double)t.tv_sec + (double)t.tv_nsec;
}

/* ns of a certain probe of a triangle from a point off its middle. */
static double scene_probe(edit_scene *s, mw_probe_cursor *cursor, uint32_t triangle)
{
    double q[3] = {0, 0, 0}, m[3], p[3];
    uint32_t v[3];
    mw_surface_triangle(s->surface, triangle, v);
    for (int i = 0; i < 3; i++) {
        mw_surface_vertex(s->surface, v[i], p);
        for (int k = 0; k < 3; k++) q[k] += p[k] / 3;
    }
    double round = hypot(q[0], q[1]);
    m[0] = 3 * q[0] / round - q[0]; /* towards the circle in the tube */
    m[1] = 3 * q[1] / round - q[1];
    m[2] = -q[2];
    for (int k = 0; k < 3; k++) q[k] -= 0.01 * m[k];
    double begin = now_nanoseconds();
    mw_touch touch = mw_probe(s->prober, cursor, q, m);
    double end = now_nanoseconds();
    if (touch.state != MW_TOUCH_HIT) fprintf(stderr, "a probe of triangle %u misses\n", triangle);
    return end - begin;
}

static int compare_times(const void *a, const void *b)
{
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

static void scene_measure_probes(edit_scene *s)
{
    static double before[PROBES], after[PROBES];
    mw_probe_cursor cursor;
    mw_error error;
    mw_probe_options certain = {.certain = 1};
    scene_require(mw_probe_cursor_init(s->prober, &certain, &cursor, &error), &error);
    for (int i = 0; i < PROBES; i++) {
        before[i] = scene_probe(s, &cursor, scene_next(s, 1));
        uint32_t triangle = scene_next(s, 1);
        scene_edit_pair(s, triangle);
        after[i] = scene_probe(s, &cursor, triangle);
    }
    qsort(before, PROBES, sizeof *before, compare_times);
    qsort(after, PROBES, sizeof *after, compare_times);
    printf("probe,%.0f,%.0f\n", before[PROBES / 2], after[PROBES / 2]);
    printf("probe 99 %%,%.0f,%.0f\n", before[PROBES * 99 / 100], after[PROBES * 99 / 100]);
}

/* The star must be right after all these edits, and is then decided as a whole. */
static void scene_measure_star(edit_scene *s)
{
    mw_star_update_options one = {.threads = 1};
    mw_error error;
    if (!mw_star_ready(s->star)) fprintf(stderr, "the star is not up to date\n");
    double begin = processor_seconds();
    scene_require(mw_star_update(s->star, &one, &error), &error);
    printf("star as a whole,%.0f\n", 1e9 * (processor_seconds() - begin));
}

int main(int argc, char **argv)
{
    uint32_t triangles = argc > 1 ? (uint32_t)atof(argv[1]) : 1000000;
    size_t edits = argc > 2 ? (size_t)atof(argv[2]) : 1000000;
    int rounds = argc > 3 ? atoi(argv[3]) : 5;
    double least[2][WAYS];
    static edit_scene scene[WAYS];
    for (int way = 0; way < WAYS; way++) {
        scene_make(&scene[way], triangles, way);
        least[0][way] = least[1][way] = INFINITY;
    }
    for (int round = 0; round < rounds; round++)
        for (int scattered = 0; scattered < 2; scattered++)
            for (int way = 0; way < WAYS; way++) {
                double ns = 1e9 * scene_edit(&scene[way], edits / (size_t)rounds, scattered);
                least[scattered][way] = fmin(least[scattered][way], ns);
            }
    printf("edits,without boxes,with boxes,with undo and report\n");
    for (int scattered = 0; scattered < 2; scattered++)
        printf("%s,%.0f,%.0f,%.0f\n", scattered ? "scattered" : "local", least[scattered][0],
               least[scattered][1], least[scattered][2]);
    printf("calls,before an edit,after an edit\n");
    scene_measure_probes(&scene[1]);
    printf("edits of a sphere,without a star,with a star\n");
    for (int scattered = 0; scattered < 2; scattered++)
        printf("%s,%.0f,%.0f\n", scattered ? "scattered" : "local", least[scattered][3],
               least[scattered][STAR_WAY]);
    scene_measure_star(&scene[STAR_WAY]);
    for (int way = 0; way < WAYS; way++) scene_release(&scene[way]);
    return 0;
}
