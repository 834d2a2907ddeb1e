/* cdt_keep.c - which triangles of a constrained triangulation are kept: those inside polygons, or
 * not reached from outside, and not in holes. */
#include "triangulate/constrained/cdt_keep.h"

#include "base/random.h"
#include "triangulate/constrained/cdt_spans.h"
#include "triangulate/constrained/polygon_ranks.h"

#include <inttypes.h>
#include <stdlib.h>

static uint32_t keep_subsegment_at(const mw_cdt *m, uint32_t half)
{
    return m->net.subsegment[3 * (size_t)mw__link_triangle(half) + mw__link_edge(half)];
}

/* --- polygons --- */

typedef struct parity {
    const mw_cdt *m;
    mw_subsegment_owners owners;
    mw_polygon_ranks ranks;
    uint8_t *odd; /* per polygon: has an odd number of its segments been crossed? */
    uint32_t odd_count;
} parity;

static void parity_release(parity *p)
{
    mw__subsegment_owners_release(&p->owners);
    mw__polygon_ranks_release(&p->ranks);
    free(p->odd);
}

static mw_status parity_prepare(parity *p, mw_error *error)
{
    mw_status status = mw__polygon_ranks_create(&p->ranks, p->m, error);
    if (status) return status;
    p->odd = mw__calloc((size_t)p->ranks.count + 1, sizeof *p->odd);
    return p->odd && mw__subsegment_owners_create(&p->owners, p->m) ? MW_OK
                                                                    : mw__fail_memory(error);
}

/* Cross a half-edge, either way. */
static void parity_cross(parity *p, uint32_t half)
{
    uint32_t subsegment = keep_subsegment_at(p->m, half);
    if (subsegment == MW_NONE) return;
    for (size_t i = p->owners.first[subsegment]; i < p->owners.first[subsegment + 1]; i++) {
        uint32_t rank = p->ranks.rank[p->owners.segment[i]];
        if (rank == MW_NONE) continue;
        p->odd[rank] ^= 1;
        p->odd_count += p->odd[rank] ? 1 : UINT32_MAX; /* less one */
    }
}

/* Half-edge of the hull, in the triangle inside. */
static uint32_t hull_first_half(const mw_cdt *m)
{
    uint32_t t = 0, k = 0;
    while (m->tri[t].link[k] != MW_NONE) {
        k = mw__next(k);
        t += k == 0;
    }
    return mw__link(t, k);
}

/* Go through all triangles depth first, from outside the hull, keeping the parities of where one
 * is. The way back is the way in: entry[t] is the edge by which triangle t was entered. */
static void parity_keep_odd(parity *p, uint8_t *entry)
{
    enum { UNSEEN = 3 };
    const mw_cdt *m = p->m;
    for (uint32_t t = 0; t < m->tri_count; t++) entry[t] = UNSEEN;
    uint32_t half = hull_first_half(m);
    parity_cross(p, half);
    for (;;) {
        uint32_t t = mw__link_triangle(half);
        if (entry[t] == UNSEEN) {
            entry[t] = (uint8_t)mw__link_edge(half);
            m->kept[t] = p->odd_count > 0;
        }
        half = mw__link(t, mw__next(mw__link_edge(half)));
        uint32_t beyond = m->tri[t].link[mw__link_edge(half)];
        bool back = entry[t] == mw__link_edge(half);
        if (back && beyond == MW_NONE)
            return; /* to where it began: the hull half-edge is the entry of one triangle only */
        if (!back && (beyond == MW_NONE || entry[mw__link_triangle(beyond)] != UNSEEN)) continue;
        parity_cross(p, half);
        half = beyond;
    }
}

static mw_status parity_keep_polygons(mw_cdt *m, mw_error *error)
{
    parity p = {.m = m};
    uint8_t *entry = mw__alloc(m->tri_count, sizeof *entry);
    mw_status status = entry ? parity_prepare(&p, error) : mw__fail_memory(error);
    if (status == MW_OK) parity_keep_odd(&p, entry);
    free(entry);
    parity_release(&p);
    return status;
}

/* --- floods --- */

typedef struct flood {
    const mw_cdt *m;
    uint32_t *stack; /* room for all triangles: each is put there once */
    uint32_t top;
    uint32_t left; /* triangles that are kept so far */
} flood;

static void flood_remove_triangle(flood *f, uint32_t t)
{
    if (!f->m->kept[t]) return;
    f->m->kept[t] = 0;
    f->left--;
    f->stack[f->top++] = t;
}

/* Remove all triangles that are connected to those on the stack without crossing a subsegment. */
static void flood_fill(flood *f)
{
    while (f->top > 0) {
        uint32_t t = f->stack[--f->top];
        for (uint32_t k = 0; k < 3; k++) {
            uint32_t link = f->m->tri[t].link[k];
            if (link != MW_NONE && keep_subsegment_at(f->m, mw__link(t, k)) == MW_NONE)
                flood_remove_triangle(f, mw__link_triangle(link));
        }
    }
}

static void flood_remove_outside(flood *f)
{
    for (uint32_t t = 0; t < f->m->tri_count; t++)
        for (uint32_t k = 0; k < 3; k++)
            if (f->m->tri[t].link[k] == MW_NONE &&
                keep_subsegment_at(f->m, mw__link(t, k)) == MW_NONE)
                flood_remove_triangle(f, t);
    flood_fill(f);
}

/* --- the points of holes --- */

static double half_side(const mw_cdt *m, uint32_t half, mw_point q)
{
    const mw_triangle *t = &m->tri[mw__link_triangle(half)];
    return mw__orient2d(m->point[t->v[mw__link_edge(half)]],
                        m->point[t->v[mw__link_edge(half) + 1]], q);
}

