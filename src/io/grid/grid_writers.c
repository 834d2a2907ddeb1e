#include "io/grid/grid_writers.h"

#include <string.h>

const double *mw__vertex_values(const mw_mesh_file *file, const char *name)
{
    for (size_t f = 0; f < file->field_count; f++)
        if (strcmp(file->field_names[f], name) == 0) return file->fields[f];
    return NULL;
}

const double *mw__triangle_values(const mw_mesh_file *file, const char *name)
{
    for (size_t f = 0; f < file->triangle_field_count; f++)
        if (strcmp(file->triangle_field_names[f], name) == 0) return file->triangle_fields[f];
    return NULL;
}

double mw__vertex_depth(const mw_mesh_file *file, const double *depths, size_t v)
{
    return depths ? depths[v] : file->has_z ? 0 - file->points[3 * v + 2] : 0;
}

void mw__output_signed(mw_output *output, int64_t value)
{
    if (value < 0) mw__output_char(output, '-');
    mw__output_integer(output, value < 0 ? 0 - (uint64_t)value : (uint64_t)value);
}
