/* field_sums.c - sums of fields that are stored one after another, in tiles of some ranks and some
 * fields.
 *
 * The columns and weights of a rank are read once for the fields of a tile. The sums of a tile stay
 * in the nearest cache and go to each field as a run. Rows with three entries are the common case;
 * all others, and missing values that are left out, go value by value. The bits are the same: each
 * value is the sum that mw_interpolate makes, in its order. */
#include "operator/field_sums.h"

#include "operator/past_caches.h"

enum {
    TILE = 256, /* ranks */
    FIELDS = 8, /* of a tile: about as many as there are registers for their addresses */
    TILES = 8,  /* whose entries stay in the cache while field after field is summed */
    STRIP = TILES * TILE,
    APART = TILE + 8, /* fields of a tile: caches hold few lines that are a power of two apart */
    AHEAD = 48        /* ranks between one whose values are asked for and one that is summed */
};

/* Have the values of three columns on their way. */
static MW_INLINE void fields_ask(const void *const *field, size_t fields, size_t stride,
                                 const uint32_t *v, bool narrow)
{
    for (size_t f = 0; f < fields; f++)
        for (int i = 0; i < MW_NARROW_ROW; i++)
            __builtin_prefetch(mw__operand_at(field[f], v[i] * stride, narrow));
}

/* The sums of some ranks, APART from field to field. All are plain: nothing is asked of each. */
static MW_INLINE void plain_sums(const mw_apply_call *c, size_t rank, size_t n, size_t k,
                                 size_t fields, double *restrict sums, bool narrow)
{
    const uint32_t *restrict v = &c->o->column[MW_NARROW_ROW * rank];
    const double *restrict w = &c->o->weight[MW_NARROW_ROW * rank];
    const size_t stride = c->stride, left = c->o->rows - rank; /* ranks, to the last of all */
    const void *field[FIELDS];
    for (size_t f = 0; f < fields; f++)
        field[f] = mw__operand_at(c->values, (k + f) * c->step, narrow);
    for (size_t i = 0; i < n; i++, v += MW_NARROW_ROW, w += MW_NARROW_ROW) {
        const size_t p = v[0] * stride, q = v[1] * stride, r = v[2] * stride;
        const double x = w[0], y = w[1], z = w[2];
        if (i + AHEAD < left) fields_ask(field, fields, stride, v + MW_NARROW_ROW * AHEAD, narrow);
        for (size_t f = 0; f < fields; f++) {
            double sum = 0 + x * mw__operand_load(field[f], p, narrow);
            sum += y * mw__operand_load(field[f], q, narrow);
            sums[f * APART + i] = sum + z * mw__operand_load(field[f], r, narrow);
        }
    }
}

/* The same of any ranks. */
static MW_INLINE void mixed_sums(const mw_apply_call *c, size_t rank, size_t n, size_t k,
                                 size_t fields, double *restrict sums, bool narrow)
{
    for (size_t i = 0; i < n; i++) {
        const mw_apply_entries e = mw__entries_of(c->o, rank + i);
        if (!c->o->first && mw__entries_plain(c, e.weight))
            plain_sums(c, rank + i, 1, k, fields, sums + i, narrow);
        else
            for (size_t f = 0; f < fields; f++)
                sums[f * APART + i] = mw__sum_any(c, e, k + f, narrow);
    }
}

static bool ranks_are_plain(const mw_apply_call *c, size_t rank, size_t n)
{
    bool plain = !c->o->first;
    for (size_t i = rank; i < rank + n && plain; i++)
        plain = mw__entries_plain(c, &c->o->weight[MW_NARROW_ROW * i]);
    return plain;
}

/* A run of doubles, or of floats, of a field. */
static MW_INLINE void run_store(void *to, const double *sums, size_t n, bool narrow, bool pass)
{
    size_t i = pass ? mw__pass_begin(to) / mw__operand_size(narrow) : n;
    if (i > n) i = n;
    for (size_t k = 0; k < i; k++) mw__operand_store(to, k, sums[k], narrow);
    if (narrow)
        for (; i + 4 <= n; i += 4)
            mw__pass_floats((float *)to + i, (float)sums[i], (float)sums[i + 1], (float)sums[i + 2],
                            (float)sums[i + 3]);
    else
        for (; i + 2 <= n; i += 2) mw__pass_doubles((double *)to + i, sums[i], sums[i + 1]);
    for (; i < n; i++) mw__operand_store(to, i, sums[i], narrow);
}

static MW_INLINE void tile_store(const mw_apply_call *c, size_t rank, size_t n, size_t k,
                                 size_t fields, const double *sums, bool narrow)
{
    for (size_t f = 0; f < fields; f++, sums += APART) {
        const size_t field = (k + f) * c->field;
        if (c->o->row)
            for (size_t i = 0; i < n; i++)
                mw__operand_store(c->result, c->o->row[rank + i] * c->row + field, sums[i], narrow);
        else
            run_store((char *)c->result + (rank + field) * mw__operand_size(narrow), sums, n,
                      narrow, c->past_caches);
    }
}

static MW_INLINE void tile_sums(const mw_apply_call *c, size_t rank, size_t n, size_t k,
                                size_t fields, bool plain, bool narrow)
{
    double sums[FIELDS * APART];
    if (plain)
        plain_sums(c, rank, n, k, fields, sums, narrow);
    else
        mixed_sums(c, rank, n, k, fields, sums, narrow);
    tile_store(c, rank, n, k, fields, sums, narrow);
}

static MW_INLINE void strip_sums(const mw_apply_call *c, size_t from, size_t to, size_t field,
                                 size_t field_end, bool narrow)
{
    bool plain[TILES];
    for (size_t rank = from, i = 0; rank < to; rank += TILE, i++)
        plain[i] = ranks_are_plain(c, rank, to - rank < TILE ? to - rank : TILE);
    for (size_t k = field; k < field_end; k += FIELDS)
        for (size_t rank = from, i = 0; rank < to; rank += TILE, i++) {
            const size_t n = to - rank < TILE ? to - rank : TILE, fields = field_end - k;
            if (fields >= FIELDS)
                tile_sums(c, rank, n, k, FIELDS, plain[i], narrow);
            else if (fields == 1)
                tile_sums(c, rank, n, k, 1, plain[i], narrow);
            else
                tile_sums(c, rank, n, k, fields, plain[i], narrow);
        }
}

void mw__field_sums(const mw_apply_call *c, size_t from, size_t to, size_t field, size_t field_end)
{
    for (size_t strip = from; strip < to; strip += STRIP) {
        const size_t end = to - strip < STRIP ? to : strip + STRIP;
        if (c->narrow)
            strip_sums(c, strip, end, field, field_end, true);
        else
            strip_sums(c, strip, end, field, field_end, false);
    }
    if (c->past_caches) mw__past_caches_end();
}
