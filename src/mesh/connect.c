/* connect.c - neighbours of triangles in O(n): half-edges are gathered at their lower vertex by a counting sort; at one
 * vertex, the two halves of an edge find each other by their upper vertex.
 *
 * A mesh that is laid out comes in parts, each a range of vertices and the triangles whose lowest vertex it holds. What a
 * part needs then stays in cache, and threads take parts. Of a triangle, two edges have the lowest vertex; the third may
 * have its lower vertex in another part, and is passed on to that one: a stray. */
#include "base/threads.h"
#include "mesh/layout.h"
#include "mesh/mesh.h"

#include <stdlib.h>
#include <string.h>

typedef struct connection {
    mw_triangle *tri;
    uint32_t vertex_count;
    const mw_parts *parts;
    uint32_t *stray_first; /* the strays from, later those for part p are stray[stray_first[p]] to before the next */
    uint32_t *stray;
    int team;
    uint32_t extra; /* see mw__connect */
} connection;

static MW_INLINE uint32_t lower(const mw_triangle *t, uint32_t e)
{
    return t->v[e] < t->v[e + 1] ? t->v[e] : t->v[e + 1];
}

static MW_INLINE uint32_t upper(const mw_triangle *t, uint32_t e)
{
    return t->v[e] < t->v[e + 1] ? t->v[e + 1] : t->v[e];
}

/* --- matching --- */

static MW_INLINE uint32_t *link_of(connection *c, uint32_t half)
{
    return &c->tri[mw__link_triangle(half)].link[mw__link_edge(half)];
}

static MW_INLINE void join(connection *c, uint32_t a, uint32_t b)
{
    *link_of(c, a) = b;
    *link_of(c, b) = a;
}

/* A half-edge as its lower vertex sees it. */
typedef struct half_edge {
    uint32_t to, half; /* upper vertex; 4 * triangle + edge */
} half_edge;

enum { FEW = 32 }; /* half-edges at a vertex that are compared each with each */

/* Join the halves of one lower vertex by comparing all. False, and nothing done, where an edge has more than two. */
static MW_INLINE bool match_few(connection *c, const half_edge *half, uint32_t count)
{
    uint32_t mate[FEW];
    for (uint32_t i = 0; i < count; i++) {
        mate[i] = MW_NONE;
        for (uint32_t j = 0; j < i; j++) {
            if (half[j].to != half[i].to) continue;
            if (mate[j] != MW_NONE || mate[i] != MW_NONE) return false;
            mate[i] = j;
            mate[j] = i;
        }
    }
    for (uint32_t i = 0; i < count; i++)
        if (mate[i] < i) join(c, half[i].half, half[mate[i]].half);
    return true;
}

typedef struct keyed_half {
    uint64_t rank; /* by the user's numbers */
    uint32_t to, half;
} keyed_half;

static int compare_halves(const void *left, const void *right)
{
    const keyed_half *a = left, *b = right;
    if (a->to != b->to) return a->to < b->to ? -1 : 1;
    return a->rank < b->rank ? -1 : a->rank > b->rank;
}

static uint64_t rank_of(const connection *c, uint32_t half)
{
    return (uint64_t)(c->tri[mw__link_triangle(half)].user & MW_USER_MASK) << 2 | mw__link_edge(half);
}

static void note_extra(const connection *c, uint32_t half, uint32_t *extra)
{
    if (*extra == MW_NONE || rank_of(c, half) < rank_of(c, *extra)) *extra = half;
}

/* The same for many, or for edges that more than two share: the first two in the user's order are joined. */
static bool match_many(connection *c, const half_edge *half, uint32_t count, uint32_t *extra)
{
    keyed_half *keyed = mw__alloc(count, sizeof *keyed);
    if (!keyed) return false;
    for (uint32_t i = 0; i < count; i++) keyed[i] = (keyed_half){rank_of(c, half[i].half), half[i].to, half[i].half};
    qsort(keyed, count, sizeof *keyed, compare_halves);
    for (uint32_t i = 0, next; i < count; i = next) {
        for (next = i + 1; next < count && keyed[next].to == keyed[i].to;) next++;
        if (next - i > 1) join(c, keyed[i].half, keyed[i + 1].half);
        for (uint32_t j = i + 2; j < next; j++) note_extra(c, keyed[j].half, extra);
    }
    free(keyed);
    return true;
}

