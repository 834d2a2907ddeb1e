/* walk - one walk, triangle by triangle: listed or drawn. */
#include "cli/commands/commands.h"
#include "cli/draw/drawing.h"
#include "cli/frame/files.h"
#include "cli/frame/message.h"
#include "cli/draw/picture.h"
#include "cli/frame/progress.h"
#include "cli/frame/row.h"
#include "cli/input/sphere.h"
#include "cli/input/taken_as.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

typedef struct walk_settings {
    taken_as taken;
    coordinates from, to;
    double max_distance;
    uint32_t samples, iterations;
    int walk; /* number of a name below */
} walk_settings;

/* --- options ------------------------------------------------------------------------------------------------------ */

/* The walks of the plane, then those that only stars have. */
static const char *name_of(int i)
{
    if (i < MW_WALK_COUNT) return mw_walk_name((mw_walk_kind)i);
    i -= MW_WALK_COUNT;
    for (int s = 0; s < MW_STAR_WALK_COUNT; s++) {
        const char *name = mw_star_walk_name((mw_star_walk_kind)s);
        if (mw_walk_by_name(name) == MW_WALK_COUNT && i-- == 0) return name;
    }
    return NULL;
}

static const char *help_of(int i)
{
    return i < MW_WALK_COUNT ? mw_walk_help((mw_walk_kind)i) : mw_star_walk_help(mw_star_walk_by_name(name_of(i)));
}

static const choices walks = {"walk", name_of, help_of};

static const option walk_options[] = {
    {"from", 0, OPTION_PLACE, offsetof(walk_settings, from), "X,Y",
     "where the walk begins; --as surface: X,Y,Z, the point where the probe is; --as star: X,Y,Z, a point that the ray "
     "goes through, or with --lonlat LON,LAT",
     NULL},
    {"to", 0, OPTION_PLACE, offsetof(walk_settings, to), "X,Y",
     "where it is to end, likewise; --as surface: a point that the probe's motion points at", NULL},
    {"walk", 0, OPTION_CHOICE, offsetof(walk_settings, walk), "NAME",
     "how to walk (default: auto). --as plane takes all of these but forgetful, and --as star auto, stochastic, "
     "forgetful, barycentric, orthogonal and straight; a probe has one walk:",
     &walks},
    {"max-distance", 0, OPTION_REACH, offsetof(walk_settings, max_distance), "D",
     "--as surface: touch nothing that is farther than D from the point, either way; 0: only what lies at the point "
     "(default: no limit)",
     NULL},
    {"samples", 0, OPTION_COUNT, offsetof(walk_settings, samples), "K",
     "--as surface: look at K triangles for a first one (default: 0, twice the cube root of the number of vertices)",
     NULL},
    {"iterations", 0, OPTION_COUNT, offsetof(walk_settings, iterations), "N",
     "--as surface: at most N walks, from different first triangles (default: 0, which means 10)", NULL},
    {0},
};

static int wants(const char *name, const char *what)
{
    complain("option '--%s' wants %s", name, what);
    return END_USAGE;
}

static int check_place(const walk_settings *s, const char *name, const coordinates *at)
{
    bool flat = s->taken.as == AS_PLANE || s->taken.lonlat;
    if (at->count == 0) {
        complain("option '--%s' is missing: where does the walk %s?", name, at == &s->from ? "begin" : "end");
        return END_USAGE;
    }
    if (at->count == (flat ? 2 : 3)) return 0;
    return wants(name, s->taken.lonlat ? "LON,LAT with --lonlat" : flat ? "X,Y with --as plane" : "X,Y,Z in space");
}

static int check_walk(const walk_settings *s)
{
    const char *name = name_of(s->walk);
    if (s->taken.as == AS_SURFACE && s->walk != MW_WALK_AUTO) return wants("walk", "--as plane or --as star");
    bool known = s->taken.as == AS_STAR ? mw_star_walk_by_name(name) != MW_STAR_WALK_COUNT : s->walk < MW_WALK_COUNT;
    if (known) return 0;
    complain("there is no walk '%s' with --as %s", name, s->taken.as == AS_STAR ? "star" : "plane");
    return END_USAGE;
}

