/* A mesh as UGRID 1.0 in netCDF-4, with its fields and its coordinate system as a CF grid
 * mapping. */
#include "io/layouts/crs_define.h"
#include "io/layouts/netcdf_mesh.h"
#include "io/mesh/face_fan.h"
#include "io/netcdf/netcdf_output.h"

#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Values that are written at a time. */
enum { WRITE_BLOCK = 1 << 16 };
/* Stands behind the corners of a face with fewer than the most. */
enum { NO_CORNER = -1 };

/* Numbers of dimensions and variables in the file. */
typedef struct mesh_writing {
    mw_netcdf_output *output;
    const mw_mesh_file *file;
    mw_job *job;
    uint64_t done, total; /* values */
    size_t faces, width;  /* in the file: width 3 if all are triangles */
    int node, face, corner;
    int mesh, x, y, z, corners, crs;
    int *fields; /* those of the vertices, then those of the triangles */
} mesh_writing;

static void write_axis(const mesh_writing *w, int variable, const char *side, const char *name)
{
    bool lonlat = mw__crs_is_lonlat(w->file->crs);
    char unit[32], standard[48];
    bool x = strcmp(name, "x") == 0;
    snprintf(unit, sizeof unit, "degrees_%s", side);
    snprintf(standard, sizeof standard, "projection_%s_coordinate", name);
    if (lonlat) mw__netcdf_output_text(w->output, variable, "units", unit);
    mw__netcdf_output_text(w->output, variable, "standard_name",
                           !lonlat ? standard
                           : x     ? "longitude"
                                   : "latitude");
    mw__netcdf_output_text(w->output, variable, "mesh", "mesh2d");
    mw__netcdf_output_text(w->output, variable, "location", "node");
    if (w->crs >= 0) mw__netcdf_output_text(w->output, variable, "grid_mapping", "crs");
}

static void write_define_mesh(mesh_writing *w)
{
    mw_netcdf_output *output = w->output;
    w->node = mw__netcdf_output_dimension(output, "mesh2d_nNodes", w->file->point_count);
    w->face = mw__netcdf_output_dimension(output, "mesh2d_nFaces", w->faces);
    w->corner = mw__netcdf_output_dimension(output, "mesh2d_nMax_face_nodes", w->width);
    w->mesh = mw__netcdf_output_variable(output, "mesh2d", MW_NETCDF_INT, 0, NULL);
    mw__netcdf_output_text(output, w->mesh, "cf_role", "mesh_topology");
    mw__netcdf_output_number(output, w->mesh, "topology_dimension", MW_NETCDF_INT, 2);
    mw__netcdf_output_text(output, w->mesh, "node_coordinates", "mesh2d_node_x mesh2d_node_y");
    mw__netcdf_output_text(output, w->mesh, "node_dimension", "mesh2d_nNodes");
    mw__netcdf_output_text(output, w->mesh, "face_node_connectivity", "mesh2d_face_nodes");
    mw__netcdf_output_text(output, w->mesh, "face_dimension", "mesh2d_nFaces");
    mw__netcdf_output_text(output, w->mesh, "max_face_nodes_dimension", "mesh2d_nMax_face_nodes");
    w->x = mw__netcdf_output_variable(output, "mesh2d_node_x", MW_NETCDF_DOUBLE, 1, &w->node);
    w->y = mw__netcdf_output_variable(output, "mesh2d_node_y", MW_NETCDF_DOUBLE, 1, &w->node);
    write_axis(w, w->x, "east", "x");
    write_axis(w, w->y, "north", "y");
    bool wide = w->file->point_count > INT32_MAX;
    w->corners = mw__netcdf_output_variable(output, "mesh2d_face_nodes",
                                            wide ? MW_NETCDF_INT64 : MW_NETCDF_INT, 2,
                                            (int[]){w->face, w->corner});
    mw__netcdf_output_text(output, w->corners, "cf_role", "face_node_connectivity");
    if (w->width > 3)
        mw__netcdf_output_number(output, w->corners, "_FillValue",
                                 wide ? MW_NETCDF_INT64 : MW_NETCDF_INT, NO_CORNER);
    mw__netcdf_output_number(output, w->corners, "start_index",
                             wide ? MW_NETCDF_INT64 : MW_NETCDF_INT, 0);
}

