/* window_sums.c - fields one after another, through a window.
 *
 * The lines of eight columns that some ranks, a strip, need are copied once for eight fields, in
 * ascending order, so that the processor foresees what is read next of each field. In the window
 * the values of a column are side by side: a rank takes two loads of four values for each column
 * instead of eight loads, and no address of each field. The sums of four ranks are turned, and go
 * to each field as a run. The bits are the same: each value is the sum that mw_interpolate makes,
 * in its order.
 *
 * All this is for processors with AVX2: with vectors of two values it takes longer than
 * mw__field_sums.
 *
 * Which lines are needed is found once for all fields. A window holds more than a strip of
 * MW_WINDOW_RANKS needs if neighbours have near numbers; otherwise a strip ends where it is full.
 */
#include "operator/window_sums.h"

#include "base/hilbert.h"
#include "operator/field_sums.h"
#include "operator/four_doubles.h"

#include <string.h>

#ifdef __x86_64__
#include <immintrin.h>

enum {
    FIELDS = 8,
    COLUMNS = 8,             /* of a line: of doubles, a cache line of each field */
    LINE = FIELDS * COLUMNS, /* values */
    LINES = 1 << 12,         /* of a window */
    PAGE = 64,               /* lines */
    PAGES = 1 << 10,         /* of a window */
    PAGE_BITS = 23,          /* of the number of a page */
    TILE = 64,               /* ranks whose sums stay in the nearest cache */
    HELD = 16,               /* results of a field that wait for the next tile */
    APART = HELD + TILE + 8, /* fields of a tile: caches hold few lines a power of two apart */
    /* fewer fields than these, after the last eight, are left to mw__field_sums: */
    FEWEST_FIELDS = 4,
    FEWEST_ROWS = 1 << 12
};

/* --- with AVX2 -------------------------------------------------------------------------------- */

#define AVX2 __attribute__((target("avx2"))) static

AVX2 inline void four_widen(mw_four_doubles *out, const float *from)
{
    *out = (mw_four_doubles)_mm256_cvtps_pd(_mm_loadu_ps(from));
}

/* A cache line of results, past the caches. */
AVX2 inline void line_pass_doubles(double *to, const double *from)
{
    for (size_t i = 0; i < MW_CACHE_LINE / sizeof *to; i += MW_FOUR)
        _mm256_stream_pd(to + i, _mm256_loadu_pd(from + i));
}

AVX2 inline void line_pass_floats(float *to, const double *from)
{
    for (size_t i = 0; i < MW_CACHE_LINE / sizeof *to; i += MW_FOUR)
        _mm_stream_ps(to + i, _mm256_cvtpd_ps(_mm256_loadu_pd(from + i)));
}

/* --- windows ---------------------------------------------------------------------------------- */

/* Lines are found by their page. A place is an index of `values`. */
struct mw_window {
    double values[LINES * LINE] __attribute__((aligned(MW_CACHE_LINE)));
    uint32_t place[MW_NARROW_ROW * MW_WINDOW_RANKS]; /* of the column of each entry */
    uint32_t line[LINES];                            /* numbers, ascending */
    uint32_t line_place[PAGES][PAGE];                /* MW_NONE: the line is not needed */
    mw_key page[PAGES], scratch[PAGES];              /* number, and index in line_place */
    bool plain[MW_WINDOW_RANKS / TILE];              /* the weights of this tile */
    uint32_t lines, pages;
    uint16_t *slot; /* 1 + index in line_place of each page of the operator; 0: none */
};

/* The ranks of a tile, and of the strip that it is a part of. */
typedef struct mw_ranks {
    size_t from, to, rank, n;
} mw_ranks;

static bool windows_fit(const mw_apply_call *c)
{
    return __builtin_cpu_supports("avx2") && c->step > 1 && c->stride == 1 && c->count >= FIELDS &&
           !c->o->first && !c->o->row && c->o->rows >= FEWEST_ROWS &&
           c->missing == MW_MISSING_SPREADS;
}

