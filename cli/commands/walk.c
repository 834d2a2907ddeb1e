/* walk - one walk, triangle by triangle: listed or drawn. */
#include "cli/commands/commands.h"
#include "cli/draw/animation.h"
#include "cli/draw/drawing.h"
#include "cli/draw/picture.h"
#include "cli/draw/plane_picture.h"
#include "cli/frame/files.h"
#include "cli/frame/message.h"
#include "cli/frame/progress.h"
#include "cli/input/lonlat_input.h"
#include "cli/input/mesh_space.h"
#include "src/base/posix.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

typedef struct walk_settings {
    mesh_space_settings mesh;
    coordinates from, to;
    double max_distance;
    uint32_t samples, iterations;
    const char *animate;
    bool plane;     /* in space: a picture in the plane of the walk */
    int grid;       /* GRID_NONE, ... */
    uint32_t cells; /* of the grid; 0: 32 */
    int walk; /* mw_walk_kind, or MW_WALK_COUNT for all; a polyhedron has the walk of that name */
} walk_settings;

enum { GRID_NONE = 0, GRID_UNIFORM, GRID_NONUNIFORM };

/* --- options ---------------------------------------------------------------------------------- */

static const char *walk_grid_name(int i)
{
    return (const char *[]){"none", "uniform", "nonuniform", NULL}[i];
}

static const choices walk_grid_choices = {"grid", walk_grid_name, NULL};

/* The walks of the plane, and all of them. */
static const char *walk_choice_name(int i)
{
    return i < MW_WALK_COUNT ? mw_walk_name((mw_walk_kind)i) : i == MW_WALK_COUNT ? "all" : NULL;
}

static const char *walk_choice_help(int i)
{
    return i < MW_WALK_COUNT ? mw_walk_help((mw_walk_kind)i)
                             : "a picture of each, beside one another; with --animate a race";
}

static const choices walk_choices = {"walk", walk_choice_name, walk_choice_help};

static const option walk_options[] = {
    {"from", 0, OPTION_XY_OR_XYZ, offsetof(walk_settings, from), "X,Y",
     "where the walk begins; --as surface: X,Y,Z, the point where the probe is; --as star: X,Y,Z, "
     "a point that the ray "
     "goes through, or with --lonlat LON,LAT",
     NULL},
    {"to", 0, OPTION_XY_OR_XYZ, offsetof(walk_settings, to), "X,Y",
     "where the walk ends, in the same form; --as surface: a point that the probe's motion points "
     "at",
     NULL},
    {"walk", 0, OPTION_CHOICE, offsetof(walk_settings, walk), "NAME",
     "how to walk (default: auto). --as plane takes all of these, and --as star auto, stochastic, "
     "forgetful, barycentric, orthogonal and straight; a probe has one walk:",
     &walk_choices},
    {"animate", 0, OPTION_TEXT, offsetof(walk_settings, animate), "FILE",
     "show the walk step by step in FILE, an animated PNG (.png or .apng); the list or picture of "
     "the whole is then "
     "written "
     "only with -o",
     NULL},
    {"plane", 0, OPTION_FLAG, offsetof(walk_settings, plane), NULL,
     "draw the picture in a plane: --as star, that of longitude and polar angle; --as surface, the "
     "one through the line of motion along which the last walk goes",
     NULL},
    {"grid", 0, OPTION_CHOICE, offsetof(walk_settings, grid), "NAME",
     "--as star --plane: begin the walk by a grid, and draw it, with the first facet of each cell; "
     "then --from is not needed (default: none):",
     &walk_grid_choices},
    {"cells", 0, OPTION_COUNT, offsetof(walk_settings, cells), "N",
     "--grid: about N cells (default: 0, which means 32)", NULL},
    {"max-distance", 0, OPTION_MAX_DISTANCE, offsetof(walk_settings, max_distance), "D",
     "--as surface: touch nothing that is farther than D from the point, either way; 0: only what "
     "lies at the point "
     "(default: no limit)",
     NULL},
    {"samples", 0, OPTION_COUNT, offsetof(walk_settings, samples), "K",
     "--as surface: look at K triangles for a first one (default: 0, twice the cube root of the "
     "number of vertices)",
     NULL},
    {"iterations", 0, OPTION_COUNT, offsetof(walk_settings, iterations), "N",
     "--as surface: at most N walks, from different first triangles (default: 0, which means 10)",
     NULL},
    {0},
};

