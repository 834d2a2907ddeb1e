/* info - what kind of mesh a file holds. */
#include "cli/commands/commands.h"
#include "cli/frame/files.h"
#include "cli/frame/message.h"
#include "cli/frame/progress.h"
#include "cli/frame/report.h"
#include "cli/gdal/gdal_layers.h"
#include "cli/gdal/gdal_points.h"
#include "cli/input/mesh_space.h"

#include <math.h>

typedef struct info_settings {
    mesh_space_settings mesh;
    const char *layer;
} info_settings;

static const option info_options[] = {
    {"layer", 0, OPTION_TEXT, offsetof(info_settings, layer), "NAME",
     "of a vector file that GDAL reads: the layer to describe (default: the only one; several are "
     "listed)",
     NULL},
    {"json", 0, OPTION_FLAG, offsetof(info_settings, mesh.json), NULL, "print the report as JSON",
     NULL},
    {0},
};

/* Report numbers, or why one of them is unknown (NaN). */
static void info_report_known(report *r, const char *name, const double *values, size_t count,
                              const char *missing)
{
    for (size_t i = 0; i < count; i++)
        if (isnan(values[i])) {
            report_missing(r, name, missing);
            return;
        }
    report_numbers(r, name, values, count);
}

/* Report the range of z of a mesh in the plane. */
static void info_report_heights(report *r, const mw_mesh_file *file)
{
    bool heights = file->has_z && file->point_count > 0;
    report_flag(r, "heights", heights);
    if (heights) {
        double range[2] = {NAN, NAN};
        for (size_t i = 0; i < file->point_count; i++) {
            double z = file->points[3 * i + 2];
            if (!(z >= range[0])) range[0] = isnan(z) ? range[0] : z;
            if (!(z <= range[1])) range[1] = isnan(z) ? range[1] : z;
        }
        info_report_known(r, "height_range", range, 2, "none");
    }
}

static void info_report_file(report *r, const char *path, const mw_mesh_file *file, bool plane)
{
    report_string(r, "file", path);
    if (plane) info_report_heights(r, file);
    report_strings(r, "fields", file->field_names, file->field_count);
    if (file->crs)
        report_string(r, "crs", file->crs);
    else
        report_missing(r, "crs", "not known");
    report_count(r, "welded_vertices", file->welded);
}

static void info_report_mesh(report *r, const mw_mesh_info *info)
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
    info_report_known(r, "low", info->low, 2, "none");
    info_report_known(r, "high", info->high, 2, "none");
    report_number(r, "area", info->area);
    report_flag(r, "embedding", info->embedding);
    report_flag(r, "convex", info->convex);
    report_flag(r, "delaunay", info->delaunay);
}

static void info_report_surface(report *r, const mw_surface_info *info)
{
    report_count(r, "vertices", info->vertices);
    report_count(r, "unused_vertices", info->unused_vertices);
    report_count(r, "triangles", info->triangles);
    report_count(r, "flat_triangles", info->flat_triangles);
    report_flag(r, "oriented", info->oriented);
    report_count(r, "clashing_edges", info->clashing_edges);
    report_flag(r, "closed", info->closed);
    report_count(r, "border_edges", info->border_edges);
    report_count(r, "border_loops", info->border_loops);
    report_count(r, "pinched_vertices", info->pinched_vertices);
    report_count(r, "components", info->components);
    report_number(r, "euler", (double)info->euler);
    info_report_known(r, "low", info->low, 3, "none");
    info_report_known(r, "high", info->high, 3, "none");
    report_number(r, "area", info->area);
    info_report_known(r, "volume", &info->volume, 1, "none: not closed, or not oriented");
}

/* Report whether the surface is star-shaped about the centre, and if not, why. */
static int info_report_star(report *r, const mesh_space_settings *s, const char *path,
                            const mw_surface *surface)
{
    mw_error error;
    mw_star *star;
    mw_star_options options = {.centre = {s->centre.at[0], s->centre.at[1], s->centre.at[2]},
                               .threads = s->common.threads,
                               .progress = progress_of_call()};
    mw_status status = mw_star_create(surface, &options, &star, &error);
    if (status != MW_OK && status != MW_ERROR_INPUT) return fail_mesh(path, &error);
    report_numbers(r, "centre", s->centre.at, 3);
    report_flag(r, "star_shaped", status == MW_OK);
    if (status == MW_OK)
        report_missing(r, "why_not", "-");
    else
        report_string(r, "why_not", error.message);
    mw_star_destroy(star);
    return 0;
}

