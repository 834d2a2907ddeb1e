/* vertex_table.h - the vertices of a triangulation to be made, with their values. First come the
 * points of POINTS, then those of the constraints, then those added where constraints cross. */
#ifndef MW_CLI_VERTICES_VERTEX_TABLE_H
#define MW_CLI_VERTICES_VERTEX_TABLE_H

#include "cli/vertices/vertex_source.h"

#include <meshwalk/meshwalk.h>
#include <stdbool.h>

typedef struct vertex_table {
    mw_mesh_file file;   /* owned; its triangles come last. An unknown value of a vertex is NaN */
    size_t points;       /* the number of vertices from POINTS, the first ones */
    size_t point_fields; /* the number of fields that POINTS have, the first ones */
    bool point_heights;  /* do POINTS have heights? */
    bool lonlat;         /* do the names of their columns mean longitude and latitude? */
    char *height_name;   /* the column of POINTS that the heights come from; NULL: none */
} vertex_table;

/* The functions with a result return 0, or an exit code after a complaint. */

/* How POINTS are read. */
typedef struct vertex_table_options {
    vertex_source_options source;
    bool quiet; /* do not tell which columns become no fields */
} vertex_table_options;

/* Read POINTS. */
int vertex_table_read(vertex_table *v, const char *path, const vertex_table_options *how);
/* Append the points of constraints, and renumber the constraints' segments accordingly. */
int vertex_table_append(vertex_table *v, mw_constraint_file *constraints);
/* Append the vertices that the mesh has beyond these, and take its triangles. */
int vertex_table_complete(vertex_table *v, const mw_mesh *mesh);
/* Take all vertices, fields and triangles of a mesh. A field z becomes the height. */
int vertex_table_of_mesh(vertex_table *v, const mw_mesh *mesh);
void vertex_table_release(vertex_table *v);

/* One field: its value at vertex i is values[i * stride]. */
typedef struct vertex_field {
    double *values;
    size_t stride;
    bool in_points; /* do POINTS have this field? */
} vertex_field;

/* Field 0 is the height, the others are those of the file. */
size_t vertex_table_field_count(const vertex_table *v);
/* The values that POINTS have in the column of a name. False: there is none, beyond x and y. */
bool vertex_table_find_column(const vertex_table *v, const char *column, vertex_field *field);
vertex_field vertex_table_field(const vertex_table *v, size_t number);

#endif
