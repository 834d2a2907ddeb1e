/* star - which facet of a star-shaped polyhedron each ray from its centre meets; or the polyhedron
 * sampled anew, on an icosphere or on another mesh. */
#include "cli/commands/commands.h"
#include "cli/frame/files.h"
#include "cli/frame/message.h"
#include "cli/frame/monotonic_clock.h"
#include "cli/frame/progress.h"
#include "cli/gdal/gdal_point_layer.h"
#include "cli/output/csv_row.h"
#include "cli/output/mesh_output.h"
#include "cli/remesh/remeshed_star.h"
#include "cli/stream/ray_stream.h"

typedef struct star_settings {
    query_stream_settings stream;
    coordinates centre; /* not given: the origin */
    uint32_t sample, cells, levels;
    int walk, start; /* mw_star_walk_kind, mw_star_start_kind */
    int finish;      /* the number of a name of --finish */
    bool lonlat, borrow, open;
    remesh_settings remesh;
} star_settings;

static const char *star_walk_name(int i)
{
    return mw_star_walk_name((mw_star_walk_kind)i);
}
static const char *star_walk_help(int i)
{
    return mw_star_walk_help((mw_star_walk_kind)i);
}
static const char *star_start_name(int i)
{
    return mw_star_start_name((mw_star_start_kind)i);
}
static const char *star_start_help(int i)
{
    return mw_star_start_help((mw_star_start_kind)i);
}

/* The walks that may finish the one whose own tests only guide it. */
static const mw_star_walk_kind star_finishes[] = {MW_STAR_WALK_AUTO, MW_STAR_WALK_STOCHASTIC,
                                                  MW_STAR_WALK_FORGETFUL};
static const char *star_finish_name(int i)
{
    return i < (int)(sizeof star_finishes / sizeof *star_finishes)
               ? mw_star_walk_name(star_finishes[i])
               : NULL;
}

static const choices star_walk_choices = {"walk", star_walk_name, star_walk_help};
static const choices star_start_choices = {"start", star_start_name, star_start_help};
static const choices finish_choices = {"way to finish", star_finish_name, NULL};

static const option star_options[] = {
    {"centre", 0, OPTION_XYZ, offsetof(star_settings, centre), "X,Y,Z",
     "the point that rays come from, and that sees all facets from inside (default: 0,0,0)", NULL},
    {"lonlat", 0, OPTION_FLAG, offsetof(star_settings, lonlat), NULL,
     "DIRECTIONS are longitudes and latitudes in degrees; and so are x and y of a POLYHEDRON "
     "without z, which then "
     "lies "
     "on the unit sphere",
     NULL},
    {"walk", 0, OPTION_CHOICE, offsetof(star_settings, walk), "NAME",
     "how to walk to the facet (default: auto):", &star_walk_choices},
    {"start", 0, OPTION_CHOICE, offsetof(star_settings, start), "NAME",
     "how to choose the first facet (default: auto):", &star_start_choices},
    {"finish", 0, OPTION_CHOICE, offsetof(star_settings, finish), "NAME",
     "the walk that ends the orthogonal one, whose own tests are only a guide (default: auto, "
     "which is stochastic):",
     &finish_choices},
    {"sample", 0, OPTION_COUNT, offsetof(star_settings, sample), "K",
     "--start sample: look at K random facets (default: 0, twice the fourth root of the number of "
     "vertices)",
     NULL},
    {"cells", 0, OPTION_COUNT, offsetof(star_settings, cells), "N",
     "--start grid, nonuniform-grid: about N cells (default: 0, one for 16 facets)", NULL},
    {"levels", 0, OPTION_COUNT, offsetof(star_settings, levels), "N",
     "--start octahedron: N levels, the octahedron itself counted (default: 0, by the number of "
     "facets)",
     NULL},
    {"borrow", 0, OPTION_FLAG, offsetof(star_settings, borrow), NULL,
     "keep nothing beside the polyhedron, whose own triangles the walks follow: the same answers, "
     "several times slower",
     NULL},
    {"open", 0, OPTION_FLAG, offsetof(star_settings, open), NULL,
     "POLYHEDRON may leave directions open, as an ocean does, or overlap: boxes find the facet "
     "that a ray meets first; the status is outside if it meets none",
     NULL},
    {"columns", 0, OPTION_TEXT, offsetof(star_settings, stream.source.columns), "LIST",
     "columns of DIRECTIONS that hold x, y and z, or longitude and latitude, as names or numbers "
     "from 1: u,v,w or 3,4,5 (default: those that the header names so, in one of the ways that the "
     "manual page lists, or the only ones)",
     NULL},
    {"remesh", 0, OPTION_TEXT, offsetof(star_settings, remesh.level), "LEVEL",
     "instead of finding facets: sample POLYHEDRON on an icosphere of 20 * 4^LEVEL triangles about "
     "the centre, and write that mesh to -o OUT",
     NULL},
    {"onto", 0, OPTION_TEXT, offsetof(star_settings, remesh.onto), "OTHER",
     "the same on another mesh, which is to be star-shaped about the same centre: its vertices "
     "move along their rays onto POLYHEDRON",
     NULL},
    {"deviation", 0, OPTION_FLAG, offsetof(star_settings, remesh.deviation), NULL,
     "--remesh, --onto: print on standard error how far the two surfaces are apart, both ways",
     NULL},
    {"format", 0, OPTION_CHOICE, offsetof(star_settings, remesh.format), "NAME",
     "--remesh, --onto: the format of OUT (default: auto, by its ending):", &mesh_formats},
    {"nodata", 0, OPTION_TEXT, offsetof(star_settings, remesh.nodata), "V",
     "--remesh, --onto: vertices with the value V have none, as those with NaN; none: all others "
     "have one (default: -99999)",
     NULL},
    {0},
};

