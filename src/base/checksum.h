/* checksum.h - XXH64, a checksum of 64 bits, as its specification defines it [Collet 2016], with
 * seed 0. Private. It finds damage, not forgery. */
#ifndef MW_SRC_BASE_CHECKSUM_H
#define MW_SRC_BASE_CHECKSUM_H

#include "base/base.h"

/* A checksum under way. Zero-initialised, it has seen no bytes. */
typedef struct mw_checksum {
    uint64_t lane[4];
    uint64_t bytes;         /* seen so far */
    unsigned char rest[32]; /* the last bytes % 32 of them */
} mw_checksum;

/* The next bytes; how they are cut into calls makes no difference. */
void mw__checksum_add(mw_checksum *sum, const void *bytes, size_t size);
/* The checksum of all bytes so far. */
uint64_t mw__checksum_end(const mw_checksum *sum);

static inline uint64_t mw__checksum_of(const void *bytes, size_t size)
{
    mw_checksum sum = {0};
    mw__checksum_add(&sum, bytes, size);
    return mw__checksum_end(&sum);
}

#endif
