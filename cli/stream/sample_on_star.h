/* sample_on_star.h - the value that a field of a star-shaped polyhedron has where each ray meets
 * it. */
#ifndef MW_CLI_STREAM_SAMPLE_ON_STAR_H
#define MW_CLI_STREAM_SAMPLE_ON_STAR_H

#include "cli/input/mesh_field.h"
#include "cli/stream/query_stream.h"

typedef struct star_sample_settings {
    const query_stream_settings *stream;
    const coordinates *centre;
    mesh_field_choice field; /* without `triangles` */
    bool lonlat, open, status;
    bool nearest; /* where a corner has no value: that of the nearest corner that has one */
} star_sample_settings;

/* Sample the mesh operands[0] at the rays operands[1]. Returns the exit code. */
int star_sample_run(const star_sample_settings *s, const char *const *operands);

#endif
