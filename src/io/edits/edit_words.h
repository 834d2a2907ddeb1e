/* edit_words.h - the words of a line of edits, in the plane or of a surface. Private. */
#ifndef MW_SRC_IO_EDITS_EDIT_WORDS_H
#define MW_SRC_IO_EDITS_EDIT_WORDS_H

#include "base/base.h"
#include "io/text/byte_source.h"
#include "io/text/delimited.h"

/* A line, and how far it has been read. */
typedef struct mw_edit_words {
    const char *p;
    const char *first; /* the word that tells the edit, for messages; NULL: not known yet */
    mw_error *error;
} mw_edit_words;

/* MW_ERROR_INPUT with a message that begins with the first word. */
mw_status mw__edit_fail(const mw_edit_words *s, const char *format, ...)
    __attribute__((format(printf, 2, 3)));

static MW_INLINE bool mw__edit_ends_word(char c)
{
    return c == 0 || c == ',' || mw__is_blank(c);
}

/* The next word, and the separator after it. An empty cell is a word of length 0. False after the
 * last word. */
bool mw__edit_next_word(mw_edit_words *s, mw_text_cell *word);
/* A word that is not empty. `what` it is, for messages, here and below. */
mw_status mw__edit_wanted_word(mw_edit_words *s, const char *what, mw_text_cell *word);
mw_status mw__edit_read_double(mw_edit_words *s, const char *what, double *value);
/* The number of a vertex or triangle: `kind`. */
mw_status mw__edit_read_number(mw_edit_words *s, const char *what, const char *kind,
                               uint32_t *number_read);
/* Only empty cells may follow. */
mw_status mw__edit_expect_end(mw_edit_words *s);

#endif
