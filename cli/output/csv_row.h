/* csv_row.h - the cells of a row of answers, as CSV. Every cell but the first begins with a
 * comma. */
#ifndef MW_CLI_OUTPUT_CSV_ROW_H
#define MW_CLI_OUTPUT_CSV_ROW_H

#include "cli/frame/text.h"

/* The numbers of the query, which are the first cells of its row. */
void csv_row_numbers(text *out, const double *values, size_t count);
/* A word, which holds no comma. */
void csv_row_word(text *out, const char *word);
/* The status, and the triangle's number: -1 for MW_NONE. */
void csv_row_status(text *out, const char *status, uint32_t triangle);
/* Any text, in quotes where a table needs them. */
void csv_row_text(text *out, const char *cell);
/* A number; an empty cell if not `filled`. */
void csv_row_count(text *out, bool filled, uint32_t value);
/* One more number in the same cell, behind a blank. */
void csv_row_count_more(text *out, uint32_t value);
void csv_row_double(text *out, bool filled, double value);
/* The weights of the triangle's corners; empty cells for unknown weights (NaN), and if the triangle
 * is MW_NONE. */
void csv_row_weights(text *out, uint32_t triangle, const double weight[3]);
/* Write the cells from byte `begin` on as those of another table: its separator in place of
 * commas, its decimal mark in place of points. Texts in quotes stay as they are. */
void csv_row_adapt(text *out, size_t begin, char separator, char decimal);
/* The end of the row. */
void csv_row_end(text *out);

#endif
