/* triangulate - a mesh of points, of any kind, or with constraints. */
#include "cli/commands/commands.h"
#include "cli/frame/files.h"
#include "cli/frame/message.h"
#include "cli/frame/monotonic_clock.h"
#include "cli/frame/progress.h"
#include "cli/frame/report.h"
#include "cli/gdal/gdal_crs.h"
#include "cli/gdal/gdal_point_layer.h"
#include "cli/constraints/constraint_file.h"
#include "cli/vertices/missing_values.h"
#include "cli/vertices/vertex_crs.h"
#include "cli/vertices/vertex_table.h"
#include "cli/output/border_peel.h"
#include "cli/output/mesh_output.h"
#include "cli/output/side_outputs.h"
#include "cli/raster/greedy_tin.h"

#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

typedef struct triangulate_settings {
    common_settings common;
    vertex_crs_settings crs;
    const char *columns, *classes, *layer, *where, *constraints, *boundary, *weight, *hidden;
    int kind, format, keep;
    uint32_t limit;
    const char *from;
    double max_edge, tolerance;
    uint32_t band;
    bool json, split, strict;
} triangulate_settings;

static const char *kind_name(int i)
{
    return mw_kind_name((mw_triangulation_kind)i);
}
static const char *kind_help(int i)
{
    return mw_kind_help((mw_triangulation_kind)i);
}
static const char *keep_name(int i)
{
    return (const char *[]){"auto", "hull", "inside", NULL}[i];
}
static const char *keep_help(int i)
{
    return (const char *[]){
        "inside, where there are polygons or holes, or FILE is a .poly; else hull",
        "all triangles of the convex hull",
        "those inside a polygon, or without polygons those that constraints part from the outside "
        "and from the points of holes"}[i];
}
static const choices kind_choices = {"kind of triangulation", kind_name, kind_help};
static const choices keep_choices = {"part to keep", keep_name, keep_help};

