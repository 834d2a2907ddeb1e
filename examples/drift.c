/* drift.c - particles drift through a strait with an island for a day: a time step of Runge and
 * Kutta's second order locates each of them twice, in one call, beginning at the triangle where it
 * was (options.hints). Whoever meets the island is stranded where its way crosses the shore
 * (mw_segment); whoever leaves the strait is gone.
 *
 *     drift [PARTICLES [CELLS]]      CELLS: of the mesh from west to east */
#include <meshwalk/meshwalk.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { STEPS = 288 };                         /* of five minutes: a day */
static const double LENGTH = 120, WIDTH = 60; /* of the strait, km */
static const double HOURS = 24.0 / STEPS;

typedef struct strait {
    mw_mesh *mesh;
    mw_locator *locator;
    /* at each vertex, to the east and to the north, km/h; the tide is added to it */
    double *current;
} strait;

typedef enum state { AFLOAT, STRANDED, GONE } state;

typedef struct swarm {
    size_t count;
    /* x, y each: a step ago, now, half a step ahead, and the current there */
    double *before, *now, *middle, *current;
    mw_location *at;
    uint32_t *hint;
    uint8_t *state; /* of each particle */
} swarm;

/* --- the strait ------------------------------------------------------------------------------- */

/* How far out of the middle of the island, 1 on its shore, squared. */
static double island(double x, double y)
{
    double dx = (x - 50) / 14, dy = (y - 28) / 9;
    return dx * dx + dy * dy;
}

/* A steady current, slower at the coasts and turned aside by the island, but not enough. */
static void current_at(double x, double y, double current[2])
{
    double coast = 4 * y * (WIDTH - y) / (WIDTH * WIDTH), near = 1 / (1 + island(x, y));
    current[0] = 8 * coast * (1 - 0.5 * near);
    current[1] = 5 * coast * near * (y - 28) / 9;
}

/* Squares of two triangles, but none on the island. */
static size_t strait_triangles(uint32_t columns, uint32_t rows, const double *points,
                               uint32_t *triangles)
{
    uint32_t *v = triangles;
    for (uint32_t i = 0; i < rows * columns; i++) {
        uint32_t a = i / columns * (columns + 1) + i % columns, b = a + 1, d = a + columns + 1,
                 c = d + 1;
        const uint32_t two[6] = {a, b, c, a, c, d};
        if (island(points[2 * a], points[2 * a + 1]) < 1) continue;
        for (int k = 0; k < 6; k++) *v++ = two[k];
    }
    return (size_t)(v - triangles) / 3;
}

static mw_status strait_make(strait *s, uint32_t columns, mw_error *error)
{
    uint32_t rows = columns / 2;
    size_t n = (size_t)(columns + 1) * (rows + 1);
    double *points = malloc(2 * n * sizeof *points);
    uint32_t *triangles = malloc(sizeof *triangles * 6 * columns * rows);
    mw_status status = MW_ERROR_MEMORY;
    s->current = malloc(2 * n * sizeof *s->current);
    if (points && triangles && s->current) {
        for (size_t i = 0; i < n; i++) {
            points[2 * i] = LENGTH * (double)(i % (columns + 1)) / columns;
            points[2 * i + 1] = WIDTH * (double)(i / (columns + 1)) / rows;
            current_at(points[2 * i], points[2 * i + 1], s->current + 2 * i);
        }
        mw_arrays arrays = {.points = points, .point_count = n, .triangles = triangles};
        arrays.triangle_count = strait_triangles(columns, rows, points, triangles);
        status = mw_mesh_create(&arrays, NULL, &s->mesh, error);
        if (!status) status = mw_locator_create(s->mesh, NULL, &s->locator, error);
    }
    free(triangles);
    free(points);
    return status;
}

/* --- the particles ---------------------------------------------------------------------------- */

static int swarm_make(swarm *w, size_t count)
{
    *w = (swarm){.count = count,
                 .before = malloc(2 * count * sizeof(double)),
                 .now = malloc(2 * count * sizeof(double)),
                 .middle = malloc(2 * count * sizeof(double)),
                 .current = malloc(2 * count * sizeof(double)),
                 .at = malloc(count * sizeof(mw_location)),
                 .hint = malloc(count * sizeof(uint32_t)),
                 .state = calloc(count, 1)};
    if (!w->before || !w->now || !w->middle || !w->current || !w->at || !w->hint || !w->state)
        return 0;
    for (size_t i = 0; i < count; i++) { /* in a patch to the west */
        w->now[2 * i] = 5 + 10 * ((double)(i * 7919 % 10007) / 10007);
        w->now[2 * i + 1] = 10 + 40 * ((double)i / (double)count);
        w->hint[i] = MW_NONE; /* nothing is known yet */
    }
    memcpy(w->before, w->now, 2 * count * sizeof *w->now);
    return 1;
}

