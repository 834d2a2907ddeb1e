/* surface_deviation.c - how far samples of a surface are from another surface [Cignoni, Rocchini,
 * Scopigno 1998].
 *
 * A triangle is cut into f * f pieces along a lattice, row by row. The corners of triangles are
 * measured first, each once; the other points of the lattice with their triangle. Threads take
 * chunks of triangles, and what they find is joined in the order of the chunks. */
#include "base/options.h"
#include "probe/nearest_in_triangle.h"

#include <math.h>
#include <meshwalk/remesh.h>
#include <stdlib.h>

enum { DEVIATION_CHUNK = 1024, MOST_PARTS = 64 };

/* What a chunk of triangles adds to the result: sums by area, and the farthest sample. */
typedef struct deviation_sum {
    double area, moment, at_most, largest, point[3];
    uint32_t triangle;
    uint64_t samples;
} deviation_sum;

typedef struct deviation_work {
    const mw_surface *surface;
    const mw_prober *other;
    double piece;      /* area: larger triangles are cut */
    uint32_t *owner;   /* of each vertex the lowest triangle; MW_NONE: it is not in use */
    double *at_vertex; /* distances */
    deviation_sum *sum;
} deviation_work;

/* --- samples --- */

static double points_distance(const double a[3], const double b[3])
{
    return hypot(hypot(a[0] - b[0], a[1] - b[1]), a[2] - b[2]);
}

/* The point of the other surface nearest to p. *hit has the answer of a sample near p, or MW_NONE:
 * its point limits the search. That point is rounded, so the search may find nothing; then it has
 * no limit. */
static double sample_measure(const deviation_work *w, const double p[3],
                             mw_nearest_surface_point *hit)
{
    double limit = INFINITY;
    if (hit->triangle != MW_NONE) limit = points_distance(p, hit->point) * (1 + 0x1p-40);
    if (mw_nearest_on_surface(w->other, p, limit, hit, NULL) == MW_OK && hit->triangle == MW_NONE)
        mw_nearest_on_surface(w->other, p, INFINITY, hit, NULL);
    return hit->distance;
}

static void sum_take_sample(deviation_sum *sum, uint32_t t, const double p[3], double distance)
{
    if (!(distance > sum->largest) && sum->triangle != MW_NONE) return;
    sum->largest = distance;
    sum->triangle = t;
    for (int k = 0; k < 3; k++) sum->point[k] = p[k];
}

static uint64_t chunk_end(const deviation_work *w, uint64_t chunk)
{
    const uint64_t end = (chunk + 1) * DEVIATION_CHUNK;
    return end < w->surface->tri_count ? end : w->surface->tri_count;
}

/* Measure the vertices that triangles of the chunk own: those measured one after the other are
 * near each other. */
static void chunk_measure_vertices(void *work, uint64_t chunk, uint32_t member)
{
    const deviation_work *w = work;
    mw_nearest_surface_point hit = {.triangle = MW_NONE};
    (void)member;
    for (uint64_t t = chunk * DEVIATION_CHUNK; t < chunk_end(w, chunk); t++)
        for (int k = 0; k < 3 && !mw__surface_is_freed(w->surface, (uint32_t)t); k++) {
            const uint32_t v = w->surface->tri[t].v[k];
            if (w->owner[v] != t) continue;
            w->at_vertex[v] = sample_measure(w, mw__surface_point(w->surface, v), &hit);
            w->sum[chunk].samples++;
        }
}

/* --- pieces --- */

/* A point of the lattice. */
typedef struct lattice_point {
    double p[3], distance;
} lattice_point;

/* A triangle that is being cut. */
typedef struct cut_triangle {
    const deviation_work *work;
    uint32_t t, parts; /* parts of each edge */
    double size;       /* area of a piece */
    deviation_sum *sum;
    mw_nearest_surface_point hit; /* of the last sample */
} cut_triangle;

static double triangle_area(const mw_surface *surface, uint32_t t)
{
    const double *a = mw__surface_corner(surface, t, 0), *b = mw__surface_corner(surface, t, 1),
                 *c = mw__surface_corner(surface, t, 2);
    double n[3];
    for (int k = 0; k < 3; k++) {
        const int i = (k + 1) % 3, j = (k + 2) % 3;
        n[k] = (b[i] - a[i]) * (c[j] - a[j]) - (b[j] - a[j]) * (c[i] - a[i]);
    }
    return hypot(hypot(n[0], n[1]), n[2]) / 2;
}

/* 1 / sqrt(3): no point of a triangle is farther from the nearest corner than this times the
 * longest edge. With angles of at most 90 degrees that distance is the radius of the circumcircle,
 * half of the longest edge over the sine of its angle of 60 degrees or more; in others it is
 * less. */