static const option triangulate_options[] = {
    {"constraints", 0, OPTION_TEXT, offsetof(triangulate_settings, constraints), "FILE",
     "make the points, lines and polygons of FILE vertices and edges of the mesh: GeoJSON, "
     "Triangle's .poly, or what "
     "GDAL reads, where the program is built with it; POINTS may be missing then",
     NULL},
    {"keep", 0, OPTION_CHOICE, offsetof(triangulate_settings, keep), "NAME",
     "with --constraints, the triangles to keep (default: auto):", &keep_choices},
    {"split", 0, OPTION_FLAG, offsetof(triangulate_settings, split), NULL,
     "with --constraints, put a vertex where some cross; without it that is an error", NULL},
    {"strict", 0, OPTION_FLAG, offsetof(triangulate_settings, strict), NULL,
     "with --constraints, refuse a FILE that has rings of fewer than three different points; "
     "without it they are "
     "skipped with a warning",
     NULL},
    {"boundary", 0, OPTION_TEXT, offsetof(triangulate_settings, boundary), "FILE",
     "keep what lies inside the polygons of FILE, whose sides become edges, with a vertex where "
     "they cross constraints",
     NULL},
    {"max-edge", 0, OPTION_LENGTH, offsetof(triangulate_settings, max_edge), "L",
     "remove triangles from the border as long as one has a border edge longer than L; none is "
     "removed over a constrained edge (default: keep the convex hull)",
     NULL},
    {"from", 0, OPTION_TEXT, offsetof(triangulate_settings, from), "RASTER",
     "in place of POINTS, those pixels of a raster that are needed to keep to --tolerance", NULL},
    {"tolerance", 0, OPTION_MAX_DISTANCE, offsetof(triangulate_settings, tolerance), "Z",
     "with --from: how far the mesh may be above or below the raster, at the centre of any pixel",
     NULL},
    {"band", 0, OPTION_COUNT, offsetof(triangulate_settings, band), "N",
     "with --from: the band of RASTER, from 1 (default: 1)", NULL},
    {"kind", 0, OPTION_CHOICE, offsetof(triangulate_settings, kind), "NAME",
     "kind of triangulation (default: delaunay, which --constraints needs):", &kind_choices},
    {"weight", 0, OPTION_TEXT, offsetof(triangulate_settings, weight), "COLUMN",
     "--kind regular: the column of POINTS that has the weights, by its name (z, c4, c5 ... "
     "without a header); a "
     "weight is the "
     "square of the radius of a circle round the point",
     NULL},
    {"hidden", 0, OPTION_TEXT, offsetof(triangulate_settings, hidden), "FILE",
     "--kind regular: list the points that no triangle has in FILE, by their numbers from 0", NULL},
    {"limit", 0, OPTION_COUNT, offsetof(triangulate_settings, limit), "N",
     "--kind min-weight: fill faces of up to N corners optimally; min-max-angle: seek the optimum "
     "of up to N points; "
     "beyond, a local optimum is made (default: 0, what half a minute finds)",
     NULL},
    {"format", 0, OPTION_CHOICE, offsetof(triangulate_settings, format), "NAME",
     "format of MESH; node is two files, .node and .ele (default: auto, by its ending):",
     &mesh_formats},
    {"columns", 0, OPTION_TEXT, offsetof(triangulate_settings, columns), "LIST",
     "columns of POINTS to take, as names or numbers from 1: lon,lat,height or 3,4,5; the first "
     "two are x and y, the "
     "third is z, further ones become fields (default: all that hold numbers; x, y and z are found "
     "by their names)",
     NULL},
    {"class", 0, OPTION_TEXT, offsetof(triangulate_settings, classes), "LIST",
     "LAS: take points of these classes only, as names or numbers: ground or 2,9 (default: all)",
     NULL},
    {"layer", 0, OPTION_TEXT, offsetof(triangulate_settings, layer), "NAME",
     "POINTS that GDAL reads: the layer with the points (default: the only one that has any)",
     NULL},
    {"where", 0, OPTION_TEXT, offsetof(triangulate_settings, where), "CONDITION",
     "POINTS that GDAL reads: take points that fulfil this, in SQL: \"class = 2\"", NULL},
    {"crs", 0, OPTION_TEXT, offsetof(triangulate_settings, crs.mesh), "CRS",
     "the coordinate system of MESH, as EPSG:2056 (default: that of POINTS, or else of the "
     "constraints); what is in "
     "another system is transformed",
     NULL},
    {"points-crs", 0, OPTION_TEXT, offsetof(triangulate_settings, crs.points), "CRS",
     "that of POINTS (default: what they tell, or else that of MESH)", NULL},
    {"constraints-crs", 0, OPTION_TEXT, offsetof(triangulate_settings, crs.constraints), "CRS",
     "that of the constraints (default: what they tell, or else that of MESH)", NULL},
    {"json", 0, OPTION_FLAG, offsetof(triangulate_settings, json), NULL, "print the report as JSON",
     NULL},
    {0},
};

/* What the command reads and makes. */
typedef struct triangulate_work {
    vertex_table vertices;
    mw_constraint_file constraints;
    uint32_t *duplicate_of; /* from mw_constrained_delaunay, with constraints only */
    mw_constrained_edges edges;
    mw_constrain_report constrained;
    mw_kind_report kind;
    double *weights; /* of --kind regular */
    uint8_t *hidden;
    border_peel peel;
    dem dem; /* of --from */
    greedy_tin_report greedy;
    double begin;
} triangulate_work;

static void triangulate_work_release(triangulate_work *w)
{
    vertex_table_release(&w->vertices);
    dem_release(&w->dem);
    mw_constraint_file_release(&w->constraints);
    mw_constrained_edges_release(&w->edges);
    free(w->duplicate_of);
    free(w->weights);
    free(w->hidden);
}

