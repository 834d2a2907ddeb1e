/* info - what kind of mesh a file holds. */
#include "commands.h"
#include "files.h"
#include "message.h"
#include "progress.h"
#include "report.h"

#include <math.h>

typedef struct info_settings {
    common_settings common;
    bool json;
} info_settings;

static const option info_options[] = {
    {"json", 0, OPTION_FLAG, offsetof(info_settings, json), NULL, "print the report as JSON", NULL},
    {0},
};

/* A pair that may not be known: NaN. */
static void report_range(report *r, const char *name, const double pair[2], const char *missing)
{
    if (isnan(pair[0]) || isnan(pair[1]))
        report_missing(r, name, missing);
    else
        report_pair(r, name, pair);
}

static void report_file(report *r, const char *path, const mw_mesh_file *file)
{
    report_string(r, "file", path);
    bool heights = file->has_z && file->point_count > 0;
    report_flag(r, "heights", heights);
    if (heights) {
        double range[2] = {NAN, NAN};
        for (size_t i = 0; i < file->point_count; i++) {
            double z = file->points[3 * i + 2];
            if (!(z >= range[0])) range[0] = isnan(z) ? range[0] : z;
            if (!(z <= range[1])) range[1] = isnan(z) ? range[1] : z;
        }
        report_range(r, "height_range", range, "none");
    }
    report_strings(r, "fields", file->field_names, file->field_count);
    report_count(r, "welded_vertices", file->welded);
}

static void report_mesh(report *r, const mw_mesh_info *info)
{
    report_count(r, "vertices", info->vertices);
    report_count(r, "unused_vertices", info->unused_vertices);
    report_count(r, "triangles", info->triangles);
    report_count(r, "flat_triangles", info->flat_triangles);
    report_count(r, "clockwise_triangles", info->clockwise_triangles);
    report_flag(r, "oriented", info->oriented);
    report_count(r, "clashing_edges", info->clashing_edges);
    report_count(r, "border_edges", info->border_edges);
    report_count(r, "border_loops", info->border_loops);
    report_count(r, "components", info->components);
    if (info->embedding)
        report_count(r, "holes", info->holes);
    else
        report_missing(r, "holes", "not known: no embedding");
    report_range(r, "low", info->low, "none");
    report_range(r, "high", info->high, "none");
    report_number(r, "area", info->area);
    report_flag(r, "embedding", info->embedding);
    report_flag(r, "convex", info->convex);
    report_flag(r, "delaunay", info->delaunay);
}

static int describe(const info_settings *s, const char *path, const mw_mesh_file *file)
{
    mw_error error;
    mw_mesh *mesh;
    mw_mesh_info info;
    report r;
    mw_arrays arrays = mw_mesh_file_arrays(file);
    mw_mesh_options options = {.tolerant = 1}; /* a defect is described, not refused */
    progress_phase("describing", path);
    if (mw_mesh_create(&arrays, &options, &mesh, &error) != MW_OK) return fail_mesh(path, &error);
    int end = 0;
    if (mw_mesh_describe(mesh, &info, &error) != MW_OK) {
        end = fail_mesh(path, &error);
    } else {
        report_begin(&r, s->json);
        report_file(&r, path, file);
        report_mesh(&r, &info);
        report_count(&r, "memory_bytes", mw_mesh_bytes(mesh));
        report_end(&r);
        end = files_write_text(s->common.output, &r.text);
    }
    mw_mesh_destroy(mesh);
    return end;
}

static int run(const void *settings, const char *const *operands)
{
    const info_settings *s = settings;
    mw_mesh_file file = {0};
    int end = files_check(s->common.output, operands, 1);
    if (end == 0) end = files_read_mesh(operands[0], &file);
    if (end == 0) end = describe(s, operands[0], &file);
    mw_mesh_file_release(&file);
    return end;
}

static const option *const tables[] = {info_options, common_options, NULL};

const command info_command = {
    .name = "info",
    .operands = "MESH",
    .operand_count = 1,
    .summary = "describe a mesh",
    .description = "Prints counts, extent, area, borders, holes, components and orientation of MESH, whether it is an "
                   "embedding, convex and Delaunay, and the memory it takes. '-' is standard input.",
    .options = tables,
    .settings_size = sizeof(info_settings),
    .run = run,
};
