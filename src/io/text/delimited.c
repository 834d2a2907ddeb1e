#include "io/text/delimited.h"
#include "base/posix.h"
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

static bool char_separates(char c, char separator)
{
    return separator == ' ' ? char_is_gap(c, separator) : c == separator;
}

bool mw__delimited_is_open(const char *row, char separator, bool open)
{
    bool begins = !open;
    for (const char *p = row; *p; p++) {
        if (open && *p == '"' && p[1] == '"') {
            p++;
        } else if (open) {
            open = *p != '"';
        } else if (begins && *p == '"') {
            open = true;
            begins = false;
        } else {
            begins = char_separates(*p, separator) || (begins && char_is_gap(*p, separator));
        }
    }
    return open;
}

const char *mw__delimited_quote_end(const char *quote)
{
    for (const char *p = quote + 1; *p; p++) {
        if (*p != '"') continue;
        if (p[1] != '"') return p + 1;
        p++;
    }
    return quote + strlen(quote);
}

bool mw__delimited_cell(const char **row, char separator, bool *more, mw_text_cell *cell)
{
    const char *p = *row;
    if (separator == ' ')
        while (char_is_gap(*p, separator)) p++;
    if (!*more || (separator == ' ' && !*p)) return false;
    while (char_is_gap(*p, separator)) p++;
    const char *begin = p;
    p = mw__delimited_skip(p, separator);
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

bool mw__cell_is_missing(mw_text_cell cell)
{
    static const char *const words[] = {"", "-", "na", "n/a", "nan", "null"};
    for (size_t i = 0; i < sizeof words / sizeof *words; i++)
        if (strlen(words[i]) == cell.length && strncasecmp(words[i], cell.text, cell.length) == 0)
            return true;
    return false;
}

/* Are there two cells at least, parted by blanks, that all look like 1,5 (with a comma behind,
 * perhaps)? */
static bool row_has_decimal_commas(const char *row)
{
    size_t count = 0;
    mw_text_cell cell;
    for (bool more = true; mw__delimited_cell(&row, ' ', &more, &cell); count++) {
        if (cell.length > 0 && cell.text[cell.length - 1] == ',') cell.length--;
        if (!memchr(cell.text, ',', cell.length) || memchr(cell.text, '.', cell.length))
            return false;
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

/* Does the row have this character outside of quoted cells, whatever separates them? */
static bool row_has_unquoted(const char *row, char wanted)
{
    char before = ',';
    for (const char *p = row; *p; before = *p++) {
        if (*p == '"' && strchr(";,\t ", before)) {
            p = mw__delimited_quote_end(p);
            if (!*p) return false;
        }
        if (*p == wanted) return true;
    }
    return false;
}

char mw__delimited_separator(const char *row, bool *decimal_comma)
{
    *decimal_comma = false;
    if (row_has_unquoted(row, ';')) return ';';
    if (row_has_unquoted(row, '\t') && row_has_tab_separators(row)) return '\t';
    if (row_has_unquoted(row, ',')) {
        *decimal_comma = row_has_decimal_commas(row);
        return ',';
    }
    return ' ';
}
