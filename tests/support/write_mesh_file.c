/* write_mesh_file.c - writes small mesh files, reads them, compares. */
#include "support/write_mesh_file.h"
#include "io/text/byte_order.h"

#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include <stdio.h>
#include <string.h>
#include <unistd.h>

const double square_points[12] = {0, 0, 0, 1, 0, 0, 1, 1, 0.5, 0, 1, 0};
const uint32_t square_triangles[6] = {0, 1, 2, 0, 2, 3};

bytes mesh_file_stl(char *memory, const char *header, uint32_t count, const float (*corners)[9],
                    size_t n)
{
    memset(memory, 0, 84);
    memcpy(memory, header, strlen(header));
    mw__put_bytes((unsigned char *)memory + 80, 4, count);
    for (size_t t = 0; t < n; t++) {
        char *facet = memory + 84 + 50 * t;
        memset(facet, 0, 50);
        for (size_t k = 0; k < 9; k++) {
            uint32_t bits;
            memcpy(&bits, &corners[t][k], sizeof bits);
            mw__put_bytes((unsigned char *)facet + 12 + 4 * k, 4, bits);
        }
    }
    return (bytes){memory, 84 + 50 * n};
}

mw_mesh_file mesh_file_read(const char *name)
{
    mw_mesh_file file;
    mw_error error;
    if (mw_read_mesh(name, NULL, &file, &error) != MW_OK) fail_msg("%s", error.message);
    return file;
}

mw_mesh_file mesh_file_read_bytes(const char *name, bytes contents)
{
    char packed[64];
    snprintf(packed, sizeof packed, "%s.gz", name);
    files_write_gzip(packed, contents);
    mw_mesh_file file = mesh_file_read(packed);
    mw_mesh_file_release(&file);
    unlink(packed);
    files_write(name, contents);
    file = mesh_file_read(name);
    unlink(name);
    return file;
}

mw_mesh_file mesh_file_read_text(const char *name, const char *text)
{
    return mesh_file_read_bytes(name, (bytes){text, strlen(text)});
}

void mesh_file_expect_triangles(const mw_mesh_file *file, size_t points, size_t triangles,
                                const uint32_t *wanted)
{
    assert_int_equal(file->point_count, points);
    assert_int_equal(file->triangle_count, triangles);
    if (triangles > 0) assert_memory_equal(file->triangles, wanted, 3 * triangles * sizeof *wanted);
}

void mesh_file_expect_points(const mw_mesh_file *file, const double *wanted)
{
    for (size_t i = 0; i < 3 * file->point_count; i++)
        if (file->points[i] != wanted[i])
            fail_msg("coordinate %zu is %g, not %g", i, file->points[i], wanted[i]);
}
