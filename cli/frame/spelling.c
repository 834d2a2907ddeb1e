#include "cli/frame/spelling.h"
#include "cli/frame/message.h"

#include <string.h>

#define LONGEST 32 /* longer words are not compared */

static size_t smaller_of_two(size_t a, size_t b)
{
    return a < b ? a : b;
}

/* The least number of letters to insert, delete, replace or swap with their neighbour, which makes
 * one word of the other [Damerau 1964]. */
static size_t edit_distance(const char *a, size_t n, const char *b, size_t m)
{
    size_t d[LONGEST + 1][LONGEST + 1];
    for (size_t i = 0; i <= n; i++) d[i][0] = i;
    for (size_t j = 0; j <= m; j++) d[0][j] = j;
    for (size_t i = 1; i <= n; i++)
        for (size_t j = 1; j <= m; j++) {
            size_t replaced = d[i - 1][j - 1] + (a[i - 1] != b[j - 1]);
            d[i][j] = smaller_of_two(replaced, 1 + smaller_of_two(d[i - 1][j], d[i][j - 1]));
            if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
                d[i][j] = smaller_of_two(d[i][j], d[i - 2][j - 2] + 1);
        }
    return d[n][m];
}

spelling spelling_of(const char *word)
{
    return (spelling){.word = word, .distance = LONGEST};
}

void spelling_try(spelling *s, const char *candidate)
{
    size_t n = strlen(s->word), m = strlen(candidate);
    if (n > LONGEST || m > LONGEST) return;
    size_t d = edit_distance(s->word, n, candidate, m);
    /* A word of three letters or more that begins the candidate is a good guess too: --thr,
     * --arith. */
    if (n >= 3 && n < m && strncmp(s->word, candidate, n) == 0) d = smaller_of_two(d, 1);
    if (d < s->distance) {
        s->distance = d;
        s->best = candidate;
    }
}

void spelling_complain(const spelling *s, const char *what, const char *prefix)
{
    if (s->best && s->distance <= 1 + strlen(s->word) / 4 && s->distance < strlen(s->word))
        complain("unknown %s '%s%s'; did you mean '%s%s'?", what, prefix, s->word, prefix, s->best);
    else
        complain("unknown %s '%s%s'", what, prefix, s->word);
}
