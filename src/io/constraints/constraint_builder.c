/* Constraints as they are read. */
#include "io/constraints/constraint_builder.h"

#include <inttypes.h>
#include <stdlib.h>
#include <string.h>

/* Half as much again, at least 16. NULL: out of memory, and the array is as it was. */
static void *array_grow(void *array, size_t count, size_t *room, size_t size)
{
    size_t wanted = count < 16 ? 16 : count + count / 2;
    void *larger = mw__realloc(array, wanted, size);
    if (larger) *room = wanted;
    return larger;
}

static mw_status constraint_too_many(const mw_constraint_builder *builder, uint32_t limit,
                                     const char *what, mw_error *error)
{
    return mw__fail(error, MW_ERROR_LIMIT, "%.240s: more than %" PRIu32 " %s",
                    mw__source_name(builder->source), limit, what);
}

mw_status mw__constraint_point(mw_constraint_builder *builder, const double xyz[3], mw_error *error)
{
    mw_constraint_file *file = builder->file;
    if (file->point_count >= MW_MAX_VERTICES)
        return constraint_too_many(builder, MW_MAX_VERTICES, "points", error);
    if (file->point_count == builder->point_room) {
        double *points =
            array_grow(file->points, file->point_count, &builder->point_room, 3 * sizeof *points);
        if (!points) return mw__fail_memory(error);
        file->points = points;
    }
    memcpy(file->points + 3 * file->point_count++, xyz, 3 * sizeof *xyz);
    return MW_OK;
}

/* The three arrays of the segments have one room. */
static bool segments_grow(mw_constraint_builder *builder)
{
    mw_constraint_file *file = builder->file;
    size_t room = 0, count = file->segment_count;
    uint32_t *segments = array_grow(file->segments, count, &room, 2 * sizeof *segments);
    if (segments) file->segments = segments;
    uint32_t *polygon = segments ? array_grow(file->polygon, count, &room, sizeof *polygon) : NULL;
    if (polygon) file->polygon = polygon;
    uint32_t *record = polygon ? array_grow(file->record, count, &room, sizeof *record) : NULL;
    if (!record) return false;
    file->record = record;
    builder->segment_room = room;
    return true;
}

mw_status mw__constraint_segment(mw_constraint_builder *builder, uint32_t a, uint32_t b,
                                 uint32_t polygon, uint64_t record, mw_error *error)
{
    mw_constraint_file *file = builder->file;
    size_t i = file->segment_count;
    if (i >= MW_NONE) return constraint_too_many(builder, MW_NONE, "segments", error);
    if (i == builder->segment_room && !segments_grow(builder)) return mw__fail_memory(error);
    file->segments[2 * i] = a;
    file->segments[2 * i + 1] = b;
    file->polygon[i] = polygon;
    file->record[i] = record < UINT32_MAX ? (uint32_t)record : UINT32_MAX;
    file->segment_count++;
    return MW_OK;
}

mw_status mw__constraint_hole(mw_constraint_builder *builder, double x, double y, mw_error *error)
{
    mw_constraint_file *file = builder->file;
    if (file->hole_seed_count == builder->hole_room) {
        double *holes = array_grow(file->hole_seeds, file->hole_seed_count, &builder->hole_room,
                                   2 * sizeof *holes);
        if (!holes) return mw__fail_memory(error);
        file->hole_seeds = holes;
    }
    file->hole_seeds[2 * file->hole_seed_count] = x;
    file->hole_seeds[2 * file->hole_seed_count + 1] = y;
    file->hole_seed_count++;
    return MW_OK;
}

mw_status mw__constraint_skip(mw_constraint_builder *builder, mw_skipped_ring ring, mw_error *error)
{
    mw_constraint_file *file = builder->file;
    if (file->skipped_count == builder->skipped_room) {
        mw_skipped_ring *rings =
            array_grow(file->skipped, file->skipped_count, &builder->skipped_room, sizeof *rings);
        if (!rings) return mw__fail_memory(error);
        file->skipped = rings;
    }
    file->skipped[file->skipped_count++] = ring;
    return MW_OK;
}
