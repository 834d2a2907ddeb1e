/* Values over time of ADCIRC as text: fort.63 (water levels), fort.64 (velocities), fort.73 and
 * fort.74 (pressure and wind), and the largest of them, maxele.63 and others. The file begins with
 * a line that describes the run, and a line of five numbers: the first is the number of times, the
 * second that of vertices, the fifth that of values at each vertex. For each time there is a line
 * "time step", then a line "vertex value (value)" for each vertex. If only some vertices follow,
 * the line of the time has two more numbers: how many follow, and the value of all others. -99999
 * means that there is no value. Fields have the names that ADCIRC gives them in netCDF. */
#include "io/series/step_series.h"
#include "io/text/counted_rows.h"

#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define ADCIRC_MISSING (-99999.0)
/* More vertices are not believed: a file may announce them and list few. */
#define ADCIRC_MOST ((int64_t)1 << 28)

typedef struct adcirc_file {
    mw_source *source;
    int64_t vertices, width;
    bool largest; /* of maxele.63 and others: what follows the first values is when they were */
    bool done;
} adcirc_file;

/* The end of the name, which has something in front of it ("m"), and the names of one value or
 * of two. */
static const struct {
    const char *ending, *names[2];
} adcirc_names[] = {{"axele.63", {"zeta_max", "zeta_max"}},
                    {"axvel.63", {"vel_max", "vel_max"}},
                    {"axwvel.63", {"wind_max", "wind_max"}},
                    {"inpr.63", {"pressure_min", ""}},
                    {".63", {"zeta", "zeta"}},
                    {".64", {"u-vel", "v-vel"}},
                    {".73", {"pressure", "pressure"}},
                    {".74", {"windx", "windy"}}};
enum { ADCIRC_NAME_COUNT = sizeof adcirc_names / sizeof *adcirc_names, ADCIRC_LARGEST = 4 };

static size_t adcirc_find_name(const char *path)
{
    size_t i = 0;
    while (i < ADCIRC_NAME_COUNT && !mw__path_ends(path, adcirc_names[i].ending)) i++;
    return i;
}

static mw_status adcirc_line(const adcirc_file *a, mw_number_row *row, bool *ended, mw_error *error)
{
    char *line;
    do {
        mw_status status = mw__source_line(a->source, &line, error);
        *ended = !line;
        if (status || !line) return status;
        *row = (mw_number_row){a->source, line};
    } while (mw__row_ends(row));
    return MW_OK;
}

static mw_status adcirc_add_to_part(const adcirc_file *a, size_t name, mw_series_part *part,
                                    mw_error *error)
{
    mw_status status = MW_OK;
    for (int64_t k = 0; !status && k < a->width; k++) {
        char numbered[64];
        snprintf(numbered, sizeof numbered, "%s", adcirc_names[name].names[k < 2 ? k : 1]);
        if (k > 0 && strcmp(adcirc_names[name].names[0], adcirc_names[name].names[1]) == 0)
            snprintf(numbered, sizeof numbered, "%s:%" PRId64, adcirc_names[name].names[0], k);
        status = mw__series_part_add(part,
                                     (mw_series_field){.name = numbered,
                                                       .location = MW_SERIES_VERTEX,
                                                       .value_count = (size_t)a->vertices},
                                     error);
    }
    part->time_unit = strdup("seconds");
    return !status && !part->time_unit ? mw__fail_memory(error) : status;
}

