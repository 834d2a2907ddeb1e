/* word_list.h - lists on the command line: words with commas between them. */
#ifndef MW_BENCH_CORE_WORD_LIST_H
#define MW_BENCH_CORE_WORD_LIST_H

#include "cli/frame/options.h"

#include <stddef.h>
#include <stdint.h>

/* Call `visit` with each word, until a call returns an exit code. Returns that, or 0. */
typedef int word_list_visit(const char *word, void *self);
int word_list_each(const char *list, word_list_visit *visit, void *self);

/* The words are names: set the bits of their numbers. Complains about other words. Returns 0 or an
 * exit code. */
int word_list_names(const char *list, const choices *names, uint32_t *set);

#define MOST_SIZES 8

typedef struct size_list {
    size_t size[MOST_SIZES];
    size_t count;
} size_list;

/* The words are numbers of vertices, those of --sizes. Complains about other words. Returns 0 or an
 * exit code. */
int word_list_sizes(const char *list, size_list *sizes);
/* As word_list_sizes: numbers of ranks, those of --ranks. */
int word_list_ranks(const char *list, size_list *ranks);

#endif
