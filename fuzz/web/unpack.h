/* unpack.h - unpacks bytes by zlib's interface, as the library does. It is compiled twice: with
 * zlib, and, under other names, with the page's own inflater. */
#ifndef MW_FUZZ_UNPACK_H
#define MW_FUZZ_UNPACK_H

#include <stdbool.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <unistd.h>

enum { UNPACK_LIMIT = 1 << 20 }; /* bytes made */

/* UNPACK_MORE: the limit is reached. */
typedef enum unpack_end { UNPACK_WHOLE, UNPACK_MORE, UNPACK_SHORT, UNPACK_DAMAGED } unpack_end;

typedef struct unpacked {
    unpack_end end;
    size_t size;
    size_t used; /* bytes of the input; of files 0 */
    unsigned char bytes[UNPACK_LIMIT];
} unpacked;

/* The bytes that the page's inflater makes, at most `room` at a time. */
void page_unpack_stream(unpacked *u, const uint8_t *data, size_t size, int window_bits,
                        size_t room);
void page_unpack_file(unpacked *u, const uint8_t *data, size_t size, size_t room);

#endif
