/* query_columns.h - finds the columns of a file of queries that a command reads. */
#ifndef MW_CLI_INPUT_QUERY_COLUMNS_H
#define MW_CLI_INPUT_QUERY_COLUMNS_H

#include <meshwalk/meshwalk.h>
#include <stdbool.h>

#define MAX_QUERY_COLUMNS 6

/* What a command reads from each row. */
typedef struct query_columns {
    const char *names[MAX_QUERY_COLUMNS]; /* "x", "y" */
    size_t count;
    bool accept_first; /* take the first columns if the header does not name the wanted ones */
    const char *hint;  /* the end of the complaint if they are not found; NULL: none */
} query_columns;

/* Find the columns: column k is at index[k] among those of the reader. These are tried in order:
 *   1. the columns that the user has `chosen` (--columns): the reader gives them in that order;
 *   2. the columns that the header calls so, in upper or lower case;
 *   3. the first columns, if `accept_first`; if there is no header; or if there are no others and
 *      the first is not called a longitude.
 * Returns 0, or an exit code after a complaint if none of this holds. */
int query_columns_find(const query_columns *wanted, const char *path, const mw_point_reader *reader, bool chosen,
                       size_t index[MAX_QUERY_COLUMNS]);

#endif
