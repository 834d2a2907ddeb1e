/* SERAFIN or Selafin, of TELEMAC: either byte order, single and double precision. The variables
 * become fields, at the first time of the file; those of later times are a series. */
#include "io/grid/selafin.h"
#include "io/grid/grid_readers.h"
#include "io/text/byte_order.h"

#include <inttypes.h>
#include <stdlib.h>
#include <string.h>

bool mw__is_selafin(const char *head, size_t size)
{
    return size >= 88 && memcmp(head, head + 84, 4) == 0 &&
           (memcmp(head, "\0\0\0P", 4) == 0 || memcmp(head, "P\0\0\0", 4) == 0);
}

mw_status mw__selafin_record(mw_selafin *s, uint64_t wanted, const char *what, uint64_t *length,
                             mw_error *error)
{
    const unsigned char *bytes;
    uint64_t position = mw__source_position(s->source);
    mw_status status = mw__source_bytes(s->source, 4, &bytes, error);
    if (status) return status;
    *length = mw__get_bytes(bytes, 4, s->big);
    if (wanted != SIZE_MAX && *length != wanted)
        return mw__source_fail_at(s->source, position, error,
                                  "the record of the %s has %" PRIu64 " bytes, not %" PRIu64, what,
                                  *length, wanted);
    return MW_OK;
}

mw_status mw__selafin_record_end(mw_selafin *s, uint64_t length, mw_error *error)
{
    const unsigned char *bytes;
    uint64_t position = mw__source_position(s->source);
    mw_status status = mw__source_bytes(s->source, 4, &bytes, error);
    if (!status && mw__get_bytes(bytes, 4, s->big) != length)
        status = mw__source_fail_at(s->source, position, error,
                                    "a record is not followed by its length, %" PRIu64, length);
    return status;
}

mw_status mw__selafin_real(mw_selafin *s, double *value, mw_error *error)
{
    const unsigned char *bytes;
    mw_status status = mw__source_bytes(s->source, s->real, &bytes, error);
    if (status) return status;
    uint64_t bits = mw__get_bytes(bytes, s->real, s->big);
    *value = s->real == 4 ? (double)mw__float_of_bits((uint32_t)bits) : mw__double_of_bits(bits);
    return MW_OK;
}

mw_status mw__selafin_integer(mw_selafin *s, int64_t *value, mw_error *error)
{
    const unsigned char *bytes;
    mw_status status = mw__source_bytes(s->source, 4, &bytes, error);
    if (!status) *value = (int32_t)(uint32_t)mw__get_bytes(bytes, 4, s->big);
    return status;
}

/* A record of integers only. */
static mw_status selafin_integers(mw_selafin *s, const char *what, int64_t *values, size_t count,
                                  mw_error *error)
{
    uint64_t length;
    mw_status status = mw__selafin_record(s, 4 * count, what, &length, error);
    for (size_t i = 0; !status && i < count; i++)
        status = mw__selafin_integer(s, &values[i], error);
    return status ? status : mw__selafin_record_end(s, length, error);
}

/* The title tells the byte order by its length, 80, and the precision by its end. */
static mw_status selafin_read_title(mw_selafin *s, mw_error *error)
{
    const char *head;
    const unsigned char *bytes;
    size_t size;
    uint64_t length;
    s->source->binary = true;
    mw_status status = mw__source_peek(s->source, 4, &head, &size, error);
    if (status) return status;
    s->big = size == 4 && head[3] == 80;
    status = mw__selafin_record(s, 80, "title", &length, error);
    if (!status) status = mw__source_bytes(s->source, 80, &bytes, error);
    if (status) return status;
    s->real = memcmp(bytes + 72, "SERAFIND", 8) == 0 ? 8 : 4;
    return mw__selafin_record_end(s, length, error);
}

