/* star_borrowed_walk.c - the remembering stochastic walk on the records of the surface. */
#include "base/random.h"
#include "star/borrow/star_borrowed.h"

int mw__star_borrowed_facing(const mw_star *star, uint32_t t)
{
    const mw_surface *surface = star->surface;
    if (MW_UNLIKELY(star->unchecked) && !mw__corners_finite(surface, t)) return 0;
    double side = mw__orient3d(mw__surface_corner(surface, t, 0), mw__surface_corner(surface, t, 1),
                               mw__surface_corner(surface, t, 2), star->centre);
    return (side < 0) - (side > 0);
}

double mw__star_borrowed_side(const mw_star_borrowed_walk *w, uint32_t t, uint32_t k)
{
    const mw_surface *surface = w->star->surface;
    const double *a = mw__surface_corner(surface, t, k), *b = mw__surface_corner(surface, t, k + 1);
    if (MW_UNLIKELY(w->star->unchecked) && !(mw__is_finite3(a) && mw__is_finite3(b))) return 0;
    return mw__star_orient(a, b, w->q, w->d, w->c);
}

static void borrowed_star_visit(mw_star_borrowed_walk *w)
{
    w->work.visited++;
    w->work.triangles[MW_STAR_STAGE_WALK]++;
    if (w->trace && w->trace->count++ < w->trace->capacity)
        w->trace->facet[w->trace->count - 1] = w->t;
}

bool mw__star_borrowed_enter(mw_star_borrowed_walk *w, uint32_t t)
{
    int facing = mw__star_borrowed_facing(w->star, t);
    if (facing == 0) return false;
    w->t = t;
    w->e = MW_STAR_NO_EDGE;
    w->turned = facing < 0;
    borrowed_star_visit(w);
    return true;
}

/* Does the ray lie strictly beyond edge k of the present facet? */
static MW_INLINE bool borrowed_star_beyond(mw_star_borrowed_walk *w, uint32_t k)
{
    double side = mw__star_borrowed_side(w, w->t, k);
    w->work.orient[MW_STAR_STAGE_WALK]++;
    return w->turned ? side > 0 : side < 0;
}

/* Go over edge k. False: nothing is there. */
static MW_INLINE bool borrowed_star_cross(mw_star_borrowed_walk *w, uint32_t k)
{
    const mw_surface *surface = w->star->surface;
    uint32_t link = surface->tri[w->t].link[k];
    if (MW_UNLIKELY(link == MW_NONE)) return false;
    w->turned ^= !mw__surface_orientations_agree(surface, w->t, k);
    w->t = mw__link_triangle(link);
    w->e = mw__link_edge(link);
    borrowed_star_visit(w);
    return true;
}

/* The edge by which to leave, by a coin among those that the ray lies beyond; MW_STAR_NO_EDGE: the
 * ray is here. */
static MW_INLINE uint32_t borrowed_star_way_out(mw_star_borrowed_walk *w)
{
    uint64_t coin = mw__toss(&w->random);
    if (w->e == MW_STAR_NO_EDGE) {
        w->e = (uint32_t)(coin * 3 >> 32);
        if (borrowed_star_beyond(w, w->e)) return w->e;
    }
    uint32_t first = coin & 1 ? mw__next(w->e) : mw__prev(w->e), second = 3 - w->e - first;
    if (borrowed_star_beyond(w, first)) return first;
    return borrowed_star_beyond(w, second) ? second : MW_STAR_NO_EDGE;
}

bool mw__star_borrowed_run(mw_star_borrowed_walk *w)
{
    for (; w->fuel > 0; w->fuel--) {
        uint32_t k = borrowed_star_way_out(w);
        if (k == MW_STAR_NO_EDGE) return true;
        if (!borrowed_star_cross(w, k)) return false;
    }
    return false;
}
