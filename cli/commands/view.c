/* view - writes a self-contained page that shows a mesh in a browser. */
#include "cli/commands/commands.h"
#include "cli/frame/files.h"
#include "cli/frame/message.h"
#include "cli/frame/progress.h"
#include "cli/input/mesh_space.h"
#include "cli/input/query_source.h"
#include "cli/view/view_content.h"
#include "cli/view/view_page.h"
#include "src/base/posix.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

typedef struct view_settings {
    mesh_space_settings mesh;
    const char *points, *columns;
} view_settings;

static const option view_options[] = {
    {"output", 'o', OPTION_TEXT, offsetof(view_settings, mesh.common.output), "FILE",
     "write the page to FILE (default: a temporary file, whose name is printed)", NULL},
    {"points", 0, OPTION_TEXT, offsetof(view_settings, points), "FILE",
     "show the points of FILE too, coloured by where they lie", NULL},
    {"columns", 0, OPTION_TEXT, offsetof(view_settings, columns), "LIST",
     "columns of --points that hold x and y, as names or numbers from 1 (default: those that the "
     "header names so, or the only two)",
     NULL},
    {0},
};

/* --- points ----------------------------------------------------------------------------------- */

typedef struct view_points {
    double *xy;
    size_t count, room;
} view_points;

static int view_points_grow(view_points *p)
{
    size_t room = p->room ? 2 * p->room : 4096;
    double *more = realloc(p->xy, room * 2 * sizeof *more);
    if (!more) return fail_memory();
    p->xy = more;
    p->room = room;
    return 0;
}

static int view_points_read_all(view_points *p, query_source *source)
{
    int end = 0;
    for (size_t count = 1; end == 0 && count > 0;) {
        if (p->count == p->room) end = view_points_grow(p);
        if (end == 0)
            end = query_source_read(source, p->xy + 2 * p->count, p->room - p->count, &count);
        if (end == 0) p->count += count;
    }
    return end;
}

static int view_points_read(view_points *p, const view_settings *s)
{
    query_source *source = NULL;
    size_t index[MAX_QUERY_COLUMNS];
    query_source_settings settings = {.columns = s->columns};
    query_columns wanted = {.axes = QUERY_PLANE,
                            .prefer = PREFER_OTHERS,
                            .names = {"x", "y"},
                            .count = 2,
                            .hint = "name them by --columns"};
    if (!s->points) return 0;
    int end = query_source_open(&source, s->points, &settings, &wanted, index);
    if (end == 0) end = view_points_read_all(p, source);
    query_source_close(source);
    return end;
}

/* --- the page --------------------------------------------------------------------------------- */

/* Make an empty temporary file for the page, so that no other program takes its name. */
static int view_temporary(char *path, size_t size)
{
    const char *directory = getenv("TMPDIR");
    if (!directory || !*directory) directory = "/tmp";
    int length = snprintf(path, size, "%s/meshwalk-XXXXXX.html", directory);
    int fd = length > 0 && (size_t)length < size ? mkstemps(path, (int)strlen(".html")) : -1;
    if (fd >= 0) {
        close(fd);
        return 0;
    }
    complain("no temporary file can be made in %s; name one by -o page.html", directory);
    return END_RESOURCE;
}

static int view_write(const char *output, const view_content *content)
{
    text t = {0};
    size_t size;
    const char *page = view_page(&size);
    const char *mark = strstr(page, VIEW_PAGE_MARK);
    size_t before = (size_t)(mark - page), skipped = before + strlen(VIEW_PAGE_MARK);
    progress_phase("packing", content->path);
    text_bytes(&t, page, before);
    view_content_write(&t, content);
    text_bytes(&t, page + skipped, size - skipped);
    return files_write_text(output, &t);
}

static int view_write_and_tell(const view_settings *s, const view_content *content)
{
    char path[4096];
    const char *output = s->mesh.common.output;
    if (output) return view_write(files_is_standard(output) ? NULL : output, content);
    int end = view_temporary(path, sizeof path);
    if (end) return end;
    end = view_write(path, content);
    if (end) unlink(path);
    if (end == 0 && (puts(path) < 0 || fflush(stdout) != 0)) {
        complain("standard output cannot be written");
        return END_RESOURCE;
    }
    return end;
}

static int view_check(const view_settings *s, const char *const *operands)
{
    size_t size;
    const char *const inputs[] = {operands[0], s->points};
    if (!view_page(&size)) {
        complain("this program was built without the page: the build needs the packages clang-14, "
                 "lld, wasi-libc and libclang-rt-14-dev-wasm32");
        return END_USAGE;
    }
    if (s->columns && !s->points) {
        complain("option '--columns' needs --points");
        return END_USAGE;
    }
    return files_check_output(s->mesh.common.output, inputs, s->points ? 2 : 1);
}

static int view_run(const void *settings, const char *const *operands)
{
    static const char *const ways[] = {"plane", "surface", "star"};
    const view_settings *s = settings;
    mw_mesh_file file = {0};
    view_points points = {0};
    int end = view_check(s, operands);
    if (end == 0) end = mesh_space_read(&s->mesh, operands, &file);
    if (end == 0) end = view_points_read(&points, s);
    view_content content = {.path = operands[0],
                            .as = ways[s->mesh.space],
                            .centre = s->mesh.centre.at,
                            .mesh = &file,
                            .points_path = s->points,
                            .points = points.xy,
                            .point_count = points.count};
    if (end == 0) end = view_write_and_tell(s, &content);
    free(points.xy);
    mw_mesh_file_release(&file);
    return end;
}

static const option *const tables[] = {view_options, mesh_space_options, common_options, NULL};

const command view_command = {
    .name = "view",
    .operands = "MESH",
    .operand_count = 1,
    .summary = "make a page that shows a mesh in a browser",
    .description =
        "Writes a page that any browser opens, without a network: it holds MESH and the engine, "
        "and sends nothing anywhere. It draws the mesh, coloured by any field; tells the triangle, "
        "weights and values under the mouse; walks from click to click by any walk, or by all of "
        "them in a race; lists the defects of the mesh, leads to each and explains it; draws "
        "profiles; and opens other files that are dropped on it. '-' is standard input.",
    .options = tables,
    .essential = "output points columns as quiet",
    .settings_size = sizeof(view_settings),
    .run = view_run,
};
