/* Writing a mesh as a table: a row for each corner of each triangle. Only unused vertices are lost.
 */
#include "io/mesh/mesh_writers.h"
#include "io/text/output.h"

static void csv_write(mw_output *output, const mw_mesh_file *file)
{
    mw__output_text(output, "triangle,corner,vertex,x,y,z");
    for (size_t f = 0; f < file->field_count; f++) {
        mw__output_char(output, ',');
        mw__output_field_name(output, file->field_names, f);
    }
    mw__output_char(output, '\n');
    for (size_t i = 0; i < 3 * file->triangle_count && !mw_output_failed(output); i++) {
        size_t vertex = file->triangles[i];
        mw__output_integer(output, i / 3);
        mw__output_char(output, ',');
        mw__output_integer(output, i % 3);
        mw__output_char(output, ',');
        mw__output_integer(output, vertex);
        for (size_t k = 0; k < 3; k++) {
            mw__output_char(output, ',');
            mw_output_double(output, file->points[3 * vertex + k]);
        }
        for (size_t f = 0; f < file->field_count; f++) {
            mw__output_char(output, ',');
            mw_output_double(output, file->fields[f][vertex]);
        }
        mw__output_char(output, '\n');
    }
}

mw_status mw__write_csv(const char *path, const mw_mesh_file *file, mw_job *job, mw_error *error)
{
    return mw__write_file(path, file, csv_write, job, error);
}
