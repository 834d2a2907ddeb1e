/* link.c - links along edges whose lower vertices are in one range.
 *
 * Of two triangles that are turned alike, one runs along their edge upwards, from the lower vertex to the upper one, and the other
 * downwards. So the halves that go down are put into a table first, and those that go up find them there. A bunch of vertices
 * at a time: their halves stay in the nearest cache, and slots of the table are seldom wanted by two. What was left there by
 * earlier bunches is known by its number, and nothing is ever cleared. A triangle has one half of either kind at its lowest vertex, at
 * places that are known beforehand; the third edge is sorted in. Where a bunch is not as simple, each vertex is looked at by itself. */
#include "mesh/link.h"

#include <stdlib.h>
#include <string.h>

enum {
    BUNCH_SHIFT = 6, /* so many vertices, as a power of two, make a bunch; parts begin with one  */
    BUNCH = 1 << BUNCH_SHIFT,
    MOST = 1024, /* halves of a bunch, expected are 384; with more it is not simple */
    SLOT_BITS = 13
};

/* A half-edge by its lower vertex, in the upper bits, and its upper one. */
typedef struct mw_arrow {
    uint64_t key;
    uint32_t half; /* 4 * triangle + edge                              */
    uint32_t next; /* of one that goes down: the one before in its slot */
} mw_arrow;

/* Arrows from `from` on go down, those from `middle` on up. On either side the bunch's own, at the lowest vertices of triangles, come
 * first, in the order of these: of triangle t number t + own[up]. */
typedef struct mw_bunch {
    uint32_t from, middle, own[2];
    uint32_t next[2];   /* how many others go down and up; then where the next of them goes */
    uint32_t triangles; /* where those end whose lowest vertex is in the bunch, counted from the part's first */
} mw_bunch;

static MW_INLINE uint32_t *link_of(mw_triangle *tri, uint32_t half)
{
    return &tri[mw__link_triangle(half)].link[mw__link_edge(half)];
}

/* --- bunches --- */

static MW_INLINE mw_bunch *bunch_of(mw_bunch *bunch, mw_part part, uint32_t vertex)
{
    return &bunch[(vertex - part.base) >> BUNCH_SHIFT];
}

/* The corner with the lowest vertex. */
static MW_INLINE uint32_t low_corner(const uint32_t v[3])
{
    uint32_t low = mw__lowest(v[0], v[1], v[2]);
    return (uint32_t)(v[1] == low) + 2 * (uint32_t)(v[2] == low);
}

/* The vertices that stray i runs from and to. Its triangle may lie anywhere. */
static MW_INLINE const uint32_t *stray_ends(const mw_triangle *tri, mw_strays strays, uint32_t i)
{
    enum { AHEAD = 16 };
    if (i + AHEAD < strays.count) __builtin_prefetch(&tri[mw__link_triangle(strays.half[i + AHEAD])]);
    return &tri[mw__link_triangle(strays.half[i])].v[mw__link_edge(strays.half[i])];
}

static MW_INLINE void count_other(mw_bunch *bunch, mw_part part, uint32_t from, uint32_t to)
{
    bunch_of(bunch, part, from < to ? from : to)->next[from < to]++;
}

static void count(const mw_triangle *tri, mw_part part, mw_strays strays, mw_bunch *bunch)
{
    for (uint32_t t = part.first; t < part.end; t++) {
        const uint32_t *v = tri[t].v;
        uint32_t k = low_corner(v), x = v[k + 1], y = v[mw__prev(k)];
        bunch_of(bunch, part, v[k])->triangles = t + 1 - part.first;
        if (MW_LIKELY(mw__part_has(part, x < y ? x : y))) count_other(bunch, part, x, y);
    }
    for (uint32_t i = 0; i < strays.count; i++) {
        const uint32_t *ends = stray_ends(tri, strays, i);
        count_other(bunch, part, ends[0], ends[1]);
    }
}