#define COVERED 0.57735026918962584

/* No point of the piece is farther than this from the other surface. */
static double piece_at_most(const cut_triangle *c, const lattice_point *const corner[3],
                            uint32_t nearest)
{
    double samples = 0, longest = 0, from_one = 0;
    for (int k = 0; k < 3; k++) {
        const double *p = corner[k]->p;
        samples = fmax(samples, corner[k]->distance);
        longest = fmax(longest, points_distance(p, corner[(k + 1) % 3]->p));
        from_one = fmax(from_one, mw__distance_to_triangle(c->work->other->surface, nearest, p));
    }
    return fmin(from_one, samples + COVERED * longest);
}

static void piece_add(cut_triangle *c, const lattice_point *a, const lattice_point *b,
                      const lattice_point *e)
{
    const lattice_point *const corner[3] = {a, b, e};
    double middle[3];
    for (int k = 0; k < 3; k++) middle[k] = a->p[k] / 3 + b->p[k] / 3 + e->p[k] / 3;
    const double distance = sample_measure(c->work, middle, &c->hit);
    c->sum->samples++;
    sum_take_sample(c->sum, c->t, middle, distance);
    c->sum->area += c->size;
    c->sum->moment += c->size * (0.75 * distance + (a->distance + b->distance + e->distance) / 12);
    c->sum->at_most = fmax(c->sum->at_most, piece_at_most(c, corner, c->hit.triangle));
}

/* The point of the lattice that is i parts from the first corner to the second, and j to the
 * third. */
static lattice_point lattice_take(cut_triangle *c, uint32_t i, uint32_t j)
{
    const mw_surface *surface = c->work->surface;
    const uint32_t part[3] = {c->parts - i - j, i, j}, *v = surface->tri[c->t].v;
    lattice_point x = {{0, 0, 0}, 0};
    for (uint32_t k = 0; k < 3; k++)
        for (int m = 0; m < 3; m++)
            x.p[m] += mw__surface_point(surface, v[k])[m] * ((double)part[k] / c->parts);
    for (uint32_t k = 0; k < 3; k++) {
        if (part[k] != c->parts) continue;
        x.distance = c->work->at_vertex[v[k]]; /* a vertex, measured already */
        for (int m = 0; m < 3; m++) x.p[m] = mw__surface_point(surface, v[k])[m];
        sum_take_sample(c->sum, c->t, x.p, x.distance);
        return x;
    }
    x.distance = sample_measure(c->work, x.p, &c->hit);
    c->sum->samples++;
    sum_take_sample(c->sum, c->t, x.p, x.distance);
    return x;
}

static void triangle_cut(cut_triangle *c)
{
    lattice_point row[2][MOST_PARTS + 1];
    for (uint32_t i = 0; i <= c->parts; i++) row[0][i] = lattice_take(c, i, 0);
    for (uint32_t j = 1; j <= c->parts; j++) {
        const lattice_point *below = row[(j - 1) % 2];
        lattice_point *above = row[j % 2];
        for (uint32_t i = 0; i + j <= c->parts; i++) {
            above[i] = lattice_take(c, i, j);
            piece_add(c, &below[i], &below[i + 1], &above[i]);
            if (i > 0) piece_add(c, &below[i], &above[i], &above[i - 1]);
        }
    }
}

static void chunk_measure_triangles(void *work, uint64_t chunk, uint32_t member)
{
    const deviation_work *w = work;
    cut_triangle c = {.work = w, .sum = &w->sum[chunk], .hit = {.triangle = MW_NONE}};
    (void)member;
    for (uint64_t t = chunk * DEVIATION_CHUNK; t < chunk_end(w, chunk); t++) {
        if (mw__surface_is_freed(w->surface, (uint32_t)t)) continue;
        const double area = triangle_area(w->surface, (uint32_t)t), parts = sqrt(area / w->piece);
        c.t = (uint32_t)t;
        c.parts = !(parts > 1) ? 1 : parts < MOST_PARTS ? (uint32_t)ceil(parts) : MOST_PARTS;
        c.size = area / c.parts / c.parts;
        triangle_cut(&c);
    }
}

/* --- the call --- */

/* The mean triangle of the other surface, or what that would be if it were as large as this one. */
static double deviation_piece(const mw_surface *surface, const mw_surface *other)
{
    double here = 0, there = 0;
    for (uint32_t t = 0; t < surface->tri_count; t++) here += triangle_area(surface, t);
    for (uint32_t t = 0; t < other->tri_count; t++)
        if (mw__corners_finite(other, t)) there += triangle_area(other, t);
    return fmax(here, there) / other->tri_count;
}

