/* npz_write.c - a matrix of compressed sparse rows, as scipy.sparse.save_npz() writes it: a ZIP
 * archive of arrays in NumPy's format 1.0, stored without compression.
 *
 * Numbers are little-endian, whatever the machine. */
#include "io/weights/weight_rows.h"

#include <stdio.h>
#include <string.h>
#include <zlib.h>

enum {
    HEAD = 128,    /* bytes of an array's header                 */
    BLOCK = 8192,  /* bytes that are encoded at a time           */
    MEMBERS = 6,   /* of the archive                             */
    LOCAL = 30,    /* bytes of a record before a member ...      */
    CENTRAL = 46,  /* ... of one in the directory at the end ... */
    DIRECTORY = 22 /* ... and of the directory's end             */
};

/* How numbers of an array are made: number i as so many bytes. */
typedef uint64_t npy_number(const mw_weight_rows *rows, size_t i);

typedef struct npy_array {
    const char *name, *type, *shape; /* in NumPy's words */
    npy_number *number;
    size_t size, count; /* bytes of a number, and how many */
} npy_array;

typedef struct npz_archive {
    mw_output *output;
    mw_job *job;
    uint64_t at, total; /* bytes written, and of the whole archive, about */
    uint32_t crc[MEMBERS];
    uint64_t offset[MEMBERS];
} npz_archive;

/* --- numbers ---------------------------------------------------------------------------------- */

static uint64_t npy_index(const mw_weight_rows *rows, size_t i)
{
    return rows->column[i];
}

static uint64_t npy_first(const mw_weight_rows *rows, size_t i)
{
    return rows->first[i];
}

static uint64_t npy_weight(const mw_weight_rows *rows, size_t i)
{
    uint64_t bits;
    memcpy(&bits, &rows->weight[i], sizeof bits);
    return bits;
}

static uint64_t npy_shape(const mw_weight_rows *rows, size_t i)
{
    return i ? rows->info.columns : rows->info.rows;
}

static uint64_t npy_format(const mw_weight_rows *rows, size_t i)
{
    (void)rows;
    return (uint64_t)(unsigned char)"csr"[i];
}

static uint64_t npy_true(const mw_weight_rows *rows, size_t i)
{
    (void)rows;
    (void)i;
    return 1;
}

/* --- bytes ------------------------------------------------------------------------------------ */

static void npz_put(unsigned char *to, uint64_t value, size_t size)
{
    for (size_t i = 0; i < size; i++) to[i] = (unsigned char)(value >> (8 * i));
}

static void npz_write(npz_archive *z, const void *bytes, size_t size)
{
    mw_output_write(z->output, bytes, size);
    z->at += size;
}

/* The header of an array: a dictionary in Python's words, filled up with blanks. */
static void npy_head(const npy_array *a, char head[HEAD + 1])
{
    memcpy(head, "\x93NUMPY\1", 7);
    head[7] = 0;
    npz_put((unsigned char *)head + 8, HEAD - 10, 2);
    snprintf(head + 10, HEAD - 9, "%-*.*s", HEAD - 10, HEAD - 10, "");
    char text[HEAD];
    const int length =
        snprintf(text, sizeof text, "{'descr': '%s', 'fortran_order': False, 'shape': %s, }",
                 a->type, a->shape);
    memcpy(head + 10, text, (size_t)length);
    head[HEAD - 1] = '\n';
}

/* The bytes of an array: their checksum, and written if there is an output for them. */
static uint32_t npy_bytes(const npy_array *a, const mw_weight_rows *rows, npz_archive *z)
{
    char head[HEAD + 1];
    unsigned char block[BLOCK];
    npy_head(a, head);
    uLong crc = crc32(0, (const Bytef *)head, HEAD);
    if (z) npz_write(z, head, HEAD);
    for (size_t from = 0, n; from < a->count; from += n) {
        n = a->count - from < BLOCK / a->size ? a->count - from : BLOCK / a->size;
        for (size_t i = 0; i < n; i++)
            npz_put(block + i * a->size, a->number(rows, from + i), a->size);
        crc = crc32(crc, block, (uInt)(n * a->size));
        if (z) npz_write(z, block, n * a->size);
        if (z && !mw__job_step(z->job, z->at, z->total)) break;
    }
    return (uint32_t)crc;
}

