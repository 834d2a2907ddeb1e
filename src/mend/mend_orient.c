/* mend_orient.c - turns triangles so that all are counter-clockwise or, in space, go with their
 * neighbours: through each edge that two triangles share, one turns or both stay. */
#include "mend/mend_geometry.h"

#include <stdlib.h>

/* Exchange the last two vertices. The parts of one triangle follow each other: it is noted once. */
static bool orient_turn(mw_mend_work *w, size_t t)
{
    mw_mend_triangle *tri = &w->triangle[t];
    mw__swap(&tri->v[1], &tri->v[2]);
    const mw_mend_change *last = w->change_count ? &w->changes[w->change_count - 1] : NULL;
    if (last && last->kind == MW_MEND_TURNED && last->triangle == tri->from) return true;
    return mw__mend_note(w, MW_MEND_TURNED, tri->from, MW_NONE, MW_NONE);
}

static bool orient_usable(const mw_mend_work *w, const uint32_t v[3])
{
    for (int k = 0; k < 3; k++)
        if (!mw__mend_finite(w, v[k])) return false;
    return true;
}

static bool orient_in_plane(mw_mend_work *w)
{
    for (size_t t = 0; t < w->count; t++) {
        const uint32_t *v = w->triangle[t].v;
        if (orient_usable(w, v) && mw__mend_area(w, v[0], v[1], v[2]) < 0 && !orient_turn(w, t))
            return false;
        if (!mw__job_step(w->job, t, w->count)) return false;
    }
    return true;
}

/* --- in space --- */

typedef struct orient_flood {
    uint32_t *link;  /* per triangle and edge: the half-edge across, or MW_NONE */
    uint32_t *queue; /* the triangles of the component so far */
    uint8_t *state;  /* of a triangle */
} orient_flood;

enum { ORIENT_NEW, ORIENT_STAYS, ORIENT_TURNS };

static void orient_link(const mw_mend_edge *edge, size_t count, uint32_t *link)
{
    for (size_t i = 0, run; i < count; i += run) {
        run = mw__mend_edge_run(edge, count, i);
        if (run != 2) continue;
        uint32_t a = edge[i].half, b = edge[i + 1].half;
        link[3 * (size_t)(a / 4) + a % 4] = b;
        link[3 * (size_t)(b / 4) + b % 4] = a;
    }
}

/* Do the two triangles of an edge run along it in opposite directions, as given? */
static bool orient_agrees(const mw_mend_work *w, uint32_t half, uint32_t across)
{
    return w->triangle[half / 4].v[half % 4] != w->triangle[across / 4].v[across % 4];
}

/* Reach the component of triangle `seed`, which stays at first. Returns its size. */
static uint32_t orient_reach(const mw_mend_work *w, orient_flood *f, uint32_t seed)
{
    uint32_t count = 1;
    f->queue[0] = seed;
    f->state[seed] = ORIENT_STAYS;
    for (uint32_t i = 0; i < count; i++)
        for (uint32_t k = 0; k < 3; k++) {
            uint32_t t = f->queue[i], across = f->link[3 * (size_t)t + k];
            if (across == MW_NONE || f->state[across / 4] != ORIENT_NEW) continue;
            bool stays = orient_agrees(w, 4 * t + k, across) == (f->state[t] == ORIENT_STAYS);
            f->state[across / 4] = stays ? ORIENT_STAYS : ORIENT_TURNS;
            f->queue[count++] = across / 4;
        }
    return count;
}

/* If most of a component would turn, the others turn instead. */
static void orient_choose(orient_flood *f, uint32_t count)
{
    uint32_t turned = 0;
    for (uint32_t i = 0; i < count; i++) turned += f->state[f->queue[i]] == ORIENT_TURNS;
    if (turned <= count / 2) return;
    for (uint32_t i = 0; i < count; i++) {
        uint8_t *state = &f->state[f->queue[i]];
        *state = *state == ORIENT_TURNS ? ORIENT_STAYS : ORIENT_TURNS;
    }
}

static bool orient_flood_all(mw_mend_work *w, orient_flood *f)
{
    for (size_t i = 0; i < 3 * w->count; i++) f->link[i] = MW_NONE;
    size_t count;
    mw_mend_edge *edge = mw__mend_edges(w, &count);
    if (!edge) return false;
    orient_link(edge, count, f->link);
    free(edge);
    for (uint32_t t = 0; t < w->count; t++) {
        if (f->state[t] == ORIENT_NEW) orient_choose(f, orient_reach(w, f, t));
        if (!mw__job_step(w->job, t, w->count)) return false;
    }
    for (size_t t = 0; t < w->count; t++)
        if (f->state[t] == ORIENT_TURNS && !orient_turn(w, t)) return false;
    return true;
}

static bool orient_in_space(mw_mend_work *w)
{
    orient_flood f = {mw__alloc(3 * w->count, sizeof *f.link), mw__alloc(w->count, sizeof *f.queue),
                      mw__calloc(w->count, 1)};
    bool done = f.link && f.queue && f.state && orient_flood_all(w, &f);
    free(f.link);
    free(f.queue);
    free(f.state);
    return done;
}

bool mw__mend_orient(mw_mend_work *w)
{
    mw__job_stage(w->job, "turning triangles", 0.1);
    return w->dimension == 3 ? orient_in_space(w) : orient_in_plane(w);
}
