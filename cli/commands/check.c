/* check - every defect of a mesh, with its place; of a mesh in the plane, a surface or a
 * star-shaped polyhedron. */
#include "cli/commands/commands.h"
#include "cli/frame/files.h"
#include "cli/frame/message.h"
#include "cli/frame/progress.h"
#include "cli/frame/report.h"
#include "cli/input/mesh_space.h"

#include <inttypes.h>
#include <stdio.h>

static const option check_options[] = {
    {"json", 0, OPTION_FLAG, offsetof(mesh_space_settings, json), NULL, "print the defects as JSON", NULL},
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
    [SPACE_STAR] = {"star_shaped", "star-shaped about the centre", "not star-shaped about the centre",
                    "nothing to meet"},
};

/* The result of a check. */
typedef struct check_outcome {
    const struct verdict_words *verdict;
    char words[128];
    bool sound; /* the mesh is what it is taken as                                  */
    bool good;  /* it also has a triangle with an area: every promise holds */
} check_outcome;

static check_outcome check_outcome_of(const mesh_space_settings *s, const mw_check *check, const mw_mesh_file *file)
{
    size_t flat = 0;
    for (size_t i = 0; i < check->defect_count; i++) flat += check->defects[i].kind == MW_DEFECT_FLAT;
    bool area = s->space == SPACE_PLANE ? files_has_area(file) : flat < file->triangle_count;
    check_outcome o = {&verdicts[s->space], .sound = check->valid, .good = check->valid && area};
    size_t defects = check->defect_count - flat;
    char remark[48] = "";
    if (flat) snprintf(remark, sizeof remark, "; %zu flat triangle%s", flat, flat == 1 ? "" : "s");
    if (!o.sound)
        snprintf(o.words, sizeof o.words, "%s: %zu defect%s%s", o.verdict->bad, defects, defects == 1 ? "" : "s",
                 remark);
    else if (!o.good)
        snprintf(o.words, sizeof o.words, "no triangle with an area: %s%s", o.verdict->empty, remark);
    else
        snprintf(o.words, sizeof o.words, "%s: every promise holds%s", o.verdict->good, remark);
    return o;
}

static void check_as_json(text *t, const char *path, const mw_check *check, const check_outcome *o)
{
    text_string(t, "{\n \"file\": ");
    report_quote(t, path);
    text_printf(t, ",\n \"%s\": %s,\n \"verdict\": ", o->verdict->key, o->sound ? "true" : "false");
    report_quote(t, o->words);
    text_string(t, ",\n \"defects\": [");
    for (size_t i = 0; i < check->defect_count; i++) {
        text_string(t, i ? ",\n" : "\n");
        check_json_defect(t, &check->defects[i]);
    }
    text_string(t, check->defect_count ? "\n ]\n}\n" : "]\n}\n");
}

static void check_as_text(text *t, const char *path, const mw_check *check, const check_outcome *o)
{
    for (size_t i = 0; i < check->defect_count; i++) {
        char words[256];
        mw_defect_describe(&check->defects[i], words, sizeof words);
        text_printf(t, "%s\n", words);
    }
    text_printf(t, "%s: %s\n", path, o->words);
}

static mw_status check_arrays(const mesh_space_settings *s, const mw_arrays *arrays, mw_check *check, mw_error *error)
{
    mw_star_options star = {.centre = {s->centre.at[0], s->centre.at[1], s->centre.at[2]},
                            .progress = progress_of_call()};
    mw_check_options options = {.threads = s->common.threads, .progress = progress_of_call()};
    int weld = mesh_space_is_welded(s);
    if (s->space == SPACE_SURFACE) return mw_surface_check_arrays(arrays, weld, &options, check, error);
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
    if (s->json)
        check_as_json(&t, path, &check, &o);
    else
        check_as_text(&t, path, &check, &o);
    int end = files_write_text(s->common.output, &t);
    if (end == 0 && !o.good) end = END_INPUT;
    mw_check_release(&check);
    return end;
}

static int check_run(const void *settings, const char *const *operands)
{
    const mesh_space_settings *s = settings;
    mw_mesh_file file = {0};
    int end = mesh_space_read(s, operands, &file);
    if (end == 0) end = check_mesh_file(s, operands[0], &file);
    mw_mesh_file_release(&file);
    return end;
}

static const option *const tables[] = {mesh_space_options, check_options, common_options, NULL};

const command check_command = {
    .name = "check",
    .operands = "MESH",
    .operand_count = 1,
    .summary = "list the defects of a mesh",
    .description =
        "Prints every defect of MESH with its place, one on a line, and then whether the mesh is an "
        "embedding: whether its triangles cover the plane without folds and overlaps. Exits with 0 if it "
        "is one and with 3 if not, or if no triangle has an area. Flat triangles beside others are listed, but do "
        "no harm. With --as, MESH is checked as a surface or as a star-shaped polyhedron in the same way. '-' is "
        "standard input.",
    .options = tables,
    .settings_size = sizeof(mesh_space_settings),
    .run = check_run,
};
