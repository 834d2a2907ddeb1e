/* Edits as lines of text, in both directions: what the editor's log is written as, and what the program carries out. */
#include "io/edits.h"
#include "io/number.h"
#include "io/table.h"

#include <inttypes.h>
#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

enum { NAME_LIMIT = 40 }; /* longer names of fields are written as numbers: MW_EDIT_TEXT_SIZE has room for no more */

/* What follows the first word: p a place (x and y), v a vertex, w another one, n a value with its field, o one that may be missing. */
typedef struct edit_form {
    const char *word, *arguments;
    mw_edit_line_kind line;
    mw_edit_kind edit;
} edit_form;

static const edit_form forms[] = {
    {"insert", "po", MW_EDIT_LINE_EDIT, MW_EDIT_INSERT},       {"remove", "v", MW_EDIT_LINE_EDIT, MW_EDIT_REMOVE},
    {"move", "vp", MW_EDIT_LINE_EDIT, MW_EDIT_MOVE},           {"flip", "vw", MW_EDIT_LINE_EDIT, MW_EDIT_FLIP},
    {"constrain", "vw", MW_EDIT_LINE_EDIT, MW_EDIT_CONSTRAIN}, {"release", "vw", MW_EDIT_LINE_EDIT, MW_EDIT_RELEASE},
    {"value", "vn", MW_EDIT_LINE_EDIT, MW_EDIT_VALUE},         {"locate", "p", MW_EDIT_LINE_LOCATE, MW_EDIT_INSERT},
    {"undo", "", MW_EDIT_LINE_UNDO, MW_EDIT_INSERT},           {"compact", "", MW_EDIT_LINE_COMPACT, MW_EDIT_INSERT},
};
enum { FORM_COUNT = sizeof forms / sizeof *forms };

static const edit_form *form_of(mw_edit_line_kind line, mw_edit_kind edit)
{
    for (size_t i = 0; i < FORM_COUNT; i++)
        if (forms[i].line == line && (line != MW_EDIT_LINE_EDIT || forms[i].edit == edit)) return &forms[i];
    return NULL;
}

const char *mw_edit_name(mw_edit_kind kind)
{
    const edit_form *form = form_of(MW_EDIT_LINE_EDIT, kind);
    return form ? form->word : NULL;
}

/* A line, and how far it has been read. */
typedef struct scan {
    const char *p;
    const edit_form *form;
    const mw_edit_text_options *options;
    mw_error *error;
} scan;

static mw_status bad(const scan *s, const char *format, ...) __attribute__((format(printf, 2, 3)));
static mw_status bad(const scan *s, const char *format, ...)
{
    char text[256];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(text, sizeof text, format, arguments);
    va_end(arguments);
    for (char *c = text; *c; c++)
        if ((unsigned char)*c < 0x20 || *c == 0x7f) *c = '?'; /* pieces of the line may be in it */
    return s->form ? mw__fail(s->error, MW_ERROR_INPUT, "%s: %s", s->form->word, text)
                   : mw__fail(s->error, MW_ERROR_INPUT, "%s", text);
}

static MW_INLINE bool ends_word(char c)
{
    return c == 0 || c == ',' || mw__is_blank(c);
}

/* The next word, and what separates it from the one behind it. A cell with nothing in it is a word of length 0; behind the last word
 * there is none. */
static bool next_word(scan *s, mw_text_field *word)
{
    const char *p = mw__skip_blanks(s->p), *begin = p;
    if (!*p || *p == '#') return false;
    const char *quote = *p == '"' ? strchr(p + 1, '"') : NULL;
    if (quote && ends_word(quote[1])) {
        *word = (mw_text_field){begin + 1, (size_t)(quote - begin - 1)};
        p = quote + 1;
    } else {
        while (!ends_word(*p) && *p != '#') p++;
        *word = (mw_text_field){begin, (size_t)(p - begin)};
    }
    p = mw__skip_blanks(p);
    s->p = p + (*p == ',');
    return true;
}

/* A word that is not empty. */
static mw_status wanted_word(scan *s, const char *what, mw_text_field *word)
{
    if (next_word(s, word) && word->length > 0) return MW_OK;
    return bad(s, "the %s is missing", what);
}

static mw_status no_number(const scan *s, const char *what, mw_text_field word)
{
    return bad(s, "%s: '%s' is not a number", what, mw__excerpt_of(word.text, word.length).text);
}

static mw_status read_double(scan *s, const char *what, double *value)
{
    mw_text_field word;
    mw_status status = wanted_word(s, what, &word);
    if (status) return status;
    return mw__read_double(word.text, value) == word.text + word.length ? MW_OK : no_number(s, what, word);
}

