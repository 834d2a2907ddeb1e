/* star - which facet of a star-shaped polyhedron each ray from its centre meets. */
#include "cli/commands/commands.h"
#include "cli/frame/files.h"
#include "cli/frame/message.h"
#include "cli/frame/monotonic_clock.h"
#include "cli/frame/progress.h"
#include "cli/gdal/gdal_point_layer.h"
#include "cli/input/lonlat_input.h"
#include "cli/output/csv_row.h"
#include "cli/stream/query_stream.h"
#include "cli/stream/statistics.h"

#include <stdio.h>
#include <stdlib.h>

typedef struct star_settings {
    query_stream_settings stream;
    coordinates centre; /* not given: the origin */
    uint32_t sample, cells, levels;
    int walk, start; /* mw_star_walk_kind, mw_star_start_kind */
    int finish;      /* the number of a name of --finish */
    bool lonlat;
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
    {"columns", 0, OPTION_TEXT, offsetof(star_settings, stream.source.columns), "LIST",
     "columns of DIRECTIONS that hold x, y and z, or longitude and latitude, as names or numbers "
     "from 1: u,v,w or "
     "3,4,5 (default: those that a header calls so, by names that the manual page lists, or the "
     "only ones)",
     NULL},
    {0},
};

/* A polyhedron that is ready for rays, and the statistics of its rays. */
typedef struct ray_queries {
    const star_settings *settings;
    double begin; /* monotonic_seconds */
    mw_surface *surface;
    mw_star *star;
    mw_star_index *index; /* NULL if the start has none */
    double *points;       /* of a block, if directions are longitudes and latitudes */
    location_statistics statistics;
} ray_queries;

/* --- the polyhedron --------------------------------------------------------------------------- */

/* The options with which 'check' reads the polyhedron as this command does. */
static const char *star_check_arguments(const star_settings *s, char words[128])
{
    text t = {0};
    text_string(&t, "--as star");
    if (s->centre.at[0] != 0 || s->centre.at[1] != 0 || s->centre.at[2] != 0) {
        text_string(&t, " --centre ");
        csv_row_numbers(&t, s->centre.at, 3);
    }
    if (s->lonlat) text_string(&t, " --lonlat");
    snprintf(words, 128, "%.*s", t.failed ? 0 : (int)t.size, t.failed ? "" : t.bytes);
    text_release(&t);
    return words;
}

static int ray_queries_fail_star(const ray_queries *r, const char *path, bool flat,
                                 const mw_error *error)
{
    char words[128];
    int end = fail_mesh(path, error);
    if (end == END_INPUT && flat)
        complain("%s: has no z; --lonlat takes x and y as longitude and latitude", path);
    else if (end == END_INPUT)
        complain("'meshwalk check %s %s' lists every defect, 'meshwalk view' shows it",
                 star_check_arguments(r->settings, words), path);
    return end;
}

static int ray_queries_make_star(ray_queries *r, const char *path, const mw_mesh_file *file)
{
    const star_settings *s = r->settings;
    mw_error error;
    mw_arrays arrays = mw_mesh_file_arrays(file);
    /* Welding closes the seam of a sphere, and joins its vertices at each pole. */
    mw_surface_options surface = {.weld = 1, .progress = progress_of_call()};
    mw_star_options star = {.centre = {s->centre.at[0], s->centre.at[1], s->centre.at[2]},
                            .angles = s->walk == MW_STAR_WALK_ORTHOGONAL,
                            .threads = s->stream.common.threads,
                            .progress = progress_of_call()};
    progress_phase("preparing", path);
    if (mw_surface_create(&arrays, &surface, &r->surface, &error) != MW_OK ||
        mw_star_create(r->surface, &star, &r->star, &error) != MW_OK)
        return ray_queries_fail_star(r, path, !file->has_z, &error);
    return 0;
}

static int ray_queries_make_index(ray_queries *r)
{
    const star_settings *s = r->settings;
    mw_error error;
    mw_star_start_kind start = (mw_star_start_kind)s->start;
    mw_star_index_options options = {
        .cells = s->cells, .levels = s->levels, .progress = progress_of_call()};
    if (!mw_star_start_has_index(start)) return 0;
    return mw_star_index_create(r->star, start, &options, &r->index, &error) == MW_OK
               ? 0
               : fail_query(&error);
}

static int ray_queries_open(ray_queries *r, const char *path)
{
    mw_mesh_file file;
    int end = files_read_mesh(path, &file);
    if (end) return end;
    if (r->settings->lonlat) end = lonlat_input_mesh(path, &file);
    if (end == 0) end = ray_queries_make_star(r, path, &file);
    mw_mesh_file_release(&file);
    if (end == 0) end = ray_queries_make_index(r);
    if (end == 0 && r->settings->lonlat) {
        r->points = malloc(QUERY_BLOCK_SIZE * 3 * sizeof *r->points);
        if (!r->points) end = fail_memory();
    }
    return end;
}

static void ray_queries_release(ray_queries *r)
{
    free(r->points);
    mw_star_index_destroy(r->index);
    mw_star_destroy(r->star);
    mw_surface_destroy(r->surface);
}

/* --- the rays --------------------------------------------------------------------------------- */