/* A list goes to standard output, or to a .csv; a picture into a file with another ending. */
static int check_output(const char *path)
{
    const char *ending = files_is_stream(path) ? NULL : strrchr(path, '.');
    if (files_is_stream(path) || (ending && strcasecmp(ending, ".csv") == 0)) return 0;
    if (picture_named(path)) return picture_check(path);
    complain("%s: a list of triangles is a .csv file, a picture an .svg, .png or .pdf file", path);
    return END_USAGE;
}

static int check_options(const walk_settings *s)
{
    int end = check_place(s, "from", &s->from);
    if (end == 0) end = check_place(s, "to", &s->to);
    if (end == 0) end = check_walk(s);
    if (end == 0 && s->taken.as != AS_SURFACE) {
        if (s->max_distance > 0) return wants("max-distance", "--as surface");
        if (s->samples > 0) return wants("samples", "--as surface");
        if (s->iterations > 0) return wants("iterations", "--as surface");
    }
    return end ? end : check_output(s->taken.common.output);
}

/* --- the walk ----------------------------------------------------------------------------------------------------- */

/* What is known of it. */
typedef struct way {
    const walk_settings *settings;
    const char *path; /* of the mesh */
    const mw_mesh_file *file;
    uint32_t *triangles, *iteration;
    size_t count, capacity;
    double *line; /* x, y, z of points from FROM to TO */
    size_t line_count;
} way;

static void remark(const way *w, const char *name, const char *what)
{
    if (!w->settings->taken.common.quiet) complain("%s: %s %s", w->path, name, what);
}

/* A walk has visited so many triangles. True: there was no room for them; now there is, and it is to be walked anew. */
static bool lacks_room(way *w, size_t count, int *end)
{
    w->count = count;
    if (count <= w->capacity) return false;
    free(w->triangles);
    free(w->iteration);
    w->triangles = malloc(count * sizeof *w->triangles);
    w->iteration = calloc(count, sizeof *w->iteration);
    w->capacity = count;
    if (w->triangles && w->iteration) return true;
    w->count = w->capacity = 0;
    *end = fail_memory();
    return false;
}

static bool make_line(way *w, size_t count)
{
    w->line = calloc(3 * count, sizeof *w->line);
    w->line_count = w->line ? count : 0;
    return w->line;
}

/* The straight line. */
static int draw_line(way *w)
{
    if (!make_line(w, 2)) return fail_memory();
    memcpy(w->line, w->settings->from.at, 3 * sizeof(double));
    memcpy(w->line + 3, w->settings->to.at, 3 * sizeof(double));
    return 0;
}

static int fail_input(const way *w, const char *as, const mw_error *error)
{
    int end = fail_mesh(w->path, error);
    if (end == END_INPUT) complain("'meshwalk check%s %s' lists every defect", as, w->path);
    return end;
}

/* --- in the plane --- */

static void remark_outside(const way *w, const char *name, const mw_location *at, const char *then)
{
    char words[128];
    if (at->where != MW_OUTSIDE && at->where != MW_IN_HOLE) return;
    snprintf(words, sizeof words, "%s%s", at->where == MW_OUTSIDE ? "lies outside the mesh" : "lies in a hole", then);
    remark(w, name, words);
}

static int walk_in_plane(way *w, const mw_locator *locator)
{
    const walk_settings *s = w->settings;
    mw_error error;
    mw_cursor begin, cursor;
    mw_location from, to;
    int end = 0;
    mw_query_options options = {.walk = (mw_walk_kind)s->walk, .start = MW_START_LAST, .seed = s->taken.common.seed};
    if (mw_cursor_init(locator, &options, &begin, &error) != MW_OK) return fail_query(&error);
    from = mw_locate(locator, &begin, s->from.at[0], s->from.at[1]);
    do cursor = begin;
    while (
        lacks_room(w, mw_walk_path(locator, &cursor, s->to.at[0], s->to.at[1], w->triangles, w->capacity, &to), &end));
    remark_outside(w, "--from", &from, ": the walk begins where one to it ends");
    remark_outside(w, "--to", &to, "");
    return end ? end : draw_line(w);
}

