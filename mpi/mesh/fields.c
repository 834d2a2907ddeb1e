/* fields.c - values of a file, at the vertices of a piece. */
#include "mpi/mesh/mesh.h"

#include <stdlib.h>
#include <string.h>

void mwp__fields_release(mwp_fields *fields)
{
    free(fields->names);
    free(fields->rows);
    *fields = (mwp_fields){0};
}

size_t mwp_mesh_field_count(const mwp_mesh *mesh)
{
    return mesh->fields.count;
}

const char *mwp_mesh_field_name(const mwp_mesh *mesh, size_t index)
{
    return index < mesh->fields.count ? mesh->fields.names[index] : NULL;
}

int mwp_mesh_field(const mwp_mesh *mesh, const char *name, mw_value_table *table)
{
    const mwp_fields *f = &mesh->fields;
    for (uint32_t i = 0; i < f->count; i++) {
        if (strcmp(f->names[i], name) != 0) continue;
        *table = (mw_value_table){.values = f->rows + i, .count = 1, .stride = f->count};
        return 1;
    }
    return 0;
}
