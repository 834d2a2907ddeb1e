/* Constraints in files: telling the format, and what the readers share. */
#include "io/constraints.h"

#include "io/builder.h"
#include "io/formats.h"
#include "io/number.h"

#include <inttypes.h>
#include <stdlib.h>
#include <string.h>

enum { HEAD = 4096 }; /* bytes looked at to tell the format */

/* Half as much again, at least 16. NULL: out of memory, and the array is as it was. */
static void *grown(void *array, size_t count, size_t *room, size_t size)
{
    size_t wanted = count < 16 ? 16 : count + count / 2;
    void *larger = mw__realloc(array, wanted, size);
    if (larger) *room = wanted;
    return larger;
}

static mw_status too_many(const mw_constraint_builder *builder, uint32_t limit, const char *what, mw_error *error)
{
    return mw__fail(error, MW_ERROR_LIMIT, "%.240s: more than %" PRIu32 " %s", mw__source_name(builder->source), limit,
                    what);
}

mw_status mw__constraint_point(mw_constraint_builder *builder, const double xyz[3], mw_error *error)
{
    mw_constraint_file *file = builder->file;
    if (file->point_count >= MW_MAX_VERTICES) return too_many(builder, MW_MAX_VERTICES, "points", error);
    if (file->point_count == builder->point_room) {
        double *points = grown(file->points, file->point_count, &builder->point_room, 3 * sizeof *points);
        if (!points) return mw__fail_memory(error);
        file->points = points;
    }
    memcpy(file->points + 3 * file->point_count++, xyz, 3 * sizeof *xyz);
    return MW_OK;
}

/* The three arrays of the segments have one room. */
static bool grow_segments(mw_constraint_builder *builder)
{
    mw_constraint_file *file = builder->file;
    size_t room = 0, count = file->segment_count;
    uint32_t *segments = grown(file->segments, count, &room, 2 * sizeof *segments);
    if (segments) file->segments = segments;
    uint32_t *polygon = segments ? grown(file->polygon, count, &room, sizeof *polygon) : NULL;
    if (polygon) file->polygon = polygon;
    uint32_t *place = polygon ? grown(file->record, count, &room, sizeof *place) : NULL;
    if (!place) return false;
    file->record = place;
    builder->segment_room = room;
    return true;
}

mw_status mw__constraint_segment(mw_constraint_builder *builder, uint32_t a, uint32_t b, uint32_t polygon,
                                 uint64_t place, mw_error *error)
{
    mw_constraint_file *file = builder->file;
    size_t i = file->segment_count;
    if (i >= MW_NONE) return too_many(builder, MW_NONE, "segments", error);
    if (i == builder->segment_room && !grow_segments(builder)) return mw__fail_memory(error);
    file->segments[2 * i] = a;
    file->segments[2 * i + 1] = b;
    file->polygon[i] = polygon;
    file->record[i] = place < UINT32_MAX ? (uint32_t)place : UINT32_MAX;
    file->segment_count++;
    return MW_OK;
}

mw_status mw__constraint_hole(mw_constraint_builder *builder, double x, double y, mw_error *error)
{
    mw_constraint_file *file = builder->file;
    if (file->hole_seed_count == builder->hole_room) {
        double *holes = grown(file->hole_seeds, file->hole_seed_count, &builder->hole_room, 2 * sizeof *holes);
        if (!holes) return mw__fail_memory(error);
        file->hole_seeds = holes;
    }
    file->hole_seeds[2 * file->hole_seed_count] = x;
    file->hole_seeds[2 * file->hole_seed_count + 1] = y;
    file->hole_seed_count++;
    return MW_OK;
}

typedef mw_status constraint_reader(mw_source *source, mw_constraint_builder *builder, mw_error *error);

static bool is_space(char c)
{
    return c == ' ' || (c >= '\t' && c <= '\r');
}

/* Is the first line, comments passed over, the header of a .poly: a count, the dimension 2, and up to two further
 * integers? */
static bool is_poly_header(const char *p, const char *end)
{
    while (p < end && (is_space(*p) || *p == '#')) {
        bool comment = *p == '#';
        do p++;
        while (comment && p < end && *p != '\n' && *p != '\r');
    }
    char line[64];
    size_t length = 0;
    while (p + length < end && !strchr("#\r\n", p[length])) {
        if (length + 1 == sizeof line) return false;
        line[length] = p[length];
        length++;
    }
    line[length] = 0;
    int64_t value = 0;
    int count = 0;
    const char *at = line;
    for (; *(at = mw__skip_blanks(at)); count++) {
        at = mw__read_integer(at, &value);
        if (!at || !mw__at_gap(at) || value < 0 || (count == 1 && value != 2)) return false;
    }
    return count >= 2 && count <= 4;
}

/* The reader that the contents call for, or else the name; NULL if none does. */
static mw_status find_reader(mw_source *source, constraint_reader **reader, mw_error *error)
{
    const char *head;
    size_t size;
    *reader = NULL;
    mw_status status = mw__source_peek(source, HEAD, &head, &size, error);
    if (status) return status;
    const char *p = head, *end = head + size;
    if (size >= 3 && memcmp(p, "\xef\xbb\xbf", 3) == 0) p += 3;
    const char *text = p;
    while (text < end && is_space(*text)) text++;
    if (text < end && *text == '{')
        *reader = mw__read_geojson;
    else if (mw__path_ends(source->path, ".poly") || is_poly_header(p, end))
        *reader = mw__read_poly;
    return MW_OK;
}

static mw_status read_path(const char *path, mw_constraint_file *file, mw_error *error)
{
    mw_source source;
    constraint_reader *reader;
    mw_constraint_builder builder = {.file = file, .source = &source};
    mw_status status = mw__source_open(&source, path, error);
    if (status) return status;
    status = find_reader(&source, &reader, error);
    if (!status)
        status = reader ? reader(&source, &builder, error)
                        : mw__fail(error, MW_ERROR_INPUT, "%.240s: constraints are read from GeoJSON and .poly files",
                                   mw__source_name(&source));
    mw__source_close(&source);
    return status;
}

mw_status mw_read_constraints(const char *path, mw_constraint_file *file, mw_error *error)
{
    if (file) *file = (mw_constraint_file){0};
    if (!path || !file) return mw__fail(error, MW_ERROR_ARGUMENT, "mw_read_constraints: NULL");
    mw_status status = read_path(path, file, error);
    if (status) mw_constraint_file_release(file);
    return status;
}

int mw_constraints_known(const char *path)
{
    mw_source source;
    constraint_reader *reader = NULL;
    if (!path || mw__source_open(&source, path, NULL) != MW_OK) return 0;
    bool found = find_reader(&source, &reader, NULL) == MW_OK && reader;
    mw__source_close(&source);
    return found && (reader != mw__read_geojson || mw__geojson_is_read());
}

void mw_constraint_file_release(mw_constraint_file *file)
{
    if (!file) return;
    mw__release_fields(file->field_names, file->fields, file->field_count);
    free(file->points);
    free(file->segments);
    free(file->polygon);
    free(file->record);
    free(file->hole_seeds);
    *file = (mw_constraint_file){0};
}
