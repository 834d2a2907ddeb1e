#include "prepared/tiles/blake2b.h"

#include <string.h>

/* The fractions of the square roots of the first eight primes. */
static const uint64_t roots[8] = {
    UINT64_C(0x6a09e667f3bcc908), UINT64_C(0xbb67ae8584caa73b), UINT64_C(0x3c6ef372fe94f82b),
    UINT64_C(0xa54ff53a5f1d36f1), UINT64_C(0x510e527fade682d1), UINT64_C(0x9b05688c2b3e6c1f),
    UINT64_C(0x1f83d9abfb41bd6b), UINT64_C(0x5be0cd19137e2179),
};

/* Which words of the block each round mixes in; rounds 10 and 11 are as 0 and 1. */
static const unsigned char schedule[10][16] = {
    {0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15},
    {14, 10, 4, 8, 9, 15, 13, 6, 1, 12, 0, 2, 11, 7, 5, 3},
    {11, 8, 12, 0, 5, 2, 15, 13, 10, 14, 3, 6, 7, 1, 9, 4},
    {7, 9, 3, 1, 13, 12, 11, 14, 2, 6, 5, 10, 4, 0, 15, 8},
    {9, 0, 5, 7, 2, 4, 10, 15, 14, 1, 11, 12, 6, 8, 3, 13},
    {2, 12, 6, 10, 0, 11, 8, 3, 4, 13, 7, 5, 15, 14, 1, 9},
    {12, 5, 1, 15, 14, 13, 4, 10, 0, 7, 6, 3, 9, 2, 8, 11},
    {13, 11, 7, 14, 12, 1, 3, 9, 5, 0, 15, 4, 8, 6, 2, 10},
    {6, 15, 14, 9, 11, 3, 0, 8, 12, 2, 13, 7, 1, 4, 10, 5},
    {10, 2, 8, 4, 7, 6, 1, 5, 15, 11, 9, 14, 3, 12, 13, 0},
};

static uint64_t turn(uint64_t word, unsigned bits)
{
    return word >> bits | word << (64 - bits);
}

static void mix(uint64_t *v, const unsigned char at[4], uint64_t x, uint64_t y)
{
    uint64_t a = v[at[0]], b = v[at[1]], c = v[at[2]], d = v[at[3]];
    a += b + x;
    d = turn(d ^ a, 32);
    c += d;
    b = turn(b ^ c, 24);
    a += b + y;
    d = turn(d ^ a, 16);
    c += d;
    b = turn(b ^ c, 63);
    v[at[0]] = a;
    v[at[1]] = b;
    v[at[2]] = c;
    v[at[3]] = d;
}

static uint64_t word_of(const unsigned char *bytes)
{
    uint64_t word = 0;
    for (int k = 7; k >= 0; k--) word = word << 8 | bytes[k];
    return word;
}

/* Mix in the block. */
static void block_mix(mw_blake2b *hash, bool last)
{
    /* columns, then diagonals, of the sixteen words as a square */
    static const unsigned char quarter[8][4] = {
        {0, 4, 8, 12},  {1, 5, 9, 13},  {2, 6, 10, 14}, {3, 7, 11, 15},
        {0, 5, 10, 15}, {1, 6, 11, 12}, {2, 7, 8, 13},  {3, 4, 9, 14},
    };
    uint64_t v[16], word[16];
    for (int i = 0; i < 16; i++) word[i] = word_of(hash->block + 8 * i);
    memcpy(v, hash->state, sizeof hash->state);
    memcpy(v + 8, roots, sizeof roots);
    hash->bytes += hash->used;
    v[12] ^= hash->bytes;
    if (last) v[14] = ~v[14];
    for (int round = 0; round < 12; round++) {
        const unsigned char *s = schedule[round % 10];
        for (int i = 0; i < 8; i++) mix(v, quarter[i], word[s[2 * i]], word[s[2 * i + 1]]);
    }
    for (int i = 0; i < 8; i++) hash->state[i] ^= v[i] ^ v[i + 8];
    hash->used = 0;
}

mw_blake2b mw__blake2b(void)
{
    mw_blake2b hash = {0};
    memcpy(hash.state, roots, sizeof roots);
    hash.state[0] ^= UINT64_C(0x01010008); /* no key, a digest of 8 bytes */
    return hash;
}

void mw__blake2b_add(mw_blake2b *hash, const void *bytes, size_t size)
{
    const unsigned char *from = bytes;
    while (size > 0) {
        if (hash->used == sizeof hash->block) block_mix(hash, false);
        const size_t room = sizeof hash->block - hash->used, taken = size < room ? size : room;
        memcpy(hash->block + hash->used, from, taken);
        hash->used += taken;
        from += taken;
        size -= taken;
    }
}

uint64_t mw__blake2b_end(mw_blake2b *hash)
{
    uint64_t digest = 0;
    memset(hash->block + hash->used, 0, sizeof hash->block - hash->used);
    block_mix(hash, true);
    for (int k = 0; k < 8; k++) digest = digest << 8 | (hash->state[0] >> (8 * k) & 0xff);
    return digest;
}
