/* star_walk.h - the vocabulary of the walks on star-shaped polyhedra, and the drivers of their
 * steps. Private. */
#ifndef MW_SRC_STAR_STAR_WALK_H
#define MW_SRC_STAR_STAR_WALK_H

#include "star/star.h"

/* Always a literal where a kernel is made; the compiler deletes what is off. */
typedef struct mw_star_policy {
    bool count, lanes;
} mw_star_policy;

/* det(a - c, b - c, q - c), with d = q - c, rounded: > 0 if q lies to the left of the great circle
 * from a to b, seen from outside. The sign is exact. It is orient3d(a, b, q, c) with the opposite
 * sign, and one row precomputed. */
static MW_INLINE double mw__star_orient(const double a[3], const double b[3], const double q[3],
                                        const double d[3], const double c[3])
{
    double ax = a[0] - c[0], ay = a[1] - c[1], az = a[2] - c[2];
    double bx = b[0] - c[0], by = b[1] - c[1], bz = b[2] - c[2];
    double bd = bx * d[1], db = d[0] * by, da = d[0] * ay, ad = ax * d[1], ab = ax * by,
           ba = bx * ay;
    double det = az * (bd - db) + bz * (da - ad) + d[2] * (ab - ba);
    double permanent = fabs(az) * (fabs(bd) + fabs(db)) + fabs(bz) * (fabs(da) + fabs(ad)) +
                       fabs(d[2]) * (fabs(ab) + fabs(ba));
    bool small = fabs(az) + fabs(bz) + fabs(d[2]) < MW_ORIENT3D_HEIGHTS;
    if (MW_LIKELY(small && fabs(det) > MW_ORIENT3D_ERROR * permanent + MW_UNDERFLOW_ERROR))
        return det;
    return -mw__orient3d_exact(a, b, q, c);
}

/* Does the ray through q lie strictly beyond edge e of a facet? Decides the rare cases where floats
 * are not sure. */
bool mw__star_beyond(const mw_star *star, const mw_star_facet *facet, uint32_t e,
                     const double q[3]);

static MW_INLINE const double *star_vertex(const mw_star_walk *w, uint32_t v)
{
    return w->point + 3 * (size_t)v;
}

/* Corner k of the current facet, and the corner opposite to edge e. */
static MW_INLINE const double *star_corner(const mw_star_walk *w, uint32_t k)
{
    return star_vertex(w, w->facet[w->t].v[k]);
}
static MW_INLINE const double *star_apex(const mw_star_walk *w, uint32_t e)
{
    return star_corner(w, mw__prev(e));
}

/* The side of q relative to the great circle from a to b, counted. */
static MW_INLINE double star_orient(mw_star_walk *w, const double a[3], const double b[3],
                                    mw_star_policy P)
{
    if (P.count) w->work->orient[w->stage]++;
    return mw__star_orient(a, b, w->q, w->d, w->c);
}

/* The same for edge e: < 0 if the ray lies strictly beyond it. */
static MW_INLINE double star_edge_orient(mw_star_walk *w, uint32_t e, mw_star_policy P)
{
    return star_orient(w, star_corner(w, e), star_corner(w, mw__next(e)), P);
}

/* Does the ray lie strictly beyond edge e, so that the great circle of the edge separates it from
 * the facet? Exact. */
static MW_INLINE bool star_beyond(mw_star_walk *w, uint32_t e, mw_star_policy P)
{
    if (P.count) w->work->orient[w->stage]++;
    const mw_star_facet *facet = &w->facet[w->t];
    const float *n = facet->normal[e];
    float side = n[0] * w->f[0] + n[1] * w->f[1] + n[2] * w->f[2];
    if (MW_LIKELY(fabsf(side) > MW_STAR_SURE)) return side < 0;
    /* A copy: taking the address of the walk would move it out of registers. */
    double q[3] = {w->q[0], w->q[1], w->q[2]};
    return mw__star_beyond(w->star, facet, e, q);
}

/* Bit k: the ray lies strictly beyond edge k. Not counted. The ray is never beyond the entry edge,
 * as tests are exact on both sides of an edge. */
static MW_INLINE uint32_t star_edges_beyond(mw_star_walk *w)
{
    const mw_star_facet *facet = &w->facet[w->t];
    float side[3], least = INFINITY;
    for (uint32_t k = 0; k < 3; k++) {
        const float *n = facet->normal[k];
        side[k] = n[0] * w->f[0] + n[1] * w->f[1] + n[2] * w->f[2];
        least = fabsf(side[k]) < least ? fabsf(side[k]) : least;
    }
    uint32_t beyond = 0;
    for (uint32_t k = 0; k < 3; k++) beyond |= (uint32_t)(side[k] < 0) << k;
    if (MW_LIKELY(least > MW_STAR_SURE)) return beyond;
    beyond = 0;
    double q[3] = {w->q[0], w->q[1], w->q[2]};
    for (uint32_t k = 0; k < 3; k++) beyond |= (uint32_t)mw__star_beyond(w->star, facet, k, q) << k;
    return beyond;
}