/* --- strays --- */

/* A triangle of a mesh that is laid out has three vertices. */
static MW_INLINE bool is_sound(const connection *c, uint32_t t)
{
    return c->parts->count > 1 || mw__has_three_vertices(&c->tri[t]);
}

static MW_INLINE bool belongs(const connection *c, uint32_t p, uint32_t t, uint32_t e)
{
    return mw__part_of(c->parts, lower(&c->tri[t], e)) == p;
}

/* The half-edges of part p whose lower vertex is in another part: count them, or store them too. */
static uint32_t find_strays(const connection *c, uint32_t p, uint32_t *out)
{
    uint32_t count = 0;
    for (uint32_t t = c->parts->first[p]; t < c->parts->first[p + 1]; t++)
        for (uint32_t e = 0; e < 3 && is_sound(c, t); e++) {
            if (belongs(c, p, t, e)) continue;
            if (out) out[count] = mw__link(t, e);
            count++;
        }
    return count;
}

/* Turn counts into where each part begins; returns the sum. */
static uint32_t add_up(uint32_t *count, uint32_t parts)
{
    uint32_t sum = 0;
    for (uint32_t p = 0; p <= parts; p++) {
        uint32_t here = p < parts ? count[p] : 0;
        count[p] = sum;
        sum += here;
    }
    return sum;
}

static uint32_t part_of(const connection *c, uint32_t half)
{
    return mw__part_of(c->parts, lower(&c->tri[mw__link_triangle(half)], mw__link_edge(half)));
}

/* Hand the strays to the parts that want them. */
static bool pass_on(connection *c, uint32_t count)
{
    uint32_t parts = c->parts->count, *sorted = mw__alloc(count, sizeof *sorted);
    if (!sorted) return false;
    memset(c->stray_first, 0, (parts + 1) * sizeof *c->stray_first);
    for (uint32_t i = 0; i < count; i++) c->stray_first[part_of(c, c->stray[i]) + 1]++;
    for (uint32_t p = 0; p < parts; p++) c->stray_first[p + 1] += c->stray_first[p];
    for (uint32_t i = count; i-- > 0;) sorted[--c->stray_first[part_of(c, c->stray[i]) + 1]] = c->stray[i];
    memmove(c->stray_first, c->stray_first + 1, parts * sizeof *c->stray_first);
    c->stray_first[parts] = count;
    free(c->stray);
    c->stray = sorted;
    return true;
}

static bool exchange_strays(connection *c)
{
    int64_t parts = c->parts->count;
    c->stray_first = mw__calloc((size_t)parts + 1, sizeof *c->stray_first);
    if (!c->stray_first) return false;
    if (parts == 1) return true;
#ifdef _OPENMP
#pragma omp parallel for schedule(static) num_threads(c->team) if (c->team > 1)
#endif
    for (int64_t p = 0; p < parts; p++) c->stray_first[p] = find_strays(c, (uint32_t)p, NULL);
    uint32_t count = add_up(c->stray_first, c->parts->count);
    c->stray = mw__alloc(count, sizeof *c->stray);
    if (!c->stray) return false;
#ifdef _OPENMP
#pragma omp parallel for schedule(static) num_threads(c->team) if (c->team > 1)
#endif
    for (int64_t p = 0; p < parts; p++) find_strays(c, (uint32_t)p, c->stray + c->stray_first[p]);
    return pass_on(c, count);
}

/* --- one part --- */

/* Room for the half-edges of one part: those of its i-th vertex are half[first[i]] to before half[first[i + 1]]. */
typedef struct bench {
    uint32_t *first;
    half_edge *half;
} bench;

static MW_INLINE void put(const connection *c, bench b, uint32_t base, uint32_t t, uint32_t e)
{
    const mw_triangle *tri = &c->tri[t];
    b.half[--b.first[lower(tri, e) - base]] = (half_edge){upper(tri, e), mw__link(t, e)};
}

