#include "cli/vertices/las_classes.h"
#include "cli/frame/message.h"
#include "cli/frame/spelling.h"

#include <stdbool.h>
#include <stdlib.h>
#include <string.h>

/* Standard classes of LAS 1.4 R15, table 17. */
static const struct {
    const char *name;
    uint8_t number;
} las_class_names[] = {
    {"never-classified", 0},
    {"unclassified", 1},
    {"ground", 2},
    {"low-vegetation", 3},
    {"medium-vegetation", 4},
    {"high-vegetation", 5},
    {"building", 6},
    {"low-noise", 7},
    {"water", 9},
    {"rail", 10},
    {"road", 11},
    {"wire-guard", 13},
    {"conductor", 14},
    {"tower", 15},
    {"connector", 16},
    {"bridge-deck", 17},
    {"high-noise", 18},
};

static int las_class_mark(const char *word, uint8_t classes[256])
{
    spelling s = spelling_of(word);
    if (*word && word[strspn(word, "0123456789")] == 0) {
        unsigned long number = strtoul(word, NULL, 10);
        if (number < 256) {
            classes[number] = 1;
            return 0;
        }
    }
    for (size_t i = 0; i < sizeof las_class_names / sizeof *las_class_names; i++) {
        if (strcmp(las_class_names[i].name, word) == 0) {
            classes[las_class_names[i].number] = 1;
            return 0;
        }
        spelling_try(&s, las_class_names[i].name);
    }
    spelling_complain(&s, "class", "");
    return END_USAGE;
}

int las_classes_parse(const char *list, uint8_t classes[256])
{
    int end = 0;
    for (bool more = true; more && end == 0;) {
        char word[32];
        size_t length = strcspn(list, ",");
        size_t kept = length < sizeof word ? length : sizeof word - 1;
        memcpy(word, list, kept);
        word[kept] = 0;
        end = las_class_mark(word, classes);
        more = list[length] == ',';
        list += length + more;
    }
    return end;
}
