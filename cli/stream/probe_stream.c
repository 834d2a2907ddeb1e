#include "cli/stream/probe_stream.h"
#include "cli/frame/files.h"
#include "cli/frame/message.h"
#include "cli/frame/progress.h"
#include "cli/output/csv_row.h"
#include "cli/stream/statistics.h"

#include <math.h>

/* Probes in memory at a time with --all: each may touch any number of triangles. */
#define ALL_BLOCK_SIZE ((size_t)1 << 14)

/* --- the surface ------------------------------------------------------------------------------ */

static int probed_surface_fail(const probed_surface *p, const char *path, const mw_error *error)
{
    int end = fail_mesh(path, error);
    if (end == END_INPUT && !p->settings->any)
        complain("'meshwalk check --as surface%s %s' lists every defect, 'meshwalk view' shows "
                 "it; --any answers probes all the same",
                 p->settings->weld ? " --weld" : "", path);
    return end;
}

static int probed_surface_prepare(probed_surface *p, const char *path, const mw_mesh_file *file)
{
    const probe_settings *s = p->settings;
    mw_error error;
    mw_arrays arrays = mw_mesh_file_arrays(file);
    mw_surface_options surface = {
        .tolerant = s->any, .weld = s->weld, .progress = progress_of_call()};
    mw_prober_options prober = {.boxes = s->certain || s->inside || s->nearest,
                                .guide = s->guide,
                                .threads = s->stream.common.threads,
                                .progress = progress_of_call()};
    progress_phase("preparing", path);
    if (mw_surface_create(&arrays, &surface, &p->surface, &error) != MW_OK)
        return probed_surface_fail(p, path, &error);
    if (mw_prober_create(p->surface, &prober, &p->prober, &error) != MW_OK)
        return fail_mesh(path, &error);
    /* has the surface an inside? */
    if (s->inside && mw_inside_surface(p->prober, NULL, 0, 0, 1, NULL, &error) != MW_OK)
        return fail_mesh(path, &error);
    return 0;
}

int probed_surface_open(probed_surface *p, const char *path)
{
    mw_mesh_file file;
    int end = files_read_mesh(path, &file);
    if (end) return end;
    end = probed_surface_prepare(p, path, &file);
    mw_mesh_file_release(&file);
    return end;
}

void probed_surface_release(probed_surface *p)
{
    mw_touch_lists_release(&p->lists);
    mw_prober_destroy(p->prober);
    mw_surface_destroy(p->surface);
}

/* --- the probes ------------------------------------------------------------------------------- */

static mw_probe_options probed_surface_options(const probed_surface *p, const query_block *block)
{
    const probe_settings *s = p->settings;
    return (mw_probe_options){
        .max_distance = s->max_distance,
        .certain = s->certain,
        .min_distance = s->min_distance,
        .faces = (mw_probe_faces)s->faces,
        .extent = (mw_probe_extent)s->extent,
        .one_per_place = s->one_per_place,
        .start = (mw_probe_start)s->start,
        .samples = s->samples,
        .iterations = s->iterations,
        .race = s->race,
        .threads = s->stream.common.threads,
        .seed = s->stream.common.seed + block->block, /* each block has its own random numbers */
        .counters = s->stream.stats,
        .progress = progress_of_call(),
    };
}

static int probed_surface_answer(void *self, const query_block *block, void *answers)
{
    probed_surface *p = self;
    const mw_touch *touches = answers;
    mw_error error;
    mw_probe_counters counters = {0};
    mw_probe_options options = probed_surface_options(p, block);
    if (mw_probe_batch(p->prober, block->values, block->count, block->stride, &options, answers,
                       &counters, &error) != MW_OK)
        return fail_query(&error);
    for (size_t i = 0; i < block->count; i++) p->states[touches[i].state]++;
    mw_probe_counters_add(&p->counters, &counters);
    return 0;
}

/* "none" is an answer too: nothing is touched. */
static bool probe_row(const void *self, const double *query, const void *answer, text *out)
{
    (void)self;
    (void)query;
    const mw_touch *touch = answer;
    csv_row_status(out, mw_touch_state_name((mw_touch_state)touch->state), touch->triangle);
    csv_row_double(out, touch->triangle != MW_NONE, touch->distance);
    csv_row_weights(out, touch->triangle, touch->weight);
    return touch->state == MW_TOUCH_HIT || touch->state == MW_TOUCH_NONE;
}

