/* counters.c - what queries did, added up. */
#include <meshwalk/locate.h>

static void counters_raise(uint64_t *most, uint64_t value)
{
    if (value > *most) *most = value;
}

void mw_counters_add(mw_counters *sum, const mw_counters *more)
{
    sum->queries += more->queries;
    sum->triangles_visited += more->triangles_visited;
    counters_raise(&sum->triangles_max, more->triangles_max);
    sum->triangles_init += more->triangles_init;
    sum->triangles += more->triangles;
    counters_raise(&sum->triangles_walk_max, more->triangles_walk_max);
    sum->triangles_final += more->triangles_final;
    counters_raise(&sum->triangles_final_max, more->triangles_final_max);
    sum->orient_init += more->orient_init;
    sum->orient += more->orient;
    sum->orient_final += more->orient_final;
    sum->implicit += more->implicit;
    sum->comparisons += more->comparisons;
    sum->walk_runs += more->walk_runs;
    sum->border_runs += more->border_runs;
    sum->triangles_border += more->triangles_border;
    counters_raise(&sum->triangles_border_max, more->triangles_border_max);
    sum->orient_border += more->orient_border;
    sum->border_edges += more->border_edges;
    counters_raise(&sum->border_edges_max, more->border_edges_max);
    sum->cycles += more->cycles;
    sum->handovers += more->handovers;
}
