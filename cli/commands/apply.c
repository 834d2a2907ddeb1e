/* apply - interpolates the fields of a netCDF file by a file of weights. */
#include "cli/commands/commands.h"
#include "cli/frame/files.h"
#include "cli/frame/message.h"
#include "cli/frame/progress.h"
#include "cli/frame/report.h"

#include <stdlib.h>
#include <string.h>

enum { MISSING_SPREADS = 0, MISSING_LEFT_OUT };

typedef struct apply_settings {
    common_settings common;
    const char *field;
    int missing;
    bool strict, stats, json;
} apply_settings;

static const char *apply_missing_name(int i)
{
    return (const char *[]){"empty", "leave-out", NULL}[i];
}
static const char *apply_missing_help(int i)
{
    return (const char *[]){"no value", "the mean of the other corners, by their weights"}[i];
}
static const choices apply_missing_choices = {"way of --missing", apply_missing_name,
                                              apply_missing_help};

static const option apply_options[] = {
    {"field", 0, OPTION_TEXT, offsetof(apply_settings, field), "LIST",
     "names of the fields, separated by commas (default: all with a value for each vertex)", NULL},
    {"missing", 0, OPTION_CHOICE, offsetof(apply_settings, missing), "NAME",
     "the value of a point if a vertex that it needs has none (default: empty):",
     &apply_missing_choices},
    {"strict", 0, OPTION_FLAG, offsetof(apply_settings, strict), NULL,
     "exit with 1 if a point has no weights", NULL},
    {"stats", 0, OPTION_FLAG, offsetof(apply_settings, stats), NULL,
     "print counts on standard error when done", NULL},
    {"json", 0, OPTION_FLAG, offsetof(apply_settings, json), NULL, "with --stats: as JSON", NULL},
    {0},
};

/* Split a list of names in place. Returns how many there are; the caller frees their array. */
static size_t apply_cut_names(char *list, const char ***names)
{
    size_t count = 1;
    for (const char *c = list; *c; c++) count += *c == ',';
    *names = malloc(count * sizeof **names);
    if (!*names) return 0;
    for (size_t i = 0; i < count; i++) {
        (*names)[i] = list;
        list += strcspn(list, ",");
        if (*list) *list++ = 0;
    }
    return count;
}

static int apply_report(const apply_settings *s, const mw_apply_weights_info *info)
{
    report r;
    report_begin(&r, s->json);
    report_count(&r, "points", info->points);
    report_count(&r, "without_weights", info->unmapped);
    report_count(&r, "fields", info->fields);
    report_count(&r, "rows", info->slabs);
    report_end(&r);
    return files_write_error_text(&r.text);
}

/* Report an error of an input file or of the output. */
static int apply_fail(const mw_error *error, const char *output)
{
    const size_t length = strlen(output);
    const bool ours = strncmp(error->message, output, length) == 0 && error->message[length] == ':';
    return ours ? fail_writing(error) : fail_reading(error);
}

static int apply_run_with(const apply_settings *s, const char *const *operands,
                          const char *const *names, size_t count)
{
    mw_error error;
    mw_apply_weights_info info;
    const mw_apply_weights_options options = {
        .fields = names,
        .field_count = count,
        .missing = s->missing == MISSING_LEFT_OUT ? MW_MISSING_LEFT_OUT : MW_MISSING_SPREADS,
        .threads = s->common.threads,
        .progress = progress_of_call()};
    progress_phase("applying", operands[1]);
    if (mw_apply_weights(operands[0], operands[1], s->common.output, &options, &info, &error) !=
        MW_OK)
        return apply_fail(&error, s->common.output);
    if (info.unmapped && !s->common.quiet && !s->strict)
        complain("%s: remark: %u of %u points have no weights; their values are missing",
                 operands[0], info.unmapped, info.points);
    int end = s->stats ? apply_report(s, &info) : 0;
    return end == 0 && s->strict && info.unmapped ? END_UNANSWERED : end;
}

static int apply_run(const void *settings, const char *const *operands)
{
    const apply_settings *s = settings;
    if (files_is_standard(s->common.output)) {
        complain("apply needs an output: -o FILE.nc");
        return END_USAGE;
    }
    int end = files_check_output(s->common.output, operands, 2);
    if (end || !s->field) return end ? end : apply_run_with(s, operands, NULL, 0);
    char *list = strdup(s->field);
    const char **names = NULL;
    const size_t count = list ? apply_cut_names(list, &names) : 0;
    end = count ? apply_run_with(s, operands, names, count) : fail_memory();
    free(names);
    free(list);
    return end;
}

static const option *const tables[] = {apply_options, common_options, NULL};

const command apply_command = {
    .name = "apply",
    .operands = "WEIGHTS FIELDS",
    .operand_count = 2,
    .summary = "interpolate the fields of a netCDF file by weights",
    .description =
        "Interpolates the fields of the netCDF file FIELDS at the points for which WEIGHTS was "
        "made, by meshwalk weights or by ESMF, and writes them to a netCDF file: all time steps "
        "and layers, a few at a time. A point without weights has no value.",
    .options = tables,
    .essential = "field missing strict stats output",
    .settings_size = sizeof(apply_settings),
    .run = apply_run,
};