static int walk_option_needs(const char *name, const char *what)
{
    complain("option '--%s' needs %s", name, what);
    return END_USAGE;
}

static int walk_option_must_be(const char *name, const char *what)
{
    complain("option '--%s' must be %s", name, what);
    return END_USAGE;
}

static int walk_check_coordinates(const walk_settings *s, const char *name, const coordinates *at)
{
    bool flat = s->mesh.space == SPACE_PLANE || s->mesh.lonlat;
    if (at->count == 0) {
        complain("option '--%s' is missing: where does the walk %s?", name,
                 at == &s->from ? "begin" : "end");
        return END_USAGE;
    }
    if (at->count == (flat ? 2 : 3)) return 0;
    return walk_option_must_be(name, s->mesh.lonlat ? "LON,LAT with --lonlat"
                                     : flat         ? "X,Y with --as plane"
                                                    : "X,Y,Z in space");
}

static bool walk_writes_picture(const walk_settings *s)
{
    return !files_is_standard(s->mesh.common.output) && picture_named(s->mesh.common.output);
}

static int walk_check_name(const walk_settings *s)
{
    const char *name = walk_choice_name(s->walk);
    if (s->mesh.space == SPACE_SURFACE && s->walk != MW_WALK_AUTO)
        return walk_option_needs("walk", "--as plane or --as star");
    bool drawn = walk_writes_picture(s) || (s->animate && !s->mesh.common.output);
    if (s->walk == MW_WALK_COUNT && (s->mesh.space != SPACE_PLANE || !drawn)) {
        complain("--walk all needs --as plane and a picture: -o FILE.svg or --animate FILE.png");
        return END_USAGE;
    }
    if (s->mesh.space != SPACE_STAR || mw_star_walk_by_name(name) != MW_STAR_WALK_COUNT) return 0;
    complain("there is no walk '%s' with --as star", name);
    return END_USAGE;
}

/* A list goes to standard output or to a .csv file, a picture to an .svg, .png or .pdf file. */
static int walk_check_output(const char *path)
{
    const char *ending = files_is_standard(path) ? NULL : strrchr(path, '.');
    if (files_is_standard(path) || (ending && strcasecmp(ending, ".csv") == 0)) return 0;
    if (picture_named(path)) return picture_check(path);
    complain("%s: a list of triangles is a .csv file, a picture an .svg, .png or .pdf file", path);
    return END_USAGE;
}

static int walk_check_animation(const walk_settings *s, const char *const *operands)
{
    const char *path = s->animate, *output = s->mesh.common.output;
    if (!path) return 0;
    if (!animation_named(path)) return walk_option_must_be("animate", "a .png or .apng file");
    if (!files_is_standard(output) && files_same_output(path, output))
        return walk_option_must_be("animate", "another file than --output");
    int end = files_check_output(path, operands, 1);
    if (end == 0) end = picture_check(path);
    return end ? end : files_try_output(path, NULL);
}

static int walk_check_plane(const walk_settings *s)
{
    const bool drawn = walk_writes_picture(s) || s->animate;
    if (s->plane && s->mesh.space == SPACE_PLANE)
        return walk_option_needs("plane", "--as star or --as surface");
    if (s->plane && !drawn)
        return walk_option_needs("plane", "a picture: -o FILE.svg or --animate FILE.png");
    if (s->grid && !(s->plane && s->mesh.space == SPACE_STAR))
        return walk_option_needs("grid", "--as star --plane");
    if (s->cells && !s->grid) return walk_option_needs("cells", "--grid");
    return options_limit("cells", s->cells, 100000, "100000");
}

