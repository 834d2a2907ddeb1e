#include "bench/core/word_list.h"
#include "cli/frame/text.h"
#include "cli/frame/message.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

int word_list_each(const char *list, word_list_visit *visit, void *self)
{
    int end = 0;
    for (bool more = true; more && end == 0;) {
        size_t length = strcspn(list, ",");
        char *word = strndup(list, length);
        if (!word) return fail_memory();
        end = visit(word, self);
        free(word);
        more = list[length] == ',';
        list += length + more;
    }
    return end;
}

/* --- names ------------------------------------------------------------------------------------ */

typedef struct name_set {
    const choices *names;
    uint32_t set;
} name_set;

static int name_set_refuse(const name_set *n, const char *word)
{
    text all = {0};
    for (int i = 0; n->names->name(i); i++)
        text_printf(&all, "%s%s", i ? ", " : "", n->names->name(i));
    text_bytes(&all, "", 1);
    complain("unknown %s '%s'; there are %s", n->names->noun, word,
             all.failed ? "others" : all.bytes);
    text_release(&all);
    return END_USAGE;
}

static int name_set_take(const char *word, void *self)
{
    name_set *n = self;
    for (int i = 0; n->names->name(i); i++)
        if (strcmp(n->names->name(i), word) == 0) {
            n->set |= UINT32_C(1) << i;
            return 0;
        }
    return name_set_refuse(n, word);
}

int word_list_names(const char *list, const choices *names, uint32_t *set)
{
    name_set n = {.names = names};
    int end = word_list_each(list, name_set_take, &n);
    *set = n.set;
    return end;
}

/* --- sizes ------------------------------------------------------------------------------------ */

/* At least 10: four points may be corners. */
#define LEAST_SIZE 10
#define MOST_SIZE 500000000
#define MOST_RANKS 1000000

typedef struct size_limits {
    const char *option;
    int least, most;
    size_list *list;
} size_limits;

static int size_list_take(const char *word, void *self)
{
    const size_limits *limits = self;
    size_list *list = limits->list;
    char *rest;
    double size = strtod(word, &rest);
    bool plain = *word && strspn(word, "0123456789e") == strlen(word) && !*rest;
    if (!plain || !(size >= limits->least && size <= limits->most) || size != floor(size)) {
        complain("option '%s' must be numbers from %d to %d separated by commas, not '%s'",
                 limits->option, limits->least, limits->most, word);
        return END_USAGE;
    }
    if (list->count == MOST_SIZES) {
        complain("option '%s' takes at most %d numbers", limits->option, MOST_SIZES);
        return END_USAGE;
    }
    list->size[list->count++] = (size_t)size;
    return 0;
}

int word_list_sizes(const char *list, size_list *sizes)
{
    size_limits limits = {"--sizes", LEAST_SIZE, MOST_SIZE, sizes};
    *sizes = (size_list){0};
    return word_list_each(list, size_list_take, &limits);
}

int word_list_ranks(const char *list, size_list *ranks)
{
    size_limits limits = {"--ranks", 1, MOST_RANKS, ranks};
    *ranks = (size_list){0};
    return word_list_each(list, size_list_take, &limits);
}
