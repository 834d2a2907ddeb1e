#include "cli/gdal/gdal_raster.h"
#include "cli/frame/files.h"
#include "cli/frame/message.h"
#include "cli/gdal/gdal_crs.h"
#include "cli/gdal/gdal_directory.h"
#include "src/base/posix.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

uint32_t gdal_raster_size(raster_type type)
{
    static const uint32_t sizes[] = {4, 8, 4, 1};
    return sizes[type];
}

#ifdef MW_GDAL

struct gdal_raster {
    const gdal_functions *gdal;
    gdal_directory target;
    gdal_raster_form form;
    GDALDriverH driver, copier; /* what writes; what then copies to the final form, or NULL */
    char *scratch;              /* what is copied */
    char **creation;
    GDALDatasetH set;
    bool by_row; /* a row is a block of the file */
};

static const GDALDataType types[] = {[RASTER_FLOAT32] = GDT_Float32,
                                     [RASTER_FLOAT64] = GDT_Float64,
                                     [RASTER_INT32] = GDT_Int32,
                                     [RASTER_BYTE] = GDT_Byte};

/* --- drivers ---------------------------------------------------------------------------------- */

static const char *raster_driver_name(const char *path)
{
    static const char *const endings[][2] = {
        {".tif", "GTiff"}, {".tiff", "GTiff"},  {".asc", "AAIGrid"}, {".img", "HFA"},
        {".png", "PNG"},   {".bil", "EHdr"},    {".flt", "EHdr"},    {".grd", "GSBG"},
        {".sdat", "SAGA"}, {".rst", "RST"},     {".nc", "netCDF"},   {".jp2", "JP2OpenJPEG"},
        {".gpkg", "GPKG"}, {".ter", "Terragen"}};
    size_t length = strlen(path);
    for (size_t i = 0; i < sizeof endings / sizeof *endings; i++) {
        size_t end = strlen(endings[i][0]);
        if (length > end && strcasecmp(path + length - end, endings[i][0]) == 0)
            return endings[i][1];
    }
    return NULL;
}

static bool driver_can(const gdal_functions *gdal, GDALDriverH driver, const char *what)
{
    const char *answer = gdal->GDALGetMetadataItem(driver, what, NULL);
    return answer && strcasecmp(answer, "YES") == 0;
}

static bool driver_writes_rasters(const gdal_functions *gdal, GDALDriverH driver)
{
    return driver && driver_can(gdal, driver, GDAL_DCAP_RASTER) &&
           (driver_can(gdal, driver, GDAL_DCAP_CREATE) ||
            driver_can(gdal, driver, GDAL_DCAP_CREATECOPY));
}

static int raster_refuse_library(const char *path)
{
    complain("%s: GDAL, which would write it, cannot be loaded (" MW_GDAL ")", path);
    return END_USAGE;
}

static int raster_check_driver(const char *path, const char *name)
{
    const gdal_functions *gdal = gdal_library_load();
    if (!gdal) return raster_refuse_library(path);
    if (!name) {
        complain("%s: no raster format has this ending; use .tif, or name a format by --driver",
                 path);
        return END_USAGE;
    }
    if (driver_writes_rasters(gdal, gdal->GDALGetDriverByName(name))) return 0;
    complain("%s: this GDAL does not write rasters as '%.60s'", path, name);
    return END_USAGE;
}

/* Every GDAL writes GeoTIFF: so GDAL is loaded meanwhile, by a thread of its own. */
int gdal_raster_check(const char *path, const char *driver)
{
    const char *name = driver ? driver : path ? raster_driver_name(path) : NULL;
    if (files_is_standard(path)) {
        complain("a raster is written to a file: -o DEM.tif");
        return END_USAGE;
    }
    const bool common = !driver && name && strcmp(name, "GTiff") == 0;
    if (common) gdal_library_begin();
    int end = common ? 0 : raster_check_driver(path, name);
    return end ? end : gdal_directory_check(path);
}

/* --- writing ---------------------------------------------------------------------------------- */

static int raster_fail(const gdal_raster *r, const char *what)
{
    const char *message = r->gdal->CPLGetLastErrorMsg();
    complain("%s: GDAL says: %.1000s", r->target.path, *message ? message : what);
    return END_RESOURCE;
}

