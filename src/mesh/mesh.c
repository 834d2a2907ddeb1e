/* mesh.c - access to a planar mesh and its fields; how it is released. */
#include "mesh/mesh.h"

#include <stdlib.h>
#include <string.h>

static void field_release(mw_field *field)
{
    if (field->borrowed) return;
    free(field->name);
    free(field->values);
}

void mw__mesh_release_fields(mw_mesh *mesh)
{
    for (size_t i = 0; i < mesh->field_count; i++) field_release(&mesh->field[i]);
    free(mesh->field);
}

void mw_mesh_destroy(mw_mesh *mesh)
{
    if (!mesh) return;
    mw__mesh_release_fields(mesh);
    free(mesh->tri);
    free(mesh->triangle_slot);
    free(mesh->vertex_slot);
    free(mesh->vertex_number);
    free(mesh->point);
    free(mesh);
}

uint32_t mw_mesh_vertex_count(const mw_mesh *mesh)
{
    return mesh->point_count;
}

uint32_t mw_mesh_triangle_count(const mw_mesh *mesh)
{
    return mesh->tri_count;
}

void mw_mesh_vertex(const mw_mesh *mesh, uint32_t vertex, double point[2])
{
    mw_point p = mesh->point[mw__vertex_slot(mesh, vertex)];
    point[0] = p.x;
    point[1] = p.y;
}

void mw_mesh_triangle(const mw_mesh *mesh, uint32_t triangle, uint32_t vertices[3])
{
    const mw_triangle *t = &mesh->tri[mw__triangle_slot(mesh, triangle)];
    for (uint32_t k = 0; k < 3; k++)
        vertices[mw__user_local_vertex(t->user, k)] = mw__vertex_number(mesh, t->v[k]);
}

void mw_mesh_stored_triangles(const mw_mesh *mesh, uint32_t first, uint32_t count,
                              uint32_t *corners, uint32_t *numbers)
{
    for (uint32_t i = 0; i < count; i++) {
        const mw_triangle *t = &mesh->tri[first + i];
        const bool reversed = (t->user & MW_REVERSED) != 0;
        corners[3 * (size_t)i] = t->v[0];
        corners[3 * (size_t)i + 1] = t->v[reversed ? 2 : 1];
        corners[3 * (size_t)i + 2] = t->v[reversed ? 1 : 2];
        if (numbers) numbers[i] = t->user & MW_USER_MASK;
    }
}

void mw_mesh_stored_vertices(const mw_mesh *mesh, uint32_t first, uint32_t count, double *points,
                             uint32_t *numbers)
{
    for (uint32_t i = 0; i < count; i++) {
        points[2 * (size_t)i] = mesh->point[first + i].x;
        points[2 * (size_t)i + 1] = mesh->point[first + i].y;
        if (numbers) numbers[i] = mw__vertex_number(mesh, first + i);
    }
}

uint32_t mw_mesh_neighbour(const mw_mesh *mesh, uint32_t triangle, unsigned local_edge,
                           unsigned *edge)
{
    const mw_triangle *t = &mesh->tri[mw__triangle_slot(mesh, triangle)];
    /* The exchange is its own inverse. */
    uint32_t link = t->link[mw__user_local_edge(t->user, local_edge)];
    if (link == MW_NONE) return MW_NONE;
    uint32_t user = mesh->tri[mw__link_triangle(link)].user;
    if (edge) *edge = mw__user_local_edge(user, mw__link_edge(link));
    return user & MW_USER_MASK;
}

size_t mw_mesh_bytes(const mw_mesh *mesh)
{
    size_t vertex = sizeof *mesh->point + mesh->field_count * sizeof(double),
           triangle = sizeof *mesh->tri;
    if (mesh->vertex_slot) vertex += sizeof *mesh->vertex_slot + sizeof *mesh->vertex_number;
    if (mesh->triangle_slot) triangle += sizeof *mesh->triangle_slot;
    return sizeof *mesh + mesh->point_count * vertex + mesh->tri_count * triangle +
           mesh->field_count * sizeof *mesh->field;
}

/* --- fields ----------------------------------------------------------------------------------- */

static mw_field *mesh_find_field(const mw_mesh *mesh, const char *name)
{
    for (size_t i = 0; i < mesh->field_count; i++)
        if (strcmp(mesh->field[i].name, name) == 0) return &mesh->field[i];
    return NULL;
}

/* A field that owns a copy of the name and room for the values; without a name when out of memory.
 */
static mw_field field_make(const mw_mesh *mesh, const char *name)
{
    size_t size = strlen(name) + 1;
    mw_field field = {.name = mw__alloc(size, 1),
                      .values = mw__alloc(mesh->point_count, sizeof(double))};
    if (field.name && field.values) {
        memcpy(field.name, name, size);
        return field;
    }
    field_release(&field);
    return (mw_field){0};
}

/* Append a field to be filled in; NULL when out of memory. */
static mw_field *mesh_add_field(mw_mesh *mesh, const char *name)
{
    mw_field *fields = mw__realloc(mesh->field, mesh->field_count + 1, sizeof *fields);
    if (!fields) return NULL;
    mesh->field = fields;
    fields[mesh->field_count] = field_make(mesh, name);
    return fields[mesh->field_count].name ? &fields[mesh->field_count++] : NULL;
}

/* The field of that name, to be filled in; NULL when out of memory. */
static mw_field *mesh_field_to_fill(mw_mesh *mesh, const char *name)
{
    mw_field *field = mesh_find_field(mesh, name);
    if (!field) return mesh_add_field(mesh, name);
    if (!field->borrowed) return field;
    mw_field own = field_make(mesh, name);
    if (!own.name) return NULL;
    *field = own;
    return field;
}

mw_status mw_mesh_set_field(mw_mesh *mesh, const char *name, const double *values, size_t stride,
                            mw_error *error)
{
    if (!mesh || !name || (!values && mesh->point_count))
        return mw__fail(error, MW_ERROR_ARGUMENT, "the mesh, the name or the values are NULL");
    mw_field *field = mesh_field_to_fill(mesh, name);
    if (!field) return mw__fail_memory(error);
    if (stride == 0) stride = 1;
    for (size_t i = 0; i < mesh->point_count; i++) field->values[i] = values[i * stride];
    return MW_OK;
}

const double *mw_mesh_field(const mw_mesh *mesh, const char *name)
{
    const mw_field *field = mesh_find_field(mesh, name);
    return field ? field->values : NULL;
}

size_t mw_mesh_field_count(const mw_mesh *mesh)
{
    return mesh->field_count;
}

const char *mw_mesh_field_name(const mw_mesh *mesh, size_t index)
{
    return index < mesh->field_count ? mesh->field[index].name : NULL;
}
