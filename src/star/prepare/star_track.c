/* star_track.c - what a star knows of each facet by itself, and how it changes. */
#include "star/prepare/star_track.h"
#include "star/prepare/kernel_check.h"
#include "star/star_hubs.h"
#include "topology/coincident.h"

#include <stdlib.h>
#include <string.h>

/* In the state of a facet. TURNED: it is stored with its vertices 1 and 2 exchanged, so edge k is
 * edge 2 - k. WRONG << k: its stored edge k is wrong. */
enum { STORED = 1, TURNED = 2, MET = 4, FLAT = 8, UNSOUND = 16, WRONG = 32 };

static void facet_count_state(mw_star_track *track, uint8_t state, uint32_t change)
{
    if (state & MET) track->met += change;
    if (state & FLAT) track->flat += change;
    if (state & UNSOUND) track->unsound += change;
    for (uint32_t k = 0; k < 3; k++)
        if (state & WRONG << k) track->wrong += change;
}

static void facet_set_state(mw_star_track *track, uint32_t t, uint8_t state)
{
    if (track->state[t] == state) return;
    facet_count_state(track, track->state[t], UINT32_MAX);
    facet_count_state(track, state, 1);
    track->state[t] = state;
}

static uint32_t facet_number(const mw_star *star, uint32_t place)
{
    return star->facet[place].user & MW_USER_MASK;
}

/* --- a facet by itself --- */

/* The state of a facet, but for its edges. */
static uint8_t facet_judge(const mw_star *star, const uint32_t v[3])
{
    if (!mw__star_corners_hold(star, v)) return STORED | UNSOUND;
    const double *a = mw__star_corner_point(star, v, 0), *b = mw__star_corner_point(star, v, 1),
                 *c = mw__star_corner_point(star, v, 2), side = mw__orient3d(a, b, c, star->centre);
    if (side == 0) return STORED | (mw__collinear3(a, b, c) ? FLAT : UNSOUND);
    bool turned = side > 0;
    const uint32_t outwards[3] = {v[0], v[turned ? 2 : 1], v[turned ? 1 : 2]};
    return (uint8_t)(STORED | (turned ? TURNED : 0) |
                     (mw__star_ray_meets(star, outwards) ? MET : 0));
}

bool mw__star_track_turns(const mw_star *star, const uint32_t v[3])
{
    return facet_judge(star, v) & TURNED;
}

static bool facet_has(const uint32_t v[3], uint32_t vertex)
{
    return v[0] == vertex || v[1] == vertex || v[2] == vertex;
}

static void facet_leave_vertex(mw_star *star, uint32_t t, uint32_t vertex)
{
    uint32_t *degree = &star->track.degree[mw__representative(star->coincident, vertex)];
    --*degree;
    if (star->owner[vertex] == t)
        star->owner[vertex] = *degree ? MW_STAR_OWNER_LOST : MW_NONE;
    else if (*degree == 0)
        star->owner[vertex] = MW_NONE;
}

static void facet_join_vertex(mw_star *star, uint32_t t, uint32_t vertex)
{
    star->track.degree[mw__representative(star->coincident, vertex)]++;
    uint32_t *owner = &star->owner[vertex];
    if (*owner != MW_STAR_OWNER_LOST && t < *owner) *owner = t;
}

/* The corners of a facet become others; before or after, there may be none (NULL). */
static void facet_change_corners(mw_star *star, uint32_t t, const uint32_t *before,
                                 const uint32_t *after)
{
    for (int k = 0; k < 3; k++) {
        if (after && !(before && facet_has(before, after[k]))) facet_join_vertex(star, t, after[k]);
        if (before && !(after && facet_has(after, before[k])))
            facet_leave_vertex(star, t, before[k]);
    }
}

/* The rings of hubs at the corners are to be found anew. */
static void facet_touch_hubs(mw_star *star, const uint32_t v[3])
{
    for (int k = 0; k < 3; k++) {
        uint32_t vertex = mw__representative(star->coincident, v[k]);
        mw__star_hub_touch(star, vertex, star->track.degree[vertex]);
    }
}

static void facet_measure_reach(mw_star *star, const uint32_t v[3])
{
    for (uint32_t k = 0; k < 9; k++)
        star->reach = fmax(
            star->reach, fabs(mw__star_corner_point(star, v, k / 3)[k % 3] - star->centre[k % 3]));
}

/* --- the guide --- */

static uint32_t guide_section(const mw_star *star, const uint32_t v[3])
{
    return mw__star_facet_key(star, v) >> (32 - star->guide_bits);
}

/* The farthest section from its own in which a facet may be named. */
#define GUIDE_NEAR 8u

