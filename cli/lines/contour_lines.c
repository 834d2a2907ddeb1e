#include "cli/lines/contour_lines.h"
#include "cli/frame/message.h"
#include "cli/frame/progress.h"
#include "cli/lines/contour_bands.h"
#include "cli/lines/contour_point.h"

#include <stdlib.h>
#include <string.h>

typedef struct contour_tracer {
    const mw_mesh *mesh;
    const double *values, *levels;
    size_t level_count;
    uint32_t *band;     /* [vertex]: how many levels are at most as high; see contour_bands.h */
    size_t *first;      /* [level + 1]: of the triangles below */
    uint32_t *triangle; /* those that each level crosses */
    uint8_t *pending;   /* [triangle]: crossed by the present level, and not passed yet */
    size_t number;      /* of the present level */
    double *points;     /* of the present line */
    size_t count, room;
    int turn; /* > 0: higher values lie to the left of the line; 0: not known yet */
    contour_sink *sink;
    void *self;
} contour_tracer;

/* Sort the triangles by the levels that cross them. */
static int tracer_collect(contour_tracer *c)
{
    uint32_t count = mw_mesh_triangle_count(c->mesh), crossed = 0;
    contour_bands *bands = malloc(((size_t)count + 1) * sizeof *bands);
    uint32_t *which = malloc(((size_t)count + 1) * sizeof *which);
    c->band = contour_bands_of_values(c->values, mw_mesh_vertex_count(c->mesh), c->levels,
                                      c->level_count);
    c->first = calloc(c->level_count + 2, sizeof *c->first);
    c->pending = calloc((size_t)count + 1, 1);
    bool made = bands && which && c->band && c->first && c->pending;
    for (uint32_t t = 0; made && t < count; t++) {
        contour_bands b = bands[crossed] = contour_bands_of_triangle(c->mesh, c->band, t);
        which[crossed] = t;
        crossed += b.low < b.high;
        for (uint32_t i = b.low; i < b.high; i++) c->first[i + 2]++;
    }
    for (size_t i = 2; made && i < c->level_count + 2; i++) c->first[i] += c->first[i - 1];
    if (made) c->triangle = malloc((c->first[c->level_count + 1] + 1) * sizeof *c->triangle);
    made = made && c->triangle;
    for (uint32_t k = 0; made && k < crossed; k++)
        for (uint32_t i = bands[k].low; i < bands[k].high; i++)
            c->triangle[c->first[i + 1]++] = which[k];
    free(bands);
    free(which);
    return made ? 0 : fail_memory();
}

/* --- one line --- */

static bool tracer_is_above(const contour_tracer *c, uint32_t vertex)
{
    return c->band[vertex] > c->number;
}

/* Does the level cross local edge k? */
static bool tracer_crosses(const contour_tracer *c, const uint32_t v[3], unsigned k)
{
    return tracer_is_above(c, v[k]) != tracer_is_above(c, v[(k + 1) % 3]);
}

/* Does no triangle that is still to be passed lie beyond an edge that the level crosses? Then the
 * edge is on a border, or a value is missing beyond it: a line that passed there had come here. */
static bool tracer_ends_at(const contour_tracer *c, uint32_t t, unsigned k)
{
    uint32_t beyond = mw_mesh_neighbour(c->mesh, t, k, NULL);
    return beyond == MW_NONE || !c->pending[beyond];
}

static bool tracer_add_point(contour_tracer *c, const double p[2])
{
    if (c->count > 0 && p[0] == c->points[2 * c->count - 2] && p[1] == c->points[2 * c->count - 1])
        return true;
    if (c->count == c->room) {
        size_t room = 2 * c->room + 1024;
        double *points = realloc(c->points, 2 * room * sizeof *points);
        if (!points) return false;
        c->points = points;
        c->room = room;
    }
    memcpy(c->points + 2 * c->count++, p, 2 * sizeof *p);
    return true;
}

/* Where the level crosses an edge: the same point from both sides. */
static bool tracer_add_crossing(contour_tracer *c, const uint32_t v[3], unsigned k)
{
    double p[2];
    contour_point(c->mesh, c->values, c->levels[c->number], v[k], v[(k + 1) % 3], p);
    return tracer_add_point(c, p);
}

