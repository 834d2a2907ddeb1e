#include "io/text/delimited.h"
#include "io/text/number_text.h"

#include <string.h>

static bool char_is_gap(char c, char separator)
{
    return c == ' ' || (c == '\t' && separator != '\t');
}

static void cell_trim(mw_text_cell *cell, char separator)
{
    while (cell->length > 0 && char_is_gap(cell->text[0], separator)) cell->text++, cell->length--;
    while (cell->length > 0 && char_is_gap(cell->text[cell->length - 1], separator)) cell->length--;
}

bool mw__delimited_cell(const char **row, char separator, bool *more, mw_text_cell *cell)
{
    const char *p = *row;
    if (separator == ' ')
        while (char_is_gap(*p, separator)) p++;
    if (!*more || (separator == ' ' && !*p)) return false;
    const char *begin = p;
    bool quoted = false;
    for (; *p; p++) {
        if (*p == '"') quoted = !quoted;
        if (!quoted && (separator == ' ' ? char_is_gap(*p, separator) : *p == separator)) break;
    }
    *cell = (mw_text_cell){begin, (size_t)(p - begin)};
    cell_trim(cell, separator);
    if (cell->length >= 2 && cell->text[0] == '"' && cell->text[cell->length - 1] == '"') {
        cell->text++;
        cell->length -= 2;
    }
    *more = *p != 0;
    *row = *p ? p + 1 : p;
    return true;
}

size_t mw__delimited_count(const char *row, char separator)
{
    size_t count = 0;
    mw_text_cell cell;
    for (bool more = true; mw__delimited_cell(&row, separator, &more, &cell);) count++;
    return count;
}

bool mw__cell_is_number(mw_text_cell cell, char separator)
{
    char copy[128];
    if (cell.length == 0 || cell.length >= sizeof copy) return false;
    memcpy(copy, cell.text, cell.length);
    copy[cell.length] = 0;
    for (char *c = copy; *c && mw__delimited_takes_comma(separator); c++)
        if (*c == ',') *c = '.';
    double value;
    const char *end = mw__read_double(copy, &value);
    return end && !*end;
}

bool mw__delimited_is_header(const char *row, char separator)
{
    bool any = false;
    mw_text_cell cell;
    for (bool more = true; mw__delimited_cell(&row, separator, &more, &cell);) {
        if (mw__cell_is_number(cell, separator)) return false;
        any |= cell.length > 0;
    }
    return any;
}

/* Are there two cells at least, parted by blanks, that all look like 1,5 (with a comma behind,
 * perhaps)? */
static bool row_has_decimal_commas(const char *row)
{
    size_t count = 0;
    mw_text_cell cell;
    for (bool more = true; mw__delimited_cell(&row, ' ', &more, &cell); count++) {
        if (cell.length > 0 && cell.text[cell.length - 1] == ',') cell.length--;
        if (!memchr(cell.text, ',', cell.length) || memchr(cell.text, '.', cell.length)) return false;
        if (!mw__cell_is_number(cell, ';')) return false;
    }
    return count >= 2;
}

/* Tabs may also be among blanks that separate, or follow commas. */
static bool row_has_tab_separators(const char *row)
{
    mw_text_cell cell;
    for (bool more = true; mw__delimited_cell(&row, '\t', &more, &cell);) {
        if (cell.length > 0 && cell.text[cell.length - 1] == ',') return false;
        size_t words = 0, numbers = 0;
        mw_text_cell word;
        char copy[128];
        if (cell.length >= sizeof copy) continue;
        memcpy(copy, cell.text, cell.length);
        copy[cell.length] = 0;
        const char *rest = copy;
        for (bool left = true; mw__delimited_cell(&rest, ' ', &left, &word); words++)
            numbers += mw__cell_is_number(word, ' ');
        if (words >= 2 && numbers == words) return false;
    }
    return true;
}

char mw__delimited_separator(const char *row, bool *decimal_comma)
{
    *decimal_comma = false;
    if (strchr(row, ';')) return ';';
    if (strchr(row, '\t') && row_has_tab_separators(row)) return '\t';
    if (strchr(row, ',')) {
        *decimal_comma = row_has_decimal_commas(row);
        return ',';
    }
    return ' ';
}
