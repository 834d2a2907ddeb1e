/* number_rows.h - which number became which, as rows of CSV: line,what,old,new. */
#ifndef MW_CLI_STREAM_NUMBER_ROWS_H
#define MW_CLI_STREAM_NUMBER_ROWS_H

#include "cli/frame/text.h"

#include <meshwalk/meshwalk.h>

/* The first line of the table. */
void number_rows_begin(mw_output *out);

/* Rows for number[0 .. count), each MW_NONE or the new number. `line` 0: the cell is empty. `row`
 * is empty before and after. */
void number_rows_write(mw_output *out, text *row, int64_t line, const char *what,
                       const uint32_t *number, uint32_t count);

#endif