mw_window *mw__windows_create(const mw_apply_call *c, uint32_t team)
{
    if (!windows_fit(c)) return NULL;
    const size_t pages = c->o->columns / (COLUMNS * PAGE) + 1, slots = pages * sizeof(uint16_t);
    mw_window *windows = mw__alloc_lines(team, sizeof *windows + slots);
    if (!windows) return NULL;
    uint16_t *slot = (uint16_t *)(void *)(windows + team);
    memset(slot, 0, team * slots);
    for (uint32_t i = 0; i < team; i++) windows[i].slot = slot + i * pages;
    return windows;
}

/* --- which columns ---------------------------------------------------------------------------- */

static __attribute__((noinline)) uint32_t window_add_page(mw_window *w, uint32_t page)
{
    const uint32_t slot = ++w->pages;
    w->page[slot - 1] = (mw_key){page, slot - 1};
    memset(w->line_place[slot - 1], 0xff, sizeof *w->line_place);
    w->slot[page] = (uint16_t)slot;
    return slot;
}

static MW_INLINE uint32_t *window_line(mw_window *w, uint32_t column)
{
    const uint32_t line = column / COLUMNS;
    uint32_t slot = w->slot[line / PAGE];
    if (MW_UNLIKELY(slot == 0)) slot = window_add_page(w, line / PAGE);
    return &w->line_place[slot - 1][line % PAGE];
}

/* Note the lines that the ranks from `from` on need. Returns where the window is full, or `to`. */
static size_t window_note_lines(mw_window *w, const mw_operator *o, size_t from, size_t to)
{
    const uint32_t *column = &o->column[MW_NARROW_ROW * from];
    uint32_t lines = 0;
    w->pages = 0;
    size_t rank = from;
    for (; rank < to && lines + MW_NARROW_ROW <= LINES && w->pages + MW_NARROW_ROW <= PAGES; rank++)
        for (int i = 0; i < MW_NARROW_ROW; i++) {
            uint32_t *at = window_line(w, *column++);
            lines += *at != 0;
            *at = 0;
        }
    return rank;
}

/* Give the lines of the window places, in ascending order. */
static void window_place_lines(mw_window *w)
{
    mw__sort_keys_by(w->page, w->scratch, w->pages, PAGE_BITS);
    w->lines = 0;
    for (uint32_t k = 0; k < w->pages; k++) {
        uint32_t *place = w->line_place[w->page[k].item];
        for (uint32_t i = 0; i < PAGE; i++)
            if (place[i] != MW_NONE) {
                place[i] = w->lines * LINE;
                w->line[w->lines++] = w->page[k].key * PAGE + i;
            }
    }
}

static void window_forget_pages(mw_window *w)
{
    for (uint32_t k = 0; k < w->pages; k++) w->slot[w->page[k].key] = 0;
}

/* Is none of 3 n weights 0? */
static bool weights_are_plain(const double *w, size_t n)
{
    const double *end = w + MW_NARROW_ROW * n;
    double least = 1;
    for (; w < end; w += MW_NARROW_ROW) {
        const double a = fabs(w[0]), b = fabs(w[1]), c = fabs(w[2]);
        const double ab = a < b ? a : b, abc = ab < c ? ab : c;
        least = abc < least ? abc : least;
    }
    return least > 0;
}

/* The window of the ranks from `from` on, at most up to `to`. Returns where they end. */
static size_t window_open(mw_window *w, const mw_operator *o, size_t from, size_t to)
{
    const size_t end = window_note_lines(w, o, from, to);
    const uint32_t *column = &o->column[MW_NARROW_ROW * from];
    window_place_lines(w);
    for (size_t i = 0; i < MW_NARROW_ROW * (end - from); i++)
        w->place[i] = *window_line(w, column[i]) + column[i] % COLUMNS * FIELDS;
    for (size_t tile = from; tile < end; tile += TILE)
        w->plain[(tile - from) / TILE] = weights_are_plain(&o->weight[MW_NARROW_ROW * tile],
                                                           end - tile < TILE ? end - tile : TILE);
    window_forget_pages(w);
    return end;
}

/* Does a line serve at least two ranks? */
static bool window_repays(const mw_window *w, size_t ranks)
{
    return w->lines <= ranks / 2;
}

/* --- their values ----------------------------------------------------------------------------- */

