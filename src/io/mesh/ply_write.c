/* Writing PLY: doubles, little-endian binary or text. */
#include "io/mesh/mesh_writers.h"
#include "io/text/byte_order.h"
#include "io/text/output.h"

#include <limits.h>

/* A line of the header: a text of several lines becomes one. */
static void ply_write_crs(mw_output *output, const char *crs)
{
    mw__output_text(output, "comment crs ");
    for (; *crs; crs++) mw__output_char(output, (unsigned char)*crs < 0x20 ? ' ' : *crs);
    mw__output_char(output, '\n');
}

static void ply_write_header(mw_output *output, const mw_mesh_file *file, const char *kind)
{
    mw_output_printf(output, "ply\nformat %s 1.0\n", kind);
    if (file->crs && *file->crs) ply_write_crs(output, file->crs);
    mw_output_printf(output, "element vertex %zu\n", file->point_count);
    mw__output_text(output, "property double x\nproperty double y\nproperty double z\n");
    for (size_t f = 0; f < file->field_count; f++) {
        mw__output_text(output, "property double ");
        mw__output_field_name(output, file->field_names, f);
        mw__output_char(output, '\n');
    }
    /* "int" is what most programs expect */
    mw_output_printf(output,
                     "element face %zu\nproperty list uchar %s vertex_indices\nend_header\n",
                     file->triangle_count, file->point_count <= INT_MAX ? "int" : "uint");
}

static void ply_write_double(mw_output *output, double value)
{
    unsigned char bytes[8];
    mw__put_f64(bytes, value);
    mw_output_write(output, bytes, sizeof bytes);
}

static void ply_write_binary(mw_output *output, const mw_mesh_file *file)
{
    ply_write_header(output, file, "binary_little_endian");
    for (size_t v = 0; v < file->point_count && !mw_output_failed(output); v++) {
        for (size_t k = 0; k < 3; k++) ply_write_double(output, file->points[3 * v + k]);
        for (size_t f = 0; f < file->field_count; f++) ply_write_double(output, file->fields[f][v]);
    }
    for (size_t t = 0; t < file->triangle_count && !mw_output_failed(output); t++) {
        unsigned char bytes[13] = {3};
        for (size_t k = 0; k < 3; k++)
            mw__put_bytes(bytes + 1 + 4 * k, 4, file->triangles[3 * t + k]);
        mw_output_write(output, bytes, sizeof bytes);
    }
}

static void ply_write_ascii(mw_output *output, const mw_mesh_file *file)
{
    ply_write_header(output, file, "ascii");
    for (size_t v = 0; v < file->point_count && !mw_output_failed(output); v++) {
        for (size_t k = 0; k < 3; k++) {
            if (k > 0) mw__output_char(output, ' ');
            mw_output_double(output, file->points[3 * v + k]);
        }
        for (size_t f = 0; f < file->field_count; f++) {
            mw__output_char(output, ' ');
            mw_output_double(output, file->fields[f][v]);
        }
        mw__output_char(output, '\n');
    }
    mw__output_triangles(output, file);
}

mw_status mw__write_ply(const char *path, const mw_mesh_file *file, mw_job *job, mw_error *error)
{
    return mw__write_file(path, file, ply_write_binary, job, error);
}

mw_status mw__write_ply_ascii(const char *path, const mw_mesh_file *file, mw_job *job,
                              mw_error *error)
{
    return mw__write_file(path, file, ply_write_ascii, job, error);
}
