/* curve.h - first tiles by the order in which the tiles lie in memory. Private. */
#ifndef MW_SRC_START_CURVE_H
#define MW_SRC_START_CURVE_H

#include "base/hilbert.h"
#include "tiling/tiling.h"
#include "start/grid.h"

typedef struct mw_curve {
    mw_hilbert hilbert;
    mw_key
        /* tiles by ascending keys; the first has key 0, the last the largest key, which no query
         * has */
        *sample;
    uint32_t *from; /* from[b]: how many samples have keys below b << shift, at least 1 */
    uint32_t count, shift;
    /* so many tiles at most lie between samples that are neighbours on the curve and in memory */
    uint32_t near;
    bool regular; /* nearly all neighbours on the curve are so near in memory */
    mw_grid
        /* of a guide: its cells name a tile where few are; MW_NONE: ask the curve. Without it,
         * tile is NULL */
        sparse;
} mw_curve;

/* Sample about `samples` tiles (0: MW_CURVE_STRIDE) of a tiling with the extent low..high. Returns
 * false when out of memory, or cancelled. A stage that takes the present part of the job. */
#define MW_CURVE_STRIDE 32 /* one of so many tiles */
bool mw__curve_create(mw_curve *curve, const mw_tiling *tiling, const double low[2],
                      const double high[2], uint32_t samples, mw_job *job);
void mw__curve_release(mw_curve *curve);
size_t mw__curve_bytes(const mw_curve *curve);

/* The first tile for q whose key is given. */
static MW_INLINE uint32_t mw__curve_at(const mw_curve *curve, uint32_t key)
{
    uint32_t bucket = key >> curve->shift;
    const mw_key *s = &curve->sample[curve->from[bucket] - 1]; /* not behind q */
    for (uint32_t n = curve->from[bucket + 1] - curve->from[bucket]; n > 0;) {
        uint32_t half = (n + 1) / 2;
        s = s[half].key <= key ? s + half : s;
        n -= half;
    }
    /* a huge number where the next one comes before in memory */
    uint32_t tiles = s[1].item - s[0].item;
    if (MW_UNLIKELY(tiles > curve->near)) return s->item;
    return s->item +
           (uint32_t)((uint64_t)tiles * (key - s->key) / ((uint64_t)(s[1].key - s->key) + 1));
}

static MW_INLINE uint32_t mw__curve_first(const mw_curve *curve, mw_point q)
{
    if (curve->sparse.tile) {
        uint32_t t = mw__grid_first(&curve->sparse, q);
        if (t != MW_NONE) return t;
    }
    return mw__curve_at(curve, mw__hilbert_key(&curve->hilbert, q.x, q.y));
}

#endif
