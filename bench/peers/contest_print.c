#include "bench/core/bench.h"
#include "bench/peers/contest.h"
#include "cli/frame/report.h"

#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <string.h>
#include <time.h>
#include <unistd.h>

/* --- the machine ------------------------------------------------------------------------------------------------- */

#define MODEL "model name"

static void processor(text *t)
{
    char line[512];
    const char *name = "unknown processor";
    FILE *info = fopen("/proc/cpuinfo", "r");
    while (info && fgets(line, sizeof line, info)) {
        char *colon = strchr(line, ':');
        if (strncmp(line, MODEL, sizeof MODEL - 1) != 0 || !colon) continue;
        colon[strcspn(colon, "\n")] = 0;
        name = colon[1] == ' ' ? colon + 2 : colon + 1;
        break;
    }
    text_string(t, name);
    if (info) fclose(info);
}

/* Processor, compiler, versions, date: a figure without them tells nothing. */
void contest_machine(uint32_t set, text *t)
{
    char date[32];
    struct tm day;
    time_t now = time(NULL);
    strftime(date, sizeof date, "%Y-%m-%d", gmtime_r(&now, &day));
    processor(t);
#ifdef __clang__
    text_printf(t, ", %ld processors; clang %d.%d.%d", sysconf(_SC_NPROCESSORS_ONLN), __clang_major__, __clang_minor__,
                __clang_patchlevel__);
#else
    text_printf(t, ", %ld processors; gcc %s", sysconf(_SC_NPROCESSORS_ONLN), __VERSION__);
#endif
#ifndef __OPTIMIZE__
    text_string(t, ", not optimised");
#endif
    text_printf(t, "; meshwalk %s", mw_version());
    engines_versions(t, set);
    text_printf(t, "; %s", date);
}

/* --- rows -------------------------------------------------------------------------------------------------------- */

#define COLUMNS 9
static const char *const names[COLUMNS] = {"task",         "dataset", "vertices", "engine", "threads",
                                           "ns_per_query", "build_s", "bytes",    "wrong"};
#define WIDEST 256

static void number(char *cell, int decimals, double value)
{
    *cell = 0;
    if (!isnan(value)) snprintf(cell, WIDEST, "%.*f", decimals, value);
}

static void cells_of(const contest_row *r, char cells[COLUMNS][WIDEST])
{
    snprintf(cells[0], WIDEST, "%s", engines_task(r->task));
    snprintf(cells[1], WIDEST, "%s", r->dataset);
    for (char *c = cells[1]; *c; c++)
        if (*c == '\t' || *c == '\n') *c = ' ';
    snprintf(cells[2], WIDEST, "%zu", r->vertices);
    snprintf(cells[3], WIDEST, "%s", engines[r->engine].name);
    snprintf(cells[4], WIDEST, "%u", r->threads);
    number(cells[5], r->ns_per_query < 100 ? 2 : 1, r->ns_per_query);
    number(cells[6], 6, r->build_seconds);
    number(cells[7], 0, r->bytes);
    number(cells[8], 0, r->wrong);
}

static bool is_text(size_t column)
{
    return column < 2 || column == 3;
}

static void print_tsv(const contest_table *table, text *t)
{
    char cells[COLUMNS][WIDEST];
    for (size_t k = 0; k < COLUMNS; k++) text_printf(t, "%s%s", k ? "\t" : "", names[k]);
    text_string(t, "\n");
    for (size_t i = 0; i < table->count; i++) {
        cells_of(&table->rows[i], cells);
        for (size_t k = 0; k < COLUMNS; k++) text_printf(t, "%s%s", k ? "\t" : "", cells[k]);
        text_string(t, "\n");
    }
}

static void print_json(const contest_table *table, text *t)
{
    char cells[COLUMNS][WIDEST];
    text_string(t, "[");
    for (size_t i = 0; i < table->count; i++) {
        cells_of(&table->rows[i], cells);
        text_string(t, i ? ",\n {" : "\n {");
        for (size_t k = 0; k < COLUMNS; k++) {
            text_printf(t, "%s\"%s\": ", k ? ", " : "", names[k]);
            if (is_text(k))
                report_quote(t, cells[k]);
            else
                text_string(t, *cells[k] ? cells[k] : "null");
        }
        text_string(t, "}");
    }
    text_string(t, "\n]\n");
}

/* Words to the left, numbers to the right. */
static void print_aligned(const char *const cells[COLUMNS], const int width[COLUMNS], text *t)
{
    for (size_t k = 0; k < COLUMNS; k++)
        text_printf(t, is_text(k) ? "%s%-*s" : "%s%*s", k ? "  " : "", width[k], cells[k]);
    text_string(t, "\n");
}

/* Tasks and sets stand apart. */
static bool is_new_block(const contest_row *rows, size_t i)
{
    const contest_row *a = &rows[i], *b = &rows[i - 1];
    return a->task != b->task || a->vertices != b->vertices || strcmp(a->dataset, b->dataset) != 0;
}

static void print_table(const contest_table *table, text *t)
{
    char cells[COLUMNS][WIDEST];
    const char *row[COLUMNS];
    int width[COLUMNS];
    for (size_t k = 0; k < COLUMNS; k++) width[k] = (int)strlen(names[k]);
    for (size_t i = 0; i < table->count; i++) {
        cells_of(&table->rows[i], cells);
        for (size_t k = 0; k < COLUMNS; k++)
            if ((int)strlen(cells[k]) > width[k]) width[k] = (int)strlen(cells[k]);
    }
    print_aligned(names, width, t);
    for (size_t i = 0; i < table->count; i++) {
        if (i > 0 && is_new_block(table->rows, i)) text_string(t, "\n");
        cells_of(&table->rows[i], cells);
        for (size_t k = 0; k < COLUMNS; k++) row[k] = cells[k];
        print_aligned(row, width, t);
    }
}

void contest_print(const contest_table *table, const contest_plan *plan, int format, text *t)
{
    if (format == FORMAT_JSON) {
        print_json(table, t);
        return;
    }
    if (format == FORMAT_TSV) text_string(t, "# ");
    contest_machine(plan->engines, t);
    text_printf(t, "; %zu queries, %zu rounds\n", plan->queries, plan->rounds);
    if (format == FORMAT_TSV)
        print_tsv(table, t);
    else
        print_table(table, t);
}
