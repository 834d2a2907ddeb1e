/* cdt_state.c - the lists of a constrained triangulation in the making. */
#include "triangulate/constrained/cdt_state.h"

#include <stdlib.h>

/* Room for one more record: the list, perhaps elsewhere now, or NULL when out of memory. */
static void *list_with_room(void *list, size_t count, size_t *capacity, size_t size)
{
    if (count < *capacity) return list;
    size_t more = 2 * *capacity + 64;
    void *grown = mw__realloc(list, more, size);
    if (grown) *capacity = more;
    return grown;
}

bool mw__segment_parts_add(mw_segment_parts *list, mw_segment_part part)
{
    mw_segment_part *item = list_with_room(list->item, list->count, &list->capacity, sizeof *item);
    if (!item) return false;
    list->item = item;
    item[list->count++] = part;
    return true;
}

bool mw__subsegment_owner_add(mw_cdt *m, mw_subsegment_owner owner)
{
    mw_subsegment_owner *list =
        list_with_room(m->owner, m->owner_count, &m->owner_capacity, sizeof *list);
    if (!list) return false;
    m->owner = list;
    list[m->owner_count++] = owner;
    return true;
}

bool mw__subsegment_note(mw_cdt *m, const mw_subsegment *subsegment, uint32_t segment)
{
    mw_segment_part part = {subsegment->from, subsegment->to, segment};
    if (subsegment->number == m->subsegments.count) {
        if (!mw__segment_parts_add(&m->subsegments, part)) return false;
    } else if (segment < m->subsegments.item[subsegment->number].segment) {
        m->subsegments.item[subsegment->number] = part;
    }
    return mw__subsegment_owner_add(m, (mw_subsegment_owner){subsegment->number, segment});
}

bool mw__subsegment_owners_create(mw_subsegment_owners *owners, const mw_cdt *m)
{
    size_t *first = mw__calloc(m->subsegments.count + 1, sizeof *first);
    uint32_t *segment = mw__alloc(m->owner_count, sizeof *segment);
    *owners = (mw_subsegment_owners){first, segment};
    if (!first || !segment) return false;
    for (size_t i = 0; i < m->owner_count; i++) first[m->owner[i].subsegment]++;
    size_t sum = 0;
    for (size_t p = 0; p <= m->subsegments.count; p++) {
        sum += first[p];
        first[p] = sum;
    }
    for (size_t i = m->owner_count; i-- > 0;)
        segment[--first[m->owner[i].subsegment]] = m->owner[i].segment;
    return true;
}

void mw__subsegment_owners_release(mw_subsegment_owners *owners)
{
    free(owners->first);
    free(owners->segment);
}
