/* bench ocean: what users of ocean models wait for, on a Delaunay triangulation of uniform points.
 *   open   a mesh of UGRID is read and gets a locator, beside one from arrays in memory
 *   hints  10^5 particles that drift, each located from its last triangle
 *   apply  weights of as many points as vertices, applied to 240 steps, beside copying by one
 *          thread; values side by side, or steps one after the other; points are those of a grid,
 *          vertices numbered so that neighbours have near numbers, or (scattered) both at random
 * Prints one row for each way, as soon as its task is measured. The other ways of a task are
 * compared with its first: by time; `apply` by the time for each byte that must be read or written.
 */
#include "bench/ocean/bench_ocean.h"
#include "bench/core/rounds.h"
#include "bench/core/word_list.h"
#include "bench/data/dataset.h"
#include "bench/ocean/ocean_weights.h"
#include "cli/frame/files.h"
#include "cli/frame/message.h"
#include "cli/frame/monotonic_clock.h"
#include "cli/frame/progress.h"

#include <meshwalk/meshwalk.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

enum { PARTICLES = 100000, DRIFTS = 10, ROUNDS = 5, FEWEST_VERTICES = 1000 };

typedef struct ocean_run {
    const bench_settings *settings;
    mw_mesh_file file; /* what is written and read */
    char path[64];
    mw_mesh *mesh;
    mw_locator *locator;
    double *places; /* of the particles */
    uint32_t *hints;
    text table;
} ocean_run;

static size_t ocean_rounds(const ocean_run *r)
{
    return r->settings->rounds ? r->settings->rounds : ROUNDS;
}

/* The ways of a task, and how many pieces of work and bytes each does. */
typedef struct ocean_task {
    const char *name;
    const char *const *ways;
    size_t count;
    double pieces;
    const double *bytes; /* of each way; NULL: alike */
} ocean_task;

/* Results for standard output are shown as they come, so that a long run can be watched. */
static int ocean_show(ocean_run *r)
{
    if (!files_is_standard(r->settings->common.output)) return 0;
    return files_write_text(NULL, &r->table);
}

/* One row for each way: seconds, nanoseconds per item, and the ratio to the first way. */
static int ocean_print(ocean_run *r, const ocean_task *task, const rounds_results *results)
{
    const bool tsv = r->settings->format == FORMAT_TSV;
    const double first = rounds_minimum(results, 0, 0) / (task->bytes ? task->bytes[0] : 1);
    for (size_t way = 0; way < task->count; way++) {
        const double seconds = rounds_minimum(results, way, 0),
                     bytes = task->bytes ? task->bytes[way] : 1;
        text_printf(&r->table,
                    tsv ? "%s\t%s\t%.4g\t%.4g\t%.4g\n" : "%-8s %-20s %10.4g %10.4g %8.3g\n",
                    task->name, task->ways[way], seconds, 1e9 * seconds / task->pieces,
                    seconds / bytes / first);
    }
    return ocean_show(r);
}

static int ocean_measure(ocean_run *r, const ocean_task *task, rounds_run *run, void *self)
{
    const rounds_plan plan = {
        .entries = task->count, .figures = 1, .warmups = 1, .rounds = ocean_rounds(r)};
    rounds_results results = {0};
    int end = rounds_measure(&plan, run, self, &results);
    if (end == 0) end = ocean_print(r, task, &results);
    rounds_release(&results);
    return end;
}

/* --- open ------------------------------------------------------------------------------------- */

static int ocean_locate_in(const mw_mesh_file *file)
{
    mw_error error;
    mw_mesh *mesh = NULL;
    mw_locator *locator = NULL;
    const mw_arrays arrays = mw_mesh_file_arrays(file);
    mw_status status = mw_mesh_create(&arrays, NULL, &mesh, &error);
    if (!status) status = mw_locator_create(mesh, NULL, &locator, &error);
    mw_locator_destroy(locator);
    mw_mesh_destroy(mesh);
    return status ? fail_query(&error) : 0;
}

