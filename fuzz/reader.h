/* reader.h - what the fuzz targets of the readers share: a reader that takes the input must give a
 * sound mesh or sound points, one that refuses must leave nothing and say why. */
#ifndef MW_FUZZ_READER_H
#define MW_FUZZ_READER_H

#include "io/constraints/geojson.h"
#include "io/constraints/poly.h"
#include "io/mesh/mesh_builder.h"
#include "io/mesh/mesh_readers.h"
#include "io/mesh/node_ele.h"
#include "io/points/point_file.h"
#include "io/text/byte_source.h"

#include <stdlib.h>
#include <string.h>

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

static inline void require(bool right)
{
    if (!right) abort();
}

/* The status of a reader and its error agree, and the message has a text. */
static inline void require_error(mw_status status, const mw_error *error, const char *name)
{
    require(status == MW_ERROR_INPUT || status == MW_ERROR_LIMIT);
    require(error->status == status);
    require(strlen(error->message) > strlen(name) &&
            strlen(error->message) < sizeof error->message);
    require(strncmp(error->message, name, strlen(name)) == 0);
    for (const char *p = error->message; *p; p++) require((unsigned char)*p >= 0x20);
}

/* Look at all values, so that the sanitizers see it if some are not there. */
static inline void require_values(const double *values, size_t n)
{
    size_t numbers = 0;
    for (size_t i = 0; i < n; i++)
        numbers += values[i] <= 0 || values[i] > 0 || values[i] != values[i];
    require(numbers == n);
}

/* The mesh names only vertices that exist, and holds no more than the input can have announced. */
static inline void require_mesh(const mw_mesh_file *file, size_t size)
{
    require(file->point_count <= size && file->triangle_count <= size + 1 &&
            file->field_count <= MW_COLUMN_LIMIT);
    for (size_t i = 0; i < 3 * file->triangle_count; i++)
        require(file->triangles[i] < file->point_count);
    require(file->face_count <= file->triangle_count);
    for (size_t t = 0; file->faces && t < file->triangle_count; t++)
        require(file->faces[t] < file->face_count);
    require_values(file->points, 3 * file->point_count);
    for (size_t f = 0; f < file->field_count; f++)
        require_values(file->fields[f], file->point_count);
}

typedef mw_status mesh_reader(mw_source *source, mw_mesh_builder *builder, mw_error *error);

/* Run one reader on the input, of which it may make so many vertices, or one triangle more. */
static inline void fuzz_mesh_reader_to(mesh_reader *read, const char *name, const uint8_t *data,
                                       size_t size, size_t limit)
{
    mw_error error = {0};
    mw_source source;
    mw_mesh_file file;
    mw_mesh_builder builder;
    if (mw__source_memory(&source, name, data, size, &error) != MW_OK) return;
    mw__build_start(&builder, &file, &source);
    mw_status status = read(&source, &builder, &error);
    if (!status) status = mw__build_finish(&builder, &error);
    mw__build_release(&builder);
    if (status)
        require_error(status, &error, name);
    else
        require_mesh(&file, limit);
    mw_mesh_file_release(&file);
    mw__source_close(&source);
}

static inline void fuzz_mesh_reader(mesh_reader *read, const char *name, const uint8_t *data,
                                    size_t size)
{
    fuzz_mesh_reader_to(read, name, data, size, size);
}

/* Segments name points that exist and polygons below their number; nothing is there that the input
 * does not hold. */
static inline void require_constraints(const mw_constraint_file *file, size_t size)
{
    require(file->point_count <= size && file->segment_count <= size &&
            file->polygon_count <= size);
    require(file->hole_seed_count <= size && file->field_count <= MW_COLUMN_LIMIT &&
            file->record_name != NULL);
    for (size_t i = 0; i < file->segment_count; i++) {
        require(file->segments[2 * i] < file->point_count &&
                file->segments[2 * i + 1] < file->point_count);
        require(file->polygon[i] < file->polygon_count || file->polygon[i] == MW_NONE);
        require(file->record[i] <= size);
    }
    require_values(file->points, 3 * file->point_count);
    require_values(file->hole_seeds, 2 * file->hole_seed_count);
    for (size_t f = 0; f < file->field_count; f++)
        require_values(file->fields[f], file->point_count);
}

typedef mw_status constraint_reader(mw_source *source, mw_constraint_builder *builder,
                                    mw_error *error);

/* Run one reader of constraints on the input; its messages begin with `shown`. */
static inline void fuzz_constraints(constraint_reader *read, const char *name, const char *shown,
                                    const uint8_t *data, size_t size)
{
    mw_error error = {0};
    mw_source source;
    mw_constraint_file file = {0};
    mw_constraint_builder builder = {.file = &file, .source = &source};
    if (mw__source_memory(&source, name, data, size, &error) != MW_OK) return;
    mw_status status = read(&source, &builder, &error);
    if (status)
        require_error(status, &error, shown);
    else
        require_constraints(&file, size);
    mw_constraint_file_release(&file);
    mw__source_close(&source);
}

/* A reader with `table` that has chosen no columns reads the first ones. */
static inline mw_status fuzz_table(mw_point_reader *reader, mw_error *error)
{
    mw_point_table table;
    size_t columns[] = {1, 0};
    require(mw_point_reader_table(reader, &table, NULL) == MW_OK);
    require(table.column_count <= MW_COLUMN_LIMIT && strchr(",;\t", table.separator));
    for (size_t i = 0; table.names && i < table.column_count; i++) require(table.names[i] != NULL);
    require((table.names == NULL) == (table.header == NULL));
    if (mw_point_reader_width(reader) > 0 || table.column_count < 2) return MW_OK;
    return mw_point_reader_select(reader, columns, 2, error);
}

/* Run the reader of points that the contents choose. */
static inline void fuzz_points(const char *name, const mw_point_reader_options *options,
                               const uint8_t *data, size_t size)
{
    enum { BLOCK = 7 };
    mw_error error = {0};
    mw_source source;
    mw_point_reader *reader = NULL;
    if (mw__source_memory(&source, name, data, size, &error) != MW_OK) return;
    mw_status status = mw__point_reader_start(source, options, &reader, &error);
    if (!status) {
        if (options->table) require(fuzz_table(reader, &error) == MW_OK);
        size_t width = mw_point_reader_width(reader), count = BLOCK, total = 0;
        require((width >= 2 || options->table) && width <= MW_COLUMN_LIMIT);
        for (size_t i = 0; i < width; i++) require(mw_point_reader_column(reader, i) != NULL);
        double *values = malloc(BLOCK * (width + 1) * sizeof *values);
        require(values != NULL);
        while (!status && count > 0) {
            size_t length;
            status = mw_point_reader_read(reader, values, BLOCK, &count, &error);
            require(count <= BLOCK && (total += count) <= size);
            for (size_t i = 0; i < count; i++)
                require((mw_point_reader_row(reader, i, &length) != NULL) == (options->table != 0));
            require_values(values, count * width);
        }
        free(values);
    }
    mw_point_reader_close(reader);
    /* a column may turn out to be selected twice, by name and by number */
    if (status == MW_ERROR_ARGUMENT)
        require(options->columns != NULL);
    else if (status)
        require_error(status, &error, name);
}

#endif
