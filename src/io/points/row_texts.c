/* The rows of a table as text, one behind the other. */
#include "io/points/row_texts.h"
#include "io/text/byte_source.h"
#include "io/text/delimited.h"

#include <stdlib.h>
#include <string.h>

static mw_status row_texts_reserve(mw_row_texts *t, size_t length, mw_error *error)
{
    if (MW_UNLIKELY(t->capacity - t->size < length)) {
        size_t capacity = 2 * t->capacity + length;
        char *bytes = mw__realloc(t->bytes, capacity, 1);
        if (!bytes) return mw__fail_memory(error);
        t->bytes = bytes;
        t->capacity = capacity;
    }
    if (MW_UNLIKELY(t->count == t->room)) {
        size_t room = 2 * t->room + 64;
        size_t *end = mw__realloc(t->end, room, sizeof *end);
        if (!end) return mw__fail_memory(error);
        t->end = end;
        t->room = room;
    }
    return MW_OK;
}

/* Write a cell that stood between white space as one of a table with commas. Returns its end. */
static char *cell_write(char *out, const char *cell, size_t length)
{
    bool quote = *cell != '"' && (memchr(cell, ',', length) || memchr(cell, '"', length));
    if (quote) *out++ = '"';
    for (size_t i = 0; i < length; i++) {
        if (quote && cell[i] == '"') *out++ = '"';
        *out++ = cell[i];
    }
    if (quote) *out++ = '"';
    return out;
}

/* At most twice as long as the row, and three bytes for each cell. */
static size_t row_write_commas(char *out, const char *row)
{
    char *begin = out;
    for (const char *p = mw__skip_blanks(row); *p; p = mw__skip_blanks(p)) {
        const char *cell = p;
        p = mw__delimited_skip(p, ' ');
        if (out > begin) *out++ = ',';
        out = cell_write(out, cell, (size_t)(p - cell));
    }
    return (size_t)(out - begin);
}

mw_status mw__row_texts_add(mw_row_texts *t, const char *row, size_t length, char separator,
                            mw_error *error)
{
    bool blanks = separator == ' ';
    mw_status status = row_texts_reserve(t, blanks ? 5 * length : length, error);
    if (status) return status;
    if (blanks)
        t->size += row_write_commas(t->bytes + t->size, row);
    else if (length > 0) {
        memcpy(t->bytes + t->size, row, length);
        t->size += length;
    }
    t->end[t->count++] = t->size;
    return MW_OK;
}

const char *mw__row_texts_at(const mw_row_texts *t, size_t row, size_t *length)
{
    size_t begin = row > 0 ? t->end[row - 1] : 0;
    *length = t->end[row] - begin;
    return t->bytes + begin;
}

void mw__row_texts_clear(mw_row_texts *t)
{
    t->size = 0;
    t->count = 0;
}

void mw__row_texts_release(mw_row_texts *t)
{
    free(t->bytes);
    free(t->end);
    *t = (mw_row_texts){0};
}
