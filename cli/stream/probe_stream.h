/* probe_stream.h - a surface in space, and a stream of probes or points that are answered with it:
 * what each touches, the nearest point, or the side on which it is. */
#ifndef MW_CLI_STREAM_PROBE_STREAM_H
#define MW_CLI_STREAM_PROBE_STREAM_H

#include "cli/stream/query_stream.h"

#include <meshwalk/meshwalk.h>

typedef struct probe_settings {
    query_stream_settings stream;
    double max_distance, min_distance;
    uint32_t samples, iterations, race;
    int guide;
    int start;         /* mw_probe_start */
    int extent, faces; /* mw_probe_extent, mw_probe_faces */
    bool certain, inside, all, one_per_place, nearest, weld, any;
} probe_settings;

/* A surface that is ready for probes, and the statistics of its probes. */
typedef struct probed_surface {
    const probe_settings *settings;
    double begin; /* monotonic_seconds */
    mw_surface *surface;
    mw_prober *prober;
    uint64_t states[MW_TOUCH_STATE_COUNT];
    uint64_t sides[MW_SURFACE_SIDE_COUNT];
    mw_probe_counters counters;
    mw_touch_lists lists; /* with --all: of the block that is being written */
} probed_surface;

/* Read the surface and prepare what the settings ask for. Returns 0, or an exit code after a
 * complaint. Release it in both cases. */
int probed_surface_open(probed_surface *p, const char *path);
void probed_surface_release(probed_surface *p);

/* Answer the rows of the file `path`. Returns the exit code. */
int probed_surface_run(probed_surface *p, const char *path);

#endif
