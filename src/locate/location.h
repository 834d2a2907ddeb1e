/* location.h - what an answer is, and how it is written. Private. */
#ifndef MW_SRC_LOCATE_LOCATION_H
#define MW_SRC_LOCATE_LOCATION_H

#include "mesh/mesh.h"

#include <meshwalk/locate.h>
#include <string.h>

typedef uint64_t mw_words __attribute__((vector_size(16)));

/* Write a location in pieces of 16 bytes, as copies read it: a processor that reads more bytes at a
 * time than were written has to wait until these are in the cache. */
static MW_INLINE void mw__location_write(mw_location *location, double a, double b, double c,
                                         uint32_t triangle, uint32_t hole, mw_where where)
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

/* A location inside a triangle; weights of the corners as stored. */
static MW_INLINE void mw__location_write_inside(mw_location *location, uint32_t user, double a,
                                                double b, double c)
{
    bool flipped = user & MW_REVERSED;
    mw__location_write(location, a, flipped ? c : b, flipped ? b : c, user & MW_USER_MASK, MW_NONE,
                       MW_INSIDE);
}

/* A location that names no triangle. */
static MW_INLINE void mw__location_write_nowhere(mw_location *location, mw_where where,
                                                 uint32_t hole)
{
    mw__location_write(location, NAN, NAN, NAN, MW_NONE, hole, where);
}

static MW_INLINE mw_location mw__location_nowhere(mw_where where)
{
    mw_location location;
    mw__location_write_nowhere(&location, where, MW_NONE);
    return location;
}

/* A location in no triangle: in a hole, if the mark of its tile says so, or outside. */
static MW_INLINE void mw__location_write_outside(mw_location *location, uint32_t mark)
{
    bool hole = (mark & MW_GHOST) && (mark & MW_USER_MASK) != MW_POCKET;
    mw__location_write_nowhere(location, hole ? MW_IN_HOLE : MW_OUTSIDE,
                               hole ? mark & MW_USER_MASK : MW_NONE);
}

/* Areas (twice) of the triangles that q makes with the sides of a triangle, area[k] opposite to
 * corner k: exact in sign, and off by less than 2^-42 of their sum. Where products of coordinates
 * leave the doubles, all may be multiplied by one power of two. */
void mw__location_areas(const mw_point corner[3], mw_point q, double area[3]);

/* The location of q in a triangle that contains it: corners as stored, `user` its number and mark,
 * area from mw__location_areas (overwritten). */
mw_location mw__location_of(const mw_point corner[3], uint32_t user, mw_point q, double area[3]);

/* The same for a triangle of the user's mesh by its number. */
mw_location mw__location_in_triangle(const mw_mesh *mesh, uint32_t triangle, mw_point q);

#endif
