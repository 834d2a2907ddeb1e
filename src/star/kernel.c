/* kernel.c - does a centre lie in the kernel of a closed surface [thesis App. F, sec. 1]? */
#include "star/kernel.h"

#include "mesh/place.h"

#include <stdlib.h>

/* What is known of each facet on the way. */
enum { VOID = 0, BACK = 1, LEVEL = 2, FRONT = 3 };

typedef struct mw_survey {
    mw_star *star;
    mw_defects *defects;
    uint8_t *faces;  /* as the user gave it, the centre lies in front of the facet, in its plane, or behind it */
    int8_t *turned;  /* 1: to agree with the first facet of its piece it is to be turned; 0: not; -1: not known */
    uint32_t *queue; /* facets of one piece */
} mw_survey;

static const double *corner(const mw_star *star, const mw_triangle *t, uint32_t k)
{
    return mw__surface_point(star->surface, t->v[k]);
}

static bool add(mw_survey *s, mw_defect_kind kind, uint32_t t, uint32_t other, uint32_t edge)
{
    mw_defect defect = mw__defect(kind, t);
    defect.other = other;
    if (edge < 3) defect.edge = (uint8_t)edge;
    return mw__defects_add(s->defects, defect);
}

/* --- facet by facet ----------------------------------------------------------------------------------------------- */

/* A facet that is linked to nothing is void only if two of its corners are at one place; else its edges are open. */
static bool vanishes(const mw_star *star, const mw_triangle *t)
{
    const uint32_t *place = star->surface->place;
    uint32_t a = mw__place_of(place, t->v[0]), b = mw__place_of(place, t->v[1]), c = mw__place_of(place, t->v[2]);
    return a == b || b == c || c == a;
}

static uint8_t face(const mw_star *star, const mw_triangle *t)
{
    if (vanishes(star, t)) return VOID;
    double side = mw__orient3d(corner(star, t, 0), corner(star, t, 1), corner(star, t, 2), star->centre);
    return side < 0   ? FRONT
           : side > 0 ? BACK
                      : LEVEL; /* orient3d > 0: the centre is where they turn counter-clockwise */
}

/* Of a welded surface, too: vertices that were made one, but have been moved apart since, leave a gap. */
static bool look_at_corners(mw_survey *s, uint32_t i)
{
    const mw_star *star = s->star;
    for (uint32_t k = 0; k < 3; k++) {
        const double *p = corner(star, &star->tri[i], k),
                     *place = mw__surface_point(star->surface, mw__place_of(star->surface->place, star->tri[i].v[k]));
        if (!mw__is_finite3(p)) {
            if (!add(s, MW_DEFECT_NOT_FINITE, i, MW_NONE, 3)) return false;
            s->defects->list[s->defects->count - 1].vertex = star->tri[i].v[k];
            return true;
        }
        if (p[0] != place[0] || p[1] != place[1] || p[2] != place[2]) return add(s, MW_DEFECT_OPEN_EDGE, i, MW_NONE, k);
    }
    return true;
}

static bool look_at_facets(mw_survey *s)
{
    mw_star *star = s->star;
    star->area_count = 0;
    for (uint32_t i = 0; i < star->tri_count; i++) {
        const mw_triangle *t = &star->tri[i];
        if (!look_at_corners(s, i)) return false;
        s->faces[i] = face(star, t);
        star->area_count += s->faces[i] == FRONT || s->faces[i] == BACK;
        if (s->faces[i] == LEVEL && !mw__collinear3(corner(star, t, 0), corner(star, t, 1), corner(star, t, 2)) &&
            !add(s, MW_DEFECT_THROUGH_CENTRE, i, MW_NONE, 3))
            return false;
    }
    return true;
}

static bool look_at_edges(mw_survey *s)
{
    for (uint32_t i = 0; i < s->star->tri_count; i++)
        for (uint32_t k = 0; k < 3; k++)
            if (s->faces[i] != VOID && s->star->tri[i].link[k] == MW_NONE &&
                !add(s, MW_DEFECT_OPEN_EDGE, i, MW_NONE, k))
                return false;
    return true;
}

/* --- piece by piece ----------------------------------------------------------------------------------------------- */

/* Collect the piece of facet `first` into the queue, and how its facets are to be turned to agree with it. An edge
 * whose two facets cannot agree is a defect. */
static bool collect(mw_survey *s, uint32_t first, uint32_t *count)
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
            int8_t turned = (int8_t)(s->turned[t] ^ !mw__surface_agrees(star->surface, t, k));
            if (s->turned[other] < 0) {
                s->turned[other] = turned;
                s->queue[end++] = other;
            } else if (s->turned[other] != turned && t < other && !add(s, MW_DEFECT_CLASHING, t, other, k)) {
                return false;
            }
        }
    }
    *count = end;
    return true;
}

/* Once the facets of a piece agree, does the centre lie behind facet t as it is? */
static bool is_front(const mw_survey *s, uint32_t t)
{
    return (s->faces[t] == FRONT) != s->turned[t];
}

