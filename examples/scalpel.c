/* scalpel.c - a probe cuts a sheet that deforms, while other threads probe it. The blade goes along
 * a line; where it touches the sheet, an edge opens behind it. Each answer of a probe is of the
 * sheet before an update or after it. */
#include <meshwalk/meshwalk.h>
#include <math.h>
#include <pthread.h>
#include <stdatomic.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>

enum { SIDE = 40, ROW = SIDE + 1, VERTICES = ROW * ROW, PROBERS = 2 };

typedef struct operation {
    mw_surface *surface;
    mw_prober *prober;
    mw_surface_editor *editor;
    mw_probe_cursor cursor[PROBERS]; /* made before the first cut */
    atomic_bool done;
    atomic_uint next, touches, bad;
} operation;

static _Noreturn void fail(const mw_error *error)
{
    fprintf(stderr, "%s\n", error->message);
    exit(1);
}

/* A sheet of side 1 at z = 0, seen from above. */
static void make_sheet(operation *o)
{
    static double points[VERTICES][3];
    static uint32_t triangles[2 * SIDE * SIDE][3];
    for (uint32_t i = 0; i < VERTICES; i++) {
        points[i][0] = (double)(i % ROW) / SIDE;
        points[i][1] = (double)(i / ROW) / SIDE;
    }
    for (uint32_t i = 0; i < SIDE * SIDE; i++) {
        uint32_t a = i / SIDE * ROW + i % SIDE, b = a + 1, d = a + ROW, c = d + 1;
        const uint32_t two[6] = {a, b, c, a, c, d};
        for (uint32_t k = 0; k < 6; k++) triangles[2 * i + k / 3][k % 3] = two[k];
    }
    mw_error error;
    mw_arrays arrays = {.points = points[0],
                        .point_count = VERTICES,
                        .triangles = triangles[0],
                        .triangle_count = 2 * SIDE * SIDE};
    if (mw_surface_create(&arrays, &(mw_surface_options){.shared = 1}, &o->surface, &error) ||
        mw_prober_create(o->surface, &(mw_prober_options){.boxes = 1}, &o->prober, &error) ||
        mw_surface_editor_create(o->surface, &(mw_surface_editor_options){.prober = o->prober},
                                 &o->editor, &error))
        fail(&error);
    for (int i = 0; i < PROBERS; i++)
        if (mw_probe_cursor_init(o->prober, &(mw_probe_options){.certain = 1}, &o->cursor[i],
                                 &error))
            fail(&error);
}

/* Probe here and there, until the cut is done. */
static void *probe(void *argument)
{
    operation *o = argument;
    unsigned me = atomic_fetch_add(&o->next, 1), i = 0;
    const double down[3] = {0, 0, -1};
    do {
        i++;
        const double from[3] = {fmod(0.37 * i, 1), fmod(0.61 * i + 0.1 * me, 1), 1};
        mw_touch touch = mw_probe(o->prober, &o->cursor[me], from, down);
        atomic_fetch_add(&o->touches, touch.state == MW_TOUCH_HIT);
        atomic_fetch_add(&o->bad, touch.state == MW_TOUCH_BAD);
    } while (!atomic_load(&o->done));
    return NULL;
}

/* The sheet is drawn apart, a little in each frame: to the left of the blade's line to the left. */
static void draw_apart(operation *o, uint32_t *left, size_t count)
{
    mw_surface_begin_update(o->surface);
    double *p = mw_surface_points(o->surface);
    for (size_t i = 0; i < count; i++) p[3 * left[i]] -= 0.0002;
    mw_prober_update(o->prober, 0.0003, 1); /* not less than they moved */
    mw_surface_end_update(o->surface);
}

/* The blade enters at the near border, in the middle, and goes to the far one. Each cut makes
 * borders of one more edge; the vertex behind it becomes two. */
static void cut(operation *o)
{
    static uint32_t copies[ROW];
    size_t made = 0;
    mw_error error;
    mw_surface_change change;
    for (uint32_t row = 0; row < SIDE; row++) {
        const uint32_t edge[2] = {row * ROW + SIDE / 2, (row + 1) * ROW + SIDE / 2};
        if (mw_surface_edit_cut(o->editor, edge, 2, &change, &error)) fail(&error);
        for (size_t i = 0; i < change.vertices_made; i++) copies[made++] = change.vertex[i].vertex;
        draw_apart(o, copies, made);
    }
}

int main(void)
{
    operation o = {.surface = NULL};
    pthread_t prober[PROBERS];
    mw_surface_info info;
    make_sheet(&o);
    for (int i = 0; i < PROBERS; i++)
        if (pthread_create(&prober[i], NULL, probe, &o)) return fprintf(stderr, "no thread\n"), 1;
    cut(&o);
    atomic_store(&o.done, true);
    for (int i = 0; i < PROBERS; i++) pthread_join(prober[i], NULL);
    mw_surface_describe(o.surface, &info, NULL);
    printf("%u components, %u vertices\n", info.components, info.vertices);
    printf("threads touched the sheet meanwhile: %s, answers of half an update: %u\n",
           atomic_load(&o.touches) ? "yes" : "no", atomic_load(&o.bad));
    mw_surface_editor_destroy(o.editor);
    mw_prober_destroy(o.prober);
    mw_surface_destroy(o.surface);
    return 0;
}
