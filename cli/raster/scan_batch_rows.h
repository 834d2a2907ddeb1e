/* scan_batch_rows.h - the pixels of one triangle of a batch. */
#ifndef MW_CLI_RASTER_SCAN_BATCH_ROWS_H
#define MW_CLI_RASTER_SCAN_BATCH_ROWS_H

#include "cli/raster/scan_batch_data.h"
#include "cli/raster/scan_vector.h"

#ifdef __x86_64__
#include <immintrin.h>
#endif

enum { BATCH_LANES = 8 };

typedef float batch_floats __attribute__((vector_size(32), aligned(4)));
typedef int32_t batch_ints
    __attribute__((vector_size(32), aligned(4))); /* as masks: 0 or all bits */
typedef uint32_t batch_bits __attribute__((vector_size(32), aligned(4)));
typedef double batch_doubles __attribute__((vector_size(64), aligned(8)));

/* The rows of a triangle. */
typedef struct batch_rows {
    uint32_t
        pixels[SCAN_BATCH_ROWS]; /* bit j: the triangle has the pixel j columns from its first */
    double low[SCAN_BATCH_ROWS], high[SCAN_BATCH_ROWS]; /* the plane there at the northern corner's
                                                         * easting, less and plus the bound */
} batch_rows;

/* *a where the mask is set, else `other`. */
static SCAN_INLINE void batch_choose(const batch_ints *mask, batch_floats *a,
                                     const batch_floats *other)
{
    *a = (batch_floats)((*mask & (batch_ints)*a) | (~*mask & (batch_ints)*other));
}

static SCAN_INLINE bool batch_any(const batch_ints *mask)
{
    int32_t any = 0;
    for (int k = 0; k < BATCH_LANES; k++) any |= (*mask)[k];
    return any != 0;
}

/* The first column east of the western or the eastern side in each row, from the triangle's first
 * column; `sure` loses rows where a centre is too near to tell. */
static SCAN_INLINE void batch_columns(const scan_batch *b, uint32_t i, int east,
                                      const batch_floats *row, const batch_ints *upper,
                                      batch_ints *column, batch_ints *sure)
{
    const batch_floats zero = {0}, least = zero + 0.5F, most = least + (float)b->columns[i],
                       clear = zero + b->clear[i], lower_start = zero + b->start[east][1][i],
                       lower_step = zero + b->step[east][1][i];
    batch_floats start = zero + b->start[east][0][i], step = zero + b->step[east][0][i];
    batch_choose(upper, &start, &lower_start);
    batch_choose(upper, &step, &lower_step);
    batch_floats at = start + *row * step;
    batch_ints within = at > least;
    batch_choose(&within, &at, &least);
    within = at < most;
    batch_choose(&within, &at, &most);
    *column = __builtin_convertvector(at, batch_ints);
    const batch_floats part = at - __builtin_convertvector(*column, batch_floats) - 0.5F;
    *sure &= (part < clear) & (-part < clear);
}

/* Find which pixels each row has. False: some are not sure. */
static SCAN_INLINE bool batch_find_pixels(const scan_batch *b, uint32_t i, int64_t count,
                                          batch_rows *rows)
{
    const batch_floats zero = {0}, middle = zero + (float)b->middle[i],
                       end = zero + (float)b->rows[i];
    const batch_ints all = {-1, -1, -1, -1, -1, -1, -1, -1};
    const batch_bits bits = (batch_bits)all;
    batch_floats row = {0, 1, 2, 3, 4, 5, 6, 7};
    batch_ints unsure = {0};
    for (int64_t k = 0; k < count; k += BATCH_LANES, row += BATCH_LANES) {
        const batch_ints upper = row < middle, mine = row < end;
        batch_ints sure = all, west, east;
        batch_columns(b, i, 0, &row, &upper, &west, &sure);
        batch_columns(b, i, 1, &row, &upper, &east, &sure);
        unsure |= mine & ~sure;
        *(batch_bits *)(rows->pixels + k) =
            (bits << (batch_bits)west) & ~(bits << (batch_bits)east);
    }
    return !batch_any(&unsure);
}