/* A variable of values of the mesh; NaN is the missing one. */
static int write_define_values(const mesh_writing *w, const char *name, bool faces)
{
    int variable = mw__netcdf_output_variable(w->output, name, MW_NETCDF_DOUBLE, 1,
                                              faces ? &w->face : &w->node);
    mw__netcdf_output_number(w->output, variable, "_FillValue", MW_NETCDF_DOUBLE, NAN);
    mw__netcdf_output_text(w->output, variable, "mesh", "mesh2d");
    mw__netcdf_output_text(w->output, variable, "location", faces ? "face" : "node");
    if (!faces)
        mw__netcdf_output_text(w->output, variable, "coordinates", "mesh2d_node_x mesh2d_node_y");
    if (w->crs >= 0) mw__netcdf_output_text(w->output, variable, "grid_mapping", "crs");
    return variable;
}

static const char *write_field_name(const mw_mesh_file *file, size_t i)
{
    return i < file->field_count ? file->field_names[i]
                                 : file->triangle_field_names[i - file->field_count];
}

/* What netCDF takes as a name: a letter or digit first, then no '/', blank or control character. */
static void write_clean(const char *name, char *text, size_t size)
{
    size_t length = 0;
    for (; name[length] && length + 1 < size; length++) {
        unsigned char c = (unsigned char)name[length];
        bool plain = (c | 0x20) >= 'a' && (c | 0x20) <= 'z';
        plain = plain || (c >= '0' && c <= '9') || c == '_' || c >= 0x80;
        text[length] = (char)(plain || (length > 0 && strchr("-+.:@", c)) ? c : '_');
    }
    text[length] = 0;
}

/* A name that no earlier variable has; if necessary, the number of the field is appended. */
static void write_unique_name(const mw_mesh_file *file, size_t i, char *text, size_t size)
{
    enum { NUMBER_ROOM = 24 };
    char other[MW_NETCDF_NAME];
    write_clean(write_field_name(file, i), text, size - NUMBER_ROOM);
    bool axis = (*text >= 'x' && *text <= 'z') && !text[1]; /* as other formats have it */
    bool taken = !*text || axis || strncmp(text, "mesh2d", 6) == 0 || strcmp(text, "crs") == 0;
    for (size_t k = 0; k < i && !taken; k++) {
        write_clean(write_field_name(file, k), other, size - NUMBER_ROOM);
        taken = strcmp(text, other) == 0;
    }
    if (taken) snprintf(text + strlen(text), NUMBER_ROOM, "_%zu", i + 1);
}

static void write_define_fields(mesh_writing *w)
{
    const mw_mesh_file *file = w->file;
    w->z = file->has_z ? write_define_values(w, "mesh2d_node_z", false) : -1;
    if (w->z >= 0) mw__netcdf_output_text(w->output, w->z, "standard_name", "altitude");
    for (size_t i = 0; i < file->field_count + file->triangle_field_count; i++) {
        char name[MW_NETCDF_NAME];
        write_unique_name(file, i, name, sizeof name);
        w->fields[i] = write_define_values(w, name, i >= file->field_count);
    }
}

static bool write_goes_on(mesh_writing *w, size_t count)
{
    w->done += count;
    return !mw__netcdf_output_failed(w->output) && mw__job_step(w->job, w->done, w->total);
}

/* Write every `stride`-th value. False: the job is to stop, or writing failed. */
static bool write_column(mesh_writing *w, int variable, const double *values, size_t count,
                         size_t stride)
{
    double block[WRITE_BLOCK / 64];
    enum { ROOM = sizeof block / sizeof *block };
    for (size_t from = 0; from < count; from += ROOM) {
        size_t n = count - from < ROOM ? count - from : ROOM;
        for (size_t i = 0; i < n; i++) block[i] = values[(from + i) * stride];
        mw__netcdf_output_doubles(w->output, variable, &from, &n, block);
        if (!write_goes_on(w, n)) return false;
    }
    return true;
}

static bool write_triangles(mesh_writing *w)
{
    for (size_t from = 0; from < w->file->triangle_count; from += WRITE_BLOCK) {
        size_t left = w->file->triangle_count - from;
        size_t starts[2] = {from, 0}, counts[2] = {left < WRITE_BLOCK ? left : WRITE_BLOCK, 3};
        mw__netcdf_output_numbers(w->output, w->corners, starts, counts,
                                  w->file->triangles + 3 * from);
        if (!write_goes_on(w, 3 * counts[0])) return false;
    }
    return true;
}

