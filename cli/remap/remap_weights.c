#include "cli/remap/remap_weights.h"
#include "cli/frame/files.h"
#include "cli/frame/message.h"
#include "cli/frame/progress.h"
#include "cli/frame/report.h"
#include "cli/gdal/gdal_crs.h"
#include "cli/gdal/gdal_raster.h"
#include "cli/gdal/mesh_crs.h"
#include "cli/remap/remap_cells.h"
#include "src/base/posix.h"

#include <stdlib.h>
#include <string.h>

/* A fraction of an area below this counts as rounding error. */
#define REMAP_NOTHING 1e-9

typedef struct remap_run {
    const remap_settings *settings;
    const char *path[2];
    remap_cells source, target;
    bool degrees;
    mw_remap remap;
} remap_run;

/* Both must have the same coordinate system; with degrees, areas are those of the sphere. */
static int remap_check_systems(remap_run *r)
{
    char names[2][CRS_NAME];
    const char *a = r->source.crs, *b = r->target.crs;
    bool quiet = r->settings->common->quiet;
    r->degrees = (a && crs_is_lonlat(a)) || (!a && b && crs_is_lonlat(b));
    if (a && b && !crs_same(a, b)) {
        complain("%s is in %s, but %s is in %s: transform one of them first", r->path[0],
                 crs_name(a, names[0]), r->path[1], crs_name(b, names[1]));
        return END_INPUT;
    }
    if (!a != !b && !quiet)
        complain("%s: warning: its coordinate system is not known, and %s is in %s: it is taken "
                 "to be the same",
                 r->path[a != NULL], r->path[a == NULL], crs_name(a ? a : b, names[0]));
    return 0;
}

/* Vertices at the seam have several copies. */
static int remap_check_cut(const remap_run *r)
{
    if (!r->settings->vertices || !r->source.cut) return 0;
    complain(
        "%s: crosses the meridian of 180 degrees, or a pole: --values vertices is not possible "
        "there, but --values faces is",
        r->path[0]);
    return END_INPUT;
}

static int remap_make(remap_run *r)
{
    mw_error error;
    mw_remap_mesh source = remap_cells_mesh(&r->source), target = remap_cells_mesh(&r->target);
    const mw_remap_options options = {.threads = r->settings->common->threads,
                                      .progress = progress_of_call(),
                                      .vertices = r->settings->vertices,
                                      .degrees = r->degrees,
                                      .covered = r->settings->covered};
    progress_phase("overlapping", r->path[0]);
    mw_status status =
        r->target.locator
            ? mw_remap_to_mesh(&source, &target, &options, &r->remap, &error)
            : mw_remap_to_pixels(&source, &r->target.pixels, &options, &r->remap, &error);
    if (status != MW_ERROR_INPUT) return status == MW_OK ? 0 : fail_query(&error);
    complain("%s, %s: %s", r->path[0], r->path[1], error.message);
    return END_INPUT;
}

static int remap_write(const remap_run *r)
{
    mw_error error;
    double *columns = remap_cells_places(&r->source, r->settings->vertices),
           *rows = remap_cells_places(&r->target, false);
    const mw_weight_positions positions = {.columns = columns,
                                           .rows = rows,
                                           .degrees = r->degrees,
                                           .column_areas = r->remap.source_area,
                                           .row_areas = r->remap.target_area,
                                           .column_fractions = r->remap.source_fraction,
                                           .row_fractions = r->remap.target_fraction,
                                           .method = "Conservative remapping"};
    const mw_file_options options = {.progress = progress_of_call()};
    const char *output = r->settings->common->output;
    int end = columns && rows ? 0 : fail_memory();
    progress_phase("writing", output);
    if (end == 0 &&
        mw_write_weights(output, r->remap.weights, &positions, &options, &error) != MW_OK)
        end = fail_writing(&error);
    free(columns);
    free(rows);
    return end;
}

static double remap_target_sum(const remap_run *r)
{
    mw_operator_info info;
    double sum = 0;
    mw_operator_describe(r->remap.weights, &info);
    for (uint32_t i = 0; i < info.rows; i++) sum += r->remap.target_area[i];
    return sum;
}

static int remap_report(const remap_run *r)
{
    mw_operator_info info;
    report p;
    mw_operator_describe(r->remap.weights, &info);
    report_begin(&p, r->settings->json);
    report_count(&p, r->settings->vertices ? "source_vertices" : "source_cells", info.columns);
    report_count(&p, "target_cells", info.rows);
    report_count(&p, "empty_cells", info.empty_rows);
    report_count(&p, "weights", info.entries);
    report_number(&p, "source_area", r->remap.source_sum);
    report_number(&p, "target_area", remap_target_sum(r));
    report_number(&p, "common_area", r->remap.common_sum);
    report_end(&p);
    return files_write_error_text(&p.text);
}

/* Part of the source is lost if the target does not cover it. */
static int remap_tell(const remap_run *r)
{
    int end = r->settings->stats ? remap_report(r) : 0;
    double whole = r->remap.source_sum, lost = whole - r->remap.common_sum;
    bool loses = lost > whole * REMAP_NOTHING;
    if (loses && !r->settings->common->quiet)
        complain("%s: remark: %.3g %% of its area lies outside %s: sums over it are not conserved",
                 r->path[0], 100 * lost / whole, r->path[1]);
    return end ? end : r->settings->strict && loses ? END_UNANSWERED : 0;
}

int remap_weights_run(const remap_settings *settings, const char *const *operands)
{
    remap_run r = {.settings = settings, .path = {operands[0], operands[1]}};
    int end = remap_cells_read(&r.source, operands[0], settings->crs, settings->common, false);
    if (end == 0)
        end = remap_cells_read(&r.target, operands[1], settings->grid_crs, settings->common, true);
    if (end == 0) end = remap_check_systems(&r);
    if (end == 0) end = remap_check_cut(&r);
    if (end == 0) end = remap_make(&r);
    if (end == 0) end = remap_write(&r);
    if (end == 0) end = remap_tell(&r);
    mw_remap_release(&r.remap);
    remap_cells_release(&r.source);
    remap_cells_release(&r.target);
    return end;
}
