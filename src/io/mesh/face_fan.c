#include "io/mesh/face_fan.h"

#include <math.h>
#include <stdbool.h>

static bool face_is_fan(const mw_mesh_file *file, size_t t, size_t count)
{
    for (size_t i = t + 1; i < t + count; i++)
        if (file->triangles[3 * i] != file->triangles[3 * t] ||
            file->triangles[3 * i + 1] != file->triangles[3 * i - 1])
            return false;
    return true;
}

/* Do the triangles have the same values? A face has one of each field. */
static bool face_is_even(const mw_mesh_file *file, size_t t, size_t count)
{
    for (size_t f = 0; f < file->triangle_field_count; f++) {
        const double *values = file->triangle_fields[f] + t;
        for (size_t i = 1; i < count; i++)
            if (values[i] != values[0] && !(isnan(values[i]) && isnan(values[0]))) return false;
    }
    return true;
}

size_t mw__face_triangles(const mw_mesh_file *file, size_t t, size_t corners)
{
    if (!file->faces || (t > 0 && file->faces[t - 1] == file->faces[t])) return 1;
    size_t count = 1;
    while (t + count < file->triangle_count && file->faces[t + count] == file->faces[t]) count++;
    const bool whole = count + 2 <= corners && face_is_fan(file, t, count);
    return whole && face_is_even(file, t, count) ? count : 1;
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
