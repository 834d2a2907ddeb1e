/* kernel_check.c - decides whether a centre lies in the kernel of a closed surface [thesis App. F,
 * sec. 1]. */
#include "star/prepare/kernel_check.h"

#include "topology/coincident.h"

#include <stdatomic.h>
#include <stdlib.h>

/* The kinds of facets. */
enum { VOID = 0, BACK = 1, LEVEL = 2, FRONT = 3 };
/* Marks beside the kind, until they have been looked at: a facet that has a defect by itself; one
 * that the ray meets. */
enum { SUSPECT = 4, MET = 8 };

typedef struct kernel_check {
    mw_star *star;
    mw_defects *defects;
    /* The kind of each facet as the user gave it: is the centre in front of it, in its plane, or
     * behind it? */
    uint8_t *faces;
    /* 1: must be reversed to agree with the first facet of its component; 0: not; -1: unknown. */
    int8_t *turned;
    uint32_t *queue; /* facets of one component */
    mw_job *job;
} kernel_check;

static bool kernel_defect_add(kernel_check *s, mw_defect_kind kind, uint32_t t, uint32_t other,
                              uint32_t edge)
{
    mw_defect defect = mw__defect(kind, t);
    defect.other = other;
    if (edge < 3) defect.edge = (uint8_t)edge;
    return mw__defects_add(s->defects, defect);
}

/* --- facet by facet --- */

/* A facet without links is void only if two of its corners coincide; else its edges are open. */
static bool facet_vanishes(const mw_star *star, const mw_triangle *t)
{
    const uint32_t *coincident = star->surface->coincident;
    uint32_t a = mw__representative(coincident, t->v[0]),
             b = mw__representative(coincident, t->v[1]),
             c = mw__representative(coincident, t->v[2]);
    return a == b || b == c || c == a;
}

static uint8_t facet_facing(const mw_star *star, const mw_triangle *t)
{
    if (facet_vanishes(star, t)) return VOID;
    double side =
        mw__orient3d(mw__star_corner_point(star, t->v, 0), mw__star_corner_point(star, t->v, 1),
                     mw__star_corner_point(star, t->v, 2), star->centre);
    return side < 0   ? FRONT
           : side > 0 ? BACK
                      /* orient3d > 0: seen from the centre, the facet is counter-clockwise. */
                      : LEVEL;
}

/* Is a vertex of a welded surface where those are with which it is one? Else they leave a gap. */
static bool vertex_is_together(const mw_star *star, uint32_t v)
{
    const double *p = mw__surface_point(star->surface, v),
                 *at = mw__surface_point(star->surface,
                                         mw__representative(star->surface->coincident, v));
    return p[0] == at[0] && p[1] == at[1] && p[2] == at[2];
}

bool mw__star_corners_hold(const mw_star *star, const uint32_t v[3])
{
    for (uint32_t k = 0; k < 3; k++)
        if (!mw__is_finite3(mw__star_corner_point(star, v, k)) || !vertex_is_together(star, v[k]))
            return false;
    return true;
}

/* Add the first corner that is not finite, or not together. */
static bool kernel_look_at_corners(kernel_check *s, uint32_t i)
{
    const uint32_t *v = s->star->tri[i].v;
    for (uint32_t k = 0; k < 3; k++) {
        if (!mw__is_finite3(mw__star_corner_point(s->star, v, k))) {
            if (!kernel_defect_add(s, MW_DEFECT_NOT_FINITE, i, MW_NONE, 3)) return false;
            s->defects->list[s->defects->count - 1].vertex = v[k];
            return true;
        }
        if (!vertex_is_together(s->star, v[k]))
            return kernel_defect_add(s, MW_DEFECT_OPEN_EDGE, i, MW_NONE, k);
    }
    return true;
}

/* Does a facet in a plane with the centre have an area? */
static bool facet_is_through_centre(const kernel_check *s, uint32_t i)
{
    const mw_star *star = s->star;
    const uint32_t *v = star->tri[i].v;
    return s->faces[i] == LEVEL &&
           !mw__collinear3(mw__star_corner_point(star, v, 0), mw__star_corner_point(star, v, 1),
                           mw__star_corner_point(star, v, 2));
}

