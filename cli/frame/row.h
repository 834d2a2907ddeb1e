/* row.h - the cells of a row of CSV. */
#ifndef CLI_ROW_H
#define CLI_ROW_H

#include "cli/frame/text.h"

/* The numbers of a query as they were read, the first cells of its row. */
void row_numbers(text *out, const double *values, size_t count);
/* The status, and the number of the triangle, or -1 for MW_NONE. */
void row_triangle(text *out, const char *status, uint32_t triangle);
/* A number, or an empty cell. */
void row_count(text *out, bool filled, uint32_t value);
void row_double(text *out, bool filled, double value);
/* The weights of a triangle's corners; empty for those that are not known (NaN), and all without a triangle. */
void row_weights(text *out, uint32_t triangle, const double weight[3]);
void row_end(text *out);

#endif
