#include "bench/core/rounds.h"
#include "cli/frame/message.h"

#include <math.h>
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>

static size_t rounds_column(const rounds_plan *p, size_t entry, size_t figure)
{
    return entry * p->figures + figure;
}

/* Which entry runs as number `k` of a turn? Turns count the warm-up rounds, too. */
static size_t rounds_entry(const rounds_plan *p, size_t turn, size_t k)
{
    if (k < p->leaders) return k;
    return p->leaders + (k - p->leaders + turn) % (p->entries - p->leaders);
}

static bool rounds_allocate(rounds_results *r)
{
    size_t columns = r->plan.entries * r->plan.figures;
    r->values = calloc(columns * r->plan.rounds + 1, sizeof *r->values);
    r->medians = calloc(columns + 1, sizeof *r->medians);
    r->minima = calloc(columns + 1, sizeof *r->minima);
    return r->values && r->medians && r->minima;
}

static void rounds_keep(rounds_results *r, size_t entry, size_t round, const double *figures)
{
    for (size_t f = 0; f < r->plan.figures; f++)
        r->values[rounds_column(&r->plan, entry, f) * r->plan.rounds + round] = figures[f];
}

static int rounds_run_all(rounds_results *r, rounds_run *run, void *self, double *figures)
{
    const rounds_plan *p = &r->plan;
    for (size_t turn = 0; turn < p->warmups + p->rounds; turn++)
        for (size_t k = 0; k < p->entries; k++) {
            bool counts = turn >= p->warmups;
            size_t entry = rounds_entry(p, turn, k),
                   round = counts ? turn - p->warmups : ROUNDS_WARMUP;
            int end = run(self, entry, round, figures);
            if (end) return end;
            if (counts) rounds_keep(r, entry, round, figures);
        }
    return 0;
}

/* NaN comes last. */
static int rounds_by_size(const void *one, const void *other)
{
    double a = *(const double *)one, b = *(const double *)other;
    return (a > b) - (a < b) + !!isnan(a) - !!isnan(b);
}

static void rounds_summarise(rounds_results *r, double *sorted)
{
    size_t n = r->plan.rounds;
    for (size_t column = 0; column < r->plan.entries * r->plan.figures; column++) {
        memcpy(sorted, r->values + column * n, n * sizeof *sorted);
        qsort(sorted, n, sizeof *sorted, rounds_by_size);
        r->medians[column] = (sorted[(n - 1) / 2] + sorted[n / 2]) / 2;
        r->minima[column] = sorted[0];
    }
}

int rounds_measure(const rounds_plan *plan, rounds_run *run, void *self, rounds_results *results)
{
    *results = (rounds_results){.plan = *plan};
    double *figures = calloc(plan->figures + 1, sizeof *figures);
    double *sorted = calloc(plan->rounds + 1, sizeof *sorted);
    int end = figures && sorted && rounds_allocate(results) ? 0 : fail_memory();
    if (end == 0) end = rounds_run_all(results, run, self, figures);
    if (end == 0) rounds_summarise(results, sorted);
    free(figures);
    free(sorted);
    return end;
}

double rounds_median(const rounds_results *results, size_t entry, size_t figure)
{
    return results->medians[rounds_column(&results->plan, entry, figure)];
}

double rounds_minimum(const rounds_results *results, size_t entry, size_t figure)
{
    return results->minima[rounds_column(&results->plan, entry, figure)];
}

void rounds_release(rounds_results *results)
{
    free(results->values);
    free(results->medians);
    free(results->minima);
    *results = (rounds_results){0};
}
