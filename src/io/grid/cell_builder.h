/* cell_builder.h - cells as VTK has them: corners one after the other, where each cell ends in
 * them, and its type; values for each cell. They become the faces of a mesh. Private. */
#ifndef MW_SRC_IO_GRID_CELL_BUILDER_H
#define MW_SRC_IO_GRID_CELL_BUILDER_H

#include "io/grid/number_list.h"
#include "io/mesh/mesh_builder.h"

typedef enum mw_cell_type {
    MW_CELL_VERTEX = 1,
    MW_CELL_LINE = 3,
    MW_CELL_TRIANGLE = 5,
    MW_CELL_STRIP = 6,
    MW_CELL_POLYGON = 7,
    MW_CELL_PIXEL = 8,
    MW_CELL_QUAD = 9,
    MW_CELL_FIRST_VOLUME = 10,
    MW_CELL_LAST_LINEAR = 16,
} mw_cell_type;

/* All zero at first. */
typedef struct mw_cell_builder {
    mw_integer_list corners, ends, types;
    char **names; /* of values of cells, and these, one for each cell */
    double **values;
    size_t value_count;
} mw_cell_builder;

/* Add values of points or of cells, `width` for each: names with a number behind them if more
 * than one. Those of points become fields at once. */
mw_status mw__cells_add_values(mw_cell_builder *cells, mw_mesh_builder *builder, const char *name,
                               const double *values, size_t count, size_t width, bool of_cells,
                               mw_error *error);

/* Build the faces, and their values. */
mw_status mw__cells_finish(mw_cell_builder *cells, mw_mesh_builder *builder, mw_error *error);
void mw__cells_release(mw_cell_builder *cells);

#endif
