/* prepare - a mesh that is ready for queries, in a file that is mapped. */
#include "cli/commands/commands.h"
#include "cli/frame/files.h"
#include "cli/frame/message.h"
#include "cli/frame/progress.h"
#include "cli/gdal/mesh_crs.h"
#include "cli/stream/extent_remark.h"

#include <stdlib.h>
#include <string.h>

typedef struct prepare_settings {
    common_settings common;
    const char *fields, *crs;
    bool border;
} prepare_settings;

static const option prepare_options[] = {
    {"border", 0, OPTION_FLAG, offsetof(prepare_settings, border), NULL,
     "keep the index of the border, which --tolerance, --outside and --details need", NULL},
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

static int prepare_write(const char *output, const mw_mesh_file *file, const mw_locator *locator)
{
    mw_error error;
    const mw_prepare_options options = {.values = file, .progress = progress_of_call()};
    progress_phase("writing", output);
    if (mw_write_prepared(locator, output, &options, &error) == MW_OK) return 0;
    return error.status == MW_ERROR_INPUT ? fail_reading(&error) : fail_writing(&error);
}

static int prepare_mesh(const prepare_settings *s, const char *path, const char *output,
                        const mw_mesh_file *file)
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
    if (end == 0) end = prepare_write(output, file, locator);
    mw_locator_destroy(locator);
    mw_mesh_destroy(mesh);
    return end;
}

static int prepare_file(const prepare_settings *s, const char *path, const char *output,
                        mw_mesh_file *file)
{
    char *crs = NULL;
    int end = prepare_choose_fields(s, path, file);
    if (end == 0) end = mesh_crs_settle(path, s->crs, file->crs, s->common.quiet, &crs);
    if (end) return end;
    free(file->crs);
    file->crs = crs;
    end = files_try_output(output, NULL);
    if (end) return end;
    return prepare_mesh(s, path, output, file);
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
    end = prepare_file(s, operands[0], s->common.output, &file);
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
        "'locate', 'sample' and 'weights' begin at once. '-' is standard input or output.",
    .options = tables,
    .essential = "border fields crs output threads",
    .settings_size = sizeof(prepare_settings),
    .run = prepare_run,
};