/* The border walk is there to go round what others cross. */
static int walk_plane(way *w)
{
    mw_error error;
    mw_mesh *mesh = NULL;
    mw_locator *locator = NULL;
    mw_arrays arrays = mw_mesh_file_arrays(w->file);
    mw_locator_options options = {.fill = w->settings->walk == MW_WALK_BORDER ? MW_FILL_NO : MW_FILL_YES};
    bool made = mw_mesh_create(&arrays, NULL, &mesh, &error) == MW_OK &&
                mw_locator_create(mesh, &options, &locator, &error) == MW_OK;
    int end = made ? walk_in_plane(w, locator) : fail_input(w, "", &error);
    mw_locator_destroy(locator);
    mw_mesh_destroy(mesh);
    return end;
}

/* --- on a polyhedron --- */

/* The point in space that a FROM or TO stands for. */
static int ray_to(const walk_settings *s, const char *name, const coordinates *where, double point[3])
{
    const double *centre = s->taken.centre.at;
    memcpy(point, where->at, 3 * sizeof *point);
    if (s->taken.lonlat) sphere_directions(where->at, 2, 1, centre, 1, point);
    if (isnan(point[0])) return wants(name, "a latitude from -90 to 90");
    if (memcmp(point, centre, 3 * sizeof *point) != 0) return 0;
    return wants(name, "another point than the centre: no ray goes from there to there");
}

/* A unit vector from the centre; of a long one too. */
static void unit(const double centre[3], const double point[3], double d[3])
{
    double largest = 0;
    for (int k = 0; k < 3; k++) {
        d[k] = point[k] / 2 - centre[k] / 2;
        largest = fmax(largest, fabs(d[k]));
    }
    for (int k = 0; k < 3; k++) d[k] /= largest;
    double length = sqrt(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]);
    for (int k = 0; k < 3; k++) d[k] /= length;
}

/* Where the ray along d meets the polyhedron. */
static void hit(const mw_star *star, const mw_surface *surface, mw_star_cursor *cursor, const double centre[3],
                double reach, const double d[3], double point[3])
{
    double ray[3], corner[3];
    uint32_t v[3];
    for (int k = 0; k < 3; k++) ray[k] = centre[k] + reach * d[k];
    mw_location at = mw_star_locate(star, cursor, ray);
    for (int k = 0; k < 3; k++) point[k] = NAN;
    if (at.triangle == MW_NONE) return;
    mw_surface_triangle(surface, at.triangle, v);
    memset(point, 0, 3 * sizeof *point);
    for (int i = 0; i < 3; i++) {
        mw_surface_vertex(surface, v[i], corner);
        for (int k = 0; k < 3; k++) point[k] += at.weight[i] * corner[k];
    }
}

static double angle_between(const double u[3], const double v[3])
{
    return acos(fmax(-1, fmin(1, u[0] * v[0] + u[1] * v[1] + u[2] * v[2])));
}

/* A direction between two that are `angle` apart. */
static void between(const double u[3], const double v[3], double angle, double part, double d[3])
{
    double a = 1 - part, b = part;
    if (angle > 0x1p-20 && part > 0 && part < 1) { /* else the sines are as good as the angles */
        a = sin(a * angle);
        b = sin(b * angle);
    }
    for (int k = 0; k < 3; k++) d[k] = a * u[k] + b * v[k];
}

/* The shorter way from FROM to TO in the plane through both and the centre; a straight walk follows it. Between opposite
 * directions, or such as rounding hardly tells from them, there is no such plane: the line has its ends only. */
