#include "cli/stream/query_header.h"
#include "src/base/posix.h"

#include <stdio.h>
#include <string.h>

/* The names that are taken. */
typedef struct taken_names {
    const char *const *of_columns;
    size_t column_count;
    const char *const *of_answers;
    size_t answer_count;
} taken_names;

/* Programs that read tables often do not tell upper case from lower case. */
static bool name_is_taken(const taken_names *taken, const char *name)
{
    for (size_t i = 0; i < taken->column_count; i++)
        if (strcasecmp(taken->of_columns[i], name) == 0) return true;
    for (size_t i = 0; i < taken->answer_count; i++)
        if (strcasecmp(taken->of_answers[i], name) == 0) return true;
    return false;
}

/* Write a name; in quotes if it would not be read as one cell otherwise. */
static void name_write(text *out, const char *name, const char *suffix, char separator)
{
    const char special[] = {separator, ',', '"', '\r', '\n', 0};
    if (!name[strcspn(name, special)]) {
        text_string(out, name);
        text_string(out, suffix);
        return;
    }
    text_string(out, "\"");
    for (; *name; name++) text_bytes(out, *name == '"' ? "\"\"" : name, *name == '"' ? 2 : 1);
    text_string(out, suffix);
    text_string(out, "\"");
}

static void answer_names_write(text *out, taken_names taken, const char *const *answers,
                               char separator)
{
    taken.of_answers = answers;
    for (taken.answer_count = 0; answers[taken.answer_count]; taken.answer_count++) {
        const char *name = answers[taken.answer_count];
        char suffix[32] = "", full[320];
        for (int again = 1;
             snprintf(full, sizeof full, "%s%s", name, suffix), name_is_taken(&taken, full);
             again++)
            snprintf(suffix, sizeof suffix, again == 1 ? "_mw" : "_mw%d", again);
        text_bytes(out, &separator, 1);
        name_write(out, name, suffix, separator);
    }
    text_bytes(out, "\n", 1);
}

/* Write the names of columns that the file does not name. */
static void column_names_write(text *out, const query_columns *wanted, const size_t *index,
                               size_t count, char separator)
{
    for (size_t i = 0; i < count; i++) {
        size_t k = 0;
        if (i > 0) text_bytes(out, &separator, 1);
        while (k < wanted->count && index[k] != i) k++;
        if (k < wanted->count)
            text_string(out, wanted->names[k]);
        else
            text_printf(out, "c%zu", i + 1);
    }
}

void query_header_write(text *out, const mw_point_table *table, const query_columns *wanted,
                        const size_t *index, const char *const *answers)
{
    taken_names taken = {.of_columns = wanted->names, .column_count = wanted->count};
    if (table->header) {
        taken = (taken_names){.of_columns = table->names, .column_count = table->column_count};
        text_string(out, table->header);
    } else {
        size_t count = table->column_count > 0 ? table->column_count : wanted->count;
        column_names_write(out, wanted, index, count, table->separator);
    }
    answer_names_write(out, taken, answers, table->separator);
}

void query_header_write_answers(text *out, const query_columns *wanted, size_t shown,
                                const char *const *answers)
{
    size_t index[MAX_QUERY_COLUMNS];
    for (size_t k = 0; k < MAX_QUERY_COLUMNS; k++) index[k] = k;
    column_names_write(out, wanted, index, shown, ',');
    answer_names_write(out, (taken_names){.of_columns = wanted->names, .column_count = shown},
                       answers, ',');
}
