#include "cli/frame/files.h"
#include "cli/frame/message.h"
#include "cli/frame/progress.h"
#include "src/base/posix.h"

#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

bool files_is_standard(const char *path)
{
    return !path || strcmp(path, "-") == 0;
}

/* One path may stand for several files: itself, and the two halves .node and .ele of a mesh. The
 * gzipped halves are read only, never written. */
enum { OUTPUT_FORM_COUNT = 3, FORM_COUNT = 5 };
static const char *const form_endings[FORM_COUNT] = {NULL, ".node", ".ele", ".node.gz", ".ele.gz"};

static bool file_form_name(const char *path, int form, char *name, size_t size)
{
    size_t stem = strlen(path);
    if (!form_endings[form]) return snprintf(name, size, "%s", path) < (int)size;
    for (int i = 1; i < FORM_COUNT; i++) {
        size_t end = strlen(form_endings[i]);
        if (stem > end && strcmp(path + stem - end, form_endings[i]) == 0) {
            stem -= end;
            break;
        }
    }
    return snprintf(name, size, "%.*s%s", (int)stem, path, form_endings[form]) < (int)size;
}

static bool file_form_stat(const char *path, bool output, int form, struct stat *s)
{
    char name[4096];
    if (files_is_standard(path))
        return form == 0 && fstat(output ? STDOUT_FILENO : STDIN_FILENO, s) == 0;
    return strlen(path) < sizeof name - 16 && file_form_name(path, form, name, sizeof name) &&
           stat(name, s) == 0;
}

/* A device or a pipe may be read and written at the same time, so only regular files count. */
static bool is_one_file(const struct stat *a, const struct stat *b)
{
    return S_ISREG(a->st_mode) && a->st_dev == b->st_dev && a->st_ino == b->st_ino;
}

static bool file_is_same(const char *output, const char *input)
{
    for (int i = 0; i < OUTPUT_FORM_COUNT; i++)
        for (int j = 0; j < FORM_COUNT; j++) {
            struct stat a, b;
            if (!file_form_stat(output, true, i, &a) || !file_form_stat(input, false, j, &b))
                continue;
            if (is_one_file(&a, &b)) return true;
        }
    return false;
}

int files_check_output(const char *output, const char *const *inputs, int count)
{
    int streams = 0;
    for (int i = 0; i < count; i++) {
        streams += files_is_standard(inputs[i]);
        if (!file_is_same(output, inputs[i])) continue;
        complain("%s: is both input and output: choose another output", inputs[i]);
        return END_USAGE;
    }
    if (streams <= 1) return 0;
    complain("standard input ('-') can be read only once");
    return END_USAGE;
}

/* Why answers are not written under an ending; endings are followed by a space. */
static const struct {
    const char *endings, *reason;
} refused_endings[] = {
    {".xlsx .xlsm .ods ", "a spreadsheet would be made in memory; each of them opens CSV"},
    {".tab .mif ", "MapInfo knows no missing numbers: a missing height would become 0"},
    {".gmt ", "this format loses quotes in texts"},
    {".gdb ", "this format rounds positions"},
    {".dxf .dgn .mvt .pbf .mbtiles .mapml ", "this format has no room for the columns"},
    {".kmz .zip .shz .gz ", "this format is packed; pack the file when it is complete"},
    {".dbf .xml .000 .x10 .gxt .itf .xtf .pix .fits .map .feather .arrow .pdf .png .jpg .svg .las "
     ".laz .nc .tif .h5 .mat .npy .npz .ply .off .obj .stl .vtk .vtu .msh .2dm .gr3 .slf ",
     "this format is for something else, or not known"},
};

/* Is the ending one of the list? */
static bool ending_is_listed(const char *ending, const char *list)
{
    size_t length = strlen(ending);
    for (const char *p = list; *p; p = strchr(p, ' ') + 1)
        if (strncasecmp(p, ending, length) == 0 && p[length] == ' ') return true;
    return false;
}

int files_check_text_output(const char *output)
{
    const char *ending = files_is_standard(output) ? NULL : strrchr(output, '.');
    if (!ending || ending == output || strchr(ending, '/')) return 0;
    for (size_t i = 0; i < sizeof refused_endings / sizeof *refused_endings; i++) {
        if (!ending_is_listed(ending, refused_endings[i].endings)) continue;
        complain("%s: answers are written as text (CSV), or by GDAL as .gpkg, .shp, .fgb, "
                 ".geojson, .kml or .gpx, but not as %s: %s",
                 output, ending, refused_endings[i].reason);
        return END_USAGE;
    }
    return 0;
}

static const char *name_in_directory(const char *path)
{
    const char *slash = strrchr(path, '/');
    return slash ? slash + 1 : path;
}

static bool stat_directory(const char *path, struct stat *s)
{
    char directory[4096];
    int length = (int)(name_in_directory(path) - path);
    if (strlen(path) >= sizeof directory) return false;
    snprintf(directory, sizeof directory, "%.*s", length ? length : 1, length ? path : ".");
    return stat(directory, s) == 0;
}

