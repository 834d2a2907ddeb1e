#include "cli/raster/raster_mesh.h"
#include "cli/frame/files.h"
#include "cli/frame/message.h"
#include "cli/frame/progress.h"
#include "cli/gdal/gdal_crs.h"
#include "cli/gdal/mesh_crs.h"
#include "cli/input/mesh_seam.h"
#include "cli/output/border_peel.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

void raster_mesh_release(raster_mesh *m)
{
    mw_locator_destroy(m->own_locator);
    if (!m->map) mw_mesh_destroy(m->mesh);
    mw_prepared_close(m->map);
    mw_operator_destroy(m->seam);
    free(m->values);
    free(m->own);
    free(m->numbers);
    free(m->faces);
    free(m->crs);
    *m = (raster_mesh){0};
}

static int raster_mesh_create(raster_mesh *m, const char *path, const mw_mesh_file *file,
                              const raster_mesh_settings *s)
{
    mw_error error;
    mw_arrays arrays = mw_mesh_file_arrays(file);
    mw_mesh_options options = {.threads = s->common->threads, .progress = progress_of_call()};
    mw_mesh_destroy(m->mesh);
    m->mesh = NULL;
    return mw_mesh_create(&arrays, &options, &m->mesh, &error) == MW_OK ? 0
                                                                        : fail_mesh(path, &error);
}

/* The triangles that are left in the file are a part of those that it had, in their order. */
static int raster_mesh_number(raster_mesh *m, const mw_mesh_file *file, const uint32_t *before)
{
    m->numbers = malloc((file->triangle_count + 1) * sizeof *m->numbers);
    if (!m->numbers) return fail_memory();
    uint32_t n = 0;
    for (size_t t = 0; t < file->triangle_count; t++, n++) {
        while (memcmp(before + 3 * (size_t)n, file->triangles + 3 * t, 3 * sizeof *before) != 0)
            n++;
        m->numbers[t] = n;
    }
    return 0;
}

static int raster_mesh_peel(raster_mesh *m, const char *path, mw_mesh_file *file,
                            const raster_mesh_settings *s)
{
    const mw_constrained_edges none = {0};
    border_peel peel;
    size_t bytes = 3 * file->triangle_count * sizeof(uint32_t);
    uint32_t *before = malloc(bytes + 1);
    if (!before) return fail_memory();
    if (bytes > 0) memcpy(before, file->triangles, bytes);
    int end = border_peel_off(m->mesh, s->max_edge, &none, file, &peel);
    m->peeled = end ? 0 : peel.triangles;
    if (m->peeled > 0) end = raster_mesh_number(m, file, before);
    free(before);
    if (end || m->peeled == 0) return end;
    if (file->triangle_count > 0) return raster_mesh_create(m, path, file, s);
    complain("%s: no triangle is left: all have longer edges than --max-edge", path);
    return END_INPUT;
}

static int raster_mesh_locate(raster_mesh *m, const char *path, const raster_mesh_settings *s)
{
    mw_error error;
    mw_locator_options options = {
        .border = s->border, .threads = s->common->threads, .progress = progress_of_call()};
    const mw_status status = mw_locator_create(m->mesh, &options, &m->own_locator, &error);
    m->locator = m->own_locator;
    if (status == MW_OK) return 0;
    int end = fail_mesh(path, &error);
    if (end == END_INPUT && m->seam)
        mesh_seam_explain(path, &(mw_seam_pieces){.west = m->west});
    else if (end == END_INPUT)
        complain("'meshwalk check %s' lists every defect, 'meshwalk view' shows it", path);
    return end;
}

/* Vertices and triangles are taken from the mesh so many at a time. */
enum { BLOCK = 256 };

static uint32_t block_count(uint32_t first, uint32_t end)
{
    return end - first < BLOCK ? end - first : BLOCK;
}