/* A line of the fields from k on. */
static MW_INLINE void line_fill(const mw_apply_call *c, uint32_t line, size_t k, double *to,
                                bool narrow)
{
    for (size_t f = 0; f < FIELDS; f += MW_FOUR)
        for (size_t v = 0; v < COLUMNS; v += MW_FOUR) {
            const size_t at = (k + f) * c->step + (size_t)line * COLUMNS + v;
            mw_four_doubles four[MW_FOUR];
            for (size_t i = 0; i < MW_FOUR; i++)
                if (narrow)
                    four_widen(&four[i], (const float *)c->values + at + i * c->step);
                else
                    mw__four_load(&four[i], c->values, at + i * c->step, false);
            mw__four_turn(four);
            for (size_t i = 0; i < MW_FOUR; i++)
                mw__four_store(to, (v + i) * FIELDS + f, &four[i], false, false);
        }
}

/* The last line of an operator whose columns end within it. */
static MW_INLINE void line_fill_short(const mw_apply_call *c, uint32_t line, size_t k, double *to,
                                      bool narrow)
{
    const size_t first = (size_t)line * COLUMNS;
    for (size_t v = first; v < c->o->columns; v++)
        for (size_t f = 0; f < FIELDS; f++)
            to[(v - first) * FIELDS + f] =
                mw__operand_load(c->values, (k + f) * c->step + v, narrow);
}

static MW_INLINE void window_fill(const mw_apply_call *c, mw_window *w, size_t k, bool narrow)
{
    const uint32_t whole = c->o->columns / COLUMNS;
    for (uint32_t i = 0; i < w->lines; i++) {
        double *to = &w->values[i * (size_t)LINE];
        if (w->line[i] < whole)
            line_fill(c, w->line[i], k, to, narrow);
        else
            line_fill_short(c, w->line[i], k, to, narrow);
    }
}

/* --- sums ------------------------------------------------------------------------------------- */

/* Four fields of a rank. */
static MW_INLINE void four_sum(const double *values, const uint32_t *place, const double *w,
                               mw_four_doubles *out)
{
    const mw_four_doubles x = {w[0], w[0], w[0], w[0]}, y = {w[1], w[1], w[1], w[1]},
                          z = {w[2], w[2], w[2], w[2]}, zero = {0, 0, 0, 0};
    mw_four_doubles a, b, c;
    mw__four_load(&a, values, place[0], false);
    mw__four_load(&b, values, place[1], false);
    mw__four_load(&c, values, place[2], false);
    *out = zero + x * a;
    *out += y * b;
    *out += z * c;
}

/* Four ranks. */
static MW_INLINE void ranks_sum_four(const double *values, const uint32_t *place, const double *w,
                                     double *sums)
{
    for (size_t f = 0; f < FIELDS; f += MW_FOUR) {
        mw_four_doubles four[MW_FOUR];
        for (size_t i = 0; i < MW_FOUR; i++)
            four_sum(values + f, place + MW_NARROW_ROW * i, w + MW_NARROW_ROW * i, &four[i]);
        mw__four_turn(four);
        for (size_t i = 0; i < MW_FOUR; i++)
            mw__four_store(sums, (f + i) * APART, &four[i], false, false);
    }
}

/* A rank with any weights. */
static MW_INLINE void rank_sum_any(const mw_apply_call *c, size_t rank, size_t k, double *sums,
                                   bool narrow)
{
    const mw_apply_entries e = mw__entries_of(c->o, rank);
    for (size_t f = 0; f < FIELDS; f++) sums[f * APART] = mw__sum_any(c, e, k + f, narrow);
}

static MW_INLINE void tile_sum(const mw_apply_call *c, const mw_window *w, const mw_ranks *t,
                               size_t k, double *sums, bool narrow)
{
    const double *weight = &c->o->weight[MW_NARROW_ROW * t->rank];
    const uint32_t *place = &w->place[MW_NARROW_ROW * (t->rank - t->from)];
    size_t i = 0;
    for (; i + MW_FOUR <= t->n; i += MW_FOUR)
        ranks_sum_four(w->values, place + MW_NARROW_ROW * i, weight + MW_NARROW_ROW * i, sums + i);
    if (w->plain[(t->rank - t->from) / TILE] && i == t->n) return;
    for (size_t j = 0; j < t->n; j++)
        if (j >= i || !mw__entries_plain(c, weight + MW_NARROW_ROW * j))
            rank_sum_any(c, t->rank + j, k, sums + j, narrow);
}

