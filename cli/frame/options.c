#include "cli/frame/options.h"
#include "cli/frame/message.h"
#include "cli/frame/spelling.h"
#include "src/base/threads.h"

#include <ctype.h>
#include <errno.h>
#include <float.h>
#include <inttypes.h>
#include <math.h>
#include <meshwalk/io.h>
#include <meshwalk/locate.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const char *layout_name(int i)
{
    return mw_layout_name((size_t)i);
}

static const choices layout_choices = {.noun = "layout", .name = layout_name};

const option common_options[] = {
    {"output", 'o', OPTION_TEXT, offsetof(common_settings, output), "FILE",
     "write to FILE, which appears under its name only when it is complete (default: -, standard "
     "output)",
     NULL},
    {"threads", 0, OPTION_COUNT, offsetof(common_settings, threads), "N",
     "use at most N threads (default: 0, all); results do not depend on it", NULL},
    {"seed", 0, OPTION_SEED, offsetof(common_settings, seed), "S",
     "seed of everything random (default: 0); where a point lies does not depend on it", NULL},
    {"layout", 0, OPTION_TEXT, offsetof(common_settings, layout), "NAME",
     "of a mesh in netCDF: how its file is laid out; NAME:0 and NAME:1 count its vertices from 0 "
     "or "
     "1 (default: recognised)",
     &layout_choices},
    {"quiet", 'q', OPTION_FLAG, offsetof(common_settings, quiet), NULL,
     "no progress, no warnings, no remarks", NULL},
    {"help", 'h', OPTION_FLAG, offsetof(common_settings, help), NULL,
     "print the options that most people need; --help all prints all of them", NULL},
    {0},
};

static const option *option_named(const command *c, const char *name, size_t length)
{
    for (const option *const *table = c->options; *table; table++)
        for (const option *o = *table; o->name; o++)
            if (strlen(o->name) == length && strncmp(o->name, name, length) == 0) return o;
    return NULL;
}

static const option *option_lettered(const command *c, char letter)
{
    for (const option *const *table = c->options; *table; table++)
        for (const option *o = *table; o->name; o++)
            if (o->letter && o->letter == letter) return o;
    return NULL;
}

static int unknown_option(const command *c, const char *name, size_t length)
{
    char word[64];
    if (length >= sizeof word) length = sizeof word - 1;
    memcpy(word, name, length);
    word[length] = 0;
    spelling s = spelling_of(word);
    for (const option *const *table = c->options; *table; table++)
        for (const option *o = *table; o->name; o++) spelling_try(&s, o->name);
    spelling_complain(&s, "option", "--");
    return END_USAGE;
}

/* Parse digits only, without a sign, a blank, or anything after them. */
static bool parse_natural(const char *value, uint64_t most, uint64_t *number)
{
    for (const char *c = value; *c; c++)
        if (!isdigit((unsigned char)*c)) return false;
    errno = 0;
    unsigned long long parsed = strtoull(value, NULL, 10);
    *number = parsed;
    return *value && errno == 0 && parsed <= most;
}

/* Parse a finite decimal number that ends before `stop`: not hexadecimal, without blanks. Returns
 * where it ends; NULL if there is no such number. */
static const char *parse_number(const char *value, char stop, double *number)
{
    size_t length = strspn(value, "0123456789.eE+-");
    if (length == 0 || value[length] != stop) return NULL;
    char *end;
    *number = strtod(value, &end);
    return end == value + length && isfinite(*number) ? end : NULL;
}

/* Does the text of a number have a digit other than 0 before the exponent? */
static bool is_written_nonzero(const char *value)
{
    return strcspn(value, "123456789") < strcspn(value, "eE");
}

/* Parse a number that is not negative. A number so small that it rounds to 0 is refused, as one
 * that is too large. */
static bool parse_length(const char *value, double *number)
{
    return parse_number(value, 0, number) && *number >= 0 &&
           (*number > 0 || !is_written_nonzero(value));
}

