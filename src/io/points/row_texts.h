/* row_texts.h - the rows of a table as text, kept beside the numbers read from them. Private. */
#ifndef MW_SRC_IO_POINTS_ROW_TEXTS_H
#define MW_SRC_IO_POINTS_ROW_TEXTS_H

#include "base/base.h"

/* A block of rows ends when their texts have so many bytes, so that memory stays bounded. */
#define MW_ROW_TEXTS_LIMIT ((size_t)1 << 26)

/* All zero = no rows. */
typedef struct mw_row_texts {
    char *bytes;
    size_t size, capacity;
    size_t *end; /* of each row in `bytes` */
    size_t count, room;
} mw_row_texts;

/* Add a row as it stands. White space as the separator (' ') is replaced by commas; a cell that
 * holds a comma is then quoted. */
mw_status mw__row_texts_add(mw_row_texts *texts, const char *row, size_t length, char separator,
                            mw_error *error);
/* The text of a row, its length in *length; it is not ended by NUL. */
const char *mw__row_texts_at(const mw_row_texts *texts, size_t row, size_t *length);
void mw__row_texts_clear(mw_row_texts *texts); /* keeps the memory */
void mw__row_texts_release(mw_row_texts *texts);

#endif
