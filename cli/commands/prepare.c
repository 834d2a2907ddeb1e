/* prepare - a mesh that is ready for queries, in a file that is mapped, or in a folder of them. */
#include "cli/commands/commands.h"
#include "cli/frame/files.h"
#include "cli/frame/message.h"
#include "cli/frame/progress.h"
#include "cli/frame/signals.h"
#include "cli/gdal/mesh_crs.h"
#include "cli/stream/extent_remark.h"
#include "src/base/posix.h"

#include <stdlib.h>
#include <string.h>

typedef struct prepare_settings {
    common_settings common;
    const char *fields, *crs;
    uint32_t tiles; /* 0: one file */
    bool border;
} prepare_settings;

static const option prepare_options[] = {
    {"border", 0, OPTION_FLAG, offsetof(prepare_settings, border), NULL,
     "keep the index of the border, which --tolerance, --outside and --details need", NULL},
    {"tiles", 0, OPTION_COUNT, offsetof(prepare_settings, tiles), "N",
     "make a folder of N prepared files, with equally many triangles each, that are mapped one by "
     "one (meshwalk.Tiles in Python); with the index of the border (default: one file)",
     NULL},
    {"fields", 0, OPTION_TEXT, offsetof(prepare_settings, fields), "LIST",
     "the fields to keep, of vertices and of triangles, separated by commas; z are the heights; "
     "none "
     "keeps none (default: all)",
     NULL},
    {"crs", 0, OPTION_TEXT, offsetof(prepare_settings, crs), "CRS",
     "the coordinate system of MESH, as EPSG:2056 (default: what its file tells)", NULL},
    {0},
};

/* --- the fields that are kept ----------------------------------------------------------------- */

/* Is a name one of a list? */
static bool list_names(const char *list, const char *name)
{
    const size_t length = strlen(name);
    for (const char *p = list; p; p = strchr(p, ',')) {
        p += *p == ',';
        if (strcspn(p, ",") == length && strncmp(p, name, length) == 0) return true;
    }
    return false;
}

/* Release the fields that a list does not name. Returns how many are left. */
static size_t fields_keep(char **names, double **fields, size_t count, const char *list)
{
    size_t kept = 0;
    for (size_t i = 0; i < count; i++) {
        if (list_names(list, names[i])) {
            names[kept] = names[i];
            fields[kept++] = fields[i];
        } else {
            free(names[i]);
            free(fields[i]);
        }
    }
    return kept;
}

static bool file_has_field(const mw_mesh_file *file, const char *name)
{
    if (file->has_z && strcmp(name, "z") == 0) return true;
    for (size_t i = 0; i < file->field_count; i++)
        if (strcmp(file->field_names[i], name) == 0) return true;
    for (size_t i = 0; i < file->triangle_field_count; i++)
        if (strcmp(file->triangle_field_names[i], name) == 0) return true;
    return false;
}

/* Refuse a list with a name that no field has. */
static int fields_check(const char *list, const char *path, const mw_mesh_file *file)
{
    char name[256];
    for (const char *p = list; p; p = strchr(p, ',')) {
        p += *p == ',';
        const size_t length = strcspn(p, ",");
        if (length < sizeof name) {
            memcpy(name, p, length);
            name[length] = 0;
            if (file_has_field(file, name)) continue;
        }
        complain("%s: has no field '%.*s'", path, (int)length, p);
        return END_INPUT;
    }
    return 0;
}

static int prepare_choose_fields(const prepare_settings *s, const char *path, mw_mesh_file *file)
{
    const bool none = s->fields && strcmp(s->fields, "none") == 0;
    if (!s->fields) return 0;
    const char *list = none ? "" : s->fields;
    int end = none ? 0 : fields_check(list, path, file);
    if (end) return end;
    file->field_count = fields_keep(file->field_names, file->fields, file->field_count, list);
    file->triangle_field_count = fields_keep(file->triangle_field_names, file->triangle_fields,
                                             file->triangle_field_count, list);
    file->has_z = file->has_z && list_names(list, "z");
    return 0;
}

/* --- the file --------------------------------------------------------------------------------- */

static int prepare_fail_mesh(const char *path, const mw_error *error)
{
    int end = fail_mesh(path, error);
    if (end == END_INPUT)
        complain("'meshwalk check %s' lists every defect, 'meshwalk view' shows it; --fix mends "
                 "some",
                 path);
    return end;
}

