#include "io/layouts/netcdf_mesh.h"

#include "io/layouts/corner_table.h"
#include "io/mesh/weld.h"
#include "io/netcdf/netcdf_values.h"

#include <inttypes.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Parts of the time that reading takes, in percent. */
enum { POINTS_SHARE = 20, CORNERS_SHARE = 40, FACES_SHARE = 40 };

/* All values of a variable over the vertices. */
static mw_status netcdf_mesh_column(const mw_netcdf *file, const mw_netcdf_variable *variable,
                                    double **values, mw_error *error)
{
    *values = NULL;
    mw_status status = mw__netcdf_check_size(file, variable, error);
    if (status) return status;
    *values = mw__alloc(variable->lengths[0], sizeof **values);
    if (!*values) return mw__fail_memory(error);
    status = mw__netcdf_column(file, variable, *values, error);
    if (!status) return MW_OK;
    free(*values);
    *values = NULL;
    return status;
}

/* Half of pi rounded to a float is too large by 4e-8: such a latitude would lie beyond the pole. */
static void netcdf_mesh_clamp(double *latitudes, size_t count)
{
    const double rounded = 90 * (1 + 1e-7);
    for (size_t v = 0; v < count; v++) {
        double *y = latitudes + 3 * v;
        if (fabs(*y) > 90 && fabs(*y) <= rounded) *y = copysign(90, *y);
    }
}

static mw_status netcdf_mesh_points(const mw_netcdf *file, const mw_layout *layout,
                                    mw_mesh_builder *builder, mw_error *error)
{
    const mw_netcdf_variable *axes[] = {layout->x, layout->y, layout->z};
    size_t count = layout->x->lengths[0];
    if (count > MW_MAX_VERTICES)
        return mw__fail(error, MW_ERROR_LIMIT, "%.240s: more than %" PRIu32 " vertices",
                        mw__netcdf_name(file), MW_MAX_VERTICES);
    mw_status status = mw__netcdf_check_size(file, layout->x, error);
    if (status) return status;
    double *points = mw__calloc(count, 3 * sizeof *points);
    if (!points) return mw__fail_memory(error);
    builder->file->points = points;
    for (size_t k = 0; k < 3 && !status; k++) {
        double *values, offset = k < 2 ? layout->offset[k] : 0, scale = k < 2 ? layout->scale : 1;
        if (!axes[k]) continue;
        status = netcdf_mesh_column(file, axes[k], &values, error);
        for (size_t v = 0; v < count && !status; v++)
            points[3 * v + k] = offset == 0 ? values[v] * scale : values[v] * scale + offset;
        if (k == 1 && scale != 1) netcdf_mesh_clamp(points + 1, count);
        free(values);
    }
    builder->file->point_count = builder->point_room = count;
    builder->file->has_z = layout->z != NULL;
    builder->points_complete = true;
    return status;
}

/* Variables of numbers over the vertices alone become fields. */
static bool netcdf_mesh_is_field(const mw_layout *layout, const mw_netcdf_variable *variable)
{
    if (variable == layout->x || variable == layout->y || variable == layout->z) return false;
    return variable->rank == 1 && variable->dimensions[0] == layout->vertex_dimension &&
           variable->type != MW_NETCDF_CHAR && variable->type < MW_NETCDF_STRING;
}

static mw_status netcdf_mesh_fields(const mw_netcdf *file, const mw_layout *layout,
                                    mw_mesh_builder *builder, mw_error *error)
{
    mw_status status = MW_OK;
    for (size_t i = 0; i < mw__netcdf_variable_count(file) && !status; i++) {
        const mw_netcdf_variable *variable = mw__netcdf_variable_at(file, i);
        if (!netcdf_mesh_is_field(layout, variable)) continue;
        status = mw__build_field(builder, variable->name, error);
        if (!status)
            status = netcdf_mesh_column(
                file, variable, &builder->file->fields[builder->file->field_count - 1], error);
    }
    return status;
}

static mw_status netcdf_mesh_face(mw_mesh_builder *builder, const int32_t *corners, size_t width,
                                  int64_t first, mw_error *error)
{
    if (width == 3 || corners[3] == MW_NO_CORNER)
        return mw__build_triangle(builder, (uint32_t)(corners[0] - first),
                                  (uint32_t)(corners[1] - first), (uint32_t)(corners[2] - first),
                                  error);
    mw_status status = MW_OK;
    mw__build_face(builder);
    for (size_t k = 0; k < width && corners[k] != MW_NO_CORNER && !status; k++)
        status = mw__build_corner(builder, corners[k], error);
    return status ? status : mw__build_face_end(builder, error);
}

static mw_status netcdf_mesh_faces(const mw_netcdf *file, const mw_layout *layout,
                                   const mw_corner_table *table, mw_mesh_builder *builder,
                                   mw_error *error)
{
    enum { FACES_A_STEP = 1 << 14 };
    mw_status status = MW_OK;
    builder->first_number = table->first_number;
    for (size_t f = 0; f < table->face_count && !status; f++) {
        const int32_t *corners = table->corners + f * table->width;
        if (f % FACES_A_STEP == 0 && !mw__job_step(builder->job, f, table->face_count))
            return MW_ERROR_MEMORY;
        if (corners[2] != MW_NO_CORNER)
            status = netcdf_mesh_face(builder, corners, table->width, table->first_number, error);
        else if (!layout->open_dropped)
            status = mw__netcdf_fail(file, layout->corners, error,
                                     "face %" PRIu64 " has fewer than 3 corners",
                                     (uint64_t)f + (uint64_t)table->first_number);
    }
    return status;
}

