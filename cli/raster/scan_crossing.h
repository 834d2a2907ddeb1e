/* scan_crossing.h - the pixels between two sides of a triangle, for many rows at a time, in
 * doubles. */
#ifndef MW_CLI_RASTER_SCAN_CROSSING_H
#define MW_CLI_RASTER_SCAN_CROSSING_H

#include "cli/raster/scan_vector.h"

/* So many rows at a time; northings are read in fours. */
enum { SCAN_ROWS = 32 };

/* A side that crosses row y at the column start + (y - from) * slope, between centres. */
typedef struct scan_crossing {
    double from, start, slope;
    double margin; /* a centre so many columns from there is sure; 1: none is */
} scan_crossing;

/* A side that is too flat, or too far away, for doubles is never sure. */
static SCAN_INLINE scan_crossing scan_crossing_make(double from, double start, double slope,
                                                    double margin)
{
    return margin < 0x1p-4 ? (scan_crossing){from, start, slope, margin}
                           : (scan_crossing){.margin = 1};
}

/* The long side, and the other one: `upper` in rows above the middle corner, `lower` below it. Rows
 * between the northings `middle` are not sure. */
typedef struct scan_crossings {
    scan_crossing across, upper, lower;
    double middle[2];
    double columns;
    /* Of each row: the first column whose centre lies east of either side, 0 .. columns. */
    int32_t on_across[SCAN_ROWS], on_other[SCAN_ROWS];
    int64_t sure[SCAN_ROWS]; /* 0: no */
} scan_crossings;

/* The first columns east of crossings at these columns; *sure loses those whose crossing has a
 * centre within the margin. */
static SCAN_INLINE void scan_columns(const scan_doubles *crossing, double columns,
                                     const scan_doubles *margin, int32_t *first, scan_mask *sure)
{
    const scan_doubles least = {0.5, 0.5, 0.5, 0.5}, most = least + columns;
    scan_doubles at = *crossing + 1;
    scan_mask within = at > least;
    scan_choose(&within, &at, &least);
    within = at < most;
    scan_choose(&within, &at, &most);
    const scan_ints whole = __builtin_convertvector(at, scan_ints);
    const scan_doubles part = at - __builtin_convertvector(whole, scan_doubles) - 0.5;
    *(scan_ints *)first = whole;
    *sure &= part + *margin < 0.5;
    *sure &= *margin - part < 0.5;
}

/* At most SCAN_ROWS rows. */
static SCAN_INLINE void scan_crossings_find(scan_crossings *c, const double *rows, int64_t count)
{
    const scan_crossing across = c->across, upper = c->upper, lower = c->lower;
    const scan_doubles zero = {0, 0, 0, 0}, across_margin = zero + across.margin;
    const scan_doubles low[4] = {zero + lower.from, zero + lower.start, zero + lower.slope,
                                 zero + lower.margin};
    for (int64_t k = 0; k < count; k += SCAN_FOUR) {
        const scan_doubles y = *(const scan_doubles *)(rows + k);
        const scan_mask up = y > c->middle[1];
        scan_mask sure = up | (y < c->middle[0]);
        scan_doubles side[4] = {zero + upper.from, zero + upper.start, zero + upper.slope,
                                zero + upper.margin};
        for (int i = 0; i < 4; i++) scan_choose(&up, &side[i], &low[i]);
        scan_doubles at = across.start + (y - across.from) * across.slope;
        scan_columns(&at, c->columns, &across_margin, c->on_across + k, &sure);
        at = side[1] + (y - side[0]) * side[2];
        scan_columns(&at, c->columns, &side[3], c->on_other + k, &sure);
        *(scan_mask *)(c->sure + k) = sure;
    }
}

#endif