static void add_up(mw_part part, uint32_t bunches, mw_bunch *bunch)
{
    uint32_t sum = 1, own = 0; /* number 0 is nobody's */
    for (mw_bunch *b = bunch; b < bunch + bunches; b++) {
        uint32_t begin = own;
        if (b->triangles > own) own = b->triangles;
        b->from = sum;
        for (int up = 0; up < 2; up++) {
            uint32_t others = b->next[up];
            if (up) b->middle = sum;
            b->own[up] = sum - begin - part.first;
            b->next[up] = sum + (own - begin);
            sum += own - begin + others;
        }
    }
}

static MW_INLINE void put(mw_arrow *to, uint32_t lower, uint32_t upper, uint32_t half)
{
    to->key = (uint64_t)lower << 32 | upper;
    to->half = half;
}

static MW_INLINE void put_other(mw_arrow *arrow, mw_bunch *bunch, mw_part part, uint32_t from, uint32_t to,
                                uint32_t half)
{
    uint32_t low = from < to ? from : to, high = from < to ? to : from;
    put(&arrow[bunch_of(bunch, part, low)->next[from < to]++], low, high, half);
}

static void fill(const mw_triangle *tri, mw_part part, mw_strays strays, mw_bunch *bunch, mw_arrow *arrow)
{
    for (uint32_t t = part.first; t < part.end; t++) {
        const uint32_t *v = tri[t].v;
        uint32_t k = low_corner(v), low = v[k], x = v[k + 1], y = v[mw__prev(k)];
        const mw_bunch *b = bunch_of(bunch, part, low);
        uint32_t up = b->own[1] + t, down = b->own[0] + t;
        put(&arrow[up], low, x, mw__link(t, k));
        put(&arrow[down], low, y, mw__link(t, mw__prev(k)));
        if (MW_LIKELY(mw__part_has(part, x < y ? x : y))) put_other(arrow, bunch, part, x, y, mw__link(t, mw__next(k)));
    }
    for (uint32_t i = 0; i < strays.count; i++) {
        const uint32_t *ends = stray_ends(tri, strays, i);
        put_other(arrow, bunch, part, ends[0], ends[1], strays.half[i]);
    }
}

/* --- matching --- */

static MW_INLINE uint32_t slot_of(uint64_t key)
{
    return (uint32_t)(key * UINT64_C(0x9e3779b97f4a7c15) >> (64 - SLOT_BITS));
}

/* Put those that go down into the table. Returns false where two are of one edge. */
static bool enter(mw_arrow *arrow, uint32_t *slot, const mw_bunch *b)
{
    for (uint32_t i = b->from; i < b->middle; i++) {
        uint32_t *last = &slot[slot_of(arrow[i].key)], j = *last;
        arrow[i].next = j;
        *last = i;
        for (; MW_UNLIKELY(j >= b->from); j = arrow[j].next)
            if (arrow[j].key == arrow[i].key) return false;
    }
    return true;
}

/* Does another of the arrows, from up to before i, have the key of i? */
static bool is_double(const mw_arrow *arrow, uint32_t from, uint32_t i)
{
    while (from < i && arrow[from].key != arrow[i].key) from++;
    return from < i;
}

/* Each of those that go up finds its mate. Those that have none come to the front, so that among them two of one edge are
 * seen. Returns false where an edge has more than two halves, or two that both go up. */
static bool find_mates(mw_triangle *tri, mw_arrow *arrow, const uint32_t *slot, const mw_bunch *b, mw_links *links)
{
    uint32_t end = b->next[1], single = b->middle;
    for (uint32_t i = b->middle; i < end; i++) {
        uint32_t j = slot[slot_of(arrow[i].key)];
        while (MW_UNLIKELY(arrow[j].key != arrow[i].key) && j >= b->from) j = arrow[j].next;
        if (MW_LIKELY(j >= b->from)) {
            uint32_t *mates = link_of(tri, arrow[j].half);
            if (MW_UNLIKELY(*mates != MW_NONE)) return false;
            *mates = arrow[i].half;
            *link_of(tri, arrow[i].half) = arrow[j].half;
        } else {
            mw_arrow alone = arrow[i];
            arrow[i] = arrow[single];
            arrow[single] = alone;
            if (is_double(arrow, b->middle, single++)) return false;
        }
    }
    links->linked += 2 * (uint64_t)(end - single);
    return true;
}