/* --- the archive ------------------------------------------------------------------------------ */

/* What a member's two records share: from the version on, up to the lengths of its name. */
static void npz_record(const npz_archive *z, const npy_array *a, size_t member, unsigned char *to)
{
    const uint64_t size = HEAD + a->size * a->count;
    npz_put(to, 20, 2);            /* version 2.0 reads it */
    npz_put(to + 2, 0, 4);         /* no flags, stored */
    npz_put(to + 6, 33u << 16, 4); /* 1980-01-01: archives of equal weights are equal */
    npz_put(to + 10, z->crc[member], 4);
    npz_put(to + 14, size, 4);
    npz_put(to + 18, size, 4);
    npz_put(to + 22, strlen(a->name), 2);
    npz_put(to + 24, 0, 2);
}

static void npz_member(npz_archive *z, const npy_array *a, size_t member,
                       const mw_weight_rows *rows)
{
    unsigned char record[LOCAL];
    z->crc[member] = npy_bytes(a, rows, NULL);
    z->offset[member] = z->at;
    npz_put(record, 0x04034b50, 4);
    npz_record(z, a, member, record + 4);
    npz_write(z, record, LOCAL);
    npz_write(z, a->name, strlen(a->name));
    npy_bytes(a, rows, z);
}

static void npz_directory(npz_archive *z, const npy_array *arrays)
{
    unsigned char record[CENTRAL] = {0}, end[DIRECTORY] = {0};
    const uint64_t begin = z->at;
    for (size_t i = 0; i < MEMBERS; i++) {
        npz_put(record, 0x02014b50, 4);
        npz_put(record + 4, 20, 2);
        npz_record(z, &arrays[i], i, record + 6);
        npz_put(record + 42, z->offset[i], 4);
        npz_write(z, record, CENTRAL);
        npz_write(z, arrays[i].name, strlen(arrays[i].name));
    }
    npz_put(end, 0x06054b50, 4);
    npz_put(end + 8, MEMBERS, 2);
    npz_put(end + 10, MEMBERS, 2);
    npz_put(end + 12, z->at - begin, 4);
    npz_put(end + 16, begin, 4);
    npz_write(z, end, DIRECTORY);
}

mw_status mw__npz_write(const char *path, const mw_weight_rows *rows, mw_job *job, mw_error *error)
{
    char entries[32], starts[32];
    const size_t n = rows->info.entries, row_count = (size_t)rows->info.rows + 1;
    snprintf(entries, sizeof entries, "(%zu,)", n);
    snprintf(starts, sizeof starts, "(%zu,)", row_count);
    const npy_array arrays[MEMBERS] = {
        {"indices.npy", "<i4", entries, npy_index, 4, n},
        {"indptr.npy", "<i4", starts, npy_first, 4, row_count},
        {"format.npy", "|S3", "()", npy_format, 1, 3},
        {"shape.npy", "<i8", "(2,)", npy_shape, 8, 2},
        {"data.npy", "<f8", entries, npy_weight, 8, n},
        {"_is_array.npy", "|b1", "()", npy_true, 1, 1},
    };
    npz_archive z = {.job = job, .total = 12 * (uint64_t)n + 4 * (uint64_t)row_count + 2000};
    if (z.total > UINT32_MAX)
        return mw__fail(error, MW_ERROR_LIMIT,
                        "%.240s: an .npz must be smaller than 4 GiB; write .nc", path);
    mw_status status = mw_output_open(path, &z.output, error);
    if (status) return status;
    for (size_t i = 0; i < MEMBERS && !mw__job_stopped(job); i++)
        npz_member(&z, &arrays[i], i, rows);
    npz_directory(&z, arrays);
    return mw_output_close(z.output, !mw__job_stopped(job), error);
}
