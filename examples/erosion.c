/* erosion.c - drops of rain wear down a terrain.
 *
 *     erosion TERRAIN [-o OUT] [options]        (erosion --help)
 *
 * The model [Beyer 2015]: drops
 * fall one after the other, run downhill, carry soil as far as their speed, water and the slope
 * let them, take up more where they could carry more, and lay it down where they cannot carry what
 * they have. There the terrain is a grid; here it is a mesh, a drop runs along edges from vertex
 * to vertex, and the mesh follows the valleys: vertices are inserted along the beds that drops
 * dig, moved to make them straighter, and removed where soil has buried what they showed.
 *
 * Each drop is located by a walk through the mesh as it is just then. Nothing is built, and
 * nothing has to be built anew. */
#include "terrain.h"

#include <getopt.h>
#include <math.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const char usage[] =
    "usage: erosion TERRAIN [-o OUT] [options]\n"
    "\n"
    "Let drops of rain fall on a terrain, run downhill, and carry soil along. TERRAIN is a mesh "
    "with heights (OFF, "
    "OBJ,\n"
    "PLY, STL, .node) or a file of points x,y,z (text, LAS), which are triangulated first, such as "
    "data/jacksboro.csv.\n"
    "Lengths and heights are in one unit, for which metre is written here.\n"
    "\n"
    "  -o, --output OUT     write the terrain that is left as a mesh; its ending tells the "
    "format:\n"
    "                       .ply .off .obj .stl .node .vtk\n"
    "  -n, --drops N        drops that fall (default 100000)\n"
    "  -s, --seed N         of the places where they fall (default 1)\n"
    "  -r, --rain H         all rain that they bring together, metres on the whole terrain "
    "(default 1000);\n"
    "                       with more drops each is smaller\n"
    "      --capacity C     soil that water carries at 1 m/s down a slope of 1 (45 degrees), cubic "
    "metres in each\n"
    "                       cubic metre of water (default 0.05)\n"
    "      --erosion E      part of what it could carry more that a drop takes up at a vertex, 0 "
    "to 1 (default 0.3)\n"
    "      --deposition D   part of what it cannot carry that it lays down there, 0 to 1 (default "
    "0.3)\n"
    "      --evaporation V  part of its water that a drop loses at a vertex, 0.0001 to 1 (default "
    "0.02)\n"
    "      --speed S        fastest that water runs, m/s (default 5)\n"
    "      --change H       the mesh is changed where so much soil was taken or laid down, metres "
    "(default: 1/200 of\n"
    "                       the range of heights); 0: never, then only heights change\n"
    "      --finest L       no edges shorter than this are made, metres (default: a third of the "
    "mean edge)\n"
    "  -h, --help           this text\n"
    "\n"
    "Printed are: what the drops did; the soil, in cubic metres, where 'unaccounted' is what the "
    "books do not explain\n"
    "of the change of volume (rounding); and how fast it went. Exit codes: 0 done, 2 wrong usage, "
    "3 input that cannot\n"
    "be read or is no terrain, 4 anything else.\n";

typedef struct settings {
    const char *input, *output;
    uint64_t drops, seed;
    double rain, capacity, erosion, deposition, evaporation, speed;
    double change, finest; /* negative: to be chosen */
} settings;

typedef struct erosion {
    settings set;
    mw_editor *editor;
    const mw_locator *locator;
    mw_cursor cursor;
    /* the field of heights */
    uint32_t z;
    /* of the terrain */
    double low[2], high[2], area;
    /* of a drop when it falls, cubic metres */
    double water;
    uint64_t random;
    /* per vertex: the area that its height counts for, a third of its triangles' */
    double *share;
    /* per vertex: metres that were taken off it since the mesh was last changed there */
    double *worn;
    size_t room;
    /* soil, cubic metres */
    double taken, laid, lost, reshaped;
    uint64_t landed, runs, heights, inserted, moved, removed, locations;
} erosion;

/* A drop of rain. */
typedef struct drop {
    uint32_t vertex, from; /* where it is, and was before: MW_NONE at first */
    double water, speed, soil;
} drop;

/* Vertices round one, in order. */
#define MOST_ROUND 256
typedef struct ring {
    uint32_t vertex[MOST_ROUND];
    size_t count;
    bool border; /* not all round */
} ring;

