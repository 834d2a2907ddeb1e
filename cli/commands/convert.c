/* convert - write a mesh in another format. */
#include "cli/commands/commands.h"
#include "cli/frame/files.h"
#include "cli/frame/message.h"
#include "cli/gdal/mesh_crs.h"
#include "cli/output/mesh_output.h"

#include <stdlib.h>

typedef struct convert_settings {
    common_settings common;
    const char *crs;
    int format; /* number of the name of --format */
} convert_settings;

static const option convert_options[] = {
    {"format", 0, OPTION_CHOICE, offsetof(convert_settings, format), "NAME",
     "the format of OUT (default: auto, by its ending):", &mesh_formats},
    {"crs", 0, OPTION_TEXT, offsetof(convert_settings, crs), "CRS",
     "the coordinate system of MESH, as EPSG:2056 (default: what its file tells)", NULL},
    {0},
};

/* The mesh gets the system of --crs, or else keeps its own. */
static int convert_settle_crs(const convert_settings *s, const char *path, mw_mesh_file *file)
{
    char *crs = NULL;
    int end = mesh_crs_settle(path, s->crs, file->crs, s->common.quiet, &crs);
    if (end) return end;
    free(file->crs);
    file->crs = crs;
    return 0;
}

static int convert_file(const convert_settings *s, const char *path, const char *output,
                        mw_mesh_file *file)
{
    bool temporary;
    int end = convert_settle_crs(s, path, file);
    if (end == 0) end = files_try_output(output, &temporary);
    if (end) return end;
    if (!s->common.quiet) {
        mesh_output_warn(output, s->format, file);
        if (file->step_count > 1)
            complain("%s: warning: has values at %zu times; only those of the first are written",
                     path, file->step_count);
    }
    return mesh_output_write(output, s->format, file, temporary, s->common.quiet);
}

static int convert_run(const void *settings, const char *const *operands)
{
    const convert_settings *s = settings;
    const char *output = operands[1] ? operands[1] : s->common.output;
    if (operands[1] && s->common.output) {
        complain("convert: two outputs, '%s' and -o %s", operands[1], s->common.output);
        return END_USAGE;
    }
    mw_mesh_file file;
    int end = mesh_output_check("convert", output, s->format);
    if (end == 0) end = files_check_output(output, operands, 1);
    if (end == 0) end = files_read_mesh(operands[0], &file);
    if (end) return end;
    end = convert_file(s, operands[0], output, &file);
    mw_mesh_file_release(&file);
    return end;
}

static const option *const tables[] = {convert_options, common_options, NULL};

const command convert_command = {
    .name = "convert",
    .operands = "MESH OUT",
    .operand_count = 2,
    .optional_operands = 1, /* with -o OUT */
    .summary = "write a mesh in another format",
    .description = "Reads MESH and writes it as OUT, in the format of its ending or of --format: "
                   "with its vertices, faces, heights and fields, its marked edges and its "
                   "coordinate system, as far as that format has a place for them; a warning names "
                   "those without a place. '-' is standard input or output.",
    .options = tables,
    .essential = "format crs layout output quiet",
    .settings_size = sizeof(convert_settings),
    .run = convert_run,
};
