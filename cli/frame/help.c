/* help.c - the text of --help, from the tables of options. */
#include "cli/frame/options.h"

#include <string.h>

#define LINE_WIDTH 80
#define HELP_COLUMN 24

static void blanks(text *t, size_t count)
{
    while (count--) text_string(t, " ");
}

/* Words from `column` on; later lines are indented. A newline in the words begins a new line. */
static void wrap_from(text *t, const char *words, size_t column, size_t indent)
{
    bool first = true;
    while (*words) {
        if (*words == '\n' || *words == ' ') {
            if (*words == '\n') {
                text_string(t, "\n");
                column = 0;
                first = true;
            }
            words++;
            continue;
        }
        size_t length = strcspn(words, " \n");
        if (!first && column + 1 + length > LINE_WIDTH) {
            text_string(t, "\n");
            column = 0;
            first = true;
        }
        if (column < indent) {
            blanks(t, indent - column);
            column = indent;
        } else if (!first) {
            text_string(t, " ");
            column++;
        }
        text_bytes(t, words, length);
        column += length;
        words += length;
        first = false;
    }
    text_string(t, "\n");
}

void options_wrap(text *t, const char *words, size_t indent)
{
    wrap_from(t, words, 0, indent);
}

static void row_of_choices(text *t, const choices *c)
{
    text row = {0};
    for (int i = 0; c->name(i); i++) text_printf(&row, "%s%s", i ? ", " : "", c->name(i));
    text_bytes(&row, "", 1);
    if (row.failed)
        t->failed = true;
    else
        wrap_from(t, row.bytes, 0, HELP_COLUMN + 2);
    text_release(&row);
}

static size_t longest_name(const choices *c)
{
    size_t longest = 0;
    const char *name;
    for (int i = 0; (name = c->name(i)); i++)
        if (strlen(name) > longest) longest = strlen(name);
    return longest;
}

static void help_of_choices(text *t, const choices *c)
{
    if (!c->help) {
        row_of_choices(t, c);
        return;
    }
    const char *name;
    size_t indent = HELP_COLUMN + 4 + longest_name(c);
    for (int i = 0; (name = c->name(i)); i++) {
        const char *help = c->help(i);
        if (!help) continue;
        blanks(t, HELP_COLUMN + 2);
        text_string(t, name);
        size_t column = HELP_COLUMN + 2 + strlen(name);
        blanks(t, indent - column);
        wrap_from(t, help, indent, indent);
    }
}

static void help_of_option(text *t, const option *o)
{
    size_t begin = t->size;
    if (o->letter)
        text_printf(t, "  -%c, --%s", o->letter, o->name);
    else
        text_printf(t, "      --%s", o->name);
    if (o->argument) text_printf(t, " %s", o->argument);
    size_t column = t->size - begin;
    if (column + 2 > HELP_COLUMN) {
        text_string(t, "\n");
        column = 0;
    }
    blanks(t, HELP_COLUMN - column);
    wrap_from(t, o->help, HELP_COLUMN, HELP_COLUMN);
    if (o->choices) help_of_choices(t, o->choices);
}

/* Has a table before it, or the same one, an option of this name? Then that one counts, and says what is true here. */
static bool is_overruled(const command *c, const option *o)
{
    for (const option *const *table = c->options; *table; table++)
        for (const option *other = *table; other->name; other++) {
            if (other == o) return false;
            if (strcmp(other->name, o->name) == 0) return true;
        }
    return false;
}

void options_help(text *t, const command *c)
{
    text_printf(t, "meshwalk %s - %s\n\nusage: meshwalk %s [options] %s\n\n", c->name, c->summary, c->name,
                c->operands);
    options_wrap(t, c->description, 0);
    text_string(t, "\noptions:\n");
    for (const option *const *table = c->options; *table; table++)
        for (const option *o = *table; o->name; o++)
            if (!is_overruled(c, o)) help_of_option(t, o);
    text_printf(t, "\nThe manual page meshwalk-%s(1) tells more.\n", c->name);
}
