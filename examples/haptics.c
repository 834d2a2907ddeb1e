/* haptics.c [SECONDS]: a haptic loop at 1 kHz, by default for 2 seconds. A thread makes a ball
 * swell and shrink a hundred times a second; the loop presses a tool into the ball and drags it
 * along. It computes a contact that sticks and slides, and the force on the tool; then it prints
 * how long a step took and how late steps began. */
#define _GNU_SOURCE /* clock_nanosleep */
#include <meshwalk/meshwalk.h>
#include <math.h>
#include <pthread.h>
#include <stdatomic.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

enum {
    RINGS = 63,
    AROUND = 128,
    VERTICES = RINGS * AROUND + 2,
    TRIANGLES = 2 * RINGS * AROUND,
    RATE = 1000,  /* steps of the loop a second */
    FRAMES = 100, /* changes of the ball a second */
};

#define STIFFNESS 400.0 /* N/m */
#define FRICTION 0.4    /* of Coulomb: tangential force over normal force */
#define TURN 6.283185307179586

static _Noreturn void fail(const char *what)
{
    fprintf(stderr, "haptics: %s\n", what);
    exit(1);
}

/* --- time ------------------------------------------------------------------------------------- */

static double seconds_now(void)
{
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

/* Waits for a time of seconds_now, which may have passed. */
static void wait_until(double time)
{
    struct timespec when = {.tv_sec = (time_t)time, .tv_nsec = (long)(1e9 * (time - floor(time)))};
    clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &when, NULL);
}

/* --- the ball --------------------------------------------------------------------------------- */

typedef struct ball {
    mw_surface *surface;
    mw_prober *prober;
    double direction[VERTICES][3];
    atomic_bool done; /* the loop has ended */
} ball;

static void ball_set_directions(ball *b)
{
    for (uint32_t i = 0; i < RINGS * AROUND; i++) {
        double polar = TURN / 2 * (i / AROUND + 1) / (RINGS + 1),
               longitude = TURN * (i % AROUND) / AROUND;
        b->direction[i][0] = sin(polar) * cos(longitude);
        b->direction[i][1] = sin(polar) * sin(longitude);
        b->direction[i][2] = cos(polar);
    }
    b->direction[VERTICES - 2][2] = 1;
    b->direction[VERTICES - 1][2] = -1;
}

static void triangle_set(uint32_t triangle[3], uint32_t a, uint32_t b, uint32_t c)
{
    triangle[0] = a;
    triangle[1] = b;
    triangle[2] = c;
}

/* Strips between the rings, and a cap at each pole; counter-clockwise from outside. */
static void ball_set_triangles(uint32_t triangles[][3])
{
    uint32_t t = 0;
    for (uint32_t i = 0; i < AROUND; i++) {
        uint32_t next = (i + 1) % AROUND, last = (RINGS - 1) * AROUND;
        triangle_set(triangles[t++], VERTICES - 2, i, next);
        triangle_set(triangles[t++], VERTICES - 1, last + next, last + i);
        for (uint32_t ring = 0; ring + AROUND < RINGS * AROUND; ring += AROUND) {
            triangle_set(triangles[t++], ring + i, ring + AROUND + i, ring + AROUND + next);
            triangle_set(triangles[t++], ring + i, ring + AROUND + next, ring + next);
        }
    }
}

/* The shape of the ball at a time: radius 1, with waves of 5 % that run over it. */
static void ball_shape(const ball *b, double time, double points[][3])
{
    for (uint32_t v = 0; v < VERTICES; v++) {
        const double *d = b->direction[v];
        double radius = 1 + 0.05 * sin(3 * d[0] + 2 * d[1] + 3 * time) * cos(2 * d[2] - time);
        for (int k = 0; k < 3; k++) points[v][k] = radius * d[k];
    }
}

static void ball_make(ball *b)
{
    static uint32_t triangles[TRIANGLES][3];
    static double points[VERTICES][3];
    mw_error error;
    ball_set_directions(b);
    ball_set_triangles(triangles);
    ball_shape(b, 0, points);
    mw_arrays arrays = {.points = points[0],
                        .point_count = VERTICES,
                        .triangles = triangles[0],
                        .triangle_count = TRIANGLES};
    if (mw_surface_create(&arrays, &(mw_surface_options){.shared = 1}, &b->surface, &error) ||
        mw_prober_create(b->surface, &(mw_prober_options){.boxes = 1}, &b->prober, &error))
        fail(error.message);
}

/* Queries wait while the surface changes. So the new shape is computed before, and how far it
 * moves is known: then boxes are enlarged, and only now and then fitted. */
static void ball_change(ball *b, double time)
{
    static double points[VERTICES][3];
    double moved = 0, *own = mw_surface_points(b->surface);
    ball_shape(b, time, points);
    for (uint32_t v = 0; v < VERTICES; v++) {
        const double *p = points[v], *o = own + 3 * v;
        moved = fmax(moved, hypot(hypot(p[0] - o[0], p[1] - o[1]), p[2] - o[2]));
    }
    mw_surface_begin_update(b->surface);
    memcpy(own, points, sizeof points);
    mw_prober_update(b->prober, 1.001 * moved, 1); /* not less than it was, for all roundings */
    mw_surface_end_update(b->surface);
}