/* Take the triangles of the mesh, except those that --max-edge removes, and destroy the mesh. */
static int triangulate_take_mesh(const triangulate_settings *s, const char *path,
                                 triangulate_work *w, mw_mesh *mesh)
{
    int end = vertex_table_complete(&w->vertices, mesh);
    if (end == 0 && s->max_edge > 0)
        end = border_peel_off(mesh, s->max_edge, &w->edges, &w->vertices.file, &w->peel);
    mw_mesh_destroy(mesh);
    if (end || w->vertices.file.triangle_count > 0 || w->peel.triangles == 0) return end;
    complain("%s: no triangle is left: all have longer edges than --max-edge", path);
    return END_INPUT;
}

/* Warn of points that lost all their triangles, and of polygons that leave out most points. */
static void triangulate_warn_of_points(const triangulate_settings *s, const char *points,
                                       const triangulate_work *w)
{
    if (s->common.quiet || !points) return;
    const mw_mesh_file *file = &w->vertices.file;
    if (w->peel.points > 0)
        complain("%s: %zu of its %zu points belong to no triangle any more: --max-edge removed "
                 "their triangles",
                 points, w->peel.points, file->point_count);
    uint8_t *used = w->constrained.triangles_removed ? calloc(file->point_count + 1, 1) : NULL;
    if (!used) return;
    size_t inside = 0;
    for (size_t i = 0; i < 3 * file->triangle_count; i++) used[file->triangles[i]] = 1;
    for (size_t i = 0; i < w->vertices.points; i++) inside += used[i];
    free(used);
    if (2 * inside < w->vertices.points && w->vertices.points > 2)
        complain("%s: %zu of its %zu points lie outside of the polygons in %s, or equal others%s",
                 points, w->vertices.points - inside, w->vertices.points,
                 s->boundary ? s->boundary : s->constraints,
                 s->boundary ? "" : "; --keep hull keeps their triangles");
}

/* The library chooses the part to keep. Exception: the segments of a .poly bound a domain, as in
 * Triangle. */
static mw_keep triangulate_keep(const triangulate_settings *s, const triangulate_work *w)
{
    if (s->keep == MW_KEEP_AUTO && constraint_file_is_poly(&w->constraints)) return MW_KEEP_INSIDE;
    return (mw_keep)s->keep;
}

static int triangulate_fail_constrained(const triangulate_settings *s, const char *points,
                                        const triangulate_work *w, const mw_error *error)
{
    const uint32_t *cross = w->constrained.crossing_segments;
    if (error->status == MW_ERROR_INPUT && cross[0] != MW_NONE)
        return constraint_file_fail_crossing(s->constraints, &w->constraints,
                                             w->vertices.file.points, cross, s->split);
    if (error->status == MW_ERROR_INPUT && w->constrained.triangles_removed > 0) {
        complain("%s: %s; --keep hull keeps all", s->constraints, error->message);
        return END_INPUT;
    }
    bool given = points && error->vertex >= 0 && (size_t)error->vertex < w->vertices.points;
    return fail_mesh(given ? points : s->constraints, error);
}

static void triangulate_warn_of_holes(const triangulate_settings *s,
                                      const mw_constrain_report *done, const mw_constraint_file *c)
{
    if (done->idle_holes == 0 || s->common.quiet) return;
    const double *seed = &c->hole_seeds[2 * (size_t)done->first_idle_hole];
    complain("%s: warning: %" PRIu32
             " of %zu holes remove nothing, the first at (%.17g, %.17g): its "
             "point is outside, or in a part that is removed already",
             s->constraints, done->idle_holes, c->hole_seed_count, seed[0], seed[1]);
}