/* A polyhedron that is ready for rays. */
typedef struct ray_queries {
    ray_stream query; /* the first member: see ray_stream.h */
    const star_settings *settings;
    mw_star_index *index; /* NULL if the start has none */
} ray_queries;

/* --- the polyhedron --------------------------------------------------------------------------- */

static int ray_queries_make_index(ray_queries *r)
{
    const star_settings *s = r->settings;
    mw_error error;
    mw_star_start_kind start = (mw_star_start_kind)s->start;
    mw_star_index_options options = {
        .cells = s->cells, .levels = s->levels, .progress = progress_of_call()};
    if (!mw_star_start_has_index(start)) return 0;
    if (mw_star_index_create(r->query.polyhedron.star, start, &options, &r->index, &error) != MW_OK)
        return fail_query(&error);
    r->query.options.index = r->index;
    return 0;
}

static int ray_queries_open(ray_queries *r, const char *path)
{
    const star_settings *s = r->settings;
    const star_input_settings how = {
        &s->centre, s->lonlat, s->walk == MW_STAR_WALK_ORTHOGONAL, s->stream.common.threads,
        s->borrow,  s->open};
    mw_mesh_file file;
    int end = files_read_mesh(path, &file);
    if (end) return end;
    end = star_input_make(&r->query.polyhedron, path, &file, &how);
    mw_mesh_file_release(&file);
    return end ? end : ray_queries_make_index(r);
}

/* --- the rays --------------------------------------------------------------------------------- */

static bool ray_queries_write_row(const void *self, const double *direction, const void *answer,
                                  text *out)
{
    (void)self;
    (void)direction;
    const mw_location *where = answer;
    csv_row_status(out, mw_where_name((mw_where)where->where), where->triangle);
    csv_row_weights(out, where->triangle, where->weight);
    return where->triangle != MW_NONE;
}

static void ray_queries_report(const void *self, report *out)
{
    const ray_queries *r = self;
    const star_input *polyhedron = &r->query.polyhedron;
    mw_star_info star;
    mw_star_index_info index = {0};
    ray_stream_report_status(&r->query, out);
    if (polyhedron->prober) {
        mw_prober_info boxes;
        mw_prober_describe(polyhedron->prober, &boxes);
        statistics_report_settings(out, &r->settings->stream.common);
        report_count(out, "surface_bytes", mw_surface_bytes(polyhedron->surface));
        report_count(out, "box_bytes", boxes.box_bytes);
        return;
    }
    mw_star_describe(polyhedron->star, &star);
    if (r->index) mw_star_index_describe(r->index, &index);
    report_string(out, "walk", star_walk_name(r->settings->walk));
    report_string(out, "start", star_start_name(r->settings->start));
    statistics_report_settings(out, &r->settings->stream.common);
    statistics_report_walks(out, &r->query.statistics.counters);
    report_count(out, "surface_bytes", mw_surface_bytes(polyhedron->surface));
    report_count(out, "star_bytes", star.bytes);
    report_count(out, "angle_bytes", star.angle_bytes);
    report_count(out, "start_bytes", index.bytes);
    report_rounded(out, "start_seconds", index.seconds);
}

/* Refuse values above the limits of the library, before the polyhedron is read. */
static int star_check_limits(const star_settings *s)
{
    int end = options_limit("cells", s->cells, UINT32_C(1) << 30, "2^30");
    return end ? end : options_limit("levels", s->levels, MW_STAR_MAX_LEVELS + 1, NULL);
}

/* The option that is given although boxes do not walk; NULL: none is. */
static const char *star_option_of_walks(const star_settings *s)
{
    return s->walk     ? "walk"
           : s->start  ? "start"
           : s->finish ? "finish"
           : s->sample ? "sample"
           : s->cells  ? "cells"
           : s->levels ? "levels"
           : s->borrow ? "borrow"
                       : NULL;
}