static void *ball_live(void *argument)
{
    ball *b = argument;
    double start = seconds_now();
    for (int frame = 1; !atomic_load(&b->done); frame++) {
        ball_change(b, (double)frame / FRAMES);
        wait_until(start + (double)frame / FRAMES);
    }
    return NULL;
}

/* --- contact ---------------------------------------------------------------------------------- */

typedef struct contact {
    bool touching;
    double point[3]; /* on the ball: the spring between it and the tool makes the force */
    unsigned pressed, stuck, slid; /* steps */
    double strongest;              /* force, N */
} contact;

static double distance_between(const double a[3], const double b[3])
{
    return hypot(hypot(a[0] - b[0], a[1] - b[1]), a[2] - b[2]);
}

static void nearest_to(const ball *b, const double from[3], double point[3])
{
    mw_nearest_surface_point nearest;
    mw_error error;
    if (mw_nearest_on_surface(b->prober, from, INFINITY, &nearest, &error)) fail(error.message);
    memcpy(point, nearest.point, 3 * sizeof *point);
}

/* Coulomb's law. The foot is the nearest point of the ball: without friction the contact would be
 * there. With friction it stays where it is while it is nearer to the foot than FRICTION times the
 * depth; else it slides up to that distance. */
static void contact_follow(contact *c, const ball *b, const double tool[3])
{
    double foot[3], wanted[3];
    nearest_to(b, tool, foot);
    if (!c->touching) memcpy(c->point, foot, sizeof foot);
    double reach = FRICTION * distance_between(tool, foot), away = distance_between(c->point, foot);
    bool slides = away > reach;
    for (int k = 0; k < 3; k++) {
        double along = slides ? reach / away : 1;
        wanted[k] = foot[k] + along * (c->point[k] - foot[k]);
    }
    nearest_to(b, wanted, c->point); /* the ball has moved, too */
    c->slid += slides;
    c->stuck += !slides;
    c->touching = true;
    c->pressed++;
    c->strongest = fmax(c->strongest, STIFFNESS * distance_between(c->point, tool));
}

/* The tool goes round in the skin of the ball, up and down, and comes out now and then. */
static void tool_at(double time, double tool[3])
{
    double longitude = time, latitude = 0.8 * sin(2.3 * time), radius = 0.93 + 0.09 * sin(5 * time);
    tool[0] = radius * cos(latitude) * cos(longitude);
    tool[1] = radius * cos(latitude) * sin(longitude);
    tool[2] = radius * sin(latitude);
}

/* Is the tool in the ball? A line from it towards the centre touches the skin behind it then. */
static bool tool_is_inside(const ball *b, mw_probe_cursor *cursor, const double tool[3])
{
    const double inwards[3] = {-tool[0], -tool[1], -tool[2]};
    mw_touch touch = mw_probe(b->prober, cursor, tool, inwards);
    return touch.state == MW_TOUCH_HIT && touch.distance < 0;
}

/* --- the loop --------------------------------------------------------------------------------- */

typedef struct timing {
    double *took, *late; /* of each step, in microseconds */
    unsigned steps;
} timing;

static contact loop_run(ball *b, timing *t)
{
    contact c = {.touching = false};
    mw_probe_options options = {.max_distance = 0.5, .certain = 1};
    mw_probe_cursor cursor;
    mw_error error;
    if (mw_probe_cursor_init(b->prober, &options, &cursor, &error)) fail(error.message);
    double start = seconds_now();
    for (unsigned i = 0; i < t->steps; i++) {
        double due = start + (double)i / RATE, tool[3];
        wait_until(due);
        double begin = seconds_now();
        tool_at((double)i / RATE, tool);
        if (tool_is_inside(b, &cursor, tool))
            contact_follow(&c, b, tool);
        else
            c.touching = false;
        t->late[i] = 1e6 * (begin - due);
        t->took[i] = 1e6 * (seconds_now() - begin);
    }
    return c;
}

static int doubles_compare(const void *a, const void *b)
{
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

/* Sorts the values. */
static void print_spread(const char *what, double *value, unsigned count)
{
    double sum = 0;
    for (unsigned i = 0; i < count; i++) sum += value[i];
    qsort(value, count, sizeof *value, doubles_compare);
    printf("%s: %.1f us on average, 99 %% within %.1f, at most %.1f\n", what, sum / count,
           value[count - 1 - count / 100], value[count - 1]);
}

int main(int argc, char **argv)
{
    static ball b;
    double seconds = argc > 1 ? atof(argv[1]) : 2;
    if (!(seconds >= 0.1 && seconds <= 3600)) fail("give the number of seconds, 0.1 to 3600");
    timing t = {.steps = (unsigned)(seconds * RATE)};
    t.took = malloc(2 * t.steps * sizeof *t.took);
    if (!t.took) fail("no memory");
    t.late = t.took + t.steps;
    pthread_t life;
    ball_make(&b);
    if (pthread_create(&life, NULL, ball_live, &b)) fail("no thread");
    contact c = loop_run(&b, &t);
    atomic_store(&b.done, true);
    pthread_join(life, NULL);
    printf("%u steps: pressed in %u; the contact stuck in %u and slid in %u\n", t.steps, c.pressed,
           c.stuck, c.slid);
    printf("strongest force: %.1f N\n", c.strongest);
    print_spread("a step took", t.took, t.steps);
    print_spread("a step began late by", t.late, t.steps);
    free(t.took);
    mw_prober_destroy(b.prober);
    mw_surface_destroy(b.surface);
    return 0;
}