/* Of files that there are not yet. */
static bool is_one_name(const char *one, const char *other)
{
    struct stat a, b;
    return strcmp(name_in_directory(one), name_in_directory(other)) == 0 &&
           stat_directory(one, &a) && stat_directory(other, &b) && a.st_dev == b.st_dev &&
           a.st_ino == b.st_ino;
}

bool files_same_output(const char *one, const char *other)
{
    struct stat a, b;
    bool exists = file_form_stat(one, true, 0, &a);
    if (exists != file_form_stat(other, true, 0, &b)) return false;
    if (exists) return is_one_file(&a, &b);
    if (files_is_standard(one) || files_is_standard(other)) return false;
    char *names[2] = {NULL, NULL};
    bool same = mw_output_resolve(one, &names[0], NULL) == MW_OK &&
                mw_output_resolve(other, &names[1], NULL) == MW_OK &&
                is_one_name(names[0], names[1]);
    free(names[0]);
    free(names[1]);
    return same;
}

/* Can the file be read as points? */
static bool file_holds_points(const char *path)
{
    mw_point_reader *reader;
    if (mw_point_reader_open(path, NULL, &reader, NULL) != MW_OK) return false;
    size_t width = mw_point_reader_width(reader), count = 0;
    double *values = malloc(3 * width * sizeof *values);
    bool points =
        values && mw_point_reader_read(reader, values, 3, &count, NULL) == MW_OK && count > 0;
    free(values);
    mw_point_reader_close(reader);
    return points;
}

bool files_remark_raster(const char *path)
{
    static const char *const endings[] = {".tif", ".tiff", ".asc", ".img", ".vrt", ".dem", ".hgt"};
    const size_t length = strlen(path);
    for (size_t i = 0; i < sizeof endings / sizeof *endings; i++) {
        const size_t end = strlen(endings[i]);
        if (length <= end || strcasecmp(path + length - end, endings[i]) != 0) continue;
        complain("'meshwalk triangulate --from %s --tolerance Z -o MESH' makes a mesh of a raster",
                 path);
        return true;
    }
    return false;
}

/* A folder of 'meshwalk prepare --tiles'. */
static bool file_is_tiles(const char *path)
{
    char name[4096];
    struct stat s;
    return snprintf(name, sizeof name, "%s/tiles.json", path) < (int)sizeof name &&
           stat(name, &s) == 0;
}

static const char *files_layout;

void files_use_layout(const char *layout)
{
    files_layout = layout;
}

int files_read_mesh(const char *path, mw_mesh_file *file)
{
    mw_error error;
    progress_phase("reading", path);
    mw_status status = mw_read_mesh(
        path, &(mw_file_options){.progress = progress_of_call(), .layout = files_layout}, file,
        &error);
    if (status == MW_OK && file->repeat)
        message_note_place(path, file->repeat_triangle, file->repeat);
    if (status == MW_OK) return 0;
    int end = fail_reading(&error);
    if (files_is_standard(path)) return end;
    if (status == MW_ERROR_INPUT && !files_remark_raster(path) && file_holds_points(path))
        complain("%s: holds points, no triangles; 'meshwalk triangulate %s -o MESH' makes a mesh "
                 "of them",
                 path, path);
    if (file_is_tiles(path))
        complain("%s: holds a mesh in tiles, which meshwalk.Tiles of the Python module reads; give "
                 "this command the mesh in one file",
                 path);
    return end;
}

bool files_has_area(const mw_mesh_file *file)
{
    for (size_t t = 0; t < file->triangle_count; t++) {
        const double *p[3];
        bool finite = true;
        for (size_t k = 0; k < 3; k++) {
            p[k] = file->points + 3 * (size_t)file->triangles[3 * t + k];
            finite = finite && isfinite(p[k][0]) && isfinite(p[k][1]);
        }
        if (finite && mw_orient2d(p[0], p[1], p[2]) != 0) return true;
    }
    return false;
}

int files_try_output(const char *output, bool *temporary)
{
    mw_error error;
    mw_output *out;
    if (temporary) *temporary = false;
    if (files_is_standard(output)) return 0;
    if (mw_output_open(output, &out, &error) != MW_OK) return fail_writing(&error);
    if (temporary) *temporary = mw_output_temporary(out) != NULL;
    mw_output_close(out, 0, NULL);
    return 0;
}

int files_write_text(const char *output, text *t)
{
    mw_error error;
    mw_output *out;
    int end = 0;
    progress_end();
    if (t->failed) {
        end = fail_memory();
    } else if (mw_output_open(output ? output : "-", &out, &error) != MW_OK) {
        end = fail_writing(&error);
    } else {
        mw_output_write(out, t->bytes, t->size);
        if (mw_output_close(out, 1, &error) != MW_OK) end = fail_writing(&error);
    }
    text_release(t);
    return end;
}

int files_write_error_text(text *t)
{
    progress_end();
    int end = t->failed ? fail_memory() : 0;
    if (end == 0) fwrite(t->bytes, 1, t->size, stderr);
    text_release(t);
    return end;
}
