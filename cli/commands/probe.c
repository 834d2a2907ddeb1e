/* probe - which triangle of a surface each probe touches. */
#include "cli/commands/commands.h"
#include "cli/frame/files.h"
#include "cli/frame/message.h"
#include "cli/frame/monotonic_clock.h"
#include "cli/gdal/gdal_point_layer.h"
#include "cli/stream/probe_stream.h"

static const char *probe_start_name(int i)
{
    return mw_probe_start_name((mw_probe_start)i);
}
static const char *probe_start_help(int i)
{
    static const char *const texts[MW_PROBE_START_COUNT] = {
        [MW_PROBE_START_AUTO] = "last where that triangle is near, else sample",
        [MW_PROBE_START_LAST] =
            "the triangle of the query before; else, and in further walks, as sample",
        [MW_PROBE_START_SAMPLE] =
            "the nearest of a sample of triangles whose fronts the motion points at",
        [MW_PROBE_START_RANDOM] = "a random triangle whose front the motion points at",
    };
    return texts[i];
}
static const choices starts = {"start", probe_start_name, probe_start_help};

static const char *probe_extent_name(int i)
{
    return mw_probe_extent_name((mw_probe_extent)i);
}
static const char *probe_extent_help(int i)
{
    static const char *const texts[MW_PROBE_EXTENT_COUNT] = {
        [MW_PROBE_LINE] = "all of the line, on both sides of the point",
        [MW_PROBE_RAY] = "the point, and what is ahead of it",
        [MW_PROBE_SEGMENT] = "from the point x,y,z to the point mx,my,mz",
    };
    return texts[i];
}
static const choices extents = {"extent", probe_extent_name, probe_extent_help};

static const char *probe_faces_name(int i)
{
    return mw_probe_faces_name((mw_probe_faces)i);
}
static const char *probe_faces_help(int i)
{
    static const char *const texts[MW_PROBE_FACES_COUNT] = {
        [MW_PROBE_FRONT] = "triangles at whose front the motion points",
        [MW_PROBE_BACK] = "triangles at whose back it points",
        [MW_PROBE_BOTH] = "both",
    };
    return texts[i];
}
static const choices faces = {"faces", probe_faces_name, probe_faces_help};

static const option probe_options[] = {
    {"max-distance", 0, OPTION_MAX_DISTANCE, offsetof(probe_settings, max_distance), "D",
     "touch nothing that is farther than D from the point, either way; 0: only what lies at the "
     "point (default: no "
     "limit)",
     NULL},
    {"certain", 0, OPTION_FLAG, offsetof(probe_settings, certain), NULL,
     "miss nothing: the nearest of all triangles on the line, or 'none'; builds boxes over the "
     "triangles",
     NULL},
    {"extent", 0, OPTION_CHOICE, offsetof(probe_settings, extent), "NAME",
     "which part of the line counts (default: line); ray and segment need --certain:", &extents},
    {"faces", 0, OPTION_CHOICE, offsetof(probe_settings, faces), "NAME",
     "which triangles count (default: front); back and both need --certain:", &faces},
    {"min-distance", 0, OPTION_LENGTH, offsetof(probe_settings, min_distance), "D",
     "touch nothing that is nearer than D to the point; needs --certain (default: 0)", NULL},
    {"inside", 0, OPTION_FLAG, offsetof(probe_settings, inside), NULL,
     "QUERIES holds points x,y,z only: which are inside of the closed SURFACE? Writes the status "
     "inside, outside, on or bad",
     NULL},
    {"all", 0, OPTION_FLAG, offsetof(probe_settings, all), NULL,
     "every triangle that counts, in their order along the motion: a row for each, with the column "
     "back; a row 'none' for a probe without any; with --certain",
     NULL},
    {"one-per-place", 0, OPTION_FLAG, offsetof(probe_settings, one_per_place), NULL,
     "with --all: of several triangles at one place only the lowest, as where the line meets an "
     "edge",
     NULL},
    {"nearest", 0, OPTION_FLAG, offsetof(probe_settings, nearest), NULL,
     "QUERIES holds points x,y,z only: the nearest point of SURFACE to each, written as "
     "status,triangle,distance,px,py,pz,w0,w1,w2",
     NULL},
    {"start", 0, OPTION_CHOICE, offsetof(probe_settings, start), "NAME",
     "how to choose the first triangle (default: auto):", &starts},
    {"guide", 0, OPTION_FLAG, offsetof(probe_settings, guide), NULL,
     "make a coarse grid first that leads to the first triangle of a walk: pays for some thousand "
     "queries in any order",
     NULL},
    {"samples", 0, OPTION_COUNT, offsetof(probe_settings, samples), "K",
     "look at K triangles for a first one (default: 0, twice the cube root of the number of "
     "vertices)",
     NULL},
    {"iterations", 0, OPTION_COUNT, offsetof(probe_settings, iterations), "N",
     "at most N walks for a query, from different first triangles (default: 0, which means 10)",
     NULL},
    {"race", 0, OPTION_COUNT, offsetof(probe_settings, race), "N",
     "run N walks for a query at a time, in threads, until one finds a triangle; where the line "
     "touches several, it "
     "may be another one each time, but not with --certain (default: 0, one walk)",
     NULL},
    {"weld", 0, OPTION_FLAG, offsetof(probe_settings, weld), NULL,
     "vertices with equal coordinates are one, so that walks cross the seams between them", NULL},
    {"any", 0, OPTION_FLAG, offsetof(probe_settings, any), NULL,
     "take also a surface with defects that 'meshwalk check --as surface' calls repeated-vertex, "
     "not-finite or edge-shared; 'meshwalk view' shows them",
     NULL},
    {"columns", 0, OPTION_TEXT, offsetof(probe_settings, stream.source.columns), "LIST",
     "columns of QUERIES that hold the point and the motion, six names or numbers from 1 (default: "
     "those that a header "
     "calls x, y, z, mx, my, mz, or the only six; with --inside and --nearest x, y, z)",
     NULL},
    {"strict", 0, OPTION_FLAG, offsetof(probe_settings, stream.strict), NULL,
     "exit with 1 if a row is 'limit' or 'bad'; 'none' is an answer", NULL},
    {0},
};