/* By any thread. */
static void kernel_face(void *work, uint64_t from, uint64_t to)
{
    kernel_check *s = work;
    for (uint32_t i = (uint32_t)from; i < to; i++) {
        s->faces[i] = facet_facing(s->star, &s->star->tri[i]);
        if (!mw__star_corners_hold(s->star, s->star->tri[i].v) || facet_is_through_centre(s, i))
            s->faces[i] |= SUSPECT;
    }
}

static bool kernel_look_at_facets(kernel_check *s)
{
    mw_star *star = s->star;
    star->area_count = 0;
    mw__job_stage(s->job, "looking at facets", 0.5);
    if (!mw__job_ranges(s->job, star->tri_count, kernel_face, s)) return false;
    for (uint32_t i = 0; i < star->tri_count; i++) {
        bool suspect = (s->faces[i] & SUSPECT) != 0;
        s->faces[i] &= (uint8_t)~SUSPECT;
        star->area_count += s->faces[i] == FRONT || s->faces[i] == BACK;
        if (!suspect) continue;
        if (!kernel_look_at_corners(s, i)) return false;
        if (facet_is_through_centre(s, i) &&
            !kernel_defect_add(s, MW_DEFECT_THROUGH_CENTRE, i, MW_NONE, 3))
            return false;
    }
    return true;
}

static bool kernel_look_at_edges(kernel_check *s)
{
    for (uint32_t i = 0; i < s->star->tri_count; i++)
        for (uint32_t k = 0; k < 3; k++)
            if (s->faces[i] != VOID && s->star->tri[i].link[k] == MW_NONE &&
                !kernel_defect_add(s, MW_DEFECT_OPEN_EDGE, i, MW_NONE, k))
                return false;
    return true;
}

/* --- component by component --- */

/* Collect the component of facet `first` in the queue, and find which of its facets must be
 * reversed to agree with it. An edge whose two facets cannot agree is a defect. */
static bool component_collect(kernel_check *s, uint32_t first, uint32_t *count)
{
    const mw_star *star = s->star;
    uint32_t end = 0;
    s->turned[first] = 0;
    s->queue[end++] = first;
    for (uint32_t i = 0; i < end; i++) {
        uint32_t t = s->queue[i];
        for (uint32_t k = 0; k < 3; k++) {
            if (star->tri[t].link[k] == MW_NONE) continue;
            uint32_t other = mw__link_triangle(star->tri[t].link[k]);
            int8_t turned =
                (int8_t)(s->turned[t] ^ !mw__surface_orientations_agree(star->surface, t, k));
            if (s->turned[other] < 0) {
                s->turned[other] = turned;
                s->queue[end++] = other;
            } else if (s->turned[other] != turned && t < other &&
                       !kernel_defect_add(s, MW_DEFECT_CLASHING, t, other, k)) {
                return false;
            }
        }
    }
    *count = end;
    return true;
}

/* Once the facets of a component agree, does the centre lie behind facet t? */
static bool facet_is_front(const kernel_check *s, uint32_t t)
{
    return (s->faces[t] == FRONT) != s->turned[t];
}

/* Add a facet that is oriented unlike most of its component, with a neighbour that is not, if there
 * is one. */
static bool kernel_defect_add_back_facing(kernel_check *s, uint32_t t, bool fronts)
{
    for (uint32_t k = 0; k < 3; k++) {
        if (s->star->tri[t].link[k] == MW_NONE) continue;
        uint32_t other = mw__link_triangle(s->star->tri[t].link[k]);
        if (s->faces[other] != LEVEL && facet_is_front(s, other) == fronts)
            return kernel_defect_add(s, MW_DEFECT_BACK_FACING, t, other, k);
    }
    return kernel_defect_add(s, MW_DEFECT_BACK_FACING, t, MW_NONE, 3);
}

/* Judge the component in the queue. Afterwards, reversing the facets with turned[] makes all fronts
 * face outwards. */
