/* What the writers of meshes share. */
#include "io/mesh/mesh_writers.h"

uint64_t mw__expected_bytes(const mw_mesh_file *file)
{
    enum { A_NUMBER = 19, A_TRIANGLE = 27 };
    return (3 + (uint64_t)file->field_count) * A_NUMBER * file->point_count +
           A_TRIANGLE * file->triangle_count;
}

mw_status mw__write_file(const char *path, const mw_mesh_file *file, mw_write_body *body,
                         mw_job *job, mw_error *error)
{
    mw_output *output;
    mw_status status = mw_output_open(path, &output, error);
    if (status) return status;
    mw__output_watch(output, job, mw__expected_bytes(file));
    body(output, file);
    return mw_output_close(output, 1, error);
}

void mw__output_points(mw_output *output, const mw_mesh_file *file)
{
    for (size_t v = 0; v < file->point_count && !mw_output_failed(output); v++)
        for (size_t k = 0; k < 3; k++) {
            mw_output_double(output, file->points[3 * v + k]);
            mw__output_char(output, k < 2 ? ' ' : '\n');
        }
}

void mw__output_triangles(mw_output *output, const mw_mesh_file *file)
{
    for (size_t t = 0; t < file->triangle_count && !mw_output_failed(output); t++) {
        mw__output_char(output, '3');
        for (size_t k = 0; k < 3; k++) {
            mw__output_char(output, ' ');
            mw__output_integer(output, file->triangles[3 * t + k]);
        }
        mw__output_char(output, '\n');
    }
}

static char word_char(char c)
{
    bool letter = (c | 0x20) >= 'a' && (c | 0x20) <= 'z';
    return (c >= '0' && c <= '9') || letter || (unsigned char)c >= 0x80 ? c : '_';
}

static bool words_equal(const char *a, const char *b)
{
    while (*a && *b && word_char(*a) == word_char(*b)) a++, b++;
    return !*a && !*b;
}

void mw__output_field_name(mw_output *output, char *const *names, size_t field)
{
    const char *name = names[field];
    bool taken =
        !*name || words_equal(name, "x") || words_equal(name, "y") || words_equal(name, "z");
    for (size_t f = 0; f < field && !taken; f++) taken = words_equal(name, names[f]);
    for (const char *p = name; *p; p++) mw__output_char(output, word_char(*p));
    if (taken) {
        mw__output_char(output, '_');
        mw__output_integer(output, field + 1);
    }
}
