#include "io/grid/number_list.h"

#include <stdlib.h>

/* Half as much again, at least 16; NULL without memory. */
static void *list_grow(void *values, size_t count, size_t *room)
{
    size_t wanted = count < 16 ? 16 : count + count / 2;
    void *larger = mw__realloc(values, wanted, 8);
    if (larger) *room = wanted;
    return larger;
}

mw_status mw__numbers_add(mw_number_list *list, double value, mw_error *error)
{
    if (list->count == list->room) {
        double *larger = list_grow(list->values, list->count, &list->room);
        if (!larger) return mw__fail_memory(error);
        list->values = larger;
    }
    list->values[list->count++] = value;
    return MW_OK;
}

mw_status mw__integers_add(mw_integer_list *list, int64_t value, mw_error *error)
{
    if (list->count == list->room) {
        int64_t *larger = list_grow(list->values, list->count, &list->room);
        if (!larger) return mw__fail_memory(error);
        list->values = larger;
    }
    list->values[list->count++] = value;
    return MW_OK;
}

typedef struct rank_pair {
    int64_t number;
    size_t position;
} rank_pair;

static int ranks_compare_pairs(const void *one, const void *other)
{
    const rank_pair *a = one, *b = other;
    if (a->number != b->number) return a->number < b->number ? -1 : 1;
    return (a->position > b->position) - (a->position < b->position);
}

static bool ranks_ascend(const mw_integer_list *list)
{
    for (size_t i = 1; i < list->count; i++)
        if (list->values[i - 1] >= list->values[i]) return false;
    return true;
}

mw_status mw__ranks_sort(mw_rank_list *ranks, size_t *twice, mw_error *error)
{
    mw_integer_list *list = &ranks->numbers;
    *twice = SIZE_MAX;
    if (ranks_ascend(list)) return MW_OK;
    rank_pair *pairs = mw__alloc(list->count, sizeof *pairs);
    ranks->order = mw__alloc(list->count, sizeof *ranks->order);
    if (!pairs || !ranks->order) {
        free(pairs);
        return mw__fail_memory(error);
    }
    for (size_t i = 0; i < list->count; i++) pairs[i] = (rank_pair){list->values[i], i};
    qsort(pairs, list->count, sizeof *pairs, ranks_compare_pairs);
    for (size_t i = 0; i < list->count; i++) {
        list->values[i] = pairs[i].number;
        ranks->order[i] = pairs[i].position;
        if (i > 0 && pairs[i].number == pairs[i - 1].number && pairs[i].position < *twice)
            *twice = pairs[i].position;
    }
    free(pairs);
    return MW_OK;
}

size_t mw__ranks_position(const mw_rank_list *ranks, size_t i)
{
    return ranks->order ? ranks->order[i] : i;
}

size_t mw__ranks_find(const mw_rank_list *ranks, int64_t number)
{
    const int64_t *values = ranks->numbers.values;
    size_t low = 0, high = ranks->numbers.count;
    if (high == 0 || number < values[0] || number > values[high - 1]) return SIZE_MAX;
    /* nearly always there are no gaps */
    uint64_t guess = (uint64_t)number - (uint64_t)values[0];
    if (guess < high && values[guess] == number) return (size_t)guess;
    while (low < high) {
        size_t middle = low + (high - low) / 2;
        if (values[middle] < number)
            low = middle + 1;
        else
            high = middle;
    }
    return values[low] == number ? low : SIZE_MAX;
}

void mw__ranks_release(mw_rank_list *ranks)
{
    free(ranks->numbers.values);
    free(ranks->order);
    *ranks = (mw_rank_list){0};
}
