#include "cli/stream/polygon_query.h"
#include "cli/frame/files.h"
#include "cli/frame/message.h"
#include "cli/output/csv_row.h"

#include <stdatomic.h>
#include <stdlib.h>
#include <string.h>

typedef struct polygon_counts {
    atomic_uint_fast64_t inside, border, outside, bad, several;
} polygon_counts;

/* The data of the rows. */
typedef struct polygon_rows {
    const polygon_file *file;
    polygon_counts *counts;
    bool details;
} polygon_rows;

static void counts_add(polygon_counts *c, const feature_hit *hits, size_t count, bool bad)
{
    atomic_uint_fast64_t *which = bad              ? &c->bad
                                  : count == 0     ? &c->outside
                                  : hits[0].border ? &c->border
                                                   : &c->inside;
    atomic_fetch_add_explicit(which, 1, memory_order_relaxed);
    if (count > 1) atomic_fetch_add_explicit(&c->several, 1, memory_order_relaxed);
}

/* The numbers of features, separated by blanks: those on whose border the point is, or all. */
static void rows_write_list(const feature_hit *hits, size_t count, bool border, text *out)
{
    bool first = true;
    for (size_t i = 0; i < count; i++) {
        if (border && !hits[i].border) continue;
        if (first)
            csv_row_count(out, true, hits[i].feature);
        else
            csv_row_count_more(out, hits[i].feature);
        first = false;
    }
    if (first) csv_row_count(out, false, 0);
}

static void rows_write_values(const polygon_rows *rows, const feature_hit *hits, size_t count,
                              text *out)
{
    const feature_values *values = &rows->file->values;
    for (size_t i = 0; i < values->count; i++) {
        const char *cell = count > 0 ? feature_values_cell(values, hits[0].feature, i) : "";
        if (values->kinds[i] == 't')
            csv_row_text(out, cell);
        else
            csv_row_word(out, cell);
    }
}

static bool rows_write(const point_query *q, const void *self, const double point[2],
                       const mw_location *where, text *out)
{
    const polygon_rows *rows = self;
    feature_hit room[FEATURE_ROOM], *hits;
    size_t count = polygon_file_at(rows->file, point, where, room, &hits);
    bool bad = where->where == MW_BAD;
    (void)q;
    if (count == SIZE_MAX) {
        out->failed = true;
        count = 0;
    }
    counts_add(rows->counts, hits, count, bad);
    csv_row_status(out,
                   bad              ? "bad"
                   : count == 0     ? "outside"
                   : hits[0].border ? "border"
                                    : "inside",
                   count > 0 ? hits[0].feature : MW_NONE);
    rows_write_list(count > 0 ? hits + 1 : hits, count > 0 ? count - 1 : 0, false, out);
    if (rows->details) rows_write_list(hits, count, true, out);
    rows_write_values(rows, hits, count, out);
    if (hits != room) free(hits);
    return count > 0;
}

static void polygon_rows_count(const void *self, report *r)
{
    const polygon_rows *rows = self;
    report_count(r, "inside", atomic_load(&rows->counts->inside));
    report_count(r, "border", atomic_load(&rows->counts->border));
    report_count(r, "outside", atomic_load(&rows->counts->outside));
    report_count(r, "bad", atomic_load(&rows->counts->bad));
    report_count(r, "in_several", atomic_load(&rows->counts->several));
    polygon_file_report(rows->file, r);
}

static int rows_run(const point_query *q, const polygon_rows *rows, const char *points)
{
    const feature_values *values = &rows->file->values;
    const char **names = calloc(values->count + 5, sizeof *names);
    char *kinds = calloc(values->count + 5, 1);
    int end = names && kinds ? 0 : fail_memory();
    if (end == 0) {
        size_t count = 0;
        names[count++] = "status", names[count++] = "feature", names[count++] = "others";
        strcpy(kinds, rows->details ? "titt" : "tit");
        if (rows->details) names[count++] = "border_of";
        for (size_t i = 0; i < values->count; i++) {
            names[count] = values->names[i];
            kinds[count++] = values->kinds[i];
        }
        end = point_query_run(q, points, names, kinds, rows_write, rows);
    }
    free(names);
    free(kinds);
    return end;
}

static int polygon_query_check(const point_query_settings *s, const polygon_file_settings *polygons,
                               const char *points)
{
    const char *unfit = s->tolerance > 0 ? "tolerance" : s->any ? "any" : s->fill ? "fill" : NULL;
    if (unfit) {
        complain("option '--%s' is for meshes, not for --polygons", unfit);
        return END_USAGE;
    }
    if (!files_is_standard(polygons->path) || !files_is_standard(points)) return 0;
    complain("standard input cannot be both the polygons and the points");
    return END_USAGE;
}

int polygon_query_run(const point_query_settings *settings, const polygon_file_settings *polygons,
                      const char *points, bool details)
{
    point_query q;
    polygon_file file = {0};
    polygon_counts counts = {0};
    const char *const inputs[] = {polygons->path, points};
    int end = polygon_query_check(settings, polygons, points);
    if (end) return end;
    end = point_query_begin(&q, settings, inputs, 2);
    if (end == 0) end = polygon_file_read(&file, polygons, &settings->stream.common);
    if (end == 0)
        end = point_query_prepare(&q, mw_polygons_mesh(file.polygons), polygons->path, file.crs);
    q.count_rows = polygon_rows_count;
    if (end == 0) end = rows_run(&q, &(polygon_rows){&file, &counts, details}, points);
    point_query_release(&q);
    polygon_file_release(&file);
    return end;
}
