/* sample.c - jump and walk: the nearest of a few random tiles [Muecke, Saias, Zhu 1996]. Nearness
 * is that of one vertex and is rounded: a farther first tile costs steps, never the answer. */
#include "base/random.h"
#include "start/start.h"

uint32_t mw__start_sample(const mw_tiling *tiling, mw_point q, uint32_t count, uint32_t rival,
                          uint64_t *random)
{
    uint32_t best = rival != MW_NONE ? rival : mw__random_below(random, tiling->tri_count);
    double best2 = mw__distance2(tiling->point[tiling->tri[best].v[0]], q);
    for (uint32_t i = rival == MW_NONE; i < count; i++) {
        uint32_t t = mw__random_below(random, tiling->tri_count);
        double d2 = mw__distance2(tiling->point[tiling->tri[t].v[0]], q);
        if (d2 < best2) {
            best2 = d2;
            best = t;
        }
    }
    return best;
}

/* At most the number of tiles: a query must end soon. */
uint32_t mw__sample_count(const mw_tiling *tiling, uint32_t sample)
{
    const double vertices = tiling->point_count;
    if (sample == MW_SAMPLE_CUBE_ROOT_OF_VERTICES) sample = (uint32_t)lround(cbrt(vertices));
    if (sample == MW_SAMPLE_FOURTH_ROOT_OF_VERTICES)
        sample = (uint32_t)lround(2 * sqrt(sqrt(vertices)));
    return sample < tiling->tri_count ? sample : tiling->tri_count;
}
