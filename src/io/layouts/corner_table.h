/* corner_table.h - the corners of all faces of a netCDF mesh, as they are numbered in the file.
 * Private. */
#ifndef MW_SRC_IO_LAYOUTS_CORNER_TABLE_H
#define MW_SRC_IO_LAYOUTS_CORNER_TABLE_H

#include "base/job.h"
#include "io/layouts/layout_find.h"

/* No corner: a face with fewer than the most. */
#define MW_NO_CORNER INT32_MIN

typedef struct mw_corner_table {
    int32_t *corners; /* `width` numbers a face; those of a face come first, then MW_NO_CORNER */
    size_t face_count, width;
    int64_t first_number; /* what they are counted from: 0 or 1 */
} mw_corner_table;

/* Read the corners, and decide whether vertices are numbered from 0 or 1: as the file or the user
 * says; otherwise as usual in the layout. If that would name vertices that do not exist, and the
 * other number would not, the other number is taken. Afterwards every corner of the table is a
 * vertex of the mesh. Errors name the variable and the face. */
mw_status mw__corner_table_read(const mw_netcdf *file, const mw_layout *layout, size_t vertex_count,
                                mw_job *job, mw_corner_table *table, mw_error *error);
void mw__corner_table_release(mw_corner_table *table);

#endif