/* Triangulate the constraints, together with POINTS if they are given. */
static int triangulate_with_constraints(const triangulate_settings *s, const char *points,
                                        triangulate_work *w)
{
    mw_error error;
    mw_mesh *mesh;
    const mw_constraint_file *c = &w->constraints;
    const mw_mesh_file *file = &w->vertices.file;
    size_t count = file->point_count;
    mw_constraints constraints = {.points = file->points,
                                  .point_count = count,
                                  .stride = 3,
                                  .segments = c->segments,
                                  .segment_count = c->segment_count,
                                  .polygon = c->polygon,
                                  .hole_seeds = c->hole_seeds,
                                  .hole_seed_count = c->hole_seed_count};
    mw_constrain_options options = {.keep = triangulate_keep(s, w),
                                    .split = s->split,
                                    .threads = s->common.threads,
                                    .progress = progress_of_call()};
    w->duplicate_of = malloc((count + 1) * sizeof *w->duplicate_of);
    w->constrained.crossing_segments[0] = w->constrained.crossing_segments[1] = MW_NONE;
    if (!w->duplicate_of) return fail_memory();
    progress_phase("triangulating", s->constraints);
    if (mw_constrained_delaunay(&constraints, &options, w->duplicate_of, &w->constrained, &w->edges,
                                &mesh, &error) != MW_OK)
        return triangulate_fail_constrained(s, points, w, &error);
    triangulate_warn_of_holes(s, &w->constrained, c);
    int end = triangulate_take_mesh(s, points ? points : s->constraints, w, mesh);
    bool on_a_line = false;
    if (end == 0)
        end = missing_values_fill(&w->vertices, count, w->duplicate_of, c->segments, &w->edges,
                                  s->common.threads, &on_a_line);
    if (end == 0 && on_a_line && !s->common.quiet)
        complain("%s: warning: its points lie on one line, or are fewer than three, so vertices of "
                 "constraints that "
                 "have no values of their own get nan",
                 points);
    return end;
}

/* Warn if a kind that should be optimal is only a local optimum, and say why. */
static void triangulate_warn_if_local(const triangulate_settings *s, const char *path,
                                      const mw_kind_report *kind)
{
    const char *name = kind_name(s->kind);
    if (kind->optimal || s->common.quiet) return;
    if (kind->local_faces > 0)
        complain("%s: warning: this %s triangulation is a local optimum: of %zu faces (the largest "
                 "has %zu corners) %zu are too large or contain points; --limit N also fills "
                 "larger faces optimally",
                 path, name, kind->faces, kind->largest_face, kind->local_faces);
    else
        complain("%s: warning: this %s triangulation is a local optimum: there are too many points "
                 "to seek the best one; "
                 "--limit N seeks it for up to N points",
                 path, name);
}

/* The weights of --kind regular, one for each point. */
static int triangulate_take_weights(const triangulate_settings *s, const char *path,
                                    triangulate_work *w)
{
    vertex_field field;
    size_t n = w->vertices.points;
    if (!s->weight) return 0;
    if (!vertex_table_find_column(&w->vertices, s->weight, &field)) {
        complain("%s: --weight: there is no column '%s' beyond x and y%s", path, s->weight,
                 s->columns ? " among those of --columns" : "");
        return END_INPUT;
    }
    w->weights = malloc((n + 1) * sizeof *w->weights);
    w->hidden = malloc(n + 1);
    if (!w->weights || !w->hidden) return fail_memory();
    for (size_t i = 0; i < n; i++) w->weights[i] = field.values[i * field.stride];
    return 0;
}

static int triangulate_write_hidden(const triangulate_settings *s, const triangulate_work *w)
{
    text t = {0};
    if (!s->hidden) return 0;
    text_string(&t, "point\n");
    for (size_t i = 0; i < w->vertices.points; i++)
        if (w->hidden[i]) text_printf(&t, "%zu\n", i);
    return files_write_text(s->hidden, &t);
}