static int walk_check_options(const walk_settings *s, const char *const *operands)
{
    int end = walk_check_plane(s);
    if (end == 0 && !(s->grid && s->from.count == 0))
        end = walk_check_coordinates(s, "from", &s->from);
    if (end == 0) end = walk_check_coordinates(s, "to", &s->to);
    if (end == 0) end = walk_check_name(s);
    if (end == 0 && s->mesh.space != SPACE_SURFACE) {
        if (s->max_distance > 0) return walk_option_needs("max-distance", "--as surface");
        if (s->samples > 0) return walk_option_needs("samples", "--as surface");
        if (s->iterations > 0) return walk_option_needs("iterations", "--as surface");
    }
    if (end == 0) end = walk_check_output(s->mesh.common.output);
    return end ? end : walk_check_animation(s, operands);
}

/* --- the walk --------------------------------------------------------------------------------- */

/* The walk as it is recorded. */
typedef struct walk_record {
    const walk_settings *settings;
    const char *path; /* of the mesh */
    const mw_mesh_file *file;
    mw_walk_kind walk; /* in the plane */
    uint32_t *triangles, *iteration;
    uint8_t *stages; /* in the plane */
    size_t count, capacity;
    double *line; /* x, y, z of points on the line from FROM to TO, or that the walk follows */
    size_t line_count;
    grid_cell *cells; /* of --grid */
    size_t cell_count;
    uint8_t *marks; /* per facet: is it the first one of a cell? */
} walk_record;

static uint32_t walk_grid_cells(const walk_record *w)
{
    return w->settings->cells ? w->settings->cells : 32;
}

static void walk_remark(const walk_record *w, const char *name, const char *what)
{
    if (!w->settings->mesh.common.quiet) complain("%s: %s %s", w->path, name, what);
}

/* Store the number of triangles that a walk visited. Returns true if the arrays were too small:
 * they are then enlarged, and the walk must be repeated. */
static bool walk_record_lacks_room(walk_record *w, size_t count, int *end)
{
    w->count = count;
    if (count <= w->capacity) return false;
    free(w->triangles);
    free(w->iteration);
    free(w->stages);
    w->triangles = malloc(count * sizeof *w->triangles);
    w->iteration = calloc(count, sizeof *w->iteration);
    w->stages = calloc(count, sizeof *w->stages);
    w->capacity = count;
    if (w->triangles && w->iteration && w->stages) return true;
    w->count = w->capacity = 0;
    *end = fail_memory();
    return false;
}

static bool walk_record_make_line(walk_record *w, size_t count)
{
    w->line = calloc(3 * count, sizeof *w->line);
    w->line_count = w->line ? count : 0;
    return w->line;
}

/* Record the straight line from FROM to TO. */
static int walk_record_line(walk_record *w)
{
    if (!walk_record_make_line(w, 2)) return fail_memory();
    memcpy(w->line, w->settings->from.at, 3 * sizeof(double));
    memcpy(w->line + 3, w->settings->to.at, 3 * sizeof(double));
    return 0;
}

static int walk_fail_mesh(const walk_record *w, const char *as, const mw_error *error)
{
    int end = fail_mesh(w->path, error);
    if (end == END_INPUT)
        complain("'meshwalk check%s %s' lists every defect, 'meshwalk view' shows it", as, w->path);
    return end;
}

/* --- in the plane ----------------------------------------------------------------------------- */

static void walk_remark_outside(const walk_record *w, const char *name, const mw_location *at,
                                const char *then)
{
    char words[128];
    if (at->where != MW_OUTSIDE && at->where != MW_IN_HOLE) return;
    snprintf(words, sizeof words, "%s%s",
             at->where == MW_OUTSIDE ? "lies outside the mesh" : "lies in a hole", then);
    walk_remark(w, name, words);
}

