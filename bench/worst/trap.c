/* trap.c - the list of traps. */
#include "bench/worst/trap.h"
#include "bench/worst/trap_entry.h"

#include <math.h>

static const trap_entry traps[] = {
    {"strip-30", "steps that shrink by 2^30 along a strip", trap_in_plane, trap_strip_30, 0, 0, 0},
    {"strip-300", "by 2^300", trap_in_plane, trap_strip_300, 0, 0, 0},
    {"strip-2000", "by 2^2000", trap_in_plane, trap_strip_2000, 0, 0, 0},
    {"fan", "all triangles at one vertex, far away", trap_in_plane, trap_fan, 0, 0, 0},
    {"half-fan", "half a wheel", trap_in_plane, trap_half_fan, 0, 0, 0},
    {"hubs", "a row of vertices between two hubs", trap_in_plane, trap_hubs, 0, 0, 0},
    {"rings", "squares round one another", trap_in_plane, trap_rings, 0, 0, 0},
    {"hub", "a vertex of n/10 edges among uniform ones", trap_in_plane, trap_hub_within, 0, 0, 0},
    {"fan-within", "the same, on one side only", trap_in_plane, trap_fan_within, 0, 0, 0},
    {"spiral", "points along a spiral", trap_in_plane, trap_spiral, 0, 0, 0},
    {"comb", "long thin teeth, the gaps filled", trap_in_plane, trap_comb, 0, 0, 0},
    {"weave", "squares of long thin triangles, across one another", trap_in_plane, trap_weave, 0, 0,
     0},
    {"quadtree", "corners of a deep quadtree", trap_in_plane, trap_quadtree, 0, 0, 0},
    {"layers", "60 layers round a circle, 1e-9 to 1 thick", trap_in_plane, trap_layers_round, 0, 0,
     0},
    {"extent-1e-150", "uniform points, multiplied", trap_in_plane, trap_tiny, 0, 0, 0},
    {"extent-1e-290", "the same", trap_in_plane, trap_tinier, 0, 0, 0},
    {"extent-1e250", "the same", trap_in_plane, trap_huge, 0, 0, 0},
    {"vertices", "uniform points, queries at them", trap_in_plane, trap_uniform, TRAP_ON_VERTICES,
     0, 0},
    {"edges", "at rounded middles of edges", trap_in_plane, trap_uniform, TRAP_ON_EDGES, 0, 0},
    {"clusters-grid", "clusters, queries at their points, start grid", trap_in_plane, trap_clusters,
     TRAP_ON_VERTICES, MW_START_GRID, 0},
    {"few-cluster", "one point in 100 in a tiny disc, queries there", trap_in_plane,
     trap_few_cluster, 0, 0, 0},
    {"few-graded", "in two rows that shrink by 2^36, queries there", trap_in_plane, trap_few_graded,
     0, 0, 0},
    {"few-comb", "in two rows of equal steps, queries there", trap_in_plane, trap_few_comb, 0, 0,
     0},
    {"few-wheel", "round one point, queries there", trap_in_plane, trap_few_wheel, 0, 0, 0},
    {"few-wheels", "round eight points, queries there", trap_in_plane, trap_few_wheels, 0, 0, 0},
    {"pole", "a star-shaped polyhedron with two poles", trap_of_star, NULL, 0, 0, 0},
    {"editor-hub", "queries on the hub of an edited wheel", trap_in_editor, trap_half_fan, 0, 0, 0},
    {"equal-probe", "a certain probe of equal triangles", trap_of_probe, NULL, 0, 0, LAYERS_EQUAL},
    {"turned-probe", "the same, turned in six ways", trap_of_probe, NULL, 0, 0, LAYERS_TURNED},
    {"near-probe", "the same, one ulp apart", trap_of_probe, NULL, 0, 0, LAYERS_NEAR},
    {"delaunay-1e-300", "triangulating uniform points, multiplied", trap_of_delaunay, trap_least, 0,
     0, 0},
    {"delaunay-5e-324", "multiples of the least double", trap_of_delaunay, trap_denormal, 0, 0, 0},
    {"delaunay-circle", "rounded points of a circle", trap_of_delaunay, trap_circle, 0, 0, 0},
    {"overlapping", "constraints along one line", trap_of_segments, NULL, 0, 0, 0},
};
enum { TRAPS = sizeof traps / sizeof *traps };

const char *trap_name(int trap)
{
    return trap >= 0 && trap < TRAPS ? traps[trap].name : NULL;
}

const char *trap_help(int trap)
{
    return trap >= 0 && trap < TRAPS ? traps[trap].help : NULL;
}

int trap_measure(int trap, const trap_plan *plan, trap_figures *figures)
{
    *figures = (trap_figures){.build = NAN, .batch = NAN, .alone = NAN, .steps = NAN, .bytes = NAN};
    for (size_t i = 0; i < ENGINES; i++) figures->peers[i] = (trap_peer_figures){NAN, NAN, NAN};
    return traps[trap].kind(&traps[trap], plan, figures);
}
