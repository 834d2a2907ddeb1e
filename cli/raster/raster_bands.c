#include "cli/raster/raster_bands.h"
#include "cli/frame/message.h"
#include "cli/frame/progress.h"
#include "src/base/base.h"
#include "src/base/posix.h"
#include "src/base/threads.h"

#include <math.h>
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

/* Strips on their way: computed by all threads, written in order by the first. Strip i uses slot i
 * modulo their number, so no more strips than slots wait to be written, and all of them stay in a
 * cache. */
enum { MOST_SLOTS = 2 * MW_MOST_THREADS };
typedef struct band_strips {
    const raster_bands *bands;
    gdal_raster *raster;
    uint32_t strips, slots;
    char *pixels;         /* of each slot, band by band */
    size_t band_bytes;    /* of a strip, and what raster_scan.h needs behind it */
    pthread_mutex_t lock; /* of what follows */
    pthread_cond_t change;
    uint32_t next;          /* the strip to be computed next */
    uint32_t written;       /* so many strips are */
    bool ready[MOST_SLOTS]; /* the strip of this slot can be written */
    int end;                /* 0, or an exit code: everyone stops */
    uint64_t found[2];      /* as filled and mistakable of raster_bands */
} band_strips;

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

/* Store `nodata` for NaN, and count as raster_bands_store. In most runs of pixels all have a
 * value. */