static void gather(const connection *c, uint32_t p, uint32_t vertices, bench b)
{
    uint32_t base = mw__part_begin(c->parts, p), sum = 0, first = c->parts->first[p], end = c->parts->first[p + 1];
    memset(b.first, 0, ((size_t)vertices + 1) * sizeof *b.first);
    for (uint32_t t = first; t < end; t++)
        for (uint32_t e = 0; e < 3 && is_sound(c, t); e++)
            if (belongs(c, p, t, e)) b.first[lower(&c->tri[t], e) - base]++;
    for (uint32_t i = c->stray_first[p]; i < c->stray_first[p + 1]; i++)
        b.first[lower(&c->tri[mw__link_triangle(c->stray[i])], mw__link_edge(c->stray[i])) - base]++;
    for (uint32_t i = 0; i <= vertices; i++) b.first[i] = sum += b.first[i];
    for (uint32_t i = c->stray_first[p]; i < c->stray_first[p + 1]; i++)
        put(c, b, base, mw__link_triangle(c->stray[i]), mw__link_edge(c->stray[i]));
    for (uint32_t t = first; t < end; t++)
        for (uint32_t e = 0; e < 3 && is_sound(c, t); e++)
            if (belongs(c, p, t, e)) put(c, b, base, t, e);
}

static bool connect_part(connection *c, uint32_t p, bench b, uint32_t *extra)
{
    uint32_t vertices = mw__part_size(c->parts, p, c->vertex_count);
    gather(c, p, vertices, b);
    bool done = true;
    for (uint32_t i = 0; i < vertices && done; i++) {
        const half_edge *half = b.half + b.first[i];
        uint32_t count = b.first[i + 1] - b.first[i];
        if (count > FEW || !match_few(c, half, count)) done = match_many(c, half, count, extra);
    }
    return done;
}

/* The most vertices and half-edges that a part has. */
static void find_most(const connection *c, size_t *vertices, size_t *halves)
{
    *vertices = mw__part_size(c->parts, 0, c->vertex_count);
    *halves = 0;
    for (uint32_t p = 0; p < c->parts->count; p++) {
        size_t most =
            3 * ((size_t)c->parts->first[p + 1] - c->parts->first[p]) + c->stray_first[p + 1] - c->stray_first[p];
        if (most > *halves) *halves = most;
    }
}

static bool connect_parts(connection *c)
{
    size_t vertices, halves;
    find_most(c, &vertices, &halves);
    bool done = true;
#ifdef _OPENMP
#pragma omp parallel num_threads(c->team) if (c->team > 1)
#endif
    {
        bench b = {mw__alloc(vertices + 1, sizeof *b.first), mw__alloc(halves, sizeof *b.half)};
        bool mine = b.first && b.half;
        uint32_t extra = MW_NONE;
#ifdef _OPENMP
#pragma omp for schedule(dynamic)
#endif
        for (int64_t p = 0; p < (int64_t)c->parts->count; p++) mine = mine && connect_part(c, (uint32_t)p, b, &extra);
        free(b.first);
        free(b.half);
#ifdef _OPENMP
#pragma omp critical(mw_connect)
#endif
        {
            done = done && mine;
            if (extra != MW_NONE) note_extra(c, extra, &c->extra);
        }
    }
    return done;
}

bool mw__connect(mw_triangle *tri, uint32_t n, uint32_t vertex_count, const mw_parts *parts, uint32_t threads,
                 uint32_t *extra)
{
    uint32_t all[2] = {0, n};
    mw_parts one = {.shift = 32, .count = 1, .first = all};
    connection c = {.tri = tri, .vertex_count = vertex_count, .parts = parts ? parts : &one, .extra = MW_NONE};
    c.team = mw__team(threads, c.parts->count);
    bool done = exchange_strays(&c) && connect_parts(&c);
    free(c.stray_first);
    free(c.stray);
    if (extra) *extra = c.extra;
    return done;
}
