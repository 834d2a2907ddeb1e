/* sparse_rows.c - rows of any width are counted, filled, and packed into an operator. */
#include "operator/sparse_rows.h"

#include "operator/row_order.h"

#include <stdlib.h>
#include <string.h>

bool mw__sparse_rows_init(mw_sparse_rows *s, uint32_t rows, uint32_t columns, uint64_t entries)
{
    *s = (mw_sparse_rows){.rows = rows,
                          .columns = columns,
                          .first = mw__calloc((uint64_t)rows + 1, sizeof *s->first),
                          .column = mw__alloc(entries, sizeof *s->column),
                          .weight = mw__alloc(entries, sizeof *s->weight)};
    return s->first && s->column && s->weight;
}

void mw__sparse_rows_release(mw_sparse_rows *s)
{
    free(s->first);
    free(s->column);
    free(s->weight);
}

void mw__sparse_rows_open(mw_sparse_rows *s)
{
    uint64_t at = 0;
    for (size_t i = 0; i <= s->rows; i++) {
        const uint64_t count = s->first[i];
        s->first[i] = at;
        at += count;
    }
}

void mw__sparse_rows_full(mw_sparse_rows *s)
{
    memmove(&s->first[1], &s->first[0], s->rows * sizeof *s->first);
    s->first[0] = 0;
}

/* --- packing ---------------------------------------------------------------------------------- */

static uint32_t rows_lowest_column(const mw_sparse_rows *s, uint32_t row)
{
    uint32_t low = MW_NONE;
    for (uint64_t e = s->first[row]; e < s->first[row + 1]; e++)
        if (s->column[e] < low) low = s->column[e];
    return low;
}

static bool rows_order(const mw_sparse_rows *s, mw_operator *o)
{
    uint32_t *key = mw__alloc(s->rows, sizeof *key);
    if (!key) return false;
    for (uint32_t i = 0; i < s->rows; i++) key[i] = rows_lowest_column(s, i);
    const bool done = mw__row_order(key, s->rows, &o->row);
    free(key);
    return done;
}

static void rows_measure(const mw_sparse_rows *s, mw_operator *o)
{
    o->rows = s->rows;
    o->columns = s->columns;
    o->entries = s->first[s->rows];
    for (uint32_t i = 0; i < s->rows; i++) {
        const uint64_t count = s->first[i + 1] - s->first[i];
        o->empty_rows += count == 0;
        if (count > o->widest) o->widest = (uint32_t)(count < MW_NONE ? count : MW_NONE);
    }
}

static bool rows_allocate(mw_operator *o)
{
    const bool narrow = o->widest <= MW_NARROW_ROW;
    const uint64_t room = narrow ? MW_NARROW_ROW * (uint64_t)o->rows : o->entries;
    if (!narrow) o->first = mw__alloc((uint64_t)o->rows + 1, sizeof *o->first);
    o->column = mw__alloc(room, sizeof *o->column);
    o->weight = mw__alloc(room, sizeof *o->weight);
    return (narrow || o->first) && o->column && o->weight;
}

/* Copy the entries of a row to a rank, and return where the next rank begins. */
static uint64_t rows_copy_entries(const mw_sparse_rows *s, mw_operator *o, size_t rank, uint64_t at)
{
    const uint32_t row = mw__operator_row(o, rank);
    const uint64_t from = s->first[row], count = s->first[row + 1] - from;
    if (o->first) o->first[rank] = at;
    memcpy(&o->column[at], &s->column[from], count * sizeof *o->column);
    memcpy(&o->weight[at], &s->weight[from], count * sizeof *o->weight);
    if (o->first) return at + count;
    for (uint64_t k = count; k < MW_NARROW_ROW; k++) {
        o->column[at + k] = count ? s->column[from] : 0;
        o->weight[at + k] = 0;
    }
    return at + MW_NARROW_ROW;
}

mw_operator *mw__sparse_rows_pack(const mw_sparse_rows *s, mw_job *job)
{
    mw_operator *o = mw__calloc(1, sizeof *o);
    if (!o) return NULL;
    rows_measure(s, o);
    bool packed = rows_order(s, o) && rows_allocate(o) && mw__job_step(job, 1, 2);
    uint64_t at = 0;
    for (size_t rank = 0; rank < o->rows && packed; rank++) at = rows_copy_entries(s, o, rank, at);
    if (packed && o->first) o->first[o->rows] = at;
    if (packed && mw__job_step(job, 2, 2)) return o;
    mw_operator_destroy(o);
    return NULL;
}
