#include "io/grid/byte_array.h"

#include <stdlib.h>
#include <string.h>
#include <zlib.h>

static bool bytes_reserve(mw_byte_array *array, size_t more)
{
    if (array->room - array->size >= more) return true;
    size_t room = array->room + array->room / 2;
    if (room < array->size + more) room = array->size + more;
    unsigned char *larger = mw__realloc(array->bytes, room, 1);
    if (!larger) return false;
    array->bytes = larger;
    array->room = room;
    return true;
}

mw_status mw__bytes_add(mw_byte_array *array, const void *bytes, size_t size, mw_error *error)
{
    if (!bytes_reserve(array, size + 1)) return mw__fail_memory(error);
    if (size) memcpy(array->bytes + array->size, bytes, size);
    array->size += size;
    array->bytes[array->size] = 0;
    return MW_OK;
}

mw_status mw__bytes_read(mw_byte_array *array, mw_source *source, mw_error *error)
{
    for (;;) {
        const char *next;
        const unsigned char *bytes;
        size_t size;
        mw_status status = mw__source_peek(source, MW_BYTES_LIMIT, &next, &size, error);
        /* at the end of a damaged input, asking for one more byte gives its error */
        if (!status && size == 0 && !source->damage) return MW_OK;
        if (!status) status = mw__source_bytes(source, size ? size : 1, &bytes, error);
        if (!status) status = mw__bytes_add(array, bytes, size, error);
        if (status) return status;
    }
}

mw_status mw__bytes_unpack(mw_byte_array *array, const unsigned char *packed, size_t size,
                           bool alone, size_t limit, bool *sound, mw_error *error)
{
    z_stream z = {.next_in = (unsigned char *)(uintptr_t)packed};
    int result = inflateInit2(&z, alone ? -MAX_WBITS : MAX_WBITS);
    *sound = false;
    if (result != Z_OK) return mw__fail_memory(error);
    size_t left = size, begin = array->size;
    mw_status status = MW_OK;
    do {
        unsigned char block[16384];
        size_t piece = left < (1u << 30) ? left : 1u << 30;
        z.avail_in = (unsigned)piece;
        z.next_out = block;
        z.avail_out = sizeof block;
        result = inflate(&z, Z_NO_FLUSH);
        left -= piece - z.avail_in;
        size_t made = sizeof block - z.avail_out;
        if (made > limit - (array->size - begin)) break;
        if (result == Z_MEM_ERROR) status = mw__fail_memory(error);
        if (!status) status = mw__bytes_add(array, block, made, error);
    } while (!status && result == Z_OK);
    *sound = result == Z_STREAM_END;
    inflateEnd(&z);
    return status;
}

static int base64_value(unsigned char c)
{
    if (c >= 'A' && c <= 'Z') return c - 'A';
    if (c >= 'a' && c <= 'z') return c - 'a' + 26;
    if (c >= '0' && c <= '9') return c - '0' + 52;
    return c == '+' ? 62 : c == '/' ? 63 : c == '=' ? 64 : -1;
}

mw_status mw__bytes_decode(mw_byte_array *array, const unsigned char *text, size_t size,
                           mw_error *error)
{
    uint32_t bits = 0;
    int have = 0, padding = 0;
    if (!bytes_reserve(array, size / 4 * 3 + 4)) return mw__fail_memory(error);
    for (size_t i = 0; i < size; i++) {
        int value = base64_value(text[i]);
        if (value < 0 && (text[i] == ' ' || (text[i] >= '\t' && text[i] <= '\r'))) continue;
        if (value < 0) break;
        padding += value == 64;
        bits = bits << 6 | (uint32_t)(value & 63);
        if (++have < 4) continue;
        for (int k = 0; k < 3 - (padding < 3 ? padding : 3); k++)
            array->bytes[array->size++] = (unsigned char)(bits >> (16 - 8 * k));
        bits = 0;
        have = padding = 0;
    }
    array->bytes[array->size] = 0;
    return MW_OK;
}