/* Tables that were kept as numbers with a point have 17.0 for 17. */
static bool whole(mw_text_field word, int64_t *number)
{
    double value;
    if (mw__read_integer(word.text, number) == word.text + word.length) return true;
    if (mw__read_double(word.text, &value) != word.text + word.length) return false;
    if (!(value >= 0 && value <= UINT32_MAX && value == floor(value))) return false;
    *number = (int64_t)value;
    return true;
}

static mw_status read_vertex(scan *s, const char *what, uint32_t *vertex)
{
    mw_text_field word;
    int64_t number;
    mw_status status = wanted_word(s, what, &word);
    if (status) return status;
    if (!whole(word, &number) || number < 0 || number > MW_MAX_VERTICES)
        return bad(s, "%s: '%s' is no number of a vertex", what, mw__excerpt_of(word.text, word.length).text);
    *vertex = (uint32_t)number;
    return MW_OK;
}

static bool is_digits(const char *text, size_t length)
{
    for (size_t i = 0; i < length; i++)
        if (text[i] < '0' || text[i] > '9') return false;
    return length > 0;
}

/* The number of a field; field_count where none has that name. */
static size_t find_field(const mw_edit_text_options *options, const char *name, size_t length)
{
    for (size_t f = 0; f < options->field_count; f++)
        if (strlen(options->fields[f]) == length && memcmp(options->fields[f], name, length) == 0) return f;
    return options->field_count;
}

/* The field that is meant where none is named; MW_NONE: there is no such. */
static uint32_t usual_field(const mw_edit_text_options *options)
{
    if (!options->fields) return 0;
    size_t field = find_field(options, "z", 1);
    return field < options->field_count ? (uint32_t)field : MW_NONE;
}

static mw_status read_field(scan *s, uint32_t *field)
{
    mw_text_field word;
    const mw_edit_text_options *options = s->options;
    if (!next_word(s, &word) || word.length == 0) {
        *field = usual_field(options);
        return *field != MW_NONE ? MW_OK : bad(s, "the mesh has no z; name a field behind the value");
    }
    int64_t number = -1;
    size_t count = options->fields ? options->field_count : MW_NONE;
    if (is_digits(word.text, word.length))
        mw__read_integer(word.text, &number);
    else if (options->fields)
        number = (int64_t)find_field(options, word.text, word.length);
    if (number < 0 || (uint64_t)number >= count)
        return bad(s, "there is no field '%s'", mw__excerpt_of(word.text, word.length).text);
    *field = (uint32_t)number;
    return MW_OK;
}

/* A value and its field. */
static mw_status read_value(scan *s, bool optional, mw_edit *edit)
{
    mw_text_field word;
    scan ahead = *s;
    edit->value = NAN;
    edit->field = 0;
    if (optional && (!next_word(&ahead, &word) || word.length == 0)) return MW_OK;
    mw_status status = read_double(s, "value", &edit->value);
    return status ? status : read_field(s, &edit->field);
}

static mw_status read_place(scan *s, mw_edit *edit)
{
    mw_status status = read_double(s, "x", &edit->x);
    return status ? status : read_double(s, "y", &edit->y);
}

static mw_status read_argument(scan *s, char argument, mw_edit *edit)
{
    bool two = strcmp(s->form->arguments, "vw") == 0;
    switch (argument) {
    case 'p': return read_place(s, edit);
    case 'v': return read_vertex(s, two ? "first vertex" : "vertex", &edit->vertex);
    case 'w': return read_vertex(s, "second vertex", &edit->other);
    default: return read_value(s, argument == 'o', edit);
    }
}

/* Only empty cells may follow. */
static mw_status expect_end(scan *s)
{
    mw_text_field word;
    while (next_word(s, &word))
        if (word.length > 0) return bad(s, "'%s' is more than it takes", mw__excerpt_of(word.text, word.length).text);
    return MW_OK;
}

static mw_status unknown_word(const scan *s, mw_text_field word)
{
    char known[160] = "";
    size_t used = 0;
    for (size_t i = 0; i < FORM_COUNT; i++)
        used += (size_t)snprintf(known + used, sizeof known - used, "%s%s", i ? ", " : "", forms[i].word);
    return bad(s, "unknown edit '%s'; there are %s", mw__excerpt_of(word.text, word.length).text, known);
}

static mw_status parse(const char *text, const mw_edit_text_options *options, mw_edit_line *line, mw_error *error)
{
    scan s = {.p = text, .options = options, .error = error};
    mw_text_field word;
    if (!next_word(&s, &word)) return MW_OK;
    if (word.length == 0) return expect_end(&s); /* a row of a table without anything in it */
    for (size_t i = 0; i < FORM_COUNT && !s.form; i++)
        if (strlen(forms[i].word) == word.length && strncasecmp(forms[i].word, word.text, word.length) == 0)
            s.form = &forms[i];
    if (!s.form) return unknown_word(&s, word);
    line->edit.kind = s.form->edit;
    mw_status status = MW_OK;
    for (const char *a = s.form->arguments; *a && !status; a++) status = read_argument(&s, *a, &line->edit);
    if (!status) status = expect_end(&s);
    if (!status) line->kind = s.form->line;
    return status;
}