/* Options as GDAL takes them: texts and a NULL, in one piece of memory. */
static char **creation_split(const char *list, const char *const *more)
{
    size_t count = 1, size = strlen(list) + 1;
    for (const char *p = list; *p; p++) count += *p == ',';
    for (size_t i = 0; more[i]; i++) count++;
    char **options = malloc((count + 1) * sizeof *options + size);
    if (!options) return NULL;
    char *copy = (char *)(options + count + 1);
    memcpy(copy, list, size);
    size_t n = 0;
    for (char *p = strtok(copy, ","); p; p = strtok(NULL, ",")) options[n++] = p;
    for (size_t i = 0; more[i]; i++) options[n++] = (char *)(uintptr_t)more[i];
    options[n] = NULL;
    return options;
}

/* Drivers that cannot be written row by row copy a GeoTIFF. */
static int raster_choose_drivers(gdal_raster *r)
{
    static const char *const by_band[] = {"INTERLEAVE=BAND", "BIGTIFF=IF_SAFER", NULL},
                             *const *const large = by_band + 1, *const *const none = by_band + 2;
    const char *name = r->form.driver ? r->form.driver : raster_driver_name(r->target.path);
    GDALDriverH driver = r->gdal->GDALGetDriverByName(name);
    bool tiff = strcasecmp(name, "GTiff") == 0 &&
                !(r->form.creation && strstr(r->form.creation, "BIGTIFF"));
    bool apart =
        tiff && r->form.by_band && !(r->form.creation && strstr(r->form.creation, "INTERLEAVE"));
    r->creation = creation_split(r->form.creation ? r->form.creation : "", apart  ? by_band
                                                                           : tiff ? large
                                                                                  : none);
    r->scratch = malloc(strlen(r->target.temporary) + 32);
    if (!r->creation || !r->scratch) return fail_memory();
    bool direct = driver_can(r->gdal, driver, GDAL_DCAP_CREATE) && strcasecmp(name, "GPKG") != 0;
    if (direct) {
        strcpy(r->scratch, r->target.temporary);
        r->driver = driver;
        return 0;
    }
    /* A name that begins with a dot is not moved to the file's place. */
    int stem = (int)(strrchr(r->target.temporary, '/') - r->target.temporary);
    sprintf(r->scratch, "%.*s/.scratch.tif", stem, r->target.temporary);
    r->driver = r->gdal->GDALGetDriverByName("GTiff");
    r->copier = driver;
    return 0;
}

static int raster_describe_bands(gdal_raster *r)
{
    const gdal_functions *gdal = r->gdal;
    const gdal_raster_form *f = &r->form;
    double transform[6] = {f->corner[0], f->size[0], 0, f->corner[1], 0, -f->size[1]};
    gdal->GDALSetGeoTransform(r->set, transform);
    OGRSpatialReferenceH crs = f->crs ? crs_parse(gdal, f->crs, true) : NULL;
    if (crs) gdal->GDALSetSpatialRef(r->set, crs);
    if (crs) gdal->OSRRelease(crs);
    for (uint32_t i = 0; i < f->bands; i++) {
        GDALRasterBandH band = gdal->GDALGetRasterBand(r->set, (int)i + 1);
        gdal->GDALSetRasterNoDataValue(band, f->nodata);
        gdal->GDALSetDescription(band, f->names[i]);
    }
    return 0;
}

/* A file of one band whose blocks are rows takes them as they are, without GDAL's cache. */
static void raster_find_blocks(gdal_raster *r)
{
    int width, height;
    r->gdal->GDALGetBlockSize(r->gdal->GDALGetRasterBand(r->set, 1), &width, &height);
    r->by_row = r->form.bands == 1 && width == (int)r->form.columns && height == 1;
}

/* GDAL keeps up to a twentieth of the memory of what is written. A few rows of tiles are enough,
 * and quicker: memory is used again. GDAL_CACHEMAX is the user's. */
