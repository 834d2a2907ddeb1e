/* coarsen.c - a terrain of few vertices that is nowhere further from the points of the given one
 * than is allowed.
 *
 *     coarsen TERRAIN --tolerance H -o OUT        (coarsen --help)
 *
 * Vertices are removed one after the other, that one first whose removal leaves the smallest
 * error, as in the "drop heuristic" [Lee 1991]. When none can go any more, exchanges
 * are tried: a vertex goes although the error is too large then, the original point with the
 * largest error comes back as a vertex, and if then another vertex beside it can go, one has been
 * gained.
 *
 * What a removal does is found by doing it: if the error is too large it is taken back
 * (mw_edit_undo). Each original point is kept with the triangle that holds it; the report of an
 * edit tells which triangles have changed, and only their points are located again. */
#include "terrain.h"

#include <getopt.h>
#include <math.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const char usage[] =
    "usage: coarsen TERRAIN --tolerance H [-o OUT] [options]\n"
    "\n"
    "Find a terrain of few vertices whose height differs from that of each point of TERRAIN by H "
    "at most. TERRAIN is "
    "a\n"
    "mesh with heights (OFF, OBJ, PLY, STL, .node) or a file of points x,y,z (text, LAS), such as "
    "data/jacksboro.csv.\n"
    "The vertices of the result are some of its points, and it covers the same part of the plane.\n"
    "\n"
    "  -t, --tolerance H    the largest error that is allowed, in the unit of the heights (metres, "
    "feet, ...)\n"
    "  -o, --output OUT     write the result as a mesh; its ending tells the format: .ply .off "
    ".obj .stl .node .vtk\n"
    "  -p, --passes N       times that exchanges are tried on all vertices (default 1); 0: "
    "vertices are only removed,\n"
    "                       which is faster, and leaves more of them\n"
    "  -h, --help           this text\n"
    "\n"
    "Of several points at one place the first counts. Printed are: vertices before and after; the "
    "largest error, by "
    "an\n"
    "independent look at every point of TERRAIN in the result; what was done, and how fast. Exit "
    "codes: 0 done, 2 "
    "wrong\n"
    "usage, 3 input that cannot be read or is no terrain, 4 anything else.\n";

typedef struct settings {
    const char *input, *output;
    double tolerance;
    unsigned passes;
} settings;

/* A vertex that waits to be removed; of an old entry the stamp is not that of the vertex any more.
 * */
typedef struct waiting {
    double error; /* that its removal caused when it was tried, or less */
    uint32_t vertex, stamp;
} waiting;

typedef struct coarsening {
    settings set;
    double limit; /* the tolerance, less what rounding may take */
    mw_editor *editor;
    const mw_locator *locator;
    mw_cursor cursor;
    uint32_t z; /* the field of heights */

    /* The original points, each in the list of the triangle that holds it. */
    double *points; /* x y z */
    uint32_t *next;
    size_t count;

    /* Carried along with the triangles: the first point in each, and the largest error of its
     * points. */
    uint32_t *first;
    double *error;
    size_t triangle_room;
    /* the first of the points that are in no triangle: the hull has shrunk beyond them */
    uint32_t astray;

    uint32_t *touched; /* triangles changed since the list was emptied, some twice */
    size_t touched_count, touched_room;

    waiting *heap; /* the least error on top */
    size_t heap_count, heap_room;
    uint32_t *stamp; /* per vertex */
    size_t vertex_room;
    uint64_t edits, undone, locations;
} coarsening;

static void *enlarge(void *array, size_t count, size_t size)
{
    void *larger = realloc(array, count * size);
    if (!larger) fail(END_FAILED, "out of memory");
    return larger;
}

/* --- edits, and the points carried along ------------------------------------------------------ */

