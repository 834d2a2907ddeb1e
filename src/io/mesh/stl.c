/* STL, as text ("solid ... facet ... vertex x y z ...") and binary (80 bytes, a count, 50 bytes
 * a triangle of single precision numbers). Corners with equal coordinates become one vertex. */
#define _DEFAULT_SOURCE /* strncasecmp */
#include "base/posix.h"
#include "io/mesh/mesh_readers.h"
#include "io/mesh/mesh_writers.h"
#include "io/mesh/weld.h"
#include "io/text/byte_order.h"
#include "io/text/file_head.h"
#include "io/text/output.h"

#include <inttypes.h>
#include <math.h>
#include <string.h>

enum { HEADER = 80, FACET = 50, HEAD = 1024 };

static mw_status stl_add_facet(mw_weld *weld, mw_mesh_builder *builder, double corners[3][3],
                               mw_error *error)
{
    uint32_t v[3] = {0};
    for (int k = 0; k < 3; k++) {
        mw_status status = mw__weld_vertex(weld, builder, corners[k], &v[k], error);
        if (status) return status;
    }
    return mw__build_triangle(builder, v[0], v[1], v[2], error);
}

static mw_status stl_read_binary(mw_source *source, mw_mesh_builder *builder, mw_weld *weld,
                                 mw_error *error)
{
    source->binary = true;
    const unsigned char *bytes;
    mw_status status = mw__source_bytes(source, HEADER + 4, &bytes, error);
    if (status) return status;
    uint32_t count = mw__get_u32(bytes + HEADER);
    for (uint32_t t = 0; t < count; t++) {
        const char *next;
        size_t have;
        status = mw__source_peek(source, FACET, &next, &have, error);
        if (status) return status;
        if (have < FACET && !source->damage)
            return mw__source_fail(
                source, error, "the data end after %" PRIu32 " of %" PRIu32 " triangles", t, count);
        status = mw__source_bytes(source, FACET, &bytes, error);
        if (status) return status;
        double corners[3][3];
        for (int k = 0; k < 9; k++) corners[k / 3][k % 3] = mw__get_f32(bytes + 12 + 4 * k);
        status = stl_add_facet(weld, builder, corners, error);
        if (status) return status;
    }
    return mw__source_check_end(source, count, "triangles", error);
}

/* The keyword at p and what follows it, or NULL. */
static const char *stl_keyword(const char *p, const char *word)
{
    size_t length = strlen(word);
    return strncasecmp(p, word, length) == 0 && mw__at_gap(p + length) ? p + length : NULL;
}

typedef struct stl_text_state {
    bool in_solid;
    bool in_facet;
    int corners;
    double corner[3][3];
} stl_text_state;

static mw_status stl_read_text_line(mw_source *source, const char *p, stl_text_state *state,
                                    mw_mesh_builder *builder, mw_weld *weld, mw_error *error)
{
    const char *rest;
    if (!state->in_solid) {
        if (!stl_keyword(p, "solid")) return mw__source_fail(source, error, "expected 'solid'");
        state->in_solid = true;
    } else if (!state->in_facet && stl_keyword(p, "facet")) {
        state->in_facet = true;
        state->corners = 0;
    } else if (state->in_facet && (rest = stl_keyword(p, "vertex"))) {
        if (state->corners == 3)
            return mw__source_fail(source, error, "a facet has a fourth vertex");
        return mw__read_xyz(source, rest, state->corner[state->corners++], error);
    } else if (state->in_facet && stl_keyword(p, "endfacet")) {
        if (state->corners < 3)
            return mw__source_fail(source, error, "a facet has %d vertices, not 3", state->corners);
        state->in_facet = false;
        return stl_add_facet(weld, builder, state->corner, error);
    } else if (!state->in_facet && stl_keyword(p, "endsolid")) {
        state->in_solid = false;
    } else if (!state->in_facet || !(stl_keyword(p, "outer") || stl_keyword(p, "endloop"))) {
        return mw__source_fail(source, error, "'%s' was not expected here", mw__excerpt(p).text);
    }
    return MW_OK;
}

