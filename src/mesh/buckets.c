/* buckets.c - distributes the triangles of the caller's arrays to buckets. */
#include "mesh/buckets.h"

#include "mesh/arrays.h"

#include <stdlib.h>

static size_t bucket_share_begin(const mw_buckets *p, uint32_t writer)
{
    return p->triangle_count * writer / p->writers;
}

/* The first block of a writer. Each of its buckets may have one block that is not full. */
static size_t writer_first_block(const mw_buckets *p, uint32_t writer)
{
    return bucket_share_begin(p, writer) / MW_BUCKET_BLOCK + (size_t)writer * (p->ranges + 1);
}

size_t mw__buckets_capacity(const mw_buckets *buckets)
{
    return writer_first_block(buckets, buckets->writers) * MW_BUCKET_BLOCK;
}

/* --- reading the arrays --- */

typedef struct bucket_source {
    const mw_mesh *mesh;
    const mw_arrays *arrays;
    bool all_finite;
} bucket_source;

/* Read triangles from number t on. Returns false if some vertex number is out of range. The loop
 * looks slots up without a branch, so that many look-ups run at the same time. */
static MW_INLINE bool raw_triangles_read_as(const bucket_source *s, mw_integer_type type, size_t t,
                                            uint32_t count, mw_raw_triangle *out)
{
    const mw_arrays arrays = {.triangles = s->arrays->triangles, .integer_type = type};
    const uint32_t *slot = s->mesh->vertex_slot, n = s->mesh->point_count;
    bool right = true;
    for (uint32_t i = 0; i < count; i++) {
        for (uint32_t k = 0; k < 3; k++) {
            uint32_t given = mw__index_at(&arrays, 3 * (t + i) + k);
            right &= given < n;
            out[i].v[k] = slot[given < n ? given : 0];
        }
        out[i].user = (uint32_t)t + i;
    }
    return right;
}

static bool raw_triangles_read(const bucket_source *s, size_t t, uint32_t count,
                               mw_raw_triangle *out)
{
    switch (s->arrays->integer_type) {
    case MW_INT32: return raw_triangles_read_as(s, MW_INT32, t, count, out);
    case MW_INT64: return raw_triangles_read_as(s, MW_INT64, t, count, out);
    default: return raw_triangles_read_as(s, MW_UINT32, t, count, out);
    }
}

/* Reads the arrays again. */
static bool triangle_is_usable(const bucket_source *s, size_t t)
{
    const mw_mesh *mesh = s->mesh;
    for (size_t k = 0; k < 3; k++) {
        uint32_t v = mw__index_at(s->arrays, 3 * t + k);
        if (v >= mesh->point_count || v == mw__index_at(s->arrays, 3 * t + (k + 1) % 3))
            return false;
        if (!mw__is_finite(mesh->point[mesh->vertex_slot[v]])) return false;
    }
    return true;
}

/* --- writing buckets --- */

typedef struct bucket_writer {
    mw_raw_triangle *raw;
    mw_bucket *bucket;
    uint32_t *next_block, free; /* the next unused block */
} bucket_writer;

static MW_INLINE void bucket_writer_put(bucket_writer *s, uint32_t range,
                                        const mw_raw_triangle *corners)
{
    mw_bucket *bucket = &s->bucket[range];
    if (MW_UNLIKELY(bucket->next % MW_BUCKET_BLOCK == 0)) {
        uint32_t block = s->free++;
        if (bucket->blocks++)
            s->next_block[bucket->next / MW_BUCKET_BLOCK - 1] = block;
        else
            bucket->first = block;
        bucket->next = block * MW_BUCKET_BLOCK;
    }
    s->raw[bucket->next++] = *corners;
}