static void swarm_release(swarm *w)
{
    free(w->before);
    free(w->now);
    free(w->middle);
    free(w->current);
    free(w->at);
    free(w->hint);
    free(w->state);
}

/* In the tide, which turns every six hours, east and west by 3 km/h at most. */
static double tide_at(double hours)
{
    double phase = hours / 6 - (double)(int)(hours / 6), swing = 12 * phase * (1 - phase);
    return (int)(hours / 6) % 2 ? -swing : swing;
}

/* The current at points, by linear interpolation: NaN where there is no water. */
static mw_status swarm_look(swarm *w, const strait *s, const double *points, mw_error *error)
{
    mw_query_options options = {.hints = w->hint};
    mw_value_table table = {.values = s->current, .type = MW_FLOAT64, .count = 2};
    mw_status status =
        mw_locate_batch(s->locator, points, w->count, 2, &options, w->at, NULL, error);
    return status ? status
                  : mw_interpolate_table(s->mesh, &table, w->at, w->count, NULL, w->current, error);
}

/* Particle i has left the water on its way. It stays where the way crosses the first border. */
static mw_status swarm_take_out(swarm *w, const strait *s, size_t i, const double from[2],
                                const double to[2], mw_error *error)
{
    mw_cursor cursor;
    mw_segment way;
    mw_segment_piece piece;
    double in_water = 0;
    mw_status status = mw_cursor_init(s->locator, NULL, &cursor, error);
    if (!status) status = mw_segment_begin(s->locator, &cursor, from, to, &way, error);
    if (status) return status;
    while (mw_segment_next(&way, &piece) && !piece.gap) in_water = piece.to;
    w->state[i] = w->at[i].where == MW_IN_HOLE ? STRANDED : GONE;
    for (size_t k = 0; k < 2; k++)
        w->now[2 * i + k] = w->middle[2 * i + k] = from[k] + in_water * (to[k] - from[k]);
    return MW_OK;
}

/* Each particle that is afloat moves from where it is as the current at `seen` says, where it has
 * come from `from`. */
static mw_status swarm_move(swarm *w, const strait *s, const double *from, const double *seen,
                            double hours, double tide, double *to, mw_error *error)
{
    mw_status status = swarm_look(w, s, seen, error);
    for (size_t i = 0; i < w->count && !status; i++) {
        if (w->state[i] != AFLOAT) continue;
        if (w->at[i].triangle == MW_NONE) {
            status = swarm_take_out(w, s, i, from + 2 * i, seen + 2 * i, error);
            continue;
        }
        double east = w->current[2 * i] + tide, north = w->current[2 * i + 1];
        to[2 * i] = w->now[2 * i] + hours * east;
        to[2 * i + 1] = w->now[2 * i + 1] + hours * north;
    }
    return status;
}

static void swarm_report(const swarm *w, double hours)
{
    size_t count[3] = {0};
    double east = 0;
    for (size_t i = 0; i < w->count; i++) {
        count[w->state[i]]++;
        east += w->state[i] == AFLOAT ? w->now[2 * i] : 0;
    }
    printf("%4.0f h: %zu afloat, at %.1f km on the average; %zu stranded, %zu gone\n", hours,
           count[AFLOAT], count[AFLOAT] ? east / (double)count[AFLOAT] : 0, count[STRANDED],
           count[GONE]);
}

/* The midpoint method: by the current here to the middle of the step, by the current there all the
 * way. */
static mw_status drift(swarm *w, const strait *s, mw_error *error)
{
    mw_status status = MW_OK;
    for (int step = 0; step < STEPS && !status; step++) {
        double now = step * HOURS;
        if (step % (STEPS / 4) == 0) swarm_report(w, now);
        status = swarm_move(w, s, w->before, w->now, HOURS / 2, tide_at(now), w->middle, error);
        if (status) break;
        memcpy(w->before, w->now, 2 * w->count * sizeof *w->now);
        status =
            swarm_move(w, s, w->before, w->middle, HOURS, tide_at(now + HOURS / 2), w->now, error);
    }
    if (!status) swarm_report(w, STEPS * HOURS);
    return status;
}

int main(int argc, char **argv)
{
    long particles = argc > 1 ? atol(argv[1]) : 2000, columns = argc > 2 ? atol(argv[2]) : 120;
    mw_error error = {.message = "out of memory"};
    strait s = {0};
    swarm w = {0};
    if (particles < 1 || columns < 20 || columns > 10000) {
        fprintf(stderr, "usage: drift [PARTICLES [CELLS]], 20 to 10000 cells\n");
        return 2;
    }
    mw_status status = strait_make(&s, (uint32_t)columns, &error);
    if (!status)
        status = swarm_make(&w, (size_t)particles) ? drift(&w, &s, &error) : MW_ERROR_MEMORY;
    if (status) fprintf(stderr, "%s\n", error.message);
    swarm_release(&w);
    free(s.current);
    mw_locator_destroy(s.locator);
    mw_mesh_destroy(s.mesh);
    return status != MW_OK;
}
