#include "cli/input/star_input.h"
#include "cli/frame/message.h"
#include "cli/frame/progress.h"
#include "cli/frame/text.h"
#include "cli/input/lonlat_input.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* The options with which 'check' reads the polyhedron in the same way. */
static const char *star_check_arguments(const star_input_settings *s, char words[128])
{
    const double *c = s->centre->at;
    text t = {0};
    text_string(&t, "--as star");
    if (c[0] != 0 || c[1] != 0 || c[2] != 0) {
        text_string(&t, " --centre ");
        for (int k = 0; k < 3; k++) {
            if (k) text_string(&t, ",");
            text_double(&t, c[k]);
        }
    }
    if (s->lonlat) text_string(&t, " --lonlat");
    snprintf(words, 128, "%.*s", t.failed ? 0 : (int)t.size, t.failed ? "" : t.bytes);
    text_release(&t);
    return words;
}

static int star_input_fail(const star_input_settings *s, const char *path, bool flat,
                           const mw_error *error)
{
    char words[128];
    int end = fail_mesh(path, error);
    if (end == END_INPUT && flat)
        complain("%s: has no z; --lonlat takes x and y as longitude and latitude", path);
    else if (end == END_INPUT && !s->open)
        complain("'meshwalk check %s %s' lists every defect, 'meshwalk view' shows it; star "
                 "and sample take meshes that leave directions open with --open",
                 star_check_arguments(s, words), path);
    return end;
}

int star_input_check_open(bool open, const coordinates *centre)
{
    const double *c = centre->at;
    if (!open || (c[0] == 0 && c[1] == 0 && c[2] == 0)) return 0;
    complain("--open takes rays from 0,0,0; leave out --centre");
    return END_USAGE;
}

static mw_status star_input_prepare(star_input *in, const star_input_settings *s, mw_error *error)
{
    const mw_progress *progress = progress_of_call();
    const mw_star_options star = {.centre = {s->centre->at[0], s->centre->at[1], s->centre->at[2]},
                                  .angles = s->angles,
                                  .threads = s->threads,
                                  .borrow = s->borrow,
                                  .progress = progress};
    const mw_prober_options boxes = {.boxes = 1, .threads = s->threads, .progress = progress};
    return s->open ? mw_prober_create(in->surface, &boxes, &in->prober, error)
                   : mw_star_create(in->surface, &star, &in->star, error);
}

int star_input_make(star_input *in, const char *path, mw_mesh_file *file,
                    const star_input_settings *s)
{
    mw_error error;
    int end = s->lonlat ? lonlat_input_mesh(path, file) : 0;
    if (end) return end;
    const mw_arrays arrays = mw_mesh_file_arrays(file);
    const mw_surface_options surface = {
        .weld = 1, .tolerant = s->open, .progress = progress_of_call()};
    progress_phase("preparing", path);
    if (mw_surface_create(&arrays, &surface, &in->surface, &error) != MW_OK ||
        star_input_prepare(in, s, &error) != MW_OK)
        return star_input_fail(s, path, !file->has_z, &error);
    return 0;
}

/* --- rays from the centre --------------------------------------------------------------------- */

enum { PROBES = 1 << 16 }; /* that are made at a time */

static mw_location location_of_touch(const mw_touch *touch)
{
    mw_location at = {.weight = {touch->weight[0], touch->weight[1], touch->weight[2]},
                      .triangle = touch->triangle,
                      .hole = MW_NONE,
                      .where = touch->where,
                      .local = touch->local};
    if (touch->state == MW_TOUCH_NONE) at.where = MW_OUTSIDE;
    return at;
}

/* Room for the probes of a block, which begin in the origin, and for what they touch. */
typedef struct ray_probes {
    double (*probe)[6];
    mw_touch *touch;
} ray_probes;

static mw_status probes_locate(const ray_probes *r, const star_input *in, const double *points,
                               size_t stride, size_t count, const mw_probe_options *options,
                               mw_location *answers, mw_error *error)
{
    for (size_t i = 0; i < count; i++)
        memcpy(r->probe[i] + 3, points + i * stride, 3 * sizeof *points);
    mw_status status =
        mw_probe_batch(in->prober, r->probe[0], count, 6, options, r->touch, NULL, error);
    for (size_t i = 0; i < count && status == MW_OK; i++)
        answers[i] = location_of_touch(&r->touch[i]);
    return status;
}

static mw_status star_input_probe(const star_input *in, const double *points, size_t stride,
                                  size_t count, const mw_star_query_options *options,
                                  mw_location *answers, mw_error *error)
{
    const mw_probe_options probe = {.certain = 1,
                                    .extent = MW_PROBE_RAY,
                                    .faces = MW_PROBE_BOTH,
                                    .threads = options->threads,
                                    .progress = options->progress};
    const ray_probes r = {calloc(PROBES, sizeof *r.probe), malloc(PROBES * sizeof *r.touch)};
    mw_status status = r.probe && r.touch ? MW_OK : MW_ERROR_MEMORY;
    if (status) *error = (mw_error){.status = status, .message = "out of memory"};
    for (size_t i = 0; i < count && status == MW_OK; i += PROBES)
        status = probes_locate(&r, in, points + i * stride, stride,
                               count - i < PROBES ? count - i : PROBES, &probe, answers + i, error);
    free(r.probe);
    free(r.touch);
    return status;
}

mw_status star_input_locate(const star_input *in, const double *points, size_t stride, size_t count,
                            const mw_star_query_options *options, mw_location *answers,
                            mw_counters *counters, mw_error *error)
{
    return in->prober ? star_input_probe(in, points, stride, count, options, answers, error)
                      : mw_star_locate_batch(in->star, points, count, stride, options, answers,
                                             counters, error);
}

void star_input_release(star_input *s)
{
    mw_star_destroy(s->star);
    mw_prober_destroy(s->prober);
    mw_surface_destroy(s->surface);
}
