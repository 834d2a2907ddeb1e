/* tie.c - rays through edges and vertices. */
#include "star/tie.h"

#include "star/kernel.h"
#include "star/walk.h"

#include <stdlib.h>

static const double *corner(const mw_star *star, uint32_t t, uint32_t k)
{
    return mw__surface_point(star->surface, star->tri[t].v[k]);
}

static uint32_t number(const mw_star *star, uint32_t t)
{
    return star->tri[t].user & MW_USER_MASK;
}

static void lower(uint32_t *lowest, uint32_t t)
{
    if (t < *lowest) *lowest = t;
}

bool mw__same_ray(const double c[3], const double a[3], const double b[3])
{
    if (!mw__collinear3(c, a, b)) return false;
    for (int k = 0; k < 3; k++) /* along a line coordinates grow or fall together */
        if (a[k] != c[k] && b[k] != c[k]) return (a[k] > c[k]) == (b[k] > c[k]);
    return false;
}

/* Does the ray through q meet facet t, which has an area? */
static bool meets(const mw_star *star, uint32_t t, const double q[3])
{
    const double *c = star->centre, d[3] = {q[0] - c[0], q[1] - c[1], q[2] - c[2]};
    for (uint32_t k = 0; k < 3; k++)
        if (mw__star_turn(corner(star, t, k), corner(star, t, k + 1), q, d, c) < 0) return false;
    return true;
}

static bool is_flat(const mw_star *star, uint32_t t)
{
    return star->flat_count && star->group[t] != MW_NONE;
}

/* The lowest facet that the ray through q meets, of those that share an edge with the group of the flat facet t, or a
 * vertex that the ray goes through. */
static uint32_t beside_group(const mw_star *star, uint32_t t, const double q[3])
{
    uint32_t lowest = MW_NONE;
    for (uint32_t i = star->group[t]; i < star->flat_count; i++) {
        uint32_t flat = star->flat[i];
        if (star->group[flat] != star->group[t]) break;
        for (uint32_t k = 0; k < 3; k++) {
            uint32_t other = mw__link_triangle(star->tri[flat].link[k]);
            if (!is_flat(star, other) && meets(star, other, q)) lower(&lowest, number(star, other));
            if (mw__same_ray(star->centre, corner(star, flat, k), q)) lower(&lowest, star->owner[star->tri[flat].v[k]]);
        }
    }
    return lowest;
}

uint32_t mw__star_edge_owner(const mw_star *star, uint32_t t, uint32_t edge, const double q[3])
{
    uint32_t lowest = is_flat(star, t) ? MW_NONE : number(star, t);
    uint32_t other = mw__link_triangle(star->tri[t].link[edge]);
    lower(&lowest, is_flat(star, other) ? beside_group(star, other, q) : number(star, other));
    return lowest;
}

/* --- beforehand --------------------------------------------------------------------------------------------------- */

/* List the flat facets that are linked, group by group. group[t] is where the group of t begins in the list. */
static void collect_groups(mw_star *star)
{
    uint32_t end = 0;
    for (uint32_t t = 0; t < star->tri_count; t++) star->group[t] = MW_NONE;
    for (uint32_t t = 0; t < star->tri_count; t++) {
        uint32_t begin = end;
        if (star->group[t] != MW_NONE || mw__star_is_void(star->surface, &star->tri[t]) ||
            !mw__collinear3(corner(star, t, 0), corner(star, t, 1), corner(star, t, 2)))
            continue;
        star->group[t] = begin;
        star->flat[end++] = t;
        for (uint32_t i = begin; i < end; i++)
            for (uint32_t k = 0; k < 3; k++) {
                uint32_t other = mw__link_triangle(star->tri[star->flat[i]].link[k]);
                if (star->group[other] != MW_NONE ||
                    !mw__collinear3(corner(star, other, 0), corner(star, other, 1), corner(star, other, 2)))
                    continue;
                star->group[other] = begin;
                star->flat[end++] = other;
            }
    }
    star->flat_count = end; /* those that are not linked do not count here */
}

static bool make_groups(mw_star *star)
{
    if (star->flat_count == 0) return true;
    if (!star->group) star->group = mw__alloc(star->tri_count, sizeof *star->group);
    free(star->flat);
    star->flat = mw__alloc(star->flat_count, sizeof *star->flat);
    if (!star->group || !star->flat) return false;
    collect_groups(star);
    return true;
}

static uint32_t place(const mw_star *star, uint32_t v)
{
    return star->surface->place ? star->surface->place[v] : v;
}

static void spread_places(mw_star *star)
{
    for (uint32_t v = 0; v < star->point_count; v++) star->owner[v] = star->owner[place(star, v)];
}

bool mw__star_fill_owners(mw_star *star)
{
    if (!make_groups(star)) return false;
    for (uint32_t v = 0; v < star->point_count; v++) star->owner[v] = MW_NONE;
    for (uint32_t t = 0; t < star->tri_count; t++) {
        if (is_flat(star, t) || mw__star_is_void(star->surface, &star->tri[t])) continue;
        for (uint32_t k = 0; k < 3; k++) lower(&star->owner[place(star, star->tri[t].v[k])], number(star, t));
    }
    spread_places(star);
    for (uint32_t i = 0; i < star->flat_count; i++)
        for (uint32_t k = 0; k < 3; k++) {
            uint32_t v = star->tri[star->flat[i]].v[k];
            lower(&star->owner[place(star, v)], beside_group(star, star->flat[i], mw__surface_point(star->surface, v)));
        }
    spread_places(star);
    return true;
}
