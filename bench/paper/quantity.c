#include "bench/paper/quantity.h"

const char *quantity_name(quantity q)
{
    static const char *const names[QUANTITIES] = {
        [TRIANGLES_INIT] = "triangles_init",
        [TRIANGLES] = "triangles",
        [TRIANGLES_FINAL] = "triangles_final",
        [TRIANGLES_FINAL_MAX] = "triangles_final_max",
        [ORIENT_INIT] = "orient_init",
        [ORIENT] = "orient",
        [ORIENT_FINAL] = "orient_final",
        [IMPLICIT] = "implicit",
        [COMPARISONS] = "comparisons",
        [WALK_RUNS] = "walk_runs",
        [TRIANGLES_WALK_MAX] = "triangles_walk_max",
        [BORDER_RUNS] = "border_runs",
        [TRIANGLES_BORDER] = "triangles_border",
        [ORIENT_BORDER] = "orient_border",
        [TRIANGLES_BORDER_MAX] = "triangles_border_max",
        [BORDER_EDGES] = "border_edges",
        [BORDER_EDGES_MAX] = "border_edges_max",
        [TRIANGLES_TOTAL] = "triangles_total",
        [SAMPLE] = "sample",
        [INSIDE_PERCENT] = "inside_percent",
        [ORIENT_MAX] = "orient_max",
        [INTERSECTIONS] = "intersections",
        [ITERATIONS] = "iterations",
        [ITERATIONS_MAX] = "iterations_max",
        [FOUND_PER_MILLION] = "found_per_million",
        [LAYERS] = "layers",
        [LOCATOR_BYTES] = "locator_bytes",
        [EDGE_LENGTH] = "edge_length",
        [SIDE_LENGTH] = "side_length",
        [LARGEST_ANGLE] = "largest_angle",
        [OPTIMAL] = "optimal",
        [LOCATOR_SECONDS] = "locator_seconds",
        [TRIANGULATION_SECONDS] = "triangulation_seconds",
        [TIME_US] = "time_us",
        [TIME_EXACT_US] = "time_exact_us",
        [MESH_TRIANGLES] = "mesh_triangles",
        [MESH_BORDER_EDGES] = "mesh_border_edges",
        [MESH_HOLES] = "mesh_holes",
        [HULL_PERCENT] = "hull_percent",
        [CORRELATION] = "correlation",
    };
    return names[q];
}

bool quantity_is_time(quantity q)
{
    return q == TIME_US || q == TIME_EXACT_US || q == LOCATOR_SECONDS || q == TRIANGULATION_SECONDS;
}
