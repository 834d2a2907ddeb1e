#include "cli/remesh/remeshed_star.h"
#include "cli/frame/files.h"
#include "cli/frame/message.h"
#include "cli/frame/progress.h"
#include "cli/input/nodata.h"
#include "cli/input/star_input.h"
#include "cli/output/mesh_output.h"
#include "cli/remesh/deviation_report.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* What the call works on. */
typedef struct remeshing {
    const remesh_settings *settings;
    const common_settings *common;
    star_input_settings how;
    const char *path;
    nodata_rule nodata;
    uint32_t level;
    mw_mesh_file given, made;
    star_input star;
    mw_location *at; /* of each vertex that is made */
} remeshing;

/* --- what is asked for --- */

static int remeshing_parse_level(remeshing *r)
{
    char *stop;
    const char *level = r->settings->level;
    if (!level) return 0;
    const unsigned long value = strtoul(level, &stop, 10);
    if (level[0] < '0' || level[0] > '9' || *stop || value > MW_ICOSPHERE_MAX_LEVEL) {
        complain("option '--remesh' must be a number from 0 to %d, not '%.60s'",
                 MW_ICOSPHERE_MAX_LEVEL, level);
        return END_USAGE;
    }
    r->level = (uint32_t)value;
    return 0;
}

static int remeshing_check(remeshing *r)
{
    const remesh_settings *s = r->settings;
    const char *inputs[2] = {r->path, s->onto};
    if (s->level && s->onto) {
        complain("star: --remesh LEVEL or --onto MESH, not both");
        return END_USAGE;
    }
    int end = remeshing_parse_level(r);
    if (end == 0) end = mesh_output_check("star", r->common->output, s->format);
    if (end == 0) end = files_check_output(r->common->output, inputs, s->onto ? 2 : 1);
    return end ? end : nodata_parse("nodata", s->nodata, &r->nodata);
}

/* --- vertices and triangles --- */

/* Room for the vertices and triangles of `made`, and for locations. */
static int remeshing_allocate(remeshing *r, size_t points, size_t triangles)
{
    mw_mesh_file *made = &r->made;
    made->points = malloc(3 * points * sizeof *made->points + 1);
    made->triangles = malloc(3 * triangles * sizeof *made->triangles + 1);
    r->at = malloc(points * sizeof *r->at + 1);
    made->point_count = points;
    made->triangle_count = triangles;
    made->has_z = 1;
    return made->points && made->triangles && r->at ? 0 : fail_memory();
}

static int remeshing_make_icosphere(remeshing *r)
{
    uint32_t points, triangles;
    mw_error error;
    const mw_remesh_options options = {.threads = r->common->threads,
                                       .progress = progress_of_call()};
    mw_icosphere_size(r->level, &points, &triangles, &error);
    int end = remeshing_allocate(r, points, triangles);
    if (end) return end;
    progress_phase("remeshing", r->path);
    return mw_star_remesh(r->star.star, r->level, &options, r->made.points, r->made.triangles,
                          r->at, &error) == MW_OK
               ? 0
               : fail_query(&error);
}

/* A vertex that no triangle has may be no point of a ray: it stays where it is. */
static void remeshing_keep_unused(remeshing *r, const mw_mesh_file *other)
{
    for (size_t v = 0; v < other->point_count; v++)
        if (r->at[v].triangle == MW_NONE)
            memcpy(r->made.points + 3 * v, other->points + 3 * v, 3 * sizeof *other->points);
}

static int remeshing_project(remeshing *r, const mw_mesh_file *other)
{
    mw_error error;
    const mw_star_query_options options = {.threads = r->common->threads,
                                           .progress = progress_of_call()};
    int end = remeshing_allocate(r, other->point_count, other->triangle_count);
    if (end) return end;
    memcpy(r->made.triangles, other->triangles, 3 * other->triangle_count * sizeof(uint32_t));
    progress_phase("remeshing", r->path);
    if (mw_star_project_batch(r->star.star, other->points, other->point_count, 3, &options,
                              r->made.points, r->at, &error) != MW_OK)
        return fail_query(&error);
    remeshing_keep_unused(r, other);
    return 0;
}

/* Warn about the fields of OTHER, which the result does not have. */
static void remeshing_warn_of_other(const remeshing *r, const mw_mesh_file *other)
{
    const size_t n = other->field_count + other->triangle_field_count;
    if (n > 0 && !r->common->quiet)
        complain("%s: warning: its %s not written: the values are those of %s", r->settings->onto,
                 n > 1 ? "fields are" : "field is", r->path);
}

/* OTHER must be star-shaped about the same centre, or its triangles would lie over each other. */
static int remeshing_make_onto(remeshing *r)
{
    mw_mesh_file other;
    star_input check = {0};
    int end = files_read_mesh(r->settings->onto, &other);
    if (end) return end;
    end = star_input_make(&check, r->settings->onto, &other, &r->how);
    star_input_release(&check);
    if (end == 0) end = remeshing_project(r, &other);
    if (end == 0) remeshing_warn_of_other(r, &other);
    mw_mesh_file_release(&other);
    return end;
}

/* --- values --- */

static char *name_copy(const char *name)
{
    const size_t size = strlen(name) + 1;
    char *copy = malloc(size);
    return copy ? memcpy(copy, name, size) : NULL;
}

