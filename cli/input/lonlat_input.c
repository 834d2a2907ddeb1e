#include "cli/input/lonlat_input.h"
#include "cli/frame/message.h"
#include "src/base/threads.h"

#include <math.h>

static int lonlat_fail_vertex(const char *path, size_t vertex, const double *p)
{
    char longitude[32], latitude[32];
    mw_format_double(p[0], longitude);
    mw_format_double(p[1], latitude);
    complain("%s: vertex %zu: %s, %s are not a longitude and a latitude in degrees", path, vertex,
             longitude, latitude);
    return END_INPUT;
}

int lonlat_input_mesh(const char *path, mw_mesh_file *file)
{
    if (file->has_z) return 0;
    for (size_t v = 0; v < file->point_count; v++) {
        double *p = file->points + 3 * v, direction[3];
        mw_lonlat_to_direction(p[0], p[1], direction);
        if (isnan(direction[0])) return lonlat_fail_vertex(path, v, p);
        for (int k = 0; k < 3; k++) p[k] = direction[k];
    }
    file->has_z = 1;
    return 0;
}

/* The length of rays: a power of two, at least 1 and at least half of the largest coordinate. */
static double lonlat_ray_length(const double centre[3])
{
    double largest = fmax(fmax(fabs(centre[0]), fabs(centre[1])), fabs(centre[2]));
    int exponent;
    frexp(largest, &exponent);
    return exponent > 0 ? ldexp(1, exponent - 1) : 1;
}

typedef struct direction_making {
    const double *lonlat, *centre;
    size_t stride, count;
    double far;
    double *points;
    uint32_t team;
} direction_making;

static void directions_make(void *work, uint32_t member)
{
    const direction_making *m = work;
    size_t end = m->count * (member + 1) / m->team;
    for (size_t i = m->count * member / m->team; i < end; i++) {
        double *p = m->points + 3 * i;
        mw_lonlat_to_direction(m->lonlat[i * m->stride], m->lonlat[i * m->stride + 1], p);
        for (int k = 0; k < 3; k++) p[k] = m->centre[k] + m->far * p[k];
    }
}

void lonlat_input_directions(const double *lonlat, size_t stride, size_t count,
                             const double centre[3], uint32_t threads, double *points)
{
    enum { WORTHWHILE = 1 << 12 }; /* points that make a thread worthwhile */
    direction_making making = {lonlat,
                               centre,
                               stride,
                               count,
                               lonlat_ray_length(centre),
                               points,
                               mw__team(threads, count / WORTHWHILE + 1)};
    mw__team_run(making.team, directions_make, &making);
}
