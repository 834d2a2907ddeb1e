#include "cli/output/csv_row.h"

#include <math.h>
#include <meshwalk/base.h>
#include <string.h>

void csv_row_numbers(text *out, const double *values, size_t count)
{
    for (size_t k = 0; k < count; k++) {
        if (k > 0) text_bytes(out, ",", 1);
        text_double(out, values[k]);
    }
}

/* A mark, and a number behind it if `filled`. */
static void row_add_count(text *out, char mark, bool filled, uint32_t value)
{
    char digits[12];
    size_t at = sizeof digits;
    if (filled) {
        do {
            digits[--at] = (char)('0' + value % 10);
            value /= 10;
        } while (value);
    }
    digits[--at] = mark;
    text_bytes(out, digits + at, sizeof digits - at);
}

void csv_row_count(text *out, bool filled, uint32_t value)
{
    row_add_count(out, ',', filled, value);
}

void csv_row_count_more(text *out, uint32_t value)
{
    row_add_count(out, ' ', true, value);
}

void csv_row_double(text *out, bool filled, double value)
{
    text_bytes(out, ",", 1);
    if (filled) text_double(out, value);
}

void csv_row_word(text *out, const char *word)
{
    text_bytes(out, ",", 1);
    text_string(out, word);
}

void csv_row_text(text *out, const char *cell)
{
    size_t length = strlen(cell);
    text_bytes(out, ",", 1);
    bool blank = length > 0 && (cell[0] == ' ' || cell[length - 1] == ' ');
    if (!blank && !cell[strcspn(cell, ",;.\t\"\r\n")]) {
        text_bytes(out, cell, length);
        return;
    }
    text_bytes(out, "\"", 1);
    for (; *cell; cell++) text_bytes(out, *cell == '"' ? "\"\"" : cell, *cell == '"' ? 2 : 1);
    text_bytes(out, "\"", 1);
}

void csv_row_status(text *out, const char *status, uint32_t triangle)
{
    csv_row_word(out, status);
    if (triangle != MW_NONE)
        csv_row_count(out, true, triangle);
    else
        text_bytes(out, ",-1", 3);
}

void csv_row_weights(text *out, uint32_t triangle, const double weight[3])
{
    for (int k = 0; k < 3; k++)
        csv_row_double(out, triangle != MW_NONE && !isnan(weight[k]), weight[k]);
}

void csv_row_adapt(text *out, size_t begin, char separator, char decimal)
{
    if (out->failed || (separator == ',' && decimal == '.')) return;
    bool quoted = false;
    for (char *c = out->bytes + begin, *end = out->bytes + out->size; c < end; c++) {
        if (*c == '"')
            quoted = !quoted;
        else if (*c == ',' && !quoted)
            *c = separator;
        else if (*c == '.' && !quoted)
            *c = decimal;
    }
}

void csv_row_end(text *out)
{
    text_bytes(out, "\n", 1);
}
