#include "cli/lines/profile_rows.h"
#include "cli/frame/message.h"
#include "cli/frame/progress.h"
#include "cli/output/csv_row.h"
#include "src/base/posix.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { SEGMENTS_AT_A_TIME = 1 << 16 };

/* --- header --- */

/* A name of an attribute that is also one of ours gets a prefix. */
static bool header_has(const void *rows, const char *name)
{
    const profile *p = rows;
    const char *own[] = {"feature", "part", "chainage", "x", "y", "triangle", "at", p->name};
    for (size_t i = 0; i < sizeof own / sizeof *own; i++)
        if (strcasecmp(own[i], name) == 0) return true;
    return false;
}

bool profile_write_header(const profile *p, text *header, text *kinds)
{
    row_output_begin_header(header, kinds, &p->lines->values, header_has, p);
    text_string(header, ",chainage,x,y");
    csv_row_text(header, p->name);
    text_string(header, ",triangle,at\n");
    text_bytes(kinds, "rrrrit", 7);
    return !header->failed && !kinds->failed;
}

/* --- rows --- */

/* A point of the profile. */
typedef struct profile_point {
    double chainage, xy[2], value; /* value: NaN where there is none */
    uint32_t triangle;             /* that the line goes on in; MW_NONE: none */
    const char *at;
} profile_point;

static int profile_write_point(profile *p, size_t line, const profile_point *point)
{
    text *out = &p->out->text;
    row_output_begin_row(out, &p->lines->values, p->lines->feature[line], p->lines->part[line]);
    csv_row_double(out, true, point->chainage);
    csv_row_double(out, true, point->xy[0]);
    csv_row_double(out, true, point->xy[1]);
    csv_row_double(out, !isnan(point->value), point->value);
    if (point->triangle == MW_NONE)
        csv_row_word(out, "-1");
    else
        csv_row_count(out, true, point->triangle);
    csv_row_word(out, point->at);
    csv_row_end(out);
    p->rows++;
    p->empty += isnan(point->value) ? 1 : 0;
    return row_output_row(p->out, point->xy);
}

/* The point where a piece begins or ends. */
static profile_point profile_point_of(const profile *p, const double *ends,
                                      const mw_segment_piece *piece, int end)
{
    profile_point point = {.at = "edge"};
    double weight[3];
    uint32_t v[3];
    uint8_t position = end ? piece->to_at : piece->from_at;
    mw_segment_weights(p->mesh, ends, ends + 2, piece, end, weight, point.xy);
    mw_mesh_triangle(p->mesh, piece->triangle, v);
    for (int k = 0; k < 3; k++)
        if (weight[k] != 0) point.value += weight[k] * p->values[v[k]];
    if (position >= MW_AT_VERTEX && position < MW_AT_INSIDE) point.at = "vertex";
    return point;
}

/* A line on its way. */
typedef struct profile_line {
    size_t number;
    double chainage; /* of the segment's beginning */
    double reached;  /* the value there, if the segment before ended in the mesh; else NaN */
} profile_line;

static int profile_begin_segment(profile *p, const profile_line *line, const double *ends,
                                 const mw_segment_piece *piece, bool first)
{
    profile_point point = {.value = line->reached, .triangle = MW_NONE};
    if (piece) {
        point = profile_point_of(p, ends, piece, 0);
        point.triangle = piece->triangle;
    }
    point.chainage = line->chainage;
    point.at = first ? "begin" : "corner";
    memcpy(point.xy, ends, sizeof point.xy);
    return profile_write_point(p, line->number, &point);
}

/* The way along a segment up to a part of it. Its whole length may be too large for a double. */
static double profile_way(const double *ends, double length, double part)
{
    if (isfinite(length)) return part * length;
    return 2 * hypot(part * (ends[2] / 2 - ends[0] / 2), part * (ends[3] / 2 - ends[1] / 2));
}

/* One piece: where it begins, if that is behind a gap, and where it ends, if that is not the end of
 * the segment. `next` begins there, or is NULL. */
