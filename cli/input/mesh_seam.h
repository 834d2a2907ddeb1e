/* mesh_seam.h - meshes that go round the globe, cut so that they lie in the plane (remap.h). */
#ifndef MW_CLI_INPUT_MESH_SEAM_H
#define MW_CLI_INPUT_MESH_SEAM_H

#include <meshwalk/meshwalk.h>

/* Put the pieces in the place of the mesh of a file: points, without heights, triangles and faces.
 * *pieces keeps `values` and `west`; release it in any case. Fields stay those of the vertices that
 * the file had. Returns 0, or an exit code after a complaint. */
int mesh_seam_cut(mw_mesh_file *file, const char *path, mw_seam_pieces *pieces);

/* Complain, after a mesh was refused, that the triangles it names are those of the pieces. */
void mesh_seam_explain(const char *path, const mw_seam_pieces *pieces);

#endif
