/* spelling.h - "did you mean ...?": the known word nearest to a mistyped one. */
#ifndef MW_CLI_FRAME_SPELLING_H
#define MW_CLI_FRAME_SPELLING_H

#include <stddef.h>

typedef struct spelling {
    const char *word; /* as typed */
    const char *best; /* the nearest candidate so far */
    size_t distance;  /* its edit distance from the word */
} spelling;

spelling spelling_of(const char *word);
void spelling_try(spelling *s, const char *candidate);

/* Complain: "unknown WHAT 'WORD'", and "did you mean ...?" if a candidate is near. The prefix goes
 * before both words ("--" for options). */
void spelling_complain(const spelling *s, const char *what, const char *prefix);

#endif
