/* prepared.h - a mesh and its locator over the bytes of a prepared file. Private.
 *
 * Opening is done in steps: the header is checked, mesh and locator get pointers into the bytes,
 * and, unless the file is trusted, what they point to is checked. */
#ifndef MW_SRC_PREPARED_PREPARED_H
#define MW_SRC_PREPARED_PREPARED_H

#include "base/job.h"
#include "locate/locator.h"
#include "prepared/prepared_format.h"

struct mw_prepared {
    mw_mesh mesh;       /* its arrays are in the file; the list of its fields is not */
    mw_locator locator; /* as are those of the tiling, the guide and the border tree */
    mw_mesh_file values;
    mw_prepared_header header;
    const unsigned char *bytes; /* of the file; at a multiple of MW_PREPARED_ALIGN */
    const char *name;           /* of the file, for messages; valid while it is opened */
    bool trusted;
};

/* Open a file whose bytes are in memory, and stay there until it is released. `p` is all zero
 * before; release it in either case. MW_ERROR_INPUT, MW_ERROR_MEMORY. Stages of the present
 * part. */
mw_status mw__prepared_open(mw_prepared *p, const char *name, const void *bytes, size_t size,
                            bool trust, mw_job *job, mw_error *error);
void mw__prepared_release(mw_prepared *p);

/* The records of a part, NULL if it is not there. */
static inline const void *mw__prepared_records(const mw_prepared *p, mw_prepared_kind kind)
{
    const mw_prepared_part *part = &p->header.part[kind];
    return part->bytes ? p->bytes + part->offset : NULL;
}

/* Can a locator be written? MW_ERROR_ARGUMENT. */
mw_status mw__prepared_check_locator(const mw_locator *locator, mw_error *error);

/* MW_ERROR_INPUT: "NAME: a damaged prepared mesh: ...". */
mw_status mw__prepared_fail(const mw_prepared *p, mw_error *error, const char *format, ...)
    __attribute__((format(printf, 3, 4)));

#endif