/* --- all triangles of each probe --- */

/* Touches that a probe has: in the lists, from `first` up to `end`; without any, `none`. */
typedef struct probe_touches {
    size_t first, end;
    mw_touch none;
} probe_touches;

/* The lists do not tell a bad probe from one that touches nothing. */
static mw_touch_state probe_state_without(const probed_surface *p, const double *query)
{
    bool segment = p->settings->extent == MW_PROBE_SEGMENT, finite = true, moves = false;
    for (int k = 0; k < 3; k++) {
        double motion = segment ? query[3 + k] - query[k] : query[3 + k];
        finite = finite && isfinite(query[k]) && isfinite(motion);
        moves = moves || motion != 0;
    }
    return finite && moves ? MW_TOUCH_NONE : MW_TOUCH_BAD;
}

static int probed_surface_answer_all(void *self, const query_block *block, void *answers)
{
    probed_surface *p = self;
    probe_touches *of = answers;
    mw_error error;
    mw_probe_counters counters = {0};
    mw_probe_options options = probed_surface_options(p, block);
    mw_touch_lists_release(&p->lists);
    if (mw_probe_all_batch(p->prober, block->values, block->count, block->stride, &options,
                           &p->lists, &counters, &error) != MW_OK)
        return fail_query(&error);
    for (size_t i = 0; i < block->count; i++) {
        of[i].first = p->lists.offset[i];
        of[i].end = p->lists.offset[i + 1];
        mw_touch_state state = MW_TOUCH_HIT;
        if (of[i].first == of[i].end)
            state = probe_state_without(p, block->values + i * block->stride);
        of[i].none = (mw_touch){.triangle = MW_NONE, .state = (uint8_t)state};
        p->states[state]++;
    }
    mw_probe_counters_add(&p->counters, &counters);
    return 0;
}

static const void *probe_touch_part(const void *self, const void *answer, size_t i)
{
    const probed_surface *p = self;
    const probe_touches *of = answer;
    if (of->first == of->end) return i == 0 ? &of->none : NULL;
    return i < of->end - of->first ? &p->lists.touch[of->first + i] : NULL;
}

static bool probe_touch_row(const void *self, const double *query, const void *answer, text *out)
{
    const mw_touch *touch = answer;
    bool answered = probe_row(self, query, answer, out);
    csv_row_count(out, touch->triangle != MW_NONE, touch->back);
    return answered;
}

/* --- the nearest point --- */

static mw_touch_state probe_nearest_state(const mw_nearest_surface_point *nearest,
                                          const double *query)
{
    if (nearest->triangle != MW_NONE) return MW_TOUCH_HIT;
    bool finite = isfinite(query[0]) && isfinite(query[1]) && isfinite(query[2]);
    return finite ? MW_TOUCH_NONE : MW_TOUCH_BAD;
}

static int probed_surface_nearest(void *self, const query_block *block, void *answers)
{
    probed_surface *p = self;
    const probe_settings *s = p->settings;
    const mw_nearest_surface_point *nearest = answers;
    mw_error error;
    mw_nearest_options options = {.threads = s->stream.common.threads,
                                  .progress = progress_of_call()};
    double reach = s->max_distance > 0 ? s->max_distance : INFINITY;
    if (mw_nearest_on_surface_batch(p->prober, block->values, block->count, block->stride, reach,
                                    &options, answers, &error) != MW_OK)
        return fail_query(&error);
    for (size_t i = 0; i < block->count; i++)
        p->states[probe_nearest_state(&nearest[i], block->values + i * block->stride)]++;
    return 0;
}

static bool probe_nearest_row(const void *self, const double *query, const void *answer, text *out)
{
    const mw_nearest_surface_point *nearest = answer;
    mw_touch_state state = probe_nearest_state(nearest, query);
    bool found = state == MW_TOUCH_HIT;
    (void)self;
    csv_row_status(out, mw_touch_state_name(state), nearest->triangle);
    csv_row_double(out, found, nearest->distance);
    for (int k = 0; k < 3; k++) csv_row_double(out, found, nearest->point[k]);
    csv_row_weights(out, nearest->triangle, nearest->weight);
    return state != MW_TOUCH_BAD;
}

/* --- inside --- */