/* Locate a point in what is there now. The cursor is where the point before it was: near. */
static void settle(coarsening *c, uint32_t point)
{
    const double *p = c->points + 3 * (size_t)point;
    mw_location at = mw_locate(c->locator, &c->cursor, p[0], p[1]);
    uint32_t *list = at.triangle == MW_NONE ? &c->astray : &c->first[at.triangle];
    c->next[point] = *list;
    *list = point;
    c->locations++;
    if (at.triangle == MW_NONE) return;
    double z;
    mw_editor_interpolate(c->editor, c->z, &at, 1, &z);
    c->error[at.triangle] = fmax(c->error[at.triangle], fabs(z - p[2]));
}

/* Move the points of a list to another one. */
static void gather(coarsening *c, uint32_t *from, uint32_t *to)
{
    for (uint32_t point = *from, after; point != MW_NONE; point = after) {
        after = c->next[point];
        c->next[point] = *to;
        *to = point;
    }
    *from = MW_NONE;
}

static void make_room(coarsening *c, const mw_change *change)
{
    size_t most = c->triangle_room;
    for (size_t i = 0; i < change->made; i++)
        if (change->triangle[i].triangle >= most) most = (size_t)change->triangle[i].triangle + 1;
    if (most > c->triangle_room) {
        most *= 2;
        c->first = enlarge(c->first, most, sizeof *c->first);
        c->error = enlarge(c->error, most, sizeof *c->error);
        for (size_t t = c->triangle_room; t < most; t++) c->first[t] = MW_NONE;
        c->triangle_room = most;
    }
    if (change->vertex != MW_NONE && change->vertex >= c->vertex_room) {
        size_t room = 2 * (size_t)change->vertex + 1;
        c->stamp = enlarge(c->stamp, room, sizeof *c->stamp);
        memset(c->stamp + c->vertex_room, 0, (room - c->vertex_room) * sizeof *c->stamp);
        c->vertex_room = room;
    }
}

static void touch(coarsening *c, uint32_t triangle)
{
    if (c->touched_count == c->touched_room)
        c->touched =
            enlarge(c->touched, c->touched_room = 2 * c->touched_room + 64, sizeof *c->touched);
    c->touched[c->touched_count++] = triangle;
}

/* Points of the triangles that an edit has changed go where they are now. */
static void carry(coarsening *c, const mw_change *change)
{
    uint32_t moving = MW_NONE;
    make_room(c, change);
    gather(c, &c->astray, &moving);
    for (size_t i = 0; i < change->made + change->reused + change->freed; i++) {
        uint32_t t = change->triangle[i].triangle;
        gather(c, &c->first[t], &moving);
        c->error[t] = 0;
        touch(c, t);
    }
    for (uint32_t after; moving != MW_NONE; moving = after) {
        after = c->next[moving];
        settle(c, moving);
    }
}

/* False: that cannot be done, as the removal of a corner of the border. */
static bool carry_out(coarsening *c, const mw_edit *edit, mw_change *change)
{
    mw_error error;
    mw_status status = mw_edit_apply(c->editor, edit, change, &error);
    if (status == MW_ERROR_INPUT) return false;
    if (status != MW_OK) fail_with(&error);
    carry(c, change);
    c->edits++;
    return true;
}

static bool remove_vertex(coarsening *c, uint32_t vertex)
{
    mw_change change;
    return carry_out(c, &(mw_edit){.kind = MW_EDIT_REMOVE, .vertex = vertex}, &change);
}

static void take_back(coarsening *c)
{
    mw_error error;
    mw_change change;
    if (mw_edit_undo(c->editor, &change, &error)) fail_with(&error);
    carry(c, &change);
    c->undone++;
}

/* The largest error in the triangles that were touched; *worst, if wanted, is a triangle where it
 * is. */
static double largest_error(const coarsening *c, uint32_t *worst)
{
    double largest = 0;
    uint32_t corners[3];
    if (c->astray != MW_NONE) return INFINITY;
    for (size_t i = 0; i < c->touched_count; i++) {
        uint32_t t = c->touched[i];
        if (c->error[t] <= largest || !mw_editor_triangle(c->editor, t, corners)) continue;
        largest = c->error[t];
        if (worst) *worst = t;
    }
    return largest;
}