/* The folder has a name of its own until it is complete: a signal waits until that is removed. */
static mw_status prepare_write_tiles(const prepare_settings *s, const mw_mesh_file *file,
                                     const mw_locator *locator, mw_error *error)
{
    const mw_tile_options options = {.tiles = s->tiles,
                                     .threads = s->common.threads,
                                     .values = file,
                                     .progress = progress_of_call()};
    signals_hold(true);
    mw_status status = mw_write_tiles(locator, s->common.output, &options, error);
    signals_hold(false);
    if (status == MW_CANCELLED) signals_await_end();
    return status;
}

static int prepare_write(const prepare_settings *s, const char *path, const mw_mesh_file *file,
                         const mw_locator *locator)
{
    mw_error error;
    const char *output = s->common.output;
    const mw_prepare_options options = {.values = file, .progress = progress_of_call()};
    progress_phase("writing", output);
    mw_status status = s->tiles ? prepare_write_tiles(s, file, locator, &error)
                                : mw_write_prepared(locator, output, &options, &error);
    if (status == MW_OK) return 0;
    if (status == MW_ERROR_INPUT && s->tiles) return fail_mesh(path, &error);
    return status == MW_ERROR_INPUT ? fail_reading(&error) : fail_writing(&error);
}

/* Check before long work that the output can be made. */
static int prepare_check_output(const prepare_settings *s)
{
    const char *output = s->common.output;
    if (s->tiles == 0) return files_try_output(output, NULL);
    if (files_is_standard(output)) {
        complain("prepare --tiles: needs -o FOLDER, not standard output");
        return END_USAGE;
    }
    if (access(output, F_OK) == 0) {
        complain("%s: exists already; remove it first", output);
        return END_RESOURCE;
    }
    return output[strlen(output) - 1] == '/' ? 0 : files_try_output(output, NULL);
}

static int prepare_mesh(const prepare_settings *s, const char *path, const mw_mesh_file *file)
{
    mw_error error;
    extent_box extent = {0};
    mw_mesh *mesh = NULL;
    mw_locator *locator = NULL;
    const mw_arrays arrays = mw_mesh_file_arrays(file);
    const mw_mesh_options meshes = {.threads = s->common.threads, .progress = progress_of_call()};
    const mw_locator_options locators = {.border = s->border,
                                         .fill = MW_FILL_YES,
                                         .threads = s->common.threads,
                                         .progress = progress_of_call()};
    progress_phase("preparing", path);
    int end = mw_mesh_create(&arrays, &meshes, &mesh, &error) == MW_OK &&
                      mw_locator_create(mesh, &locators, &locator, &error) == MW_OK
                  ? 0
                  : prepare_fail_mesh(path, &error);
    if (end == 0 && !s->common.quiet) {
        extent_add(&extent, file->points, file->point_count, 3);
        extent_warn_of_seam(path, &extent, mesh);
    }
    if (end == 0) end = prepare_write(s, path, file, locator);
    mw_locator_destroy(locator);
    mw_mesh_destroy(mesh);
    return end;
}

static int prepare_file(const prepare_settings *s, const char *path, mw_mesh_file *file)
{
    char *crs = NULL;
    int end = prepare_choose_fields(s, path, file);
    if (end == 0) end = mesh_crs_settle(path, s->crs, file->crs, s->common.quiet, &crs);
    if (end) return end;
    free(file->crs);
    file->crs = crs;
    end = prepare_check_output(s);
    return end ? end : prepare_mesh(s, path, file);
}

static int prepare_run(const void *settings, const char *const *operands)
{
    const prepare_settings *s = settings;
    mw_mesh_file file;
    if (!s->common.output) {
        complain("prepare: needs -o FILE, such as -o mesh.mwm");
        return END_USAGE;
    }
    int end = files_check_output(s->common.output, operands, 1);
    if (end == 0) end = files_read_mesh(operands[0], &file);
    if (end) return end;
    end = prepare_file(s, operands[0], &file);
    mw_mesh_file_release(&file);
    return end;
}

static const option *const tables[] = {prepare_options, common_options, NULL};

const command prepare_command = {
    .name = "prepare",
    .operands = "MESH",
    .operand_count = 1,
    .summary = "write a mesh that is ready for queries, to be mapped",
    .description =
        "Reads MESH, prepares it for queries, and writes all of that to the file of -o (.mwm): "
        "with fields, faces, marked edges and coordinate system. Each command takes this file in "
        "place of a mesh. Those that locate points map it: it is checked, and processes "
        "that use one file share one copy of it in memory. With --trust it is not checked, and "
        "'locate', 'sample' and 'weights' begin at once. '-' is standard input or output. With "
        "--tiles the mesh is cut into many such files, for machines with less memory than it "
        "takes.",
    .options = tables,
    .essential = "border tiles fields crs output",
    .settings_size = sizeof(prepare_settings),
    .run = prepare_run,
};
