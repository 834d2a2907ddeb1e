#include "cli/raster/scan_batch.h"
#include "cli/raster/scan_batch_rows.h"
#include "cli/raster/scan_batch_sides.h"

#include <math.h>

#ifdef __x86_64__

static SCAN_INLINE void batch_prepare_all(scan_batch *b, const scan_strip *s)
{
    const raster_grid *g = s->grid;
    const double west = fabs(g->x[0]), east = fabs(g->x[g->columns - 1]);
    const batch_terms terms = {.west = g->west,
                               .height = g->height,
                               .per_width = s->per_width,
                               .columns = g->columns,
                               .reach = west > east ? west : east,
                               .far = 2 * (fabs(g->north) + g->rows * g->height)};
    batch_prepare(b, &terms);
}

/* Fill the triangles of a batch; what is not sure is left to scan_triangle.h. */
#define BATCH_FILL(b, s, fill_columns)                                                             \
    do {                                                                                           \
        batch_rows rows;                                                                           \
        batch_target target;                                                                       \
        batch_prepare_all(b, s);                                                                   \
        for (uint32_t i = 0; i < (b)->count; i++) {                                                \
            bool sure = batch_find_rows(b, i, s, &rows);                                           \
            for (int shift = 0; sure && shift < (int)(b)->columns[i]; shift += BATCH_LANES) {      \
                batch_target_at(b, i, s, shift, &target);                                          \
                sure = fill_columns(&target, &rows, shift);                                        \
            }                                                                                      \
            if (!sure) scan_triangle_fill(s, (b)->number[i], (b)->corner[i]);                      \
        }                                                                                          \
    } while (0)

BATCH_AVX2 static void batch_fill_avx2(scan_batch *b, const scan_strip *s)
{
    BATCH_FILL(b, s, batch_fill_columns_avx2);
}

BATCH_AVX512 static void batch_fill_avx512(scan_batch *b, const scan_strip *s)
{
    BATCH_FILL(b, s, batch_fill_columns_avx512);
}

static scan_batch_work *batch_work_here(void)
{
    if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512vl") &&
        __builtin_cpu_supports("avx512dq"))
        return batch_fill_avx512;
    return __builtin_cpu_supports("avx2") ? batch_fill_avx2 : NULL;
}

#else

static scan_batch_work *batch_work_here(void)
{
    return NULL;
}

#endif

bool scan_batch_begin(scan_batch *batch, const scan_strip *s)
{
    *batch = (scan_batch){.work = batch_work_here()};
    return batch->work && s->rounded && !s->result && !s->triangles &&
           s->last - s->first < SCAN_BATCH_ROWS;
}

void scan_batch_finish(scan_batch *b, const scan_strip *s)
{
    b->work(b, s);
    b->count = 0;
}

/* Is a corner on the centres of a row? Behind the last row this may be true by chance. */
static bool batch_touches_row(const scan_strip *s, const scan_vertex *const corner[3])
{
    const double *y = s->grid->y;
    return (y[corner[0]->row] == corner[0]->y) | (y[corner[1]->row] == corner[1]->y) |
           (y[corner[2]->row] == corner[2]->y);
}

/* Rows of the strip that a triangle reaches into, if no corner is on a row. */
static row_range batch_rows_of(const scan_strip *s, const scan_vertex *const corner[3])
{
    const int32_t a = corner[0]->row, b = corner[1]->row, c = corner[2]->row, low = a < b ? a : b,
                  high = a < b ? b : a;
    row_range r = {low < c ? low : c, (high < c ? c : high) - 1};
    if (r.first < s->first) r.first = s->first;
    if (r.last > s->last) r.last = s->last;
    return r;
}

void scan_batch_add(scan_batch *b, const scan_strip *s, uint32_t number,
                    const scan_vertex *const corner[3])
{
    if (batch_touches_row(s, corner)) {
        scan_triangle_fill(s, number, corner);
        return;
    }
    const row_range rows = batch_rows_of(s, corner);
    if (rows.first > rows.last) return;
    const uint32_t i = b->count;
    for (int k = 0; k < 3; k++) {
        b->corner[i][k] = corner[k];
        b->x[k][i] = corner[k]->x;
        b->y[k][i] = corner[k]->y;
        b->value[k][i] = corner[k]->value;
        b->row[k][i] = corner[k]->row;
    }
    b->number[i] = number;
    b->first[i] = (double)rows.first;
    b->rows[i] = (double)(rows.last - rows.first + 1);
    b->at[i] = s->grid->y[rows.first];
    if (++b->count == SCAN_BATCH) scan_batch_finish(b, s);
}
