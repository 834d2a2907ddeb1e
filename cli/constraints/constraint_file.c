#include "cli/constraints/constraint_file.h"
#include "cli/frame/files.h"
#include "cli/frame/message.h"
#include "cli/frame/progress.h"
#include "cli/gdal/gdal_library.h"
#include "src/base/posix.h"

#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static bool path_is_directory(const char *path)
{
    struct stat s;
    return stat(path, &s) == 0 && S_ISDIR(s.st_mode);
}

static int constraint_file_read_any(const char *path, const gdal_constraints_options *options,
                                    mw_constraint_file *file)
{
    mw_error error;
    progress_phase("reading", path);
    if (options->layer || options->values) return gdal_constraints_read(path, options, file);
    mw_status status =
        mw_read_constraints(path, &(mw_file_options){.progress = progress_of_call()}, file, &error);
    if (status == MW_OK) return 0;
    bool unknown =
        status == MW_ERROR_INPUT && !files_is_standard(path) && !mw_constraints_known(path);
    if (gdal_library_built() && (unknown || path_is_directory(path)))
        return gdal_constraints_read(path, options, file);
    int end = fail_reading(&error);
    if (unknown) complain("a program built with GDAL reads other vector files too");
    return end;
}

static void ring_complain(const char *path, const mw_constraint_file *file,
                          const mw_skipped_ring *ring, bool strict)
{
    complain("%s: %s%s %" PRIu32 ": ring %" PRIu32 " of polygon %" PRIu32
             " has fewer than three different points%s",
             path, strict ? "" : "warning: ", file->record_name, ring->record, ring->ring,
             ring->polygon,
             strict            ? ", which --strict refuses"
             : ring->ring == 0 ? ": the polygon is skipped"
                               : ": it is skipped");
}

/* Name the first ones, and count the others. */
static void rings_warn(const char *path, const mw_constraint_file *file)
{
    enum { NAMED = 10 };
    const size_t count = file->skipped_count, named = count <= NAMED ? count : NAMED;
    for (size_t i = 0; i < named; i++) ring_complain(path, file, &file->skipped[i], false);
    if (count > named)
        complain("%s: warning: %zu more such rings are skipped", path, count - named);
}

int constraint_file_read(const char *path, constraint_file_options options,
                         mw_constraint_file *file)
{
    int end = constraint_file_read_any(path, &options.gdal, file);
    if (end || file->skipped_count == 0) return end;
    if (!options.strict) {
        if (!options.quiet) rings_warn(path, file);
        return 0;
    }
    ring_complain(path, file, &file->skipped[0], true);
    mw_constraint_file_release(file);
    return END_INPUT;
}

bool constraint_file_is_poly(const mw_constraint_file *file)
{
    return strcmp(file->record_name, "line") == 0;
}

/* The length of a path without its ending, if that is one of these. */
static int path_stem_length(const char *path, const char *const *endings)
{
    size_t length = strlen(path);
    for (; *endings; endings++) {
        size_t end = strlen(*endings);
        if (length > end && strcasecmp(path + length - end, *endings) == 0)
            return (int)(length - end);
    }
    return (int)length;
}

static bool shares_node_file(const char *path, const char *output)
{
    static const char *const poly[] = {".poly", ".poly.gz", NULL}, *const node[] = {".node", ".ele",
                                                                                    NULL};
    char beside[4096], written[4096];
    int stem = path_stem_length(path, poly), size = sizeof written;
    if (stem == (int)strlen(path) || files_is_standard(output)) return false;
    return snprintf(beside, sizeof beside, "%.*s.node", stem, path) < size &&
           snprintf(written, sizeof written, "%.*s.node", path_stem_length(output, node), output) <
               size &&
           files_same_output(beside, written);
}

int constraint_file_check_output(const char *path, const char *output)
{
    if (!shares_node_file(path, output)) return 0;
    complain("%s: its points may be in the .node file that would be written: choose another output",
             path);
    return END_USAGE;
}