static void raster_limit_cache(const gdal_raster *r)
{
    enum { ROWS = 1024 };
    const gdal_raster_form *f = &r->form;
    const GIntBig rows = (GIntBig)ROWS * f->columns * f->bands * gdal_raster_size(f->type),
                  least = (GIntBig)1 << 26, most = rows > least ? rows : least;
    if (!r->gdal->CPLGetConfigOption("GDAL_CACHEMAX", NULL) && most < r->gdal->GDALGetCacheMax64())
        r->gdal->GDALSetCacheMax64(most);
}

int gdal_raster_create(gdal_raster **raster, const char *path, const gdal_raster_form *form)
{
    gdal_raster *r = *raster = calloc(1, sizeof *r);
    if (!r) return fail_memory();
    r->gdal = gdal_library_load();
    r->form = *form;
    if (!r->gdal) return raster_refuse_library(path);
    int end = gdal_directory_open(&r->target, path);
    if (end == 0) end = raster_choose_drivers(r);
    if (end) return end;
    char *scratch_options[] = {"BIGTIFF=IF_SAFER", NULL};
    raster_limit_cache(r);
    r->gdal->CPLErrorReset();
    r->set = r->gdal->GDALCreate(r->driver, r->scratch, (int)form->columns, (int)form->rows,
                                 (int)form->bands, types[form->type],
                                 r->copier ? scratch_options : r->creation);
    if (!r->set || r->gdal->CPLGetLastErrorType() >= CE_Warning)
        return raster_fail(r, "it cannot be created");
    raster_find_blocks(r);
    return raster_describe_bands(r);
}

int gdal_raster_write(gdal_raster *r, uint32_t band, uint32_t row, uint32_t rows, void *pixels)
{
    const GDALRasterBandH target = r->gdal->GDALGetRasterBand(r->set, (int)band + 1);
    const size_t row_bytes = (size_t)r->form.columns * gdal_raster_size(r->form.type);
    CPLErr failure = CE_None;
    r->gdal->CPLErrorReset();
    if (r->by_row)
        for (uint32_t i = 0; failure == CE_None && i < rows; i++)
            failure =
                r->gdal->GDALWriteBlock(target, 0, (int)(row + i), (char *)pixels + i * row_bytes);
    else
        failure = r->gdal->GDALRasterIO(target, GF_Write, 0, (int)row, (int)r->form.columns,
                                        (int)rows, pixels, (int)r->form.columns, (int)rows,
                                        types[r->form.type], 0, 0);
    return failure == CE_None ? 0 : raster_fail(r, "its rows cannot be written");
}

/* Close what was written, and copy it to its final form if that is another. */
static int raster_complete(gdal_raster *r)
{
    r->gdal->CPLErrorReset();
    if (r->copier) {
        GDALDatasetH copy = r->gdal->GDALCreateCopy(r->copier, r->target.temporary, r->set, FALSE,
                                                    r->creation, NULL, NULL);
        if (!copy) return raster_fail(r, "it cannot be written");
        r->gdal->GDALClose(copy);
    }
    r->gdal->GDALClose(r->set);
    r->set = NULL;
    return r->gdal->CPLGetLastErrorType() >= CE_Failure ? raster_fail(r, "it is incomplete") : 0;
}

int gdal_raster_close(gdal_raster *r, bool commit)
{
    int end = 0;
    if (!r) return 0;
    if (commit) end = raster_complete(r);
    if (r->set) r->gdal->GDALClose(r->set);
    int closed = gdal_directory_close(&r->target, commit && end == 0);
    free(r->creation);
    free(r->scratch);
    free(r);
    return end ? end : closed;
}

/* --- reading ---------------------------------------------------------------------------------- */

static int raster_take_grid(const gdal_functions *gdal, GDALDatasetH set, const char *path,
                            gdal_raster_form *form)
{
    double transform[6];
    if (gdal->GDALGetRasterCount(set) == 0 ||
        gdal->GDALGetGeoTransform(set, transform) != CE_None) {
        complain("%s: this raster is not georeferenced", path);
        return END_INPUT;
    }
    if (transform[2] != 0 || transform[4] != 0 || transform[1] <= 0 || transform[5] >= 0) {
        complain(
            "%s: its rows do not run east, or its columns do not run south; gdalwarp can turn it",
            path);
        return END_INPUT;
    }
    int has = 0;
    double nodata = gdal->GDALGetRasterNoDataValue(gdal->GDALGetRasterBand(set, 1), &has);
    *form = (gdal_raster_form){.columns = (uint32_t)gdal->GDALGetRasterXSize(set),
                               .rows = (uint32_t)gdal->GDALGetRasterYSize(set),
                               .bands = (uint32_t)gdal->GDALGetRasterCount(set),
                               .corner = {transform[0], transform[3]},
                               .size = {transform[1], -transform[5]},
                               .nodata = has ? nodata : (double)NAN};
    return 0;
}

