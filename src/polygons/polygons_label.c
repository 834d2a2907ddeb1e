/* polygons_label.c - the set of polygons that covers each triangle, carried from the outside of the
 * hull over the edges: an edge toggles the polygons that own it. */
#include "polygons/polygons_label.h"

#include <stdlib.h>

typedef struct labeller {
    mw_polygons *p;
    const mw_triangle *tri;
    const mw_point *point;
    uint32_t *toggle; /* ranks to toggle, ascending once sorted */
    size_t toggle_count, toggle_room;
} labeller;

static bool labeller_add(labeller *l, uint32_t rank)
{
    if (l->toggle_count == l->toggle_room) {
        size_t room = 2 * l->toggle_room + 64;
        uint32_t *toggle = mw__realloc(l->toggle, room, sizeof *toggle);
        if (!toggle) return false;
        l->toggle = toggle;
        l->toggle_room = room;
    }
    l->toggle[l->toggle_count++] = rank;
    return true;
}

/* Is edge u v to the right of the chord? A chord that crosses the edge parts the triangles on both
 * sides of it alike, so neither matters. */
static bool chord_has_right(const mw_polygon_chord *chord, mw_point u, mw_point v)
{
    double a = mw__chord_side(chord, u), b = mw__chord_side(chord, v);
    return a <= 0 && b <= 0 && (a < 0 || b < 0);
}

/* The polygons of those chords of triangle t that have its edge k on their right. */
static bool labeller_add_chords(labeller *l, uint32_t t, uint32_t k)
{
    const mw_rank_lists *chords = &l->p->chords;
    if (!chords->first) return true;
    mw_point u = l->point[l->tri[t].v[k]], v = l->point[l->tri[t].v[k + 1]];
    for (uint32_t i = chords->first[t]; i < chords->first[t + 1]; i++) {
        const mw_polygon_chord *chord = &l->p->chord[chords->item[i]];
        if (chord_has_right(chord, u, v) && !labeller_add(l, chord->rank)) return false;
    }
    return true;
}

static bool labeller_add_owners(labeller *l, uint32_t t, uint32_t k)
{
    const mw_rank_lists *owners = &l->p->owners;
    uint32_t subsegment = l->p->subsegment[3 * (size_t)t + k];
    if (subsegment == MW_NONE || !owners->first) return true;
    for (uint32_t i = owners->first[subsegment]; i < owners->first[subsegment + 1]; i++)
        if (!labeller_add(l, owners->item[i])) return false;
    return true;
}

static int rank_compare(const void *left, const void *right)
{
    uint32_t a = *(const uint32_t *)left, b = *(const uint32_t *)right;
    return (a > b) - (a < b);
}

/* The set beyond an edge: of the triangle at the end of half-edge `into`, coming from set `from`
 * over `out`, or from outside the hull where that is MW_NONE. MW_NONE when out of memory. */
static uint32_t labeller_cross(labeller *l, uint32_t from, uint32_t out, uint32_t into)
{
    uint32_t t = mw__link_triangle(into), k = mw__link_edge(into);
    l->toggle_count = 0;
    bool done = labeller_add_owners(l, t, k) && labeller_add_chords(l, t, k);
    if (done && out != MW_NONE)
        done = labeller_add_chords(l, mw__link_triangle(out), mw__link_edge(out));
    if (!done) return MW_NONE;
    if (l->toggle_count > 1) qsort(l->toggle, l->toggle_count, sizeof *l->toggle, rank_compare);
    return mw__polygon_sets_toggle(&l->p->sets, from, l->toggle, l->toggle_count);
}

/* A half-edge of the hull. */
static uint32_t labeller_begin(const labeller *l)
{
    for (uint32_t t = 0;; t++)
        for (uint32_t k = 0; k < 3; k++)
            if (l->tri[t].link[k] == MW_NONE) return mw__link(t, k);
}

/* Give the neighbours of triangle t their sets, and put them on the stack. */
static bool labeller_label_neighbours(labeller *l, uint32_t t, uint32_t *stack, uint32_t *top)
{
    for (uint32_t k = 0; k < 3; k++) {
        uint32_t link = l->tri[t].link[k];
        if (link == MW_NONE || l->p->set[mw__link_triangle(link)] != MW_NONE) continue;
        uint32_t set = labeller_cross(l, l->p->set[t], mw__link(t, k), link);
        if (set == MW_NONE) return false;
        l->p->set[mw__link_triangle(link)] = set;
        stack[(*top)++] = mw__link_triangle(link);
    }
    return true;
}

static bool labeller_run(labeller *l, uint32_t tri_count, uint32_t *stack, mw_job *job)
{
    uint32_t top = 0, done = 0, half = labeller_begin(l);
    for (uint32_t t = 0; t < tri_count; t++) l->p->set[t] = MW_NONE;
    uint32_t set = labeller_cross(l, 0, MW_NONE, half);
    if (set == MW_NONE) return false;
    l->p->set[mw__link_triangle(half)] = set;
    stack[top++] = mw__link_triangle(half);
    while (top > 0)
        if (!labeller_label_neighbours(l, stack[--top], stack, &top) ||
            !mw__job_step(job, done++, tri_count))
            return false;
    mw__polygon_sets_finish(&l->p->sets);
    return true;
}

bool mw__polygons_label(mw_polygons *p, const mw_triangle *tri, uint32_t tri_count,
                        const mw_point *point, mw_job *job)
{
    labeller l = {.p = p, .tri = tri, .point = point};
    uint32_t *stack = mw__alloc(tri_count, sizeof *stack);
    p->set = mw__alloc(tri_count, sizeof *p->set);
    bool done = stack && p->set && mw__polygon_sets_create(&p->sets) &&
                labeller_run(&l, tri_count, stack, job);
    free(l.toggle);
    free(stack);
    return done;
}