/* Where two segments cross, approximately. */
static void segments_crossing(const double *points, const uint32_t *one, const uint32_t *other,
                              double at[2])
{
    const double *a = points + 3 * (size_t)one[0], *b = points + 3 * (size_t)one[1];
    const double *c = points + 3 * (size_t)other[0], *d = points + 3 * (size_t)other[1];
    double far = mw_orient2d(c, d, b), near = mw_orient2d(c, d, a), t = near / (near - far);
    for (int k = 0; k < 2; k++) at[k] = isfinite(t) ? a[k] + t * (b[k] - a[k]) : a[k];
}

int constraint_file_fail_crossing(const char *path, const mw_constraint_file *file,
                                  const double *points, const uint32_t cross[2], bool split)
{
    const char *what = file->record_name;
    uint32_t one = file->record[cross[0]], other = file->record[cross[1]];
    double at[2];
    char second[64];
    segments_crossing(points, file->segments + 2 * (size_t)cross[0],
                      file->segments + 2 * (size_t)cross[1], at);
    if (one == other)
        snprintf(second, sizeof second, "itself");
    else
        snprintf(second, sizeof second, "%s %" PRIu32, what, other);
    complain("%s: %s %" PRIu32 " crosses %s near %.9g %.9g; %s", path, what, one, second, at[0],
             at[1],
             split ? "others are so close there that rounded points cannot keep them apart"
                   : "--split puts a vertex there");
    return END_INPUT;
}

/* --- joining --- */

/* Append `more` items to an array of `count`. */
static bool array_append(void *array, size_t count, const void *items, size_t more, size_t size)
{
    void **begin = array;
    char *longer = realloc(*begin, (count + more + 1) * size);
    if (!longer) return false;
    if (more > 0) memcpy(longer + count * size, items, more * size);
    *begin = longer;
    return true;
}

/* The points of the boundary have no attributes: NaN. */
static bool fields_extend(mw_constraint_file *c, size_t more)
{
    for (size_t f = 0; f < c->field_count; f++) {
        double *longer = realloc(c->fields[f], (c->point_count + more + 1) * sizeof *longer);
        if (!longer) return false;
        c->fields[f] = longer;
        for (size_t i = 0; i < more; i++) longer[c->point_count + i] = NAN;
    }
    return true;
}

static bool segments_append(mw_constraint_file *c, const mw_constraint_file *b)
{
    size_t count = c->segment_count, more = b->segment_count;
    for (size_t i = 0; i < count; i++) c->polygon[i] = MW_NONE;
    if (!array_append(&c->segments, 2 * count, b->segments, 2 * more, sizeof *c->segments) ||
        !array_append(&c->polygon, count, b->polygon, more, sizeof *c->polygon) ||
        !array_append(&c->record, count, b->record, more, sizeof *c->record))
        return false;
    for (size_t i = 2 * count; i < 2 * (count + more); i++)
        c->segments[i] += (uint32_t)c->point_count;
    c->segment_count = count + more;
    return true;
}

int constraint_file_join(mw_constraint_file *constraints, const mw_constraint_file *boundary)
{
    mw_constraint_file *c = constraints;
    if (c->point_count + boundary->point_count > MW_MAX_VERTICES) {
        complain("more than %u vertices", (unsigned)MW_MAX_VERTICES);
        return END_RESOURCE;
    }
    if (!segments_append(c, boundary) || !fields_extend(c, boundary->point_count) ||
        !array_append(&c->points, 3 * c->point_count, boundary->points, 3 * boundary->point_count,
                      sizeof(double)) ||
        !array_append(&c->hole_seeds, 2 * c->hole_seed_count, boundary->hole_seeds,
                      2 * boundary->hole_seed_count, sizeof(double)))
        return fail_memory();
    c->point_count += boundary->point_count;
    c->hole_seed_count += boundary->hole_seed_count;
    c->polygon_count = boundary->polygon_count;
    c->has_z = c->has_z || boundary->has_z;
    return 0;
}
