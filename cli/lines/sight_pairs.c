#include "cli/lines/sight_pairs.h"
#include "cli/frame/message.h"
#include "cli/frame/progress.h"
#include "cli/output/csv_row.h"
#include "src/base/posix.h"

#include <string.h>

static bool sight_pairs_has(const void *rows, const char *name)
{
    static const char *const own[] = {"feature", "part", "visible", "obstacle_x", "obstacle_y"};
    (void)rows;
    for (size_t i = 0; i < sizeof own / sizeof *own; i++)
        if (strcasecmp(own[i], name) == 0) return true;
    return false;
}

/* The line of sight from a to b. False: an end has no ground, or its height is not known. */
static bool sight_pairs_look(const sight_pairs *p, const double a[2], const double b[2],
                             mw_sight *sight)
{
    mw_viewpoint view;
    const mw_sight_end from = {.x = a[0], .y = a[1], .height = p->height},
                       to = {.x = b[0], .y = b[1], .height = p->target_height};
    if (mw_viewpoint_init(p->locator, p->heights, &from, &view, NULL) != MW_OK) return false;
    *sight = mw_sight_to(&view, &to);
    return sight->state != MW_SIGHT_UNKNOWN;
}

static int sight_pairs_write_row(sight_pairs *p, size_t line, row_output *out)
{
    const line_file *l = p->lines;
    const double *a = l->points + 2 * l->first[line], *b = l->points + 2 * l->first[line + 1] - 2;
    const double ends[4] = {a[0], a[1], b[0], b[1]};
    mw_sight sight = {0};
    bool known = sight_pairs_look(p, a, b, &sight),
         hidden = known && sight.state == MW_SIGHT_HIDDEN;
    p->unknown += !known;
    row_output_begin_row(&out->text, &l->values, l->feature[line], l->part[line]);
    csv_row_word(&out->text, !known ? "" : hidden ? "0" : "1");
    for (int k = 0; k < 2; k++) csv_row_double(&out->text, hidden, a[k] + sight.at * (b[k] - a[k]));
    csv_row_end(&out->text);
    return out->rows ? row_output_line(out, ends, 2) : row_output_row(out, ends);
}

int sight_pairs_write(sight_pairs *p, const char *output, const char *crs, bool quiet)
{
    row_output out;
    text header = {0}, kinds = {0};
    row_output_begin_header(&header, &kinds, &p->lines->values, sight_pairs_has, p);
    text_string(&header, ",visible,obstacle_x,obstacle_y\n");
    text_bytes(&kinds, "irr", 4);
    int end = header.failed || kinds.failed ? fail_memory() : 0;
    if (end == 0) {
        end = gdal_rows_known(output)
                  ? row_output_open_lines(&out, output, &header, kinds.bytes, crs, quiet)
                  : row_output_open(&out, output, &header, kinds.bytes, crs, quiet);
        for (size_t i = 0; end == 0 && i < p->lines->count; i++) {
            end = sight_pairs_write_row(p, i, &out);
            progress_lines(i + 1, (double)(i + 1) / (double)p->lines->count);
        }
        int closed = row_output_close(&out, end == 0);
        if (end == 0) end = closed;
    }
    text_release(&header);
    text_release(&kinds);
    return end;
}