/* --- the mesh --------------------------------------------------------------------------------- */

static double uniform(uint64_t *state)
{
    *state = *state * UINT64_C(6364136223846793005) + UINT64_C(1442695040888963407);
    return (double)(*state >> 11) * 0x1p-53;
}

static double height(const erosion *s, uint32_t v)
{
    return mw_editor_value(s->editor, s->z, v);
}

static double distance(const erosion *s, uint32_t a, uint32_t b)
{
    double p[2], q[2];
    mw_editor_vertex(s->editor, a, p);
    mw_editor_vertex(s->editor, b, q);
    return hypot(q[0] - p[0], q[1] - p[1]);
}

static ring look_round(const erosion *s, uint32_t v)
{
    ring r;
    r.count = mw_editor_adjacent_vertices(s->editor, v, r.vertex, MOST_ROUND);
    r.border = r.count == 0 || r.count > MOST_ROUND ||
               mw_editor_edge(s->editor, v, r.vertex[0]) == MW_EDGE_BORDER;
    if (r.count > MOST_ROUND) r.count = MOST_ROUND;
    return r;
}

/* Where vertices are gets its share of what the triangles are: add a triangle, or take it away.
 * Returns its volume above z = 0. */
static double count_triangle(erosion *s, const uint32_t v[3], double sign)
{
    double p[3][2], z = 0;
    for (int k = 0; k < 3; k++) {
        mw_editor_vertex(s->editor, v[k], p[k]);
        z += height(s, v[k]);
    }
    double area = fabs(mw_orient2d(p[0], p[1], p[2])) / 2;
    for (int k = 0; k < 3; k++) s->share[v[k]] += sign * area / 3;
    return sign * area * z / 3;
}

static bool has(const uint32_t v[3], uint32_t vertex)
{
    return v[0] == vertex || v[1] == vertex || v[2] == vertex;
}

/* All triangles of a vertex. */
static double count_star(erosion *s, uint32_t v, double sign)
{
    ring r = look_round(s, v);
    double volume = 0;
    for (size_t i = r.border ? 1 : 0; i < r.count; i++) {
        const uint32_t corners[3] = {v, r.vertex[(i + r.count - 1) % r.count], r.vertex[i]};
        volume += count_triangle(s, corners, sign);
    }
    return volume;
}

static void make_room(erosion *s, uint32_t vertex)
{
    if (vertex < s->room) return;
    size_t room = 2 * (size_t)vertex + 1024;
    double *share = realloc(s->share, room * sizeof *share),
           *worn = realloc(s->worn, room * sizeof *worn);
    if (!share || !worn) fail(END_FAILED, "out of memory");
    memset(share + s->room, 0, (room - s->room) * sizeof *share);
    memset(worn + s->room, 0, (room - s->room) * sizeof *worn);
    s->share = share;
    s->worn = worn;
    s->room = room;
}

/* Carry out an edit that changes triangles, and carry shares along; returns the vertex, MW_NONE if
 * nothing has changed. Triangles of its vertex are counted as they were before it and as they are
 * after it, for those of a vertex that moves are not listed; the others as listed. *volume: by how
 * much the terrain has become more. */
static uint32_t reshape(erosion *s, const mw_edit *edit, double *volume)
{
    mw_error error;
    mw_change change;
    bool inserts = edit->kind == MW_EDIT_INSERT;
    *volume = inserts ? 0 : count_star(s, edit->vertex, -1);
    mw_status status = mw_edit_apply(s->editor, edit, &change, &error);
    if (status != MW_OK && status != MW_ERROR_INPUT) fail_with(&error);
    if (status != MW_OK || (inserts && !change.vertices_made)) {
        if (!inserts) count_star(s, edit->vertex, 1);
        return MW_NONE;
    }
    make_room(s, change.vertex);
    for (size_t i = 0; i < change.made + change.reused + change.freed; i++) {
        const mw_changed_triangle *t = &change.triangle[i];
        uint32_t after[3];
        if (t->before[0] != MW_NONE && !has(t->before, change.vertex))
            *volume += count_triangle(s, t->before, -1);
        if (mw_editor_triangle(s->editor, t->triangle, after) && !has(after, change.vertex))
            *volume += count_triangle(s, after, 1);
    }
    if (!change.vertices_freed) *volume += count_star(s, change.vertex, 1);
    s->reshaped += *volume;
    return change.vertex;
}