/* --- removals --------------------------------------------------------------------------------- */

static bool is_before(const waiting *a, const waiting *b)
{
    return a->error < b->error || (a->error == b->error && a->vertex < b->vertex);
}

static void push(coarsening *c, uint32_t vertex, double error)
{
    if (c->heap_count == c->heap_room)
        c->heap = enlarge(c->heap, c->heap_room = 2 * c->heap_room + 64, sizeof *c->heap);
    waiting entry = {error, vertex, ++c->stamp[vertex]};
    size_t i = c->heap_count++;
    for (; i > 0 && is_before(&entry, &c->heap[(i - 1) / 2]); i = (i - 1) / 2)
        c->heap[i] = c->heap[(i - 1) / 2];
    c->heap[i] = entry;
}

static waiting pop(coarsening *c)
{
    waiting top = c->heap[0], last = c->heap[--c->heap_count];
    size_t i = 0;
    for (size_t k; (k = 2 * i + 1) < c->heap_count; i = k) {
        if (k + 1 < c->heap_count && is_before(&c->heap[k + 1], &c->heap[k])) k++;
        if (!is_before(&c->heap[k], &last)) break;
        c->heap[i] = c->heap[k];
    }
    c->heap[i] = last;
    return top;
}

/* Round what was touched the errors of removals are others now: these vertices are to be tried
 * again. */
static void push_touched(coarsening *c)
{
    for (size_t i = 0; i < c->touched_count; i++) {
        uint32_t v[3];
        if (!mw_editor_triangle(c->editor, c->touched[i], v)) continue;
        for (int k = 0; k < 3; k++) push(c, v[k], 0);
    }
}

/* Remove vertices, that with the least error first, until none is left that can go. A vertex waits
 * with the error that its removal had when it was tried; when it comes on top its removal is
 * carried out, and taken back if it turns out that it is another one's turn. */
static void remove_all(coarsening *c)
{
    while (c->heap_count > 0) {
        waiting w = pop(c);
        if (w.stamp != c->stamp[w.vertex]) continue;
        c->touched_count = 0;
        if (!remove_vertex(c, w.vertex)) continue;
        double error = largest_error(c, NULL);
        bool turn = c->heap_count == 0 || error <= c->heap[0].error;
        if (error <= c->limit && turn) {
            push_touched(c);
        } else {
            take_back(c);
            if (error <= c->limit) push(c, w.vertex, error);
        }
    }
}

/* --- exchanges -------------------------------------------------------------------------------- */

/* The point with the largest error in a triangle. */
static uint32_t worst_point(coarsening *c, uint32_t triangle)
{
    uint32_t worst = c->first[triangle];
    double largest = -1;
    for (uint32_t i = worst; i != MW_NONE; i = c->next[i]) {
        const double *p = c->points + 3 * (size_t)i;
        double z;
        mw_location at = mw_locate(c->locator, &c->cursor, p[0], p[1]);
        mw_editor_interpolate(c->editor, c->z, &at, 1, &z);
        if (fabs(z - p[2]) > largest) {
            largest = fabs(z - p[2]);
            worst = i;
        }
    }
    return worst;
}

static uint32_t insert_point(coarsening *c, uint32_t point)
{
    const double *p = c->points + 3 * (size_t)point;
    mw_change change;
    mw_edit edit = {.kind = MW_EDIT_INSERT, .x = p[0], .y = p[1], .field = c->z, .value = p[2]};
    return carry_out(c, &edit, &change) && change.vertices_made ? change.vertex : MW_NONE;
}

#define MOST_ROUND 64

/* Can a vertex beside this one go, too? Then it has gone. */
static bool remove_beside(coarsening *c, uint32_t vertex)
{
    uint32_t round[MOST_ROUND];
    size_t count = mw_editor_adjacent_vertices(c->editor, vertex, round, MOST_ROUND);
    for (size_t i = 0; i < count && i < MOST_ROUND; i++) {
        if (!remove_vertex(c, round[i])) continue;
        if (largest_error(c, NULL) <= c->limit) return true;
        take_back(c);
    }
    return false;
}