static bool component_judge(kernel_check *s, uint32_t count)
{
    uint32_t fronts = 0, backs = 0;
    for (uint32_t i = 0; i < count; i++) {
        uint32_t t = s->queue[i];
        if (s->faces[t] == LEVEL) continue;
        if (facet_is_front(s, t))
            fronts++;
        else
            backs++;
    }
    bool outwards = fronts >= backs;
    for (uint32_t i = 0; i < count; i++) {
        uint32_t t = s->queue[i];
        if (s->faces[t] != LEVEL && facet_is_front(s, t) != outwards &&
            !kernel_defect_add_back_facing(s, t, outwards))
            return false;
    }
    for (uint32_t i = 0; i < count; i++) s->turned[s->queue[i]] ^= !outwards;
    return true;
}

static bool kernel_look_at_components(kernel_check *s)
{
    mw__job_stage(s->job, "looking at components", 0.3);
    for (uint32_t i = 0; i < s->star->tri_count; i++) {
        uint32_t count;
        if (!mw__job_step(s->job, i, s->star->tri_count)) return false;
        if (s->faces[i] == VOID || s->turned[i] >= 0) continue;
        if (!component_collect(s, i, &count) || !component_judge(s, count)) return false;
    }
    return true;
}

/* --- orientation --- */

static void facet_turn(mw_triangle *t)
{
    uint32_t v = t->v[1], link = t->link[0];
    t->v[1] = t->v[2];
    t->v[2] = v;
    t->link[0] = t->link[2];
    t->link[2] = link;
}

/* Exchanging vertices 1 and 2 of a facet exchanges its edges 0 and 2, in the facet and in the links
 * of its neighbours. */
void mw__facets_turn(mw_star *star, const int8_t *turned)
{
    for (uint32_t i = 0; i < star->tri_count; i++)
        for (uint32_t k = 0; k < 3; k++) {
            uint32_t link = star->tri[i].link[k];
            if (link == MW_NONE || turned[mw__link_triangle(link)] <= 0) continue;
            star->tri[i].link[k] = mw__link(mw__link_triangle(link), 2 - mw__link_edge(link));
        }
    for (uint32_t i = 0; i < star->tri_count; i++)
        if (turned[i] > 0) facet_turn(&star->tri[i]);
}

/* --- one ray --- */

/* The sign of coordinate k of (a - c) x (b - c). */
static double normal_sign(const mw_star *star, const double a[3], const double b[3], int k)
{
    const double *c = star->centre;
    int i = (k + 1) % 3, j = (k + 2) % 3;
    return mw__orient2d((mw_point){c[i], c[j]}, (mw_point){a[i], a[j]}, (mw_point){b[i], b[j]});
}

/* Does the ray from the centre in direction (1, e, e^2), for all small e > 0, lie to the left of
 * the edge ab? The ray lies on the great circle of no edge, as some coordinate of a normal is not
 * 0. */
static bool ray_is_left(const mw_star *star, const double a[3], const double b[3])
{
    for (int k = 0; k < 3; k++) {
        double side = normal_sign(star, a, b, k);
        if (side != 0) return side > 0;
    }
    return false;
}

bool mw__star_ray_meets(const mw_star *star, const uint32_t v[3])
{
    for (uint32_t k = 0; k < 3; k++)
        if (!ray_is_left(star, mw__star_corner_point(star, v, k),
                         mw__star_corner_point(star, v, mw__next(k))))
            return false;
    return true;
}

/* Mark the facets that the ray meets. By any thread. */
static void kernel_meet(void *work, uint64_t from, uint64_t to)
{
    kernel_check *s = work;
    for (uint64_t i = from; i < to; i++)
        if (s->faces[i] != VOID && s->faces[i] != LEVEL &&
            mw__star_ray_meets(s->star, s->star->tri[i].v))
            s->faces[i] |= MET;
}

