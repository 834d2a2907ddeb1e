/* Meshes in files: choosing the reader or the writer. */
#include "base/options.h"
#include "base/posix.h"
#include "io/mesh/mesh_builder.h"
#include "io/formats/mesh_formats.h"
#include "io/layouts/layout_find.h"
#include "io/mesh/mesh_readers.h"
#include "io/mesh/node_ele.h"
#include "io/text/byte_source.h"
#include "io/text/file_head.h"

#include <inttypes.h>
#include <stdlib.h>
#include <string.h>

/* Read from a source. Its contents decide the format, or else its name. */
static mw_status mesh_read_source(mw_source *source, mw_mesh_builder *builder, mw_error *error)
{
    const char *head;
    size_t size;
    mw_status status = mw__source_peek(source, MW_HEAD_SIZE, &head, &size, error);
    if (status) return status;
    const mw_mesh_format *format = mw__mesh_format_of(source->path, head, size);
    if (format && format->read) return format->read(source, builder, error);
    char names[256];
    mw__mesh_format_list(false, names, sizeof names);
    return mw__fail(error, MW_ERROR_INPUT, "%.240s: this is not a mesh in a known format (%s)",
                    mw__source_name(source), names);
}

static mw_status mesh_read_path(const char *path, mw_mesh_builder *builder, mw_error *error)
{
    const mw_mesh_format *format = mw__mesh_format_by_path(path);
    if (format && format->read_path) return format->read_path(path, builder, error);
    mw_source source;
    mw_status status = mw__source_open(&source, path, error);
    bool pair = false;
    if (status == MW_ERROR_SYSTEM && mw__node_ele_exists(path, &pair, error) != MW_OK)
        return MW_ERROR_MEMORY;
    if (pair) return mw__read_node_ele(path, builder, error);
    if (status) return status;
    builder->source = &source;
    mw__source_watch(&source, builder->job);
    status = mesh_read_source(&source, builder, error);
    if (!status) status = mw__build_finish(builder, error);
    mw__source_close(&source);
    return status;
}

static mw_status mesh_read(const char *path, const char *layout, mw_job *job, mw_mesh_file *file,
                           mw_error *error)
{
    mw_mesh_builder builder;
    mw__build_start(&builder, file, NULL);
    builder.job = job;
    builder.layout = layout;
    mw__job_stage(job, "reading", 1);
    mw_status status = mesh_read_path(path, &builder, error);
    mw__build_release(&builder);
    return status;
}

mw_status mw_read_mesh(const char *path, const mw_file_options *options, mw_mesh_file *file,
                       mw_error *error)
{
    static const mw_file_options defaults;
    if (file) *file = (mw_mesh_file){0};
    if (!path || !file)
        return mw__fail(error, MW_ERROR_ARGUMENT, "mw_read_mesh: the path or the result is NULL");
    if (!options) options = &defaults;
    mw_status status = MW_RESERVED_CHECK(mw_file_options, options, error);
    if (!status) status = mw__layout_check(options->layout, error);
    if (status) return status;
    mw_job job = mw__job(1, options->progress);
    status = mw__job_end(&job, mesh_read(path, options->layout, &job, file, error), error);
    if (!status && !file->crs) status = mw_read_prj(path, &file->crs, error);
    if (status) mw_mesh_file_release(file);
    return status;
}

void mw_mesh_file_release(mw_mesh_file *file)
{
    if (!file) return;
    mw__fields_release(file->field_names, file->fields, file->field_count);
    mw__fields_release(file->triangle_field_names, file->triangle_fields,
                       file->triangle_field_count);
    for (size_t m = 0; m < file->mark_count; m++) free(file->mark_names[m]);
    free(file->mark_names);
    free(file->edges);
    free(file->points);
    free(file->triangles);
    free(file->faces);
    free(file->crs);
    free(file->repeat);
    *file = (mw_mesh_file){0};
}

mw_arrays mw_mesh_file_arrays(const mw_mesh_file *file)
{
    return (mw_arrays){.points = file->points,
                       .point_count = file->point_count,
                       .point_stride = 3,
                       .triangles = file->triangles,
                       .triangle_count = file->triangle_count,
                       .integer_type = MW_UINT32};
}

static mw_status mesh_writer_find(const char *path, const char *name, const mw_mesh_format **found,
                                  mw_error *error)
{
    const mw_mesh_format *format =
        name ? mw__mesh_format_by_name(name) : mw__mesh_format_by_path(path);
    *found = format;
    size_t length = strlen(path);
    char names[256];
    if (!format || !format->write) {
        mw__mesh_format_list(true, names, sizeof names);
        if (name)
            return mw__fail(error, MW_ERROR_ARGUMENT, "unknown mesh format '%.40s' (known: %s)",
                            name, names);
        return mw__fail(error, MW_ERROR_ARGUMENT,
                        "%.240s: no mesh format has this ending (known: %s)", path, names);
    }
    if (length > 3 && strcasecmp(path + length - 3, ".gz") == 0)
        return mw__fail(error, MW_ERROR_ARGUMENT, "%.240s: gzip is read, but not written", path);
    return MW_OK;
}

static mw_status mesh_check_vertices(const mw_mesh_file *file, mw_error *error)
{
    for (size_t t = 0; t < file->triangle_count; t++)
        for (int k = 0; k < 3; k++)
            if (file->triangles[3 * t + (size_t)k] >= file->point_count)
                return mw__fail_at(error, (int64_t)t, file->triangles[3 * t + (size_t)k],
                                   "triangle %zu names vertex %" PRIu32 ", which does not exist", t,
                                   file->triangles[3 * t + (size_t)k]);
    return MW_OK;
}

mw_status mw_write_mesh(const char *path, const mw_mesh_file *file, const char *name,
                        const mw_file_options *options, mw_error *error)
{
    static const mw_file_options defaults;
    const mw_mesh_format *format;
    if (!path || !file)
        return mw__fail(error, MW_ERROR_ARGUMENT, "mw_write_mesh: the path or the mesh is NULL");
    if (!options) options = &defaults;
    mw_status status = MW_RESERVED_CHECK(mw_file_options, options, error);
    if (!status) status = mesh_writer_find(path, name, &format, error);
    if (!status) status = mesh_check_vertices(file, error);
    if (status) return status;
    mw_job job = mw__job(1, options->progress);
    mw__job_stage(&job, "writing", 1);
    return mw__job_end(&job, format->write(path, file, &job, error), error);
}