static int ocean_open(void *self, size_t way, size_t round, double *figures)
{
    const ocean_run *r = self;
    mw_mesh_file file;
    mw_error error;
    (void)round;
    const double begin = monotonic_seconds();
    int end;
    if (way == 0) {
        end = ocean_locate_in(&r->file);
    } else {
        if (mw_read_mesh(r->path, NULL, &file, &error) != MW_OK) return fail_reading(&error);
        end = ocean_locate_in(&file);
        mw_mesh_file_release(&file);
    }
    figures[0] = monotonic_seconds() - begin;
    return end;
}

/* The arrays of the mesh, as a file has them. */
static bool ocean_fill_file(ocean_run *r, const mw_mesh *mesh)
{
    mw_mesh_file *file = &r->file;
    file->point_count = mw_mesh_vertex_count(mesh);
    file->triangle_count = mw_mesh_triangle_count(mesh);
    file->points = calloc(3 * file->point_count, sizeof *file->points);
    file->triangles = malloc(3 * file->triangle_count * sizeof *file->triangles);
    if (!file->points || !file->triangles) return false;
    for (uint32_t v = 0; v < file->point_count; v++)
        mw_mesh_vertex(mesh, v, file->points + (size_t)3 * v);
    for (uint32_t t = 0; t < file->triangle_count; t++)
        mw_mesh_triangle(mesh, t, file->triangles + (size_t)3 * t);
    return true;
}

static int ocean_write(ocean_run *r)
{
    mw_error error;
    const char *folder = getenv("TMPDIR");
    snprintf(r->path, sizeof r->path, "%.30s/meshwalk_bench_XXXXXX.nc", folder ? folder : "/tmp");
    const int descriptor = mkstemps(r->path, 3);
    if (descriptor < 0) {
        complain("%s: cannot be written", r->path);
        return END_RESOURCE;
    }
    close(descriptor);
    return mw_write_mesh(r->path, &r->file, NULL, NULL, &error) == MW_OK ? 0 : fail_writing(&error);
}

static int ocean_measure_open(ocean_run *r, const mw_mesh *mesh)
{
    static const char *const ways[] = {"arrays", "UGRID"};
    if (mw_netcdf_version(NULL, 0) == 0) {
        complain("bench ocean: libnetcdf is not found here, so no mesh is opened");
        return 0;
    }
    progress_phase("opening", "UGRID");
    int end = ocean_fill_file(r, mesh) ? ocean_write(r) : fail_memory();
    if (end == 0)
        end = ocean_measure(r, &(ocean_task){"open", ways, 2, (double)r->file.triangle_count, NULL},
                            ocean_open, r);
    if (*r->path) unlink(r->path);
    free(r->file.points);
    free(r->file.triangles);
    return end;
}

/* --- hints ------------------------------------------------------------------------------------ */

/* Round the middle of the square, a tenth of an edge a step or so. */
static void ocean_drift(ocean_run *r, double step)
{
    for (size_t i = 0; i < PARTICLES; i++) {
        double *p = r->places + 2 * i;
        const double u = 0.5 - p[1], v = p[0] - 0.5;
        p[0] += step * u;
        p[1] += step * v;
    }
}

static int ocean_follow(void *self, size_t way, size_t round, double *figures)
{
    ocean_run *r = self;
    mw_error error;
    mw_location *at = malloc(PARTICLES * sizeof *at);
    const mw_query_options options = {.threads = 1, .hints = way == 1 ? r->hints : NULL};
    (void)round;
    if (!at) return fail_memory();
    figures[0] = 0;
    mw_status status = MW_OK;
    for (int step = 0; step < DRIFTS && !status; step++) {
        ocean_drift(r, 3e-4);
        const double begin = monotonic_seconds();
        status = mw_locate_batch(r->locator, r->places, PARTICLES, 2, &options, at, NULL, &error);
        figures[0] += monotonic_seconds() - begin;
    }
    free(at);
    return status ? fail_query(&error) : 0;
}

