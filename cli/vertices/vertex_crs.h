/* vertex_crs.h - points and constraints of a triangulation, brought into one coordinate system. */
#ifndef MW_CLI_VERTICES_VERTEX_CRS_H
#define MW_CLI_VERTICES_VERTEX_CRS_H

#include "cli/frame/options.h"
#include "cli/vertices/vertex_table.h"

/* The options --crs, --points-crs and --constraints-crs; NULL: not given. */
typedef struct vertex_crs_settings {
    const char *mesh, *points, *constraints;
} vertex_crs_settings;

/* Refuse options before anything is read. Returns 0, or an exit code after a complaint. */
int vertex_crs_check(const vertex_crs_settings *settings);

/* Decide on the system of the mesh: that of --crs, or else of the points, or else of the
 * constraints. Points and constraints in other systems are transformed; heights are not. Stores the
 * system in v->file.crs; NULL: unknown. Assumptions and unknown systems are reported on standard
 * error. `points` and `constraints` are paths, or NULL. Returns 0, or an exit code after a
 * complaint. */
int vertex_crs_join(const vertex_crs_settings *settings, const common_settings *common,
                    const char *points, vertex_table *v, const char *constraints,
                    mw_constraint_file *c);

/* Bring constraints into the system of a mesh, which may be NULL: not known. */
int vertex_crs_move_constraints(const common_settings *common, const char *path,
                                mw_constraint_file *c, const char *mesh_path, const char *mesh_crs);

#endif