/* Record the line that the walk follows; if it follows none, only its ends. */
static int walk_record_way(walk_record *w, const mw_walk_way *way)
{
    const walk_settings *s = w->settings;
    uint32_t points = way->line_points ? way->line_points : 3;
    if (!walk_record_make_line(w, points)) return fail_memory();
    for (uint32_t i = 0; i < way->line_points; i++)
        memcpy(w->line + 3 * i, way->line[i], 2 * sizeof(double));
    if (way->line_points) return 0;
    memcpy(w->line, s->from.at, 2 * sizeof(double));
    w->line[3] = w->line[4] = NAN;
    memcpy(w->line + 6, s->to.at, 2 * sizeof(double));
    return 0;
}

static int walk_in_plane(walk_record *w, const mw_locator *locator)
{
    const walk_settings *s = w->settings;
    mw_error error;
    mw_cursor begin, cursor;
    mw_location from, to;
    mw_walk_way way;
    int end = 0;
    mw_query_options options = {
        .walk = w->walk, .start = MW_START_LAST, .seed = s->mesh.common.seed};
    if (mw_cursor_init(locator, &options, &begin, &error) != MW_OK) return fail_query(&error);
    from = mw_locate(locator, &begin, s->from.at[0], s->from.at[1]);
    do {
        cursor = begin;
        way =
            (mw_walk_way){.triangles = w->triangles, .stages = w->stages, .capacity = w->capacity};
    } while (walk_record_lacks_room(
        w, mw_walk_follow(locator, &cursor, s->to.at[0], s->to.at[1], &way, &to), &end));
    walk_remark_outside(w, "--from", &from, ": the walk begins where one to it ends");
    walk_remark_outside(w, "--to", &to, "");
    return end ? end : walk_record_way(w, &way);
}

/* Pockets and holes stay open for the border walk only: it goes round them; other walks cross them.
 */
static int walk_plane(walk_record *w)
{
    mw_error error;
    mw_mesh *mesh = NULL;
    mw_locator *locator = NULL;
    mw_arrays arrays = mw_mesh_file_arrays(w->file);
    const uint32_t threads = w->settings->mesh.common.threads;
    mw_mesh_options how = {.threads = threads, .progress = progress_of_call()};
    mw_locator_options options = {.fill = w->walk == MW_WALK_BORDER ? MW_FILL_NO : MW_FILL_YES,
                                  .threads = threads,
                                  .progress = progress_of_call()};
    bool made = mw_mesh_create(&arrays, &how, &mesh, &error) == MW_OK &&
                mw_locator_create(mesh, &options, &locator, &error) == MW_OK;
    int end = made ? walk_in_plane(w, locator) : walk_fail_mesh(w, "", &error);
    mw_locator_destroy(locator);
    mw_mesh_destroy(mesh);
    return end;
}

/* --- on a polyhedron -------------------------------------------------------------------------- */

/* The point in space that FROM or TO means. */
static int ray_point(const walk_settings *s, const char *name, const coordinates *where,
                     double point[3])
{
    const double *centre = s->mesh.centre.at;
    memcpy(point, where->at, 3 * sizeof *point);
    if (s->mesh.lonlat) lonlat_input_directions(where->at, 2, 1, centre, 1, point);
    if (isnan(point[0])) return walk_option_must_be(name, "a latitude from -90 to 90");
    if (memcmp(point, centre, 3 * sizeof *point) != 0) return 0;
    return walk_option_must_be(name,
                               "another point than the centre: no ray goes from there to there");
}

/* The unit vector from the centre towards a point. Halves and the largest coordinate prevent an
 * overflow. */
static void ray_unit_direction(const double centre[3], const double point[3], double d[3])
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

/* The point where the ray along d meets the polyhedron; NaN if it meets none. */
static void ray_hit(const mw_star *star, const mw_surface *surface, mw_star_cursor *cursor,
                    const double centre[3], double reach, const double d[3], double point[3])
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

