/* options.h - commands and their options. Tables of options parse the arguments and make the text
 * of --help; the tests compare them with the manual pages.
 *
 * A command keeps the values of its options in a structure of its own, its settings. Each option
 * names the member it sets. A setting that is all zero has its default. */
#ifndef MW_CLI_FRAME_OPTIONS_H
#define MW_CLI_FRAME_OPTIONS_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* What an option's argument is, and the type of its setting. */
typedef enum option_kind {
    OPTION_FLAG,         /* bool: no argument                                                */
    OPTION_TEXT,         /* const char *: not empty; its choices, if any, are for --help only */
    OPTION_LENGTH,       /* double: finite, not negative                                     */
    OPTION_MAX_DISTANCE, /* double: the same; a given 0 is stored as the least double above 0,
                          * because 0 stands for the default, which is no limit              */
    OPTION_XYZ,          /* coordinates: X,Y,Z, finite                                       */
    OPTION_XY_OR_XYZ,    /* coordinates: X,Y or X,Y,Z, finite                                */
    OPTION_COUNT,        /* uint32_t                                                         */
    /* uint32_t: at least 1, or a rule by name: MW_SAMPLE_CUBE_ROOT_OF_VERTICES, ... */
    OPTION_SAMPLE,
    OPTION_SEED,   /* uint64_t                                                         */
    OPTION_CHOICE, /* int: the number of a name among the option's choices             */
} option_kind;

typedef struct coordinates {
    double at[3];
    uint32_t count; /* 2 or 3; 0: the option was not given */
} coordinates;

/* The names that an option accepts: alone (OPTION_CHOICE) or in a list. */
typedef struct choices {
    const char *noun;         /* for messages: "walk" */
    const char *(*name)(int); /* the names from number 0; NULL after the last */
    const char *(*help)(int); /* the line of a name in --help; NULL hides the name. Without this
                               * function the names stand in one row */
} choices;

typedef struct option {
    const char *name; /* "walk" for --walk; NULL ends a table */
    char letter;      /* 'o' for -o; 0: none */
    option_kind kind;
    size_t offset;        /* of the member of the settings */
    const char *argument; /* its name in the help: "NAME" */
    const char *help;
    const choices *choices;
} option;

#define MAX_OPERANDS 2

/* A sub-command of the program. */
typedef struct command {
    const char *name;
    const char *operands;         /* as in the usage line: "MESH POINTS" */
    int operand_count;            /* how many operands there are ...  */
    int optional_operands;        /* ... and how many of the last ones may be missing: NULL then */
    const char *summary;          /* one line */
    const char *description;      /* a paragraph or more */
    const option *const *options; /* tables; NULL ends them. The first option of a name counts */
    const char *essential; /* names of the options that --help shows, in this order, separated by
                                   * blanks; --help all shows all of them */
    size_t settings_size;
    int (*run)(const void *settings, const char *const *operands); /* returns the exit code */
} command;

/* The first member of every command's settings, and its options. */
typedef struct common_settings {
    const char *output; /* NULL or "-": standard output */
    uint64_t seed;
    uint32_t threads;   /* 0: all there are, see options_threads */
    const char *layout; /* of meshes in netCDF; NULL: recognised */
    bool quiet, help, help_all;
} common_settings;

extern const option common_options[];

/* Parse the arguments after the command's name; NULL ends them. Returns 0, or an exit code after a
 * complaint. If the settings then have `help` set, the operands have not been checked. */
int options_parse(const command *c, char **arguments, void *settings,
                  const char *operands[MAX_OPERANDS]);

/* Complain that a command got `found` operands, which is not what it wants. Returns END_USAGE. */
int options_fail_operands(const command *c, int found);

/* Refuse a count above the maximum that the library takes. The message writes the maximum as
 * `written`, or in digits if that is NULL. Returns 0, or END_USAGE after a complaint. */
int options_limit(const char *name, uint32_t value, uint32_t most, const char *written);

/* How many threads a value of --threads means: 0 stands for all that the system offers. */
uint32_t options_threads(uint32_t threads);

#endif
