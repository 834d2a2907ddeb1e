#include "cli/input/mesh_field.h"
#include "cli/frame/message.h"
#include "cli/frame/text.h"

#include <stdint.h>
#include <stdlib.h>
#include <string.h>

/* The number of a field of triangles; SIZE_MAX: there is none of this name. */
static size_t mesh_field_of_triangles(const mw_mesh_file *file, const char *field)
{
    size_t i = 0;
    while (i < file->triangle_field_count && strcmp(file->triangle_field_names[i], field) != 0) i++;
    return i < file->triangle_field_count ? i : SIZE_MAX;
}

/* Does the file have the field, or its layers, over time? */
static bool mesh_field_is_over_time(const char *path, const char *field)
{
    mw_series *series;
    bool is = false;
    const size_t length = strlen(field);
    if (strcmp(path, "-") == 0 || mw_series_open(path, NULL, &series, NULL) != MW_OK) return false;
    const mw_series_info *info = mw_series_describe(series);
    for (size_t i = 0; i < info->field_count && !is; i++) {
        const char *name = info->fields[i].name;
        is = strncmp(name, field, length) == 0 && (!name[length] || name[length] == ':');
    }
    mw_series_close(series);
    return is;
}

static int mesh_field_fail(const char *path, const mw_mesh_file *file,
                           const mesh_field_choice *choice)
{
    const bool triangles = choice->recover || choice->triangles;
    text names = {0};
    if (file->has_z) text_string(&names, " z");
    for (size_t i = 0; i < file->field_count; i++) text_printf(&names, " %s", file->field_names[i]);
    for (size_t i = 0; triangles && i < file->triangle_field_count; i++)
        text_printf(&names, " %s", file->triangle_field_names[i]);
    int end = END_INPUT;
    if (names.failed)
        end = fail_memory();
    else if (mesh_field_of_triangles(file, choice->field) != SIZE_MAX)
        complain("%s: '%s' is a field of triangles; values at vertices are needed here", path,
                 choice->field);
    else if (mesh_field_is_over_time(path, choice->field))
        complain("%s: '%s' has values over time; 'meshwalk sample --time all' takes them, or some",
                 path, choice->field);
    else if (names.size == 0)
        complain("%s: has neither heights nor fields: there is nothing to sample", path);
    else
        complain("%s: has no field '%s'; --field may be one of:%.*s", path, choice->field,
                 (int)names.size, names.bytes);
    text_release(&names);
    return end;
}

static int mesh_field_recover(mw_mesh *mesh, const char *path, const char *field,
                              const double *values)
{
    mw_error error;
    double *vertices = malloc(mw_mesh_vertex_count(mesh) * sizeof *vertices + 1);
    if (!vertices) return fail_memory();
    mw_status status = mw_recover_vertex_values(mesh, values, NULL, vertices, &error);
    if (status == MW_OK) status = mw_mesh_set_field(mesh, field, vertices, 1, &error);
    free(vertices);
    return status == MW_OK ? 0 : fail_mesh(path, &error);
}

/* The copy is for free(); NULL without memory. */
static double *mesh_field_copy_triangles(const char *path, const mw_mesh_file *file, size_t field,
                                         const mesh_field_choice *choice)
{
    nodata_rule rule = choice->nodata;
    rule.place = "triangle";
    rule.places = "triangles";
    return nodata_copy(file->triangle_fields[field], 1, file->triangle_count, &rule, path,
                       choice->field, choice->quiet);
}

static int mesh_field_take_triangles(mw_mesh *mesh, const char *path, const mw_mesh_file *file,
                                     size_t field, const mesh_field_choice *choice)
{
    double *copy = mesh_field_copy_triangles(path, file, field, choice);
    if (!copy) return fail_memory();
    if (!choice->recover) {
        *choice->triangles = copy;
        return 0;
    }
    const int end = mesh_field_recover(mesh, path, choice->field, copy);
    free(copy);
    return end;
}

/* The values of a field of vertices, `stride` apart. NULL: there is none of this name. */
static const double *mesh_field_of_vertices(const mw_mesh_file *file, const char *field,
                                            size_t *stride)
{
    *stride = 1;
    for (size_t i = 0; i < file->field_count; i++)
        if (strcmp(file->field_names[i], field) == 0) return file->fields[i];
    *stride = 3;
    if (!file->has_z || strcmp(field, "z") != 0) return NULL;
    static const double none; /* of no vertices */
    return file->points ? file->points + 2 : &none;
}

int mesh_field_copy(const char *path, const mw_mesh_file *file, const mesh_field_choice *choice,
                    double **copy)
{
    size_t stride;
    const double *values = mesh_field_of_vertices(file, choice->field, &stride);
    if (!values) return mesh_field_fail(path, file, choice);
    if (file->step_count > 1 && stride == 1 && !choice->quiet)
        complain("%s: warning: has values at %zu times; '%s' is that of the first ('meshwalk "
                 "sample --time' takes others)",
                 path, file->step_count, choice->field);
    *copy = nodata_copy(values, stride, file->point_count, &choice->nodata, path, choice->field,
                        choice->quiet);
    return *copy ? 0 : fail_memory();
}

int mesh_field_load(mw_mesh *mesh, const char *path, const mw_mesh_file *file, const void *self)
{
    const mesh_field_choice *choice = self;
    const char *field = choice->field;
    mw_error error;
    double *copy;
    size_t stride;
    const bool of_vertices = mesh_field_of_vertices(file, field, &stride) != NULL;
    const size_t triangles = of_vertices ? SIZE_MAX : mesh_field_of_triangles(file, field);
    if (triangles != SIZE_MAX && (choice->recover || choice->triangles))
        return mesh_field_take_triangles(mesh, path, file, triangles, choice);
    int end = mesh_field_copy(path, file, choice, &copy);
    if (end) return end;
    mw_status status = mw_mesh_set_field(mesh, field, copy, 1, &error);
    free(copy);
    return status == MW_OK ? 0 : fail_mesh(path, &error);
}

int mesh_field_copy_either(const char *path, const mw_mesh_file *file,
                           const mesh_field_choice *choice, double **values)
{
    size_t stride;
    const bool of_vertices = mesh_field_of_vertices(file, choice->field, &stride) != NULL;
    const size_t triangles = of_vertices ? SIZE_MAX : mesh_field_of_triangles(file, choice->field);
    if (triangles == SIZE_MAX) return mesh_field_copy(path, file, choice, values);
    *choice->triangles = mesh_field_copy_triangles(path, file, triangles, choice);
    return *choice->triangles ? 0 : fail_memory();
}
