#include "cli/output/mended_mesh.h"
#include "cli/frame/message.h"
#include "cli/frame/progress.h"
#include "cli/frame/report.h"
#include "cli/frame/spelling.h"

#include <inttypes.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* --- repairs by name --- */

static const char *repair_name(int i)
{
    return (const char *[]){"weld", "orient", "drop", "split", "all", NULL}[i];
}
static const char *repair_help(int i)
{
    return (const char *[]){
        "make one of coincident vertices, or of those within --tolerance",
        "turn triangles, so that all go the same way",
        "drop unusable and duplicate triangles, and with split those without an area",
        "split triangles where a vertex of others lies inside a border edge", "all of these"}[i];
}
const choices mend_repairs = {"repair", repair_name, repair_help};

static const uint32_t repair_bits[] = {MW_REPAIR_WELD, MW_REPAIR_ORIENT, MW_REPAIR_DROP,
                                       MW_REPAIR_SPLIT, MW_REPAIR_ALL};

static int repair_parse(const char *word, uint32_t *repairs)
{
    spelling s = spelling_of(word);
    for (int i = 0; repair_name(i); i++) {
        if (strcmp(repair_name(i), word) == 0) {
            *repairs |= repair_bits[i];
            return 0;
        }
        spelling_try(&s, repair_name(i));
    }
    spelling_complain(&s, "repair", "");
    return END_USAGE;
}

int mended_mesh_parse(const char *list, uint32_t *repairs)
{
    int end = 0;
    *repairs = 0;
    for (bool more = true; more && end == 0;) {
        char word[16];
        size_t length = strcspn(list, ","), kept = length < sizeof word ? length : sizeof word - 1;
        memcpy(word, list, kept);
        word[kept] = 0;
        end = repair_parse(word, repairs);
        more = list[length] == ',';
        list += length + more;
    }
    return end;
}

/* --- values --- */

static bool lost_value_note(mended_mesh *m, size_t field, uint32_t vertex, uint32_t kept,
                            double value, double kept_value)
{
    if (value == kept_value || (isnan(value) && isnan(kept_value))) return true;
    if ((m->lost_count & (m->lost_count - 1)) == 0) { /* room for a power of two */
        size_t room = m->lost_count ? 2 * m->lost_count : 1;
        lost_value *more = realloc(m->lost, room * sizeof *more);
        if (!more) return false;
        m->lost = more;
    }
    m->lost[m->lost_count++] = (lost_value){vertex, kept, field, value, kept_value};
    return true;
}

/* Compare the values of welded vertices. In space z is a coordinate. */
static bool mended_mesh_find_lost(mended_mesh *m, const mw_mesh_file *file, bool space)
{
    for (size_t i = 0; i < m->mended.change_count; i++) {
        const mw_mend_change *c = &m->mended.changes[i];
        if (c->kind != MW_MEND_WELDED) continue;
        size_t v = c->vertex, kept = c->other;
        const double *p = file->points;
        if (file->has_z && !space &&
            !lost_value_note(m, SIZE_MAX, c->vertex, c->other, p[3 * v + 2], p[3 * kept + 2]))
            return false;
        for (size_t f = 0; f < file->field_count; f++)
            if (!lost_value_note(m, f, c->vertex, c->other, file->fields[f][v],
                                 file->fields[f][kept]))
                return false;
    }
    return true;
}

/* Vertices keep their order, so they can move down in place. */
static void mended_mesh_move_values(const mended_mesh *m, mw_mesh_file *file)
{
    const uint32_t *from = m->mended.vertex_from;
    for (size_t i = 0; i < m->mended.vertex_count; i++) {
        memmove(file->points + 3 * i, file->points + 3 * (size_t)from[i], 3 * sizeof(double));
        for (size_t f = 0; f < file->field_count; f++)
            file->fields[f][i] = file->fields[f][from[i]];
    }
}

int mended_mesh_create(mended_mesh *m, const char *path, mw_mesh_file *file,
                       const mw_mend_options *options)
{
    mw_error error;
    mw_arrays arrays = mw_mesh_file_arrays(file);
    *m = (mended_mesh){.old_vertices = file->point_count, .old_triangles = file->triangle_count};
    progress_phase("mending", path);
    if (mw_mend_arrays(&arrays, options, &m->mended, &error) != MW_OK)
        return fail_mesh(path, &error);
    if (!mended_mesh_find_lost(m, file, options->space)) return fail_memory();
    mended_mesh_move_values(m, file);
    free(file->triangles);
    file->triangles = m->mended.triangles;
    file->triangle_count = m->mended.triangle_count;
    file->point_count = m->mended.vertex_count;
    m->mended.triangles = NULL;
    return 0;
}

void mended_mesh_release(mended_mesh *m)
{
    mw_mended_release(&m->mended);
    free(m->lost);
    *m = (mended_mesh){0};
}

/* --- what is told --- */

static const char *lost_value_field(const lost_value *lost, const mw_mesh_file *file)
{
    return lost->field == SIZE_MAX ? "z" : file->field_names[lost->field];
}