static void set_height(erosion *s, uint32_t v, double z)
{
    mw_error error;
    if (mw_edit_value(s->editor, s->z, v, z, &error)) fail_with(&error);
    s->heights++;
}

/* Give a vertex that has come or moved the height with which no soil has come or gone, but leave
 * it between two others. */
static void keep_soil(erosion *s, uint32_t v, double volume, uint32_t above, uint32_t below)
{
    double z = height(s, v), high = height(s, above), low = height(s, below);
    double wanted = fmin(fmax(z - volume / s->share[v], fmin(low, z)), fmax(high, z));
    s->reshaped += (wanted - z) * s->share[v];
    set_height(s, v, wanted);
}

/* --- the mesh follows the valleys ------------------------------------------------------------- */

static void middle(const erosion *s, uint32_t a, uint32_t b, double m[2])
{
    double p[2], q[2];
    mw_editor_vertex(s->editor, a, p);
    mw_editor_vertex(s->editor, b, q);
    for (int k = 0; k < 2; k++) m[k] = p[k] / 2 + q[k] / 2;
}

/* Water cuts corners: a vertex of a bed goes a little towards the middle of those before and after
 * it. */
static void straighten(erosion *s, uint32_t from, uint32_t v, uint32_t to)
{
    double p[2], m[2], volume;
    mw_editor_vertex(s->editor, v, p);
    middle(s, from, to, m);
    mw_edit edit = {.kind = MW_EDIT_MOVE, .vertex = v};
    edit.x = p[0] + (m[0] - p[0]) / 4;
    edit.y = p[1] + (m[1] - p[1]) / 4;
    if (reshape(s, &edit, &volume) == MW_NONE) return;
    keep_soil(s, v, volume, from, to);
    s->moved++;
}

/* A long edge of a bed gets a vertex in its middle, which takes its height from the terrain there.
 * */
static void refine(erosion *s, uint32_t v, uint32_t to)
{
    double m[2], volume;
    if (distance(s, v, to) < 2 * s->set.finest) return;
    middle(s, v, to, m);
    mw_edit edit = {.kind = MW_EDIT_INSERT, .x = m[0], .y = m[1], .field = MW_NONE, .value = NAN};
    edit.field = s->z;
    uint32_t made = reshape(s, &edit, &volume);
    if (made == MW_NONE) return;
    keep_soil(s, made, volume, v, to);
    s->inserted++;
}

static bool remove_vertex(erosion *s, uint32_t v)
{
    double volume;
    bool gone = reshape(s, &(mw_edit){.kind = MW_EDIT_REMOVE, .vertex = v}, &volume) != MW_NONE;
    s->removed += gone;
    return gone;
}

/* Vertices of a bed that have come too close to one another: one goes. */
static void thin_out(erosion *s, uint32_t from, uint32_t v, uint32_t to)
{
    ring r = look_round(s, v);
    for (size_t i = 0; i < r.count; i++) {
        uint32_t w = r.vertex[i];
        if (w == from || w == to || distance(s, v, w) > s->set.finest / 2 ||
            look_round(s, w).border)
            continue;
        remove_vertex(s, w);
        return;
    }
}

static void deepen(erosion *s, uint32_t from, uint32_t v, uint32_t to)
{
    s->worn[v] = 0;
    thin_out(s, from, v, to);
    refine(s, v, to);
    if (from != MW_NONE && from != to) straighten(s, from, v, to);
}

/* Soil was laid down. Is a vertex about as high as those round about let expect, and has nothing
 * to show any more? */
static bool is_buried(const erosion *s, uint32_t v, const ring *r)
{
    double sum = 0, weights = 0;
    for (size_t i = 0; i < r->count; i++) {
        double weight = 1 / distance(s, v, r->vertex[i]);
        sum += weight * height(s, r->vertex[i]);
        weights += weight;
    }
    return fabs(sum / weights - height(s, v)) < s->set.change / 2;
}

