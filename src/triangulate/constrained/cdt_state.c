/* cdt_state.c - the lists of a constrained triangulation in the making. */
#include "triangulate/constrained/cdt_state.h"

#include <stdlib.h>

/* Room for one more record: the list, perhaps elsewhere now, or NULL when out of memory. */
static void *grow(void *list, size_t count, size_t *capacity, size_t size)
{
    if (count < *capacity) return list;
    size_t more = 2 * *capacity + 64;
    void *grown = mw__realloc(list, more, size);
    if (grown) *capacity = more;
    return grown;
}

bool mw__stretches_add(mw_stretches *list, mw_stretch stretch)
{
    mw_stretch *item = grow(list->item, list->count, &list->capacity, sizeof *item);
    if (!item) return false;
    list->item = item;
    item[list->count++] = stretch;
    return true;
}

bool mw__run_add(mw_cdt *m, mw_run run)
{
    mw_run *list = grow(m->run, m->run_count, &m->run_capacity, sizeof *list);
    if (!list) return false;
    m->run = list;
    list[m->run_count++] = run;
    return true;
}

bool mw__runs_create(mw_runs *runs, const mw_cdt *m)
{
    size_t *first = mw__calloc(m->pieces.count + 1, sizeof *first);
    uint32_t *segment = mw__alloc(m->run_count, sizeof *segment);
    *runs = (mw_runs){first, segment};
    if (!first || !segment) return false;
    for (size_t i = 0; i < m->run_count; i++) first[m->run[i].piece]++;
    size_t sum = 0;
    for (size_t p = 0; p <= m->pieces.count; p++) {
        sum += first[p];
        first[p] = sum;
    }
    for (size_t i = m->run_count; i-- > 0;) segment[--first[m->run[i].piece]] = m->run[i].segment;
    return true;
}

void mw__runs_release(mw_runs *runs)
{
    free(runs->first);
    free(runs->segment);
}