/* Bytes from the begin of a cache line. */
static MW_INLINE size_t line_offset(const char *at)
{
    return (uintptr_t)at % MW_CACHE_LINE;
}

/* n results of a field, past the caches. */
static MW_INLINE void results_pass(char *to, const double *sums, size_t n, bool narrow)
{
    const size_t size = mw__operand_size(narrow), line = MW_CACHE_LINE / size;
    size_t i = line_offset(to) ? line - line_offset(to) / size : 0;
    if (i > n) i = n;
    for (size_t j = 0; j < i; j++) mw__operand_store(to, j, sums[j], narrow);
    for (; i + line <= n; i += line)
        if (narrow)
            line_pass_floats((float *)(void *)to + i, &sums[i]);
        else
            line_pass_doubles((double *)(void *)to + i, &sums[i]);
    for (; i < n; i++) mw__operand_store(to, i, sums[i], narrow);
}

/* The results of a tile. Those in a cache line that it begins or ends within wait for the next
 * tile: a part of a line written past the caches costs as much as several lines. */
static MW_INLINE void results_store(const mw_apply_call *c, const mw_ranks *t, size_t k,
                                    const double *sums, bool narrow)
{
    const size_t size = mw__operand_size(narrow);
    for (size_t f = 0; f < FIELDS; f++) {
        char *to = (char *)c->result + (t->rank + (k + f) * c->field) * size;
        const size_t before = t->rank == t->from ? 0 : line_offset(to) / size,
                     after = t->rank + t->n == t->to ? 0 : line_offset(to + t->n * size) / size;
        if (c->past_caches)
            results_pass(to - before * size, sums + f * APART - before, before + t->n - after,
                         narrow);
        else
            for (size_t i = 0; i < t->n; i++) mw__operand_store(to, i, sums[f * APART + i], narrow);
    }
}

static MW_INLINE void eight_sum(const mw_apply_call *c, mw_window *w, size_t from, size_t to,
                                size_t k, bool narrow)
{
    double sums[FIELDS * APART];
    window_fill(c, w, k, narrow);
    for (size_t rank = from; rank < to; rank += TILE) {
        const mw_ranks t = {from, to, rank, to - rank < TILE ? to - rank : TILE};
        tile_sum(c, w, &t, k, sums + HELD, narrow);
        results_store(c, &t, k, sums + HELD, narrow);
        for (size_t f = 0; f < FIELDS; f++)
            memcpy(&sums[f * APART], &sums[f * APART + TILE], HELD * sizeof *sums);
    }
}

/* The fields k .. k + 7 of some ranks. */
AVX2 void window_eight(const mw_apply_call *c, mw_window *w, size_t from, size_t to, size_t k)
{
    if (c->narrow)
        eight_sum(c, w, from, to, k, true);
    else
        eight_sum(c, w, from, to, k, false);
}

/* All fields. The last eight may overlap those before them: sums made twice are the same. */
static void window_fields(const mw_apply_call *c, mw_window *w, size_t from, size_t to)
{
    size_t k = 0;
    for (; k + FIELDS <= c->count; k += FIELDS) window_eight(c, w, from, to, k);
    if (c->count - k >= FEWEST_FIELDS)
        window_eight(c, w, from, to, c->count - FIELDS);
    else if (k < c->count)
        mw__field_sums(c, from, to, k, c->count);
}

void mw__window_sums(const mw_apply_call *c, uint32_t member, size_t from, size_t to)
{
    mw_window *window = &c->windows[member];
    for (size_t rank = from, end; rank < to; rank = end) {
        end = window_open(window, c->o, rank, to);
        if (window_repays(window, end - rank))
            window_fields(c, window, rank, end);
        else
            mw__field_sums(c, rank, end, 0, c->count);
    }
    if (c->past_caches) mw__past_caches_end();
}

#else

mw_window *mw__windows_create(const mw_apply_call *c, uint32_t team)
{
    (void)c;
    (void)team;
    return NULL;
}

void mw__window_sums(const mw_apply_call *c, uint32_t member, size_t from, size_t to)
{
    (void)member;
    mw__field_sums(c, from, to, 0, c->count);
}

#endif