static int triangulate_points(const triangulate_settings *s, const char *path, triangulate_work *w)
{
    mw_error error;
    mw_mesh *mesh;
    const mw_mesh_file *file = &w->vertices.file;
    int end = triangulate_take_weights(s, path, w);
    if (end) return end;
    mw_kind_options options = {.limit = s->limit,
                               .threads = s->common.threads,
                               .progress = progress_of_call(),
                               .weights = w->weights,
                               .hidden = w->hidden};
    progress_phase("triangulating", path);
    if (mw_triangulate((mw_triangulation_kind)s->kind, file->points, file->point_count, 3, &options,
                       NULL, &w->kind, &mesh, &error) != MW_OK)
        return fail_mesh(path, &error);
    end = triangulate_take_mesh(s, path, w, mesh);
    if (end == 0) triangulate_warn_if_local(s, path, &w->kind);
    return end;
}

static void triangulate_report_constrained(report *r, const triangulate_work *w)
{
    report_count(r, "constraints", w->constraints.segment_count);
    report_count(r, "pieces", w->constrained.constrained_edges);
    report_count(r, "added", w->constrained.vertices_added);
    report_count(r, "removed", w->constrained.triangles_removed);
    report_count(r, "crossed", w->constrained.triangles_crossed);
}

static void triangulate_report_kind(report *r, const triangulate_settings *s,
                                    const mw_kind_report *kind)
{
    report_string(r, "kind", kind_name(s->kind));
    report_number(r, "edge_length", kind->edge_length);
    report_number(r, "largest_angle", kind->largest_angle * (180 / acos(-1)));
    report_flag(r, "optimal", kind->optimal);
    if (s->kind == MW_KIND_REGULAR) report_count(r, "hidden", kind->hidden);
    if (s->kind != MW_KIND_MIN_WEIGHT) return;
    report_count(r, "faces", kind->faces);
    report_count(r, "largest_face", kind->largest_face);
    report_count(r, "local_faces", kind->local_faces);
}

/* Report how the columns of POINTS were used: the height, and the fields. */
static void triangulate_report_columns(report *r, const vertex_table *v)
{
    if (v->height_name)
        report_string(r, "heights", v->height_name);
    else
        report_missing(r, "heights", "none");
    report_strings(r, "fields", v->file.field_names, v->file.field_count);
}

static void triangulate_report_raster(report *r, const triangulate_work *w)
{
    report_count(r, "inserted", w->greedy.inserted);
    report_count(r, "pixels", w->greedy.pixels);
    report_count(r, "left_out", w->greedy.left_out);
    report_number(r, "largest_error", w->greedy.largest);
}

/* Print the report on standard output; on standard error if the mesh goes to standard output. */
static int triangulate_print_report(const triangulate_settings *s, const triangulate_work *w)
{
    report r;
    if (s->common.quiet) return 0;
    report_begin(&r, s->json);
    const mw_delaunay_report *made = s->constraints ? &w->constrained.delaunay : &w->kind.delaunay;
    report_count(&r, "points", s->from ? w->vertices.file.point_count : made->points);
    report_count(&r, "duplicates", made->duplicates);
    report_count(&r, "triangles", w->vertices.file.triangle_count);
    if (s->max_edge > 0) report_count(&r, "peeled", w->peel.triangles);
    if (s->from) triangulate_report_raster(&r, w);
    triangulate_report_columns(&r, &w->vertices);
    if (!s->from)
        report_rounded(&r, "visited_per_point",
                       made->points ? (double)made->triangles_visited / (double)made->points : 0);
    if (s->constraints)
        triangulate_report_constrained(&r, w);
    else if (!s->from)
        triangulate_report_kind(&r, s, &w->kind);
    report_rounded(&r, "seconds", monotonic_seconds() - w->begin);
    report_end(&r);
    return files_is_standard(s->common.output) ? files_write_error_text(&r.text)
                                               : files_write_text(NULL, &r.text);
}

static int triangulate_refuse(const char *why)
{
    complain("triangulate: %s", why);
    return END_USAGE;
}

