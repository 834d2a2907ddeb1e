/* column_places.c - columns get places in the order in which the ranks use them. */
#include "operator/column_places.h"

#include <stdlib.h>
#include <string.h>

static uint32_t *places_make(const mw_operator *o)
{
    const uint64_t entries = mw__operator_first(o, o->rows);
    uint32_t *place = mw__alloc_lines(o->columns + entries, sizeof *place), next = 0;
    if (!place) return NULL;
    uint32_t *of_entry = place + o->columns;
    memset(place, 0xff, o->columns * sizeof *place);
    for (uint64_t e = 0; e < entries; e++) {
        uint32_t *at = &place[o->column[e]];
        if (*at == MW_NONE) *at = next++;
        of_entry[e] = *at;
    }
    for (size_t i = 0; i < o->columns; i++)
        if (place[i] == MW_NONE) place[i] = next++;
    return place;
}

const uint32_t *mw__column_places(const mw_operator *o)
{
    mw_operator *keeper = (mw_operator *)o;
    uint32_t *places = atomic_load(&keeper->places);
    if (places) return places;
    uint32_t *made = places_make(o);
    if (!made || atomic_compare_exchange_strong(&keeper->places, &places, made)) return made;
    free(made);
    return places;
}