/* Exchange a vertex for a point that makes up for it and for another vertex. False: all is as
 * before. */
static bool exchange(coarsening *c, uint32_t vertex)
{
    double place[2];
    uint32_t worst = MW_NONE, in_its_place;
    mw_editor_vertex(c->editor, vertex, place);
    c->touched_count = 0;
    if (!remove_vertex(c, vertex)) return false;
    double error = largest_error(c, &worst);
    if (error <= c->limit) return true;
    if (error < INFINITY) {
        uint32_t point = worst_point(c, worst);
        const double *p = c->points + 3 * (size_t)point;
        bool same = p[0] == place[0] && p[1] == place[1];
        in_its_place = same ? MW_NONE : insert_point(c, point);
        if (in_its_place != MW_NONE) {
            if (largest_error(c, NULL) <= c->limit && remove_beside(c, in_its_place)) return true;
            take_back(c);
        }
    }
    take_back(c);
    return false;
}

/* Returns how many there were. */
static size_t exchange_all(coarsening *c)
{
    mw_editor_info info;
    size_t exchanged = 0;
    double place[2];
    mw_editor_describe(c->editor, &info);
    for (uint32_t v = 0; v < info.vertex_range; v++) {
        if (!mw_editor_vertex(c->editor, v, place) || !exchange(c, v)) continue;
        exchanged++;
        push_touched(c);
        remove_all(c);
    }
    return exchanged;
}

/* --- before and after ------------------------------------------------------------------------- */

static void take_points(coarsening *c, const mw_mesh *mesh)
{
    const double *z = mw_mesh_field(mesh, "z");
    double highest = 0;
    c->count = mw_mesh_vertex_count(mesh);
    c->points = enlarge(NULL, c->count, 3 * sizeof *c->points);
    c->next = enlarge(NULL, c->count, sizeof *c->next);
    for (size_t i = 0; i < c->count; i++) {
        mw_mesh_vertex(mesh, (uint32_t)i, c->points + 3 * i);
        c->points[3 * i + 2] = z[i];
        highest = fmax(highest, fabs(z[i]));
    }
    c->limit = c->set.tolerance - fmin(c->set.tolerance / 2, 1e-12 * highest);
}

static void prepare(coarsening *c)
{
    mw_error error;
    mw_mesh *mesh = terrain_read(c->set.input);
    mw_editor_options options = {.delaunay = MW_DELAUNAY_MAKE, .undo = 4};
    if (mw_editor_create(mesh, &options, &c->editor, &error))
        fail(END_INPUT, "%s: %s", c->set.input, error.message);
    take_points(c, mesh);
    c->triangle_room = mw_mesh_triangle_count(mesh);
    c->first = enlarge(NULL, c->triangle_room, sizeof *c->first);
    c->error = enlarge(NULL, c->triangle_room, sizeof *c->error);
    c->vertex_room = c->count;
    c->stamp = calloc(c->vertex_room, sizeof *c->stamp);
    if (!c->stamp) fail(END_FAILED, "out of memory");
    mw_mesh_destroy(mesh);
    c->z = mw_editor_field_by_name(c->editor, "z");
    c->locator = mw_editor_locator(c->editor);
    if (mw_cursor_init(c->locator, &(mw_query_options){.start = MW_START_LAST}, &c->cursor, &error))
        fail_with(&error);
    c->astray = MW_NONE;
    for (size_t t = 0; t < c->triangle_room; t++) {
        c->first[t] = MW_NONE;
        c->error[t] = 0;
    }
    for (size_t i = 0; i < c->count; i++) settle(c, (uint32_t)i);
    for (size_t i = 0; i < c->count; i++) push(c, (uint32_t)i, 0);
}

/* Look at the result as anybody may who did not see how it came about: locate all points in it,
 * with a locator of its own. Returns the largest error; infinite if a point is not in it. */
