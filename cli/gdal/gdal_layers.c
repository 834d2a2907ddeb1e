#include "cli/gdal/gdal_layers.h"
#include "cli/frame/message.h"
#include "cli/gdal/gdal_crs.h"

#include <stdlib.h>
#include <string.h>

#ifdef MW_GDAL

static void layer_report_fields(const gdal_functions *gdal, OGRLayerH layer, report *r)
{
    OGRFeatureDefnH definition = gdal->OGR_L_GetLayerDefn(layer);
    size_t count = (size_t)gdal->OGR_FD_GetFieldCount(definition);
    char **names = calloc(count + 1, sizeof *names);
    for (size_t i = 0; names && i < count; i++)
        names[i] = (char *)(uintptr_t)gdal->OGR_Fld_GetNameRef(
            gdal->OGR_FD_GetFieldDefn(definition, (int)i));
    if (names)
        report_strings(r, "fields", names, count);
    else
        r->text.failed = true;
    free(names);
}

static void layer_report(const gdal_functions *gdal, GDALDatasetH set, OGRLayerH layer, report *r)
{
    char *crs = crs_of_layer(set, layer);
    GIntBig features = gdal->OGR_L_GetFeatureCount(layer, TRUE);
    report_string(r, "layer", gdal->OGR_L_GetName(layer));
    report_string(r, "geometry", gdal->OGRGeometryTypeToName(gdal->OGR_L_GetGeomType(layer)));
    report_count(r, "features", features > 0 ? (uint64_t)features : 0);
    layer_report_fields(gdal, layer, r);
    if (crs)
        report_string(r, "crs", crs);
    else
        report_missing(r, "crs", "not known");
    free(crs);
}

static int layers_report_set(const gdal_functions *gdal, GDALDatasetH set, const char *path,
                             const char *wanted, report *r)
{
    int count = gdal->GDALDatasetGetLayerCount(set), found = -1;
    char **names = calloc((size_t)count + 1, sizeof *names);
    if (!names) return fail_memory();
    for (int i = 0; i < count; i++) {
        names[i] = (char *)(uintptr_t)gdal->OGR_L_GetName(gdal->GDALDatasetGetLayer(set, i));
        if (wanted ? strcmp(names[i], wanted) == 0 : count == 1) found = i;
    }
    report_string(r, "file", path);
    report_strings(r, "layers", names, (size_t)count);
    free(names);
    if (found >= 0) layer_report(gdal, set, gdal->GDALDatasetGetLayer(set, found), r);
    if (found >= 0 || !wanted) return 0;
    complain("%s: has no layer '%s'; without --layer this command lists them", path, wanted);
    return END_INPUT;
}

int gdal_layers_report(const char *path, const char *wanted, report *r)
{
    GDALDatasetH set = gdal_library_open(path, GDAL_OF_VECTOR, "this is not a vector file");
    if (!set) return END_INPUT;
    const gdal_functions *gdal = gdal_library_load();
    int end = layers_report_set(gdal, set, path, wanted, r);
    gdal->GDALClose(set);
    return end;
}

#else

int gdal_layers_report(const char *path, const char *wanted, report *r)
{
    (void)wanted;
    (void)r;
    complain("%s: is not a mesh; a program built with GDAL lists its layers", path);
    return END_INPUT;
}

#endif
