/* check - every defect of a mesh, and where it is; of a mesh in the plane, a surface or a
 * star-shaped polyhedron. With --fix also a mesh in which they are mended. */
#include "cli/commands/commands.h"
#include "cli/frame/files.h"
#include "cli/frame/message.h"
#include "cli/frame/progress.h"
#include "cli/frame/report.h"
#include "cli/input/mesh_space.h"
#include "cli/output/mended_mesh.h"
#include "cli/output/mesh_output.h"
#include "cli/output/side_outputs.h"

#include <inttypes.h>
#include <stdio.h>

typedef struct check_settings {
    mesh_space_settings mesh;
    const char *fix, *numbers;
    double tolerance;
    int format;
} check_settings;

static const option check_options[] = {
    {"fix", 0, OPTION_TEXT, offsetof(check_settings, fix), "LIST",
     "mend these, write the mesh to -o OUT, and report each change and each defect that remains:",
     &mend_repairs},
    {"tolerance", 0, OPTION_LENGTH, offsetof(check_settings, tolerance), "D",
     "--fix: weld vertices that are at most D apart, and split border edges at vertices at most D "
     "off (default: 0, "
     "exact)",
     NULL},
    {"numbers", 0, OPTION_TEXT, offsetof(check_settings, numbers), "FILE",
     "--fix: write to FILE the old and the new number of each vertex and triangle", NULL},
    {"format", 0, OPTION_CHOICE, offsetof(check_settings, format), "NAME",
     "--fix: format of OUT (default: auto, by its ending):", &mesh_formats},
    {"json", 0, OPTION_FLAG, offsetof(check_settings, mesh.json), NULL, "print the defects as JSON",
     NULL},
    {"output", 'o', OPTION_TEXT, offsetof(check_settings, mesh.common.output), "FILE",
     "write to FILE; with --fix the mended mesh (default: standard output)", NULL},
    {"quiet", 'q', OPTION_FLAG, offsetof(check_settings, mesh.common.quiet), NULL,
     "no progress on standard error; with --fix do not list the changes", NULL},
    {0},
};

/* Names for scripts: they stay when the texts change. */
static const char *const kind_names[MW_DEFECT_COUNT] = {
    [MW_DEFECT_MISSING_VERTEX] = "index",
    [MW_DEFECT_NOT_FINITE] = "not-finite",
    [MW_DEFECT_REPEATED_VERTEX] = "repeated-vertex",
    [MW_DEFECT_NON_MANIFOLD_EDGE] = "edge-shared",
    [MW_DEFECT_FOLDED] = "folded",
    [MW_DEFECT_WINDING] = "turn",
    [MW_DEFECT_CROSSING] = "crossing",
    [MW_DEFECT_VERTEX_IN_EDGE] = "vertex-in-edge",
    [MW_DEFECT_OVERLAP] = "overlap",
    [MW_DEFECT_FLAT] = "flat",
    [MW_DEFECT_CLASHING] = "clashing",
    [MW_DEFECT_OPEN_EDGE] = "open-edge",
    [MW_DEFECT_THROUGH_CENTRE] = "through-centre",
    [MW_DEFECT_BACK_FACING] = "turned",
    [MW_DEFECT_COVERED] = "covered",
};

static void check_json_number(text *t, const char *name, uint32_t value, uint32_t none)
{
    if (value != none) text_printf(t, ", \"%s\": %" PRIu32, name, value);
}

static void check_json_defect(text *t, const mw_defect *d)
{
    char words[256];
    mw_defect_describe(d, words, sizeof words);
    text_printf(t, "  {\"kind\": \"%s\"", kind_names[d->kind]);
    check_json_number(t, "triangle", d->triangle, MW_NONE);
    check_json_number(t, "edge", d->edge, 255);
    check_json_number(t, "other", d->other, MW_NONE);
    check_json_number(t, "other_edge", d->other_edge, 255);
    check_json_number(t, "vertex", d->vertex, MW_NONE);
    text_string(t, ", \"text\": ");
    report_quote(t, words);
    text_string(t, "}");
}

/* The words of the verdict for each way to take a mesh. */
static const struct verdict_words {
    const char *key; /* in JSON */
    const char *good, *bad, *empty;
} verdicts[] = {
    [SPACE_PLANE] = {"embedding", "an embedding", "no embedding", "nothing to locate in"},
    [SPACE_SURFACE] = {"surface", "a sound surface", "no sound surface", "nothing to touch"},
    [SPACE_STAR] = {"star_shaped", "star-shaped about the centre",
                    "not star-shaped about the centre", "nothing to meet"},
};

/* The result of a check. */
typedef struct check_outcome {
    const struct verdict_words *verdict;
    char words[128];
    bool sound; /* the mesh is what it is taken as                                  */
    bool good;  /* it also has a triangle with an area: every promise holds */
} check_outcome;