static double check(const coarsening *c, const mw_mesh *mesh)
{
    mw_error error;
    mw_locator *locator;
    mw_location *at = enlarge(NULL, c->count, sizeof *at);
    double *height = enlarge(NULL, c->count, sizeof *height), largest = 0;
    if (mw_locator_create(mesh, NULL, &locator, &error) ||
        mw_locate_batch(locator, c->points, c->count, 3, NULL, at, NULL, &error))
        fail_with(&error);
    mw_interpolate(mesh, mw_mesh_field(mesh, "z"), at, c->count, height);
    for (size_t i = 0; i < c->count; i++) {
        double e = fabs(height[i] - c->points[3 * i + 2]);
        largest = e <= largest ? largest : isnan(e) ? INFINITY : e;
    }
    mw_locator_destroy(locator);
    free(height);
    free(at);
    return largest;
}

static void report(const coarsening *c, const mw_mesh *mesh, double largest, double seconds)
{
    uint32_t after = mw_mesh_vertex_count(mesh);
    printf("vertices: %zu before, %u after (%.2f %%)\n", c->count, after,
           100.0 * after / (double)c->count);
    printf("largest error: %.6g, allowed are %.6g\n", largest, c->set.tolerance);
    printf("points checked: %zu\n", c->count);
    printf("edits: %llu, %llu of them taken back; points located again: %llu\n",
           (unsigned long long)c->edits, (unsigned long long)c->undone,
           (unsigned long long)c->locations);
    printf("%.2f s: %.0f edits and %.0f locations a second\n", seconds,
           (double)(c->edits + c->undone) / seconds, (double)c->locations / seconds);
}

static const struct option options[] = {
    {"tolerance", required_argument, NULL, 't'},
    {"output", required_argument, NULL, 'o'},
    {"passes", required_argument, NULL, 'p'},
    {"help", no_argument, NULL, 'h'},
    {0},
};

static settings take_arguments(int argc, char **argv)
{
    settings set = {.tolerance = -1, .passes = 1};
    for (int letter; (letter = getopt_long(argc, argv, "t:o:p:h", options, NULL)) != -1;) {
        switch (letter) {
        case 't': set.tolerance = option_number("tolerance", optarg, 1e-300, 1e300); break;
        case 'o': set.output = optarg; break;
        case 'p': set.passes = (unsigned)option_number("passes", optarg, 0, 1e6); break;
        case 'h': printf("%s", usage); exit(0);
        default: fail(END_USAGE, "try 'coarsen --help'");
        }
    }
    if (argc - optind != 1) fail(END_USAGE, "one terrain is wanted; try 'coarsen --help'");
    if (set.tolerance < 0) fail(END_USAGE, "--tolerance is wanted: how large may the error be?");
    if (set.output && !terrain_can_write(set.output))
        fail(END_USAGE,
             "%s: the ending tells no format; one of .ply .off .obj .stl .node .vtk is wanted",
             set.output);
    set.input = argv[optind];
    return set;
}

int main(int argc, char **argv)
{
    program_name = "coarsen";
    coarsening c = {.set = take_arguments(argc, argv)};
    prepare(&c);
    double clock = terrain_clock();
    remove_all(&c);
    for (unsigned pass = 0; pass < c.set.passes; pass++)
        if (exchange_all(&c) == 0) break;
    clock = terrain_clock() - clock;

    mw_error error;
    mw_mesh *mesh;
    if (mw_editor_mesh(c.editor, NULL, NULL, &mesh, &error)) fail_with(&error);
    double largest = check(&c, mesh);
    if (!(largest <= c.set.tolerance))
        fail(END_FAILED, "the error is %g: not as small as wanted", largest);
    report(&c, mesh, largest, clock);
    if (c.set.output) terrain_write(c.set.output, mesh);
    mw_mesh_destroy(mesh);
    mw_editor_destroy(c.editor);
    free(c.points);
    free(c.next);
    free(c.first);
    free(c.error);
    free(c.touched);
    free(c.heap);
    free(c.stamp);
    return 0;
}
