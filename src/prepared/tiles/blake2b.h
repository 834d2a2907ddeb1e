/* blake2b.h - BLAKE2b with a digest of 8 bytes [Saarinen, Aumasson 2015]: the checksum of the index
 * of tiles, which Python's hashlib knows. Private. */
#ifndef MW_SRC_PREPARED_TILES_BLAKE2B_H
#define MW_SRC_PREPARED_TILES_BLAKE2B_H

#include "base/base.h"

typedef struct mw_blake2b {
    uint64_t state[8];
    uint64_t bytes;           /* that were mixed in */
    unsigned char block[128]; /* bytes that were not */
    size_t used;
} mw_blake2b;

mw_blake2b mw__blake2b(void);
void mw__blake2b_add(mw_blake2b *hash, const void *bytes, size_t size);
/* The digest, its first byte the highest. */
uint64_t mw__blake2b_end(mw_blake2b *hash);

#endif
