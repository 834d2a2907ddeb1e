/* control_loop.c - a haptic control loop: one thread deforms a sheet, another presses a tool
 * against it and computes a force. An update waits for the query that runs, a query for the
 * update. */
#define _POSIX_C_SOURCE 200809L /* nanosleep */
#include <meshwalk/meshwalk.h>
#include <math.h>
#include <pthread.h>
#include <stdatomic.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <time.h>

enum { SIDE = 60, VERTICES = (SIDE + 1) * (SIDE + 1), TRIANGLES = 2 * SIDE * SIDE, STEPS = 200 };

typedef struct sheet {
    mw_surface *surface;
    mw_prober *prober;
    atomic_bool done; /* the loop has ended */
    unsigned frames;
} sheet;

static _Noreturn void fail(const char *what)
{
    fprintf(stderr, "%s\n", what);
    exit(1);
}

static void wait_a_millisecond(void)
{
    nanosleep(&(struct timespec){.tv_nsec = 1000000}, NULL);
}

/* A square of side 2 round the origin, at z = 0, seen from above. */
static void make_sheet(sheet *s)
{
    static double points[VERTICES][3];
    static uint32_t triangles[TRIANGLES][3];
    for (uint32_t i = 0; i < VERTICES; i++) {
        points[i][0] = 2.0 * (i % (SIDE + 1)) / SIDE - 1;
        points[i][1] = 2.0 * (i / (SIDE + 1)) / SIDE - 1;
    }
    for (uint32_t i = 0; i < SIDE * SIDE; i++) {
        uint32_t a = i / SIDE * (SIDE + 1) + i % SIDE, b = a + 1, d = a + SIDE + 1, c = d + 1;
        const uint32_t two[6] = {a, b, c, a, c, d};
        for (uint32_t k = 0; k < 6; k++) triangles[2 * i + k / 3][k % 3] = two[k];
    }
    mw_arrays arrays = {.points = points[0],
                        .point_count = VERTICES,
                        .triangles = triangles[0],
                        .triangle_count = TRIANGLES};
    mw_error error;
    if (mw_surface_create(&arrays, &(mw_surface_options){.shared = 1}, &s->surface, &error) ||
        mw_prober_create(s->surface, &(mw_prober_options){.boxes = 1}, &s->prober, &error))
        fail(error.message);
}

/* A wave of height 0.1 runs over the sheet. How far its vertices move is known, so the boxes need
 * not be fitted in each frame. */
static void deform(sheet *s, double time)
{
    mw_surface_begin_update(s->surface);
    double moved = 0, *p = mw_surface_points(s->surface);
    for (int i = 0; i < VERTICES; i++, p += 3) {
        double z = 0.1 * sin(4 * p[0] + p[1] - time);
        moved = fmax(moved, fabs(z - p[2]));
        p[2] = z;
    }
    mw_prober_update(s->prober, 1.001 * moved, 1); /* not less than it was, for all roundings */
    mw_surface_end_update(s->surface);
}

static void *simulate(void *argument)
{
    sheet *s = argument;
    do {
        deform(s, 0.02 * ++s->frames);
        wait_a_millisecond();
    } while (!atomic_load(&s->done));
    return NULL;
}

/* The force on the tool: of a spring to its proxy, the nearest point of the sheet. The sheet may
 * be in a later frame than when the tool was found below it; each answer is of one frame. */
static void pull(const sheet *s, const double tool[3], double force[3])
{
    mw_nearest_surface_point proxy;
    mw_error error;
    if (mw_nearest_on_surface(s->prober, tool, INFINITY, &proxy, &error)) fail(error.message);
    for (int k = 0; k < 3; k++) force[k] = 400 * (proxy.point[k] - tool[k]);
}

/* The tool goes round below the sheet. The cursor remembers what it touched last: on a path the
 * next touch is near. */
static void control(const sheet *s)
{
    mw_error error;
    mw_probe_cursor cursor;
    mw_probe_options options = {.max_distance = 0.5, .certain = 1};
    if (mw_probe_cursor_init(s->prober, &options, &cursor, &error)) fail(error.message);
    unsigned below = 0, pushed = 0;
    const double down[3] = {0, 0, -1};
    for (int i = 0; i < STEPS; i++) {
        double angle = 6.283185307179586 * i / STEPS, force[3] = {0, 0, 0};
        const double tool[3] = {0.7 * cos(angle), 0.7 * sin(angle), -0.2};
        mw_touch touch = mw_probe(s->prober, &cursor, tool, down);
        if (touch.state == MW_TOUCH_HIT && touch.distance < 0) {
            below++;
            pull(s, tool, force);
        }
        pushed += force[2] > 0;
        wait_a_millisecond();
    }
    printf("%d steps, below the sheet in %u, pushed up in %u\n", STEPS, below, pushed);
}

int main(void)
{
    sheet s = {.frames = 0};
    pthread_t simulation;
    make_sheet(&s);
    if (pthread_create(&simulation, NULL, simulate, &s)) fail("no thread");
    control(&s);
    atomic_store(&s.done, true);
    pthread_join(simulation, NULL);
    printf("the sheet moved meanwhile: %s\n", s.frames > 0 ? "yes" : "no");
    mw_prober_destroy(s.prober);
    mw_surface_destroy(s.surface);
    return 0;
}