/* A direction on the way from u to v, which are `angle` apart. */
static void direction_between(const double u[3], const double v[3], double angle, double part,
                              double d[3])
{
    double a = 1 - part, b = part;
    /* The sines of smaller angles are as good as equal to the angles. */
    if (angle > 0x1p-20 && part > 0 && part < 1) {
        a = sin(a * angle);
        b = sin(b * angle);
    }
    for (int k = 0; k < 3; k++) d[k] = a * u[k] + b * v[k];
}

/* Record the shorter arc from FROM to TO in the plane through both and the centre, which the
 * straight walk follows. Opposite directions, or nearly opposite ones, have no such plane: the line
 * then has only its ends. */
static int walk_record_arc(walk_record *w, const mw_star *star, const mw_surface *surface,
                           const double from[3], const double to[3])
{
    enum { PARTS = 256 };
    const double *centre = w->settings->mesh.centre.at;
    mw_star_cursor cursor;
    mw_error error;
    double u[3], v[3], d[3];
    if (!walk_record_make_line(w, PARTS + 1)) return fail_memory();
    if (mw_star_cursor_init(star, NULL, &cursor, &error) != MW_OK) return fail_query(&error);
    ray_unit_direction(centre, from, u);
    ray_unit_direction(centre, to, v);
    double angle = angle_between(u, v), reach = 1;
    bool opposite = angle > acos(-1) - 0x1p-15;
    for (int k = 0; k < 3; k++) reach = fmax(reach, fabs(centre[k]));
    for (int i = 0; i <= PARTS; i++) {
        direction_between(u, v, angle, (double)i / PARTS, d);
        if (opposite && i > 0 && i < PARTS) memcpy(d, (const double[]){NAN, NAN, NAN}, sizeof d);
        ray_hit(star, surface, &cursor, centre, reach, d, w->line + 3 * i);
    }
    return 0;
}

/* Mark the facets at the middles of the cells of the grid. */
static int walk_mark_first_facets(walk_record *w, const mw_star *star)
{
    const double *centre = w->settings->mesh.centre.at;
    mw_star_cursor cursor;
    mw_error error;
    double reach = 1;
    w->cells =
        grid_cells_make(walk_grid_cells(w), w->settings->grid == GRID_UNIFORM, &w->cell_count);
    w->marks = calloc(w->file->triangle_count, sizeof *w->marks);
    if (!w->cells || !w->marks) return fail_memory();
    if (mw_star_cursor_init(star, NULL, &cursor, &error) != MW_OK) return fail_query(&error);
    for (int k = 0; k < 3; k++) reach = fmax(reach, fabs(centre[k]));
    for (size_t i = 0; i < w->cell_count; i++) {
        double d[3];
        grid_cell_direction(&w->cells[i], d);
        for (int k = 0; k < 3; k++) d[k] = centre[k] + reach * d[k];
        const mw_location at = mw_star_locate(star, &cursor, d);
        if (at.triangle != MW_NONE) w->marks[at.triangle] = 1;
    }
    return 0;
}

static int walk_make_index(const walk_record *w, const mw_star *star, mw_star_start_kind *start,
                           mw_star_index **index)
{
    mw_error error;
    const mw_star_index_options options = {.cells = walk_grid_cells(w),
                                           .progress = progress_of_call()};
    if (!w->settings->grid) return 0;
    *start = w->settings->grid == GRID_UNIFORM ? MW_STAR_START_GRID : MW_STAR_START_NONUNIFORM_GRID;
    return mw_star_index_create(star, *start, &options, index, &error) == MW_OK
               ? 0
               : fail_query(&error);
}

/* The middle of the first facet: where a walk by a grid begins. */
static void walk_first_middle(const walk_record *w, double from[3])
{
    for (size_t k = 0; k < 3; k++) {
        from[k] = 0;
        for (size_t i = 0; i < 3 && w->count; i++)
            from[k] += w->file->points[3 * w->file->triangles[3 * w->triangles[0] + i] + k] / 3;
    }
}