static mw_status selafin_read_name(mw_selafin *s, mw_error *error)
{
    uint64_t length;
    const unsigned char *bytes;
    mw_status status = mw__selafin_record(s, 32, "name of a variable", &length, error);
    if (!status) status = mw__source_bytes(s->source, 32, &bytes, error);
    if (status) return status;
    char(*names)[33] = mw__realloc(s->names, s->field_count + 1, sizeof *names);
    if (!names) return mw__fail_memory(error);
    s->names = names;
    char *name = names[s->field_count++];
    memcpy(name, bytes, 32);
    name[32] = 0;
    for (size_t i = 0; i < 32; i++)
        if ((unsigned char)name[i] < ' ' || (unsigned char)name[i] > '~') name[i] = ' ';
    return mw__selafin_record_end(s, length, error);
}

mw_status mw__selafin_start(mw_selafin *s, mw_source *source, mw_error *error)
{
    int64_t counts[4] = {0};
    *s = (mw_selafin){.source = source};
    mw_status status = selafin_read_title(s, error);
    if (!status) status = selafin_integers(s, "numbers of variables", counts, 2, error);
    if (!status && (counts[0] < 0 || counts[1] < 0 || counts[0] + counts[1] > MW_COLUMN_LIMIT))
        status = mw__source_fail(source, error,
                                 "the file announces %" PRId64 " and %" PRId64 " variables",
                                 counts[0], counts[1]);
    for (int64_t i = 0; !status && i < counts[0] + counts[1]; i++)
        status = selafin_read_name(s, error);
    if (!status) status = selafin_integers(s, "parameters", s->parameters, 10, error);
    if (!status && s->parameters[9] == 1) status = selafin_integers(s, "date", s->date, 6, error);
    if (!status) status = selafin_integers(s, "numbers of the mesh", counts, 4, error);
    s->elements = counts[0];
    s->vertices = counts[1];
    s->corners = counts[2];
    if (!status && (s->elements < 0 || s->vertices < 0))
        status = mw__source_fail(source, error, "a count is negative");
    if (!status && (s->parameters[6] > 1 || (s->corners != 3 && s->corners != 4)))
        status = mw__source_fail(source, error,
                                 "the elements have %" PRId64 " corners, in %" PRId64
                                 " planes; only meshes in one plane are read, with 3 or 4 corners",
                                 s->corners, s->parameters[6]);
    return status;
}

void mw__selafin_release(mw_selafin *s)
{
    free(s->names);
    s->names = NULL;
}

mw_status mw__selafin_time(mw_selafin *s, double *time, bool *ended, mw_error *error)
{
    const char *next;
    size_t size;
    uint64_t length;
    mw_status status = mw__source_peek(s->source, 1, &next, &size, error);
    *ended = size == 0 && !s->source->damage;
    if (status || *ended) return status;
    status = mw__selafin_record(s, s->real, "time", &length, error);
    if (!status) status = mw__selafin_real(s, time, error);
    return status ? status : mw__selafin_record_end(s, length, error);
}

mw_status mw__selafin_values(mw_selafin *s, const char *what, double *values, size_t stride,
                             mw_error *error)
{
    uint64_t length;
    mw_status status = mw__selafin_record(s, (uint64_t)s->vertices * s->real, what, &length, error);
    for (int64_t v = 0; !status && v < s->vertices; v++)
        status = mw__selafin_real(s, &values[stride * (size_t)v], error);
    return status ? status : mw__selafin_record_end(s, length, error);
}

mw_status mw__selafin_skip(mw_selafin *s, mw_error *error)
{
    uint64_t length;
    mw_status status =
        mw__selafin_record(s, (uint64_t)s->vertices * s->real, "values", &length, error);
    if (!status) status = mw__source_skip(s->source, length, error);
    return status ? status : mw__selafin_record_end(s, length, error);
}

