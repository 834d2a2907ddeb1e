/* field.c - values at the vertices of a mesh, by name. */
#include "mesh/mesh.h"

#include <stdlib.h>
#include <string.h>

static mw_field *find_field(const mw_mesh *mesh, const char *name)
{
    for (size_t i = 0; i < mesh->field_count; i++)
        if (strcmp(mesh->field[i].name, name) == 0) return &mesh->field[i];
    return NULL;
}

/* Append a field that owns copies of the name and room for the values; NULL when out of memory. */
static mw_field *add_field(mw_mesh *mesh, const char *name)
{
    mw_field *fields = mw__realloc(mesh->field, mesh->field_count + 1, sizeof *fields);
    if (!fields) return NULL;
    mesh->field = fields;
    mw_field *field = &fields[mesh->field_count];
    size_t size = strlen(name) + 1;
    field->name = mw__alloc(size, 1);
    field->values = mw__alloc(mesh->point_count, sizeof(double));
    if (!field->name || !field->values) {
        free(field->name);
        free(field->values);
        return NULL;
    }
    memcpy(field->name, name, size);
    mesh->field_count++;
    return field;
}

mw_status mw_mesh_set_field(mw_mesh *mesh, const char *name, const double *values, size_t stride, mw_error *error)
{
    if (!mesh || !name || (!values && mesh->point_count))
        return mw__fail(error, MW_ERROR_ARGUMENT, "a field needs a mesh, a name and values");
    mw_field *field = find_field(mesh, name);
    if (!field) field = add_field(mesh, name);
    if (!field) return mw__fail_memory(error);
    if (stride == 0) stride = 1;
    for (size_t i = 0; i < mesh->point_count; i++) field->values[i] = values[i * stride];
    return MW_OK;
}

const double *mw_mesh_field(const mw_mesh *mesh, const char *name)
{
    const mw_field *field = find_field(mesh, name);
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
