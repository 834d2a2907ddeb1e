/* vertices.h - the vertices of a triangulation to be made, with the values they have: those of POINTS, then those of
 * the constraints, then those added where constraints cross. */
#ifndef CLI_VERTICES_H
#define CLI_VERTICES_H

#include <meshwalk/meshwalk.h>
#include <stdbool.h>

typedef struct vertices {
    mw_mesh_file file;   /* its arrays belong to this; triangles come at the end */
    size_t points;       /* so many vertices are those of POINTS, and so many of the fields; do POINTS have heights? */
    size_t point_fields; /* of the other vertices a value that is not known is NaN */
    bool point_heights;
} vertices;

/* Each returns 0 or an exit code after a complaint. `columns` and `classes` may be NULL. */
int vertices_read(vertices *v, const char *path, const char *columns, const char *classes);
/* Append the points of constraints, whose segments then name vertices. */
int vertices_append(vertices *v, mw_constraint_file *constraints);
/* Take the vertices that the mesh has beyond these, and its triangles. */
int vertices_complete(vertices *v, const mw_mesh *mesh);
/* All vertices, fields and triangles of a mesh; its field z, if it has one, is the height. */
int vertices_of_mesh(vertices *v, const mw_mesh *mesh);
void vertices_release(vertices *v);

/* One value of all vertices: that of vertex i is values[i * stride]. Value 0 is z, the others are the fields. */
typedef struct vertex_value {
    double *values;
    size_t stride;
    bool in_points;
} vertex_value;
size_t vertices_value_count(const vertices *v);
vertex_value vertices_value(const vertices *v, size_t number);

#endif
