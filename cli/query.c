#include "query.h"
#include "files.h"
#include "message.h"
#include "progress.h"
#include "signals.h"
#include "tally.h"

#include <stdlib.h>
#include <string.h>

#define BLOCK ((size_t)1 << 18) /* points in memory at a time */
#define CHUNK ((size_t)1 << 12) /* of a block: rows that one thread formats in one go */
#define CHUNKS (BLOCK / CHUNK)

static const char *walk_name(int i)
{
    return mw_walk_name((mw_walk_kind)i);
}
static const char *walk_help(int i)
{
    return mw_walk_help((mw_walk_kind)i);
}
static const char *start_name(int i)
{
    return mw_start_name((mw_start_kind)i);
}
static const char *start_help(int i)
{
    return mw_start_help((mw_start_kind)i);
}
static const char *arithmetic_name(int i)
{
    return i == MW_EXACT ? "exact" : i == MW_DOUBLE ? "double" : NULL;
}

/* What may end the walks whose own tests are only a guide. */
static const mw_walk_kind finishes[] = {MW_WALK_AUTO, MW_WALK_REMEMBERING, MW_WALK_STOCHASTIC};
static const char *finish_name(int i)
{
    return i < (int)(sizeof finishes / sizeof *finishes) ? mw_walk_name(finishes[i]) : NULL;
}

/* What becomes of pockets and holes: the numbers of mw_locator_options.fill. */
enum { FILL_AUTO, FILL_YES, FILL_NO };
static const char *fill_name(int i)
{
    static const char *const names[] = {"auto", "yes", "no", NULL};
    return names[i];
}

static const choices walks = {"walk", walk_name, walk_help};
static const choices starts = {"start", start_name, start_help};
static const choices arithmetics = {"arithmetic", arithmetic_name, NULL};
static const choices fill_choices = {"way to fill", fill_name, NULL};
static const choices finish_choices = {"way to finish", finish_name, NULL};

const option query_options[] = {
    {"walk", 0, OPTION_CHOICE, offsetof(query_settings, walk), "NAME",
     "how to walk to the triangle (default: auto):", &walks},
    {"start", 0, OPTION_CHOICE, offsetof(query_settings, start), "NAME",
     "how to choose the first triangle (default: auto):", &starts},
    {"arithmetic", 0, OPTION_CHOICE, offsetof(query_settings, arithmetic), "NAME",
     "how walks decide their turns (default: exact); the triangle found is exact in either case:", &arithmetics},
    {"finish", 0, OPTION_CHOICE, offsetof(query_settings, finish), "NAME",
     "the walk that ends those whose own tests are only a guide (default: auto, by the mesh):", &finish_choices},
    {"fill", 0, OPTION_CHOICE, offsetof(query_settings, fill), "NAME",
     "fill pockets and holes of the mesh with triangles that count as outside, so that every walk can cross them; "
     "without "
     "them only --walk border finds its way (default: auto: no with --walk border, else yes):",
     &fill_choices},
    {"steps", 0, OPTION_COUNT, offsetof(query_settings, steps), "K",
     "--walk fast-stochastic: steps with one test (default: 0, estimated)", NULL},
    {"areas", 0, OPTION_FLAG, offsetof(query_settings, areas), NULL,
     "store the areas of the triangles, which saves tests with --walk direct", NULL},
    {"sample", 0, OPTION_SAMPLE, offsetof(query_settings, sample), "K",
     "--start sample: look at K random triangles; also cube-root (the default) or fourth-root, of the number of "
     "triangles",
     NULL},
    {"cells", 0, OPTION_COUNT, offsetof(query_settings, cells), "N",
     "--start grid, two-level-grid: about N cells, of the first level (default: 0, by the number of vertices)", NULL},
    {"layers", 0, OPTION_COUNT, offsetof(query_settings, layers), "N",
     "--start layers: N layers, the mesh itself counted (default: 0, by its size)", NULL},
    {"tolerance", 0, OPTION_LENGTH, offsetof(query_settings, tolerance), "D",
     "a point outside, at most D away from the mesh, is 'near' (default: 0)", NULL},
    {"columns", 0, OPTION_TEXT, offsetof(query_settings, columns), "LIST",
     "columns of POINTS that hold x and y, as names or numbers from 1: lon,lat or 3,4 (default: those that a header "
     "calls x and y, lon and lat, ..., else the first two)",
     NULL},
    {"any", 0, OPTION_FLAG, offsetof(query_settings, any), NULL,
     "take also a mesh that is no embedding; a warning says what is not promised then", NULL},
    {"strict", 0, OPTION_FLAG, offsetof(query_settings, strict), NULL, "exit with 1 if a point has no answer", NULL},
    {"stats", 0, OPTION_FLAG, offsetof(query_settings, stats), NULL,
     "print counts and times on standard error when done", NULL},
    {"json", 0, OPTION_FLAG, offsetof(query_settings, json), NULL, "with --stats: as JSON", NULL},
    {0},
};

