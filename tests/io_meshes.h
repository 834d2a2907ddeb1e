/* io_meshes.h - small mesh files for the tests of reading: a square of two triangles in several formats. */
#ifndef MW_TEST_IO_MESHES_H
#define MW_TEST_IO_MESHES_H

#include "io_files.h"

#define SQUARE_BODY "0 0 0\n1 0 0\n1 1 .5\n0 1 0\n"
#define SQUARE_V "v 0 0 0\nv 1 0 0\nv 1 1 .5\nv 0 1 0\n"
#define FACET(a, b, c)                                                                                                 \
    "facet normal 0 0 1\n outer loop\n  vertex " a "\n  vertex " b "\n  vertex " c "\n endloop\nendfacet\n"

static inline bytes binary_stl(char *room, const char *header, uint32_t count, const float (*corners)[9], size_t n)
{
    memset(room, 0, 84);
    memcpy(room, header, strlen(header));
    memcpy(room + 80, &count, 4);
    for (size_t t = 0; t < n; t++) {
        char *facet = room + 84 + 50 * t;
        memset(facet, 0, 50);
        memcpy(facet + 12, corners[t], 36);
    }
    return (bytes){room, 84 + 50 * n};
}

static inline mw_mesh_file read_file(const char *name)
{
    mw_mesh_file file;
    mw_error error;
    if (mw_read_mesh(name, &file, &error) != MW_OK) fail_msg("%s", error.message);
    return file;
}

/* Read contents under a name, plain and as gzip. */
static inline mw_mesh_file read_bytes(const char *name, bytes contents)
{
    char packed[64];
    snprintf(packed, sizeof packed, "%s.gz", name);
    files_write_gzip(packed, contents);
    mw_mesh_file file = read_file(packed);
    mw_mesh_file_release(&file);
    unlink(packed);
    files_write(name, contents);
    file = read_file(name);
    unlink(name);
    return file;
}

static inline mw_mesh_file read_text(const char *name, const char *text)
{
    return read_bytes(name, (bytes){text, strlen(text)});
}

static inline void expect_triangles(const mw_mesh_file *file, size_t points, size_t triangles, const uint32_t *wanted)
{
    assert_int_equal(file->point_count, points);
    assert_int_equal(file->triangle_count, triangles);
    if (triangles > 0) assert_memory_equal(file->triangles, wanted, 3 * triangles * sizeof *wanted);
}

static inline void expect_points(const mw_mesh_file *file, const double *wanted)
{
    for (size_t i = 0; i < 3 * file->point_count; i++)
        if (file->points[i] != wanted[i]) fail_msg("coordinate %zu is %g, not %g", i, file->points[i], wanted[i]);
}

static const double square[] = {0, 0, 0, 1, 0, 0, 1, 1, 0.5, 0, 1, 0};
static const uint32_t halves[] = {0, 1, 2, 0, 2, 3};

#endif