static mw_status adcirc_start(void *state, mw_source *source, const mw_series_options *options,
                              mw_series_part *part, mw_error *error)
{
    adcirc_file *a = state;
    char *line;
    bool ended;
    mw_number_row row;
    int64_t ignored;
    double step;
    size_t name = adcirc_find_name(source->path);
    *a = (adcirc_file){.source = source, .largest = name < ADCIRC_LARGEST};
    mw_status status = mw__source_line(source, &line, error);
    if (!status) status = adcirc_line(a, &row, &ended, error);
    if (!status && ended) status = mw__source_fail(source, error, "the file ends in its header");
    if (!status) status = mw__row_integer(&row, "number of times", &ignored, error);
    if (!status) status = mw__row_integer(&row, "number of vertices", &a->vertices, error);
    if (!status) status = mw__row_double(&row, "time between outputs", &step, error);
    if (!status)
        status = mw__row_integer(&row, "number of time steps between outputs", &ignored, error);
    if (!status) status = mw__row_integer(&row, "count of values", &a->width, error);
    if (!status && (a->vertices < 1 || a->width < 1 || a->width > 2))
        status = mw__source_fail(source, error,
                                 "the file announces %" PRId64 " values at each of %" PRId64
                                 " vertices; 1 or 2 values are possible",
                                 a->width, a->vertices);
    if (!status && a->vertices > ADCIRC_MOST)
        status = mw__source_fail(source, error,
                                 "the file announces %" PRId64 " vertices, which is too many",
                                 a->vertices);
    if (!status)
        status = mw__step_series_check(source, (size_t)a->vertices, options->vertex_count,
                                       "vertices", error);
    return !status && part ? adcirc_add_to_part(a, name, part, error) : status;
}

static mw_status adcirc_read_vertex(const adcirc_file *a, int64_t at, int64_t count, double *values,
                                    mw_error *error)
{
    mw_number_row row;
    bool ended;
    int64_t vertex;
    mw_status status = adcirc_line(a, &row, &ended, error);
    if (!status && ended) status = mw__rows_end_early(a->source, "vertices", at, count, error);
    if (!status && !values) return MW_OK;
    if (!status) status = mw__row_integer(&row, "number of the vertex", &vertex, error);
    if (!status && (vertex < 1 || vertex > a->vertices))
        status = mw__source_fail(a->source, error, "vertex %" PRId64 " does not exist", vertex);
    for (int64_t k = 0; !status && k < a->width; k++) {
        double value;
        status = mw__row_double(&row, "value", &value, error);
        if (!status) values[k * a->vertices + vertex - 1] = value == ADCIRC_MISSING ? NAN : value;
    }
    return status;
}

static mw_status adcirc_step(void *state, double *time, bool *ended, double *values,
                             mw_error *error)
{
    adcirc_file *a = state;
    mw_number_row row;
    int64_t number, count = a->vertices;
    double other = NAN;
    *ended = a->done;
    if (a->done) return MW_OK;
    mw_status status = adcirc_line(a, &row, ended, error);
    if (status || *ended) return status;
    status = mw__row_double(&row, "time", time, error);
    if (!status) status = mw__row_integer(&row, "number of the step", &number, error);
    if (!status && !mw__row_ends(&row)) {
        status = mw__row_integer(&row, "count of vertices", &count, error);
        if (!status) status = mw__row_double(&row, "value of the other vertices", &other, error);
        if (!status && (count < 0 || count > a->vertices))
            status = mw__source_fail(a->source, error,
                                     "the step announces values at %" PRId64
                                     " vertices; the mesh has %" PRId64,
                                     count, a->vertices);
    }
    if (other == ADCIRC_MISSING) other = NAN;
    for (int64_t i = 0; !status && values && i < a->vertices * a->width; i++) values[i] = other;
    for (int64_t i = 0; !status && i < count; i++)
        status = adcirc_read_vertex(a, i, count, values, error);
    a->done = a->largest;
    return status;
}

static void adcirc_stop(void *state)
{
    (void)state;
}

static const mw_step_format adcirc_format = {sizeof(adcirc_file), adcirc_start, adcirc_step,
                                             adcirc_stop};

static bool adcirc_series_is(const char *path, const char *head, size_t size)
{
    (void)head;
    (void)size;
    return adcirc_find_name(path) < ADCIRC_NAME_COUNT;
}

static mw_status adcirc_series_open(mw_source *source, const mw_series_options *options,
                                    mw_series_part *part, mw_error *error)
{
    return mw__step_series_open(&adcirc_format, source, options, part, error);
}

const mw_series_kind mw__adcirc_series = {adcirc_series_is, adcirc_series_open,
                                          mw__step_series_read, mw__step_series_close};
