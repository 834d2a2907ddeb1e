#include "bench/data/dataset_file.h"
#include "cli/frame/files.h"
#include "cli/frame/message.h"
#include "cli/frame/progress.h"

#include <stdlib.h>
#include <string.h>

static bool dataset_grow(dataset *d, size_t count)
{
    if (count >= SIZE_MAX / (2 * sizeof(double))) return false;
    double *points = realloc(d->points, 2 * (count + 1) * sizeof(double));
    if (points) d->points = points;
    return points;
}

/* No reader of meshes knows the file, by its contents or its name; of other failures a reader
 * tells. */
static bool is_no_mesh(const mw_error *error)
{
    return error->status == MW_ERROR_INPUT &&
           strstr(error->message, ": this is not a mesh in a known format");
}

/* A mesh; *none is set if the file is not one. Returns 0 or an exit code. */
static int read_mesh_file(mw_mesh_file *file, const char *path, bool *none)
{
    mw_error error;
    *file = (mw_mesh_file){0};
    *none = files_is_standard(path);
    if (*none || mw_read_mesh(path, NULL, file, &error) == MW_OK) return 0;
    *none = is_no_mesh(&error);
    return *none ? 0 : fail_reading(&error);
}

/* The vertices of a mesh. */
static int dataset_read_vertices(dataset *d, const char *path, bool *none)
{
    mw_mesh_file file;
    int end = read_mesh_file(&file, path, none);
    if (end || *none) return end;
    bool room = dataset_grow(d, d->count + file.point_count);
    for (size_t i = 0; room && i < file.point_count; i++, d->count++)
        for (size_t k = 0; k < 2; k++) d->points[2 * d->count + k] = file.points[3 * i + k];
    mw_mesh_file_release(&file);
    return room ? 0 : fail_memory();
}

#define BLOCK ((size_t)1 << 14)

static int dataset_read_blocks(dataset *d, mw_point_reader *reader, double *values)
{
    mw_error error;
    size_t width = mw_point_reader_width(reader), room = d->count;
    for (size_t count = 1; count > 0;) {
        if (mw_point_reader_read(reader, values, BLOCK, &count, &error) != MW_OK)
            return fail_reading(&error);
        if (d->count + count > room && !dataset_grow(d, room = 2 * (d->count + count)))
            return fail_memory();
        for (size_t i = 0; i < count; i++, d->count++)
            for (size_t k = 0; k < 2; k++) d->points[2 * d->count + k] = values[i * width + k];
        progress_points(d->count, mw_point_reader_fraction(reader));
    }
    return 0;
}

static int dataset_read_points(dataset *d, const char *path)
{
    mw_error error;
    mw_point_reader *reader;
    if (mw_point_reader_open(path, NULL, &reader, &error) != MW_OK) return fail_reading(&error);
    double *values = malloc(BLOCK * mw_point_reader_width(reader) * sizeof *values);
    int end = values ? dataset_read_blocks(d, reader, values) : fail_memory();
    free(values);
    mw_point_reader_close(reader);
    return end;
}

int dataset_read(dataset *d, const char *path, bool enclose)
{
    *d = (dataset){0};
    progress_phase("reading", path);
    bool points;
    int end = dataset_read_vertices(d, path, &points);
    if (end == 0 && points) end = dataset_read_points(d, path);
    if (end) return end;
    if (!dataset_bound(d, d->count)) {
        complain("%s: the extent of the points is too large for a double", path);
        return END_INPUT;
    }
    if (!enclose || d->count == 0) return 0;
    if (!dataset_grow(d, d->count + 4)) return fail_memory();
    d->count += 4;
    dataset_enclose(d);
    return 0;
}

int dataset_read_mesh(dataset *d, mw_mesh_file *mesh, const char *path)
{
    bool points;
    *d = (dataset){0};
    progress_phase("reading", path);
    int end = read_mesh_file(mesh, path, &points);
    return end || !points ? end : dataset_read(d, path, false);
}
