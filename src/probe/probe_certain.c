/* probe_certain.c - certain probes: the nearest triangle of all that a probe touches. */
#include "probe/ray.h"

uint32_t mw__probe_certain(const mw_prober *prober, const mw_line *line, double max_distance,
                           uint32_t seed, mw_probe_counters *counters)
{
    mw_ray_query ray = {.line = *line,
                        .faces = MW_PROBE_FRONT,
                        .greatest = max_distance > 0 ? max_distance : INFINITY};
    mw_ray_search search;
    mw__ray_search_begin(&search, prober, &ray, mw__ray_found_nearest, NULL);
    if (seed != MW_NONE) mw__ray_search_guess(&search, seed);
    mw__ray_search_run(&search);
    if (counters) mw__ray_search_count(&search, counters);
    return search.nearest;
}
