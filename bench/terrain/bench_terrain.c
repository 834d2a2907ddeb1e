/* bench terrain: rasters and contours of a made terrain, beside the programs that people use. Each
 * way is a whole command, from file to file, but for `write`.
 *   raster    a GeoTIFF from a TIN in PLY, and from the same TIN in a prepared file; `write` writes
 *             the same pixels from memory; gmt triangulates its points and writes its own format;
 *             gdal_grid triangulates its points, too
 *   contours  lines of about fifty levels: of the TIN, and of a raster of as many pixels as the TIN
 *             has triangles
 * One row for each way; the first way of a task is what its others are compared with. */
#include "bench/terrain/bench_terrain.h"
#include "bench/core/processor_clock.h"
#include "bench/core/rounds.h"
#include "bench/core/word_list.h"
#include "bench/terrain/terrain_files.h"
#include "bench/terrain/timed_command.h"
#include "cli/frame/files.h"
#include "cli/frame/message.h"
#include "cli/frame/monotonic_clock.h"
#include "cli/frame/progress.h"
#include "cli/gdal/gdal_raster.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

enum { ROUNDS = 3, MOST_WAYS = 5, MOST_WORDS = 24, FEWEST_VERTICES = 100 };
enum { LEVELS = 50, PIXELS = 100000000, WORD_LENGTH = 64 };

/* A way to do a task. */
typedef struct terrain_way {
    const char *name;
    const char *package; /* of Debian */
    const char *words[MOST_WORDS];
    const char *output; /* removed before each run */
} terrain_way;

typedef struct terrain_run {
    const bench_settings *settings;
    char folder[256], program[4096];
    size_t side, dem_side;        /* pixels each way */
    char numbers[6][WORD_LENGTH]; /* words that depend on the sizes */
    const terrain_way *ways[MOST_WAYS];
    size_t way_count;
    float *pixels;  /* a block of rows, for `write` */
    uint32_t tasks; /* a set */
    text table;
} terrain_run;

enum { TASK_CONTOURS, TASK_RASTER, TASKS };

static const char *terrain_task_name(int i)
{
    return (const char *[]){"contours", "raster", NULL}[i];
}
static const choices terrain_task_choices = {"task", terrain_task_name, NULL};

/* --- writing from memory ---------------------------------------------------------------------- */

enum { WRITE_ROWS = 256 };

/* The pixels of the raster are written to the same folder, as `meshwalk raster` writes them:
 * floats, not packed, a row to a block. They come from the same rows of memory each time, and GDAL
 * is loaded already. */
static int terrain_write(terrain_run *r, command_time *time)
{
    static const char *const names[] = {"z"};
    char path[512];
    gdal_raster *raster;
    const uint32_t side = (uint32_t)r->side;
    const double size = TERRAIN_SIDE / side;
    const gdal_raster_form form = {.columns = side,
                                   .rows = side,
                                   .bands = 1,
                                   .corner = {0, TERRAIN_SIDE},
                                   .size = {size, size},
                                   .type = RASTER_FLOAT32,
                                   .nodata = NAN,
                                   .names = names};
    snprintf(path, sizeof path, "%s/written.tif", r->folder);
    double begin = monotonic_seconds(), processor = processor_seconds();
    int end = gdal_raster_check(path, NULL);
    if (end) return end;
    end = gdal_raster_create(&raster, path, &form);
    for (uint32_t row = 0; end == 0 && row < side; row += WRITE_ROWS)
        end = gdal_raster_write(raster, 0, row, side - row < WRITE_ROWS ? side - row : WRITE_ROWS,
                                r->pixels);
    int closed = gdal_raster_close(raster, end == 0);
    *time = (command_time){monotonic_seconds() - begin, processor_seconds() - processor};
    return end ? end : closed;
}

/* --- ways ------------------------------------------------------------------------------------- */

static const char *terrain_word(terrain_run *r, const char *word)
{
    return strcmp(word, "meshwalk") == 0 ? r->program
           : word[0] == '%'              ? r->numbers[word[1] - '0']
                                         : word;
}