static int draw_arc(way *w, const mw_star *star, const mw_surface *surface, const double from[3], const double to[3])
{
    enum { PARTS = 256 };
    const double *centre = w->settings->taken.centre.at;
    mw_star_cursor cursor;
    mw_error error;
    double u[3], v[3], d[3];
    if (!make_line(w, PARTS + 1)) return fail_memory();
    if (mw_star_cursor_init(star, NULL, &cursor, &error) != MW_OK) return fail_query(&error);
    unit(centre, from, u);
    unit(centre, to, v);
    double angle = angle_between(u, v), reach = 1;
    bool opposite = angle > acos(-1) - 0x1p-15;
    for (int k = 0; k < 3; k++) reach = fmax(reach, fabs(centre[k]));
    for (int i = 0; i <= PARTS; i++) {
        between(u, v, angle, (double)i / PARTS, d);
        if (opposite && i > 0 && i < PARTS) memcpy(d, (const double[]){NAN, NAN, NAN}, sizeof d);
        hit(star, surface, &cursor, centre, reach, d, w->line + 3 * i);
    }
    return 0;
}

static int walk_on_star(way *w, const mw_star *star, const mw_surface *surface)
{
    const walk_settings *s = w->settings;
    mw_error error;
    mw_star_cursor begin, cursor;
    double from[3], to[3];
    mw_star_query_options options = {
        .walk = mw_star_walk_by_name(name_of(s->walk)), .start = MW_STAR_START_LAST, .seed = s->taken.common.seed};
    int end = ray_to(s, "from", &s->from, from);
    if (end == 0) end = ray_to(s, "to", &s->to, to);
    if (end) return end;
    if (mw_star_cursor_init(star, &options, &begin, &error) != MW_OK) return fail_query(&error);
    mw_star_locate(star, &begin, from);
    do cursor = begin;
    while (lacks_room(w, mw_star_path(star, &cursor, to, w->triangles, w->capacity, NULL), &end));
    return end ? end : draw_arc(w, star, surface, from, to);
}

static int walk_star(way *w)
{
    const walk_settings *s = w->settings;
    mw_error error;
    mw_surface *surface = NULL;
    mw_star *star = NULL;
    mw_arrays arrays = mw_mesh_file_arrays(w->file);
    mw_surface_options welded = {.weld = 1};
    mw_star_options options = {.centre = {s->taken.centre.at[0], s->taken.centre.at[1], s->taken.centre.at[2]},
                               .angles = strcmp(name_of(s->walk), "orthogonal") == 0};
    bool made = mw_surface_create(&arrays, &welded, &surface, &error) == MW_OK &&
                mw_star_create(surface, &options, &star, &error) == MW_OK;
    int end = made ? walk_on_star(w, star, surface) : fail_input(w, " --as star", &error);
    mw_star_destroy(star);
    mw_surface_destroy(surface);
    return end;
}

/* --- on a surface --- */

static int walk_of_probe(way *w, const mw_prober *prober)
{
    const walk_settings *s = w->settings;
    mw_error error;
    mw_touch touch;
    mw_probe_cursor begin, cursor;
    double motion[3];
    int end = 0;
    mw_probe_options options = {.max_distance = s->max_distance,
                                .start = MW_PROBE_START_SAMPLE,
                                .samples = s->samples,
                                .iterations = s->iterations,
                                .seed = s->taken.common.seed};
    if (mw_probe_cursor_init(prober, &options, &begin, &error) != MW_OK) return fail_query(&error);
    for (int k = 0; k < 3; k++) motion[k] = s->to.at[k] - s->from.at[k];
    do cursor = begin;
    while (lacks_room(
        w, mw_probe_path(prober, &cursor, s->from.at, motion, w->triangles, w->iteration, w->capacity, &touch), &end));
    if (touch.state == MW_TOUCH_BAD) return wants("to", "another point than --from, and not too far away: a motion");
    if (touch.state == MW_TOUCH_LIMIT) remark(w, "the probe", "touched nothing: its walks ended without a triangle");
    return end ? end : draw_line(w);
}

