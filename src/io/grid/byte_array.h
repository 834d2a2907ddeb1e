/* byte_array.h - bytes in memory: a whole input, and what is unpacked from a part of it. Private.
 *
 * They grow with what is there, not with what a header announces. */
#ifndef MW_SRC_IO_GRID_BYTE_ARRAY_H
#define MW_SRC_IO_GRID_BYTE_ARRAY_H

#include "io/text/byte_source.h"

/* All zero: empty. Release the bytes with free(). */
typedef struct mw_byte_array {
    unsigned char *bytes;
    size_t size, room;
} mw_byte_array;

mw_status mw__bytes_add(mw_byte_array *array, const void *bytes, size_t size, mw_error *error);
/* All that is left of a source. */
mw_status mw__bytes_read(mw_byte_array *array, mw_source *source, mw_error *error);

/* Add what packed bytes hold, at most `limit` bytes: by zlib, or by deflate alone. *sound tells
 * whether they are whole. */
mw_status mw__bytes_unpack(mw_byte_array *array, const unsigned char *packed, size_t size,
                           bool alone, size_t limit, bool *sound, mw_error *error);

/* Add what text in base64 stands for. Blanks and line ends are passed over; it may be several
 * texts with "=" at their ends, one behind the other. It ends at any other character. */
mw_status mw__bytes_decode(mw_byte_array *array, const unsigned char *text, size_t size,
                           mw_error *error);

#endif
