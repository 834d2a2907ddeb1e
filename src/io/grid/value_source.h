/* value_source.h - words and numbers of a file that has its numbers as text, parted by blanks and
 * line ends, or as bytes. Private. */
#ifndef MW_SRC_IO_GRID_VALUE_SOURCE_H
#define MW_SRC_IO_GRID_VALUE_SOURCE_H

#include "io/text/byte_source.h"

typedef struct mw_value_source {
    mw_source *source;
    char *rest;       /* of the line, NULL before the first */
    bool binary, big; /* numbers are bytes, in which order */
} mw_value_source;

typedef enum mw_number_kind {
    MW_NUMBER_SIGNED,
    MW_NUMBER_UNSIGNED,
    MW_NUMBER_FLOAT
} mw_number_kind;
typedef struct mw_number_type {
    mw_number_kind kind;
    size_t size; /* in bytes: 1, 2, 4 or 8; of a float at least 2 */
} mw_number_type;

/* The next word, ended by NUL, which is good until the next call; NULL at the end of the input. */
mw_status mw__value_word(mw_value_source *values, char **word, mw_error *error);
/* What is left of the line; the next call goes on behind it. */
char *mw__value_rest(mw_value_source *values);
/* The next line, and the next bytes, whatever is left of the present line. A word or a rest taken
 * before is no longer good: the source may have moved what it holds. */
mw_status mw__value_line(mw_value_source *values, char **line, mw_error *error);
mw_status mw__value_bytes(mw_value_source *values, size_t count, const unsigned char **bytes,
                          mw_error *error);

/* The next number. `what` names it for messages. Integers beyond 64 bits, and numbers with a
 * fraction where an integer is wanted, are errors. */
mw_status mw__value_double(mw_value_source *values, mw_number_type type, const char *what,
                           double *value, mw_error *error);
mw_status mw__value_integer(mw_value_source *values, mw_number_type type, const char *what,
                            int64_t *value, mw_error *error);
/* An integer of text, whatever the numbers are. */
mw_status mw__value_word_integer(mw_value_source *values, const char *what, int64_t *value,
                                 mw_error *error);
/* The same, and an error if it is negative. */
mw_status mw__value_word_count(mw_value_source *values, const char *what, int64_t *value,
                               mw_error *error);

/* The number that these bytes are. */
double mw__value_of_bytes(const unsigned char *bytes, mw_number_type type, bool big);

#endif
