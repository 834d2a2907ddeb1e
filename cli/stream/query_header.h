/* query_header.h - the first row of the output of a query command. */
#ifndef MW_CLI_STREAM_QUERY_HEADER_H
#define MW_CLI_STREAM_QUERY_HEADER_H

#include "cli/frame/text.h"
#include "cli/input/query_columns.h"

/* Write the header of the table, then the names of the answers. Columns without names in the file
 * get c1, c2, ..., but those of the query their names in `wanted`. A name that is taken gets the
 * suffix "_mw".
 *   index    the columns of the query in the table
 *   answers  NULL ends them */
void query_header_write(text *out, const mw_point_table *table, const query_columns *wanted,
                        const size_t *index, const char *const *answers);

/* Write the first `shown` names of the query, then those of the answers, with commas. */
void query_header_write_answers(text *out, const query_columns *wanted, size_t shown,
                                const char *const *answers);

#endif