static int probed_surface_sides(void *self, const query_block *block, void *answers)
{
    probed_surface *p = self;
    const uint8_t *sides = answers;
    mw_error error;
    if (mw_inside_surface(p->prober, block->values, block->count, block->stride,
                          p->settings->stream.common.threads, answers, &error) != MW_OK)
        return fail_query(&error);
    for (size_t i = 0; i < block->count; i++) p->sides[sides[i]]++;
    return 0;
}

static bool probe_side_row(const void *self, const double *query, const void *answer, text *out)
{
    (void)self;
    (void)query;
    mw_surface_side side = (mw_surface_side) * (const uint8_t *)answer;
    csv_row_word(out, mw_surface_side_name(side));
    return side != MW_SURFACE_BAD;
}

static void probe_report_counters(report *r, const mw_probe_counters *c)
{
    statistics_report_mean(r, "samples", c->samples, c->queries);
    statistics_report_mean(r, "triangles_per_query", c->triangles, c->queries);
    report_count(r, "triangles_max", c->triangles_max);
    statistics_report_mean(r, "tests_per_query", c->tests, c->queries);
    report_count(r, "tests_max", c->tests_max);
    statistics_report_mean(r, "intersections", c->intersections, c->queries);
    statistics_report_mean(r, "iterations", c->iterations, c->queries);
    report_count(r, "iterations_max", c->iterations_max);
    statistics_report_mean(r, "boxes", c->boxes, c->queries);
    statistics_report_mean(r, "box_triangles", c->box_triangles, c->queries);
}

static void probed_surface_report(const void *self, report *r)
{
    const probed_surface *p = self;
    mw_prober_info info;
    mw_prober_describe(p->prober, &info);
    for (int i = 0; i < MW_TOUCH_STATE_COUNT && !p->settings->inside; i++)
        report_count(r, mw_touch_state_name((mw_touch_state)i), p->states[i]);
    for (int i = 0; i < MW_SURFACE_SIDE_COUNT && p->settings->inside; i++)
        report_count(r, mw_surface_side_name((mw_surface_side)i), p->sides[i]);
    report_string(r, "start", mw_probe_start_name((mw_probe_start)p->settings->start));
    report_flag(r, "certain", p->settings->certain);
    statistics_report_settings(r, &p->settings->stream.common);
    probe_report_counters(r, &p->counters);
    report_count(r, "surface_bytes", mw_surface_bytes(p->surface));
    report_count(r, "prober_bytes", info.bytes);
    report_count(r, "box_bytes", info.box_bytes);
    report_rounded(r, "box_seconds", info.fit_seconds);
}

int probed_surface_run(probed_surface *p, const char *path)
{
    static const char *const answers[] = {"status", "triangle", "distance", "w0", "w1", "w2", NULL};
    static const char *const sides[] = {"status", NULL};
    static const char *const touches[] = {"status", "triangle", "distance", "w0",
                                          "w1",     "w2",       "back",     NULL};
    static const char *const points[] = {"status", "triangle", "distance", "px", "py",
                                         "pz",     "w0",       "w1",       "w2", NULL};
    query_stream s = {
        .settings = &p->settings->stream,
        .begin = p->begin,
        .doing = "probing",
        .columns = {.axes = QUERY_SPACE, .names = {"x", "y", "z", "mx", "my", "mz"}, .count = 6},
        .shown = 3,
        .answers = answers,
        .kinds = "tirrrr",
        .answer_size = sizeof(mw_touch),
        .answer = probed_surface_answer,
        .row = probe_row,
        .report = probed_surface_report,
        .self = p,
    };
    if (p->settings->inside || p->settings->nearest) s.columns.count = 3;
    if (p->settings->inside) {
        s.answers = sides;
        s.kinds = "t";
        s.answer_size = 1;
        s.answer = probed_surface_sides;
        s.row = probe_side_row;
    } else if (p->settings->nearest) {
        s.answers = points;
        s.kinds = "tirrrrrrr";
        s.answer_size = sizeof(mw_nearest_surface_point);
        s.answer = probed_surface_nearest;
        s.row = probe_nearest_row;
    } else if (p->settings->all) {
        s.answers = touches;
        s.kinds = "tirrrri";
        s.answer_size = sizeof(probe_touches);
        s.answer = probed_surface_answer_all;
        s.row = probe_touch_row;
        s.part = probe_touch_part;
        s.block_size = ALL_BLOCK_SIZE;
    }
    return query_stream_run(&s, path);
}