static check_outcome check_outcome_of(const mesh_space_settings *s, const mw_check *check,
                                      const mw_mesh_file *file)
{
    size_t flat = 0;
    for (size_t i = 0; i < check->defect_count; i++)
        flat += check->defects[i].kind == MW_DEFECT_FLAT;
    bool area = s->space == SPACE_PLANE ? files_has_area(file) : flat < file->triangle_count;
    check_outcome o = {&verdicts[s->space], .sound = check->valid, .good = check->valid && area};
    size_t defects = check->defect_count - flat;
    char remark[48] = "";
    if (flat) snprintf(remark, sizeof remark, "; %zu flat triangle%s", flat, flat == 1 ? "" : "s");
    if (!o.sound)
        snprintf(o.words, sizeof o.words, "%s: %zu defect%s%s", o.verdict->bad, defects,
                 defects == 1 ? "" : "s", remark);
    else if (!o.good)
        snprintf(o.words, sizeof o.words, "no triangle with an area: %s%s", o.verdict->empty,
                 remark);
    else
        snprintf(o.words, sizeof o.words, "%s: every promise holds%s", o.verdict->good, remark);
    return o;
}

/* The members of a JSON object after the first one. */
static void check_as_json(text *t, const mw_check *check, const check_outcome *o)
{
    text_printf(t, ",\n \"%s\": %s,\n \"verdict\": ", o->verdict->key, o->sound ? "true" : "false");
    report_quote(t, o->words);
    text_string(t, ",\n \"defects\": [");
    for (size_t i = 0; i < check->defect_count; i++) {
        text_string(t, i ? ",\n" : "\n");
        check_json_defect(t, &check->defects[i]);
    }
    text_string(t, check->defect_count ? "\n ]\n}\n" : "]\n}\n");
}

static void check_json_begin(text *t, const char *path)
{
    text_string(t, "{\n \"file\": ");
    report_quote(t, path);
}

/* Print a line for each defect, each after `prefix`. */
static void check_as_text(text *t, const char *path, const char *prefix, const mw_check *check,
                          const check_outcome *o)
{
    for (size_t i = 0; i < check->defect_count; i++) {
        char words[256];
        mw_defect_describe(&check->defects[i], words, sizeof words);
        text_printf(t, "%s%s\n", prefix, words);
    }
    text_printf(t, "%s: %s\n", path, o->words);
}

static mw_status check_arrays(const mesh_space_settings *s, const mw_arrays *arrays,
                              mw_check *check, mw_error *error)
{
    mw_star_options star = {.centre = {s->centre.at[0], s->centre.at[1], s->centre.at[2]},
                            .threads = s->common.threads,
                            .progress = progress_of_call()};
    mw_check_options options = {.threads = s->common.threads, .progress = progress_of_call()};
    int weld = mesh_space_is_welded(s);
    if (s->space == SPACE_SURFACE)
        return mw_surface_check_arrays(arrays, weld, &options, check, error);
    if (s->space == SPACE_STAR) return mw_star_check_arrays(arrays, weld, &star, check, error);
    return mw_check_arrays(arrays, &options, check, error);
}

static int check_mesh_file(const mesh_space_settings *s, const char *path, const mw_mesh_file *file)
{
    mw_error error;
    mw_check check;
    text t = {0};
    mw_arrays arrays = mw_mesh_file_arrays(file);
    progress_phase("checking", path);
    if (check_arrays(s, &arrays, &check, &error) != MW_OK) return fail_mesh(path, &error);
    check_outcome o = check_outcome_of(s, &check, file);
    if (s->json) {
        check_json_begin(&t, path);
        check_as_json(&t, &check, &o);
    } else {
        check_as_text(&t, path, "", &check, &o);
    }
    int end = files_write_text(s->common.output, &t);
    if (end == 0 && !o.good) end = END_INPUT;
    mw_check_release(&check);
    return end;
}

/* --- mending --- */

static int check_refuse(const char *why)
{
    complain("check: %s", why);
    return END_USAGE;
}

static int check_fix_settings(const check_settings *s, const char *const *operands,
                              side_output *numbers)
{
    const char *output = s->mesh.common.output;
    if (!s->fix && (s->numbers || s->tolerance > 0 || s->format))
        return check_refuse("--numbers, --tolerance and --format need --fix");
    if (!s->fix) return 0;
    if (s->mesh.lonlat) return check_refuse("--fix cannot mend a mesh with --lonlat");
    int end = mesh_output_check("check", output, s->format);
    if (end == 0) end = files_check_output(output, operands, 1);
    return end ? end : side_outputs_check(numbers, 1, output, operands, 1);
}

