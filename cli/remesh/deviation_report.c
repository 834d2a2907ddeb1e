#include "cli/remesh/deviation_report.h"
#include "cli/frame/files.h"
#include "cli/frame/message.h"
#include "cli/frame/progress.h"
#include "cli/frame/report.h"

#include <math.h>
#include <stdio.h>

static int deviation_measure(const mw_surface *from, const mw_surface *to, uint32_t threads,
                             mw_deviation *out)
{
    mw_error error;
    mw_prober *prober;
    const mw_prober_options boxes = {
        .boxes = 1, .threads = threads, .progress = progress_of_call()};
    const mw_remesh_options options = {.threads = threads, .progress = progress_of_call()};
    progress_phase("measuring", NULL);
    if (mw_prober_create(to, &boxes, &prober, &error) != MW_OK) return fail_query(&error);
    const mw_status status = mw_surface_deviation(from, prober, &options, out, &error);
    mw_prober_destroy(prober);
    return status == MW_OK ? 0 : fail_query(&error);
}

static void deviation_report_one(report *r, const char *of, const mw_deviation *d)
{
    char name[64];
    const struct {
        const char *what;
        double value;
    } numbers[] = {{"largest", d->largest}, {"mean", d->mean}, {"at_most", d->at_most}};
    for (int i = 0; i < 3; i++) {
        snprintf(name, sizeof name, "%s_%s", of, numbers[i].what);
        report_number(r, name, numbers[i].value);
    }
    snprintf(name, sizeof name, "%s_place", of);
    report_numbers(r, name, d->point, 3);
    snprintf(name, sizeof name, "%s_samples", of);
    report_count(r, name, d->samples);
}

int deviation_report_print(const mw_surface *given, const mw_surface *made,
                           const common_settings *common, bool json)
{
    report r;
    mw_deviation there, back;
    int end = deviation_measure(made, given, common->threads, &there);
    if (end == 0) end = deviation_measure(given, made, common->threads, &back);
    if (end) return end;
    report_begin(&r, json);
    report_count(&r, "vertices", mw_surface_vertex_count(made));
    report_count(&r, "triangles", mw_surface_triangle_count(made));
    deviation_report_one(&r, "out", &there);
    deviation_report_one(&r, "polyhedron", &back);
    report_number(&r, "hausdorff_at_least", fmax(there.largest, back.largest));
    report_number(&r, "hausdorff_at_most", fmax(there.at_most, back.at_most));
    report_end(&r);
    return files_write_error_text(&r.text);
}
