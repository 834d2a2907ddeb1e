/* four_doubles.h - four values at a time: loaded, stored, turned. Private; for this room only.
 *
 * Floats become doubles when they are loaded and are rounded when they are stored. `narrow` is a
 * literal where this is stamped. Vectors go by pointers: without AVX a compiler may pass them in
 * two ways. */
#ifndef MW_SRC_OPERATOR_FOUR_DOUBLES_H
#define MW_SRC_OPERATOR_FOUR_DOUBLES_H

#include "operator/apply_call.h"
#include "operator/past_caches.h"

enum { MW_FOUR = 4 };

typedef double mw_four_doubles __attribute__((vector_size(32), aligned(8)));
typedef float mw_four_floats __attribute__((vector_size(16), aligned(4)));

static MW_INLINE void mw__four_load(mw_four_doubles *out, const void *values, size_t i, bool narrow)
{
    if (narrow)
        *out = __builtin_convertvector(*(const mw_four_floats *)&((const float *)values)[i],
                                       mw_four_doubles);
    else
        *out = *(const mw_four_doubles *)&((const double *)values)[i];
}

/* `pass`: past the caches; then the address is a multiple of MW_PASSED_BYTES. */
static MW_INLINE void mw__four_store(void *to, size_t i, const mw_four_doubles *value, bool narrow,
                                     bool pass)
{
    if (narrow) {
        const mw_four_floats v = __builtin_convertvector(*value, mw_four_floats);
        float *at = (float *)to + i;
        if (pass)
            mw__pass_floats(at, v[0], v[1], v[2], v[3]);
        else
            *(mw_four_floats *)at = v;
    } else {
        const mw_four_doubles v = *value;
        double *at = (double *)to + i;
        if (pass) {
            mw__pass_doubles(at, v[0], v[1]);
            mw__pass_doubles(at + 2, v[2], v[3]);
        } else {
            *(mw_four_doubles *)at = v;
        }
    }
}

/* Four rows become four columns. */
static MW_INLINE void mw__four_turn(mw_four_doubles rows[MW_FOUR])
{
    const mw_four_doubles a = __builtin_shufflevector(rows[0], rows[1], 0, 4, 2, 6),
                          b = __builtin_shufflevector(rows[0], rows[1], 1, 5, 3, 7),
                          c = __builtin_shufflevector(rows[2], rows[3], 0, 4, 2, 6),
                          d = __builtin_shufflevector(rows[2], rows[3], 1, 5, 3, 7);
    rows[0] = __builtin_shufflevector(a, c, 0, 1, 4, 5);
    rows[1] = __builtin_shufflevector(b, d, 0, 1, 4, 5);
    rows[2] = __builtin_shufflevector(a, c, 2, 3, 6, 7);
    rows[3] = __builtin_shufflevector(b, d, 2, 3, 6, 7);
}

#endif
