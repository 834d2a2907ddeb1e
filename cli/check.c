/* check - every defect of a mesh, with its place. */
#include "commands.h"
#include "files.h"
#include "message.h"
#include "progress.h"
#include "report.h"

#include <inttypes.h>
#include <stdio.h>

typedef struct check_settings {
    common_settings common;
    bool json;
} check_settings;

static const option check_options[] = {
    {"json", 0, OPTION_FLAG, offsetof(check_settings, json), NULL, "print the defects as JSON", NULL},
    {0},
};

/* Names for scripts: they stay when the texts change. */
static const char *const kind_names[MW_DEFECT_COUNT] = {
    [MW_DEFECT_INDEX] = "index",
    [MW_DEFECT_NOT_FINITE] = "not-finite",
    [MW_DEFECT_REPEATED_VERTEX] = "repeated-vertex",
    [MW_DEFECT_EDGE_SHARED] = "edge-shared",
    [MW_DEFECT_FOLDED] = "folded",
    [MW_DEFECT_TURN] = "turn",
    [MW_DEFECT_CROSSING] = "crossing",
    [MW_DEFECT_VERTEX_IN_EDGE] = "vertex-in-edge",
    [MW_DEFECT_OVERLAP] = "overlap",
    [MW_DEFECT_FLAT] = "flat",
};

static void place(text *t, const char *name, uint32_t value, uint32_t none)
{
    if (value != none) text_printf(t, ", \"%s\": %" PRIu32, name, value);
}

static void defect_as_json(text *t, const mw_defect *d)
{
    char words[256];
    mw_defect_describe(d, words, sizeof words);
    text_printf(t, "  {\"kind\": \"%s\"", kind_names[d->kind]);
    place(t, "triangle", d->triangle, MW_NONE);
    place(t, "edge", d->edge, 255);
    place(t, "other", d->other, MW_NONE);
    place(t, "other_edge", d->other_edge, 255);
    place(t, "vertex", d->vertex, MW_NONE);
    text_string(t, ", \"text\": ");
    report_quote(t, words);
    text_string(t, "}");
}

/* What a check comes to. */
typedef struct outcome {
    char words[128];
    bool good; /* points can be located, and every promise holds */
} outcome;

static outcome outcome_of(const mw_check *check, const mw_mesh_file *file)
{
    outcome o = {.good = check->embedding && files_has_area(file)};
    size_t flat = 0;
    for (size_t i = 0; i < check->defect_count; i++) flat += check->defects[i].kind == MW_DEFECT_FLAT;
    size_t defects = check->defect_count - flat;
    char remark[48] = "";
    if (flat) snprintf(remark, sizeof remark, "; %zu flat triangle%s", flat, flat == 1 ? "" : "s");
    if (!check->embedding)
        snprintf(o.words, sizeof o.words, "no embedding: %zu defect%s%s", defects, defects == 1 ? "" : "s", remark);
    else
        snprintf(o.words, sizeof o.words, "%s%s",
                 o.good ? "an embedding: every promise holds" : "no triangle with an area: nothing to locate in",
                 remark);
    return o;
}

static void as_json(text *t, const char *path, const mw_check *check, const outcome *o)
{
    text_string(t, "{\n \"file\": ");
    report_quote(t, path);
    text_printf(t, ",\n \"embedding\": %s,\n \"verdict\": ", check->embedding ? "true" : "false");
    report_quote(t, o->words);
    text_string(t, ",\n \"defects\": [");
    for (size_t i = 0; i < check->defect_count; i++) {
        text_string(t, i ? ",\n" : "\n");
        defect_as_json(t, &check->defects[i]);
    }
    text_string(t, check->defect_count ? "\n ]\n}\n" : "]\n}\n");
}

static void as_text(text *t, const char *path, const mw_check *check, const outcome *o)
{
    for (size_t i = 0; i < check->defect_count; i++) {
        char words[256];
        mw_defect_describe(&check->defects[i], words, sizeof words);
        text_printf(t, "%s\n", words);
    }
    text_printf(t, "%s: %s\n", path, o->words);
}

static int check_file(const check_settings *s, const char *path, const mw_mesh_file *file)
{
    mw_error error;
    mw_check check;
    text t = {0};
    mw_arrays arrays = mw_mesh_file_arrays(file);
    progress_phase("checking", path);
    if (mw_check_arrays(&arrays, &check, &error) != MW_OK) return fail_mesh(path, &error);
    outcome o = outcome_of(&check, file);
    if (s->json)
        as_json(&t, path, &check, &o);
    else
        as_text(&t, path, &check, &o);
    int end = files_write_text(s->common.output, &t);
    if (end == 0 && !o.good) end = END_INPUT;
    mw_check_release(&check);
    return end;
}

static int run(const void *settings, const char *const *operands)
{
    const check_settings *s = settings;
    mw_mesh_file file = {0};
    int end = files_check(s->common.output, operands, 1);
    if (end == 0) end = files_read_mesh(operands[0], &file);
    if (end == 0) end = check_file(s, operands[0], &file);
    mw_mesh_file_release(&file);
    return end;
}

static const option *const tables[] = {check_options, common_options, NULL};

const command check_command = {
    .name = "check",
    .operands = "MESH",
    .operand_count = 1,
    .summary = "list the defects of a mesh",
    .description =
        "Prints every defect of MESH with its place, one on a line, and then whether the mesh is an "
        "embedding: whether its triangles cover the plane without folds and overlaps. Exits with 0 if it "
        "is one and with 3 if not, or if no triangle has an area. Flat triangles beside others are listed, but do "
        "no harm. '-' is standard input.",
    .options = tables,
    .settings_size = sizeof(check_settings),
    .run = run,
};
