/* number_list.h - numbers and integers that are collected one by one. Private. */
#ifndef MW_SRC_IO_GRID_NUMBER_LIST_H
#define MW_SRC_IO_GRID_NUMBER_LIST_H

#include "base/base.h"

/* All zero: an empty list. Release the values with free(). */
typedef struct mw_number_list {
    double *values;
    size_t count, room;
} mw_number_list;

typedef struct mw_integer_list {
    int64_t *values;
    size_t count, room;
} mw_integer_list;

mw_status mw__numbers_add(mw_number_list *list, double value, mw_error *error);
mw_status mw__integers_add(mw_integer_list *list, int64_t value, mw_error *error);

/* The numbers that a file gives to its vertices or faces, which may have gaps and come in any
 * order. Their ranks from 1 are what is counted by. */
typedef struct mw_rank_list {
    mw_integer_list numbers; /* as they come; sorted by mw__ranks_sort */
    size_t *order;           /* position in the file of each rank; NULL: they come in order */
} mw_rank_list;

/* Sort the numbers. *twice is the position in the file of a number that was there before, SIZE_MAX
 * if there is none. */
mw_status mw__ranks_sort(mw_rank_list *ranks, size_t *twice, mw_error *error);
/* Position in the file of rank i, from 0. */
size_t mw__ranks_position(const mw_rank_list *ranks, size_t i);
/* The rank of a number, from 0; SIZE_MAX if it is not there. */
size_t mw__ranks_find(const mw_rank_list *ranks, int64_t number);
void mw__ranks_release(mw_rank_list *ranks);

#endif