static int ocean_measure_hints(ocean_run *r, const mw_mesh *mesh)
{
    static const char *const ways[] = {"no hints", "hints"};
    uint64_t random = r->settings->common.seed + 3;
    mw_error error;
    progress_phase("following", "particles");
    if (mw_locator_create(mesh, NULL, &r->locator, &error) != MW_OK) return fail_query(&error);
    r->places = malloc(2 * PARTICLES * sizeof *r->places);
    r->hints = malloc(PARTICLES * sizeof *r->hints);
    int end = r->places && r->hints ? 0 : fail_memory();
    for (size_t i = 0; i < 2 * PARTICLES && end == 0; i++)
        r->places[i] = 0.2 + 0.6 * dataset_unit(&random);
    for (size_t i = 0; i < PARTICLES && end == 0; i++) r->hints[i] = MW_NONE;
    if (end == 0)
        end = ocean_measure(r, &(ocean_task){"hints", ways, 2, (double)PARTICLES * DRIFTS, NULL},
                            ocean_follow, r);
    mw_locator_destroy(r->locator);
    free(r->places);
    free(r->hints);
    return end;
}

/* --- all -------------------------------------------------------------------------------------- */

static int ocean_measure_apply(ocean_run *r, const mw_mesh *mesh)
{
    ocean_weights w;
    double bytes[OCEAN_WEIGHTS_WAYS];
    progress_phase("applying", "weights");
    int end = ocean_weights_make(&w, mesh, r->settings->common.seed);
    if (end == 0) {
        for (size_t way = 0; way < OCEAN_WEIGHTS_WAYS; way++)
            bytes[way] = ocean_weights_bytes(&w, way);
        end = ocean_measure(r,
                            &(ocean_task){"apply", ocean_weights_ways, OCEAN_WEIGHTS_WAYS,
                                          (double)w.points * OCEAN_STEPS, bytes},
                            ocean_weights_time, &w);
    }
    ocean_weights_release(&w);
    return end;
}

static int ocean_make_mesh(const ocean_run *r, size_t vertices, mw_mesh **out)
{
    dataset set;
    mw_error error;
    *out = NULL;
    if (!dataset_make(&set, DATASET_UNIFORM, vertices, true, r->settings->common.seed))
        return fail_memory();
    const mw_status status = mw_delaunay(set.points, vertices, 2, NULL, NULL, NULL, out, &error);
    dataset_release(&set);
    return status ? fail_query(&error) : 0;
}

static int ocean_measure_size(ocean_run *r, size_t vertices)
{
    mw_mesh *mesh;
    int end = ocean_make_mesh(r, vertices / 2, &mesh); /* with as many faces as vertices are told */
    if (end == 0) end = ocean_measure_open(r, mesh);
    mw_mesh_destroy(mesh);
    if (end) return end;
    end = ocean_make_mesh(r, vertices, &mesh);
    if (end == 0) end = ocean_measure_hints(r, mesh);
    if (end == 0) end = ocean_measure_apply(r, mesh);
    mw_mesh_destroy(mesh);
    return end;
}

static int ocean_check_settings(const bench_settings *s, const char *table)
{
    if (table || s->enclose != ENCLOSE_AUTO || s->no_times || s->data || s->plot || s->engines ||
        s->tasks || s->queries || s->format == FORMAT_JSON) {
        complain("bench ocean makes its own meshes, takes times of meshwalk alone, and prints "
                 "them with --format table or tsv");
        return END_USAGE;
    }
    return options_limit("rounds", s->rounds, 1000, NULL);
}

int bench_ocean(const bench_settings *s, const char *table)
{
    ocean_run r = {.settings = s};
    size_list sizes = {{1000000}, 1};
    int end = ocean_check_settings(s, table);
    if (end == 0 && s->sizes) end = word_list_sizes(s->sizes, &sizes);
    if (end == 0) end = files_try_output(s->common.output, NULL);
    text_string(&r.table, s->format == FORMAT_TSV
                              ? "task\tway\tseconds\tns\tratio\n"
                              : "task     way                     seconds         ns    ratio\n");
    if (end == 0) end = ocean_show(&r);
    for (size_t i = 0; i < sizes.count && end == 0; i++)
        end = ocean_measure_size(&r,
                                 sizes.size[i] < FEWEST_VERTICES ? FEWEST_VERTICES : sizes.size[i]);
    if (end == 0 && !files_is_standard(s->common.output))
        return files_write_text(s->common.output, &r.table);
    text_release(&r.table);
    return end;
}
