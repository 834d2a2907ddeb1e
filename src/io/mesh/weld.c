#include "io/mesh/weld.h"
#include "base/coordinates.h"

#include <stdlib.h>
#include <string.h>

static bool corners_equal(const double a[3], const double b[3])
{
    for (int k = 0; k < 3; k++)
        if (mw__coordinate_bits(a[k]) != mw__coordinate_bits(b[k])) return false;
    return true;
}

mw_status mw__weld_start(mw_weld *weld, mw_error *error)
{
    *weld = (mw_weld){.slot_count = 64};
    weld->slots = mw__alloc(weld->slot_count, sizeof *weld->slots);
    if (!weld->slots) return mw__fail_memory(error);
    memset(weld->slots, 0xff, weld->slot_count * sizeof *weld->slots);
    weld->seed = mw__coordinates_seed(weld->slots);
    return MW_OK;
}

void mw__weld_release(mw_weld *weld)
{
    free(weld->slots);
    *weld = (mw_weld){0};
}

/* The slot that holds the vertex at xyz, or the free one where it belongs. */
static size_t weld_find_slot(const mw_weld *weld, const double *points, const double xyz[3])
{
    size_t mask = weld->slot_count - 1, slot = mw__coordinates_hash(weld->seed, xyz) & mask;
    while (weld->slots[slot] != MW_NONE &&
           !corners_equal(points + 3 * (size_t)weld->slots[slot], xyz))
        slot = (slot + 1) & mask;
    return slot;
}

static mw_status weld_grow(mw_weld *weld, const double *points, mw_error *error)
{
    mw_weld larger = {.slot_count = 2 * weld->slot_count, .seed = weld->seed};
    larger.slots = mw__alloc(larger.slot_count, sizeof *larger.slots);
    if (!larger.slots) return mw__fail_memory(error);
    memset(larger.slots, 0xff, larger.slot_count * sizeof *larger.slots);
    for (size_t s = 0; s < weld->slot_count; s++)
        if (weld->slots[s] != MW_NONE)
            larger.slots[weld_find_slot(&larger, points, points + 3 * (size_t)weld->slots[s])] =
                weld->slots[s];
    free(weld->slots);
    *weld = larger;
    return MW_OK;
}

mw_status mw__weld_vertex(mw_weld *weld, mw_mesh_builder *builder, const double xyz[3],
                          uint32_t *vertex, mw_error *error)
{
    size_t count = builder->file->point_count;
    mw_status status = MW_OK;
    if (count >= weld->slot_count / 4 * 3) status = weld_grow(weld, builder->file->points, error);
    if (status) return status;
    size_t slot = weld_find_slot(weld, builder->file->points, xyz);
    if (weld->slots[slot] == MW_NONE) {
        status = mw__build_point(builder, xyz[0], xyz[1], xyz[2], error);
        if (status) return status;
        weld->slots[slot] = (uint32_t)count;
    } else {
        builder->file->welded++;
    }
    *vertex = weld->slots[slot];
    return MW_OK;
}