/* Walk from triangle *t to one that holds q; false if q is outside the hull. The edges are tried
 * from a random one on: the walk ends with probability 1 [Devillers, Pion, Teillaud 2002]. */
static bool hole_point_walk(const mw_cdt *m, mw_point q, uint64_t *random, uint32_t *t)
{
    for (;;) {
        uint32_t first = mw__random_below(random, 3), k = first;
        while (half_side(m, mw__link(*t, k), q) >= 0) {
            k = mw__next(k);
            if (k == first) return true;
        }
        if (m->tri[*t].link[k] == MW_NONE) return false;
        *t = mw__link_triangle(m->tri[*t].link[k]);
    }
}

/* Remove the triangles round the vertex that a half-edge leaves. */
static void flood_remove_round(flood *f, uint32_t first)
{
    const mw_triangle *tri = f->m->tri;
    uint32_t half = first;
    do {
        flood_remove_triangle(f, mw__link_triangle(half));
        half = tri[mw__link_triangle(half)].link[mw__prev(mw__link_edge(half))];
    } while (half != first && half != MW_NONE);
    if (half == first) return;
    half = first;
    while ((half = tri[mw__link_triangle(half)].link[mw__link_edge(half)]) != MW_NONE) {
        half = mw__half_next(half);
        flood_remove_triangle(f, mw__link_triangle(half));
    }
}

/* Remove all triangles that q touches, of which t is one. True if q is on a segment or a vertex. */
static bool flood_remove_touched(flood *f, uint32_t t, mw_point q)
{
    bool on[3], bounded = false;
    for (uint32_t k = 0; k < 3; k++) on[k] = half_side(f->m, mw__link(t, k), q) == 0;
    flood_remove_triangle(f, t);
    for (uint32_t k = 0; k < 3; k++) {
        uint32_t link = f->m->tri[t].link[k];
        if (on[k] && (on[mw__prev(k)] || keep_subsegment_at(f->m, mw__link(t, k)) != MW_NONE))
            bounded = true;
        if (on[k] && link != MW_NONE) flood_remove_triangle(f, mw__link_triangle(link));
        if (on[k] && on[mw__prev(k)]) flood_remove_round(f, mw__link(t, k));
    }
    return bounded;
}

/* Hole i removed the last triangles. */
static mw_status holes_fail_empty(const mw_cdt *m, size_t i, bool bounded, mw_error *error)
{
    const double *q = &m->given->hole_seeds[2 * i];
    return mw__fail(error, MW_ERROR_INPUT,
                    "nothing is left: the point of hole %zu (%.17g, %.17g) %s", i, q[0], q[1],
                    bounded ? "is on a segment or at a point, so all sides of it are removed"
                            : "reaches all that was left: no closed ring is round it alone");
}

static mw_status flood_remove_holes(flood *f, mw_constrain_report *report, mw_error *error)
{
    const mw_constraints *given = f->m->given;
    uint64_t random = 1;
    uint32_t t = 0;
    for (size_t i = 0; i < given->hole_seed_count; i++) {
        mw_point q = {given->hole_seeds[2 * i], given->hole_seeds[2 * i + 1]};
        const uint32_t before = f->left;
        bool bounded = false;
        if (hole_point_walk(f->m, q, &random, &t)) {
            bounded = flood_remove_touched(f, t, q);
            flood_fill(f);
        }
        if (f->left == before && report->idle_holes++ == 0) report->first_idle_hole = (uint32_t)i;
        if (f->left == 0) return holes_fail_empty(f->m, i, bounded, error);
    }
    return MW_OK;
}

/* --- all together --- */

static uint32_t keep_count(const mw_cdt *m)
{
    uint32_t count = 0;
    for (uint32_t t = 0; t < m->tri_count; t++) count += m->kept[t];
    return count;
}

/* Remove what is outside, and the holes. */
static mw_status flood_remove(flood *f, bool polygons, mw_constrain_report *report, mw_error *error)
{
    f->left = keep_count(f->m);
    if (!polygons) flood_remove_outside(f);
    if (f->left > 0) return flood_remove_holes(f, report, error);
    return mw__fail(error, MW_ERROR_INPUT,
                    "nothing is left: all %" PRIu32 " triangles are outside: %s", f->m->tri_count,
                    polygons ? "no polygon has an inside" : "no ring of segments is closed");
}

static bool constraints_have_polygon(const mw_constraints *given)
{
    for (size_t i = 0; given->polygon && i < given->segment_count; i++)
        if (given->polygon[i] != MW_NONE) return true;
    return false;
}

mw_status mw__cdt_keep_triangles(mw_cdt *m, mw_keep keep, mw_constrain_report *report,
                                 mw_error *error)
{
    bool polygons = constraints_have_polygon(m->given);
    if (keep == MW_KEEP_AUTO)
        keep = polygons || m->given->hole_seed_count ? MW_KEEP_INSIDE : MW_KEEP_HULL;
    m->kept = mw__alloc(m->tri_count, sizeof *m->kept);
    if (!m->kept) return mw__fail_memory(error);
    for (uint32_t t = 0; t < m->tri_count; t++) m->kept[t] = 1;
    if (keep == MW_KEEP_HULL) return MW_OK;
    if (polygons) {
        mw_status status =
            mw__cdt_spans_list(m) ? parity_keep_polygons(m, error) : mw__fail_memory(error);
        if (status) return status;
    }
    flood f = {.m = m, .stack = mw__alloc(m->tri_count, sizeof *f.stack)};
    if (!f.stack) return mw__fail_memory(error);
    mw_status status = flood_remove(&f, polygons, report, error);
    report->triangles_removed = m->tri_count - f.left;
    free(f.stack);
    return status;
}
