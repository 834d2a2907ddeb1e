/* field_rows.h - copies fields stored one after another so that their values lie side by side, a
 * few fields at a time. Private; for this room only.
 *
 * A scattered row then reads and writes whole cache lines. Otherwise it would use a single number
 * of each line. */
#ifndef MW_SRC_OPERATOR_FIELD_ROWS_H
#define MW_SRC_OPERATOR_FIELD_ROWS_H

#include "base/job.h"

/* `count` fields of `n` values of `size` bytes: value i of field k is at i * stride + k * step (in
 * values). A row is a cache line, and value k of line i is that of field k. */
typedef struct mw_field_rows {
    char *fields, *rows;
    const uint32_t *place; /* the line of value i is place[i]; NULL: it is i */
    size_t n, count, size, stride, step;
} mw_field_rows;

/* From fields to rows if there is a `place`, from rows to fields otherwise. A stage of the job;
 * returns false if that is to stop. */
bool mw__field_rows_copy(const mw_field_rows *f, mw_job *job);

#endif
