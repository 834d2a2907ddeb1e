/* volume - cut and fill between a mesh and a plane, or another mesh. */
#include "cli/commands/commands.h"
#include "cli/frame/files.h"
#include "cli/frame/message.h"
#include "cli/frame/progress.h"
#include "cli/frame/report.h"
#include "cli/gdal/crs_heights.h"
#include "cli/gdal/gdal_crs.h"
#include "cli/raster/raster_mesh.h"

#include <math.h>
#include <stdlib.h>

typedef struct volume_settings {
    common_settings common;
    const char *base, *against, *field, *against_field, *nodata, *crs, *against_crs;
    bool json, strict;
} volume_settings;

static const option volume_options[] = {
    {"base", 0, OPTION_TEXT, offsetof(volume_settings, base), "Z",
     "the volume above and below the height Z", NULL},
    {"against", 0, OPTION_TEXT, offsetof(volume_settings, against), "MESH2",
     "the volume between MESH and MESH2, where both have heights", NULL},
    {"field", 0, OPTION_TEXT, offsetof(volume_settings, field), "NAME",
     "the height: z or a field of MESH (default: z)", NULL},
    {"against-field", 0, OPTION_TEXT, offsetof(volume_settings, against_field), "NAME",
     "the height of MESH2 (default: as --field)", NULL},
    {"nodata", 0, OPTION_TEXT, offsetof(volume_settings, nodata), "V",
     "vertices with the value V have none, as those with NaN; none: all others have one (default: "
     "-99999)",
     NULL},
    {"crs", 0, OPTION_TEXT, offsetof(volume_settings, crs), "CRS",
     "the coordinate system of MESH, as EPSG:2056 (default: what it tells)", NULL},
    {"against-crs", 0, OPTION_TEXT, offsetof(volume_settings, against_crs), "CRS", "that of MESH2",
     NULL},
    {"json", 0, OPTION_FLAG, offsetof(volume_settings, json), NULL, "print JSON", NULL},
    {"strict", 0, OPTION_FLAG, offsetof(volume_settings, strict), NULL,
     "exit with 1 if some area is in one of the meshes only", NULL},
    {0},
};

typedef struct volume_meshes {
    const char *path[2];
    raster_mesh mesh[2]; /* the second one only with --against */
    double base;
} volume_meshes;

/* --- what is refused --- */

static int volume_check(const volume_settings *s, const char *mesh, volume_meshes *m,
                        nodata_rule *nodata)
{
    char *stop;
    const char *inputs[2] = {mesh, s->against};
    if (!s->base == !s->against) {
        complain("volume: give either --base Z or --against MESH2");
        return END_USAGE;
    }
    if (!s->against && (s->against_field || s->against_crs || s->strict)) {
        complain("option '--%s' needs --against", s->against_field ? "against-field"
                                                  : s->against_crs ? "against-crs"
                                                                   : "strict");
        return END_USAGE;
    }
    m->base = s->base ? strtod(s->base, &stop) : 0;
    if (s->base && (*stop || stop == s->base || !isfinite(m->base))) {
        complain("option '--base' must be a number, not '%.60s'", s->base);
        return END_USAGE;
    }
    int end = files_check_output(s->common.output, inputs, s->against ? 2 : 1);
    if (end == 0) end = crs_check_option("crs", s->crs);
    if (end == 0) end = crs_check_option("against-crs", s->against_crs);
    return end ? end : nodata_parse("nodata", s->nodata, nodata);
}

/* Degrees have no areas. */
static int volume_check_plane(const volume_meshes *m, int k)
{
    char name[CRS_NAME];
    if (!m->mesh[k].crs || !crs_is_lonlat(m->mesh[k].crs)) return 0;
    complain("%s: is in longitudes and latitudes (%s), in which areas have no unit: transform it "
             "to a projected coordinate system first",
             m->path[k], crs_name(m->mesh[k].crs, name));
    return END_INPUT;
}

static int volume_check_systems(const volume_settings *s, const volume_meshes *m)
{
    char names[2][CRS_NAME];
    const char *a = m->mesh[0].crs, *b = m->mesh[1].crs;
    int end = volume_check_plane(m, 0);
    if (end || !s->against) return end;
    end = volume_check_plane(m, 1);
    if (end) return end;
    if (a && b && !crs_same(a, b)) {
        complain("%s is in %s, but %s is in %s: transform one of them first", m->path[0],
                 crs_name(a, names[0]), m->path[1], crs_name(b, names[1]));
        return END_INPUT;
    }
    if (a && b) return crs_check_heights(m->path[0], a, m->path[1], b, s->common.quiet);
    if (!a != !b && !s->common.quiet)
        complain("%s: warning: its coordinate system is not known, and %s is in %s: it is taken "
                 "to be the same",
                 m->path[a != NULL], m->path[a == NULL], crs_name(a ? a : b, names[0]));
    return 0;
}