/* Parse `count` numbers with commas between them. */
static bool parse_numbers(const char *value, double *numbers, uint32_t count)
{
    for (uint32_t k = 0; k < count; k++) {
        const char *end = parse_number(value, k + 1 < count ? ',' : 0, &numbers[k]);
        if (!end) return false;
        value = end + 1;
    }
    return true;
}

/* Parse X,Y or X,Y,Z. */
static bool parse_coordinates(const char *value, coordinates *where)
{
    for (where->count = 2; where->count <= 3; where->count++)
        if (parse_numbers(value, where->at, where->count)) return true;
    return false;
}

/* Parse the size of a sample: a number, or the name of a rule. */
static bool parse_sample(const char *value, uint32_t *sample)
{
    uint64_t number = 0;
    if (strcmp(value, "cube-root") == 0)
        *sample = MW_SAMPLE_CUBE_ROOT_OF_VERTICES;
    else if (strcmp(value, "fourth-root") == 0)
        *sample = MW_SAMPLE_FOURTH_ROOT_OF_VERTICES;
    else if (parse_natural(value, UINT32_MAX - 1, &number) && number > 0)
        *sample = (uint32_t)number;
    else
        return false;
    return true;
}

static int parse_choice(const option *o, const char *value, int *number)
{
    spelling s = spelling_of(value);
    const char *name;
    for (int i = 0; (name = o->choices->name(i)); i++) {
        if (strcmp(name, value) == 0) {
            *number = i;
            return 0;
        }
        spelling_try(&s, name);
    }
    spelling_complain(&s, o->choices->noun, "");
    return END_USAGE;
}

static int option_bad_value(const option *o, const char *value, const char *wanted)
{
    complain("option '--%s' must be %s, not '%s'", o->name, wanted, value);
    return END_USAGE;
}

static int option_take(const option *o, const char *value, void *settings)
{
    char *target = (char *)settings + o->offset;
    uint64_t natural = 0;
    double length = 0;
    coordinates where = {0};
    uint32_t sample = 0;
    int choice = 0, end;
    switch (o->kind) {
    case OPTION_FLAG: memcpy(target, &(bool){true}, sizeof(bool)); return 0;
    case OPTION_TEXT:
        if (!*value) return option_bad_value(o, value, "a text that is not empty");
        memcpy(target, &value, sizeof value);
        return 0;
    case OPTION_LENGTH:
    case OPTION_MAX_DISTANCE:
        if (!parse_length(value, &length)) return option_bad_value(o, value, "a length, 0 or more");
        if (o->kind == OPTION_MAX_DISTANCE && length == 0) length = DBL_TRUE_MIN;
        memcpy(target, &length, sizeof length);
        return 0;
    case OPTION_XYZ:
        where.count = 3;
        if (!parse_numbers(value, where.at, where.count))
            return option_bad_value(o, value, "a point X,Y,Z");
        memcpy(target, &where, sizeof where);
        return 0;
    case OPTION_XY_OR_XYZ:
        if (!parse_coordinates(value, &where))
            return option_bad_value(o, value, "coordinates X,Y or X,Y,Z");
        memcpy(target, &where, sizeof where);
        return 0;
    case OPTION_COUNT:
        if (!parse_natural(value, UINT32_MAX, &natural))
            return option_bad_value(o, value, "a whole number below 2^32");
        memcpy(target, &(uint32_t){(uint32_t)natural}, sizeof(uint32_t));
        return 0;
    case OPTION_SAMPLE:
        if (!parse_sample(value, &sample))
            return option_bad_value(o, value,
                                    "a whole number from 1 to 2^32 - 2, cube-root or fourth-root");
        memcpy(target, &sample, sizeof sample);
        return 0;
    case OPTION_SEED:
        if (!parse_natural(value, UINT64_MAX, &natural))
            return option_bad_value(o, value, "a whole number below 2^64");
        memcpy(target, &natural, sizeof natural);
        return 0;
    case OPTION_CHOICE:
        end = parse_choice(o, value, &choice);
        if (end == 0) memcpy(target, &choice, sizeof choice);
        return end;
    }
    return END_USAGE;
}