int gdal_raster_describe(const char *path, gdal_raster_form *form, char **crs)
{
    *crs = NULL;
    GDALDatasetH set = gdal_library_open(path, GDAL_OF_RASTER, "this is not a raster");
    if (!set) return END_INPUT;
    const gdal_functions *gdal = gdal_library_load();
    int end = raster_take_grid(gdal, set, path, form);
    OGRSpatialReferenceH system = gdal->GDALGetSpatialRef(set);
    if (end == 0 && system) *crs = crs_export(gdal, system);
    gdal->GDALClose(set);
    return end;
}

/* Bring values to the unit of the band, and nodata to NaN. */
static void band_settle(const gdal_functions *gdal, GDALRasterBandH band, double *values,
                        size_t count)
{
    int has_nodata = 0, has_offset = 0, has_scale = 0;
    double nodata = gdal->GDALGetRasterNoDataValue(band, &has_nodata),
           offset = gdal->GDALGetRasterOffset(band, &has_offset),
           scale = gdal->GDALGetRasterScale(band, &has_scale);
    bool single = gdal->GDALGetRasterDataType(band) == GDT_Float32;
    if (single) nodata = (double)(float)nodata;
    for (size_t i = 0; i < count; i++) {
        if ((has_nodata && values[i] == nodata) || !isfinite(values[i]))
            values[i] = NAN;
        else
            values[i] = values[i] * (has_scale ? scale : 1) + (has_offset ? offset : 0);
    }
}

int gdal_raster_read(const char *path, const gdal_raster_form *form, uint32_t band, double *values)
{
    GDALDatasetH set = gdal_library_open(path, GDAL_OF_RASTER, "this is not a raster");
    if (!set) return END_INPUT;
    const gdal_functions *gdal = gdal_library_load();
    GDALRasterBandH source = gdal->GDALGetRasterBand(set, (int)band + 1);
    CPLErr failure = CE_Failure;
    if (source)
        failure =
            gdal->GDALRasterIO(source, GF_Read, 0, 0, (int)form->columns, (int)form->rows, values,
                               (int)form->columns, (int)form->rows, GDT_Float64, 0, 0);
    if (failure != CE_None)
        complain("%s: GDAL says: %.1000s", path, gdal->CPLGetLastErrorMsg());
    else
        band_settle(gdal, source, values, (size_t)form->columns * form->rows);
    gdal->GDALClose(set);
    return failure == CE_None ? 0 : END_INPUT;
}

#else

int gdal_raster_read(const char *path, const gdal_raster_form *form, uint32_t band, double *values)
{
    (void)path;
    (void)form;
    (void)band;
    (void)values;
    return END_INPUT;
}

int gdal_raster_check(const char *path, const char *driver)
{
    (void)driver;
    complain("%s: only a program built with GDAL can write it", path ? path : "rasters");
    return END_USAGE;
}

int gdal_raster_create(gdal_raster **raster, const char *path, const gdal_raster_form *form)
{
    (void)form;
    *raster = NULL;
    return gdal_raster_check(path, NULL);
}

int gdal_raster_write(gdal_raster *r, uint32_t band, uint32_t row, uint32_t rows, void *pixels)
{
    (void)r;
    (void)band;
    (void)row;
    (void)rows;
    (void)pixels;
    return END_USAGE;
}

int gdal_raster_close(gdal_raster *r, bool commit)
{
    (void)r;
    (void)commit;
    return 0;
}

int gdal_raster_describe(const char *path, gdal_raster_form *form, char **crs)
{
    (void)form;
    *crs = NULL;
    complain("%s: only a program built with GDAL can read it", path);
    return END_INPUT;
}

#endif
