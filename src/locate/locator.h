/* locator.h - what a locator holds, and the steps of a query that the single and the batch query share. Private. */
#ifndef MW_SRC_LOCATOR_H
#define MW_SRC_LOCATOR_H

#include "domain/tiling.h"
#include "locate/border.h"
#include "locate/index.h"
#include "start/start.h"
#include "walk/walk.h"

#include <meshwalk/locate.h>
#include <string.h>

struct mw_locator {
    const mw_mesh *mesh;
    mw_tiling tiling;
    mw_border border;       /* edge_count 0 and box NULL without options.border                         */
    double low[2], high[2]; /* extent of the tiling                                                    */
    mw_index guide;         /* how queries begin where nothing is said; start MW_START_AUTO: there is none */
    double near2;           /* a tile within this squared distance beats a sample, by expectation      */
    double cell2;           /* the same of a guide: the area of one of its cells, if it were a grid, not refined */
    double pace;            /* tiles that a straight line crosses per unit of length, by expectation   */
    mw_walk_kind auto_walk; /* what MW_WALK_AUTO means here */
    mw_walk_kind finish;    /* what ends the cheap walks    */
    uint32_t centre;        /* name of the tile in the middle                                           */
    bool has_border;
    uint64_t epoch;    /* raised by each edit of the mesh, its upper half where triangles get other names; else 0 */
    char promise[640]; /* which promise is void; empty for an embedding                            */
};

/* What a tiling shows, and choices that follow from it: extent, walks, the tile in the middle, density. */
void mw__locator_survey(mw_locator *locator);

/* The guide of a locator that has been surveyed. False when out of memory; it may be released in either case. */
bool mw__locator_guide(const mw_locator *locator, mw_index *guide);

/* Where the finished walk found its point: ends it exactly if it was not, and applies the rule of ties. Leaves in walk->t
 * the tile where the point is (or the last one before the hull), and counts. */
mw_location mw__conclude(const mw_locator *locator, const mw_cursor *cursor, mw_walk *walk, mw_verdict verdict,
                         mw_counters *counters);

/* The walk of one query: first tile by the cursor's start; `last` is where the query before it ended, MW_NONE if there is
 * none: then the start is MW_START_SAMPLE. If the cursor counts, *work is where; it must last as long as the walk. */
mw_walk mw__depart(const mw_locator *locator, const mw_cursor *cursor, uint32_t last, mw_point q, uint64_t *random,
                   mw_work *work);

uint32_t mw__first_tile(const mw_locator *locator, const mw_cursor *cursor, uint32_t last, mw_point q, uint64_t *random,
                        mw_work *work);

/* The mesh has changed since the query before: begin at the tile that is now where that ended, or near it. */
void mw__catch_up(const mw_locator *locator, mw_cursor *cursor);

/* Have the cursor of a mesh that changes know by its name the tile where the query ended. */
static MW_INLINE void mw__note_last(const mw_locator *locator, mw_cursor *cursor)
{
    cursor->last_name = mw__tile_name(&locator->tiling, cursor->last);
}

typedef uint64_t mw_words __attribute__((vector_size(16)));

/* Does q lie within a few lengths of the shortest edge of tile t? Then hardly any guide leads nearer. A long edge would not
 * tell, as many small tiles may lie beside it; nor does a tile as large as a cell, such as there are along the hull. */
static MW_INLINE bool mw__is_close(const mw_locator *locator, uint32_t t, mw_point q)
{
    enum { LENGTHS = 3 };
    const mw_tiling *tiling = &locator->tiling;
    const uint32_t *v = tiling->tri[t].v;
    mw_point a = tiling->point[v[0]], b = tiling->point[v[1]], c = tiling->point[v[2]];
    double ab = mw__distance2(a, b), bc = mw__distance2(b, c), ca = mw__distance2(c, a);
    double least = ab < bc ? ab : bc, shortest = least < ca ? least : ca, far = mw__distance2(a, q);
    return far <= LENGTHS * LENGTHS * shortest && far <= locator->cell2;
}

/* Where to begin where there is a guide: at tile `last`, if q is close to it. */
static MW_INLINE uint32_t mw__guided(const mw_locator *locator, uint32_t last, mw_point q)
{
    return mw__is_close(locator, last, q) ? last : mw__index_tile(&locator->tiling, &locator->guide, q);
}

/* A location, written as it is commonly copied, by 16 bytes: who reads more bytes at a time than were written has to wait
 * until they have left for the cache. */
static MW_INLINE void mw__put_location(mw_location *location, double a, double b, double c, uint32_t triangle,
                                       uint32_t hole, mw_where where)
{
    const double weight[3] = {a, b, c};
    const uint32_t numbers[2] = {triangle, hole};
    const mw_location rest = {.where = (uint8_t)where, .local = 255};
    uint64_t word[4];
    memcpy(word, weight, sizeof weight);
    memcpy(&word[3], numbers, sizeof numbers);
    const mw_words first = {word[0], word[1]}, second = {word[2], word[3]};
    memcpy(location, &first, sizeof first);
    memcpy((char *)location + sizeof first, &second, sizeof second);
    memcpy(&location->where, &rest.where, sizeof rest - offsetof(mw_location, where));
}

/* A location that names no triangle. */
static MW_INLINE void mw__put_nowhere(mw_location *location, mw_where where, uint32_t hole)
{
    mw__put_location(location, NAN, NAN, NAN, MW_NONE, hole, where);
}

static MW_INLINE mw_location mw__nowhere(mw_where where)
{
    mw_location location;
    mw__put_nowhere(&location, where, MW_NONE);
    return location;
}

/* A location in no triangle: in a hole, if the mark of its tile says so, or outside. */
static MW_INLINE void mw__put_in_none(mw_location *location, uint32_t mark)
{
    bool hole = (mark & MW_GHOST) && (mark & MW_USER_MASK) != MW_POCKET;
    mw__put_nowhere(location, hole ? MW_IN_HOLE : MW_OUTSIDE, hole ? mark & MW_USER_MASK : MW_NONE);
}

/* Areas (twice) of the triangles that q makes with the sides of a triangle, area[k] opposite to corner k: exact in sign,
 * and off by less than 2^-42 of their sum. */
void mw__areas(const mw_point corner[3], mw_point q, double area[3]);

/* The location of q in a triangle that contains it: corners as stored, `user` its number and mark, area from mw__areas
 * (overwritten). */
mw_location mw__place(const mw_point corner[3], uint32_t user, mw_point q, double area[3]);

/* The same for a triangle of the user's mesh by its number. */
mw_location mw__place_in(const mw_mesh *mesh, uint32_t triangle, mw_point q);

#endif
