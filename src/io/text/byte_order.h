/* byte_order.h - numbers as bytes, in either order. Private. */
#ifndef MW_SRC_IO_TEXT_BYTE_ORDER_H
#define MW_SRC_IO_TEXT_BYTE_ORDER_H

#include "base/base.h"

#include <string.h>

/* Unsigned number of `size` bytes (1, 2, 4 or 8). */
static MW_INLINE uint64_t mw__get_bytes(const unsigned char *p, size_t size, bool big)
{
    uint64_t value = 0;
    for (size_t i = 0; i < size; i++) value |= (uint64_t)p[big ? size - 1 - i : i] << (8 * i);
    return value;
}

static MW_INLINE uint16_t mw__get_u16(const unsigned char *p)
{
    return (uint16_t)mw__get_bytes(p, 2, false);
}
static MW_INLINE uint32_t mw__get_u32(const unsigned char *p)
{
    return (uint32_t)mw__get_bytes(p, 4, false);
}
static MW_INLINE uint64_t mw__get_u64(const unsigned char *p)
{
    return mw__get_bytes(p, 8, false);
}
static MW_INLINE int32_t mw__get_i32(const unsigned char *p)
{
    return (int32_t)mw__get_u32(p);
}

static MW_INLINE double mw__double_of_bits(uint64_t bits)
{
    double value;
    memcpy(&value, &bits, sizeof value);
    return value;
}

static MW_INLINE float mw__float_of_bits(uint32_t bits)
{
    float value;
    memcpy(&value, &bits, sizeof value);
    return value;
}

static MW_INLINE double mw__get_f64(const unsigned char *p)
{
    return mw__double_of_bits(mw__get_u64(p));
}
static MW_INLINE float mw__get_f32(const unsigned char *p)
{
    return mw__float_of_bits(mw__get_u32(p));
}

static MW_INLINE void mw__put_bytes(unsigned char *p, size_t size, uint64_t value)
{
    for (size_t i = 0; i < size; i++) p[i] = (unsigned char)(value >> (8 * i));
}

static MW_INLINE void mw__put_f64(unsigned char *p, double value)
{
    uint64_t bits;
    memcpy(&bits, &value, sizeof bits);
    mw__put_bytes(p, 8, bits);
}

#endif