/* Part the bunch's halves by their lower vertices: those of vertex i of the bunch go to half[first[i]] and before half[first[i + 1]]. Whatever
 * links they have are forgotten. */
static void part_bunch(mw_triangle *tri, const mw_arrow *arrow, uint32_t n, mw_half_edge *half, uint32_t *first)
{
    uint32_t next[BUNCH] = {0}, sum = 0;
    for (uint32_t i = 0; i < n; i++) next[(arrow[i].key >> 32) % BUNCH]++;
    for (uint32_t v = 0; v < BUNCH; v++) {
        first[v] = sum;
        sum += next[v];
        next[v] = first[v];
    }
    first[BUNCH] = sum;
    for (uint32_t i = 0; i < n; i++) {
        *link_of(tri, arrow[i].half) = MW_NONE;
        half[next[(arrow[i].key >> 32) % BUNCH]++] = (mw_half_edge){(uint32_t)arrow[i].key, arrow[i].half};
    }
}

/* Whatever they are, and whether some are linked already. */
static bool match_each(mw_triangle *tri, const mw_arrow *arrow, const mw_bunch *b, mw_links *links)
{
    uint32_t n = b->next[1] - b->from, first[BUNCH + 1];
    mw_half_edge *half = mw__alloc(n, sizeof *half);
    if (!half) return false;
    part_bunch(tri, arrow + b->from, n, half, first);
    bool done = true;
    for (uint32_t v = 0; v < BUNCH && done; v++) done = mw__match(tri, half + first[v], first[v + 1] - first[v], links);
    free(half);
    return done;
}

static bool match_bunch(mw_triangle *tri, const mw_link_room *room, const mw_bunch *b, mw_links *links)
{
    mw_arrow *arrow = room->arrow;
    bool simple =
        b->next[1] - b->from <= MOST && enter(arrow, room->slot, b) && find_mates(tri, arrow, room->slot, b, links);
    return simple || match_each(tri, arrow, b, links);
}

/* --- all --- */

static bool make_room(mw_link_room *room, size_t arrows, size_t bunches)
{
    if (room->arrows < arrows) {
        free(room->arrow);
        room->arrows = arrows + arrows / 4;
        room->arrow = mw__alloc_lines(room->arrows, sizeof *room->arrow);
        if (!room->arrow) room->arrows = 0;
    }
    if (room->bunches < bunches) {
        free(room->bunch);
        room->bunches = bunches;
        room->bunch = mw__alloc_lines(room->bunches, sizeof *room->bunch);
        if (!room->bunch) room->bunches = 0;
    }
    if (!room->slot) room->slot = mw__alloc_lines((size_t)1 << SLOT_BITS, sizeof *room->slot);
    return room->arrow && room->bunch && room->slot;
}

bool mw__link_part(mw_triangle *tri, mw_part part, mw_strays strays, mw_link_room *room, mw_links *links)
{
    uint32_t bunches = (part.size >> BUNCH_SHIFT) + 1;
    size_t arrows = 3 * (size_t)(part.end - part.first) + strays.count + 1;
    if (!make_room(room, arrows, bunches)) return false;
    memset(room->bunch, 0, bunches * sizeof *room->bunch);
    memset(room->slot, 0, sizeof *room->slot << SLOT_BITS);
    room->arrow[0] = (mw_arrow){0};
    count(tri, part, strays, room->bunch);
    add_up(part, bunches, room->bunch);
    fill(tri, part, strays, room->bunch, room->arrow);
    bool done = true;
    for (uint32_t i = 0; i < bunches && done; i++) done = match_bunch(tri, room, &room->bunch[i], links);
    return done;
}

void mw__link_room_release(mw_link_room *room)
{
    free(room->arrow);
    free(room->bunch);
    free(room->slot);
}
