/* bench segments: the triangles along random segments of a Delaunay triangulation of uniform
 * points, short ones of about ten triangles, and ones across half of the square. One row for each
 * size, length and way: a batch on one thread, a batch on all, one segment after the other. */
#include "bench/segments/bench_segments.h"
#include "bench/core/processor_clock.h"
#include "bench/core/rounds.h"
#include "bench/core/word_list.h"
#include "bench/data/dataset.h"
#include "cli/frame/files.h"
#include "cli/frame/message.h"
#include "cli/frame/monotonic_clock.h"
#include "cli/frame/progress.h"

#include <math.h>
#include <meshwalk/meshwalk.h>
#include <stdlib.h>

enum { SEGMENTS = 200000, ROUNDS = 5, FEWEST_VERTICES = 100, SHORT_TRIANGLES = 10 };
enum { ONE_THREAD, ALL_THREADS, ALONE, WAYS };

static const char *const ways[WAYS] = {"batch-1", "batch", "alone"};
static const char *const lengths[] = {"short", "long"};

/* A segment in a Delaunay triangulation of n uniform points of the unit square crosses about so
 * many edges for each unit of length, over the square root of n: as counted here. */
#define CROSSINGS_PER_LENGTH 2.16

typedef struct segments_run {
    const bench_settings *settings;
    mw_locator *locator;
    double *ends; /* x y x y of each segment */
    size_t count;
    size_t pieces; /* of all of them */
    text table;
} segments_run;

static void segments_draw(segments_run *r, size_t vertices, bool are_long)
{
    uint64_t random = r->settings->common.seed + 1;
    double length =
        are_long ? 0.5 : (SHORT_TRIANGLES - 1) / (CROSSINGS_PER_LENGTH * sqrt((double)vertices));
    for (size_t i = 0; i < r->count; i++) {
        double *at = r->ends + 4 * i, angle = 8 * atan(1) * dataset_unit(&random);
        for (int k = 0; k < 2; k++) at[k] = dataset_unit(&random);
        at[2] = at[0] + length * cos(angle);
        at[3] = at[1] + length * sin(angle);
    }
}

static mw_status segments_follow_alone(segments_run *r, mw_error *error)
{
    mw_cursor cursor;
    mw_segment segment;
    mw_segment_piece piece;
    mw_status status = mw_cursor_init(r->locator, NULL, &cursor, error);
    r->pieces = 0;
    for (size_t i = 0; i < r->count && !status; i++) {
        const double *at = r->ends + 4 * i;
        status = mw_segment_begin(r->locator, &cursor, at, at + 2, &segment, error);
        while (!status && mw_segment_next(&segment, &piece)) r->pieces++;
    }
    return status;
}

static mw_status segments_follow_batch(segments_run *r, uint32_t threads, mw_error *error)
{
    mw_segment_pieces pieces;
    mw_segment_options options = {.threads = threads};
    mw_status status = mw_segment_batch(r->locator, r->ends, r->count, 4, &options, &pieces, error);
    r->pieces = pieces.piece_count;
    mw_segment_pieces_release(&pieces);
    return status;
}

/* Figures: seconds by the clock, and of the processor. */
static int segments_time(void *self, size_t way, size_t round, double *figures)
{
    segments_run *r = self;
    mw_error error;
    (void)round;
    double begin = monotonic_seconds(), processor = processor_seconds();
    mw_status status = way == ALONE ? segments_follow_alone(r, &error)
                                    : segments_follow_batch(r, way == ONE_THREAD ? 1 : 0, &error);
    figures[0] = monotonic_seconds() - begin;
    figures[1] = processor_seconds() - processor;
    return status == MW_OK ? 0 : fail_query(&error);
}

static void segments_print_row(segments_run *r, size_t vertices, const char *length,
                               const char *way, double seconds, double processor)
{
    bool tsv = r->settings->format == FORMAT_TSV;
    double each = (double)r->pieces / (double)r->count, ns = 1e9 * seconds / (double)r->count;
    text_printf(&r->table,
                tsv ? "%zu\t%s\t%s\t%.4g\t%.4g\t%.4g\t%.4g\n"
                    : "%9zu %-8s %-8s %12.4g %12.4g %12.4g %12.4g\n",
                vertices, length, way, each, ns, ns / each,
                1e9 * processor / (double)r->count / each);
}

static int segments_measure_length(segments_run *r, size_t vertices, bool are_long)
{
    const bench_settings *s = r->settings;
    rounds_plan plan = {
        .entries = WAYS, .figures = 2, .warmups = 1, .rounds = s->rounds ? s->rounds : ROUNDS};
    rounds_results results = {0};
    size_t all = s->queries ? s->queries : SEGMENTS;
    r->count = are_long ? all / 100 + 1 : all;
    r->ends = malloc(4 * r->count * sizeof *r->ends);
    if (!r->ends) return fail_memory();
    segments_draw(r, vertices, are_long);
    int end = rounds_measure(&plan, segments_time, r, &results);
    for (size_t way = 0; way < WAYS && end == 0; way++)
        segments_print_row(r, vertices, lengths[are_long], ways[way],
                           rounds_minimum(&results, way, 0), rounds_minimum(&results, way, 1));
    rounds_release(&results);
    free(r->ends);
    return end;
}

static int segments_measure_size(segments_run *r, size_t vertices)
{
    dataset set;
    mw_mesh *mesh = NULL;
    mw_error error;
    progress_phase("following", "segments");
    if (!dataset_make(&set, DATASET_UNIFORM, vertices, true, r->settings->common.seed))
        return fail_memory();
    int end = 0;
    if (mw_delaunay(set.points, vertices, 2, NULL, NULL, NULL, &mesh, &error) != MW_OK ||
        mw_locator_create(mesh, NULL, &r->locator, &error) != MW_OK)
        end = fail_query(&error);
    for (int are_long = 0; are_long < 2 && end == 0; are_long++)
        end = segments_measure_length(r, vertices, are_long);
    mw_locator_destroy(r->locator);
    mw_mesh_destroy(mesh);
    dataset_release(&set);
    r->locator = NULL;
    return end;
}

static int segments_check_settings(const bench_settings *s, const char *table)
{
    if (table || s->enclose != ENCLOSE_AUTO || s->no_times || s->data || s->plot || s->engines ||
        s->tasks || s->format == FORMAT_JSON) {
        complain("bench segments makes its own mesh, takes times of meshwalk alone, and prints "
                 "them with --format table or tsv");
        return END_USAGE;
    }
    return options_limit("rounds", s->rounds, 1000, NULL);
}

int bench_segments(const bench_settings *s, const char *table)
{
    segments_run r = {.settings = s};
    size_list sizes = {{5000, 100000, 1000000}, 3};
    int end = segments_check_settings(s, table);
    if (end == 0 && s->sizes) end = word_list_sizes(s->sizes, &sizes);
    if (end == 0) end = files_try_output(s->common.output, NULL);
    text_string(&r.table, s->format == FORMAT_TSV
                              ? "vertices\tlength\tway\ttriangles\tns\tns_triangle\tprocessor\n"
                              : " vertices length   way         triangles           ns  "
                                "ns_triangle    processor\n");
    for (size_t i = 0; i < sizes.count && end == 0; i++)
        end = segments_measure_size(&r, sizes.size[i] < FEWEST_VERTICES ? FEWEST_VERTICES
                                                                        : sizes.size[i]);
    if (end == 0) return files_write_text(s->common.output, &r.table);
    text_release(&r.table);
    return end;
}
