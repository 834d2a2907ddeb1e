#include "cli/raster/raster_mean.h"
#include "cli/frame/message.h"
#include "cli/frame/progress.h"

#include <math.h>
#include <stdlib.h>

/* So many pixels are computed at a time, or one row: some 100 bytes each. Each strip looks at all
 * triangles. */
#define MEAN_PIXELS ((uint32_t)1 << 20)

/* What a strip is made with. */
typedef struct mean_strip {
    raster_mean *mean;
    mw_remap remap[2]; /* of values of vertices, of those of cells: made when a band wants one */
    mw_remap_pixels pixels;
    uint32_t row;
    size_t count;                /* of its pixels */
    double *derived[BAND_COUNT]; /* a value for each triangle; of aspects the sine */
    double *cosine;              /* of aspects */
    double *values, *other;      /* of each pixel */
    void *stored;                /* the same, as the raster has them */
    uint32_t *faces;             /* of each triangle; NULL: triangle i is face i */
    uint64_t found[2];
} mean_strip;

/* --- values of triangles ---------------------------------------------------------------------- */

/* The value of a triangle, and for aspects its cosine. */
static double mean_property(const raster_mean *m, raster_band band, uint32_t t, double *cosine)
{
    double value = raster_bands_property(m->mesh, band, t);
    if (band != BAND_ASPECT) return value;
    bool flat = isnan(value) && !isnan(raster_bands_property(m->mesh, BAND_SLOPE, t));
    double angle = value * (acos(-1) / 180);
    *cosine = flat ? 0 : cos(angle);
    return flat ? 0 : sin(angle);
}

static bool mean_derive(mean_strip *s)
{
    const raster_mean *m = s->mean;
    const raster_bands *b = m->bands;
    uint32_t count = mw_mesh_triangle_count(m->mesh->mesh);
    if (m->series && (m->mesh->faces || m->mesh->numbers)) {
        s->faces = malloc(((size_t)count + 1) * sizeof *s->faces);
        for (uint32_t t = 0; s->faces && t < count; t++) s->faces[t] = raster_mesh_face(m->mesh, t);
        if (!s->faces) return false;
    }
    s->cosine = malloc(((size_t)count + 1) * sizeof *s->cosine);
    for (uint32_t k = 0; k < b->count && s->cosine; k++) {
        if (m->series || b->bands[k] == BAND_VALUE) continue;
        s->derived[k] = malloc(((size_t)count + 1) * sizeof *s->cosine);
        for (uint32_t t = 0; t < count && s->derived[k]; t++)
            s->derived[k][t] = mean_property(m, b->bands[k], t, &s->cosine[t]);
        if (!s->derived[k]) return false;
    }
    return s->cosine != NULL;
}

/* --- one strip -------------------------------------------------------------------------------- */

/* The weights of the strip. */
static int mean_weigh(mean_strip *s, bool of_vertices, const mw_remap **out)
{
    mw_error error;
    const raster_mean *m = s->mean;
    mw_remap *remap = &s->remap[of_vertices ? 0 : 1];
    const mw_remap_mesh source = {.locator = m->mesh->locator,
                                  .face = of_vertices ? NULL : s->faces,
                                  .face_count = s->faces ? m->mesh->face_count : 0};
    const mw_remap_options options = {
        .threads = m->bands->threads, .vertices = of_vertices, .degrees = m->degrees, .covered = 1};
    *out = remap;
    if (remap->weights || mw_remap_to_pixels(&source, &s->pixels, &options, remap, &error) == MW_OK)
        return 0;
    return fail_query(&error);
}

static int mean_apply(const mean_strip *s, const mw_remap *remap, const double *values,
                      double *result)
{
    mw_error error;
    const mw_value_table table = {.values = values, .type = MW_FLOAT64, .count = 1};
    const mw_operator_apply_options apply = {.threads = s->mean->bands->threads};
    return mw_operator_apply(remap->weights, &table, &apply, result, &error) == MW_OK
               ? 0
               : fail_query(&error);
}

