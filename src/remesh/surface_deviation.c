/* surface_deviation.c - how far samples of a surface are from another surface. */
#include "base/options.h"
#include "surface/surface.h"

#include <math.h>
#include <meshwalk/remesh.h>
#include <stdlib.h>

/* What the threads share. A vertex is measured with its owner, the lowest triangle that has it, so
 * that samples measured one after the other are near each other. */
typedef struct deviation_work {
    const mw_surface *surface;
    const mw_prober *other;
    uint32_t *owner;   /* of each vertex; MW_NONE: it is not in use */
    double *at_vertex; /* distances */
    double *at_centroid;
} deviation_work;

/* --- samples --- */

static void triangle_centroid(const mw_surface *surface, uint32_t t, double p[3])
{
    for (int k = 0; k < 3; k++)
        p[k] = mw__surface_corner(surface, t, 0)[k] / 3 + mw__surface_corner(surface, t, 1)[k] / 3 +
               mw__surface_corner(surface, t, 2)[k] / 3;
}

static double points_distance(const double a[3], const double b[3])
{
    return hypot(hypot(a[0] - b[0], a[1] - b[1]), a[2] - b[2]);
}

/* The point of the other surface nearest to p. *hit has the answer of a sample near p, or MW_NONE:
 * its point limits the search. That point is rounded, so the search may find nothing; then it has
 * no limit. */
static void sample_measure(const deviation_work *w, const double p[3],
                           mw_nearest_surface_point *hit)
{
    double limit = INFINITY;
    if (hit->triangle != MW_NONE) limit = points_distance(p, hit->point) * (1 + 0x1p-40);
    if (mw_nearest_on_surface(w->other, p, limit, hit, NULL) == MW_OK && hit->triangle == MW_NONE)
        mw_nearest_on_surface(w->other, p, INFINITY, hit, NULL);
}

static void triangles_measure(void *work, uint64_t from, uint64_t to)
{
    const deviation_work *w = work;
    mw_nearest_surface_point hit = {.triangle = MW_NONE};
    for (uint64_t i = from; i < to; i++) {
        const uint32_t t = (uint32_t)i, *v = w->surface->tri[t].v;
        double middle[3];
        for (int k = 0; k < 3; k++) {
            if (w->owner[v[k]] != t) continue;
            sample_measure(w, mw__surface_point(w->surface, v[k]), &hit);
            w->at_vertex[v[k]] = hit.distance;
        }
        triangle_centroid(w->surface, t, middle);
        sample_measure(w, middle, &hit);
        w->at_centroid[t] = hit.distance;
    }
}

/* --- the result --- */

static double triangle_size(const mw_surface *surface, uint32_t t)
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

/* No point of triangle t is farther from the other surface than this. The centroid cuts it into
 * three triangles, whose corners are samples. */
static double triangle_at_most(const deviation_work *w, uint32_t t)
{
    const uint32_t *v = w->surface->tri[t].v;
    double middle[3], most = 0;
    triangle_centroid(w->surface, t, middle);
    for (uint32_t k = 0; k < 3; k++) {
        const uint32_t from = v[k], to = v[(k + 1) % 3];
        const double *a = mw__surface_point(w->surface, from),
                     *b = mw__surface_point(w->surface, to);
        const double longest = fmax(points_distance(a, b),
                                    fmax(points_distance(a, middle), points_distance(b, middle)));
        const double corners = fmax(w->at_centroid[t], fmax(w->at_vertex[from], w->at_vertex[to]));
        most = fmax(most, corners + COVERED * longest);
    }
    return most;
}

/* The sample with the largest distance so far: corner k of triangle t, or its centroid, k = 3. */
typedef struct farthest_sample {
    uint32_t t;
    int k;
    double distance;
    uint64_t samples;
} farthest_sample;

static void farthest_take(farthest_sample *f, uint32_t t, int k, double distance)
{
    f->samples++;
    if (f->samples > 1 && !(distance > f->distance)) return;
    f->t = t;
    f->k = k;
    f->distance = distance;
}

/* Look at the farthest sample once more, for its nearest point. */
static void farthest_tell(const deviation_work *w, const farthest_sample *f, mw_deviation *out)
{
    mw_nearest_surface_point hit;
    const double *corner = mw__surface_corner(w->surface, f->t, (uint32_t)f->k);
    for (int k = 0; k < 3 && f->k < 3; k++) out->point[k] = corner[k];
    if (f->k == 3) triangle_centroid(w->surface, f->t, out->point);
    mw_nearest_on_surface(w->other, out->point, INFINITY, &hit, NULL);
    for (int k = 0; k < 3; k++) out->nearest[k] = hit.point[k];
    out->largest = f->distance;
    out->triangle = f->t;
    out->nearest_triangle = hit.triangle;
    out->samples = f->samples;
}

static void deviation_sum_up(const deviation_work *w, mw_deviation *out)
{
    double sum = 0;
    farthest_sample farthest = {0};
    *out = (mw_deviation){0};
    for (uint32_t t = 0; t < w->surface->tri_count; t++) {
        const uint32_t *v = w->surface->tri[t].v;
        const double size = triangle_size(w->surface, t);
        double value = 0.75 * w->at_centroid[t];
        for (int k = 0; k < 3; k++) {
            value += w->at_vertex[v[k]] / 12;
            if (w->owner[v[k]] == t) farthest_take(&farthest, t, k, w->at_vertex[v[k]]);
        }
        farthest_take(&farthest, t, 3, w->at_centroid[t]);
        out->at_most = fmax(out->at_most, triangle_at_most(w, t));
        out->area += size;
        sum += size * value;
    }
    out->mean = out->area > 0 ? sum / out->area : NAN;
    farthest_tell(w, &farthest, out);
}

/* --- the call --- */

/* Note the owners; refuse vertices that are not finite. */
static mw_status deviation_find_owners(const deviation_work *w, mw_error *error)
{
    for (uint32_t v = 0; v < w->surface->point_count; v++) w->owner[v] = MW_NONE;
    for (uint32_t t = 0; t < w->surface->tri_count; t++)
        for (uint32_t k = 0; k < 3; k++) {
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

static mw_status deviation_run(deviation_work *w, mw_job *job, mw_deviation *out, mw_error *error)
{
    w->owner = mw__alloc(w->surface->point_count, sizeof *w->owner);
    w->at_vertex = mw__alloc(w->surface->point_count, sizeof *w->at_vertex);
    w->at_centroid = mw__alloc(w->surface->tri_count, sizeof *w->at_centroid);
    if (!w->owner || !w->at_vertex || !w->at_centroid) return mw__fail_memory(error);
    mw_status status = deviation_find_owners(w, error);
    if (status) return status;
    mw__job_stage(job, "measuring distances", 1);
    if (!mw__job_ranges(job, w->surface->tri_count, triangles_measure, w))
        return mw__fail_memory(error);
    deviation_sum_up(w, out);
    return MW_OK;
}

mw_status mw_surface_deviation(const mw_surface *surface, const mw_prober *other,
                               const mw_remesh_options *options, mw_deviation *out, mw_error *error)
{
    static const mw_remesh_options defaults;
    if (!surface || !other || !out)
        return mw__fail(error, MW_ERROR_ARGUMENT, "the surface, the prober or the result is NULL");
    if (surface->tri_count == 0)
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
    free(w.at_centroid);
    return mw__job_end(&job, status, error);
}