int options_limit(const char *name, uint32_t value, uint32_t most, const char *written)
{
    char digits[16];
    if (value <= most) return 0;
    snprintf(digits, sizeof digits, "%" PRIu32, most);
    complain("option '--%s' must be at most %s, not '%" PRIu32 "'", name,
             written ? written : digits, value);
    return END_USAGE;
}

uint32_t options_threads(uint32_t threads)
{
    return mw__team(threads, MW_MOST_THREADS);
}

/* The argument of an option: the rest of its word, or else the next word. */
static const char *option_argument(const option *o, const char *attached, char ***word)
{
    if (attached) return attached;
    if ((*word)[1]) return *++*word;
    complain("option '--%s' needs an argument: %s", o->name, o->argument);
    return NULL;
}

/* --name, --name=value, --name value. */
static int parse_long(const command *c, char ***word, void *settings)
{
    const char *name = **word + 2;
    size_t length = strcspn(name, "=");
    const char *attached = name[length] ? name + length + 1 : NULL;
    const option *o = option_named(c, name, length);
    if (!o) return unknown_option(c, name, length);
    if (o->kind == OPTION_FLAG) {
        if (!attached) return option_take(o, NULL, settings);
        if (strcmp(o->name, "help") == 0 && strcmp(attached, "all") == 0) {
            ((common_settings *)settings)->help_all = true;
            return option_take(o, NULL, settings);
        }
        complain("option '--%s' takes no argument", o->name);
        return END_USAGE;
    }
    const char *value = option_argument(o, attached, word);
    return value ? option_take(o, value, settings) : END_USAGE;
}

/* -q, -o value, -ovalue, and flags together: -qo value. */
static int parse_letters(const command *c, char ***word, void *settings)
{
    for (const char *letter = **word + 1; *letter; letter++) {
        const option *o = option_lettered(c, *letter);
        if (!o) {
            complain("unknown option '-%c'", *letter);
            return END_USAGE;
        }
        if (o->kind == OPTION_FLAG) {
            option_take(o, NULL, settings);
            continue;
        }
        const char *value = option_argument(o, letter[1] ? letter + 1 : NULL, word);
        return value ? option_take(o, value, settings) : END_USAGE;
    }
    return 0;
}

int options_fail_operands(const command *c, int found)
{
    complain("%s: expected %s, found %d argument%s; usage: meshwalk %s [options] %s", c->name,
             c->operands, found, found == 1 ? "" : "s", c->name, c->operands);
    return END_USAGE;
}

int options_parse(const command *c, char **arguments, void *settings,
                  const char *operands[MAX_OPERANDS])
{
    int found = 0, end = 0;
    bool options = true;
    for (char **word = arguments; *word && end == 0; word++) {
        if (options && strcmp(*word, "--") == 0)
            options = false;
        else if (options && strncmp(*word, "--", 2) == 0)
            end = parse_long(c, &word, settings);
        else if (options && **word == '-' && (*word)[1])
            end = parse_letters(c, &word, settings);
        else if (found++ < c->operand_count)
            operands[found - 1] = *word;
    }
    common_settings *common = settings;
    if (common->help && found > 0 && strcmp(operands[0], "all") == 0) common->help_all = true;
    if (end || common->help) return end;
    for (int i = 0; i < found && i < c->operand_count; i++)
        if (!*operands[i]) {
            complain("the name of a file is empty");
            return END_USAGE;
        }
    if (found <= c->operand_count && found >= c->operand_count - c->optional_operands) return 0;
    return options_fail_operands(c, found);
}
