/* sorted.c - queries in order along a Hilbert curve, so that each can begin where the one before
 * ended [thesis App. E, sec. 4.1; Amenta, Choi, Rote 2003 for the order]. */
#include "start/start.h"

void mw__sort_queries(const double *points, size_t n, size_t stride, const double low[2],
                      const double high[2], mw_key *order, mw_key *scratch)
{
    /* The extent of the queries within that of the mesh: a stray query must not make the cells
     * coarse. */
    double from[2] = {high[0], high[1]}, to[2] = {low[0], low[1]};
    for (size_t i = 0; i < n; i++)
        for (size_t k = 0; k < 2; k++) {
            double value = points[i * stride + k];
            if (value < from[k]) from[k] = value;
            if (value > to[k]) to[k] = value;
        }
    for (size_t k = 0; k < 2; k++) {
        if (from[k] < low[k]) from[k] = low[k];
        if (to[k] > high[k]) to[k] = high[k];
    }
    mw_hilbert hilbert = mw__hilbert(from, to);
    for (size_t i = 0; i < n; i++)
        order[i] = (mw_key){mw__hilbert_key(&hilbert, points[i * stride], points[i * stride + 1]),
                            (uint32_t)i};
    mw__sort_keys(order, scratch, n);
}
