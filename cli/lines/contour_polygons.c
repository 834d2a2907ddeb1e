#include "cli/lines/contour_polygons.h"
#include "cli/frame/message.h"
#include "cli/frame/progress.h"
#include "cli/lines/contour_bands.h"
#include "cli/lines/contour_point.h"
#include "cli/lines/part_sets.h"
#include "cli/lines/ring_links.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* What the polygons of one mesh are made with. */
typedef struct band_maker {
    const mw_mesh *mesh;
    const double *values, *levels;
    size_t level_count;
    uint32_t *band;     /* [vertex]: see contour_bands.h */
    size_t *first;      /* [band + 1]: of its triangles below */
    uint32_t *triangle; /* those that have a part of each band */
    uint32_t *parent;   /* [triangle]: another one of the same part of the band, see part_sets.h */
    double least, greatest; /* value */
    double low, high;       /* of the present band: values from low on, below high */
    ring_segments segments;
    ring_set rings;
    double *points; /* of a polygon */
    size_t *starts;
    contour_polygon_sink *sink;
    void *self;
} band_maker;

/* --- which triangles have which bands --------------------------------------------------------- */

static int bands_collect(band_maker *b)
{
    uint32_t count = mw_mesh_triangle_count(b->mesh), v[3];
    size_t bands = b->level_count + 1;
    b->first = calloc(bands + 2, sizeof *b->first);
    b->parent = malloc(((size_t)count + 1) * sizeof *b->parent);
    contour_bands *range = malloc(((size_t)count + 1) * sizeof *range);
    bool made = b->first && b->parent && range;
    b->least = INFINITY;
    b->greatest = -INFINITY;
    for (uint32_t t = 0; made && t < count; t++) {
        range[t] = contour_bands_of_triangle(b->mesh, b->band, t);
        if (range[t].low == CONTOUR_NO_BAND) continue;
        for (uint32_t i = range[t].low; i <= range[t].high; i++) b->first[i + 2]++;
        mw_mesh_triangle(b->mesh, t, v);
        for (int k = 0; k < 3; k++) {
            b->least = fmin(b->least, b->values[v[k]]);
            b->greatest = fmax(b->greatest, b->values[v[k]]);
        }
    }
    for (size_t i = 2; made && i < bands + 2; i++) b->first[i] += b->first[i - 1];
    if (made) b->triangle = malloc((b->first[bands + 1] + 1) * sizeof *b->triangle);
    made = made && b->triangle;
    for (uint32_t t = 0; made && t < count; t++)
        for (uint32_t i = range[t].low; i != CONTOUR_NO_BAND && i <= range[t].high; i++)
            b->triangle[b->first[i + 1]++] = t;
    free(range);
    return made ? 0 : fail_memory();
}

/* The triangle beyond an edge; MW_NONE on a border, and where a value is missing. */
static uint32_t band_beyond(const band_maker *b, uint32_t t, unsigned k)
{
    uint32_t beyond = mw_mesh_neighbour(b->mesh, t, k, NULL);
    if (beyond == MW_NONE) return MW_NONE;
    contour_bands range = contour_bands_of_triangle(b->mesh, b->band, beyond);
    return range.low == CONTOUR_NO_BAND ? MW_NONE : beyond;
}

/* --- what hangs together ---------------------------------------------------------------------- */

/* Does an edge have more than a point of the band? */
static bool band_has_edge(const band_maker *b, uint32_t from, uint32_t to)
{
    double low = fmin(b->values[from], b->values[to]), high = fmax(b->values[from], b->values[to]);
    return low < b->high && (high > b->low || low >= b->low);
}

static void band_join(band_maker *b, const uint32_t *triangles, size_t count)
{
    uint32_t v[3];
    for (size_t i = 0; i < count; i++) b->parent[triangles[i]] = triangles[i];
    for (size_t i = 0; i < count; i++) {
        uint32_t t = triangles[i];
        mw_mesh_triangle(b->mesh, t, v);
        for (unsigned k = 0; k < 3; k++) {
            uint32_t beyond = band_beyond(b, t, k);
            if (beyond == MW_NONE || beyond < t || !band_has_edge(b, v[k], v[(k + 1) % 3]))
                continue;
            part_join(b->parent, t, beyond);
        }
    }
}

/* --- what bounds the band --------------------------------------------------------------------- */

/* The segment along which a level crosses a triangle, with what lies above it to its left. */
static bool band_add_crossing(band_maker *b, const uint32_t v[3], double level, bool above,
                              uint32_t part)
{
    double p[2][2];
    int found = 0;
    for (int k = 0; k < 3; k++) {
        uint32_t from = v[k], to = v[(k + 1) % 3];
        bool falls = b->values[from] >= level;
        if (falls == (b->values[to] >= level)) continue;
        contour_point(b->mesh, b->values, level, from, to, p[falls ? 0 : 1]);
        found++;
    }
    if (found == 0) return true;
    return ring_segments_add(&b->segments, p[!above], p[above], part);
}

/* Where the band begins on an edge, seen from a vertex. */
static void band_clip(const band_maker *b, uint32_t from, uint32_t to, double p[2])
{
    double z = b->values[from];
    if (z < b->low)
        contour_point(b->mesh, b->values, b->low, from, to, p);
    else if (z >= b->high)
        contour_point(b->mesh, b->values, b->high, from, to, p);
    else
        mw_mesh_vertex(b->mesh, from, p);
}