/* These replace the common options, whose help promises more than probes by walks can keep. */
static const option random_options[] = {
    {"threads", 0, OPTION_COUNT, offsetof(probe_settings, stream.common.threads), "N",
     "use at most N threads, those of --race apart (default: 0, all); without --race results do "
     "not depend on it",
     NULL},
    {"seed", 0, OPTION_SEED, offsetof(probe_settings, stream.common.seed), "S",
     "seed of everything random (default: 0); without --certain another seed may find another "
     "triangle, or one where "
     "this one finds none",
     NULL},
    {0},
};

#define MAX_RACERS 256 /* threads */

/* What only certain probes have. */
static int probe_check(const probe_settings *s)
{
    bool certain_only =
        s->extent != MW_PROBE_LINE || s->faces != MW_PROBE_FRONT || s->min_distance > 0;
    const char *why = NULL;
    if (s->inside && (certain_only || s->certain || s->max_distance > 0))
        why = "--inside takes no options of lines";
    else if (s->nearest && (certain_only || s->certain))
        why = "--nearest takes no options of lines but --max-distance";
    else if (s->inside + s->nearest + s->all > 1)
        why = "--all, --inside and --nearest ask for different answers";
    else if (s->all && !s->certain)
        why = "--all needs --certain";
    else if (s->one_per_place && !s->all)
        why = "--one-per-place needs --all";
    else if (certain_only && !s->certain)
        why = "--extent, --faces and --min-distance need --certain";
    else if (s->max_distance > 0 && s->min_distance > s->max_distance)
        why = "--min-distance is above --max-distance";
    if (why) complain("%s", why);
    return why ? END_USAGE : 0;
}

static int probe_run(const void *settings, const char *const *operands)
{
    const probe_settings *s = settings;
    probed_surface p = {.settings = s, .begin = monotonic_seconds()};
    int end = files_check_output(s->stream.common.output, operands, 2);
    if (end == 0) end = point_layers_check(operands, 2);
    if (end == 0) end = query_stream_check_output(&s->stream);
    if (end == 0) end = options_limit("race", s->race, MAX_RACERS, NULL);
    if (end == 0) end = probe_check(s);
    if (end == 0) end = probed_surface_open(&p, operands[0]);
    if (end == 0) end = probed_surface_run(&p, operands[1]);
    probed_surface_release(&p);
    return end;
}

static const option *const tables[] = {probe_options, query_stream_options, random_options,
                                       common_options, NULL};

const command probe_command = {
    .name = "probe",
    .operands = "SURFACE QUERIES",
    .operand_count = 2,
    .summary = "find the triangle of a surface that each probe touches",
    .description =
        "A row of QUERIES is x,y,z,mx,my,mz: the point where a probe is, and its motion. The "
        "probe touches a triangle of SURFACE that the line through the point along the motion "
        "meets, on either side of the point, if the motion points at the triangle's front: "
        "the side from which its corners are seen counter-clockwise. Writes every row "
        "unchanged, followed by status,triangle,distance,w0,w1,w2. The status is hit; none, "
        "if certainly nothing is touched; limit, if the walks found nothing, though there may "
        "be something; or bad, if the motion is zero or a number is not finite. The distance "
        "is negative behind the point; w0, w1, w2 are the weights of the triangle's corners. "
        "Of several triangles, walks report the first that they find, and --certain the "
        "nearest; with --all all of them, a row each. --nearest and --inside take points instead. "
        "'-' is standard input.",
    .options = tables,
    .essential = "certain max-distance columns only-answers output",
    .settings_size = sizeof(probe_settings),
    .run = probe_run,
};
