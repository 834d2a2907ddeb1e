#include "cli/lines/contour_bands.h"

#include <math.h>
#include <stdlib.h>

/* How many levels are at most as high as a value, in levels[low .. high - 1] and before. */
static uint32_t bands_search(const double *levels, uint32_t low, uint32_t high, double value)
{
    while (low < high) {
        uint32_t middle = low + (high - low) / 2;
        if (levels[middle] <= value)
            low = middle + 1;
        else
            high = middle;
    }
    return low;
}

/* The same among all levels. Most lists of levels are evenly spaced: the guess is right then, or
 * next to it. */
static uint32_t bands_find(const double *levels, uint32_t count, double scale, double value)
{
    if (!(value >= levels[0])) return 0;
    if (value >= levels[count - 1]) return count;
    double steps = (value - levels[0]) * scale;
    uint32_t guess = steps < count - 1 ? (uint32_t)steps + 1 : count - 1; /* also of NaN */
    if (levels[guess] <= value) return bands_search(levels, guess + 1, count, value);
    return levels[guess - 1] <= value ? guess : bands_search(levels, 0, guess - 1, value);
}

uint32_t *contour_bands_of_values(const double *values, size_t n, const double *levels,
                                  size_t level_count)
{
    uint32_t count = (uint32_t)level_count;
    uint32_t *band = malloc((n + 1) * sizeof *band);
    double scale = count > 1 ? (count - 1) / (levels[count - 1] - levels[0]) : 0;
    if (!isfinite(scale)) scale = 0;
    for (size_t v = 0; band && v < n; v++)
        band[v] = isnan(values[v]) ? CONTOUR_NO_BAND
                  : count == 0     ? 0
                                   : bands_find(levels, count, scale, values[v]);
    return band;
}