/* Refuse options that contradict each other. */
static int triangulate_check_combination(const triangulate_settings *s, const char *points)
{
    if (s->boundary && s->keep)
        return triangulate_refuse(
            "--keep cannot be used with --boundary, which decides what to keep");
    if (!s->from && (s->tolerance > 0 || s->band))
        return triangulate_refuse("--tolerance and --band need --from");
    if (s->from && points) return triangulate_refuse("give POINTS or --from RASTER, not both");
    if (s->from && s->tolerance == 0) return triangulate_refuse("--from needs --tolerance Z");
    if (s->from && s->kind != MW_KIND_DELAUNAY)
        return triangulate_refuse("--from is for --kind delaunay only");
    if (s->from && s->max_edge > 0)
        return triangulate_refuse("--from and --max-edge cannot be used together");
    if (!points && !s->from && !s->constraints && !s->boundary)
        return triangulate_refuse(
            "needs POINTS, or --from RASTER, or --constraints FILE, or --boundary FILE");
    if (!points && (s->columns || s->classes || s->layer || s->where || s->crs.points))
        return triangulate_refuse("--columns, --class, --layer, --where and --points-crs need "
                                  "POINTS, which are missing");
    if (!s->constraints && !s->boundary && (s->keep || s->split || s->strict))
        return triangulate_refuse("--keep, --split and --strict need --constraints");
    if (!s->constraints && !s->boundary && s->crs.constraints)
        return triangulate_refuse("--constraints-crs needs --constraints");
    if ((s->constraints || s->boundary) && s->kind != MW_KIND_DELAUNAY)
        return triangulate_refuse("--constraints and --boundary are for --kind delaunay only");
    if (!s->weight && s->kind == MW_KIND_REGULAR)
        return triangulate_refuse("--kind regular needs --weight COLUMN");
    if ((s->weight || s->hidden) && s->kind != MW_KIND_REGULAR)
        return triangulate_refuse("--weight and --hidden need --kind regular");
    if (s->hidden && files_is_standard(s->hidden))
        return triangulate_refuse("--hidden must be a file, not standard output");
    if (s->limit && s->kind != MW_KIND_MIN_WEIGHT && s->kind != MW_KIND_MIN_MAX_ANGLE)
        return triangulate_refuse("--limit needs --kind min-weight or min-max-angle");
    return 0;
}

/* Refuse wrong settings before the work begins. */
static int triangulate_check_settings(const triangulate_settings *s, const char *points)
{
    const char *output = s->common.output,
               *files[] = {points ? points : s->from, s->constraints, s->boundary}, *inputs[3];
    int count = 0, end = triangulate_check_combination(s, points);
    if (end == 0) end = vertex_crs_check(&s->crs);
    for (int i = 0; i < 3; i++)
        if (files[i]) inputs[count++] = files[i];
    if (end == 0) end = point_layers_check(inputs, count);
    if (end == 0) end = mesh_output_check("triangulate", output, s->format);
    for (int i = 1; i < 3 && end == 0; i++)
        if (files[i] && mesh_output_is_node(output, s->format))
            end = constraint_file_check_output(files[i], output);
    if (end == 0) end = files_check_output(output, inputs, count);
    const side_output hidden = {.option = "hidden", .path = s->hidden};
    if (end == 0) end = side_outputs_check(&hidden, 1, output, inputs, count);
    return end || !s->hidden ? end : files_try_output(s->hidden, NULL);
}

/* A boundary counts as constraints whose inside is kept and whose crossings become vertices. */
static triangulate_settings triangulate_settle(const triangulate_settings *given)
{
    triangulate_settings s = *given;
    if (!s.boundary) return s;
    if (!s.constraints) s.constraints = s.boundary;
    s.keep = MW_KEEP_INSIDE;
    s.split = true;
    return s;
}