/* Variables of real numbers over the faces alone become fields of their triangles; integers are
 * usually internal data of the model. */
static mw_status netcdf_mesh_face_fields(const mw_netcdf *file, const mw_layout *layout,
                                         mw_mesh_builder *builder, mw_error *error)
{
    mw_status status = MW_OK;
    for (size_t i = 0; i < mw__netcdf_variable_count(file) && !status; i++) {
        const mw_netcdf_variable *variable = mw__netcdf_variable_at(file, i);
        double *values;
        bool real = variable->type == MW_NETCDF_FLOAT || variable->type == MW_NETCDF_DOUBLE;
        if (variable->rank != 1 || variable->dimensions[0] != layout->face_dimension || !real)
            continue;
        status = netcdf_mesh_column(file, variable, &values, error);
        if (!status) status = mw__build_face_field(builder, variable->name, values, error);
        free(values);
    }
    return status;
}

/* Faces whose corners come as coordinates: equal ones are one vertex. */
static mw_status netcdf_mesh_weld(const mw_netcdf *file, const mw_layout *layout,
                                  mw_mesh_builder *builder, mw_weld *weld, mw_error *error)
{
    size_t width = layout->corner_count, count = layout->face_count * width;
    double *values[2] = {mw__alloc(count, sizeof(double)), mw__alloc(count, sizeof(double))};
    const mw_netcdf_variable *axes[] = {layout->x, layout->y};
    mw_status status = values[0] && values[1] ? MW_OK : mw__fail_memory(error);
    for (int k = 0; k < 2 && !status; k++)
        status =
            mw__netcdf_doubles(file, axes[k], (size_t[]){0, 0}, axes[k]->lengths, values[k], error);
    for (size_t f = 0; f < layout->face_count && !status; f++) {
        mw__build_face(builder);
        for (size_t k = 0; k < width && !status; k++) {
            size_t at = layout->corner_first ? k * layout->face_count + f : f * width + k;
            double xyz[3] = {values[0][at] * layout->scale, values[1][at] * layout->scale, 0};
            if (layout->scale != 1) netcdf_mesh_clamp(xyz + 1, 1);
            uint32_t vertex = 0;
            status = mw__weld_vertex(weld, builder, xyz, &vertex, error);
            if (!status) status = mw__build_corner(builder, vertex, error);
        }
        if (!status) status = mw__build_face_end(builder, error);
    }
    free(values[0]);
    free(values[1]);
    return status;
}

static mw_status netcdf_mesh_bounds(const mw_netcdf *file, const mw_layout *layout,
                                    mw_mesh_builder *builder, mw_error *error)
{
    mw_weld weld;
    mw_status status = mw__netcdf_check_size(file, layout->x, error);
    if (!status) status = mw__weld_start(&weld, error);
    if (status) return status;
    status = netcdf_mesh_weld(file, layout, builder, &weld, error);
    mw__weld_release(&weld);
    return status;
}

static mw_status netcdf_mesh_read(const mw_netcdf *file, const mw_layout *layout,
                                  mw_mesh_builder *builder, mw_error *error)
{
    mw_corner_table table;
    mw_job *job = builder->job;
    mw_status status = mw__layout_crs(file, layout, &builder->file->crs, error);
    if (status) return status;
    builder->lonlat = layout->lonlat;
    builder->corner_variable = (layout->corners ? layout->corners : layout->x)->name;
    if (!layout->corners) {
        status = netcdf_mesh_bounds(file, layout, builder, error);
        return status ? status : netcdf_mesh_face_fields(file, layout, builder, error);
    }
    status = netcdf_mesh_points(file, layout, builder, error);
    if (!status) status = netcdf_mesh_fields(file, layout, builder, error);
    if (status) return status;
    mw_job_span outer = mw__job_steps_of(job, POINTS_SHARE, CORNERS_SHARE, 100);
    status = mw__corner_table_read(file, layout, builder->file->point_count, job, &table, error);
    mw__job_steps_end(job, outer);
    if (status) return status;
    outer = mw__job_steps_of(job, POINTS_SHARE + CORNERS_SHARE, FACES_SHARE, 100);
    status = netcdf_mesh_faces(file, layout, &table, builder, error);
    mw__job_steps_end(job, outer);
    mw__corner_table_release(&table);
    return status ? status : netcdf_mesh_face_fields(file, layout, builder, error);
}

mw_status mw__read_netcdf(mw_source *source, mw_mesh_builder *builder, mw_error *error)
{
    mw_netcdf *file;
    void *memory;
    mw_layout layout;
    mw_job alone = {.threads = 1}, *job = builder->job;
    if (!job) builder->job = &alone;
    mw_status status = mw__netcdf_open_source(source, &file, &memory, error);
    source->placeless = true;
    if (!status) status = mw__layout_find(file, builder->layout, &layout, error);
    if (!status) status = netcdf_mesh_read(file, &layout, builder, error);
    builder->corner_variable = NULL;
    builder->job = job;
    mw__netcdf_close(file);
    free(memory);
    return status;
}