/* Note the owners; refuse vertices that are not finite. */
static mw_status deviation_find_owners(const deviation_work *w, mw_error *error)
{
    for (uint32_t v = 0; v < w->surface->point_count; v++) w->owner[v] = MW_NONE;
    for (uint32_t t = 0; t < w->surface->tri_count; t++)
        for (uint32_t k = 0; k < 3 && !mw__surface_is_freed(w->surface, t); k++) {
            const uint32_t v = w->surface->tri[t].v[k];
            if (w->owner[v] != MW_NONE) continue;
            if (!mw__is_finite3(mw__surface_point(w->surface, v)))
                return mw__fail_at(error, t, v, "vertex %u is not finite", v);
            w->owner[v] = t;
        }
    return MW_OK;
}

/* One sample tells whether the prober can answer at all. */
static mw_status deviation_try(const mw_surface *surface, const mw_prober *other, mw_error *error)
{
    mw_nearest_surface_point hit;
    const double *p = mw__surface_corner(surface, 0, 0);
    mw_status status = mw_nearest_on_surface(other, p, INFINITY, &hit, error);
    if (status || hit.triangle != MW_NONE || !mw__is_finite3(p)) return status;
    return mw__fail(error, MW_ERROR_INPUT, "the other surface has no triangle with an area");
}

static void deviation_sum_up(const deviation_work *w, uint64_t chunks, mw_deviation *out)
{
    deviation_sum all = {.triangle = MW_NONE};
    mw_nearest_surface_point hit;
    for (uint64_t c = 0; c < chunks; c++) {
        const deviation_sum *s = &w->sum[c];
        if (s->triangle == MW_NONE) continue; /* its triangles are freed */
        all.area += s->area;
        all.moment += s->moment;
        all.samples += s->samples;
        all.at_most = fmax(all.at_most, s->at_most);
        sum_take_sample(&all, s->triangle, s->point, s->largest);
    }
    mw_nearest_on_surface(w->other, all.point, INFINITY, &hit, NULL);
    *out = (mw_deviation){.largest = all.largest,
                          .at_most = fmax(all.at_most, all.largest),
                          .mean = all.area > 0 ? all.moment / all.area : NAN,
                          .triangle = all.triangle,
                          .nearest_triangle = hit.triangle,
                          .samples = all.samples,
                          .area = all.area};
    for (int k = 0; k < 3; k++) {
        out->point[k] = all.point[k];
        out->nearest[k] = hit.point[k];
    }
}

static mw_status deviation_run(deviation_work *w, mw_job *job, mw_deviation *out, mw_error *error)
{
    const uint64_t chunks =
        ((uint64_t)w->surface->tri_count + DEVIATION_CHUNK - 1) / DEVIATION_CHUNK;
    w->owner = mw__alloc(w->surface->point_count, sizeof *w->owner);
    w->at_vertex = mw__alloc(w->surface->point_count, sizeof *w->at_vertex);
    w->sum = mw__calloc(chunks, sizeof *w->sum);
    if (!w->owner || !w->at_vertex || !w->sum) return mw__fail_memory(error);
    mw_status status = deviation_find_owners(w, error);
    if (status) return status;
    for (uint64_t c = 0; c < chunks; c++) w->sum[c].triangle = MW_NONE;
    w->piece = deviation_piece(w->surface, w->other->surface);
    const uint32_t team = mw__job_team(job, chunks);
    mw__job_stage(job, "measuring vertices", 0.25);
    if (!mw__job_chunks(job, team, chunks, chunk_measure_vertices, w))
        return mw__fail_memory(error);
    mw__job_stage(job, "measuring triangles", 0.75);
    if (!mw__job_chunks(job, team, chunks, chunk_measure_triangles, w))
        return mw__fail_memory(error);
    deviation_sum_up(w, chunks, out);
    return MW_OK;
}

mw_status mw_surface_deviation(const mw_surface *surface, const mw_prober *other,
                               const mw_remesh_options *options, mw_deviation *out, mw_error *error)
{
    static const mw_remesh_options defaults;
    if (!surface || !other || !out)
        return mw__fail(error, MW_ERROR_ARGUMENT, "the surface, the prober or the result is NULL");
    if (surface->tri_count == surface->freed_triangles)
        return mw__fail(error, MW_ERROR_INPUT, "the surface has no triangle");
    if (!options) options = &defaults;
    mw_status status = MW_RESERVED_CHECK(mw_remesh_options, options, error);
    if (!status) status = deviation_try(surface, other, error);
    if (status) return status;
    deviation_work w = {.surface = surface, .other = other};
    mw_job job = mw__job(options->threads, options->progress);
    status = deviation_run(&w, &job, out, error);
    free(w.owner);
    free(w.at_vertex);
    free(w.sum);
    return mw__job_end(&job, status, error);
}
