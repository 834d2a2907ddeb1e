/* Any bytes as a stream of edits of a surface. What is taken comes back when its text is read
 * again; what is refused names its line. */
#include "io/edits/surface_edit_text.h"
#include "oracle/edit_require.h"

#include <stdbool.h>
#include <string.h>

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

/* A refusal begins with the name of the input. */
static void require_message(mw_status status, const mw_error *error, const char *name)
{
    REQUIRE(status == MW_ERROR_INPUT && error->status == status);
    REQUIRE(strncmp(error->message, name, strlen(name)) == 0);
    for (const char *p = error->message; *p; p++) REQUIRE((unsigned char)*p >= 0x20);
}

static bool same_doubles(const double *a, const double *b, size_t n)
{
    for (size_t i = 0; i < n; i++)
        if (memcmp(&a[i], &b[i], sizeof *a) != 0 && !(a[i] != a[i] && b[i] != b[i])) return false;
    return true;
}

static void require_same(const mw_surface_edit_line *a, const mw_surface_edit_line *b)
{
    const mw_surface_edit *e = &a->edit, *f = &b->edit;
    REQUIRE(a->kind == b->kind && e->kind == f->kind && e->triangle == f->triangle);
    REQUIRE(memcmp(e->vertex, f->vertex, sizeof e->vertex) == 0);
    REQUIRE(same_doubles(e->point, f->point, 3) && same_doubles(a->point, b->point, 3) &&
            same_doubles(a->motion, b->motion, 3));
    REQUIRE(e->path_count == f->path_count && !e->path == !f->path && !e->other == !f->other);
    for (size_t i = 0; i < e->path_count; i++)
        REQUIRE(e->path[i] == f->path[i] && (!e->other || e->other[i] == f->other[i]));
}

/* The text of a line, read again by a reader of its own. */
static void require_again(const mw_surface_edit_line *line)
{
    mw_error error = {0};
    mw_source source;
    mw_surface_edit_reader *reader;
    mw_surface_edit_line again;
    if (mw__source_memory(&source, "again.txt", (const uint8_t *)line->text, strlen(line->text),
                          &error) != MW_OK)
        return;
    if (mw__surface_edit_reader_start(source, &reader, &error) != MW_OK) return;
    REQUIRE(mw_surface_edit_reader_read(reader, &again, &error) == MW_OK);
    require_same(line, &again);
    mw_surface_edit_reader_close(reader);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    static const char name[] = "input.txt";
    mw_error error = {0};
    mw_source source;
    mw_surface_edit_reader *reader;
    mw_surface_edit_line line;
    if (mw__source_memory(&source, name, data, size, &error) != MW_OK) return 0;
    if (mw__surface_edit_reader_start(source, &reader, &error) != MW_OK) return 0;
    int64_t before = 0;
    for (bool more = true; more;) {
        mw_status status = mw_surface_edit_reader_read(reader, &line, &error);
        more = status ? line.line > 0 : line.kind != MW_SURFACE_EDIT_LINE_NONE;
        REQUIRE(!more || (line.line > before && line.line <= (int64_t)size + 1));
        before = line.line;
        if (status)
            require_message(status, &error, name);
        else if (more)
            require_again(&line);
    }
    mw_surface_edit_reader_close(reader);
    return 0;
}
