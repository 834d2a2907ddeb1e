/* call_runs.h - what the files of long_calls.h share: the calls, and sums of what they make. */
#ifndef MW_TESTS_SUPPORT_CALLS_CALL_RUNS_H
#define MW_TESTS_SUPPORT_CALLS_CALL_RUNS_H

#include "support/calls/call_setting.h"

#include <meshwalk/operator.h>

/* --- sums, which tell one result from another --- */

void call_sum(uint64_t *sum, uint64_t value);
void call_sum_number(uint64_t *sum, double value);
void call_sum_mesh(uint64_t *sum, const mw_mesh *mesh);
void call_sum_locations(uint64_t *sum, const mw_location *at, size_t n);

/* End the program if something does not hold after a call that failed. */
void call_expect(bool holds, const char *what);
/* Add a mesh that was made, or was not, and destroy it. Returns the status. */
mw_status call_mesh_made(mw_status status, mw_mesh *mesh, uint64_t *sum);
/* The same with what a check found. */
mw_status call_check_made(mw_status status, mw_check *check, uint64_t *sum);
/* The operator from the vertices of the mesh to the points; NULL if *status says why not. */
mw_operator *call_operator_of(const call_inputs *in, const call_setting *how, mw_status *status,
                              mw_error *error);

/* --- the calls --- */

/* call_meshes.c */
long_call_run run_delaunay, run_kind_delaunay, run_kind_greedy, run_kind_min_weight,
    run_kind_min_max_angle, run_kind_regular, run_constrained, run_polygons, run_mesh_laid_out,
    run_mesh_as_given, run_check, run_check_damaged, run_mend, run_describe;

/* call_locators.c */
long_call_run run_locator, run_locator_crowded, run_locator_filled, run_locator_open,
    run_index_grid, run_index_two_level, run_index_curve, run_index_layers, run_index_buckets,
    run_index_triangle_buckets, run_index_kd_tree, run_index_chains, run_batch, run_segments,
    run_borrow, run_borrowed_batch, run_editor, run_edits;

/* call_values.c */
long_call_run run_volume_above, run_volume_between, run_surface_area, run_remap_to_mesh,
    run_remap_to_pixels, run_table, run_operator, run_transpose, run_operator_surface,
    run_operator_entries, run_operator_apply;

/* call_space.c */
long_call_run run_surface, run_surface_check, run_star_check, run_star, run_star_borrowed,
    run_star_grid, run_star_octahedron, run_star_batch, run_star_project, run_remesh, run_icosphere,
    run_deviation, run_prober, run_probe_batch, run_probe_any, run_probe_all, run_nearest_batch;

/* call_files.c */
long_call_run run_read, run_read_lines, run_write, run_write_pair, run_write_weights,
    run_write_tiles;

#endif