static int walk_on_star(walk_record *w, const mw_star *star, const mw_surface *surface)
{
    const walk_settings *s = w->settings;
    mw_error error;
    mw_star_cursor begin, cursor;
    mw_star_index *index = NULL;
    double from[3] = {0}, to[3];
    mw_star_query_options options = {.walk = mw_star_walk_by_name(walk_choice_name(s->walk)),
                                     .start = MW_STAR_START_LAST,
                                     .seed = s->mesh.common.seed};
    int end = s->grid ? walk_mark_first_facets(w, star) : ray_point(s, "from", &s->from, from);
    if (end == 0) end = ray_point(s, "to", &s->to, to);
    if (end == 0) end = walk_make_index(w, star, &options.start, &index);
    options.index = index;
    if (end == 0 && mw_star_cursor_init(star, &options, &begin, &error) != MW_OK)
        end = fail_query(&error);
    if (end == 0 && !s->grid) mw_star_locate(star, &begin, from);
    if (end == 0) {
        do cursor = begin;
        while (walk_record_lacks_room(
            w, mw_star_path(star, &cursor, to, w->triangles, w->capacity, NULL), &end));
    }
    if (s->grid) walk_first_middle(w, from);
    mw_star_index_destroy(index);
    return end ? end : walk_record_arc(w, star, surface, from, to);
}

static int walk_star(walk_record *w)
{
    const walk_settings *s = w->settings;
    mw_error error;
    mw_surface *surface = NULL;
    mw_star *star = NULL;
    mw_arrays arrays = mw_mesh_file_arrays(w->file);
    mw_surface_options welded = {.weld = 1, .progress = progress_of_call()};
    mw_star_options options = {
        .centre = {s->mesh.centre.at[0], s->mesh.centre.at[1], s->mesh.centre.at[2]},
        .angles = strcmp(walk_choice_name(s->walk), "orthogonal") == 0,
        .threads = s->mesh.common.threads,
        .progress = progress_of_call()};
    bool made = mw_surface_create(&arrays, &welded, &surface, &error) == MW_OK &&
                mw_star_create(surface, &options, &star, &error) == MW_OK;
    int end = made ? walk_on_star(w, star, surface) : walk_fail_mesh(w, " --as star", &error);
    mw_star_destroy(star);
    mw_surface_destroy(surface);
    return end;
}

/* --- on a surface ----------------------------------------------------------------------------- */

static int walk_as_probe(walk_record *w, const mw_prober *prober)
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
                                .seed = s->mesh.common.seed};
    if (mw_probe_cursor_init(prober, &options, &begin, &error) != MW_OK) return fail_query(&error);
    for (int k = 0; k < 3; k++) motion[k] = s->to.at[k] - s->from.at[k];
    do cursor = begin;
    while (walk_record_lacks_room(w,
                                  mw_probe_path(prober, &cursor, s->from.at, motion, w->triangles,
                                                w->iteration, w->capacity, &touch),
                                  &end));
    if (touch.state == MW_TOUCH_BAD)
        return walk_option_must_be("to",
                                   "another point than --from, and not too far away: a motion");
    if (touch.state == MW_TOUCH_LIMIT)
        walk_remark(w, "the probe", "touched nothing: its walks ended without a triangle");
    return end ? end : walk_record_line(w);
}

static int walk_surface(walk_record *w)
{
    const walk_settings *s = w->settings;
    mw_error error;
    mw_surface *surface = NULL;
    mw_prober *prober = NULL;
    mw_arrays arrays = mw_mesh_file_arrays(w->file);
    mw_surface_options options = {.weld = s->mesh.weld, .progress = progress_of_call()};
    bool made = mw_surface_create(&arrays, &options, &surface, &error) == MW_OK &&
                mw_prober_create(surface, NULL, &prober, &error) == MW_OK;
    int end = made ? walk_as_probe(w, prober) : walk_fail_mesh(w, " --as surface", &error);
    mw_prober_destroy(prober);
    mw_surface_destroy(surface);
    return end;
}