/* Let entries of the guide that name facet `from`, with these corners, name `to`. They are in its
 * section of the curve, and in sections near it that have no facet, or were one section before the
 * guide was refined. */
static void guide_rename(mw_star *star, const uint32_t v[3], uint32_t from, uint32_t to)
{
    uint32_t section = guide_section(star, v), end = UINT32_C(1) << star->guide_bits,
             i = section > GUIDE_NEAR ? section - GUIDE_NEAR : 0;
    if (end - section > GUIDE_NEAR + 1) end = section + GUIDE_NEAR + 1;
    for (; i < end; i++)
        if (star->guide[i] == from) star->guide[i] = to;
    if (star->front == from) star->front = to;
}

/* How far along the curve a facet is from a section, in sections. */
static uint32_t guide_distance(const mw_star *star, uint32_t facet, uint32_t section)
{
    if (facet >= star->facet_count) return UINT32_MAX;
    uint32_t is = guide_section(star, star->facet[facet].v);
    return is > section ? is - section : section - is;
}

/* Facets that went, or moved along the curve, are still named by sections far from where they were
 * last. So with every fourth that goes, some sections are looked at, in turn: one that names a
 * facet far away names that of the section before it, if that is near. */
static void guide_tend(mw_star *star)
{
    enum { SECTIONS = 4 };
    mw_star_track *track = &star->track;
    const uint32_t last = (UINT32_C(1) << star->guide_bits) - 1;
    for (int i = 0; i < SECTIONS; i++) {
        uint32_t section = track->tended_section++ & last,
                 before = star->guide[(section - 1) & last];
        if (guide_distance(star, star->guide[section], section) > GUIDE_NEAR &&
            guide_distance(star, before, section) <= GUIDE_NEAR)
            star->guide[section] = before;
    }
}

/* --- places --- */

static uint32_t facet_append(mw_star *star, uint32_t t)
{
    uint32_t place = star->facet_count++;
    star->track.place[t] = place;
    star->facet[place] =
        (mw_star_facet){.link = {MW_NONE, MW_NONE, MW_NONE}, .v = {MW_NONE}, .user = t};
    return place;
}

/* The last facet takes a place that has become free. Where its neighbours name it, they are told;
 * those that are about to be dropped do not. */
static void facet_move_last(mw_star *star, uint32_t place)
{
    uint32_t last = --star->facet_count;
    if (place == last) return;
    mw_star_facet *facet = &star->facet[place];
    *facet = star->facet[last];
    star->track.place[facet_number(star, place)] = place;
    for (uint32_t k = 0; k < 3; k++) {
        uint32_t link = facet->link[k];
        if (link == MW_NONE || mw__link_triangle(link) >= star->facet_count) continue;
        uint32_t *back = &star->facet[mw__link_triangle(link)].link[mw__link_edge(link)];
        if (*back == mw__link(last, k)) *back = mw__link(place, k);
    }
    guide_rename(star, facet->v, last, place);
    facet_touch_hubs(star, facet->v);
}

/* --- the three steps --- */

void mw__star_track_renew(mw_star *star, uint32_t t)
{
    mw_star_track *track = &star->track;
    const uint32_t *v = star->surface->tri[t].v;
    bool known = track->place[t] != MW_NONE;
    uint8_t state = facet_judge(star, v);
    uint32_t place = known ? track->place[t] : facet_append(star, t);
    mw_star_facet *facet = &star->facet[place];
    const uint32_t before[3] = {facet->v[0], facet->v[1], facet->v[2]};
    facet_change_corners(star, t, known ? before : NULL, v);
    if (known) facet_touch_hubs(star, before);
    bool turned = (state & TURNED) != 0;
    facet->v[0] = v[0];
    facet->v[1] = v[turned ? 2 : 1];
    facet->v[2] = v[turned ? 1 : 2];
    facet->user = t | (turned ? MW_FACET_ALTERED : 0);
    facet_touch_hubs(star, facet->v);
    facet_set_state(track, t, state); /* its edges come with mw__star_track_link */
    mw__star_set_planes(star, facet);
    if (star->angle) mw__star_renew_angles(star, facet);
    facet_measure_reach(star, v);
    if (!known) star->guide[guide_section(star, v)] = place;
}

static uint32_t half_edge_stored(const mw_star *star, uint32_t half)
{
    uint32_t t = mw__link_triangle(half), k = mw__link_edge(half);
    return mw__link(star->track.place[t], star->track.state[t] & TURNED ? 2 - k : k);
}

