/* Writing legacy VTK (text, version 3.0), for ParaView: an unstructured grid of triangles with
 * the fields as point data and the triangle fields as cell data. */
#include "io/mesh/mesh_writers.h"
#include "io/text/output.h"

static void vtk_write_values(mw_output *output, const double *values, size_t count)
{
    for (size_t i = 0; i < count && !mw_output_failed(output); i++) {
        mw_output_double(output, values[i]);
        mw__output_char(output, '\n');
    }
}

/* A section of fields: "POINT_DATA" or "CELL_DATA", with `count` values each. */
static void vtk_write_fields(mw_output *output, const char *section, size_t count,
                             char *const *names, double *const *fields, size_t field_count)
{
    if (field_count > 0) mw_output_printf(output, "%s %zu\n", section, count);
    for (size_t f = 0; f < field_count; f++) {
        mw__output_text(output, "SCALARS ");
        mw__output_field_name(output, names, f);
        mw__output_text(output, " double 1\nLOOKUP_TABLE default\n");
        vtk_write_values(output, fields[f], count);
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
    vtk_write_fields(output, "POINT_DATA", file->point_count, file->field_names, file->fields,
                     file->field_count);
    vtk_write_fields(output, "CELL_DATA", file->triangle_count, file->triangle_field_names,
                     file->triangle_fields, file->triangle_field_count);
}

mw_status mw__write_vtk(const char *path, const mw_mesh_file *file, mw_job *job, mw_error *error)
{
    return mw__write_file(path, file, vtk_write, job, error);
}
