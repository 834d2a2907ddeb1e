#include "cli/raster/raster_series.h"
#include "cli/frame/message.h"
#include "cli/frame/text.h"

#include <stdlib.h>

enum { SERIES_MOST_BANDS = 65535 }; /* of a GeoTIFF */

static size_t series_steps(const raster_series *s)
{
    return s->choice.last - s->choice.first + 1;
}

/* "zeta@3600", as the columns of 'sample --wide' are called. */
static char *series_band_name(const raster_series *s, size_t step, size_t k)
{
    text name = {0};
    text_printf(&name, "%s@", series_field(&s->choice, k)->name);
    text_double(&name, s->choice.info->times[step]);
    text_bytes(&name, "", 1);
    if (name.failed) text_release(&name);
    return name.bytes;
}

static int series_name_bands(raster_series *s)
{
    size_t fields = s->choice.field_count, count = series_steps(s) * fields;
    if (count > SERIES_MOST_BANDS) {
        complain("%s: %zu fields and steps are more than the %d bands that a raster may have: "
                 "--time and --field choose some",
                 s->choice.path, count, SERIES_MOST_BANDS);
        return END_RESOURCE;
    }
    s->names = calloc(count + 1, sizeof *s->names);
    if (!s->names) return fail_memory();
    for (; s->bands < count; s->bands++) {
        s->names[s->bands] =
            series_band_name(s, s->choice.first + s->bands / fields, s->bands % fields);
        if (!s->names[s->bands]) return fail_memory();
    }
    return 0;
}

int raster_series_open(raster_series *s, const series_request *request, const raster_mesh *mesh,
                       bool quiet)
{
    *s = (raster_series){0};
    int end = series_choose(&s->choice, request, mesh->file_vertices, mesh->face_count);
    if (end) return end;
    const mw_series_info *info = s->choice.info;
    if (!quiet && *info->time_unit)
        complain("%s: remark: %zu of %zu steps; times are in %s", s->choice.path, series_steps(s),
                 info->step_count, info->time_unit);
    return series_name_bands(s);
}

void raster_series_close(raster_series *s)
{
    for (uint32_t i = 0; i < s->bands; i++) free(s->names[i]);
    free(s->names);
    series_close(&s->choice);
    *s = (raster_series){0};
}

int raster_series_begin(raster_mesh *mesh)
{
    mesh->cells = malloc(mesh->face_count * sizeof *mesh->cells + 1);
    return mesh->cells ? 0 : fail_memory();
}

void raster_series_end(raster_mesh *mesh)
{
    free(mesh->cells);
    mesh->cells = NULL;
}

int raster_series_read(raster_series *s, raster_mesh *mesh, uint32_t band, bool *cells)
{
    mw_error error;
    size_t fields = s->choice.field_count, k = band % fields,
           step = s->choice.first + band / fields;
    *cells = series_field(&s->choice, k)->location == MW_SERIES_FACE;
    double *values = *cells ? mesh->cells : mesh->seam ? mesh->own : mesh->values;
    if (mw_series_read(s->choice.series, s->choice.field[k], step, values, &error) != MW_OK)
        return fail_reading(&error);
    return *cells ? 0 : raster_mesh_spread(mesh);
}

int raster_series_write(raster_series *s, raster_bands *b, raster_mesh *mesh, gdal_raster *raster)
{
    uint64_t filled = 0, mistakable = 0;
    int end = raster_series_begin(mesh);
    for (b->offset = 0; end == 0 && b->offset < s->bands; b->offset++) {
        bool cells;
        end = raster_series_read(s, mesh, b->offset, &cells);
        b->bands[0] = cells ? BAND_CELL : BAND_VALUE;
        if (end == 0) end = raster_bands_write(b, raster);
        if (b->offset == 0) filled = b->filled;
        mistakable += b->mistakable;
    }
    b->filled = filled;
    b->mistakable = mistakable;
    raster_series_end(mesh);
    return end;
}
