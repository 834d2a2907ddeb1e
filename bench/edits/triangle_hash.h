/* triangle_hash.h - are two triangulations the same? The sums of the hashes of their triangles
 * tell. */
#ifndef MW_BENCH_EDITS_TRIANGLE_HASH_H
#define MW_BENCH_EDITS_TRIANGLE_HASH_H

#include <stdint.h>
#include <string.h>

/* It depends neither on which corner comes first nor on the orientation: FNV-1a of whole words
 * [Fowler, Noll, Vo] over the corners in the order of their coordinates, and mixed. */
static inline uint64_t triangle_hash(const double corners[6])
{
    double c[6];
    memcpy(c, corners, sizeof c);
    for (int pass = 0; pass < 3; pass++) { /* bubbles: 0 with 1, 1 with 2, 0 with 1 */
        double *a = c + 2 * (pass % 2), *b = a + 2, x = a[0], y = a[1];
        if (x < b[0] || (x == b[0] && y <= b[1])) continue;
        a[0] = b[0];
        a[1] = b[1];
        b[0] = x;
        b[1] = y;
    }
    uint64_t hash = UINT64_C(14695981039346656037), words[6];
    memcpy(words, c, sizeof words);
    for (int k = 0; k < 6; k++) hash = (hash ^ words[k]) * UINT64_C(1099511628211);
    return (hash ^ (hash >> 31)) * UINT64_C(0x9e3779b97f4a7c15);
}

#endif