/* --- the report --- */

static int volume_print(const volume_settings *s, const volume_meshes *m,
                        const mw_volume_info *info)
{
    report r;
    char unit[CRS_UNIT];
    report_begin(&r, s->json);
    report_number(&r, "cut", info->cut);
    report_number(&r, "fill", info->fill);
    report_number(&r, "net", info->cut - info->fill);
    report_number(&r, "area", info->area);
    report_number(&r, "cut_area", info->cut_area);
    report_number(&r, "fill_area", info->fill_area);
    report_number(&r, "level_area", info->level_area);
    if (s->against) {
        report_number(&r, "mesh_only_area", info->surface_only);
        report_number(&r, "against_only_area", info->other_only);
    }
    if (m->mesh[0].crs && crs_unit(m->mesh[0].crs, unit)) report_string(&r, "unit", unit);
    report_end(&r);
    return files_write_text(s->common.output, &r.text);
}

static int volume_tell(const volume_settings *s, const volume_meshes *m, const mw_volume_info *info)
{
    int end = volume_print(s, m, info);
    if (end || !s->against) return end;
    if (info->area == 0 && !s->common.quiet)
        complain("%s: warning: it has no area in common with %s: x %g to %g, y %g to %g here, x %g "
                 "to %g, y %g to %g there",
                 m->path[0], m->path[1], m->mesh[0].extent[0], m->mesh[0].extent[2],
                 m->mesh[0].extent[1], m->mesh[0].extent[3], m->mesh[1].extent[0],
                 m->mesh[1].extent[2], m->mesh[1].extent[1], m->mesh[1].extent[3]);
    bool alone = info->surface_only > 0 || info->other_only > 0;
    return s->strict && alone ? END_UNANSWERED : 0;
}

static int volume_find(const volume_settings *s, const volume_meshes *m, mw_volume_info *info)
{
    mw_error error;
    const raster_mesh *a = &m->mesh[0], *b = &m->mesh[1];
    const mw_volume_options options = {.threads = s->common.threads,
                                       .progress = progress_of_call()};
    progress_phase("adding", m->path[0]);
    mw_status status =
        s->against ? mw_volume_between(a->locator, a->values, b->locator, b->values, &options, info,
                                       &error)
                   : mw_volume_above(a->locator, a->values, m->base, &options, info, &error);
    return status == MW_OK ? 0 : fail_query(&error);
}

static int volume_run(const void *settings, const char *const *operands)
{
    const volume_settings *s = settings;
    volume_meshes m = {.path = {operands[0], s->against}};
    mw_volume_info info;
    raster_mesh_settings wish = {
        .common = &s->common,
        .field = {.field = s->field ? s->field : "z", .quiet = s->common.quiet},
        .crs = s->crs};
    int end = volume_check(s, operands[0], &m, &wish.field.nodata);
    if (end == 0) end = raster_mesh_read(&m.mesh[0], operands[0], &wish);
    if (s->against_field) wish.field.field = s->against_field;
    wish.crs = s->against_crs;
    if (end == 0 && s->against) end = raster_mesh_read(&m.mesh[1], s->against, &wish);
    if (end == 0) end = volume_check_systems(s, &m);
    if (end == 0) end = volume_find(s, &m, &info);
    if (end == 0) end = volume_tell(s, &m, &info);
    raster_mesh_release(&m.mesh[0]);
    raster_mesh_release(&m.mesh[1]);
    return end;
}

static const option *const tables[] = {volume_options, common_options, NULL};

const command volume_command = {
    .name = "volume",
    .operands = "MESH",
    .operand_count = 1,
    .summary = "cut and fill between a mesh and a height, or another mesh",
    .description = "Prints the volume of what MESH has above a height or another mesh (cut), what "
                   "it lacks below (fill), and the areas of both in the plane. Triangles are "
                   "clipped by those of the other mesh exactly. Places where only one of two "
                   "meshes has a height add no volume; the report has their area.",
    .options = tables,
    .essential = "base against field strict output",
    .settings_size = sizeof(volume_settings),
    .run = volume_run,
};
