#include "cli/lines/contour_point.h"

#include <math.h>
#include <stdbool.h>
#include <string.h>

/* A point is a vertex if it is no farther from it than this part of its coordinates: programs round
 * coordinates when they write them, and points so near to one another would become equal. */
#define NEAR_VERTEX 0x1p-44

static bool point_is_at(const double p[2], const double vertex[2])
{
    double limit = NEAR_VERTEX * fmax(fabs(vertex[0]), fabs(vertex[1]));
    return fabs(p[0] - vertex[0]) <= limit && fabs(p[1] - vertex[1]) <= limit;
}

void contour_point(const mw_mesh *mesh, const double *values, double level, uint32_t from,
                   uint32_t to, double p[2])
{
    uint32_t low = values[from] >= level ? to : from, high = low == from ? to : from;
    double a[2], b[2], below = values[low], above = values[high];
    mw_mesh_vertex(mesh, low, a);
    mw_mesh_vertex(mesh, high, b);
    double t = (level / 2 - below / 2) / (above / 2 - below / 2);
    for (int i = 0; i < 2; i++) {
        double across = b[i] - a[i]; /* not rounded off an edge along an axis */
        p[i] = isfinite(across) ? a[i] + across * t : a[i] * (1 - t) + b[i] * t;
    }
    const double *vertex = above == level || point_is_at(p, b) ? b : point_is_at(p, a) ? a : p;
    memmove(p, vertex, 2 * sizeof *p);
}
