/* mesh_object.c - meshes: read, made from arrays, triangulated; their arrays and properties. */
#include "engine/mesh_object.h"

#include <stdbool.h>
#include <stdlib.h>
#include <string.h>

mw_mesh *web_mesh_planar(web_mesh *m)
{
    mw_arrays arrays = mw_mesh_file_arrays(&m->file);
    if (!m->mesh) mw_mesh_create(&arrays, NULL, &m->mesh, &web_error);
    return m->mesh;
}

void WEB_EXPORT(web_mesh_free)(web_mesh *m)
{
    if (!m) return;
    mw_mesh_destroy(m->mesh);
    mw_mesh_file_release(&m->file);
    free(m);
}

static web_mesh *mesh_fail_memory(web_mesh *m)
{
    web_mesh_free(m);
    web_error = (mw_error){MW_ERROR_MEMORY, -1, -1, -1, "there is not enough memory"};
    return NULL;
}

/* --- made ------------------------------------------------------------------------------------- */

web_mesh *WEB_EXPORT(web_mesh_read)(const char *path)
{
    web_mesh *m = calloc(1, sizeof *m);
    if (!m) return mesh_fail_memory(m);
    if (mw_read_mesh(path, NULL, &m->file, &web_error) == MW_OK) return m;
    free(m);
    return NULL;
}

/* Room for a mesh, to be filled through the addresses of its arrays. */
web_mesh *WEB_EXPORT(web_mesh_make)(size_t points, size_t triangles)
{
    web_mesh *m = calloc(1, sizeof *m);
    if (!m) return mesh_fail_memory(m);
    m->file.points = calloc(points ? points : 1, 3 * sizeof(double));
    m->file.triangles = calloc(triangles ? triangles : 1, 3 * sizeof(uint32_t));
    m->file.point_count = points;
    m->file.triangle_count = triangles;
    return m->file.points && m->file.triangles ? m : mesh_fail_memory(m);
}

/* The Delaunay triangulation of n points x, y, z. */
web_mesh *WEB_EXPORT(web_mesh_delaunay)(const double *points, size_t n)
{
    mw_mesh *made;
    if (mw_delaunay(points, n, 3, NULL, NULL, NULL, &made, &web_error) != MW_OK) return NULL;
    uint32_t count = mw_mesh_triangle_count(made);
    web_mesh *m = web_mesh_make(n, count);
    if (!m) mw_mesh_destroy(made);
    if (!m) return NULL;
    memcpy(m->file.points, points, n * 3 * sizeof *points);
    for (uint32_t t = 0; t < count; t++)
        mw_mesh_triangle(made, t, m->file.triangles + 3 * (size_t)t);
    m->mesh = made;
    return m;
}

void WEB_EXPORT(web_mesh_set_has_z)(web_mesh *m, int has_z)
{
    m->file.has_z = has_z;
}

/* --- arrays ----------------------------------------------------------------------------------- */

size_t WEB_EXPORT(web_mesh_vertex_count)(const web_mesh *m)
{
    return m->file.point_count;
}

size_t WEB_EXPORT(web_mesh_triangle_count)(const web_mesh *m)
{
    return m->file.triangle_count;
}

/* x, y, z of each vertex. */
double *WEB_EXPORT(web_mesh_points)(web_mesh *m)
{
    return m->file.points;
}

uint32_t *WEB_EXPORT(web_mesh_triangles)(web_mesh *m)
{
    return m->file.triangles;
}

int WEB_EXPORT(web_mesh_has_z)(const web_mesh *m)
{
    return m->file.has_z;
}

const char *WEB_EXPORT(web_mesh_crs)(const web_mesh *m)
{
    return m->file.crs;
}

/* --- values ----------------------------------------------------------------------------------- */

/* Fields of vertices (0) or of triangles (1). */
size_t WEB_EXPORT(web_mesh_field_count)(const web_mesh *m, int of_triangles)
{
    return of_triangles ? m->file.triangle_field_count : m->file.field_count;
}

const char *WEB_EXPORT(web_mesh_field_name)(const web_mesh *m, int of_triangles, size_t i)
{
    return (of_triangles ? m->file.triangle_field_names : m->file.field_names)[i];
}

double *WEB_EXPORT(web_mesh_field)(const web_mesh *m, int of_triangles, size_t i)
{
    return (of_triangles ? m->file.triangle_fields : m->file.fields)[i];
}

static bool fields_add(char ***names, double ***fields, size_t count, const char *name, size_t size)
{
    char **more_names = realloc(*names, (count + 1) * sizeof *more_names);
    if (more_names) *names = more_names;
    double **more_fields = realloc(*fields, (count + 1) * sizeof *more_fields);
    if (more_fields) *fields = more_fields;
    if (!more_names || !more_fields) return false;
    more_names[count] = strdup(name);
    more_fields[count] = calloc(size ? size : 1, sizeof(double));
    if (more_names[count] && more_fields[count]) return true;
    free(more_names[count]);
    free(more_fields[count]);
    return false;
}

/* A new field, to be filled; NULL if there is no memory. */
double *WEB_EXPORT(web_mesh_add_field)(web_mesh *m, int of_triangles, const char *name)
{
    mw_mesh_file *f = &m->file;
    size_t *count = of_triangles ? &f->triangle_field_count : &f->field_count;
    char ***names = of_triangles ? &f->triangle_field_names : &f->field_names;
    double ***fields = of_triangles ? &f->triangle_fields : &f->fields;
    size_t size = of_triangles ? f->triangle_count : f->point_count;
    if (!fields_add(names, fields, *count, name, size)) return NULL;
    return (*fields)[(*count)++];
}

/* --- properties ------------------------------------------------------------------------------- */

/* Links of all triangles: 4 * neighbour + its edge, MW_NONE on a border. Of unusable arrays the
 * links of a tolerant mesh. Returns 0 if there is no memory. */
int WEB_EXPORT(web_mesh_links)(const web_mesh *m, uint32_t *links)
{
    mw_mesh *mesh;
    mw_arrays arrays = mw_mesh_file_arrays(&m->file);
    mw_mesh_options tolerant = {.tolerant = 1};
    if (mw_mesh_create(&arrays, &tolerant, &mesh, &web_error) != MW_OK) return 0;
    for (uint32_t t = 0; t < (uint32_t)m->file.triangle_count; t++)
        for (unsigned k = 0; k < 3; k++) {
            unsigned edge = 0;
            uint32_t other = mw_mesh_neighbour(mesh, t, k, &edge);
            links[3 * (size_t)t + k] = other == MW_NONE ? MW_NONE : 4 * other + edge;
        }
    mw_mesh_destroy(mesh);
    return 1;
}

/* What mw_mesh_describe tells, in the order of its members. Returns 0 on failure. */
int WEB_EXPORT(web_mesh_describe)(web_mesh *m, double *values)
{
    mw_mesh_info i;
    mw_mesh *mesh = web_mesh_planar(m);
    if (!mesh || mw_mesh_describe(mesh, NULL, &i, &web_error) != MW_OK) return 0;
    const double all[] = {i.vertices,
                          i.triangles,
                          i.unused_vertices,
                          i.flat_triangles,
                          i.clockwise_triangles,
                          i.clashing_edges,
                          i.border_edges,
                          i.border_loops,
                          i.components,
                          i.holes,
                          i.oriented,
                          i.embedding,
                          i.convex,
                          i.delaunay,
                          i.low[0],
                          i.low[1],
                          i.high[0],
                          i.high[1],
                          i.area};
    memcpy(values, all, sizeof all);
    return 1;
}