/* The side with the higher values, if this triangle shows it. The level cuts off the vertex between
 * the edges of entry and exit. */
static void tracer_note_side(contour_tracer *c, const uint32_t v[3], unsigned entry, unsigned exit)
{
    double p[3][2];
    if (c->turn) return;
    for (int k = 0; k < 3; k++) mw_mesh_vertex(c->mesh, v[k], p[k]);
    double area = mw_orient2d(p[0], p[1], p[2]);
    bool next = exit == (entry + 1) % 3;
    bool left = next ? area < 0 : area > 0; /* of the vertex that is cut off */
    if (area != 0) c->turn = left == tracer_is_above(c, v[next ? exit : entry]) ? 1 : -1;
}

static void tracer_reverse(contour_tracer *c)
{
    for (size_t i = 0, j = c->count; i + 1 < j; i++) {
        double p[2];
        j--;
        memcpy(p, c->points + 2 * i, sizeof p);
        memcpy(c->points + 2 * i, c->points + 2 * j, sizeof p);
        memcpy(c->points + 2 * j, p, sizeof p);
    }
}

static int tracer_finish_line(contour_tracer *c, bool closed)
{
    double begin[2] = {c->points[0], c->points[1]};
    if (closed && c->count > 1 && !tracer_add_point(c, begin)) return fail_memory();
    if (c->count < 2) return 0;
    if (c->turn < 0) tracer_reverse(c);
    return c->sink(c->self, &(contour_line){c->levels[c->number], closed, c->points, c->count});
}

/* Follow the line that enters triangle t over edge `entry`, to the border or back to t. */
static int tracer_follow(contour_tracer *c, uint32_t t, unsigned entry, bool closed)
{
    uint32_t v[3];
    c->count = 0;
    c->turn = 0;
    mw_mesh_triangle(c->mesh, t, v);
    if (!tracer_add_crossing(c, v, entry)) return fail_memory();
    while (t != MW_NONE && c->pending[t]) {
        c->pending[t] = 0;
        mw_mesh_triangle(c->mesh, t, v);
        unsigned exit = tracer_crosses(c, v, (entry + 1) % 3) ? (entry + 1) % 3 : (entry + 2) % 3;
        tracer_note_side(c, v, entry, exit);
        if (!tracer_add_crossing(c, v, exit)) return fail_memory();
        t = mw_mesh_neighbour(c->mesh, t, exit, &entry);
    }
    return tracer_finish_line(c, closed);
}

/* --- one level --- */

/* All lines of the level that begin at a border, then all that are closed. */
static int tracer_trace_level(contour_tracer *c, const uint32_t *triangles, size_t count)
{
    int end = 0;
    uint32_t v[3];
    for (size_t i = 0; i < count; i++) c->pending[triangles[i]] = 1;
    for (int closed = 0; closed < 2; closed++)
        for (size_t i = 0; end == 0 && i < count; i++) {
            uint32_t t = triangles[i];
            if (!c->pending[t]) continue;
            mw_mesh_triangle(c->mesh, t, v);
            for (unsigned k = 0; end == 0 && k < 3 && c->pending[t]; k++)
                if (tracer_crosses(c, v, k) && (closed || tracer_ends_at(c, t, k)))
                    end = tracer_follow(c, t, k, closed);
        }
    return end;
}

int contour_lines_trace(const mw_mesh *mesh, const double *values, const double *levels,
                        size_t level_count, contour_sink *sink, void *self)
{
    contour_tracer c = {.mesh = mesh,
                        .values = values,
                        .levels = levels,
                        .level_count = level_count,
                        .sink = sink,
                        .self = self};
    int end = tracer_collect(&c);
    for (size_t i = 0; end == 0 && i < level_count; i++) {
        c.number = i;
        end = tracer_trace_level(&c, c.triangle + c.first[i], c.first[i + 1] - c.first[i]);
        progress_lines(i + 1, (double)(i + 1) / (double)level_count);
    }
    free(c.band);
    free(c.first);
    free(c.triangle);
    free(c.pending);
    free(c.points);
    return end;
}