/* Figures: seconds by the clock, and of the processor. */
static int terrain_time(void *self, size_t way, size_t round, double *figures)
{
    terrain_run *r = self;
    const terrain_way *w = r->ways[way];
    const char *words[MOST_WORDS] = {0};
    char path[512];
    command_time time;
    (void)round;
    snprintf(path, sizeof path, "%s/%s", r->folder, w->output);
    unlink(path);
    for (size_t i = 0; w->words[i]; i++) words[i] = terrain_word(r, w->words[i]);
    int end = words[0] ? command_run(r->folder, words, &time) : terrain_write(r, &time);
    figures[0] = time.seconds;
    figures[1] = time.processor;
    return end;
}

static bool terrain_has(const terrain_way *way)
{
    return !way->words[0] || strcmp(way->words[0], "meshwalk") == 0 ||
           command_is_there(way->words[0]);
}

static void terrain_print(terrain_run *r, const char *task, const rounds_results *results)
{
    const bool tsv = r->settings->format == FORMAT_TSV;
    for (size_t way = 0; way < r->way_count; way++) {
        const double seconds = rounds_minimum(results, way, 0),
                     processor = rounds_minimum(results, way, 1);
        text_printf(
            &r->table,
            tsv ? "%s\t%s\t%.4g\t%.4g\t%.4g\t%.4g\n" : "%-9s %-20s %9.4g %9.4g %8.3g %10.3g\n",
            task, r->ways[way]->name, seconds, processor, seconds / rounds_minimum(results, 0, 0),
            processor / rounds_minimum(results, 0, 1));
    }
}

static int terrain_measure(terrain_run *r, const char *task, const terrain_way *ways, size_t count)
{
    const size_t rounds = r->settings->rounds ? r->settings->rounds : ROUNDS;
    rounds_results results = {0};
    r->way_count = 0;
    for (size_t i = 0; i < count; i++) {
        if (terrain_has(&ways[i]))
            r->ways[r->way_count++] = &ways[i];
        else
            complain("bench terrain: %s is not installed here (on Debian: apt-get install %s)",
                     ways[i].words[0], ways[i].package);
    }
    const rounds_plan plan = {.entries = r->way_count, .figures = 2, .rounds = rounds};
    progress_phase("measuring", task);
    int end = rounds_measure(&plan, terrain_time, r, &results);
    if (end == 0) terrain_print(r, task, &results);
    rounds_release(&results);
    return end;
}

/* --- tasks ------------------------------------------------------------------------------------ */

/* %0: size of a pixel; %1: the extent, %2: for GMT; %3: pixels each way, %5: for GMT; %4: the
 * interval of contours. */
static const terrain_way raster_ways[] = {
    {"meshwalk raster",
     NULL,
     {"meshwalk", "raster", "-q", "tin.ply", "--resolution", "%0", "--extent", "%1", "-o",
      "meshwalk.tif"},
     "meshwalk.tif"},
    {"meshwalk prepared",
     NULL,
     {"meshwalk", "raster", "-q", "tin.mwm", "--resolution", "%0", "--extent", "%1", "-o",
      "prepared.tif"},
     "prepared.tif"},
    {"write", NULL, {NULL}, "written.tif"},
    {"gmt triangulate -G",
     "gmt",
     {"gmt", "triangulate", "points.bin", "-bi3d", "%2", "%5", "-r", "-Ggmt.nc"},
     "gmt.nc"},
    {"gdal_grid -a linear",
     "gdal-bin",
     {"gdal_grid", "-q", "-a", "linear:radius=0", "-ot", "Float32", "-txe", "0", "1000", "-tye",
      "1000", "0", "-outsize", "%3", "%3", "-l", "points", "points.vrt", "grid.tif"},
     "grid.tif"},
};

static const terrain_way contour_ways[] = {
    {"meshwalk contours",
     NULL,
     {"meshwalk", "contours", "-q", "tin.ply", "--interval", "%4", "-o", "meshwalk.shp"},
     "meshwalk.shp"},
    {"gdal_contour",
     "gdal-bin",
     {"gdal_contour", "-q", "-a", "elevation", "-i", "%4", "dem.img", "gdal.shp"},
     "gdal.shp"},
};