/* Means of unit vectors become directions. */
static void mean_directions(const mean_strip *s)
{
    for (size_t i = 0; i < s->count; i++) {
        double sine = s->values[i], cosine = s->other[i];
        double degrees = atan2(sine, cosine) * (180 / acos(-1));
        s->values[i] = sine == 0 && cosine == 0 ? (double)NAN
                       : degrees < 0            ? degrees + 360
                                                : degrees;
    }
}

/* Means, whose rows have no entries where the mesh covers nothing. */
static void mean_sum(raster_mean *m, const mw_remap *remap, const double *values, size_t count)
{
    for (size_t i = 0; i < count; i++) {
        double area = remap->target_fraction[i] * remap->target_area[i];
        if (isnan(values[i])) continue;
        m->area += area;
        m->integral += values[i] * area;
    }
}

static int mean_of_band(mean_strip *s, uint32_t band)
{
    raster_mean *m = s->mean;
    const double *values = m->mesh->values;
    const mw_remap *remap;
    bool cells = false, aspect = false;
    int end = 0;
    if (m->series) {
        end = raster_series_read(m->series, m->mesh, band, &cells);
        if (cells) values = m->mesh->cells;
    } else if (s->derived[band]) {
        cells = true;
        aspect = m->bands->bands[band] == BAND_ASPECT;
        values = s->derived[band];
    }
    if (end == 0) end = mean_weigh(s, !cells, &remap);
    if (end == 0) end = mean_apply(s, remap, values, s->values);
    if (end == 0 && aspect) end = mean_apply(s, remap, s->cosine, s->other);
    if (end == 0 && aspect) mean_directions(s);
    if (end == 0 && band == 0) mean_sum(m, remap, s->values, s->count);
    return end;
}

static int mean_write_strip(mean_strip *s, uint32_t bands, gdal_raster *raster)
{
    int end = 0;
    for (uint32_t band = 0; end == 0 && band < bands; band++) {
        uint64_t found[2] = {0};
        end = mean_of_band(s, band);
        if (end) break;
        raster_bands_store(s->mean->bands, s->values, s->count, s->stored, found);
        if (band == 0) s->found[0] += found[0];
        s->found[1] += found[1];
        end = gdal_raster_write(raster, band, s->row, s->pixels.rows, s->stored);
    }
    for (int i = 0; i < 2; i++) {
        mw_remap_release(&s->remap[i]);
        s->remap[i] = (mw_remap){0};
    }
    return end;
}

int raster_mean_write(raster_mean *m, gdal_raster *raster)
{
    raster_bands *b = m->bands;
    const raster_grid *g = b->grid;
    mean_strip s = {.mean = m};
    uint32_t step = g->columns < MEAN_PIXELS ? MEAN_PIXELS / g->columns : 1,
             bands = m->series ? m->series->bands : b->count;
    size_t most = (size_t)step * g->columns;
    s.values = malloc(most * sizeof *s.values);
    s.other = malloc(most * sizeof *s.other);
    s.stored = malloc(most * sizeof *s.values);
    int end = s.values && s.other && s.stored && mean_derive(&s) ? 0 : fail_memory();
    if (end == 0 && m->series) end = raster_series_begin(m->mesh);
    for (uint32_t row = 0; end == 0 && row < g->rows; row += step) {
        uint32_t rows = g->rows - row < step ? g->rows - row : step;
        s.row = row;
        s.count = (size_t)rows * g->columns;
        s.pixels = (mw_remap_pixels){.west = g->west,
                                     .north = g->north - row * g->height,
                                     .width = g->width,
                                     .height = g->height,
                                     .columns = g->columns,
                                     .rows = rows};
        end = mean_write_strip(&s, bands, raster);
        progress_points((uint64_t)(row + rows) * g->columns, (double)(row + rows) / g->rows);
    }
    if (m->series) raster_series_end(m->mesh);
    b->filled = s.found[0];
    b->mistakable = s.found[1];
    for (int k = 0; k < BAND_COUNT; k++) free(s.derived[k]);
    free(s.faces);
    free(s.cosine);
    free(s.values);
    free(s.other);
    free(s.stored);
    return end;
}
