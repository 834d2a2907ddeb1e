#include "cli/raster/raster_bands.h"
#include "cli/frame/message.h"
#include "cli/frame/progress.h"
#include "src/base/threads.h"

#include <math.h>
#include <stdatomic.h>
#include <stdlib.h>
#include <string.h>

/* Each type of pixels has a loop of its own. */
#define RASTER_INLINE inline __attribute__((always_inline))

static const char *const names[BAND_COUNT] = {"value",  "cell",      "slope",
                                              "aspect", "hillshade", "triangle"};

const char *raster_band_name(raster_band band)
{
    return names[band];
}

uint32_t raster_bands_parse(const char *list, raster_band bands[BAND_COUNT])
{
    uint32_t count = 0;
    for (const char *item = list;; item++) {
        size_t length = strcspn(item, ",");
        raster_band band = BAND_SLOPE;
        while (band < BAND_COUNT &&
               (strlen(names[band]) != length || memcmp(names[band], item, length) != 0))
            band++;
        for (uint32_t i = 0; i < count; i++)
            if (bands[i] == band) band = BAND_COUNT;
        if (band == BAND_COUNT) {
            complain(
                "option '--derive' must be some of slope,aspect,hillshade,triangle, not '%.60s'",
                list);
            return 0;
        }
        bands[count++] = band;
        item += length;
        if (!*item) return count;
    }
}

/* --- planes ----------------------------------------------------------------------------------- */

/* How the plane of a triangle rises to the east and to the north; NaN if a value is missing. */
static void triangle_gradient(const raster_mesh *m, uint32_t triangle, double g[2])
{
    uint32_t v[3];
    double p[3][2], z[3];
    mw_mesh_triangle(m->mesh, triangle, v);
    for (int k = 0; k < 3; k++) {
        mw_mesh_vertex(m->mesh, v[k], p[k]);
        z[k] = m->values[v[k]];
    }
    double area = mw_orient2d(p[0], p[1], p[2]), bz = z[1] - z[0], cz = z[2] - z[0];
    g[0] = (bz * (p[2][1] - p[0][1]) - cz * (p[1][1] - p[0][1])) / area;
    g[1] = (cz * (p[1][0] - p[0][0]) - bz * (p[2][0] - p[0][0])) / area;
}

static double gradient_slope(const double g[2])
{
    return atan(hypot(g[0], g[1])) * (180 / acos(-1));
}

static double gradient_aspect(const double g[2])
{
    if (g[0] == 0 && g[1] == 0) return NAN;
    double azimuth = atan2(-g[0], -g[1]) * (180 / acos(-1));
    return azimuth < 0 ? azimuth + 360 : azimuth;
}

/* The cosine of the angle between the normal and the sun, to 1 .. 255 as gdaldem has it. */
static double gradient_hillshade(const double g[2])
{
    const double azimuth = 315 * acos(-1) / 180, height = 45 * acos(-1) / 180;
    double light = sin(height) - cos(height) * (g[0] * sin(azimuth) + g[1] * cos(azimuth));
    double cosine = light / sqrt(1 + g[0] * g[0] + g[1] * g[1]);
    return isnan(cosine) ? (double)NAN : cosine <= 0 ? 1 : 1 + 254 * cosine;
}

double raster_bands_property(const raster_mesh *m, raster_band band, uint32_t triangle)
{
    double g[2];
    if (triangle == MW_NONE) return NAN;
    if (band == BAND_CELL) return m->cells[raster_mesh_face(m, triangle)];
    if (band == BAND_TRIANGLE) return m->numbers ? m->numbers[triangle] : triangle;
    triangle_gradient(m, triangle, g);
    return band == BAND_SLOPE    ? gradient_slope(g)
           : band == BAND_ASPECT ? gradient_aspect(g)
                                 : gradient_hillshade(g);
}

/* --- strips ----------------------------------------------------------------------------------- */

/* Strips that are computed together. Meanwhile those before them are written. */
typedef struct band_block {
    const raster_bands *bands;
    char *pixels[2][BAND_COUNT]; /* of each band: of these strips, and of those before them */
    uint32_t first, end;         /* strips */
    uint32_t before;             /* the first of those before them; the same as `first`: none */
    gdal_raster *raster;
    int end_of_writing; /* 0, or an exit code */
    atomic_uint next;   /* the strip to go on with */
    atomic_uint_fast64_t filled, mistakable;
    atomic_bool failed; /* memory ran out */
} band_block;

/* What a thread works with. */
typedef struct strip_worker {
    const raster_bands *bands;
    mw_cursor cursor;
    double *values;
    uint32_t *triangles; /* NULL: not wanted */
    uint64_t found[2];   /* as filled and mistakable of raster_bands */
} strip_worker;

