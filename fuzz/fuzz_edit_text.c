/* Any bytes as a stream of edits. What is taken comes back when it is written and read again; what
 * is refused names its line. */
#include "io/edits/edit_text.h"
#include "reader.h"

static const char *const names[] = {"temp", "z", "wind speed", "a#b"};
static const mw_edit_text_options named = {.fields = names,
                                           .field_count = sizeof names / sizeof *names};

static bool same_double(double a, double b)
{
    return memcmp(&a, &b, sizeof a) == 0 || (a != a && b != b);
}

static void require_same(const mw_edit_line *a, const mw_edit_line *b)
{
    const mw_edit *e = &a->edit, *f = &b->edit;
    require(a->kind == b->kind && e->kind == f->kind && e->vertex == f->vertex &&
            e->other == f->other);
    require(same_double(e->x, f->x) && same_double(e->y, f->y) && same_double(e->value, f->value));
    require(e->field == f->field || (e->kind == MW_EDIT_INSERT && e->value != e->value));
}

static void fuzz(const mw_edit_text_options *options, const uint8_t *data, size_t size)
{
    static const char name[] = "input.txt";
    mw_error error = {0};
    mw_source source;
    mw_edit_reader *reader;
    mw_edit_line line = {.kind = MW_EDIT_LINE_UNDO}, again;
    char text[MW_EDIT_TEXT_SIZE];
    if (mw__source_memory(&source, name, data, size, &error) != MW_OK) return;
    if (mw__edit_reader_start(source, options, &reader, &error) != MW_OK) return;
    int64_t before = 0;
    for (bool more = true; more;) {
        mw_status status = mw_edit_reader_read(reader, &line, &error);
        more = status ? line.line > 0 : line.kind != MW_EDIT_LINE_NONE;
        require(!more || (line.line > before && line.line <= (int64_t)size + 1));
        before = line.line;
        if (status) {
            require_error(status, &error, name);
        } else if (more) {
            size_t length = mw_edit_format(&line, options, text);
            require(length > 0 && length < sizeof text && text[length] == 0);
            require(mw_edit_parse(text, options, &again, &error) == MW_OK);
            require_same(&line, &again);
        }
    }
    mw_edit_reader_close(reader);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    fuzz(&named, data, size);
    fuzz(NULL, data, size);
    return 0;
}