/* Returns the first unusable triangle of the share, or MW_NONE. */
static uint32_t bucket_writer_fill(const mw_buckets *buckets, const bucket_source *from,
                                   uint32_t share)
{
    enum { BATCH = 64 };
    mw_raw_triangle batch[BATCH];
    bucket_writer s = {buckets->raw, buckets->bucket + (size_t)share * buckets->ranges,
                       buckets->next_block, (uint32_t)writer_first_block(buckets, share)};
    size_t end = bucket_share_begin(buckets, share + 1);
    for (size_t t = bucket_share_begin(buckets, share), count; t < end; t += count) {
        count = end - t < BATCH ? end - t : BATCH;
        bool good = raw_triangles_read(from, t, (uint32_t)count, batch) && from->all_finite;
        for (uint32_t i = 0; i < count; i++) {
            const uint32_t *v = batch[i].v;
            bool doubtful = !good | (v[0] == v[1]) | (v[1] == v[2]) | (v[2] == v[0]);
            if (MW_UNLIKELY(doubtful) && !triangle_is_usable(from, t + i)) return (uint32_t)t + i;
            bucket_writer_put(
                &s, (uint32_t)((uint64_t)mw__lowest_of_three(v[0], v[1], v[2]) >> buckets->shift),
                &batch[i]);
        }
    }
    return MW_NONE;
}

typedef struct bucket_filling {
    const mw_buckets *buckets;
    bucket_source source;
    _Atomic uint32_t bad; /* the first unusable triangle found so far, or MW_NONE */
} bucket_filling;

static void bucket_fill_share(void *work, uint64_t share, uint32_t member)
{
    bucket_filling *filling = work;
    (void)member;
    uint32_t found = bucket_writer_fill(filling->buckets, &filling->source, (uint32_t)share);
    uint32_t known = atomic_load(&filling->bad);
    while (found < known && !atomic_compare_exchange_weak(&filling->bad, &known, found)) {
    }
}

bool mw__buckets_fill(mw_buckets *buckets, const mw_mesh *mesh, const mw_arrays *arrays,
                      bool all_finite, mw_job *job, uint32_t *bad)
{
    *bad = MW_NONE;
    mw__job_stage(job, "distributing triangles", 0.2);
    buckets->next_block =
        mw__alloc(writer_first_block(buckets, buckets->writers), sizeof *buckets->next_block);
    buckets->bucket =
        mw__calloc((size_t)buckets->writers * buckets->ranges, sizeof *buckets->bucket);
    if (!buckets->next_block || !buckets->bucket) return false;
    bucket_filling filling = {buckets, {mesh, arrays, all_finite}, MW_NONE};
    bool done =
        mw__job_chunks(job, buckets->writers, buckets->writers, bucket_fill_share, &filling);
    *bad = filling.bad;
    return done;
}

void mw__buckets_release(mw_buckets *buckets)
{
    free(buckets->next_block);
    free(buckets->bucket);
}

/* --- reading buckets --- */

static uint32_t bucket_size(const mw_bucket *bucket)
{
    if (bucket->blocks == 0) return 0;
    return (bucket->blocks - 1) * MW_BUCKET_BLOCK + (bucket->next - 1) % MW_BUCKET_BLOCK + 1;
}

static const mw_bucket *bucket_of(const mw_buckets *buckets, uint32_t share, uint32_t range)
{
    return &buckets->bucket[(size_t)share * buckets->ranges + range];
}

uint32_t mw__buckets_count(const mw_buckets *buckets, uint32_t range)
{
    uint32_t sum = 0;
    for (uint32_t s = 0; s < buckets->writers; s++)
        sum += bucket_size(bucket_of(buckets, s, range));
    return sum;
}

const mw_raw_triangle *mw__bucket_read_block(mw_bucket_reader *r, uint32_t *count)
{
    enum { LINE = 64 / sizeof(mw_raw_triangle) };
    while (r->left == 0) {
        if (r->writer == r->buckets->writers) return NULL;
        const mw_bucket *bucket = bucket_of(r->buckets, r->writer++, r->range);
        r->left = bucket_size(bucket);
        r->block = bucket->first;
    }
    const mw_raw_triangle *here = r->buckets->raw + (size_t)r->block * MW_BUCKET_BLOCK;
    *count = r->left < MW_BUCKET_BLOCK ? r->left : MW_BUCKET_BLOCK;
    r->left -= *count;
    if (r->left == 0) return here;
    r->block = r->buckets->next_block[r->block];
    const mw_raw_triangle *after = r->buckets->raw + (size_t)r->block * MW_BUCKET_BLOCK;
    for (uint32_t i = 0; i < MW_BUCKET_BLOCK; i += LINE) __builtin_prefetch(&after[i]);
    return here;
}
