/* constraint_builder.h - a constraint_file that grows while a reader reads. Private. */
#ifndef MW_SRC_IO_CONSTRAINTS_CONSTRAINT_BUILDER_H
#define MW_SRC_IO_CONSTRAINTS_CONSTRAINT_BUILDER_H

#include "io/text/byte_source.h"

#include <meshwalk/io.h>

/* As in mesh_builder.h, nothing is allocated by what a file announces. */
typedef struct mw_constraint_builder {
    mw_constraint_file *file;
    const mw_source *source; /* what is read from: for messages */
    size_t point_room, segment_room, hole_room, skipped_room;
} mw_constraint_builder;

mw_status mw__constraint_point(mw_constraint_builder *builder, const double xyz[3],
                               mw_error *error);
mw_status mw__constraint_segment(mw_constraint_builder *builder, uint32_t a, uint32_t b,
                                 uint32_t polygon, uint64_t record, mw_error *error);
mw_status mw__constraint_hole(mw_constraint_builder *builder, double x, double y, mw_error *error);
mw_status mw__constraint_skip(mw_constraint_builder *builder, mw_skipped_ring ring,
                              mw_error *error);

#endif