static void raster_mesh_mark_used(const raster_mesh *m, uint8_t *used)
{
    const uint32_t n = mw_mesh_triangle_count(m->mesh);
    uint32_t corners[3 * BLOCK];
    for (uint32_t t = 0; t < n; t += BLOCK) {
        const uint32_t count = block_count(t, n);
        mw_mesh_stored_triangles(m->mesh, t, count, corners, NULL);
        for (uint32_t i = 0; i < 3 * count; i++) used[corners[i]] = 1;
    }
}

/* The extent of the vertices that triangles have, and their number. */
static int raster_mesh_measure(raster_mesh *m)
{
    const uint32_t n = mw_mesh_vertex_count(m->mesh);
    double points[2 * BLOCK];
    uint8_t *used = calloc((size_t)n + 1, 1);
    if (!used) return fail_memory();
    raster_mesh_mark_used(m, used);
    for (int k = 0; k < 4; k++) m->extent[k] = k < 2 ? (double)INFINITY : -(double)INFINITY;
    for (uint32_t v = 0; v < n; v++) {
        const double *p = points + 2 * (size_t)(v % BLOCK);
        if (v % BLOCK == 0) mw_mesh_stored_vertices(m->mesh, v, block_count(v, n), points, NULL);
        if (!used[v]) continue;
        for (int k = 0; k < 2; k++) {
            m->extent[k] = p[k] < m->extent[k] ? p[k] : m->extent[k];
            m->extent[k + 2] = p[k] > m->extent[k + 2] ? p[k] : m->extent[k + 2];
        }
        m->vertices++;
    }
    free(used);
    return 0;
}

double raster_mesh_area(const raster_mesh *m)
{
    uint32_t v[3];
    double p[3][2], area = 0;
    for (uint32_t t = 0; t < mw_mesh_triangle_count(m->mesh); t++) {
        mw_mesh_triangle(m->mesh, t, v);
        for (int k = 0; k < 3; k++) mw_mesh_vertex(m->mesh, v[k], p[k]);
        area += fabs(mw_orient2d(p[0], p[1], p[2])) / 2;
    }
    return area;
}

/* --- the seam of longitudes ------------------------------------------------------------------- */

/* The values at the vertices of the file, or room for them. */
static int raster_mesh_keep_own(raster_mesh *m, const char *path, const mw_mesh_file *file,
                                const raster_mesh_settings *s)
{
    if (!s->over_time) return mesh_field_copy(path, file, &s->field, &m->own);
    m->own = malloc(file->point_count * sizeof *m->own + 1);
    return m->own ? 0 : fail_memory();
}

static int raster_mesh_cut(raster_mesh *m, const char *path, mw_mesh_file *file,
                           const raster_mesh_settings *s)
{
    const mw_arrays arrays = mw_mesh_file_arrays(file);
    mw_seam_pieces pieces = {0};
    m->file_vertices = file->point_count;
    if (!s->cut || !m->crs || !crs_is_lonlat(m->crs) || !mw_seam_crosses(&arrays)) return 0;
    if (s->max_edge > 0) {
        complain("%s: crosses the meridian of 180 degrees, or a pole: --max-edge cannot be used "
                 "there with --mean",
                 path);
        return END_INPUT;
    }
    int end = raster_mesh_keep_own(m, path, file, s);
    if (end == 0) end = mesh_seam_cut(file, path, &pieces);
    m->seam = pieces.values;
    m->west = pieces.west;
    pieces.values = NULL;
    mw_seam_pieces_release(&pieces);
    return end;
}

int raster_mesh_spread(raster_mesh *m)
{
    mw_error error;
    const mw_value_table table = {.values = m->own, .type = MW_FLOAT64, .count = 1};
    const mw_operator_apply_options options = {.threads = 1};
    if (!m->seam || mw_operator_apply(m->seam, &table, &options, m->values, &error) == MW_OK)
        return 0;
    return fail_query(&error);
}

/* --- values ----------------------------------------------------------------------------------- */

