/* Writing 2DM: triangles and quadrilaterals with their material (the triangle field "material", or
 * "physical", else 1), vertices with their height. If the mesh has no heights, the height is the
 * field "depth" with the opposite sign. */
#include "io/grid/grid_writers.h"

#include <math.h>

static void sms_write_faces(mw_output *output, const mw_mesh_file *file)
{
    const double *materials = mw__triangle_values(file, "material");
    size_t face = 0, count;
    if (!materials) materials = mw__triangle_values(file, "physical");
    for (size_t t = 0; t < file->triangle_count && !mw_output_failed(output); t += count) {
        count = mw__face_triangles(file, t, 4);
        mw__output_text(output, count == 2 ? "E4Q " : "E3T ");
        mw__output_integer(output, ++face);
        for (size_t k = 0; k < count + 2; k++) {
            mw__output_char(output, ' ');
            mw__output_integer(output, (uint64_t)mw__face_corner(file, t, k) + 1);
        }
        mw__output_char(output, ' ');
        mw_output_double(output, materials && isfinite(materials[t]) ? materials[t] : 1);
        mw__output_char(output, '\n');
    }
}

static void sms_write(mw_output *output, const mw_mesh_file *file)
{
    const double *depths = mw__vertex_values(file, "depth");
    mw__output_text(output, "MESH2D\nNUM_MATERIALS_PER_ELEM 1\n");
    sms_write_faces(output, file);
    for (size_t v = 0; v < file->point_count && !mw_output_failed(output); v++) {
        mw__output_text(output, "ND ");
        mw__output_integer(output, v + 1);
        for (size_t k = 0; k < 3; k++) {
            double value = file->points[3 * v + k];
            if (k == 2 && !file->has_z && depths) value = 0 - depths[v];
            mw__output_char(output, ' ');
            mw_output_double(output, value);
        }
        mw__output_char(output, '\n');
    }
}

mw_status mw__write_2dm(const char *path, const mw_mesh_file *file, mw_job *job, mw_error *error)
{
    return mw__write_file(path, file, sms_write, job, error);
}
