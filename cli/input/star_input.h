/* star_input.h - a star-shaped polyhedron from the file of a mesh. */
#ifndef MW_CLI_INPUT_STAR_INPUT_H
#define MW_CLI_INPUT_STAR_INPUT_H

#include "cli/frame/options.h"

#include <meshwalk/meshwalk.h>

typedef struct star_input {
    mw_surface *surface;
    mw_star *star;     /* NULL if the surface may be open: then */
    mw_prober *prober; /* boxes find the triangle that a ray meets first */
} star_input;

/* How the polyhedron is taken. */
typedef struct star_input_settings {
    const coordinates *centre; /* not given: the origin */
    bool lonlat;               /* x and y of a file without z are longitude and latitude */
    bool angles;               /* for the orthogonal walk */
    uint32_t threads;          /* 0: all there are */
    bool borrow;               /* rays walk on the surface's own records */
    bool open; /* triangles need not surround the centre; the centre is the origin */
} star_input_settings;

/* The centre must not move for a surface that may be open. Returns 0, or an exit code after a
 * complaint. */
int star_input_check_open(bool open, const coordinates *centre);

/* Make the polyhedron. Its vertices with equal coordinates are one: that closes the seam of a
 * sphere, and its poles. With `lonlat` the vertices of the file come onto the unit sphere. Returns
 * 0, or an exit code after a complaint; release it in both cases. */
int star_input_make(star_input *s, const char *path, mw_mesh_file *file,
                    const star_input_settings *settings);
/* Find the triangles that rays from the centre through `count` points meet, as
 * mw_star_locate_batch(). Of a surface that may be open only `threads` and `progress` of the
 * options count, and nothing is counted in *counters; a ray that meets nothing is MW_OUTSIDE. */
mw_status star_input_locate(const star_input *in, const double *points, size_t stride, size_t count,
                            const mw_star_query_options *options, mw_location *answers,
                            mw_counters *counters, mw_error *error);
void star_input_release(star_input *s);

#endif
