/* Edits as lines of text, read and written: the editor's log, and the streams that `meshwalk edit`
 * carries out. */
#include "io/edits/edit_text.h"
#include "base/options.h"
#include "base/posix.h"
#include "io/edits/edit_words.h"
#include "io/text/number_text.h"

#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Fields with longer names are written as numbers: MW_EDIT_TEXT_SIZE has room for no more. */
enum { NAME_LIMIT = 40 };

/* What follows the first word: p a point (x and y), v a vertex, w another one, n a value with
 * its field, o one that may be missing. */
typedef struct edit_form {
    const char *word, *arguments;
    mw_edit_line_kind line;
    mw_edit_kind edit;
} edit_form;

static const edit_form forms[] = {
    {"insert", "po", MW_EDIT_LINE_EDIT, MW_EDIT_INSERT},
    {"remove", "v", MW_EDIT_LINE_EDIT, MW_EDIT_REMOVE},
    {"move", "vp", MW_EDIT_LINE_EDIT, MW_EDIT_MOVE},
    {"flip", "vw", MW_EDIT_LINE_EDIT, MW_EDIT_FLIP},
    {"constrain", "vw", MW_EDIT_LINE_EDIT, MW_EDIT_CONSTRAIN},
    {"release", "vw", MW_EDIT_LINE_EDIT, MW_EDIT_RELEASE},
    {"value", "vn", MW_EDIT_LINE_EDIT, MW_EDIT_VALUE},
    {"locate", "p", MW_EDIT_LINE_LOCATE, MW_EDIT_INSERT},
    {"undo", "", MW_EDIT_LINE_UNDO, MW_EDIT_INSERT},
    {"compact", "", MW_EDIT_LINE_COMPACT, MW_EDIT_INSERT},
};
enum { FORM_COUNT = sizeof forms / sizeof *forms };

static const edit_form *edit_form_of(mw_edit_line_kind line, mw_edit_kind edit)
{
    for (size_t i = 0; i < FORM_COUNT; i++)
        if (forms[i].line == line && (line != MW_EDIT_LINE_EDIT || forms[i].edit == edit))
            return &forms[i];
    return NULL;
}

const char *mw_edit_name(mw_edit_kind kind)
{
    const edit_form *form = edit_form_of(MW_EDIT_LINE_EDIT, kind);
    return form ? form->word : NULL;
}

/* A line, and how far it has been read. */
typedef struct edit_scan {
    mw_edit_words words;
    const edit_form *form;
    const mw_edit_text_options *options;
} edit_scan;

static bool is_digits(const char *text, size_t length)
{
    for (size_t i = 0; i < length; i++)
        if (text[i] < '0' || text[i] > '9') return false;
    return length > 0;
}

/* The number of a field; field_count where none has that name. */
static size_t edit_find_field(const mw_edit_text_options *options, const char *name, size_t length)
{
    for (size_t f = 0; f < options->field_count; f++)
        if (strlen(options->fields[f]) == length && memcmp(options->fields[f], name, length) == 0)
            return f;
    return options->field_count;
}

/* The default field if none is named; MW_NONE: there is none. */
static uint32_t edit_usual_field(const mw_edit_text_options *options)
{
    if (!options->fields) return 0;
    size_t field = edit_find_field(options, "z", 1);
    return field < options->field_count ? (uint32_t)field : MW_NONE;
}

static mw_status edit_read_field(edit_scan *s, uint32_t *field)
{
    mw_text_cell word;
    const mw_edit_text_options *options = s->options;
    if (!mw__edit_next_word(&s->words, &word) || word.length == 0) {
        *field = edit_usual_field(options);
        return *field != MW_NONE
                   ? MW_OK
                   : mw__edit_fail(&s->words, "the mesh has no z; name a field after the value");
    }
    int64_t number = -1;
    size_t count = options->fields ? options->field_count : MW_NONE;
    if (is_digits(word.text, word.length))
        mw__read_integer(word.text, &number);
    else if (options->fields)
        number = (int64_t)edit_find_field(options, word.text, word.length);
    if (number < 0 || (uint64_t)number >= count)
        return mw__edit_fail(&s->words, "there is no field '%s'",
                             mw__excerpt_of(word.text, word.length).text);
    *field = (uint32_t)number;
    return MW_OK;
}

