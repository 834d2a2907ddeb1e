/* overlap_walk.c - which tiles a triangle overlaps. */
#include "overlap/overlap_walk.h"

#include "segment/segment.h"

#include <stdlib.h>
#include <string.h>

bool mw__overlap_walk_create(mw_overlap_walk *walk, const mw_locator *locator)
{
    *walk = (mw_overlap_walk){.locator = locator, .room = 256};
    walk->seen = mw__calloc(locator->tiling.tri_count, sizeof *walk->seen);
    walk->queue = mw__alloc(walk->room, sizeof *walk->queue);
    mw__overlap_walk_forget(walk);
    return walk->seen && walk->queue;
}

void mw__overlap_walk_release(mw_overlap_walk *walk)
{
    free(walk->seen);
    free(walk->queue);
}

void mw__overlap_walk_forget(mw_overlap_walk *walk)
{
    mw_cursor_init(walk->locator, NULL, &walk->cursor, NULL);
}

static void overlap_corners(const mw_overlap_walk *walk, uint32_t t, mw_point corner[3])
{
    const mw_tiling *tiling = &walk->locator->tiling;
    for (int k = 0; k < 3; k++) corner[k] = tiling->point[tiling->tri[t].v[k]];
}

/* --- the queue --- */

static void overlap_new_round(mw_overlap_walk *walk)
{
    walk->taken = walk->queued = 0;
    if (++walk->round) return;
    memset(walk->seen, 0, walk->locator->tiling.tri_count * sizeof *walk->seen);
    walk->round = 1;
}

static void overlap_add(mw_overlap_walk *walk, uint32_t t)
{
    if (walk->seen[t] == walk->round) return;
    walk->seen[t] = walk->round;
    if (walk->queued == walk->room) {
        uint32_t *queue = mw__realloc(walk->queue, 2 * walk->room, sizeof *queue);
        if (!queue) {
            walk->no_memory = true;
            return;
        }
        walk->queue = queue;
        walk->room *= 2;
    }
    walk->queue[walk->queued++] = t;
}

/* Tiles across the edges in the set `over`. */
static void overlap_add_neighbours(mw_overlap_walk *walk, uint32_t t, uint32_t over)
{
    const mw_triangle *tile = &walk->locator->tiling.tri[t];
    for (uint32_t k = 0; k < 3; k++)
        if (over >> k & 1 && tile->link[k] != MW_NONE)
            overlap_add(walk, mw__link_triangle(tile->link[k]));
}

static bool overlap_take(mw_overlap_walk *walk, uint32_t *t)
{
    if (walk->no_memory || walk->taken == walk->queued) return false;
    *t = walk->queue[walk->taken++];
    return true;
}

/* --- where it begins --- */

/* Search from a tile that touches the triangle: the first tile with a common area, or MW_NONE. */
static uint32_t overlap_search(mw_overlap_walk *walk, uint32_t from)
{
    mw_point corner[3];
    mw_clip clip;
    uint32_t t;
    overlap_new_round(walk);
    overlap_add(walk, from);
    while (overlap_take(walk, &t)) {
        overlap_corners(walk, t, corner);
        if (mw__clip(walk->p, corner, 3, &clip)) return t;
        if (mw__clip_touches(walk->p, corner, 3)) overlap_add_neighbours(walk, t, 7);
    }
    return MW_NONE;
}

/* Does the triangle's bounding box meet that of the tiling? */
static bool overlap_is_near(const mw_overlap_walk *walk)
{
    const mw_locator *l = walk->locator;
    const mw_point *p = walk->p;
    return fmin(fmin(p[0].x, p[1].x), p[2].x) <= l->high[0] &&
           fmax(fmax(p[0].x, p[1].x), p[2].x) >= l->low[0] &&
           fmin(fmin(p[0].y, p[1].y), p[2].y) <= l->high[1] &&
           fmax(fmax(p[0].y, p[1].y), p[2].y) >= l->low[1];
}

/* The tile where an edge of the triangle enters the hull, if its corners are outside. */
static uint32_t overlap_over_hull(mw_overlap_walk *walk)
{
    for (uint32_t k = 0; k < 3; k++) {
        mw_segment s;
        const mw_point *a = &walk->p[k], *b = &walk->p[mw__next(k)];
        mw__segment_set(&s, walk->locator, &walk->cursor, (double[]){a->x, a->y},
                        (double[]){b->x, b->y});
        if (s.phase != MW_SEGMENT_ENDED) return s.tile;
    }
    return MW_NONE;
}

/* A tile with a common area, or MW_NONE. The tiles that touch the triangle are connected, so a
 * search from any of them finds one if there is one. */
static uint32_t overlap_first(mw_overlap_walk *walk)
{
    if (!overlap_is_near(walk)) return MW_NONE;
    for (int k = 0; k < 3; k++) {
        mw_point corner[3];
        mw_clip clip;
        mw_locate(walk->locator, &walk->cursor, walk->p[k].x, walk->p[k].y);
        overlap_corners(walk, walk->cursor.last, corner);
        if (mw__clip(walk->p, corner, 3, &clip)) return walk->cursor.last;
        if (mw__clip_touches(walk->p, corner, 3)) return overlap_search(walk, walk->cursor.last);
    }
    uint32_t t = overlap_over_hull(walk);
    return t == MW_NONE ? t : overlap_search(walk, t);
}

void mw__overlap_walk_begin(mw_overlap_walk *walk, const mw_point p[3])
{
    memcpy(walk->p, p, sizeof walk->p);
    uint32_t t = overlap_first(walk);
    overlap_new_round(walk);
    if (t != MW_NONE) overlap_add(walk, t);
}

bool mw__overlap_walk_next(mw_overlap_walk *walk, uint32_t *tile, mw_clip *clip)
{
    mw_point corner[3];
    while (overlap_take(walk, tile)) {
        overlap_corners(walk, *tile, corner);
        uint32_t count = mw__clip(walk->p, corner, 3, clip);
        overlap_add_neighbours(walk, *tile, clip->over);
        if (count) return true;
    }
    return false;
}