static bool band_add_triangle(band_maker *b, uint32_t t)
{
    uint32_t v[3], part = part_root(b->parent, t);
    double p[3][2], clip[2][2];
    mw_mesh_triangle(b->mesh, t, v);
    for (int k = 0; k < 3; k++) mw_mesh_vertex(b->mesh, v[k], p[k]);
    bool turned = mw_orient2d(p[0], p[1], p[2]) < 0, added = true;
    for (unsigned k = 0; k < 3; k++) {
        uint32_t from = v[turned ? (k + 1) % 3 : k], to = v[turned ? k : (k + 1) % 3];
        if (!band_has_edge(b, from, to) || band_beyond(b, t, k) != MW_NONE) continue;
        band_clip(b, from, to, clip[0]);
        band_clip(b, to, from, clip[1]);
        added = added && ring_segments_add(&b->segments, clip[0], clip[1], part);
    }
    const uint32_t around[3] = {v[0], v[turned ? 2 : 1], v[turned ? 1 : 2]};
    return added && band_add_crossing(b, around, b->low, true, part) &&
           band_add_crossing(b, around, b->high, false, part);
}

/* --- polygons --------------------------------------------------------------------------------- */

/* Rings of one part stand together, outlines first, in the order in which they were found. */
static int band_compare_rings(const void *x, const void *y)
{
    const linked_ring *a = x, *b = y;
    if (a->part != b->part) return a->part < b->part ? -1 : 1;
    if (a->outer != b->outer) return a->outer ? -1 : 1;
    return (a->first > b->first) - (a->first < b->first);
}

/* The outline that contains a hole. A part has several outlines only if rounding has cut it. */
static const linked_ring *band_find_outline(const band_maker *b, const linked_ring *outlines,
                                            size_t count, const linked_ring *hole)
{
    const linked_ring *best = NULL;
    for (size_t i = 0; count > 1 && i < count; i++) {
        int side = 0;
        for (size_t k = 0; side == 0 && k < hole->count; k++)
            side = ring_holds(&b->rings, &outlines[i], b->rings.points + 2 * (hole->first + k));
        if (side >= 0 && (!best || outlines[i].area < best->area)) best = &outlines[i];
    }
    return best ? best : outlines;
}

static void polygon_add_ring(const band_maker *b, contour_polygon *polygon, const linked_ring *r)
{
    const double *from = b->rings.points + 2 * r->first;
    size_t at = b->starts[polygon->ring_count];
    memcpy(b->points + 2 * at, from, 2 * r->count * sizeof *from);
    memcpy(b->points + 2 * (at + r->count), from, 2 * sizeof *from);
    b->starts[++polygon->ring_count] = at + r->count + 1;
}

/* The polygons of one part: rings of which the first `outlines` are outlines. */
static int band_write_part(band_maker *b, const linked_ring *rings, size_t outlines, size_t count)
{
    int end = 0;
    for (size_t i = 0; end == 0 && i < outlines; i++) {
        contour_polygon polygon = {.low = isinf(b->low) ? b->least : b->low,
                                   .high = isinf(b->high) ? b->greatest : b->high,
                                   .points = b->points,
                                   .first = b->starts};
        polygon_add_ring(b, &polygon, &rings[i]);
        for (size_t k = outlines; k < count; k++)
            if (band_find_outline(b, rings, outlines, &rings[k]) == &rings[i])
                polygon_add_ring(b, &polygon, &rings[k]);
        end = b->sink(b->self, &polygon);
    }
    return end;
}

static int band_write(band_maker *b)
{
    int end = 0;
    const linked_ring *rings = b->rings.rings;
    size_t room = b->segments.count + b->rings.count + 1;
    free(b->points);
    free(b->starts);
    b->points = malloc(2 * room * sizeof *b->points);
    b->starts = calloc(b->rings.count + 2, sizeof *b->starts);
    if (!b->points || !b->starts) return fail_memory();
    if (b->rings.count > 0)
        qsort(b->rings.rings, b->rings.count, sizeof *b->rings.rings, band_compare_rings);
    for (size_t i = 0, next; end == 0 && i < b->rings.count; i = next) {
        size_t outlines = 0;
        for (next = i; next < b->rings.count && rings[next].part == rings[i].part; next++)
            outlines += rings[next].outer;
        end = band_write_part(b, rings + i, outlines, next - i);
    }
    return end;
}

static int band_make(band_maker *b, size_t band)
{
    const uint32_t *triangles = b->triangle + b->first[band];
    size_t count = b->first[band + 1] - b->first[band];
    b->low = band > 0 ? b->levels[band - 1] : -(double)INFINITY;
    b->high = band < b->level_count ? b->levels[band] : (double)INFINITY;
    b->segments.count = 0;
    band_join(b, triangles, count);
    for (size_t i = 0; i < count; i++)
        if (!band_add_triangle(b, triangles[i])) return fail_memory();
    ring_set_release(&b->rings);
    if (!ring_links_make(&b->segments, b->parent, &b->rings)) return fail_memory();
    return band_write(b);
}

int contour_polygons_make(const mw_mesh *mesh, const double *values, const double *levels,
                          size_t level_count, contour_polygon_sink *sink, void *self)
{
    band_maker b = {.mesh = mesh,
                    .values = values,
                    .levels = levels,
                    .level_count = level_count,
                    .sink = sink,
                    .self = self};
    b.band = contour_bands_of_values(values, mw_mesh_vertex_count(mesh), levels, level_count);
    int end = b.band ? bands_collect(&b) : fail_memory();
    for (size_t i = 0; end == 0 && i <= level_count; i++) {
        if (b.first[i + 1] > b.first[i]) end = band_make(&b, i);
        progress_lines(i + 1, (double)(i + 1) / (double)(level_count + 1));
    }
    ring_set_release(&b.rings);
    free(b.band);
    free(b.first);
    free(b.triangle);
    free(b.parent);
    free(b.segments.all);
    free(b.points);
    free(b.starts);
    return end;
}
