/* mesh_builder.h - a mesh_file that grows while a reader reads. Private.
 *
 * Memory is allocated for the contents of a file, not for the counts in its header; for all of them
 * at once if the size of the file shows that they are there. A reader adds
 * points, values of fields for the point added last, and faces, corner by corner. Vertex numbers
 * are checked at once if all points are known, else at the end, with the position of the face.
 * Faces with more than three corners are cut into triangles (face_cut.h) as soon as all their
 * corners are known, at the latest at the end. */
#ifndef MW_SRC_IO_MESH_MESH_BUILDER_H
#define MW_SRC_IO_MESH_MESH_BUILDER_H

#include "io/text/byte_source.h"

#include <meshwalk/io.h>

typedef struct mw_mesh_builder {
    mw_mesh_file *file;
    mw_source *source;           /* what is read from: for messages */
    const char *corner_variable; /* of a netCDF file, the variable with the corners; NULL: none */
    mw_job *job;                 /* that watches the reading; may be NULL */
    const char *layout;          /* asked for in netCDF files; NULL: whichever is there */
    size_t point_room, triangle_room;
    int64_t first_number; /* number of the first vertex: 0 or 1 */
    bool points_complete;
    bool lonlat;     /* x and y are longitudes and latitudes, as far as is known */
    int64_t highest; /* largest vertex (counted from 0) named so far, -1 if none, and where */
    uint64_t highest_position;
    uint32_t *corners; /* of the present face, each that differs from the one before */
    size_t corner_count, corner_room;
    size_t named;      /* how many corners of it the file names */
    uint32_t start[3]; /* the first three of these */
    size_t edge_room;
    struct build_polygon *polygons; /* faces that wait for their points */
    size_t polygon_count, polygon_room;
} mw_mesh_builder;

/* `file` is emptied; on failure the caller releases it. */
void mw__build_start(mw_mesh_builder *builder, mw_mesh_file *file, mw_source *source);
/* Release what the builder itself holds, after mw__build_finish or a failure. */
void mw__build_release(mw_mesh_builder *builder);

/* Add a field; before the first point. Its value for the point added last is set with
 * mw__build_value. */
mw_status mw__build_field(mw_mesh_builder *builder, const char *name, mw_error *error);
/* So many points or triangles will probably come: their bytes are there. After the fields. */
mw_status mw__build_expect_points(mw_mesh_builder *builder, size_t n, mw_error *error);
mw_status mw__build_expect_triangles(mw_mesh_builder *builder, size_t n, mw_error *error);
mw_status mw__build_point(mw_mesh_builder *builder, double x, double y, double z, mw_error *error);
/* n points at once, if no fields were added: the caller fills in 3 n numbers. */
mw_status mw__build_points(mw_mesh_builder *builder, size_t n, double **points, mw_error *error);
/* A point from the three numbers that a text begins with; reading them alone. */
mw_status mw__build_point_text(mw_mesh_builder *builder, const char *text, mw_error *error);
mw_status mw__read_xyz(const mw_source *source, const char *text, double xyz[3], mw_error *error);
void mw__build_value(mw_mesh_builder *builder, size_t field, double value);

/* Add a face: begin it, add its corners as the file numbers them, end it. Fewer than three corners
 * are an error, and so is a face that is not convex. If a corner is named several times in a row,
 * the face gets it once, but a face of three corners is taken as it is. */
void mw__build_face(mw_mesh_builder *builder);
mw_status mw__build_corner(mw_mesh_builder *builder, int64_t number, mw_error *error);
mw_status mw__build_face_end(mw_mesh_builder *builder, mw_error *error);
/* Check a number of a vertex and count it from 0. */
mw_status mw__build_vertex(mw_mesh_builder *builder, int64_t number, uint32_t *vertex,
                           mw_error *error);
/* One face that is a triangle of vertices counted from 0 that exist. */
mw_status mw__build_triangle(mw_mesh_builder *builder, uint32_t a, uint32_t b, uint32_t c,
                             mw_error *error);

/* Many such triangles: room for at least one, which the caller fills from its beginning; then how
 * many it filled. */
mw_status mw__build_triangle_room(mw_mesh_builder *builder, uint32_t **triangles, size_t *room,
                                  mw_error *error);
void mw__build_triangles(mw_mesh_builder *builder, size_t n);

/* After the last point: a field with a value for each vertex, to be filled in; they are NaN. */
mw_status mw__build_late_field(mw_mesh_builder *builder, const char *name, double **values,
                               mw_error *error);
/* After the last face: a value for each of face_count faces, which its triangles get. */
mw_status mw__build_face_field(mw_mesh_builder *builder, const char *name, const double *values,
                               mw_error *error);

/* A mark for the edges that follow, and an edge of vertices as the file numbers them. */
mw_status mw__build_mark(mw_mesh_builder *builder, const char *name, mw_error *error);
mw_status mw__build_edge(mw_mesh_builder *builder, int64_t a, int64_t b, mw_error *error);

/* Release the fields of a file, names and values. */
void mw__fields_release(char **names, double **fields, size_t count);

/* Check what is left to check and give back memory not needed. */
mw_status mw__build_finish(mw_mesh_builder *builder, mw_error *error);

#endif
