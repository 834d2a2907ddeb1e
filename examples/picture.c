/* picture.c - a shaded picture of a terrain model: its height at every pixel from one batch, drawn
 * with Cairo.
 *
 *     picture MESH PICTURE.png [WIDTH] */
#include <meshwalk/meshwalk.h>
#include <cairo.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

/* A grid of heights, one per pixel, rows from the north; NaN outside the model. */
typedef struct raster {
    int columns, rows;
    double cell; /* metres per pixel */
    double *height;
} raster;

/* A model as read: the mesh, its extent and its heights. */
typedef struct terrain {
    mw_mesh *mesh;
    mw_mesh_info info;
} terrain;

static mw_status read_terrain(const char *path, terrain *t, mw_error *error)
{
    mw_mesh_file file;
    mw_status status = mw_read_mesh(path, NULL, &file, error);
    if (status) return status;
    mw_arrays arrays = mw_mesh_file_arrays(&file);
    status = mw_mesh_create(&arrays, NULL, &t->mesh, error);
    if (!status) status = mw_mesh_set_field(t->mesh, "z", file.points + 2, 3, error);
    if (!status) status = mw_mesh_describe(t->mesh, NULL, &t->info, error);
    mw_mesh_file_release(&file);
    return status;
}

/* The middles of all pixels, x and y of each. */
static void pixel_centres(const terrain *t, const raster *r, double *position)
{
    for (int row = 0; row < r->rows; row++) {
        for (int column = 0; column < r->columns; column++, position += 2) {
            position[0] = t->info.low[0] + (column + 0.5) * r->cell;
            position[1] = t->info.high[1] - (row + 0.5) * r->cell;
        }
    }
}

static mw_status sample(const terrain *t, const raster *r, mw_error *error)
{
    size_t n = (size_t)r->rows * (size_t)r->columns;
    double *position = malloc(2 * n * sizeof *position);
    mw_location *location = malloc(n * sizeof *location);
    mw_locator *locator = NULL;
    mw_status status = position && location ? MW_OK : MW_ERROR_MEMORY;
    if (status) snprintf(error->message, sizeof error->message, "out of memory");
    if (!status) status = mw_locator_create(t->mesh, NULL, &locator, error);
    if (!status) {
        pixel_centres(t, r, position);
        status = mw_locate_batch(locator, position, n, 2, NULL, location, NULL, error);
    }
    if (!status) mw_interpolate(t->mesh, mw_mesh_field(t->mesh, "z"), location, n, r->height);
    mw_locator_destroy(locator);
    free(location);
    free(position);
    return status;
}

/* Brightness 0..1 of a slope lit from the north-west, 45 degrees above the horizon; heights
 * exaggerated. */
static double shade(const raster *r, int column, int row)
{
    int east = column + 1 < r->columns ? column + 1 : column,
        west = column > 0 ? column - 1 : column;
    int south = row + 1 < r->rows ? row + 1 : row, north = row > 0 ? row - 1 : row;
    const double *h = r->height, exaggeration = 2.5;
    double dx = exaggeration * (h[row * r->columns + east] - h[row * r->columns + west]) /
                ((east - west) * r->cell);
    double dy = exaggeration * (h[north * r->columns + column] - h[south * r->columns + column]) /
                ((south - north) * r->cell);
    double light = (dx / sqrt(2) - dy / sqrt(2) + 1) / sqrt(2) / sqrt(dx * dx + dy * dy + 1);
    return isnan(light) || light < 0 ? 0 : light;
}

/* From green valleys over brown slopes to pale summits; `level` 0..1. Packed as Cairo's RGB24. */
static uint32_t colour(double level, double light)
{
    static const double stop[4][3] = {
        {0.42, 0.60, 0.38}, {0.80, 0.76, 0.50}, {0.66, 0.48, 0.33}, {0.97, 0.95, 0.92}};
    int below = level >= 1 ? 2 : (int)(3 * level);
    double part = 3 * level - below, brightness = 0.25 + 0.95 * light;
    uint32_t packed = 0;
    for (int k = 0; k < 3; k++) {
        double c = (stop[below][k] * (1 - part) + stop[below + 1][k] * part) * brightness;
        /* few levels: a small file */
        uint32_t byte = c >= 1 ? 255 : (uint32_t)(255 * c) & ~UINT32_C(7);
        packed = packed << 8 | byte;
    }
    return packed;
}

static void paint(const raster *r, cairo_surface_t *surface)
{
    double low = INFINITY, high = -INFINITY;
    for (int i = 0; i < r->rows * r->columns; i++) {
        low = fmin(low, r->height[i]); /* fmin and fmax pass over NaN */
        high = fmax(high, r->height[i]);
    }
    cairo_surface_flush(surface);
    unsigned char *pixels = cairo_image_surface_get_data(surface);
    int stride = cairo_image_surface_get_stride(surface);
    for (int row = 0; row < r->rows; row++) {
        uint32_t *line = (uint32_t *)(void *)(pixels + (ptrdiff_t)row * stride);
        for (int column = 0; column < r->columns; column++) {
            double h = r->height[row * r->columns + column];
            line[column] =
                isnan(h) ? 0xffffff : colour((h - low) / (high - low), shade(r, column, row));
        }
    }
    cairo_surface_mark_dirty(surface);
}

static mw_status draw(const char *mesh, const char *picture, int width, mw_error *error)
{
    terrain t = {.mesh = NULL};
    mw_status status = read_terrain(mesh, &t, error);
    raster r = {.columns = width};
    if (!status) {
        r.cell = (t.info.high[0] - t.info.low[0]) / width;
        r.rows = (int)((t.info.high[1] - t.info.low[1]) / r.cell);
        r.height = malloc((size_t)r.rows * (size_t)r.columns * sizeof *r.height);
        status = r.height ? sample(&t, &r, error) : MW_ERROR_MEMORY;
    }
    if (!status) {
        cairo_surface_t *surface =
            cairo_image_surface_create(CAIRO_FORMAT_RGB24, r.columns, r.rows);
        if (cairo_surface_status(surface) == CAIRO_STATUS_SUCCESS) paint(&r, surface);
        cairo_status_t written = cairo_surface_write_to_png(surface, picture);
        if (written)
            snprintf(error->message, sizeof error->message, "%s: %s", picture,
                     cairo_status_to_string(written));
        if (written) status = MW_ERROR_SYSTEM;
        cairo_surface_destroy(surface);
    }
    free(r.height);
    mw_mesh_destroy(t.mesh);
    return status;
}

int main(int argc, char **argv)
{
    int width = argc > 3 ? atoi(argv[3]) : 800;
    if (argc < 3 || width < 1 || width > 10000) {
        fprintf(stderr, "usage: picture MESH PICTURE.png [WIDTH]\n");
        return 2;
    }
    mw_error error = {.message = "out of memory"};
    if (draw(argv[1], argv[2], width, &error) == MW_OK) return 0;
    fprintf(stderr, "picture: %s\n", error.message);
    return 1;
}