static void write_face(const mesh_writing *w, size_t triangle, size_t corners, int64_t *row)
{
    for (size_t k = 0; k < w->width; k++)
        row[k] = k < corners ? (int64_t)mw__face_corner(w->file, triangle, k) : NO_CORNER;
}

/* Faces, a row each; false also if there is no memory. */
static bool write_polygons(mesh_writing *w)
{
    const size_t rows = w->width < WRITE_BLOCK ? WRITE_BLOCK / w->width : 1;
    int64_t *block = mw__alloc(rows * w->width, sizeof *block);
    bool on = block != NULL;
    for (size_t from = 0, t = 0; from < w->faces && on; from += rows) {
        const size_t n = w->faces - from < rows ? w->faces - from : rows;
        for (size_t i = 0; i < n; i++) {
            const size_t count = mw__face_triangles(w->file, t, SIZE_MAX);
            write_face(w, t, count + 2, block + i * w->width);
            t += count;
        }
        mw__netcdf_output_integers(w->output, w->corners, (size_t[]){from, 0},
                                   (size_t[]){n, w->width}, block);
        on = write_goes_on(w, n * w->width);
    }
    free(block);
    return on;
}

static bool write_corners(mesh_writing *w)
{
    return w->width == 3 ? write_triangles(w) : write_polygons(w);
}

/* The value of a face is that of its first triangle. */
static bool write_face_column(mesh_writing *w, int variable, const double *values)
{
    double block[WRITE_BLOCK / 64];
    enum { ROOM = sizeof block / sizeof *block };
    if (w->width == 3) return write_column(w, variable, values, w->faces, 1);
    for (size_t from = 0, t = 0; from < w->faces; from += ROOM) {
        size_t n = w->faces - from < ROOM ? w->faces - from : ROOM;
        for (size_t i = 0; i < n; i++, t += mw__face_triangles(w->file, t, SIZE_MAX))
            block[i] = values[t];
        mw__netcdf_output_doubles(w->output, variable, &from, &n, block);
        if (!write_goes_on(w, n)) return false;
    }
    return true;
}

static bool write_values(mesh_writing *w)
{
    const mw_mesh_file *file = w->file;
    const double *points = file->points;
    bool on = write_column(w, w->x, points, file->point_count, 3) &&
              write_column(w, w->y, points + 1, file->point_count, 3) && write_corners(w);
    if (w->z >= 0) on = on && write_column(w, w->z, points + 2, file->point_count, 3);
    for (size_t i = 0; i < file->field_count && on; i++)
        on = write_column(w, w->fields[i], file->fields[i], file->point_count, 1);
    for (size_t i = 0; i < file->triangle_field_count && on; i++)
        on = write_face_column(w, w->fields[file->field_count + i], file->triangle_fields[i]);
    return on || mw__netcdf_output_failed(w->output);
}

static void write_measure(mesh_writing *w)
{
    const mw_mesh_file *file = w->file;
    const uint64_t fields = file->field_count;
    size_t count;
    w->width = 3;
    for (size_t t = 0; t < file->triangle_count; t += count, w->faces++) {
        count = mw__face_triangles(file, t, SIZE_MAX);
        if (count + 2 > w->width) w->width = count + 2;
    }
    w->total = (3 + fields) * file->point_count +
               (w->width + (uint64_t)file->triangle_field_count) * w->faces;
}

mw_status mw__write_netcdf(const char *path, const mw_mesh_file *file, mw_job *job, mw_error *error)
{
    size_t fields = file->field_count + file->triangle_field_count;
    mesh_writing w = {.file = file, .job = job};
    write_measure(&w);
    w.fields = mw__alloc(fields, sizeof *w.fields);
    if (!w.fields) return mw__fail_memory(error);
    mw_status status = mw__netcdf_output_open(path, &w.output, error);
    if (!status) {
        mw__netcdf_output_text(w.output, MW_NETCDF_OUTPUT_FILE, "Conventions", "CF-1.8 UGRID-1.0");
        w.crs = mw__crs_define(w.output, file->crs);
        write_define_mesh(&w);
        write_define_fields(&w);
        mw__netcdf_output_defined(w.output);
        bool on = write_values(&w);
        status = mw__netcdf_output_close(w.output, on, error);
        if (!status && !on) status = mw__fail_memory(error); /* or cancelled */
    }
    free(w.fields);
    return status;
}
