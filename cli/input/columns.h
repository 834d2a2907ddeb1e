/* columns.h - which columns of a file of queries hold what a command asks for. */
#ifndef CLI_COLUMNS_H
#define CLI_COLUMNS_H

#include <meshwalk/meshwalk.h>
#include <stdbool.h>

#define MOST_COLUMNS 6

/* What a command wants to read of each row. */
typedef struct columns {
    const char *names[MOST_COLUMNS];
    size_t count;
    bool loose;       /* unless chosen, the first ones do, whatever a header calls them and however many there are */
    const char *hint; /* to add where they are not found; NULL: nothing */
} columns;

/* Where the columns are among those that a reader gives: at pick[0], pick[1], ... Columns that the user has chosen are
 * taken in that order; else those that a header calls so; else the first ones, where there is no header or there are no
 * more than are wanted, unless they are called longitude and latitude. Complains and returns an exit code where that does
 * not tell. */
int columns_pick(const columns *wanted, const char *path, const mw_point_reader *reader, bool chosen,
                 size_t pick[MOST_COLUMNS]);

/* The names as in a header: "x,y,z". */
const char *columns_list(const columns *wanted, char list[64]);

#endif