static mw_status stl_read_text(mw_source *source, mw_mesh_builder *builder, mw_weld *weld,
                               mw_error *error)
{
    stl_text_state state = {0};
    for (;;) {
        char *line;
        mw_status status = mw__source_line(source, &line, error);
        if (status) return status;
        if (!line) break;
        line = mw__skip_blanks(line);
        if (!*line) continue;
        status = stl_read_text_line(source, line, &state, builder, weld, error);
        if (status) return status;
    }
    if (source->line == 0) return mw__source_fail(source, error, "the file is empty");
    if (state.in_solid) return mw__source_fail(source, error, "the file ends before 'endsolid'");
    return MW_OK;
}

/* Binary files may begin with "solid" too, but text has no NUL bytes, and the upper byte of a
 * binary count is one. */
static bool stl_is_text(const char *head, size_t size)
{
    size_t i = (size_t)(mw__head_skip_mark(head, head + size) - head);
    while (i < size && (mw__is_blank(head[i]) || head[i] == '\n' || head[i] == '\r')) i++;
    return size - i >= 5 && strncasecmp(head + i, "solid", 5) == 0 && !memchr(head, 0, size);
}

mw_status mw__read_stl(mw_source *source, mw_mesh_builder *builder, mw_error *error)
{
    const char *head;
    size_t size;
    mw_weld weld;
    builder->file->has_z = 1;
    mw_status status = mw__source_peek(source, HEAD, &head, &size, error);
    if (status) return status;
    bool text = stl_is_text(head, size);
    status = mw__weld_start(&weld, error);
    if (status) return status;
    status = text ? stl_read_text(source, builder, &weld, error)
                  : stl_read_binary(source, builder, &weld, error);
    mw__weld_release(&weld);
    return status;
}

/* The unit normal of a triangle, zero where it has none. */
static void facet_normal(const double *a, const double *b, const double *c, double n[3])
{
    double u[3], v[3];
    for (int k = 0; k < 3; k++) {
        u[k] = b[k] - a[k];
        v[k] = c[k] - a[k];
    }
    for (int k = 0; k < 3; k++)
        n[k] = u[(k + 1) % 3] * v[(k + 2) % 3] - u[(k + 2) % 3] * v[(k + 1) % 3];
    double length = sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
    for (int k = 0; k < 3; k++) n[k] = length > 0 && isfinite(length) ? n[k] / length : 0;
}

static void stl_write_triple(mw_output *output, const char *before, const double xyz[3])
{
    mw__output_text(output, before);
    for (int k = 0; k < 3; k++) {
        mw__output_char(output, ' ');
        mw_output_double(output, xyz[k]);
    }
    mw__output_char(output, '\n');
}

static void stl_write(mw_output *output, const mw_mesh_file *file)
{
    mw__output_text(output, "solid meshwalk\n");
    for (size_t t = 0; t < file->triangle_count && !mw_output_failed(output); t++) {
        const double *corner[3];
        double normal[3];
        for (size_t k = 0; k < 3; k++)
            corner[k] = file->points + 3 * (size_t)file->triangles[3 * t + k];
        facet_normal(corner[0], corner[1], corner[2], normal);
        stl_write_triple(output, "facet normal", normal);
        mw__output_text(output, "outer loop\n");
        for (int k = 0; k < 3; k++) stl_write_triple(output, "vertex", corner[k]);
        mw__output_text(output, "endloop\nendfacet\n");
    }
    mw__output_text(output, "endsolid meshwalk\n");
}

mw_status mw__write_stl(const char *path, const mw_mesh_file *file, mw_job *job, mw_error *error)
{
    return mw__write_file(path, file, stl_write, job, error);
}