/* A drop has run from a vertex on to the next one. Returns false if the vertex is gone. */
static bool follow(erosion *s, uint32_t from, uint32_t v, uint32_t to, const ring *r)
{
    bool buried = false;
    if (s->set.change == 0 || fabs(s->worn[v]) < s->set.change) return true;
    if (s->worn[v] > 0) {
        deepen(s, from, v, to);
    } else {
        s->worn[v] = 0;
        buried = is_buried(s, v, r) && remove_vertex(s, v);
    }
    return !buried;
}

/* --- a drop ----------------------------------------------------------------------------------- */

/* Raise a vertex by `dz`, with soil of the drop; or lower it. */
static void change_height(erosion *s, drop *d, uint32_t v, double dz)
{
    double soil = dz * s->share[v];
    if (dz == 0) return;
    set_height(s, v, height(s, v) + dz);
    s->worn[v] -= dz;
    d->soil = soil < d->soil ? d->soil - soil : 0;
    *(dz < 0 ? &s->taken : &s->laid) += fabs(soil);
}

/* Raise the drop's vertex by so much soil, but by `most` at most. */
static void lay_down(erosion *s, drop *d, double soil, double most)
{
    if (most > 0 && soil > 0)
        change_height(s, d, d->vertex, fmin(soil / s->share[d->vertex], most));
}

/* All that the drop still carries settles round about where it has ended, or is gone, over the
 * border. */
static void settle(erosion *s, drop *d)
{
    ring r = look_round(s, d->vertex);
    if (r.border) s->lost += d->soil;
    if (r.border || d->soil == 0) return;
    double area = s->share[d->vertex];
    for (size_t i = 0; i < r.count; i++) area += s->share[r.vertex[i]];
    double dz = d->soil / area;
    change_height(s, d, d->vertex, dz);
    for (size_t i = 0; i < r.count; i++) change_height(s, d, r.vertex[i], dz);
}

/* The neighbour to which the steepest way down leads; in a pit the lowest one but that where the
 * drop came from. *slope: how steep it is, 0 in a pit. */
static uint32_t way_down(const erosion *s, const drop *d, const ring *r, double *slope)
{
    double z = height(s, d->vertex), lowest = INFINITY;
    uint32_t steepest = MW_NONE, next = d->from;
    *slope = 0;
    for (size_t i = 0; i < r->count; i++) {
        uint32_t w = r->vertex[i];
        double zw = height(s, w);
        if (zw < z && (z - zw) / distance(s, d->vertex, w) > *slope) {
            steepest = w;
            *slope = (z - zw) / distance(s, d->vertex, w);
        }
        if (zw < lowest && w != d->from) {
            next = w;
            lowest = zw;
        }
    }
    return *slope > 0 ? steepest : next;
}

/* Take up soil, or lay it down. Digging ends half way down to the next vertex, heaping half way up
 * to the one before. */
static void exchange(erosion *s, drop *d, uint32_t next, double slope)
{
    double z = height(s, d->vertex), fall = z - height(s, next);
    double carried = s->set.capacity * slope * d->speed * d->water, missing = carried - d->soil;
    if (missing < 0)
        lay_down(s, d, -missing * s->set.deposition,
                 d->from == MW_NONE ? 0 : (height(s, d->from) - z) / 2);
    else
        change_height(s, d, d->vertex,
                      -fmin(missing * s->set.erosion / s->share[d->vertex], fall / 2));
    d->speed = fmin(sqrt(d->speed * d->speed + 2 * 9.81 * fall), s->set.speed);
}

/* In a pit the drop lays down its soil. Is the pit full then, so that it runs over? */
static bool runs_over(erosion *s, drop *d, uint32_t next)
{
    double depth = fmax(height(s, next) - height(s, d->vertex), 0);
    bool full = d->soil > depth * s->share[d->vertex];
    lay_down(s, d, d->soil, depth);
    d->speed = 0;
    return full;
}

/* One vertex further. Returns false when the drop has ended. */
static bool run_on(erosion *s, drop *d)
{
    double slope;
    ring r = look_round(s, d->vertex);
    if (r.border) return false;
    uint32_t next = way_down(s, d, &r, &slope), from = d->from;
    if (slope > 0)
        exchange(s, d, next, slope);
    else if (!runs_over(s, d, next))
        return false;
    d->from = d->vertex;
    d->vertex = next;
    d->water *= 1 - s->set.evaporation;
    s->runs++;
    if (!follow(s, from, d->from, next, &r)) d->from = MW_NONE;
    return true;
}

