/* delimited.h - one row of cells with separators between them: telling the separator, taking
 * the row apart. Private. */
#ifndef MW_SRC_IO_TEXT_DELIMITED_H
#define MW_SRC_IO_TEXT_DELIMITED_H

#include "base/base.h"

/* One cell of a row: without the blanks and the quotes around it. */
typedef struct mw_text_cell {
    const char *text;
    size_t length;
} mw_text_cell;

/* The separator of the columns: ';', tab, ',', or ' ' for any white space, from one row.
 * Semicolons win over tabs, tabs over commas, commas over blanks. *decimal_comma is set where
 * the numbers of a row separated by blanks look like 1,5. */
char mw__delimited_separator(const char *row, bool *decimal_comma);

/* Take the next cell off *row; false after the last. Start with *more = true. With ' ' as the
 * separator there are no empty cells. A cell that begins with a double quote is quoted: separators
 * and line ends up to the closing quote are text, and "" is a quote. */
bool mw__delimited_cell(const char **row, char separator, bool *more, mw_text_cell *cell);

/* How many cells a row has. */
size_t mw__delimited_count(const char *row, char separator);

/* Is a quoted cell still open at the end of the text? `open`: one is open at its beginning, which
 * is then in the middle of a row. */
bool mw__delimited_is_open(const char *row, char separator, bool open);

/* What follows the closing quote of a cell that begins with one; the end of the row without one. */
const char *mw__delimited_quote_end(const char *quote);

/* Whether the cell says that there is no value: it is empty, or -, NA, N/A, NaN or NULL in letters
 * of any case. */
bool mw__cell_is_missing(mw_text_cell cell);

/* Whether the whole cell is a number; with ';' and tab as separators a comma is a decimal point
 * too. */
bool mw__cell_is_number(mw_text_cell cell, char separator);

/* Whether a row names columns: no cell is a number, and not all are empty. */
bool mw__delimited_is_header(const char *row, char separator);

/* The end of the cell that begins at p, behind the blanks in front of it. */
static MW_INLINE const char *mw__delimited_skip(const char *p, char separator)
{
    if (MW_UNLIKELY(*p == '"')) p = mw__delimited_quote_end(p);
    if (separator == ' ')
        while (*p && *p != ' ' && *p != '\t') p++;
    else
        while (*p && *p != separator) p++;
    return p;
}

/* With these separators a comma can only be a decimal comma. */
static MW_INLINE bool mw__delimited_takes_comma(char separator)
{
    return separator == ';' || separator == '\t';
}

#endif
