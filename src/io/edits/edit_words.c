/* edit_words.c - the words of a line of edits. */
#include "io/edits/edit_words.h"
#include "io/text/number_text.h"

#include <inttypes.h>
#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

mw_status mw__edit_fail(const mw_edit_words *s, const char *format, ...)
{
    char text[256];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(text, sizeof text, format, arguments);
    va_end(arguments);
    mw__message_clean(text);
    return s->first ? mw__fail(s->error, MW_ERROR_INPUT, "%s: %s", s->first, text)
                    : mw__fail(s->error, MW_ERROR_INPUT, "%s", text);
}

bool mw__edit_next_word(mw_edit_words *s, mw_text_cell *word)
{
    const char *p = mw__skip_blanks(s->p), *begin = p;
    if (!*p || *p == '#') return false;
    const char *quote = *p == '"' ? strchr(p + 1, '"') : NULL;
    if (quote && mw__edit_ends_word(quote[1])) {
        *word = (mw_text_cell){begin + 1, (size_t)(quote - begin - 1)};
        p = quote + 1;
    } else {
        while (!mw__edit_ends_word(*p) && *p != '#') p++;
        *word = (mw_text_cell){begin, (size_t)(p - begin)};
    }
    p = mw__skip_blanks(p);
    s->p = p + (*p == ',');
    return true;
}

mw_status mw__edit_wanted_word(mw_edit_words *s, const char *what, mw_text_cell *word)
{
    if (mw__edit_next_word(s, word) && word->length > 0) return MW_OK;
    return mw__edit_fail(s, "the %s is missing", what);
}

static mw_status edit_no_number(const mw_edit_words *s, const char *what, mw_text_cell word)
{
    return mw__edit_fail(s, "%s: '%s' is not a number", what,
                         mw__excerpt_of(word.text, word.length).text);
}

mw_status mw__edit_read_double(mw_edit_words *s, const char *what, double *value)
{
    mw_text_cell word;
    mw_status status = mw__edit_wanted_word(s, what, &word);
    if (status) return status;
    return mw__read_double(word.text, value) == word.text + word.length
               ? MW_OK
               : edit_no_number(s, what, word);
}

/* Some tables write 17.0 for 17. */
static bool word_is_whole_number(mw_text_cell word, int64_t *number)
{
    double value;
    if (mw__read_integer(word.text, number) == word.text + word.length) return true;
    if (mw__read_double(word.text, &value) != word.text + word.length) return false;
    if (!(value >= 0 && value <= UINT32_MAX && value == floor(value))) return false;
    *number = (int64_t)value;
    return true;
}

mw_status mw__edit_read_number(mw_edit_words *s, const char *what, const char *kind,
                               uint32_t *number_read)
{
    mw_text_cell word;
    int64_t number;
    mw_status status = mw__edit_wanted_word(s, what, &word);
    if (status) return status;
    if (!word_is_whole_number(word, &number) || number < 0 || number > MW_MAX_VERTICES)
        return mw__edit_fail(s, "%s: '%s' is not a %s number", what,
                             mw__excerpt_of(word.text, word.length).text, kind);
    *number_read = (uint32_t)number;
    return MW_OK;
}

mw_status mw__edit_expect_end(mw_edit_words *s)
{
    mw_text_cell word;
    while (mw__edit_next_word(s, &word))
        if (word.length > 0)
            return mw__edit_fail(s, "'%s' is one word too many",
                                 mw__excerpt_of(word.text, word.length).text);
    return MW_OK;
}