/* Store a value in the type of the raster, and return the stored value. */
static RASTER_INLINE double pixel_store(raster_type type, double value, void *pixels, size_t i)
{
    switch (type) {
    case RASTER_FLOAT32: return ((float *)pixels)[i] = (float)value;
    case RASTER_FLOAT64: return ((double *)pixels)[i] = value;
    case RASTER_INT32: return ((int32_t *)pixels)[i] = (int32_t)value;
    case RASTER_BYTE: return ((uint8_t *)pixels)[i] = (uint8_t)(value + 0.5);
    }
    return value;
}

/* The type is a constant where this is called. */
static RASTER_INLINE void pixels_store(raster_type type, double nodata, const double *values,
                                       size_t count, void *pixels, uint64_t found[2])
{
    uint64_t filled = 0, mistakable = 0;
    for (size_t i = 0; i < count; i++) {
        bool valued = values[i] == values[i];
        double value = pixel_store(type, valued ? values[i] : nodata, pixels, i);
        filled += valued;
        mistakable += valued && value == nodata;
    }
    found[0] += filled;
    found[1] += mistakable;
}

void raster_bands_store(const raster_bands *b, const double *values, size_t count, void *pixels,
                        uint64_t found[2])
{
    double nodata = b->nodata;
    switch (b->type) {
    case RASTER_FLOAT32: pixels_store(RASTER_FLOAT32, nodata, values, count, pixels, found); break;
    case RASTER_FLOAT64: pixels_store(RASTER_FLOAT64, nodata, values, count, pixels, found); break;
    case RASTER_INT32: pixels_store(RASTER_INT32, nodata, values, count, pixels, found); break;
    case RASTER_BYTE: pixels_store(RASTER_BYTE, nodata, values, count, pixels, found); break;
    }
}

/* Pixels outside get the value of the nearest point of the border. */
static void worker_fill_outside(strip_worker *w, uint32_t row, uint32_t rows)
{
    const raster_bands *b = w->bands;
    const raster_grid *g = b->grid;
    mw_nearest_border_point hit;
    for (uint32_t j = 0; j < rows; j++)
        for (uint32_t i = 0; i < g->columns; i++) {
            size_t at = (size_t)j * g->columns + i;
            if (w->triangles[at] != MW_NONE ||
                mw_nearest_border(b->mesh->locator, g->x[i], g->y[row + j], &hit, NULL) != MW_OK)
                continue;
            mw_location where = {.weight = {hit.weight[0], hit.weight[1], hit.weight[2]},
                                 .triangle = hit.triangle};
            w->triangles[at] = hit.triangle;
            mw_interpolate(b->mesh->mesh, b->mesh->values, &where, 1, &w->values[at]);
        }
}

/* Only heights as floats are wanted: the scan makes them in their place. */
static bool bands_are_rounded(const raster_bands *b)
{
    return b->count == 1 && b->bands[0] == BAND_VALUE && b->type == RASTER_FLOAT32 && !b->nearest;
}

/* Store `nodata` for NaN, and count as raster_bands_store. */
static void pixels_settle(double nodata, float *pixels, size_t count, uint64_t found[2])
{
    const float none = (float)nodata;
    uint64_t filled = 0, mistakable = 0;
    for (size_t i = 0; i < count; i++) {
        bool valued = pixels[i] == pixels[i];
        filled += valued;
        mistakable += pixels[i] == none;
        pixels[i] = valued ? pixels[i] : none;
    }
    found[0] += filled;
    found[1] += mistakable;
}

/* Replace each triangle by what it has. */
static void worker_derive(strip_worker *w, raster_band band, size_t count)
{
    uint32_t last = MW_NONE;
    double value = NAN;
    for (size_t i = 0; i < count; i++) {
        if (w->triangles[i] != last) {
            last = w->triangles[i];
            value = raster_bands_property(w->bands->mesh, band, last);
        }
        w->values[i] = value;
    }
}

static void worker_do_strip(strip_worker *w, const band_block *block, uint32_t strip)
{
    const raster_bands *b = w->bands;
    uint32_t height = raster_scan_height(b->scan), row = strip * height;
    uint32_t rows = b->grid->rows - row < height ? b->grid->rows - row : height;
    size_t count = (size_t)rows * b->grid->columns;
    size_t before = (size_t)(strip - block->first) * height * b->grid->columns;
    raster_scan_pixels pixels = {.triangles = w->triangles};
    if (bands_are_rounded(b)) {
        pixels.rounded = (float *)(void *)block->pixels[0][0] + before;
        raster_scan_strip(b->scan, strip, &w->cursor, &pixels);
        pixels_settle(b->nodata, pixels.rounded, count, w->found);
        return;
    }
    if (b->bands[0] == BAND_VALUE) pixels.values = w->values;
    raster_scan_strip(b->scan, strip, &w->cursor, &pixels);
    if (b->nearest) worker_fill_outside(w, row, rows);
    for (uint32_t k = 0; k < b->count; k++) {
        if (b->bands[k] != BAND_VALUE) worker_derive(w, b->bands[k], count);
        uint64_t none[2] = {0};
        raster_bands_store(b, w->values, count,
                           block->pixels[0][k] + before * gdal_raster_size(b->type),
                           k == 0 ? w->found : none);
    }
}

