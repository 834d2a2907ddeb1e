/* dataset_file.h - points to measure with from a file. */
#ifndef MW_BENCH_DATA_DATASET_FILE_H
#define MW_BENCH_DATA_DATASET_FILE_H

#include "bench/data/dataset.h"

#include <meshwalk/meshwalk.h>

#ifdef __cplusplus
extern "C" {
#endif

/* The points of a file of points, or the vertices of a mesh. The domain is their extent; with
 * `enclose` its four corners follow them. Complains about what is wrong; returns 0 or an exit
 * code. */
int dataset_read(dataset *d, const char *path, bool enclose);

/* The same of a file that may be a mesh: then `mesh` has it, and the set is empty; else the mesh
 * is. */
int dataset_read_mesh(dataset *d, mw_mesh_file *mesh, const char *path);

#ifdef __cplusplus
}
#endif

#endif
