/* team_sort.c - the radix sort of hilbert.c by several threads. Each member counts the digits of
 * its part of the keys; from the counts of all it knows where each of its keys goes. Keys with
 * equal digits stay in order, so the result does not depend on the threads. */
#include "base/team_sort.h"
#include "base/threads.h"

#include <stdlib.h>
#include <string.h>

enum { DIGIT_BITS = 11, DIGIT_COUNT = 3, DIGIT_VALUES = 1 << DIGIT_BITS };

typedef struct team_sort {
    const mw_key *from;
    mw_key *to;
    size_t n;
    uint32_t team, shift;
    uint32_t (*next)[DIGIT_VALUES]; /* of each member */
} team_sort;

static size_t sort_part(const team_sort *s, uint32_t member)
{
    return (size_t)((uint64_t)s->n * member / s->team);
}

static uint32_t sort_digit(const team_sort *s, size_t i)
{
    return s->from[i].key >> s->shift & (DIGIT_VALUES - 1);
}

static void sort_count(void *work, uint32_t member)
{
    const team_sort *s = work;
    uint32_t *count = s->next[member];
    memset(count, 0, sizeof s->next[member]);
    for (size_t i = sort_part(s, member), end = sort_part(s, member + 1); i < end; i++)
        count[sort_digit(s, i)]++;
}

/* Counts become the places of the first keys. */
static void sort_add_up(const team_sort *s)
{
    uint32_t sum = 0;
    for (uint32_t digit = 0; digit < DIGIT_VALUES; digit++)
        for (uint32_t member = 0; member < s->team; member++) {
            uint32_t here = s->next[member][digit];
            s->next[member][digit] = sum;
            sum += here;
        }
}

static void sort_scatter(void *work, uint32_t member)
{
    const team_sort *s = work;
    uint32_t *next = s->next[member];
    for (size_t i = sort_part(s, member), end = sort_part(s, member + 1); i < end; i++)
        s->to[next[sort_digit(s, i)]++] = s->from[i];
}

void mw__sort_keys_in_team(mw_key *keys, mw_key *scratch, size_t n, uint32_t team)
{
    team_sort s = {.from = keys, .to = scratch, .n = n, .team = team};
    if (team > 1) s.next = mw__alloc(team, sizeof *s.next);
    if (!s.next) { /* one alone, or too little memory for more */
        mw__sort_keys(keys, scratch, n);
        return;
    }
    for (uint32_t digit = 0; digit < DIGIT_COUNT; digit++) {
        s.shift = digit * DIGIT_BITS;
        mw__team_run(team, sort_count, &s);
        sort_add_up(&s);
        mw__team_run(team, sort_scatter, &s);
        mw_key *swap = (mw_key *)s.from;
        s.from = s.to;
        s.to = swap;
    }
    free(s.next);
    memcpy(keys, scratch, n * sizeof *keys); /* three digits: the result lies there */
}
