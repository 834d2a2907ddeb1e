#include "io/table.h"
#include "io/number.h"

#include <string.h>

static bool is_gap(char c, char separator)
{
    return c == ' ' || (c == '\t' && separator != '\t');
}

static void trim(mw_text_field *field, char separator)
{
    while (field->length > 0 && is_gap(field->text[0], separator)) field->text++, field->length--;
    while (field->length > 0 && is_gap(field->text[field->length - 1], separator)) field->length--;
}

bool mw__table_field(const char **row, char separator, bool *more, mw_text_field *field)
{
    const char *p = *row;
    if (separator == ' ')
        while (is_gap(*p, separator)) p++;
    if (!*more || (separator == ' ' && !*p)) return false;
    const char *begin = p;
    bool quoted = false;
    for (; *p; p++) {
        if (*p == '"') quoted = !quoted;
        if (!quoted && (separator == ' ' ? is_gap(*p, separator) : *p == separator)) break;
    }
    *field = (mw_text_field){begin, (size_t)(p - begin)};
    trim(field, separator);
    if (field->length >= 2 && field->text[0] == '"' && field->text[field->length - 1] == '"') {
        field->text++;
        field->length -= 2;
    }
    *more = *p != 0;
    *row = *p ? p + 1 : p;
    return true;
}

size_t mw__table_columns(const char *row, char separator)
{
    size_t count = 0;
    mw_text_field field;
    for (bool more = true; mw__table_field(&row, separator, &more, &field);) count++;
    return count;
}

bool mw__table_is_number(mw_text_field field, char separator)
{
    char copy[128];
    if (field.length == 0 || field.length >= sizeof copy) return false;
    memcpy(copy, field.text, field.length);
    copy[field.length] = 0;
    for (char *c = copy; *c && mw__table_takes_comma(separator); c++)
        if (*c == ',') *c = '.';
    double value;
    const char *end = mw__read_double(copy, &value);
    return end && !*end;
}

bool mw__table_is_header(const char *row, char separator)
{
    bool any = false;
    mw_text_field field;
    for (bool more = true; mw__table_field(&row, separator, &more, &field);) {
        if (mw__table_is_number(field, separator)) return false;
        any |= field.length > 0;
    }
    return any;
}

/* Are there two fields at least, parted by blanks, that all look like 1,5 (with a comma behind, perhaps)? */
static bool has_decimal_commas(const char *row)
{
    size_t count = 0;
    mw_text_field field;
    for (bool more = true; mw__table_field(&row, ' ', &more, &field); count++) {
        if (field.length > 0 && field.text[field.length - 1] == ',') field.length--;
        if (!memchr(field.text, ',', field.length) || memchr(field.text, '.', field.length)) return false;
        if (!mw__table_is_number(field, ';')) return false;
    }
    return count >= 2;
}

/* Tabs may also be among blanks that separate, or follow commas. */
static bool tabs_separate(const char *row)
{
    mw_text_field field;
    for (bool more = true; mw__table_field(&row, '\t', &more, &field);) {
        if (field.length > 0 && field.text[field.length - 1] == ',') return false;
        size_t words = 0, numbers = 0;
        mw_text_field word;
        char copy[128];
        if (field.length >= sizeof copy) continue;
        memcpy(copy, field.text, field.length);
        copy[field.length] = 0;
        const char *rest = copy;
        for (bool left = true; mw__table_field(&rest, ' ', &left, &word); words++)
            numbers += mw__table_is_number(word, ' ');
        if (words >= 2 && numbers == words) return false;
    }
    return true;
}

char mw__table_separator(const char *row, bool *decimal_comma)
{
    *decimal_comma = false;
    if (strchr(row, ';')) return ';';
    if (strchr(row, '\t') && tabs_separate(row)) return '\t';
    if (strchr(row, ',')) {
        *decimal_comma = has_decimal_commas(row);
        return ',';
    }
    return ' ';
}