static void warn_if_void(const query *q, const char *path)
{
    const char *promise = mw_locator_void_promise(q->locator);
    if (promise && !q->settings->common.quiet) complain("%s: warning: %s", path, promise);
}

/* With `area`, a triangle that has one, a mesh is refused for its defects only, and --any helps. */
static int fail_defect(const query *q, const char *path, bool area, const mw_error *error)
{
    int end = fail_mesh(path, error);
    if (end == END_INPUT && !q->settings->any && area)
        complain("'meshwalk check %s' lists every defect; --any locates points all the same", path);
    return end;
}

static int make_mesh(query *q, const char *path, const mw_mesh_file *file, bool area)
{
    mw_error error;
    mw_arrays arrays = mw_mesh_file_arrays(file);
    mw_mesh_options options = {.tolerant = q->settings->any};
    progress_phase("preparing", path);
    return mw_mesh_create(&arrays, &options, &q->mesh, &error) == MW_OK ? 0 : fail_defect(q, path, area, &error);
}

static int make_locator(query *q, const char *path, bool border, bool area)
{
    mw_error error;
    const query_settings *settings = q->settings;
    mw_locator_options options = {.any = settings->any,
                                  .border = border || settings->tolerance > 0,
                                  .areas = settings->areas,
                                  .fill = settings->fill};
    if (settings->walk == MW_WALK_BORDER && settings->fill == FILL_AUTO) options.fill = FILL_NO;
    if (mw_locator_create(q->mesh, &options, &q->locator, &error) != MW_OK) return fail_defect(q, path, area, &error);
    warn_if_void(q, path);
    return 0;
}

/* The library refuses an option, or a limit is reached. */
static int fail_query(const mw_error *error)
{
    complain("%s", error->message);
    return error->status == MW_ERROR_ARGUMENT ? END_USAGE : END_INTERNAL;
}

/* The limits of the library, found out before the mesh is read. */
static int check_index(const query_settings *settings)
{
    const uint32_t most_cells = UINT32_C(1) << 30;
    if (settings->cells > most_cells) complain("option '--cells' wants at most 2^30, not '%u'", settings->cells);
    if (settings->layers > MW_MAX_LAYERS)
        complain("option '--layers' wants at most %d, not '%u'", MW_MAX_LAYERS, settings->layers);
    return settings->cells > most_cells || settings->layers > MW_MAX_LAYERS ? END_USAGE : 0;
}

/* Only the border walk does without what fills pockets and holes. */
static int check_fill(const query_settings *settings)
{
    if (settings->fill != FILL_NO || settings->walk == MW_WALK_AUTO || settings->walk == MW_WALK_BORDER) return 0;
    complain("--fill no wants --walk border, not %s", mw_walk_name((mw_walk_kind)settings->walk));
    return END_USAGE;
}

/* Build what the start needs, if it needs something. */
static int make_index(query *q)
{
    mw_error error;
    const query_settings *settings = q->settings;
    mw_start_kind start = (mw_start_kind)settings->start;
    if (!mw_start_has_index(start)) return 0;
    mw_index_options options = {.cells = settings->cells, .layers = settings->layers, .seed = settings->common.seed};
    return mw_index_create(q->locator, start, &options, &q->index, &error) == MW_OK ? 0 : fail_query(&error);
}

int query_open(query *q, const query_settings *settings, const char *const *operands, bool border, query_keep *keep,
               const void *self)
{
    const char *path = operands[0];
    mw_mesh_file file;
    *q = (query){.settings = settings, .begin = tally_clock()};
    int end = files_check(settings->common.output, operands, 2);
    if (end == 0) end = check_index(settings);
    if (end == 0) end = check_fill(settings);
    if (end == 0) end = files_read_mesh(path, &file);
    if (end) return end;
    bool area = files_has_area(&file);
    end = make_mesh(q, path, &file, area);
    if (end == 0 && keep) end = keep(q->mesh, path, &file, self);
    mw_mesh_file_release(&file);
    if (end == 0) end = make_locator(q, path, border, area);
    return end ? end : make_index(q);
}

void query_release(query *q)
{
    mw_index_destroy(q->index);
    mw_locator_destroy(q->locator);
    mw_mesh_destroy(q->mesh);
}

/* The stream of points, a block of it, and its rows. */
typedef struct stream {
    const query *query;
    query_row *row;
    const void *self;
    mw_point_reader *reader;
    mw_output *out;
    double *values;
    size_t width;
    mw_location *locations;
    text chunk[CHUNKS];
    uint64_t unanswered[CHUNKS];
    tally tally;
} stream;