/* Do the facets on both sides of a stored edge go along it in opposite directions? */
static bool half_edges_agree(const mw_star *star, uint32_t half, uint32_t link)
{
    const mw_star_facet *a = &star->facet[mw__link_triangle(half)],
                        *b = &star->facet[mw__link_triangle(link)];
    return mw__representative(star->coincident, a->v[mw__link_edge(half)]) ==
           mw__representative(star->coincident, b->v[mw__next(mw__link_edge(link))]);
}

static void half_edge_set(mw_star *star, uint32_t half, uint32_t link, bool wrong)
{
    uint32_t place = mw__link_triangle(half), k = mw__link_edge(half),
             t = facet_number(star, place);
    star->facet[place].link[k] = link;
    uint8_t state = star->track.state[t];
    facet_set_state(&star->track, t, (uint8_t)(wrong ? state | WRONG << k : state & ~(WRONG << k)));
}

void mw__star_track_link(mw_star *star, uint32_t t)
{
    for (uint32_t k = 0; k < 3; k++) {
        uint32_t other = star->surface->tri[t].link[k],
                 half = half_edge_stored(star, mw__link(t, k));
        if (other == MW_NONE) {
            half_edge_set(star, half, MW_NONE, true);
            continue;
        }
        uint32_t link = half_edge_stored(star, other);
        bool wrong = !half_edges_agree(star, half, link);
        half_edge_set(star, half, link, wrong);
        half_edge_set(star, link, half, wrong);
    }
}

/* Where a facet is that is near one that goes: the one that took its place, or the lowest at a
 * corner of it; any, if there is none. */
static uint32_t facet_find_heir(const mw_star *star, uint32_t t, const uint32_t v[3])
{
    const uint32_t *place = star->track.place;
    uint32_t heir = MW_NONE;
    if (t < star->surface->tri_count) heir = star->surface->tri[t].user & MW_USER_MASK;
    for (uint32_t k = 0; k < 3 && (heir >= star->tri_room || place[heir] == MW_NONE); k++)
        heir = star->owner[v[k]];
    return heir < star->tri_room && place[heir] != MW_NONE ? place[heir] : 0;
}

void mw__star_track_drop(mw_star *star, uint32_t t)
{
    mw_star_track *track = &star->track;
    uint32_t place = track->place[t];
    if (place == MW_NONE) return;
    const mw_star_facet facet = star->facet[place];
    facet_set_state(track, t, 0);
    track->place[t] = MW_NONE;
    facet_change_corners(star, t, facet.v, NULL);
    facet_touch_hubs(star, facet.v);
    uint32_t heir = facet_find_heir(star, t, facet.v);
    if (heir != star->facet_count - 1) guide_rename(star, facet.v, place, heir); /* else it comes */
    facet_move_last(star, place);
    if (track->dropped++ % 4 == 0) guide_tend(star);
}

/* --- memory --- */

/* Grow an array that begins at a cache line, which realloc would not keep. */
static bool facet_lines_make_room(void *array, size_t count, size_t room, size_t size)
{
    void **records = array, *more = mw__alloc_lines(room, size);
    if (!more) return false;
    memcpy(more, *records, count * size);
    free(*records);
    *records = more;
    return true;
}

static bool numbers_make_room(uint32_t **array, size_t room)
{
    uint32_t *more = mw__realloc(*array, room, sizeof *more);
    if (more) *array = more;
    return more != NULL;
}

static size_t room_for(size_t room, size_t count, size_t most)
{
    size_t more = room + room / 2 + 16;
    if (more < count) more = count;
    return more < most ? more : most;
}

/* A guide for more facets has sections within each of the old ones. */
static bool guide_refine(mw_star *star, uint32_t facets)
{
    uint32_t bits = mw__star_guide_bits(facets), more = bits - star->guide_bits;
    if (bits <= star->guide_bits) return true;
    uint32_t *guide = mw__alloc((size_t)1 << bits, sizeof *guide);
    if (!guide) return false;
    for (uint32_t i = 0; i < UINT32_C(1) << bits; i++) guide[i] = star->guide[i >> more];
    free(star->guide);
    star->guide = guide;
    star->guide_bits = bits;
    return true;
}

static bool facets_reserve(mw_star *star, size_t count)
{
    if (count <= star->tri_room) return true;
    size_t room = room_for(star->tri_room, count, MW_MAX_TRIANGLES);
    uint8_t *state = mw__realloc(star->track.state, room, sizeof *state);
    if (!state) return false;
    star->track.state = state;
    if (!numbers_make_room(&star->track.place, room) || !guide_refine(star, (uint32_t)room) ||
        !facet_lines_make_room(&star->facet, star->facet_count, room, sizeof *star->facet))
        return false;
    for (size_t t = star->tri_room; t < room; t++) {
        star->track.state[t] = 0;
        star->track.place[t] = MW_NONE;
    }
    star->tri_room = (uint32_t)room;
    return true;
}

