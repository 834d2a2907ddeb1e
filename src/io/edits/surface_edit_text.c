/* surface_edit_text.c - edits of a surface as lines of text. */
#include "io/edits/surface_edit_text.h"
#include "base/posix.h"
#include "io/edits/edit_words.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* What follows the first word: p a point, m a motion, o a point that may be missing, u a
 * vertex, v w x vertices, t a triangle, c vertices to the end, s vertices, "to", and as many. */
typedef struct surface_edit_form {
    const char *word, *arguments;
    mw_surface_edit_line_kind line;
    mw_surface_edit_kind edit;
} surface_edit_form;

static const surface_edit_form surface_forms[] = {
    {"add-vertex", "p", MW_SURFACE_EDIT_LINE_EDIT, MW_SURFACE_ADD_VERTEX},
    {"remove-vertex", "u", MW_SURFACE_EDIT_LINE_EDIT, MW_SURFACE_REMOVE_VERTEX},
    {"move-vertex", "up", MW_SURFACE_EDIT_LINE_EDIT, MW_SURFACE_MOVE_VERTEX},
    {"add-triangle", "vwx", MW_SURFACE_EDIT_LINE_EDIT, MW_SURFACE_ADD_TRIANGLE},
    {"remove-triangle", "t", MW_SURFACE_EDIT_LINE_EDIT, MW_SURFACE_REMOVE_TRIANGLE},
    {"split-edge", "vwo", MW_SURFACE_EDIT_LINE_EDIT, MW_SURFACE_SPLIT_EDGE},
    {"split-triangle", "to", MW_SURFACE_EDIT_LINE_EDIT, MW_SURFACE_SPLIT_TRIANGLE},
    {"flip", "vw", MW_SURFACE_EDIT_LINE_EDIT, MW_SURFACE_FLIP},
    {"collapse", "vwo", MW_SURFACE_EDIT_LINE_EDIT, MW_SURFACE_COLLAPSE},
    {"cut", "c", MW_SURFACE_EDIT_LINE_EDIT, MW_SURFACE_CUT},
    {"sew", "s", MW_SURFACE_EDIT_LINE_EDIT, MW_SURFACE_SEW},
    {"probe", "pm", MW_SURFACE_EDIT_LINE_PROBE, MW_SURFACE_ADD_VERTEX},
    {"undo", "", MW_SURFACE_EDIT_LINE_UNDO, MW_SURFACE_ADD_VERTEX},
    {"compact", "", MW_SURFACE_EDIT_LINE_COMPACT, MW_SURFACE_ADD_VERTEX},
};
enum { SURFACE_FORMS = sizeof surface_forms / sizeof *surface_forms };

struct mw_surface_edit_reader {
    mw_source source;
    uint32_t *path; /* of the last line */
    size_t path_room;
    bool broken;
};

/* --- arguments --- */

static mw_status surface_read_triple(mw_edit_words *words, const char *const names[3],
                                     double triple[3])
{
    mw_status status = MW_OK;
    for (int i = 0; i < 3 && !status; i++)
        status = mw__edit_read_double(words, names[i], &triple[i]);
    return status;
}

static const char *const point_names[3] = {"x", "y", "z"}, *const motion_names[3] = {
                                                               "x of the motion", "y of the motion",
                                                               "z of the motion"};

/* A point, or nothing but empty cells. */
static mw_status surface_read_optional(mw_edit_words *words, double point[3])
{
    mw_edit_words ahead = *words;
    mw_text_cell word = {NULL, 0};
    while (mw__edit_next_word(&ahead, &word) && word.length == 0) continue;
    if (word.length > 0) return surface_read_triple(words, point_names, point);
    point[0] = point[1] = point[2] = NAN;
    return MW_OK;
}

static bool word_is_to(mw_text_cell word)
{
    return word.length == 2 && strncasecmp(word.text, "to", 2) == 0;
}

static mw_status reader_path_room(mw_surface_edit_reader *r, size_t count, mw_error *error)
{
    if (count < r->path_room) return MW_OK;
    size_t room = 2 * r->path_room + 16;
    uint32_t *path = mw__realloc(r->path, room, sizeof *path);
    if (!path) return mw__fail_memory(error);
    r->path = path;
    r->path_room = room;
    return MW_OK;
}

/* Vertices up to the end, or up to the word "to" at `first` or later. */
static mw_status surface_read_path(mw_surface_edit_reader *r, mw_edit_words *words, size_t first,
                                   size_t *count, bool *to)
{
    mw_text_cell word;
    *to = false;
    *count = first;
    for (;;) {
        mw_edit_words ahead = *words;
        if (!mw__edit_next_word(&ahead, &word)) return MW_OK;
        *to = word_is_to(word);
        if (*to || word.length == 0) *words = ahead;
        if (*to) return MW_OK;
        if (word.length == 0) continue; /* an empty cell */
        mw_status status = reader_path_room(r, *count, words->error);
        if (!status) status = mw__edit_read_number(words, "vertex", "vertex", &r->path[*count]);
        if (status) return status;
        ++*count;
    }
}

static mw_status surface_read_cut(mw_surface_edit_reader *r, mw_edit_words *words,
                                  mw_surface_edit *edit)
{
    bool to;
    mw_status status = surface_read_path(r, words, 0, &edit->path_count, &to);
    if (status) return status;
    if (to) return mw__edit_fail(words, "'to' is not a vertex number");
    if (edit->path_count < 2) return mw__edit_fail(words, "a cut needs at least two vertices");
    edit->path = r->path;
    return MW_OK;
}

