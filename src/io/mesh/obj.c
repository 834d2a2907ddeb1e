/* OBJ, the format of Wavefront: "v x y z ...", "f a b c ..." with corners "a", "a/t", "a//n" or
 * "a/t/n", counted from 1 or, when negative, back from the last vertex. A "\" at the end
 * continues a line. All else is passed over. */
#include "io/mesh/mesh_readers.h"
#include "io/mesh/mesh_writers.h"
#include "io/text/number_text.h"
#include "io/text/output.h"

#include <inttypes.h>
#include <stdlib.h>
#include <string.h>

/* A line and its continuations, put together in memory of its own where there are any. */
typedef struct obj_statement {
    char *text; /* owned; NULL until needed */
    size_t used, room;
} obj_statement;

static bool statement_append(obj_statement *all, const char *text, size_t length)
{
    if (all->used + length + 1 > all->room) {
        size_t room = 2 * (all->used + length + 1);
        char *larger = mw__realloc(all->text, room, 1);
        if (!larger) return false;
        all->text = larger;
        all->room = room;
    }
    memcpy(all->text + all->used, text, length);
    all->used += length;
    all->text[all->used] = 0;
    return true;
}

/* The next line with what continues it, up to its comment; NULL at the end. */
static mw_status statement_read(mw_source *source, obj_statement *all, char **statement,
                                mw_error *error)
{
    all->used = 0;
    for (;;) {
        char *line;
        mw_status status = mw__source_line(source, &line, error);
        if (status) return status;
        if (!line) {
            *statement = all->used ? all->text : NULL;
            return MW_OK;
        }
        char *comment = strchr(line, '#');
        if (comment) *comment = 0;
        size_t length = strlen(line);
        bool continued = length > 0 && line[length - 1] == '\\';
        if (continued) line[--length] = ' ';
        *statement = line;
        if (!continued && !all->used) return MW_OK;
        if (all->used + length > MW_LINE_LIMIT)
            return mw__source_fail(source, error, "continued lines have more than %zu bytes",
                                   MW_LINE_LIMIT);
        if (!statement_append(all, line, length + continued)) return mw__fail_memory(error);
        *statement = all->text;
        if (!continued) return MW_OK;
    }
}

/* Skip "/texture/normal", each of which may be missing. NULL if something else stands there. */
static const char *corner_skip_references(const char *p)
{
    int64_t ignored;
    for (int k = 0; k < 2 && *p == '/'; k++) {
        const char *end = mw__read_integer(++p, &ignored);
        if (end) p = end;
    }
    return mw__at_gap(p) ? p : NULL;
}

static mw_status obj_read_face(mw_source *source, const char *p, mw_mesh_builder *builder,
                               mw_error *error)
{
    mw__build_face(builder);
    for (p = mw__skip_blanks(p); *p; p = mw__skip_blanks(p)) {
        int64_t number;
        const char *end = mw__read_integer(p, &number);
        if (end && !mw__integer_fits(number)) return mw__source_fail_large(source, p, end, error);
        if (end) end = corner_skip_references(end);
        if (!end || number == 0)
            return mw__source_fail(source, error, "'%s' is not a vertex number",
                                   mw__excerpt(p).text);
        if (number < 0) {
            int64_t back = number;
            int64_t count = (int64_t)builder->file->point_count;
            number = back < -count ? 0 : count + 1 + back;
            if (number == 0)
                return mw__source_fail(source, error,
                                       "vertex %" PRId64 " does not exist: there are %" PRId64
                                       " before this line",
                                       back, count);
        }
        mw_status status = mw__build_corner(builder, number, error);
        if (status) return status;
        p = end;
    }
    return mw__build_face_end(builder, error);
}

mw_status mw__read_obj(mw_source *source, mw_mesh_builder *builder, mw_error *error)
{
    obj_statement all = {0};
    builder->file->has_z = 1;
    builder->first_number = 1;
    mw_status status;
    for (;;) {
        char *p;
        status = statement_read(source, &all, &p, error);
        if (status || !p) break;
        p = mw__skip_blanks(p);
        if (p[0] == 'v' && mw__is_blank(p[1]))
            status = mw__build_point_text(builder, p + 1, error);
        else if (p[0] == 'f' && mw__is_blank(p[1]))
            status = obj_read_face(source, p + 1, builder, error);
        if (status) break;
    }
    free(all.text);
    if (!status && builder->file->point_count == 0)
        status = mw__source_fail(source, error, "there is no vertex ('v x y z') in this file");
    return status;
}

static void obj_write(mw_output *output, const mw_mesh_file *file)
{
    for (size_t v = 0; v < file->point_count && !mw_output_failed(output); v++) {
        mw__output_char(output, 'v');
        for (size_t k = 0; k < 3; k++) {
            mw__output_char(output, ' ');
            mw_output_double(output, file->points[3 * v + k]);
        }
        mw__output_char(output, '\n');
    }
    for (size_t t = 0; t < file->triangle_count && !mw_output_failed(output); t++) {
        mw__output_char(output, 'f');
        for (size_t k = 0; k < 3; k++) {
            mw__output_char(output, ' ');
            mw__output_integer(output, (uint64_t)file->triangles[3 * t + k] + 1);
        }
        mw__output_char(output, '\n');
    }
}

mw_status mw__write_obj(const char *path, const mw_mesh_file *file, mw_job *job, mw_error *error)
{
    return mw__write_file(path, file, obj_write, job, error);
}
