/* buckets.h - the triangles of the caller's arrays, distributed to buckets by their lowest vertices
 * (a bucket sort). Private.
 *
 * The sizes of the buckets are not known beforehand. So a bucket is a list of blocks, taken when
 * they are needed, and the arrays are read only once. */
#ifndef MW_SRC_MESH_BUCKETS_H
#define MW_SRC_MESH_BUCKETS_H

#include "base/job.h"
#include "mesh/mesh.h"

/* A triangle: its vertices by slot, and its number in the arrays. */
typedef struct mw_raw_triangle {
    uint32_t v[3], user;
} mw_raw_triangle;

#define MW_BUCKET_BLOCK 64u /* triangles */

typedef struct mw_bucket {
    /* Where the next triangle goes; a multiple of MW_BUCKET_BLOCK: into a new block. */
    uint32_t next;
    uint32_t first, blocks; /* the first block, and the number of blocks */
} mw_bucket;

/* Each writer (a thread) has a bucket for each range of 2^shift vertices and distributes its share
 * of the arrays. The share of writer 0 comes first in the arrays, then that of writer 1, and so
 * on. */
typedef struct mw_buckets {
    mw_raw_triangle *raw;
    uint32_t *next_block; /* per block: the next block of its bucket */
    mw_bucket *bucket;    /* those of writer 0, of writer 1, ... */
    uint32_t ranges, shift, writers;
    size_t triangle_count;
} mw_buckets;

/* The number of triangles that `raw`, which the caller provides, must have room for. Some blocks
 * are not full. */
size_t mw__buckets_capacity(const mw_buckets *buckets);

/* Distribute the triangles of the arrays to buckets. The mesh has its vertices already. *bad
 * becomes the first unusable triangle, and then the buckets are unusable, too; otherwise MW_NONE.
 * all_finite: are all vertices finite? A stage that takes 0.2 of the present part. Returns false
 * when out of memory, or cancelled. Release in either case. */
bool mw__buckets_fill(mw_buckets *buckets, const mw_mesh *mesh, const mw_arrays *arrays,
                      bool all_finite, mw_job *job, uint32_t *bad);
void mw__buckets_release(mw_buckets *buckets);

/* The number of triangles in a range. */
uint32_t mw__buckets_count(const mw_buckets *buckets, uint32_t range);

/* Reads the buckets of a range, in the order of the arrays. */
typedef struct mw_bucket_reader {
    const mw_buckets *buckets;
    uint32_t range, writer, block, left;
} mw_bucket_reader;

static MW_INLINE mw_bucket_reader mw__bucket_reader_begin(const mw_buckets *buckets, uint32_t range)
{
    return (mw_bucket_reader){.buckets = buckets, .range = range};
}

/* The next block, with *count triangles; NULL at the end. */
const mw_raw_triangle *mw__bucket_read_block(mw_bucket_reader *reader, uint32_t *count);

#endif
