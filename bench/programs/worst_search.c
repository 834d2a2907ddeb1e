/* worst_search - looks for a mesh on which a query takes many steps, by changing points of small
 * Delaunay triangulations and keeping what makes steps more.
 *
 *     worst_search [POINTS [SECONDS [SEED]]]
 *
 * Steps are tiles visited, tests and comparisons of queries by the default of the library, in
 * random triangles. The first half of the time raises the mean of a query, the second the most that
 * one takes. Prints each best mesh's steps, and at the end its points to standard error. */
#include <meshwalk/meshwalk.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

enum { QUERIES = 1500, MOST_POINTS = 100000 };

static uint64_t random_state;

static double unit(void)
{
    random_state = random_state * UINT64_C(6364136223846793005) + UINT64_C(1442695040888963407);
    return (double)(random_state >> 11) * 0x1p-53;
}

static size_t below(size_t n)
{
    return (size_t)(unit() * (double)n);
}

/* --- how many steps a mesh takes -------------------------------------------------------------- */

typedef struct search_steps {
    double mean, most;
    mw_start_kind guide;
} search_steps;

static void draw(const mw_mesh *mesh, double *q)
{
    for (size_t i = 0; i < QUERIES; i++) {
        uint32_t v[3];
        double c[3][2], s = sqrt(unit()), t = unit();
        mw_mesh_triangle(mesh, (uint32_t)below(mw_mesh_triangle_count(mesh)), v);
        for (int k = 0; k < 3; k++) mw_mesh_vertex(mesh, v[k], c[k]);
        for (int x = 0; x < 2; x++)
            q[2 * i + (size_t)x] = (1 - s) * c[0][x] + s * (1 - t) * c[1][x] + s * t * c[2][x];
    }
}

/* False: the points have no mesh. */
static int measure(const double *points, size_t n, search_steps *steps)
{
    static double q[2 * QUERIES];
    mw_mesh *mesh = NULL;
    mw_locator *locator = NULL;
    mw_locator_options one_thread = {.threads = 1};
    mw_query_options count = {.counters = 1, .threads = 1};
    if (mw_delaunay(points, n, 2, NULL, NULL, NULL, &mesh, NULL)) return 0;
    if (mw_locator_create(mesh, &one_thread, &locator, NULL)) {
        mw_mesh_destroy(mesh);
        return 0;
    }
    draw(mesh, q);
    *steps = (search_steps){0};
    for (size_t i = 0; i < QUERIES; i++) {
        mw_cursor cursor;
        mw_cursor_init(locator, &count, &cursor, NULL);
        mw_locate(locator, &cursor, q[2 * i], q[2 * i + 1]);
        const mw_counters *c = &cursor.counters;
        const double all = (double)(c->triangles_visited + c->orient_init + c->comparisons);
        steps->mean += all / QUERIES;
        steps->most = fmax(steps->most, all);
    }
    mw_locator_info info;
    mw_locator_describe(locator, &info);
    steps->guide = info.guide;
    mw_locator_destroy(locator);
    mw_mesh_destroy(mesh);
    return 1;
}

/* --- changes ---------------------------------------------------------------------------------- */

/* Move some points, that follow each other, in one of several ways. */
static void change(double *p, size_t n)
{
    const size_t way = below(8), first = below(n), count = 1 + below(way ? n / 4 + 1 : 8);
    const double x = p[2 * first], y = p[2 * first + 1], size = exp2(-40 * unit());
    const double angle = 6.28318530717958648 * unit(), ratio = exp2(-unit() / 4);
    double shrunk = 1;
    for (size_t i = 0; i < count; i++) {
        double *at = &p[2 * ((first + i) % n)];
        const double t = (double)i / (double)count;
        shrunk *= ratio;
        switch (way) {
        case 0: /* anywhere near */
            at[0] += size * (2 * unit() - 1);
            at[1] += size * (2 * unit() - 1);
            break;
        case 1: /* nearer to one */
            at[0] = x + (at[0] - x) * size;
            at[1] = y + (at[1] - y) * size;
            break;
        case 2: /* in a row of equal steps */
            at[0] = x + t * cos(angle);
            at[1] = y + t * sin(angle);
            break;
        case 3: /* in two rows whose steps shrink */
            at[0] = x + shrunk * cos(angle) + (i % 2 ? size * sin(angle) : 0);
            at[1] = y + shrunk * sin(angle) - (i % 2 ? size * cos(angle) : 0);
            break;
        case 4: /* on a circle */
            at[0] = x + size * cos(6.28318530717958648 * t);
            at[1] = y + size * sin(6.28318530717958648 * t);
            break;
        case 5: /* on a spiral */
            at[0] = x + (size + t) * cos(30 * t);
            at[1] = y + (size + t) * sin(30 * t);
            break;
        case 6: /* a comb: teeth with two ends each */
            at[0] = x + size * t;
            at[1] = y + (i % 2 ? 1 : 0);
            break;
        default: /* flatter */ at[1] = y + (at[1] - y) * size; break;
        }
    }
}

int main(int argc, char **argv)
{
    const size_t n = argc > 1 ? strtoul(argv[1], NULL, 10) : 1000;
    const double seconds = argc > 2 ? atof(argv[2]) : 10;
    random_state = argc > 3 ? strtoul(argv[3], NULL, 10) : 1;
    if (n < 3 || n > MOST_POINTS) return 2;
    double *best = malloc(2 * n * sizeof *best), *trial = malloc(2 * n * sizeof *trial);
    if (!best || !trial) return 4;
    for (size_t i = 0; i < 2 * n; i++) best[i] = unit();
    search_steps steps, at = {0};
    size_t tried = 0;
    for (clock_t begin = clock(), now = begin; (double)(now - begin) < seconds * CLOCKS_PER_SEC;
         now = clock(), tried++) {
        const int most = (double)(now - begin) > seconds / 2 * CLOCKS_PER_SEC;
        memcpy(trial, best, 2 * n * sizeof *trial);
        for (size_t changes = tried ? 1 + below(3) : 0; changes > 0; changes--) change(trial, n);
        if (!measure(trial, n, &steps)) continue;
        if (most ? steps.most <= at.most : steps.mean <= at.mean) continue;
        at = steps;
        memcpy(best, trial, 2 * n * sizeof *best);
        printf("%zu\t%.1f\t%.0f\t%s\n", tried, at.mean, at.most, mw_start_name(at.guide));
    }
    for (size_t i = 0; i < n; i++) fprintf(stderr, "%a %a\n", best[2 * i], best[2 * i + 1]);
    free(best);
    free(trial);
    return 0;
}