static const mw_edit_text_options by_number;

mw_status mw_edit_parse(const char *text, const mw_edit_text_options *options, mw_edit_line *line, mw_error *error)
{
    if (!text || !line) return mw__fail(error, MW_ERROR_ARGUMENT, "mw_edit_parse: NULL");
    *line = (mw_edit_line){0};
    return parse(text, options ? options : &by_number, line, error);
}

/* Can a name stand in a line, and does it lead back to its field? *quotes: it has to stand in quotes. */
static bool is_word(const mw_edit_text_options *options, uint32_t field, bool *quotes)
{
    if (!options->fields || field >= options->field_count) return false;
    const char *name = options->fields[field];
    size_t length = strlen(name);
    *quotes = false;
    for (const char *c = name; *c; c++) {
        if ((unsigned char)*c < 0x20 || *c == 0x7f || *c == '"' || *c == '#') return false;
        *quotes |= ends_word(*c);
    }
    return length > 0 && length <= NAME_LIMIT && !is_digits(name, length) && find_field(options, name, length) == field;
}

static char *put_word(char *p, const char *word)
{
    size_t length = strlen(word);
    memcpy(p, word, length);
    return p + length;
}

static char *put_number(char *p, double value)
{
    *p++ = ' ';
    return p + mw_format_double(value, p);
}

static char *put_value(char *p, const mw_edit *edit, const mw_edit_text_options *options)
{
    bool quotes;
    p = put_number(p, edit->value);
    if (edit->field == usual_field(options)) return p;
    if (!is_word(options, edit->field, &quotes)) return p + sprintf(p, " %" PRIu32, edit->field);
    return p + sprintf(p, quotes ? " \"%s\"" : " %s", options->fields[edit->field]);
}

static char *put_argument(char *p, char argument, const mw_edit *edit, const mw_edit_text_options *options)
{
    switch (argument) {
    case 'p': return put_number(put_number(p, edit->x), edit->y);
    case 'v': return p + sprintf(p, " %" PRIu32, edit->vertex);
    case 'w': return p + sprintf(p, " %" PRIu32, edit->other);
    case 'o': return isnan(edit->value) ? p : put_value(p, edit, options);
    default: return put_value(p, edit, options);
    }
}

size_t mw_edit_format(const mw_edit_line *line, const mw_edit_text_options *options, char text[MW_EDIT_TEXT_SIZE])
{
    char *p = text;
    const edit_form *form = form_of(line->kind, line->edit.kind);
    if (form) {
        p = put_word(p, form->word);
        for (const char *a = form->arguments; *a; a++)
            p = put_argument(p, *a, &line->edit, options ? options : &by_number);
    }
    *p = 0;
    return (size_t)(p - text);
}

struct mw_edit_reader {
    mw_source source;
    mw_edit_text_options options;
    bool broken;
};

mw_status mw__edits_start(mw_source source, const mw_edit_text_options *options, mw_edit_reader **out, mw_error *error)
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

mw_status mw_edit_reader_open(const char *path, const mw_edit_text_options *options, mw_edit_reader **out,
                              mw_error *error)
{
    if (out) *out = NULL;
    if (!path || !out) return mw__fail(error, MW_ERROR_ARGUMENT, "mw_edit_reader_open: NULL");
    mw_source source;
    mw_status status = mw__source_open(&source, path, error);
    return status ? status : mw__edits_start(source, options, out, error);
}

mw_status mw_edit_reader_read(mw_edit_reader *reader, mw_edit_line *line, mw_error *error)
{
    mw_error wrong;
    *line = (mw_edit_line){0};
    if (reader->broken) return mw__source_fail(&reader->source, error, "cannot be read on");
    while (line->kind == MW_EDIT_LINE_NONE) {
        char *text;
        mw_status status = mw__source_line(&reader->source, &text, error);
        reader->broken = status != MW_OK;
        if (status || !text) return status;
        status = parse(text, &reader->options, line, &wrong);
        if (status || line->kind != MW_EDIT_LINE_NONE) line->line = reader->source.line;
        if (status) return mw__source_fail(&reader->source, error, "%s", wrong.message);
    }
    return MW_OK;
}

void mw_edit_reader_close(mw_edit_reader *reader)
{
    if (!reader) return;
    mw__source_close(&reader->source);
    free(reader);
}