/* Where a drop falls: the corner nearest to it, by its weights, of the triangle that it falls on.
 * */
static uint32_t land(erosion *s)
{
    for (;;) {
        double x = s->low[0] + uniform(&s->random) * (s->high[0] - s->low[0]);
        double y = s->low[1] + uniform(&s->random) * (s->high[1] - s->low[1]);
        mw_location at = mw_locate(s->locator, &s->cursor, x, y);
        uint32_t corner[3];
        s->locations++;
        if (at.triangle == MW_NONE) continue; /* beside the terrain, or in a hole of it */
        mw_editor_triangle(s->editor, at.triangle, corner);
        int k = at.weight[0] >= at.weight[1] ? 0 : 1;
        return corner[at.weight[2] > at.weight[k] ? 2 : k];
    }
}

/* A drop has dried up when so much of its water is left. */
#define DRY 0.01

static void rain(erosion *s)
{
    for (; s->landed < s->set.drops; s->landed++) {
        drop d = {.vertex = land(s), .from = MW_NONE, .water = s->water};
        while (run_on(s, &d))
            if (d.water < DRY * s->water) break;
        settle(s, &d);
    }
}

/* --- before and after ------------------------------------------------------------------------- */

/* Area and volume of what is there; shares of the vertices, if they are wanted. */
static double survey(erosion *s, bool shares)
{
    mw_editor_info info;
    uint32_t v[3];
    double volume = 0, *own = s->share;
    mw_editor_describe(s->editor, &info);
    make_room(s, info.vertex_range);
    if (!shares) s->share = calloc(s->room, sizeof *own);
    if (!s->share) fail(END_FAILED, "out of memory");
    for (uint32_t t = 0; t < info.triangle_range; t++)
        if (mw_editor_triangle(s->editor, t, v)) volume += count_triangle(s, v, 1);
    if (!shares) {
        free(s->share);
        s->share = own;
    }
    return volume;
}

static void choose(erosion *s, const mw_mesh *mesh, const mw_mesh_info *info)
{
    double low = INFINITY, high = -INFINITY;
    const double *z = mw_mesh_field(mesh, "z");
    for (uint32_t i = 0; i < info->vertices; i++) {
        low = fmin(low, z[i]);
        high = fmax(high, z[i]);
    }
    if (s->set.change < 0) s->set.change = (high - low) / 200;
    /* Of triangles that are all alike and have equal sides, with this mean area. */
    if (s->set.finest < 0) s->set.finest = sqrt(4 / sqrt(3) * info->area / info->triangles) / 3;
    s->area = info->area;
    s->water = s->set.rain * s->area / (double)s->set.drops;
    memcpy(s->low, info->low, sizeof s->low);
    memcpy(s->high, info->high, sizeof s->high);
}

static void prepare(erosion *s)
{
    mw_error error;
    mw_mesh_info info;
    mw_mesh *mesh = terrain_read(s->set.input);
    if (mw_mesh_describe(mesh, NULL, &info, &error)) fail_with(&error);
    if (mw_editor_create(mesh, &(mw_editor_options){.delaunay = MW_DELAUNAY_MAKE}, &s->editor,
                         &error))
        fail(END_INPUT, "%s: %s", s->set.input, error.message);
    choose(s, mesh, &info);
    mw_mesh_destroy(mesh);
    s->z = mw_editor_field_by_name(s->editor, "z");
    s->locator = mw_editor_locator(s->editor);
    if (mw_cursor_init(s->locator, NULL, &s->cursor, &error)) fail_with(&error);
    s->random = s->set.seed;
}

static void write_terrain(const erosion *s)
{
    mw_error error;
    mw_mesh *mesh;
    if (mw_editor_mesh(s->editor, NULL, NULL, &mesh, &error)) fail_with(&error);
    terrain_write(s->set.output, mesh);
    mw_mesh_destroy(mesh);
}