static mw_status surface_read_seam(mw_surface_edit_reader *r, mw_edit_words *words,
                                   mw_surface_edit *edit)
{
    bool to, again = false;
    size_t count;
    mw_status status = surface_read_path(r, words, 0, &edit->path_count, &to);
    if (!status && !to)
        return mw__edit_fail(words, "the word 'to' and the other chain are missing");
    if (!status) status = surface_read_path(r, words, edit->path_count, &count, &again);
    if (status) return status;
    if (again) return mw__edit_fail(words, "'to' comes twice");
    if (edit->path_count < 2 || count != 2 * edit->path_count)
        return mw__edit_fail(
            words,
            "both chains need the same number of vertices, at least two; they have %zu and %zu",
            edit->path_count, count - edit->path_count);
    edit->path = r->path;
    edit->other = r->path + edit->path_count;
    return MW_OK;
}

static mw_status surface_read_argument(mw_surface_edit_reader *r, mw_edit_words *words,
                                       char argument, mw_surface_edit_line *line)
{
    mw_surface_edit *edit = &line->edit;
    bool probe = strcmp(words->first, "probe") == 0;
    switch (argument) {
    case 'p': return surface_read_triple(words, point_names, probe ? line->point : edit->point);
    case 'm': return surface_read_triple(words, motion_names, line->motion);
    case 'o': return surface_read_optional(words, edit->point);
    case 'u': return mw__edit_read_number(words, "vertex", "vertex", &edit->vertex[0]);
    case 'v': return mw__edit_read_number(words, "first vertex", "vertex", &edit->vertex[0]);
    case 'w': return mw__edit_read_number(words, "second vertex", "vertex", &edit->vertex[1]);
    case 'x': return mw__edit_read_number(words, "third vertex", "vertex", &edit->vertex[2]);
    case 't': return mw__edit_read_number(words, "triangle", "triangle", &edit->triangle);
    case 'c': return surface_read_cut(r, words, edit);
    default: return surface_read_seam(r, words, edit);
    }
}

/* --- lines --- */

static mw_status surface_unknown_word(const mw_edit_words *words, mw_text_cell word)
{
    char known[256] = "";
    size_t used = 0;
    for (size_t i = 0; i < SURFACE_FORMS; i++)
        used += (size_t)snprintf(known + used, sizeof known - used, "%s%s", i ? ", " : "",
                                 surface_forms[i].word);
    return mw__edit_fail(words, "unknown edit '%s'; known edits are %s",
                         mw__excerpt_of(word.text, word.length).text, known);
}

static mw_status surface_parse_line(mw_surface_edit_reader *r, char *text,
                                    mw_surface_edit_line *line, mw_error *error)
{
    mw_edit_words words = {.p = text, .error = error};
    const surface_edit_form *form = NULL;
    mw_text_cell word;
    if (!mw__edit_next_word(&words, &word)) return MW_OK;
    if (word.length == 0) return mw__edit_expect_end(&words); /* a row without anything in it */
    for (size_t i = 0; i < SURFACE_FORMS && !form; i++)
        if (strlen(surface_forms[i].word) == word.length &&
            strncasecmp(surface_forms[i].word, word.text, word.length) == 0)
            form = &surface_forms[i];
    if (!form) return surface_unknown_word(&words, word);
    words.first = form->word;
    line->edit.kind = form->edit;
    mw_status status = MW_OK;
    for (const char *a = form->arguments; *a && !status; a++)
        status = surface_read_argument(r, &words, *a, line);
    if (!status) status = mw__edit_expect_end(&words);
    if (status) return status;
    line->kind = form->line;
    char *end = text + (words.p - text); /* what is left is a comment */
    while (end > text && mw__edit_ends_word(end[-1])) end--;
    *end = 0;
    line->text = text;
    return MW_OK;
}

mw_status mw__surface_edit_reader_start(mw_source source, mw_surface_edit_reader **out,
                                        mw_error *error)
{
    mw_surface_edit_reader *reader = mw__calloc(1, sizeof *reader);
    if (!reader) {
        mw__source_close(&source);
        return mw__fail_memory(error);
    }
    reader->source = source;
    *out = reader;
    return MW_OK;
}

mw_status mw_surface_edit_reader_open(const char *path, mw_surface_edit_reader **out,
                                      mw_error *error)
{
    if (out) *out = NULL;
    if (!path || !out)
        return mw__fail(
            error, MW_ERROR_ARGUMENT,
            "mw_surface_edit_reader_open: the path or the pointer to the new reader is NULL");
    mw_source source;
    mw_status status = mw__source_open(&source, path, error);
    return status ? status : mw__surface_edit_reader_start(source, out, error);
}

mw_status mw_surface_edit_reader_read(mw_surface_edit_reader *reader, mw_surface_edit_line *line,
                                      mw_error *error)
{
    mw_error wrong;
    *line = (mw_surface_edit_line){0};
    if (reader->broken) return mw__source_fail(&reader->source, error, "cannot be read further");
    while (line->kind == MW_SURFACE_EDIT_LINE_NONE) {
        char *text;
        mw_status status = mw__source_line(&reader->source, &text, error);
        reader->broken = status != MW_OK;
        if (status || !text) return status;
        status = surface_parse_line(reader, text, line, &wrong);
        if (status == MW_ERROR_MEMORY) return mw__fail_memory(error);
        if (status || line->kind != MW_SURFACE_EDIT_LINE_NONE) line->line = reader->source.line;
        if (status) return mw__source_fail(&reader->source, error, "%s", wrong.message);
    }
    return MW_OK;
}

double mw_surface_edit_reader_fraction(const mw_surface_edit_reader *reader)
{
    return mw__source_fraction(&reader->source);
}

void mw_surface_edit_reader_close(mw_surface_edit_reader *reader)
{
    if (!reader) return;
    mw__source_close(&reader->source);
    free(reader->path);
    free(reader);
}