/* --- outputs ---------------------------------------------------------------------------------- */

static int walk_write_list(const walk_record *w)
{
    text t = {0};
    text_string(&t, "step,triangle,iteration\n");
    for (size_t i = 0; i < w->count; i++)
        text_printf(&t, "%zu,%lu,%lu\n", i, (unsigned long)w->triangles[i],
                    (unsigned long)w->iteration[i]);
    return files_write_text(w->settings->mesh.common.output, &t);
}

/* The picture of a walk; its caption has room for 160 letters. */
static drawing walk_drawing(const walk_record *w, char *caption)
{
    static const drawing_view views[] = {
        [SPACE_PLANE] = VIEW_PLANE, [SPACE_SURFACE] = VIEW_SURFACE, [SPACE_STAR] = VIEW_STAR};
    static const char *const stages[] = {"initialisation", "walk", "final location", "border",
                                         NULL};
    const walk_settings *s = w->settings;
    bool plane = s->mesh.space == SPACE_PLANE;
    const char *name = strrchr(w->path, '/'), *walk = s->mesh.space == SPACE_SURFACE ? "probe"
                                                      : plane ? mw_walk_name(w->walk)
                                                              : walk_choice_name(s->walk);
    snprintf(caption, 160, "%.100s: %s, %zu triangle%s", name ? name + 1 : w->path, walk, w->count,
             w->count == 1 ? "" : "s");
    return (drawing){.view = views[s->mesh.space],
                     .centre = {s->mesh.centre.at[0], s->mesh.centre.at[1], s->mesh.centre.at[2]},
                     .caption = caption,
                     .name = walk,
                     .points = w->file->points,
                     .triangles = w->file->triangles,
                     .point_count = w->file->point_count,
                     .triangle_count = w->file->triangle_count,
                     .path = w->triangles,
                     .iteration = w->iteration,
                     .path_count = w->count,
                     .stage = plane ? w->stages : NULL,
                     .stage_names = stages,
                     .line = w->line,
                     .line_count = w->line_count,
                     .line_name = plane                            ? "its line"
                                  : s->mesh.space == SPACE_SURFACE ? "line of motion"
                                                                   : "shortest way",
                     .marks = w->marks,
                     .mark_name = "first facet of a cell"};
}

/* The picture of the walk in its plane. */
static int walk_take_plane(const walk_record *w, plane_picture *p, drawing *d, char *caption)
{
    const bool orthogonal = strcmp(walk_choice_name(w->settings->walk), "orthogonal") == 0;
    const size_t length = strlen(caption);
    size_t left_out = 0;
    if (!w->settings->plane) return 0;
    const bool room = d->view == VIEW_STAR ? plane_picture_of_star(p, d, orthogonal, w->cells,
                                                                   w->cell_count, &left_out)
                                           : plane_picture_of_probe(p, d);
    const unsigned long walk = w->count ? w->iteration[w->count - 1] : 0;
    if (walk) snprintf(caption + length, 160 - length, "; the plane of walk %lu", walk + 1);
    if (left_out)
        snprintf(caption + length, 160 - length, "; %zu at the seam or a pole not shown", left_out);
    *d = p->drawing;
    if (orthogonal) d->line_name = "its two legs";
    return room ? 0 : fail_memory();
}

static int walk_write_picture(const walk_record *w)
{
    char caption[160];
    drawing d = walk_drawing(w, caption);
    plane_picture p = {0};
    progress_phase("drawing", w->settings->mesh.common.output);
    int end = walk_take_plane(w, &p, &d, caption);
    if (end == 0) end = drawing_write(&d, w->settings->mesh.common.output);
    plane_picture_release(&p);
    return end;
}

static int walk_write_animation(const walk_record *w)
{
    enum { TRIANGLES = 4000 /* of the mesh, which each step shows again */ };
    char caption[160];
    drawing d = walk_drawing(w, caption);
    plane_picture p = {0};
    progress_phase("drawing", w->settings->animate);
    int end = walk_take_plane(w, &p, &d, caption);
    d.most_triangles = TRIANGLES;
    if (end == 0) end = drawing_write_animation(&d, w->settings->animate);
    plane_picture_release(&p);
    return end;
}

