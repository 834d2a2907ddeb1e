#include "io/grid/cell_builder.h"

#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Component `k` of `count` values of `width` components each. */
static mw_status cells_add_column(mw_cell_builder *cells, const char *name, const double *values,
                                  size_t count, size_t width, size_t k, mw_error *error)
{
    if (cells->value_count == MW_COLUMN_LIMIT)
        return mw__fail(error, MW_ERROR_LIMIT, "more than %d values per cell", MW_COLUMN_LIMIT);
    size_t n = cells->value_count + 1;
    char **names = mw__realloc(cells->names, n, sizeof *names);
    if (!names) return mw__fail_memory(error);
    cells->names = names;
    double **columns = mw__realloc(cells->values, n, sizeof *columns);
    if (!columns) return mw__fail_memory(error);
    cells->values = columns;
    names[n - 1] = strdup(name);
    columns[n - 1] = mw__alloc(count, sizeof **columns);
    cells->value_count = n;
    if (!names[n - 1] || !columns[n - 1]) return mw__fail_memory(error);
    for (size_t i = 0; i < count; i++) columns[n - 1][i] = values[i * width + k];
    return MW_OK;
}

mw_status mw__cells_add_values(mw_cell_builder *cells, mw_mesh_builder *builder, const char *name,
                               const double *values, size_t count, size_t width, bool of_cells,
                               mw_error *error)
{
    mw_status status = MW_OK;
    for (size_t k = 0; !status && k < width; k++) {
        char numbered[320];
        double *field;
        snprintf(numbered, sizeof numbered, "%s_%zu", name, k);
        const char *column = width > 1 ? numbered : name;
        if (of_cells) {
            status = cells_add_column(cells, column, values, count, width, k, error);
            continue;
        }
        status = mw__build_late_field(builder, column, &field, error);
        for (size_t i = 0; !status && i < count; i++) field[i] = values[i * width + k];
    }
    return status;
}

/* A strip makes a face of each of its triangles, every second one turned. */
static mw_status cells_build_strip(const int64_t *corner, size_t count, mw_mesh_builder *builder,
                                   mw_error *error)
{
    mw_status status = MW_OK;
    for (size_t i = 0; !status && i + 2 < count; i++) {
        mw__build_face(builder);
        status = mw__build_corner(builder, corner[i + i % 2], error);
        if (!status) status = mw__build_corner(builder, corner[i + 1 - i % 2], error);
        if (!status) status = mw__build_corner(builder, corner[i + 2], error);
        if (!status) status = mw__build_face_end(builder, error);
    }
    return status;
}

static mw_status cells_build_face(const int64_t *corner, size_t count, bool pixel,
                                  mw_mesh_builder *builder, mw_error *error)
{
    static const size_t order[] = {0, 1, 3, 2}; /* of a pixel */
    mw_status status = MW_OK;
    mw__build_face(builder);
    for (size_t k = 0; !status && k < count; k++)
        status = mw__build_corner(builder, corner[pixel ? order[k % 4] : k], error);
    return status ? status : mw__build_face_end(builder, error);
}

/* How many corners a cell of a type has; 0: any number. */
static size_t cells_corners(int64_t type)
{
    return type == MW_CELL_TRIANGLE ? 3 : type == MW_CELL_QUAD || type == MW_CELL_PIXEL ? 4 : 0;
}

static mw_status cells_build_cell(const mw_cell_builder *cells, size_t i, mw_mesh_builder *builder,
                                  mw_error *error)
{
    int64_t type = cells->types.values[i];
    int64_t begin = i > 0 ? cells->ends.values[i - 1] : 0, end = cells->ends.values[i];
    const int64_t *corner = begin < end ? cells->corners.values + begin : NULL;
    size_t count = (size_t)(end - begin), wanted = cells_corners(type);
    if (end < begin)
        return mw__source_fail(builder->source, error, "cell %zu ends before it begins", i);
    if (wanted && count != wanted)
        return mw__source_fail(builder->source, error,
                               "cell %zu of type %" PRId64 " has %zu corners", i, type, count);
    if (type == MW_CELL_STRIP) return cells_build_strip(corner, count, builder, error);
    if (type == MW_CELL_TRIANGLE || type == MW_CELL_POLYGON || type == MW_CELL_QUAD ||
        type == MW_CELL_PIXEL)
        return cells_build_face(corner, count, type == MW_CELL_PIXEL, builder, error);
    if (type > MW_CELL_LAST_LINEAR || type < 0)
        return mw__source_fail(builder->source, error,
                               "cell %zu: cells of type %" PRId64 " are not read, only linear ones",
                               i, type);
    return MW_OK;
}

/* The cell of each face: a strip has several, a line none. */
static mw_status cells_spread_values(const mw_cell_builder *cells, const size_t *face_ends,
                                     mw_mesh_builder *builder, mw_error *error)
{
    mw_status status = MW_OK;
    if (cells->value_count == 0) return MW_OK;
    double *of_faces = mw__alloc(builder->file->face_count, sizeof *of_faces);
    if (!of_faces) return mw__fail_memory(error);
    for (size_t f = 0; !status && f < cells->value_count; f++) {
        size_t face = 0;
        for (size_t i = 0; i < cells->ends.count; i++)
            while (face < face_ends[i]) of_faces[face++] = cells->values[f][i];
        status = mw__build_face_field(builder, cells->names[f], of_faces, error);
    }
    free(of_faces);
    return status;
}

mw_status mw__cells_finish(mw_cell_builder *cells, mw_mesh_builder *builder, mw_error *error)
{
    size_t count = cells->ends.count;
    int64_t volume = 0;
    if (cells->types.count != count)
        return mw__source_fail(builder->source, error, "the file has %zu cells, but types for %zu",
                               count, cells->types.count);
    size_t *face_ends = mw__alloc(count, sizeof *face_ends);
    if (!face_ends) return mw__fail_memory(error);
    mw_status status = MW_OK;
    for (size_t i = 0; !status && i < count; i++) {
        status = cells_build_cell(cells, i, builder, error);
        face_ends[i] = builder->file->face_count;
        if (cells->types.values[i] >= MW_CELL_FIRST_VOLUME) volume = cells->types.values[i];
    }
    if (!status && builder->file->face_count == 0 && volume)
        status = mw__source_fail(builder->source, error,
                                 "the file has no triangles, quadrilaterals or polygons, only "
                                 "volumes: cells of type %" PRId64,
                                 volume);
    if (!status) status = cells_spread_values(cells, face_ends, builder, error);
    free(face_ends);
    return status;
}

void mw__cells_release(mw_cell_builder *cells)
{
    mw__fields_release(cells->names, cells->values, cells->value_count);
    free(cells->corners.values);
    free(cells->ends.values);
    free(cells->types.values);
    *cells = (mw_cell_builder){0};
}