/* Refuse a boundary without polygons, except for a .poly alone, whose segments bound a domain. */
static int triangulate_check_boundary(const triangulate_settings *s,
                                      const mw_constraint_file *boundary)
{
    bool alone = s->boundary == s->constraints;
    if (!s->boundary || boundary->polygon_count > 0 || (alone && constraint_file_is_poly(boundary)))
        return 0;
    complain("%s: holds no polygon, so it is no boundary", s->boundary);
    return END_INPUT;
}

/* Read a boundary and append it to the constraints. */
static int triangulate_join_boundary(const triangulate_settings *s, const char *points,
                                     triangulate_work *w)
{
    mw_constraint_file boundary = {0};
    const constraint_file_options options = {.quiet = s->common.quiet, .strict = s->strict};
    if (!s->boundary) return 0;
    int end = constraint_file_read(s->boundary, options, &boundary);
    if (end == 0) end = triangulate_check_boundary(s, &boundary);
    if (end == 0)
        end = vertex_crs_move_constraints(&s->common, s->boundary, &boundary,
                                          points ? points : s->constraints, w->vertices.file.crs);
    if (end == 0) end = constraint_file_join(&w->constraints, &boundary);
    mw_constraint_file_release(&boundary);
    return end;
}

/* Take the first pixels of a raster as points. */
static int triangulate_read_raster(const triangulate_settings *s, triangulate_work *w)
{
    vertex_table *v = &w->vertices;
    int end = dem_read(&w->dem, s->from, s->band ? s->band : 1);
    if (end == 0 && w->dem.crs && s->crs.mesh && !crs_same(w->dem.crs, s->crs.mesh)) {
        complain("%s: is in another coordinate system than --crs says; gdalwarp transforms it",
                 s->from);
        end = END_INPUT;
    }
    if (end == 0) end = dem_begin(&w->dem, &v->file.points, &v->file.point_count);
    if (end) return end;
    v->file.has_z = v->point_heights = true;
    v->points = v->file.point_count;
    v->height_name = strdup("raster");
    v->file.crs = w->dem.crs ? strdup(w->dem.crs) : NULL;
    return v->height_name && (v->file.crs || !w->dem.crs) ? 0 : fail_memory();
}

/* Vertices of constraints that have no height get that of the raster. */
static int triangulate_take_heights(const triangulate_settings *s, triangulate_work *w)
{
    const mw_mesh_file *file = &w->vertices.file;
    for (size_t i = w->vertices.points; i < file->point_count; i++) {
        double *p = file->points + 3 * i;
        if (!w->constraints.has_z || isnan(p[2])) p[2] = dem_height(&w->dem, p[0], p[1]);
        if (!isnan(p[2])) continue;
        complain("%s: the point %g, %g has no height, and %s has none there", s->constraints, p[0],
                 p[1], s->from);
        return END_INPUT;
    }
    return 0;
}

/* Insert further pixels into the mesh of the vertices, as needed. */
static int triangulate_refine(const triangulate_settings *s, triangulate_work *w)
{
    mw_error error;
    mw_mesh *mesh = NULL, *fine = NULL;
    mw_mesh_file *file = &w->vertices.file;
    const mw_arrays arrays = mw_mesh_file_arrays(file);
    const greedy_tin_options options = {
        .tolerance = s->tolerance,
        .bounded = w->constrained.triangles_removed > 0,
        .common = &s->common,
    };
    if (mw_mesh_create(&arrays, NULL, &mesh, &error) != MW_OK ||
        mw_mesh_set_field(mesh, "z", file->points + 2, 3, &error) != MW_OK) {
        mw_mesh_destroy(mesh);
        return fail_mesh(s->from, &error);
    }
    int end = greedy_tin_make(&w->dem, mesh, &w->edges, &options, &fine, &w->greedy);
    mw_mesh_destroy(mesh);
    if (end == 0) {
        char *crs = file->crs, *height = w->vertices.height_name;
        file->crs = w->vertices.height_name = NULL;
        vertex_table_release(&w->vertices);
        end = vertex_table_of_mesh(&w->vertices, fine);
        file->crs = crs;
        w->vertices.height_name = height;
    }
    mw_mesh_destroy(fine);
    if (end == 0 && w->greedy.left_out > 0 && !options.bounded && !s->common.quiet)
        complain("%s: warning: %zu of its pixels have a height, but lie in no triangle: too few "
                 "pixels beside them have a height",
                 s->from, w->greedy.left_out);
    return end;
}

