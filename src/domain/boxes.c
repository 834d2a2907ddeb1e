/* boxes.c - a packed tree of boxes. */
#include "domain/boxes.h"

#include <stdlib.h>

static void build_level(mw_boxes *b, uint32_t level, mw_box (*box_of)(const void *things, uint32_t i),
                        const void *things)
{
    uint32_t below = level ? b->level_boxes[level - 1] : b->count;
    for (uint32_t i = 0; i < b->level_boxes[level]; i++) {
        mw_box box = mw__box_of_nothing();
        for (uint32_t j = i * MW_BOXES_FAN; j < below && j < (i + 1) * MW_BOXES_FAN; j++)
            mw__box_join(&box, level ? b->box[b->first[level - 1] + j] : box_of(things, j));
        b->box[b->first[level] + i] = box;
    }
}

bool mw__boxes_create(mw_boxes *boxes, uint32_t count, mw_box (*box_of)(const void *things, uint32_t i),
                      const void *things)
{
    *boxes = (mw_boxes){.count = count};
    uint32_t sum = 0, below = count;
    do {
        uint32_t here = (below + MW_BOXES_FAN - 1) / MW_BOXES_FAN;
        boxes->first[boxes->level_count] = sum;
        boxes->level_boxes[boxes->level_count++] = here;
        sum += here;
        below = here;
    } while (below > 1);
    boxes->box = mw__alloc(sum, sizeof *boxes->box);
    if (!boxes->box) return false;
    for (uint32_t level = 0; level < boxes->level_count; level++) build_level(boxes, level, box_of, things);
    return true;
}

void mw__boxes_release(mw_boxes *boxes)
{
    free(boxes->box);
    *boxes = (mw_boxes){0};
}

size_t mw__boxes_bytes(const mw_boxes *boxes)
{
    size_t sum = 0;
    for (uint32_t level = 0; level < boxes->level_count; level++) sum += boxes->level_boxes[level];
    return sum * sizeof *boxes->box;
}

/* Thing i begins boxes of the levels below the one returned, at least of none. */
static uint32_t levels_begun(const mw_boxes *b, uint32_t i)
{
    uint32_t level = 0;
    while (level < b->level_count && i % MW_BOXES_FAN == 0) {
        i /= MW_BOXES_FAN;
        level++;
    }
    return level;
}

uint32_t mw__boxes_next(const mw_boxes *boxes, uint32_t i, mw_point q)
{
    for (uint64_t at = i; at < boxes->count;) {
        uint64_t passed = 0;
        for (uint32_t level = levels_begun(boxes, (uint32_t)at); level-- > 0 && !passed;) {
            uint32_t shift = MW_BOXES_BITS * (level + 1);
            if (!mw__box_contains(&boxes->box[boxes->first[level] + (at >> shift)], q)) passed = UINT64_C(1) << shift;
        }
        if (!passed) return (uint32_t)at;
        at += passed;
    }
    return boxes->count;
}
