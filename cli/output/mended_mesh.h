/* mended_mesh.h - the mesh of a file, mended: its values kept, and what there is to tell about it.
 */
#ifndef MW_CLI_OUTPUT_MENDED_MESH_H
#define MW_CLI_OUTPUT_MENDED_MESH_H

#include "cli/frame/options.h"
#include "cli/frame/text.h"

#include <meshwalk/meshwalk.h>

/* A value that was lost, because it differs from that of the vertex that its vertex was welded to.
 */
typedef struct lost_value {
    uint32_t vertex, kept; /* numbers in the file */
    size_t field;          /* of the file; SIZE_MAX: z */
    double value, kept_value;
} lost_value;

typedef struct mended_mesh {
    mw_mended mended;                   /* its triangles have gone to the file */
    size_t old_vertices, old_triangles; /* that the file had */
    lost_value *lost;
    size_t lost_count;
} mended_mesh;

/* The names of repairs, for --help. */
extern const choices mend_repairs;

/* Parse a list of repairs: a sum of mw_repair_kind. Returns 0, or END_USAGE after a complaint. */
int mended_mesh_parse(const char *list, uint32_t *repairs);

/* Mend the mesh of `file`, read from `path`, in place. Returns 0, or an exit code after a
 * complaint. Release in either case. */
int mended_mesh_create(mended_mesh *m, const char *path, mw_mesh_file *file,
                       const mw_mend_options *options);
void mended_mesh_release(mended_mesh *m);

/* Write what was done, a line for each change, or the members "changes" and "lost" of a JSON
 * object. */
void mended_mesh_tell(const mended_mesh *m, const mw_mesh_file *file, text *t);
void mended_mesh_tell_json(const mended_mesh *m, const mw_mesh_file *file, text *t);
/* One line that sums it up. */
void mended_mesh_sum_up(const mended_mesh *m, const char *path, text *t);

/* Write which numbers became which, as CSV. */
void mended_mesh_write_numbers(const mended_mesh *m, mw_output *out);

#endif
