#include "cli/remap/remap_cells.h"
#include "cli/frame/files.h"
#include "cli/frame/message.h"
#include "cli/frame/progress.h"
#include "cli/gdal/gdal_crs.h"
#include "cli/gdal/gdal_raster.h"
#include "cli/gdal/mesh_crs.h"
#include "cli/input/mesh_seam.h"
#include "src/base/posix.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

void remap_cells_release(remap_cells *c)
{
    mw_locator_destroy(c->locator);
    mw_mesh_destroy(c->mesh);
    free(c->face);
    free(c->crs);
}

/* Formats of rasters; .nc and .grd are meshes. */
static bool cells_are_pixels(const char *path)
{
    static const char *const endings[] = {".tif", ".tiff", ".vrt", ".asc", ".img", ".bil",
                                          ".flt", ".dem",  ".hgt", ".jp2", ".sdat"};
    const char *ending = strrchr(path, '.');
    for (size_t i = 0; ending && i < sizeof endings / sizeof *endings; i++)
        if (strcasecmp(ending, endings[i]) == 0) return true;
    return false;
}

static int cells_read_pixels(remap_cells *c, const char *path, const char *crs, bool quiet)
{
    gdal_raster_form form;
    char *of_file = NULL;
    int end = gdal_raster_describe(path, &form, &of_file);
    if (end == 0) end = mesh_crs_settle(path, crs, of_file, quiet, &c->crs);
    free(of_file);
    if (end) return end;
    c->pixels = (mw_remap_pixels){.west = form.corner[0],
                                  .north = form.corner[1],
                                  .width = form.size[0],
                                  .height = form.size[1],
                                  .columns = form.columns,
                                  .rows = form.rows};
    return 0;
}

static int cells_read_mesh(remap_cells *c, const char *path, const char *crs,
                           const common_settings *common)
{
    mw_mesh_file file;
    mw_error error;
    int end = files_read_mesh(path, &file);
    if (end) return end;
    end = mesh_crs_settle(path, crs, file.crs, common->quiet, &c->crs);
    mw_seam_pieces pieces = {0};
    mw_arrays arrays = mw_mesh_file_arrays(&file);
    c->cut = end == 0 && c->crs && crs_is_lonlat(c->crs) && mw_seam_crosses(&arrays);
    if (c->cut) end = mesh_seam_cut(&file, path, &pieces);
    c->west = pieces.west;
    arrays = mw_mesh_file_arrays(&file);
    const mw_mesh_options options = {.threads = common->threads, .progress = progress_of_call()};
    const mw_locator_options fill = {.threads = common->threads, .progress = progress_of_call()};
    progress_phase("preparing", path);
    if (end == 0 && (mw_mesh_create(&arrays, &options, &c->mesh, &error) != MW_OK ||
                     mw_locator_create(c->mesh, &fill, &c->locator, &error) != MW_OK)) {
        end = fail_mesh(path, &error);
        if (end == END_INPUT && c->cut)
            mesh_seam_explain(path, &pieces);
        else if (end == END_INPUT)
            complain("'meshwalk check %s' lists every defect, 'meshwalk view' shows it", path);
    }
    c->face = file.faces;
    c->face_count = file.face_count;
    file.faces = NULL;
    mw_mesh_file_release(&file);
    mw_seam_pieces_release(&pieces);
    return end;
}

int remap_cells_read(remap_cells *c, const char *path, const char *crs,
                     const common_settings *common, bool grid)
{
    *c = (remap_cells){0};
    return grid && cells_are_pixels(path) ? cells_read_pixels(c, path, crs, common->quiet)
                                          : cells_read_mesh(c, path, crs, common);
}

mw_remap_mesh remap_cells_mesh(const remap_cells *c)
{
    return (mw_remap_mesh){c->locator, c->face, c->face ? c->face_count : 0};
}

/* --- places ----------------------------------------------------------------------------------- */

static double *places_of_pixels(const mw_remap_pixels *p)
{
    double *place = malloc(2 * (size_t)p->columns * p->rows * sizeof *place + 1), *at = place;
    for (uint32_t r = 0; r < p->rows && place; r++)
        for (uint32_t k = 0; k < p->columns; k++) {
            *at++ = p->west + (k + 0.5) * p->width;
            *at++ = p->north - (r + 0.5) * p->height;
        }
    return place;
}

static double *places_of_vertices(const mw_mesh *mesh)
{
    const uint32_t n = mw_mesh_vertex_count(mesh);
    double *place = malloc(2 * (size_t)n * sizeof *place + 1);
    for (uint32_t v = 0; v < n && place; v++) mw_mesh_vertex(mesh, v, place + 2 * (size_t)v);
    return place;
}

/* Add whole turns to the longitudes of a piece of a cell that was cut. */
static void cell_bring_near(double p[3][2], double longitude)
{
    const double turns = 360 * round((p[0][0] - longitude) / 360);
    for (int k = 0; k < 3; k++) p[k][0] -= turns;
}

/* Centroids; of a cell without an area, a vertex. */
static double *places_of_cells(const remap_cells *c)
{
    const uint32_t n = mw_mesh_triangle_count(c->mesh);
    const size_t cells = c->face ? c->face_count : n;
    double *place = calloc(2 * cells + 1, sizeof *place), *area = calloc(cells + 1, sizeof *area);
    for (uint32_t t = 0; t < n && place && area; t++) {
        uint32_t v[3];
        double p[3][2], *at = place + 2 * (size_t)(c->face ? c->face[t] : t),
                        *sum = &area[c->face ? c->face[t] : t];
        mw_mesh_triangle(c->mesh, t, v);
        for (int k = 0; k < 3; k++) mw_mesh_vertex(c->mesh, v[k], p[k]);
        if (c->cut && *sum > 0) cell_bring_near(p, at[0]);
        double size = fabs(mw_orient2d(p[0], p[1], p[2]));
        *sum += size;
        for (int i = 0; i < 2; i++) {
            double middle = (p[0][i] + p[1][i] + p[2][i]) / 3;
            if (*sum > 0)
                at[i] += (middle - at[i]) * (size / *sum);
            else
                at[i] = p[0][i];
        }
    }
    for (size_t i = 0; i < cells && place && c->cut; i++)
        place[2 * i] -= 360 * floor((place[2 * i] - c->west) / 360);
    free(area);
    if (!area) {
        free(place);
        place = NULL;
    }
    return place;
}

double *remap_cells_places(const remap_cells *c, bool vertices)
{
    if (!c->mesh) return places_of_pixels(&c->pixels);
    return vertices ? places_of_vertices(c->mesh) : places_of_cells(c);
}
