/* probe.c - which triangle of a ring a probe touches: one probe, many, and with certainty. */
#include <meshwalk/meshwalk.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

enum {
    ROUND = 60,
    ACROSS = 24,
    VERTICES = ROUND * ACROSS,
    TRIANGLES = 2 * VERTICES,
    PROBES = 1000
};
#define TURN 6.283185307179586

static _Noreturn void fail(const mw_error *error)
{
    fprintf(stderr, "%s\n", error->message);
    exit(1);
}

/* A ring round the z axis: the middle of its tube 2 from the axis, the tube's radius 0.5. Fronts
 * face out. */
static mw_surface *make_ring(void)
{
    static double points[VERTICES][3];
    static uint32_t triangles[TRIANGLES][3];
    for (uint32_t i = 0; i < VERTICES; i++) {
        uint32_t u = i / ACROSS, v = i % ACROSS, u1 = (u + 1) % ROUND, v1 = (v + 1) % ACROSS;
        double along = TURN * u / ROUND, across = TURN * v / ACROSS, radius = 2 + 0.5 * cos(across);
        points[i][0] = radius * cos(along);
        points[i][1] = radius * sin(along);
        points[i][2] = 0.5 * sin(across);
        uint32_t a = i, b = u1 * ACROSS + v, c = u1 * ACROSS + v1, d = u * ACROSS + v1;
        const uint32_t two[6] = {a, b, c, a, c, d};
        for (uint32_t k = 0; k < 6; k++) triangles[2 * i + k / 3][k % 3] = two[k];
    }
    mw_arrays arrays = {.points = points[0],
                        .point_count = VERTICES,
                        .triangles = triangles[0],
                        .triangle_count = TRIANGLES};
    mw_surface *surface;
    mw_error error;
    if (mw_surface_create(&arrays, NULL, &surface, &error)) fail(&error);
    return surface;
}

/* A probe at x, 0.1, z that moves down. */
static void show(const mw_prober *prober, mw_probe_cursor *cursor, double x, double z)
{
    mw_touch touch = mw_probe(prober, cursor, (double[3]){x, 0.1, z}, (double[3]){0, 0, -1});
    printf("down from (%g, 0.1, %g): %s", x, z, mw_touch_state_name(touch.state));
    if (touch.state == MW_TOUCH_HIT)
        printf(", triangle %u, %.3f ahead", touch.triangle, touch.distance);
    printf("\n");
}

/* Probes that go round the ring and down on it; each begins with the triangle that the one before
 * it touched. */
static void go_round(const mw_prober *prober, const mw_probe_options *options, mw_touch *touches)
{
    static double queries[PROBES][6];
    mw_error error;
    for (int i = 0; i < PROBES; i++) {
        double along = TURN * i / PROBES;
        const double query[6] = {2.03 * cos(along), 2.03 * sin(along), 0.6, 0.1, 0, -1};
        for (int k = 0; k < 6; k++) queries[i][k] = query[k];
    }
    if (mw_probe_batch(prober, queries[0], PROBES, 6, options, touches, NULL, &error)) fail(&error);
}

int main(void)
{
    static mw_touch as_published[PROBES], for_certain[PROBES];
    mw_error error;
    mw_surface *surface = make_ring();
    mw_prober *prober;
    mw_probe_cursor quick, complete;
    mw_probe_options certain = {.certain = 1}, near = {.max_distance = 0.3};
    if (mw_prober_create(surface, &(mw_prober_options){.boxes = 1}, &prober, &error) ||
        mw_probe_cursor_init(prober, NULL, &quick, &error) ||
        mw_probe_cursor_init(prober, &certain, &complete, &error))
        fail(&error);

    show(prober, &quick, 2.1, 1);    /* above the ring                                           */
    show(prober, &quick, 2.1, 0.4);  /* just gone in: behind the probe is touched, too           */
    show(prober, &quick, 0.3, 1);    /* through the hole: no walk finds any, which proves nothing */
    show(prober, &complete, 0.3, 1); /* but this does                                            */

    uint32_t touched = 0, differing = 0;
    go_round(prober, &near, as_published);
    near.certain = 1;
    go_round(prober, &near, for_certain);
    for (int i = 0; i < PROBES; i++) {
        touched += for_certain[i].state == MW_TOUCH_HIT;
        differing += as_published[i].triangle != for_certain[i].triangle;
    }
    printf("%d probes round the ring, %u touch it, %u answers differ\n", PROBES, touched,
           differing);

    mw_prober_destroy(prober);
    mw_surface_destroy(surface);
    return 0;
}
