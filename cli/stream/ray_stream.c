#include "cli/stream/ray_stream.h"
#include "cli/frame/message.h"
#include "cli/frame/progress.h"
#include "cli/input/lonlat_input.h"

#include <stdlib.h>

static int ray_stream_allocate(ray_stream *q)
{
    if (q->lonlat) q->points = malloc(QUERY_BLOCK_SIZE * 3 * sizeof *q->points);
    if (q->field) q->at_rays = malloc(QUERY_BLOCK_SIZE * sizeof *q->at_rays);
    return (q->lonlat && !q->points) || (q->field && !q->at_rays) ? fail_memory() : 0;
}

/* `self` begins with the query. */
static int ray_stream_answer(void *self, const query_block *block, void *answers)
{
    ray_stream *q = self;
    const common_settings *common = &q->stream->common;
    mw_error error;
    mw_counters counters = {0};
    mw_star_query_options options = q->options;
    options.seed = common->seed + block->block; /* each block has its own random numbers */
    options.threads = common->threads;
    options.counters = q->stream->stats;
    options.progress = progress_of_call();
    const double *points = block->values;
    size_t stride = block->stride;
    if (q->lonlat) {
        lonlat_input_directions(block->values, stride, block->count, q->centre->at, common->threads,
                                q->points);
        points = q->points;
        stride = 3;
    }
    if (star_input_locate(&q->polyhedron, points, stride, block->count, &options, answers,
                          &counters, &error) != MW_OK)
        return fail_query(&error);
    if (q->field) {
        const mw_hits hits = mw_hits_of_locations(answers, block->count);
        mw_surface_interpolate(q->polyhedron.surface, q->field, &hits, q->at_rays);
        q->first = answers;
    }
    location_statistics_add(&q->statistics, answers, block->count, &counters);
    return 0;
}

int ray_stream_run(ray_stream *q, const char *path, const char *const *answers, const char *kinds,
                   query_stream_row *row, query_stream_report *tell)
{
    query_stream asked = {
        .settings = q->stream,
        .begin = q->begin,
        .doing = "locating",
        .columns = {.axes = QUERY_SPACE,
                    .names = {"x", "y", "z"},
                    .count = 3,
                    .hint = "; --lonlat reads longitude and latitude"},
        .answers = answers,
        .kinds = kinds,
        .answer_size = sizeof(mw_location),
        .answer = ray_stream_answer,
        .row = row,
        .report = tell,
        .self = q,
    };
    if (q->lonlat) {
        asked.columns = (query_columns){.axes = QUERY_LONLAT, .names = {"lon", "lat"}, .count = 2};
        asked.domain = QUERIES_BY_LONLAT;
    }
    asked.shown = asked.columns.count;
    const int end = ray_stream_allocate(q);
    return end ? end : query_stream_run(&asked, path);
}

void ray_stream_report_status(const ray_stream *q, report *out)
{
    static const mw_where states[] = {MW_INSIDE, MW_ON_EDGE, MW_ON_VERTEX, MW_BAD, MW_OUTSIDE};
    const size_t count = sizeof states / sizeof *states - (q->polyhedron.prober ? 0 : 1);
    for (size_t i = 0; i < count; i++)
        report_count(out, mw_where_name(states[i]), q->statistics.where[states[i]]);
}

void ray_stream_release(ray_stream *q)
{
    free(q->points);
    free(q->at_rays);
    star_input_release(&q->polyhedron);
}
