/* Constraints in files: telling the format. */
#include "base/options.h"
#include "io/constraints/geojson.h"
#include "io/constraints/poly.h"
#include "io/mesh/mesh_builder.h"
#include "io/text/file_head.h"
#include "io/text/number_text.h"

#include <stdlib.h>
#include <string.h>

typedef mw_status constraint_reader(mw_source *source, mw_constraint_builder *builder,
                                    mw_error *error);

/* Is the first line, comments passed over, the header of a .poly: a count, the dimension 2, and
 * up to two further integers? */
static bool head_is_poly(const char *p, const char *end)
{
    p = mw__head_skip_comments(p, end);
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
static mw_status constraint_reader_find(mw_source *source, constraint_reader **reader,
                                        mw_error *error)
{
    const char *head;
    size_t size;
    *reader = NULL;
    mw_status status = mw__source_peek(source, MW_HEAD_SIZE, &head, &size, error);
    if (status) return status;
    const char *end = head + size, *p = mw__head_skip_mark(head, end);
    const char *text = p;
    while (text < end && mw__is_space(*text)) text++;
    if (text < end && *text == '{')
        *reader = mw__read_geojson;
    else if (mw__path_ends(source->path, ".poly") || head_is_poly(p, end))
        *reader = mw__read_poly;
    return MW_OK;
}

static mw_status constraint_read_path(const char *path, mw_job *job, mw_constraint_file *file,
                                      mw_error *error)
{
    mw_source source;
    constraint_reader *reader;
    mw_constraint_builder builder = {.file = file, .source = &source};
    mw_status status = mw__source_open(&source, path, error);
    if (status) return status;
    mw__job_stage(job, "reading", 1);
    mw__source_watch(&source, job);
    status = constraint_reader_find(&source, &reader, error);
    if (!status)
        status = reader ? reader(&source, &builder, error)
                        : mw__fail(error, MW_ERROR_INPUT,
                                   "%.240s: constraints are read from GeoJSON and .poly files",
                                   mw__source_name(&source));
    mw__source_close(&source);
    return status;
}

mw_status mw_read_constraints(const char *path, const mw_file_options *options,
                              mw_constraint_file *file, mw_error *error)
{
    static const mw_file_options defaults;
    if (file) *file = (mw_constraint_file){0};
    if (!path || !file)
        return mw__fail(error, MW_ERROR_ARGUMENT,
                        "mw_read_constraints: the path or the result is NULL");
    if (!options) options = &defaults;
    mw_status status = MW_RESERVED_CHECK(mw_file_options, options, error);
    if (status) return status;
    mw_job job = mw__job(1, options->progress);
    status = mw__job_end(&job, constraint_read_path(path, &job, file, error), error);
    if (!status && !file->crs) status = mw_read_prj(path, &file->crs, error);
    if (status) mw_constraint_file_release(file);
    return status;
}

int mw_constraints_known(const char *path)
{
    mw_source source;
    constraint_reader *reader = NULL;
    if (!path || mw__source_open(&source, path, NULL) != MW_OK) return 0;
    bool found = constraint_reader_find(&source, &reader, NULL) == MW_OK && reader;
    mw__source_close(&source);
    return found && (reader != mw__read_geojson || mw__geojson_known());
}

void mw_constraint_file_release(mw_constraint_file *file)
{
    if (!file) return;
    mw__fields_release(file->field_names, file->fields, file->field_count);
    free(file->points);
    free(file->segments);
    free(file->polygon);
    free(file->record);
    free(file->hole_seeds);
    free(file->skipped);
    free(file->crs);
    *file = (mw_constraint_file){0};
}