/* Go to the facet across edge e, which exists. Reads nothing of that facet. */
static MW_INLINE mw_star_verdict star_cross(mw_star_walk *w, uint32_t e, mw_star_policy P)
{
    uint32_t link = w->facet[w->t].link[e];
    w->t = mw__link_triangle(link);
    w->e = mw__link_edge(link);
    if (P.count) {
        w->work->visited++;
        w->work->triangles[w->stage]++;
    }
    return MW_STAR_GO;
}

/* Leave through edge e if the ray lies beyond it; otherwise the ray is here. */
static MW_INLINE mw_star_verdict star_leave(mw_star_walk *w, uint32_t e, mw_star_policy P)
{
    return star_beyond(w, e, P) ? star_cross(w, e, P) : MW_STAR_FOUND;
}

/* Leave through edge `first`, else through edge `second`; otherwise the ray is here. Many
 * interleaved walks hide the time of a second test, but not that of a mispredicted branch. */
static MW_INLINE mw_star_verdict star_leave_either(mw_star_walk *w, uint32_t first, uint32_t second,
                                                   mw_star_policy P)
{
    if (!P.lanes) {
        if (star_beyond(w, first, P)) return star_cross(w, first, P);
        return star_leave(w, second, P);
    }
    bool one = star_beyond(w, first, P), two = star_beyond(w, second, P);
    if (!(one | two)) return MW_STAR_FOUND;
    return star_cross(w, one ? first : second, P);
}

static MW_INLINE mw_star_verdict mw__star_drive(mw_star_walk *walk,
                                                mw_star_verdict (*step)(mw_star_walk *walk,
                                                                        mw_star_policy P),
                                                mw_star_policy P)
{
    mw_star_walk w = *walk; /* a local copy can stay in registers */
    mw_star_verdict verdict = MW_STAR_DRY;
    while (w.fuel) {
        w.fuel--;
        verdict = step(&w, P);
        if (verdict != MW_STAR_GO) break;
        verdict = MW_STAR_DRY;
    }
    *walk = w;
    return verdict;
}

/* Many interleaved walks: while one waits for memory, the others continue. After a step the cache
 * line of the new facet is prefetched. After the last step the vertices are prefetched, which the
 * conclusion reads one lap later. */
static MW_INLINE void
mw__star_drive_ring(mw_star_feed *feed, uint32_t lane_count,
                    mw_star_verdict (*step)(mw_star_walk *walk, mw_star_policy P), mw_star_policy P)
{
    mw_star_walk lane[MW_STAR_LANES];
    mw_star_verdict verdict[MW_STAR_LANES];
    uint32_t name[MW_STAR_LANES], alive = 0;
    for (uint32_t i = 0; i < lane_count; i++)
        if (feed->deliver(feed, i, &lane[alive], MW_STAR_GO)) {
            verdict[alive] = MW_STAR_GO;
            name[alive++] = i;
        }
    for (uint32_t i = 0; alive; i = i + 1 < alive ? i + 1 : 0) {
        mw_star_walk *w = &lane[i];
        if (verdict[i] != MW_STAR_GO) {
            if (feed->deliver(feed, name[i], w, verdict[i])) {
                verdict[i] = MW_STAR_GO;
                __builtin_prefetch(&w->facet[w->t]);
            } else {
                alive--;
                lane[i] = lane[alive];
                name[i] = name[alive];
                verdict[i] = verdict[alive];
            }
            continue;
        }
        verdict[i] = MW_LIKELY(w->fuel > 0) ? step(w, P) : MW_STAR_DRY;
        w->fuel--;
        const mw_star_facet *facet = &w->facet[w->t];
        __builtin_prefetch(facet);
        if (verdict[i] == MW_STAR_GO) continue;
        for (uint32_t k = 0; k < 3; k++) __builtin_prefetch(star_vertex(w, facet->v[k]));
    }
}

/* Makes the kernels of a walk from star_NAME_step, with literal policies. */
#define MW_STAR_STAMP(name)                                                                        \
    static mw_star_verdict star_##name##_run(mw_star_walk *walk)                                   \
    {                                                                                              \
        return mw__star_drive(walk, star_##name##_step, (mw_star_policy){false, false});           \
    }                                                                                              \
    static mw_star_verdict star_##name##_run_count(mw_star_walk *walk)                             \
    {                                                                                              \
        return mw__star_drive(walk, star_##name##_step, (mw_star_policy){true, false});            \
    }                                                                                              \
    static void star_##name##_ring(mw_star_feed *feed, uint32_t lane_count)                        \
    {                                                                                              \
        mw__star_drive_ring(feed, lane_count, star_##name##_step, (mw_star_policy){false, true});  \
    }                                                                                              \
    static mw_star_verdict star_##name##_step_count(mw_star_walk *walk)                            \
    {                                                                                              \
        return star_##name##_step(walk, (mw_star_policy){true, false});                            \
    }                                                                                              \
    const mw_star_kernels mw__star_##name = {{star_##name##_run, star_##name##_run_count},         \
                                             star_##name##_ring,                                   \
                                             star_##name##_step_count};

#endif
