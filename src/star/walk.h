/* walk.h - the vocabulary of the walks on star-shaped polyhedra, and what drives a step to its end. Private. */
#ifndef MW_SRC_STAR_WALK_H
#define MW_SRC_STAR_WALK_H

#include "star/star.h"

/* Always a literal where a kernel is stamped; the compiler deletes what is off. */
typedef struct mw_star_policy {
    bool count;
} mw_star_policy;

/* det(a - c, b - c, q - c), with d = q - c as rounded: > 0 where q lies to the left of the great circle from a to b,
 * seen from outside. Sign-exact: orient3d(a, b, q, c) with the sign of its convention turned, and one row known. */
static MW_INLINE double mw__star_turn(const double a[3], const double b[3], const double q[3], const double d[3],
                                      const double c[3])
{
    double ax = a[0] - c[0], ay = a[1] - c[1], az = a[2] - c[2];
    double bx = b[0] - c[0], by = b[1] - c[1], bz = b[2] - c[2];
    double bd = bx * d[1], db = d[0] * by, da = d[0] * ay, ad = ax * d[1], ab = ax * by, ba = bx * ay;
    double det = az * (bd - db) + bz * (da - ad) + d[2] * (ab - ba);
    double permanent =
        fabs(az) * (fabs(bd) + fabs(db)) + fabs(bz) * (fabs(da) + fabs(ad)) + fabs(d[2]) * (fabs(ab) + fabs(ba));
    bool small = fabs(az) + fabs(bz) + fabs(d[2]) < MW_ORIENT3D_HEIGHTS;
    if (MW_LIKELY(small && fabs(det) > MW_ORIENT3D_ERROR * permanent + MW_UNDERFLOW_ERROR)) return det;
    return -mw__orient3d_exact(a, b, q, c);
}

static MW_INLINE const double *star_vertex(const mw_star_walk *w, uint32_t v)
{
    return w->point + 3 * (size_t)v;
}

/* Corner k of the current facet, 0 to 3; and the one off edge e. */
static MW_INLINE const double *star_corner(const mw_star_walk *w, uint32_t k)
{
    return star_vertex(w, w->tri[w->t].v[k]);
}
static MW_INLINE const double *star_apex(const mw_star_walk *w, uint32_t e)
{
    return star_corner(w, mw__prev(e));
}

/* The side of q against the great circle from a to b, counted. */
static MW_INLINE double turn(mw_star_walk *w, const double a[3], const double b[3], mw_star_policy P)
{
    if (P.count) w->work->orient[w->stage]++;
    return mw__star_turn(a, b, w->q, w->d, w->c);
}

/* Of edge e: < 0 where the ray lies strictly beyond it. */
static MW_INLINE double edge_turn(mw_star_walk *w, uint32_t e, mw_star_policy P)
{
    return turn(w, star_corner(w, e), star_corner(w, e + 1), P);
}

/* Does the ray lie strictly beyond edge e, so that its great circle parts it from the facet? */
static MW_INLINE bool beyond(mw_star_walk *w, uint32_t e, mw_star_policy P)
{
    return edge_turn(w, e, P) < 0;
}

/* Go to the facet across edge e: there is one. Reads nothing of it. */
static MW_INLINE mw_star_verdict cross(mw_star_walk *w, uint32_t e, mw_star_policy P)
{
    uint32_t link = w->tri[w->t].link[e];
    w->t = mw__link_triangle(link);
    w->e = mw__link_edge(link);
    if (P.count) {
        w->work->visited++;
        w->work->triangles[w->stage]++;
    }
    return MW_STAR_GO;
}

/* Leave through edge e if the ray lies beyond it; otherwise it is here. */
static MW_INLINE mw_star_verdict leave(mw_star_walk *w, uint32_t e, mw_star_policy P)
{
    return beyond(w, e, P) ? cross(w, e, P) : MW_STAR_FOUND;
}

/* Leave through `first`, or else `second`; otherwise the ray is here. */
static MW_INLINE mw_star_verdict leave_either(mw_star_walk *w, uint32_t first, uint32_t second, mw_star_policy P)
{
    if (beyond(w, first, P)) return cross(w, first, P);
    return leave(w, second, P);
}

static MW_INLINE mw_star_verdict mw__star_drive(mw_star_walk *walk,
                                                mw_star_verdict (*step)(mw_star_walk *walk, mw_star_policy P),
                                                mw_star_policy P)
{
    mw_star_walk w = *walk; /* a local copy can live in registers */
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

/* The kernels of a walk from NAME_step, with literal policies. */
#define MW_STAR_STAMP(name)                                                                                            \
    static mw_star_verdict name##_run(mw_star_walk *walk)                                                              \
    {                                                                                                                  \
        return mw__star_drive(walk, name##_step, (mw_star_policy){false});                                             \
    }                                                                                                                  \
    static mw_star_verdict name##_run_count(mw_star_walk *walk)                                                        \
    {                                                                                                                  \
        return mw__star_drive(walk, name##_step, (mw_star_policy){true});                                              \
    }                                                                                                                  \
    static mw_star_verdict name##_step_count(mw_star_walk *walk)                                                       \
    {                                                                                                                  \
        return name##_step(walk, (mw_star_policy){true});                                                              \
    }                                                                                                                  \
    const mw_star_kernels mw__star_##name = {{name##_run, name##_run_count}, name##_step_count};

#endif
