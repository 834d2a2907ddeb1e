#include "io/grid/msh_data.h"

#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { MSH_WIDTH_LIMIT = 9, MSH_NAME_SIZE = 256, MSH_COLUMN_SIZE = MSH_NAME_SIZE + 24 };

/* What stands before the values. */
typedef struct msh_data_head {
    char name[MSH_NAME_SIZE];
    int64_t width, count;
} msh_data_head;

/* Texts, a line each, of which the first is the name; quotes round it are removed. */
static mw_status msh_read_texts(mw_msh_source *m, msh_data_head *head, mw_error *error)
{
    int64_t count;
    mw_status status = mw__value_word_count(&m->values, "number of texts", &count, error);
    for (int64_t i = 0; !status && i < count; i++) {
        char *line;
        status = mw__value_line(&m->values, &line, error);
        if (!status && !line)
            status = mw__source_fail(m->values.source, error, "the file ends before a name");
        if (status || i > 0) continue;
        line = mw__skip_blanks(line);
        line += *line == '"';
        size_t length = strlen(line);
        while (length > 0 && strchr(" \t\"", line[length - 1])) length--;
        if (length >= sizeof head->name) length = sizeof head->name - 1;
        memcpy(head->name, line, length);
        head->name[length] = 0;
    }
    if (!status && !*head->name)
        status = mw__source_fail(m->values.source, error, "the values have no name");
    return status;
}

/* Texts, real numbers (the time), and integers: the step, the number of values of each vertex or
 * face, and of how many there are values. All are text, whatever the values are. */
static mw_status msh_read_head(mw_msh_source *m, msh_data_head *head, mw_error *error)
{
    int64_t count, number;
    char *ignored;
    mw_status status = msh_read_texts(m, head, error);
    if (!status) status = mw__value_word_count(&m->values, "count of numbers", &count, error);
    for (int64_t i = 0; !status && i < count; i++) {
        status = mw__value_word(&m->values, &ignored, error);
        if (!status && !ignored)
            status = mw__source_fail(m->values.source, error, "the file ends before the time");
    }
    if (!status) status = mw__value_word_count(&m->values, "count of integers", &count, error);
    for (int64_t i = 0; !status && i < count; i++) {
        status = mw__value_word_integer(&m->values, "number", &number, error);
        if (i == 1) head->width = number;
        if (i == 2) head->count = number;
    }
    if (!status && (head->width < 1 || head->width > MSH_WIDTH_LIMIT || head->count < 0))
        status = mw__source_fail(m->values.source, error,
                                 "'%s' announces %" PRId64 " times %" PRId64 " values", head->name,
                                 head->count, head->width);
    return status;
}

static bool msh_data_is_there(const mw_mesh_file *file, const char *name, bool of_faces)
{
    char *const *names = of_faces ? file->triangle_field_names : file->field_names;
    size_t count = of_faces ? file->triangle_field_count : file->field_count;
    for (size_t f = 0; f < count; f++)
        if (strcmp(names[f], name) == 0) return true;
    return false;
}

/* Lines "number value ...", to where `columns` has room for a number of each vertex or face; NULL:
 * they are skipped. */
static mw_status msh_read_values(mw_msh_source *m, const msh_data_head *head,
                                 const mw_rank_list *ranks, bool of_faces, double *const *columns,
                                 mw_error *error)
{
    mw_status status = MW_OK;
    for (int64_t i = 0; !status && i < head->count; i++) {
        int64_t number = 0;
        status = mw__msh_integer(m, of_faces ? "number of an element" : "number of a vertex",
                                 &number, error);
        size_t rank = columns && !status ? mw__ranks_find(ranks, number) : SIZE_MAX;
        if (columns && !status && !of_faces && rank == SIZE_MAX)
            status = mw__source_fail(m->values.source, error, "vertex %" PRId64 " does not exist",
                                     number);
        for (int64_t k = 0; !status && k < head->width; k++) {
            double value;
            status = mw__msh_real(m, "value", &value, error);
            if (!status && rank != SIZE_MAX) columns[k][mw__ranks_position(ranks, rank)] = value;
        }
    }
    return status;
}

static void msh_column_name(const msh_data_head *head, int64_t k, char *name, size_t size)
{
    if (head->width > 1)
        snprintf(name, size, "%s_%" PRId64, head->name, k);
    else
        snprintf(name, size, "%s", head->name);
}

static mw_status msh_read_vertex_data(mw_msh_source *m, const msh_data_head *head,
                                      mw_mesh_builder *builder, const mw_rank_list *ranks,
                                      mw_error *error)
{
    double *columns[MSH_WIDTH_LIMIT] = {0};
    char name[MSH_COLUMN_SIZE];
    mw_status status = MW_OK;
    for (int64_t k = 0; !status && k < head->width; k++) {
        msh_column_name(head, k, name, sizeof name);
        status = mw__build_late_field(builder, name, &columns[k], error);
    }
    return status ? status : msh_read_values(m, head, ranks, false, columns, error);
}

static mw_status msh_read_face_data(mw_msh_source *m, const msh_data_head *head,
                                    mw_mesh_builder *builder, const mw_rank_list *ranks,
                                    mw_error *error)
{
    double *columns[MSH_WIDTH_LIMIT] = {0};
    char name[MSH_COLUMN_SIZE];
    size_t faces = ranks->numbers.count;
    mw_status status = MW_OK;
    double *values = mw__alloc(faces, (size_t)head->width * sizeof *values);
    if (!values) return mw__fail_memory(error);
    for (size_t i = 0; i < faces * (size_t)head->width; i++) values[i] = NAN;
    for (int64_t k = 0; k < head->width; k++) columns[k] = values + (size_t)k * faces;
    status = msh_read_values(m, head, ranks, true, columns, error);
    for (int64_t k = 0; !status && k < head->width; k++) {
        msh_column_name(head, k, name, sizeof name);
        status = mw__build_face_field(builder, name, columns[k], error);
    }
    free(values);
    return status;
}

mw_status mw__msh_read_data(mw_msh_source *m, mw_mesh_builder *builder, const mw_rank_list *ranks,
                            bool of_faces, mw_error *error)
{
    msh_data_head head = {0};
    char first[MSH_COLUMN_SIZE];
    mw_status status = msh_read_head(m, &head, error);
    if (status) return status;
    msh_column_name(&head, 0, first, sizeof first);
    if (msh_data_is_there(builder->file, first, of_faces))
        return msh_read_values(m, &head, ranks, of_faces, NULL, error);
    return of_faces ? msh_read_face_data(m, &head, builder, ranks, error)
                    : msh_read_vertex_data(m, &head, builder, ranks, error);
}
