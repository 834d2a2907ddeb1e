#include "oracle/surface/star_twin.h"

#include "base/random.h"
#include "oracle/edit_require.h"
#include "star/star_hubs.h"

#include <stdlib.h>
#include <string.h>

/* Which facet has a place, for all of the user's numbers; MW_NONE: none. */
static uint32_t *places_of(const mw_star *star)
{
    uint32_t *place = require_room(star->tri_count, sizeof *place);
    for (uint32_t t = 0; t < star->tri_count; t++) place[t] = MW_NONE;
    for (uint32_t i = 0; i < star->facet_count; i++) {
        uint32_t t = star->facet[i].user & MW_USER_MASK;
        REQUIRE(t < star->tri_count && place[t] == MW_NONE);
        place[t] = i;
    }
    return place;
}

static uint32_t user_of_link(const mw_star *star, uint32_t link)
{
    REQUIRE(mw__link_triangle(link) < star->facet_count);
    return mw__link(star->facet[mw__link_triangle(link)].user & MW_USER_MASK, mw__link_edge(link));
}

/* The same facets, links, owners and angles. */
static void check_facets(const mw_star *star, const mw_star *fresh)
{
    REQUIRE(star->facet_count == fresh->facet_count && star->tri_count == fresh->tri_count);
    REQUIRE(star->point_count == fresh->point_count && star->area_count == fresh->area_count);
    uint32_t *place = places_of(star);
    for (uint32_t i = 0; i < fresh->facet_count; i++) {
        const mw_star_facet *b = &fresh->facet[i], *a = &star->facet[place[b->user & MW_USER_MASK]];
        REQUIRE(a->user == b->user && memcmp(a->v, b->v, sizeof a->v) == 0);
        REQUIRE(memcmp(a->normal, b->normal, sizeof a->normal) == 0);
        for (int k = 0; k < 3; k++)
            REQUIRE(user_of_link(star, a->link[k]) == user_of_link(fresh, b->link[k]));
        for (int k = 0; k < 3 && fresh->angle; k++)
            REQUIRE(memcmp(star->angle + 2 * a->v[k], fresh->angle + 2 * a->v[k], 16) == 0);
    }
    for (uint32_t v = 0; v < fresh->point_count; v++) REQUIRE(star->owner[v] == fresh->owner[v]);
    REQUIRE(star->front < star->facet_count);
    free(place);
}

/* Each hub has all its facets in its ring, in order; each vertex of many facets is one. */
static void check_hubs(const mw_star *star)
{
    uint32_t many = 0;
    for (uint32_t v = 0; v < star->point_count; v++)
        many += star->track.degree[v] >= MW_STAR_HUB_FACETS;
    for (uint32_t i = 0; i < star->hubs.count; i++) {
        const mw_star_hub *hub = &star->hubs.hub[i];
        REQUIRE(!hub->stale && hub->count == star->track.degree[hub->vertex]);
        many -= hub->count >= MW_STAR_HUB_FACETS;
        for (uint32_t k = 0; k < hub->count; k++) {
            uint32_t half = hub->ring[k], next = hub->ring[k + 1 < hub->count ? k + 1 : 0];
            REQUIRE(mw__link_triangle(half) < star->facet_count);
            REQUIRE(star->facet[mw__link_triangle(half)].v[mw__link_edge(half)] == hub->vertex);
            REQUIRE(mw__star_turn(star, half) == next);
        }
    }
    REQUIRE(many == 0);
}

/* A ray anywhere, or through a vertex or the middle of an edge. */
static void any_ray(const mw_star *star, double q[3], uint64_t *random)
{
    const mw_star_facet *facet = &star->facet[mw__random_below(random, star->facet_count)];
    uint32_t kind = mw__random_below(random, 4);
    for (uint32_t k = 0; k < 3; k++) {
        double a = mw__star_corner_point(star, facet->v, 0)[k],
               b = mw__star_corner_point(star, facet->v, 1)[k];
        q[k] = kind == 0   ? a
               : kind == 1 ? (a + b) / 2
                           : star->centre[k] + (double)mw__random_below(random, 2001) - 1000;
    }
}

static void check_answers(const mw_star *star, const mw_star *fresh, mw_star_cursor *cursor,
                          int rays, uint64_t *random)
{
    for (int i = 0; i < rays; i++) {
        double q[3];
        any_ray(fresh, q, random);
        mw_star_query_options how = {.seed = *random, .counters = 1};
        how.walk = (mw_star_walk_kind)mw__random_below(random, MW_STAR_WALK_COUNT);
        if (how.walk == MW_STAR_WALK_ORTHOGONAL && !star->angle) how.walk = MW_STAR_WALK_AUTO;
        how.start = (mw_star_start_kind)mw__random_below(random, MW_STAR_START_COUNT);
        if (mw_star_start_has_index(how.start)) how.start = MW_STAR_START_AUTO;
        mw_star_cursor one, other;
        REQUIRE(mw_star_cursor_init(fresh, NULL, &one, NULL) == MW_OK);
        REQUIRE(mw_star_cursor_init(star, &how, &other, NULL) == MW_OK);
        mw_location should = mw_star_locate(fresh, &one, q), is = mw_star_locate(star, cursor, q);
        REQUIRE(should.triangle == is.triangle && memcmp(&should, &is, sizeof is) == 0);
        is = mw_star_locate(star, &other, q);
        REQUIRE(memcmp(&should, &is, sizeof is) == 0);
    }
}

void star_twin_check(mw_star *star, mw_star_cursor *cursor, int rays, star_twin_counts *counts,
                     uint64_t *random)
{
    mw_star_options options = {.threads = 1, .angles = star->angles};
    mw_star_update_options none = {.moved = &(uint32_t){0}, .threads = 1};
    mw_star *fresh;
    mw_error wanted = {0}, error = {0};
    mw_star_info info = {0};
    memcpy(options.centre, star->centre, sizeof star->centre);
    mw_status status = mw_star_create(star->surface, &options, &fresh, &wanted);
    if (fresh) mw_star_describe(fresh, &info);
    bool sound = status == MW_OK && info.flat_facets == 0;
    if (star->track.on) REQUIRE(mw_star_ready(star) == sound);
    if (!mw_star_ready(star)) {
        const double q[3] = {1, 2, 3};
        REQUIRE(mw_star_locate(star, cursor, q).where == MW_BAD);
    }
    if (!sound || !star->track.on) {
        REQUIRE(mw_star_update(star, &none, &error) == status);
        REQUIRE(status == MW_OK || strcmp(error.message, wanted.message) == 0);
        REQUIRE(mw_star_ready(star) == (status == MW_OK));
        REQUIRE(star->track.on == (info.flat_facets == 0));
    }
    if (sound) check_facets(star, fresh);
    if (sound) check_hubs(star);
    if (fresh) check_answers(star, fresh, cursor, rays, random);
    counts->ready += sound;
    counts->refused += status != MW_OK;
    counts->flat += info.flat_facets > 0;
    mw_star_destroy(fresh);
}
