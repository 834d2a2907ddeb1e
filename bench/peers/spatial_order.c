/* The one file of bench/peers with a private header of the library: what is measured is the
 * library's own sort, and no public function sorts points. It is built with the peers only. */
#include "bench/peers/spatial_order.h"
#include "base/hilbert.h"

#include <math.h>
#include <stdlib.h>

static void point_extent(const double *points, size_t n, double low[2], double high[2])
{
    for (size_t k = 0; k < 2; k++) {
        low[k] = INFINITY;
        high[k] = -INFINITY;
    }
    for (size_t i = 0; i < n; i++)
        for (size_t k = 0; k < 2; k++) {
            low[k] = fmin(low[k], points[2 * i + k]);
            high[k] = fmax(high[k], points[2 * i + k]);
        }
}

bool spatial_order(const double *points, size_t n, uint32_t *order)
{
    double low[2], high[2];
    mw_key *keys = malloc(2 * n * sizeof *keys);
    if (!keys) return false;
    point_extent(points, n, low, high);
    mw_hilbert curve = mw__hilbert(low, high);
    for (size_t i = 0; i < n; i++)
        keys[i] = (mw_key){mw__hilbert_key(&curve, points[2 * i], points[2 * i + 1]), (uint32_t)i};
    mw__sort_keys(keys, keys + n, n);
    for (size_t i = 0; i < n; i++) order[i] = keys[i].item;
    free(keys);
    return true;
}
