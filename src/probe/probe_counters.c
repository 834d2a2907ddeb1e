/* probe_counters.c - adds counters of probes. */
#include "probe/prober.h"

static void counter_raise(uint64_t *most, uint64_t value)
{
    if (value > *most) *most = value;
}

void mw_probe_counters_add(mw_probe_counters *sum, const mw_probe_counters *more)
{
    sum->queries += more->queries;
    sum->hits += more->hits;
    sum->samples += more->samples;
    sum->triangles += more->triangles;
    counter_raise(&sum->triangles_max, more->triangles_max);
    sum->tests += more->tests;
    counter_raise(&sum->tests_max, more->tests_max);
    sum->intersections += more->intersections;
    sum->iterations += more->iterations;
    counter_raise(&sum->iterations_max, more->iterations_max);
    sum->boxes += more->boxes;
    sum->box_triangles += more->box_triangles;
}

void mw__probe_count(mw_probe_counters *sum, mw_probe_counters *work, bool hit)
{
    work->queries = 1;
    work->hits = hit;
    work->triangles_max = work->triangles;
    work->tests_max = work->tests;
    work->iterations_max = work->iterations;
    mw_probe_counters_add(sum, work);
}
