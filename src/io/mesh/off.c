/* OFF, the format of Geomview: [ST][C][N]OFF, then the counts of vertices, faces and (perhaps)
 * edges, then the vertices and the faces, one a line. Normals, colours and texture coordinates
 * are passed over. */
#include "io/mesh/mesh_readers.h"
#include "io/mesh/mesh_writers.h"
#include "io/text/counted_rows.h"
#include "io/text/number_text.h"
#include "io/text/output.h"

#include <inttypes.h>
#include <string.h>

/* The line with the keyword; *rest is what follows it, where the counts may stand. */
static mw_status off_read_keyword(mw_source *source, char **rest, mw_error *error)
{
    char *line;
    mw_status status = mw__source_content_line(source, &line, error);
    if (status) return status;
    size_t length = line ? strcspn(line, " \t") : 0;
    if (length < 3 || strncmp(line + length - 3, "OFF", 3) != 0)
        return mw__source_fail(source, error, "an OFF file begins with OFF");
    if (length > 3 && (line[length - 4] == 'n' || line[length - 4] == '4'))
        return mw__source_fail(source, error, "'%s' is not read: its vertices are not x, y, z",
                               mw__excerpt(line).text);
    *rest = mw__skip_blanks(line + length);
    if (strncmp(*rest, "BINARY", 6) == 0)
        return mw__source_fail(source, error, "binary OFF is not read");
    return MW_OK;
}

static mw_status off_read_counts(mw_source *source, char *line, int64_t *vertices, int64_t *faces,
                                 mw_error *error)
{
    if (!*line) {
        mw_status status = mw__source_content_line(source, &line, error);
        if (status) return status;
    }
    const char *p = line, *first_end = p ? mw__read_integer(p, vertices) : NULL;
    const char *second = first_end ? mw__skip_blanks(first_end) : NULL;
    const char *end = second ? mw__read_integer(second, faces) : NULL;
    if (!end || !mw__at_gap(end))
        return mw__source_fail(source, error, "expected the numbers of vertices and faces");
    if (!mw__integer_fits(*vertices)) return mw__source_fail_large(source, p, first_end, error);
    if (!mw__integer_fits(*faces)) return mw__source_fail_large(source, second, end, error);
    if (*vertices < 0 || *faces < 0) return mw__source_fail(source, error, "a count is negative");
    return MW_OK;
}

static mw_status off_read_face(mw_source *source, const char *line, mw_mesh_builder *builder,
                               mw_error *error)
{
    int64_t corners, number;
    const char *p = mw__read_integer(line, &corners);
    if (!p || !mw__at_gap(p) || corners < 0)
        return mw__source_fail(source, error, "'%s' is not a number of corners",
                               mw__excerpt(line).text);
    if (!mw__integer_fits(corners)) return mw__source_fail_large(source, line, p, error);
    mw__build_face(builder);
    for (int64_t k = 0; k < corners; k++) {
        p = mw__skip_blanks(p);
        const char *end = mw__read_integer(p, &number);
        if (!end || !mw__at_gap(end)) {
            if (!*p)
                return mw__source_fail(source, error,
                                       "a face announces %" PRId64 " corners, but has %" PRId64,
                                       corners, k);
            return mw__source_fail(source, error, "'%s' is not a vertex number",
                                   mw__excerpt(p).text);
        }
        if (!mw__integer_fits(number)) return mw__source_fail_large(source, p, end, error);
        mw_status status = mw__build_corner(builder, number, error);
        if (status) return status;
        p = end;
    }
    return mw__build_face_end(builder, error);
}

mw_status mw__read_off(mw_source *source, mw_mesh_builder *builder, mw_error *error)
{
    char *line;
    int64_t vertices, faces;
    builder->file->has_z = 1;
    mw_status status = off_read_keyword(source, &line, error);
    if (!status) status = off_read_counts(source, line, &vertices, &faces, error);
    for (int64_t v = 0; !status && v < vertices; v++) {
        status = mw__source_content_line(source, &line, error);
        if (!status && !line) status = mw__rows_end_early(source, "vertices", v, vertices, error);
        if (!status) status = mw__build_point_text(builder, line, error);
    }
    builder->points_complete = true;
    for (int64_t f = 0; !status && f < faces; f++) {
        status = mw__source_content_line(source, &line, error);
        if (!status && !line) status = mw__rows_end_early(source, "faces", f, faces, error);
        if (!status) status = off_read_face(source, line, builder, error);
    }
    return status ? status : mw__rows_check_end(source, "faces", faces, error);
}

static void off_write(mw_output *output, const mw_mesh_file *file)
{
    mw_output_printf(output, "OFF\n%zu %zu 0\n", file->point_count, file->triangle_count);
    mw__output_points(output, file);
    mw__output_triangles(output, file);
}

mw_status mw__write_off(const char *path, const mw_mesh_file *file, mw_job *job, mw_error *error)
{
    return mw__write_file(path, file, off_write, job, error);
}
