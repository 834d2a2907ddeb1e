/* point_reader.h - a stream of points: what its readers fill in, and what they share. Private. */
#ifndef MW_SRC_IO_POINTS_POINT_READER_H
#define MW_SRC_IO_POINTS_POINT_READER_H

#include "io/points/row_texts.h"
#include "io/points/table_header.h"
#include "io/text/byte_source.h"

#include <meshwalk/io.h>

/* The cells of a column that hold texts where numbers belong. */
typedef struct mw_text_cells {
    uint64_t count;
    int64_t line; /* of the first */
} mw_text_cells;

struct mw_point_reader {
    mw_source source;
    size_t width;
    char **names;    /* one per value */
    size_t *columns; /* of each value: the column of the file */
    mw_status (*read)(mw_point_reader *reader, double *values, size_t capacity, size_t *count,
                      mw_error *error);
    /* Choose the columns to read. They exist, each once; no column is chosen yet. */
    mw_status (*select)(mw_point_reader *reader, const size_t *columns, size_t count,
                        mw_error *error);
    void *state;            /* of that reader; released with free */
    mw_table_header header; /* all columns of the file */
    char separator;         /* of the rows' texts */
    char decimal;           /* '.' or ',' */
    bool table, begun;      /* keeps the rows' texts; has read something */
    mw_row_texts rows;      /* of the block read last */
    bool texts_allowed;     /* in values that no coordinate is */
    mw_text_cells *texts;   /* per value; NULL: none are allowed */
    char *crs;              /* NULL: not known */
};

/* Add a column to the reader: its name, and which column of the file it is. */
mw_status mw__point_reader_add(mw_point_reader *reader, const char *name, size_t column,
                               mw_error *error);

/* Remove all columns from the reader. */
void mw__point_reader_clear(mw_point_reader *reader);

/* The next item of a selection "x,y,3", without blanks around it, its length in *length; NULL
 * after the last. *rest begins as the selection. */
const char *mw__selection_item(const char **rest, size_t *length);

#endif
