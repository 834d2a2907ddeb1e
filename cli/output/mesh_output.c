#include "cli/output/mesh_output.h"
#include "cli/frame/files.h"
#include "cli/frame/message.h"
#include "cli/frame/progress.h"
#include "cli/frame/signals.h"
#include "cli/output/prj_output.h"

#include <string.h>
#include <strings.h>

enum { FORMAT_BY_ENDING = 0 };

static const char *mesh_format_name(int i)
{
    return i == FORMAT_BY_ENDING ? "auto" : mw_mesh_format_name((size_t)i - 1);
}

const choices mesh_formats = {"format", mesh_format_name, NULL};

/* Is the ending the name of a format, or .ele, which belongs to the format node, or one of netcdf?
 */
static bool ending_is_known(const char *path)
{
    const char *ending = strrchr(path, '.');
    if (!ending) return false;
    const char *name;
    for (size_t i = 0; (name = mw_mesh_format_name(i)); i++)
        if (strcasecmp(ending + 1, name) == 0) return true;
    return strcasecmp(ending, ".ele") == 0 || strcasecmp(ending, ".nc") == 0 ||
           strcasecmp(ending, ".nc4") == 0;
}

int mesh_output_check(const char *command_name, const char *output, int format)
{
    if (!output)
        complain("%s: -o MESH is missing: where should the mesh go?", command_name);
    else if (files_is_standard(output) && format == FORMAT_BY_ENDING)
        complain("%s: a mesh on standard output wants --format", command_name);
    else if (format == FORMAT_BY_ENDING && !ending_is_known(output))
        complain("%s: no mesh format has this ending; name one with --format (off, ply, ...)",
                 output);
    else
        return 0;
    return END_USAGE;
}

bool mesh_output_is_node(const char *output, int format)
{
    if (format != FORMAT_BY_ENDING) return strcmp(mesh_format_name(format), "node") == 0;
    const char *ending = strrchr(output, '.');
    return ending && (strcasecmp(ending, ".node") == 0 || strcasecmp(ending, ".ele") == 0);
}

/* PLY and netCDF hold the coordinate system themselves. */
static bool mesh_output_holds_crs(const char *output, int format)
{
    static const char *const endings[] = {".ply", ".nc", ".nc4"};
    if (format != FORMAT_BY_ENDING)
        return strncmp(mesh_format_name(format), "ply", 3) == 0 ||
               strcmp(mesh_format_name(format), "netcdf") == 0;
    const char *ending = strrchr(output, '.');
    for (size_t i = 0; ending && i < sizeof endings / sizeof *endings; i++)
        if (strcasecmp(ending, endings[i]) == 0) return true;
    return false;
}

static bool format_holds_fields(const char *format)
{
    static const char *const names[] = {"ply",    "ply-ascii", "node", "ele",
                                        "netcdf", "nc",        "vtk",  "csv"};
    for (size_t i = 0; i < sizeof names / sizeof *names; i++)
        if (strcasecmp(format, names[i]) == 0) return true;
    return false;
}

void mesh_output_warn(const char *output, int format, const mw_mesh_file *file)
{
    const char *name =
        format == FORMAT_BY_ENDING ? strrchr(output, '.') + 1 : mesh_format_name(format);
    if (file->field_count == 0 || format_holds_fields(name)) return;
    complain("%s: warning: the format %s has no place for fields: %s%s%s not written; ply and node "
             "have one",
             output, name, file->field_names[0], file->field_count > 1 ? " and others" : "",
             file->field_count > 1 ? " are" : " is");
}

int mesh_output_write(const char *output, int format, const mw_mesh_file *file, bool temporary,
                      bool quiet)
{
    mw_error error;
    bool inside = mesh_output_holds_crs(output, format);
    int end = inside ? 0 : prj_output_check(output, file->crs, quiet);
    if (end) return end;
    progress_phase("writing", NULL);
    if (temporary) signals_hold(true);
    const mw_file_options watched = {.progress = progress_of_call()};
    mw_status status =
        mw_write_mesh(output, file, format == FORMAT_BY_ENDING ? NULL : mesh_format_name(format),
                      &watched, &error);
    if (temporary) signals_hold(false);
    if (status != MW_OK) return fail_writing(&error);
    return inside ? 0 : prj_output_write(output, file->crs, quiet);
}