static SCAN_INLINE void batch_find_plane_rows(const scan_batch *b, uint32_t i, const double *y,
                                              int64_t count, batch_rows *rows)
{
    for (int64_t k = 0; k < count; k += BATCH_LANES) {
        const batch_doubles north = b->north[i] * (*(const batch_doubles *)(y + k) - b->from[1][i]);
        *(batch_doubles *)(rows->low + k) = b->low[i] + north;
        *(batch_doubles *)(rows->high + k) = b->high[i] + north;
    }
}

/* Find the rows of triangle i. False: it is left to scan_triangle.h. */
static SCAN_INLINE bool batch_find_rows(const scan_batch *b, uint32_t i, const scan_strip *s,
                                        batch_rows *rows)
{
    const int64_t first = (int64_t)b->first[i], count = (int64_t)b->rows[i];
    if (b->small[i] == 0 || !batch_find_pixels(b, i, count, rows)) return false;
    batch_find_plane_rows(b, i, s->grid->y + first, count, rows);
    return true;
}

/* Eight columns of a triangle, from column `shift` of its own. */
typedef struct batch_target {
    float *pixels; /* of the first row */
    int64_t stride, rows;
    batch_doubles east; /* how far the plane is above that at the northern corner's easting */
} batch_target;

static SCAN_INLINE void batch_target_at(const scan_batch *b, uint32_t i, const scan_strip *s,
                                        int shift, batch_target *t)
{
    const raster_grid *g = s->grid;
    const int64_t column = (int64_t)b->column[i] + shift, stride = g->columns;
    t->pixels = s->rounded + ((int64_t)b->first[i] - s->first) * stride + column;
    t->stride = stride;
    t->rows = (int64_t)b->rows[i];
    t->east = b->east[i] * (*(const batch_doubles *)(g->x + column) - b->from[0][i]);
}

#ifdef __x86_64__

#define BATCH_AVX2 __attribute__((target("avx2")))
#define BATCH_AVX512 __attribute__((target("avx2,avx512f,avx512vl,avx512dq")))

/* Fill eight columns. False: the plane was not sure. Pixels that are not the triangle's are read
 * and written again. */
BATCH_AVX2 static SCAN_INLINE bool batch_fill_columns_avx2(const batch_target *t,
                                                           const batch_rows *rows, int shift)
{
    const batch_ints bit = {1, 2, 4, 8, 16, 32, 64, 128}, zero = {0};
    batch_ints unsure = zero;
    float *to = t->pixels;
    for (int64_t k = 0; k < t->rows; k++, to += t->stride) {
        const batch_ints mine = ((zero + (int32_t)(rows->pixels[k] >> shift)) & bit) != 0;
        batch_floats low = __builtin_convertvector(rows->low[k] + t->east, batch_floats);
        const batch_floats high = __builtin_convertvector(rows->high[k] + t->east, batch_floats),
                           old = *(const batch_floats *)to;
        unsure |= mine & (low != high);
        batch_choose(&mine, &low, &old);
        *(batch_floats *)to = low;
    }
    return !batch_any(&unsure);
}

/* The same; only pixels of the triangle are written. */
BATCH_AVX512 static SCAN_INLINE bool batch_fill_columns_avx512(const batch_target *t,
                                                               const batch_rows *rows, int shift)
{
    const __m512d east = (__m512d)t->east;
    __mmask8 unsure = 0;
    float *to = t->pixels;
    for (int64_t k = 0; k < t->rows; k++, to += t->stride) {
        const __mmask8 mine = (__mmask8)(rows->pixels[k] >> shift);
        const __m256 low = _mm512_cvtpd_ps(_mm512_add_pd(_mm512_set1_pd(rows->low[k]), east)),
                     high = _mm512_cvtpd_ps(_mm512_add_pd(_mm512_set1_pd(rows->high[k]), east));
        unsure |= _mm256_mask_cmp_ps_mask(mine, low, high, _CMP_NEQ_UQ);
        _mm256_mask_storeu_ps(to, mine, low);
    }
    return unsure == 0;
}

#endif

#endif