static void report(const erosion *s, uint32_t vertices, double change, double seconds)
{
    mw_editor_info info;
    mw_editor_describe(s->editor, &info);
    uint64_t shape = s->inserted + s->moved + s->removed;
    printf("%llu drops of %.4g cubic metres ran along %llu edges\n", (unsigned long long)s->landed,
           s->water, (unsigned long long)s->runs);
    printf("edits: %llu heights, %llu vertices inserted, %llu moved, %llu removed\n",
           (unsigned long long)s->heights, (unsigned long long)s->inserted,
           (unsigned long long)s->moved, (unsigned long long)s->removed);
    printf("vertices: %u before, %u after\n", vertices, info.vertices);
    printf("soil: %.6g taken up, %.6g laid down, %.6g gone over the border, %.3g by changes of the "
           "mesh\n",
           s->taken, s->laid, s->lost, s->reshaped);
    printf("volume: changed by %.6g, unaccounted %.2g\n", change,
           change - (s->laid - s->taken + s->reshaped));
    printf(
        "%.2f s: %.0f drops, %.0f locations, %.0f edits of heights and %.0f of the mesh a second\n",
        seconds, (double)s->landed / seconds, (double)s->locations / seconds,
        (double)s->heights / seconds, (double)shape / seconds);
}

static const struct option options[] = {
    {"output", required_argument, NULL, 'o'},
    {"drops", required_argument, NULL, 'n'},
    {"seed", required_argument, NULL, 's'},
    {"rain", required_argument, NULL, 'r'},
    {"capacity", required_argument, NULL, 'c'},
    {"erosion", required_argument, NULL, 'e'},
    {"deposition", required_argument, NULL, 'd'},
    {"evaporation", required_argument, NULL, 'v'},
    {"speed", required_argument, NULL, 'S'},
    {"change", required_argument, NULL, 'C'},
    {"finest", required_argument, NULL, 'f'},
    {"help", no_argument, NULL, 'h'},
    {0},
};

static void take_option(settings *set, int letter, const char *text)
{
    switch (letter) {
    case 'o': set->output = text; break;
    case 'n': set->drops = (uint64_t)option_number("drops", text, 1, 1e12); break;
    case 's': set->seed = (uint64_t)option_number("seed", text, 0, 9e15); break;
    case 'r': set->rain = option_number("rain", text, 0, 1e9); break;
    case 'c': set->capacity = option_number("capacity", text, 0, 1e9); break;
    case 'e': set->erosion = option_number("erosion", text, 0, 1); break;
    case 'd': set->deposition = option_number("deposition", text, 0, 1); break;
    case 'v': set->evaporation = option_number("evaporation", text, 0.0001, 1); break;
    case 'S': set->speed = option_number("speed", text, 0, 1e9); break;
    case 'C': set->change = option_number("change", text, 0, 1e9); break;
    case 'f': set->finest = option_number("finest", text, 1e-9, 1e9); break;
    case 'h': printf("%s", usage); exit(0);
    default: fail(END_USAGE, "try 'erosion --help'");
    }
}

static settings take_arguments(int argc, char **argv)
{
    settings set = {.drops = 100000,
                    .seed = 1,
                    .rain = 1000,
                    .capacity = 0.05,
                    .erosion = 0.3,
                    .deposition = 0.3,
                    .evaporation = 0.02,
                    .speed = 5,
                    .change = -1,
                    .finest = -1};
    for (int letter; (letter = getopt_long(argc, argv, "o:n:s:r:h", options, NULL)) != -1;)
        take_option(&set, letter, optarg);
    if (argc - optind != 1) fail(END_USAGE, "one terrain is wanted; try 'erosion --help'");
    if (set.output && !terrain_can_write(set.output))
        fail(END_USAGE,
             "%s: the ending tells no format; one of .ply .off .obj .stl .node .vtk is wanted",
             set.output);
    set.input = argv[optind];
    return set;
}

int main(int argc, char **argv)
{
    program_name = "erosion";
    erosion s = {.set = take_arguments(argc, argv)};
    mw_editor_info before;
    prepare(&s);
    mw_editor_describe(s.editor, &before);
    double volume = survey(&s, true), clock = terrain_clock();
    rain(&s);
    clock = terrain_clock() - clock;
    report(&s, before.vertices, survey(&s, false) - volume, clock);
    if (s.set.output) write_terrain(&s);
    mw_editor_destroy(s.editor);
    free(s.share);
    free(s.worn);
    return 0;
}