static bool vertices_reserve(mw_star *star, size_t count)
{
    if (count <= star->point_room) return true;
    size_t room = room_for(star->point_room, count, MW_MAX_VERTICES);
    if (!numbers_make_room(&star->track.degree, room) || !numbers_make_room(&star->owner, room))
        return false;
    if (star->angle &&
        !facet_lines_make_room(&star->angle, star->point_room, room, 2 * sizeof *star->angle))
        return false;
    for (size_t v = star->point_room; v < room; v++) {
        star->track.degree[v] = 0;
        star->owner[v] = MW_NONE;
    }
    star->point_room = (uint32_t)room;
    return true;
}

bool mw__star_track_reserve(mw_star *star, size_t tri_count, size_t point_count)
{
    return facets_reserve(star, tri_count) && vertices_reserve(star, point_count);
}

/* --- begin and end --- */

static void track_fill(mw_star *star)
{
    mw_star_track *track = &star->track;
    for (uint32_t t = 0; t < star->tri_room; t++) {
        track->state[t] = 0;
        track->place[t] = MW_NONE;
    }
    for (uint32_t v = 0; v < star->point_room; v++) track->degree[v] = 0;
    for (uint32_t v = star->point_count; v < star->point_room; v++) star->owner[v] = MW_NONE;
    for (uint32_t i = 0; i < star->facet_count; i++) {
        uint32_t t = facet_number(star, i);
        track->place[t] = i;
        for (uint32_t k = 0; k < 3; k++)
            track->degree[mw__representative(star->coincident, star->facet[i].v[k])]++;
        facet_set_state(track, t, facet_judge(star, star->surface->tri[t].v));
    }
    for (uint32_t i = 0; i < star->facet_count; i++)
        mw__star_track_link(star, facet_number(star, i));
}

bool mw__star_track_begin(mw_star *star)
{
    mw_star_track *track = &star->track;
    *track = (mw_star_track){
        .state = mw__alloc(star->tri_room, sizeof *track->state),
        .place = mw__alloc(star->tri_room, sizeof *track->place),
        .degree = mw__alloc(star->point_room, sizeof *track->degree),
    };
    track->on = track->state && track->place && track->degree;
    if (track->on)
        track_fill(star);
    else
        mw__star_track_end(star);
    return track->on;
}

void mw__star_track_end(mw_star *star)
{
    free(star->track.state);
    free(star->track.place);
    free(star->track.degree);
    star->track = (mw_star_track){0};
}

size_t mw__star_track_bytes(const mw_star *star)
{
    const mw_star_track *track = &star->track;
    if (!track->on) return 0;
    return star->tri_room * (sizeof *track->state + sizeof *track->place) +
           star->point_room * sizeof *track->degree;
}

void mw__star_track_renumber(mw_star *star, const uint32_t *triangle, const uint32_t *vertex)
{
    mw_star_track *track = &star->track;
    uint32_t facets = 0, points = 0;
    for (uint32_t i = 0; i < star->facet_count; i++) {
        mw_star_facet *facet = &star->facet[i];
        for (uint32_t k = 0; k < 3; k++) facet->v[k] = vertex[facet->v[k]];
        facet->user = triangle[facet->user & MW_USER_MASK] | (facet->user & ~MW_USER_MASK);
    }
    for (uint32_t t = 0; t < star->tri_count; t++) {
        if (triangle[t] == MW_NONE) continue;
        track->state[facets] = track->state[t];
        track->place[facets++] = track->place[t];
    }
    for (uint32_t v = 0; v < star->point_count; v++) {
        if (vertex[v] == MW_NONE) continue;
        track->degree[points] = track->degree[v];
        star->owner[points] = star->owner[v] == MW_NONE ? MW_NONE : triangle[star->owner[v]];
        if (star->angle)
            memcpy(star->angle + 2 * points, star->angle + 2 * v, 2 * sizeof *star->angle);
        points++;
    }
    for (uint32_t t = facets; t < star->tri_count; t++) {
        track->state[t] = 0;
        track->place[t] = MW_NONE;
    }
    for (uint32_t v = points; v < star->point_count; v++) {
        track->degree[v] = 0;
        star->owner[v] = MW_NONE;
    }
    for (uint32_t i = 0; i < star->hubs.count; i++)
        star->hubs.hub[i].vertex = vertex[star->hubs.hub[i].vertex];
    star->tri_count = facets;
    star->point_count = points;
}