static int profile_write_piece(profile *p, profile_line *line, const double *ends, double length,
                               const mw_segment_piece *piece, const mw_segment_piece *next,
                               bool ends_segment)
{
    int end = 0;
    profile_point point;
    if (piece->gap) {
        point = profile_point_of(p, ends, piece, 0);
        point.chainage = line->chainage + profile_way(ends, length, piece->from);
        point.triangle = piece->triangle;
        end = profile_write_point(p, line->number, &point);
    }
    point = profile_point_of(p, ends, piece, 1);
    if (ends_segment) {
        line->reached = point.value;
        return end;
    }
    point.chainage = line->chainage + profile_way(ends, length, piece->to);
    point.triangle = next ? next->triangle : MW_NONE;
    return end ? end : profile_write_point(p, line->number, &point);
}

/* One segment, without its end, which is the beginning of the next. */
static int profile_write_segment(profile *p, profile_line *line, const double *ends, bool first,
                                 const mw_segment_piece *piece, size_t count)
{
    double length = hypot(ends[2] - ends[0], ends[3] - ends[1]);
    int end =
        profile_begin_segment(p, line, ends, count > 0 && !piece[0].gap ? piece : NULL, first);
    line->reached = NAN;
    for (size_t i = 0; end == 0 && i < count; i++) {
        const mw_segment_piece *next = i + 1 < count && !piece[i + 1].gap ? &piece[i + 1] : NULL;
        bool last = i + 1 == count && (piece[i].to == 1 || length == 0);
        end = profile_write_piece(p, line, ends, length, &piece[i], next, last);
    }
    line->chainage += length;
    return end;
}

/* A line of one point is a segment of no length. */
static size_t profile_line_segments(const line_file *lines, size_t line)
{
    size_t points = lines->first[line + 1] - lines->first[line];
    return points > 1 ? points - 1 : 1;
}

static void profile_segment_ends(const line_file *lines, size_t line, size_t segment, double *ends)
{
    size_t a = lines->first[line] + segment, b = a + 1 < lines->first[line + 1] ? a + 1 : a;
    memcpy(ends, lines->points + 2 * a, 2 * sizeof *ends);
    memcpy(ends + 2, lines->points + 2 * b, 2 * sizeof *ends);
}

static int profile_write_line(profile *p, size_t number, const double *ends,
                              const mw_segment_pieces *pieces, size_t first)
{
    profile_line line = {.number = number, .reached = NAN};
    size_t segments = profile_line_segments(p->lines, number);
    int end = 0;
    for (size_t i = 0; end == 0 && i < segments; i++) {
        size_t from = pieces->offset[first + i], to = pieces->offset[first + i + 1];
        end = profile_write_segment(p, &line, ends + 4 * (first + i), i == 0, pieces->piece + from,
                                    to - from);
    }
    profile_point last = {
        .chainage = line.chainage, .value = line.reached, .triangle = MW_NONE, .at = "end"};
    memcpy(last.xy, ends + 4 * (first + segments - 1) + 2, sizeof last.xy);
    return end ? end : profile_write_point(p, number, &last);
}

/* The lines from `from` to `to` - 1, which have so many segments. */
static int profile_write_lines(profile *p, size_t from, size_t to, size_t segments)
{
    mw_segment_pieces pieces = {0};
    mw_segment_options options = {.threads = p->threads, .progress = progress_of_call()};
    mw_error error;
    double *ends = malloc(4 * segments * sizeof *ends);
    size_t count = 0;
    if (!ends) return fail_memory();
    for (size_t i = from; i < to; i++)
        for (size_t k = 0; k < profile_line_segments(p->lines, i); k++)
            profile_segment_ends(p->lines, i, k, ends + 4 * count++);
    int end = 0;
    if (mw_segment_batch(p->locator, ends, segments, 4, &options, &pieces, &error) != MW_OK)
        end = fail_query(&error);
    for (size_t i = from, first = 0; end == 0 && i < to; i++) {
        end = profile_write_line(p, i, ends, &pieces, first);
        first += profile_line_segments(p->lines, i);
    }
    mw_segment_pieces_release(&pieces);
    free(ends);
    return end;
}

int profile_write_rows(profile *p)
{
    size_t lines = p->lines->count;
    int end = 0;
    for (size_t from = 0, to; end == 0 && from < lines; from = to) {
        size_t segments = 0;
        for (to = from; to < lines && segments < SEGMENTS_AT_A_TIME; to++)
            segments += profile_line_segments(p->lines, to);
        progress_part((double)from / (double)lines, (double)to / (double)lines);
        end = profile_write_lines(p, from, to, segments);
        progress_lines(to, (double)to / (double)lines);
    }
    return end;
}