/* Room for values that come later. */
static int raster_mesh_leave_values(raster_mesh *m, const mw_mesh_file *file)
{
    m->face_count = file->faces ? file->face_count : file->triangle_count;
    m->values = malloc((size_t)mw_mesh_vertex_count(m->mesh) * sizeof *m->values + 1);
    if (file->faces) m->faces = malloc(file->triangle_count * sizeof *m->faces + 1);
    if (!m->values || (file->faces && !m->faces)) return fail_memory();
    if (file->faces) memcpy(m->faces, file->faces, file->triangle_count * sizeof *m->faces);
    return 0;
}

static int raster_mesh_take_values(raster_mesh *m, const char *path, const mw_mesh_file *file,
                                   const raster_mesh_settings *s)
{
    if (!m->seam) return mesh_field_copy(path, file, &s->field, &m->values);
    m->values = malloc((size_t)mw_mesh_vertex_count(m->mesh) * sizeof *m->values + 1);
    return m->values ? raster_mesh_spread(m) : fail_memory();
}

static int raster_mesh_fill_values(raster_mesh *m, const char *path, const mw_mesh_file *file,
                                   const raster_mesh_settings *s)
{
    return s->over_time ? raster_mesh_leave_values(m, file)
                        : raster_mesh_take_values(m, path, file, s);
}

/* --- prepared files --------------------------------------------------------------------------- */

/* Is the mesh, as it was prepared, the one that is asked for? */
static bool raster_mesh_takes_map(const char *path, const raster_mesh_settings *s)
{
    return s->max_edge == 0 && !s->cut && mw_prepared_known(path);
}

/* Map a prepared file. `map` stays NULL if its locator lacks the border that is needed. */
static int raster_mesh_map(raster_mesh *m, const char *path, const raster_mesh_settings *s)
{
    mw_error error;
    mw_prepared_info info;
    const mw_map_options options = {.threads = s->common->threads, .progress = progress_of_call()};
    progress_phase("checking", path);
    if (mw_mesh_map(path, &options, &m->map, &error) != MW_OK) return fail_reading(&error);
    mw_prepared_describe(m->map, &info);
    if (!s->border || info.border) return 0;
    mw_prepared_close(m->map);
    m->map = NULL;
    return 0;
}

static int raster_mesh_attach_map(raster_mesh *m, const char *path, const raster_mesh_settings *s)
{
    const mw_mesh_file *values = mw_prepared_values(m->map);
    m->mesh = mw_prepared_mesh(m->map);
    m->locator = mw_prepared_locator(m->map);
    m->file_vertices = values->point_count;
    int end = mesh_crs_settle(path, s->crs, values->crs, s->common->quiet, &m->crs);
    if (end == 0) end = raster_mesh_fill_values(m, path, values, s);
    return end ? end : raster_mesh_measure(m);
}

/* --- all of it -------------------------------------------------------------------------------- */

static int raster_mesh_read_file(raster_mesh *m, const char *path, const raster_mesh_settings *s)
{
    mw_mesh_file file;
    int end = files_read_mesh(path, &file);
    if (end) return end;
    end = mesh_crs_settle(path, s->crs, file.crs, s->common->quiet, &m->crs);
    progress_phase("preparing", path);
    if (end == 0) end = raster_mesh_cut(m, path, &file, s);
    if (end == 0) end = raster_mesh_create(m, path, &file, s);
    if (end == 0) end = raster_mesh_fill_values(m, path, &file, s);
    if (end == 0 && s->max_edge > 0) end = raster_mesh_peel(m, path, &file, s);
    mw_mesh_file_release(&file);
    if (end == 0) end = raster_mesh_measure(m);
    return end ? end : raster_mesh_locate(m, path, s);
}

int raster_mesh_read(raster_mesh *m, const char *path, const raster_mesh_settings *s)
{
    *m = (raster_mesh){0};
    int end = raster_mesh_takes_map(path, s) ? raster_mesh_map(m, path, s) : 0;
    if (end) return end;
    return m->map ? raster_mesh_attach_map(m, path, s) : raster_mesh_read_file(m, path, s);
}