/* Count the facets that the ray meets: at least one, if there are facets. Facets are oriented. */
static bool kernel_look_along_ray(kernel_check *s)
{
    uint32_t first = MW_NONE;
    mw__job_stage(s->job, "looking along a ray", 0.2);
    if (!mw__job_ranges(s->job, s->star->tri_count, kernel_meet, s)) return false;
    for (uint32_t i = 0; i < s->star->tri_count; i++) {
        if (!(s->faces[i] & MET)) continue;
        if (first != MW_NONE && !kernel_defect_add(s, MW_DEFECT_COVERED, first, i, 3)) return false;
        if (first == MW_NONE) first = i;
    }
    return true;
}

static bool kernel_check_run(kernel_check *s)
{
    size_t before = s->defects->count;
    if (!kernel_look_at_facets(s) || !kernel_look_at_edges(s) || !kernel_look_at_components(s))
        return false;
    if (s->defects->count > before) return true;
    mw__facets_turn(s->star, s->turned);
    return kernel_look_along_ray(s);
}

/* --- without memory --- */

/* Where each facet that does not vanish faces the centre or turns its back, it can be turned so
 * that the centre lies behind it; and neighbours then agree if they agree now or face it unlike. So
 * each facet can be asked by itself, in any order. */
typedef struct kernel_glance {
    const mw_star *star;
    atomic_bool unsure;
    atomic_uint_fast32_t areas, met;
} kernel_glance;

/* Does the neighbour at edge k, once both are turned outwards, agree? */
static bool glance_edge_agrees(const mw_star *star, uint32_t t, uint32_t k, uint8_t facing)
{
    const mw_surface *surface = star->surface;
    uint32_t link = surface->tri[t].link[k];
    if (link == MW_NONE) return false;
    if (mw__link_triangle(link) < t) return true; /* it asks */
    uint8_t other = facet_facing(star, &surface->tri[mw__link_triangle(link)]);
    return (other == facing) == mw__surface_orientations_agree(surface, t, k);
}

static bool glance_ray_meets(const mw_star *star, const uint32_t v[3], uint8_t facing)
{
    const uint32_t turned[3] = {v[0], v[2], v[1]};
    return mw__star_ray_meets(star, facing == FRONT ? v : turned);
}

/* By any thread. */
static void glance_range(void *work, uint64_t from, uint64_t to)
{
    kernel_glance *g = work;
    uint32_t areas = 0, met = 0;
    for (uint32_t t = (uint32_t)from; t < to; t++) {
        const mw_triangle *facet = &g->star->surface->tri[t];
        uint8_t facing = facet_facing(g->star, facet);
        bool sure = facing != LEVEL && mw__star_corners_hold(g->star, facet->v);
        for (uint32_t k = 0; k < 3 && sure && facing != VOID; k++)
            sure = glance_edge_agrees(g->star, t, k, facing);
        if (!sure) {
            atomic_store_explicit(&g->unsure, true, memory_order_relaxed);
            return;
        }
        if (facing == VOID) continue;
        areas++;
        met += glance_ray_meets(g->star, facet->v, facing);
    }
    atomic_fetch_add_explicit(&g->areas, areas, memory_order_relaxed);
    atomic_fetch_add_explicit(&g->met, met, memory_order_relaxed);
}

bool mw__star_kernel_holds(mw_star *star, mw_job *job)
{
    kernel_glance g = {.star = star};
    mw__job_stage(job, "looking at facets", 1);
    if (!mw__job_ranges(job, star->tri_count, glance_range, &g)) return false;
    star->area_count = (uint32_t)g.areas;
    return !g.unsure && g.met == 1;
}

bool mw__star_kernel_check(mw_star *star, mw_job *job, mw_defects *defects)
{
    uint32_t n = star->tri_count;
    kernel_check s = {
        star, defects, mw__alloc(n, 1), mw__alloc(n, 1), mw__alloc(n, sizeof *s.queue), job};
    bool done = s.faces && s.turned && s.queue;
    if (done) {
        for (uint32_t i = 0; i < n; i++) s.turned[i] = -1;
        done = kernel_check_run(&s);
    }
    free(s.faces);
    free(s.turned);
    free(s.queue);
    return done;
}