static int walk_and_write(walk_record *w)
{
    const walk_settings *s = w->settings;
    progress_phase("walking", w->path);
    int end = s->mesh.space == SPACE_PLANE  ? walk_plane(w)
              : s->mesh.space == SPACE_STAR ? walk_star(w)
                                            : walk_surface(w);
    if (end == 0 && s->animate) end = walk_write_animation(w);
    if (end || (s->animate && !s->mesh.common.output)) return end;
    return walk_writes_picture(s) ? walk_write_picture(w) : walk_write_list(w);
}

static void walk_record_release(walk_record *w)
{
    free(w->triangles);
    free(w->iteration);
    free(w->stages);
    free(w->line);
    free(w->cells);
    free(w->marks);
}

static int walk_write_all(const walk_settings *s, const drawing *d, size_t count)
{
    int end = s->animate ? drawing_write_race(d, count, s->animate) : 0;
    if (end || !s->mesh.common.output) return end;
    return drawing_write_sheet(d, count, s->mesh.common.output);
}

/* Draw every walk in the plane, side by side. Remarks about the points are printed once. */
static int walk_all_and_write(const walk_record *common)
{
    enum { WALKS = MW_WALK_COUNT - 1, TRIANGLES = 4000 /* of the mesh, in each picture */ };
    walk_record record[WALKS];
    drawing sheet[WALKS];
    char caption[WALKS][160];
    walk_settings quiet = *common->settings;
    quiet.mesh.common.quiet = true;
    int end = 0;
    size_t count = 0;
    progress_phase("walking", common->path);
    for (; count < WALKS && end == 0; count++) {
        record[count] = (walk_record){.settings = count ? &quiet : common->settings,
                                      .path = common->path,
                                      .file = common->file,
                                      .walk = (mw_walk_kind)(count + 1)};
        end = walk_plane(&record[count]);
        sheet[count] = walk_drawing(&record[count], caption[count]);
        sheet[count].most_triangles = TRIANGLES;
    }
    progress_phase("drawing", common->path);
    if (end == 0) end = walk_write_all(common->settings, sheet, count);
    while (count-- > 0) walk_record_release(&record[count]);
    return end;
}

static int walk_run(const void *settings, const char *const *operands)
{
    const walk_settings *s = settings;
    mw_mesh_file file = {0};
    walk_record w = {
        .settings = s, .path = operands[0], .file = &file, .walk = (mw_walk_kind)s->walk};
    bool all = s->walk == MW_WALK_COUNT;
    int end = walk_check_options(s, operands);
    if (end == 0) end = mesh_space_read(&s->mesh, operands, &file);
    if (end == 0) end = all ? walk_all_and_write(&w) : walk_and_write(&w);
    walk_record_release(&w);
    mw_mesh_file_release(&file);
    return end;
}

static const option *const tables[] = {walk_options, mesh_space_options, common_options, NULL};

const command walk_command = {
    .name = "walk",
    .operands = "MESH",
    .operand_count = 1,
    .summary = "draw or list one walk, triangle by triangle",
    .description = "Walks through MESH from the triangle that contains --from to the one that "
                   "contains --to, and writes the "
                   "triangles visited: as a list, step,triangle,iteration, in order and numbered "
                   "from 0; or as a picture, if the "
                   "output is an .svg, .png or .pdf file; or step by step (--animate). With --as "
                   "star, the walk goes over the "
                   "facets of a polyhedron from one "
                   "ray to the other. With --as surface, it is that of a probe at --from that "
                   "moves towards --to, and iteration "
                   "is the number of its walk; it begins in a triangle chosen at random. '-' is "
                   "standard input.",
    .options = tables,
    .essential = "from to walk as output",
    .settings_size = sizeof(walk_settings),
    .run = walk_run,
};