/* The next two functions fill the report. They return 0 or an exit code. */
static int info_describe_plane(report *r, const mesh_space_settings *s, const char *path,
                               const mw_mesh_file *file)
{
    mw_error error;
    mw_mesh *mesh;
    mw_mesh_info info;
    mw_arrays arrays = mw_mesh_file_arrays(file);
    mw_mesh_options options = {.tolerant = 1, /* a defect is described, not refused */
                               .threads = s->common.threads,
                               .progress = progress_of_call()};
    mw_check_options checks = {.threads = s->common.threads, .progress = progress_of_call()};
    if (mw_mesh_create(&arrays, &options, &mesh, &error) != MW_OK) return fail_mesh(path, &error);
    int end = mw_mesh_describe(mesh, &checks, &info, &error) == MW_OK ? 0 : fail_mesh(path, &error);
    if (end == 0) {
        info_report_file(r, path, file, true);
        info_report_mesh(r, &info);
        report_count(r, "memory_bytes", mw_mesh_bytes(mesh));
    }
    mw_mesh_destroy(mesh);
    return end;
}

static int info_describe_surface(report *r, const mesh_space_settings *s, const char *path,
                                 const mw_mesh_file *file)
{
    mw_error error;
    mw_surface *surface;
    mw_surface_info info;
    mw_arrays arrays = mw_mesh_file_arrays(file);
    mw_surface_options options = {
        .tolerant = 1, .weld = mesh_space_is_welded(s), .progress = progress_of_call()};
    if (mw_surface_create(&arrays, &options, &surface, &error) != MW_OK)
        return fail_mesh(path, &error);
    int end = mw_surface_describe(surface, &info, &error) == MW_OK ? 0 : fail_mesh(path, &error);
    if (end == 0) {
        info_report_file(r, path, file, false);
        info_report_surface(r, &info);
        if (s->space == SPACE_STAR) end = info_report_star(r, s, path, surface);
        report_count(r, "memory_bytes", mw_surface_bytes(surface));
    }
    mw_surface_destroy(surface);
    return end;
}

static int info_describe(const mesh_space_settings *s, const char *path, const mw_mesh_file *file)
{
    report r;
    progress_phase("describing", path);
    report_begin(&r, s->json);
    int end = s->space == SPACE_PLANE ? info_describe_plane(&r, s, path, file)
                                      : info_describe_surface(&r, s, path, file);
    report_end(&r);
    if (end == 0) return files_write_text(s->common.output, &r.text);
    text_release(&r.text);
    return end;
}

/* A vector file holds no mesh, but layers. */
static int info_describe_layers(const info_settings *s, const char *path)
{
    report r;
    int end = files_check_output(s->mesh.common.output, &path, 1);
    if (end) return end;
    report_begin(&r, s->mesh.json);
    end = gdal_layers_report(path, s->layer, &r);
    report_end(&r);
    if (end == 0) return files_write_text(s->mesh.common.output, &r.text);
    text_release(&r.text);
    return end;
}

static int info_run(const void *settings, const char *const *operands)
{
    const info_settings *s = settings;
    mw_mesh_file file = {0};
    if (gdal_points_known(operands[0])) return info_describe_layers(s, operands[0]);
    if (s->layer) {
        complain("option '--layer' is for vector files that GDAL reads, not for meshes");
        return END_USAGE;
    }
    int end = mesh_space_read(&s->mesh, operands, &file);
    if (end == 0) end = info_describe(&s->mesh, operands[0], &file);
    mw_mesh_file_release(&file);
    return end;
}

static const option *const tables[] = {mesh_space_options, info_options, common_options, NULL};

const command info_command = {
    .name = "info",
    .operands = "MESH",
    .operand_count = 1,
    .summary = "describe a mesh",
    .description = "Prints counts, extent, area, borders, holes, components and orientation of "
                   "MESH, whether it is an embedding, convex and Delaunay, and the memory it "
                   "takes. With --as, MESH is described as a surface in space, or as a polyhedron: "
                   "whether it is star-shaped about a centre. For a vector file that GDAL reads, "
                   "it lists the layers, or describes one of them. 'meshwalk check' lists the "
                   "defects of MESH, 'meshwalk view' shows them. '-' is standard input.",
    .options = tables,
    .essential = "as centre json output threads",
    .settings_size = sizeof(info_settings),
    .run = info_run,
};
