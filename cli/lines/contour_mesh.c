#include "cli/lines/contour_mesh.h"
#include "cli/frame/message.h"
#include "cli/lines/contour_bands.h"

#include <math.h>
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>

/* The arrays of the mesh that is made. */
typedef struct contour_part {
    double *points, *values;
    uint32_t *triangles;
    uint32_t *number; /* [vertex of the file]: its number here, or MW_NONE */
    size_t point_count, triangle_count;
} contour_part;

static void part_release(contour_part *p)
{
    free(p->points);
    free(p->triangles);
    free(p->number);
}

/* Triangles that are looked at together, and how far ahead vertices are prefetched: those of
 * neighbours may lie anywhere in the file. */
enum { BLOCK = 2048, AHEAD = 32 };

/* Which of `count` triangles from t on does a level cross? Written down without branches, which
 * would be guessed wrong. Returns how many. */
static size_t part_find(const mw_mesh_file *file, const uint32_t *band, size_t t, size_t count,
                        uint32_t found[BLOCK])
{
    const uint32_t *v = file->triangles + 3 * t;
    size_t n = 0;
    for (size_t i = 0; i < count; i++, v += 3) {
        for (int k = 0; i + AHEAD < count && k < 3; k++)
            __builtin_prefetch(band + v[3 * AHEAD + k]);
        const contour_bands b = contour_bands_of_corners(band, v);
        found[n] = (uint32_t)(t + i);
        n += b.low < b.high;
    }
    return n;
}

static void part_add(contour_part *p, const uint32_t v[3])
{
    uint32_t *to = p->triangles + 3 * p->triangle_count++;
    for (int k = 0; k < 3; k++) {
        if (p->number[v[k]] == MW_NONE) p->number[v[k]] = (uint32_t)p->point_count++;
        to[k] = p->number[v[k]];
    }
}

/* Number the triangles and vertices that are wanted. */
static bool part_choose(contour_part *p, const mw_mesh_file *file, const uint32_t *band)
{
    uint32_t found[BLOCK];
    p->triangles = malloc(3 * file->triangle_count * sizeof *p->triangles + 1);
    p->number = malloc(file->point_count * sizeof *p->number + 1);
    if (!p->triangles || !p->number) return false;
    for (size_t v = 0; v < file->point_count; v++) p->number[v] = MW_NONE;
    for (size_t t = 0; t < file->triangle_count; t += BLOCK) {
        const size_t left = file->triangle_count - t;
        const size_t n = part_find(file, band, t, left < BLOCK ? left : BLOCK, found);
        for (size_t i = 0; i < n; i++) part_add(p, file->triangles + 3 * (size_t)found[i]);
    }
    return true;
}

static bool part_copy_vertices(contour_part *p, const mw_mesh_file *file, const double *values)
{
    p->points = malloc(2 * p->point_count * sizeof *p->points + 1);
    p->values = malloc(p->point_count * sizeof *p->values + 1);
    if (!p->points || !p->values) return false;
    for (size_t v = 0; v < file->point_count; v++) {
        const size_t to = p->number[v];
        if (to == MW_NONE) continue;
        memcpy(p->points + 2 * to, file->points + 3 * v, 2 * sizeof *p->points);
        p->values[to] = values[v];
    }
    return true;
}

static bool part_make(contour_part *p, const mw_mesh_file *file, const double *values,
                      const double *levels, size_t level_count)
{
    uint32_t *band = contour_bands_of_values(values, file->point_count, levels, level_count);
    bool made = band && part_choose(p, file, band) && part_copy_vertices(p, file, values);
    free(band);
    return made;
}

/* --- the mesh --------------------------------------------------------------------------------- */

static bool mesh_is_plain(const mw_mesh_file *file)
{
    bool finite = true;
    for (size_t v = 0; v < file->point_count; v++)
        finite &= isfinite(file->points[3 * v]) && isfinite(file->points[3 * v + 1]);
    return finite && !file->repeat;
}

static int mesh_make_whole(contour_mesh *made, const char *path, const mw_mesh_file *file,
                           const double *values, const mw_mesh_options *options)
{
    mw_error error;
    const mw_arrays arrays = mw_mesh_file_arrays(file);
    const size_t size = file->point_count * sizeof *values;
    if (mw_mesh_create(&arrays, options, &made->mesh, &error) != MW_OK)
        return fail_mesh(path, &error);
    made->values = malloc(size + 1);
    if (!made->values) return fail_memory();
    memcpy(made->values, values, size);
    return 0;
}

int contour_mesh_create(contour_mesh *made, const char *path, const mw_mesh_file *file,
                        const double *values, const double *levels, size_t level_count,
                        const mw_mesh_options *options)
{
    contour_part part = {0};
    mw_error error;
    *made = (contour_mesh){0};
    if (!mesh_is_plain(file)) return mesh_make_whole(made, path, file, values, options);
    int end = part_make(&part, file, values, levels, level_count) ? 0 : fail_memory();
    const mw_arrays arrays = {.points = part.points,
                              .point_count = part.point_count,
                              .triangles = part.triangles,
                              .triangle_count = part.triangle_count,
                              .integer_type = MW_UINT32};
    made->values = part.values;
    mw_status status = end ? MW_OK : mw_mesh_create(&arrays, options, &made->mesh, &error);
    part_release(&part);
    if (status == MW_OK) return end;
    /* Its numbers mean nothing to the user. */
    free(made->values);
    made->values = NULL;
    return mesh_make_whole(made, path, file, values, options);
}

void contour_mesh_release(contour_mesh *made)
{
    mw_mesh_destroy(made->mesh);
    free(made->values);
    *made = (contour_mesh){0};
}
