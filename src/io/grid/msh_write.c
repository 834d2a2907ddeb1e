/* Writing MSH of Gmsh, version 2.2 as text: marked edges become lines in physical groups named like
 * their marks; faces become triangles and quadrilaterals, and the triangle field "physical" (or
 * "material"), if it has whole numbers, is the number of their physical group. Fields of vertices
 * become $NodeData. There is no $ElementData, since meshio 5.3 fails to read it in files of several
 * kinds of elements. */
#include "io/grid/grid_writers.h"

#include <math.h>

/* number type 2 group entity */
static void msh_write_tags(mw_output *output, size_t number, int type, int64_t group)
{
    mw__output_integer(output, number);
    mw_output_printf(output, " %d 2 ", type);
    for (int i = 0; i < 2; i++) {
        mw__output_signed(output, group);
        mw__output_char(output, ' ');
    }
}

static void msh_write_edges(mw_output *output, const mw_mesh_file *file)
{
    for (size_t e = 0; e < file->edge_count && !mw_output_failed(output); e++) {
        const mw_marked_edge *edge = &file->edges[e];
        msh_write_tags(output, e + 1, 1, (int64_t)edge->mark + 1);
        mw__output_integer(output, (uint64_t)edge->vertex[0] + 1);
        mw__output_char(output, ' ');
        mw__output_integer(output, (uint64_t)edge->vertex[1] + 1);
        mw__output_char(output, '\n');
    }
}

static bool msh_are_groups(const mw_mesh_file *file, const double *values)
{
    for (size_t t = 0; t < file->triangle_count; t++)
        if (!(fabs(values[t]) < 0x1p31 && values[t] == floor(values[t]))) return false;
    return true;
}

/* The values that are numbers of physical groups; NULL if there are none. */
static const double *msh_find_groups(const mw_mesh_file *file)
{
    const double *groups = mw__triangle_values(file, "physical");
    if (!groups) groups = mw__triangle_values(file, "material");
    return groups && msh_are_groups(file, groups) ? groups : NULL;
}

static void msh_write_faces(mw_output *output, const mw_mesh_file *file)
{
    const double *groups = msh_find_groups(file);
    size_t face = file->edge_count, count;
    for (size_t t = 0; t < file->triangle_count && !mw_output_failed(output); t += count) {
        count = mw__face_triangles(file, t, 4);
        double group = groups ? groups[t] : 0;
        msh_write_tags(output, ++face, count == 2 ? 3 : 2, (int64_t)group);
        for (size_t k = 0; k < count + 2; k++) {
            mw__output_integer(output, (uint64_t)mw__face_corner(file, t, k) + 1);
            mw__output_char(output, k < count + 1 ? ' ' : '\n');
        }
    }
}

/* A name in quotes, which end the line. */
static void msh_write_name(mw_output *output, const char *name)
{
    mw__output_char(output, '"');
    for (const char *c = name; *c; c++)
        mw__output_char(output, *c == '"' || (unsigned char)*c < ' ' ? '\'' : *c);
    mw__output_text(output, "\"\n");
}

static void msh_write_names(mw_output *output, const mw_mesh_file *file)
{
    if (file->mark_count == 0) return;
    mw_output_printf(output, "$PhysicalNames\n%zu\n", file->mark_count);
    for (size_t m = 0; m < file->mark_count; m++) {
        mw_output_printf(output, "1 %zu ", m + 1);
        msh_write_name(output, file->mark_names[m]);
    }
    mw__output_text(output, "$EndPhysicalNames\n");
}

/* Values of the vertices, at the time 0 and step 0, one each. Missing ones are NaN: meshio needs as
 * many as there are vertices. */
static void msh_write_field(mw_output *output, const mw_mesh_file *file, size_t f)
{
    mw__output_text(output, "$NodeData\n1\n");
    msh_write_name(output, file->field_names[f]);
    mw_output_printf(output, "1\n0\n3\n0\n1\n%zu\n", file->point_count);
    for (size_t v = 0; v < file->point_count && !mw_output_failed(output); v++) {
        mw__output_integer(output, v + 1);
        mw__output_char(output, ' ');
        mw_output_double(output, file->fields[f][v]);
        mw__output_char(output, '\n');
    }
    mw__output_text(output, "$EndNodeData\n");
}

static void msh_write(mw_output *output, const mw_mesh_file *file)
{
    mw__output_text(output, "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n");
    msh_write_names(output, file);
    mw_output_printf(output, "$Nodes\n%zu\n", file->point_count);
    for (size_t v = 0; v < file->point_count && !mw_output_failed(output); v++) {
        mw__output_integer(output, v + 1);
        for (size_t k = 0; k < 3; k++) {
            mw__output_char(output, ' ');
            mw_output_double(output, file->points[3 * v + k]);
        }
        mw__output_char(output, '\n');
    }
    mw_output_printf(output, "$EndNodes\n$Elements\n%zu\n",
                     file->edge_count + mw__face_count(file, 4));
    msh_write_edges(output, file);
    msh_write_faces(output, file);
    mw__output_text(output, "$EndElements\n");
    for (size_t f = 0; f < file->field_count; f++) msh_write_field(output, file, f);
}

mw_status mw__write_msh(const char *path, const mw_mesh_file *file, mw_job *job, mw_error *error)
{
    return mw__write_file(path, file, msh_write, job, error);
}
