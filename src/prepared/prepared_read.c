/* prepared_read.c - reads a prepared file for those who want the arrays of a mesh. */
#include "prepared/prepared_read.h"

#include "prepared/prepared.h"

#include <stdlib.h>
#include <string.h>

bool mw__prepared_begins(const char *head, size_t size)
{
    static const char mark[] = MW_PREPARED_MARK;
    return size >= sizeof mark - 1 && memcmp(head, mark, sizeof mark - 1) == 0;
}

/* --- copies ----------------------------------------------------------------------------------- */

/* The number of the field of heights; the number of fields if there is none. */
static size_t values_heights(const mw_mesh_file *v)
{
    size_t i = 0;
    while (i < v->field_count && strcmp(v->field_names[i], "z") != 0) i++;
    return i;
}

static bool file_copy_mesh(const mw_prepared *p, mw_mesh_file *file)
{
    const mw_mesh_file *v = &p->values;
    const size_t heights = values_heights(v);
    file->points = mw__alloc(v->point_count, 3 * sizeof *file->points);
    file->triangles = mw__alloc(v->triangle_count, 3 * sizeof *file->triangles);
    if (!file->points || !file->triangles) return false;
    file->point_count = v->point_count;
    file->triangle_count = v->triangle_count;
    file->has_z = heights < v->field_count;
    for (uint32_t i = 0; i < v->point_count; i++) {
        mw_mesh_vertex(&p->mesh, i, file->points + 3 * (size_t)i);
        file->points[3 * (size_t)i + 2] = file->has_z ? v->fields[heights][i] : 0;
    }
    for (uint32_t t = 0; t < v->triangle_count; t++)
        mw_mesh_triangle(&p->mesh, t, file->triangles + 3 * (size_t)t);
    return true;
}

static void *bytes_copy(const void *bytes, size_t count, size_t size)
{
    void *copy = mw__alloc(count, size);
    if (copy && count) memcpy(copy, bytes, count * size);
    return copy;
}

/* Copy the names, and the fields of them, but for the one numbered `left_out`. */
static bool fields_copy(char *const *names, double *const *fields, size_t count, size_t left_out,
                        size_t length, char ***names_out, double ***fields_out, size_t *count_out)
{
    *names_out = mw__calloc(count, sizeof **names_out);
    if (fields) *fields_out = mw__calloc(count, sizeof **fields_out);
    if (!*names_out || (fields && !*fields_out)) return false;
    for (size_t i = 0; i < count; i++) {
        if (i == left_out) continue;
        const size_t k = (*count_out)++;
        (*names_out)[k] = strdup(names[i]);
        if (fields) (*fields_out)[k] = bytes_copy(fields[i], length, sizeof(double));
        if (!(*names_out)[k] || (fields && !(*fields_out)[k])) return false;
    }
    return true;
}

static bool file_copy_values(const mw_prepared *p, mw_mesh_file *file)
{
    const mw_mesh_file *v = &p->values;
    if (v->faces) file->faces = bytes_copy(v->faces, v->triangle_count, sizeof *v->faces);
    if (v->edge_count) file->edges = bytes_copy(v->edges, v->edge_count, sizeof *v->edges);
    if (v->crs) file->crs = strdup(v->crs);
    file->face_count = v->face_count;
    file->edge_count = v->edge_count;
    file->step_count = v->step_count;
    return (file->faces || !v->faces) && (file->edges || !v->edge_count) &&
           (file->crs || !v->crs) &&
           fields_copy(v->field_names, v->fields, v->field_count, values_heights(v), v->point_count,
                       &file->field_names, &file->fields, &file->field_count) &&
           fields_copy(v->triangle_field_names, v->triangle_fields, v->triangle_field_count,
                       SIZE_MAX, v->triangle_count, &file->triangle_field_names,
                       &file->triangle_fields, &file->triangle_field_count) &&
           fields_copy(v->mark_names, NULL, v->mark_count, SIZE_MAX, 0, &file->mark_names, NULL,
                       &file->mark_count);
}

static mw_status prepared_copy(const mw_prepared *p, mw_mesh_builder *builder, mw_error *error)
{
    builder->first_number = p->values.first_number;
    return file_copy_mesh(p, builder->file) && file_copy_values(p, builder->file)
               ? MW_OK
               : mw__fail_memory(error);
}

/* --- reading ---------------------------------------------------------------------------------- */

/* All bytes of a source, at a multiple of MW_PREPARED_ALIGN. */
static mw_status source_read_bytes(mw_source *source, unsigned char **out, size_t *size,
                                   mw_error *error)
{
    enum { LEAST = 1 << 16 };
    size_t room = 0;
    for (*out = NULL, *size = 0;;) {
        const char *next;
        const unsigned char *bytes;
        size_t count;
        mw_status status = mw__source_peek(source, MW_BYTES_LIMIT, &next, &count, error);
        if (status || (count == 0 && !source->damage)) return status;
        status = mw__source_bytes(source, count ? count : 1, &bytes, error);
        if (status) return status;
        if (*size + count > room) {
            room = room + room / 2 + LEAST;
            unsigned char *larger = mw__alloc_lines(room, 1);
            if (larger && *size) memcpy(larger, *out, *size);
            free(*out);
            *out = larger;
            if (!larger) return mw__fail_memory(error);
        }
        memcpy(*out + *size, bytes, count);
        *size += count;
    }
}

static mw_status prepared_read_bytes(mw_source *source, mw_mesh_builder *builder, mw_job *job,
                                     mw_error *error)
{
    unsigned char *bytes;
    size_t size;
    mw_prepared *p = mw__calloc(1, sizeof *p);
    if (!p) return mw__fail_memory(error);
    source->binary = true;
    mw_status status = source_read_bytes(source, &bytes, &size, error);
    if (!status)
        status = mw__prepared_open(p, mw__source_name(source), bytes, size, false, job, error);
    if (!status) status = prepared_copy(p, builder, error);
    mw__prepared_release(p);
    free(p);
    free(bytes);
    return status;
}

static mw_status prepared_read_map(const char *path, mw_mesh_builder *builder, mw_error *error)
{
    mw_prepared *p;
    mw_status status = mw_mesh_map(path, NULL, &p, error);
    if (!status) status = prepared_copy(p, builder, error);
    mw_prepared_close(p);
    return status;
}

mw_status mw__read_prepared(mw_source *source, mw_mesh_builder *builder, mw_error *error)
{
    mw_job job = mw__job(1, NULL);
    return mw__source_is_plain_file(source) ? prepared_read_map(source->path, builder, error)
                                            : prepared_read_bytes(source, builder, &job, error);
}
