/* lmt_polygon.c - triangulation of a polygon with chords of least total length [Gilbert 1979;
 * Klincsek 1980].
 *
 * Corners are numbered along the border, which may touch itself: then one vertex is several
 * corners, and a chord is told by its corners. The inside of the polygon is a disc all the same,
 * and three chords, or pieces of the border, between three corners are the sides of a triangle in
 * it. The least weight beyond a chord ij is found from those beyond im and mj, least over m. Only
 * given chords count; with all that a polygon can have, the time is cubic.
 *
 * Chords are taken by falling i, then rising j, so im and mj come before ij. The results of the
 * chords from i are in a row, indexed by m; those of the chords to j in a list that grows with
 * falling m. */
#include "triangulate/kinds/lmt.h"

#include <math.h>
#include <stdlib.h>

typedef struct end {
    uint32_t low, apex;
    double weight; /* of the chord itself and of what is beyond it */
} end;

typedef struct chord_table {
    uint32_t corner_count;
    size_t *first_up;     /* per corner i: where its chords begin in `up`                      */
    uint32_t *up;         /* numbers of chords, by i, then j                                   */
    size_t *first_down;   /* per corner j: where its list begins in `down`                     */
    uint32_t *down_count; /* per corner j: the list's length so far                            */
    end *down;            /* by falling i                                                      */
    double *row;          /* per corner m: the weight of the chord im, INFINITY without one    */
} chord_table;

static void table_release(chord_table *t)
{
    free(t->first_up);
    free(t->up);
    free(t->first_down);
    free(t->down_count);
    free(t->down);
    free(t->row);
}

static void table_prefix_sums(size_t *first, uint32_t n)
{
    size_t sum = 0;
    for (uint32_t i = 0; i <= n; i++) first[i] = sum += first[i];
}

/* Chords in two rounds of counting sort: by j, then by i. */
static bool table_sort_chords(chord_table *t, const mw_lmt_face *p)
{
    uint32_t n = t->corner_count;
    uint32_t *by_high = mw__alloc(p->chord_count, sizeof *by_high);
    size_t *first = mw__calloc((size_t)n + 1, sizeof *first);
    bool done = by_high && first;
    if (done) {
        for (size_t c = 0; c < p->chord_count; c++) first[p->chord[c].high]++;
        table_prefix_sums(first, n);
        for (size_t c = p->chord_count; c-- > 0;) by_high[--first[p->chord[c].high]] = (uint32_t)c;
        for (size_t c = 0; c < p->chord_count; c++) t->first_up[p->chord[c].low]++;
        table_prefix_sums(t->first_up, n);
        for (size_t c = p->chord_count; c-- > 0;)
            t->up[--t->first_up[p->chord[by_high[c]].low]] = by_high[c];
    }
    free(by_high);
    free(first);
    return done;
}

static bool table_create(chord_table *t, const mw_lmt_face *p)
{
    uint32_t n = p->corner_count;
    *t = (chord_table){.corner_count = n};
    t->first_up = mw__calloc((size_t)n + 1, sizeof *t->first_up);
    t->first_down = mw__calloc((size_t)n + 1, sizeof *t->first_down);
    t->down_count = mw__calloc(n, sizeof *t->down_count);
    t->up = mw__alloc(p->chord_count, sizeof *t->up);
    t->down = mw__alloc(p->chord_count + n + 1, sizeof *t->down);
    t->row = mw__alloc(n, sizeof *t->row);
    if (!t->first_up || !t->first_down || !t->down_count || !t->up || !t->down || !t->row)
        return false;
    if (!table_sort_chords(t, p)) return false;
    /* to each corner: its chords, the border before it, and the border that closes the polygon */
    for (size_t c = 0; c < p->chord_count; c++) t->first_down[p->chord[c].high + 1]++;
    for (uint32_t j = 0; j < n; j++)
        t->first_down[j + 1] += t->first_down[j] + (j > 0) + (j == n - 1);
    for (uint32_t i = 0; i < n; i++) t->row[i] = INFINITY;
    return true;
}

static void chord_close(chord_table *t, uint32_t i, uint32_t j, double length)
{
    const end *list = &t->down[t->first_down[j]];
    end best = {i, MW_NONE, INFINITY};
    for (uint32_t k = 0; k < t->down_count[j]; k++) {
        double weight = t->row[list[k].low] + list[k].weight;
        if (weight < best.weight) {
            best.weight = weight;
            best.apex = list[k].low;
        }
    }
    if (best.apex == MW_NONE) return; /* in no triangulation */
    best.weight += length;
    t->row[j] = best.weight;
    t->down[t->first_down[j] + t->down_count[j]++] = best;
}

/* Returns false if the job is to stop. */
static bool table_fill(chord_table *t, const mw_lmt_face *p, mw_job *job)
{
    uint32_t n = t->corner_count;
    for (uint32_t i = n - 1; i-- > 0;) {
        if (!mw__job_step(job, n - i, n)) return false;
        t->row[i + 1] = 0;
        t->down[t->first_down[i + 1] + t->down_count[i + 1]++] = (end){i, MW_NONE, 0};
        for (size_t k = t->first_up[i]; k < t->first_up[i + 1]; k++)
            chord_close(t, i, p->chord[t->up[k]].high, p->chord[t->up[k]].length);
        if (i == 0) chord_close(t, 0, n - 1, 0);
        t->row[i + 1] = INFINITY;
        for (size_t k = t->first_up[i]; k < t->first_up[i + 1]; k++)
            t->row[p->chord[t->up[k]].high] = INFINITY;
    }
    return true;
}

static uint32_t chord_apex(const chord_table *t, uint32_t i, uint32_t j)
{
    const end *list = &t->down[t->first_down[j]];
    uint32_t below = 0, above = t->down_count[j] - 1;
    while (below < above) {
        uint32_t middle = below + (above - below) / 2;
        if (list[middle].low > i)
            below = middle + 1;
        else
            above = middle;
    }
    return list[below].apex;
}

/* Chords still to be opened are kept in the room of the corners not yet written: there are never
 * more of them. */
static void table_collect(const chord_table *t, uint32_t *corners)
{
    size_t written = 0, open = 3 * ((size_t)t->corner_count - 2);
    corners[--open] = 0;
    corners[--open] = t->corner_count - 1;
    while (open < 3 * ((size_t)t->corner_count - 2)) {
        uint32_t j = corners[open++], i = corners[open++], m = chord_apex(t, i, j);
        corners[written++] = i;
        corners[written++] = m;
        corners[written++] = j;
        if (m - i > 1) {
            corners[--open] = i;
            corners[--open] = m;
        }
        if (j - m > 1) {
            corners[--open] = m;
            corners[--open] = j;
        }
    }
}

bool mw__lmt_face_steps(const mw_lmt_face *polygon, uint64_t *steps)
{
    uint32_t *count = mw__calloc(polygon->corner_count, sizeof *count);
    if (!count) return false;
    for (size_t c = 0; c < polygon->chord_count; c++) count[polygon->chord[c].high]++;
    *steps = 0;
    for (uint32_t j = 0; j < polygon->corner_count; j++)
        *steps += (uint64_t)count[j] * (count[j] + 1) / 2 + 1;
    free(count);
    return true;
}

bool mw__lmt_face_fill(const mw_lmt_face *polygon, mw_job *job, uint32_t *corners)
{
    chord_table t;
    bool done = table_create(&t, polygon) && table_fill(&t, polygon, job);
    if (done) table_collect(&t, corners);
    table_release(&t);
    return done;
}
