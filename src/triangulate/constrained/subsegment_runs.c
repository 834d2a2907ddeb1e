/* subsegment_runs.c - subsegments that follow each other on one line, joined. */
#include "triangulate/constrained/subsegment_runs.h"

#include <stdlib.h>

void mw__subsegment_runs_release(mw_subsegment_runs *runs)
{
    free(runs->run);
    free(runs->span);
    *runs = (mw_subsegment_runs){0};
}

uint32_t mw__subsegment_run(mw_subsegment_runs *runs, uint32_t subsegment)
{
    mw_subsegment_run *run = runs->run;
    while (run[subsegment].parent != subsegment)
        subsegment = run[subsegment].parent = run[run[subsegment].parent].parent;
    return subsegment;
}

bool mw__subsegment_runs_add(mw_subsegment_runs *runs, const mw_point *point, uint32_t from,
                             uint32_t to)
{
    if (runs->count == runs->room) {
        const size_t room = 2 * runs->room + 64;
        mw_subsegment_run *run = mw__realloc(runs->run, room, sizeof *run);
        if (!run) return false;
        runs->run = run;
        runs->room = room;
    }
    const bool upwards = mw__point_is_before(point[from], point[to]);
    runs->run[runs->count] =
        (mw_subsegment_run){(uint32_t)runs->count, upwards ? from : to, upwards ? to : from};
    runs->count++;
    return true;
}

void mw__subsegment_runs_join(mw_subsegment_runs *runs, const mw_point *point, uint32_t a,
                              uint32_t b)
{
    a = mw__subsegment_run(runs, a);
    b = mw__subsegment_run(runs, b);
    if (a == b) return;
    if (a > b) mw__swap(&a, &b); /* which of them becomes the root does not matter */
    mw_subsegment_run *one = &runs->run[a], *two = &runs->run[b];
    if (mw__point_is_before(point[two->low], point[one->low])) one->low = two->low;
    if (mw__point_is_before(point[one->high], point[two->high])) one->high = two->high;
    two->parent = a;
}

uint32_t mw__subsegment_runs_leave(mw_subsegment_runs *runs, const mw_point *point,
                                   uint32_t subsegment, uint32_t from, uint32_t to)
{
    const mw_subsegment_run *run = &runs->run[mw__subsegment_run(runs, subsegment)];
    if (mw__point_is_before(point[from], point[to]))
        return mw__point_is_before(point[run->high], point[to]) ? run->high : to;
    return mw__point_is_before(point[to], point[run->low]) ? run->low : to;
}

bool mw__subsegment_runs_note(mw_subsegment_runs *runs, const mw_subsegment_span *span)
{
    if (runs->span_count == runs->span_room) {
        const size_t room = 2 * runs->span_room + 64;
        mw_subsegment_span *list = mw__realloc(runs->span, room, sizeof *list);
        if (!list) return false;
        runs->span = list;
        runs->span_room = room;
    }
    runs->span[runs->span_count++] = *span;
    return true;
}
