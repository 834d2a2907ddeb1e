/* table.h - rows of text with separators: telling the separator, taking a row apart. Private. */
#ifndef MW_SRC_IO_TABLE_H
#define MW_SRC_IO_TABLE_H

#include "base/base.h"

/* One field of a row: without the blanks and the quotes around it. */
typedef struct mw_text_field {
    const char *text;
    size_t length;
} mw_text_field;

/* The separator of the columns: ';', tab, ',', or ' ' for any white space, from one row. Semicolons win over tabs, tabs
 * over commas, commas over blanks. *decimal_comma is set where the numbers of a row separated by blanks look like
 * 1,5. */
char mw__table_separator(const char *row, bool *decimal_comma);

/* Take the next field off *row; false after the last. Start with *more = true. With ' ' as the separator there are no
 * empty fields. A separator between double quotes is text. */
bool mw__table_field(const char **row, char separator, bool *more, mw_text_field *field);

size_t mw__table_columns(const char *row, char separator);

/* Whether the whole field is a number; with ';' and tab as separators a comma is a decimal point too. */
bool mw__table_is_number(mw_text_field field, char separator);

/* Whether a row names columns: no field is a number, and not all are empty. */
bool mw__table_is_header(const char *row, char separator);

/* With these separators a comma can only be a decimal comma. */
static MW_INLINE bool mw__table_takes_comma(char separator)
{
    return separator == ';' || separator == '\t';
}

#endif
