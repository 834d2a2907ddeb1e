/* Writing legacy VTK (text, version 3.0), for ParaView: an unstructured grid of triangles with
 * the fields as point data. */
#include "io/mesh/mesh_writers.h"
#include "io/text/output.h"

static void vtk_write_values(mw_output *output, const double *values, size_t count)
{
    for (size_t i = 0; i < count && !mw_output_failed(output); i++) {
        mw_output_double(output, values[i]);
        mw__output_char(output, '\n');
    }
}

static void vtk_write(mw_output *output, const mw_mesh_file *file)
{
    mw_output_printf(output,
                     "# vtk DataFile Version 3.0\nmeshwalk\nASCII\nDATASET "
                     "UNSTRUCTURED_GRID\nPOINTS %zu double\n",
                     file->point_count);
    mw__output_points(output, file);
    mw_output_printf(output, "CELLS %zu %zu\n", file->triangle_count, 4 * file->triangle_count);
    mw__output_triangles(output, file);
    mw_output_printf(output, "CELL_TYPES %zu\n", file->triangle_count);
    for (size_t t = 0; t < file->triangle_count && !mw_output_failed(output); t++)
        mw__output_text(output, "5\n");
    if (file->field_count > 0) mw_output_printf(output, "POINT_DATA %zu\n", file->point_count);
    for (size_t f = 0; f < file->field_count; f++) {
        mw__output_text(output, "SCALARS ");
        mw__output_field_name(output, file, f);
        mw__output_text(output, " double 1\nLOOKUP_TABLE default\n");
        vtk_write_values(output, file->fields[f], file->point_count);
    }
}

mw_status mw__write_vtk(const char *path, const mw_mesh_file *file, mw_job *job, mw_error *error)
{
    return mw__write_file(path, file, vtk_write, job, error);
}