/* Write the strips before those of the block. */
static int block_write(const band_block *block)
{
    const raster_bands *b = block->bands;
    uint32_t height = raster_scan_height(b->scan), row = block->before * height;
    uint32_t rows = (block->first - block->before) * height;
    if (rows > b->grid->rows - row) rows = b->grid->rows - row;
    int end = 0;
    for (uint32_t k = 0; rows > 0 && end == 0 && k < b->count; k++)
        end = gdal_raster_write(block->raster, b->offset + k, row, rows, block->pixels[1][k]);
    progress_points((uint64_t)(row + rows) * b->grid->columns,
                    (double)(row + rows) / b->grid->rows);
    return end;
}

static void block_work(void *work, uint32_t member)
{
    band_block *block = work;
    const raster_bands *b = block->bands;
    strip_worker w = {.bands = b};
    size_t count = (size_t)raster_scan_height(b->scan) * b->grid->columns;
    /* GDAL is called by the thread that the program began with: member 0. */
    if (member == 0) block->end_of_writing = block_write(block);
    bool doubles = !bands_are_rounded(b);
    if (doubles) w.values = malloc(count * sizeof *w.values);
    bool wanted = b->bands[0] != BAND_VALUE || b->nearest;
    if (wanted) w.triangles = malloc(count * sizeof *w.triangles);
    if ((w.values || !doubles) && (w.triangles || !wanted) &&
        mw_cursor_init(b->mesh->locator, NULL, &w.cursor, NULL) == MW_OK) {
        for (uint32_t strip; (strip = atomic_fetch_add(&block->next, 1)) < block->end;)
            worker_do_strip(&w, block, strip);
    } else {
        atomic_store(&block->failed, true);
    }
    atomic_fetch_add(&block->filled, w.found[0]);
    atomic_fetch_add(&block->mistakable, w.found[1]);
    free(w.values);
    free(w.triangles);
}

/* --- blocks ----------------------------------------------------------------------------------- */

/* About this many bytes of pixels wait to be written. */
#define BLOCK_BYTES ((size_t)1 << 25)

static bool block_make_pixels(band_block *block, size_t bytes)
{
    for (int i = 0; i < 2; i++)
        for (uint32_t k = 0; k < block->bands->count; k++)
            if (!(block->pixels[i][k] = malloc(bytes))) return false;
    return true;
}

/* Go on with the strips from `first` up to, not including, `end`. */
static void block_move(band_block *block, uint32_t first, uint32_t end)
{
    block->before = block->first;
    block->first = first;
    block->end = end;
    atomic_store(&block->next, first);
    for (int k = 0; k < BAND_COUNT; k++) {
        char *pixels = block->pixels[0][k];
        block->pixels[0][k] = block->pixels[1][k];
        block->pixels[1][k] = pixels;
    }
}

int raster_bands_write(raster_bands *b, gdal_raster *raster)
{
    uint32_t height = raster_scan_height(b->scan), strips = raster_scan_strips(b->scan);
    size_t strip_bytes = (size_t)height * b->grid->columns * gdal_raster_size(b->type);
    size_t at_once = BLOCK_BYTES / strip_bytes / b->count, most = 8 * mw__team(b->threads, strips);
    uint32_t step = (uint32_t)(at_once < 1 ? 1 : at_once > most ? most : at_once);
    band_block block = {.bands = b, .raster = raster};
    int end = block_make_pixels(&block, step * strip_bytes) ? 0 : fail_memory();
    if (b->bands[0] == BAND_VALUE) raster_scan_take_values(b->scan, b->mesh->values);
    for (uint32_t strip = 0; end == 0 && strip < strips; strip += step) {
        block_move(&block, strip, strips - strip < step ? strips : strip + step);
        mw__team_run(mw__team(b->threads, block.end - strip), block_work, &block);
        end = atomic_load(&block.failed) ? fail_memory() : block.end_of_writing;
    }
    block_move(&block, strips, strips);
    if (end == 0) end = block_write(&block);
    for (uint32_t k = 0; k < b->count; k++) {
        free(block.pixels[0][k]);
        free(block.pixels[1][k]);
    }
    b->filled = atomic_load(&block.filled);
    b->mistakable = atomic_load(&block.mistakable);
    return end;
}