/* Print the changes, in the numbers of the file, and the remaining defects of the mended mesh. */
static void check_fix_tell(const check_settings *s, const char *path, const mended_mesh *m,
                           const mw_mesh_file *file, const mw_check *check, const check_outcome *o,
                           text *t)
{
    const char *output = s->mesh.common.output;
    char prefix[512];
    if (s->mesh.json) {
        check_json_begin(t, path);
        text_string(t, ",\n \"output\": ");
        report_quote(t, output);
        text_string(t, ",\n ");
        mended_mesh_tell_json(m, file, t);
        check_as_json(t, check, o);
        return;
    }
    snprintf(prefix, sizeof prefix, "%s: ", output);
    if (!s->mesh.common.quiet) mended_mesh_tell(m, file, t);
    mended_mesh_sum_up(m, path, t);
    check_as_text(t, output, prefix, check, o);
}

/* Check the mended mesh, write it, then print the report. One of the two files may be standard
 * output.
 */
static int check_fix_write(const check_settings *s, const char *path, const mended_mesh *m,
                           const mw_mesh_file *file, bool temporary)
{
    mw_error error;
    mw_check check;
    text t = {0};
    const char *output = s->mesh.common.output;
    mw_arrays arrays = mw_mesh_file_arrays(file);
    progress_phase("checking", output);
    if (check_arrays(&s->mesh, &arrays, &check, &error) != MW_OK) return fail_mesh(output, &error);
    check_outcome o = check_outcome_of(&s->mesh, &check, file);
    if (!s->mesh.common.quiet) mesh_output_warn(output, s->format, file);
    int end = mesh_output_write(output, s->format, file, temporary, s->mesh.common.quiet);
    check_fix_tell(s, path, m, file, &check, &o, &t);
    mw_check_release(&check);
    bool taken = files_is_standard(output) || (s->numbers && files_is_standard(s->numbers));
    if (end) text_release(&t);
    if (end) return end;
    end = taken ? files_write_error_text(&t) : files_write_text(NULL, &t);
    return end || o.good ? end : END_UNANSWERED;
}

static int check_fix_file(const check_settings *s, const char *path, mw_mesh_file *file,
                          side_output *numbers)
{
    mended_mesh m = {0};
    bool temporary;
    mw_mend_options options = {.space = s->mesh.space != SPACE_PLANE,
                               .tolerance = s->tolerance,
                               .progress = progress_of_call()};
    int end = mended_mesh_parse(s->fix, &options.repairs);
    if (end == 0) end = files_try_output(s->mesh.common.output, &temporary);
    if (end == 0) end = side_outputs_open(numbers, 1);
    if (end == 0) end = mended_mesh_create(&m, path, file, &options);
    if (end == 0 && s->numbers) mended_mesh_write_numbers(&m, numbers->out);
    if (end == 0) end = check_fix_write(s, path, &m, file, temporary);
    int closed = side_outputs_close(numbers, 1, end <= END_UNANSWERED);
    mended_mesh_release(&m);
    return end > END_UNANSWERED || closed == 0 ? end : closed;
}

static int check_run(const void *settings, const char *const *operands)
{
    const check_settings *s = settings;
    mw_mesh_file file = {0};
    uint32_t repairs;
    side_output numbers = {"numbers", s->numbers, NULL};
    int end = s->fix ? mended_mesh_parse(s->fix, &repairs) : 0;
    if (end == 0) end = check_fix_settings(s, operands, &numbers);
    if (end == 0) end = mesh_space_read(&s->mesh, operands, &file);
    if (end == 0)
        end = s->fix ? check_fix_file(s, operands[0], &file, &numbers)
                     : check_mesh_file(&s->mesh, operands[0], &file);
    mw_mesh_file_release(&file);
    return end;
}

static const option *const tables[] = {check_options, mesh_space_options, common_options, NULL};

const command check_command = {
    .name = "check",
    .operands = "MESH",
    .operand_count = 1,
    .summary = "list the defects of a mesh, and mend them",
    .description =
        "Prints every defect of MESH and where it is, one on a line, and then whether the mesh is "
        "an embedding: whether its triangles cover the plane without folds and overlaps. Exits "
        "with 0 if it is one and with 3 if not, or if no triangle has an area. Flat triangles "
        "beside others are listed, but do no harm. With --as, MESH is checked as a surface or as a "
        "star-shaped polyhedron in the same way. With --fix, the mesh is mended and written, and "
        "each change is reported; the exit code then is 0 if the mended mesh is an embedding, and "
        "1 if defects remain. 'meshwalk view MESH' shows the defects in a browser. '-' is standard "
        "input.",
    .options = tables,
    .essential = "fix tolerance numbers as output",
    .settings_size = sizeof(check_settings),
    .run = check_run,
};