static int triangulate_read_input(const triangulate_settings *s, const char *points,
                                  triangulate_work *w)
{
    const vertex_table_options how = {{s->columns, s->classes, s->layer, s->where},
                                      s->common.quiet};
    int end = s->from  ? triangulate_read_raster(s, w)
              : points ? vertex_table_read(&w->vertices, points, &how)
                       : 0;
    const constraint_file_options options = {.quiet = s->common.quiet, .strict = s->strict};
    if (end == 0 && s->constraints)
        end = constraint_file_read(s->constraints, options, &w->constraints);
    if (end == 0 && s->boundary == s->constraints)
        end = triangulate_check_boundary(s, &w->constraints);
    if (end == 0)
        end = vertex_crs_join(&s->crs, &s->common, points, &w->vertices, s->constraints,
                              &w->constraints);
    if (end == 0 && s->boundary != s->constraints) end = triangulate_join_boundary(s, points, w);
    if (end || !s->constraints) return end;
    end = vertex_table_append(&w->vertices, &w->constraints);
    return end || !s->from ? end : triangulate_take_heights(s, w);
}

static int triangulate_run(const void *settings, const char *const *operands)
{
    const triangulate_settings *given = settings, settled = triangulate_settle(given),
                               *s = &settled;
    const char *points = operands[0] ? operands[0] : s->from;
    triangulate_work w = {.begin = monotonic_seconds()};
    bool temporary = false;
    int end = triangulate_check_settings(given, operands[0]);
    if (end == 0) end = files_try_output(s->common.output, &temporary);
    if (end == 0) end = triangulate_read_input(s, points, &w);
    if (end == 0)
        end = s->constraints ? triangulate_with_constraints(s, points, &w)
                             : triangulate_points(s, points, &w);
    if (end == 0 && !s->from) triangulate_warn_of_points(s, points, &w);
    if (end == 0 && s->from) end = triangulate_refine(s, &w);
    if (end == 0 && !s->common.quiet)
        mesh_output_warn(s->common.output, s->format, &w.vertices.file);
    if (end == 0)
        end = mesh_output_write(s->common.output, s->format, &w.vertices.file, temporary,
                                s->common.quiet);
    if (end == 0) end = triangulate_write_hidden(s, &w);
    if (end == 0) end = triangulate_print_report(s, &w);
    triangulate_work_release(&w);
    return end;
}

static const option *const tables[] = {triangulate_options, common_options, NULL};

const command triangulate_command = {
    .name = "triangulate",
    .operands = "[POINTS] -o MESH",
    .operand_count = 1,
    .optional_operands = 1,
    .summary = "make a triangulation of points, lines and polygons",
    .description =
        "Writes a triangulation of POINTS to MESH, Delaunay unless --kind says otherwise. Vertex i "
        "of the mesh is point i, from 0. A point equal to an earlier one is counted in the report, "
        "and belongs to no triangle. A column z, or height, is the height; further columns of "
        "numbers become fields. With --constraints, the lines and polygons of a file are edges of "
        "the mesh; its points follow POINTS, with heights and fields interpolated where the file "
        "has none. With --from and --tolerance, a raster of heights is triangulated instead of "
        "POINTS. '-' is standard input.",
    .options = tables,
    .essential = "columns constraints boundary max-edge output",
    .settings_size = sizeof(triangulate_settings),
    .run = triangulate_run,
};
