#include "io/grid/grid_writers.h"

#include <string.h>

static bool face_is_fan(const mw_mesh_file *file, size_t t, size_t count)
{
    for (size_t i = t + 1; i < t + count; i++)
        if (file->triangles[3 * i] != file->triangles[3 * t] ||
            file->triangles[3 * i + 1] != file->triangles[3 * i - 1])
            return false;
    return true;
}

size_t mw__face_triangles(const mw_mesh_file *file, size_t t, size_t corners)
{
    if (!file->faces || (t > 0 && file->faces[t - 1] == file->faces[t])) return 1;
    size_t count = 1;
    while (t + count < file->triangle_count && file->faces[t + count] == file->faces[t]) count++;
    return count + 2 <= corners && face_is_fan(file, t, count) ? count : 1;
}

uint32_t mw__face_corner(const mw_mesh_file *file, size_t t, size_t k)
{
    return file->triangles[k < 2 ? 3 * t + k : 3 * (t + k - 2) + 2];
}

size_t mw__face_count(const mw_mesh_file *file, size_t corners)
{
    size_t count = 0;
    for (size_t t = 0; t < file->triangle_count; t += mw__face_triangles(file, t, corners)) count++;
    return count;
}

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