void mended_mesh_tell(const mended_mesh *m, const mw_mesh_file *file, text *t)
{
    for (size_t i = 0; i < m->mended.change_count; i++) {
        char words[128];
        mw_mend_change_describe(&m->mended.changes[i], words, sizeof words);
        text_printf(t, "%s\n", words);
    }
    for (size_t i = 0; i < m->lost_count; i++) {
        const lost_value *l = &m->lost[i];
        text_printf(t, "vertex %" PRIu32 ": its %s, ", l->vertex, lost_value_field(l, file));
        text_double(t, l->value);
        text_printf(t, ", is lost: that of vertex %" PRIu32 ", ", l->kept);
        text_double(t, l->kept_value);
        text_string(t, ", is kept\n");
    }
}

/* Names for scripts: they stay when the texts change. Of a kind of defect the name is that of
 * check. */
static const char *const change_names[MW_MEND_CHANGE_COUNT] = {
    [MW_MEND_WELDED] = "welded",
    [MW_MEND_DROPPED_MISSING] = "dropped-index",
    [MW_MEND_DROPPED_INFINITE] = "dropped-not-finite",
    [MW_MEND_DROPPED_REPEATED] = "dropped-repeated-vertex",
    [MW_MEND_DROPPED_DUPLICATE] = "dropped-duplicate",
    [MW_MEND_DROPPED_FLAT] = "dropped-flat",
    [MW_MEND_SPLIT] = "split",
    [MW_MEND_TURNED] = "turned",
};

static void json_number_member(text *t, const char *name, uint32_t value)
{
    if (value != MW_NONE) text_printf(t, ", \"%s\": %" PRIu32, name, value);
}

static void json_double_member(text *t, const char *name, double value)
{
    text_printf(t, ", \"%s\": ", name);
    if (isfinite(value))
        text_double(t, value);
    else
        text_string(t, "null");
}

void mended_mesh_tell_json(const mended_mesh *m, const mw_mesh_file *file, text *t)
{
    text_string(t, "\"changes\": [");
    for (size_t i = 0; i < m->mended.change_count; i++) {
        const mw_mend_change *c = &m->mended.changes[i];
        text_printf(t, "%s\n  {\"kind\": \"%s\"", i ? "," : "", change_names[c->kind]);
        json_number_member(t, "triangle", c->triangle);
        json_number_member(t, "vertex", c->vertex);
        json_number_member(t, "other", c->other);
        text_string(t, "}");
    }
    text_string(t, m->mended.change_count ? "\n ],\n \"lost\": [" : "],\n \"lost\": [");
    for (size_t i = 0; i < m->lost_count; i++) {
        const lost_value *l = &m->lost[i];
        text_printf(t, "%s\n  {\"field\": ", i ? "," : "");
        report_quote(t, lost_value_field(l, file));
        json_number_member(t, "vertex", l->vertex);
        json_number_member(t, "kept", l->kept);
        json_double_member(t, "value", l->value);
        json_double_member(t, "kept_value", l->kept_value);
        text_string(t, "}");
    }
    text_string(t, m->lost_count ? "\n ]" : "]");
}

void mended_mesh_sum_up(const mended_mesh *m, const char *path, text *t)
{
    size_t count[MW_MEND_CHANGE_COUNT] = {0}, dropped = 0, split = 0;
    uint32_t last = MW_NONE;
    for (size_t i = 0; i < m->mended.change_count; i++) {
        const mw_mend_change *c = &m->mended.changes[i];
        count[c->kind]++;
        dropped += c->kind >= MW_MEND_DROPPED_MISSING && c->kind <= MW_MEND_DROPPED_FLAT;
        split += c->kind == MW_MEND_SPLIT && c->triangle != last;
        last = c->kind == MW_MEND_SPLIT ? c->triangle : MW_NONE;
    }
    text_printf(t,
                "%s: vertices: %zu welded, %zu of %zu left; triangles: %zu dropped, %zu split, %zu "
                "turned, %zu "
                "made of %zu",
                path, count[MW_MEND_WELDED], m->mended.vertex_count, m->old_vertices, dropped,
                split, count[MW_MEND_TURNED], m->mended.triangle_count, m->old_triangles);
    if (m->lost_count > 0) text_printf(t, "; values lost: %zu", m->lost_count);
    text_string(t, "\n");
}

void mended_mesh_write_numbers(const mended_mesh *m, mw_output *out)
{
    const mw_mended *mended = &m->mended;
    mw_output_printf(out, "what,old,new\n");
    for (size_t v = 0; v < m->old_vertices; v++)
        mw_output_printf(out, "vertex,%zu,%" PRIu32 "\n", v, mended->vertex_to[v]);
    for (size_t t = 0, part = 0; t < m->old_triangles; t++) {
        size_t first = part;
        while (part < mended->triangle_count && mended->triangle_from[part] == t)
            mw_output_printf(out, "triangle,%zu,%zu\n", t, part++);
        if (part == first) mw_output_printf(out, "triangle,%zu,-1\n", t);
    }
}
