/* Writing VTU: an unstructured grid of triangles, quadrilaterals and polygons, with fields as point
 * data and triangle fields as cell data, appended as raw doubles. */
#include "io/grid/grid_writers.h"
#include "io/text/byte_order.h"

#include <inttypes.h>

/* The arrays follow one another in the appended data, each with its size in front. */
typedef struct vtu_layout {
    mw_output *output;
    uint64_t offset;
} vtu_layout;

/* A name as the value of an attribute. */
static void vtu_write_name(mw_output *output, const char *name)
{
    for (; *name; name++)
        if (*name == '<' || *name == '&' || *name == '"' || *name == '>')
            mw_output_printf(output, "&#%d;", *name);
        else
            mw__output_char(output, (unsigned char)*name < ' ' ? ' ' : *name);
}

static void vtu_write_array(vtu_layout *l, const char *type, const char *name, int width,
                            uint64_t size)
{
    mw_output_printf(l->output, "<DataArray type=\"%s\" Name=\"", type);
    vtu_write_name(l->output, name);
    mw_output_printf(l->output,
                     "\" NumberOfComponents=\"%d\" format=\"appended\" offset=\"%" PRIu64 "\"/>\n",
                     width, l->offset);
    l->offset += 8 + size;
}

static void vtu_put(mw_output *output, uint64_t value, size_t size)
{
    unsigned char bytes[8];
    mw__put_bytes(bytes, size, value);
    mw_output_write(output, bytes, size);
}

static void vtu_put_double(mw_output *output, double value)
{
    unsigned char bytes[8];
    mw__put_f64(bytes, value);
    mw_output_write(output, bytes, sizeof bytes);
}

static void vtu_write_points(mw_output *output, const mw_mesh_file *file)
{
    vtu_put(output, 24 * (uint64_t)file->point_count, 8);
    for (size_t i = 0; i < 3 * file->point_count && !mw_output_failed(output); i++)
        vtu_put_double(output, file->points[i]);
}

/* All corners, or the end of each face, or its type. */
typedef enum vtu_face_part { VTU_CORNERS, VTU_ENDS, VTU_TYPES } vtu_face_part;

static void vtu_write_faces(mw_output *output, const mw_mesh_file *file, vtu_face_part part,
                            uint64_t size)
{
    uint64_t end = 0;
    size_t count;
    vtu_put(output, size, 8);
    for (size_t t = 0; t < file->triangle_count && !mw_output_failed(output); t += count) {
        count = mw__face_triangles(file, t, SIZE_MAX);
        end += count + 2;
        if (part == VTU_ENDS) vtu_put(output, end, 8);
        if (part == VTU_TYPES) vtu_put(output, count == 1 ? 5 : count == 2 ? 9 : 7, 1);
        for (size_t k = 0; k < count + 2 && part == VTU_CORNERS; k++)
            vtu_put(output, mw__face_corner(file, t, k), 4);
    }
}

static void vtu_write_values(mw_output *output, const double *values, size_t count)
{
    vtu_put(output, 8 * (uint64_t)count, 8);
    for (size_t i = 0; i < count && !mw_output_failed(output); i++)
        vtu_put_double(output, values[i]);
}

/* The value of a face is that of its first triangle. */
static void vtu_write_face_values(mw_output *output, const mw_mesh_file *file, const double *values,
                                  size_t faces)
{
    vtu_put(output, 8 * (uint64_t)faces, 8);
    for (size_t t = 0; t < file->triangle_count && !mw_output_failed(output);
         t += mw__face_triangles(file, t, SIZE_MAX))
        vtu_put_double(output, values[t]);
}

static void vtu_write_head(vtu_layout *l, const mw_mesh_file *file, size_t faces, size_t corners)
{
    mw_output *output = l->output;
    mw_output_printf(output,
                     "<?xml version=\"1.0\"?>\n<VTKFile type=\"UnstructuredGrid\" version=\"1.0\" "
                     "byte_order=\"LittleEndian\" header_type=\"UInt64\">\n<UnstructuredGrid>\n"
                     "<Piece NumberOfPoints=\"%zu\" NumberOfCells=\"%zu\">\n<Points>\n",
                     file->point_count, faces);
    vtu_write_array(l, "Float64", "Points", 3, 24 * (uint64_t)file->point_count);
    mw__output_text(output, "</Points>\n<Cells>\n");
    vtu_write_array(l, "UInt32", "connectivity", 1, 4 * (uint64_t)corners);
    vtu_write_array(l, "UInt64", "offsets", 1, 8 * (uint64_t)faces);
    vtu_write_array(l, "UInt8", "types", 1, faces);
    mw__output_text(output, "</Cells>\n<PointData>\n");
    for (size_t f = 0; f < file->field_count; f++)
        vtu_write_array(l, "Float64", file->field_names[f], 1, 8 * (uint64_t)file->point_count);
    mw__output_text(output, "</PointData>\n<CellData>\n");
    for (size_t f = 0; f < file->triangle_field_count; f++)
        vtu_write_array(l, "Float64", file->triangle_field_names[f], 1, 8 * (uint64_t)faces);
    mw__output_text(output, "</CellData>\n</Piece>\n</UnstructuredGrid>\n"
                            "<AppendedData encoding=\"raw\">\n_");
}

static void vtu_write(mw_output *output, const mw_mesh_file *file)
{
    vtu_layout l = {.output = output};
    size_t faces = mw__face_count(file, SIZE_MAX), corners = file->triangle_count + 2 * faces;
    vtu_write_head(&l, file, faces, corners);
    vtu_write_points(output, file);
    vtu_write_faces(output, file, VTU_CORNERS, 4 * (uint64_t)corners);
    vtu_write_faces(output, file, VTU_ENDS, 8 * (uint64_t)faces);
    vtu_write_faces(output, file, VTU_TYPES, faces);
    for (size_t f = 0; f < file->field_count; f++)
        vtu_write_values(output, file->fields[f], file->point_count);
    for (size_t f = 0; f < file->triangle_field_count; f++)
        vtu_write_face_values(output, file, file->triangle_fields[f], faces);
    mw__output_text(output, "\n</AppendedData>\n</VTKFile>\n");
}

mw_status mw__write_vtu(const char *path, const mw_mesh_file *file, mw_job *job, mw_error *error)
{
    return mw__write_file(path, file, vtu_write, job, error);
}