static void terrain_set_numbers(terrain_run *r)
{
    double size = TERRAIN_SIDE / (double)r->side, low = INFINITY, high = -INFINITY;
    for (int i = 0; i < 100; i++)
        for (int k = 0; k < 100; k++) {
            double z = terrain_height(i * TERRAIN_SIDE / 100, k * TERRAIN_SIDE / 100);
            low = fmin(low, z);
            high = fmax(high, z);
        }
    snprintf(r->numbers[0], WORD_LENGTH, "%.17g", size);
    snprintf(r->numbers[1], WORD_LENGTH, "0,0,%g,%g", TERRAIN_SIDE, TERRAIN_SIDE);
    snprintf(r->numbers[2], WORD_LENGTH, "-R0/%g/0/%g", TERRAIN_SIDE, TERRAIN_SIDE);
    snprintf(r->numbers[3], WORD_LENGTH, "%zu", r->side);
    snprintf(r->numbers[4], WORD_LENGTH, "%g", ceil((high - low) / LEVELS));
    snprintf(r->numbers[5], WORD_LENGTH, "-I%zu+n/%zu+n", r->side, r->side);
}

static int terrain_run_tasks(terrain_run *r, size_t vertices)
{
    size_t triangles = 0;
    progress_phase("making", "terrain");
    int end = terrain_write_tin(r->folder, vertices, r->settings->common.seed, &triangles);
    r->dem_side = (size_t)ceil(sqrt((double)triangles));
    if (end == 0) end = terrain_write_raster(r->folder, r->dem_side);
    r->pixels = calloc(r->side * WRITE_ROWS, sizeof *r->pixels);
    if (end == 0 && !r->pixels) end = fail_memory();
    for (size_t i = 0; end == 0 && i < r->side * WRITE_ROWS; i++)
        r->pixels[i] = (float)terrain_height((double)(i % r->side), (double)(i / r->side));
    terrain_set_numbers(r);
    if (end == 0 && r->tasks >> TASK_CONTOURS & 1)
        end = terrain_measure(r, "contours", contour_ways,
                              sizeof contour_ways / sizeof *contour_ways);
    if (end == 0 && r->tasks >> TASK_RASTER & 1)
        end = terrain_measure(r, "raster", raster_ways, sizeof raster_ways / sizeof *raster_ways);
    free(r->pixels);
    return end;
}

static int terrain_check_settings(const bench_settings *s, const char *table)
{
    if (table || s->enclose != ENCLOSE_AUTO || s->no_times || s->data || s->plot || s->engines ||
        s->format == FORMAT_JSON) {
        complain("bench terrain makes its own terrain, runs all programs that are there, and "
                 "prints times with --format table or tsv");
        return END_USAGE;
    }
    return options_limit("rounds", s->rounds, 1000, NULL);
}

int bench_terrain(const bench_settings *s, const char *table)
{
    terrain_run r = {.settings = s, .tasks = (UINT32_C(1) << TASKS) - 1};
    size_list sizes = {{1000000}, 1};
    int end = terrain_check_settings(s, table);
    if (end == 0 && s->tasks) end = word_list_names(s->tasks, &terrain_task_choices, &r.tasks);
    if (end == 0 && s->sizes) end = word_list_sizes(s->sizes, &sizes);
    if (end == 0) end = files_try_output(s->common.output, NULL);
    if (end == 0) end = gdal_raster_check("bench.tif", NULL);
    if (end) return end;
    r.side = (size_t)ceil(sqrt(s->queries ? s->queries : PIXELS));
    ssize_t length = readlink("/proc/self/exe", r.program, sizeof r.program - 1);
    if (length < 0) strcpy(r.program, "meshwalk");
    text_string(&r.table,
                s->format == FORMAT_TSV
                    ? "task\tway\tseconds\tprocessor\tratio\tratio_processor\n"
                    : "task      way                    seconds processor    ratio  processor\n");
    for (size_t i = 0; i < sizes.count && end == 0; i++) {
        size_t vertices = sizes.size[i] < FEWEST_VERTICES ? FEWEST_VERTICES : sizes.size[i];
        end = terrain_folder_make(r.folder, sizeof r.folder);
        if (end == 0) end = terrain_run_tasks(&r, vertices);
        terrain_folder_remove(r.folder);
    }
    if (end == 0) return files_write_text(s->common.output, &r.table);
    text_release(&r.table);
    return end;
}