static int star_check_open(const star_settings *s)
{
    const char *unfit = s->open ? star_option_of_walks(s) : NULL;
    if (!unfit) return star_input_check_open(s->open, &s->centre);
    complain("option '--%s' cannot be used with --open, which finds facets by boxes, not by a walk",
             unfit);
    return END_USAGE;
}

static int star_locate(const star_settings *s, const char *const *operands)
{
    static const char *const answers[] = {"status", "triangle", "w0", "w1", "w2", NULL};
    ray_queries r = {.query = {.stream = &s->stream,
                               .centre = &s->centre,
                               .options = {.walk = (mw_star_walk_kind)s->walk,
                                           .start = (mw_star_start_kind)s->start,
                                           .finish = star_finishes[s->finish],
                                           .samples = s->sample},
                               .lonlat = s->lonlat,
                               .begin = monotonic_seconds()},
                     .settings = s};
    int end = files_check_output(s->stream.common.output, operands, 2);
    if (end == 0) end = point_layers_check(operands, 2);
    if (end == 0) end = query_stream_check_output(&s->stream);
    if (end == 0) end = star_check_limits(s);
    if (end == 0) end = star_check_open(s);
    if (end == 0) end = ray_queries_open(&r, operands[0]);
    if (end == 0)
        end = ray_stream_run(&r.query, operands[1], answers, "tirrr", ray_queries_write_row,
                             ray_queries_report);
    mw_star_index_destroy(r.index);
    ray_stream_release(&r.query);
    return end;
}

/* --- remeshing -------------------------------------------------------------------------------- */

/* The option that is given although it means nothing for a remeshed polyhedron; NULL: none is. */
static const char *star_option_of_rays(const star_settings *s)
{
    const char *of_walks = star_option_of_walks(s);
    return of_walks                   ? of_walks
           : s->open                  ? "open"
           : s->stream.source.columns ? "columns"
           : s->stream.source.layer   ? "layer"
           : s->stream.source.where   ? "where"
           : s->stream.strict         ? "strict"
           : s->stream.stats          ? "stats"
           : s->stream.only_answers   ? "only-answers"
                                      : NULL;
}

static int star_remesh(const star_settings *s, const char *const *operands)
{
    const char *unfit = star_option_of_rays(s);
    remesh_settings remesh = s->remesh;
    if (operands[1]) {
        complain("star: '%s' is one file too many: --remesh and --onto take POLYHEDRON only",
                 operands[1]);
        return END_USAGE;
    }
    if (unfit) {
        complain("option '--%s' is for DIRECTIONS, not for --remesh and --onto", unfit);
        return END_USAGE;
    }
    remesh.json = s->stream.json;
    return remeshed_star_run(&remesh, &s->stream.common, &s->centre, s->lonlat, operands[0]);
}

static int star_run(const void *settings, const char *const *operands)
{
    const star_settings *s = settings;
    const char *unfit = s->remesh.deviation ? "deviation"
                        : s->remesh.format  ? "format"
                        : s->remesh.nodata  ? "nodata"
                                            : NULL;
    if (s->remesh.level || s->remesh.onto) return star_remesh(s, operands);
    if (unfit) {
        complain("option '--%s' needs --remesh or --onto", unfit);
        return END_USAGE;
    }
    if (!operands[1]) return options_fail_operands(&star_command, 1);
    return star_locate(s, operands);
}

static const option *const tables[] = {star_options, query_stream_options, common_options, NULL};

const command star_command = {
    .name = "star",
    .operands = "POLYHEDRON DIRECTIONS",
    .operand_count = 2,
    .optional_operands = 1, /* with --remesh or --onto */
    .summary = "find facets that rays from a centre meet; remesh a polyhedron",
    .description =
        "Writes every row of DIRECTIONS unchanged, followed by status,triangle,w0,w1,w2. The "
        "triangle is the facet of POLYHEDRON that the ray from the centre through the point "
        "meets, from 0; status is inside, edge or vertex. If the point is the centre or is "
        "not finite, the status is bad and the triangle -1. w0, w1, w2 are the weights of the "
        "facet's corners at the point where the ray meets it. A ray through an edge or a "
        "corner belongs to the lowest-numbered facet that it meets. POLYHEDRON must be "
        "closed, and the centre must see the inside of each facet, as that of a sphere does; "
        "with --open it may leave parts of the sphere open, as an ocean does. "
        "With --remesh or --onto there are no DIRECTIONS: a new mesh is written, whose vertices "
        "are where rays from the centre meet POLYHEDRON, with its fields interpolated there. "
        "'-' is standard input.",
    .options = tables,
    .essential = "centre lonlat remesh columns output",
    .settings_size = sizeof(star_settings),
    .run = star_run,
};
