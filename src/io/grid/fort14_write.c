/* Writing ADCIRC's fort.14, which has triangles only, and SCHISM's .gr3, which has quadrilaterals,
 * too. Marked edges become boundaries: open ones if their mark begins with "open", else land
 * boundaries, whose type is the number after "type" in the mark. Types whose vertices have further
 * values (barriers) cannot be written, and are left out. */
#include "io/grid/grid_writers.h"
#include "io/text/number_text.h"

#include <string.h>

static bool mark_is_open(const char *mark)
{
    return strncmp(mark, "open", 4) == 0;
}

static int64_t mark_type(const char *mark)
{
    int64_t type;
    const char *word = strstr(mark, "type ");
    return word && mw__read_integer(word + 5, &type) ? type : 0;
}

/* Barriers: 3, 4, 5 and these plus 10 or 20. */
static bool mark_is_plain(const char *mark)
{
    int64_t type = mark_type(mark);
    return mark_is_open(mark) || type < 0 || type > 29 || type % 10 < 3 || type % 10 > 5;
}

/* The end of the chain of edges that begins with edge e: each goes on from the one before. */
static size_t chain_end(const mw_mesh_file *file, size_t e)
{
    size_t end = e + 1;
    while (end < file->edge_count && file->edges[end].mark == file->edges[e].mark &&
           file->edges[end].vertex[0] == file->edges[end - 1].vertex[1])
        end++;
    return end;
}

static bool chain_is_wanted(const mw_mesh_file *file, size_t e, bool open)
{
    const char *mark = file->mark_names[file->edges[e].mark];
    return mark_is_open(mark) == open && mark_is_plain(mark);
}

static void chain_write(mw_output *output, const mw_mesh_file *file, size_t e, size_t end,
                        bool open)
{
    mw__output_integer(output, end - e + 1);
    if (!open) {
        mw__output_char(output, ' ');
        mw__output_signed(output, mark_type(file->mark_names[file->edges[e].mark]));
    }
    mw__output_char(output, '\n');
    for (size_t i = e; i <= end; i++) {
        uint32_t v = i < end ? file->edges[i].vertex[0] : file->edges[end - 1].vertex[1];
        mw__output_integer(output, (uint64_t)v + 1);
        mw__output_char(output, '\n');
    }
}

static void boundaries_write(mw_output *output, const mw_mesh_file *file, bool open)
{
    size_t chains = 0, vertices = 0;
    for (size_t e = 0, end; e < file->edge_count; e = end) {
        end = chain_end(file, e);
        if (!chain_is_wanted(file, e, open)) continue;
        chains++;
        vertices += end - e + 1;
    }
    mw_output_printf(output, "%zu = Number of %s boundaries\n", chains, open ? "open" : "land");
    mw_output_printf(output, "%zu = Total number of %s boundary nodes\n", vertices,
                     open ? "open" : "land");
    for (size_t e = 0, end; e < file->edge_count && !mw_output_failed(output); e = end) {
        end = chain_end(file, e);
        if (chain_is_wanted(file, e, open)) chain_write(output, file, e, end, open);
    }
}

static void fort14_write_vertices(mw_output *output, const mw_mesh_file *file)
{
    const double *depths = mw__vertex_values(file, "depth");
    for (size_t v = 0; v < file->point_count && !mw_output_failed(output); v++) {
        mw__output_integer(output, v + 1);
        for (size_t k = 0; k < 2; k++) {
            mw__output_char(output, ' ');
            mw_output_double(output, file->points[3 * v + k]);
        }
        mw__output_char(output, ' ');
        mw_output_double(output, mw__vertex_depth(file, depths, v));
        mw__output_char(output, '\n');
    }
}

static void fort14_write_body(mw_output *output, const mw_mesh_file *file, size_t corners)
{
    size_t face = 0, count;
    mw_output_printf(output, "meshwalk\n%zu %zu\n", mw__face_count(file, corners),
                     file->point_count);
    fort14_write_vertices(output, file);
    for (size_t t = 0; t < file->triangle_count && !mw_output_failed(output); t += count) {
        count = mw__face_triangles(file, t, corners);
        mw__output_integer(output, ++face);
        mw__output_char(output, ' ');
        mw__output_integer(output, count + 2);
        for (size_t k = 0; k < count + 2; k++) {
            mw__output_char(output, ' ');
            mw__output_integer(output, (uint64_t)mw__face_corner(file, t, k) + 1);
        }
        mw__output_char(output, '\n');
    }
    boundaries_write(output, file, true);
    boundaries_write(output, file, false);
}

static void fort14_write(mw_output *output, const mw_mesh_file *file)
{
    fort14_write_body(output, file, 3);
}

static void gr3_write(mw_output *output, const mw_mesh_file *file)
{
    fort14_write_body(output, file, 4);
}

mw_status mw__write_fort14(const char *path, const mw_mesh_file *file, mw_job *job, mw_error *error)
{
    return mw__write_file(path, file, fort14_write, job, error);
}

mw_status mw__write_gr3(const char *path, const mw_mesh_file *file, mw_job *job, mw_error *error)
{
    return mw__write_file(path, file, gr3_write, job, error);
}
