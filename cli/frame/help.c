#include "cli/frame/help.h"

#include <string.h>

#define LINE_WIDTH 80
#define HELP_COLUMN 24

static void help_blanks(text *t, size_t count)
{
    while (count--) text_string(t, " ");
}

/* Write the words from `column` on, and indent the lines after the first. A newline in the words
 * begins a new line. */
static void help_wrap_from(text *t, const char *words, size_t column, size_t indent)
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
            help_blanks(t, indent - column);
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

void help_wrap(text *t, const char *words, size_t indent)
{
    help_wrap_from(t, words, 0, indent);
}

static void help_choices_row(text *t, const choices *c)
{
    text row = {0};
    for (int i = 0; c->name(i); i++) text_printf(&row, "%s'%s'", i ? ", " : "", c->name(i));
    text_bytes(&row, "", 1);
    if (row.failed)
        t->failed = true;
    else
        help_wrap_from(t, row.bytes, 0, HELP_COLUMN + 2);
    text_release(&row);
}

static size_t choices_longest_name(const choices *c)
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
        help_choices_row(t, c);
        return;
    }
    const char *name;
    size_t indent = HELP_COLUMN + 6 + choices_longest_name(c);
    for (int i = 0; (name = c->name(i)); i++) {
        const char *help = c->help(i);
        if (!help) continue;
        help_blanks(t, HELP_COLUMN + 2);
        text_printf(t, "'%s'", name);
        size_t column = HELP_COLUMN + 4 + strlen(name);
        help_blanks(t, indent - column);
        help_wrap_from(t, help, indent, indent);
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
    help_blanks(t, HELP_COLUMN - column);
    help_wrap_from(t, o->help, HELP_COLUMN, HELP_COLUMN);
    if (o->choices) help_of_choices(t, o->choices);
}

/* Does an option of the same name stand earlier in the tables? The earlier one counts then: a
 * command overrules a common option to describe what is true for it. */
static bool option_is_overruled(const command *c, const option *o)
{
    for (const option *const *table = c->options; *table; table++)
        for (const option *other = *table; other->name; other++) {
            if (other == o) return false;
            if (strcmp(other->name, o->name) == 0) return true;
        }
    return false;
}

/* Is a name among those of a list separated by blanks? */
static bool list_has(const char *list, const char *name)
{
    size_t length = strlen(name);
    for (const char *at = list; (at = strstr(at, name)); at += length)
        if ((at == list || at[-1] == ' ') && (at[length] == 0 || at[length] == ' ')) return true;
    return false;
}

/* The options that the command calls essential, in its order. */
static void help_essential_options(text *t, const command *c)
{
    for (const char *name = c->essential; *name; name += strspn(name, " ")) {
        size_t length = strcspn(name, " ");
        bool found = false;
        for (const option *const *table = c->options; *table && !found; table++)
            for (const option *o = *table; o->name && !found; o++) {
                found = strlen(o->name) == length && strncmp(o->name, name, length) == 0;
                if (found) help_of_option(t, o);
            }
        name += length;
    }
}

/* The names of the others. */
static void help_other_options(text *t, const command *c)
{
    text names = {0};
    text_printf(&names, "'meshwalk %s --help all' describes the other options:", c->name);
    for (const option *const *table = c->options; *table; table++)
        for (const option *o = *table; o->name; o++)
            if (!option_is_overruled(c, o) && !list_has(c->essential, o->name))
                text_printf(&names, " --%s", o->name);
    text_bytes(&names, "", 1);
    if (names.failed)
        t->failed = true;
    else
        help_wrap(t, names.bytes, 0);
    text_release(&names);
}

static void help_all_options(text *t, const command *c)
{
    for (const option *const *table = c->options; *table; table++)
        for (const option *o = *table; o->name; o++)
            if (!option_is_overruled(c, o)) help_of_option(t, o);
}

void help_of_command(text *t, const command *c, bool all)
{
    text_printf(t, "meshwalk %s - %s\n\nusage: meshwalk %s [options] %s\n\n", c->name, c->summary,
                c->name, c->operands);
    help_wrap(t, c->description, 0);
    text_string(t, "\noptions:\n");
    if (all) {
        help_all_options(t, c);
    } else {
        help_essential_options(t, c);
        text_string(t, "\n");
        help_other_options(t, c);
    }
    text_printf(t, "\nThe manual page meshwalk-%s(1) tells more.\n", c->name);
}
