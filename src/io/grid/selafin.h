/* selafin.h - what the files of TELEMAC hold, in records of Fortran: a length, so many bytes, and
 * the length again. Private. */
#ifndef MW_SRC_IO_GRID_SELAFIN_H
#define MW_SRC_IO_GRID_SELAFIN_H

#include "io/text/byte_source.h"

typedef struct mw_selafin {
    mw_source *source;
    bool big;
    size_t real;        /* bytes of a number: 4 or 8 */
    size_t field_count; /* variables */
    char (*names)[33];  /* of them: 16 characters, then 16 of the unit, without blanks at the end */
    int64_t parameters[10], date[6];
    int64_t elements, vertices, corners;
} mw_selafin;

/* Does a file begin so: a record of 80 bytes that ends with its length, in either byte order? */
bool mw__is_selafin(const char *head, size_t size);

/* Read up to the numbers of elements and vertices. Release it in any case. */
mw_status mw__selafin_start(mw_selafin *s, mw_source *source, mw_error *error);
void mw__selafin_release(mw_selafin *s);

/* The length of the next record; an error if it is not `wanted` (which may be SIZE_MAX: any). */
mw_status mw__selafin_record(mw_selafin *s, uint64_t wanted, const char *what, uint64_t *length,
                             mw_error *error);
/* The length again, behind the record. */
mw_status mw__selafin_record_end(mw_selafin *s, uint64_t length, mw_error *error);
/* The next number of a record, of the file's size. */
mw_status mw__selafin_real(mw_selafin *s, double *value, mw_error *error);
mw_status mw__selafin_integer(mw_selafin *s, int64_t *value, mw_error *error);
/* Read a time; *ended tells that there is none left. */
mw_status mw__selafin_time(mw_selafin *s, double *time, bool *ended, mw_error *error);
/* Read or pass over a record of one number for each vertex. */
mw_status mw__selafin_values(mw_selafin *s, const char *what, double *values, size_t stride,
                             mw_error *error);
mw_status mw__selafin_skip(mw_selafin *s, mw_error *error);

#endif