static void pixels_settle(double nodata, float *pixels, size_t count, uint64_t found[2])
{
    enum { RUN = 32 };
    const float none = (float)nodata;
    for (size_t from = 0; from < count; from += RUN) {
        const size_t run = count - from < RUN ? count - from : RUN;
        uint32_t valued = 0, mistakable = 0;
        for (size_t i = 0; run == RUN && i < RUN; i++) {
            valued += pixels[from + i] == pixels[from + i];
            mistakable += pixels[from + i] == none;
        }
        if (run == RUN && valued == RUN) {
            found[0] += RUN;
            found[1] += mistakable;
            continue;
        }
        for (size_t i = from; i < from + run; i++) {
            const bool has = pixels[i] == pixels[i];
            found[0] += has;
            found[1] += pixels[i] == none;
            pixels[i] = has ? pixels[i] : none;
        }
    }
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

static char *strip_pixels(const band_strips *all, uint32_t strip, uint32_t band)
{
    return all->pixels + (strip % all->slots * (size_t)all->bands->count + band) * all->band_bytes;
}

static void worker_do_strip(strip_worker *w, const band_strips *all, uint32_t strip)
{
    const raster_bands *b = w->bands;
    uint32_t height = raster_scan_height(b->scan), row = strip * height;
    uint32_t rows = b->grid->rows - row < height ? b->grid->rows - row : height;
    size_t count = (size_t)rows * b->grid->columns;
    raster_scan_pixels pixels = {.triangles = w->triangles};
    if (bands_are_rounded(b)) {
        pixels.rounded = (float *)(void *)strip_pixels(all, strip, 0);
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
        raster_bands_store(b, w->values, count, strip_pixels(all, strip, k),
                           k == 0 ? w->found : none);
    }
}

static int strip_write(const band_strips *all, uint32_t strip)
{
    const raster_bands *b = all->bands;
    uint32_t height = raster_scan_height(b->scan), row = strip * height,
             rows = b->grid->rows - row < height ? b->grid->rows - row : height;
    int end = 0;
    for (uint32_t k = 0; end == 0 && k < b->count; k++)
        end = gdal_raster_write(all->raster, b->offset + k, row, rows, strip_pixels(all, strip, k));
    progress_points((uint64_t)(row + rows) * b->grid->columns,
                    (double)(row + rows) / b->grid->rows);
    return end;
}

static bool worker_make(strip_worker *w)
{
    const raster_bands *b = w->bands;
    const size_t count = (size_t)raster_scan_height(b->scan) * b->grid->columns;
    const bool doubles = !bands_are_rounded(b), wanted = b->bands[0] != BAND_VALUE || b->nearest;
    if (doubles) w->values = malloc(count * sizeof *w->values);
    if (wanted) w->triangles = malloc(count * sizeof *w->triangles);
    return (w->values || !doubles) && (w->triangles || !wanted) &&
           mw_cursor_init(b->mesh->locator, NULL, &w->cursor, NULL) == MW_OK;
}

/* --- threads ---------------------------------------------------------------------------------- */

/* With the lock held: do something without it, and report. */
static void strips_compute_next(band_strips *all, strip_worker *w)
{
    const uint32_t strip = all->next++;
    pthread_mutex_unlock(&all->lock);
    worker_do_strip(w, all, strip);
    pthread_mutex_lock(&all->lock);
    all->ready[strip % all->slots] = true;
    pthread_cond_broadcast(&all->change);
}

static void strips_write_next(band_strips *all)
{
    const uint32_t strip = all->written;
    pthread_mutex_unlock(&all->lock);
    const int end = strip_write(all, strip);
    pthread_mutex_lock(&all->lock);
    all->ready[strip % all->slots] = false;
    all->written++;
    if (end) all->end = end;
    pthread_cond_broadcast(&all->change);
}

/* A strip is computed by a thread that runs already, and written by the caller's, which runs from
 * the beginning: so nobody waits for a thread that could not be made. GDAL is called by the thread
 * that the program began with: member 0. */
static void strips_work(void *self, uint32_t member)
{
    band_strips *all = self;
    strip_worker w = {.bands = all->bands};
    const bool made = worker_make(&w), writes = member == 0;
    pthread_mutex_lock(&all->lock);
    if (!made && !all->end) all->end = fail_memory();
    while (!all->end && (writes ? all->written : all->next) < all->strips) {
        if (writes && all->ready[all->written % all->slots])
            strips_write_next(all);
        else if (all->next < all->strips && all->next - all->written < all->slots)
            strips_compute_next(all, &w);
        else
            pthread_cond_wait(&all->change, &all->lock);
    }
    for (int i = 0; i < 2; i++) all->found[i] += w.found[i];
    pthread_cond_broadcast(&all->change);
    pthread_mutex_unlock(&all->lock);
    free(w.values);
    free(w.triangles);
}

/* At most about this many bytes of pixels wait to be written. */
#define WAITING_BYTES ((size_t)1 << 26)

/* Two strips for each thread: one that it computes, and one that is written later. */
static uint32_t strips_slots(size_t bytes, uint32_t team)
{
    const size_t most = WAITING_BYTES / bytes;
    return 2 * team <= most ? 2 * team : most > 2 ? (uint32_t)most : 2;
}

int raster_bands_write(raster_bands *b, gdal_raster *raster)
{
    const uint32_t strips = raster_scan_strips(b->scan), team = mw__team(b->threads, strips);
    const size_t pixels = (size_t)raster_scan_height(b->scan) * b->grid->columns,
                 bytes = pixels * gdal_raster_size(b->type) + RASTER_GRID_SPARE * sizeof(float);
    band_strips all = {.bands = b,
                       .raster = raster,
                       .strips = strips,
                       .slots = strips_slots(bytes * b->count, team),
                       .band_bytes = bytes};
    all.pixels = mw__alloc_lines(all.slots, bytes * b->count);
    if (!all.pixels) return fail_memory();
    if (b->bands[0] == BAND_VALUE) raster_scan_take_values(b->scan, b->mesh->values);
    pthread_mutex_init(&all.lock, NULL);
    pthread_cond_init(&all.change, NULL);
    mw__team_run(team, strips_work, &all);
    free(all.pixels);
    pthread_mutex_destroy(&all.lock);
    pthread_cond_destroy(&all.change);
    b->filled = all.found[0];
    b->mistakable = all.found[1];
    return all.end;
}
