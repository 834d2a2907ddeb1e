#include "bench/peers/comparison_print.h"
#include "bench/core/settings.h"
#include "cli/frame/report.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#define COLUMNS 9
static const char *const names[COLUMNS] = {"task",    "dataset", "vertices",
                                           "engine",  "threads", "ns_per_query",
                                           "build_s", "bytes",   "wrong"};
#define WIDEST 256

static void comparison_number(char *cell, int decimals, double value)
{
    *cell = 0;
    if (!isnan(value)) snprintf(cell, WIDEST, "%.*f", decimals, value);
}

static void comparison_row_cells(const comparison_row *r, char cells[COLUMNS][WIDEST])
{
    snprintf(cells[0], WIDEST, "%s", engine_task_name(r->task));
    snprintf(cells[1], WIDEST, "%s", r->dataset);
    for (char *c = cells[1]; *c; c++)
        if (*c == '\t' || *c == '\n') *c = ' ';
    snprintf(cells[2], WIDEST, "%zu", r->vertices);
    snprintf(cells[3], WIDEST, "%s", engines[r->engine].name);
    snprintf(cells[4], WIDEST, "%u", r->threads);
    comparison_number(cells[5], r->ns_per_query < 100 ? 2 : 1, r->ns_per_query);
    comparison_number(cells[6], 6, r->build_seconds);
    comparison_number(cells[7], 0, r->bytes);
    comparison_number(cells[8], 0, r->wrong);
}

static bool comparison_column_is_text(size_t column)
{
    return column < 2 || column == 3;
}

static void comparison_print_tsv(const comparison_table *table, text *t)
{
    char cells[COLUMNS][WIDEST];
    for (size_t k = 0; k < COLUMNS; k++) text_printf(t, "%s%s", k ? "\t" : "", names[k]);
    text_string(t, "\n");
    for (size_t i = 0; i < table->count; i++) {
        comparison_row_cells(&table->rows[i], cells);
        for (size_t k = 0; k < COLUMNS; k++) text_printf(t, "%s%s", k ? "\t" : "", cells[k]);
        text_string(t, "\n");
    }
}

static void comparison_print_json(const comparison_table *table, text *t)
{
    char cells[COLUMNS][WIDEST];
    text_string(t, "[");
    for (size_t i = 0; i < table->count; i++) {
        comparison_row_cells(&table->rows[i], cells);
        text_string(t, i ? ",\n {" : "\n {");
        for (size_t k = 0; k < COLUMNS; k++) {
            text_printf(t, "%s\"%s\": ", k ? ", " : "", names[k]);
            if (comparison_column_is_text(k))
                report_quote(t, cells[k]);
            else
                text_string(t, *cells[k] ? cells[k] : "null");
        }
        text_string(t, "}");
    }
    text_string(t, "\n]\n");
}

/* Words to the left, numbers to the right. */
static void comparison_print_aligned(const char *const cells[COLUMNS], const int width[COLUMNS],
                                     text *t)
{
    for (size_t k = 0; k < COLUMNS; k++)
        text_printf(t, comparison_column_is_text(k) ? "%s%-*s" : "%s%*s", k ? "  " : "", width[k],
                    cells[k]);
    text_string(t, "\n");
}

/* Tasks and sets stand apart. */
static bool comparison_is_new_block(const comparison_row *rows, size_t i)
{
    const comparison_row *a = &rows[i], *b = &rows[i - 1];
    return a->task != b->task || a->vertices != b->vertices || strcmp(a->dataset, b->dataset) != 0;
}

static void comparison_print_table(const comparison_table *table, text *t)
{
    char cells[COLUMNS][WIDEST];
    const char *row[COLUMNS];
    int width[COLUMNS];
    for (size_t k = 0; k < COLUMNS; k++) width[k] = (int)strlen(names[k]);
    for (size_t i = 0; i < table->count; i++) {
        comparison_row_cells(&table->rows[i], cells);
        for (size_t k = 0; k < COLUMNS; k++)
            if ((int)strlen(cells[k]) > width[k]) width[k] = (int)strlen(cells[k]);
    }
    comparison_print_aligned(names, width, t);
    for (size_t i = 0; i < table->count; i++) {
        if (i > 0 && comparison_is_new_block(table->rows, i)) text_string(t, "\n");
        comparison_row_cells(&table->rows[i], cells);
        for (size_t k = 0; k < COLUMNS; k++) row[k] = cells[k];
        comparison_print_aligned(row, width, t);
    }
}

void comparison_print(const comparison_table *table, const comparison_plan *plan, int format,
                      text *t)
{
    if (format == FORMAT_JSON) {
        comparison_print_json(table, t);
        return;
    }
    if (format == FORMAT_TSV) text_string(t, "# ");
    engine_list_describe(plan->engines, t);
    text_printf(t, "; %zu queries, %zu rounds\n", plan->queries, plan->rounds);
    if (format == FORMAT_TSV)
        comparison_print_tsv(table, t);
    else
        comparison_print_table(table, t);
}
