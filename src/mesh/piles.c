/* piles.c - triangles of the caller's arrays to piles. */
#include "mesh/piles.h"

#include "mesh/arrays.h"

#include <stdlib.h>

static size_t share_begin(const mw_piles *p, uint32_t stacker)
{
    return p->triangle_count * stacker / p->stackers;
}

/* The blocks of a stacker: each of its piles may have one that is not full. */
static size_t first_block(const mw_piles *p, uint32_t stacker)
{
    return share_begin(p, stacker) / MW_PILE_BLOCK + (size_t)stacker * (p->ranges + 1);
}

size_t mw__piles_room(const mw_piles *piles)
{
    return first_block(piles, piles->stackers) * MW_PILE_BLOCK;
}

/* --- reading the arrays --- */

typedef struct source {
    const mw_mesh *mesh;
    const mw_arrays *arrays;
    bool all_finite;
} source;

/* Triangles from number t on. Returns false where not all their numbers are those of vertices. Places are looked up without a
 * jump between, as many at a time as there are. */
static MW_INLINE bool translate_as(const source *s, mw_integer_type type, size_t t, uint32_t count, mw_corners *out)
{
    const mw_arrays arrays = {.triangles = s->arrays->triangles, .integer_type = type};
    const uint32_t *place = s->mesh->vertex_place, n = s->mesh->point_count;
    bool right = true;
    for (uint32_t i = 0; i < count; i++) {
        for (uint32_t k = 0; k < 3; k++) {
            uint32_t given = mw__index_at(&arrays, 3 * (t + i) + k);
            right &= given < n;
            out[i].v[k] = place[given < n ? given : 0];
        }
        out[i].user = (uint32_t)t + i;
    }
    return right;
}

static bool translate(const source *s, size_t t, uint32_t count, mw_corners *out)
{
    switch (s->arrays->integer_type) {
    case MW_INT32: return translate_as(s, MW_INT32, t, count, out);
    case MW_INT64: return translate_as(s, MW_INT64, t, count, out);
    default: return translate_as(s, MW_UINT32, t, count, out);
    }
}

/* Looks at the arrays again. */
static bool is_usable(const source *s, size_t t)
{
    const mw_mesh *mesh = s->mesh;
    for (size_t k = 0; k < 3; k++) {
        uint32_t v = mw__index_at(s->arrays, 3 * t + k);
        if (v >= mesh->point_count || v == mw__index_at(s->arrays, 3 * t + (k + 1) % 3)) return false;
        if (!mw__is_finite(mesh->point[mesh->vertex_place[v]])) return false;
    }
    return true;
}

/* --- piling up --- */

typedef struct stacker {
    mw_corners *at;
    mw_pile *pile;
    uint32_t *following, free; /* the next block that nobody has */
} stacker;

static MW_INLINE void put(stacker *s, uint32_t range, const mw_corners *corners)
{
    mw_pile *pile = &s->pile[range];
    if (MW_UNLIKELY(pile->next % MW_PILE_BLOCK == 0)) {
        uint32_t block = s->free++;
        if (pile->blocks++)
            s->following[pile->next / MW_PILE_BLOCK - 1] = block;
        else
            pile->first = block;
        pile->next = block * MW_PILE_BLOCK;
    }
    s->at[pile->next++] = *corners;
}

/* Returns the first triangle of the share that is not usable, or MW_NONE. */
static uint32_t pile_share(const mw_piles *piles, const source *from, uint32_t share)
{
    enum { BATCH = 64 };
    mw_corners batch[BATCH];
    stacker s = {piles->at, piles->pile + (size_t)share * piles->ranges, piles->following,
                 (uint32_t)first_block(piles, share)};
    size_t end = share_begin(piles, share + 1);
    for (size_t t = share_begin(piles, share), count; t < end; t += count) {
        count = end - t < BATCH ? end - t : BATCH;
        bool good = translate(from, t, (uint32_t)count, batch) && from->all_finite;
        for (uint32_t i = 0; i < count; i++) {
            const uint32_t *v = batch[i].v;
            bool doubtful = !good | (v[0] == v[1]) | (v[1] == v[2]) | (v[2] == v[0]);
            if (MW_UNLIKELY(doubtful) && !is_usable(from, t + i)) return (uint32_t)t + i;
            put(&s, (uint32_t)((uint64_t)mw__lowest(v[0], v[1], v[2]) >> piles->shift), &batch[i]);
        }
    }
    return MW_NONE;
}

bool mw__pile_up(mw_piles *piles, const mw_mesh *mesh, const mw_arrays *arrays, bool all_finite, uint32_t *bad)
{
    *bad = MW_NONE;
    piles->following = mw__alloc(first_block(piles, piles->stackers), sizeof *piles->following);
    piles->pile = mw__calloc((size_t)piles->stackers * piles->ranges, sizeof *piles->pile);
    if (!piles->following || !piles->pile) return false;
    const source s = {mesh, arrays, all_finite};
    int team = (int)piles->stackers;
    (void)team; /* unused without OpenMP */
#ifdef _OPENMP
#pragma omp parallel for schedule(static) num_threads(team) if (team > 1)
#endif
    for (uint32_t i = 0; i < piles->stackers; i++) {
        uint32_t found = pile_share(piles, &s, i);
        if (found == MW_NONE) continue;
#ifdef _OPENMP
#pragma omp critical(mw_piles)
#endif
        if (found < *bad) *bad = found;
    }
    return true;
}

void mw__piles_release(mw_piles *piles)
{
    free(piles->following);
    free(piles->pile);
}

/* --- reading piles --- */

static uint32_t size_of(const mw_pile *pile)
{
    if (pile->blocks == 0) return 0;
    return (pile->blocks - 1) * MW_PILE_BLOCK + (pile->next - 1) % MW_PILE_BLOCK + 1;
}

static const mw_pile *pile_of(const mw_piles *piles, uint32_t share, uint32_t range)
{
    return &piles->pile[(size_t)share * piles->ranges + range];
}

uint32_t mw__piles_count(const mw_piles *piles, uint32_t range)
{
    uint32_t sum = 0;
    for (uint32_t s = 0; s < piles->stackers; s++) sum += size_of(pile_of(piles, s, range));
    return sum;
}

const mw_corners *mw__read_block(mw_pile_reader *r, uint32_t *count)
{
    enum { LINE = 64 / sizeof(mw_corners) };
    while (r->left == 0) {
        if (r->stacker == r->piles->stackers) return NULL;
        const mw_pile *pile = pile_of(r->piles, r->stacker++, r->range);
        r->left = size_of(pile);
        r->block = pile->first;
    }
    const mw_corners *here = r->piles->at + (size_t)r->block * MW_PILE_BLOCK;
    *count = r->left < MW_PILE_BLOCK ? r->left : MW_PILE_BLOCK;
    r->left -= *count;
    if (r->left == 0) return here;
    r->block = r->piles->following[r->block];
    const mw_corners *after = r->piles->at + (size_t)r->block * MW_PILE_BLOCK;
    for (uint32_t i = 0; i < MW_PILE_BLOCK; i += LINE) __builtin_prefetch(&after[i]);
    return here;
}
