#include "bench/edits/edit_table.h"
#include "bench/core/settings.h"
#include "bench/edits/edit_engine_list.h"
#include "cli/frame/message.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

edit_row edit_row_of(const edit_plan *p, edit_task task, const char *name)
{
    return (edit_row){task, p->name, name, p->vertices, NAN, NAN, NAN, NAN, NAN, NAN};
}

int edit_table_add(edit_table *table, const edit_row *row)
{
    edit_row *rows = realloc(table->rows, (table->count + 1) * sizeof *rows);
    if (!rows) return fail_memory();
    table->rows = rows;
    rows[table->count++] = *row;
    return 0;
}

#define COLUMNS 10
static const char *const names[COLUMNS] = {"task", "dataset",   "vertices", "edits", "engine",
                                           "ns",   "triangles", "bytes",    "wrong", "ratio"};
#define WIDEST 64

static void edit_table_number(char *cell, int decimals, double value)
{
    *cell = 0;
    if (!isnan(value)) snprintf(cell, WIDEST, "%.*f", decimals, value);
}

static void edit_row_cells(const edit_row *r, char cells[COLUMNS][WIDEST])
{
    snprintf(cells[0], WIDEST, "%s", edit_task_name(r->task));
    snprintf(cells[1], WIDEST, "%s", r->dataset);
    snprintf(cells[2], WIDEST, "%zu", r->vertices);
    edit_table_number(cells[3], 0, r->edits);
    snprintf(cells[4], WIDEST, "%s", r->name);
    edit_table_number(cells[5], r->ns < 1000 ? 1 : 0, r->ns);
    edit_table_number(cells[6], 2, r->triangles);
    edit_table_number(cells[7], 0, r->bytes);
    edit_table_number(cells[8], 0, r->wrong);
    edit_table_number(cells[9], 3, r->ratio);
}

static bool edit_column_is_text(size_t column)
{
    return column < 2 || column == 4;
}

static bool edit_table_is_new_block(const edit_row *rows, size_t i)
{
    const edit_row *a = &rows[i], *b = &rows[i - 1];
    return a->task != b->task || a->vertices != b->vertices || a->dataset != b->dataset ||
           a->edits != b->edits;
}

/* Aligned, or with tabs. */
static void edit_table_print_cells(const char *const cells[COLUMNS], const int width[COLUMNS],
                                   text *t)
{
    for (size_t k = 0; k < COLUMNS; k++) {
        if (!width)
            text_printf(t, "%s%s", k ? "\t" : "", cells[k]);
        else
            text_printf(t, edit_column_is_text(k) ? "%s%-*s" : "%s%*s", k ? "  " : "", width[k],
                        cells[k]);
    }
    text_string(t, "\n");
}

static void edit_table_print_rows(const edit_table *table, const int *width, text *t)
{
    char cells[COLUMNS][WIDEST];
    const char *row[COLUMNS];
    edit_table_print_cells(names, width, t);
    for (size_t k = 0; k < COLUMNS; k++) row[k] = cells[k];
    for (size_t i = 0; i < table->count; i++) {
        if (width && i > 0 && edit_table_is_new_block(table->rows, i)) text_string(t, "\n");
        edit_row_cells(&table->rows[i], cells);
        edit_table_print_cells(row, width, t);
    }
}

static void edit_table_widths(const edit_table *table, int width[COLUMNS])
{
    char cells[COLUMNS][WIDEST];
    for (size_t k = 0; k < COLUMNS; k++) width[k] = (int)strlen(names[k]);
    for (size_t i = 0; i < table->count; i++) {
        edit_row_cells(&table->rows[i], cells);
        for (size_t k = 0; k < COLUMNS; k++)
            if ((int)strlen(cells[k]) > width[k]) width[k] = (int)strlen(cells[k]);
    }
}

void edit_table_print(const edit_table *table, const edit_plan *plan, int format, text *t)
{
    int width[COLUMNS];
    if (format == FORMAT_TSV) text_string(t, "# ");
    engine_list_describe(edit_engine_libraries(plan->engines), t);
    text_printf(t, "; %zu steps, %zu rounds\n", plan->steps, plan->rounds);
    edit_table_widths(table, width);
    edit_table_print_rows(table, format == FORMAT_TSV ? NULL : width, t);
}

void edit_table_release(edit_table *table)
{
    free(table->rows);
    *table = (edit_table){0};
}