/* Field i of the polyhedron at each vertex that is made. */
static int remeshing_carry_field(remeshing *r, const mw_operator *weights, size_t i)
{
    mw_error error;
    mw_mesh_file *made = &r->made;
    const char *name = r->given.field_names[i];
    double *values = nodata_copy(r->given.fields[i], 1, r->given.point_count, &r->nodata, r->path,
                                 name, r->common->quiet);
    const mw_value_table table = {.values = values, .count = 1};
    const mw_operator_apply_options options = {.threads = r->common->threads,
                                               .progress = progress_of_call()};
    made->fields[i] = malloc(made->point_count * sizeof **made->fields + 1);
    made->field_names[i] = name_copy(name);
    made->field_count = i + 1;
    int end = values && made->fields[i] && made->field_names[i] ? 0 : fail_memory();
    if (end == 0 && mw_operator_apply(weights, &table, &options, made->fields[i], &error) != MW_OK)
        end = fail_query(&error);
    free(values);
    return end;
}

static void remeshing_warn_of_given(const remeshing *r)
{
    const mw_mesh_file *g = &r->given;
    if (r->common->quiet) return;
    if (g->step_count > 1)
        complain("%s: warning: has values at %zu times; only those of the first are written",
                 r->path, g->step_count);
    if (g->triangle_field_count)
        complain("%s: warning: values of triangles are not written, '%s'%s: the triangles are new "
                 "ones",
                 r->path, g->triangle_field_names[0],
                 g->triangle_field_count > 1 ? " and others" : "");
    if (g->mark_count)
        complain("%s: warning: marked edges are not written: the edges are new ones", r->path);
}

static int remeshing_carry_fields(remeshing *r)
{
    mw_error error;
    mw_operator *weights;
    const size_t count = r->given.field_count;
    const mw_hits hits = mw_hits_of_locations(r->at, r->made.point_count);
    const mw_operator_options options = {.threads = r->common->threads,
                                         .progress = progress_of_call()};
    remeshing_warn_of_given(r);
    if (count == 0) return 0;
    r->made.fields = calloc(count, sizeof *r->made.fields);
    r->made.field_names = calloc(count, sizeof *r->made.field_names);
    if (!r->made.fields || !r->made.field_names) return fail_memory();
    progress_phase("interpolating", r->path);
    if (mw_operator_create_on_surface(r->star.surface, &hits, &options, &weights, &error) != MW_OK)
        return fail_query(&error);
    int end = 0;
    for (size_t i = 0; i < count && end == 0; i++) end = remeshing_carry_field(r, weights, i);
    mw_operator_destroy(weights);
    return end;
}

/* --- the result --- */

/* A mesh whose facets are hardly wider than rounding may fold. Returns 0, or an exit code. */
static int remeshing_check_result(const remeshing *r, const mw_surface *surface)
{
    mw_error error;
    mw_star *star;
    const double *c = r->how.centre->at;
    const mw_star_options options = {.centre = {c[0], c[1], c[2]},
                                     .threads = r->common->threads,
                                     .progress = progress_of_call()};
    mw_status status = mw_star_create(surface, &options, &star, &error);
    if (status == MW_OK) mw_star_destroy(star);
    if (status == MW_ERROR_INPUT && !r->common->quiet)
        complain("%s: warning: rounding folds it, so that it is not star-shaped: %s",
                 r->common->output, error.message);
    return status == MW_OK || status == MW_ERROR_INPUT ? 0 : fail_query(&error);
}

/* Check the result, and measure it if that is asked for. */
static int remeshing_judge(const remeshing *r)
{
    mw_error error;
    mw_surface *surface;
    const mw_arrays arrays = mw_mesh_file_arrays(&r->made);
    const mw_surface_options options = {.weld = 1, .progress = progress_of_call()};
    if (mw_surface_create(&arrays, &options, &surface, &error) != MW_OK) return fail_query(&error);
    int end = remeshing_check_result(r, surface);
    if (end == 0 && r->settings->deviation)
        end = deviation_report_print(r->star.surface, surface, r->common, r->settings->json);
    mw_surface_destroy(surface);
    return end;
}

static int remeshing_write(remeshing *r)
{
    bool temporary;
    const char *output = r->common->output;
    int end = files_try_output(output, &temporary);
    if (end) return end;
    if (!r->common->quiet) mesh_output_warn(output, r->settings->format, &r->made);
    return mesh_output_write(output, r->settings->format, &r->made, temporary, r->common->quiet);
}

/* A system of longitudes and latitudes is not that of points on a sphere. */
static void remeshing_take_crs(remeshing *r, bool onto_sphere)
{
    if (onto_sphere) return;
    r->made.crs = r->given.crs;
    r->given.crs = NULL;
}

int remeshed_star_run(const remesh_settings *s, const common_settings *common,
                      const coordinates *centre, bool lonlat, const char *path)
{
    remeshing r = {.settings = s,
                   .common = common,
                   .how = {.centre = centre, .lonlat = lonlat, .threads = common->threads},
                   .path = path};
    int end = remeshing_check(&r);
    if (end == 0) end = files_read_mesh(path, &r.given);
    if (end) return end;
    const bool onto_sphere = lonlat && !r.given.has_z;
    end = star_input_make(&r.star, path, &r.given, &r.how);
    if (end == 0) end = s->onto ? remeshing_make_onto(&r) : remeshing_make_icosphere(&r);
    if (end == 0) end = remeshing_carry_fields(&r);
    remeshing_take_crs(&r, onto_sphere);
    if (end == 0) end = remeshing_judge(&r);
    if (end == 0) end = remeshing_write(&r);
    star_input_release(&r.star);
    mw_mesh_file_release(&r.given);
    mw_mesh_file_release(&r.made);
    free(r.at);
    return end;
}
