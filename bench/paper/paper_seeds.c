#include "bench/paper/paper_seeds.h"

#include <math.h>

/* Mean and standard deviation of a value that stands in each of `seeds` results, `stride` bytes
 * apart. */
static void seeds_take(double *mean, double *deviation, size_t stride, size_t seeds)
{
    const char *first = (const char *)mean;
    double sum = 0, squares = 0;
    for (size_t i = 0; i < seeds; i++) sum += *(const double *)(const void *)(first + i * stride);
    sum /= (double)seeds;
    for (size_t i = 0; i < seeds; i++)
        squares += pow(*(const double *)(const void *)(first + i * stride) - sum, 2);
    *mean = sum;
    *deviation = sqrt(squares / (double)(seeds > 1 ? seeds - 1 : 1));
}

void paper_seeds_fold(paper *p, size_t seeds)
{
    size_t sets = p->count / seeds, stride = sets * sizeof *p->results;
    for (size_t set = 0; set < sets; set++) {
        paper_result *r = &p->results[set];
        for (int q = 0; q < QUANTITIES; q++) {
            for (size_t i = 0; i < MOST_ALGORITHMS; i++)
                seeds_take(&r->outcome.value[i][q], &r->deviation.value[i][q], stride, seeds);
            seeds_take(&r->outcome.whole[q], &r->deviation.whole[q], stride, seeds);
        }
    }
    p->count = sets;
}