/* A facet that turns the other way than most of its piece, with a neighbour that does not where there is one. */
static bool add_turned(mw_survey *s, uint32_t t, bool fronts)
{
    for (uint32_t k = 0; k < 3; k++) {
        if (s->star->tri[t].link[k] == MW_NONE) continue;
        uint32_t other = mw__link_triangle(s->star->tri[t].link[k]);
        if (s->faces[other] != LEVEL && is_front(s, other) == fronts) return add(s, MW_DEFECT_BACK_FACING, t, other, k);
    }
    return add(s, MW_DEFECT_BACK_FACING, t, MW_NONE, 3);
}

/* The piece's facets are in the queue. Afterwards turned[] is what makes their fronts face outwards. */
static bool judge(mw_survey *s, uint32_t count)
{
    uint32_t fronts = 0, backs = 0;
    for (uint32_t i = 0; i < count; i++) {
        uint32_t t = s->queue[i];
        if (s->faces[t] == LEVEL) continue;
        if (is_front(s, t))
            fronts++;
        else
            backs++;
    }
    bool outwards = fronts >= backs;
    for (uint32_t i = 0; i < count; i++) {
        uint32_t t = s->queue[i];
        if (s->faces[t] != LEVEL && is_front(s, t) != outwards && !add_turned(s, t, outwards)) return false;
    }
    for (uint32_t i = 0; i < count; i++) s->turned[s->queue[i]] ^= !outwards;
    return true;
}

static bool look_at_pieces(mw_survey *s)
{
    for (uint32_t i = 0; i < s->star->tri_count; i++) {
        uint32_t count;
        if (s->faces[i] == VOID || s->turned[i] >= 0) continue;
        if (!collect(s, i, &count) || !judge(s, count)) return false;
    }
    return true;
}

/* --- orientation -------------------------------------------------------------------------------------------------- */

static void turn_facet(mw_triangle *t)
{
    uint32_t v = t->v[1], link = t->link[0];
    t->v[1] = t->v[2];
    t->v[2] = v;
    t->link[0] = t->link[2];
    t->link[2] = link;
}

/* Exchanging vertices 1 and 2 of a facet exchanges its edges 0 and 2, here and in the links of its neighbours. */
static void orient(mw_survey *s)
{
    mw_star *star = s->star;
    for (uint32_t i = 0; i < star->tri_count; i++)
        for (uint32_t k = 0; k < 3; k++) {
            uint32_t link = star->tri[i].link[k];
            if (link == MW_NONE || s->turned[mw__link_triangle(link)] <= 0) continue;
            star->tri[i].link[k] = mw__link(mw__link_triangle(link), 2 - mw__link_edge(link));
        }
    for (uint32_t i = 0; i < star->tri_count; i++)
        if (s->turned[i] > 0) turn_facet(&star->tri[i]);
}

/* --- one ray ------------------------------------------------------------------------------------------------------ */

/* Sign of coordinate k of (a - c) x (b - c). */
static double normal(const mw_star *star, const double a[3], const double b[3], int k)
{
    const double *c = star->centre;
    int i = (k + 1) % 3, j = (k + 2) % 3;
    return mw__orient2d((mw_point){c[i], c[j]}, (mw_point){a[i], a[j]}, (mw_point){b[i], b[j]});
}

/* Does the ray from the centre in direction (1, e, e^2), for all small e > 0, lie to the left of the edge ab? It
 * lies on the circle of no edge: some coordinate of a normal is not 0. */
static bool ray_is_left(const mw_star *star, const double a[3], const double b[3])
{
    for (int k = 0; k < 3; k++) {
        double side = normal(star, a, b, k);
        if (side != 0) return side > 0;
    }
    return false;
}

/* Facets are oriented. The ray meets at least one, if there is one. */
static bool look_along_ray(mw_survey *s)
{
    const mw_star *star = s->star;
    uint32_t first = MW_NONE;
    for (uint32_t i = 0; i < star->tri_count; i++) {
        const mw_triangle *t = &star->tri[i];
        if (s->faces[i] == VOID || s->faces[i] == LEVEL) continue;
        bool meets = true;
        for (uint32_t k = 0; k < 3 && meets; k++) meets = ray_is_left(star, corner(star, t, k), corner(star, t, k + 1));
        if (meets && first != MW_NONE && !add(s, MW_DEFECT_COVERED, first, i, 3)) return false;
        if (meets && first == MW_NONE) first = i;
    }
    return true;
}

static bool survey(mw_survey *s)
{
    size_t before = s->defects->count;
    if (!look_at_facets(s) || !look_at_edges(s) || !look_at_pieces(s)) return false;
    if (s->defects->count > before) return true;
    orient(s);
    return look_along_ray(s);
}

bool mw__star_kernel(mw_star *star, mw_defects *defects)
{
    uint32_t n = star->tri_count;
    mw_survey s = {star, defects, mw__alloc(n, 1), mw__alloc(n, 1), mw__alloc(n, sizeof *s.queue)};
    bool done = s.faces && s.turned && s.queue;
    if (done) {
        for (uint32_t i = 0; i < n; i++) s.turned[i] = -1;
        done = survey(&s);
    }
    free(s.faces);
    free(s.turned);
    free(s.queue);
    return done;
}