/* A value and its field. */
static mw_status edit_read_value(edit_scan *s, bool optional, mw_edit *edit)
{
    mw_text_cell word;
    edit_scan ahead = *s;
    edit->value = NAN;
    edit->field = 0;
    if (optional && (!mw__edit_next_word(&ahead.words, &word) || word.length == 0)) return MW_OK;
    mw_status status = mw__edit_read_double(&s->words, "value", &edit->value);
    return status ? status : edit_read_field(s, &edit->field);
}

static mw_status edit_read_point(edit_scan *s, mw_edit *edit)
{
    mw_status status = mw__edit_read_double(&s->words, "x", &edit->x);
    return status ? status : mw__edit_read_double(&s->words, "y", &edit->y);
}

static mw_status edit_read_argument(edit_scan *s, char argument, mw_edit *edit)
{
    bool two = strcmp(s->form->arguments, "vw") == 0;
    switch (argument) {
    case 'p': return edit_read_point(s, edit);
    case 'v':
        return mw__edit_read_number(&s->words, two ? "first vertex" : "vertex", "vertex",
                                    &edit->vertex);
    case 'w': return mw__edit_read_number(&s->words, "second vertex", "vertex", &edit->other);
    default: return edit_read_value(s, argument == 'o', edit);
    }
}

static mw_status edit_unknown_word(const edit_scan *s, mw_text_cell word)
{
    char known[160] = "";
    size_t used = 0;
    for (size_t i = 0; i < FORM_COUNT; i++)
        used += (size_t)snprintf(known + used, sizeof known - used, "%s%s", i ? ", " : "",
                                 forms[i].word);
    return mw__edit_fail(&s->words, "unknown edit '%s'; known edits are %s",
                         mw__excerpt_of(word.text, word.length).text, known);
}

static mw_status edit_parse(const char *text, const mw_edit_text_options *options,
                            mw_edit_line *line, mw_error *error)
{
    edit_scan s = {.words = {.p = text, .error = error}, .options = options};
    mw_text_cell word;
    if (!mw__edit_next_word(&s.words, &word)) return MW_OK;
    if (word.length == 0)
        return mw__edit_expect_end(&s.words); /* a row of a table without anything in it */
    for (size_t i = 0; i < FORM_COUNT && !s.form; i++)
        if (strlen(forms[i].word) == word.length &&
            strncasecmp(forms[i].word, word.text, word.length) == 0)
            s.form = &forms[i];
    if (!s.form) return edit_unknown_word(&s, word);
    s.words.first = s.form->word;
    line->edit.kind = s.form->edit;
    mw_status status = MW_OK;
    for (const char *a = s.form->arguments; *a && !status; a++)
        status = edit_read_argument(&s, *a, &line->edit);
    if (!status) status = mw__edit_expect_end(&s.words);
    if (!status) line->kind = s.form->line;
    return status;
}

static const mw_edit_text_options by_number;

mw_status mw_edit_parse(const char *text, const mw_edit_text_options *options, mw_edit_line *line,
                        mw_error *error)
{
    if (!text || !line)
        return mw__fail(error, MW_ERROR_ARGUMENT, "mw_edit_parse: the text or the result is NULL");
    *line = (mw_edit_line){0};
    mw_status status = options ? MW_RESERVED_CHECK(mw_edit_text_options, options, error) : MW_OK;
    return status ? status : edit_parse(text, options ? options : &by_number, line, error);
}

/* Can a name be written in a line and be read back as the same field? *quotes: it needs quotes. */
static bool field_name_is_word(const mw_edit_text_options *options, uint32_t field, bool *quotes)
{
    if (!options->fields || field >= options->field_count) return false;
    const char *name = options->fields[field];
    size_t length = strlen(name);
    *quotes = false;
    for (const char *c = name; *c; c++) {
        if ((unsigned char)*c < 0x20 || *c == 0x7f || *c == '"' || *c == '#') return false;
        *quotes |= mw__edit_ends_word(*c);
    }
    return length > 0 && length <= NAME_LIMIT && !is_digits(name, length) &&
           edit_find_field(options, name, length) == field;
}

