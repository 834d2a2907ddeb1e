#include "cli/frame/files.h"
#include "cli/frame/message.h"
#include "cli/frame/progress.h"

#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

bool files_is_stream(const char *path)
{
    return !path || strcmp(path, "-") == 0;
}

/* The files a name can stand for: itself, and both halves of a .node/.ele pair; zipped ones are read, not written. */
enum { OUTPUT_FORM_COUNT = 3, FORM_COUNT = 5 };
static const char *const forms[FORM_COUNT] = {NULL, ".node", ".ele", ".node.gz", ".ele.gz"};

static bool form_of(const char *path, int form, char *name, size_t size)
{
    size_t stem = strlen(path);
    if (!forms[form]) return snprintf(name, size, "%s", path) < (int)size;
    for (int i = 1; i < FORM_COUNT; i++) {
        size_t end = strlen(forms[i]);
        if (stem > end && strcmp(path + stem - end, forms[i]) == 0) {
            stem -= end;
            break;
        }
    }
    return snprintf(name, size, "%.*s%s", (int)stem, path, forms[form]) < (int)size;
}

static bool stat_form(const char *path, bool output, int form, struct stat *s)
{
    char name[4096];
    if (files_is_stream(path)) return form == 0 && fstat(output ? STDOUT_FILENO : STDIN_FILENO, s) == 0;
    return strlen(path) < sizeof name - 16 && form_of(path, form, name, sizeof name) && stat(name, s) == 0;
}

/* Devices and pipes may well be read and written at a time. */
static bool is_one_file(const struct stat *a, const struct stat *b)
{
    return S_ISREG(a->st_mode) && a->st_dev == b->st_dev && a->st_ino == b->st_ino;
}

static bool same_file(const char *output, const char *input)
{
    for (int i = 0; i < OUTPUT_FORM_COUNT; i++)
        for (int j = 0; j < FORM_COUNT; j++) {
            struct stat a, b;
            if (!stat_form(output, true, i, &a) || !stat_form(input, false, j, &b)) continue;
            if (is_one_file(&a, &b)) return true;
        }
    return false;
}

int files_check(const char *output, const char *const *inputs, int count)
{
    int streams = 0;
    for (int i = 0; i < count; i++) {
        streams += files_is_stream(inputs[i]);
        if (!same_file(output, inputs[i])) continue;
        complain("%s: is input and output: choose another output", inputs[i]);
        return END_USAGE;
    }
    if (streams <= 1) return 0;
    complain("standard input ('-') can be read once only");
    return END_USAGE;
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

bool files_same_output(const char *one, const char *other)
{
    struct stat a, b;
    bool exists = stat_form(one, true, 0, &a);
    if (exists != stat_form(other, true, 0, &b)) return false;
    if (exists) return is_one_file(&a, &b);
    if (files_is_stream(one) || files_is_stream(other)) return false;
    return strcmp(name_in_directory(one), name_in_directory(other)) == 0 && stat_directory(one, &a) &&
           stat_directory(other, &b) && a.st_dev == b.st_dev && a.st_ino == b.st_ino;
}

/* Does the file read as points? */
static bool holds_points(const char *path)
{
    mw_point_reader *reader;
    if (mw_point_reader_open(path, NULL, &reader, NULL) != MW_OK) return false;
    size_t width = mw_point_reader_width(reader), count = 0;
    double *values = malloc(3 * width * sizeof *values);
    bool points = values && mw_point_reader_read(reader, values, 3, &count, NULL) == MW_OK && count > 0;
    free(values);
    mw_point_reader_close(reader);
    return points;
}

int files_read_mesh(const char *path, mw_mesh_file *file)
{
    mw_error error;
    progress_phase("reading", path);
    mw_status status = mw_read_mesh(path, file, &error);
    if (status == MW_OK) return 0;
    int end = fail_reading(&error);
    if (status == MW_ERROR_INPUT && !files_is_stream(path) && holds_points(path))
        complain("%s: holds points, no triangles; 'meshwalk triangulate %s -o MESH' makes a mesh of them", path, path);
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

int files_try_output(const char *output, bool *named)
{
    mw_error error;
    mw_output *out;
    if (named) *named = false;
    if (files_is_stream(output)) return 0;
    if (mw_output_open(output, &out, &error) != MW_OK) return fail_writing(&error);
    if (named) *named = mw_output_temporary(out) != NULL;
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
