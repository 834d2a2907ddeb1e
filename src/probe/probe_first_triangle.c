/* probe_first_triangle.c - the first triangle of a walk [thesis App. G, Alg. 1]: of k random
 * triangles whose fronts m points at, the nearest to q. The distance is that of one vertex,
 * rounded. A farther first triangle costs steps, but never changes the answer. Departure from the
 * printed pseudocode: if m points at none of the k, at most 8 k more are tried, not as many as
 * needed, since there may be none. */
#include "base/random.h"
#include "probe/plane_walk.h"

enum { PATIENCE = 8 };

bool mw__probe_faces(const mw_probe_search *search, uint32_t triangle, mw_probe_counters *work)
{
    const double *a = mw__surface_corner(search->surface, triangle, 0);
    const double *b = mw__surface_corner(search->surface, triangle, 1);
    const double *c = mw__surface_corner(search->surface, triangle, 2);
    if (work) work->tests++;
    return mw__corners_finite(search->surface, triangle) && mw__facing(search->line.m, a, b, c) < 0;
}

static double squared_distance(const double a[3], const double b[3])
{
    double x = a[0] - b[0], y = a[1] - b[1], z = a[2] - b[2];
    return x * x + y * y + z * z;
}

uint32_t mw__probe_first_triangle(const mw_probe_search *search, uint64_t *random,
                                  mw_probe_counters *work)
{
    const mw_surface *surface = search->surface;
    uint32_t best = MW_NONE;
    double best2 = 0;
    uint64_t looks = 0, k = search->samples, most = k + PATIENCE * k;
    for (; looks < k || (best == MW_NONE && looks < most); looks++) {
        uint32_t t = mw__random_below(random, surface->tri_count);
        double d2 = squared_distance(mw__surface_corner(surface, t, 0), search->line.q);
        if ((best != MW_NONE && !(d2 < best2)) || !mw__probe_faces(search, t, work)) continue;
        best = t;
        best2 = d2;
        if (!search->nearest) {
            looks++;
            break;
        }
    }
    if (work) work->samples += looks;
    return best;
}