static int ray_queries_answer(void *self, const query_block *block, void *answers)
{
    ray_queries *r = self;
    const star_settings *s = r->settings;
    const common_settings *common = &s->stream.common;
    mw_error error;
    mw_counters counters = {0};
    mw_star_query_options options = {
        .walk = (mw_star_walk_kind)s->walk,
        .start = (mw_star_start_kind)s->start,
        .finish = star_finishes[s->finish],
        .seed = common->seed + block->block, /* each block has its own random numbers */
        .samples = s->sample,
        .threads = common->threads,
        .counters = s->stream.stats,
        .index = r->index,
        .progress = progress_of_call(),
    };
    const double *points = block->values;
    size_t stride = block->stride;
    if (s->lonlat) {
        lonlat_input_directions(block->values, stride, block->count, s->centre.at, common->threads,
                                r->points);
        points = r->points;
        stride = 3;
    }
    if (mw_star_locate_batch(r->star, points, block->count, stride, &options, answers, &counters,
                             &error) != MW_OK)
        return fail_query(&error);
    location_statistics_add(&r->statistics, answers, block->count, &counters);
    return 0;
}

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
    static const mw_where states[] = {MW_INSIDE, MW_ON_EDGE, MW_ON_VERTEX, MW_BAD};
    const ray_queries *r = self;
    mw_star_info star;
    mw_star_index_info index = {0};
    mw_star_describe(r->star, &star);
    if (r->index) mw_star_index_describe(r->index, &index);
    for (size_t i = 0; i < sizeof states / sizeof *states; i++)
        report_count(out, mw_where_name(states[i]), r->statistics.where[states[i]]);
    report_string(out, "walk", star_walk_name(r->settings->walk));
    report_string(out, "start", star_start_name(r->settings->start));
    statistics_report_settings(out, &r->settings->stream.common);
    statistics_report_walks(out, &r->statistics.counters);
    report_count(out, "surface_bytes", mw_surface_bytes(r->surface));
    report_count(out, "star_bytes", star.bytes);
    report_count(out, "angle_bytes", star.angle_bytes);
    report_count(out, "start_bytes", index.bytes);
    report_rounded(out, "start_seconds", index.seconds);
}

static int ray_queries_run(ray_queries *r, const char *path)
{
    const star_settings *s = r->settings;
    static const char *const answers[] = {"status", "triangle", "w0", "w1", "w2", NULL};
    query_stream asked = {
        .settings = &s->stream,
        .begin = r->begin,
        .doing = "locating",
        .columns = {.axes = QUERY_SPACE,
                    .names = {"x", "y", "z"},
                    .count = 3,
                    .hint = "; --lonlat reads longitude and latitude"},
        .answers = answers,
        .kinds = "tirrr",
        .answer_size = sizeof(mw_location),
        .answer = ray_queries_answer,
        .row = ray_queries_write_row,
        .report = ray_queries_report,
        .self = r,
    };
    if (s->lonlat)
        asked.columns = (query_columns){.axes = QUERY_LONLAT, .names = {"lon", "lat"}, .count = 2};
    if (s->lonlat) asked.domain = QUERIES_BY_LONLAT;
    asked.shown = asked.columns.count;
    return query_stream_run(&asked, path);
}

/* Refuse values above the limits of the library, before the polyhedron is read. */
static int star_check_limits(const star_settings *s)
{
    int end = options_limit("cells", s->cells, UINT32_C(1) << 30, "2^30");
    return end ? end : options_limit("levels", s->levels, MW_STAR_MAX_LEVELS + 1, NULL);
}

static int star_run(const void *settings, const char *const *operands)
{
    const star_settings *s = settings;
    ray_queries r = {.settings = s, .begin = monotonic_seconds()};
    int end = files_check_output(s->stream.common.output, operands, 2);
    if (end == 0) end = point_layers_check(operands, 2);
    if (end == 0) end = query_stream_check_output(&s->stream);
    if (end == 0) end = star_check_limits(s);
    if (end == 0) end = ray_queries_open(&r, operands[0]);
    if (end == 0) end = ray_queries_run(&r, operands[1]);
    ray_queries_release(&r);
    return end;
}

static const option *const tables[] = {star_options, query_stream_options, common_options, NULL};

const command star_command = {
    .name = "star",
    .operands = "POLYHEDRON DIRECTIONS",
    .operand_count = 2,
    .summary = "find the facet that each ray from a centre meets",
    .description =
        "Writes every row of DIRECTIONS unchanged, followed by status,triangle,w0,w1,w2. The "
        "triangle is the facet of POLYHEDRON that the ray from the centre through the point "
        "meets, from 0; status is inside, edge or vertex. If the point is the centre or is "
        "not finite, the status is bad and the triangle -1. w0, w1, w2 are the weights of the "
        "facet's corners at the point where the ray meets it. A ray through an edge or a "
        "corner belongs to the lowest-numbered facet that it meets. POLYHEDRON must be "
        "closed, and the centre must see the inside of each facet, as that of a sphere does. "
        "'-' is standard input.",
    .options = tables,
    .essential = "centre lonlat columns only-answers output",
    .settings_size = sizeof(star_settings),
    .run = star_run,
};