static int walk_surface(way *w)
{
    const walk_settings *s = w->settings;
    mw_error error;
    mw_surface *surface = NULL;
    mw_prober *prober = NULL;
    mw_arrays arrays = mw_mesh_file_arrays(w->file);
    mw_surface_options options = {.weld = s->taken.weld};
    bool made = mw_surface_create(&arrays, &options, &surface, &error) == MW_OK &&
                mw_prober_create(surface, NULL, &prober, &error) == MW_OK;
    int end = made ? walk_of_probe(w, prober) : fail_input(w, " --as surface", &error);
    mw_prober_destroy(prober);
    mw_surface_destroy(surface);
    return end;
}

/* --- list and picture --------------------------------------------------------------------------------------------- */

static int write_list(const way *w)
{
    text t = {0};
    text_string(&t, "step,triangle,iteration\n");
    for (size_t i = 0; i < w->count; i++)
        text_printf(&t, "%zu,%lu,%lu\n", i, (unsigned long)w->triangles[i], (unsigned long)w->iteration[i]);
    return files_write_text(w->settings->taken.common.output, &t);
}

static int write_picture(const way *w)
{
    static const drawing_view views[] = {[AS_PLANE] = VIEW_PLANE, [AS_SURFACE] = VIEW_SURFACE, [AS_STAR] = VIEW_STAR};
    const walk_settings *s = w->settings;
    char caption[160];
    const char *name = strrchr(w->path, '/'), *walk = s->taken.as == AS_SURFACE ? "probe" : name_of(s->walk);
    snprintf(caption, sizeof caption, "%.100s: %s, %zu triangle%s", name ? name + 1 : w->path, walk, w->count,
             w->count == 1 ? "" : "s");
    drawing d = {.view = views[s->taken.as],
                 .centre = {s->taken.centre.at[0], s->taken.centre.at[1], s->taken.centre.at[2]},
                 .caption = caption,
                 .points = w->file->points,
                 .triangles = w->file->triangles,
                 .point_count = w->file->point_count,
                 .triangle_count = w->file->triangle_count,
                 .path = w->triangles,
                 .iteration = w->iteration,
                 .path_count = w->count,
                 .line = w->line,
                 .line_count = w->line_count};
    progress_phase("drawing", s->taken.common.output);
    return drawing_write(&d, s->taken.common.output);
}

static int walk_and_write(way *w)
{
    const walk_settings *s = w->settings;
    progress_phase("walking", w->path);
    int end = s->taken.as == AS_PLANE ? walk_plane(w) : s->taken.as == AS_STAR ? walk_star(w) : walk_surface(w);
    if (end) return end;
    bool picture = !files_is_stream(s->taken.common.output) && picture_named(s->taken.common.output);
    return picture ? write_picture(w) : write_list(w);
}

static int run(const void *settings, const char *const *operands)
{
    const walk_settings *s = settings;
    mw_mesh_file file = {0};
    way w = {.settings = s, .path = operands[0], .file = &file};
    int end = check_options(s);
    if (end == 0) end = taken_as_read(&s->taken, operands, &file);
    if (end == 0) end = walk_and_write(&w);
    free(w.triangles);
    free(w.iteration);
    free(w.line);
    mw_mesh_file_release(&file);
    return end;
}

static const option *const tables[] = {walk_options, taken_as_options, common_options, NULL};

const command walk_command = {
    .name = "walk",
    .operands = "MESH",
    .operand_count = 1,
    .summary = "draw or list one walk, triangle by triangle",
    .description =
        "Walks through MESH from the triangle that contains --from to the one that contains --to, and writes the "
        "triangles visited: as a list, step,triangle,iteration, in order and numbered from 0; or as a picture, if the "
        "output is an .svg, .png or .pdf file. With --as star, the walk goes over the facets of a polyhedron from one "
        "ray to the other. With --as surface, it is that of a probe at --from that moves towards --to, and iteration "
        "is the number of its walk; it begins in a triangle chosen at random. '-' is standard input.",
    .options = tables,
    .settings_size = sizeof(walk_settings),
    .run = run,
};