static char *edit_put_word(char *p, const char *word)
{
    size_t length = strlen(word);
    memcpy(p, word, length);
    return p + length;
}

static char *edit_put_number(char *p, double value)
{
    *p++ = ' ';
    return p + mw_format_double(value, p);
}

static char *edit_put_value(char *p, const mw_edit *edit, const mw_edit_text_options *options)
{
    bool quotes;
    p = edit_put_number(p, edit->value);
    if (edit->field == edit_usual_field(options)) return p;
    if (!field_name_is_word(options, edit->field, &quotes))
        return p + sprintf(p, " %" PRIu32, edit->field);
    return p + sprintf(p, quotes ? " \"%s\"" : " %s", options->fields[edit->field]);
}

static char *edit_put_argument(char *p, char argument, const mw_edit *edit,
                               const mw_edit_text_options *options)
{
    switch (argument) {
    case 'p': return edit_put_number(edit_put_number(p, edit->x), edit->y);
    case 'v': return p + sprintf(p, " %" PRIu32, edit->vertex);
    case 'w': return p + sprintf(p, " %" PRIu32, edit->other);
    case 'o': return isnan(edit->value) ? p : edit_put_value(p, edit, options);
    default: return edit_put_value(p, edit, options);
    }
}

size_t mw_edit_format(const mw_edit_line *line, const mw_edit_text_options *options,
                      char text[MW_EDIT_TEXT_SIZE])
{
    char *p = text;
    const edit_form *form = edit_form_of(line->kind, line->edit.kind);
    if (form) {
        p = edit_put_word(p, form->word);
        for (const char *a = form->arguments; *a; a++)
            p = edit_put_argument(p, *a, &line->edit, options ? options : &by_number);
    }
    *p = 0;
    return (size_t)(p - text);
}

struct mw_edit_reader {
    mw_source source;
    mw_edit_text_options options;
    bool broken;
};

mw_status mw__edit_reader_start(mw_source source, const mw_edit_text_options *options,
                                mw_edit_reader **out, mw_error *error)
{
    mw_edit_reader *reader = mw__calloc(1, sizeof *reader);
    if (!reader) {
        mw__source_close(&source);
        return mw__fail_memory(error);
    }
    reader->source = source;
    reader->options = options ? *options : by_number;
    *out = reader;
    return MW_OK;
}

mw_status mw_edit_reader_open(const char *path, const mw_edit_text_options *options,
                              mw_edit_reader **out, mw_error *error)
{
    if (out) *out = NULL;
    if (!path || !out)
        return mw__fail(error, MW_ERROR_ARGUMENT,
                        "mw_edit_reader_open: the path or the pointer to the new reader is NULL");
    mw_source source;
    mw_status status = options ? MW_RESERVED_CHECK(mw_edit_text_options, options, error) : MW_OK;
    if (!status) status = mw__source_open(&source, path, error);
    return status ? status : mw__edit_reader_start(source, options, out, error);
}

mw_status mw_edit_reader_read(mw_edit_reader *reader, mw_edit_line *line, mw_error *error)
{
    mw_error wrong;
    *line = (mw_edit_line){0};
    if (reader->broken) return mw__source_fail(&reader->source, error, "cannot be read further");
    while (line->kind == MW_EDIT_LINE_NONE) {
        char *text;
        mw_status status = mw__source_line(&reader->source, &text, error);
        reader->broken = status != MW_OK;
        if (status || !text) return status;
        status = edit_parse(text, &reader->options, line, &wrong);
        if (status || line->kind != MW_EDIT_LINE_NONE) line->line = reader->source.line;
        if (status) return mw__source_fail(&reader->source, error, "%s", wrong.message);
    }
    return MW_OK;
}

double mw_edit_reader_fraction(const mw_edit_reader *reader)
{
    return mw__source_fraction(&reader->source);
}

void mw_edit_reader_close(mw_edit_reader *reader)
{
    if (!reader) return;
    mw__source_close(&reader->source);
    free(reader);
}
