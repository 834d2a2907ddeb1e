/* spelling.h - which known word a mistyped one was meant to be. */
#ifndef CLI_SPELLING_H
#define CLI_SPELLING_H

#include <stddef.h>

typedef struct spelling {
    const char *word; /* as typed */
    const char *best; /* the nearest candidate so far */
    size_t distance;
} spelling;

spelling spelling_of(const char *word);
void spelling_try(spelling *s, const char *candidate);

/* Complain: "unknown WHAT 'WORD'", with "did you mean ...?" where a candidate is near. `prefix` goes before the
 * candidate ("--" for options). */
void spelling_complain(const spelling *s, const char *what, const char *prefix);

#endif