static void format_chunk(stream *s, size_t k, size_t count)
{
    size_t begin = k * CHUNK, end = begin + CHUNK < count ? begin + CHUNK : count;
    text_clear(&s->chunk[k]);
    s->unanswered[k] = 0;
    for (size_t i = begin; i < end; i++)
        s->unanswered[k] += !s->row(s->query, s->self, s->values + i * s->width, &s->locations[i], &s->chunk[k]);
}

/* Rows are made by several threads, none of them without work, and written in order. */
static int write_block(stream *s, size_t count)
{
    long chunks = (long)((count + CHUNK - 1) / CHUNK);
    long threads = tally_threads(s->query->settings->common.threads);
    if (threads > chunks) threads = chunks;
#ifdef _OPENMP
#pragma omp parallel for num_threads((int)threads) if (threads > 1) schedule(dynamic)
#endif
    for (long k = 0; k < chunks; k++) format_chunk(s, (size_t)k, count);
    for (long k = 0; k < chunks; k++) {
        if (s->chunk[k].failed) return fail_memory();
        mw_output_write(s->out, s->chunk[k].bytes, s->chunk[k].size);
        s->tally.unanswered += s->unanswered[k];
    }
    return 0;
}

static int locate_block(stream *s, size_t count)
{
    const query_settings *settings = s->query->settings;
    mw_error error;
    mw_counters counters = {0};
    mw_query_options options = {
        .walk = (mw_walk_kind)settings->walk,
        .start = (mw_start_kind)settings->start,
        .arithmetic = (mw_arithmetic)settings->arithmetic,
        .finish = finishes[settings->finish],
        .seed = settings->common.seed + s->tally.blocks, /* other random numbers in each block */
        .sample = settings->sample,
        .steps = settings->steps,
        .threads = settings->common.threads,
        .tolerance = settings->tolerance,
        .count = settings->stats,
        .index = s->query->index,
    };
    double begin = tally_clock();
    mw_status status =
        mw_locate_batch(s->query->locator, s->values, count, s->width, &options, s->locations, &counters, &error);
    if (status != MW_OK) return fail_query(&error);
    tally_block(&s->tally, s->locations, count, &counters, tally_clock() - begin);
    return 0;
}

static int run_blocks(stream *s)
{
    mw_error error;
    while (!mw_output_failed(s->out)) {
        size_t count;
        if (mw_points_read(s->reader, s->values, BLOCK, &count, &error) != MW_OK) return fail_reading(&error);
        if (count == 0) return 0;
        int end = locate_block(s, count);
        if (end == 0) end = write_block(s, count);
        if (end) return end;
        progress_points(s->tally.points);
    }
    return 0; /* closing the output reports what failed */
}

/* Points and output are open. */
static int run_stream(stream *s, const char *header)
{
    mw_error error;
    signals_remove(mw_output_temporary(s->out));
    s->width = mw_points_width(s->reader);
    s->values = malloc(BLOCK * s->width * sizeof *s->values);
    s->locations = malloc(BLOCK * sizeof *s->locations);
    int end = s->values && s->locations ? 0 : fail_memory();
    if (end == 0) {
        mw_output_write(s->out, header, strlen(header));
        end = run_blocks(s);
    }
    progress_phase("writing", NULL);
    if (mw_output_close(s->out, end == 0, &error) != MW_OK && end == 0) end = fail_writing(&error);
    signals_remove(NULL);
    for (size_t k = 0; k < CHUNKS; k++) text_release(&s->chunk[k]);
    free(s->locations);
    free(s->values);
    return end;
}

int query_run(const query *q, const char *points, const char *header, query_row *row, const void *self)
{
    const query_settings *settings = q->settings;
    mw_error error;
    mw_points_options options = {.columns = settings->columns};
    stream *s = calloc(1, sizeof *s);
    if (!s) return fail_memory();
    *s = (stream){.query = q, .row = row, .self = self};
    tally_begin(&s->tally);
    int end;
    progress_phase("locating", points);
    if (mw_points_open(points, &options, &s->reader, &error) != MW_OK)
        end = fail_reading(&error);
    else if (mw_output_open(settings->common.output ? settings->common.output : "-", &s->out, &error) != MW_OK)
        end = fail_writing(&error);
    else
        end = run_stream(s, header);
    mw_points_close(s->reader);
    if (end == 0 && settings->stats) end = tally_print(&s->tally, q);
    if (end == 0 && settings->strict && s->tally.unanswered) end = END_UNLOCATED;
    free(s);
    return end;
}