static mw_status selafin_read_elements(mw_selafin *s, mw_mesh_builder *builder, mw_error *error)
{
    uint64_t length;
    uint64_t bytes = 4 * (uint64_t)s->elements * (uint64_t)s->corners;
    mw_status status = mw__selafin_record(s, bytes, "elements", &length, error);
    for (int64_t e = 0; !status && e < s->elements; e++) {
        int64_t vertex;
        mw__build_face(builder);
        for (int64_t k = 0; !status && k < s->corners; k++) {
            status = mw__selafin_integer(s, &vertex, error);
            if (!status) status = mw__build_corner(builder, vertex, error);
        }
        if (!status) status = mw__build_face_end(builder, error);
    }
    if (!status) status = mw__selafin_record_end(s, length, error);
    /* numbers of border vertices */
    if (!status)
        status = mw__selafin_record(s, 4 * (uint64_t)s->vertices, "border", &length, error);
    if (!status) status = mw__source_skip(s->source, length, error);
    return status ? status : mw__selafin_record_end(s, length, error);
}

/* x of all vertices, which tell the precision, then y. */
static mw_status selafin_read_points(mw_selafin *s, mw_mesh_builder *builder, mw_error *error)
{
    uint64_t length;
    mw_mesh_file *file = builder->file;
    mw_status status = mw__selafin_record(s, SIZE_MAX, "x", &length, error);
    if (status) return status;
    if (length == 8 * (uint64_t)s->vertices)
        s->real = 8;
    else if (length == 4 * (uint64_t)s->vertices)
        s->real = 4;
    else
        return mw__source_fail(s->source, error,
                               "the record of x has %" PRIu64 " bytes for %" PRId64 " vertices",
                               length, s->vertices);
    for (int64_t v = 0; !status && v < s->vertices; v++) {
        double x;
        status = mw__selafin_real(s, &x, error);
        if (!status) status = mw__build_point(builder, x + (double)s->parameters[2], 0, 0, error);
    }
    if (!status) status = mw__selafin_record_end(s, length, error);
    builder->points_complete = true;
    double *y = file->points ? file->points + 1 : NULL; /* no vertices: there is no array */
    if (!status) status = mw__selafin_values(s, "y", y, 3, error);
    for (size_t v = 0; !status && v < file->point_count; v++)
        file->points[3 * v + 1] += (double)s->parameters[3];
    return status;
}

/* The field of a variable is called as it is, without its unit. */
static mw_status selafin_add_fields(const mw_selafin *s, mw_mesh_builder *builder, mw_error *error)
{
    mw_status status = MW_OK;
    for (size_t f = 0; !status && f < s->field_count; f++) {
        char name[17];
        size_t length = 16;
        memcpy(name, s->names[f], length);
        while (length > 0 && name[length - 1] == ' ') length--;
        name[length] = 0;
        status = mw__build_field(builder, name, error);
    }
    return status;
}

static mw_status selafin_read_steps(mw_selafin *s, mw_mesh_builder *builder, mw_error *error)
{
    mw_mesh_file *file = builder->file;
    for (;;) {
        double time;
        bool ended;
        mw_status status = mw__selafin_time(s, &time, &ended, error);
        if (status || ended) return status;
        for (size_t f = 0; !status && f < s->field_count; f++)
            status = file->step_count == 0
                         ? mw__selafin_values(s, s->names[f], file->fields[f], 1, error)
                         : mw__selafin_skip(s, error);
        if (status) return status;
        file->step_count++;
    }
}

/* Without a time there are no values. */
static void selafin_drop_fields(mw_mesh_file *file)
{
    mw__fields_release(file->field_names, file->fields, file->field_count);
    file->field_names = NULL;
    file->fields = NULL;
    file->field_count = 0;
}

mw_status mw__read_selafin(mw_source *source, mw_mesh_builder *builder, mw_error *error)
{
    mw_selafin s;
    builder->first_number = 1;
    mw_status status = mw__selafin_start(&s, source, error);
    if (!status) status = selafin_add_fields(&s, builder, error);
    if (!status) status = selafin_read_elements(&s, builder, error);
    if (!status) status = selafin_read_points(&s, builder, error);
    if (!status && s.vertices > 0) status = selafin_read_steps(&s, builder, error);
    if (!status && builder->file->step_count == 0) selafin_drop_fields(builder->file);
    mw__selafin_release(&s);
    return status;
}
