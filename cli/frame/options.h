/* options.h - the options of a command: tables that parse, print the help, and are checked against the man pages.
 *
 * A command keeps what its options say in a structure of its own, its settings. Each option names a member of it. All
 * zero is the default of every setting. */
#ifndef CLI_OPTIONS_H
#define CLI_OPTIONS_H

#include "cli/frame/text.h"

typedef enum option_kind {
    OPTION_FLAG,   /* bool: no argument                          */
    OPTION_TEXT,   /* const char *; choices, if any, are for --help */
    OPTION_LENGTH, /* double: finite and not negative            */
    OPTION_REACH,  /* double: likewise, but 0 given is not the default: the least length above 0 stands for it */
    OPTION_POINT,  /* coordinates: X,Y,Z, finite                 */
    OPTION_PLACE,  /* coordinates: X,Y or X,Y,Z, finite          */
    OPTION_COUNT,  /* uint32_t                                   */
    OPTION_SAMPLE, /* uint32_t: a number, not 0, or MW_SAMPLE_.. */
    OPTION_SEED,   /* uint64_t                                   */
    OPTION_CHOICE, /* int: the number of a name, see choices     */
} option_kind;

typedef struct coordinates {
    double at[3];
    uint32_t count; /* 0: not given */
} coordinates;

/* The names an OPTION_CHOICE accepts, or that may stand in a list. */
typedef struct choices {
    const char *noun;         /* "walk" */
    const char *(*name)(int); /* from 0; NULL beyond the last */
    const char *(*help)(int); /* a line for --help, or NULL: not listed. No function: the names are listed in a row */
} choices;

typedef struct option {
    const char *name; /* "walk", given as --walk; NULL ends a table */
    char letter;      /* 'o', given as -o; 0: none */
    option_kind kind;
    size_t offset;        /* of the setting */
    const char *argument; /* as the help calls it: "NAME" */
    const char *help;
    const choices *choices;
} option;

#define MOST_OPERANDS 2

/* A sub-command. */
typedef struct command {
    const char *name;
    const char *operands;         /* as in the usage line: "MESH POINTS" */
    int operand_count;            /* exactly so many */
    int optional_operands;        /* but so many of the last ones may be missing: NULL then */
    const char *summary;          /* one line */
    const char *description;      /* a paragraph or more */
    const option *const *options; /* tables; NULL ends them. Of options of one name the first counts */
    size_t settings_size;
    int (*run)(const void *settings, const char *const *operands); /* returns the exit code */
} command;

/* The settings every command begins with, and their options. */
typedef struct common_settings {
    const char *output; /* NULL or "-": standard output */
    uint64_t seed;
    uint32_t threads;
    bool quiet, help;
} common_settings;

extern const option common_options[];

/* Parse the arguments after the command's name. Returns 0, or an exit code after a complaint. With `help` set in the
 * settings nothing else has been checked. */
int options_parse(const command *c, int count, char **arguments, void *settings, const char *operands[MOST_OPERANDS]);

/* Refuse a count that the library does not take; `written`: the most as words, NULL: as digits. Returns 0 or an exit code
 * after a complaint. */
int options_limit(const char *name, uint32_t value, uint32_t most, const char *written);

/* The text that `--help` prints. */
void options_help(text *t, const command *c);

/* Add words to a text, wrapped and indented. */
void options_wrap(text *t, const char *words, size_t indent);

#endif
