/* checksum.c - XXH64 [Collet 2016]: four lanes take eight bytes each in turn; at the end they are
 * joined, and what is left is added in pieces of 8, 4 and 1 bytes. */
#include "base/checksum.h"

#include <string.h>

static const uint64_t prime[6] = {0,
                                  UINT64_C(0x9E3779B185EBCA87),
                                  UINT64_C(0xC2B2AE3D27D4EB4F),
                                  UINT64_C(0x165667B19E3779F9),
                                  UINT64_C(0x85EBCA77C2B2AE63),
                                  UINT64_C(0x27D4EB2F165667C5)};

enum { STRIPE = 32 };

static MW_INLINE uint64_t rotate_left(uint64_t x, unsigned bits)
{
    return x << bits | x >> (64 - bits);
}

/* Numbers are little-endian. */
static MW_INLINE uint64_t bytes_as_u64(const unsigned char *p)
{
    uint64_t x;
    memcpy(&x, p, sizeof x);
#if __BYTE_ORDER__ == __ORDER_BIG_ENDIAN__
    x = __builtin_bswap64(x);
#endif
    return x;
}

static MW_INLINE uint32_t bytes_as_u32(const unsigned char *p)
{
    uint32_t x;
    memcpy(&x, p, sizeof x);
#if __BYTE_ORDER__ == __ORDER_BIG_ENDIAN__
    x = __builtin_bswap32(x);
#endif
    return x;
}

static MW_INLINE uint64_t lane_add(uint64_t lane, uint64_t input)
{
    return rotate_left(lane + input * prime[2], 31) * prime[1];
}

static const unsigned char *checksum_add_stripes(mw_checksum *sum, const unsigned char *p,
                                                 const unsigned char *end)
{
    uint64_t a = sum->lane[0], b = sum->lane[1], c = sum->lane[2], d = sum->lane[3];
    for (; end - p >= STRIPE; p += STRIPE) {
        a = lane_add(a, bytes_as_u64(p));
        b = lane_add(b, bytes_as_u64(p + 8));
        c = lane_add(c, bytes_as_u64(p + 16));
        d = lane_add(d, bytes_as_u64(p + 24));
    }
    sum->lane[0] = a;
    sum->lane[1] = b;
    sum->lane[2] = c;
    sum->lane[3] = d;
    return p;
}

void mw__checksum_add(mw_checksum *sum, const void *bytes, size_t size)
{
    const unsigned char *p = bytes, *end = p + size;
    size_t kept = sum->bytes % STRIPE;
    if (size == 0) return;
    if (sum->bytes == 0) {
        sum->lane[0] = prime[1] + prime[2];
        sum->lane[1] = prime[2];
        sum->lane[2] = 0;
        sum->lane[3] = 0 - prime[1];
    }
    sum->bytes += size;
    if (kept > 0) {
        size_t missing = STRIPE - kept, taken = size < missing ? size : missing;
        memcpy(sum->rest + kept, p, taken);
        p += taken;
        if (taken < missing) return;
        checksum_add_stripes(sum, sum->rest, sum->rest + STRIPE);
    }
    p = checksum_add_stripes(sum, p, end);
    if (p < end) memcpy(sum->rest, p, (size_t)(end - p));
}

static uint64_t lanes_join(const uint64_t lane[4])
{
    uint64_t hash = rotate_left(lane[0], 1) + rotate_left(lane[1], 7) + rotate_left(lane[2], 12) +
                    rotate_left(lane[3], 18);
    for (int i = 0; i < 4; i++) hash = (hash ^ lane_add(0, lane[i])) * prime[1] + prime[4];
    return hash;
}

uint64_t mw__checksum_end(const mw_checksum *sum)
{
    const unsigned char *p = sum->rest, *end = p + sum->bytes % STRIPE;
    uint64_t hash = (sum->bytes >= STRIPE ? lanes_join(sum->lane) : prime[5]) + sum->bytes;
    for (; end - p >= 8; p += 8)
        hash = rotate_left(hash ^ lane_add(0, bytes_as_u64(p)), 27) * prime[1] + prime[4];
    for (; end - p >= 4; p += 4)
        hash = rotate_left(hash ^ bytes_as_u32(p) * prime[1], 23) * prime[2] + prime[3];
    for (; p < end; p++) hash = rotate_left(hash ^ *p * prime[5], 11) * prime[1];
    hash = (hash ^ hash >> 33) * prime[2];
    hash = (hash ^ hash >> 29) * prime[3];
    return hash ^ hash >> 32;
}
