#include "cli/output/mesh_output.h"
#include "cli/frame/files.h"
#include "cli/frame/message.h"
#include "cli/frame/progress.h"
#include "cli/frame/signals.h"
#include "cli/output/prj_output.h"
#include "src/base/posix.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { FORMAT_BY_ENDING = 0 };

static const char *mesh_format_name(int i)
{
    return i == FORMAT_BY_ENDING ? "auto" : mw_mesh_format_name((size_t)i - 1);
}

const choices mesh_formats = {"format", mesh_format_name, NULL};

static bool mesh_output_is_packed(const char *output)
{
    size_t length = strlen(output);
    return length > 3 && strcasecmp(output + length - 3, ".gz") == 0;
}

static bool mesh_output_is_prepared(const char *output)
{
    const char *ending = strrchr(output, '.');
    return ending && strcasecmp(ending, ".mwm") == 0;
}

int mesh_output_check(const char *command_name, const char *output, int format)
{
    if (!output)
        complain("%s: -o MESH is missing: where should the mesh go?", command_name);
    else if (files_is_standard(output) && format == FORMAT_BY_ENDING)
        complain("%s: a mesh on standard output needs --format", command_name);
    else if (format == FORMAT_BY_ENDING && mesh_output_is_prepared(output))
        complain("%s: 'meshwalk prepare MESH -o %s' writes prepared meshes; here name another "
                 "ending, or a format with --format (off, ply, ...)",
                 output, output);
    else if (format == FORMAT_BY_ENDING && !mw_mesh_format_of_path(output))
        complain("%s: no mesh format has this ending; name one with --format (off, ply, ...)",
                 output);
    else if (mesh_output_is_packed(output))
        complain("%s: gzip is read, but not written; leave out .gz", output);
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

/* What a format has a place for. `field` and `triangle_field` are the only ones that it keeps;
 * NULL: it keeps all if `fields`, `triangle_fields` are set. `whole`: it keeps the triangle field
 * only if that has whole numbers. */
typedef struct format_places {
    const char *format, *field, *triangle_field, *second_triangle_field;
    bool fields, triangle_fields, whole, marks;
} format_places;

static const format_places *format_find_places(const char *format)
{
    static const format_places places[] = {
        {.format = "ply", .fields = true},
        {.format = "ply-ascii", .fields = true},
        {.format = "node", .fields = true},
        {.format = "netcdf", .fields = true, .triangle_fields = true},
        {.format = "csv", .fields = true},
        {.format = "vtk", .fields = true, .triangle_fields = true},
        {.format = "vtu", .fields = true, .triangle_fields = true},
        {.format = "fort.14", .field = "depth", .fields = true, .marks = true},
        {.format = "gr3", .field = "depth", .fields = true, .marks = true},
        {.format = "2dm",
         .field = "depth",
         .triangle_field = "material",
         .second_triangle_field = "physical",
         .fields = true,
         .triangle_fields = true},
        {.format = "msh",
         .triangle_field = "physical",
         .second_triangle_field = "material",
         .whole = true,
         .fields = true,
         .triangle_fields = true,
         .marks = true},
        {0},
    };
    const format_places *p = places;
    while (p->format && strcasecmp(p->format, format) != 0) p++;
    return p;
}

static size_t names_find(char *const *names, size_t count, const char *name)
{
    size_t i = 0;
    while (i < count && strcmp(names[i], name) != 0) i++;
    return i;
}

static bool names_hold(char *const *names, size_t count, const char *name)
{
    return names_find(names, count, name) < count;
}

/* Has the triangle field of that name, if there is one, whole numbers of 32 bits? */
static bool triangle_field_is_whole(const mw_mesh_file *file, const char *name)
{
    size_t f = names_find(file->triangle_field_names, file->triangle_field_count, name);
    if (f == file->triangle_field_count) return true;
    const double *values = file->triangle_fields[f];
    for (size_t t = 0; t < file->triangle_count; t++)
        if (!(fabs(values[t]) < 0x1p31 && values[t] == floor(values[t]))) return false;
    return true;
}

/* Warn of names that are lost: all but `kept`, NULL for none. */
static void warn_of_lost(const char *output, const char *format, const char *what,
                         char *const *names, size_t count, const char *kept, const char *better)
{
    text lost = {0};
    size_t n = 0;
    for (size_t i = 0; i < count; i++) {
        if (kept && strcmp(names[i], kept) == 0) continue;
        if (n < 8) text_printf(&lost, "%s%s", n ? ", " : "", names[i]);
        n++;
    }
    if (n > 8) text_printf(&lost, " and %zu more", n - 8);
    if (n > 0 && !lost.failed)
        complain("%s: warning: the format %s has no place for %s: %.*s %s not written; %s", output,
                 format, what, (int)lost.size, lost.bytes, n > 1 ? "are" : "is", better);
    text_release(&lost);
}

static void warn_of_fields(const char *output, const char *format, const format_places *p,
                           const mw_mesh_file *file)
{
    /* 2dm has one place, for heights or else for the depth */
    const char *kept = strcasecmp(format, "2dm") == 0 && file->has_z ? NULL : p->field;
    if (!p->fields || p->field)
        warn_of_lost(output, format, "fields", file->field_names, file->field_count, kept,
                     "ply, node and vtu have one");
    if (p->fields && p->field && file->has_z && strcasecmp(format, "2dm") != 0 &&
        names_hold(file->field_names, file->field_count, p->field))
        complain("%s: warning: the format %s has a place for heights or for the depth: the depth "
                 "is written, the heights are not",
                 output, format);
    const char *first = p->triangle_field;
    if (first && !names_hold(file->triangle_field_names, file->triangle_field_count, first))
        first = p->second_triangle_field;
    const bool some = !p->triangle_fields || first;
    if (first && p->whole && !triangle_field_is_whole(file, first)) first = NULL;
    if (some)
        warn_of_lost(output, format, "these values of triangles", file->triangle_field_names,
                     file->triangle_field_count, first, "vtu has one");
}

/* Boundaries of fort.14 whose vertices have further values, by the types of barriers. */
static bool mark_is_barrier(const char *mark)
{
    const char *word = strstr(mark, "type ");
    long type = word ? strtol(word + 5, NULL, 10) : 0;
    return strncmp(mark, "open", 4) != 0 && type > 0 && type < 30 && type % 10 >= 3 &&
           type % 10 <= 5;
}

static void warn_of_marks(const char *output, const char *format, const format_places *p,
                          const mw_mesh_file *file)
{
    bool land = p->marks && p->field; /* fort.14 and gr3 */
    if (!p->marks)
        warn_of_lost(output, format, "marked edges", file->mark_names, file->mark_count, NULL,
                     "fort.14, gr3 and msh have one");
    for (size_t m = 0; m < file->mark_count && land; m++) {
        if (!mark_is_barrier(file->mark_names[m])) continue;
        complain("%s: warning: barriers are not written, as their heights are not known: '%s'%s",
                 output, file->mark_names[m],
                 m + 1 < file->mark_count ? " and perhaps others" : "");
        return;
    }
}

void mesh_output_warn(const char *output, int format, const mw_mesh_file *file)
{
    const char *name =
        format == FORMAT_BY_ENDING ? mw_mesh_format_of_path(output) : mesh_format_name(format);
    const format_places *p = format_find_places(name);
    warn_of_fields(output, name, p, file);
    warn_of_marks(output, name, p, file);
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
